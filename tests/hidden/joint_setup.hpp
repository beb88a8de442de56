#pragma once
/// The specimen as a test on a joint needs it: some blocks away, clamped or taped together, dummies taped on, rods set.

#include "tests/hidden/virtual_campaign.hpp"

namespace stylobate::hidden {

inline constexpr double rod_start_s = 0.2; ///< when the end of a rod begins to move

struct JointSetup {
    Model model;
    State start;                        ///< laid by hand, not yet at rest
    double laid_off_m[max_bodies] = {}; ///< of each block to the right, from where it is meant to stand
};

/// @param number of the test: what scatters by hand belongs to it
/// @pre the plan was checked
JointSetup set_up(const VirtualCampaign& made, const MeasuredRun& planned, int number, const State* worn);

/// Where hands hold a body: by the place of its own rectangle.
void hold(const Model& model, int body, double x, double y, double theta, BodyState& state);

/// Throws InputError where a planned test contradicts itself or the specimen.
void check_plan(const VirtualCampaign& made, const MeasuredRun& planned);

} // namespace stylobate::hidden
