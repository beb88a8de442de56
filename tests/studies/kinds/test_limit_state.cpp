/// Limit states counted by hand, and what the program says and draws of them.

#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/adaptive/adaptive_kind.hpp"
#include "studies/kinds/surface/surface_kind.hpp"
#include "studies/results/result_picture.hpp"
#include "studies/workflow/console.hpp"
#include "tests/program/program.hpp"

#include <cmath>

namespace stylobate {
namespace {

/// A colonnade of two columns of two drums and one epistyle: five blocks.
const std::vector<std::string> five_blocks = {"drum 0 of column 0", "drum 1 of column 0", "drum 0 of column 1",
                                              "drum 1 of column 1", "epistyle 0"};

ResultRow row_of(State state, const std::vector<double>& fall_time_s)
{
    ResultRow row;
    Outcome& o = row.outcome;
    o.state = state;
    o.fall_time_s = fall_time_s;
    o.end_time_s = 20;
    for (std::size_t i = 0; i < fall_time_s.size(); ++i) {
        const double time = fall_time_s[i];
        if (time < 0)
            continue;
        ++o.fallen_blocks;
        if (o.first_collapse_block == -1 || time < o.collapse_time_s) {
            o.first_collapse_block = static_cast<std::int32_t>(i);
            o.collapse_time_s = time;
        } else if (time == o.collapse_time_s) {
            o.first_collapse_block = several_blocks;
        }
    }
    return row;
}

/// Ten rows: 4 collapsed (first: block 4 three times, block 1 once; one of them in all), 2 rocked, 1 slid, 2 stood, and
/// one invalid that looks like a collapse.
std::vector<ResultRow> ten_rows()
{
    std::vector<ResultRow> rows = {
        row_of(State::collapsed, {-1, 4.5, -1, -1, 4.0}),    row_of(State::collapsed, {-1, 2.0, -1, -1, 3.0}),
        row_of(State::collapsed, {7.0, 6.5, 9.0, 6.6, 6.0}), row_of(State::collapsed, {-1, -1, -1, -1, 5.0}),
        row_of(State::rocked, {-1, -1, -1, -1, -1}),         row_of(State::rocked, {-1, -1, -1, -1, -1}),
        row_of(State::slid, {-1, -1, -1, -1, -1}),           row_of(State::stood, {-1, -1, -1, -1, -1}),
        row_of(State::stood, {-1, -1, -1, -1, -1}),          row_of(State::invalid, {1, 1, 1, 1, 1})};
    for (const std::size_t i : {0U, 2U, 3U, 9U}) {
        rows[i].outcome.unseated_block = 4;
        rows[i].outcome.unseating_time_s = rows[i].outcome.collapse_time_s - 0.5;
    }
    rows[4].outcome.unseated_block = 4; // it lost a seat, and did not fall
    rows[4].outcome.unseating_time_s = 3;
    rows[2].outcome.total_collapse_time_s = 9;
    for (const std::size_t i : {4U, 7U}) // (a fall ends a realization while it moves)
        rows[i].outcome.at_rest = 1;
    rows[9].outcome.total_collapse_time_s = 1;
    return rows;
}

TEST(LimitState, CountsByHand)
{
    LimitCounts counts(5);
    EXPECT_TRUE(std::isnan(counts.median_collapse_time_s()));
    EXPECT_TRUE(std::isnan(counts.share(LimitState::total).probability));
    for (const ResultRow& row : ten_rows())
        counts.add(row);
    EXPECT_EQ(counts.trials(), 9U);
    const std::vector<std::uint64_t> want = {4, 1, 4, 2, 1, 3};
    for (std::size_t i = 0; i < want.size(); ++i) {
        const Share share = counts.share(limit_state_of(limit_state_names().at(i)));
        EXPECT_EQ(share.count, want[i]) << limit_state_names()[i];
        EXPECT_EQ(share.trials, 9U);
        EXPECT_EQ(share.probability, static_cast<double>(want[i]) / 9);
        EXPECT_LT(share.lower, share.probability);
        EXPECT_GT(share.upper, share.probability);
    }
    EXPECT_EQ(counts.moving_text(), "3 of 5 realizations without collapse still moved at the end.");
    EXPECT_EQ(LimitCounts(5).moving_text(), std::nullopt);
    EXPECT_EQ(counts.first(), (std::vector<std::uint64_t>{0, 1, 0, 0, 3}));
    EXPECT_EQ(counts.median_collapse_time_s(), 4.5); // of 2, 4, 5, 6
    EXPECT_EQ(counts.median_total_collapse_time_s(), 9);
    counts.add(row_of(State::collapsed, {-1, 4.75, -1, -1, -1}));
    EXPECT_EQ(counts.median_collapse_time_s(), 4.75); // of 2, 4, 4.75, 5, 6
}

/// Blocks that fell first at the same step did so together: none of them is the first, whatever its number.
TEST(LimitState, NoBlockIsTheFirstOfATie)
{
    LimitCounts counts(5);
    Tally tally(1, limit_state_names().size(), 5);
    std::vector<ResultRow> rows = {
        row_of(State::collapsed, {2, -1, 2, -1, 3}), row_of(State::collapsed, {4, -1, 2, -1, 3}),
        row_of(State::collapsed, {1, 1, 1, 1, 1}), row_of(State::stood, {-1, -1, -1, -1, -1})};
    for (const ResultRow& row : rows) {
        counts.add(row);
        tally.add(tally_entry(row));
    }
    for (const LimitCounts& all : {counts, LimitCounts(tally)}) {
        EXPECT_EQ(all.first(), (std::vector<std::uint64_t>{0, 0, 1, 0, 0}));
        EXPECT_EQ(all.first_together(), 2U);
        EXPECT_EQ(all.share_first_together().probability, 0.5);
        EXPECT_EQ(all.share_first_together().lower, share_of(4, 2).lower);
    }
    const FallOrder order = fall_order(five_blocks, rows);
    EXPECT_EQ(order.together, 2U);
    EXPECT_EQ(order.blocks[2].first, 1U);
    EXPECT_EQ(order.blocks[0].first, 0U);
}

TEST(LimitState, IntervalsAreJeffreys)
{
    // Brown, Cai and DasGupta (2001), Statistical Science 16, Table 5: n = 10
    const std::vector<std::pair<double, double>> table = {{0, 0.217}, {0.011, 0.381}, {0.044, 0.503}, {0.093, 0.606}};
    for (std::size_t k = 0; k < table.size(); ++k) {
        const Share share = share_of(10, k);
        EXPECT_NEAR(share.lower, table[k].first, 6e-4) << k;
        EXPECT_NEAR(share.upper, table[k].second, 6e-4) << k;
    }
    EXPECT_EQ(interval_name(), "jeffreys 0.95");
}

/// Of a fragility study each motion counts once: thirty runs under one of two motions are not thirty observations.
TEST(LimitState, RunsUnderOneMotionAreNotIndependent)
{
    MotionGroups motions{2, 10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
    LimitCounts counts(5, motions), alone(5);
    for (std::uint64_t cell = 0; cell < 20; ++cell) // ten motions of two cells
        for (int run = 0; run < 15; ++run) {
            ResultRow row = cell < 6 ? row_of(State::collapsed, {-1, 2, -1, -1, 3}) : row_of(State::stood, {});
            row.cell = cell;
            counts.add(row);
            alone.add(row);
        }
    EXPECT_EQ(counts.interval(), "motions 0.95");
    for (const Share& share : {counts.share(LimitState::collapse), counts.share_first(1), counts.share_fallen(4)}) {
        EXPECT_EQ(share.count, 90U);
        EXPECT_EQ(share.trials, 300U);
        EXPECT_NEAR(share.lower, 0.0667, 1e-4); // Clopper and Pearson, 3 of 10
        EXPECT_NEAR(share.upper, 0.6525, 1e-4);
    }
    EXPECT_EQ(counts.share_fallen(0).count, 0U);
    EXPECT_EQ(alone.interval(), interval_name());
    EXPECT_GT(alone.share(LimitState::collapse).lower, 0.24);

    // two that are equal are one: 3 of 9; of seven there is no interval
    motions.group[9] = 8;
    motions.groups = 9;
    LimitCounts equal(5, motions);
    MotionGroups seven{2, 7, {0, 1, 2, 3, 4, 5, 6, 6, 6, 6}};
    LimitCounts few(5, seven);
    for (std::uint64_t cell = 0; cell < 20; ++cell)
        for (LimitCounts* each : {&equal, &few}) {
            ResultRow row = row_of(cell < 6 ? State::collapsed : State::stood, {});
            row.cell = cell;
            each->add(row);
        }
    EXPECT_GT(equal.share(LimitState::collapse).upper, 0.6525);
    EXPECT_EQ(few.share(LimitState::collapse).probability, 0.3);
    EXPECT_TRUE(std::isnan(few.share(LimitState::collapse).lower));
    EXPECT_EQ(few.interval(), "none");
}

/// Cells of 3 of 10 and of none: the mean of 0.3 and 1/2. Their posteriors have the variances p (1 - p) / (n + 2) with
/// p = 3.5 / 11 and 1/2.
TEST(LimitState, MeanOfAnAdaptiveSurfaceByHand)
{
    SurfaceTable table;
    table.trials = {10, 0};
    table.collapses = {3, 0};
    table.probability = {0.3, std::nan("")};
    const SurfaceMean mean = mean_of(table);
    EXPECT_NEAR(mean.value, 0.4, 1e-15);
    EXPECT_NEAR(mean.error, std::sqrt(3.5 / 11 * 7.5 / 11 / 12 + 0.25 / 2) / 2, 1e-15);
    Progress progress;
    set_share(progress, {0.4, 0.1});
    EXPECT_NEAR(progress.share_lower, 0.4 - 0.196, 1e-15);
    EXPECT_NEAR(progress.share_upper, 0.4 + 0.196, 1e-15);
    set_share(progress, {0.1, 0.1});
    EXPECT_EQ(progress.share_lower, 0);
}

/// Where nothing has fallen yet the share is not known to be 0.
TEST(LimitState, ProgressHasAnIntervalAtNone)
{
    Progress progress;
    progress.done = 40;
    progress.total = 100;
    EXPECT_EQ(progress_line(progress).find("collapsed"), std::string::npos) << "nothing can be said yet";
    progress.share = 0;
    progress.share_lower = 0;
    progress.share_upper = 0.0604; // 0.975 of Beta(1/2, 40.5), which the executor gives
    EXPECT_NE(progress_line(progress).find("0.0 % collapsed (0.0 to 6.0)"), std::string::npos)
        << progress_line(progress);
    EXPECT_EQ(progress_line(progress).find("+-"), std::string::npos);
}

/// The time left of a run whose end is open is an estimate, and is left out where there is none.
TEST(LimitState, ProgressOfAnOpenEndIsAnEstimate)
{
    Progress progress;
    progress.done = 1000;
    progress.total = 20000;
    progress.rate = 10;
    EXPECT_NE(progress_line(progress).find("1000 of 20000 realizations, 10/s, 31 min 40 s left"), std::string::npos);
    progress.open_end = true;
    EXPECT_NE(progress_line(progress).find("1000 realizations, 10/s"), std::string::npos);
    EXPECT_EQ(progress_line(progress).find("left"), std::string::npos);
    progress.expected = 1500;
    EXPECT_NE(progress_line(progress).find("1000 of about 1500 realizations, 10/s, about 50 s left"), std::string::npos)
        << progress_line(progress);
}

TEST(LimitState, SurfaceOfEach)
{
    const std::vector<std::uint64_t> left = {2, 0, 1, 0, 0}; // rows 0, 1, 7, 8 of the list above
    const std::vector<std::uint64_t> right = {2, 1, 3, 2, 1};
    for (std::size_t i = 0; i < left.size(); ++i) {
        SurfaceCounts counts({{1.0}, {2.0, 3.0}, {}}, static_cast<LimitState>(i));
        std::vector<ResultRow> rows = ten_rows();
        for (std::size_t k = 0; k < rows.size(); ++k) {
            rows[k].cell = k == 0 || k == 1 || k == 7 || k == 8 ? 0 : 1;
            counts.add(rows[k]);
        }
        const SurfaceTable table = counts.table();
        EXPECT_EQ(table.trials, (std::vector<std::uint64_t>{4, 5}));
        EXPECT_EQ(table.collapses, (std::vector<std::uint64_t>{left[i], right[i]})) << limit_state_names()[i];
        EXPECT_EQ(table.probability[1], static_cast<double>(right[i]) / 5);
        EXPECT_EQ(table.lower[0], share_of(4, left[i]).lower);
        EXPECT_EQ(table.upper[1], share_of(5, right[i]).upper);
    }
}

TEST(LimitState, OrderOfFalls)
{
    const FallOrder order = fall_order(five_blocks, ten_rows());
    EXPECT_EQ(order.trials, 9U);
    EXPECT_EQ(order.end_time_s, 20);
    ASSERT_EQ(order.blocks.size(), 5U);
    EXPECT_EQ(order.blocks[4].name, "epistyle 0");
    EXPECT_EQ(order.blocks[4].fall_time_s, (std::vector<double>{3, 4, 5, 6}));
    EXPECT_EQ(order.blocks[1].fall_time_s, (std::vector<double>{2, 4.5, 6.5}));
    EXPECT_EQ(order.blocks[0].fall_time_s, std::vector<double>{7});
    EXPECT_EQ(order.blocks[4].first, 3U);
    EXPECT_EQ(order.blocks[1].first, 1U);
    EXPECT_EQ(order.blocks[2].first, 0U);
    EXPECT_EQ(order.blocks[1].lower, share_of(9, 3).lower);
    // medians: 4.5 of blocks 1 and 4, 6.6, 7, 9
    EXPECT_EQ(order_of_falls(order), (std::vector<std::size_t>{1, 4, 3, 0, 2}));
}

using Falls = Program;

TEST_F(Falls, RunTellsLimitStates)
{
    const Ended plain = run(run_words(column_study, eight_realizations, {"-o", "plain.h5"}));
    ASSERT_EQ(plain.status, 0) << testing::PrintToString(plain);
    const JsonValue json = json_of(run(run_words(column_study, eight_realizations, {"-o", "a.h5", "--json"})));
    const ResultReader reader(folder / "a.h5");
    EXPECT_EQ(reader.header().block_names.size(), 7U);
    // counted anew from the rows
    std::uint64_t collapsed = 0;
    std::vector<std::uint64_t> first(7);
    std::vector<double> times;
    for (const ResultRow& row : reader.rows())
        if (row.outcome.state == State::collapsed) {
            ++collapsed;
            if (row.outcome.first_collapse_block != several_blocks)
                ++first.at(static_cast<std::size_t>(row.outcome.first_collapse_block));
            times.push_back(row.outcome.collapse_time_s);
        }
    ASSERT_GT(collapsed, 0U) << "the study is not what it should be";
    const JsonValue& limits = json["limit_states"];
    EXPECT_EQ(limits["trials"].number, 8);
    EXPECT_EQ(limits["interval"].text, "jeffreys 0.95");
    EXPECT_EQ(limits["collapse"]["count"].number, static_cast<double>(collapsed));
    EXPECT_EQ(limits["collapse"]["probability"].number, static_cast<double>(collapsed) / 8);
    EXPECT_EQ(limits["collapse"]["lower"].number, share_of(8, collapsed).lower);
    EXPECT_EQ(limits["collapse"]["upper"].number, share_of(8, collapsed).upper);
    EXPECT_EQ(limits["unseated"]["count"].number, 0);
    EXPECT_FALSE(limits.has("total")) << "nothing is followed beyond its first fall";
    double told = 0;
    for (const JsonValue& block : limits["first_fallen"].items) {
        const auto index = static_cast<std::size_t>(block["block"].number);
        EXPECT_EQ(block["name"].text, "drum " + std::to_string(index + 1));
        EXPECT_EQ(block["share"]["count"].number, static_cast<double>(first.at(index)));
        told += block["share"]["count"].number;
    }
    EXPECT_EQ(told, static_cast<double>(collapsed));
    std::sort(times.begin(), times.end());
    EXPECT_EQ(limits["median_collapse_time_s"].number, (times[(times.size() - 1) / 2] + times[times.size() / 2]) / 2);

    EXPECT_NE(plain.out.find("  collapsed " + std::to_string(collapsed) + ", "), std::string::npos) << plain.out;
    EXPECT_NE(plain.out.find("95 % Jeffreys interval"), std::string::npos) << plain.out;
    EXPECT_NE(plain.out.find("  first to fall (drums counted from the base): drum "), std::string::npos) << plain.out;
}

TEST_F(Falls, PicturesOfLimitStatesAndOfTheOrder)
{
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "real.h5"})).status, 0);
    // the same study, with falls made by hand: two drums in every realization of the last cell
    const ResultReader real(folder / "real.h5");
    {
        const auto writer = ResultWriter::create(folder / "a.h5", real.header());
        for (ResultRow row : real.rows()) {
            Outcome& o = row.outcome;
            o.state = row.cell == 3 ? State::collapsed : State::rocked;
            o.fall_time_s.assign(7, -1);
            o.first_collapse_block = row.cell == 3 ? 6 : -1;
            if (row.cell == 3) {
                o.fall_time_s[6] = o.collapse_time_s = 1.5;
                o.fall_time_s[5] = 2.0;
            }
            writer->add(row);
        }
        const SurfaceTable table = real.surface();
        writer->finish(&table);
    }
    const std::vector<std::pair<Words, std::string>> pictures = {
        {{"--picture", "order"}, "a_order.png"},
        {{"--cell", "3"}, "a_order_cell_3.png"},
        {{"--limit", "rocked"}, "a_surface_rocked.png"},
        {{"--limit", "slid", "--picture", "slice"}, "a_slice_slid.png"},
        {{"--limit", "unseated"}, "a_surface_unseated.png"},
        {{"--limit", "collapse", "-o", "c.png"}, "c.png"},
    };
    for (const auto& [more, name] : pictures) {
        Words words = {"export", "a.h5", "--to", "png", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(json_of(ended)["written"].text, name);
        EXPECT_GT(fs::file_size(folder / name), 10000U);
        fs::remove(folder / name);
    }
    const Words png = {"export", "a.h5", "--to", "png"};
    const auto refused = [&](const Words& more, const Words& parts) {
        Words words = png;
        words.insert(words.end(), more.begin(), more.end());
        expect_refused(words, parts);
    };
    refused({"--limit", "fell"}, {"fell", "collapse", "unseated"});
    refused({"--limit", "total"}, {"--limit total", "a.h5", "outcome.follow"});
    refused({"--limit", "rocked", "--picture", "strip"}, {"--limit rocked", "strip", "surface, slice"});
    refused({"--limit", "rocked", "--picture", "order"}, {"--limit rocked", "order"});
    refused({"--cell", "4"}, {"--cell 4", "0 to 3"});
    refused({"--cell", "-1"}, {"--cell", "-1"});
    refused({"--cell", "1", "--picture", "surface"}, {"--cell 1", "order"});
    refused({"--cell", "0"}, {"no block fell in 2 valid realizations"});
    expect_refused({"export", "a.h5", "--to", "csv", "--limit", "rocked"}, {"--limit rocked", "--to png"});
    expect_refused({"export", "a.h5", "--to", "csv", "--picture", "order"}, {"--picture order", "--to png"});
    expect_refused({"export", "a.h5", "--to", "csv", "--cell", "1"}, {"--cell 1", "--to png"});
}

