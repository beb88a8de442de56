/// Twins: the same realization but for one thing; how fast they part; how often their verdicts differ, by pairs whose
/// truth is known.

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "ensemble/replicas/replicas.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "studies/kinds/replicas/discordance.hpp"
#include "studies/kinds/replicas/replicas.hpp"
#include "tests/ensemble/engine/outcome_bits.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

using namespace stylobate;

namespace {

const std::string input = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_column.toml";

Study replicas_study(const std::vector<std::string>& settings,
                     const std::string& frequencies = "{from=9.0,to=9.0,count=1}",
                     const std::string& pgas = "{from=9.0,to=9.0,count=1}", int realizations = 3)
{
    std::vector<std::string> all{"study.realizations=" + std::to_string(realizations),
                                 "surface.frequency_hz=" + frequencies, "surface.pga_m_s2=" + pgas};
    all.insert(all.end(), settings.begin(), settings.end());
    return read_study(input, all);
}

/// Every number of a block but its place.
std::vector<double> block_numbers(const Block& b)
{
    return {b.half_width_m, b.half_height_m, b.mass_kg, b.inertia_kg_m2, b.y_m, double(b.fixed), double(b.column)};
}
std::vector<double> joint_numbers(const Joint& j)
{
    return {double(j.lower),         double(j.upper),
            j.normal_stiffness_n_m2, j.tangential_stiffness_n_m,
            j.normal_damping_n_s_m,  j.tangential_damping_n_s_m,
            j.damping_chord_m,       j.friction};
}

/// Everything but the places of blocks and the step.
void expect_same(const Realization& a, const Realization& b)
{
    EXPECT_EQ(a.inputs, b.inputs);
    ASSERT_EQ(a.blocks.size(), b.blocks.size());
    for (std::size_t i = 0; i < a.blocks.size(); ++i) {
        EXPECT_EQ(block_numbers(a.blocks[i]), block_numbers(b.blocks[i])) << i;
        EXPECT_EQ(a.blocks[i].mechanisms, b.blocks[i].mechanisms);
    }
    ASSERT_EQ(a.joints.size(), b.joints.size());
    for (std::size_t i = 0; i < a.joints.size(); ++i) {
        EXPECT_EQ(joint_numbers(a.joints[i]), joint_numbers(b.joints[i])) << i;
        EXPECT_EQ(a.joints[i].mechanisms, b.joints[i].mechanisms);
    }
    EXPECT_EQ(a.base_tilt_rad, b.base_tilt_rad);
    EXPECT_EQ(a.frequency_hz, b.frequency_hz);
    EXPECT_EQ(a.pga_m_s2, b.pga_m_s2);
    EXPECT_EQ(a.phase_rad, b.phase_rad);
}

using Outcomes = std::map<std::uint64_t, std::vector<std::uint64_t>>;

/// All realizations of a study with twins, range by range.
Outcomes run(const Study& study, Isa isa, int threads)
{
    const Experiment experiment(study);
    Outcomes outcomes;
    for (const ReplicaRange& range : replica_ranges(study)) {
        std::vector<std::uint64_t> indices;
        for (std::uint64_t index = range.begin; index < range.end; ++index)
            indices.push_back(index);
        RunPlan plan;
        plan.total = indices.size();
        plan.indices = indices;
        plan.as = &range.study;
        plan.sink = [&](const Realization& r, const Outcome& o) { outcomes[r.index] = outcome_bits(o); };
        Observer observer;
        run_ensemble(experiment, {isa, threads}, plan, observer);
    }
    return outcomes;
}

Outcomes run_plain(const Study& study)
{
    Outcomes outcomes;
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) { outcomes[r.index] = outcome_bits(o); };
    Observer observer;
    run_ensemble(Experiment(study), {best_isa(), 2}, plan, observer);
    return outcomes;
}

std::vector<ReplicaSeparation> follow(const Study& study, Isa isa = best_isa(), int threads = 2)
{
    Observer observer;
    return replica_separations(Experiment(study), {isa, threads}, observer);
}

std::vector<std::uint64_t> bits(const std::vector<ReplicaSeparation>& pairs)
{
    std::vector<std::uint64_t> all;
    for (const ReplicaSeparation& p : pairs) {
        all.insert(all.end(), {p.original, p.kind});
        for (const double v : {p.start, p.exponent_per_s, p.horizon_s, p.followed_s, p.original_end_s})
            all.push_back(std::bit_cast<std::uint64_t>(v));
    }
    return all;
}

