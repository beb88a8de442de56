/// Results of an adaptive surface: rows in any order, some of the study's; in a finished file in index order.

#include "tests/io/store/result_samples.hpp"

#include <algorithm>
#include <numeric>

namespace stylobate {
namespace {

class AdaptiveStore : public ResultStore {
protected:
    /// 6 cells of 1000 indices each; room for 900 rows.
    static ResultHeader header()
    {
        ResultHeader selected = sample_header(900);
        selected.selected = true;
        return selected;
    }
    /// 700 indices in an order of their own.
    static std::vector<std::uint64_t> indices(unsigned seed)
    {
        std::vector<std::uint64_t> all(6000);
        std::iota(all.begin(), all.end(), 0);
        std::shuffle(all.begin(), all.end(), std::mt19937_64(17));
        all.resize(700);
        std::shuffle(all.begin(), all.end(), std::mt19937_64(seed));
        return all;
    }
    static SurfaceTable table()
    {
        SurfaceTable t;
        t.frequency_hz = header().frequency_hz;
        t.pga_m_s2 = header().pga_m_s2;
        t.trials = {8, 90, 100, 8, 16, 478};
        t.collapses = {0, 45, 50, 8, 1, 3};
        t.probability = {0.01, 0.5, 0.5, 0.99, 0.05, 0.007};
        t.lower = {0, 0.4, 0.4, 0.9, 0.01, 0.002};
        t.upper = {0.1, 0.6, 0.6, 1, 0.1, 0.01};
        t.interval = "adaptive 0.95";
        t.method = {IntervalMethod::surface, IntervalMethod::own,     IntervalMethod::own,
                    IntervalMethod::surface, IntervalMethod::surface, IntervalMethod::own};
        t.half_width = 0.1;
        t.rounds = 12;
        return t;
    }
    static std::string bytes(const fs::path& path)
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

TEST_F(AdaptiveStore, AFinishedFileHasItsRowsInIndexOrderWhateverTheOrderTheyCameIn)
{
    std::vector<std::string> files;
    for (const unsigned seed : {1U, 2U}) {
        const fs::path path = folder / (std::to_string(seed) + ".h5");
        {
            const auto writer = ResultWriter::create(path, header());
            for (const std::uint64_t index : indices(seed)) {
                writer->add(sample_row(index));
                if (index % 3 == 0)
                    writer->add(sample_row(index)); // once more: changes nothing
            }
            const SurfaceTable surface = table();
            writer->finish(&surface);
        }
        files.push_back(bytes(path));
    }
    EXPECT_TRUE(files[0] == files[1]);

    const ResultReader reader(folder / "1.h5");
    EXPECT_TRUE(reader.complete());
    EXPECT_TRUE(reader.header().selected);
    EXPECT_EQ(reader.header().total, 700U);
    std::vector<std::uint64_t> sorted = indices(1);
    std::sort(sorted.begin(), sorted.end());
    const std::vector<ResultRow> rows = reader.rows();
    ASSERT_EQ(rows.size(), sorted.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].index, sorted[i]);
        EXPECT_TRUE(same_bits(rows[i], sample_row(sorted[i])));
        EXPECT_TRUE(same_bits(reader.row(sorted[i]), rows[i]));
    }
    for (std::uint64_t index = 0; index < 6100; ++index)
        EXPECT_EQ(reader.has(index), std::binary_search(sorted.begin(), sorted.end(), index)) << index;
    const auto absent = static_cast<std::uint64_t>(
        std::adjacent_find(sorted.begin(), sorted.end(), [](auto a, auto b) { return b > a + 1; }) - sorted.begin());
    try {
        reader.row(sorted[absent] + 1);
        FAIL() << "a row that is not there was read";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("does not hold realization"), std::string::npos) << error.what();
    }
    const SurfaceTable read = reader.surface();
    const SurfaceTable want = table();
    EXPECT_EQ(read.method, want.method);
    EXPECT_EQ(read.trials, want.trials);
    EXPECT_EQ(read.lower, want.lower);
    EXPECT_EQ(read.half_width, want.half_width);
    EXPECT_EQ(read.rounds, want.rounds);
}

TEST_F(AdaptiveStore, AnUnfinishedFileContinuesToTheSameBytes)
{
    const SurfaceTable surface = table();
    const fs::path whole = folder / "whole.h5";
    {
        const auto writer = ResultWriter::create(whole, header());
        for (const std::uint64_t index : indices(1))
            writer->add(sample_row(index));
        writer->finish(&surface);
    }
    {
        const auto writer = ResultWriter::create(file, header());
        const std::vector<std::uint64_t> some = indices(3);
        for (std::size_t i = 0; i < 300; ++i)
            writer->add(sample_row(some[i]));
        EXPECT_EQ(writer->rows(), 300U);
    } // as a killed process leaves it
    {
        const ResultReader reader(file);
        EXPECT_FALSE(reader.complete());
        const std::vector<ResultRow> rows = reader.rows();
        ASSERT_EQ(rows.size(), 300U);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_TRUE(same_bits(rows[i], sample_row(rows[i].index)));
            EXPECT_TRUE(i == 0 || rows[i - 1].index < rows[i].index);
        }
    }
    {
        const auto writer = ResultWriter::resume(file, header());
        EXPECT_EQ(writer->rows(), 300U);
        for (const std::uint64_t index : indices(4)) {
            writer->add(sample_row(index));
            EXPECT_TRUE(writer->has(index) && ResultReader(file).has(index));
            if (writer->rows() == 310)
                break;
        }
    }
    const auto writer = ResultWriter::resume(file, header());
    EXPECT_EQ(writer->rows(), 310U);
    for (const std::uint64_t index : indices(5))
        writer->add(sample_row(index));
    writer->finish(&surface);
    EXPECT_TRUE(bytes(whole) == bytes(file));
}

TEST_F(AdaptiveStore, RefusesAnotherStudysFileAFinishedOneAndMoreRowsThanItsRoom)
{
    const auto refusal = [&](const ResultHeader& asked) {
        try {
            ResultWriter::resume(file, asked);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no refusal");
    };
    {
        const auto writer = ResultWriter::create(file, header());
        for (std::uint64_t index = 0; index < 900; ++index)
            writer->add(sample_row(6 * index));
        EXPECT_THROW(writer->add(sample_row(1)), std::invalid_argument);
    }
    EXPECT_NE(refusal(sample_header(900)).find("another study"), std::string::npos) << refusal(sample_header(900));
    {
        const auto writer = ResultWriter::resume(file, header());
        const SurfaceTable surface = table();
        for (std::uint64_t index = 0; index < 900; ++index)
            writer->add(sample_row(6 * index));
        writer->finish(&surface);
        EXPECT_THROW(writer->add(sample_row(1)), std::logic_error);
    }
    EXPECT_NE(refusal(header()).find("is already complete"), std::string::npos) << refusal(header());
}

} // namespace
} // namespace stylobate
