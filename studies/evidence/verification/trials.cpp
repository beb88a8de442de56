#include "studies/evidence/verification/trials.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/planar/structure/settle.hpp"
#include "studies/evidence/verification/reference_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stylobate::verification {

namespace {

using reference::Number;
using reference::Solver;
using reference::State;

double rate_of(const Realization& r, int block)
{
    return std::sqrt(0.75 * r.gravity_m_s2 /
                     std::hypot(block_of(r, block).half_width_m, block_of(r, block).half_height_m));
}

double slenderness_of(const Realization& r, int block)
{
    return std::atan(block_of(r, block).half_width_m / block_of(r, block).half_height_m);
}

/// Free motion in the engine, step by step.
class FreeRun {
public:
    FreeRun(const Realization& r, double limit_s, const ContactSpec& contact = {})
        : study_(still(limit_s, contact)), set_(study_, nullptr, kernels(Isa::scalar), r)
    {
        set_.load(0, r);
    }
    void step()
    {
        const int k = n_++ % chunk_steps;
        set_.advance(k, k + 1);
    }
    double angle(int block) const { return set_.snapshot(0).theta_rad[static_cast<std::size_t>(block)]; }

private:
    static Study still(double limit_s, const ContactSpec& contact)
    {
        Study study = model::still(limit_s + 1);
        study.contact = contact;
        return study;
    }

    Study study_;
    LaneSet set_;
    int n_ = 0;
};

/// The engine's start, in absolute positions.
std::vector<State> start_of(const Realization& r)
{
    const StaticState rest = static_state(r);
    std::vector<State> states;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        states.push_back(
            {{Number(r.blocks[i].x_m) + rest.x_m[i], Number(r.blocks[i].y_m) + rest.y_m[i]}, rest.theta_rad[i]});
    return states;
}

/// Free motion by the second solver.
class ReferenceRun {
public:
    explicit ReferenceRun(const Realization& r) : solver_(r, start_of(r)) {}
    void step() { solver_.step(0); }
    double angle(int block) const { return static_cast<double>(solver_.block(static_cast<std::size_t>(block)).angle); }

private:
    Solver solver_;
};

template <class Run>
double upright_time(Run run, const Realization& r, const std::vector<int>& blocks, double limit_s)
{
    const auto lean = [&] {
        double sum = 0;
        for (const int block : blocks)
            sum += run.angle(block) / static_cast<double>(blocks.size());
        return sum;
    };
    double before = lean();
    for (int n = 0; n * r.step_s < limit_s; ++n) {
        run.step();
        const double now = lean();
        if (now <= 0)
            return r.step_s * (n + before / (before - now));
        before = now;
    }
    throw std::runtime_error("the block did not come through the upright position in time");
}

template <class Run>
double restitution(Run run, const Realization& r, int block, double limit_s)
{
    const double alpha = slenderness_of(r, block);
    double lowest = 0;
    for (int n = 0; n * r.step_s < limit_s; ++n) {
        run.step();
        const double now = run.angle(block);
        if (lowest < -1e-3 * alpha && now > lowest) {
            const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
            return std::sqrt(energy(-lowest) / energy(r.initial_tilt_rad));
        }
        lowest = std::min(lowest, now);
    }
    throw std::runtime_error("the block did not come back from its first impact in time");
}

/// Steps until `enough` says so; at most to the end of the base's motion and `more_s` beyond.
template <class Enough>
void follow(const Realization& r, Solver& solver, const BaseMotion& base, double more_s, Enough enough)
{
    for (int n = 0; n * r.step_s < base.duration_s() + more_s; ++n) {
        solver.step(base.displacement_m((n + 1) * r.step_s));
        if (enough())
            return;
    }
}

} // namespace

Realization leaned_block(const model::Stone& stone, double K_n, double part, double step_rate, double xi)
{
    const model::Bed bed{K_n, xi, 5, true};
    Realization r = model::single(stone, bed, step_rate / model::bed_rate(bed, stone), 2 * stone.width);
    r.initial_tilt_rad = part * model::slenderness(stone);
    return r;
}

double upright_time(const Realization& r, const std::vector<int>& blocks)
{
    const double limit_s = 5 / rate_of(r, blocks.front());
    return upright_time(FreeRun(r, limit_s), r, blocks, limit_s);
}

