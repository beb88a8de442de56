#pragma once
/// Columns of six drums in space, for each kind of bed: what the spatial step is timed and counted on.

#include "kernels/isa.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace stylobate::spatial {

class Column {
public:
    static constexpr int drums = 6;

    explicit Column(BedKind kind) : kind_(kind)
    {
        for (int i = 0; i < drums; ++i)
            joints_.push_back({i, i + 1, kind});
        topology_.bodies = drums + 1;
        topology_.fixed = 1;
        topology_.top = drums;
        topology_.joints = drums;
        topology_.joint = joints_.data();
        topology_.correction = correction_.data();
        lists_.resize(static_cast<std::size_t>(joint_lists_size(topology_)));
        list_joints(topology_, lists_.data());
    }
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;

    const Topology& topology() const { return topology_; }

    /// Puts the column into a lane that is empty: pressed by its weight, twisted, and moving.
    void load(const Bundle& b, int lane) const
    {
        const double R = 0.024, H = 0.029, k = 1e8 / 0.048, dt = 5e-5, dt2 = dt * dt, g = 9.81;
        const bool round = kind_ != BedKind::rectangle;
        const double area = (round ? std::numbers::pi : 4) * R * R, m = 2030 * area * H, K = k * area;
        const double across = m * (R * R / (round ? 4 : 3) + H * H / 12), along = m * R * R * (round ? 0.5 : 2.0 / 3);
        b.at(OfRealization::dt2, lane) = dt2;
        b.at(OfRealization::gravity_dy, lane) = -dt2 * g;
        b.at(OfBody::q_w, 0, lane) = 1;
        for (int i = 1; i <= drums; ++i) {
            const double twist = 2e-3 * i;
            b.at(OfBody::y, i, lane) = b.at(OfBody::y, i - 1, lane) - (drums + 1 - i) * m * g / K;
            b.at(OfBody::q_w, i, lane) = std::cos(0.5 * twist);
            b.at(OfBody::q_y, i, lane) = std::sin(0.5 * twist);
            b.at(OfBody::dx, i, lane) = 1e-4 * dt * i;
            b.at(OfBody::l_z, i, lane) = 1e-9;
            b.at(OfBody::mass, i, lane) = m;
            b.at(OfBody::dt2_per_mass, i, lane) = dt2 / m;
            b.at(OfBody::per_sphere, i, lane) = 1 / across;
            b.at(OfBody::per_top, i, lane) = 1 / along - 1 / across;
            b.at(OfBody::least_y, i, lane) = -0.5 * H;
        }
        for (int j = 0; j < drums; ++j) {
            b.at(OfJoint::stiffness, j, lane) = k;
            b.at(OfJoint::K_t, j, lane) = K;
            b.at(OfJoint::per_K_t, j, lane) = 1 / K;
            b.at(OfJoint::C_n, j, lane) = b.at(OfJoint::C_t, j, lane) = 0.2 * std::sqrt(K * m) / (area * dt);
            b.at(OfJoint::mu, j, lane) = 0.68;
            b.at(OfJoint::depth_limit, j, lane) = 0.1 * H;
            b.at(static_cast<OfJoint::Field>(OfJoint::lower_anchor + 1), j, lane) = 0.5 * H;
            b.at(static_cast<OfJoint::Field>(OfJoint::upper_anchor + 1), j, lane) = -0.5 * H;
            for (const auto f :
                 {OfJoint::lower_half_1, OfJoint::lower_half_2, OfJoint::upper_half_1, OfJoint::upper_half_2})
                b.at(f, j, lane) = R;
        }
        for (int step = 0; step < chunk_steps; ++step) {
            b.at(OfBaseX::second, step, lane) = 2e-3 * dt2;
            b.at(OfBaseZ::second, step, lane) = 1e-3 * dt2;
        }
    }

private:
    BedKind kind_;
    std::vector<TopologyJoint> joints_;
    std::vector<Axis> correction_ = std::vector<Axis>(drums + 1, Axis::none);
    std::vector<int> lists_;
    Topology topology_;
};

} // namespace stylobate::spatial
