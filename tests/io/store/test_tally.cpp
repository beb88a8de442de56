/// Results without rows: times in bounded memory, counts that depend on no order and no interruption, and files that
/// are refused when they are not what was written.

#include "tests/io/store/result_samples.hpp"

#include "io/store/result_store.hpp"

#include <algorithm>
#include <csignal>
#include <map>
#include <numeric>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stylobate {
namespace {

// ---- times

std::vector<double> some_times(std::size_t n, double sigma)
{
    std::mt19937_64 random(n);
    std::lognormal_distribution<double> law(1.5, sigma);
    std::vector<double> times(n);
    for (double& time : times)
        time = law(random);
    return times;
}

double sorted_median(std::vector<double> times)
{
    std::sort(times.begin(), times.end());
    const std::size_t n = times.size();
    return n % 2 == 1 ? times[n / 2] : (times[n / 2 - 1] + times[n / 2]) / 2;
}

TimeCounts counts_of(const std::vector<double>& times)
{
    TimeCounts counts;
    for (const double time : times)
        counts.add(time);
    return counts;
}

TEST(TimeCounts, FewAreExact)
{
    EXPECT_TRUE(std::isnan(TimeCounts().median()));
    for (const std::size_t n : {1U, 2U, 3U, 10U, 1001U, 4096U}) {
        const std::vector<double> times = some_times(n, 0.7);
        const TimeCounts counts = counts_of(times);
        EXPECT_TRUE(counts.exact());
        EXPECT_EQ(counts.total(), n);
        EXPECT_EQ(counts.median(), sorted_median(times)) << n;
    }
    EXPECT_EQ(counts_of({5, 0, 5, 0, 5}).median(), 5);
    EXPECT_EQ(counts_of({5, 0, 5, 0}).median(), 2.5);
    TimeCounts equal; // many, but few different ones
    for (int i = 0; i < 100'000; ++i)
        equal.add(i % 10 == 0 ? 3.1 : 4.7);
    EXPECT_TRUE(equal.exact());
    EXPECT_EQ(equal.median(), 4.7);
}

TEST(TimeCounts, ManyAreRoundedByNoMoreThanStated)
{
    double worst = 0;
    for (const std::size_t n : {4097U, 20'000U, 100'001U, 300'000U})
        for (const double sigma : {0.01, 0.7, 3.0}) {
            const std::vector<double> times = some_times(n, sigma);
            const TimeCounts counts = counts_of(times);
            EXPECT_FALSE(counts.exact());
            EXPECT_EQ(counts.total(), n);
            const double median = sorted_median(times), error = std::abs(counts.median() / median - 1);
            EXPECT_LE(error, TimeCounts::rounding) << n << ' ' << sigma;
            worst = std::max(worst, error);
        }
    EXPECT_GT(worst, TimeCounts::rounding / 100) << "nothing was rounded";
    const TimeCounts one = counts_of(some_times(300'000, 0.7));
    EXPECT_LT(one.counts().size(), 4096U * 12); // within e^1.5 times e^(-4.5 x 0.7) to e^(4.5 x 0.7): 9 octaves
}

TEST(TimeCounts, NoOrderAndNoInterruptionChangesThem)
{
    for (const std::size_t n : {3000U, 4096U, 4097U, 30'000U}) {
        std::vector<double> times = some_times(n, 0.5);
        times.insert(times.end(), times.begin(), times.begin() + 1000); // some twice
        const TimeCounts whole = counts_of(times);
        std::mt19937_64 random(n);
        for (int i = 0; i < 3; ++i) {
            std::shuffle(times.begin(), times.end(), random);
            TimeCounts parts;
            for (const double time : times) {
                if (random() % 1000 == 0)
                    parts = TimeCounts(parts.counts(), parts.exact());
                parts.add(time);
            }
            EXPECT_EQ(parts.exact(), whole.exact());
            EXPECT_EQ(parts.counts(), whole.counts());
        }
    }
}

TEST(TimeCounts, PartsJoinToTheWhole)
{
    // both exact, exact joined with rounded, and exact parts that together are too many
    for (const std::size_t n : {3000U, 6000U, 9000U, 30'000U})
        for (const std::size_t cut : {n / 2, n - 100, std::size_t{100}}) {
            std::vector<double> times = some_times(n, 0.5);
            times.insert(times.end(), times.begin(), times.begin() + 1000);
            const auto middle = times.begin() + static_cast<std::ptrdiff_t>(cut);
            const TimeCounts whole = counts_of(times), first = counts_of({times.begin(), middle}),
                             second = counts_of({middle, times.end()});
            for (TimeCounts joined : {first, second}) {
                joined.add(joined.counts() == first.counts() ? second : first);
                EXPECT_EQ(joined.exact(), whole.exact()) << n << ' ' << cut;
                EXPECT_EQ(joined.counts(), whole.counts()) << n << ' ' << cut;
            }
        }
}

/// Peak memory of a child process that takes n times [kB].
long peak_kb(std::size_t n)
{
    const pid_t child = ::fork();
    if (child == 0) {
        TimeCounts counts;
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> law(0.5, 30);
        for (std::size_t i = 0; i < n; ++i)
            counts.add(law(random));
        ::_exit(counts.total() == n ? 0 : 1);
    }
    int status = 0;
    rusage used = {};
    EXPECT_EQ(::wait4(child, &status, 0, &used), child);
    EXPECT_EQ(status, 0);
    return used.ru_maxrss;
}

TEST(TimeCounts, MemoryDoesNotGrow)
{
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer's memory is not the program's";
#endif
    const long few = peak_kb(1000), many = peak_kb(3'000'000);
    EXPECT_LT(many - few, 2000) << few << ' ' << many; // as a list they would take 24 000
}

// ---- the writer

ResultHeader tally_header(std::uint64_t total)
{
    ResultHeader header = sample_header(total);
    header.limit_states = {"collapse", "second"};
    return header;
}

/// A function of the index alone; one in 50 is invalid.
TallyEntry entry(std::uint64_t index)
{
    std::mt19937_64 random(index * 977 + 5);
    TallyEntry e;
    e.index = index;
    e.cell = index * 7 % 6;
    if (random() % 50 == 0) {
        e.invalid = random() % 2 == 0 ? InvalidReason::energy : InvalidReason::not_finite;
        return e;
    }
    e.reached = static_cast<std::uint32_t>(random() % 4);
    e.energy_residual = static_cast<double>(random() % 1000) / -1e6;
    if (e.reached & 1) {
        e.first_block = static_cast<std::int32_t>(random() % 3);
        e.collapse_time_s = static_cast<double>(random() % 100'000) / 1000;
        if (random() % 4 == 0)
            e.total_collapse_time_s = e.collapse_time_s + 1;
    }
    return e;
}

void expect_counts_by_hand(const Tally& tally, std::uint64_t total)
{
    std::map<std::uint64_t, std::uint64_t> trials, invalid;
    std::map<std::pair<std::uint64_t, int>, std::uint64_t> reached, first;
    std::vector<double> times, total_times;
    std::vector<std::uint64_t> set_aside;
    double worst = 0;
    std::uint64_t whose = 0;
    for (std::uint64_t i = total; i-- > 0;) {
        const TallyEntry e = entry(i);
        if (e.invalid != InvalidReason::none) {
            ++invalid[e.cell];
            set_aside.insert(set_aside.begin(), i);
            continue;
        }
        ++trials[e.cell];
        for (int k = 0; k < 2; ++k)
            reached[{e.cell, k}] += e.reached >> k & 1U;
        if (e.first_block >= 0)
            ++first[{e.cell, e.first_block}];
        if (e.collapse_time_s >= 0)
            times.push_back(e.collapse_time_s);
        if (e.total_collapse_time_s >= 0)
            total_times.push_back(e.total_collapse_time_s);
        if (std::abs(e.energy_residual) >= worst) {
            worst = std::abs(e.energy_residual);
            whose = i;
        }
    }
    for (std::size_t cell = 0; cell < 6; ++cell) {
        EXPECT_EQ(tally.trials[cell], trials[cell]);
        EXPECT_EQ(tally.invalid[cell], invalid[cell]);
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_EQ(tally.reached[2 * cell + k], (reached[{cell, static_cast<int>(k)}]));
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(tally.first[3 * cell + k], (first[{cell, static_cast<int>(k)}]));
    }
    EXPECT_EQ(tally.added(), total);
    EXPECT_EQ(tally.collapse_time_s.total(), times.size());
    EXPECT_NEAR(tally.collapse_time_s.median(), sorted_median(times), TimeCounts::rounding * sorted_median(times));
    EXPECT_NEAR(tally.total_collapse_time_s.median(), sorted_median(total_times),
                TimeCounts::rounding * sorted_median(total_times));
    EXPECT_EQ(std::abs(tally.energy_residual), worst);
    EXPECT_EQ(tally.energy_realization, whose);
    set_aside.resize(std::min(set_aside.size(), Tally::most_invalid));
    std::vector<std::uint64_t> known;
    for (const auto& [index, reason] : tally.first_invalid) {
        known.push_back(index);
        EXPECT_EQ(reason, entry(index).invalid);
    }
    EXPECT_EQ(known, set_aside);
}

using TallyStore = ResultStore;

void write_at_once(const fs::path& file, std::uint64_t total)
{
    const auto writer = TallyWriter::create(file, tally_header(total));
    for (std::uint64_t i = 0; i < total; ++i)
        writer->add(entry(i));
    writer->finish(sample_surface());
}

TEST_F(TallyStore, CountsAreThoseCountedByHand)
{
    for (const std::uint64_t total : {1ULL, 255ULL, 256ULL, 257ULL, 20'000ULL}) {
        fs::remove(file);
        write_at_once(file, total);
        const ResultReader reader(file);
        EXPECT_TRUE(reader.complete());
        EXPECT_EQ(reader.done(), total);
        EXPECT_FALSE(reader.has(0));
        EXPECT_TRUE(reader.rows().empty());
        ASSERT_NE(reader.tally(), nullptr);
        if (total > 1000)
            expect_counts_by_hand(*reader.tally(), total);
        EXPECT_EQ(reader.header().limit_states, tally_header(total).limit_states);
        EXPECT_EQ(reader.header().input_names, tally_header(total).input_names);
        EXPECT_EQ(reader.header().block_names, tally_header(total).block_names);
        EXPECT_EQ(bits(reader.surface().lower), bits(sample_surface().lower));
        expect_part(refusal([&] { reader.row(0); }), "has no rows");
    }
}

TEST_F(TallyStore, PartsJoinToTheSameBytes)
{
    constexpr std::uint64_t total = 20'000;
    write_at_once(file, total);
    const RunOrder order(total);
    const fs::path joined = folder / "joined.h5";
    const auto writer = TallyWriter::create(joined, tally_header(total));
    for (const std::uint64_t number : {3, 1, 5, 2, 4}) {
        const fs::path part = folder / "part.h5";
        fs::remove(part);
        ResultHeader header = tally_header(total);
        header.shard = {number, 5};
        {
            const auto one = TallyWriter::create(part, header);
            const RunOrder::Places places = order.places(header.shard);
            for (std::uint64_t place = places.end; place-- > places.begin;)
                one->add(entry(order.index(place)));
            one->flush();
        }
        const ResultReader reader(part);
        EXPECT_EQ(reader.header().shard, header.shard);
        writer->add(*reader.tally(), *reader.counted());
        const Tally before = writer->tally();
        EXPECT_THROW(writer->add(*reader.tally(), *reader.counted()), std::invalid_argument);
        EXPECT_EQ(writer->tally().trials, before.trials) << "what is there twice was added";
    }
    writer->finish(sample_surface());
    EXPECT_TRUE(contents(joined) == contents(file));
    EXPECT_THROW(Tally(6, 2, 3).add(Tally(5, 2, 3)), std::invalid_argument);
}

/// Four bundles' worth of realizations at a time, in any order among them, and again and again only the file survives.
TEST_F(TallyStore, NoOrderAndNoInterruptionChangesTheFile)
{
    const std::uint64_t total = 20'000 + 77;
    write_at_once(file, total);
    std::mt19937_64 random(4);
    const fs::path parts = folder / "parts.h5";
    std::uint64_t kept = 0;
    int interrupted = 0;
    for (bool done = false; !done;) {
        auto writer = fs::exists(parts) ? TallyWriter::resume(parts, tally_header(total))
                                        : TallyWriter::create(parts, tally_header(total));
        EXPECT_EQ(writer->tally().added(), kept);
        const std::uint64_t stop = random() % 6000;
        std::vector<std::uint64_t> lanes;
        const RunOrder order(total);
        std::uint64_t next = 0, ended = 0;
        while (!done && ended < stop) {
            for (; lanes.size() < 900 && next < total; ++next)
                if (!writer->has(order.index(next)))
                    lanes.push_back(order.index(next));
            if (lanes.empty()) {
                done = true;
                break;
            }
            const std::size_t lane = random() % lanes.size();
            writer->add(entry(lanes[lane]));
            if (random() % 10 == 0)
                writer->add(entry(lanes[lane])); // twice
            lanes.erase(lanes.begin() + static_cast<std::ptrdiff_t>(lane));
            ++ended;
        }
        if (done) {
            expect_counts_by_hand(writer->tally(), total);
            writer->finish(sample_surface());
            EXPECT_THROW(writer->add(entry(0)), std::logic_error);
        } else {
            writer->flush();
            EXPECT_EQ(writer->tally().added(), kept + ended) << "every one that has ended is counted";
            kept = writer->tally().added();
            ++interrupted;
            const ResultReader reader(parts);
            EXPECT_FALSE(reader.complete());
            EXPECT_EQ(reader.done(), kept);
            if (random() % 2 == 0) { // what came after the file was written last is lost with the process
                for (std::size_t i = 0; i < lanes.size() / 2; ++i)
                    writer->add(entry(lanes[i]));
            }
        }
    }
    EXPECT_GT(interrupted, 3);
    EXPECT_TRUE(contents(parts) == contents(file));
    EXPECT_FALSE(fs::exists(folder / "parts.h5.writing"));
}

/// A run replaces its file again and again; who opens it meanwhile gets one of them.
TEST_F(TallyStore, IsReadWhileItIsReplaced)
{
    TallyWriter::create(file, tally_header(100)).reset();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) { // HDF5 is no library for threads
        try {
            const auto writer = TallyWriter::resume(file, tally_header(100));
            while (true)
                writer->flush();
        } catch (...) {
            ::_exit(1);
        }
    }
    std::set<fs::file_time_type> times;
    while (times.size() < 200 && ::waitpid(child, nullptr, WNOHANG) == 0) {
        std::error_code replaced;
        times.insert(fs::last_write_time(file, replaced));
        EXPECT_NO_THROW(EXPECT_EQ(ResultReader(file).done(), 0U));
    }
    EXPECT_EQ(times.size(), 200U) << "its writer has ended";
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
}

/// Counts replace their file again and again: never one of somebody else.
TEST_F(TallyStore, LeavesAFileThatHasTakenItsPlace)
{
    const auto writer = TallyWriter::create(file, tally_header(20));
    for (std::uint64_t i = 0; i < 10; ++i)
        writer->add(entry(i));
    writer->flush();
    const fs::path rescued = file.string() + ".rescued";
    std::ofstream(folder / "other") << "somebody's own";
    fs::rename(folder / "other", file);
    expect_part(refusal([&] { writer->flush(); }), "another file has taken the place");
    EXPECT_EQ(contents(file), "somebody's own");
    EXPECT_EQ(ResultReader(rescued).done(), 10U);
}

TEST_F(TallyStore, AFileOfABillionIsSmall)
{
    const std::uint64_t billion = 1'000'000'000;
    const auto writer = TallyWriter::create(file, tally_header(billion));
    const RunOrder order(billion);
    for (std::uint64_t place = billion - 1000; place < billion; ++place)
        writer->add(entry(order.index(place)));
    for (std::uint64_t place = 0; place < 5000; ++place)
        writer->add(entry(order.index(place)));
    writer->flush();
    EXPECT_LT(fs::file_size(file), 200'000U);
    EXPECT_TRUE(writer->has(order.index(4999)));
    EXPECT_FALSE(writer->has(order.index(5000)));
    EXPECT_FALSE(writer->has(order.index(billion / 2)));
    EXPECT_TRUE(writer->has(order.index(billion - 1)));
    EXPECT_EQ(ResultReader(file).done(), 6000U);
    EXPECT_THROW(writer->finish(sample_surface()), std::logic_error);
    TallyEntry wrong = entry(7000);
    wrong.index = billion;
    EXPECT_THROW(writer->add(wrong), std::invalid_argument);
    wrong = entry(7000);
    wrong.cell = 6;
    EXPECT_THROW(writer->add(wrong), std::invalid_argument);
}

TEST_F(TallyStore, AnotherStudyIsRefusedAndNothingChanges)
{
    {
        const auto writer = TallyWriter::create(file, tally_header(1000));
        for (std::uint64_t i = 0; i < 600; ++i)
            writer->add(entry(i));
        writer->flush();
        expect_part(refusal([&] { TallyWriter::resume(file, tally_header(1000)); }), "is being written by another run");
    }
    const std::string before = contents(file);
    ResultHeader other = tally_header(1000);
    other.limit_states = {"collapse", "third"};
    expect_part(refusal([&] { TallyWriter::resume(file, other); }), "counts other limit states");
    expect_part(refusal([&] { TallyWriter::resume(file, tally_header(2000)); }), "1000 realizations instead of 2000");
    expect_part(refusal([&] { ResultWriter::resume(file, sample_header(1000)); }), "keeps no rows");
    expect_part(refusal([&] { TallyWriter::create(file, tally_header(1000)); }), "exists already");
    other = tally_header(1000);
    other.code_version = "9";
    expect_part(refusal([&] { TallyWriter::resume(file, other); }), "was begun by version");
    EXPECT_TRUE(contents(file) == before);

    const fs::path rows = folder / "rows.h5";
    ResultWriter::create(rows, sample_header(1000));
    expect_part(refusal([&] { TallyWriter::resume(rows, tally_header(1000)); }), "keeps a row of each");

    {
        const auto writer = TallyWriter::resume(file, tally_header(1000));
        for (std::uint64_t i = 0; i < 1000; ++i)
            writer->add(entry(i));
        writer->finish(sample_surface());
    }
    expect_part(refusal([&] { TallyWriter::resume(file, tally_header(1000)); }), "is already complete");
    EXPECT_THROW(TallyWriter::create(folder / "x.h5", sample_header(10)), std::invalid_argument);
}

TEST_F(TallyStore, EveryDamagedByteIsNoticed)
{
    write_at_once(file, 3000);
    const std::string whole = contents(file);
    std::mt19937_64 random(11);
    const fs::path copy = folder / "copy.h5";
    for (int i = 0; i < 400; ++i) {
        std::string bytes = whole;
        bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
        put(copy, bytes);
        EXPECT_THROW(ResultReader{copy}, InputError) << i;
    }
    for (int i = 0; i < 50; ++i) {
        put(copy, whole.substr(0, random() % whole.size()));
        EXPECT_THROW(ResultReader{copy}, InputError) << i;
    }
    put(copy, whole + "x");
    EXPECT_THROW(ResultReader{copy}, InputError);
}

} // namespace
} // namespace stylobate
