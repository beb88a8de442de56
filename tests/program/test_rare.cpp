/// A study of rare events as its user runs it: against plain counts, the same bytes whatever the threads and
/// interruptions, refusals.

#include "tests/program/program.hpp"

#include "ensemble/numerics/interval.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/kind_tables.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {
namespace {

const std::string rare_study = STYLOBATE_SOURCE_DIR "/studies/inputs/rare_collapse.toml";

class RareStatistics : public Program {
protected:
    Ended study(const std::vector<std::string>& settings, const std::string& results, const char* threads = "2",
                const std::string& simd = "auto") const
    {
        return run(run_words(rare_study, settings, {"-o", results, "--threads", threads, "--simd", simd, "--json"}));
    }

    /// Collapses of so many plain draws at a PGA: the cell of a surface.
    std::uint64_t plain(double pga, std::uint64_t realizations) const
    {
        const std::string axis = fmt::format("surface.pga_m_s2={{from={0},to={0},count=1}}", pga);
        std::string text = read_bytes(rare_study);
        const auto without = [&](const std::string& from, const std::string& to) {
            const std::size_t begin = text.find(from);
            text.replace(begin, text.find(to, begin) - begin, "");
        };
        without("[rare]", "[structure]");
        without("frequency_hz", "[perturbation]");
        text.replace(text.find("kind = \"rare\""), 13, "kind = \"surface\"");
        write_bytes(folder / "plain.toml", text);
        const Ended ended = run(run_words("plain.toml",
                                          {"surface.frequency_hz={from=5.0,to=5.0,count=1}", axis, "study.seed=77",
                                           fmt::format("study.realizations={}", realizations)},
                                          {"-o", "plain.h5", "--quiet"}));
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const std::uint64_t collapses = ResultReader(folder / "plain.h5").surface().collapses.at(0);
        fs::remove(folder / "plain.h5");
        return collapses;
    }

    /// The intervals of both agree: at 99.9 % of each, which both miss once in a thousand.
    void expect_agreement(double pga, std::uint64_t realizations) const
    {
        const JsonValue found = json_of(study({fmt::format("excitation.pga_m_s2={}", pga)}, "rare.h5"))["rare"];
        const double p = found["probability"].number;
        const double relative =
            std::log(found["upper"].number / found["lower"].number) / 2 / 2.262; // Student's t of nine degrees, 95 %
        const std::uint64_t collapses = plain(pga, realizations);
        const BinomialInterval counted = jeffreys(realizations, collapses, 0.999);
        const std::string text = fmt::format(
            "chains {:.3g} (95 %: {:.3g} to {:.3g}) with {:.0f} realizations; plain {} of {}: 99.9 % {:.3g} to "
            "{:.3g}; cost of plain sampling over that of chains {:.1f}\n",
            p, found["lower"].number, found["upper"].number, found["realizations"].number, collapses, realizations,
            counted.lower, counted.upper, found["plain_realizations"].number / found["realizations"].number);
        std::printf("%s", text.c_str());
        EXPECT_GT(p * std::exp(4.78 * relative), counted.lower) << text; // 99.9 %
        EXPECT_LT(p * std::exp(-4.78 * relative), counted.upper) << text;
        for (const JsonValue& level : found["levels"].items)
            if (level["stuck"].kind == JsonValue::Kind::number) {
                EXPECT_LT(level["stuck"].number, 0.25) << text;
            }
    }
};

TEST_F(RareStatistics, AgreesWithPlainCountsOfOneInAThousand)
{
    expect_agreement(3.9, 20000);
}

/// Of one in ten thousand: half a million realizations.
TEST_F(RareStatistics, AgreesWithPlainCountsOfOneInTenThousandLong)
{
    expect_agreement(3.75, 500000);
}

TEST_F(RareStatistics, ThreadsInstructionSetsAndInterruptionsChangeNoByte)
{
    const std::vector<std::string> small = {"rare.samples=200", "rare.repeats=5", "excitation.pga_m_s2=3.9"};
    const Ended whole = study(small, "whole.h5");
    ASSERT_EQ(whole.status, 0) << testing::PrintToString(whole);
    ASSERT_EQ(study(small, "scalar.h5", "1", "scalar").status, 0);
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "scalar.h5"));
    ProgramRun part{.arguments = run_words(rare_study, small, {"-o", "parts.h5", "--threads", "1"})};
    part.signal = SIGKILL;
    part.terminal = true;
    part.when = when_done(ResultReader(folder / "whole.h5").done() * 6 / 10);
    run(part);
    const Ended rest = study(small, "parts.h5");
    EXPECT_EQ(rest.status, 0) << testing::PrintToString(rest);
    EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "parts.h5"));

    const ResultReader reader(folder / "whole.h5");
    const RareTable table = rare_table(reader.table("rare"));
    EXPECT_EQ(table.repeats.size(), 5U);
    EXPECT_EQ(table.realizations, reader.rows().size());                  // of the pilot too
    for (std::size_t i = table.levels; i < table.threshold_m.size(); ++i) // all repeats have the levels of the pilot
        EXPECT_TRUE(std::isnan(table.threshold_m[i]) || table.threshold_m[i] == table.threshold_m[i % table.levels]);
    EXPECT_EQ(json_of(whole)["rare"]["probability"].number, table.probability);
    ASSERT_EQ(run({"report", "whole.h5", "--quiet"}).status, 0);
    EXPECT_NE(read_bytes(folder / "whole.html").find("Probability of collapse"), std::string::npos);
    expect_refused({"replay", "whole.h5", "--realization", "3"}, {"it cannot be repeated alone"});
}

TEST_F(RareStatistics, RefusesWhatItCannotAnswer)
{
    const auto refused = [&](const std::vector<std::string>& settings, const Words& parts) {
        expect_refused(run_words(rare_study, settings, {"-o", "x.h5"}), parts);
    };
    refused({"study.realizations=5"}, {"study.realizations", "rare.samples"});
    refused({"study.sampling=sobol"}, {"study.sampling"});
    refused({"rare.samples=150"}, {"rare.samples", "[200, "});
    refused({"rare.repeats=4"}, {"rare.repeats", "[5, "});
    refused({"excitation.kind=noise"}, {"synthetic earthquakes"});
    refused({"study.kind=single"}, {"rare", "is not used by study.kind = \"single\""});
    // nothing comes to a collapse: said, with no estimate
    const JsonValue calm =
        json_of(study({"excitation.pga_m_s2=0.001", "rare.samples=200", "rare.repeats=5"}, "calm.h5"))["rare"];
    EXPECT_TRUE(calm["probability"].kind == JsonValue::Kind::null);
    EXPECT_TRUE(calm["upper"].kind == JsonValue::Kind::null);
}

} // namespace
} // namespace stylobate
