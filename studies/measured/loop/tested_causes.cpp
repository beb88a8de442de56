#include "studies/measured/loop/tested_causes.hpp"

#include "studies/measured/joint_tests/procedures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {

namespace {

// From weak to strong.
constexpr std::array friction_parts = {0.1, 0.3, 0.6}; // off the friction: of one joint, or of all while they slide
constexpr std::array worn_parts = {0.1, 0.4,  1.5,
                                   5.0, 20.0, 60.0};      // of the friction, over the path of a pull: the last ones end
constexpr std::array lost_before = {0.85, 0.97};          // of the friction, before the tests
constexpr std::array held_parts = {0.25, 1.0, 3.0, 10.0}; // of a dowel or a bond, over the friction at rest
constexpr std::array lost_corners = {0.04, 0.15};         // over the width
constexpr std::array centre_offsets = {0.025, 0.08};      // over the width
constexpr std::array wedge_angles = {0.002, 0.008};       // [rad]
constexpr std::array critical_parts = {0.15, 0.5, 1.2};   // of critical damping, of the block on the joint
constexpr std::array rates = {3.0, 10.0};                 // Hunt and Crossley's lambda over 0.1 sqrt(g h)
constexpr std::array drag_parts = {0.1, 0.3, 0.6, 1.5, 4.0};  // of the weight, at the speed of the table in `slide`
constexpr double least_velocity = 0.01, most_velocity = 0.08; // of Stribeck's law, over sqrt(g H)
constexpr double least_yield = 0.002, most_yield = 0.02;      // slip at which a dowel yields, over the width
constexpr double least_tension = 0.5, most_tension = 2;       // of a bond, over its cohesion
constexpr double pull_path_m = 0.22;                          // of small blocks
constexpr double slide_speed_m_s = 0.43;                      // likewise: 10.7 m/s2 at 4 Hz

/// One mechanism at one place.
class CauseMaker {
public:
    CauseMaker(std::vector<LoopCause>& all, int joint, Cause cause, std::string form = {})
        : all_(all), joint_(joint), cause_(std::move(cause)), form_(std::move(form))
    {
    }

    /// A cause that acts in the tests as another one does.
    void add_like(const SizedCause& acting, double size)
    {
        all_.push_back(
            {acting, cause_, {loop_mechanism(cause_.mechanism), cause_.place, size, cause_.unit, form_}, joint_});
    }
    /// @param size in the tables
    void add(double size, double least_fixed = 0, double most_fixed = 0)
    {
        all_.push_back({{cause_, parameter_of(cause_, size)},
                        cause_,
                        {loop_mechanism(cause_.mechanism), cause_.place, size, cause_.unit, form_},
                        joint_,
                        least_fixed,
                        most_fixed});
    }

private:
    std::vector<LoopCause>& all_;
    int joint_;
    Cause cause_;
    std::string form_;
};

Cause of_joint(const char* mechanism, int joint, const char* parameter, const char* unit, double neutral = 0)
{
    Cause cause{mechanism, fmt::format("joint {}", joint), parameter, unit, neutral};
    cause.joint = joint;
    return cause;
}

void add_of_joint(const Specimen& specimen, int joint, double friction, double stiffness_n_m2,
                  std::vector<LoopCause>& all)
{
    const TestedBody body = tested_body(specimen, joint, {});
    const auto block = static_cast<std::size_t>(body.upper);
    const double width = 2 * specimen.half_width_m[block], mass = specimen.mass_kg[block];
    const double at_rest = friction * mass * specimen.gravity_m_s2;
    const double speed = std::sqrt(specimen.gravity_m_s2 * 2 * specimen.half_height_m[block]);

    CauseMaker friction_of(all, joint, of_joint("joint_friction", joint, "ratio", "", 1));
    for (const double part : friction_parts)
        for (const double sign : {-1.0, 1.0})
            friction_of.add(sign * part);
    CauseMaker wear(all, joint, of_joint("friction_wear", joint, "wear_per_m", "1/m"));
    for (const double part : worn_parts)
        wear.add(part / (pull_path_m * body.length_ratio));
    // Wear that went on in other runs before: what is left is little, and goes on being little.
    CauseMaker worn(all, joint, of_joint("friction_wear", joint, "lost", ""), "worn before");
    for (const double lost : lost_before)
        worn.add_like({of_joint("joint_friction", joint, "ratio", "", 1), 1 - lost}, lost);
    CauseMaker dowel(all, joint, of_joint("dowel", joint, "yield_n", "N"));
    CauseMaker held(all, joint, of_joint("adhesion", joint, "adhesion_n_m", "N/m"));
    CauseMaker bond(all, joint, of_joint("adhesion", joint, "adhesion_n_m", "N/m"), "and tension");
    for (const double part : held_parts) {
        dowel.add(part * at_rest, least_yield * width, most_yield * width);
        held.add(part * at_rest / width);
        bond.add(part * at_rest / width, least_tension, most_tension);
    }
    for (const char* side : {"left", "right"}) {
        Cause chip = of_joint("corner_loss", joint, "loss_m", "m");
        chip.side = side;
        CauseMaker corner(all, joint, chip, side);
        for (const double part : lost_corners)
            corner.add(part * width);
    }
    Cause off{"eccentricity", fmt::format("block {}", body.upper), "offset_m", "m"};
    off.block = body.upper;
    CauseMaker centre(all, joint, off);
    for (const double part : centre_offsets)
        for (const double sign : {-1.0, 1.0})
            centre.add(sign * part * width);
    CauseMaker wedge(all, joint, of_joint("wedge", joint, "angle_rad", "rad"));
    for (const double angle : wedge_angles)
        for (const double sign : {-1.0, 1.0})
            wedge.add(sign * angle);
    CauseMaker rate(all, joint, of_joint("rate_damping", joint, "rate_s_m", "s/m"), "rate");
    for (const double part : rates)
        rate.add(part / (0.1 * speed));
    CauseMaker dashpot(all, joint, of_joint("face_damping", joint, "dashpot_n_s_m", "N s/m"), "dashpot");
    for (const double part : critical_parts)
        dashpot.add(part * 2 * std::sqrt(stiffness_n_m2 * width * mass));
}

} // namespace

