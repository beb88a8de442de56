/// Mechanisms of structures in space from a realization to the kernel: which step runs, directions and points of
/// wedges and centres of mass, ties, and the energy balance.

#include "ensemble/spatial/spatial_watch.hpp"
#include "ensemble/spatial/structure/solid_mechanisms.hpp"
#include "tests/ensemble/spatial/standing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

using B = spatial::OfBody;
using Vec = spatial::Vector<double>;

constexpr double gravity = 9.81;

Solid solid(bool round, double width_m, double depth_m, double height_m, double bottom_m, double mass_kg)
{
    Solid s;
    s.bottom = s.top = {round, width_m / 2, depth_m / 2};
    s.height_m = height_m;
    s.mass_kg = mass_kg;
    const double x = width_m * width_m, y = height_m * height_m, z = depth_m * depth_m;
    const double round_part = round ? 0.75 : 1;
    s.inertia_kg_m2 = {mass_kg * (y + round_part * z) / 12, mass_kg * round_part * (x + z) / 12,
                       mass_kg * (y + round_part * x) / 12};
    s.centre_height_m = height_m / 2;
    s.centre_m = {0, bottom_m + height_m / 2, 0};
    return s;
}

/// @param size of the smaller face, whose area bears
SolidJoint bed(const SpatialStructure& of, int lower, double area_m2, double mass_kg)
{
    SolidJoint j;
    j.lower = lower;
    j.upper = lower + 1;
    const Solid &below = of.solids[static_cast<std::size_t>(lower)],
                &above = of.solids[static_cast<std::size_t>(lower) + 1];
    j.point_m = {above.centre_m[0] - above.eccentricity_m[0], above.centre_m[1] - above.centre_height_m,
                 above.centre_m[2] - above.eccentricity_m[1]};
    j.lower_face = below.top;
    j.upper_face = above.bottom;
    j.area_m2 = area_m2;
    j.normal_stiffness_n_m3 = 1e9;
    j.tangential_stiffness_n_m = 1e9 * area_m2;
    j.normal_damping_n_s_m3 = j.tangential_damping_n_s_m3 = 2 * 0.3 * std::sqrt(1e9 * mass_kg / area_m2);
    j.friction = 0.8;
    return j;
}

/// A block of 0.8 m x 0.8 m x 2 m on a fixed one.
Realization block(bool round)
{
    Realization r;
    r.gravity_m_s2 = gravity;
    r.step_s = 1e-4;
    r.space.solids = {solid(round, 4, 4, 1, -1, 1e4), solid(round, 0.8, 0.8, 2, 0, 2000)};
    r.space.solids[0].fixed = true;
    r.space.drums = 2;
    r.space.joints = {bed(r.space, 0, round ? std::numbers::pi * 0.16 : 0.64, 2000)};
    return r;
}

/// A beam on a round drum, the drum on a fixed one.
Realization beam_on_drum()
{
    Realization r = block(true);
    r.space.solids[1] = solid(true, 1.2, 1.2, 1, 0, 2500);
    r.space.joints[0] = bed(r.space, 0, std::numbers::pi * 0.36, 2500);
    r.space.solids.push_back(solid(false, 2, 1, 0.5, 1, 2500));
    r.space.joints.push_back(bed(r.space, 1, std::numbers::pi * 0.36, 2500));
    r.space.drums = 3;
    return r;
}

/// One realization in a bundle of one lane.
struct Stepped {
    explicit Stepped(const Realization& r)
        : topology(r.space), memory(allocate(spatial::bundle_registers(topology.kernel())), &std::free),
          bundle(spatial::bind_bundle(topology.kernel(), 1, memory.get()))
    {
        store_solids(r, topology, bundle, 0);
    }
    static double* allocate(std::size_t numbers)
    {
        auto* const memory = static_cast<double*>(std::aligned_alloc(64, (numbers * sizeof(double) + 63) / 64 * 64));
        std::fill_n(memory, numbers, 0.0);
        return memory;
    }
    void run(int chunks)
    {
        for (int chunk = 0; chunk < chunks; ++chunk)
            kernels(Isa::scalar).spatial.run(topology.kernel(), bundle, 0, chunk_steps);
    }
    Vec vector(B::Field field, int body) const
    {
        const auto at = [&](int k) { return bundle.at(static_cast<B::Field>(field + k), body, 0); };
        return {at(0), at(1), at(2)};
    }
    /// Its rotation vector, of small angles.
    Vec turned(int body) const { return 2.0 * vector(B::q_x, body); }

