/// Causes fitted to the balance of forces: motions by formula in which one thing acts, seen by noisy cameras.

#include "tests/ensemble/motion/formula_motions.hpp"

#include "studies/measured/diagnosis/decision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

BalanceEvidence evidence_of(const Campaign& campaign)
{
    std::vector<std::vector<double>> base;
    for (const MeasuredRun& run : campaign.runs)
        base.push_back(run.base_displacement_m.values);
    return balance_evidence(campaign, campaign_scales(campaign), base);
}

std::string listed(const BalanceEvidence& evidence)
{
    std::string all;
    for (const CauseFit& fit : evidence.causes)
        if (all.size() < 600)
            all += fit.cause.label() + " gains " + std::to_string(fit.gain) + ", " + std::to_string(fit.size) + " +- " +
                   std::to_string(fit.sd) + "\n";
    return all;
}

/// A run of a block that is at these places, one after the other [m].
MeasuredRun pushed_run(const Specimen& specimen, const std::vector<double>& x, unsigned seed)
{
    return formula_run(
        specimen, static_cast<int>(x.size()),
        [&](int b, int i) {
            Pose pose = at_rest(specimen, b);
            pose.x += x[static_cast<std::size_t>(i)];
            return pose;
        },
        camera_m, camera_rad, seed);
}

/// Several runs of a block that is slowed down from several velocities, to either side.
/// @param to_the_right friction that it has more in this direction, and less in the other
Campaign coasting_campaign(const std::function<double(double)>& slowed, double to_the_right = 0)
{
    Campaign campaign;
    campaign.specimen = one_block();
    unsigned seed = 0;
    for (const double velocity : {1.0, -1.5, 2.0, -2.5, 3.0, -1.2}) {
        const double more = std::copysign(to_the_right * formula_gravity, velocity);
        const std::vector<double> x = coasting(velocity, [&](double v) { return slowed(v) + more; });
        campaign.runs.push_back(pushed_run(campaign.specimen, x, ++seed));
    }
    return campaign;
}

/// Block and slab slide together, or the block on the slab: frictions of the two joints.
/// @param drag slows both by so much times the square of the velocity [1/m]
/// @param cubic likewise times the third power [s/m2]
Campaign slab_campaign(double lower, double upper, double drag = 0, double cubic = 0)
{
    Campaign campaign;
    campaign.specimen = block_on_slab();
    unsigned seed = 10;
    for (const double velocity : {1.5, -1.5, 1.0, -1.0, 1.8, -1.8}) {
        const bool together = seed % 4 < 2;
        const double mu = together ? lower : upper;
        const std::vector<double> x =
            coasting(velocity, [&](double v) { return mu * formula_gravity + (drag + cubic * v) * v * v; });
        campaign.runs.push_back(formula_run(
            campaign.specimen, static_cast<int>(x.size()),
            [&](int b, int i) {
                Pose pose = at_rest(campaign.specimen, b);
                pose.x += together || b == 1 ? x[static_cast<std::size_t>(i)] : 0;
                return pose;
            },
            camera_m, camera_rad, ++seed));
    }
    return campaign;
}

/// A block that turns on its left and on its right corner, its centre of mass to the right of the middle.
Campaign rocking_campaign(double offset_m)
{
    Campaign campaign;
    campaign.specimen = one_block();
    const double b = 0.03, h = 0.05, inertia = (b * b + h * h) / 3;
    unsigned seed = 30;
    for (const int sign : {1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1}) {
        const std::vector<double> theta = rocking(b + sign * offset_m, h, inertia, 0.2 + 0.02 * (seed % 5), 0.08);
        campaign.runs.push_back(formula_run(
            campaign.specimen, static_cast<int>(theta.size()),
            [&](int, int i) { return rocked_pose(b, h, sign * theta[static_cast<std::size_t>(i)]); }, camera_m,
            camera_rad, ++seed));
    }
    return campaign;
}

