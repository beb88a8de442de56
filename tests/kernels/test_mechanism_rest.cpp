/// What must hold with any mechanism: a structure stays where it rests, the safe step is safe, the energies balance.

#include "ensemble/planar/structure/settle.hpp"
#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "tests/kernels/mechanism_runs.hpp"
#include "tests/kernels/uneven_drums.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>
#include <string_view>

using namespace stylobate;
using namespace stylobate::model;

namespace {

void each_joint(Realization& r, const std::function<void(JointMechanisms&)>& set)
{
    for (int j = 0; j < r.beds(); ++j)
        set(r.joints[static_cast<std::size_t>(j)].mechanisms);
}

/// Ways to lie otherwise than the baseline.
std::vector<std::pair<const char*, std::function<void(Realization&)>>> ways_to_rest()
{
    return {{"area", [](Realization& r) { r.with_mechanisms = true; }},
            {"two_corner", [](Realization& r) { r.form = ContactForm::two_corner; }},
            {"points", [](Realization& r) { r.form = ContactForm::points; }},
            {"wedge", [](Realization& r) { r.joints[1].mechanisms.wedge_rad = 0.004; }},
            {"eccentricity", [](Realization& r) { r.blocks[r.blocks.size() - 2].mechanisms.eccentricity_m = 0.002; }},
            {"tendon",
             [](Realization& r) {
                 for (const std::size_t block : {std::size_t{1}, r.blocks.size() - 1})
                     if (r.blocks[block].role == BlockRole::drum && !r.blocks[block].fixed) {
                         r.blocks[block].strengthening.tendon_n_m = 1e5;
                         r.blocks[block].strengthening.tendon_prestress_n = 8;
                     }
             }},
            {"mortar",
             [](Realization& r) {
                 for (int j = 0; j < r.beds(); ++j) {
                     r.joints[static_cast<std::size_t>(j)].strengthening.bond_tension_n_m = 1e5;
                     r.joints[static_cast<std::size_t>(j)].strengthening.bond_cohesion_n_m = 1e5;
                 }
             }},
            {"chips", [](Realization& r) { each_joint(r, [](JointMechanisms& e) { e.chip_left_m = 0.002; }); }},
            {"hertz", [](Realization& r) {
                 each_joint(r, [](JointMechanisms& e) {
                     e.force_exponent = 1.5;
                     e.reference_overlap_m2 = 4e-8;
                 });
             }}};
}

/// Largest displacement from the start in a second without shaking, over the depth of the lowest bed.
double unrest(const Realization& r, double depth)
{
    Study study = still(1);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const Snapshot start = set.snapshot(0);
    double most = 0;
    while (!set.outcome(0)) {
        set.advance();
        const Snapshot now = set.snapshot(0);
        for (std::size_t i = 0; i < r.blocks.size(); ++i)
            most = std::max({most, std::fabs(now.y_m[i] - start.y_m[i]),
                             r.blocks[i].half_width_m * std::fabs(now.theta_rad[i] - start.theta_rad[i])});
    }
    return most / depth;
}

} // namespace

TEST(ExtendedRest, AColumnStaysWhereItIsPut)
{
    const double depth = 6 * 0.1355 * gravity / (1e8 * 0.048);
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points})
        for (const auto& [name, set] : ways_to_rest()) {
            if (form != ContactForm::area && name == std::string_view("mortar"))
                continue; // has no such law
            Realization r = stack(uneven_drums(3), {1e8, 0.1}, 1e-5);
            r.form = form;
            set(r);
            r.step_s = 0.9 * step_bound(r).dt_s;
            EXPECT_LT(unrest(r, depth), 1e-3) << name << ' ' << static_cast<int>(form);
        }
}

