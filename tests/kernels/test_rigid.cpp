/// The rigid form against oracles that share no code with it: Housner's block, sliding under a pulse, limit analysis.

#include "ensemble/engine/rigid_order.hpp"
#include "studies/evidence/verification/colonnade.hpp"
#include "studies/evidence/verification/limit_analysis.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/rigid_slider.hpp"
#include "studies/evidence/verification/rocking_block.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

using model::gravity;
using model::mono_stone;

Realization rigid(Realization r, double step_s)
{
    r.form = ContactForm::rigid;
    r.step_s = step_s;
    return r;
}

Realization leaned(double part, double step_s)
{
    return rigid(verification::leaned_block(mono_stone, 1e8, part, 1), step_s);
}

/// The least overturning half sine of w = 4 p, over g tan alpha.
double overturning(double step_s)
{
    const Realization upright = leaned(0, step_s);
    return model::least_overturning(
        model::pulse(ExcitationKind::half_sine),
        [&](double eta) {
            Realization r = upright;
            r.frequency_hz = 4 * model::rocking_rate(mono_stone) / (2 * model::pi);
            r.pga_m_s2 = eta * gravity * mono_stone.width / mono_stone.height;
            return r;
        },
        1.5, 4.5, 1e-4);
}

TEST(Rigid, ABlockRocksAsHousnersDoes)
{
    const verification::RigidBlock block = verification::rigid_block(mono_stone.width, mono_stone.height);
    const auto quarter_period_s = static_cast<double>(verification::quarter_period(block, 0.5L * block.alpha));
    const double eta = verification::half_sine_edge(block, 4);
    for (const auto& [rate_hz, tolerance] : {std::pair{120.0, 1e-3}, {240.0, 1e-3}, {480.0, 5e-4}, {1920.0, 1e-4}})
        EXPECT_NEAR(verification::upright_time(leaned(0.5, 1 / rate_hz)) / quarter_period_s, 1, tolerance) << rate_hz;
    for (const auto& [rate_hz, tolerance] : {std::pair{120.0, 7e-3}, {240.0, 1.5e-3}, {480.0, 1e-3}, {1920.0, 3e-4}})
        EXPECT_NEAR(overturning(1 / rate_hz) / eta, 1, tolerance) << rate_hz;
}

TEST(Rigid, LosesAtAnImpactWhatHousnerSaysOnTheMeanOverItsPhase)
{
    const double alpha = model::slenderness(mono_stone), wanted = 1 - 1.5 * std::pow(std::sin(alpha), 2);
    constexpr double step_s = 1.0 / 240;
    double sum = 0;
    constexpr int phases = 64;
    for (int i = 0; i < phases; ++i) { // a little more lean: the impact comes at another time within the step
        const double e = verification::impact_restitution(leaned(0.5 + 0.03 * i / phases, step_s));
        EXPECT_NEAR(e, wanted, 4e-3) << i;
        sum += e;
    }
    EXPECT_NEAR(sum / phases, wanted, 5e-4);
}

/// A flat block, which slides and does not rock.
Realization slider(double mu, double step_s)
{
    model::Bed bed;
    bed.mu = mu;
    return rigid(model::single({0.4, 0.02, 1}, bed, step_s, 10), step_s);
}

TEST(Rigid, SlidesUnderPulsesAsCoulombHasIt)
{
    constexpr double mu = 0.2, f = 1, w = 2 * model::pi * f;
    for (const double eta : {1.5, 2.0, 3.0})
        for (const bool full : {false, true}) {
            const double want = verification::pulse_slip(eta, full ? 1 : 0.5).total * mu * gravity / (w * w);
            double before = 0;
            for (const double rate_hz : {200.0, 400.0, 1600.0}) {
                Realization r = slider(mu, 1 / rate_hz);
                r.frequency_hz = f;
                r.pga_m_s2 = eta * mu * gravity;
                const Outcome o =
                    model::run_one(model::pulse(full ? ExcitationKind::full_sine : ExcitationKind::half_sine), r);
                const double error = std::fabs(o.total_sliding_m / want - 1);
                EXPECT_LT(error, rate_hz < 300 ? 1e-2 : 5e-3) << eta << ' ' << full << ' ' << rate_hz;
                EXPECT_NEAR(o.energy_residual, 0, 1e-9);
                before = error;
            }
            EXPECT_LT(before, 1e-3);
        }
}