TEST(BalanceFit, HealthyMotionsNeedNoCause)
{
    for (const Campaign& campaign : {coasting_campaign([](double) { return 0.5 * formula_gravity; }),
                                     slab_campaign(0.5, 0.5), rocking_campaign(0)}) {
        const BalanceEvidence evidence = evidence_of(campaign);
        ASSERT_TRUE(evidence.fit) << evidence.why_not;
        for (const CauseFit& fit : evidence.causes)
            EXPECT_LT(fit.gain, 6) << listed(evidence); // chi square's tail at 6 nats: 5e-4
    }
}

TEST(BalanceFit, CommonFrictionIsCalibrated)
{
    const BalanceEvidence evidence = evidence_of(slab_campaign(0.53, 0.53));
    ASSERT_TRUE(evidence.fit);
    // the priors of the joints' own friction share in it
    EXPECT_NEAR(evidence.fit->friction_ratio(), 1.06, 0.03);
    EXPECT_GT(evidence.fit->samples_of(Law::sliding, 0), 5);
    EXPECT_GT(evidence.fit->samples_of(Law::sliding, 1), 5);
    EXPECT_EQ(evidence.fit->samples_of(Law::rocking, 0), 0);
}

TEST(BalanceFit, FrictionOfOneJoint)
{
    const BalanceEvidence evidence = evidence_of(slab_campaign(0.5, 0.3));
    ASSERT_FALSE(evidence.causes.empty());
    const CauseFit& best = evidence.causes.front();
    EXPECT_EQ(best.cause.mechanism, "joint_friction") << listed(evidence);
    EXPECT_EQ(best.cause.place, "joint 1") << listed(evidence);
    EXPECT_GT(best.gain, 10);
    EXPECT_NEAR(best.size, 0.6, 3 * best.sd);
    EXPECT_LT(best.sd, 0.1);
}

TEST(BalanceFit, WearThatEnds)
{
    // v^2 / 2 as a function of the path: friction falls from mu by `wear` for each metre, until the path `ends`
    const double mu = 0.5, wear = 8, ends = 0.08, g = formula_gravity;
    Campaign campaign;
    campaign.specimen = one_block();
    unsigned seed = 30;
    for (const double velocity : {1.2, -1.3, 1.4, -1.5, 1.6, -1.4}) {
        std::vector<double> x(40, 0.0); // at rest, then pushed
        double at = 0, v = std::fabs(velocity);
        const double dt = 0.01 / formula_rate_hz;
        for (int i = 1; v > 0; ++i) {
            const double worn = std::min(at + 0.5 * dt * v, ends); // midpoint
            const double slower = mu * (1 - wear * worn) * g;
            at += dt * (v - 0.5 * dt * slower);
            v -= dt * slower;
            if (i % 100 == 0 && v > 0)
                x.push_back(std::copysign(at, velocity));
        }
        ASSERT_GT(at, 2 * ends);
        campaign.runs.push_back(pushed_run(campaign.specimen, x, ++seed));
    }
    const BalanceEvidence evidence = evidence_of(campaign);
    ASSERT_FALSE(evidence.causes.empty());
    const CauseFit& best = evidence.causes.front();
    EXPECT_EQ(best.cause.mechanism, "friction_wear") << listed(evidence);
    EXPECT_EQ(best.cause.place, "joint 0"); // the only one
    EXPECT_NEAR(best.cause.fixed, ends, 1e-9) << listed(evidence);
    EXPECT_NEAR(best.size, wear, 4 * best.sd) << listed(evidence);
    EXPECT_LT(best.sd, 0.2 * wear);
    EXPECT_GT(best.gain, 10);
}

TEST(BalanceFit, FrictionThatWasLessAllAlongIsNoWear)
{
    // what the few samples before an end of wear leave open is paid for
    const BalanceEvidence evidence = evidence_of(slab_campaign(0.5, 0.3));
    EXPECT_EQ(evidence.causes.front().cause.mechanism, "joint_friction") << listed(evidence);
    for (const CauseFit& fit : evidence.causes) {
        if (fit.cause.mechanism != "friction_wear")
            continue;
        EXPECT_LT(fit.gain, evidence.causes.front().gain - 1.5) << listed(evidence);
    }
}

