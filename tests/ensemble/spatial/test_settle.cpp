// Rest of structures in space, against statics by hand.

#include "ensemble/model/input_error.hpp"
#include "ensemble/spatial/structure/spatial_scales.hpp"
#include "tests/ensemble/spatial/standing.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace stylobate {
namespace {

using B = spatial::OfBody;
using J = spatial::OfJoint;
using Vec = Standing::Vec;

/// The column of the laboratory: six drums of 24 mm radius and 29 mm height on a fixed one.
struct Small {
    static constexpr double radius = 0.024, height = 0.029, k = 1e8 / 0.048;
    static constexpr double mass = 0.1355 * std::numbers::pi / 4;
};

/// @param offset of free drum i = 0 .. 5, from the axis
Standing small_column(bool round, const std::function<Vec(int)>& offset = {}, double k = Small::k)
{
    Standing s;
    const double R = Small::radius, H = Small::height;
    int below = s.body({0, -H, 0}, R, R, H, Small::mass, round, true);
    for (int i = 0; i < 6; ++i) {
        const Vec at = offset ? offset(i) : Vec{0, 0, 0};
        const int above = s.body({at.x, i * H, at.z}, R, R, H, Small::mass, round);
        s.bed(below, above, {k, 0.7, 0.1, Small::mass});
        below = above;
    }
    const double area = round ? std::numbers::pi * R * R : 4 * R * R;
    s.r.step_s = 0.15 / std::sqrt(k * area / Small::mass);
    return s;
}

/// Columns 3 m apart, of three drums and a square abacus, with beams from axis to axis.
struct Colonnade {
    static constexpr double g = Standing::g, drum_kg = 2500 * std::numbers::pi * 0.16, abacus_kg = 750;
    static constexpr double beam_kg = 2500 * 3 * 0.9 * 0.7;

    Standing s;
    std::vector<int> foot, top, beams, butts; // joints, bodies, bodies, joints
    std::vector<std::array<int, 2>> seats;    // joints
    double weight = 0;

    explicit Colonnade(int columns)
    {
        s.r.step_s = 1e-5;
        const BedLaw law{3e9, 0.7, 0.1, 1000};
        for (int c = 0; c < columns; ++c) {
            const double x = 3.0 * c;
            int below = s.drum({x, -0.5, 0}, 0.4, 0.5, 1000, true);
            s.solid(below).column = c;
            for (int i = 0; i < 3; ++i) {
                const int above = s.drum({x, 1.0 * i, 0}, 0.4, 1, drum_kg);
                s.solid(above).column = c;
                const int joint = s.bed(below, above, law);
                if (i == 0)
                    foot.push_back(joint);
                below = above;
            }
            const int abacus = s.body({x, 3, 0}, 0.5, 0.5, 0.3, abacus_kg, false);
            s.solid(abacus).column = c;
            s.solid(abacus).bottom = {true, 0.5, 0.5};
            s.bed(below, abacus, law);
            top.push_back(abacus);
            weight += g * (3 * drum_kg + abacus_kg);
        }
        for (std::size_t c = 0; c + 1 < top.size(); ++c) {
            beams.push_back(s.beam({1.5 + 3.0 * static_cast<double>(c), 3.3, 0}, 1.5, 0.45, 0.7, beam_kg));
            seats.push_back({s.bed(top[c], beams[c], law), s.bed(top[c + 1], beams[c], law)});
            weight += g * beam_kg;
        }
        for (std::size_t c = 0; c + 1 < beams.size(); ++c)
            butts.push_back(s.butt(beams[c], beams[c + 1], law));
    }
    Vec force(int joint)
    {
        return {s.at(J::force, joint), s.at(static_cast<J::Field>(J::force + 1), joint),
                s.at(static_cast<J::Field>(J::force + 2), joint)};
    }
};

std::string refusal(Standing& s)
{
    try {
        s.settle();
    } catch (const InputError& error) {
        return error.what();
    }
    return "stands";
}

double length(const Vec& v)
{
    return std::sqrt(dot(v, v));
}

} // namespace

TEST(SpatialSettle, EachBedSinksUnderTheWeightAboveIt)
{
    for (const bool round : {true, false}) {
        Standing s = small_column(round);
        s.settle();
        const double area = (round ? std::numbers::pi : 4) * Small::radius * Small::radius;
        double y = 0;
        for (int i = 1; i <= 6; ++i) {
            y -= (7 - i) * Small::mass * Standing::g / (Small::k * area);
            EXPECT_NEAR(s.u(i).y / y, 1, 1e-14);
            EXPECT_EQ(s.u(i).x, 0);
            EXPECT_EQ(s.u(i).z, 0);
            EXPECT_EQ(s.q(i).w, 1);
        }
        if (round) {
            EXPECT_NEAR(-s.u(1).y, 1.66156875e-6, 1e-19); // 2 x 0.1355 x 6 x 9.81 / 4 / 2.4e6, by hand
        }
        s.run(1);
        for (int j = 0; j < 6; ++j)
            EXPECT_NEAR(s.at(J::normal, j) / ((6 - j) * Small::mass * Standing::g), 1, 1e-13);
    }
}

