#include "ensemble/spatial/structure/step_bound.hpp"

#include "ensemble/model/input_error.hpp"
#include "kernels/spatial/disc_bed.hpp"
#include "kernels/spatial/friction.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stylobate {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Row6 = Eigen::Matrix<double, 6, 1>;
using Point = Eigen::Vector3d;

constexpr std::array<double, 13> contact_states{-0.999, -0.9, -0.7, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1, 1.5, 100};
constexpr std::size_t states = contact_states.size();

/// The pressed part of a face: its moments about the middle of the face, the centre of the pressure and the friction
/// radius.
struct Pressed {
    double area = 0;
    Eigen::Vector2d first, centre;
    Eigen::Matrix2d second;
    double friction_radius = 0;
    double force = 0; ///< over the stiffness and the slope along the unit face's first axis
};

/// The same of a face of half size 1 that is deepest on its first axis (a disc), or in its first corner (a square).
struct UnitPressed {
    double area, first, second_along, second_across, centre, force;
    double
        spread; ///< the friction radius of a disc; mean square distance from the centre of the pressure along an axis
};

/// The segment of a unit disc: the bed law's own formulas.
UnitPressed unit_disc(double xi)
{
    const spatial::DiscSegment<double> s = spatial::disc_segment(xi);
    return {s.area, s.first, s.second, s.moment, s.moment / s.pressure, s.pressure, spatial::disc_friction_radius(xi)};
}

/// The part of the square |x|, |y| < 1 in which the depth 2 xi + x + y is positive. From the deepest corner it is the
/// triangle of the legs L = 2 + 2 xi without the three that lie beyond the sides; a triangle's integrals are powers of
/// its legs. `along` is xx, `across` the mixed moment xy.
UnitPressed unit_square(double xi)
{
    double area = 0, u = 0, uu = 0, uv = 0, pressure = 0, pu = 0, puu = 0;
    const auto add = [&](double sign, double shift_u, double shift_v) {
        const double L = std::max(2 + 2 * xi - shift_u - shift_v, 0.0), L2 = L * L, L3 = L2 * L;
        const double a = sign * L2 / 2, t = sign * L3 / 6, t2 = sign * L2 * L2 / 24;
        area += a;
        u += shift_u * a + t;
        uu += shift_u * shift_u * a + 2 * shift_u * t + 2 * t2;
        uv += shift_u * shift_v * a + (shift_u + shift_v) * t + t2;
        pressure += t;
        pu += shift_u * t + t2;
        puu += shift_u * shift_u * t + 2 * shift_u * t2 + sign * L2 * L3 / 60;
    };
    add(1, 0, 0);
    add(-1, 2, 0);
    add(-1, 0, 2);
    add(1, 2, 2);
    const double middle = pu / pressure;
    return {
        area, area - u, area - 2 * u + uu, area - 2 * u + uv, 1 - middle, pressure, puu / pressure - middle * middle};
}

/// A disc of radius R that is deepest towards the unit vector e.
Pressed pressed_disc(const UnitPressed& unit, double R, const Eigen::Vector2d& e)
{
    const Eigen::Matrix2d along = e * e.transpose();
    const double R4 = R * R * R * R;
    return {R * R * unit.area,
            R * R * R * unit.first * e,
            R * unit.centre * e,
            R4 * (unit.second_along * along + unit.second_across * (Eigen::Matrix2d::Identity() - along)),
            R * unit.spread,
            R * R * R * unit.force};
}

/// A rectangle that is deepest in the corner `half`, with signs.
Pressed pressed_rectangle(const UnitPressed& unit, const Eigen::Vector2d& half)
{
    constexpr double gyration_to_mean = 0.92; // THEORY.md, section 5
    const double size = std::fabs(half.x() * half.y());
    Eigen::Matrix2d second = unit.second_across * half * half.transpose();
    second.diagonal() = unit.second_along * half.cwiseAbs2();
    return {size * unit.area,
            size * unit.first * half,
            unit.centre * half,
            size * second,
            gyration_to_mean * std::sqrt(unit.spread) * half.norm(),
            size * half.norm() * unit.force};
}

/// What is left of a face without its recess, at the same slope: as the kernel subtracts them.
Pressed without(const Pressed& face, const Pressed& recess)
{
    const double force = face.force - recess.force;
    return {face.area - recess.area,
            face.first - recess.first,
            (face.force * face.centre - recess.force * recess.centre) / force,
            face.second - recess.second,
            (face.force * face.friction_radius - recess.force * recess.friction_radius) / force,
            force};
}

/// What two faces have in common as the bound sees it: a disc or a rectangle along the axes of the joint, its middle
/// from the joint's point.
struct CommonFace {
    bool round = true;
    Eigen::Vector2d middle, half;
    double inner_ratio = 0; ///< of a recess in its middle that lies within those of both faces; 0 if there is none
};