TEST(BalanceFit, Drag)
{
    const double c = 0.36; // N s2/m2, of 0.9 kg
    const BalanceEvidence evidence =
        evidence_of(coasting_campaign([&](double v) { return 0.5 * formula_gravity + c / 0.9 * v * v; }));
    ASSERT_FALSE(evidence.causes.empty());
    const CauseFit& best = evidence.causes.front();
    EXPECT_EQ(best.cause.mechanism, "drag") << listed(evidence);
    EXPECT_GT(best.gain, 10);
    EXPECT_NEAR(best.size, c, 3 * best.sd);
    EXPECT_LT(best.sd, 0.1 * c);
}

TEST(BalanceFit, DragInProportionToTheSpeed)
{
    const double c = 1.1; // N s/m, of 0.9 kg
    const BalanceEvidence evidence =
        evidence_of(coasting_campaign([&](double v) { return 0.5 * formula_gravity + c / 0.9 * v; }));
    ASSERT_FALSE(evidence.causes.empty());
    const CauseFit& best = evidence.causes.front();
    EXPECT_EQ(best.cause.mechanism, "drag") << listed(evidence);
    EXPECT_EQ(best.cause.parameter, "linear_n_s_m") << listed(evidence);
    EXPECT_GT(best.gain, 10);
    EXPECT_NEAR(best.size, c, 3 * best.sd);
}

TEST(BalanceFit, ShiftedCentreOfMass)
{
    for (const double offset : {0.0025, -0.0025}) {
        const BalanceEvidence evidence = evidence_of(rocking_campaign(offset));
        ASSERT_FALSE(evidence.causes.empty());
        const CauseFit& best = evidence.causes.front();
        EXPECT_EQ(best.cause.mechanism, "eccentricity") << listed(evidence);
        EXPECT_GT(best.gain, 10);
        EXPECT_NEAR(best.size, offset, 3 * best.sd);
        EXPECT_LT(best.sd, 3e-4);
    }
}

TEST(BalanceFit, AForceThatGoesWithVelocityIsDescribed)
{
    const BalanceEvidence evidence =
        evidence_of(coasting_campaign([](double v) { return 0.5 * formula_gravity + 1.2 * v; }));
    ASSERT_FALSE(evidence.structures.empty());
    const StructureFit& best = evidence.structures.front();
    EXPECT_EQ(best.structure.depends_on, "velocity") << best.structure.text;
    EXPECT_EQ(best.structure.coordinate, "x");
    EXPECT_GT(best.gain, 10);
    EXPECT_NEAR(best.size, -1.2, 3 * best.sd); // against it, for each kilogram
    EXPECT_LT(best.sd, 0.12);
}

TEST(BalanceFit, WhatIsGivenIsNotFoundAgain)
{
    const Campaign campaign = slab_campaign(0.5, 0.3);
    const BalanceEvidence first = evidence_of(campaign);
    std::vector<std::vector<double>> base;
    for (const MeasuredRun& run : campaign.runs)
        base.push_back(run.base_displacement_m.values);
    const BalanceEvidence left =
        balance_evidence(campaign, campaign_scales(campaign), base, {first.causes.front().cause});
    for (const CauseFit& fit : left.causes)
        EXPECT_LT(fit.gain, 6) << listed(left);
}

TEST(BalanceFit, FrictionThatFallsWithSpeedIsHeldAgainstTheStaticOne)
{
    // the static friction is the nominal one, the dynamic one 0.6 of it
    const double mu = 0.5, speed = 0.04;
    const BalanceEvidence evidence = evidence_of(coasting_campaign(
        [&](double v) { return mu * (0.6 + 0.4 * std::exp(-std::fabs(v) / speed)) * formula_gravity; }));
    const auto found = std::find_if(evidence.causes.begin(), evidence.causes.end(),
                                    [](const CauseFit& fit) { return fit.cause.mechanism == "stribeck"; });
    ASSERT_NE(found, evidence.causes.end()) << listed(evidence);
    EXPECT_NEAR(found->size, 0.6, 0.06) << listed(evidence);
    EXPECT_GT(found->gain, 15) << "a prior on the dynamic friction would cost 0.4 over 0.05, squared and halved: 32";
}