TEST_F(Falls, NeedAFinishedRunAndCells)
{
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "real.h5"})).status, 0);
    ResultHeader header = ResultReader(folder / "real.h5").header();
    ResultWriter::create(folder / "begun.h5", header);
    expect_refused({"export", "begun.h5", "--to", "png", "--picture", "order"}, {"begun.h5", "not complete"});
    expect_refused({"export", "begun.h5", "--to", "png", "--limit", "rocked"}, {"begun.h5", "not complete"});
    ASSERT_EQ(run({"replay", "real.h5", "--realization", "2", "-o", "one.h5"}).status, 0);
    expect_refused({"export", "one.h5", "--to", "png", "--cell", "0"}, {"--cell 0", "replay", "no cells"});
    expect_refused({"export", "one.h5", "--to", "png", "--picture", "surface", "--limit", "slid"},
                   {"one.h5", "--picture surface", "replay", "strip, order"});
}

TEST_F(Falls, ReplayNamesItsBlocks)
{
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "a.h5"})).status, 0);
    const ResultReader reader(folder / "a.h5");
    const std::vector<ResultRow> rows = reader.rows();
    const auto collapsed = std::find_if(rows.begin(), rows.end(),
                                        [](const ResultRow& row) { return row.outcome.first_collapse_block >= 0; });
    ASSERT_NE(collapsed, rows.end());
    const std::string index = std::to_string(collapsed->index);
    const Ended ended = run({"replay", "a.h5", "--realization", index, "-o", "one.h5"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const std::string first = "drum " + std::to_string(collapsed->outcome.first_collapse_block + 1) + " first";
    EXPECT_NE(ended.out.find(first), std::string::npos) << ended.out;

    const JsonValue json = json_of(run({"replay", "a.h5", "--realization", index, "--json"}));
    std::vector<double> told(7, -1);
    double last = 0;
    for (const JsonValue& fall : json["falls"].items) {
        EXPECT_EQ(fall["name"].text, "drum " + std::to_string(static_cast<int>(fall["block"].number) + 1));
        EXPECT_GE(fall["time_s"].number, last) << "not in the order of the falls";
        last = fall["time_s"].number;
        told.at(static_cast<std::size_t>(fall["block"].number)) = last;
    }
    EXPECT_EQ(told, collapsed->outcome.fall_time_s);
    EXPECT_EQ(json["fallen_blocks"].number, collapsed->outcome.fallen_blocks);

    const Trajectory t = ResultReader(folder / "one.h5").trajectory(collapsed->index);
    EXPECT_EQ(t.name, reader.header().block_names);
    EXPECT_EQ(t.role, std::vector<BlockRole>(7, BlockRole::drum));
    EXPECT_EQ(t.column, std::vector<std::int32_t>(7, 0));
}

} // namespace
} // namespace stylobate