TEST(Replicas, EachDiffersFromItsOriginalInOneThingAlone)
{
    const Study study = replicas_study({"twins.moves_m=[1e-12, 1e-3]", "twins.block=4"});
    ASSERT_EQ(study.replicas->kinds.size(), 6U);
    const std::uint64_t n = study.originals();
    EXPECT_EQ(study.total(), 7 * n);
    const Sampler sampler(study, nullptr);
    const Experiment plain_experiment(replicas_study({}));
    const Sampler& plain = plain_experiment.sampler();
    const Experiment two_corner_experiment(replicas_study({"contact.form=\"two_corner\""}));
    const Sampler& two_corner = two_corner_experiment.sampler();
    const Experiment points_experiment(replicas_study({"contact.form=\"points\""}));
    const Sampler& points = points_experiment.sampler();
    for (std::uint64_t i = 0; i < n; ++i) {
        const Realization original = sampler.realization(i);
        expect_same(original, plain.realization(i));
        for (std::uint64_t kind = 0; kind < 6; ++kind) {
            const std::uint64_t index = (kind + 1) * n + i;
            const Realization replica = sampler.realization(index);
            EXPECT_EQ(replica.index, index);
            EXPECT_EQ(study.original(index), i);
            EXPECT_EQ(study.cell(index), study.cell(i));
            const bool form = kind >= 4;
            expect_same(replica, kind == 4 ? two_corner.realization(i) : kind == 5 ? points.realization(i) : original);
            for (std::size_t b = 0; b < replica.blocks.size(); ++b) {
                const double move = kind == 0 ? 1e-12 : kind == 1 ? 1e-3 : 0;
                EXPECT_EQ(replica.blocks[b].x_m, original.blocks[b].x_m + (b == 4 ? move : 0));
            }
            EXPECT_EQ(replica.form, kind == 4   ? ContactForm::two_corner
                                    : kind == 5 ? ContactForm::points
                                                : ContactForm::area);
            if (!form) {
                EXPECT_EQ(replica.step_s, kind == 2 ? 0.8 * original.step_s : original.step_s) << kind;
            }
        }
    }
}

TEST(Replicas, AnExperimentIsTheSameWhereverItLies)
{
    const Study study = replicas_study({"twins.moves_m=[1e-3]", "twins.block=4"});
    std::vector<Experiment> moved;
    moved.emplace_back(study);
    const Sampler& sampler = moved.front().sampler();
    moved.emplace_back(std::move(moved.front())); // and the vector grows
    moved.emplace_back(moved.back());
    EXPECT_EQ(&moved.back().sampler(), &sampler);
    EXPECT_EQ(&moved.back().study(), &moved[1].study());
    moved.erase(moved.begin(), moved.begin() + 2);
    const Experiment fresh(study);
    for (std::uint64_t i = 0; i < study.total(); ++i) { // those in other forms have studies of their own
        expect_same(sampler.realization(i), fresh.sampler().realization(i));
        EXPECT_EQ(sampler.realization(i).step_s, fresh.sampler().realization(i).step_s);
    }
}

TEST(Replicas, MovedByNothingTheyAreEqualToTheLastBit)
{
    const Study study =
        replicas_study({"twins.moves_m=[0]", "twins.step_ratio=1", "twins.precision=false", "twins.forms=false"},
                       "{from=6.0,to=9.0,count=2}", "{from=6.0,to=9.0,count=2}");
    ASSERT_EQ(study.replicas->kinds.size(), 1U);
    const Outcomes outcomes = run(study, best_isa(), 2);
    ASSERT_EQ(outcomes.size(), study.total());
    for (std::uint64_t i = 0; i < study.originals(); ++i)
        EXPECT_EQ(outcomes.at(i), outcomes.at(study.originals() + i)) << i;
    const std::vector<ReplicaSeparation> pairs = follow(study);
    ASSERT_EQ(pairs.size(), study.originals());
    for (const ReplicaSeparation& pair : pairs) {
        EXPECT_EQ(pair.start, 0);
        EXPECT_TRUE(std::isnan(pair.exponent_per_s));
        EXPECT_TRUE(std::isnan(pair.horizon_s));
        EXPECT_EQ(pair.followed_s, pair.original_end_s);
    }
}