TEST(SpatialSettle, AHollowBedSinksByItsRing)
{
    for (const bool round : {true, false}) {
        Standing s = small_column(round);
        const double ratio = 0.8, bearing = 1 - ratio * ratio;
        for (SolidJoint& joint : s.r.space.joints)
            joint.inner_ratio = ratio;
        s.settle();
        const double area = bearing * (round ? std::numbers::pi : 4) * Small::radius * Small::radius;
        double y = 0;
        for (int i = 1; i <= 6; ++i) {
            y -= (7 - i) * Small::mass * Standing::g / (Small::k * area);
            EXPECT_NEAR(s.u(i).y / y, 1, 1e-13);
        }
    }
}

TEST(SpatialSettle, StaysAtRest)
{
    const auto offset = [](int i) { return Vec{0.003 * std::sin(2.0 * i), 0, 0.002 * std::cos(3.0 * i)}; };
    for (const bool round : {true, false})
        for (const auto& of : {std::function<Vec(int)>(), std::function<Vec(int)>(offset)}) {
            Standing s = small_column(round, of);
            s.settle();
            const Vec start = s.u(6);
            const double barrier = spatial_scales(s.r).barrier_j;
            for (int checks = 0; checks < 20; ++checks) {
                s.run(500);
                EXPECT_LT(s.kinetic_j(), 1e-20 * barrier);
            }
            EXPECT_LT(length(s.u(6) - start), 1e-15);
        }
}

// Of two square drums the upper one lies beside the axis: the beds tilt by the moment over k I of the common face.
TEST(SpatialSettle, SquaresTiltByTheMomentOfTheirOffset)
{
    const double a = 0.5, mass = 2500, k = 3e10, e = 0.1;
    for (const bool along_z : {false, true}) {
        Standing s;
        const int base = s.body({0, -1, 0}, a, a, 1, mass, false, true), low = s.body({0, 0, 0}, a, a, 1, mass, false),
                  high = s.body(along_z ? Vec{0, 1, e} : Vec{e, 1, 0}, a, a, 1, mass, false);
        s.bed(base, low, {k});
        s.bed(low, high, {k});
        s.settle();
        const double weight = mass * Standing::g, width = 2 * a - e;
        const double below = 2 * weight * (e / 2) / (k * std::pow(2 * a, 4) / 12),
                     above = weight * (e / 2) / (k * 2 * a * std::pow(width, 3) / 12);
        const auto lean = [&](int i) { return along_z ? s.turn(i).x : -s.turn(i).z; };
        EXPECT_NEAR(lean(low) / below, 1, 1e-4);
        EXPECT_NEAR((lean(high) - lean(low)) / above, 1, 1e-4);
        // the middle of the common face sinks by the mean pressure over k
        const Vec seen = s.point(high, along_z ? Vec{0, -0.5, -e / 2} : Vec{-e / 2, -0.5, 0}),
                  under = s.point(low, along_z ? Vec{0, 0.5, e / 2} : Vec{e / 2, 0.5, 0});
        EXPECT_NEAR((under.y - seen.y) / (weight / (k * 2 * a * width)), 1, 1e-4);
    }
}

// Whatever stands on a bed is in equilibrium: the bed's force on it is its weight, and has no moment about its centre
// of mass. (A sum over the bodies, which no formula of the beds enters.)
TEST(SpatialSettle, EachPartOfAColumnIsInEquilibrium)
{
    for (const bool round : {true, false}) {
        Standing s = small_column(round, [](int i) { return Vec{0.004 * std::sin(2.0 * i), 0, 0.003 * std::cos(i)}; });
        s.r.space.base_tilt_rad = {0.01, 0.02};
        s.settle();
        s.run(1);
        const double sine_z = std::sin(0.01), sine_x = std::sin(0.02), cosine_z = std::cos(0.01),
                     cosine_x = std::cos(0.02);
        const Vec down{sine_z * cosine_x, -cosine_z * cosine_x, sine_x};
        for (int j = 0; j < 6; ++j) {
            double mass = 0;
            Vec moment{0, 0, 0};
            for (int i = j + 1; i <= 6; ++i) {
                mass += Small::mass;
                moment = moment + Small::mass * s.point(i, {0, 0, 0});
            }
            const auto field = [&](J::Field first) {
                return Vec{s.at(first, j), s.at(static_cast<J::Field>(first + 1), j),
                           s.at(static_cast<J::Field>(first + 2), j)};
            };
            const Vec force = field(J::force), weight = mass * Standing::g * down;
            EXPECT_LT(length(force + weight), 1e-9 * length(weight));
            const Vec from = s.point(j + 1, {0, 0, 0}) - 1 / mass * moment;
            const Vec about = field(J::upper_moment) + cross(from, force);
            EXPECT_LT(length(about), 1e-9 * length(weight) * Small::radius);
            // friction carries the slope, within its cone
            EXPECT_NEAR(std::hypot(s.at(J::spring_1, j), s.at(J::spring_2, j)) / length(weight),
                        std::hypot(down.x, down.z), 2e-3);
        }
    }
}

