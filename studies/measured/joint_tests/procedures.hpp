#pragma once
/// What the laboratory shall do in a test of one joint: runs without measurements. Who performs them, a laboratory or
/// a simulation, gives the same runs back with the series that were measured.
///
/// The numbers are those of small blocks (half width 24 mm, 0.135 kg). For other blocks lengths are in proportion to
/// s = half width / 24 mm, times to sqrt(s), forces to the weight.

#include "ensemble/model/campaign.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

inline constexpr double test_rate_hz = 500;           ///< of the cameras
inline constexpr double test_start_s = 0.2;           ///< rods begin to move, dropped bodies are released
inline constexpr double pull_reach_m = 0.008;         ///< of the cycles of `pull`, to either side
inline constexpr double pull_creep_m = 0.00025;       ///< over which the first slip of `pull` is approached slowly
inline constexpr double pull_slow_m_s = 0.014;        ///< its slow cycles
inline constexpr double pull_fast_m_s = 0.060;        ///< its fast cycles
inline constexpr double push_reach_m = 0.010;         ///< the rod's end is held after that way
inline constexpr double push_speed_m_s = 0.004;       ///< of the rod's end
inline constexpr double drop_height_m = 0.003;        ///< of the lower corner above its place
inline constexpr double drop_lean_rad = 0.1;          ///< of the body that hangs, in turn to the left and to the right
inline constexpr int drop_repeats = 6;                ///< of `drop`
inline constexpr double steepest_board_rad = 0.69813; ///< 40 degrees

/// The block under test and what is taped on it, as one rigid body on its joint.
struct TestedBody {
    int lower = -1; ///< block below the joint; -1: the base
    int upper = 0;  ///< block above it
    double mass_kg = 0;
    double centre_m = 0;     ///< height of its centre of mass above the joint, as planned
    double height_m = 0;     ///< of all of it
    double inertia_m2 = 0;   ///< about its centre of mass, per mass
    double length_ratio = 1; ///< s
    double time_ratio = 1;   ///< sqrt(s)
};

/// @throws InputError where the specimen has no such joint
TestedBody tested_body(const Specimen& specimen, int joint, const std::vector<Dummy>& dummies);

/// True if the joint can be tested by itself: what stands on it stands on no other joint.
bool stands_alone(const Specimen& specimen, int joint);

/// The runs of one test on one joint; none where the joint does not stand alone, and for `shake`.
///
/// Runs with the same motion_id are repeats; the two sides of `board`, `tilt` and `push` come in the order left, right:
/// the body slides, turns or is pushed to that side.
/// @throws InputError where the specimen has no such joint
std::vector<MeasuredRun> planned_runs(const Specimen& specimen, const Laboratory& laboratory, RunKind kind, int joint);

/// Why the laboratory cannot do a test, as a sentence; nullopt: it can, on one joint at least. What a laboratory does
/// not state it is taken to have, but for a force gauge of 0 N, which is none.
std::optional<std::string> cannot_do(const Specimen& specimen, const Laboratory& laboratory, RunKind kind);

/// The cost of one test on one joint, over that of a shake run: judged by what has to be set up, not measured.
double default_cost(RunKind kind);

} // namespace stylobate
