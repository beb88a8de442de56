#include "tests/hidden/laws/bed_ends.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

/// A face as a line with its middle, direction and half length.
struct Face {
    double x, y;   ///< middle
    double tx, ty; ///< along it, to the right
    double half;
};

/// The upper (side = 1) or lower (side = -1) face of a body, turned by a further angle.
Face face_of(const Model& model, int body, const BodyState& state, int side, double turned)
{
    double x = 0, y = 0;
    geometric_centre(model, body, state, x, y);
    const Body& shape = model.bodies[static_cast<std::size_t>(body)];
    const double c = std::cos(state.theta), s = std::sin(state.theta);
    const double out = side * shape.half_height_m;
    // wedges are small: the sine and cosine of the sum to the second order of the wedge
    const double even = 1 - 0.5 * turned * turned;
    return {x - s * out, y + c * out, c * even - s * turned, s * even + c * turned, shape.half_width_m};
}

Face base_face(const Model& model, const BaseState& base, double turned)
{
    const double c = std::cos(base.theta), s = std::sin(base.theta);
    const double even = 1 - 0.5 * turned * turned;
    return {base.x - s * model.base_top_m, base.y + c * model.base_top_m, c * even - s * turned, s * even + c * turned,
            model.base_half_width_m};
}

} // namespace

void geometric_centre(const Model& model, int body, const BodyState& state, double& x, double& y)
{
    const auto b = static_cast<std::size_t>(body);
    const double right = model.bodies[b].mass_x_m + model.effects.bodies[b].eccentricity_m;
    const double up = model.bodies[b].mass_y_m;
    const double c = std::cos(state.theta), s = std::sin(state.theta);
    x = state.x - right * c + up * s;
    y = state.y - right * s - up * c;
}

BedEnds ends_of_bed(const Model& model, int bed, const State& state, const BaseState& base)
{
    const auto b = static_cast<std::size_t>(bed);
    const Bed& which = model.beds[b];
    const BedEffect& effect = model.effects.beds[b];
    const Face low = which.lower < 0 ? base_face(model, base, effect.wedge_rad)
                                     : face_of(model, which.lower, state.bodies[static_cast<std::size_t>(which.lower)],
                                               1, effect.wedge_rad);
    const Face up = face_of(model, which.upper, state.bodies[static_cast<std::size_t>(which.upper)], -1, 0);
    const double worn = effect.corner_wear_m_rad * state.beds[b].turned_rad;
    const double lost[2] = {effect.chip_left_m + worn, effect.chip_right_m + worn};

    BedEnds ends;
    ends.position = (up.x - low.x) * low.tx + (up.y - low.y) * low.ty;
    double along[2] = {0, 0};
    for (int e = 0; e < 2; ++e) {
        const double side = e == 0 ? -1 : 1;
        BedEnd& end = ends.end[e];
        const double upper_arm = side * (up.half - lost[e]), lower_arm = side * (low.half - lost[e]);
        const double ux = up.x + upper_arm * up.tx, uy = up.y + upper_arm * up.ty;
        const double at = (ux - low.x) * low.tx + (uy - low.y) * low.ty;
        if (side * at <= side * lower_arm) { // the upper body's corner on the lower face
            end = {ux, uy, -low.ty, low.tx, (uy - low.y) * low.tx - (ux - low.x) * low.ty};
            along[e] = at;
        } else { // the lower body's corner on the upper face
            const double lx = low.x + lower_arm * low.tx, ly = low.y + lower_arm * low.ty;
            end = {lx, ly, -up.ty, up.tx, (up.y - ly) * up.tx - (up.x - lx) * up.ty};
            along[e] = lower_arm;
        }
        end.gap += state.beds[b].gap_shift_m[e];
    }
    ends.width = along[1] - along[0];
    return ends;
}

} // namespace stylobate::hidden