TEST(ExtendedRest, AColonnadeStaysWhereItIsPut)
{
    Bed bed;
    bed.xi = 0.1;
    for (const auto& [name, set] : ways_to_rest()) {
        Realization r = colonnade(paper_colonnade(2), bed, 1);
        set(r);
        if (r.joints[1].mechanisms.wedge_rad != 0) // one that a redundant frame can close
            r.joints[1].mechanisms.wedge_rad = 2e-5;
        r.step_s = 0.9 * step_bound(r).dt_s;
        std::vector<Pose> poses;
        for (const Block& block : r.blocks)
            poses.push_back({block.x_m, block.y_m, 0});
        std::vector<double> spring;
        EXPECT_LT(settle(r, beds_at_rest(r), poses, spring), 1e-6) << name;
        EXPECT_LT(unrest(r, 2e-6), 1e-2) << name;
    }
}

TEST(ExtendedStepBound, HoldsForRandomStacks)
{
    // small shocks at .999 of the bound, with every form and the mechanisms that stiffen or damp: what the scheme
    // cannot follow grows without limit within some hundred steps
    std::mt19937 random(5);
    std::uniform_real_distribution<double> draw(0, 1);
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<Stone> stones;
        const int count = 1 + trial % 7;
        for (int i = 0; i < count; ++i)
            stones.push_back({0.04 + 0.03 * draw(random), 0.01 + 0.08 * draw(random), 0.05 + draw(random), 0});
        const Bed bed{1e7 * std::pow(100, draw(random)), 0.5 * draw(random), 0.7, trial % 2 == 0};
        Realization r = stack(stones, bed, 1);
        r.form = static_cast<ContactForm>(trial % 3);
        const bool all = draw(random) < 0.5;
        each_joint(r, [&](JointMechanisms& e) {
            if (!all)
                return;
            e.face_damping = draw(random);
            e.rate_s_m = 2 * draw(random);
            e.force_exponent = 1 + 0.5 * draw(random);
            e.reference_overlap_m2 = count * 5.0 / bed.K_n;
            e.dowel_stiffness_n_m = 1e7 * draw(random);
            e.dowel_yield_n = 1e3;
        });
        for (Joint& joint : r.joints)
            if (all)
                joint.strengthening = {.bearing_n_m = 1e6 * draw(random),
                                       .bearing_n_s_m = 100 * draw(random),
                                       .bearing_per_m = 2 * draw(random),
                                       .hold_n = 1e3,
                                       .hold_stiffness_n_m = 1e7 * draw(random),
                                       .hold_length_m = 0.01,
                                       .hold_spread_m = 0.02 * draw(random)};
        if (all)
            r.blocks.back().strengthening.tendon_n_m = 1e7 * draw(random);
        r.with_mechanisms = true;
        r.step_s = 0.999 * step_bound(r).dt_s;
        const Study study = still(20000 * r.step_s);
        LaneSet set(study, nullptr, kernels(best_isa()), r);
        set.load(0, r);
        for (int b = 1; b <= count; ++b)
            nudge(set, 0, b, draw(random) - 0.5, draw(random) - 0.5, 20 * (draw(random) - 0.5));
        set.advance(0, 4);
        for (int b = 1; b <= count; ++b)
            nudge(set, 0, b, 0, 0, 0);
        const Snapshot start = set.snapshot(0);
        set.advance(4, chunk_steps);
        double most = 0;
        while (!set.outcome(0)) {
            set.advance();
            const Snapshot now = set.snapshot(0);
            for (std::size_t i = 0; i < r.blocks.size(); ++i)
                most = std::max(most, std::fabs(now.y_m[i] - start.y_m[i]));
        }
        EXPECT_NE(set.outcome(0)->state, State::invalid) << trial;
        EXPECT_LT(most, 1e-5) << trial; // a few overlaps
    }
}

