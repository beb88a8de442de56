// The bed of a polygon on a rectangle: its load against differences of its energy, its integrals against strips, and
// faces that are flush up to rounding.

#include "kernels/spatial/disc_bed.hpp"
#include "kernels/spatial/polygon_bed.hpp"

#include "tests/kernels/spatial/long_real.hpp"
#include "tests/kernels/spatial/polygon_reference.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace stylobate::spatial {
namespace {

struct Range {
    double least, most;
};

/// A kind of pose. The faces are about 2 m wide.
struct Situation {
    const char* name;
    double half_x, half_y; ///< of the lower face [m]
    Range offset_x, offset_y;
    Range tilt, azimuth, twist;
    Range depth_per_tilt; ///< of the deepest point [m]
};

constexpr double quarter = std::numbers::pi / 2, eighth = quarter / 2;
const Situation situations[] = {
    {"whole face", 1.6, 1.5, {-0.1, 0.1}, {-0.1, 0.1}, {1e-6, 1e-3}, {0, 6.3}, {-0.1, 0.1}, {3, 5}},
    {"lifted edge", 1.6, 1.5, {-0.1, 0.1}, {-0.1, 0.1}, {1e-4, 0.1}, {-0.02, 0.02}, {-0.01, 0.01}, {0.1, 1.5}},
    {"lifted edge, across", 1.6, 1.5, {-0.1, 0.1}, {-0.1, 0.1}, {1e-4, 0.1}, {-1.59, -1.55}, {0, 0}, {0.1, 1.5}},
    {"corner", 1.6, 1.5, {-0.1, 0.1}, {-0.1, 0.1}, {1e-4, 0.3}, {0.4, 1.2}, {-0.1, 0.1}, {0.01, 0.3}},
    {"over an edge", 1.0, 1.5, {0.3, 1.2}, {-0.1, 0.1}, {1e-5, 0.1}, {0, 6.3}, {-0.2, 0.2}, {0.1, 4}},
    {"over a corner", 1.0, 0.9, {0.3, 0.9}, {-0.9, -0.3}, {1e-5, 0.1}, {0, 6.3}, {-0.2, 0.2}, {0.1, 4}},
    {"turned by 45 degrees", 1.0, 0.9, {-0.1, 0.1}, {-0.1, 0.1}, {1e-5, 0.1}, {0, 6.3}, {eighth, eighth}, {0.1, 4}},
    {"any turn", 1.0, 0.9, {-0.7, 0.7}, {-0.7, 0.7}, {1e-4, 0.3}, {0, 6.3}, {-3, 3}, {0.1, 2}},
    {"smaller lower face", 0.4, 0.3, {-0.3, 0.3}, {-0.3, 0.3}, {1e-5, 0.1}, {0, 6.3}, {-3, 3}, {0.05, 2}},
    {"nearly flush", 1.0, 0.8, {-1e-6, 1e-6}, {-1e-6, 1e-6}, {1e-6, 1e-3}, {0, 6.3}, {-1e-6, 1e-6}, {0.1, 4}},
    {"steep", 1.1, 1.2, {-0.3, 0.3}, {-0.3, 0.3}, {0.4, 0.8}, {0, 6.3}, {-1, 1}, {0.01, 0.5}},
};

class Random {
public:
    double in(const Range& r) { return r.least + (r.most - r.least) * unit_(generator_); }

private:
    std::mt19937_64 generator_{20260715};
    std::uniform_real_distribution<double> unit_{0, 1};
};

template <class Real, int corners>
Polygon<Real, corners> polygon(const Scene& s)
{
    Polygon<Real, corners> p;
    for (int i = 0; i < corners; ++i)
        p.x[i] = s.x[static_cast<std::size_t>(i)], p.y[i] = s.y[static_cast<std::size_t>(i)];
    return p;
}

template <int corners>
Scene scene(const Situation& a, Random& random)
{
    Scene s;
    // centres beside the anchors, so that no moment vanishes by symmetry
    const double upper_x = 0.07, upper_y = -0.04, lower_x = -0.02, lower_y = 0.05;
    const auto fill = [&](const auto& p) {
        s.x.assign(p.x, p.x + corners);
        s.y.assign(p.y, p.y + corners);
    };
    if constexpr (corners == 4)
        fill(polygon_of(Rectangle<double>{upper_x, upper_y, 1.0, 0.8}));
    else
        fill(sixteen_corners(upper_x, upper_y, 1.0));
    s.lower = {lower_x, lower_y, a.half_x, a.half_y};
    s.offset_x = lower_x - upper_x + random.in(a.offset_x);
    s.offset_y = lower_y - upper_y + random.in(a.offset_y);
    s.tilt = a.tilt.least * std::pow(a.tilt.most / a.tilt.least, random.in({0, 1}));
    s.azimuth = random.in(a.azimuth), s.twist = random.in(a.twist);
    s.depth = s.tilt * random.in(a.depth_per_tilt);
    return s;
}

template <class Real, int corners>
BedLoad<Real> load_of(const Scene& s, const Quaternion<Real>& q, const Vector<Real>& place)
{
    const Rectangle<Real> lower{s.lower.centre_x, s.lower.centre_y, s.lower.half_x, s.lower.half_y};
    return polygon_bed(BedPose<Real>{minus_identity(q), place},
                       PolygonBed<Real, corners>{Real(1.0), polygon<Real, corners>(s), lower});
}

Vector<LongReal> along(int axis, long double size)
{
    return {axis == 0 ? size : 0, axis == 1 ? size : 0, axis == 2 ? size : 0};
}

/// Minus the derivatives of the energy with respect to displacement and rotation about P of the upper body.
template <int corners>
std::array<double, 6> differences(const Scene& s, const Quaternion<LongReal>& q, const Vector<LongReal>& place,
                                  long double h)
{
    std::array<double, 6> minus;
    for (int i = 0; i < 6; ++i) {
        const auto energy = [&](long double size) {
            const Vector<LongReal> step = along(i % 3, size);
            if (i < 3)
                return load_of<LongReal, corners>(s, q, place + step).energy.v;
            return load_of<LongReal, corners>(s, product(rotation_by<LongReal>(step.x.v, step.y.v, step.z.v), q), place)
                .energy.v;
        };
        minus[static_cast<std::size_t>(i)] = static_cast<double>((energy(-h) - energy(h)) / (2 * h));
    }
    return minus;
}

template <int corners>
void expect_gradient(const Situation& a)
{
    Random random;
    int used = 0;
    for (int n = 0; n < 400; ++n) {
        const Scene s = scene<corners>(a, random);
        const Placed p = placed(s);
        if (p.sides.empty())
            continue;
        const Quaternion<LongReal> q{p.q.w, p.q.x, p.q.y, p.q.z};
        const Vector<LongReal> place{p.place.x, p.place.y, p.place.z};
        const BedLoad<LongReal> load = load_of<LongReal, corners>(s, q, place);
        const double N = static_cast<double>(load.force);
        if (!(N > 0))
            continue;
        ++used;
        const auto minus = differences<corners>(s, q, place, 1e-6L * s.depth);
        const LongReal given[6] = {load.lateral_x, load.lateral_y, load.force,
                                   load.torque.x,  load.torque.y,  load.torque.z};
        for (int i = 0; i < 6; ++i)
            ASSERT_NEAR(static_cast<double>(given[i]), minus[static_cast<std::size_t>(i)], 1e-8 * N)
                << a.name << ", pose " << n << ", freedom " << i;
    }
    EXPECT_GT(used, 300) << a.name;
}

TEST(PolygonBed, LoadOfRectangleIsTheGradientOfItsEnergy)
{
    for (const Situation& a : situations)
        expect_gradient<4>(a);
}

TEST(PolygonBed, LoadOfSixteenCornersIsTheGradientOfItsEnergy)
{
    for (const Situation& a : situations)
        expect_gradient<16>(a);
}

template <int corners>
void expect_integrals(const Situation& a)
{
    Random random;
    for (int n = 0; n < 20; ++n) {
        const Scene s = scene<corners>(a, random);
        const Placed p = placed(s);
        if (p.sides.empty())
            continue;
        const PatchSums want = patch_sums(s, p, 16000);
        const BedLoad<double> load = load_of<double, corners>(s, p.q, p.place);
        const std::string where = std::string(a.name) + ", pose " + std::to_string(n);
        // corners of the patch within a strip: 1e-7 of the sum
        const double of_area = 1e-6 * want.area, of_force = 1e-6 * want.pressure;
        EXPECT_NEAR(load.area, want.area, of_area) << where;
        EXPECT_NEAR(load.first_x, want.x, of_area) << where;
        EXPECT_NEAR(load.first_y, want.y, of_area) << where;
        EXPECT_NEAR(load.second_xx, want.xx, of_area) << where;
        EXPECT_NEAR(load.second_xy, want.xy, of_area) << where;
        EXPECT_NEAR(load.second_yy, want.yy, of_area) << where;
        EXPECT_NEAR(load.force, want.pressure, of_force) << where;
        EXPECT_NEAR(load.moment_x, want.moment_x, of_force) << where;
        EXPECT_NEAR(load.moment_y, want.moment_y, of_force) << where;
        EXPECT_NEAR(load.energy, want.energy, 1e-6 * want.energy) << where;
        const double x = want.moment_x / want.pressure, y = want.moment_y / want.pressure;
        const double gyration = std::sqrt(want.polar / want.pressure - x * x - y * y);
        EXPECT_NEAR(load.friction_radius, 0.92 * gyration, 1e-5 * gyration + 1e-9) << where;
    }
}

TEST(PolygonBed, IntegralsAreThoseOfStrips)
{
    for (const Situation& a : situations) {
        expect_integrals<4>(a);
        expect_integrals<16>(a);
    }
}

BedLoad<double> rectangle_bed(const BedPose<double>& pose, double stiffness, const Rectangle<double>& upper,
                              const Rectangle<double>& lower)
{
    return polygon_bed(pose, PolygonBed<double, 4>{stiffness, polygon_of(upper), lower});
}

/// Faces of which all or some edges lie above each other, displaced by `apart`, tilted about x or y by an angle whose
/// square is below rounding. The patch is a rectangle that is known.
struct Flush {
    Rectangle<double> upper, lower;
    double tilt_x, tilt_y; ///< slopes of the depth
    double apart;          ///< [m], along x
    double turn;           ///< about the normal, of the size of rounding
};

BedLoad<double> load_of(const Flush& f)
{
    // the upper face's centre comes above the lower one's, by numbers that round
    const double x = f.lower.centre_x - f.upper.centre_x + f.apart, y = f.lower.centre_y - f.upper.centre_y;
    const double depth = 1e-6 - f.tilt_x * f.upper.centre_x - f.tilt_y * f.upper.centre_y;
    const Matrix<double> turn{0, -f.turn, 0, f.turn, 0, 0, -f.tilt_x, -f.tilt_y, 0};
    return rectangle_bed({turn, {x, y, -depth}}, 2.0, f.upper, f.lower);
}

TEST(PolygonBed, FlushEdgesCountOnce)
{
    Random random;
    for (int n = 0; n < 20000; ++n) {
        const Range any{-3, 3}, size{0.3, 0.9};
        Flush f{{random.in(any), random.in(any), random.in(size), random.in(size)}, {}, 0, 0, 0, 0};
        f.lower = {random.in(any), random.in(any), f.upper.half_x, f.upper.half_y};
        if (n % 3 == 1)
            f.lower.half_y *= 1.3;
        if (n % 3 == 2)
            f.lower.half_x *= 0.6;
        const double sizes[] = {0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-9};
        f.apart = (n % 2 ? 1 : -1) * sizes[n % 6];
        f.turn = n % 5 ? 0 : random.in({-1e-16, 1e-16});
        f.tilt_x = n % 4 == 1 ? random.in({-1e-6, 1e-6}) : 0, f.tilt_y = n % 4 == 2 ? random.in({-1e-6, 1e-6}) : 0;
        const BedLoad<double> load = load_of(f);
        const double half_x = std::min(f.upper.half_x, f.lower.half_x);
        const double area = 4 * half_x * std::min(f.upper.half_y, f.lower.half_y);
        // the depth changes linearly from 1e-6 m at the centre and is positive nowhere less than 1e-7 m
        ASSERT_NEAR(load.area, area, 1e-14 + 3 * std::abs(f.apart)) << n;
        ASSERT_NEAR(load.force, 2e-6 * area, 2e-6 * (1e-13 + 4 * std::abs(f.apart))) << n;
        ASSERT_NEAR(load.moment_x - load.force * f.upper.centre_x, 2 * f.tilt_x * area * half_x * half_x / 3,
                    2e-6 * (1e-13 + 4 * std::abs(f.apart)))
            << n;
    }
}

TEST(PolygonBed, SixteenCornersOnAFlushRectangle)
{
    // four of the edges lie above the rectangle's sides; they are of the length of the others
    const double radius = 0.7, apothem = radius * std::cos(std::numbers::pi / 16);
    const double area = 8 * radius * radius * std::sin(std::numbers::pi / 8);
    Random random;
    for (int n = 0; n < 5000; ++n) {
        const double ux = random.in({-3, 3}), uy = random.in({-3, 3}), lx = random.in({-3, 3}), ly = random.in({-3, 3});
        const double turn = random.in({-1e-16, 1e-16}), apart = n % 2 ? 0 : random.in({-1e-15, 1e-15});
        const BedPose<double> pose{{0, -turn, 0, turn, 0, 0, 0, 0, 0}, {lx - ux + apart, ly - uy, -1e-5}};
        const BedLoad<double> load =
            polygon_bed(pose, PolygonBed<double, 16>{1.0, sixteen_corners(ux, uy, radius), {lx, ly, apothem, apothem}});
        ASSERT_NEAR(load.area, area, 3e-14) << n;
        ASSERT_NEAR(load.force, 1e-5 * area, 3e-19) << n;
    }
}

TEST(PolygonBed, PassesFlushWithoutAJump)
{
    // a face of 1 m by 0.8 m that moves off its equal: the area falls by 0.8 m2 per metre from the first step on
    const Rectangle<double> face{0.1, -0.2, 0.5, 0.4};
    for (const double turn : {0.0, 1e-12, -1e-12, 1e-9}) {
        double before = 0;
        for (int n = -200; n <= 200; ++n) {
            const double apart = n * 1e-12;
            const BedPose<double> pose{{0, -turn, 0, turn, 0, 0, -1e-6, -5e-7, 0}, {apart, 0, -2e-6}};
            const BedLoad<double> load = rectangle_bed(pose, 1.0, face, face);
            EXPECT_NEAR(load.area, 0.8 * (1 - std::abs(apart)), 2 * std::abs(turn) + 1e-15) << n;
            if (n > -200) {
                // no more than k d^2 / 2 of the deepest corner over the side, 2.7e-6 m
                EXPECT_NEAR(load.energy, before, 0.5 * 2.7e-6 * 2.7e-6 * 0.8 * 1e-12) << n;
            }
            before = load.energy;
        }
    }
}

TEST(PolygonBed, FlushLoadLiesBetweenTheTwoGradients)
{
    // At the bend of the energy the lateral force may be that of either side; the other freedoms have one derivative.
    const Rectangle<double> face{0, 0, 0.5, 0.4};
    const Scene s{{-0.5, 0.5, 0.5, -0.5}, {-0.4, -0.4, 0.4, 0.4}, face, 0, 0, 0, 0, 0, 0};
    const double d = 1e-5;
    const Quaternion<LongReal> q = no_rotation<LongReal>();
    const Vector<LongReal> place{0.0L, 0.0L, -static_cast<long double>(d)};
    const BedLoad<double> load = load_of<double, 4>(s, no_rotation<double>(), {0, 0, -d});
    const auto minus = differences<4>(s, q, place, 1e-12L);
    EXPECT_NEAR(load.force, minus[2], 1e-9 * load.force);
    EXPECT_NEAR(load.torque.x, minus[3], 1e-9 * load.force);
    EXPECT_NEAR(load.torque.y, minus[4], 1e-9 * load.force);
    // k d^2 / 2 over the length of the sides
    EXPECT_LE(std::abs(load.lateral_x), 0.5 * d * d * 0.8 * (1 + 1e-12));
    EXPECT_LE(std::abs(load.lateral_y), 0.5 * d * d * 1.0 * (1 + 1e-12));
}

TEST(PolygonBed, ForceOfASideByHand)
{
    // Half of the face hangs over the side x = 0.5 m, level, 2e-3 m deep: k d^2 / 2 over the 0.8 m of the side, at the
    // height of the face, in the middle of the side
    const Rectangle<double> face{0, 0, 0.5, 0.4};
    const BedLoad<double> load = rectangle_bed({{}, {0.5, 0.1, -2e-3}}, 1e3, face, face);
    EXPECT_NEAR(load.area, 0.5 * 0.7, 1e-15);
    EXPECT_NEAR(load.force, 2.0 * 0.35, 1e-14);
    EXPECT_NEAR(load.energy, 1e3 * 4e-6 / 2 * 0.35, 1e-17);
    EXPECT_NEAR(load.lateral_x, 2e-3 * 0.7, 1e-17);
    EXPECT_NEAR(load.lateral_y, 2e-3 * 0.5, 1e-17);
    // the corner of the lower face is (0, 0.3) from P; sides reach from there to x = -0.5, y = -0.4
    EXPECT_NEAR(load.torque.z, 2e-3 * 0.7 * 0.05 * -1 * -1 + 2e-3 * 0.5 * -0.25, 1e-16);
    EXPECT_NEAR(load.torque.x, 0.7 * -0.05, 1e-15);
    EXPECT_NEAR(load.torque.y, 0.7 * 0.25, 1e-15);
}

TEST(PolygonBed, NothingWhereFacesAreApart)
{
    const Rectangle<double> face{0.2, 0.1, 0.5, 0.4};
    const Matrix<double> tilt = minus_identity(rotation_by<double>(0.01, 0.02, 0.3));
    for (const Vector<double>& place : {Vector<double>{0, 0, 0.1}, Vector<double>{2, 0, -0.01},
                                        Vector<double>{0, -2, -0.01}, Vector<double>{1.5, 1.5, -0.01}}) {
        const BedLoad<double> load = rectangle_bed({tilt, place}, 1e9, face, face);
        EXPECT_EQ(load.force, 0);
        EXPECT_EQ(load.energy, 0);
        EXPECT_EQ(load.area, 0);
        EXPECT_EQ(load.second_xx, 0);
        EXPECT_EQ(load.friction_radius, 0);
        EXPECT_EQ(load.lateral_x, 0);
        EXPECT_EQ(load.torque.z, 0);
    }
}

TEST(PolygonBed, SixteenCornersLieBetweenTwoDiscs)
{
    // the inscribed and the circumscribed circle on a wide face: area, force and energy grow with the face
    const double radius = 0.8, inner = radius * std::cos(std::numbers::pi / 16);
    Random random;
    int lifted = 0;
    for (int n = 0; n < 500; ++n) {
        const double tilt = std::pow(10, random.in({-6, -0.3})), azimuth = random.in({0, 6.3});
        const Quaternion<double> q = rotation_by<double>(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0);
        const double height = std::sin(tilt) * radius * random.in({-1.5, 0.9});
        const BedPose<double> pose{minus_identity(q), {0, 0, height}};
        const BedLoad<double> polygon =
            polygon_bed(pose, PolygonBed<double, 16>{1.0, sixteen_corners(0.0, 0.0, radius), {0, 0, 5, 5}});
        const BedLoad<double> less = disc_bed(pose, DiscBed<double>{1.0, inner, 1e3});
        const BedLoad<double> more = disc_bed(pose, DiscBed<double>{1.0, radius, 1e3});
        lifted += less.area < 0.99 * std::numbers::pi * inner * inner;
        for (const auto number : {&BedLoad<double>::area, &BedLoad<double>::force, &BedLoad<double>::energy}) {
            EXPECT_LE(less.*number, polygon.*number * (1 + 1e-9)) << n;
            EXPECT_GE(more.*number, polygon.*number * (1 - 1e-9)) << n;
        }
    }
    EXPECT_GT(lifted, 200);
}

TEST(PolygonBed, SixteenCornersPressedByTheWholeFace)
{
    // regular polygon of n corners: A = n/2 R2 sin(2 pi/n), second moment A R2 (2 + cos(2 pi/n)) / 12
    const double radius = 0.8, angle = std::numbers::pi / 8;
    const Quaternion<double> q = rotation_by<double>(1e-7, 2e-7, 0);
    const BedPose<double> pose{minus_identity(q), {0, 0, -1e-6}}; // the torques are a thirtieth of force x 1 m
    const BedLoad<double> polygon =
        polygon_bed(pose, PolygonBed<double, 16>{1.0, sixteen_corners(0.0, 0.0, radius), {0, 0, 5, 5}});
    const BedLoad<double> disc = disc_bed(pose, DiscBed<double>{1.0, radius, 1e3});
    const double of_area = 8 * std::sin(angle) / std::numbers::pi; // 0.97450
    EXPECT_NEAR(polygon.area, of_area * disc.area, 1e-9);
    EXPECT_NEAR(polygon.force, of_area * disc.force, 1e-9 * disc.force);
    EXPECT_NEAR(polygon.torque.x, of_area * (2 + std::cos(angle)) / 3 * disc.torque.x, 1e-7 * disc.force);
    EXPECT_NEAR(polygon.torque.y, of_area * (2 + std::cos(angle)) / 3 * disc.torque.y, 1e-7 * disc.force);
    EXPECT_NEAR(polygon.friction_radius, disc.friction_radius, 0.04 * disc.friction_radius);
}

TEST(PolygonBed, FrictionRadiusOfAnEvenlyPressedSquare)
{
    // mean distance from the centre of a square of side 1: (sqrt 2 + ln(1 + sqrt 2)) / 6
    const double mean = (std::numbers::sqrt2 + std::log(1 + std::numbers::sqrt2)) / 6;
    const Rectangle<double> face{0.3, 0, 0.5, 0.5};
    const BedLoad<double> load = rectangle_bed({{}, {0, 0, -1e-6}}, 1.0, face, face);
    EXPECT_NEAR(load.friction_radius, mean, 0.02 * mean);
}

} // namespace
} // namespace stylobate::spatial