std::vector<model::Stone> random_stones(unsigned seed, int count)
{
    std::mt19937 bits(seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(bits); };
    std::vector<model::Stone> stones;
    for (int i = 0; i < count; ++i)
        stones.push_back({between(0.04, 0.06), between(0.02, 0.05), between(0.1, 0.2), between(-0.002, 0.002)});
    return stones;
}

/// Largest displacement of any block after a second of a nearly constant acceleration, over the width.
double moved_under(Realization r, double acceleration)
{
    // a base that is tilted has the same forces as one that is accelerated, and lasts
    r.base_tilt_rad = -std::atan(acceleration / r.gravity_m_s2);
    r.gravity_m_s2 = std::hypot(acceleration, r.gravity_m_s2);
    const Study study = model::still(1);
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    for (double t = 0; t < 0.2; t += chunk_steps * r.step_s)
        set.advance();
    const Snapshot now = set.snapshot(0);
    double most = 0;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        most = std::max(most, std::hypot(now.x_m[i] - r.blocks[i].x_m, now.y_m[i] - r.blocks[i].y_m));
    return most / r.blocks[1].half_width_m;
}

TEST(Rigid, StacksMoveFromTheAccelerationOnThatLimitAnalysisGives)
{
    for (const double mu : {0.15, 0.3, 0.7})
        for (int stack = 0; stack < 6; ++stack) {
            model::Bed bed;
            bed.mu = mu;
            const Realization r =
                rigid(model::stack(random_stones(17 + static_cast<unsigned>(stack), 2 + stack), bed, 1e-3, 0.2), 1e-3);
            const double limit = verification::limit_acceleration(r).acceleration_m_s2;
            EXPECT_LT(moved_under(r, 0.999 * limit), 1e-6) << mu << ' ' << stack;
            EXPECT_GT(moved_under(r, 1.01 * limit), 1e-3) << mu << ' ' << stack;
        }
}

/// Epistyles make loops of beds; one over three columns relates beds that share no block.
TEST(Rigid, FramesMoveFromTheAccelerationOnThatLimitAnalysisGives)
{
    model::Colonnade one_over_three = model::paper_colonnade(1), two_over_three = model::paper_colonnade(2);
    one_over_three.columns = two_over_three.columns = 3;
    one_over_three.epistyle.width += one_over_three.spacing;
    two_over_three.one_epistyle = false;
    two_over_three.epistyle.width = 0.98 * two_over_three.spacing; // each ends short of the middle of its seats
    for (const model::Colonnade& c :
         {model::paper_colonnade(1), model::paper_colonnade(3), one_over_three, two_over_three})
        for (const double mu : {0.2, 0.7, 5.0}) {
            model::Bed bed;
            bed.mu = mu;
            const Realization r = rigid(model::colonnade(c, bed, 1e-3, false), 1e-3);
            const double limit = verification::limit_acceleration(r).acceleration_m_s2;
            // Of three columns the contacts are not always found (docs/rigid_limit.md); with 0.7 the limit depends on
            // friction and rocking alike, and more than one state is at rest.
            const auto [part, still] = c.columns == 2 && mu != 0.7 ? std::pair(0.999, 1e-6) : std::pair(0.99, 1e-4);
            EXPECT_LT(moved_under(r, part * limit), still) << mu << ' ' << c.columns << ' ' << c.drums;
            EXPECT_GT(moved_under(r, 1.01 * limit), 1e-3) << mu << ' ' << c.columns << ' ' << c.drums;
        }
}

