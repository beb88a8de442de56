/// Numbers that are dealt out to ranks, with ranks that are threads.

#include "ensemble/planar/device/device.hpp"
#include "ensemble/run/deal.hpp"
#include "tests/ensemble/run/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <thread>

namespace stylobate {
namespace {

using test::ThreadRanks;

/// 0 .. count - 1, once.
Deal::Stock stock_of(std::uint64_t count, std::uint64_t& next)
{
    return {[&next, count]() -> std::optional<std::uint64_t> {
                return next < count ? std::optional(next++) : std::nullopt;
            },
            count};
}

TEST(Deal, GivesEachNumberToOneRankAndRankZeroAllThatComesOfThem)
{
    for (const int size : {1, 2, 5}) {
        constexpr std::uint64_t count = 1000;
        std::uint64_t next = 0;
        std::set<std::uint64_t> own;       // that rank 0 had
        std::multiset<std::string> others; // what the others gave
        std::atomic<std::uint64_t> dealt = 0;
        ThreadRanks(size).run([&](Ranks& ranks) {
            Deal deal(ranks, stock_of(count, next), 2, [&](std::string_view content) { others.emplace(content); });
            std::vector<std::thread> threads;
            std::mutex mutex;
            for (int thread = 0; thread < 3; ++thread)
                threads.emplace_back([&] {
                    while (const std::optional<std::uint64_t> number = deal.next()) {
                        ++dealt;
                        const std::lock_guard lock(mutex);
                        if (ranks.leads())
                            own.insert(*number);
                        else
                            deal.give(std::to_string(*number));
                    }
                });
            for (std::thread& thread : threads)
                thread.join();
            EXPECT_TRUE(deal.finish());
        });
        EXPECT_EQ(dealt, count) << size << " ranks";
        std::set<std::uint64_t> all = own;
        for (const std::string& text : others) {
            std::uint64_t number = 0;
            std::from_chars(text.data(), text.data() + text.size(), number);
            EXPECT_TRUE(all.insert(number).second) << number << " came twice";
        }
        EXPECT_EQ(all.size(), count);
        EXPECT_EQ(*all.rbegin(), count - 1);
    }
}

TEST(Deal, DealsOneRoundAfterTheOther)
{
    std::map<std::uint64_t, int> taken;
    ThreadRanks(3).run([&](Ranks& ranks) {
        for (std::uint64_t round = 0; round < 20; ++round) {
            std::uint64_t next = 0;
            Deal deal(ranks, stock_of(7, next), 1, [&](std::string_view) { ++taken[round]; });
            while (const std::optional<std::uint64_t> number = deal.next())
                if (!ranks.leads())
                    deal.give("x");
            EXPECT_TRUE(deal.finish());
            const std::vector<std::string> said = ranks.of_all(std::to_string(round));
            EXPECT_EQ(std::count(said.begin(), said.end(), std::to_string(round)), 3);
        }
    });
    for (const auto& [round, count] : taken)
        EXPECT_LE(count, 7);
}

/// A rank that waits until the others have done all else holds the numbers that it has, and no more.
TEST(Deal, ARankThatIsSlowGetsLess)
{
    constexpr std::uint64_t count = 800;
    std::uint64_t next = 0;
    std::atomic<std::uint64_t> by_slow = 0, by_others = 0;
    ThreadRanks(3).run([&](Ranks& ranks) {
        Deal deal(ranks, stock_of(count, next), 2, [](std::string_view) {});
        const bool slow = ranks.rank() == 2;
        while (const std::optional<std::uint64_t> number = deal.next()) {
            ++(slow ? by_slow : by_others);
            if (slow) // as slow as the others need for all but what may be in its hand
                while (by_others < count - 3 * Deal::portion(count, 3))
                    std::this_thread::yield();
        }
        EXPECT_TRUE(deal.finish());
    });
    EXPECT_EQ(by_slow + by_others, count);
    EXPECT_LE(by_slow, 3 * Deal::portion(count, 3));
}

/// Rank 0 as another one sees it, with a look at each portion before it is sent.
class WatchedFirst : public Ranks {
public:
    WatchedFirst(Ranks& ranks, std::string given, std::function<void(int to, std::size_t numbers)> portion)
        : ranks_(ranks), given_(std::move(given)), portion_(std::move(portion))
    {
    }
    std::map<int, std::size_t> received; ///< from each rank, of what has come of numbers