double reference_upright_time(const Realization& r, const std::vector<int>& blocks)
{
    return upright_time(ReferenceRun(r), r, blocks, 5 / rate_of(r, blocks.front()));
}

double impact_restitution(const Realization& r, const ContactSpec& contact, int block)
{
    const double limit_s = 8 / rate_of(r, block);
    return restitution(FreeRun(r, limit_s, contact), r, block, limit_s);
}

double reference_restitution(const Realization& r)
{
    return restitution(ReferenceRun(r), r, 1, 8 / rate_of(r, 1));
}

ReferenceShaken reference_shaken(const Study& study, const Realization& r, double rotation_rad, double height_fraction)
{
    const BaseMotion base(study.excitation, r, nullptr);
    Solver solver(r, start_of(r));
    ReferenceShaken found;
    const auto ground = static_cast<double>(r.blocks[0].y_m + r.blocks[0].half_height_m);
    follow(r, solver, base, 0, [&] {
        const std::vector<State>& blocks = solver.blocks();
        for (std::size_t i = 1; i < blocks.size(); ++i) {
            found.rocks = found.rocks || std::fabs(blocks[i].angle - blocks[i - 1].angle) > rotation_rad;
            found.falls = found.falls ||
                          static_cast<double>(blocks[i].at.y()) - ground < height_fraction * (r.blocks[i].y_m - ground);
        }
        return found.falls;
    });
    return found;
}

int reference_way(const Study& study, const Realization& r)
{
    const BaseMotion base(study.excitation, r, nullptr);
    Solver solver(r, start_of(r));
    const double alpha = slenderness_of(r, 1), clear = 0.01 * alpha;
    int side = 1, crossings = 0; // the base first accelerates to +x: the block leans to -x, counter-clockwise
    double now = 0;
    follow(r, solver, base, 12 / rate_of(r, 1), [&] {
        now = static_cast<double>(solver.block(1).angle);
        if (side * now < -clear) {
            side = -side;
            ++crossings;
        }
        return std::fabs(now) > 1.5 * alpha + 0.3;
    });
    return std::fabs(now) < alpha ? 0 : 1 + crossings;
}

HeldState hold(const Realization& r, double acceleration)
{
    model::BareColumn column(r);
    column.put(static_state(r));
    const Scales scales = scales_of(r);
    const double p = scales.p_rad_s, dt = r.step_s, rise = 10 / p, end = 70 / p;
    const auto moved = [&] {
        for (int i = 0; i < column.blocks(); ++i) {
            const Block& block = r.blocks[static_cast<std::size_t>(i)];
            if (std::fabs(column.at(OfBlock::theta, i)) > std::atan(block.half_width_m / block.half_height_m))
                return true;
        }
        return column.at(OfRealization::slip) > 0.01 * scales.width_m;
    };
    HeldState state;
    int n = 0;
    for (double t = 0; t < end; t += dt, ++n) {
        const double x = std::min(t / rise, 1.0);
        column.step(acceleration * x * x * (3 - 2 * x) * dt * dt);
        column.slow_down(2 * p * dt);
        if (n % 256 == 0 && moved())
            return state;
    }
    state.stays = !moved();
    const auto pose = [&](int block) {
        const Block& b = r.blocks[static_cast<std::size_t>(block)];
        return Pose{b.x_m + column.at(OfBlock::x, block), b.y_m + column.at(OfBlock::y, block),
                    column.at(OfBlock::theta, block)};
    };
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const auto area = overlap_of(r.blocks[static_cast<std::size_t>(joint.lower)], pose(joint.lower),
                                     r.blocks[static_cast<std::size_t>(joint.upper)], pose(joint.upper))
                              .area;
        state.pressure_n.push_back(joint.normal_stiffness_n_m2 * area);
    }
    return state;
}

double largest_held_acceleration(const Realization& r, double low, double high, double tolerance)
{
    if (!hold(r, low).stays || hold(r, high).stays)
        throw std::runtime_error("the ends do not bracket the largest acceleration that is held");
    while (high - low > tolerance) {
        const double middle = 0.5 * (low + high);
        (hold(r, middle).stays ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace stylobate::verification