CommonFace common_face(const SolidJoint& joint)
{
    const auto vector = [](const std::array<double, 2>& v) { return Eigen::Vector2d(v[0], v[1]); };
    const auto halves = [&](const Face& face) {
        return joint.normal == Normal::y ? Eigen::Vector2d(face.half_z_m, face.half_x_m)
                                         : Eigen::Vector2d(face.half_x_m, face.half_z_m);
    };
    const CommonFace lower{joint.lower_face.round, vector(joint.lower_middle_m), halves(joint.lower_face)},
        upper{joint.upper_face.round, vector(joint.upper_middle_m), halves(joint.upper_face)};
    const double ratio = joint.inner_ratio;
    if (lower.round && upper.round) {
        CommonFace disc = lower.half.x() < upper.half.x() ? lower : upper;
        double recess = disc.half.x() * ratio;
        for (const CommonFace& of : {lower, upper})
            recess = std::min(recess, ratio * of.half.x() - (of.middle - disc.middle).norm());
        disc.inner_ratio = std::max(recess, 0.0) / disc.half.x();
        return disc;
    }
    const Eigen::Vector2d from = (lower.middle - lower.half).cwiseMax(upper.middle - upper.half),
                          to = (lower.middle + lower.half).cwiseMin(upper.middle + upper.half);
    for (const CommonFace& disc : {lower, upper})
        if (disc.round && from == disc.middle - disc.half && to == disc.middle + disc.half)
            return {true, disc.middle, disc.half, ratio}; // all of it lies on the rectangle
    CommonFace common{false, (from + to) / 2, (to - from) / 2};
    if (lower.round || upper.round)
        return common; // as if all of it did bear: that is stiffer
    common.inner_ratio = ratio;
    for (const CommonFace& of : {lower, upper}) {
        const Eigen::Vector2d recess = ratio * of.half - (of.middle - common.middle).cwiseAbs();
        common.inner_ratio = std::min(common.inner_ratio, recess.cwiseQuotient(common.half).minCoeff());
    }
    common.inner_ratio = std::max(common.inner_ratio, 0.0);
    return common;
}

/// The axes of a joint: the normal and the two that follow it cyclically.
struct Axes {
    Point first, second, normal;
    explicit Axes(Normal of)
    {
        const auto n = static_cast<Eigen::Index>(of);
        first = Point::Unit((n + 1) % 3);
        second = Point::Unit((n + 2) % 3);
        normal = Point::Unit(n);
    }
};

/// The normal dashpot of a patch with coefficient 1 per area, by lift of the middle of the face and tilts: spread over
/// the patch, and a share of it at the ends (kernels/spatial/mechanisms/face_damping.hpp).
/// @param whole area of the face
Eigen::Matrix3d dashpot_moments(const Pressed& pressed, const Eigen::Vector2d& slope, double reach2, bool fades,
                                double whole, double share)
{
    const auto outer = [](const Eigen::Vector2d& at) {
        const Eigen::Vector3d row(1, at.x(), at.y());
        return Eigen::Matrix3d(row * row.transpose());
    };
    Eigen::Matrix3d spread;
    spread << pressed.area, pressed.first.transpose(), pressed.first, pressed.second;
    if (share == 0)
        return spread;
    const Eigen::Vector2d centre = pressed.first / pressed.area;
    const Eigen::Matrix2d J = pressed.second - pressed.first * centre.transpose();
    const Eigen::Vector2d along = J * slope;
    const double moment = slope.dot(along);
    const Eigen::Vector2d end = std::sqrt(reach2 / (pressed.area * moment)) * along;
    Eigen::Matrix3d at_ends =
        (fades ? std::min(pressed.area, whole / 2) : whole / 2) * (outer(centre + end) + outer(centre - end));
    at_ends.bottomRightCorner<2, 2>() += J - along * along.transpose() / moment;
    return (1 - share) * spread + share * at_ends;
}

struct Resistance {
    Matrix6 K = Matrix6::Zero(), C = Matrix6::Zero();
};

/// Every joint of a body, in every state, with each place where it can be deepest.
struct BodyJoint {
    std::array<std::vector<Resistance>, states> of;
};

