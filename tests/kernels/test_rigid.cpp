/// The rigid form against oracles that share no code with it: Housner's block, sliding under a pulse, limit analysis.

#include "ensemble/planar/rigid_order.hpp"
#include "ensemble/planar/structure/limit_analysis.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/trials.hpp"

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
            const double limit = limit_acceleration(r).acceleration_m_s2;
            EXPECT_LT(moved_under(r, 0.999 * limit), 1e-6) << mu << ' ' << stack;
            EXPECT_GT(moved_under(r, 1.01 * limit), 1e-3) << mu << ' ' << stack;
        }
}

/// Epistyles make loops of beds; one over three columns relates beds that share no block. The load comes at once, which
/// is the hardest to find forces for.
TEST(Rigid, FramesMoveFromTheAccelerationOnThatLimitAnalysisGives)
{
    for (const int columns : {2, 3, 4})
        for (const int drums : {1, 2, 3})
            for (const bool whole : {false, true}) {
                model::Colonnade c = model::paper_colonnade(drums);
                c.columns = columns;
                if (columns > 2 && whole)
                    c.epistyle.width += (columns - 2) * c.spacing;
                else if (columns > 2)
                    c.epistyle.width = 0.98 * c.spacing; // each ends short of the middle of its seats
                c.one_epistyle = columns == 2 || whole;
                if (columns == 2 && whole)
                    continue;
                for (const double mu : {0.2, 0.5, 0.7, 5.0}) {
                    model::Bed bed;
                    bed.mu = mu;
                    const Realization r = rigid(model::colonnade(c, bed, 1e-3, false), 1e-3);
                    const double limit = limit_acceleration(r).acceleration_m_s2;
                    for (const double part : {0.3, 0.5, 0.6, 0.8, 0.9, 0.95, 0.99})
                        EXPECT_LT(moved_under(r, part * limit), part < 0.99 ? 1e-4 : 1e-3)
                            << mu << ' ' << columns << ' ' << drums << ' ' << whole << ' ' << part;
                    EXPECT_GT(moved_under(r, 1.01 * limit), 1e-3) << mu << ' ' << columns << ' ' << drums;
                }
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
    FallingBlock(double height_m, double restitution, double step_s, double expansion = 0) : height_m_(height_m)
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
        bundle_.at(OfRigidJoint::expansion, 0, 0) = expansion;
        bundle_.at(OfRigid::expands, 0) = expansion > 0;
        bundle_.at(OfRealization::gravity_dy, 0) = -dt2 * gravity;
    }
    /// How high it comes after it has met the face.
    double rebound_m()
    {
        double y = height_m_, before = y;
        do {
            before = y;
            y = step();
        } while (y < before);
        EXPECT_NEAR(before, 0, 0.02 * height_m_); // within the path of a step
        double highest = y;
        for (int n = 0; n < 100 && y >= highest; ++n) {
            y = step();
            highest = std::max(highest, y);
        }
        return highest;
    }

private:
    double step()
    {
        kernels(Isa::scalar).planar.run(topology_, bundle_, 0, 1);
        return bundle_.at(OfBlock::y, 1, 0);
    }

    const double height_m_;
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
        EXPECT_NEAR(block.rebound_m(), e * e * height_m, 0.03 * height_m) << e;
    }
}

/// Poisson's law is the same there: nothing else is compressed.
TEST(Rigid, ABlockThatFallsFlatReboundsByItsExpansion)
{
    constexpr double height_m = 0.05, step_s = 1e-3;
    for (const double e : {0.3, 0.7}) {
        FallingBlock block(height_m, 0, step_s, e);
        EXPECT_NEAR(block.rebound_m(), e * e * height_m, 0.03 * height_m) << e;
    }
}

/// The rate of rotation after the first impact of a rocking block, over the one before it, by impulses at the new
/// corner: a plastic impact, then the part of its normal impulse that is given back while friction holds.
double poisson_rate_ratio(const model::Stone& stone, double part)
{
    const double b = stone.width / 2, h = stone.height / 2;
    const double inertia_per_mass = (b * b + h * h) / 3;
    // about the old corner (-b, -h) with rate -1: the centre's velocity is (-h, b) x rate... of a unit rate
    const double vx = h, vy = -b, w = -1;
    // velocity of the new corner (b, -h), and its response to unit impulses per mass, along x and y
    const double cx = vx + w * h, cy = vy + w * b;
    const double xx = 1 + h * h / inertia_per_mass, yy = 1 + b * b / inertia_per_mass, xy = h * b / inertia_per_mass;
    const double determinant = xx * yy - xy * xy;
    const double jx = -(yy * cx - xy * cy) / determinant, jy = -(xx * cy - xy * cx) / determinant;
    const double back_y = part * jy, back_x = -xy * back_y / xx;
    return (w + (b * (jy + back_y) + h * (jx + back_x)) / inertia_per_mass) / w;
}

