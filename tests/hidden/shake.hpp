#pragma once
/// One run: a specimen that stands on the table is shaken, and seen by cameras that make no errors.

#include "tests/hidden/laws/stepper.hpp"

#include <vector>

namespace stylobate::hidden {

inline constexpr double frame_s = 0.002; ///< between two frames of the cameras; a whole number of steps
inline constexpr int window_frames = 20; ///< of a window, over which forces are compared: 40 ms

struct History {
    int frames = 0; ///< before a collapse
    bool collapsed = false;
    double collapse_s = -1;
    std::vector<BodyState> places; ///< (frames x bodies) geometric centres, with their velocities
    std::vector<BaseState> table;  ///< (frames)
    std::vector<State> windows;    ///< states at the start of each window, and at the end of the last one
    State end;
    double tilt_rad = 0; ///< greatest rotation
    double slip_m = 0;   ///< greatest path slipped in one bed, in this run
};

/// Collapsed: a rotation above 0.7 rad, a centre below six tenths of its height at rest, or a bed of less than a tenth
/// of its width.
History shake(const Model& model, const TableMotion& motion, const State& start);

/// The state of a body's geometric centre.
BodyState seen(const Model& model, int body, const BodyState& state);

} // namespace stylobate::hidden
