/// The parts of the pages of measured data: the split, the scores, the logistic regression, the mesh, the base motions,
/// against known answers; and the data themselves, where they lie beside the checkout.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/measured/boulders/boulder_model.hpp"
#include "studies/evidence/measured/double_pulse/double_pulse.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <set>

namespace stylobate::measured {

namespace {

namespace fs = std::filesystem;

TEST(Split, TakesEverySecondGroupInTheOrderOfNames)
{
    const std::vector<bool> fits = fitting_half({"kobe", "athens", "kobe", "tabas", "bam", "athens"});
    // athens, bam, kobe, tabas: the first and third are fitted on
    EXPECT_EQ(fits, (std::vector<bool>{true, true, true, false, false, true}));
}

TEST(Score, OfKnownForecasts)
{
    const Scores s = score({{0.8, true, "a"}, {0.8, false, "a"}, {0.1, false, "b"}, {0.4, true, "b"}});
    EXPECT_DOUBLE_EQ(s.right, 0.5);
    EXPECT_EQ(s.false_falls, 1);
    EXPECT_EQ(s.false_stands, 1);
    EXPECT_NEAR(s.brier, (0.04 + 0.64 + 0.01 + 0.36) / 4, 1e-15);
    EXPECT_NEAR(s.log, -(std::log(0.8) + std::log(0.2) + std::log(0.9) + std::log(0.4)) / 4, 1e-15);
}

TEST(Score, ASureMissIsNotInfinitelyWrong)
{
    EXPECT_NEAR(log_loss({0, true, ""}), -std::log(surest), 1e-12);
    EXPECT_NEAR(log_loss({1, true, ""}), -std::log(1 - surest), 1e-12);
}

TEST(Score, AnswersAreWorthTheirShare)
{
    // of three predicted falls two fell; of one predicted stand none
    const Answers worth = answers_worth({true, true, true, false}, {true, true, false, false});
    EXPECT_DOUBLE_EQ(worth.of(true), 2.5 / 4);
    EXPECT_DOUBLE_EQ(worth.of(false), 0.5 / 2);
}

TEST(Score, TheBootstrapDrawsWholeGroups)
{
    // 40 groups of 10 equal values, normal with sd 1: the interval of the mean is 1.96 / sqrt(40) to either side, and
    // would be sqrt(10) times narrower if single values were drawn
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::vector<double> values;
    std::vector<std::string> groups;
    double sum = 0, squares = 0;
    for (int g = 0; g < 40; ++g) {
        const double value = normal(random);
        sum += value;
        squares += value * value;
        values.insert(values.end(), 10, value);
        groups.insert(groups.end(), 10, std::to_string(g));
    }
    const double mean = sum / 40, sd = std::sqrt(squares / 40 - mean * mean);
    const Estimate e = grouped_mean(values, groups);
    EXPECT_NEAR(e.mean, mean, 1e-12);
    EXPECT_NEAR(e.high - e.low, 2 * 1.96 * sd / std::sqrt(40), 0.12 * 2 * 1.96 * sd / std::sqrt(40));
}

TEST(Score, ADifferenceIsPaired)
{
    const std::vector<Forecast> good{{0.9, true, "a"}, {0.1, false, "b"}}, bad{{0.6, true, "a"}, {0.4, false, "b"}};
    const Estimate e = difference(good, bad, brier);
    EXPECT_NEAR(e.mean, 0.01 - 0.16, 1e-15); // the same in both groups: no spread
    EXPECT_NEAR(e.low, e.high, 1e-15);
}

TEST(Logistic, OfATwoByTwoTableIsItsLogOdds)
{
    // without: 3 of 10; with: 8 of 12. Closed form: b0 = logit(3/10), b1 = logit(8/12) - b0
    std::vector<std::vector<double>> x;
    std::vector<bool> event;
    for (int i = 0; i < 10; ++i) {
        x.push_back({0});
        event.push_back(i < 3);
    }
    for (int i = 0; i < 12; ++i) {
        x.push_back({1});
        event.push_back(i < 8);
    }
    const Logistic fit = fit_logistic(x, event);
    EXPECT_NEAR(fit.coefficients[0], std::log(3.0 / 7), 1e-9);
    EXPECT_NEAR(fit.coefficients[1], std::log(8.0 / 4) - std::log(3.0 / 7), 1e-9);
    EXPECT_NEAR(fit.probability({1}), 8.0 / 12, 1e-9);
}

TEST(Logistic, FindsWhatTheEventsWereDrawnFrom)
{
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const Logistic truth{{0.5, 2, -1}};
    std::vector<std::vector<double>> x;
    std::vector<bool> event;
    for (int i = 0; i < 20000; ++i) {
        x.push_back({normal(random), normal(random)});
        event.push_back(uniform(random) < truth.probability(x.back()));
    }
    const Logistic fit = fit_logistic(x, event);
    for (std::size_t k = 0; k < 3; ++k) // standard errors are about 0.02 to 0.035
        EXPECT_NEAR(fit.coefficients[k], truth.coefficients[k], 0.12);
}

TEST(Logistic, SeparatedEventsHaveNoRule)
{
    EXPECT_THROW(fit_logistic({{-1}, {-2}, {1}, {2}}, {false, false, true, true}), InputError);
}

/// A box of width, depth and height, its sides across the axes.
Mesh box(double width, double depth, double height)
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back({(i & 1) ? width : 0, (i & 2) ? depth : 0, (i & 4) ? height : 0});
    for (const auto& [a, b, c, d] : {std::array<std::size_t, 4>{0, 2, 3, 1},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 4, 6, 2},
                                     {1, 3, 7, 5}}) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    }
    return mesh;
}

