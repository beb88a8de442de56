/// A survival study as its user runs it: the same bytes whatever the threads and interruptions; one event is the
/// surface; what is reported is what the rows contain; structures together; tables, pictures and page; refusals.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "studies/report/left_out.hpp"

#include <cmath>

namespace stylobate {
namespace {

constexpr int past_realizations = 12;
constexpr std::uint64_t past_originals = 16 * past_realizations;
const std::vector<std::string> plain_surface = short_surface(past_realizations);
const std::vector<std::string> survival =
    with(plain_surface, {"study.kind=survival", "survival.events=2", "survival.pause_s=0.5", "survival.monuments=20",
                         "survival.observed={tolerance_m=0.001}", "survival.stands_for_years=100",
                         "survival.hazard={k0_per_year=0.1,k=2,sigma_ln=1}"});

class SurvivalProgram : public ColumnProgram {};

TEST_F(SurvivalProgram, ThreadsInstructionSetsAndInterruptionsChangeNoByte)
{
    expect_no_byte_changes([](const std::string& results, const char* threads, const std::string& simd) {
        return words(survival, results, threads, simd);
    });
}

TEST_F(SurvivalProgram, OneEventIsTheSurfaceAndTheCountsAreThoseOfTheRows)
{
    const Ended ended = run(words(survival, "past.h5", "2"));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    ASSERT_EQ(run(words(plain_surface, "plain.h5", "2")).status, 0);
    const ResultReader past(folder / "past.h5"), plain(folder / "plain.h5");
    EXPECT_TRUE(plain.header().bed_names.empty());
    ASSERT_EQ(past.header().bed_names.size(), 3U);
    EXPECT_EQ(past.header().bed_names.front(), "drum 2 on drum 1");
    ASSERT_EQ(past.rows().size(), 2 * past_originals);
    EXPECT_EQ(past.surface().trials, plain.surface().trials) << "a second event is no trial of the surface";

    std::uint64_t agree = 0, stand = 0, valid = 0;
    for (const ResultRow& row : past.rows()) {
        const Outcome& o = row.outcome;
        ASSERT_EQ(o.bed_offset_m.size(), 3U);
        EXPECT_EQ(row.cell, row.index % past_originals / past_realizations);
        if (o.state == State::invalid)
            continue;
        ++valid;
        if (o.state == State::collapsed)
            continue;
        ++stand;
        agree += std::all_of(o.bed_offset_m.begin(), o.bed_offset_m.end(),
                             [](double offset) { return std::fabs(offset) <= 0.001; });
        double sum = 0;
        for (const double offset : o.bed_offset_m)
            sum += std::fabs(offset);
        EXPECT_EQ(o.at_rest == 0, std::isnan(o.residual_sliding_m));
        if (o.at_rest != 0) {
            EXPECT_EQ(sum, o.residual_sliding_m);
        }
    }
    const JsonValue said = json_of(ended)["survival"];
    EXPECT_EQ(said["valid"].number, static_cast<double>(valid));
    EXPECT_EQ(said["standing"].number, static_cast<double>(stand));
    EXPECT_EQ(said["agreeing"].number, static_cast<double>(agree));
    EXPECT_TRUE(said["judged"].boolean);
    EXPECT_EQ(said["exclusion_by_events"].items.size(), 2U);
    EXPECT_LT(said["rates"]["factor_median"]["value"].number, 1);
    // the summary is of one event, and states it
    ASSERT_EQ(run({"report", "past.h5", "--animate", "0", "--quiet"}).status, 0);
    EXPECT_NE(read_bytes(folder / "past.html").find(" valid realizations of one event over "), std::string::npos);
    // the table of the file has the same counts
    const Table table = past.table("survival");
    std::uint64_t in_table = 0;
    for (const std::uint64_t n : table.counts("agreeing", {2, 4, 4}))
        in_table += n;
    EXPECT_EQ(in_table, agree);
}

TEST_F(SurvivalProgram, ItIsVerifiedReplayedAndMerged)
{
    ASSERT_EQ(run(words(survival, "past.h5", "2")).status, 0);
    const Ended verified = run({"verify-file", "past.h5", "--replay", "6"});
    EXPECT_EQ(verified.status, 0) << testing::PrintToString(verified);
    for (const std::uint64_t index : {std::uint64_t{7}, past_originals + 41}) {
        const Ended ended = run({"replay", "past.h5", "--realization", std::to_string(index), "--json"});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_TRUE(json_of(ended)["same_bits"].boolean) << index;
    }
    for (const char* shard : {"1/2", "2/2"}) {
        Words part = run_words(column_study, survival, {"-o", std::string("s") + shard[0] + ".h5", "--shard", shard});
        ASSERT_EQ(run(part).status, 0) << shard;
    }
    ASSERT_EQ(run({"merge", "s1.h5", "s2.h5", "-o", "merged.h5"}).status, 0);
    EXPECT_EQ(bytes("merged.h5"), bytes("past.h5"));
}

TEST_F(SurvivalProgram, TablesPicturesAndPage)
{
    ASSERT_EQ(run(words(survival, "past.h5", "2")).status, 0);
    ASSERT_EQ(run({"export", "past.h5", "--to", "csv"}).status, 0);
    EXPECT_EQ(count_of(bytes("past_csv/survival.csv"), "\n"), 1 + 32U);
    EXPECT_NE(bytes("past_csv/realizations.csv").find("bed_offset_m[2],rotation_rad[0]"), std::string::npos);
    for (const char* picture : {"likelihood", "exclusion", "rates", "surface"}) {
        const Ended ended = run({"export", "past.h5", "--to", "png", "--picture", picture});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_GT(bytes(std::string("past_") + picture + ".png").size(), 10000U) << picture;
    }
    ASSERT_EQ(run({"report", "past.h5", "-o", "past.html"}).status, 0);
    const std::string page = bytes("past.html");
    for (const char* title :
         {"The past of the structure", "The rates of the hazard curve", "Test on simulated monuments"})
        EXPECT_NE(page.find(title), std::string::npos) << title;
    EXPECT_EQ(run({"info", "past.h5"}).status, 0);
}

TEST_F(SurvivalProgram, StructuresOfOneSiteAreCombined)
{
    ASSERT_EQ(run(words(survival, "a.h5", "2")).status, 0);
    ASSERT_EQ(run(words(with(survival, {"structure.drum_width_m=0.06", "survival.structure=2"}), "b.h5", "2")).status,
              0);
    EXPECT_EQ(run({"past", "a.h5", "b.h5", "--quiet"}).out, run({"past", "a.h5", "b.h5"}).out);
    const Ended ended = run({"past", "a.h5", "b.h5", "-o", "both.png", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_GT(bytes("both.png").size(), 10000U);
    EXPECT_EQ(json_of(ended)["structures"].items.size(), 2U);
    EXPECT_EQ(json_of(ended)["together_by_events"].items.size(), 2U);
    EXPECT_EQ(json_of(ended)["left_out"].text, left_out_text(2));
    EXPECT_NE(run({"past", "a.h5", "b.h5"}).out.find(left_out_text(2) + "\n"), std::string::npos);

    expect_refused(Words{"past", "a.h5"}, {"two structures"});
    expect_refused(Words{"past", "a.h5", "b.h5", "./a.h5"}, {"a.h5 is given twice"});
    ASSERT_EQ(run(words(with(survival, {"survival.prior=uniform", "survival.structure=3"}), "c.h5", "2")).status, 0);
    expect_refused(Words{"past", "a.h5", "c.h5"}, {"c.h5", "another prior", "a.h5"});
    ASSERT_EQ(run(words(with(survival, {"study.seed=9", "survival.structure=2"}), "e.h5", "2")).status, 0);
    expect_refused(Words{"past", "a.h5", "e.h5"}, {"not been through the same motions", "study.seed"});
    ASSERT_EQ(run(words(with(survival, {"surface.pga_m_s2.to=11", "survival.structure=2"}), "d.h5", "2")).status, 0);
    expect_refused(Words{"past", "a.h5", "d.h5"}, {"d.h5", "other axes"});
    ASSERT_EQ(run(words(plain_surface, "plain.h5", "2")).status, 0);
    expect_refused(Words{"past", "a.h5", "plain.h5"}, {"plain.h5", "survival"});
}

TEST_F(SurvivalProgram, AStateThatNoneReachesIsNotJudged)
{
    const std::vector<std::string> odd = with(
        survival, {"survival.observed={joint_offset_m=[0.02,-0.02,0.02],tolerance_m=0.0001}", "survival.structure=2"});
    const Ended ended = run(words(odd, "odd.h5", "2"));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue said = json_of(ended)["survival"];
    EXPECT_FALSE(said["judged"].boolean);
    EXPECT_GT(said["nearest"]["distance_in_tolerances"].number, 1);
    EXPECT_NE(said["why_not_judged"].text.find("cannot be judged"), std::string::npos);
    EXPECT_NE(said["why_not_judged"].text.find("more realizations"), std::string::npos);
    for (const char* number : {"\"posterior\"", "\"exclusion_by_events\""})
        EXPECT_EQ(ended.out.find(number), std::string::npos) << number;
    expect_refused(Words{"export", "odd.h5", "--to", "png", "--picture", "exclusion"}, {"cannot be judged"});
    ASSERT_EQ(run({"report", "odd.h5", "-o", "odd.html"}).status, 0);
    EXPECT_NE(bytes("odd.html").find("Not judged"), std::string::npos);
    ASSERT_EQ(run(words(survival, "a.h5", "2")).status, 0);
    expect_refused(Words{"past", "a.h5", "odd.h5"}, {"odd.h5", "cannot be judged"});
}

TEST_F(SurvivalProgram, BadInputIsRefusedWithItsRange)
{
    const auto refused = [&](const std::vector<std::string>& settings, const std::vector<std::string>& says) {
        expect_refused(words(with(survival, settings), "none.h5", "1"), says);
    };
    refused({"survival.observed={joint_offset_m=[0.001,0,0]}"}, {"survival.observed.tolerance_m is missing"});
    refused({"survival.observed={joint_offset_m=[0.001],tolerance_m=0.001}"},
            {"joint_offset_m", "has 1 values", "3 joints"});
    refused({"survival.observed={joints=[2,1],tolerance_m=0.001}"}, {"joints", "ascending"});
    refused({"survival.observed={joints=[3],tolerance_m=0.001}"}, {"joints", "[0, 2]", "3 joints"});
    refused({"survival.observed={tolerance_m=0}"}, {"tolerance_m", "is outside (0, 10]"});
    refused({"survival.observed={mirrored=true}"}, {"survival.observed.tolerance_m is missing"});
    refused({"survival.observed={rotation_rad=[0,0],rotation_tolerance_rad=0.1}"}, {"rotation_rad", "3 free blocks"});
    refused({"survival.observed={rotation_rad=[0,0,0]}"}, {"rotation_tolerance_rad is missing"});
    refused({"survival.observed={offset=1}"}, {"unknown key survival.observed.offset", "joint_offset_m"});
    refused({"survival.level=1"}, {"survival.level = 1 is outside [0.5, 0.999]"});
    refused({"survival.events=0"}, {"survival.events = 0 is outside [1, 20]"});
    refused({"survival.prior=lognormal"}, {"survival.prior", "Allowed", "log_uniform"});
    refused({"survival.hazard={k0_per_year=0.1,sigma_ln=1}"}, {"survival.hazard.k is missing"});
    refused({"survival.hazard={sigma_ln=1}"}, {"survival.hazard has 0 hazard curves"});
    refused({"survival.hazard={intensity_m_s2=[1,2],rate_per_year=[0.1,0.2],sigma_ln=1}"},
            {"intensity_m_s2", "no hazard curve", "descend"});
    refused({"survival.hazard={file=\"none.csv\",sigma_ln=1}"}, {"none.csv"});
    refused({"survival.stands_for_years=-1"}, {"survival.stands_for_years"});
    refused({"surface.adaptive={budget=400}"}, {"adaptive", "survival"});
    refused({"surface.pga_m_s2.count=2"}, {"surface.pga_m_s2", "three values"});
    refused({"output.realizations=none"}, {"output.realizations", "survival"});
    refused({"excitation.start=abrupt"}, {"survival.events", "abrupt"});
    refused({"mechanisms.time_offset={offset_s=0.1}"}, {"survival.events", "time_offset"});
    refused({"twins.forms=true"}, {"[twins]", "survival"});
    std::ofstream(folder / "curve.csv") << "pga_m_s2,annual_frequency\n1,0.1\n2,x\n";
    refused({"survival.hazard={file=\"curve.csv\",sigma_ln=1}"}, {"curve.csv:3", "annual_frequency"});
    std::ofstream(folder / "other.csv") << "a,b\n1,0.1\n";
    refused({"survival.hazard={file=\"other.csv\",sigma_ln=1}"}, {"other.csv:1", "intensity measure"});
    expect_refused(words(with(plain_surface, {"survival.events=2"}), "none.h5", "1"), {"survival", "surface"});
}

TEST_F(SurvivalProgram, AHazardCurveInAFileIsItsPoints)
{
    std::ofstream(folder / "curve.csv") << "# a comment\npga_m_s2,annual_frequency\n1,0.1\n2,0.0125\n";
    const std::vector<std::string> base = with(survival, {"survival.events=1", "survival.monuments=0"});
    ASSERT_EQ(run(words(with(base, {"survival.hazard={file=\"curve.csv\",sigma_ln=1}"}), "a.h5", "2")).status, 0);
    ASSERT_EQ(run(words(with(base, {"survival.hazard={intensity_m_s2=[1,2],rate_per_year=[0.1,0.0125],sigma_ln=1}"}),
                        "b.h5", "2"))
                  .status,
              0);
    EXPECT_EQ(bytes("a.h5"), bytes("b.h5")) << "the results do not need the file";
    // the weakest intensities of a curve may be exceeded equally often, as `risk` takes them
    std::ofstream(folder / "level.csv") << "pga_m_s2,annual_frequency\n0.5,0.1\n1,0.1\n1.2,0.0125\n";
    const Ended level = run(words(with(base, {"survival.hazard={file=\"level.csv\",sigma_ln=1}"}), "level.h5", "2"));
    ASSERT_EQ(level.status, 0) << testing::PrintToString(level);
    ASSERT_EQ(run({"report", "level.h5"}).status, 0);
    EXPECT_NE(read_page(folder / "level.html").find("outside of the points of the hazard curve, 0.5 to 1.2 m/s2"),
              std::string::npos);
    std::ofstream(folder / "pgv.csv") << "pgv_m_s,annual_frequency\n1,0.1\n2,0.0125\n";
    expect_refused(words(with(base, {"survival.hazard={file=\"pgv.csv\",sigma_ln=1}"}), "none.h5", "1"),
                   {"pgv.csv", "the hazard is of pgv_m_s, the study of pga_m_s2"});
    expect_refused(words(with(base, {"survival.hazard={file=\"curve.csv\",site=\"2\",sigma_ln=1}"}), "none.h5", "1"),
                   {"survival.hazard.site = 2", "is a table of one site"});
    fs::remove(folder / "curve.csv");
    EXPECT_EQ(run({"report", "a.h5"}).status, 0);
}

} // namespace
} // namespace stylobate