TEST(SpatialSettle, WhatCannotStandIsNamed)
{
    Standing overhanging = small_column(true, [](int i) { return Vec{i >= 2 ? 0.0275 : 0, 0, 0}; });
    EXPECT_NE(refusal(overhanging).find("the weight of drum 4 and of what it carries passes 0.0035 m outside"),
              std::string::npos)
        << refusal(overhanging);
    Standing sliding = small_column(true);
    for (SolidJoint& joint : sliding.r.space.joints)
        joint.friction = 0.01;
    sliding.r.space.base_tilt_rad = {0.02, 0};
    EXPECT_NE(refusal(sliding).find("drum 2 slides on a base that is tilted by 0.02 rad"), std::string::npos)
        << refusal(sliding);
    Standing soft = small_column(true, {}, Small::k / 2e4);
    EXPECT_NE(refusal(soft).find("the bed of drum 2 is too soft"), std::string::npos) << refusal(soft);
    Standing steep = small_column(false);
    steep.r.space.base_tilt_rad = {0, 0.3}; // 3 H tan 0.3 = 0.027 > 0.024
    EXPECT_NE(refusal(steep).find("drum 2"), std::string::npos) << refusal(steep);
}

// Just inside of what can stand. (The rim of a disc is softer than the edge of a square: its column cannot lean as
// far.)
TEST(SpatialSettle, StandsNearItsLimits)
{
    for (const bool round : {true, false}) {
        Standing steep = small_column(round);
        steep.r.space.base_tilt_rad = {(round ? 0.8 : 0.9) * std::atan(Small::radius / (3 * Small::height)), 0};
        EXPECT_EQ(refusal(steep), "stands");
        Standing slippery = small_column(round);
        for (SolidJoint& joint : slippery.r.space.joints)
            joint.friction = 0.05;
        slippery.r.space.base_tilt_rad = {std::atan(0.99 * 0.05), 0};
        EXPECT_EQ(refusal(slippery), "stands");
    }
}

TEST(SpatialSettle, PortalBaseCarriesTheWeight)
{
    Colonnade c(2);
    c.s.settle();
    c.s.run(1);
    EXPECT_NEAR((c.force(c.foot[0]).y + c.force(c.foot[1]).y) / c.weight, 1, 1e-6);
    // by symmetry each seat carries half of the beam
    for (const int seat : c.seats[0])
        EXPECT_NEAR(c.force(seat).y / (Colonnade::g * Colonnade::beam_kg / 2), 1, 1e-6);
    EXPECT_NEAR(c.force(c.seats[0][0]).x, -c.force(c.seats[0][1]).x, 1e-6 * c.weight);
}

// Beams whose outer seats give way turn, and their inner ends press on each other.
TEST(SpatialSettle, ButtedBeamsPressOnEachOther)
{
    Colonnade c(3);
    c.s.settle();
    c.s.run(1);
    double base = 0;
    for (const int foot : c.foot)
        base += c.force(foot).y;
    EXPECT_NEAR(base / c.weight, 1, 1e-6);
    const double beam = Colonnade::g * Colonnade::beam_kg;
    const Vec butt = c.force(c.butts[0]), outer = c.force(c.seats[0][0]), inner = c.force(c.seats[0][1]);
    EXPECT_GT(butt.x, 0.01 * beam);
    EXPECT_NEAR(outer.x + inner.x, butt.x, 1e-5 * beam); // along x: its seats hold it against the other beam
    EXPECT_NEAR(outer.y + inner.y - butt.y, beam, 1e-5 * beam);
    EXPECT_NEAR(outer.z + inner.z - butt.z, 0, 1e-5 * beam);
    EXPECT_NEAR(c.force(c.seats[1][1]).y, outer.y, 1e-4 * beam); // the other beam is its mirror image
}

