/// Survival studies: several events in succession, the final state of a realization, and the counts of the rows.

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/survival/combined_past.hpp"
#include "studies/kinds/survival/survival.hpp"
#include "studies/kinds/survival/survival_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

namespace stylobate {
namespace {

/// A squat block that slides and does not rock.
std::string squat(const std::string& excitation, const std::string& survival)
{
    return "[study]\nkind = \"survival\"\nrealizations = 2\n"
           "[structure]\nblocks = 1\ndrum_width_m = 1.0\ndrum_height_m = 0.2\ndepth_m = 1.0\ndensity_kg_m3 = 2700\n"
           "[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.2\n[excitation]\n" +
           excitation +
           "\n[surface]\nfrequency_hz = { from = 1, to = 2, count = 2 }\npga_m_s2 = { from = 3, to = 5, count = 3 }\n"
           "[survival]\nevents = 3\npause_s = 2\n" +
           survival + "\n";
}

TEST(Survival, SeveralEventsAreOneAfterTheOther)
{
    for (const std::string kind : {"harmonic", "half_sine", "full_sine", "ricker", "pulse", "tapered"}) {
        const Study study = parse_study(squat("kind = \"" + kind + "\"", ""), kind);
        ASSERT_EQ(study.total(), 3U * 6 * 2);
        ASSERT_EQ(study.originals(), 12U);
        const Sampler sampler(study, nullptr);
        const std::uint64_t index = 7, later = index + 2 * study.originals();
        EXPECT_EQ(study.design().events_of(index), 1);
        EXPECT_EQ(study.design().events_of(later), 3);
        EXPECT_EQ(study.cell(later), study.cell(index));
        const Realization one = sampler.realization(index), three = sampler.realization(later);
        EXPECT_EQ(one.pga_m_s2, three.pga_m_s2);
        const BaseMotion a(study.excitation, one, nullptr), b(study.excitation, three, nullptr);
        const double T = a.duration_s(), period = (b.duration_s() - T) / 2;
        EXPECT_NEAR(period, T + 2, 0.02) << kind; // and at most two samples
        double peak = 0;
        for (int i = 0; i <= 100; ++i)
            peak = std::max(peak, std::fabs(a.displacement_m(T * i / 100)));
        // a half sine leaves the ground in motion: at the velocity v after the first, 2 v after the second
        const double v = a.displacement_m(T + 1) - a.displacement_m(T), end = a.displacement_m(T) - v * T;
        for (int event = 0; event < 3; ++event)
            for (int i = 0; i <= 50; ++i) {
                const double t = T * i / 50, at = event * period + t;
                double expected = a.displacement_m(t);
                for (int before = 0; before < event; ++before)
                    expected += end + v * (at - before * period);
                EXPECT_NEAR(b.displacement_m(at), expected, 3e-3 * peak) << kind << ' ' << event << ' ' << i;
            }
    }
}

TEST(Survival, NoiseIsDrawnAnewForEachEvent)
{
    const Study study = parse_study(squat("kind = \"noise\"\nstrong_s = 2", ""), "noise");
    const Sampler sampler(study, nullptr);
    const Realization two = sampler.realization(study.originals()), one = sampler.realization(0);
    ASSERT_TRUE(two.motion && one.motion);
    const std::vector<double>& a = two.motion->acceleration_m_s2;
    const std::size_t n = one.motion->acceleration_m_s2.size(), second = a.size() - n;
    EXPECT_NE(std::vector<double>(a.begin(), a.begin() + 100),
              std::vector<double>(a.begin() + static_cast<std::ptrdiff_t>(second),
                                  a.begin() + static_cast<std::ptrdiff_t>(second + 100)));
    for (const auto& [from, to] : {std::pair{std::size_t{0}, n}, std::pair{second, a.size()}}) {
        double peak = 0;
        for (std::size_t i = from; i < to; ++i)
            peak = std::max(peak, std::fabs(a[i]));
        EXPECT_NEAR(peak, two.pga_m_s2, 1e-9) << "each is as strong";
    }
}

TEST(Survival, ABlockThatSlidesUnderOneEventSlidesTwiceAndThriceAsFarUnderTwoAndThree)
{
    const Study study = parse_study(squat("kind = \"full_sine\"", "observed = { tolerance_m = 0.001 }"), "squat");
    const Experiment experiment(study);
    std::vector<double> offset;
    for (std::uint64_t events = 0; events < 3; ++events) {
        const TracedRealization f = trace(experiment, 2 * 2 + events * study.originals(), Isa::scalar);
        ASSERT_EQ(f.outcome.bed_offset_m.size(), 1U);
        ASSERT_EQ(f.outcome.rotation_rad.size(), 1U);
        offset.push_back(f.outcome.bed_offset_m[0]);
        // what the trajectory shows
        const double moved = f.trajectory["x_m"].back() - f.trajectory["x_m"].front();
        EXPECT_NEAR(offset.back(), moved, 2e-5);
        EXPECT_NEAR(f.outcome.rotation_rad[0], 0, 1e-6);
        EXPECT_EQ(std::fabs(offset.back()), f.outcome.residual_sliding_m);
    }
    EXPECT_GT(std::fabs(offset[0]), 0.02);
    EXPECT_NEAR(offset[1], 2 * offset[0], 0.01 * std::fabs(offset[0]));
    EXPECT_NEAR(offset[2], 3 * offset[0], 0.015 * std::fabs(offset[0]));
    // another kind does not have it
    const Study plain = parse_study(squat("kind = \"full_sine\"", ""), "squat", {"study.kind=survival"});
    EXPECT_FALSE(trace(Experiment(plain), 0, Isa::scalar).outcome.bed_offset_m.empty());
}

/// A monument that was measured is at rest; that it stands is known without waiting.
TEST(Survival, AnObservedStateIsComparedWithStatesAtRest)
{
    const auto tail = [](const std::string& observed, const std::vector<std::string>& settings) {
        return parse_study(squat("kind = \"full_sine\"", observed), "squat", settings).excitation.tail;
    };
    const std::string observed = "observed = { tolerance_m = 0.001 }";
    EXPECT_EQ(tail(observed, {}), Tail::rest);
    EXPECT_EQ(tail(observed, {"excitation.tail_s=\"structure\""}), Tail::structure);
    EXPECT_EQ(tail("", {}), Tail::structure);
}

/// Rows of known outcomes: of the cells of three intensities 10, 5 and 0 of 10 stand, with offsets that are their
/// number in the cell in mm.
std::vector<ResultRow> made_rows(const Study& study)
{
    std::vector<ResultRow> rows;
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        ResultRow row;
        row.index = i;
        row.cell = study.cell(i);
        const std::uint64_t number = i % 10, stand = row.cell % 3 == 0 ? 10 : row.cell % 3 == 1 ? 5 : 0;
        row.outcome.state = number < stand ? State::slid : State::collapsed;
        row.outcome.at_rest = number != 4;
        row.outcome.bed_offset_m = {0.001 * static_cast<double>(number)};
        row.outcome.rotation_rad = {0};
        rows.push_back(row);
    }
    return rows;
}

Study made_study(const std::string& observed)
{
    return parse_study(squat("kind = \"full_sine\"", observed), "made",
                       {"study.realizations=10", "survival.events=2", "survival.monuments=20"});
}

ResultHeader header_of(const Study& study)
{
    ResultHeader header;
    header.kind = "survival";
    header.block_names = {"drum"};
    header.bed_names = {"drum on the ground"};
    header.frequency_hz = {1, 2};
    header.pga_m_s2 = {3, 4, 5};
    header.total = study.total();
    return header;
}

TEST(Survival, CountsAreThoseOfTheRowsInAnyOrder)
{
    const Study study = made_study("observed = { joint_offset_m = [0.003], tolerance_m = 0.0011, mirrored = true }");
    const ResultHeader header = header_of(study);
    std::vector<ResultRow> rows = made_rows(study);
    SurvivalCounts counts(study, header);
    for (const ResultRow& row : rows)
        counts.add(row);
    const std::vector<std::uint64_t> agree = counts.sums(&MotionTally::agree), stand = counts.sums(&MotionTally::stand);
    EXPECT_EQ(counts.sums(&MotionTally::valid), std::vector<std::uint64_t>(12, 10));
    for (std::size_t cell = 0; cell < 12; ++cell) {
        // 2, 3 and 4 mm agree, wherever they stand
        EXPECT_EQ(agree[cell], cell % 3 == 2 ? 0U : 3U) << cell;
        EXPECT_EQ(stand[cell], cell % 3 == 0 ? 10U : cell % 3 == 1 ? 5U : 0U);
    }
    EXPECT_EQ(counts.moving(), 8U) << "those of 4 mm in the eight cells with any that stand";
    ASSERT_TRUE(counts.nearest());
    EXPECT_EQ(counts.nearest()->index, 3U);
    EXPECT_NEAR(counts.nearest()->distance, 0, 1e-12);
    const std::string json = survival_json(survival_of(study, counts)).text();
    std::shuffle(rows.begin(), rows.end(), std::mt19937_64(4));
    SurvivalCounts shuffled(study, header);
    for (const ResultRow& row : rows)
        shuffled.add(row);
    EXPECT_EQ(survival_json(survival_of(study, shuffled)).text(), json);
}

/// A fixed block does not turn: the observed rotations are those of the free blocks, from bottom to top.
TEST(Survival, ObservedRotationsAreOfTheFreeBlocks)
{
    const Study study = parse_study(squat("kind = \"full_sine\"", "observed = { joints = [0], joint_offset_m = [0], "
                                                                  "tolerance_m = 1, rotation_rad = [0.02, -0.03], "
                                                                  "rotation_tolerance_rad = 0.001 }"),
                                    "fixed", {"structure.blocks=3", "structure.fixed_blocks=1"});
    const Outcome simulated = trace(Experiment(study), 0, Isa::scalar).outcome;
    ASSERT_EQ(simulated.rotation_rad.size(), 3U) << "an outcome has the fixed block too";
    SurvivalCounts counts(study, header_of(study));
    ASSERT_EQ(counts.names().size(), 3U) << "one joint, two free blocks";
    EXPECT_EQ(counts.names()[1], "rotation of drum 2 [rad]") << "drum 1 is fixed";
    EXPECT_EQ(counts.names()[2], "rotation of drum 3 [rad]");
    const auto agrees = [&](const std::vector<double>& rotation) {
        const std::uint64_t before = counts.sums(&MotionTally::agree)[0];
        ResultRow row;
        row.outcome = simulated;
        row.outcome.state = State::slid;
        row.outcome.rotation_rad = rotation;
        counts.add(row);
        return counts.sums(&MotionTally::agree)[0] > before;
    };
    EXPECT_TRUE(agrees({0, 0.02, -0.03}));
    EXPECT_TRUE(agrees({0.5, 0.0205, -0.0295})) << "what the fixed block has is not compared";
    EXPECT_FALSE(agrees({0.02, -0.03, 0}));
    EXPECT_FALSE(agrees({0, 0.022, -0.03})) << "two tolerances away";
}

/// Two columns of one drum and an epistyle: joints are those of both drums and both seats.
std::string colonnade(const std::string& columns, const std::string& survival)
{
    return "[study]\nkind = \"survival\"\nrealizations = 2\n"
           "[structure]\nkind = \"colonnade\"\n" +
           columns +
           "\nblocks = 1\ndrum_width_m = "
           "0.06\ndrum_height_m = 0.1\ndrum_mass_kg = 0.75\ndepth_m = 0.06\nepistyle_height_m = 0.06\n"
           "epistyle_mass_kg = 1.14\n[contact]\nnormal_stiffness_n_m2 = 1e8\nfriction = 0.68\n[excitation]\nkind = "
           "\"full_sine\"\n[surface]\n"
           "frequency_hz = { from = 1, to = 2, count = 2 }\npga_m_s2 = { from = 3, to = 5, count = 3 }\n[survival]\n" +
           survival + "\n";
}

TEST(Survival, OfAColonnadeTheMirrorImageHasTheOtherColumnsState)
{
    const std::string observed = "observed = { joints = [0], joint_offset_m = [0.003], rotation_rad = [0, 0.1, 0], "
                                 "tolerance_m = 0.001, rotation_tolerance_rad = 0.01, mirrored = true }";
    const Study study = parse_study(colonnade("columns = 2\ncolumn_spacing_m = 0.09", observed), "colonnade");
    ResultHeader header = header_of(study);
    header.bed_names = {"left", "right", "left seat", "right seat"};
    SurvivalCounts counts(study, header);
    const auto agrees = [&](std::vector<double> offset, std::vector<double> rotation) {
        const auto sum = [&] {
            const std::vector<std::uint64_t> all = counts.sums(&MotionTally::agree);
            return std::accumulate(all.begin(), all.end(), std::uint64_t{0});
        };
        const std::uint64_t before = sum();
        ResultRow row;
        row.outcome.state = State::slid;
        row.outcome.bed_offset_m = std::move(offset);
        row.outcome.rotation_rad = std::move(rotation);
        counts.add(row);
        return sum() > before;
    };
    EXPECT_TRUE(agrees({0.003, 0.5, 0.5, 0.5}, {0, 0.1, 0}));
    EXPECT_TRUE(agrees({0.5, -0.003, 0.5, 0.5}, {-0.1, 0, 0})) << "from behind";
    EXPECT_FALSE(agrees({-0.003, 0.5, 0.5, 0.5}, {0, -0.1, 0})) << "the columns do not change places";
    EXPECT_FALSE(agrees({0.5, 0.003, 0.5, 0.5}, {-0.1, 0, 0}));
    // the states that the simulated monuments are of hold both
    EXPECT_EQ(counts.standing().front().value.size(), 5U) << "one joint of each column, and three blocks";
    try {
        parse_study(colonnade("column_list = [ { x_m = -0.045 }, { x_m = 0.045, drum_width_m = 0.05 } ]", observed),
                    "uneven");
        ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("mirrored = true needs a structure that is its own mirror image"),
                  std::string::npos)
            << error.what();
    }
}

