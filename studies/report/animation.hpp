#pragma once
/// A realization in motion for the page: its trajectory in tenths of a pixel of a drawing, as text.

#include "ensemble/model/outcome.hpp"
#include "io/store/result_store.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct PlacedBlock;

/// Whether no block of its column is above a block; an epistyle is one.
bool is_top(const std::vector<PlacedBlock>& blocks, std::size_t block);

/// The drawing that trajectories are quantised for: the structure in the frame of its base, with room on all sides.
struct AnimationStage {
    double px_m = 1;       ///< pixels per metre
    double middle_m = 0;   ///< of the structure at rest: x = 0 of the drawing is its middle
    double width_px = 640; ///< of the drawing
    double height_px = 0;
    double ground_px = 0;    ///< y of the ground, from above
    double quantum_px = 0.1; ///< coordinates are whole multiples of it
    // in space, where the view turns about a point above the middle of the ground
    double middle_z_m = 0; ///< as `middle_m`, along z
    double pivot_px = 0;   ///< height of that point, which is the middle of the drawing
    double reach_px = 0;   ///< half the side of the ground that is drawn

    double quantum_m() const { return quantum_px / px_m; }
};

/// @param blocks of the structure at rest, at least one
AnimationStage animation_stage(const std::vector<PlacedBlock>& blocks);
/// The same for a structure in space: nothing that leans about its foot leaves the drawing, from wherever it is seen.
AnimationStage animation_stage_in_space(const std::vector<PlacedBlock>& blocks);

struct Animation {
    std::uint64_t index = 0, cell = 0;
    State state = State::stood;
    double frequency_hz = 0, pga_m_s2 = 0;
    std::string motion; ///< of a study of motions: "motion pulse_3 at PGV 0.8 m/s"; else ""
    std::uint64_t samples = 0;
    std::vector<double> fall_time_s;                               ///< (blocks) -1: never
    double azimuth_rad = std::numeric_limits<double>::quiet_NaN(); ///< of the fall, in space; NaN: there is none
    std::string data;                                              ///< base64
};

/// The samples of a trajectory at a lower rate, as text. The bytes are those that `decoded` in page/player.js
/// describes, and for a structure in space page/space.js: whole numbers of variable length; sizes of the blocks, then
/// each coordinate with its differences, runs of zeros together. Rounding does not add up: the differences are of
/// rounded values. What is not finite repeats the value before it.
/// @param stride one of this many samples of the trajectory is taken, from the first one on; >= 1
/// @pre the trajectory has a sample
/// @returns the animation without the values of its row
Animation animation_of(const Trajectory& trajectory, const AnimationStage& stage, std::size_t stride);

/// Times in ascending order as text, in whole multiples of a quantum: the first one, and the differences from one to
/// the next, as unsigned numbers of variable length (page/cells.js reads them). @param quantum_s > 0
std::string ascending_text(const std::vector<double>& sorted_s, double quantum_s);

/// A block of all animations of a page.
struct AnimatedBlock {
    std::string name;
    std::string look; ///< classes of the page's style: "stone", "lintel", "fixed"
};

/// What the player in space draws besides.
struct SpaceLooks {
    std::vector<std::size_t> round;  ///< (blocks) 1: drawn as a drum; 0: as a prism; 2: round below, square above
    std::vector<std::size_t> orbits; ///< blocks whose orbits are drawn at first
};

/// What the script of the page (player.js) needs beside the list of animations, to which members may be added.
/// @param looks of a structure in space; none: it is in the plane
Json animation_store(const AnimationStage& stage, double rate_hz, const std::vector<AnimatedBlock>& blocks,
                     const std::optional<SpaceLooks>& looks = std::nullopt);

} // namespace stylobate