    SolidTopology topology;
    std::unique_ptr<double[], decltype(&std::free)> memory;
    spatial::Bundle bundle;
};

TEST(SolidMechanisms, TheStepWithMechanismsRunsWhereOneHasRows)
{
    const auto model = [](const std::function<void(Realization&)>& set) {
        Realization r = block(true);
        set(r);
        return model_in_space(r.space).mechanisms;
    };
    const auto joint = [&](double JointMechanisms::*member, double value) {
        return model([&](Realization& r) { r.space.joints[0].mechanisms.*member = value; });
    };
    const auto body = [&](double BlockMechanisms::*member, double value) {
        return model([&](Realization& r) { r.space.solids[1].mechanisms.*member = value; });
    };
    EXPECT_FALSE(model([](Realization&) {}));
    EXPECT_TRUE(model([](Realization& r) { r.space.with_mechanisms = true; }));
    EXPECT_TRUE(joint(&JointMechanisms::dynamic_ratio, 0.9));
    EXPECT_TRUE(joint(&JointMechanisms::wear_per_m, 1));
    EXPECT_TRUE(joint(&JointMechanisms::adhesion_pa, 1));
    EXPECT_TRUE(joint(&JointMechanisms::dowel_stiffness_n_m, 1));
    EXPECT_TRUE(joint(&JointMechanisms::face_damping, 0.1));
    EXPECT_TRUE(joint(&JointMechanisms::wedge_rad, -1e-3));
    EXPECT_TRUE(joint(&JointMechanisms::wedge_x_rad, 1e-3));
    EXPECT_TRUE(body(&BlockMechanisms::tie_n_m, 1));
    EXPECT_TRUE(body(&BlockMechanisms::tie_n_s_m, 1));
    EXPECT_TRUE(body(&BlockMechanisms::tie_n, -1));
    EXPECT_TRUE(body(&BlockMechanisms::tie_n_m_s, 1));
    // friction and centres of mass are values of the plain step
    EXPECT_FALSE(body(&BlockMechanisms::eccentricity_m, 0.1));
    EXPECT_FALSE(joint(&JointMechanisms::stribeck_velocity_m_s, 0.1));
}

TEST(SolidMechanisms, AnEccentricBlockLeansByItsMomentInItsDirection)
{
    // (k I - W h) tilt = W e, I of the face; towards (e_x, e_z), that is about (e_z, -e_x)
    const double e_x = 0.012, e_z = -0.02, W = 2000 * gravity;
    for (const bool round : {true, false}) {
        Realization r = block(round);
        Solid& s = r.space.solids[1];
        s.eccentricity_m = {e_x, e_z};
        s.centre_m[0] += e_x;
        s.centre_m[2] += e_z;
        Stepped stepped(r);
        stepped.run(600);
        const double second = round ? std::numbers::pi * 0.0256 / 4 : 0.8 * 0.512 / 12;
        const double per_e = W / (1e9 * second - W);
        const Vec turned = stepped.turned(1);
        EXPECT_NEAR(turned.x, per_e * e_z, 2e-3 * per_e * 0.02);
        EXPECT_NEAR(turned.z, -per_e * e_x, 2e-3 * per_e * 0.02);
    }
}

