#include "ensemble/spatial/structure/initial_tilt.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {
namespace {

using Vector = spatial::Vector<double>;

constexpr int halvings = 100; ///< of the depth: as far as the numbers go

/// From the middle of a face to the point of its rim that is farthest in a horizontal direction; in the middle of a
/// side, where the side is across it.
Vector rim(const Face& face, double x, double z)
{
    if (face.round)
        return {face.half_x_m * x, 0, face.half_x_m * z};
    constexpr double across = 1e-12; // of a sine or cosine
    const auto side = [](double component) { return component > across ? 1 : component < -across ? -1 : 0; };
    return {side(x) * face.half_x_m, 0, side(z) * face.half_z_m};
}

class Lean {
public:
    Lean(const SpatialStructure& structure, const SolidTopology& solids, ForcesAtRest& forces,
         std::vector<SolidPose>& poses)
        : structure_(structure), solids_(solids), forces_(forces), poses_(poses), rest_(poses),
          angle_(std::fabs(structure.initial_tilt_rad))
    {
        const double side = structure.initial_tilt_rad < 0 ? -1 : 1;
        x_ = side * std::cos(structure.initial_tilt_direction_rad);
        z_ = side * std::sin(structure.initial_tilt_direction_rad);
        forces.put(poses);
        for (int j = 0; j < solids.kernel().joints; ++j)
            carried_n_.push_back(structure.joints[static_cast<std::size_t>(j)].normal == Normal::y ? forces.normal_n(j)
                                                                                                   : 0);
    }

    void run()
    {
        int columns = 0;
        for (const Solid& solid : structure_.solids)
            columns = std::max(columns, solid.column + 1);
        forces_.limit_depth(false); // the deeper, the more force
        for (int column = 0; column < columns; ++column)
            lean_column(column);
        for (std::size_t i = 0; i < structure_.solids.size(); ++i)
            if (structure_.solids[i].role == BlockRole::epistyle && !structure_.solids[i].fixed)
                lift_epistyle(static_cast<int>(i));
        forces_.limit_depth(true);
    }

private:
    std::size_t place(int solid) const
    {
        return static_cast<std::size_t>(solids_.place_of(static_cast<std::size_t>(solid)));
    }
    const Solid& solid(int i) const { return structure_.solids[static_cast<std::size_t>(i)]; }

    /// Where a point of a body is. @param own from its centre of mass, in its frame
    Vector point(int i, const Vector& own, const SolidPose& pose) const
    {
        const auto& c = solid(i).centre_m;
        return Vector{c[0], c[1], c[2]} + pose.displacement + rotated(spatial::minus_identity(pose.attitude), own);
    }

    void lean_column(int column)
    {
        std::vector<int> moved;
        int number = 0; // in the column
        for (std::size_t i = 0; i < structure_.solids.size(); ++i) {
            const Solid& drum = structure_.solids[i];
            if (drum.role != BlockRole::drum || drum.column != column)
                continue;
            if (number++ >= structure_.initial_tilt_block && !drum.fixed)
                moved.push_back(static_cast<int>(i));
        }
        if (moved.empty())
            return;
        const int foot = moved.front();
        const auto bottom = solid(foot).to_bottom();
        const Vector pivot =
            point(foot, Vector{bottom[0], bottom[1], bottom[2]} + rim(solid(foot).bottom, x_, z_), poses_[place(foot)]);
        const Vector turn = angle_ * Vector{z_, 0, -x_};
        const spatial::Matrix<double> m = spatial::minus_identity(after_turn(spatial::no_rotation<double>(), turn));
        for (const int i : moved) {
            SolidPose& pose = poses_[place(i)];
            pose.displacement = pose.displacement + displaced(m, point(i, {0, 0, 0}, pose) - pivot);
            pose.attitude = after_turn(pose.attitude, turn);
        }
        press_in(moved, solid(foot).height_m / 2);
    }

    /// Onto its seats: their highest points are at the side from which the columns lean.
    void lift_epistyle(int epistyle)
    {
        Vector sum{0, 0, 0};
        int seats = 0;
        for (const SolidJoint& joint : structure_.joints) {
            if (joint.upper != epistyle || joint.normal != Normal::y || solid(joint.lower).role == BlockRole::ground)
                continue;
            const auto top = solid(joint.lower).to_top();
            const Vector high = Vector{top[0], top[1], top[2]} + rim(solid(joint.lower).top, -x_, -z_);
            const std::size_t i = place(joint.lower);
            sum = sum + (point(joint.lower, high, poses_[i]) - point(joint.lower, high, rest_[i]));
            ++seats;
        }
        if (seats == 0)
            return;
        SolidPose& pose = poses_[place(epistyle)];
        pose.displacement = pose.displacement + 1.0 / seats * sum;
        press_in({epistyle}, solid(epistyle).height_m / 2);
    }

    /// Moves bodies up or down together until the beds on which they stand carry what they carry at rest.
    /// @param reach upwards they are then in the air, downwards far too deep
    void press_in(const std::vector<int>& moved, double reach)
    {
        const auto moves = [&](int i) { return std::find(moved.begin(), moved.end(), i) != moved.end(); };
        const auto carries = [&](const SolidJoint& joint) {
            return joint.normal == Normal::y && moves(joint.upper) && !moves(joint.lower);
        };
        const auto sum = [&](const auto& force) {
            double all = 0;
            for (std::size_t j = 0; j < structure_.joints.size(); ++j)
                if (carries(structure_.joints[j]))
                    all += force(j);
            return all;
        };
        const double weight = sum([&](std::size_t j) { return carried_n_[j]; });
        const std::vector<SolidPose> from = poses_;
        const auto shift = [&](double y) {
            for (const int i : moved)
                poses_[place(i)].displacement.y = from[place(i)].displacement.y + y;
        };
        double high = reach, low = -reach;
        for (int n = 0; n < halvings; ++n) {
            const double middle = 0.5 * (high + low);
            shift(middle);
            forces_.put(poses_);
            (sum([&](std::size_t j) { return forces_.normal_n(static_cast<int>(j)); }) > weight ? low : high) = middle;
        }
        shift(low);
    }

    const SpatialStructure& structure_;
    const SolidTopology& solids_;
    ForcesAtRest& forces_;
    std::vector<SolidPose>& poses_;
    const std::vector<SolidPose> rest_;
    double angle_, x_ = 0, z_ = 0;  ///< of the tilt; direction towards which they lean
    std::vector<double> carried_n_; ///< (joints) by beds at rest
};

} // namespace

void lean(const SpatialStructure& structure, const SolidTopology& topology, ForcesAtRest& forces,
          std::vector<SolidPose>& poses)
{
    Lean(structure, topology, forces, poses).run();
}

} // namespace stylobate
