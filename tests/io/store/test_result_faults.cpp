/// Faults around the result store: nothing lost to a kill, every damage noticed, nothing changed by a refusal.

#include "io/store/result_file.hpp"
#include "io/store/result_seal.hpp"
#include "tests/io/store/result_samples.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <hdf5.h>
#include <map>
#include <numeric>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>

namespace stylobate {
namespace {

/// Says to the parent that one more step is done.
using Mark = std::function<void()>;

/// Runs `work` in a process of its own, and kills it the given time after its `marks`-th mark (0: after its start).
void run_and_kill(std::uint64_t marks, std::chrono::microseconds after, const std::function<void(const Mark&)>& work)
{
    int pipe[2] = {};
    ASSERT_EQ(::pipe(pipe), 0);
    // 4 bytes a mark in the smallest pipe there is: the child is never more than 1024 marks ahead
    ::fcntl(pipe[1], F_SETPIPE_SZ, 4096);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        try {
            work([&] {
                if (::write(pipe[1], "mark", 4) != 4)
                    ::_exit(7);
            });
        } catch (...) {
            ::_exit(7);
        }
        ::_exit(0);
    }
    ::close(pipe[1]);
    char mark[4] = {};
    for (std::uint64_t i = 0; i < marks && ::read(pipe[0], mark, 4) == 4; ++i)
        ;
    std::this_thread::sleep_for(after);
    ::kill(child, SIGKILL);
    ::close(pipe[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << "the child failed";
}

std::unique_ptr<ResultWriter> create_or_resume(const fs::path& file, std::uint64_t total)
{
    return fs::exists(file) ? ResultWriter::resume(file, sample_header(total))
                            : ResultWriter::create(file, sample_header(total));
}

TEST_F(ResultStore, SurvivesBeingKilledWhileRowsAreWritten)
{
    const std::uint64_t chunks = 40;
    const std::uint64_t total = chunks * chunk;
    std::mt19937_64 random(11);
    std::vector<std::uint64_t> order(total);
    std::iota(order.begin(), order.end(), 0);
    for (std::uint64_t c = 0; c < chunks; c += 3) // neighbouring chunks interleaved, as lanes finish out of order
        std::shuffle(order.begin() + static_cast<std::ptrdiff_t>(c * chunk),
                     order.begin() + static_cast<std::ptrdiff_t>(std::min(total, (c + 3) * chunk)), random);
    std::vector<ResultRow> rows;
    for (std::uint64_t i = 0; i < total; ++i)
        rows.push_back(sample_row(i));

    int partly = 0;
    for (int repeat = 0; repeat < 20; ++repeat) {
        fs::remove(file);
        for (int kill = 0; kill < 3; ++kill) {
            // the first kills of some repeats strike while the file is created, the others while rows are written
            const std::uint64_t marks = kill == 0 && repeat % 3 == 0 ? 0 : 1 + random() % (total / 2);
            run_and_kill(marks, std::chrono::microseconds(random() % 500), [&](const Mark& mark) {
                const auto writer = create_or_resume(file, total);
                for (const std::uint64_t i : order)
                    if (!writer->has(i)) {
                        writer->add(rows[i]);
                        mark();
                    }
            });
            if (!fs::exists(file))
                continue; // killed before there was one
            const auto writer = ResultWriter::resume(file, sample_header(total));
            partly += writer->rows() > 0 && writer->rows() < total;
            const ResultReader reader(file);
            for (std::uint64_t i = 0; i < total; ++i) {
                ASSERT_EQ(writer->has(i), reader.has(i));
                if (writer->has(i)) {
                    ASSERT_EQ(bits(reader.row(i)), bits(rows[i])) << "claimed, but wrong";
                }
            }
        }
    }
    EXPECT_GT(partly, 10) << "the kills must strike in the middle to show anything";
    const auto writer = create_or_resume(file, total);
    for (const ResultRow& row : rows)
        writer->add(row);
    writer->finish(nullptr);
    EXPECT_EQ(ResultReader(file).rows().size(), total);
}

TEST_F(ResultStore, SurvivesBeingKilledWhileItIsFinished)
{
    const std::uint64_t total = 20 * chunk;
    const fs::path unfinished = folder / "unfinished.h5";
    {
        const auto writer = ResultWriter::create(unfinished, sample_header(total));
        add_rows(*writer, 0, total);
    }
    const Trajectory trajectory = sample_trajectory(1, 20000);
    const SurfaceTable table = sample_surface();
    const auto finish = [&](const Mark& mark) {
        const auto writer = ResultWriter::resume(file, sample_header(total));
        writer->add(trajectory);
        mark();
        writer->finish(&table);
    };
    fs::copy_file(unfinished, file);
    std::chrono::steady_clock::time_point begin;
    finish([&] { begin = std::chrono::steady_clock::now(); });
    const auto needed = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);

    int complete = 0;
    for (int repeat = 0; repeat < 20; ++repeat) {
        fs::copy_file(unfinished, file, fs::copy_options::overwrite_existing);
        run_and_kill(1, repeat * needed / 15, finish);
        if (ResultReader(file).complete()) {
            ++complete;
        } else {
            const auto writer = ResultWriter::resume(file, sample_header(total));
            ASSERT_EQ(writer->rows(), total);
            writer->add(trajectory);
            writer->finish(&table);
        }
        const ResultReader reader(file);
        ASSERT_EQ(reader.rows().size(), total);
        ASSERT_EQ(bits(reader.trajectory(1)["x_m"]), bits(trajectory["x_m"]));
        ASSERT_EQ(reader.surface().trials, table.trials);
    }
    EXPECT_LT(complete, 20) << "the kills must strike in the middle to show anything";
}

/// Rows that something else has cut off are not taken for rows: what comes behind them would stand in a gap of zeros.
TEST_F(ResultStore, NoticesThatItWasCutUnderTheRun)
{
    auto writer = ResultWriter::create(file, sample_header(40));
    const auto empty = fs::file_size(file);
    add_rows(*writer, 0, 30);
    fs::resize_file(file, empty + (fs::file_size(file) - empty) / 2);
    add_rows(*writer, 30, 40);
    expect_part(refusal([&] { writer->finish(nullptr); }), "was changed by something else");
    writer.reset();
    EXPECT_FALSE(fs::exists(file.string() + ".finishing"));
    writer = ResultWriter::resume(file, sample_header(40));
    EXPECT_GT(writer->rows(), 0U);
    EXPECT_LT(writer->rows(), 16U) << "what was cut off is not there";
    add_rows(*writer, 0, 40);
    writer->finish(nullptr);
    EXPECT_EQ(ResultReader(file).rows().size(), 40U);
}

/// A file of somebody else at the path of the results is not written over.
TEST_F(ResultStore, LeavesAFileThatHasTakenItsPlace)
{
    const auto writer = ResultWriter::create(file, sample_header(20));
    add_rows(*writer, 0, 20);
    const fs::path rescued = file.string() + ".rescued";
    std::ofstream(rescued.string() + ".other") << "somebody's own";
    fs::rename(rescued.string() + ".other", file);
    expect_part(refusal([&] { writer->finish(nullptr); }), "another file has taken the place");
    EXPECT_EQ(contents(file), "somebody's own");
    EXPECT_EQ(ResultReader(rescued).rows().size(), 20U);
    fs::remove(rescued);
}

TEST_F(ResultStore, HasOneWriterAtATime)
{
    auto writer = ResultWriter::create(file, sample_header(10));
    const std::string text = refusal([&] { ResultWriter::resume(file, sample_header(10)); });
    expect_part(text, "is being written by another run");
    const pid_t child = ::fork();
    if (child == 0) {
        (void)writer.release(); // as a process of its own, which only knows the name
        try {
            ResultWriter::resume(file, sample_header(10));
        } catch (const InputError&) {
            ::_exit(0);
        }
        ::_exit(1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);

    add_rows(*writer, 0, 10);
    EXPECT_EQ(ResultReader(file).rows().size(), 10U) << "reading is free meanwhile";
    writer->finish(nullptr);
    expect_part(refusal([&] { ResultWriter::resume(file, sample_header(10)); }), "another run");
    writer.reset();
    expect_part(refusal([&] { ResultWriter::resume(file, sample_header(10)); }), "already complete");
}

struct Snapshot {
    explicit Snapshot(const fs::path& folder)
    {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            struct stat status = {};
            ::stat(entry.path().c_str(), &status);
            files[entry.path()] = {entry.is_regular_file() ? contents(entry.path()) : "", status.st_mtim.tv_sec,
                                   status.st_mtim.tv_nsec, status.st_ino};
        }
    }
    bool operator==(const Snapshot&) const = default;
    std::map<fs::path, std::tuple<std::string, long, long, ino_t>> files;
};

/// The file with another version in its seal, which is whole: as an earlier version of the program sealed it.
std::string as_version_1(std::string bytes)
{
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    const auto set = [&](std::size_t at, std::uint32_t value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
    EXPECT_EQ(number(16), 5U);
    set(16, 1);
    const std::size_t end = number(20) - 4;
    set(end, crc32_of(std::as_bytes(std::span(bytes)).first(end)));
    return bytes;
}

TEST_F(ResultStore, RefusesAndChangesNothing)
{
    const fs::path complete = folder / "complete.h5";
    write_complete(complete, 300);
    {
        const auto writer = ResultWriter::create(file, sample_header(300));
        add_rows(*writer, 0, chunk);
    }
    const fs::path foreign = folder / "foreign.h5";
    const hid_t made = H5Fcreate(foreign.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(made);
    const fs::path text = folder / "text.h5";
    put(text, "[study]\nkind = \"surface\"\n" + std::string(2000, '#'));
    const fs::path empty = folder / "empty.h5";
    put(empty, "");
    const fs::path cut = folder / "cut.h5";
    put(cut, contents(complete).substr(0, contents(complete).size() - 1));
    const fs::path longer = folder / "longer.h5";
    put(longer, contents(complete) + "x");
    const fs::path old = folder / "old.h5";
    put(old, as_version_1(contents(file)));
    const fs::path pipe = folder / "pipe.h5";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    fs::create_directory(folder / "folder.h5");
    const Snapshot before(folder);

    const auto resume = [&](const fs::path& path, const std::function<void(ResultHeader&)>& change = nullptr) {
        ResultHeader header = sample_header(300);
        if (change)
            change(header);
        return refusal([&] { ResultWriter::resume(path, header); });
    };
    const auto both = [&](const fs::path& path, const std::string& part) {
        for (const std::string& message : {resume(path), refusal([&] { ResultReader reader(path); })}) {
            expect_part(message, path.string() + ": ");
            expect_part(message, part);
        }
    };
    both(folder / "missing.h5", "there is no such file");
    both(folder / "none" / "missing.h5", "there is no such file");
    both(text / "missing.h5", "Not a directory");
    both(folder / "folder.h5", "is a folder");
    both(pipe, "is not a regular file");
    both(foreign, "is an HDF5 file, but not a results file");
    both(text, "is not a results file of stylobate");
    both(empty, "is empty");
    both(cut, "is truncated");
    both(longer, "is damaged");
    both(old, "is of format version 1; this program reads versions 5 and 6. Read it with the version that wrote it, or "
              "run its "
              "study again into another file.");

    std::string message =
        resume(file, [](ResultHeader& h) { h.study_toml.replace(h.study_toml.find("0.68"), 4, "0.7"); });
    expect_part(message, "another study");
    expect_part(message, "line 6 of the study");
    expect_part(message, "friction = 0.68 #");
    expect_part(message, "friction = 0.7 #");
    message = resume(file, [](ResultHeader& h) { h.study_toml += "[more]\n"; });
    expect_part(message, "line 7");
    expect_part(message, "(the end of the text)");
    expect_part(message, "[more]");
    expect_part(resume(file, [](ResultHeader& h) { h.study_toml.pop_back(); }), "ends differently");
    message = resume(file, [](ResultHeader& h) { h.code_version = "0.2.0"; });
    expect_part(message, "0.1.0+abc");
    expect_part(message, "0.2.0");
    expect_part(resume(file, [](ResultHeader& h) { h.kind = "single"; }), "'surface' instead of 'single'");
    expect_part(resume(file, [](ResultHeader& h) { h.seed = 8; }), "instead of 8");
    expect_part(resume(file, [](ResultHeader& h) { h.total = 301; }), "300 realizations instead of 301");
    expect_part(resume(file, [](ResultHeader& h) { h.first = 5; }), "begins with realization 0 instead of 5");
    expect_part(resume(file, [](ResultHeader& h) { h.input_names.pop_back(); }), "inputs");
    expect_part(resume(file, [](ResultHeader& h) { h.block_names[2] = "epistyle 1"; }), "blocks have other names");
    expect_part(resume(file, [](ResultHeader& h) { h.block_names.pop_back(); }), "blocks have other names");
    expect_part(resume(file, [](ResultHeader& h) { h.frequency_hz[1] = 3; }), "axes");
    expect_part(resume(complete), "already complete");

    const auto create = [&](const fs::path& path) {
        return refusal([&] { ResultWriter::create(path, sample_header(300)); });
    };
    expect_part(create(file), "exists already");
    expect_part(create(folder / "folder.h5"), "exists already");
    expect_part(create(folder / "none" / "new.h5"), "there is no such folder");
    expect_part(create(text / "new.h5"), "is not a folder");
    expect_part(create("/proc/new.h5"), "cannot be written");
    EXPECT_TRUE(before == Snapshot(folder)) << "a refusal has changed a file";

    const auto writer = ResultWriter::resume(file, sample_header(300));
    EXPECT_EQ(writer->rows(), chunk) << "after all this the file still goes on";
}

TEST_F(ResultStore, RefusesFoldersWithoutPermission)
{
    if (::geteuid() == 0)
        GTEST_SKIP() << "the superuser may write everywhere";
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    const std::string message = refusal([&] { ResultWriter::create(file, sample_header(1)); });
    fs::permissions(folder, fs::perms::owner_all);
    expect_part(message, "cannot be written: Permission denied");
}

TEST_F(ResultStore, TakesOverWhatADeadProcessLeft)
{
    put(folder / "results.h5.creating", "half a file");
    put(folder / "results.h5.finishing", "half a file");
    write_complete(file, 3);
    EXPECT_EQ(ResultReader(file).rows().size(), 3U);
    EXPECT_FALSE(fs::exists(folder / "results.h5.creating"));
    EXPECT_FALSE(fs::exists(folder / "results.h5.finishing"));
}

/// What damage does to a complete file: an InputError, or the content that was written.
void expect_noticed(const fs::path& file, const std::string& damaged, const std::string& want, const std::string& what)
{
    put(file, damaged);
    try {
        const ResultReader reader(file);
        EXPECT_TRUE(everything(reader) == want) << what;
    } catch (const InputError&) {
    }
}

TEST_F(ResultStore, NoticesEveryFlippedByteAndTruncation)
{
    write_complete(file, 20);
    const std::string good = contents(file);
    const std::string want = everything(ResultReader(file));
    std::mt19937_64 random(1);
    int refused = 0;
    for (std::size_t at = 0; at < good.size(); at += at < 1024 ? 4 : 1 + random() % 120) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1U << (random() % 8)));
        put(file, bad);
        try {
            const ResultReader reader(file);
            ADD_FAILURE() << "byte " << at;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 500);
    for (int i = 0; i < 100; ++i) {
        const std::size_t length = i < 20 ? static_cast<std::size_t>(i) * 40 : random() % good.size();
        expect_noticed(file, good.substr(0, length), want, "cut at " + std::to_string(length));
        std::string bad = good; // a part of the file overwritten, with zeros, noise, or another part
        const std::size_t from = random() % good.size();
        const std::size_t size = std::min<std::size_t>(1 + random() % 700, good.size() - from);
        for (std::size_t k = 0; k < size; ++k)
            bad[from + k] = i % 3 == 0   ? '\0'
                            : i % 3 == 1 ? static_cast<char>(random())
                                         : good[(from + k + 512) % good.size()];
        expect_noticed(file, bad, want, "overwritten from " + std::to_string(from));
    }
}

/// What is cut off, as by a kill or a full disk, or is damaged: what comes before it is there, and nothing else.
TEST_F(ResultStore, ATornEndOfAnUnfinishedFileIsNotThere)
{
    const std::uint64_t total = 60;
    std::size_t beginning = 0;
    {
        const auto writer = ResultWriter::create(file, sample_header(total));
        beginning = fs::file_size(file);
        add_rows(*writer, 7, 40);
    }
    const std::string good = contents(file);
    const std::size_t record = (good.size() - beginning) / 33;
    EXPECT_EQ(beginning + 33 * record, good.size());
    std::mt19937_64 random(2);
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string bad = good;
        const std::size_t at = i % 4 == 0 ? random() % beginning : beginning + random() % (good.size() - beginning);
        if (i % 2 == 0)
            bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1U << (random() % 8)));
        else
            bad.resize(at);
        put(file, bad);
        try {
            const auto writer = ResultWriter::resume(file, sample_header(total));
            const ResultReader reader(file);
            EXPECT_GE(at, beginning);
            EXPECT_EQ(writer->rows(), (at - beginning) / record) << "all before the damage, none behind it";
            EXPECT_EQ(reader.rows().size(), writer->rows());
            for (const ResultRow& row : reader.rows())
                ASSERT_EQ(bits(row), bits(sample_row(row.index))) << "byte " << at;
            ASSERT_EQ(contents(file), bad) << "looking changed the file";
            if (i % 10 == 1) { // and it goes on from there
                add_rows(*writer, 0, total);
                writer->finish(nullptr);
                EXPECT_EQ(ResultReader(file).rows().size(), total);
            }
        } catch (const InputError&) {
            EXPECT_LT(at, beginning);
            ++refused;
        }
    }
    EXPECT_GT(refused, 50);
}