TEST(Replicas, ThoseOfTheNumericsAreTheStudiesThatRunSo)
{
    const Study study = replicas_study({"twins.moves_m=[1e-9]", "twins.step_ratio=0.5"});
    const Outcomes outcomes = run(study, best_isa(), 2);
    const std::uint64_t n = study.originals();
    const auto expect_kind = [&](std::uint64_t kind, const std::vector<std::string>& settings) {
        const Outcomes want = run_plain(replicas_study(settings));
        ASSERT_EQ(want.size(), n);
        for (std::uint64_t i = 0; i < n; ++i)
            EXPECT_EQ(outcomes.at(kind * n + i), want.at(i)) << settings[0] << ' ' << i;
    };
    expect_kind(0, {"study.seed=1"});
    expect_kind(2, {"run.step_fraction=0.45"}); // half of 0.9 to the last bit
    expect_kind(3, {"run.precision=\"single\""});
    expect_kind(4, {"contact.form=\"two_corner\""});
    expect_kind(5, {"contact.form=\"points\""});
}

TEST(Replicas, TheSameBitsOnEveryInstructionSetAndNumberOfThreads)
{
    const Study study = replicas_study({"twins.moves_m=[1e-12, 1e-6]", "excitation.cycles=5"},
                                       "{from=4.0,to=9.0,count=2}", "{from=9.0,to=9.0,count=1}");
    const Outcomes outcomes = run(study, Isa::scalar, 1);
    const std::vector<std::uint64_t> pairs = bits(follow(study, Isa::scalar, 1));
    ASSERT_EQ(pairs.size(), 7 * 2 * study.originals());
    for (const Isa isa : usable_isas())
        for (const int threads : {1, 3}) {
            EXPECT_EQ(run(study, isa, threads), outcomes) << to_string(isa) << ' ' << threads;
            EXPECT_EQ(bits(follow(study, isa, threads)), pairs) << to_string(isa) << ' ' << threads;
        }
}

TEST(Replicas, AStandingColumnKeepsThemAsTheyAre)
{
    // far below what opens a joint: nothing grows, and no verdict differs
    const Study study = replicas_study({"twins.moves_m=[1e-12, 1e-6]", "twins.forms=false"},
                                       "{from=1.0,to=2.0,count=2}", "{from=0.2,to=0.2,count=1}");
    const Outcomes outcomes = run(study, best_isa(), 2);
    for (const auto& [index, outcome] : outcomes)
        EXPECT_EQ(outcome[0], static_cast<std::uint64_t>(State::stood)) << index;
    for (const ReplicaSeparation& pair : follow(study)) {
        EXPECT_TRUE(std::isnan(pair.horizon_s));
        EXPECT_TRUE(std::isnan(pair.exponent_per_s)) << "it never leaves its place";
    }
}

TEST(Replicas, ABlockOnAWideFloorIsTheSameWhereverItStands)
{
    // whatever it does there, rocking and sliding included, the twin does it a little to the right: nothing grows
    const std::string floor_and_block =
        "structure={drums=[{width_m=1.0,height_m=0.05,mass_kg=10},{width_m=0.048,height_m=0.12,mass_kg=0.56}],"
        "fixed_blocks=1,depth_m=0.048,kind=\"column\"}";
    const Study study = replicas_study(
        {floor_and_block, "twins.moves_m=[1e-6]", "twins.step_ratio=1", "twins.precision=false", "twins.forms=false"},
        "{from=6.0,to=6.0,count=1}", "{from=7.0,to=7.0,count=1}", 4);
    const std::vector<ReplicaSeparation> pairs = follow(study);
    ASSERT_EQ(pairs.size(), 4U);
    int slopes = 0;
    for (const ReplicaSeparation& pair : pairs) {
        EXPECT_NEAR(pair.start, 1e-6 / 0.048, 0.02 * pair.start); // widths are drawn
        EXPECT_TRUE(std::isnan(pair.horizon_s));
        if (!std::isnan(pair.exponent_per_s)) {
            ++slopes;
            EXPECT_LT(std::fabs(pair.exponent_per_s), 0.05);
        }
    }
    EXPECT_GT(slopes, 0) << "it moves";
}