/// Densities over the logarithm of the PGA.
TEST(Survival, PriorsAreDensitiesOverTheLogarithm)
{
    const auto ratio = [](const std::string& prior, const std::string& hazard) {
        const PriorDensity density = prior_density(*made_study("prior = \"" + prior + "\"\n" + hazard).survival);
        return density(4) / density(2);
    };
    EXPECT_EQ(ratio("log_uniform", ""), 1);
    EXPECT_EQ(ratio("uniform", ""), 2);
    EXPECT_NEAR(ratio("hazard", "hazard = { k0_per_year = 0.1, k = 2.5, sigma_ln = 1 }"), std::pow(2, -2.5), 1e-12);
    // points: k is 1 up to 3 m/s2 and 3 beyond
    EXPECT_NEAR(ratio("hazard", "hazard = { intensity_m_s2 = [1.5, 3, 6], rate_per_year = [0.1, 0.05, 0.00625], "
                                "sigma_ln = 1 }"),
                3 * 0.05 * std::pow(4.0 / 3, -3) / (0.1 * 1.5 / 2), 1e-12);
}

/// Likelihoods and rates of made rows by hand. Of 10 realizations in each cell those of 1 Hz agree in 10, 5 and 0 with
/// one event, those of 2 Hz in 5, 0 and 0; with two events half as many rounded down. Means over the two frequencies
/// have (k + 1/4) / (n + 1/2) of each cell, single frequencies Jeffreys' (k + 1/2) / (n + 1) (past_likelihood.hpp).
TEST(Survival, LikelihoodsAndRatesAreThoseOfTheCountsByHand)
{
    const std::uint64_t stand[2][6] = {{10, 5, 0, 5, 0, 0}, {5, 2, 0, 2, 0, 0}};
    const Study study = made_study("stands_for_years = 50\nhazard = { k0_per_year = 0.2, k = 2, sigma_ln = 0.5 }");
    SurvivalCounts counts(study, header_of(study));
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        ResultRow row;
        row.index = i;
        row.cell = study.cell(i);
        row.outcome.state = i % 10 < stand[study.design().events_of(i) - 1][row.cell] ? State::slid : State::collapsed;
        counts.add(row);
    }
    const Survival s = survival_of(study, counts);
    EXPECT_EQ(s.realizations, 120U);
    EXPECT_EQ(s.valid, 120U);
    EXPECT_EQ(s.stand, 29U);
    EXPECT_EQ(s.agree, 29U);
    ASSERT_TRUE(s.past);
    ASSERT_EQ(s.past->by_events.size(), 2U);
    for (std::size_t e = 0; e < 2; ++e)
        for (std::size_t i = 0; i < 3; ++i) {
            const double k = static_cast<double>(stand[e][i] + stand[e][3 + i]);
            EXPECT_NEAR(s.past->by_events[e].likelihood[i].value, (k + 0.5) / 2 / 10.5, 1e-12) << e << ' ' << i;
        }
    ASSERT_EQ(s.by_frequency.size(), 2U);
    for (std::size_t f = 0; f < 2; ++f)
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(s.by_frequency[f].likelihood[i].value, (static_cast<double>(stand[0][3 * f + i]) + 0.5) / 11,
                        1e-12)
                << f << ' ' << i;
    // nothing but its standing is known: shaking is excluded under which it stands in less than 5 %
    EXPECT_NEAR(s.past->by_events[0].rule.part[0], 0.05, 1e-15);
    EXPECT_TRUE(s.past->by_events[0].rule.absolute);
    // one event: 1/4, 3/4 and 1 collapse at 3, 4 and 5 m/s2, linear in ln a between them, and all beyond; weaker events
    // are harmless. Of rates 0.2 a^-2: the piece from a to b adds P(a) H(a) - P(b) H(b) + (slope / 2) (H(a) - H(b))
    const auto rate = [](double a) { return 0.2 / (a * a); };
    double want = rate(5);
    for (const auto& [a, b, from, to] : {std::array{3.0, 4.0, 0.25, 0.75}, std::array{4.0, 5.0, 0.75, 1.0}})
        want += from * rate(a) - to * rate(b) + (to - from) / std::log(b / a) / 2 * (rate(a) - rate(b));
    ASSERT_TRUE(s.rates);
    EXPECT_EQ(s.years, 50);
    EXPECT_EQ(s.sigma_ln, 0.5);
    EXPECT_NEAR(s.rates->collapse_rate.value, want, 2e-5 * want) << "the trapezoidal rule in 64 parts";
    EXPECT_NEAR(s.rates->stands.value, std::exp(-50 * want), 1e-4);
    EXPECT_NEAR(s.rates->at_begin.value, 0.25, 1e-12);
    EXPECT_NEAR(s.rates->prior_upper, std::exp(0.5 * 1.959964), 1e-5);
    // the median of the factor c: prior lognormal times exp(-rate 50 c), by the midpoint rule
    double all = 0, below = 0;
    for (int k = 0; k < 40000; ++k) {
        const double z = -8 + (k + 0.5) / 2500, density = std::exp(-z * z / 2 - 50 * want * std::exp(0.5 * z));
        all += density;
        below += std::exp(0.5 * z) < s.rates->factor_median.value ? density : 0;
    }
    EXPECT_NEAR(below / all, 0.5, 1e-3);
}

