/// Simulated campaigns with labels: which are simulated, that they are the same whoever simulates them, and that an
/// interrupted ensemble continues.

#include "tests/ensemble/run/thread_ranks.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include "io/files/atomic_file.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/campaigns/proposals.hpp"
#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace stylobate {
namespace {

const Campaign& campaign()
{
    static const Campaign measured = measure({.runs = 2, .drums = 2, .strong_s = 0.5});
    return measured;
}

/// Of so many joints and blocks that all do the same, or of the joints whose paths these are.
JointPaths paths(const JointPath& mean, std::size_t runs = 2)
{
    JointPaths of;
    of.mean = mean;
    of.before.resize(runs, mean);
    of.speed_m_s = 0.4;
    for (const double slip : mean.slip_m)
        of.reach_m.push_back(slip > 0 ? 0.02 : 0);
    of.leaving_m_s.assign(mean.slip_m.size(), 0.3);
    of.turning_rad_s.assign(mean.slip_m.size(), 4);
    return of;
}
JointPaths paths(std::size_t joints)
{
    return paths({std::vector<double>(joints, 0.01), std::vector<double>(joints, 0.5)});
}
const JointPaths paths_of_two = paths(2);

TEST(CandidateCauses, SizesAreThoseOfTheSpecimen)
{
    const Specimen& s = campaign().specimen;
    const CampaignScales scales = campaign_scales(campaign());
    const std::vector<CandidateCause> causes =
        candidate_causes(s, scales, paths({{0.01, 0.0}, {0.5, 0.0}}, 4), 0.6, 1e8);
    const double speed = std::sqrt(9.81 * 0.058); // of two drums of 29 mm
    std::map<std::string, const CandidateCause*> by_label;
    for (const CandidateCause& cause : causes) {
        // less friction, and more; slow slip, and fast
        by_label[(cause.cause.mechanism == "stribeck" ? fmt::format("{:.3f} ", cause.cause.fixed / speed)
                  : cause.at_one > 1 && cause.ratio   ? "more "
                  : cause.cause.unit == "N s/m" && cause.cause.mechanism == "drag" ? "linear "
                  : stands_for_unknown(cause.cause) ? (cause.at_one < 0 ? "away " : "") + cause.cause.parameter + " "
                                                    : "") +
                 cause.cause.label()] = &cause;
        EXPECT_DOUBLE_EQ(cause.size_of(0), cause.cause.neutral) << cause.cause.label();
        for (const double z : {cause.least, 0.3 * cause.most, cause.most})
            EXPECT_NEAR(cause.ratio ? std::log(cause.size_of(z)) / std::log(cause.at_one)
                                    : cause.size_of(z) / cause.at_one,
                        z, 1e-12)
                << cause.cause.label();
    }
    EXPECT_EQ(by_label.size(), causes.size()) << "each once";
    EXPECT_DOUBLE_EQ(by_label.at("joint_friction at joint 1")->size_of(1), 0.5);
    EXPECT_DOUBLE_EQ(by_label.at("more joint_friction at joint 1")->size_of(1), 1.5);
    for (const char* part : {"0.005", "0.020", "0.080"})
        EXPECT_DOUBLE_EQ(by_label.at(std::string(part) + " stribeck at all")->size_of(1), 0.5);
    EXPECT_DOUBLE_EQ(by_label.at("corner_loss at joint 0 left")->size_of(1), 0.15 * 0.048);
    EXPECT_DOUBLE_EQ(by_label.at("friction_wear at joint 0")->size_of(1), 0.6 / 0.01) << "all of a run's path";
    EXPECT_DOUBLE_EQ(by_label.at("friction_wear at joint 1")->size_of(1), 0.6 / (0.02 * 0.048))
        << "a joint that does not slide does not wear to nothing";
    EXPECT_DOUBLE_EQ(by_label.at("friction_wear at joint 0 from run to run")->size_of(1), 0.6 / (2 * 0.01))
        << "over the path of the root of four runs";
    EXPECT_TRUE(by_label.at("corner_wear at joint 1 from run to run")->cause.persists);
    // what the friction of the joint holds at rest: joint 0 carries both drums
    EXPECT_NEAR(by_label.at("dowel at joint 0")->size_of(1), 0.6 * 2 * 0.1355 * 9.81, 1e-9);
    EXPECT_NEAR(by_label.at("drag at all")->size_of(1) * 0.4 * 0.4, 0.3 * 0.1355 * 9.81, 1e-9)
        << "a part of the weight at the speeds that occur";
    EXPECT_NEAR(by_label.at("linear drag at all")->size_of(1) * 0.4, 0.3 * 0.1355 * 9.81, 1e-9);
    EXPECT_EQ(by_label.at("eccentricity at block 1")->least, -1) << "to either side";
    // half of the critical damping 2 sqrt(K_N B m) of a drum on its bed
    EXPECT_NEAR(by_label.at("face_damping at joint 1")->size_of(1), std::sqrt(1e8 * 0.048 * 0.1355), 1e-6);
    // ties: 0.3 of the weight at the displacement and at the speeds of the block that occur
    const double weight = 0.1355 * 9.81;
    EXPECT_NEAR(by_label.at("stiffness_n_m tie at block 0")->size_of(1), 0.3 * weight / 0.02, 1e-9);
    EXPECT_NEAR(by_label.at("away stiffness_n_m tie at block 0")->size_of(1), -0.3 * weight / 0.02, 1e-9);
    EXPECT_NEAR(by_label.at("dashpot_n_s_m tie at block 0")->size_of(1), 0.3 * weight / 0.3, 1e-9);
    EXPECT_NEAR(by_label.at("turning_dashpot_n_m_s tie at block 0")->size_of(1), 0.3 * weight * 0.024 / 4, 1e-9);
    EXPECT_NEAR(by_label.at("stiffness_n_m tie at block 1")->size_of(1), 0.3 * weight / (0.01 * 0.048), 1e-9)
        << "a block that stays in its place";
    // 10 at the impact velocity 0.1 sqrt(g H)
    EXPECT_NEAR(by_label.at("rate_damping at joint 0")->size_of(1) * 0.1 * speed, 10, 1e-6);
}

TEST(CandidateCauses, WearGoesOnWhereEarlierRunsHaveLeftIt)
{
    const SpecimenStructure built = build_specimen(campaign().specimen);
    const Realization healthy = nominal_realization(default_study(campaign()), built.structure);
    const auto joint = [&](const Realization& r, std::size_t j) {
        return r.joints[static_cast<std::size_t>(built.bed[j])];
    };
    const auto worn = [&](Cause cause, double size, const JointPath& before) {
        cause.joint = 1;
        Realization r = healthy;
        apply_cause({cause, size}, built, r);
        carry_wear({cause, size}, built, before, r);
        return r;
    };
    Cause wear{"friction_wear", "joint 1", "wear_per_m", "1/m"},
        corners{"corner_wear", "joint 1", "wear_m_rad", "m/rad"};
    const JointPath before{{0.5, 0.02}, {9, 0.4}};
    const double friction = joint(healthy, 1).friction;
    EXPECT_EQ(joint(worn(wear, 20, before), 1).friction, friction) << "of each run by itself";
    EXPECT_EQ(joint(worn(corners, 1e-3, before), 1).mechanisms.chip_left_m, 0);

    wear.persists = corners.persists = true;
    const Joint late = joint(worn(wear, 20, before), 1);
    for (const double slip : {0.0, 0.01, 0.025}) // the law itself, over the whole path
        EXPECT_NEAR(late.friction * (1 - late.mechanisms.wear_per_m * slip), friction * (1 - 20 * (0.02 + slip)),
                    1e-12);
    EXPECT_EQ(joint(worn(wear, 20, before), 0).friction, joint(healthy, 0).friction);
    const Joint worn_out = joint(worn(wear, 60, before), 1);
    EXPECT_EQ(worn_out.friction, 0);
    EXPECT_EQ(worn_out.mechanisms.wear_per_m, 0);
    const Joint round = joint(worn(corners, 1e-3, before), 1);
    EXPECT_DOUBLE_EQ(round.mechanisms.chip_left_m, 0.4e-3);
    EXPECT_DOUBLE_EQ(round.mechanisms.chip_right_m, 0.4e-3);
    EXPECT_DOUBLE_EQ(round.mechanisms.corner_wear_m_rad, 1e-3);
}

/// The same motion again and again: each run adds its path, and wear that goes on makes a joint slide farther.
TEST(JointPaths, AddUpFromRunToRunAndWearGoesOnWithThem)
{
    Campaign shaken = measure({.runs = 1, .drums = 2, .friction = 0.3, .pga_m_s2 = 6, .strong_s = 1});
    shaken.specimen.friction_nominal = 0.3;
    shaken.runs.resize(3, shaken.runs.front());
    const CampaignScales scales = campaign_scales(shaken);
    const VirtualLaboratory laboratory(shaken);
    const JointPaths found = joint_paths(shaken, scales, laboratory.base_m);
    ASSERT_EQ(found.before.size(), 3U);
    ASSERT_GT(found.before[1].slip_m[0], 0.002);
    for (std::size_t j = 0; j < 2; ++j) {
        EXPECT_EQ(found.before[0].slip_m[j], 0);
        EXPECT_DOUBLE_EQ(found.before[2].slip_m[j], 2 * found.before[1].slip_m[j]);
        EXPECT_DOUBLE_EQ(found.mean.slip_m[j], found.before[1].slip_m[j]);
        EXPECT_DOUBLE_EQ(found.before[2].rotation_rad[j], 2 * found.mean.rotation_rad[j]);
        EXPECT_EQ(laboratory.before[2].slip_m[j], found.before[2].slip_m[j]);
    }
    Cause wear{"friction_wear", "joint 0", "wear_per_m", "1/m"};
    wear.joint = 0;
    wear.persists = true;
    HealthyScatter scatter;
    scatter.laws.resize(16);
    Observer observer;
    // of the second run over the first one, on the mean of specimens that were put down a little differently
    const auto longer = [&](const std::vector<SizedCause>& acting) {
        const VirtualCampaigns made = virtual_campaigns(laboratory, default_study(shaken), 3, 0, 16, scatter, {acting},
                                                        {best_isa(), 2}, observer);
        double first = 0, second = 0;
        for (const Campaign& campaign : made.campaigns) {
            const std::vector<JointPath> before = joint_paths(campaign, scales, made.base_m).before;
            first += before[1].slip_m[0];
            second += before[2].slip_m[0] - before[1].slip_m[0];
        }
        return second / first;
    };
    const double healthy = longer({}), worn = longer({{wear, 0.5 / found.before[1].slip_m[0]}});
    EXPECT_NEAR(healthy, 1, 0.2);
    EXPECT_GT(worn, 1.2 * healthy) << "the second run begins with half of the friction";
}

TEST(CandidateCauses, DampingOfOneJointStaysThereBesideAnyLaw)
{
    const Specimen& s = campaign().specimen;
    const SpecimenStructure built = build_specimen(s);
    Study study = default_study(campaign());
    HealthyLaw law;
    law.face_share = 0.25;
    law.rate = 2;
    apply_law(law, study);
    Cause dashpot{"face_damping", "joint 1", "dashpot_n_s_m", "N s/m"},
        rate{"rate_damping", "joint 0", "rate_s_m", "s/m"};
    dashpot.joint = 1;
    rate.joint = 0;
    Realization healthy = nominal_realization(study, built.structure), damped = healthy;
    const double own = healthy.joints[static_cast<std::size_t>(built.bed[1])].normal_damping_n_s_m;
    apply_cause({dashpot, 3 * own}, built, damped);
    apply_cause({rate, 7}, built, damped);
    for (Realization* r : {&healthy, &damped})
        apply_law(law, s, built, 0.7, *r);
    const auto joint = [&](const Realization& r, std::size_t j) {
        return r.joints[static_cast<std::size_t>(built.bed[j])];
    };
    EXPECT_DOUBLE_EQ(joint(damped, 1).normal_damping_n_s_m, 4 * own);
    // at the ends: all that was added, and a quarter of the joint's own
    EXPECT_NEAR(joint(damped, 1).mechanisms.face_damping * 4 * own, 3 * own + 0.25 * own, 1e-9 * own);
    EXPECT_DOUBLE_EQ(joint(damped, 0).mechanisms.rate_s_m, joint(healthy, 0).mechanisms.rate_s_m + 7);
    EXPECT_DOUBLE_EQ(joint(damped, 0).normal_damping_n_s_m, own);
    EXPECT_DOUBLE_EQ(joint(damped, 1).mechanisms.rate_s_m, joint(healthy, 1).mechanisms.rate_s_m);
    EXPECT_DOUBLE_EQ(joint(healthy, 1).mechanisms.face_damping, 0.25);
    EXPECT_LT(damped.step_s, healthy.step_s) << "a stiffer dashpot needs a shorter step";
}

TEST(EnsemblePlan, CountsAreInProportionToTheNulls)
{
    const EnsemblePlan all, same = EnsemblePlan::with(all.nulls), half = EnsemblePlan::with(all.nulls / 2),
                            few = EnsemblePlan::with(24);
    EXPECT_EQ(same.total(40), all.total(40));
    EXPECT_EQ(2 * half.total(40), all.total(40));
    EXPECT_EQ(few.nulls, 24U);
    EXPECT_GE(few.of_each_cause, 3U) << "fewer show no shift";
    EXPECT_LE(few.pairs, few.wide);
    EXPECT_EQ(EnsemblePlan::with(0).nulls, 0U);
}

TEST(EnsemblePlan, EachCauseHasSizesFromWeakToStrong)
{
    const std::vector<CandidateCause> causes =
        candidate_causes(campaign().specimen, campaign_scales(campaign()), paths_of_two, 0.6, 1e8);
    const EnsemblePlan plan;
    std::map<int, std::vector<double>> sizes;
    std::map<int, std::set<std::uint64_t>> parents;
    for (std::uint64_t number = 0; number < plan.total(causes.size()); ++number) {
        const auto [cause, z] = plan.label(causes, number);
        EXPECT_EQ(cause < 0, number < plan.healthy());
        EXPECT_EQ(z == 0, cause < 0);
        sizes[cause].push_back(z);
        parents[cause].insert(plan.parent(number));
    }
    ASSERT_EQ(sizes.size(), causes.size() + 1);
    for (std::size_t c = 0; c < causes.size(); ++c) {
        const std::vector<double>& of = sizes.at(static_cast<int>(c));
        ASSERT_EQ(of.size(), plan.of_each_cause);
        EXPECT_EQ(*std::max_element(of.begin(), of.end()), causes[c].most);
        EXPECT_EQ(*std::min_element(of.begin(), of.end()) < 0, causes[c].least < 0);
        EXPECT_GE(parents.at(static_cast<int>(c)).size(), 4U) << "its laws are not all near one";
    }
}

TEST(EnsemblePlan, RoundsFollowOnEachOther)
{
    const EnsemblePlan plan;
    std::uint64_t number = 0;
    for (std::uint64_t round = 0; round <= plan.rounds + 1; ++round) {
        EXPECT_EQ(number, plan.begin_of(round));
        const std::uint64_t count = round == 0 ? plan.scouts() : round <= plan.rounds ? plan.of_each_round : plan.nulls;
        for (std::uint64_t i = 0; i < count; ++i)
            EXPECT_EQ(plan.round(number++), round);
    }
    EXPECT_EQ(number, plan.healthy());
    EXPECT_EQ(plan.round(plan.total(30) - 1), plan.rounds + 1) << "labelled ones are near the likest laws, too";
}

TEST(HealthyLawNearAnother, StaysInTheFamilyAndNearby)
{
    const LawFamily family;
    double square = 0;
    int n = 0;
    for (std::uint64_t k = 0; k < 200; ++k) {
        const HealthyLaw parent = draw_law(family, 3, k), law = draw_near(family, parent, 1.0 / 3, 3, 1000 + k);
        EXPECT_EQ(law.form, parent.form);
        EXPECT_EQ(law.kind, parent.kind);
        EXPECT_TRUE(law.stiffness >= 0.1 && law.stiffness <= 10);
        EXPECT_TRUE(law.shear >= 0.1 && law.shear <= 1);
        EXPECT_TRUE(law.inset >= 0 && law.inset <= 0.03);
        EXPECT_EQ(law, draw_near(family, parent, 1.0 / 3, 3, 1000 + k)) << "a function of its number";
        if (parent.stiffness > 0.5 && parent.stiffness < 2) { // far from the bounds
            square += std::pow(std::log(law.stiffness / parent.stiffness), 2);
            ++n;
        }
    }
    ASSERT_GT(n, 30);
    EXPECT_NEAR(std::sqrt(square / n), 1.0 / 3, 5 * (1.0 / 3) / std::sqrt(2.0 * n));
}

SimulatedCampaign as_shown(const Campaign& measured, const std::vector<std::vector<double>>& base_m)
{
    const CampaignScales scales = campaign_scales(measured);
    return {.numbers = statistics_of(measured, scales, base_m),
            .scores = balance_scores(fit_balance(measured, scales, base_m), score_plan(measured.specimen, scales))};
}

/// Stops after so many campaigns.
class Impatient : public Observer {
public:
    explicit Impatient(std::uint64_t most) : most_(most) {}
    bool stop_requested() override { return done >= most_; }
    std::uint64_t done = 0;

private:
    std::uint64_t most_;
};

TEST(CampaignEnsemble, IsTheSameForAnyThreadsInstructionsAndInterruption)
{
    const Study study = default_study(campaign());
    const CampaignScales scales = campaign_scales(campaign());
    std::vector<CandidateCause> causes = candidate_causes(campaign().specimen, scales, paths_of_two, 0.6, 1e8);
    causes.resize(3);
    EnsemblePlan plan;
    plan.wide = 16;
    plan.pairs = 8;
    plan.of_each_round = 6;
    plan.parents = 3;
    plan.nulls = 12;
    plan.of_each_cause = 4;
    const SimulatedCampaign shown = as_shown(campaign(), direct_tests(campaign(), scales).base_m);
    const TemporaryFolder folder;
    const auto text_of = [](const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    };
    const auto simulate = [&](const char* file, Isa isa, int threads, Observer& observer, Ranks* ranks = nullptr) {
        RunOptions options{isa, threads};
        options.ranks = ranks;
        return simulate_ensemble(
            campaign(), study, causes, {}, plan, shown, folder.path() / file, options,
            [&](std::uint64_t done, std::uint64_t) {
                if (auto* impatient = dynamic_cast<Impatient*>(&observer))
                    impatient->done = done;
            },
            observer);
    };
    Observer patient;
    const CampaignEnsemble whole = simulate("whole", best_isa(), 2, patient);
    ASSERT_TRUE(whole.complete);
    ASSERT_EQ(whole.campaigns.size(), 24U + 2U * 6U + 12U + 12U);
    const std::size_t scores = score_plan(campaign().specimen, scales).size();
    for (const SimulatedCampaign& row : whole.campaigns) {
        EXPECT_EQ(row.numbers.values.size(), shown.numbers.values.size());
        EXPECT_EQ(row.scores.size(), scores);
    }
    EXPECT_TRUE(simulate("scalar", Isa::scalar, 1, patient).complete);
    EXPECT_TRUE(text_of(folder.path() / "whole") == text_of(folder.path() / "scalar"));

    CampaignEnsemble rest;
    for (const std::uint64_t most : {36U, 30U}) { // after the scouts and two rounds; and one
        Impatient impatient(most);
        EXPECT_FALSE(simulate("parts", best_isa(), 1, impatient).complete);
        rest = simulate("parts", best_isa(), 2, patient);
        EXPECT_EQ(rest.cached, most) << "whole rounds";
        EXPECT_TRUE(text_of(folder.path() / "whole") == text_of(folder.path() / "parts"));
        EXPECT_EQ(rest.distance, whole.distance);
        if (most == 36)
            std::filesystem::remove(folder.path() / "parts");
    }

    // three ranks go on where one process was, and all of them have all campaigns
    Impatient one(30);
    EXPECT_FALSE(simulate("ranks", best_isa(), 1, one).complete);
    test::ThreadRanks(3).run([&](Ranks& ranks) {
        Observer own;
        const CampaignEnsemble shared = simulate("ranks", best_isa(), 1, own, &ranks);
        EXPECT_TRUE(shared.complete);
        EXPECT_EQ(shared.cached, 30U);
        EXPECT_EQ(shared.distance, whole.distance);
        EXPECT_EQ(shared.cost.simulations, rest.cost.simulations);
        EXPECT_EQ(shared.cost.block_steps, rest.cost.block_steps);
    });
    EXPECT_TRUE(text_of(folder.path() / "whole") == text_of(folder.path() / "ranks"));

    // another seed is another ensemble, and does not continue this one
    plan.seed = 2;
    EXPECT_EQ(simulate("parts", best_isa(), 2, patient).cached, 0U);
}

/// One in which the law shows.
const Campaign& lively()
{
    static const Campaign measured = measure({.runs = 4, .drums = 3, .friction = 0.8, .pga_m_s2 = 11, .strong_s = 2});
    return measured;
}

/// Median distances of the scouts and of the nulls from a campaign of this law.
std::pair<double, double> distances_from_law(const HealthyLaw& truth, const EnsemblePlan& plan)
{
    Observer observer;
    HealthyScatter scatter;
    scatter.laws = {truth};
    const Study study = default_study(lively());
    const CampaignScales scales = campaign_scales(lively());
    const VirtualCampaigns made =
        virtual_campaigns(VirtualLaboratory(lively()), study, 77, 1, 1, scatter, {}, {best_isa(), 2}, observer);
    const SimulatedCampaign shown = as_shown(made.campaigns.front(), made.base_m);
    std::vector<CandidateCause> causes = candidate_causes(lively().specimen, scales, paths(3), 0.6, 1e8);
    causes.resize(1);
    const CampaignEnsemble ensemble = simulate_ensemble(
        made.campaigns.front(), study, causes, {}, plan, shown, {}, {best_isa(), 2},
        [](std::uint64_t, std::uint64_t) {}, observer);
    const auto median = [&](std::uint64_t from, std::uint64_t to) {
        std::vector<double> distance(ensemble.distance.begin() + static_cast<std::ptrdiff_t>(from),
                                     ensemble.distance.begin() + static_cast<std::ptrdiff_t>(to));
        std::sort(distance.begin(), distance.end());
        return distance[distance.size() / 2];
    };
    return {median(0, plan.scouts()), median(plan.begin_of(plan.rounds + 1), plan.healthy())};
}

TEST(CampaignEnsemble, RoundsComeNearerToTheLaw)
{
    EnsemblePlan plan;
    plan.wide = 72;
    plan.of_each_round = 24;
    plan.parents = 6;
    plan.nulls = 24;
    plan.of_each_cause = 1;
    const HealthyLaw truth = draw_law(plan.family, 5, 9);
    const auto [scouts, nulls] = distances_from_law(truth, plan);
    EXPECT_LT(nulls, 0.7 * scouts);
    EXPECT_LT(nulls, 3) << "in units of the scatter within a law";
}

EnsemblePlan lively_plan()
{
    EnsemblePlan plan;
    plan.wide = 72;
    plan.of_each_round = 48;
    plan.nulls = 96;
    return plan;
}

/// A campaign of the family's law in which these act, and how it is diagnosed.
EnsembleDiagnosis diagnosed(const std::vector<SizedCause>& acting)
{
    Observer observer;
    const Study study = default_study(lively());
    const EnsemblePlan plan = lively_plan();
    HealthyScatter scatter;
    scatter.laws = {draw_law(plan.family, 6, 4)};
    const VirtualCampaigns made =
        virtual_campaigns(VirtualLaboratory(lively()), study, 78, 1, 1, scatter, {acting}, {best_isa(), 2}, observer);
    const Campaign& campaign = made.campaigns.front();
    return ensemble_diagnosis(
        campaign, study, campaign_scales(campaign), {}, made.base_m, plan, {}, {best_isa(), 2},
        [](std::uint64_t, std::uint64_t) {}, observer);
}

TEST(EnsembleDiagnosis, APlantedCauseIsNamedLong)
{
    Cause slippery{"joint_friction", "joint 1", "ratio", "", 1};
    slippery.joint = 1;
    const EnsembleDiagnosis found = diagnosed({{slippery, 0.4}});
    const Decided decided = decide({}, {}, &found, {});
    ASSERT_EQ(decided.verdict, Verdict::named);
    EXPECT_EQ(decided.named.front().fit.cause.label(), "joint_friction at joint 1");
    EXPECT_NEAR(decided.named.front().fit.size, 0.4, 0.15);
    EXPECT_GE(decided.named.front().probability.value(), 0.5);
    EXPECT_EQ(tests_in_words(found).size(), 3U) << "causes and unknown forces in the balance of forces, statistics";

    // what carries the name: campaigns with the cause lie on the side of the measured one, healthy ones do not
    const CarryingNumber& carrying = found.carrying;
    double healthy = 0, with_cause = 0;
    for (const double value : carrying.nulls)
        healthy += value / static_cast<double>(carrying.nulls.size());
    int strong = 0;
    for (const auto& [size, value] : carrying.labelled)
        if (size < 0.6) {
            with_cause += value;
            ++strong;
        }
    ASSERT_GT(strong, 0);
    EXPECT_GT((with_cause / strong - healthy) * (carrying.measured - healthy), 0);
    const auto friction = found.power(found.mechanism_of(slippery), 0.6);
    ASSERT_TRUE(friction);
    EXPECT_GT(*friction, 0.2);
    EXPECT_FALSE(found.power(99, 0));
}

TEST(EnsembleDiagnosis, NothingIsNamedWhereNothingIsHiddenLong)
{
    const EnsembleDiagnosis found = diagnosed({});
    const Decided decided = decide({}, {}, &found, {});
    EXPECT_EQ(decided.verdict, Verdict::none);
    // a cause that the simulations cannot contain: joints are not judged, whatever they show
    DirectResult direct;
    CauseFit vertical;
    vertical.cause = {"vertical_motion", "base", "amplitude_m", "m"};
    direct.found = {vertical};
    EXPECT_EQ(decide(direct, {}, &found, {}).named.size(), 1U);
}

} // namespace
} // namespace stylobate
