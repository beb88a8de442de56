#include "tests/hidden/shake.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

BodyState seen(const Model& model, int body, const BodyState& state)
{
    BodyState centre = state;
    geometric_centre(model, body, state, centre.x, centre.y);
    velocity_at(state, centre.x, centre.y, centre.vx, centre.vy);
    return centre;
}

History shake(const Model& model, const TableMotion& motion, const State& start)
{
    const long per_frame = std::lround(frame_s / model.step_s);
    const int frames = static_cast<int>((motion.half_steps() - 1) / (2 * per_frame)) + 1;
    const Table table{&motion, 0, {}, 0.5 * model.step_s};
    History history;
    State state = start;
    const auto fallen = [&] {
        for (std::size_t i = 0; i < static_cast<std::size_t>(model.body_count); ++i)
            if (std::abs(state.bodies[i].theta) > 0.7 || state.bodies[i].y < 0.6 * start.bodies[i].y)
                return true;
        for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
            if (state.beds[j].width_m < 0.1 * state.beds[j].width_at_rest_m)
                return true;
        return false;
    };
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0)
            for (long k = 0; k < per_frame; ++k)
                step(model, table, state);
        if (fallen()) {
            history.collapsed = true;
            history.collapse_s = frame * frame_s;
            break;
        }
        if (frame % window_frames == 0)
            history.windows.push_back(state);
        for (int i = 0; i < model.body_count; ++i) {
            history.places.push_back(seen(model, i, state.bodies[static_cast<std::size_t>(i)]));
            history.tilt_rad = std::max(history.tilt_rad, std::abs(history.places.back().theta));
        }
        history.table.push_back(table.at(2 * state.step));
        ++history.frames;
    }
    for (std::size_t j = 0; j < static_cast<std::size_t>(model.bed_count); ++j)
        history.slip_m = std::max(history.slip_m, state.beds[j].slip_m - start.beds[j].slip_m);
    history.end = state;
    return history;
}

} // namespace stylobate::hidden
