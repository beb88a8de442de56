#pragma once
/// A block on a base that is set moving at once and stopped at once: the published outcomes of one block (ceh2016), and
/// the engine's.

#include "studies/evidence/measured/parts/fall_table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::measured {

/// One test, or one published simulation.
struct DoublePulse {
    double distance_m = 0;   ///< that the base moves until it is stopped
    double velocity_m_s = 0; ///< of the base in between
    bool fell = false;
};

/// @throws InputError naming the file and line: a marker that is neither a fall nor none, values that are not positive
std::vector<DoublePulse> read_double_pulses(const std::filesystem::path& file);

/// The base reaches the velocity by a triangle of acceleration that lasts `pulse_s`, and loses it by the same;
/// `distance_m` is where it ends, exactly. Pulses that would overlap are as long as they can be.
Motion base_motion_of(const DoublePulse& test, double pulse_s);

/// The block and its bed. Its size is unknown, and so is all else.
struct PulsedBlock {
    double slenderness = 0.2; ///< width over height
    double height_m = 0.1;
    double friction = 0.7;
    double damping_ratio = 0.1;
    bool ends = false;      ///< whether the normal dashpot acts at the ends of the contact (face damping)
    double pulse_s = 0.002; ///< of the base
};
Study pulsed_study(const PulsedBlock& block);

} // namespace stylobate::measured