SizedCause LoopCause::drawn(double uniform) const
{
    SizedCause one = cause;
    if (most_fixed > 0)
        one.cause.fixed = least_fixed * std::pow(most_fixed / least_fixed, uniform);
    return one;
}

std::vector<LoopCause> loop_causes(const Specimen& specimen, const std::vector<int>& joints, double friction,
                                   double stiffness_n_m2)
{
    std::vector<LoopCause> all;
    double mass = 0, height = 0, length = 0;
    for (int b = 0; b < specimen.blocks(); ++b) {
        const auto k = static_cast<std::size_t>(b);
        mass += specimen.mass_kg[k] / specimen.blocks();
        height = std::max(height, specimen.rest_y_m[k] + specimen.half_height_m[k] - specimen.base_block_top_m);
        length += specimen.half_width_m[k] / (0.024 * specimen.blocks());
    }
    const double speed = std::sqrt(specimen.gravity_m_s2 * height);
    CauseMaker stribeck(all, -1, {"stribeck", "all", "dynamic_ratio", "", 1});
    for (const double part : friction_parts)
        stribeck.add(part, least_velocity * speed, most_velocity * speed);
    CauseMaker drag(all, -1, {"drag", "all", "coefficient_n_s2_m2", "N s2/m2"});
    for (const double part : drag_parts)
        drag.add(part * mass * specimen.gravity_m_s2 / (slide_speed_m_s * slide_speed_m_s * length));
    CauseMaker viscous(all, -1, {"drag", "all", "linear_n_s_m", "N s/m"}, "linear");
    for (const double part : drag_parts)
        viscous.add(part * mass * specimen.gravity_m_s2 / (slide_speed_m_s * std::sqrt(length)));
    for (const int joint : joints)
        add_of_joint(specimen, joint, friction, stiffness_n_m2, all);
    return all;
}

std::string loop_mechanism(const std::string& mechanism)
{
    return mechanism == "rate_damping" || mechanism == "face_damping" ? "damping" : mechanism;
}

double parameter_of(const Cause& cause, double size)
{
    return cause.mechanism == "stribeck" ? 1 - size : cause.mechanism == "joint_friction" ? 1 + size : size;
}

std::string size_words(const Cause& cause, double size)
{
    return fmt::format("{} = {:.3g}{}{}", cause.parameter, parameter_of(cause, size), cause.unit.empty() ? "" : " ",
                       cause.unit);
}

} // namespace stylobate