/// Each bed's losses are sums of its own forces and rates; the blocks' energies are not. Impacts, slips and gaps that
/// are closed all take part.
TEST(Rigid, TheEnergyOfARockingStackBalances)
{
    Study study = model::harmonic(30, 2);
    study.excitation.tail_s = 1;
    double lost = 0;
    int fallen = 0;
    for (unsigned seed = 0; seed < 16; ++seed) {
        model::Bed bed;
        bed.mu = 0.5;
        Realization r = rigid(model::stack(random_stones(seed, 5), bed, 1e-3, 0.2), 1e-3);
        r.frequency_hz = 4;
        r.pga_m_s2 = 4.5;
        const Outcome o = model::run_one(study, r);
        fallen += o.state == State::collapsed;
        EXPECT_LT(std::fabs(o.energy_residual), 0.01) << seed;
        // a fall may gain a little: faces that are turned far against each other are a rough bed
        EXPECT_GT(o.energy_damping_j, o.state == State::collapsed ? 0.05 * o.energy_potential_j : 0) << seed;
        EXPECT_GE(o.energy_friction_j, 0) << seed;
        lost += o.energy_damping_j + o.energy_friction_j;
    }
    EXPECT_GT(lost, 0.1) << "hardly anything moved";
    EXPECT_LT(fallen, 16);
}

/// Slender columns with a wide cap rock as one block of another frequency parameter (Makris and Vassiliou).
TEST(Rigid, AFrameRocksAsItsEquivalentBlock)
{
    model::Bed bed;
    bed.mu = 5;
    model::Colonnade wide;
    wide.spacing = 8;
    wide.drum = {1, 4, 1e4};
    wide.epistyle = {9.4, 0.5, 2e4};
    Realization r = rigid(model::colonnade(wide, bed, 1.0 / 480, false), 1.0 / 480);
    const verification::RigidBlock frame = verification::rigid_frame(wide.drum.width, wide.drum.height, 1);
    for (const double part : {0.3, 0.5}) {
        r.initial_tilt_rad = part * static_cast<double>(frame.alpha);
        const auto wanted = static_cast<double>(verification::quarter_period(frame, part * frame.alpha));
        EXPECT_NEAR(verification::upright_time(r), wanted, 2e-3 * wanted);
    }
}

/// Rocking columns are chaotic: the mirror image is compared for as long as a difference of rounding stays small.
TEST(Rigid, TheMirrorImageMovesAsTheMirrorImage)
{
    std::vector<model::Stone> stones = random_stones(5, 6), mirrored = stones;
    for (model::Stone& s : mirrored)
        s.offset = -s.offset;
    const Study study = model::harmonic(4, 2);
    const auto follow = [&](const std::vector<model::Stone>& of, double phase) {
        Realization r = rigid(model::stack(of, {}, 1e-3, 0.2), 1e-3);
        r.frequency_hz = 4;
        r.pga_m_s2 = 5;
        r.phase_rad = phase;
        LaneSet set(study, nullptr, kernels(Isa::scalar), r);
        set.load(0, r);
        for (int chunk = 0; chunk < 9; ++chunk)
            set.advance();
        return set.snapshot(0);
    };
    const Snapshot a = follow(stones, 0), b = follow(mirrored, model::pi);
    double turned = 0;
    for (std::size_t i = 0; i < a.x_m.size(); ++i) {
        EXPECT_NEAR(a.x_m[i], -b.x_m[i], 1e-9) << i;
        EXPECT_NEAR(a.y_m[i], b.y_m[i], 1e-9) << i;
        EXPECT_NEAR(a.theta_rad[i], -b.theta_rad[i], 1e-8) << i;
        turned = std::max(turned, std::fabs(a.theta_rad[i]));
    }
    EXPECT_GT(turned, 1e-3) << "nothing rocked";
}