TEST(Replicas, WhereItIsChaoticTheHorizonGrowsWithTheLogarithmOfTheMove)
{
    const Study study = replicas_study({"twins.moves_m=[1e-15, 1e-12, 1e-9]", "twins.followed=24"},
                                       "{from=9.0,to=9.0,count=1}", "{from=10.0,to=10.0,count=1}", 24);
    std::vector<double> gains, exponents;
    std::map<std::uint64_t, double> before;
    for (const ReplicaSeparation& pair : follow(study)) {
        if (pair.kind > 0)
            gains.push_back(before.at(pair.original) - pair.horizon_s);
        if (pair.kind == 0)
            exponents.push_back(pair.exponent_per_s);
        before[pair.original] = pair.horizon_s;
    }
    const Estimated gain = estimated_mean(gains), exponent = estimated_mean(exponents);
    ASSERT_GT(gain.count, 20U);
    EXPECT_GT(gain.lower, 0) << "the smaller the move, the longer it can be foretold";
    EXPECT_GT(exponent.lower, 1) << "1/s";
    // two ways to the same exponent: the slope in time, and what a thousandth of the move gains
    const double of_gain = std::log(1e3) / gain.value;
    EXPECT_LT(std::fabs(std::log(of_gain / exponent.value)), std::log(2.0)) << of_gain << ' ' << exponent.value;
}

TEST(Replicas, MovesAreAtMostAQuarterOfTheDrumsWidth)
{
    const auto moves = [](const std::string& width_m) {
        const Study study = replicas_study(
            {"twins.step_ratio=1", "twins.precision=false", "twins.forms=false", "structure.drum_width_m=" + width_m});
        EXPECT_EQ(parse_study(study.text, "again").text, study.text);
        std::vector<double> sizes;
        for (const auto& kind : study.replicas->kinds)
            sizes.push_back(kind.size);
        return sizes;
    };
    EXPECT_EQ(moves("0.004"), (std::vector<double>{1e-12, 1e-9, 1e-6, 1e-3}));
    EXPECT_EQ(moves("0.0039"), (std::vector<double>{1e-12, 1e-9, 1e-6}));
    EXPECT_THROW(moves("3e-12"), InputError);
    EXPECT_THROW(replicas_study({"twins.moves_m=[1e-3]", "structure.drum_width_m=0.0039"}), InputError);
}

TEST(Replicas, TheStudysTextTellsAllOfThem)
{
    const Study base = replicas_study({"twins.moves_m=[0, 3e-7]", "twins.step_ratio=0.7", "twins.precision=false",
                                       "twins.followed=1", "twins.tolerance=0.03", "twins.block=2"});
    const Study again = parse_study(base.text, "again");
    EXPECT_EQ(again.text, base.text);
    EXPECT_EQ(again.replicas->kinds, base.replicas->kinds);
    EXPECT_EQ(again.replicas->block, 2);
    EXPECT_EQ(again.replicas->followed, 1U);
    EXPECT_EQ(again.replicas->tolerance, 0.03);
    const std::vector<std::function<void(ReplicasSpec&)>> changes = {
        [](ReplicasSpec& t) { t.kinds[1].size = 4e-7; },
        [](ReplicasSpec& t) { t.kinds[2].size = 0.71; },
        [](ReplicasSpec& t) { t.kinds.pop_back(), t.kinds.pop_back(); },
        [](ReplicasSpec& t) {
            t.kinds.insert(t.kinds.begin() + 3, {ReplicaBy::precision, 0, ContactForm::area});
        },
        [](ReplicasSpec& t) { t.block = 3; },
        [](ReplicasSpec& t) { t.followed = 0; },
        [](ReplicasSpec& t) { t.tolerance = 0.02; }};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Study changed = base;
        changes[i](*changed.replicas);
        EXPECT_NE(study_text(changed), base.text) << i;
    }
    EXPECT_NE(replicas_study({}).text, base.text);
}

TEST(Slope, IsThatOfTheNormalEquations)
{
    std::mt19937_64 random(3);
    std::normal_distribution<double> noise;
    Slope slope;
    double n = 0, t = 0, y = 0, tt = 0, ty = 0;
    EXPECT_TRUE(std::isnan(slope.value()));
    for (int i = 0; i < 40; ++i) {
        const double ti = 5 + 0.1 * i, yi = 3 * ti - 7 + noise(random);
        slope.add(ti, yi);
        n += 1, t += ti, y += yi, tt += ti * ti, ty += ti * yi;
    }
    EXPECT_NEAR(slope.value(), (n * ty - t * y) / (n * tt - t * t), 1e-9);
}