TEST(BalanceFit, WearThatGoesOnFromRunToRun)
{
    // friction falls with the whole path since the first run; within a run hardly
    const double mu = 0.5, wear = 0.3, dt = 0.01 / formula_rate_hz;
    Campaign campaign;
    campaign.specimen = one_block();
    double worn = 0;
    unsigned seed = 50;
    for (const double velocity : {1.2, -1.3, 1.4, -1.5, 1.6, -1.4}) {
        std::vector<double> x(40, 0.0); // at rest, then pushed
        double at = 0, v = std::fabs(velocity);
        for (int i = 1; v > 0; ++i) {
            const double slower = mu * (1 - wear * (worn + at)) * formula_gravity;
            at += dt * (v - 0.5 * dt * slower);
            v -= dt * slower;
            if (i % 100 == 0 && v > 0)
                x.push_back(std::copysign(at, velocity));
        }
        worn += at;
        campaign.runs.push_back(pushed_run(campaign.specimen, x, ++seed));
    }
    // the order of the runs is that of their numbers, not that in the file
    for (std::size_t r = 0; r < campaign.runs.size(); ++r)
        campaign.runs[r].run_order = static_cast<int>(r);
    std::swap(campaign.runs[0], campaign.runs[5]);
    std::swap(campaign.runs[1], campaign.runs[3]);
    const BalanceEvidence evidence = evidence_of(campaign);
    ASSERT_FALSE(evidence.causes.empty());
    const CauseFit& best = evidence.causes.front();
    EXPECT_EQ(best.cause.mechanism, "friction_wear") << listed(evidence);
    EXPECT_TRUE(best.cause.persists) << listed(evidence);
    EXPECT_NEAR(best.size, wear, 4 * best.sd) << listed(evidence);
}

/// All faces begin to carry inside their corners, or, were it possible, outside them.
Campaign inset_campaign(double inside_m)
{
    Campaign campaign;
    campaign.specimen = one_block();
    const double b = 0.03, h = 0.05, inertia = (b * b + h * h) / 3;
    unsigned seed = 70;
    for (const int sign : {1, -1, 1, -1, 1, -1, 1, -1}) {
        const std::vector<double> theta = rocking(b - inside_m, h, inertia, 0.15 + 0.02 * (seed % 5), 0.08);
        campaign.runs.push_back(formula_run(
            campaign.specimen, static_cast<int>(theta.size()),
            [&](int, int i) { return rocked_pose(b, h, sign * theta[static_cast<std::size_t>(i)], inside_m); },
            camera_m, camera_rad, ++seed));
    }
    return campaign;
}

TEST(BalanceFit, FacesCarryInsideTheirCornersAndNotOutside)
{
    const auto corner_gain = [](const BalanceEvidence& evidence) {
        double most = 0;
        for (const CauseFit& fit : evidence.causes)
            if (fit.cause.mechanism == "corner_loss")
                most = std::max(most, fit.gain);
        return most;
    };
    // inside on both sides is what every contact does a little
    EXPECT_LT(corner_gain(evidence_of(inset_campaign(0.0012))), 3);
    const Campaign campaign = inset_campaign(-0.0012);
    const BalanceEvidence outside = evidence_of(campaign);
    ASSERT_TRUE(outside.fit);
    // the common turning point is at its bound: scores are there, and ask for the other sign
    for (const Cause& cause : balance_causes(campaign.specimen, campaign_scales(campaign)))
        if (cause.mechanism == "corner_loss" && !cause.side) {
            EXPECT_LT(outside.fit->score(cause), 0);
        }
}

