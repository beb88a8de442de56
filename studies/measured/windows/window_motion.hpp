#pragma once
/// Windows of a campaign in motion: the measured blocks and those of simulations that start from the measured state,
/// as plain data. SI units.

#include "ensemble/model/fields.hpp"
#include "io/tables/rows.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

enum class ShownBlockKind {
    drum, ///< of a column, or a capital
    epistyle,
    fixed ///< to the table: in no track
};

/// A block as it is drawn.
struct ShownBlock {
    ShownBlockKind kind = ShownBlockKind::drum;
    double half_width_m = 0;
    double half_height_m = 0;
    double rest_x_m = 0; ///< centre in the plan, as in the measured file: above the table
    double rest_y_m = 0;
    friend bool operator==(const ShownBlock&, const ShownBlock&) = default;
};

/// Where a block is. NaN: it was not seen, or its model was no longer finite.
struct BlockPlace {
    double x_m = 0; ///< centre, against `MotionSample::base_x_m`
    double y_m = 0; ///< centre, above the table
    double theta_rad = 0;
};

/// A moment of a window.
struct MotionSample {
    double time_s = 0;   ///< the cameras' clock
    double base_x_m = 0; ///< displacement of the base, as measured
};

/// The blocks of a window as one of several saw them: the cameras, or a model.
struct MotionTrack {
    std::string model; ///< "measured"; "baseline", "extended"; of a calibration "calibrated", "start"
    /// Error over what noise and a short lag make, root mean square of the block and coordinate that is off most;
    /// nothing of what was measured.
    std::optional<double> excess;
    int block = -1;                 ///< which one that is, of the specimen
    std::string coordinate;         ///< "x", "y" or "theta"
    std::vector<BlockPlace> places; ///< (samples x blocks of the specimen), row by row
};

/// Why a window is shown.
enum class WindowChoice {
    worst,  ///< of its run the one in which the first model is off most
    typical ///< the median of all windows
};

struct WindowMotion {
    WindowChoice choice = WindowChoice::worst;
    std::string run;
    double from_s = 0; ///< the cameras' clock; simulations start there
    double to_s = 0;
    std::uint64_t rank = 0;   ///< of its error among all windows; 1: the largest
    std::uint64_t ranked = 0; ///< number of windows
    std::vector<MotionSample> samples;
    std::vector<MotionTrack> tracks; ///< first the measured one
};

/// What a page needs to show windows in motion.
struct WindowMotions {
    std::vector<ShownBlock> blocks;    ///< those of the specimen in their order, then the fixed ones
    std::vector<WindowMotion> windows; ///< the worst of all first

    /// How many blocks the tracks have.
    std::size_t free_blocks() const;
    /// What is wrong with it, for who reads it from a file; nullopt: nothing. Every track is as long as its samples and
    /// blocks want, sizes are positive, times ascend.
    std::optional<std::string> fault() const;
};

// ---- their words and fields in files --------------------------------------------------------------------------------

template <>
struct FieldWords<ShownBlockKind> {
    static constexpr const char* words[] = {"drum", "epistyle", "fixed"};
};
template <>
struct FieldWords<WindowChoice> {
    static constexpr const char* words[] = {"worst", "typical"};
};

template <class F>
void visit_fields(std::type_identity<ShownBlock>, F&& f)
{
    f("kind", &ShownBlock::kind);
    f("half_width_m", &ShownBlock::half_width_m);
    f("half_height_m", &ShownBlock::half_height_m);
    f("rest_x_m", &ShownBlock::rest_x_m);
    f("rest_y_m", &ShownBlock::rest_y_m);
}

template <class F>
void visit_fields(std::type_identity<BlockPlace>, F&& f)
{
    f("x_m", &BlockPlace::x_m);
    f("y_m", &BlockPlace::y_m);
    f("theta_rad", &BlockPlace::theta_rad);
}

template <class F>
void visit_fields(std::type_identity<MotionSample>, F&& f)
{
    f("time_s", &MotionSample::time_s);
    f("base_x_m", &MotionSample::base_x_m);
}

template <class F>
void visit_fields(std::type_identity<MotionTrack>, F&& f)
{
    f("model", &MotionTrack::model);
    f("excess", &MotionTrack::excess);
    f("block", &MotionTrack::block);
    f("coordinate", &MotionTrack::coordinate);
    f("places", &MotionTrack::places);
}

template <class F>
void visit_fields(std::type_identity<WindowMotion>, F&& f)
{
    f("choice", &WindowMotion::choice);
    f("run", &WindowMotion::run);
    f("from_s", &WindowMotion::from_s);
    f("to_s", &WindowMotion::to_s);
    f("rank", &WindowMotion::rank);
    f("ranked", &WindowMotion::ranked);
    f("samples", &WindowMotion::samples);
    f("tracks", &WindowMotion::tracks);
}

template <class F>
void visit_fields(std::type_identity<WindowMotions>, F&& f)
{
    f("blocks", &WindowMotions::blocks);
    f("windows", &WindowMotions::windows);
}

} // namespace stylobate