TEST(Survival, WhereNothingWasMeasuredAllThatStandAgree)
{
    const Study study = made_study("");
    SurvivalCounts counts(study, header_of(study));
    for (const ResultRow& row : made_rows(study))
        counts.add(row);
    EXPECT_EQ(counts.sums(&MotionTally::agree), counts.sums(&MotionTally::stand));
    const Survival survival = survival_of(study, counts);
    EXPECT_FALSE(survival.monuments);
    ASSERT_TRUE(survival.judged());
    // 1, 1/2, 0 over 3, 4, 5 m/s2: between 4 and 5 the likelihood falls below the threshold
    const Exclusion& e = survival.past->by_events.front();
    ASSERT_TRUE(e.excludes());
    EXPECT_GT(e.by_likelihood.value, 4);
    EXPECT_LT(e.by_likelihood.value, 5);
    EXPECT_LT(e.by_likelihood.lower, e.by_likelihood.value);
    EXPECT_GT(e.by_likelihood.upper, e.by_likelihood.value);
}

TEST(Survival, AStateThatNoneReachesHasANearestOne)
{
    const Study study = made_study("observed = { joint_offset_m = [0.02], tolerance_m = 0.002 }");
    SurvivalCounts counts(study, header_of(study));
    for (const ResultRow& row : made_rows(study))
        counts.add(row);
    const Survival survival = survival_of(study, counts);
    EXPECT_FALSE(survival.judged());
    ASSERT_TRUE(survival.nearest);
    EXPECT_EQ(survival.nearest->index, 9U); // 9 mm, 5.5 tolerances away
    EXPECT_NEAR(survival.nearest->distance, 5.5, 1e-9);
    EXPECT_FALSE(survival.past);
    const std::string words = not_judged_words(survival);
    for (const char* word : {"cannot be judged", "realization 9", "5.5 tolerances", "more realizations"})
        EXPECT_NE(words.find(word), std::string::npos) << words;
}