TEST(Rigid, AnImpactGivesBackItsPartOfTheImpulse)
{
    for (const double part : {0.0, 0.2, 0.5}) {
        Realization r = leaned(0.5, 1.0 / 16000);
        r.restitution_law = RestitutionLaw::poisson;
        r.joints[0].restitution = part;
        const Study study = model::still(2);
        LaneSet set(study, nullptr, kernels(Isa::scalar), r);
        set.load(0, r);
        std::vector<double> turned{set.snapshot(0).theta_rad[1]};
        int after = 0; // steps since upright
        for (int n = 0; after < 6; ++n) {
            set.advance(n % chunk_steps, n % chunk_steps + 1);
            turned.push_back(set.snapshot(0).theta_rad[1]);
            after += turned.back() * turned.front() <= 0 || after > 0;
        }
        const std::size_t last = turned.size() - 1;
        const double before = turned[last - 7] - turned[last - 8], now = turned[last] - turned[last - 1];
        EXPECT_NEAR(now / before, poisson_rate_ratio(mono_stone, part), 5e-3) << part;
    }
}

/// A plank without friction that tips over the corner of what is below it slides along that corner: the corner presses
/// across the plank. Lagrange's equations of the plank with this one condition, by Runge and Kutta.
struct Plank {
    double half_height, inertia_per_mass;
    std::array<double, 6>
    rates(const std::array<double, 6>& s) const ///< x, y from the corner, rotation; and their rates
    {
        const double sine = std::sin(s[2]), cosine = std::cos(s[2]), w = s[5];
        const double along =
            -(s[0] * cosine + s[1] * sine); // d (distance of the corner from the plank's middle) / d turn
        const double whirl = 2 * w * (s[3] * cosine + s[4] * sine);
        const double force = (gravity * cosine + whirl + w * w * half_height) / (1 + along * along / inertia_per_mass);
        return {s[3], s[4], s[5], -sine * force, cosine * force - gravity, along * force / inertia_per_mass};
    }
    void step(std::array<double, 6>& s, double dt) const
    {
        const auto moved = [&](const std::array<double, 6>& by, double t) {
            std::array<double, 6> out = s;
            for (std::size_t i = 0; i < 6; ++i)
                out[i] += t * by[i];
            return out;
        };
        const auto k1 = rates(s), k2 = rates(moved(k1, dt / 2)), k3 = rates(moved(k2, dt / 2)),
                   k4 = rates(moved(k3, dt));
        for (std::size_t i = 0; i < 6; ++i)
            s[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
};

TEST(Rigid, APlankSlidesAlongTheCornerThatItTipsOver)
{
    constexpr double beyond_m = 0.1, end_s = 0.3;
    const model::Stone stone{1, 0.04, 1, 0.05 + beyond_m};
    model::Bed bed;
    bed.mu = 0;
    double before = 0;
    for (const double rate_hz : {500.0, 2000.0}) {
        const Realization r = rigid(model::single(stone, bed, 1 / rate_hz, 0.1), 1 / rate_hz);
        const Study study = model::still(1);
        LaneSet set(study, nullptr, kernels(Isa::scalar), r);
        set.load(0, r);
        const int steps = static_cast<int>(end_s * rate_hz);
        for (int n = 0; n < steps; ++n)
            set.advance(n % chunk_steps, n % chunk_steps + 1);
        const Snapshot now = set.snapshot(0);
        const Plank plank{stone.height / 2, (1 + stone.height * stone.height) / 12};
        std::array<double, 6> wanted{beyond_m, stone.height / 2, 0, 0, 0, 0};
        for (int n = 0; n < 3000; ++n)
            plank.step(wanted, end_s / 3000);
        EXPECT_LT(wanted[2], -0.3) << "it hardly turns";
        const double error = std::hypot(now.x_m[1] - 0.05 - wanted[0], now.y_m[1] - wanted[1]) +
                             0.1 * std::fabs(now.theta_rad[1] - wanted[2]);
        EXPECT_LT(error, 2 / rate_hz);
        before = error;
    }
    EXPECT_LT(before, 5e-4);
}

/// Blocks that fall go on as contacts by area have it, and lie at last.
TEST(Rigid, AToppledBlockLiesOnItsSide)
{
    Study study = model::still(4);
    study.outcome.follow = Follow::rest;
    for (const double rate_hz : {500.0, 1000.0}) {
        Realization r = rigid(model::single(mono_stone, {}, 1 / rate_hz, 2), 1 / rate_hz);
        r.initial_tilt_rad = 1.02 * model::slenderness(mono_stone);
        const Outcome o = model::run_one(study, r);
        EXPECT_EQ(o.state, State::collapsed);
        EXPECT_LT(std::fabs(o.energy_residual), 0.1); // it comes down flat, in few steps
        // it has lost the height of its centre
        const double fell_m =
            std::hypot(mono_stone.width, mono_stone.height) / 2 * std::cos(0.02 * model::slenderness(mono_stone)) -
            mono_stone.width / 2;
        EXPECT_NEAR(o.energy_potential_j, -mono_stone.mass * gravity * fell_m,
                    0.01 * mono_stone.mass * gravity * fell_m);
        EXPECT_LT(o.energy_kinetic_j, 1e-3);
        EXPECT_NEAR(o.end_time_s, 4, 0.1);
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