    int rank() const override { return ranks_.rank(); }
    int size() const override { return ranks_.size(); }
    int local_rank() const override { return ranks_.local_rank(); }
    int local_size() const override { return ranks_.local_size(); }
    int sharing() const override { return ranks_.sharing(); }
    void send(int to, std::string content) override
    {
        if (content.size() > sizeof(std::uint64_t)) // a letter, and the numbers
            portion_(to, content.size() / sizeof(std::uint64_t));
        ranks_.send(to, std::move(content));
    }
    std::optional<Message> receive() override
    {
        std::optional<Message> message = ranks_.receive();
        if (message && message->content.ends_with(given_))
            ++received[message->from];
        return message;
    }
    void await_sent() override { ranks_.await_sent(); }
    std::string of_first(const std::string& mine) override { return ranks_.of_first(mine); }
    std::vector<std::string> of_all(const std::string& mine) override { return ranks_.of_all(mine); }
    void abort(int status) override { ranks_.abort(status); }

private:
    Ranks& ranks_;
    const std::string given_;
    const std::function<void(int, std::size_t)> portion_;
};

/// What waits to be taken has a bound: when a rank gets a portion, rank 0 has taken all that came of the numbers
/// before, but of those that the rank still has in hand.
TEST(Deal, RanksWaitForARankZeroThatFallsBehind)
{
    constexpr std::uint64_t count = 20'000, ahead = 2;
    std::uint64_t next = 0;
    std::size_t taken = 0, portions = 0;
    std::map<int, std::size_t> dealt;
    ThreadRanks(3).run([&](Ranks& ranks) {
        if (ranks.leads()) {
            WatchedFirst* watched = nullptr;
            WatchedFirst first(ranks, "given", [&](int to, std::size_t numbers) {
                std::size_t received = 0;
                for (const auto& [from, some] : watched->received)
                    received += some;
                EXPECT_EQ(taken, received) << "something waits on rank 0";
                EXPECT_LE(dealt[to] - watched->received[to], ahead + 1) << "and one that is being run";
                dealt[to] += numbers;
                ++portions;
            });
            watched = &first;
            Deal deal(first, stock_of(count, next), ahead, [&](std::string_view) { ++taken; });
            EXPECT_TRUE(deal.finish()); // rank 0 runs none itself
            return;
        }
        Deal deal(ranks, stock_of(count, next), ahead, [](std::string_view) {});
        while (deal.next())
            deal.give("given");
        EXPECT_TRUE(deal.finish());
    });
    EXPECT_EQ(taken, count);
    EXPECT_GT(portions, count / 256);
}

TEST(Deal, AnyRankStopsAllOfThem)
{
    for (const int who : {0, 1, 2}) {
        std::uint64_t next = 0;
        std::atomic<std::uint64_t> dealt = 0;
        std::atomic<int> complete = 0;
        ThreadRanks(3).run([&](Ranks& ranks) {
            Deal deal(ranks, stock_of(1'000'000'000, next), 2, [](std::string_view) {});
            while (const std::optional<std::uint64_t> number = deal.next())
                if (++dealt > 500 && ranks.rank() == who)
                    deal.stop();
            complete += deal.finish();
        });
        EXPECT_EQ(complete, 0) << "stopped by rank " << who;
        EXPECT_LT(next, 1'000'000'000);
    }
}

/// A rank that has numbers in hand, and asks for none, hears of it too.
TEST(Deal, AStopIsHeardByARankThatIsBusy)
{
    for (const int who : {0, 1}) {
        std::uint64_t next = 0;
        std::atomic<int> busy = 0;
        ThreadRanks(3).run([&](Ranks& ranks) {
            Deal deal(ranks, stock_of(1'000'000'000, next), 2, [](std::string_view) {});
            EXPECT_TRUE(deal.next());
            ++busy;
            while (busy < 3)
                std::this_thread::yield();
            if (ranks.rank() == who)
                deal.stop();
            while (!deal.stopped())
                std::this_thread::yield();
            EXPECT_FALSE(deal.next());
            EXPECT_FALSE(deal.finish());
        });
    }
}

TEST(Deal, AnErrorOfWhatIsTakenComesOutOnRankZeroAndStopsTheOthers)
{
    std::uint64_t next = 0;
    std::atomic<int> errors = 0, stopped = 0, taken = 0;
    ThreadRanks(2).run([&](Ranks& ranks) {
        Deal deal(ranks, stock_of(1'000'000'000, next), 2, [&](std::string_view) {
            ++taken;
            throw std::runtime_error("the disk is full");
        });
        while (const std::optional<std::uint64_t> number = deal.next())
            if (!ranks.leads())
                deal.give("x");
        try {
            stopped += !deal.finish();
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "the disk is full");
            errors += ranks.leads();
        }
    });
    EXPECT_EQ(errors, 1);
    EXPECT_EQ(stopped, 1);
    EXPECT_EQ(taken, 1) << "taken after a failure";
}

TEST(Deal, PortionsShrinkWithWhatIsLeft)
{
    EXPECT_EQ(Deal::portion(1'000'000, 4), 256U);
    EXPECT_EQ(Deal::portion(640, 4), 20U);
    EXPECT_EQ(Deal::portion(3, 4), 1U);
    EXPECT_EQ(Deal::portion(0, 4), 1U);
}

TEST(Ranks, TheFirstThatSaysSomethingIsHeard)
{
    ThreadRanks(4).run([](Ranks& ranks) {
        EXPECT_EQ(first_said(ranks, ranks.rank() < 2 ? std::nullopt : std::optional(std::to_string(ranks.rank()))),
                  "2");
        EXPECT_EQ(first_said(ranks, std::nullopt), std::nullopt);
        EXPECT_FALSE(all_agree(&ranks, ranks.rank() != 3));
        EXPECT_TRUE(all_agree(&ranks, true));
    });
    EXPECT_TRUE(all_agree(nullptr, true));
    EXPECT_FALSE(all_agree(nullptr, false));
}

/// Every device of a machine is used, and every process has one.
TEST(Ranks, ShareTheDevicesOfTheirMachine)
{
    for (const int devices : {1, 2, 3, 8})
        for (const int ranks : {1, 2, 3, 5, 8, 16}) {
            std::map<int, int> users;
            for (int rank = 0; rank < ranks; ++rank) {
                const std::vector<int> own = devices_of_rank(devices, rank, ranks);
                EXPECT_FALSE(own.empty()) << devices << " devices, rank " << rank << " of " << ranks;
                for (const int device : own)
                    ++users[device];
            }
            EXPECT_EQ(users.size(), static_cast<std::size_t>(devices));
            EXPECT_EQ(users.begin()->first, 0);
            EXPECT_EQ(users.rbegin()->first, devices - 1);
            const auto [least, most] = std::minmax_element(
                users.begin(), users.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
            EXPECT_LE(most->second - least->second, 1) << devices << " devices, " << ranks << " ranks";
        }
    EXPECT_TRUE(devices_of_rank(0, 0, 2).empty());
}

} // namespace
} // namespace stylobate
