#pragma once
/// The fields of windows in motion with their names in files, written once for the writer and the reader.

#include "studies/measured/windows/field_table.hpp"
#include "studies/measured/windows/window_motion.hpp"

#include <type_traits>

namespace stylobate {

template <>
struct FieldWords<ShownBlockKind> {
    static constexpr const char* words[] = {"drum", "epistyle", "fixed"};
};
template <>
struct FieldWords<WindowChoice> {
    static constexpr const char* words[] = {"worst", "typical"};
};
template <class F>
void visit_fields(std::type_identity<ShownBlock>, F f)
{
    f("kind", &ShownBlock::kind);
    f("half_width_m", &ShownBlock::half_width_m);
    f("half_height_m", &ShownBlock::half_height_m);
    f("rest_x_m", &ShownBlock::rest_x_m);
    f("rest_y_m", &ShownBlock::rest_y_m);
}

template <class F>
void visit_fields(std::type_identity<BlockPlace>, F f)
{
    f("x_m", &BlockPlace::x_m);
    f("y_m", &BlockPlace::y_m);
    f("theta_rad", &BlockPlace::theta_rad);
}

template <class F>
void visit_fields(std::type_identity<MotionSample>, F f)
{
    f("time_s", &MotionSample::time_s);
    f("base_x_m", &MotionSample::base_x_m);
}

template <class F>
void visit_fields(std::type_identity<MotionTrack>, F f)
{
    f("model", &MotionTrack::model);
    f("excess", &MotionTrack::excess);
    f("block", &MotionTrack::block);
    f("coordinate", &MotionTrack::coordinate);
    f("places", &MotionTrack::places);
}

template <class F>
void visit_fields(std::type_identity<WindowMotion>, F f)
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
void visit_fields(std::type_identity<WindowMotions>, F f)
{
    f("blocks", &WindowMotions::blocks);
    f("windows", &WindowMotions::windows);
}

} // namespace stylobate
