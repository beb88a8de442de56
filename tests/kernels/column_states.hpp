#pragma once
/// Columns in random states, in the kernels' own memory: for the tests that compare instruction sets.

#include "kernels/isa.hpp"
#include "kernels/planar/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace stylobate {

/// Memory as the kernels want it.
template <class Number = double>
struct Aligned {
    explicit Aligned(std::size_t numbers)
        : count(numbers), data(static_cast<Number*>(std::aligned_alloc(64, (numbers * sizeof(Number) + 63) / 64 * 64)))
    {
        std::fill_n(data.get(), count, Number{0});
    }
    struct Free {
        void operator()(Number* p) const { std::free(p); }
    };
    std::size_t count;
    std::unique_ptr<Number[], Free> data;
};

/// One realization by itself, in the layout of a bundle with one lane.
using State = std::vector<double>;

struct Column {
    explicit Column(int free_blocks, const std::vector<int>& order = {})
    {
        for (int j = 0; j < free_blocks; ++j) {
            const int k = order.empty() ? j : order[static_cast<std::size_t>(j)];
            joints.push_back({k, k + 1});
        }
        topology.blocks = free_blocks + 1;
        topology.fixed = 1;
        topology.top = free_blocks;
        topology.joints = free_blocks;
        topology.joint = joints.data();
        bed_lists.resize(static_cast<std::size_t>(bed_lists_size(topology)));
        list_beds(topology, bed_lists.data());
    }
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;
    std::size_t registers() const { return bundle_registers(topology); }

    std::vector<TopologyJoint> joints;
    std::vector<int> bed_lists;
    Topology topology;
};

/// How a random column is placed.
enum class Pose { aligned, standing, rocking, heap };

class StateMaker {
public:
    explicit StateMaker(std::uint64_t seed) : engine_(seed) {}