TEST(SolidMechanisms, AWedgeTiltsWhatRestsOnIt)
{
    // about x and z; the weight adds a part W h / (k I - W h)
    const double about_x = 0.004, about_z = -0.007;
    for (const bool round : {true, false}) {
        Realization r = block(round);
        r.space.joints[0].mechanisms.wedge_rad = about_z;
        r.space.joints[0].mechanisms.wedge_x_rad = about_x;
        Stepped stepped(r);
        stepped.run(600);
        const double second = round ? std::numbers::pi * 0.0256 / 4 : 0.8 * 0.512 / 12, W = 2000 * gravity;
        const double part = 1 + W / (1e9 * second - W);
        const Vec turned = stepped.turned(1);
        EXPECT_NEAR(turned.x, part * about_x, 2e-5);
        EXPECT_NEAR(turned.z, part * about_z, 2e-5);
    }
}

TEST(SolidMechanisms, ABeamOnAWedgeOfARoundDrumTiltsTheSameWay)
{
    // the kernel's lower face is the beam's, its normal points down
    const double about_x = 0.004, about_z = -0.007;
    Realization r = beam_on_drum();
    r.space.joints[1].mechanisms.wedge_rad = about_z;
    r.space.joints[1].mechanisms.wedge_x_rad = about_x;
    Stepped stepped(r);
    ASSERT_TRUE(stepped.topology.kernel().joint[1].reversed);
    stepped.run(600);
    const Vec beam = stepped.turned(2), drum = stepped.turned(1);
    EXPECT_NEAR(beam.x - drum.x, about_x, 1e-4);
    EXPECT_NEAR(beam.z - drum.z, about_z, 1e-4);
    EXPECT_LT(std::hypot(drum.x, drum.z), 1e-4);
    // one that is laid beside the middle of the drum rises or sinks with the slope of the drum's face there
    const double aside = 0.3;
    Realization offset = r;
    offset.space.joints[1].mechanisms.wedge_x_rad = 0;
    offset.space.solids[2].centre_m[0] = aside;
    offset.space.joints[1].point_m[0] = aside;
    offset.space.joints[1].lower_middle_m = {0, -aside};
    Stepped beside(offset);
    beside.run(600);
    EXPECT_NEAR(beside.vector(B::x, 2).y, aside * about_z, 2e-4);
}

TEST(SolidMechanisms, EachEndHasHalfOfTheDashpotOfTheFace)
{
    // one step of a block that turns: c A / 2 at both edges, b from the middle, resist with c A b2, and a dashpot that
    // is spread with c A b2 / 3
    const auto braking = [](double share) { // moment per rate of rotation
        Realization r = block(false);
        r.space.joints[0].mechanisms.face_damping = share;
        r.space.joints[0].friction = 0;
        const auto gain = [&](double rate) {
            Stepped stepped(r);
            stepped.bundle.at(B::y, 1, 0) = -1e-3; // pressed all over
            stepped.bundle.at(B::q_z, 1, 0) = 1e-6;
            const double l = rate * r.step_s * r.space.solids[1].inertia_kg_m2[2];
            stepped.bundle.at(B::l_z, 1, 0) = l;
            kernels(Isa::scalar).spatial.run(stepped.topology.kernel(), stepped.bundle, 0, 1);
            return stepped.vector(B::l_x, 1).z - l;
        };
        const double rate = 1e-4;
        return (gain(0) - gain(rate)) / (rate * r.step_s * r.step_s);
    };
    const double c = 2 * 0.3 * std::sqrt(1e9 * 2000 / 0.64), b = 0.4;
    EXPECT_NEAR(braking(1) / (c * 0.64 * b * b), 1, 1e-3);
    EXPECT_NEAR(braking(0.25) / (c * 0.64 * b * b), 0.25 + 0.75 / 3, 1e-3);
}