/// One free body with its joints; motions are divided by the square roots of the masses.
class HeldBody {
public:
    HeldBody(const SpatialStructure& structure, int body)
        : structure_(structure), solid_(structure.solids[static_cast<std::size_t>(body)]),
          centre_(solid_.centre_m[0], solid_.centre_m[1], solid_.centre_m[2])
    {
        per_root_mass_.head<3>().setConstant(1 / std::sqrt(solid_.mass_kg));
        for (Eigen::Index k = 0; k < 3; ++k)
            per_root_mass_(3 + k) = 1 / std::sqrt(solid_.inertia_kg_m2[static_cast<std::size_t>(k)]);
        for (const SolidJoint& joint : structure.joints)
            if (joint.lower == body || joint.upper == body)
                mine_.push_back(
                    {&joint,
                     structure.solids[static_cast<std::size_t>(joint.lower == body ? joint.upper : joint.lower)].fixed
                         ? 1.0
                         : 2.0});
        add_ties();
        for (const Mine& mine : mine_) {
            const CommonFace face = common_face(*mine.joint);
            const Point from = arm(*mine.joint, face.middle);
            const Axes axes(mine.joint->normal);
            const Eigen::Vector2d aside(from.dot(axes.first), from.dot(axes.second));
            if (aside.norm() > aside_.norm())
                aside_ = aside;
            centred_ = centred_ && mine.joint->normal == Normal::y && aside.norm() < rounding * face.half.norm();
            rectangles_ = rectangles_ || !face.round;
            faces_.push_back(face);
        }
        for (std::size_t j = 0; j < mine_.size(); ++j)
            joints_.push_back(resistances(mine_[j], faces_[j], j == 0 && centred_));
    }

    /// The bound of this body, if it is below `most_s`; else `most_s`.
    double bound_s(double most_s) const
    {
        std::vector<std::size_t> place(joints_.size(), 0);
        for (bool more = !joints_.empty(); more;) {
            for (std::size_t s = 0; s < states; ++s) {
                Resistance sum = own_;
                for (std::size_t j = 0; j < joints_.size(); ++j) {
                    sum.K += joints_[j].of[s][place[j]].K;
                    sum.C += joints_[j].of[s][place[j]].C;
                }
                most_s = stable_s(sum, most_s);
            }
            more = false; // the next combination of places
            for (std::size_t j = 0; j < joints_.size() && !more; ++j) {
                more = ++place[j] < joints_[j].of[0].size();
                if (!more)
                    place[j] = 0;
            }
        }
        return most_s;
    }

private:
    static constexpr double rounding = 1e-9;

    struct Mine {
        const SolidJoint* joint;
        double factor; ///< f
    };

    /// From the centre of mass to a point of a joint's face.
    Point arm(const SolidJoint& joint, const Eigen::Vector2d& at) const
    {
        const Axes axes(joint.normal);
        return Point(joint.point_m[0], joint.point_m[1], joint.point_m[2]) + at.x() * axes.first +
               at.y() * axes.second - centre_;
    }

    /// The motion along a direction of the point at `arm`, by motions of the body.
    Row6 motion(const Point& direction, const Point& arm) const
    {
        Row6 row;
        row << direction, arm.cross(direction);
        return row.cwiseProduct(per_root_mass_);
    }
    Row6 rotation(const Point& axis) const
    {
        Row6 row;
        row << Point::Zero(), axis;
        return row.cwiseProduct(per_root_mass_);
    }

