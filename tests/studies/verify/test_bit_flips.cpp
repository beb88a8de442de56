/// A flipped bit in any byte of a results file is noticed: the file is refused with one message, or `verify-file` finds
/// a difference. Nothing crashes, hangs, or reports other numbers.

#include "studies/verify/verification.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "kernels/isa.hpp"
#include "tests/studies/verify/results_made.hpp"

#include <span>

namespace stylobate {
namespace {

/// What became of the flips, one for each byte that was tried.
struct Flips {
    std::size_t refused = 0; ///< with one message
    std::size_t found = 0;   ///< by `verify-file`
    std::size_t said = 0;    ///< the report names bytes that were not read
    std::size_t without_effect = 0;
    std::size_t all() const { return refused + found + said + without_effect; }
};

/// What is reported of a file, all its rows among it.
std::string report_of(const std::string& file, bool& well)
{
    VerifyOptions options;
    options.replay = 0;
    options.run = {best_isa(), 1};
    Observer patient;
    const FileVerification v = verify_file(file, options, patient);
    well = v.well();
    std::string report = text_of(v);
    const ResultReader reader(file);
    reader.for_each_row([&](const ResultRow& row) {
        report += fmt::format("{} {} {} {}\n", row.index, row.outcome.collapse_time_s, row.outcome.energy_residual,
                              fmt::join(row.inputs, " "));
    });
    return report;
}

class BitFlips : public MadeResults {
protected:
    /// Flips one bit in every `stride`-th byte, another one each time.
    Flips flip(std::size_t stride) const
    {
        bool well = false;
        const std::string right = report_of(file, well);
        EXPECT_TRUE(well) << right;
        const std::string bytes = bytes_of(file);
        FileHandle handle = FileHandle::open(file, true);
        const auto put = [&](std::size_t at, char value) { handle.write(at, std::as_bytes(std::span(&value, 1))); };
        Flips flips;
        for (std::size_t at = stride / 2; at < bytes.size(); at += stride) {
            put(at, static_cast<char>(bytes[at] ^ (1 << (at / stride % 8))));
            try {
                const std::string report = report_of(file, well);
                if (!well)
                    ++flips.found;
                else if (report.find("the beginning of a record") != std::string::npos)
                    ++flips.said;
                else if (report == right)
                    ++flips.without_effect;
                else
                    ADD_FAILURE() << "byte " << at << " is not noticed:\n" << report;
            } catch (const InputError& error) {
                ++flips.refused;
                EXPECT_TRUE(std::string(error.what()).starts_with(file + ": ")) << error.what();
            }
            put(at, bytes[at]);
        }
        EXPECT_EQ(flips.all(), (bytes.size() - stride / 2 + stride - 1) / stride);
        EXPECT_TRUE(bytes_of(file) == bytes);
        fmt::print("{} flips: {} refused, {} found by verify-file, {} named in its text, {} without effect\n",
                   flips.all(), flips.refused, flips.found, flips.said, flips.without_effect);
        return flips;
    }

    /// A complete file refuses all of them.
    void expect_all_refused(std::size_t stride) const
    {
        const Flips flips = flip(stride);
        EXPECT_EQ(flips.refused, flips.all());
    }

    void make_rows() const { make_results(ready_study("small_scale_column", two_cells(3)), file); }
    void make_counts() const
    {
        make_results(ready_study("small_scale_column", two_cells(3, {"output.realizations=\"none\""})), file);
    }
    void make_moving() const { make_results(ready_study("free_rocking", {"output.trajectory_rate_hz=10"}), file); }
    /// @returns where the records begin
    std::size_t make_unfinished() const
    {
        const LoadedStudy loaded = ready_study("small_scale_column", two_cells(12));
        std::size_t begin = 0;
        {
            const auto writer = ResultWriter::create((folder / "begun.h5").string(), loaded.result_header());
            begin = fs::file_size(folder / "begun.h5");
        }
        make_results(loaded, file, {1, 2});
        return begin;
    }
    /// What is behind the beginning of an unfinished file has a checksum for each record.
    void expect_unfinished_noticed(std::size_t stride) const
    {
        const std::size_t begin = make_unfinished(), size = fs::file_size(file);
        const Flips flips = flip(stride);
        EXPECT_GE(flips.found, (size - begin) / stride - (size - begin) / stride / 20) << "in records";
        EXPECT_GE(flips.refused, (begin - 512) / stride * 9 / 10) << "in what is before them";
        EXPECT_EQ(flips.without_effect, 0U);
    }
};

constexpr std::size_t sampled = 211; // every so many bytes, a prime: no multiple of a row

TEST_F(BitFlips, InRowsAreRefused)
{
    make_rows();
    expect_all_refused(sampled);
}

TEST_F(BitFlips, InCountsAreRefused)
{
    make_counts();
    expect_all_refused(sampled);
}

TEST_F(BitFlips, InTrajectoriesAreRefused)
{
    make_moving();
    expect_all_refused(sampled);
}

TEST_F(BitFlips, InAnUnfinishedFileAreNoticed)
{
    expect_unfinished_noticed(sampled);
}

TEST_F(BitFlips, OfEveryByteAreRefusedLong)
{
    make_rows();
    expect_all_refused(1);
    fs::remove(file);
    make_counts();
    expect_all_refused(1);
    fs::remove(file);
    make_moving();
    expect_all_refused(1);
}

TEST_F(BitFlips, OfEveryByteOfAnUnfinishedFileAreNoticedLong)
{
    expect_unfinished_noticed(1);
}

} // namespace
} // namespace stylobate