// Two boxes on frictionless ground with a gap between them: one that is pushed comes to the other one through it.
TEST(SpatialSettle, AButtJointActsOnceItsGapHasClosed)
{
    const double gap = 0.002, half = 0.5;
    Standing s;
    const int ground = s.body({0, -1, 0}, 5, 5, 1, 1000, false, true),
              left = s.body({-half, 0, 0}, half, half, 1, 1000, false),
              right = s.body({half + gap, 0, 0}, half, half, 1, 1000, false);
    for (const int box : {left, right})
        s.bed(ground, box, {3e9});
    const int butt = s.butt(left, right, {3e9});
    s.r.space.joints[static_cast<std::size_t>(butt)].gap_m = gap;
    s.settle();
    const double y = s.u(right).y;
    const auto force_at = [&](double closed) {
        for (const int box : {left, right})
            s.at(B::y, box) = y;
        s.at(B::x, right) = -closed;
        s.run(1);
        return s.at(J::normal, butt);
    };
    EXPECT_EQ(force_at(0), 0);
    EXPECT_EQ(force_at(0.999 * gap), 0);
    EXPECT_NEAR(force_at(gap + 1e-6) / (3e9 * 1e-6), 1, 1e-3);
}

TEST(SpatialSettle, LeansAboutTheRimOfItsBlock)
{
    const double tilt = 0.04, direction = 0.7;
    Standing upright = small_column(true), leaning = small_column(true);
    leaning.r.space.initial_tilt_rad = tilt;
    leaning.r.space.initial_tilt_direction_rad = direction;
    leaning.r.space.initial_tilt_block = 3; // the fixed one is block 0
    upright.settle();
    leaning.settle();
    for (const int i : {1, 2}) // below it nothing has changed
        EXPECT_EQ(length(leaning.u(i) - upright.u(i)), 0);
    const Vec rim{Small::radius * std::cos(direction), -Small::height / 2, Small::radius * std::sin(direction)};
    const Vec moved = leaning.point(3, rim) - upright.point(3, rim);
    EXPECT_NEAR(moved.x, 0, 1e-15);
    EXPECT_NEAR(moved.z, 0, 1e-15);
    EXPECT_LT(moved.y, 0); // less of the face carries the same
    EXPECT_GT(moved.y, -1e-3);
    for (int i = 3; i <= 6; ++i) {
        const Vec axis = rotated(spatial::minus_identity(leaning.q(i)), Vec{0, 1, 0});
        EXPECT_NEAR(std::atan2(std::hypot(axis.x, axis.z), axis.y), tilt, 1e-12);
        EXPECT_NEAR(std::atan2(axis.z, axis.x), direction, 1e-12);
    }
    leaning.run(1);
    EXPECT_NEAR(leaning.at(J::normal, 2) / (4 * Small::mass * Standing::g), 1, 1e-9);
}

TEST(SpatialSettle, APrismLeansAboutItsEdge)
{
    Standing upright = small_column(false), leaning = small_column(false);
    leaning.r.space.initial_tilt_rad = -0.02; // towards -z
    leaning.r.space.initial_tilt_direction_rad = std::numbers::pi / 2;
    upright.settle();
    leaning.settle();
    for (const double side : {-1.0, 1.0}) {
        const Vec corner{side * Small::radius, -Small::height / 2, -Small::radius};
        const Vec moved = leaning.point(1, corner) - upright.point(1, corner);
        EXPECT_NEAR(std::hypot(moved.x, moved.z), 0, 1e-15);
    }
    EXPECT_NEAR(leaning.turn(1).x, -0.02, 1e-6);
}

// Columns that lean across carry their beams with them, level, on the edges that rise.
TEST(SpatialSettle, BeamsFollowLeaningColumns)
{
    const double tilt = 0.01;
    Colonnade upright(3), leaning(3);
    leaning.s.r.space.initial_tilt_rad = tilt;
    leaning.s.r.space.initial_tilt_direction_rad = std::numbers::pi / 2;
    leaning.s.r.space.initial_tilt_block = 1;
    upright.s.settle();
    leaning.s.settle();
    for (const int beam : leaning.beams) {
        const Vec moved = leaning.s.u(beam) - upright.s.u(beam);
        // with the edge of the abacus at the back, seen from the foot's rim in front
        EXPECT_NEAR(moved.z, std::sin(tilt) * 3.3 + (1 - std::cos(tilt)) * (0.4 + 0.5), 5e-6);
        // onto the abacus at the beam's own edge, less what the rims sink in
        EXPECT_LT(moved.y, std::sin(tilt) * (0.4 + 0.45));
        EXPECT_GT(moved.y, std::sin(tilt) * (0.4 + 0.45) - 3e-3);
        EXPECT_EQ(leaning.s.q(beam).x, upright.s.q(beam).x);
    }
    leaning.s.run(1);
    upright.s.run(1);
    for (std::size_t b = 0; b < leaning.seats.size(); ++b) {
        const auto carried = [&](Colonnade& of) {
            return of.s.at(J::normal, of.seats[b][0]) + of.s.at(J::normal, of.seats[b][1]);
        };
        EXPECT_NEAR(carried(leaning) / carried(upright), 1, 1e-6);
    }
}

} // namespace stylobate