TEST(ExtendedStepBound, TwoCornersAgainstTheirMatrices)
{
    // springs and dashpots of K B / 2 and C / 2 at the ends of each face, assembled one by one; the largest step by
    // halving on 4 M - 2 dt C - dt2 K
    for (const double xi : {0.0, 0.1, 0.3}) {
        Realization r = spec({1e8, xi}, 1e-5);
        r.form = ContactForm::two_corner;
        r.gravity_m_s2 = 1e-6; // its geometric stiffness apart
        const Eigen::Index n = 18;
        Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), K = M, C = M;
        const double b = 0.024, h = 0.0145;
        for (Eigen::Index i = 0; i < 6; ++i) {
            M(3 * i, 3 * i) = M(3 * i + 1, 3 * i + 1) = 0.1355;
            M(3 * i + 2, 3 * i + 2) = r.blocks[1].inertia_kg_m2;
            const auto row = [&](bool vertical, double x) {
                Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
                v(3 * i + (vertical ? 1 : 0)) = 1;
                v(3 * i + 2) = vertical ? x : h;
                if (i > 0) {
                    v(3 * i - 3 + (vertical ? 1 : 0)) = -1;
                    v(3 * i - 1) = vertical ? -x : h;
                }
                return v;
            };
            const Joint& joint = r.joints[static_cast<std::size_t>(i)];
            for (const double x : {-b, b}) {
                K += 1e8 * 0.024 * row(true, x) * row(true, x).transpose();
                C += 0.5 * joint.normal_damping_n_s_m * row(true, x) * row(true, x).transpose();
            }
            K += joint.tangential_stiffness_n_m * row(false, 0) * row(false, 0).transpose();
            C += joint.tangential_damping_n_s_m * row(false, 0) * row(false, 0).transpose();
        }
        double low = 0, high = 1e-3;
        while (high - low > 1e-12) {
            const double dt = 0.5 * (low + high);
            const Eigen::MatrixXd left = 4 * M - 2 * dt * C - dt * dt * K;
            (Eigen::LLT<Eigen::MatrixXd>(left).info() == Eigen::Success ? low : high) = dt;
        }
        EXPECT_NEAR(linear_response(r).step_s, low, 1e-6 * low) << xi;
        EXPECT_LT(step_bound(r).dt_s, low) << xi;
        EXPECT_GT(step_bound(r).dt_s, 0.5 * low) << xi;
    }
}

TEST(ExtendedEnergy, Balances)
{
    // drums that rock and slide hard; the baseline's own residual is of the order of depth / width
    const Study study = harmonic(8, 1);
    Realization plain = stack(uneven_drums(7), {1e8, 0.1, 0.3}, 2e-5);
    plain.frequency_hz = 4;
    plain.pga_m_s2 = 3;
    plain.with_mechanisms = true;
    std::vector<Realization> all;
    const auto add = [&](const std::function<void(JointMechanisms&)>& set) {
        all.push_back(plain);
        each_joint(all.back(), set);
    };
    add([](JointMechanisms&) {});
    add([](JointMechanisms& e) { e.dynamic_ratio = 0.5, e.stribeck_velocity_m_s = 0.02; });
    add([](JointMechanisms& e) { e.adhesion_n_m = 30, e.wear_per_m = 3; });
    add([](JointMechanisms& e) { e.dowel_stiffness_n_m = 1e5, e.dowel_yield_n = 2, e.dowel_gap_m = 1e-4; });
    add([](JointMechanisms& e) { e.force_exponent = 1.4, e.reference_overlap_m2 = 5e-8; });
    add([](JointMechanisms& e) { e.rate_s_m = 1, e.face_damping = 0.7; });
    add([](JointMechanisms& e) { e.chip_left_m = 0.002, e.corner_wear_m_rad = 0.001; });
    add([](JointMechanisms& e) { e.wedge_rad = 0.002; });
    for (const ContactForm form : {ContactForm::two_corner, ContactForm::points}) {
        all.push_back(plain);
        all.back().form = form;
    }
    all.push_back(plain);
    for (Block& block : all.back().blocks) {
        block.mechanisms.drag_n_s2_m2 = 2;
        block.mechanisms.eccentricity_m = block.fixed ? 0 : 0.001;
    }
    all.push_back(plain);
    for (Block& block : all.back().blocks) {
        block.mechanisms.tie_n_m = 60;
        block.mechanisms.tie_n_s_m = 1;
        block.mechanisms.tie_n_m_s = 1e-4;
    }
    all.push_back(plain);
    all.back().base = {2e-3, 0.5};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Outcome o = run_one(study, all[i]);
        EXPECT_NE(o.state, State::invalid) << i;
        EXPECT_LT(std::fabs(o.energy_residual), 0.03) << i;
        EXPECT_GT(o.energy_damping_j, 0) << i;
    }
}