TEST(MeshStance, OfABoxIsItsSlenderness)
{
    const Mesh mesh = box(0.3, 0.5, 0.8);
    const MeshBody body = body_of(mesh);
    EXPECT_NEAR(body.volume_m3, 0.12, 1e-12);
    EXPECT_NEAR(body.centroid_m[0], 0.15, 1e-12);
    EXPECT_NEAR(body.centroid_m[2], 0.4, 1e-12);
    EXPECT_NEAR(body.extent_m[1], 0.5, 1e-12);
    const std::vector<Stance> towards = stances(mesh, 4); // +x, +y, -x, -y
    for (const std::size_t k : {0, 2}) {
        EXPECT_NEAR(towards[k].balance_rad, std::atan(0.3 / 0.8), 0.25 * std::numbers::pi / 180);
        EXPECT_NEAR(towards[k].barrier, std::hypot(0.15, 0.4) / 0.4 - 1, 1e-4);
        EXPECT_NEAR(towards[k].effective_slenderness(), 0.3 / 0.8, 1e-3);
        EXPECT_NEAR(towards[k].start_slenderness, std::tan(std::atan(0.3 / 0.8) - std::numbers::pi / 180), 1e-9);
    }
    EXPECT_NEAR(towards[1].effective_slenderness(), 0.5 / 0.8, 1e-3);
}

TEST(MeshStance, ReadsFacesAndSaysWhatIsWrong)
{
    const fs::path file = fs::temp_directory_path() / "stylobate_measured_mesh.obj";
    std::ofstream(file) << "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                           "f 1/1 3/1 2/1\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    EXPECT_NEAR(body_of(read_obj(file)).volume_m3, 1.0 / 6, 1e-12);
    std::ofstream(file) << "v 0 0 0\nf 1 2 3\n";
    try {
        read_obj(file);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(":2: "), std::string::npos) << e.what();
    }
    fs::remove(file);
}

TEST(DoublePulse, EndsWhereItShould)
{
    for (const double pulse : {0.001, 0.005, 0.02})
        for (const DoublePulse test : {DoublePulse{0.0025, 0.6, false}, {0.02, 0.2, false}, {0.035, 0.55, false}}) {
            const Motion motion = base_motion_of(test, pulse);
            EXPECT_NEAR(motion.displacement_m.back(), test.distance_m, 1e-12);
            EXPECT_NEAR(motion.velocity_m_s.back(), 0, 1e-12);
            EXPECT_NEAR(*std::max_element(motion.velocity_m_s.begin(), motion.velocity_m_s.end()), test.velocity_m_s,
                        1e-12);
        }
}

/// A rigid block whose base is set moving at once and for good overturns if its pivot speed carries it to balance:
/// v = (4 R2 / (3 h)) p sqrt(2 (1 - cos alpha)), h half its height; without slip.
TEST(DoublePulse, ALongWayIsOneVelocityStep)
{
    PulsedBlock block;
    block.slenderness = 0.25;
    block.height_m = 0.1;
    block.friction = 5;
    block.pulse_s = 0.0005;
    const double h = 0.05, R = h * std::hypot(1, 0.25), alpha = std::atan(0.25), p = std::sqrt(0.75 * 9.81 / R);
    const double limit = 4 * R * R / (3 * h) * p * std::sqrt(2 * (1 - std::cos(alpha)));
    const auto falls = [&](double factor) {
        return falls_in(base_motion_of({2, factor * limit, false}, block.pulse_s), {pulsed_study(block)},
                        Isa::scalar)[0] != 0;
    };
    EXPECT_FALSE(falls(0.93)); // the contact gives way a little
    EXPECT_TRUE(falls(1.03));
}