TEST(BalanceFit, ScoresAreSignedRootsOfGains)
{
    for (const Campaign& campaign : {slab_campaign(0.5, 0.45), rocking_campaign(0.0006), rocking_campaign(-0.0006)}) {
        const BalanceEvidence evidence = evidence_of(campaign);
        ASSERT_TRUE(evidence.fit);
        int compared = 0;
        for (const Cause& cause : balance_causes(campaign.specimen, campaign_scales(campaign))) {
            const CauseFit fit = evidence.fit->fit(cause);
            const double score = evidence.fit->score(cause);
            if (std::isnan(score) || fit.gain == 0 || (cause.mechanism == "friction_wear" && cause.fixed > 0))
                continue;
            // a gain of g nats is a score of sqrt(2 g), while it is small: one step from the baseline
            if (fit.gain < 4) {
                EXPECT_NEAR(std::fabs(score), std::sqrt(2 * fit.gain), 0.3 + 0.2 * std::fabs(score)) << cause.label();
            }
            const bool either_way = cause.mechanism == "joint_friction" || cause.mechanism == "eccentricity";
            if (std::fabs(score) > 1 && either_way) {
                EXPECT_EQ(score < 0, fit.size < cause.neutral) << cause.label();
            }
            ++compared;
        }
        EXPECT_GT(compared, 3);
        for (const Structure& structure : balance_structures(campaign.specimen))
            EXPECT_FALSE(std::isinf(evidence.fit->score(structure))) << structure.text;
    }
}

TEST(BalanceFit, AnEccentricityThatNoBlockHasIsNoCause)
{
    const auto found = [](double offset) {
        const BalanceEvidence evidence = evidence_of(rocking_campaign(offset));
        return std::any_of(evidence.causes.begin(), evidence.causes.end(),
                           [](const CauseFit& fit) { return fit.cause.mechanism == "eccentricity"; });
    };
    EXPECT_TRUE(found(0.0045)); // 7.5 % of the width
    EXPECT_FALSE(found(0.009)); // 15 %
}

/// Of scores that no healthy campaign has: nulls of 0.5, in units of 1.
ForceTest beyond_all(std::size_t variants)
{
    ForceTest test;
    test.variant = 0;
    test.score = 9;
    test.nulls.assign(300, 0.5);
    test.p_value = 1.0 / 301;
    test.unit.assign(variants, 1);
    return test;
}

/// @param unit of the scores of causes   @param null score of a force of no known kind in healthy campaigns
EnsembleDiagnosis beyond_healthy(const Campaign& campaign, double unit = 1, double null = 0.5)
{
    EnsembleDiagnosis ensemble;
    ensemble.scored = score_plan(campaign.specimen, campaign_scales(campaign));
    ensemble.listed = beyond_all(ensemble.scored.causes.size());
    ensemble.listed.unit.assign(ensemble.scored.causes.size(), unit);
    ensemble.forces = beyond_all(ensemble.scored.structures.size());
    ensemble.forces.nulls.assign(300, null);
    for (const Cause& cause : ensemble.scored.causes)
        ensemble.causes.push_back({cause});
    ensemble.by_statistics.causes.resize(ensemble.causes.size());
    return ensemble;
}

NamedByForces named_in(const Campaign& campaign, double unit = 1, double null = 0.5)
{
    return named_by_forces(evidence_of(campaign), beyond_healthy(campaign, unit, null));
}

TEST(NamedByForces, ACauseThatLeavesNothingBesideIt)
{
    const NamedByForces named =
        named_in(coasting_campaign([](double v) { return 0.5 * formula_gravity + 0.4 * v * v; }));
    ASSERT_EQ(named.causes.size(), 1U);
    EXPECT_EQ(named.causes.front().cause.mechanism, "drag");
    EXPECT_FALSE(named.unknown) << named.unknown->structure.text;
    EXPECT_NEAR(named.p_value, 1.0 / 301, 1e-12);
}

TEST(NamedByForces, AForceBesideTheCauseIsNoneOfTheList)
{
    // drag, and friction that depends on the direction
    const Campaign campaign = coasting_campaign([](double v) { return 0.5 * formula_gravity + 0.4 * v * v; }, 0.06);
    const NamedByForces named = named_in(campaign);
    ASSERT_FALSE(named.causes.empty());
    ASSERT_TRUE(named.unknown);
    EXPECT_GT(named.unknown->gain, 8);
    // where healthy campaigns have as much, it is none
    const double score = std::sqrt(2 * named.unknown->gain);
    EXPECT_FALSE(named_in(campaign, 1, 1.5 * score).unknown);
    EXPECT_TRUE(named_in(campaign, 1, 0.99 * score).unknown);

    const BalanceEvidence evidence = evidence_of(campaign);
    const EnsembleDiagnosis ensemble = beyond_healthy(campaign);
    const Decided decided = decide({}, evidence, &ensemble, {});
    EXPECT_EQ(decided.verdict, Verdict::unexplained);
    EXPECT_TRUE(decided.named.empty());
    ASSERT_TRUE(decided.unexplained && decided.beside);
    EXPECT_EQ(decided.beside->cause.label(), named.causes.front().cause.label());
    EXPECT_EQ(decided.unexplained->structure.text, named.unknown->structure.text);
}