/// A run that goes on behind a damaged record must not find the whole ones that lay behind it again: another order of
/// the realizations would have two rows of one.
/// A damaged number of realizations must not become as many places.
TEST_F(ResultStore, RowsThatAreOnlyAnnouncedTakeNoMemory)
{
    constexpr std::uint64_t many = std::uint64_t{1} << 60;
    RowNumbers numbers(sample_header(many), false);
    EXPECT_TRUE(numbers.add(many - 1, 7));
    EXPECT_TRUE(numbers.add(0, 9));
    EXPECT_FALSE(numbers.add(0, 8));
    EXPECT_EQ(numbers.of(many - 1), 7u);
    EXPECT_EQ(numbers.of(1), std::nullopt);
    EXPECT_EQ(numbers.of(many), std::nullopt);
    EXPECT_EQ(numbers.added(), 2u);
}

/// From the first way to find a row to the second one.
TEST_F(ResultStore, RowsAreFoundWhileTheyBecomeMany)
{
    constexpr std::uint64_t total = 1 << 14;
    const auto writer = ResultWriter::create(file, sample_header(total));
    for (std::uint64_t i = 0; i < total / 16; ++i) {
        writer->add(sample_row(5 * i % total));
        ASSERT_TRUE(writer->has(5 * (i / 2) % total)) << i;
    }
    std::uint64_t rows = 0, last = 0;
    writer->for_each_row([&](const ResultRow& row) {
        EXPECT_EQ(row.index % 5, 0u);
        EXPECT_EQ(row.index, 5 * rows);
        last = row.index;
        ++rows;
    });
    EXPECT_EQ(rows, total / 16);
    EXPECT_EQ(last, 5 * (total / 16 - 1));
}

