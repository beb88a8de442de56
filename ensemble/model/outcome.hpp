#pragma once
/// How a realization ended. Plain data, SI units.

#include <cstdint>
#include <vector>

namespace stylobate {

enum class State : std::uint8_t { stood = 0, rocked = 1, slid = 2, collapsed = 3, invalid = 4 };
enum class InvalidReason : std::uint8_t { none = 0, not_finite = 1, energy = 2 };

/// `Outcome::first_collapse_block` where several blocks met the collapse criterion at the same step: they fell
/// together.
inline constexpr std::int32_t several_blocks = -2;

const char* to_string(State state);
const char* to_string(InvalidReason reason);

struct Outcome {
    State state = State::stood;
    InvalidReason invalid_reason = InvalidReason::none;
    double collapse_time_s = -1;            ///< first time of the collapse; -1 = none
    std::int32_t first_collapse_block = -1; ///< that met the collapse criterion first; -1 = none; `several_blocks`
    std::int32_t fallen_blocks = 0;         ///< how many have met it by the end
    std::int32_t unseated_block = -1;       ///< epistyle that lost a seat first; -1 = none; `several_blocks`
    std::int32_t at_rest = 0; ///< 1: it lay still at the end (`at_rest` in engine/watch.hpp); 0: it still moved, and
                              ///< what remains of its motion (`residual_...`) is NaN. 0 too of one that was set aside
    double unseating_time_s = -1;       ///< when, as a check found it (every `chunk_steps` steps); -1 = never
    double total_collapse_time_s = -1;  ///< when every column and every epistyle had fallen; -1 = not so
    double peak_top_displacement_m = 0; ///< largest |x| of the top block's centre from its place in the reference stack
    double residual_top_displacement_m = 0; ///< x of the top block's centre at rest, from its rest at the start
    double top_path_m = 0;                  ///< path of the top block's centre against the base
    double total_sliding_m = 0;             ///< sum over the beds of the slip while slipping
    double sliding_path_m = 0;              ///< sum over the beds of the relative path of the faces in contact
    double residual_sliding_m = 0;          ///< sum over the beds of how far the faces lie from where they lay
    double residual_dislocation = 0;        ///< of the bed whose faces lie furthest from where they lay, over its width
    double total_rocking_rad = 0;           ///< sum over the beds of the largest relative rotation
    double rocking_path_rad = 0;            ///< sum over the beds of the path of the relative rotation
    double max_relative_rotation_rad = 0;   ///< of the bed that rotated most
    double energy_kinetic_j = 0;            ///< at the end
    double energy_potential_j = 0;          ///< gravity, against the start
    double energy_spring_j = 0;             ///< normal and tangential, against the start
    double energy_friction_j = 0;           ///< dissipated by friction
    double energy_damping_j = 0;            ///< dissipated by the dashpots
    double energy_base_work_j = 0;          ///< done by the base
    double energy_residual = 0;             ///< what the balance lacks, over the energy scale of the run
    double end_time_s = 0;                  ///< simulated time
    double step_s = 0;                      ///< time step
    std::uint64_t steps = 0;
    std::vector<double> fall_time_s; ///< (blocks but the ground) when each met the collapse criterion, exact to a step;
                                     ///< -1 = never. Equal times: together
    // Of a survival study, else empty; of one that was set aside 0.
    std::vector<double> bed_offset_m; ///< (beds) how far the faces lie from where they lay, > 0: the upper block to the
                                      ///< right
    std::vector<double> rotation_rad; ///< (blocks but the ground) from upright, at the end
};

} // namespace stylobate