/// Structures under a motion share it and nothing else; so do structures of a site.
TEST(Survival, StructuresOfASiteShareTheMotionAlone)
{
    const std::vector<std::string> drawn = {
        "study.realizations=6",
        "perturbation.phase={distribution=\"uniform\",from=0,to=6}",
        "perturbation.friction={distribution=\"normal\",cov=0.1}",
    };
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), drawn.begin(), drawn.end());
        return parse_study(squat("kind = \"harmonic\"", ""), "site", more);
    };
    const Study alone = with({}), shared = with({"survival.structures_per_motion=3"}),
                second = with({"survival.structure=2"});
    const Sampler a(alone, nullptr), b(shared, nullptr), c(second, nullptr);
    const auto friction = [](const Realization& r) { return r.joints.front().friction; };
    for (const std::uint64_t cell : {0U, 5U, 7U}) { // 7: of two events
        const std::uint64_t first = 6 * cell;
        std::set<double> phases, frictions;
        for (std::uint64_t k = 0; k < 6; ++k) {
            const Realization r = b.realization(first + k);
            phases.insert(r.phase_rad);
            frictions.insert(friction(r));
            EXPECT_EQ(r.phase_rad, b.realization(first + k / 3 * 3).phase_rad);
            EXPECT_EQ(friction(r), friction(a.realization(first + k))) << "structures are drawn as before";
            EXPECT_EQ(c.realization(first + k).phase_rad, a.realization(first + k).phase_rad);
            EXPECT_NE(friction(c.realization(first + k)), friction(a.realization(first + k)));
        }
        EXPECT_EQ(phases.size(), 2U);
        EXPECT_EQ(frictions.size(), 6U);
    }
    const auto refused = [&](const std::vector<std::string>& settings, const std::string& says) {
        try {
            with(settings);
            ADD_FAILURE() << says;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
        }
    };
    refused({"survival.structures_per_motion=4"}, "no multiple of survival.structures_per_motion = 4");
    refused({"survival.built=2"}, "survival.structures_per_motion = 1");
    refused({"survival.structures_per_motion=2", "survival.built=2", "survival.standing=3"},
            "more stand than were built");
}

