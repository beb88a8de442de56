#pragma once
/// A slow second solver of the same equations, for one stack on a moving base. It shares no code with the kernels:
/// absolute positions in the laboratory in extended precision, the textbook central difference 2 u - u_prev, the
/// overlap by clipping one polygon with the other (Sutherland and Hodgman), the contact direction from the chord, and
/// the velocities as backward differences, each Eq. as it is printed.

#include "ensemble/realization/realization.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate::reference {

using Number = long double;
using Vector = Eigen::Matrix<Number, 2, 1>;

inline Number cross(const Vector& a, const Vector& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

/// A corner, and whether the edge from it to the next one lies on the clipping polygon.
struct Corner {
    Vector point;
    bool on_clip = false;
};

struct Area {
    Number area = 0;                  ///< [m2]
    Vector centroid = Vector::Zero(); ///< [m]
    Vector chord = Vector::Zero();    ///< between the crossings of the outlines [m]
    Vector normal() const { return Vector(chord.y(), -chord.x()) / chord.norm(); }
};

/// Corners of a rectangle, counter-clockwise.
inline std::vector<Vector> rectangle(const Vector& centre, Number angle, Number half_width, Number half_height)
{
    const Vector e(std::cos(angle) * half_width, std::sin(angle) * half_width);
    const Vector f(-std::sin(angle) * half_height, std::cos(angle) * half_height);
    return {centre - e - f, centre + e - f, centre + e + f, centre - e + f};
}

/// Part of `subject` inside `clip`, both convex and counter-clockwise.
/// The chord runs along the edges that lie on `clip`, summed up; its normal points out of `clip`.
inline Area overlap(const std::vector<Vector>& clip, const std::vector<Vector>& subject)
{
    // coordinates near the contact: products of absolute ones would lose what is looked for
    const Vector& origin = subject.front();
    std::vector<Corner> polygon;
    for (const Vector& p : subject)
        polygon.push_back({p - origin, false});
    for (std::size_t i = 0; i < clip.size(); ++i) {
        const Vector a = clip[i] - origin, side = clip[(i + 1) % clip.size()] - clip[i];
        std::vector<Corner> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Corner& from = polygon[k];
            const Corner& to = polygon[(k + 1) % polygon.size()];
            const Number df = cross(side, from.point - a), dt = cross(side, to.point - a);
            if (df >= 0)
                kept.push_back(from);
            if ((df >= 0) != (dt >= 0)) {
                const Vector crossing = from.point + (to.point - from.point) * (df / (df - dt));
                kept.push_back({crossing, df >= 0 ? true : from.on_clip}); // on the way out the clip takes over
            }
        }
        polygon = kept;
    }
    Area result;
    Vector moment = Vector::Zero();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector& p = polygon[k].point;
        const Vector& q = polygon[(k + 1) % polygon.size()].point;
        const Number twice = cross(p, q);
        result.area += twice / 2;
        moment += (p + q) * (twice / 6);
        if (polygon[k].on_clip)
            result.chord += q - p;
    }
    if (result.area > 0)
        result.centroid = origin + moment / result.area;
    return result;
}

struct State {
    Vector at = Vector::Zero(); ///< centre [m]
    Number angle = 0;           ///< [rad]
};

/// What a joint does in one step.
struct JointForce {
    Number normal = 0;     ///< F_N [N]
    Number tangential = 0; ///< F_T, against the sliding of the upper block [N]
};

class Solver {
public:
    /// @param start one state per block, at rest; the base has not moved yet
    Solver(const Realization& r, const std::vector<State>& start)
        : r_(r), now_(start), before_(start), force_(start.size()), moment_(start.size()), spring_(r.joints.size()),
          joint_force_(r.joints.size())
    {
        // U(-dt) = U0 - V0 dt + a0 dt2 / 2 with V0 = 0; the springs have not been sheared
        forces();
        const Number dt2 = Number(r_.step_s) * r_.step_s;
        for (std::size_t i = 0; i < now_.size(); ++i)
            if (!r_.blocks[i].fixed) {
                before_[i].at += acceleration(i) * (dt2 / 2);
                before_[i].angle += moment_[i] / Number(r_.blocks[i].inertia_kg_m2) * (dt2 / 2);
            }
    }