TEST(Discordance, SharesByHand)
{
    const DiscordantShare share = discordant_share({.neither = 3, .original = 1, .replica = 2, .both = 4});
    EXPECT_EQ(share.trials, 10U);
    EXPECT_EQ(share.discordant, 3U);
    EXPECT_DOUBLE_EQ(share.probability, 0.3);
    // 5 originals and 6 twins collapsed: 5 x 4 + 5 x 6 of 100 comparisons differ, 3 of these within a pair
    EXPECT_DOUBLE_EQ(share.independent, 47.0 / 90);
    EXPECT_FALSE(share.verdict());
    EXPECT_EQ(discordant_share({.neither = 1000}).verdict(), Sureness::certain);
    EXPECT_EQ(discordant_share({.neither = 500, .original = 500}).verdict(), Sureness::coin_flip);
    EXPECT_FALSE(discordant_share({}).verdict());
    // eight pairs of which none differs: the share may be a quarter
    EXPECT_FALSE(discordant_share({.neither = 8}).verdict());
    EXPECT_GT(discordant_share({.neither = 8}).upper, 0.25);
    EXPECT_FALSE(discordant_share({.neither = fewest_pairs() - 1}).verdict());
    EXPECT_EQ(discordant_share({.neither = fewest_pairs()}).verdict(), Sureness::certain);
    // the 97.5 % point of Beta(1/2, n + 1/2) is about 5.0239 / 2 / n, half the point of chi-square of one degree
    EXPECT_NEAR(static_cast<double>(fewest_pairs()), 5.0239 / 2 / 0.05, 2);
    EXPECT_TRUE(std::isnan(discordant_share({}).probability));
    EXPECT_EQ(sureness(0.049), Sureness::certain);
    EXPECT_EQ(sureness(0.05), Sureness::probable);
    EXPECT_EQ(sureness(0.25), Sureness::probable);
    EXPECT_EQ(sureness(0.26), Sureness::coin_flip);
}

/// Pairs of a cell where the twin is, with probability `decided`, a realization of its own, else the original again.
PairCounts simulated(std::mt19937_64& random, double p, double decided, int pairs)
{
    std::bernoulli_distribution collapses(p), own(decided);
    PairCounts c;
    for (int i = 0; i < pairs; ++i) {
        const bool a = collapses(random), b = own(random) ? collapses(random) : a;
        ++(a && b ? c.both : a ? c.original : b ? c.replica : c.neither);
    }
    return c;
}

TEST(Discordance, TheRatioIsTheShareThatTwinsDoNotHaveInCommon)
{
    // 600 simulated surfaces: 24 cells of 16 pairs. The interval of 95 % misses the truth in 30 of them on average;
    // more than 55, or fewer than 12, come by chance once in 10^5.
    std::mt19937_64 random(11);
    for (const double truth : {0.1, 0.5, 1.0}) {
        int missed = 0;
        double mean = 0, independent = 0, wanted = 0;
        constexpr int surfaces = 600, cells = 24;
        for (int s = 0; s < surfaces; ++s) {
            std::vector<PairCounts> counts;
            for (int c = 0; c < cells; ++c) {
                const double p = (c + 0.5) / cells;
                counts.push_back(simulated(random, p, truth, 16));
                independent += discordant_share(counts.back()).independent;
                wanted += 2 * p * (1 - p);
            }
            const DiscordanceRatio ratio = discordance_ratio(counts);
            mean += ratio.ratio / surfaces;
            missed += truth < ratio.lower || truth > ratio.upper;
        }
        EXPECT_NEAR(independent / wanted, 1, 0.01) << "without bias";
        EXPECT_NEAR(mean, truth, 0.01 * (1 + truth));
        EXPECT_LE(missed, 55) << truth;
        EXPECT_GE(missed, 12) << truth;
    }
}