/// By default 120 / p: p = sqrt(3 g / (4 R)), R = hypot(0.5, 0.1).
TEST(Survival, ThePauseBetweenEventsLastsUntilTheStructureRests)
{
    std::string text = squat("kind = \"full_sine\"", "");
    text.erase(text.find("pause_s = 2\n"), 12);
    const Study study = parse_study(text, "pause");
    const Sampler sampler(study, nullptr);
    const Realization one = sampler.realization(0), two = sampler.realization(study.originals());
    const BaseMotion a(study.excitation, one, nullptr), b(study.excitation, two, nullptr);
    const double pause = 120 / std::sqrt(3 * 9.81 / (4 * std::hypot(0.5, 0.1)));
    EXPECT_NEAR(b.duration_s() - 2 * a.duration_s(), pause, 0.01 * pause);
}

/// Two structures of a site, of which 2, 3 and 4 mm and 4, 5 and 6 mm agree: under one motion in ten both do.
TEST(Survival, OfASiteTheLikelihoodIsThatOfTheMotionsUnderWhichAllAgree)
{
    const auto of = [](int structure, const std::string& offset) {
        return parse_study(
            squat("kind = \"full_sine\"", "observed = { joint_offset_m = [" + offset + "], tolerance_m = 0.0011 }"),
            "made",
            {"study.realizations=10", "survival.events=1", "survival.monuments=0",
             "survival.structure=" + std::to_string(structure)});
    };
    const Study a = of(1, "0.003"), b = of(2, "0.005"), again = of(1, "0.005");
    const ResultHeader header = header_of(a);
    const auto counts_of = [&](const Study& study) {
        SurvivalCounts counts(study, header);
        for (ResultRow row : made_rows(study)) {
            row.outcome.state = State::slid; // all stand
            counts.add(row);
        }
        return counts;
    };
    const SurvivalCounts counts_a = counts_of(a), counts_b = counts_of(b), counts_again = counts_of(again);
    const CombinedPast both = combined_past({{"a.h5", a, counts_a}, {"b.h5", b, counts_b}});
    EXPECT_EQ(both.agree, 6U);
    EXPECT_EQ(both.motions, 60U);
    // (k + c) / (n + 2 c), c = 1 / (2 nf)
    for (const PastEstimate& at : both.together.by_events.front().likelihood)
        EXPECT_NEAR(at.value, (1 + 0.25) / (10 + 0.5), 1e-12) << "and not 0.3 x 0.3";
    try {
        combined_past({{"a.h5", a, counts_a}, {"c.h5", again, counts_again}});
        ADD_FAILURE() << "both are drawn alike";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("survival.structure = 2"), std::string::npos) << error.what();
    }
}

