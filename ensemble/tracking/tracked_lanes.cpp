#include "ensemble/tracking/tracked_lanes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

std::vector<double> TrackedLanes::state(int lane) const
{
    std::vector<double> registers(state_registers());
    for (std::size_t i = 0; i < registers.size(); ++i)
        registers[i] = set_.model().memory()[i * stride() + static_cast<std::size_t>(lane)];
    return registers;
}

void TrackedLanes::load(int lane, Realization realization, int phase)
{
    set_.load(lane, std::move(realization));
    begin(lane, phase, 0);
}

void TrackedLanes::load(int lane, Realization realization, int phase, const std::vector<double>& state,
                        std::uint64_t step)
{
    assert(state.size() == state_registers() && "the state is one of the same structure and model");
    const Realization& r = set_.occupy(lane, std::move(realization)).realization;
    for (std::size_t i = 0; i < state.size(); ++i)
        set_.model().memory()[i * stride() + static_cast<std::size_t>(lane)] = state[i];
    if (topology().model.has_mechanism_rows())
        for (int i = 0; i < static_cast<int>(r.blocks.size()); ++i)
            nudge(lane, i, 0, 0, 0);
    begin(lane, phase, step);
}

/// The rows of the tables of the base's motion that are still to come in this chunk.
void TrackedLanes::begin(int lane, int phase, std::uint64_t step)
{
    assert(!set_.model().single() && "what is tracked is stepped in double precision");
    assert(set_.bases().on_host() && "formulas fill the table of all lanes at once");
    const LaneSet::Place& place = set_.place(lane);
    set_.bases().first_step(lane) = static_cast<double>(step) - phase;
    place.motions[0].fill(set_.bases().first_step(lane), set_.model().bundle().rows<OfBase::Field>() + lane, lanes());
    if (topology().model.has_mechanism_rows())
        set_.model().fill_mechanisms(lane, set_.bases(), place);
}

void TrackedLanes::nudge(int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2)
{
    stylobate::nudge(set_, lane, block, x_m_s2, y_m_s2, theta_rad_s2);
}

void TrackedLanes::step(int first, int last)
{
    assert(topology().model.mechanisms && "the step with mechanisms leaves a trace");
    if (!trace_)
        trace_ = aligned_array<double>(static_cast<std::size_t>(chunk_steps * topology().blocks * OfBlock::traced) *
                                       stride());
    Bundle& bundle = set_.model().bundle();
    bundle.trace = trace_.get();
    set_.model().run(set_.bases(), set_.places(), first, last);
    bundle.trace = nullptr;
    trace_first_ = first;
    trace_last_ = last;
    if (last == chunk_steps)
        for (int lane = 0; lane < lanes(); ++lane)
            if (!free(lane))
                set_.bases().first_step(lane) += chunk_steps;
}

PlanarModel::Turn TrackedLanes::turn(int lane, int phase) const
{
    const Bundle& bundle = set_.model().bundle();
    if (phase < chunk_steps)
        return {bundle.at(OfPitch::angle, phase, lane), bundle.at(OfPitch::increment, phase, lane)};
    // the first row of the next chunk, which is not in the table yet: where a chunk ends depends on when the lane was
    // loaded, and must not be seen
    const Realization& r = set_.realization(lane);
    const BaseMotion& motion = set_.motion(lane);
    const LaneBases& bases = set_.bases();
    const double first = bases.first_step(lane), reach = std::max(1.0, std::round(motion.spacing_s() / r.step_s));
    return PlanarModel::turn_of(r, reach, bases.chunk(motion, first - reach).front(),
                                bases.chunk(motion, first).front(), bases.chunk(motion, first + reach).front());
}

const double* TrackedLanes::traced(int k, int lane, int phase) const
{
    if (phase % chunk_steps == trace_last_ % chunk_steps) // now, also of what has been loaded since
        return &set_.model().bundle().at(OfBlock::x, k, lane);
    assert(phase > trace_first_ && phase < trace_last_ && "a step of the last run");
    const int row = (phase - trace_first_ - 1) * topology().blocks + k;
    return &trace_[static_cast<std::size_t>(row * OfBlock::traced) * stride() + static_cast<std::size_t>(lane)];
}

BlockMotion TrackedLanes::moved(int lane, int block, int phase, double behind) const
{
    const int k = set_.model().place_of(block);
    if (k < topology().fixed)
        return {};
    const double* at = traced(k, lane, phase);
    const Planar<double> centre = centre_of(topology(), set_.model().bundle(), k, lane,
                                            {at[0], at[OfBlock::y * stride()], at[OfBlock::theta * stride()]});
    BlockMotion m = {centre.x, centre.y, centre.theta};
    if (set_.realization(lane).base.pitch_rad_s2_m != 0) {
        const double phi = turn(lane, phase).angle_rad;
        const Block& rest = set_.realization(lane).blocks[static_cast<std::size_t>(block)];
        const double x = rest.x_m + m.x_m, y = rest.y_m + m.y_m, sine = std::sin(phi), cosine = std::cos(phi);
        m = {x * cosine - y * sine - rest.x_m, x * sine + y * cosine - rest.y_m, m.theta_rad + phi};
    }
    const BlockMotion last = behind > 0 ? increment(lane, block, phase) : BlockMotion{};
    return {m.x_m - behind * last.x_m, m.y_m - behind * last.y_m, m.theta_rad - behind * last.theta_rad};
}

BlockMotion TrackedLanes::increment(int lane, int block, int phase) const
{
    const int k = set_.model().place_of(block);
    if (k < topology().fixed)
        return {};
    const double* at = traced(k, lane, phase);
    BlockMotion d = {at[OfBlock::dx * stride()], at[OfBlock::dy * stride()], at[OfBlock::dtheta * stride()]};
    const double e =
        topology().model.has_mechanism_rows() ? set_.model().bundle().at(OfBlockMechanisms::eccentricity, k, lane) : 0;
    if (e != 0) { // the centre of mass goes round the geometric one
        const double theta = at[OfBlock::theta * stride()];
        d.x_m += e * std::sin(theta) * d.theta_rad;
        d.y_m -= e * std::cos(theta) * d.theta_rad;
    }
    if (set_.realization(lane).base.pitch_rad_s2_m != 0) {
        const double w = turn(lane, phase).increment_rad;
        const Block& rest = set_.realization(lane).blocks[static_cast<std::size_t>(block)];
        d = {d.x_m - w * rest.y_m, d.y_m + w * rest.x_m, d.theta_rad + w};
    }
    return d;
}

} // namespace stylobate