/// Two cells pair by pair: what a pair adds is its own discordance less the ratio times the share of all pairs of its
/// cell that differ from either of its members.
TEST(Discordance, IntervalOfTheRatioByHand)
{
    const std::vector<PairCounts> cells = {{.neither = 4, .original = 1, .replica = 2, .both = 3},
                                           {.neither = 2, .original = 2, .replica = 1, .both = 3}};
    const DiscordanceRatio found = discordance_ratio(cells);
    // 47 of 90 comparisons of different pairs differ in the first cell (as above), 5 x 4 + 3 x 4 - 3 of 56 in the
    // second
    const double independent = 10 * 47.0 / 90 + 8 * 29.0 / 56, ratio = 6 / independent;
    EXPECT_NEAR(found.ratio, ratio, 1e-12);
    EXPECT_NEAR(found.all.independent, independent / 18, 1e-12);
    double variance = 0;
    for (const PairCounts& c : cells) {
        std::vector<std::pair<int, int>> pairs;
        pairs.insert(pairs.end(), c.neither, {0, 0});
        pairs.insert(pairs.end(), c.original, {1, 0});
        pairs.insert(pairs.end(), c.replica, {0, 1});
        pairs.insert(pairs.end(), c.both, {1, 1});
        const auto n = static_cast<double>(pairs.size());
        double sum = 0, squares = 0;
        for (const auto& [a, b] : pairs) {
            double differ = 0;
            for (const auto& [other_a, other_b] : pairs)
                differ += (a != other_b) + (other_a != b);
            const double adds = (a != b) - ratio * differ / n;
            sum += adds;
            squares += adds * adds;
        }
        variance += (squares - sum * sum / n) * n / (n - 1);
    }
    const double half = 1.959963984540054 * std::sqrt(variance) / independent;
    EXPECT_NEAR(found.upper, ratio + half, 1e-12);
    EXPECT_NEAR(found.lower, ratio - half, 1e-12);
    EXPECT_GT(found.lower, 0);
}

/// Twins moved by 1e-9 and 1e-6 m: of three originals both kinds came apart, 2, 3 and 4 s later after the smaller move.
TEST(Growth, GainOfASmallerMoveByHand)
{
    const Study study = replicas_study({"twins.moves_m=[1e-9, 1e-6]"});
    const double late[] = {5, 7, 9}, early[] = {3, 4, 5};
    std::vector<ReplicaSeparation> pairs;
    for (std::uint64_t i = 0; i < 3; ++i) {
        pairs.push_back({i, 0, 1e-9, 2.0 + static_cast<double>(i), late[i], 10, 10});
        pairs.push_back({i, 1, 1e-6, 3, early[i], 10, 10});
    }
    const Replicas found = replicas_of(study, {}, {}, pairs);
    ASSERT_EQ(found.growth.size(), 2U);
    EXPECT_EQ(found.growth[0].pairs_lost, 3U);
    EXPECT_NEAR(found.growth[0].gained_s.value, 3, 1e-12);
    EXPECT_NEAR(found.growth[0].gained_s.upper - 3, 4.302653 / std::sqrt(3.0), 1e-5); // as of 1, 2, 3 below
    EXPECT_NEAR(found.growth[0].gained_exponent_per_s, std::log(1000) / 3, 1e-12);
    EXPECT_TRUE(std::isnan(found.growth[1].gained_exponent_per_s));
    EXPECT_NEAR(found.growth[0].exponent_per_s[0].value, 3, 1e-12);
    EXPECT_EQ(found.growth[0].all_horizons_s.value, 7);
}

TEST(Discordance, WhereNoPairIsDiscordantTheRatioHasAnUpperLimit)
{
    const DiscordanceRatio none = discordance_ratio({{.neither = 10, .both = 10}, {.neither = 5, .both = 15}});
    EXPECT_EQ(none.ratio, 0);
    EXPECT_EQ(none.lower, 0);
    EXPECT_GT(none.upper, 0.02);
    EXPECT_LT(none.upper, 0.3);
    EXPECT_TRUE(std::isnan(discordance_ratio({{.neither = 20}}).ratio)) << "no pair differs";
    EXPECT_TRUE(std::isnan(discordance_ratio({}).ratio));
}

TEST(Growth, MeansAndMedians)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const Estimated mean = estimated_mean({1, nan, 2, 3});
    EXPECT_EQ(mean.count, 3U);
    EXPECT_DOUBLE_EQ(mean.value, 2);
    EXPECT_NEAR(mean.upper - 2, 4.302653 / std::sqrt(3.0), 1e-5); // Student's quantile of two degrees of freedom
    EXPECT_EQ(estimated_mean({4}).lower, -infinity);
    EXPECT_TRUE(std::isnan(estimated_mean({nan}).value));
    // nine values: the second and the eighth hold the median in 1 - 2 (1 + 9) / 512 = 96 %, the third and the seventh
    // in 82 %
    const Estimated median = estimated_median({9, 1, 2, 8, 3, 7, infinity, 5, 6});
    EXPECT_EQ(median.value, 6);
    EXPECT_EQ(median.lower, 2);
    EXPECT_EQ(median.upper, 9);
    EXPECT_EQ(estimated_median({1, infinity, infinity}).value, infinity);
    EXPECT_EQ(estimated_median({1, 2}).value, 1.5);
    EXPECT_TRUE(std::isnan(estimated_median({}).value));
}

} // namespace