    /// One step: all that is fixed moves to the base's next displacement [m]; where the base is at rest instead,
    /// `inertial` [m/s2] is the acceleration of the frame.
    void step(Number next_base, Number inertial = 0)
    {
        forces();
        const Number dt2 = Number(r_.step_s) * r_.step_s;
        for (std::size_t i = 0; i < now_.size(); ++i) {
            State next = now_[i];
            if (r_.blocks[i].fixed) {
                next.at.x() = r_.blocks[i].x_m + next_base;
            } else {
                const Vector a = acceleration(i) - Vector(inertial, 0);
                next.at = 2 * now_[i].at - before_[i].at + dt2 * a; // Eqs. 4 and 5
                next.angle = 2 * now_[i].angle - before_[i].angle + dt2 * moment_[i] / r_.blocks[i].inertia_kg_m2; // 6
            }
            before_[i] = now_[i];
            now_[i] = next;
        }
    }

    const State& block(std::size_t i) const { return now_[i]; }
    const std::vector<State>& blocks() const { return now_; }
    /// Of the last step.
    const JointForce& joint(std::size_t j) const { return joint_force_[j]; }

    static Area overlap_of(const Block& lower, const State& l, const Block& upper, const State& u)
    {
        return overlap(rectangle(l.at, l.angle, lower.half_width_m, lower.half_height_m),
                       rectangle(u.at, u.angle, upper.half_width_m, upper.half_height_m));
    }

private:
    Vector acceleration(std::size_t i) const
    {
        return force_[i] / Number(r_.blocks[i].mass_kg) - Vector(0, r_.gravity_m_s2);
    }

    /// Velocity of a block's material point [m/s], by backward differences.
    Vector velocity(std::size_t i, const Vector& point) const
    {
        const Number dt = r_.step_s;
        const Vector v = (now_[i].at - before_[i].at) / dt;
        const Number w = (now_[i].angle - before_[i].angle) / dt;
        const Vector arm = point - now_[i].at;
        return v + w * Vector(-arm.y(), arm.x());
    }

    void forces()
    {
        std::fill(force_.begin(), force_.end(), Vector::Zero());
        std::fill(moment_.begin(), moment_.end(), Number(0));
        for (std::size_t j = 0; j < r_.joints.size(); ++j) {
            const Joint& joint = r_.joints[j];
            const auto lower = static_cast<std::size_t>(joint.lower), upper = static_cast<std::size_t>(joint.upper);
            const Area a = overlap_of(r_.blocks[lower], now_[lower], r_.blocks[upper], now_[upper]);
            const Number length = a.chord.norm();
            joint_force_[j] = {};
            if (a.area < 1e-18L || length < 1e-12L) {
                spring_[j] = 0;
                continue;
            }
            const Vector normal = a.normal(), tangent(normal.y(), -normal.x());
            const Vector v = velocity(upper, a.centroid) - velocity(lower, a.centroid);
            const Number share = joint.damping_chord_m > 0 ? length / joint.damping_chord_m : 1;
            const Number dt = r_.step_s;
            // Eq. 1, without tension
            const Number F_n = std::max(Number(0), joint.normal_stiffness_n_m2 * a.area -
                                                       share * joint.normal_damping_n_s_m * v.dot(normal));
            // Eqs. 2 and 3
            const Number limit = joint.friction * F_n, sliding = v.dot(tangent);
            spring_[j] = std::clamp(spring_[j] + joint.tangential_stiffness_n_m * sliding * dt, -limit, limit);
            const Number F_t = std::clamp(spring_[j] + share * joint.tangential_damping_n_s_m * sliding, -limit, limit);
            joint_force_[j] = {F_n, F_t};
            const Vector F = F_n * normal - F_t * tangent;
            force_[upper] += F;
            moment_[upper] += cross(a.centroid - now_[upper].at, F);
            force_[lower] -= F;
            moment_[lower] -= cross(a.centroid - now_[lower].at, F);
        }
    }

    Realization r_;
    std::vector<State> now_, before_;
    std::vector<Vector> force_;
    std::vector<Number> moment_;
    std::vector<Number> spring_;
    std::vector<JointForce> joint_force_;
};

} // namespace stylobate::reference