TEST(SolidMechanisms, ATiePullsBackHorizontally)
{
    // one step of a body in the air: dx = dt2 / m (f - k x - c v), along z without f; l = dt (L - dt c_r omega)
    const double k = 3e5, c = 4e3, f = 700, c_r = 90;
    Realization r = block(true);
    BlockMechanisms& e = r.space.solids[1].mechanisms;
    e.tie_n_m = k, e.tie_n_s_m = c, e.tie_n = f, e.tie_n_m_s = c_r;
    Stepped stepped(r);
    const double dt = r.step_s, m = 2000, inertia = r.space.solids[1].inertia_kg_m2[1];
    const double x = 0.01, z = -0.02, v_x = 0.3, v_z = 0.2, omega = 1.5;
    for (const auto& [field, value] : {std::pair{B::x, x},
                                       {B::y, 1.0},
                                       {B::z, z},
                                       {B::dx, v_x * dt},
                                       {B::dz, v_z * dt},
                                       {B::l_y, inertia * omega * dt}})
        stepped.bundle.at(field, 1, 0) = value;
    kernels(Isa::scalar).spatial.run(stepped.topology.kernel(), stepped.bundle, 0, 1);
    const Vec d = stepped.vector(B::dx, 1), l = stepped.vector(B::l_x, 1);
    EXPECT_NEAR(d.x, v_x * dt + dt * dt / m * (f - k * x - c * v_x), 1e-18);
    EXPECT_NEAR(d.y, -dt * dt * gravity, 1e-18);
    EXPECT_NEAR(d.z, v_z * dt + dt * dt / m * (-k * z - c * v_z), 1e-18);
    EXPECT_NEAR(l.y, dt * (inertia * omega - dt * c_r * omega), 1e-16);
}

TEST(SolidMechanisms, TheEnergyBalanceHasDowelsAndTies)
{
    // a block that slides without friction against a dowel that yields, held by a tie with a dashpot
    Realization r = block(false);
    r.space.joints[0].friction = 0;
    JointMechanisms& e = r.space.joints[0].mechanisms;
    e.dowel_stiffness_n_m = 4e6;
    e.dowel_yield_n = 3000;
    e.dowel_gap_m = 1e-3;
    BlockMechanisms& tie = r.space.solids[1].mechanisms;
    tie.tie_n_m = 1e5;
    tie.tie_n_s_m = 2e3;
    tie.tie_n = 500;
    Stepped stepped(r);
    const spatial::Topology& kernel = stepped.topology.kernel();
    stepped.bundle.at(B::dx, 1, 0) = 0.25 * r.step_s;
    stepped.bundle.at(B::dz, 1, 0) = -0.15 * r.step_s;
    stepped.bundle.at(B::y, 1, 0) = -2000 * gravity / (1e9 * 0.64);
    Watch w;
    w.step_s = r.step_s;
    w.barrier_j = 1;
    const auto lacks = [&](const EnergyBalance& o) {
        return o.kinetic + o.potential + o.spring + o.friction + o.damping - o.base_work;
    };
    kernels(Isa::scalar).spatial.run(kernel, stepped.bundle, 0, 1);
    const EnergyBalance start = spatial::energy_balance(kernel, stepped.bundle, 0, w);
    double most = 0, damping = 0;
    for (int chunk = 0; chunk < 40; ++chunk) {
        stepped.run(1);
        const EnergyBalance o = spatial::energy_balance(kernel, stepped.bundle, 0, w);
        most = std::max(most, std::fabs(lacks(o) - lacks(start)));
        EXPECT_GE(o.damping - damping, -1e-3) << chunk;
        damping = o.damping;
    }
    EXPECT_GT(damping, 30);
    EXPECT_LT(most, 1e-3 * damping);
    EXPECT_GT(spatial::dowel_energy(kernel, stepped.bundle, 0), 0);
}

// ---- at rest --------------------------------------------------------------------------------------------------------

/// Three round drums of 1 m and a square capital with a beam, whose beds the test changes.
Standing column()
{
    Standing s;
    const BedLaw law{3e9, 0.7, 0, 0};
    const int ground = s.body({0, -1, 0}, 3, 3, 1, 1e4, true, true);
    const int low = s.drum({0, 0, 0}, 0.5, 1, 2000), middle = s.drum({0, 1, 0}, 0.5, 1, 2000),
              high = s.drum({0, 2, 0}, 0.5, 1, 2000);
    const int beam = s.beam({0, 3, 0}, 1.5, 0.5, 0.6, 4000);
    s.bed(ground, low, law);
    s.bed(low, middle, law);
    s.bed(middle, high, law);
    s.bed(high, beam, law);
    return s;
}

