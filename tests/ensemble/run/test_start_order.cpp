/// The order in which the places of a run are started: the longest ones first, each place once, and the share of the
/// whole from complete blocks alone.

#include "ensemble/run/start_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace stylobate {
namespace {

using Places = std::vector<std::uint64_t>;

/// Places begin .. end - 1 but for those that are done.
StartOrder::Next places_of(std::uint64_t& next, std::uint64_t end, const DoneSet& done)
{
    return [&next, end, &done]() -> std::optional<std::uint64_t> {
        while (next < end && done.has(next))
            ++next;
        return next < end ? std::optional(next++) : std::nullopt;
    };
}

double grows(std::uint64_t place)
{
    return 1 + static_cast<double>(place);
}

TEST(LongestPlaces, AreThoseThatTakeMostStepsTheLongestFirst)
{
    const DoneSet none{RunOrder(100)};
    const auto steps = [](std::uint64_t place) { return place == 37 ? 900.0 : place == 36 ? 800.0 : 100.0; };
    EXPECT_EQ(longest_places({0, 100}, none, 2, steps), (Places{37, 36}));
    EXPECT_EQ(longest_places({0, 100}, none, 4, steps), (Places{37, 36, 0, 1}));
    EXPECT_EQ(longest_places({38, 100}, none, 2, grows), (Places{99, 98}));
    EXPECT_EQ(longest_places({0, 3}, none, 1000, steps), (Places{})) << "all take as long";
    EXPECT_EQ(longest_places({0, 100}, none, 0, steps), (Places{}));
}

TEST(LongestPlaces, WhatIsDoneIsNoneOfThem)
{
    DoneSet done{RunOrder(100)};
    for (const std::uint64_t place : {99, 97, 3})
        done.add(place, false, false);
    EXPECT_EQ(longest_places({0, 100}, done, 3, grows), (Places{98, 96, 95}));
}

TEST(LongestPlaces, WhereAllTakeAboutAsLongTheOrderStays)
{
    const DoneSet none{RunOrder(100)};
    EXPECT_EQ(longest_places({0, 100}, none, 10, [](std::uint64_t) { return 64.0; }), (Places{}));
    EXPECT_EQ(longest_places({0, 100}, none, 10, [](std::uint64_t place) { return 1000 + grows(place); }), (Places{}));
}

TEST(StartOrder, GivesTheLongestThenTheOthersEachOnce)
{
    const DoneSet none{RunOrder(10)};
    std::uint64_t next = 0;
    StartOrder order(places_of(next, 10, none));
    order.start_first({7, 2, 9, 0}, 1);
    Places given;
    while (const std::optional<std::uint64_t> place = order.next())
        given.push_back(*place);
    EXPECT_EQ(given, (Places{2, 9, 0, 1, 3, 4, 5, 6, 8}));
    EXPECT_EQ(order.next_apart(), 7U);
    EXPECT_EQ(order.next_apart(), std::nullopt);
}

TEST(StartOrder, WithoutLongestOnesIsThatOfTheRun)
{
    DoneSet done{RunOrder(6)};
    done.add(2, false, false);
    std::uint64_t next = 0;
    StartOrder order(places_of(next, 6, done));
    Places given;
    while (const std::optional<std::uint64_t> place = order.next())
        given.push_back(*place);
    EXPECT_EQ(given, (Places{0, 1, 3, 4, 5}));
    EXPECT_EQ(order.next_apart(), std::nullopt);
}

TEST(StartOrder, WhatIsGivenBackIsGivenAnew)
{
    const DoneSet none{RunOrder(4)};
    std::uint64_t next = 0;
    StartOrder order(places_of(next, 4, none));
    order.start_first({3}, 0);
    EXPECT_EQ(order.next(), 3U);
    EXPECT_EQ(order.next(), 0U);
    order.give_back(3);
    EXPECT_EQ(order.next(), 3U);
    EXPECT_EQ(order.next(), 1U);
    EXPECT_EQ(order.next(), 2U);
    EXPECT_EQ(order.next(), std::nullopt);
    order.give_back(2);
    EXPECT_EQ(order.next(), 2U) << "after the last one, too";
    EXPECT_EQ(order.next(), std::nullopt);
}

TEST(StartOrder, ServesSeveralThreads)
{
    constexpr std::uint64_t count = 20'000;
    std::uint64_t next = 0;
    std::mutex mutex;
    StartOrder order([&]() -> std::optional<std::uint64_t> {
        const std::lock_guard lock(mutex);
        return next < count ? std::optional(next++) : std::nullopt;
    });
    Places longest;
    for (std::uint64_t place = 0; place < count; place += 20)
        longest.push_back(place);
    order.start_first(longest, 100);
    std::vector<Places> given(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < given.size(); ++t)
        threads.emplace_back([&, t] {
            while (const std::optional<std::uint64_t> place = t == 0 ? order.next_apart() : order.next())
                given[t].push_back(*place);
        });
    for (std::thread& thread : threads)
        thread.join();
    std::set<std::uint64_t> all;
    for (const Places& some : given)
        for (const std::uint64_t place : some)
            EXPECT_TRUE(all.insert(place).second) << place << " came twice";
    EXPECT_EQ(all.size(), count);
    EXPECT_EQ(given[0].size(), 100U);
}

/// The longest places all collapse here, and no other one does. Whatever is done when, the sample is that of the first
/// blocks, whole, by a count of its own.
TEST(StartOrder, TheSampleOfTheWholeIsFairAtAnyTime)
{
    constexpr std::uint64_t total = 5000;
    const RunOrder run_order(total);
    const auto collapses = [&](std::uint64_t place) { return run_order.index(place) % 5 == 0; };
    DoneSet done(run_order);
    const Places longest =
        longest_places({0, total}, done, 1000, [&](std::uint64_t place) { return collapses(place) ? 1000.0 : 100.0; });
    ASSERT_EQ(longest.size(), 1000U);
    std::uint64_t next = 0;
    const DoneSet none(run_order);
    StartOrder order(places_of(next, total, none));
    order.start_first(longest, 40);
    std::vector<bool> is_done(total);
    std::size_t most_parts = 0, most_done = 0;
    const auto add = [&](std::uint64_t place) {
        done.add(place, collapses(place), false);
        is_done[place] = true;
        std::uint64_t whole = 0, collapsed = 0;
        for (std::uint64_t end = 0; whole < total; whole = end) {
            end = run_order.block_end(whole);
            if (!std::all_of(is_done.begin() + static_cast<long>(whole), is_done.begin() + static_cast<long>(end),
                             [](bool is) { return is; }))
                break;
        }
        for (std::uint64_t p = 0; p < whole; ++p)
            collapsed += collapses(p);
        const DoneSet::Part sample = done.sample();
        ASSERT_EQ(sample.end, whole);
        ASSERT_EQ(sample.collapsed, collapsed);
        most_parts = std::max(most_parts, done.parts().size());
        most_done += whole == 0;
    };
    int turn = 0;
    std::optional<std::uint64_t> apart = order.next_apart();
    while (const std::optional<std::uint64_t> place = order.next()) {
        add(*place);
        if (++turn % 100 == 0 && apart) { // those of the host end in between
            add(*apart);
            apart = order.next_apart();
        }
    }
    for (; apart; apart = order.next_apart())
        add(*apart);
    EXPECT_EQ(done.all().end, total);
    EXPECT_EQ(done.parts().size(), 1U);
    EXPECT_LE(most_parts, 1001U);
    EXPECT_GT(most_done, 900U) << "while the longest ones run nothing is known of the whole";
}

} // namespace
} // namespace stylobate