    void add_ties()
    {
        const BlockMechanisms& e = solid_.mechanisms;
        for (const Point& along : {Point(Point::UnitX()), Point(Point::UnitZ())}) {
            const Row6 row = motion(along, Point::Zero());
            own_.K += std::max(e.tie_n_m, 0.0) * row * row.transpose(); // one that drives away shortens no step
            own_.C += e.tie_n_s_m * row * row.transpose();
        }
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Row6 row = rotation(Point::Unit(k));
            own_.C += e.tie_n_m_s * row * row.transpose();
        }
        for (const Mine& mine : mine_) {
            const double dowel = mine.joint->mechanisms.dowel_stiffness_n_m;
            const Axes axes(mine.joint->normal);
            for (const Point& along : {axes.first, axes.second}) {
                const Row6 row = motion(along, arm(*mine.joint, {0, 0}));
                own_.K += mine.factor * dowel * row * row.transpose();
            }
        }
    }

    /// @param one of the places is enough: the others follow by symmetry
    BodyJoint resistances(const Mine& mine, const CommonFace& face, bool one) const
    {
        constexpr std::array<std::array<double, 2>, 4> corners{{{1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
        const Eigen::Vector2d line = aside_.norm() > 0 ? Eigen::Vector2d(aside_.normalized()) : Eigen::Vector2d(1, 0);
        const std::size_t places = one ? 1 : face.round && !rectangles_ ? 2 : corners.size();
        BodyJoint joint;
        for (std::size_t s = 0; s < states; ++s)
            for (std::size_t place = 0; place < places; ++place) {
                const Eigen::Vector2d corner(corners[place][0], corners[place][1]);
                const Eigen::Vector2d towards =
                    rectangles_ ? Eigen::Vector2d(corner / std::sqrt(2.0)) : Eigen::Vector2d(corner.x() * line);
                const auto pressed_part = [&](double part) { // of the face's size
                    const double xi = contact_states[s] / part;
                    return face.round ? pressed_disc(unit_disc(xi), part * face.half.x(), towards)
                                      : pressed_rectangle(unit_square(xi), part * corner.cwiseProduct(face.half));
                };
                Pressed pressed = pressed_part(1);
                if (contact_states[s] > -face.inner_ratio && face.inner_ratio > 0)
                    pressed = without(pressed, pressed_part(face.inner_ratio));
                // a rectangle is as deep at both sides of its corner
                const Eigen::Vector2d slope =
                    face.round ? towards : Eigen::Vector2d(corner.cwiseQuotient(face.half).normalized());
                joint.of[s].push_back(resistance(mine, face, pressed, slope));
            }
        return joint;
    }

    /// @param slope along which the depth of the patch grows
    Resistance resistance(const Mine& mine, const CommonFace& face, const Pressed& pressed,
                          const Eigen::Vector2d& slope) const
    {
        const SolidJoint& joint = *mine.joint;
        const Axes axes(joint.normal);
        const Row6 lift = motion(axes.normal, arm(joint, face.middle)), // of the middle, and per distance from it
            by_first = rotation(axes.first.cross(axes.normal)), by_second = rotation(axes.second.cross(axes.normal));
        Eigen::Matrix<double, 6, 3> rows;
        rows << lift, by_first, by_second;
        Eigen::Matrix3d moments;
        moments << pressed.area, pressed.first.transpose(), pressed.first, pressed.second;
        const bool round = joint.lower_face.round || joint.upper_face.round;
        const double inner2 = face.inner_ratio * face.inner_ratio;
        const Eigen::Matrix3d dashpots = dashpot_moments(pressed, slope, (face.round ? 4 : 6) / (1 + inner2), round,
                                                         joint.area_m2, joint.mechanisms.face_damping);

        const Point at = arm(joint, face.middle + pressed.centre);
        const Row6 first = motion(axes.first, at), second = motion(axes.second, at),
                   spin = pressed.friction_radius * rotation(axes.normal);
        const Matrix6 slide = first * first.transpose() + second * second.transpose(), twist = spin * spin.transpose();
        const double f = mine.factor;
        Resistance of;
        of.K = f * (joint.normal_stiffness_n_m3 * rows * moments * rows.transpose() +
                    joint.tangential_stiffness_n_m * (slide + spatial::torsion_ratio<double>() * twist));
        of.C = f * (joint.normal_damping_n_s_m3 * rows * dashpots * rows.transpose() +
                    joint.tangential_damping_n_s_m3 * pressed.area * (slide + twist));
        return of;
    }

    /// The largest stable step, if it is below `most_s`; else `most_s`.
    static double stable_s(const Resistance& sum, double most_s)
    {
        const auto stable = [&](double dt) {
            const Matrix6 of = 4 * Matrix6::Identity() - 2 * dt * sum.C - dt * dt * sum.K;
            return Eigen::LLT<Matrix6>(of).info() == Eigen::Success;
        };
        const double stiffest = sum.K.diagonal().maxCoeff();
        if (!(stiffest > 0) || (most_s < std::numeric_limits<double>::infinity() && stable(most_s)))
            return most_s;
        double low = 0, high = std::min(most_s, 2 / std::sqrt(stiffest)); // not stable
        while (high - low > accuracy * high) {
            const double middle = (low + high) / 2;
            (stable(middle) ? low : high) = middle;
        }
        return low;
    }
    static constexpr double accuracy = 1e-9;

    const SpatialStructure& structure_;
    const Solid& solid_;
    const Point centre_;
    Row6 per_root_mass_;
    std::vector<Mine> mine_;
    std::vector<CommonFace> faces_; ///< (its joints)
    Eigen::Vector2d aside_{0, 0};   ///< the farthest of their middles from the axis through the centre of mass
    bool centred_ = true;           ///< all of them lie on that axis
    bool rectangles_ = false;       ///< some of them are
    Resistance own_;                ///< of ties and dowels
    std::vector<BodyJoint> joints_;
};

} // namespace

double spatial_step_bound_s(const Realization& realization, StepBasis basis)
{
    if (basis == StepBasis::structure)
        throw InputError("run.step_bound = \"structure\" is not available with structure.dimensions = 3: at full "
                         "contact the largest step of the whole structure is no bound, as drums that roll on their "
                         "rims are stiffer. Set it to \"block\", or omit it.");
    double bound_s = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < realization.space.solids.size(); ++i)
        if (!realization.space.solids[i].fixed)
            bound_s = HeldBody(realization.space, static_cast<int>(i)).bound_s(bound_s);
    return bound_s;
}

} // namespace stylobate