TEST(NamedByForces, ASecondCauseOfTheListIsNoUnknownForce)
{
    const Campaign campaign = slab_campaign(0.5, 0.3, 0.4);
    const NamedByForces named = named_in(campaign);
    ASSERT_FALSE(named.causes.empty());
    // much is left beside the first one, of the friction's kind too
    const BalanceEvidence evidence = evidence_of(campaign);
    EXPECT_GT(evidence.fit->describe({named.causes.front().cause}).front().gain, 8);
    EXPECT_FALSE(named.unknown) << named.unknown->structure.text;
}

TEST(NamedByForces, TheForcesOfWhatTheStatisticsNameAreNotUnknown)
{
    const Campaign campaign = slab_campaign(0.5, 0.3, 0.4);
    const BalanceEvidence evidence = evidence_of(campaign);
    const EnsembleDiagnosis ensemble = beyond_healthy(campaign);
    DecisionRule alone; // by which no further cause of the list keeps a force from being unknown
    alone.structure_better = -1e9;
    const auto unknown_beside = [&](const std::vector<Cause>& by_statistics) {
        return named_by_forces(evidence, ensemble, by_statistics, alone).unknown;
    };
    ASSERT_TRUE(unknown_beside({}));
    const Cause first = named_in(campaign).causes.front().cause;
    const auto second = std::find_if(evidence.causes.begin(), evidence.causes.end(), [&](const CauseFit& fit) {
        return fit.cause.mechanism == (first.mechanism == "drag" ? "joint_friction" : "drag");
    });
    ASSERT_NE(second, evidence.causes.end());
    EXPECT_FALSE(unknown_beside({second->cause})) << "both together are all that acts";
    // what forces name already, or do not see, is nothing more
    const double gain = unknown_beside({})->gain;
    Cause unseen{"damping", "joint 0", "ratio", "", 1};
    unseen.joint = 0;
    ASSERT_TRUE(unknown_beside({first, unseen}));
    EXPECT_EQ(unknown_beside({first, unseen})->gain, gain);
    EXPECT_EQ(named_by_forces(evidence, ensemble, {first, unseen, second->cause}, alone).given_too,
              std::vector<Cause>{second->cause});

    // the decision asks for what its own statistics name
    EnsembleDiagnosis named = ensemble;
    named.forces.variant = -1;
    EnsembleVerdict& statistics = named.by_statistics;
    statistics.best = static_cast<int>(
        std::find(named.scored.causes.begin(), named.scored.causes.end(), second->cause) - named.scored.causes.begin());
    ASSERT_LT(static_cast<std::size_t>(statistics.best), named.causes.size());
    CandidateCause& candidate = named.causes[static_cast<std::size_t>(statistics.best)];
    candidate.at_one = second->size;
    candidate.most = 1;
    statistics.causes[static_cast<std::size_t>(statistics.best)] = {20, 1, 0.9, 1.1};
    statistics.null_gains = {1, 2};
    statistics.null_weights = {1, 1};
    EXPECT_EQ(decide({}, evidence, &named, alone).verdict, Verdict::unexplained) << "they name nothing";
    statistics.named = true;
    statistics.probability = statistics.set_probability = 0.8;
    EXPECT_EQ(decide({}, evidence, &named, alone).verdict, Verdict::named);
    // what is left beside both is said to be so
    DecisionRule any = alone;
    any.clear = 0;
    any.structure_better = -1e9;
    const Decided left = decide({}, evidence, &named, any);
    ASSERT_TRUE(left.beside);
    EXPECT_EQ(left.beside->cause, first);
    EXPECT_EQ(left.beside_too, std::vector<Cause>{second->cause});
}

