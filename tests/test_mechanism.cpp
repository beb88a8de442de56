/// The place for extensions of the model: one that is neutral gives the baseline's bits, one that is not changes them.

#include "kernels/step.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

using namespace stylobate;

namespace {

/// Friction of one joint times a factor: the smallest extension there is.
struct OneJointsFriction {
    struct State {
        int joint = 0;
        double factor = 1; // neutral
    };
    template <class Real>
    static ContactForce<Real> force(const State& state, int joint, JointLaw<Real> law, Real area, Real length,
                                    Real closing, Real sliding, Real spring)
    {
        law.mu = law.mu * Real(joint == state.joint ? state.factor : 1.0);
        return contact_force(law, area, length, closing, sliding, spring);
    }
};

constexpr int drums = 4;

/// A column of drums on a base that is jerked away under it, after some steps.
template <class Mechanism>
std::vector<double> shaken_column(const typename Mechanism::State& state)
{
    std::vector<TopologyJoint> joints;
    for (int i = 0; i < drums; ++i)
        joints.push_back({i, i + 1});
    const Topology topology{drums + 1, 1, drums, drums, joints.data()};
    std::vector<double> memory(bundle_registers(topology), 0.0);
    const Bundle b = bind_bundle(topology, 1, memory.data());
    const double dt = 2e-5, mass = 0.1355, width = 0.048, height = 0.029;
    for (int i = 0; i <= drums; ++i) {
        b.at(OfBlock::half_width, i, 0) = width / 2;
        b.at(OfBlock::half_height, i, 0) = height / 2;
        b.at(OfBlock::mass, i, 0) = mass;
        b.at(OfBlock::inertia, i, 0) = mass * (width * width + height * height) / 12;
        b.at(OfBlock::y, i, 0) = -1e-6 * i;
        if (i > 0) {
            b.at(OfBlock::dt2_per_mass, i, 0) = dt * dt / mass;
            b.at(OfBlock::dt2_per_inertia, i, 0) = dt * dt / b.at(OfBlock::inertia, i, 0);
        }
    }
    for (int j = 0; j < drums; ++j) {
        b.at(OfJoint::height, j, 0) = height;
        b.at(OfJoint::depth_limit, j, 0) = 0.001;
        b.at(OfJoint::K_n, j, 0) = 1e8;
        b.at(OfJoint::K_t, j, 0) = 4.8e6;
        b.at(OfJoint::per_K_t, j, 0) = 1 / 4.8e6;
        b.at(OfJoint::C_n_per_dt, j, 0) = 160 / dt;
        b.at(OfJoint::C_t_per_dt, j, 0) = 160 / dt;
        b.at(OfJoint::mu, j, 0) = 0.3;
    }
    b.at(OfRealization::gravity_dy, 0) = -9.81 * dt * dt;
    for (int k = 0; k < chunk_steps; ++k)
        b.base_table[k] = 6.0 * dt * dt;
    for (int chunk = 0; chunk < 40; ++chunk)
        run_steps<double, Mechanism>(topology, b, 0, chunk_steps, state);
    return memory;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

} // namespace

TEST(Mechanism, NeutralOneGivesTheBaselinesBits)
{
    const std::vector<double> want = shaken_column<Baseline>({});
    EXPECT_TRUE(same_bits(shaken_column<OneJointsFriction>({2, 1.0}), want));
}

TEST(Mechanism, OneThatIsNotNeutralActsWhereItIs)
{
    const std::vector<double> baseline = shaken_column<Baseline>({});
    for (int joint = 0; joint < drums; ++joint) {
        const std::vector<double> weak = shaken_column<OneJointsFriction>({joint, 0.5});
        EXPECT_FALSE(same_bits(weak, baseline)) << joint;
    }
}