/// Before the first impact the motion is smooth, and its error is of second order.
TEST(Rigid, ConvergesWithTheSquareOfTheStep)
{
    const auto lean_after =
        [&](double step_s) { // 0.09 s after it is let go, one of 1/11 of the quarter period before upright
            const Realization r = leaned(0.5, step_s);
            const Study study = model::still(1);
            LaneSet set(study, nullptr, kernels(Isa::scalar), r);
            set.load(0, r);
            const int steps = static_cast<int>(std::lround(0.1 / step_s));
            for (int n = 0; n < steps; ++n)
                set.advance(n % chunk_steps, n % chunk_steps + 1);
            return set.snapshot(0).theta_rad[1];
        };
    const double exact = lean_after(0.1 / 12800);
    const double coarse = std::fabs(lean_after(0.1 / 50) - exact), fine = std::fabs(lean_after(0.1 / 200) - exact);
    EXPECT_GT(std::log(coarse / fine) / std::log(4), 1.8);
}

/// A block by itself above a fixed one, with every field open.
class FallingBlock {
public:
    FallingBlock(double height_m, double restitution, double step_s)
    {
        topology_.blocks = 2;
        topology_.fixed = topology_.joints = topology_.top = 1;
        topology_.joint = &joint_;
        topology_.model.form = ContactForm::rigid;
        topology_.stack = true;
        order_ = rigid_order(topology_);
        topology_.rigid_order = order_.list.data();
        memory_.resize(bundle_registers(topology_));
        bundle_ = bind_bundle(topology_, 1, memory_.data());
        const double dt2 = step_s * step_s;
        for (int block = 0; block < 2; ++block) {
            bundle_.at(OfBlock::half_width, block, 0) = block == 0 ? 1 : 0.05;
            bundle_.at(OfBlock::half_height, block, 0) = 0.03;
            bundle_.at(OfBlock::most_turn, block, 0) = 1;
            bundle_.at(OfBlock::least_y, block, 0) = -1;
        }
        bundle_.at(OfBlock::mass, 1, 0) = bundle_.at(OfBlock::inertia, 1, 0) = 1;
        bundle_.at(OfBlock::dt2_per_mass, 1, 0) = bundle_.at(OfBlock::dt2_per_inertia, 1, 0) = dt2;
        bundle_.at(OfRigidBlock::mass_per_dt2, 1, 0) = bundle_.at(OfRigidBlock::inertia_per_dt2, 1, 0) = 1 / dt2;
        bundle_.at(OfBlock::y, 1, 0) = height_m;
        bundle_.at(OfJoint::height, 0, 0) = 0.06;
        bundle_.at(OfJoint::mu, 0, 0) = 0.5;
        bundle_.at(OfRigidJoint::restitution, 0, 0) = restitution;
        bundle_.at(OfRealization::gravity_dy, 0) = -dt2 * gravity;
    }
    double step()
    {
        kernels(Isa::scalar).run(topology_, bundle_, 0, 1);
        return bundle_.at(OfBlock::y, 1, 0);
    }

private:
    const TopologyJoint joint_{0, 1};
    Topology topology_;
    RigidOrder order_;
    std::vector<double> memory_;
    Bundle bundle_;
};

/// It comes up again to e2 of the height that it fell from.
TEST(Rigid, ABlockThatFallsFlatReboundsByItsRestitution)
{
    constexpr double height_m = 0.05, step_s = 1e-3;
    for (const double e : {0.0, 0.3, 0.7}) {
        FallingBlock block(height_m, e, step_s);
        double y = height_m, before = y;
        do {
            before = y;
            y = block.step();
        } while (y < before);
        EXPECT_NEAR(before, 0, 0.02 * height_m) << e; // within the path of a step
        double highest = y;
        for (int n = 0; n < 100 && y >= highest; ++n) {
            y = block.step();
            highest = std::max(highest, y);
        }
        EXPECT_NEAR(highest, e * e * height_m, 0.03 * height_m) << e;
    }
}

TEST(Rigid, TwelveBlocksLieStillForAHundredSeconds)
{
    const Realization r =
        rigid(model::stack(std::vector<model::Stone>(12, model::spec_drum), {}, 1.0 / 240), 1.0 / 240);
    const Study study = model::still(100);
    const Outcome o = model::run_one(study, r);
    EXPECT_GE(o.end_time_s, 100);
    EXPECT_LT(o.top_path_m, 1e-12);
    EXPECT_LT(o.max_relative_rotation_rad, 1e-13);
}

} // namespace
} // namespace stylobate