TEST(NamedByForces, TheSameCauseElsewhereIsNoSecondOne)
{
    // a force in proportion to the third power of the velocity, for which drag stands, and which another drag explains
    // further
    const Campaign campaign = slab_campaign(0.5, 0.5, 0, 0.4);
    const BalanceEvidence evidence = evidence_of(campaign);
    EnsembleDiagnosis ensemble = beyond_healthy(campaign);
    const auto at_blocks = [](const auto& c) { return c.cause.mechanism == "drag" && c.cause.block >= 0; };
    std::erase_if(ensemble.causes, at_blocks); // drag is simulated at all blocks alone
    const NamedByForces named = named_by_forces(evidence, ensemble);
    ASSERT_FALSE(named.causes.empty());
    const Cause first = named.causes.front().cause;
    ASSERT_EQ(first.label(), "drag at all");
    double elsewhere = 0, other = 0;
    for (const CauseFit& listed : evidence.causes) {
        double& best = listed.cause.mechanism == "drag" ? elsewhere : other;
        best = std::max(best, evidence.fit->fit(listed.cause, {first}).gain);
    }
    const double left = evidence.fit->describe({first}).front().gain;
    ASSERT_GT(elsewhere, other + 0.1) << other;
    DecisionRule rule;
    rule.clear = 0;
    rule.structure_better = left - (elsewhere + other) / 2; // more than beside other causes, less than beside all
    EXPECT_TRUE(named_by_forces(evidence, ensemble, {}, rule).unknown);
    rule.structure_better = left - other + 0.01;
    EXPECT_FALSE(named_by_forces(evidence, ensemble, {}, rule).unknown);
}

TEST(NamedByForces, WhatOnlyAnImpossibleSizeExplainsIsNoneOfTheList)
{
    // a force that drives with the square of the velocity: a drag of a negative size, and of no known kind
    const Campaign campaign = coasting_campaign([](double v) { return 0.5 * formula_gravity - 0.25 * v * v; });
    BalanceEvidence evidence = evidence_of(campaign);
    ASSERT_TRUE(evidence.impossible);
    EXPECT_EQ(evidence.impossible->cause.mechanism, "drag");
    EXPECT_LT(evidence.impossible->size, 0);
    const EnsembleDiagnosis ensemble = beyond_healthy(campaign);
    const NamedByForces named = named_by_forces(evidence, ensemble);
    EXPECT_TRUE(named.causes.empty());
    ASSERT_TRUE(named.unknown);
    EXPECT_EQ(named.unknown->structure.text, evidence.structures.front().structure.text);
    const Decided decided = decide({}, evidence, &ensemble, {});
    EXPECT_EQ(decided.verdict, Verdict::unexplained);
    EXPECT_TRUE(decided.named.empty());
    EXPECT_FALSE(decided.beside);
    // a possible cause that explains nearly as much is a rival, and is named
    CauseFit rival = evidence.impossible.value();
    rival.gain -= 2.9;
    rival.cause = ensemble.causes.front().cause;
    rival.size = 0.5;
    evidence.causes.insert(evidence.causes.begin(), rival);
    EXPECT_FALSE(named_by_forces(evidence, ensemble).causes.empty());
    evidence.causes.front().gain -= 0.2;
    EXPECT_TRUE(named_by_forces(evidence, ensemble).causes.empty());
}

TEST(NamedByForces, NotWhatHealthyCampaignsShowAsWell)
{
    const Campaign drag = coasting_campaign([](double v) { return 0.5 * formula_gravity + 0.4 * v * v; });
    const double gain = evidence_of(drag).causes.front().gain;
    // a score is the root of twice the gain: 1.5 units of it are asked for
    EXPECT_FALSE(named_in(drag, std::sqrt(2 * gain) / 1.51).causes.empty());
    EXPECT_TRUE(named_in(drag, std::sqrt(2 * gain) / 1.49).causes.empty());
}

} // namespace
} // namespace stylobate
