/// The realizations in motion of `stylobate report`: which are kept, within which limits, and what is refused.

#include "studies/experiment/limit_state.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "tests/program/program.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <array>
#include <fmt/format.h>
#include <set>

namespace stylobate {
namespace {

class Animate : public Program {
protected:
    /// 16 cells of a short column; some of them have both fates.
    void make_surface() const
    {
        const Ended ended = run(run_words(column_study, short_surface(6), {"-o", "surface.h5", "--quiet"}));
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }

    /// The page of these options.
    std::string page_of(const std::string& results, const Words& options) const
    {
        Words words = {"report", results, "-o", "page.html", "--force", "--quiet"};
        words.insert(words.end(), options.begin(), options.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(ended.err, "") << testing::PrintToString(ended);
        return read_bytes(folder / "page.html");
    }

    /// What stands in a page under a name; nothing: an empty list.
    static JsonValue data_of(const std::string& page, const std::string& id)
    {
        const std::string open = "id=\"" + id + "\">";
        const std::size_t begin = page.find(open);
        if (begin == std::string::npos)
            return {};
        const std::size_t end = page.find("</script>", begin);
        return JsonParser::parse(page.substr(begin + open.size(), end - begin - open.size()));
    }

    using Key = std::pair<std::uint64_t, std::uint64_t>; ///< cell and index
    static std::set<Key> kept(const std::string& page)
    {
        std::set<Key> all;
        const JsonValue data = data_of(page, "animations");
        if (data.kind == JsonValue::Kind::object)
            for (const JsonValue& one : data["list"].items)
                all.emplace(static_cast<std::uint64_t>(one["cell"].number),
                            static_cast<std::uint64_t>(one["index"].number));
        return all;
    }

    /// The first of each fate in the cells that have both, and the first of all in the others, from the rows.
    std::set<Key> expected(std::size_t each) const
    {
        std::map<std::uint64_t, std::array<std::vector<std::uint64_t>, 2>> cells;
        for (const ResultRow& row : ResultReader(folder / "surface.h5").rows())
            if (row.outcome.state != State::invalid)
                cells[row.cell][row.outcome.state == State::collapsed].push_back(row.index);
        std::set<Key> all;
        for (const auto& [cell, fates] : cells) {
            const bool mixed = !fates[0].empty() && !fates[1].empty();
            for (const std::vector<std::uint64_t>& fate : fates)
                for (std::size_t k = 0; k < std::min<std::size_t>(mixed ? each : 1, fate.size()); ++k)
                    all.emplace(cell, fate[k]);
        }
        return all;
    }
};

TEST_F(Animate, OneOfEachFateOfEveryCell)
{
    make_surface();
    const std::set<Key> one = expected(1), two = expected(2);
    ASSERT_GE(one.size(), 16U + 2U) << "the study has too few mixed cells to test anything";
    ASSERT_GT(two.size(), one.size());
    EXPECT_EQ(kept(page_of("surface.h5", {})), one);
    EXPECT_EQ(kept(page_of("surface.h5", {"--animate", "2"})), two);
    EXPECT_TRUE(kept(page_of("surface.h5", {"--animate", "0"})).empty());
}

TEST_F(Animate, CellsHaveTheCountsOfTheRows)
{
    make_surface();
    const JsonValue cells = data_of(page_of("surface.h5", {"--animate", "0"}), "cells");
    std::map<std::uint64_t, std::array<double, 5>> states;
    for (const ResultRow& row : ResultReader(folder / "surface.h5").rows())
        ++states[row.cell][static_cast<std::size_t>(row.outcome.state)];
    const SurfaceTable surface = ResultReader(folder / "surface.h5").surface();
    ASSERT_EQ(cells["trials"].items.size(), 16U);
    for (std::size_t cell = 0; cell < 16; ++cell) {
        EXPECT_EQ(cells["collapses"].items[cell].number, states[cell][3]);
        EXPECT_EQ(cells["trials"].items[cell].number, static_cast<double>(surface.trials[cell]));
        EXPECT_NEAR(cells["probability"].items[cell].number, surface.probability[cell], 1e-5);
        EXPECT_NEAR(cells["lower"].items[cell].number, surface.lower[cell], 1e-5);
        EXPECT_NEAR(cells["upper"].items[cell].number, surface.upper[cell], 1e-5);
        EXPECT_EQ(cells["outcomes"]["rocked"].items[cell].number, states[cell][1]);
        EXPECT_EQ(cells["outcomes"]["slid"].items[cell].number, states[cell][2]);
    }
}

TEST_F(Animate, CellsHaveEachLimitStateWithItsInterval)
{
    make_surface();
    const JsonValue cells = data_of(page_of("surface.h5", {"--animate", "0"}), "cells");
    const std::vector<ResultRow> rows = ResultReader(folder / "surface.h5").rows();
    std::vector<std::string> names;
    for (const JsonValue& limit : cells["limits"].items)
        names.push_back(limit["name"].text);
    EXPECT_EQ(names, (std::vector<std::string>{"collapse", "rocked", "slid", "moving"})); // no epistyle, one fall
    std::map<std::pair<double, double>, const JsonValue*> intervals;
    for (const JsonValue& one : cells["intervals"].items)
        intervals[{one.items[0].number, one.items[1].number}] = &one.items[2];
    for (const JsonValue& limit : cells["limits"].items) {
        if (limit["name"].text == "collapse") // its own members
            continue;
        std::vector<std::uint64_t> counts(16);
        for (const ResultRow& row : rows)
            counts[row.cell] +=
                row.outcome.state != State::invalid && reached(limit_state_of(limit["name"].text), row.outcome);
        for (std::size_t cell = 0; cell < 16; ++cell) {
            const double trials = cells["trials"].items[cell].number, count = static_cast<double>(counts[cell]);
            EXPECT_EQ(limit["reached"].items[cell].number, count);
            const Share share = share_of(static_cast<std::uint64_t>(trials), counts[cell]);
            const auto ends = intervals.find({trials, count});
            ASSERT_NE(ends, intervals.end());
            EXPECT_NEAR(ends->second->items[0].number, share.lower, 1e-5);
            EXPECT_NEAR(ends->second->items[1].number, share.upper, 1e-5);
        }
    }
}

TEST_F(Animate, TheChoiceDoesNotDependOnThreadsAndTheBudgetLeavesOut)
{
    make_surface();
    const std::string all = page_of("surface.h5", {"--threads", "1"});
    EXPECT_EQ(page_of("surface.h5", {"--threads", "3"}), all);
    const JsonValue list = data_of(all, "animations")["list"];
    std::size_t most = 0;
    for (const JsonValue& one : list.items)
        most = std::max(most, one["data"].text.size());
    // room for one or two, with what is said of them
    const double mb = (1.2 * static_cast<double>(most) + 400) / 1e6;
    const std::string some = page_of("surface.h5", {"--animate-mb", fmt::format("{:.6f}", mb)});
    const std::set<Key> in_all = kept(all), in_some = kept(some);
    EXPECT_GE(in_some.size(), 1U);
    EXPECT_LT(in_some.size(), in_all.size());
    const ResultReader reader(folder / "surface.h5"); // what fell in mixed cells comes first
    for (const auto& [cell, index] : in_some)
        EXPECT_EQ(reader.row(index).outcome.state, State::collapsed);
    EXPECT_TRUE(std::includes(in_all.begin(), in_all.end(), in_some.begin(), in_some.end()));
    EXPECT_EQ(page_of("surface.h5", {"--animate-mb", fmt::format("{:.6f}", mb), "--threads", "2"}), some);
    EXPECT_NE(some.find("The budget is used up"), std::string::npos);
    EXPECT_EQ(all.find("The budget is used up"), std::string::npos);
    // the first ones are made in any case, more only while there is time
    const std::string late = page_of("surface.h5", {"--animate-seconds", "0", "--threads", "1"});
    EXPECT_EQ(kept(late).size(), 2U);
    EXPECT_NE(late.find("is used up: --animate-seconds"), std::string::npos);
}

TEST_F(Animate, OfASingleStudyTheTrajectoriesOfTheFile)
{
    const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";
    EXPECT_EQ(run({"run", study, "-o", "one.h5", "--quiet"}).status, 0);
    const std::string page = page_of("one.h5", {});
    const JsonValue data = data_of(page, "animations");
    ASSERT_EQ(data["list"].items.size(), 1U);
    const Trajectory t = ResultReader(folder / "one.h5").trajectory(0);
    EXPECT_LE(data["rate_hz"].number, 60);
    EXPECT_NEAR((data["list"].items[0]["samples"].number - 1) / data["rate_hz"].number, t.time_s.back(),
                1 / data["rate_hz"].number);
    EXPECT_EQ(count_of(page, "class=\"figure-data\""), 1U); // its history
}

TEST_F(Animate, RefusesWhatCannotBeHad)
{
    make_surface();
    expect_refused({"report", "surface.h5", "--animate", "-1"}, {"--animate", "-1"});
    expect_refused({"report", "surface.h5", "--animate", "1.5"}, {"--animate", "1.5"});
    expect_refused({"report", "surface.h5", "--animate-mb", "-3"}, {"--animate-mb", "-3"});
    expect_refused({"report", "surface.h5", "--animate-mb", "0"}, {"--animate-mb", "0"});
    expect_refused({"report", "surface.h5", "--animate-mb", "nan"}, {"--animate-mb", "a number"});
    expect_refused({"report", "surface.h5", "--animate-seconds", "nan"}, {"--animate-seconds", "a number"});
    expect_refused({"report", "surface.h5", "--animate-seconds", "-1"}, {"--animate-seconds", "-1"});
    expect_refused({"report", "surface.h5", "--animate-mb", "0.0005"},
                   {"surface.h5", "budget of 0.0005 MB", "--animate-mb", "or --animate 0"});
    EXPECT_EQ(run(run_words(column_study, with(short_surface(6), {"output.realizations=\"none\""}),
                            {"-o", "counts.h5", "--quiet"}))
                  .status,
              0);
    expect_refused({"report", "counts.h5", "--animate", "1"}, {"counts.h5", "no rows of realizations"});
    const std::string counted = page_of("counts.h5", {});
    EXPECT_NE(counted.find("has no rows of realizations"), std::string::npos);
    EXPECT_EQ(data_of(counted, "cells")["trials"].items.size(), 16U);
    // a run that is not complete
    const Ended stopped = run(ProgramRun{.arguments = run_words(column_study, short_surface(20000), {"-o", "part.h5"}),
                                         .terminal = true,
                                         .signal = SIGINT,
                                         .when = when_done(100)});
    EXPECT_EQ(stopped.status, 130) << testing::PrintToString(stopped);
    expect_refused({"report", "part.h5"}, {"part.h5", "not complete: it has ", " of 320000 realizations"});
}

TEST_F(Animate, ADiagnosisHasNone)
{
    write_diagnosis(filled_diagnosis(), folder / "diagnosis.h5");
    expect_refused({"report", "diagnosis.h5", "--animate", "1"}, {"diagnosis.h5", "--animate", "no realizations"});
    expect_refused({"report", "diagnosis.h5", "--animate-mb", "1"},
                   {"diagnosis.h5", "--animate-mb", "no realizations"});
    expect_refused({"report", "diagnosis.h5", "--animate-seconds", "1"}, {"--animate-seconds", "no realizations"});
}

TEST_F(Animate, WithoutItsRecordAPageHasNoAnimations)
{
    write_bytes(folder / "record.at2", Burst{}.at2());
    const Words settings =
        with(two_under_a_record,
             {"study.realizations=8", "excitation.file=" + (folder / "record.at2").string(),
              "surface.frequency_hz={from=1.0,to=1.0,count=1}", "surface.pga_m_s2={from=5.0,to=14.0,count=10}"});
    const Ended ran = run(run_words(record_study, settings, {"-o", "shaken.h5", "--quiet"}));
    ASSERT_EQ(ran.status, 0) << testing::PrintToString(ran);
    ASSERT_FALSE(kept(page_of("shaken.h5", {})).empty()) << "the study has no mixed cell";
    fs::remove(folder / "record.at2");
    fs::remove(folder / "page.html");
    const Ended without = run({"report", "shaken.h5"});
    EXPECT_EQ(without.status, 0) << testing::PrintToString(without);
    EXPECT_NE(without.err.find("warning: no animations: "), std::string::npos) << without.err;
    EXPECT_TRUE(kept(read_bytes(folder / "shaken.html")).empty());
    fs::remove(folder / "shaken.html");
    expect_refused({"report", "shaken.h5", "--animate", "1"}, {"record.at2"});
}

TEST_F(Animate, AnInterruptLeavesNoPage)
{
    EXPECT_EQ(run(run_words(column_study, short_surface(100), {"-o", "surface.h5", "--quiet"})).status, 0);
    const Words before = names();
    const Ended ended = run(ProgramRun{.arguments = {"report", "surface.h5", "--animate", "100", "--threads", "1"},
                                       .terminal = true,
                                       .signal = SIGINT,
                                       .when = when_done(2)});
    EXPECT_EQ(ended.status, 130) << testing::PrintToString(ended);
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find("interrupted: no page was written"), std::string::npos) << ended.err;
    EXPECT_EQ(names(), before);
}

} // namespace
} // namespace stylobate
