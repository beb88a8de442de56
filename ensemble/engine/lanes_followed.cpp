/// Lanes whose realizations are followed from outside (`lanes.hpp`).

#include "ensemble/engine/lanes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

std::vector<double> LaneSet::state(int lane) const
{
    std::vector<double> registers(state_registers());
    for (std::size_t i = 0; i < registers.size(); ++i)
        registers[i] = memory_[i * lanes_ + static_cast<std::size_t>(lane)];
    return registers;
}

void LaneSet::load_followed(int lane, Realization realization, int phase)
{
    load(lane, std::move(realization));
    begin_followed(lane, phase, 0);
}

void LaneSet::load_followed(int lane, Realization realization, int phase, const std::vector<double>& state,
                            std::uint64_t step)
{
    assert(state.size() == state_registers() && "the state is one of the same structure and model");
    clear(lane);
    Place& place = places_[static_cast<std::size_t>(lane)];
    place.busy = true;
    ++active_;
    place.realization = std::move(realization);
    const Realization& r = place.realization;
    place.motion = BaseMotion(study_.excitation, r, record_);
    if (r.vertical != nullptr)
        place.vertical = BaseMotion::along(r.vertical, r.step_s, r.change.offset_s);
    for (std::size_t i = 0; i < state.size(); ++i)
        memory_[i * lanes_ + static_cast<std::size_t>(lane)] = state[i];
    if (topology_.model.extended())
        for (int i = 0; i < static_cast<int>(r.blocks.size()); ++i)
            nudge(lane, i, 0, 0, 0);
    begin_followed(lane, phase, step);
}

/// The rows of the tables of the base's motion that are still to come in this chunk.
void LaneSet::begin_followed(int lane, int phase, std::uint64_t step)
{
    assert(!single_ && "what is followed is stepped in double precision");
    assert(BaseMotion::on_host(study_) && "formulas fill the table of all lanes at once");
    first_step_[lane] = static_cast<double>(step) - phase;
    motion(lane).fill(first_step_[lane], bundle_.base_table + lane, lanes());
    if (topology_.model.extended())
        fill_extension(lane);
}

void LaneSet::step_followed(int first, int last)
{
    assert(topology_.model.mechanisms && "the extended step leaves a trace");
    if (!trace_)
        trace_ =
            aligned_array<double>(static_cast<std::size_t>(chunk_steps * topology_.blocks * OfBlock::traced) * lanes_);
    bundle_.trace = trace_.get();
    run(first, last);
    bundle_.trace = nullptr;
    trace_first_ = first;
    trace_last_ = last;
    if (last == chunk_steps)
        for (int lane = 0; lane < lanes(); ++lane)
            if (!free(lane))
                first_step_[lane] += chunk_steps;
}

LaneSet::Turn LaneSet::turn(int lane, int phase) const
{
    if (phase < chunk_steps)
        return {bundle_.at(OfPitch::angle, phase, lane), bundle_.at(OfPitch::increment, phase, lane)};
    // the first row of the next chunk, which is not in the table yet: where a chunk ends depends on when the lane was
    // loaded, and must not be seen
    const Realization& r = realization(lane);
    const double first = first_step_[lane], reach = std::max(1.0, std::round(motion(lane).spacing_s() / r.step_s));
    return turn_of(r, reach, base_chunk(lane, first - reach).front(), base_chunk(lane, first).front(),
                   base_chunk(lane, first + reach).front());
}

const double* LaneSet::traced(int k, int lane, int phase) const
{
    if (phase % chunk_steps == trace_last_ % chunk_steps) // now, also of what has been loaded since
        return &bundle_.at(OfBlock::x, k, lane);
    assert(phase > trace_first_ && phase < trace_last_ && "a step of the last run");
    const int row = (phase - trace_first_ - 1) * topology_.blocks + k;
    return &trace_[static_cast<std::size_t>(row * OfBlock::traced) * lanes_ + static_cast<std::size_t>(lane)];
}

BlockMotion LaneSet::moved(int lane, int block, int phase, double behind) const
{
    const int k = place_of_[static_cast<std::size_t>(block)];
    if (k < topology_.fixed)
        return {};
    const double* at = traced(k, lane, phase);
    const Planar<double> centre =
        centre_of(topology_, bundle_, k, lane, {at[0], at[OfBlock::y * lanes_], at[OfBlock::theta * lanes_]});
    BlockMotion m = {centre.x, centre.y, centre.theta};
    if (realization(lane).base.pitch_rad_s2_m != 0) {
        const double phi = turn(lane, phase).angle_rad;
        const Block& rest = realization(lane).blocks[static_cast<std::size_t>(block)];
        const double x = rest.x_m + m.x_m, y = rest.y_m + m.y_m, sine = std::sin(phi), cosine = std::cos(phi);
        m = {x * cosine - y * sine - rest.x_m, x * sine + y * cosine - rest.y_m, m.theta_rad + phi};
    }
    const BlockMotion last = behind > 0 ? increment(lane, block, phase) : BlockMotion{};
    return {m.x_m - behind * last.x_m, m.y_m - behind * last.y_m, m.theta_rad - behind * last.theta_rad};
}

BlockMotion LaneSet::increment(int lane, int block, int phase) const
{
    const int k = place_of_[static_cast<std::size_t>(block)];
    if (k < topology_.fixed)
        return {};
    const double* at = traced(k, lane, phase);
    BlockMotion d = {at[OfBlock::dx * lanes_], at[OfBlock::dy * lanes_], at[OfBlock::dtheta * lanes_]};
    const double e = topology_.model.extended() ? bundle_.at(OfBlockExtension::eccentricity, k, lane) : 0;
    if (e != 0) { // the centre of mass goes round the geometric one
        const double theta = at[OfBlock::theta * lanes_];
        d.x_m += e * std::sin(theta) * d.theta_rad;
        d.y_m -= e * std::cos(theta) * d.theta_rad;
    }
    if (realization(lane).base.pitch_rad_s2_m != 0) {
        const double w = turn(lane, phase).increment_rad;
        const Block& rest = realization(lane).blocks[static_cast<std::size_t>(block)];
        d = {d.x_m - w * rest.y_m, d.y_m + w * rest.x_m, d.theta_rad + w};
    }
    return d;
}

} // namespace stylobate