/// Largest kinetic energy in 0.05 s from rest [J].
double unrest_j(Standing& s)
{
    double most = 0;
    for (int chunk = 0; chunk < 80; ++chunk) {
        s.run(chunk_steps);
        most = std::max(most, s.kinetic_j());
    }
    return most;
}

TEST(SolidMechanisms, AColumnRestsOnItsWedges)
{
    Standing s = column();
    // what is above turns by the sum of the wedges below it, in two directions; the last is under the beam
    const double about_x[] = {0, 0.002, 0, -0.0015}, about_z[] = {0.003, 0, -0.004, 0.001};
    for (std::size_t j = 0; j < 4; ++j) {
        s.r.space.joints[j].mechanisms.wedge_x_rad = about_x[j];
        s.r.space.joints[j].mechanisms.wedge_rad = about_z[j];
    }
    s.settle();
    double x = 0, z = 0;
    for (int i = 1; i <= 4; ++i) {
        x += about_x[i - 1];
        z += about_z[i - 1];
        // the weight beside the middle of a bed turns it by some 1e-5
        EXPECT_NEAR(s.turn(i).x, x, 1e-4) << i;
        EXPECT_NEAR(s.turn(i).z, z, 1e-4) << i;
        EXPECT_NEAR(s.turn(i).y, 0, 1e-4) << i;
    }
    EXPECT_LT(unrest_j(s), 1e-9);
}

TEST(SolidMechanisms, DowelsShareTheShearOfATiltedBase)
{
    // shear of the weight above: the springs K_t and k_d have it together
    const double slope = 0.02, k_d = 1e9;
    Standing s = column();
    s.r.space.base_tilt_rad = {0.6 * slope, 0.8 * slope};
    JointMechanisms& dowel = s.r.space.joints[1].mechanisms;
    dowel.dowel_stiffness_n_m = k_d;
    dowel.dowel_yield_n = 1e9;
    s.settle();
    const double K_t = s.r.space.joints[1].tangential_stiffness_n_m;
    const double shear = 8000 * Standing::g * std::sqrt(1 - std::pow(std::cos(0.6 * slope) * std::cos(0.8 * slope), 2));
    const double spring = std::hypot(s.at(spatial::OfJoint::spring_1, 1), s.at(spatial::OfJoint::spring_2, 1));
    EXPECT_NEAR(spring, shear * K_t / (K_t + k_d), 0.02 * shear);
    EXPECT_LT(unrest_j(s), 1e-9);
    const double force = std::hypot(
        s.bundle().at(spatial::OfJointMechanisms::dowel_force, 1, 0),
        s.bundle().at(static_cast<spatial::OfJointMechanisms::Field>(spatial::OfJointMechanisms::dowel_force + 1), 1,
                      0));
    EXPECT_NEAR(force, shear - spring, 0.01 * shear);
}

TEST(SolidMechanisms, FrictionThatChangesWithTheSlipHoldsAtRest)
{
    Standing s = column();
    s.r.space.base_tilt_rad = {0.1, 0.05};
    for (SolidJoint& joint : s.r.space.joints) {
        joint.mechanisms.dynamic_ratio = 0.01;
        joint.mechanisms.stribeck_velocity_m_s = 1e-6;
        joint.mechanisms.wear_per_m = 1e4;
        joint.mechanisms.adhesion_pa = 1e3;
    }
    s.settle();
    EXPECT_LT(unrest_j(s), 1e-9);
    EXPECT_EQ(s.at(spatial::OfRealization::slip), 0);
    EXPECT_EQ(s.bundle().at(spatial::OfJointMechanisms::broken, 0, 0), 0);
}

} // namespace
} // namespace stylobate
