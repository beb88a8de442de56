#pragma once
/// One realization through time, and pictures of it.

#include "stylobate/experiment.hpp"
#include "stylobate/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

/// The blocks of a structure at evenly spaced times, in the frame of the base: x to the right, y upwards from the base,
/// in space z towards the viewer. A list that the structure's model does not have is empty.
///
/// In the plane places are those of the blocks' centres, and an angle turns a block counter-clockwise from upright. In
/// space places are those of the middles of the bodies, halfway between their faces, and a quaternion turns a body from
/// upright about its middle; its length is 1 to within the change of a step.
struct Trajectory {
    Outcome outcome;                   ///< the same bits as in the ensemble
    int dimensions = 2;                ///< of the structure: 2 in the plane, 3 in space
    std::vector<double> time_s;        ///< (times)
    std::vector<double> x_m;           ///< (times x blocks), time by time
    std::vector<double> y_m;           ///< (times x blocks)
    std::vector<double> base_x_m;      ///< (times) displacement of the base
    std::vector<double> rest_x_m;      ///< (blocks) place in the structure as it is built: upright, faces touching
    std::vector<double> rest_y_m;      ///< (blocks)
    std::vector<double> half_height_m; ///< (blocks)
    std::vector<bool> fixed;           ///< (blocks) whether it moves with the base
    std::vector<bool> epistyle;        ///< (blocks) whether it lies across columns
    std::vector<std::int32_t> column;  ///< (blocks) of a drum, from the left; -1 of an epistyle
    std::vector<std::string> name;     ///< (blocks) in layout order: column by column from the bottom, then epistyles

    // in the plane alone
    std::vector<double> theta_rad;    ///< (times x blocks)
    std::vector<double> half_width_m; ///< (blocks)

    // in space alone
    std::vector<double> z_m;                ///< (times x blocks)
    std::vector<double> q_w, q_x, q_y, q_z; ///< (times x blocks) the quaternion
    std::vector<double> base_y_m;           ///< (times)
    std::vector<double> base_z_m;           ///< (times)
    std::vector<double> rest_z_m;           ///< (blocks)
    std::vector<double> bottom_half_x_m;    ///< (blocks) half sizes of the faces; of a disc its radius
    std::vector<double> bottom_half_z_m;    ///< (blocks)
    std::vector<double> top_half_x_m;       ///< (blocks)
    std::vector<double> top_half_z_m;       ///< (blocks)
    std::vector<double> round;              ///< (blocks) 1: the faces are discs; 0: rectangles; 2: the bottom
                                            ///< one is a disc, the top one a rectangle

    std::size_t blocks() const { return half_height_m.size(); }
    /// The last sample that is not after a time; the first one before all.
    /// @throws std::out_of_range if there are no samples
    std::size_t sample_at(double time_s) const;
};

/// Runs one realization, sampled at the study's `output.trajectory_rate_hz`.
/// @param index from 0 to `experiment.realizations() - 1`
/// @throws InputError if there is no such realization, and for a study of rare events, whose realizations follow from
///         each other
Trajectory replay(const Experiment& experiment, std::uint64_t index);

/// Runs one realization of a result again, as `stylobate replay` does.
/// @param settings may only give the present path of its record: "excitation.file=PATH"
/// @param go_on polled many times a second; false: stop. May be empty
/// @throws InputError as above, and if the record is not the one of the result, or the settings give anything else
/// @throws Stopped if `go_on` returned false
Trajectory replay(const Result& result, std::uint64_t index, const std::vector<std::string>& settings = {},
                  const std::function<bool()>& go_on = {});

/// Draws the structure at a time, to scale, in the frame of the base: a vector picture for any browser. A structure in
/// space is seen obliquely from above. A file that is there is replaced.
/// @throws InputError if the arrays do not fit each other, or if the file cannot be written
void write_svg(const Trajectory& trajectory, double time_s, const std::filesystem::path& file);

/// Draws a strip of snapshots with the displacements below (PNG, by librsvg), as `stylobate export --picture strip`.
/// @throws InputError if librsvg is missing, or the file cannot be written
void write_strip(const Trajectory& trajectory, const std::filesystem::path& png,
                 const std::optional<std::string>& title = {});

} // namespace stylobate::api