TEST_F(ResultStore, RowsBehindADamagedOneDoNotComeBack)
{
    const std::uint64_t total = 20;
    std::size_t beginning = 0;
    {
        const auto writer = ResultWriter::create(file, sample_header(total));
        beginning = fs::file_size(file);
        add_rows(*writer, 0, 10);
    }
    std::string bytes = contents(file);
    const std::size_t record = (bytes.size() - beginning) / 10;
    EXPECT_EQ(ResultReader(file).unread().bytes, 0U);

    put(file, bytes.substr(0, bytes.size() - 3)); // a kill
    EXPECT_EQ(ResultReader(file).unread().bytes, record - 3);
    EXPECT_FALSE(ResultReader(file).unread().damaged);

    bytes[beginning + 4 * record + 40] ^= 1;
    put(file, bytes);
    EXPECT_EQ(ResultReader(file).rows().size(), 4U);
    EXPECT_EQ(ResultReader(file).unread().bytes, 6 * record);
    EXPECT_TRUE(ResultReader(file).unread().damaged);
    {
        const auto writer = ResultWriter::resume(file, sample_header(total));
        writer->add(sample_row(9)); // as long as the damaged one; the old row 9 lies behind it
    }
    const ResultReader reader(file);
    EXPECT_EQ(reader.rows().size(), 5U);
    EXPECT_EQ(reader.unread().bytes, 0U);
    EXPECT_EQ(bits(reader.row(9)), bits(sample_row(9)));
}

} // namespace
} // namespace stylobate