    State make(const Column& column, Pose pose)
    {
        Aligned<> memory(column.registers());
        const Bundle b = bind_bundle(column.topology, 1, memory.data.get());
        const double dt = 1e-4, K = std::exp(uniform(std::log(1e7), std::log(1e9)));
        double top = 0, lean = 0;
        for (int i = 0; i <= column.topology.joints; ++i) {
            const double width = pose == Pose::aligned ? 0.048 : 0.048 + uniform(-0.004, 0.004);
            const double height = pose == Pose::aligned ? 0.029 : 0.029 + uniform(-0.002, 0.002);
            const double mass = 2000 * width * height * 0.048;
            b.at(OfBlock::half_width, i, 0) = width / 2;
            b.at(OfBlock::half_height, i, 0) = height / 2;
            b.at(OfBlock::mass, i, 0) = mass;
            b.at(OfBlock::inertia, i, 0) = mass * (width * width + height * height) / 12;
            if (i == 0)
                continue;
            b.at(OfBlock::dt2_per_mass, i, 0) = dt * dt / mass;
            b.at(OfBlock::dt2_per_inertia, i, 0) = dt * dt / b.at(OfBlock::inertia, i, 0);
            top -= mass * 9.81 * (column.topology.joints - i + 1) / (K * width);
            place(b, i, pose, top, lean);
        }
        for (int j = 0; j < column.topology.joints; ++j) {
            const auto [lower, upper] = column.joints[static_cast<std::size_t>(j)];
            const double hl = b.at(OfBlock::half_height, lower, 0), hu = b.at(OfBlock::half_height, upper, 0);
            b.at(OfJoint::reference_x, j, 0) = pose == Pose::aligned ? 0 : uniform(-1e-3, 1e-3);
            b.at(OfJoint::height, j, 0) = hl + hu;
            b.at(OfJoint::depth_limit, j, 0) = 0.1 * std::min(hl, hu);
            b.at(OfJoint::K_n, j, 0) = K;
            b.at(OfJoint::K_t, j, 0) = K * 0.048;
            b.at(OfJoint::per_K_t, j, 0) = 1 / (K * 0.048);
            const double C = 0.2 * std::sqrt(K * 0.048 * b.at(OfBlock::mass, upper, 0)) / dt;
            const bool chord = uniform(0, 1) < 0.5;
            for (auto [constant, each] : {std::pair{OfJoint::C_n_per_dt, OfJoint::C_n_chord},
                                          std::pair{OfJoint::C_t_per_dt, OfJoint::C_t_chord}}) {
                b.at(constant, j, 0) = chord ? 0 : C;
                b.at(each, j, 0) = chord ? C / 0.048 : 0;
            }
            b.at(OfJoint::mu, j, 0) = uniform(0.3, 0.9);
        }
        b.at(OfRealization::gravity_dx, 0) = dt * dt * 9.81 * uniform(-0.002, 0.002);
        b.at(OfRealization::gravity_dy, 0) = -dt * dt * 9.81;
        double base = 0;
        for (int k = 0; k < chunk_steps; ++k) {
            base = 0.9 * base + dt * dt * uniform(-2, 2);
            b.rows<OfBase::Field>()[k] = base;
        }
        return State(memory.data.get(), memory.data.get() + memory.count);
    }

    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    std::uint64_t word() { return engine_(); }

private:
    void place(const Bundle& b, int i, Pose pose, double top, double& lean)
    {
        const double dt = 1e-4;
        b.at(OfBlock::y, i, 0) = top;
        if (pose == Pose::aligned)
            return;
        double speed = 0.01;
        if (pose == Pose::standing) {
            b.at(OfBlock::theta, i, 0) = uniform(-1, 1) * std::pow(10.0, uniform(-16, -5));
        } else if (pose == Pose::rocking) {
            lean += uniform(-0.02, 0.02);
            b.at(OfBlock::theta, i, 0) = lean;
            b.at(OfBlock::x, i, 0) = uniform(-0.01, 0.01);
            b.at(OfBlock::y, i, 0) = top + uniform(-1e-4, 5e-4);
            speed = 0.2;
        } else { // thrown together: any angle, many turns, deep in one another
            b.at(OfBlock::theta, i, 0) = uniform(-1, 1) * (uniform(0, 1) < 0.3 ? 300.0 : 3.0);
            b.at(OfBlock::x, i, 0) = uniform(-0.03, 0.03);
            b.at(OfBlock::y, i, 0) = uniform(-0.02, 0.02);
            speed = 1;
        }
        b.at(OfBlock::dx, i, 0) = dt * speed * uniform(-1, 1);
        b.at(OfBlock::dy, i, 0) = dt * speed * uniform(-1, 1);
        b.at(OfBlock::dtheta, i, 0) = dt * 20 * speed * uniform(-1, 1);
    }

    std::mt19937_64 engine_;
};

/// In how many joints the closed form of the overlap does not hold.
inline int general_joints(const Column& column, State state)
{
    const Bundle b = bind_bundle(column.topology, 1, state.data());
    int count = 0;
    for (int j = 0; j < column.topology.joints; ++j) {
        const auto [lower, upper] = column.joints[static_cast<std::size_t>(j)];
        const double tl = b.at(OfBlock::theta, lower, 0), tu = b.at(OfBlock::theta, upper, 0);
        const double x = b.at(OfJoint::reference_x, j, 0) + b.at(OfBlock::x, upper, 0) - b.at(OfBlock::x, lower, 0);
        const double y = b.at(OfJoint::height, j, 0) + b.at(OfBlock::y, upper, 0) - b.at(OfBlock::y, lower, 0);
        const double hu = b.at(OfBlock::half_height, upper, 0);
        Placement<double> p{};
        p.sine = std::sin(tu - tl);
        p.cosine = std::cos(tu - tl);
        p.x = x * std::cos(tl) + y * std::sin(tl) + hu * p.sine;
        p.depth = b.at(OfBlock::half_height, lower, 0) - (y * std::cos(tl) - x * std::sin(tl) - hu * p.cosine);
        bool fits = false;
        stacked_overlap(p, b.at(OfBlock::half_width, lower, 0), b.at(OfBlock::half_width, upper, 0),
                        b.at(OfJoint::depth_limit, j, 0), fits);
        count += !fits;
    }
    return count;
}

inline Pose any_pose(StateMaker& maker)
{
    return static_cast<Pose>(maker.word() % 4);
}

} // namespace stylobate