/// Sites of two structures whose offsets follow from a pulse that both share: the joint credible intervals contain the
/// true PGA of 200 simulated sites, and the exclusion spares it.
TEST(SurvivalStatistics, TheJointAnswerHoldsOnTwoHundredSimulatedSites)
{
    const auto of = [](int structure) {
        return parse_study(
            squat("kind = \"full_sine\"", "observed = { joint_offset_m = [0.04], tolerance_m = 0.01 }"), "made",
            {"study.realizations=400", "survival.events=1", "survival.monuments=200", "surface.pga_m_s2.count=8",
             "surface.pga_m_s2.to=9", "survival.structure=" + std::to_string(structure)});
    };
    const Study a = of(1), b = of(2);
    ResultHeader header = header_of(a);
    header.pga_m_s2.clear();
    for (int i = 0; i < 8; ++i)
        header.pga_m_s2.push_back(a.surface->pga_m_s2.value(i));
    SurvivalCounts counts_a(a, header), counts_b(b, header);
    std::mt19937_64 random(12);
    std::normal_distribution<double> normal;
    for (std::uint64_t i = 0; i < a.total(); ++i) {
        ResultRow row;
        row.index = i;
        row.cell = a.cell(i);
        row.outcome.state = State::slid;
        row.outcome.rotation_rad = {0};
        const double pga = header.pga_m_s2[row.cell % 8], f = header.frequency_hz[row.cell / 8];
        const double pulse = std::exp(0.6 * normal(random)); // of both
        for (SurvivalCounts* counts : {&counts_a, &counts_b}) {
            row.outcome.bed_offset_m = {0.002 * pga * pga / f * pulse * std::exp(0.2 * normal(random))};
            counts->add(row);
        }
    }
    const CombinedPast both = combined_past({{"a.h5", a, counts_a}, {"b.h5", b, counts_b}});
    ASSERT_TRUE(both.sites);
    const auto n = static_cast<double>(both.sites->intensity.size());
    ASSERT_GE(n, 190);
    // 95 % of 200 are 190; fewer than 180 or all come by chance in 1 of 400 runs and in 1 of 28,000
    EXPECT_GE(static_cast<double>(MonumentTest::inside(both.sites->intensity, 0.95)), 0.9 * n);
    EXPECT_NEAR(static_cast<double>(MonumentTest::inside(both.sites->intensity, 0.5)), 0.5 * n, 22);
    std::size_t wrong = 0, all = 0;
    for (const ExclusionCoverage& at : both.coverage) {
        wrong += at.excluded;
        all += at.monuments;
    }
    ASSERT_EQ(all, 1600U);
    // at most 5 %, with a standard deviation of 0.8 %: what calibrates and what is tested have 1600 each
    EXPECT_LE(static_cast<double>(wrong), 80 + 3.5 * 0.008 * 1600);
}

} // namespace
} // namespace stylobate