TEST(Boulder, ItsStudyReadsBackAndNeedsOnlyItsMotion)
{
    BoulderModel model;
    model.ends = true;
    model.slenderness_spread = 0.2;
    const Study study = boulder_study(model, 16);
    const Study again = parse_study(study.text, "boulder");
    EXPECT_EQ(again.text, study.text);
    EXPECT_EQ(again.realizations, 16U);
    EXPECT_NEAR(model.rocking_rate_rad_s(), std::sqrt(0.75 * 9.81 / (0.25 * std::hypot(1, 0.2))), 1e-12);
}

TEST(Boulder, DashpotsAtTheEndsTakeMoreOutOfAnImpact)
{
    BoulderModel model;
    model.slenderness = 0.3;
    const double centroid = restitution(model);
    model.ends = true;
    model.damping_ratio = 0.5;
    const double ends = restitution(model);
    EXPECT_LT(centroid, 1.01);
    EXPECT_LT(ends, centroid - 0.02);
    EXPECT_GT(ends, 0.5);
}

TEST(FallTable, AnInvalidRealizationHasFallenIfItLayOnItsSide)
{
    const auto ended = [](State state, double turned_rad) {
        Outcome outcome;
        outcome.state = state;
        outcome.max_relative_rotation_rad = turned_rad;
        return outcome;
    };
    Ends ends, more;
    ends.add(ended(State::collapsed, 0.6));
    ends.add(ended(State::invalid, 1.2));
    ends.add(ended(State::invalid, 0.4));
    more.add(ended(State::rocked, 0.1));
    ends.add(more);
    EXPECT_EQ(ends.total, 4U);
    EXPECT_EQ(ends.fallen, 2U);
    EXPECT_EQ(ends.on_its_side, 1U);
    EXPECT_EQ(ends.set_aside, 1U);
}

TEST(Boulder, TheStrongPartHasItsMargins)
{
    std::vector<double> a(1000, 0.1);
    a[400] = a[500] = 1;
    const auto [first, last] = strong_part(a, 0.005, 0.6);
    EXPECT_EQ(first, 300U);
    EXPECT_EQ(last, 601U);
    EXPECT_EQ(strong_part(a, 0.005, 2).second, 0U);
}

TEST(MeasuredData, BouldersAreReadAsTheyWerePublished)
{
    const fs::path folder = fs::path(STYLOBATE_DATA_DIR) / "rock_shake_table";
    if (!fs::exists(folder / "tests.csv"))
        GTEST_SKIP() << "there is no " << folder;
    const BoulderData data = read_boulders(folder);
    EXPECT_EQ(data.tests.size(), 347U);
    EXPECT_EQ(data.without_motion, 84);
    std::vector<double> ratio; // of the largest acceleration to the published PGA, which was low-passed
    for (const BoulderTest& test : data.tests)
        if (!test.motion.empty())
            ratio.push_back(test.motion.pga_m_s2 / 9.80665 / test.pga_g);
    std::nth_element(ratio.begin(), ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2), ratio.end());
    EXPECT_GT(ratio[ratio.size() / 2], 1.0);
    EXPECT_LT(ratio[ratio.size() / 2], 1.3);
}

TEST(MeasuredData, DoublePulsesAreReadAsTheyWerePublished)
{
    const fs::path folder = fs::path(STYLOBATE_DATA_DIR) / "published";
    if (!fs::exists(folder))
        GTEST_SKIP() << "there is no " << folder;
    const auto tests = read_double_pulses(folder / "ceh2016_single_block_scale1_experiment.csv");
    EXPECT_EQ(tests.size(), 65U);
    int falls = 0;
    for (const DoublePulse& test : tests) {
        falls += test.fell;
        EXPECT_FALSE(test.fell && test.distance_m <= 0.0125) << "nothing fell at so short a distance";
    }
    EXPECT_EQ(falls, 30);
}

TEST(PageCases, StudiesOfTheFittedModelsAreStudies)
{
    int files = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(STYLOBATE_SOURCE_DIR) / "studies/evidence/measured/fitted"))
        if (entry.path().extension() == ".toml") {
            ++files;
            const Study study = read_study(entry.path(), {"excitation.file=motion.csv"});
            EXPECT_EQ(study.excitation.kind, ExcitationKind::table) << entry.path();
            EXPECT_EQ(study.structure.columns.size(), 1U) << entry.path();
        }
    EXPECT_GE(files, 4);
}

} // namespace

} // namespace stylobate::measured
