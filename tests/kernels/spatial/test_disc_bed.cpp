/// The bed of two discs against quadrature, written without its formulas, and against differences of its energy.

#include "kernels/spatial/disc_bed.hpp"

#include "tests/kernels/spatial/long_real.hpp"
#include "tests/kernels/spatial/rotations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stylobate {
namespace {

using spatial::Axis;

const long double pi = std::acos(-1.0L);

// ---- the segment of the unit disc -----------------------------------------------------------------------------------

/// Its integrals by Simpson's rule in the angle psi, t = cos(psi), from the deepest point to the end at psi_0.
spatial::DiscSegment<long double> segment_by_quadrature(long double xi)
{
    const long double eta = 1 + xi; // of the part's depth, from 0 to 2
    const long double end = xi >= 1 ? pi : 2 * std::asin(std::sqrt(eta / 2));
    spatial::DiscSegment<long double> sum{0, 0, 0, 0, 0};
    const int n = 20000;
    for (int i = 0; i <= n; ++i) {
        const long double psi = end * i / n, t = std::cos(psi),
                          width = 2 * std::sin(psi) * std::sin(psi); // dt times 2 w
        const long double depth = xi >= 1 ? xi + t : 2 * std::sin((end - psi) / 2) * std::sin((end + psi) / 2);
        const long double weight = (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * end / n / 3 * width;
        sum.pressure += weight * depth;
        sum.moment += weight * depth * t;
        sum.area += weight;
        sum.first += weight * t;
        sum.second += weight * t * t;
    }
    return sum;
}

TEST(SpatialDiscBed, SegmentAgreesWithQuadrature)
{
    for (const double xi : {-0.9999, -0.99, -0.9, -0.7, -0.5, -0.3, -0.1, -1e-3, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99,
                            0.9999, 1.0, 1.5, 40.0}) {
        const auto want = segment_by_quadrature(xi);
        const auto disc = spatial::disc_segment(xi);
        const auto agree = [&](double value, long double expected, double relative) {
            EXPECT_NEAR(value / static_cast<double>(expected), 1, relative) << xi;
        };
        agree(disc.moment, want.moment, 5e-14);
        agree(disc.pressure, want.pressure, 5e-13);
        agree(disc.area, want.area, 5e-13);
        agree(disc.second, want.second, 5e-13);
        EXPECT_NEAR(disc.first, static_cast<double>(want.first), 1e-15) << xi;
    }
}

TEST(SpatialDiscBed, SegmentOfHalfOfAllAndOfNothing)
{
    const double pi_ = std::acos(-1.0);
    EXPECT_NEAR(spatial::disc_segment(0.0).moment, pi_ / 8, 2e-14);
    EXPECT_NEAR(spatial::disc_segment(0.0).pressure, 2.0 / 3, 1e-15);
    EXPECT_NEAR(spatial::disc_segment(0.0).area, pi_ / 2, 8e-14);
    const auto whole = spatial::disc_segment(3.0), none = spatial::disc_segment(-1.5);
    EXPECT_NEAR(whole.pressure, 3 * pi_, 1e-14);
    EXPECT_NEAR(whole.moment, pi_ / 4, 1e-15);
    EXPECT_NEAR(whole.area, pi_, 1e-15);
    EXPECT_NEAR(whole.second, pi_ / 4, 1e-15);
    EXPECT_EQ(whole.first, 0);
    for (const double value : {none.pressure, none.moment, none.area, none.second, none.first})
        EXPECT_EQ(value, 0);
}

// ---- the load against quadrature over the faces ---------------------------------------------------------------------

struct Sums {
    double force = 0, moment_x = 0, moment_y = 0, energy = 0;
    double area = 0, first_x = 0, first_y = 0, second_xx = 0, second_xy = 0, second_yy = 0;
};

/// The integrals over the points p of the upper disc that lie above the lower one and below its plane, in strips of
/// constant x. Each strip is an interval, and a polynomial of the third degree in y: two Gauss points are exact.
Sums by_strips(const spatial::BedPose<double>& pose, const spatial::BedLoad<double>& frame, double upper, double lower)
{
    Sums sum;
    const double d = -pose.place.z, a = frame.slope_x, b = frame.slope_y;
    const int strips = 20000;
    for (int i = 0; i < strips; ++i) {
        const double x = upper * std::cos(std::acos(-1.0) * (i + 0.5) / strips); // closer at the rim
        const double dx = upper * std::acos(-1.0) / strips * std::sin(std::acos(-1.0) * (i + 0.5) / strips);
        double high = std::sqrt(upper * upper - x * x), low = -high;
        const auto cut = [&](double value, double slope) { // value + slope y > 0
            if (slope > 0)
                low = std::max(low, -value / slope);
            else if (slope < 0)
                high = std::min(high, -value / slope);
            else if (value <= 0)
                high = low;
        };
        cut(d + a * x, b);
        // |P + t p|^2 < lower^2: A y2 + 2 B y + C < 0
        const double u = pose.place.x + frame.t11 * x, v = pose.place.y + frame.t21 * x;
        const double A = frame.t12 * frame.t12 + frame.t22 * frame.t22, B = u * frame.t12 + v * frame.t22;
        const double root = B * B - A * (u * u + v * v - lower * lower);
        if (root <= 0)
            continue;
        low = std::max(low, (-B - std::sqrt(root)) / A);
        high = std::min(high, (-B + std::sqrt(root)) / A);
        if (high <= low)
            continue;
        for (const double gauss : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
            const double y = (low + high) / 2 + gauss * (high - low) / 2, weight = dx * (high - low) / 2;
            const double depth = d + a * x + b * y;
            sum.force += weight * depth;
            sum.moment_x += weight * depth * x;
            sum.moment_y += weight * depth * y;
            sum.energy += weight * depth * depth / 2;
            sum.area += weight;
            sum.first_x += weight * x;
            sum.first_y += weight * y;
            sum.second_xx += weight * x * x;
            sum.second_xy += weight * x * y;
            sum.second_yy += weight * y * y;
        }
    }
    return sum;
}

/// The upper face tilted by `tilt` towards `direction`, twisted, and its centre at (x, y, z).
spatial::BedPose<double> pose_of(double tilt, double direction, double twist, spatial::Vector<double> place)
{
    const auto q = product(rotation_by<double>(-tilt * std::sin(direction), tilt * std::cos(direction), 0),
                           rotation_by<double>(0, 0, twist));
    return {spatial::minus_identity(q), place};
}

void expect_sums(const spatial::BedLoad<double>& load, const Sums& want, double k, double radius, double relative)
{
    const double force = k * want.force, area = want.area;
    EXPECT_NEAR(load.force, force, relative * force);
    EXPECT_NEAR(load.moment_x, k * want.moment_x, relative * force * radius);
    EXPECT_NEAR(load.moment_y, k * want.moment_y, relative * force * radius);
    EXPECT_NEAR(load.energy, k * want.energy, relative * k * want.energy);
    EXPECT_NEAR(load.area, area, relative * area);
    EXPECT_NEAR(load.first_x, want.first_x, relative * area * radius);
    EXPECT_NEAR(load.first_y, want.first_y, relative * area * radius);
    EXPECT_NEAR(load.second_xx, want.second_xx, relative * area * radius * radius);
    EXPECT_NEAR(load.second_xy, want.second_xy, relative * area * radius * radius);
    EXPECT_NEAR(load.second_yy, want.second_yy, relative * area * radius * radius);
}

/// A disc above a much larger one: the common part is the upper face, whose load is exact at any tilt.
TEST(SpatialDiscBed, UpperDiscInsideTheLowerOneIsExact)
{
    const double k = 3e9, upper = 0.5, lower = 2.0;
    for (const double tilt : {1e-4, 0.05, 0.6})
        for (const double depth : {-0.7, -0.2, 0.4, 1.7}) { // at the centre, per tilt and radius
            SCOPED_TRACE(testing::Message() << "tilt " << tilt << ", depth " << depth);
            const auto pose = pose_of(tilt, 0.8, 2.0, {0.2, -0.3, -depth * upper * std::sin(tilt)});
            const auto load = spatial::disc_bed(pose, spatial::DiscBed<double>{k, upper, lower});
            expect_sums(load, by_strips(pose, load, upper, lower), k, upper, 1e-6);
            EXPECT_NEAR(load.lateral_x, 0, 1e-12 * load.force);
            EXPECT_NEAR(load.lateral_y, 0, 1e-12 * load.force);
        }
}

/// The lower disc inside the upper one, and equal discs one above the other: the tilted face is shorter in plan by a
/// part of tilt2 / 2, which the ellipse has along the tilt only at the rim.
TEST(SpatialDiscBed, ConcentricDiscsAgreeWithQuadrature)
{
    const double k = 3e9, tilt = 0.01;
    struct {
        double upper, lower;
        spatial::Vector<double> place;
    } cases[] = {{0.5, 0.5, {0, 0, 0}}, {0.8, 0.5, {0.1, -0.15, 0}}};
    for (auto& one : cases)
        for (const double depth : {-0.6, 0.3, 1.5}) {
            SCOPED_TRACE(testing::Message() << "radius " << one.upper << ", depth " << depth);
            const double away = -one.place.x * std::cos(0.8) - one.place.y * std::sin(0.8); // lower centre, uphill
            one.place.z = tilt * (away - depth * 0.5);
            const auto pose = pose_of(tilt, 0.8, 2.0, one.place);
            const auto load = spatial::disc_bed(pose, spatial::DiscBed<double>{k, one.upper, one.lower});
            expect_sums(load, by_strips(pose, load, one.upper, one.lower), k, 0.5, 5e-4);
        }
}

/// The ellipse against the lens of two equal discs, whose centres are a part of the radius apart. The error is that of
/// the cusps, largest where only one of them presses.
TEST(SpatialDiscBed, EccentricDiscsAgreeWithTheLens)
{
    const double k = 3e9, tilt = 1e-3, radius = 0.5;
    struct {
        double offset, depth, relative;
    } cases[] = {{0.01, -0.4, 0.006}, {0.05, -0.4, 0.03}, {0.2, -0.4, 0.125}, {0.05, 0.3, 0.015},
                 {0.2, 0.3, 0.055},   {0.05, 1.5, 0.01},  {0.2, 1.5, 0.032}};
    for (const auto& one : cases)
        for (const double direction : {0.0, 0.8, 1.6, 2.2, 3.1}) {
            SCOPED_TRACE(testing::Message() << "offset " << one.offset << ", depth " << one.depth << ", " << direction);
            const auto pose = pose_of(tilt, direction, 2.0, {one.offset * radius, 0, -one.depth * radius * tilt});
            const auto load = spatial::disc_bed(pose, spatial::DiscBed<double>{k, radius, radius});
            expect_sums(load, by_strips(pose, load, radius, radius), k, radius, one.relative);
        }
}

TEST(SpatialDiscBed, FlatBedCarriesItsDepth)
{
    const double pi_ = std::acos(-1.0), k = 3e9, d = 1e-6, r = 0.5;
    const auto load = spatial::disc_bed(pose_of(0, 0, 1.0, {0, 0, -d}), spatial::DiscBed<double>{k, r, r});
    EXPECT_NEAR(load.force, k * pi_ * r * r * d, 1e-14 * k * d);
    EXPECT_NEAR(load.energy, k * pi_ * r * r * d * d / 2, 1e-14 * k * d * d);
    EXPECT_NEAR(load.area, pi_ * r * r, 1e-15);
    EXPECT_NEAR(load.second_xx, pi_ * r * r * r * r / 4, 1e-15);
    EXPECT_NEAR(load.second_yy, pi_ * r * r * r * r / 4, 1e-15);
    EXPECT_NEAR(load.second_xy, 0, 1e-15);
    EXPECT_NEAR(load.friction_radius, 2 * r / 3, 1e-15); // of a uniform pressure
    EXPECT_EQ(load.torque.x, 0);
    EXPECT_EQ(load.torque.y, 0);
    EXPECT_EQ(load.torque.z, 0);
}

TEST(SpatialDiscBed, NothingWhereTheFacesAreApart)
{
    const spatial::DiscBed<double> bed{3e9, 0.5, 0.4};
    for (const auto& pose : {pose_of(0, 0, 0, {0, 0, 1e-9}), pose_of(0.1, 0.7, 1, {0.1, 0.2, 0.06}),
                             pose_of(0, 0, 0, {0.95, 0, -1e-4}), pose_of(0.01, 2, 1, {0, -2, -0.1})}) {
        const auto load = spatial::disc_bed(pose, bed);
        for (const double value : {load.force, load.energy, load.area, load.moment_x, load.moment_y, load.lateral_x,
                                   load.lateral_y, load.torque.x, load.torque.y, load.torque.z})
            EXPECT_EQ(value, 0);
    }
}

/// Bodies at rest are exactly upright and centred, or tilted and displaced by rounding.
template <class Real>
void expect_finite_loads()
{
    using Number = typename Lanes<Real>::Number;
    const double least = std::numeric_limits<Number>::min();
    for (const double tilt : {0.0, least, 1e-30, 1e-18, 1e-9})
        for (const double offset : {0.0, least, 1e-30, 1e-18, 1e-9})
            for (const double depth : {-1e-6, -least, 0.0, least, 1e-6})
                for (const double lower : {0.4, 0.5, 0.6, 1e3}) {
                    SCOPED_TRACE(testing::Message() << tilt << ' ' << offset << ' ' << depth << ' ' << lower);
                    const auto q = rotation_by<Real>(0.3 * tilt, tilt, 0);
                    const spatial::BedPose<Real> pose{
                        spatial::minus_identity(q),
                        {static_cast<Real>(offset), static_cast<Real>(-0.2 * offset), static_cast<Real>(-depth)}};
                    const auto load =
                        spatial::disc_bed(pose, spatial::DiscBed<Real>{Real(3e9), Real(0.5), static_cast<Real>(lower)});
                    for (const Real value : {load.energy, load.moment_x, load.moment_y, load.lateral_x, load.lateral_y,
                                             load.torque.x, load.torque.y, load.torque.z, load.first_x, load.first_y,
                                             load.second_xx, load.second_xy, load.second_yy, load.friction_radius})
                        EXPECT_TRUE(std::isfinite(value));
                    // all presses, except the crescent of the offset, where the depth exceeds the tilt
                    const double whole = 3e9 * std::acos(-1.0) * std::min(0.25, lower * lower) * depth;
                    if (depth == 1e-6) {
                        EXPECT_NEAR(load.force / whole, 1, 2e-9 + 8 * std::numeric_limits<Number>::epsilon());
                    } else if (depth == -1e-6) {
                        EXPECT_EQ(load.force, 0);
                    }
                }
}

TEST(SpatialDiscBed, LoadIsFiniteAtRest)
{
    expect_finite_loads<double>();
    expect_finite_loads<float>();
}

/// The torque of friction of a pure spin about the pressure's centre is mu times the integral of pressure times
/// distance. The fit of its radius is good to 1 %.
TEST(SpatialDiscBed, FrictionRadiusIsTheMeanDistance)
{
    for (const double xi : {-0.9, -0.5, 0.0, 0.5, 0.9, 1.2, 3.0}) {
        const double tilt = 1e-5;
        const auto pose = pose_of(tilt, 0, 0, {0, 0, -xi * std::sin(tilt)});
        const auto load = spatial::disc_bed(pose, spatial::DiscBed<double>{1, 1, 3});
        const double centre = load.moment_x / load.force;
        double mean = 0, all = 0;
        const int n = 2000;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double x = -1 + 2 * (i + 0.5) / n, y = -1 + 2 * (j + 0.5) / n;
                if (x * x + y * y < 1 && xi + x > 0) {
                    all += xi + x;
                    mean += (xi + x) * std::hypot(x - centre, y);
                }
            }
        EXPECT_NEAR(load.friction_radius, mean / all, 0.01 * mean / all) << xi;
    }
}

// ---- the load against differences of the energy ---------------------------------------------------------------------

using Long = LongReal;
using LongVector = spatial::Vector<Long>;

LongVector long_vector(long double x, long double y, long double z)
{
    return {x, y, z};
}

struct Pair {
    spatial::BedBody<Long> lower, upper;
    Axis normal;
    spatial::DiscBed<Long> bed;
};

spatial::BedLoad<Long> load_of(Pair pair)
{
    pair.lower.turn = spatial::minus_identity(pair.lower.q);
    pair.upper.turn = spatial::minus_identity(pair.upper.q);
    return spatial::disc_bed(spatial::bed_pose(pair.lower, pair.upper, pair.normal), pair.bed);
}

/// Largest difference between the load and the negative gradient of the energy in all twelve freedoms of the two
/// bodies, as a part of the normal force (and of its product with 1 m).
long double gradient_error(const Pair& pair)
{
    const auto load = load_of(pair);
    const auto base = [&](const LongVector& v) {
        return rotated(spatial::minus_identity(pair.lower.q), spatial::from_joint(v, pair.normal));
    };
    const LongVector force = base({load.lateral_x, load.lateral_y, load.force}), torque = base(load.torque);
    // arms to the anchor of the upper face, which lies P away from that of the lower one
    const LongVector arm_upper = rotated(spatial::minus_identity(pair.upper.q), pair.upper.anchor);
    Pair posed = pair;
    posed.lower.turn = spatial::minus_identity(pair.lower.q);
    posed.upper.turn = spatial::minus_identity(pair.upper.q);
    const LongVector place = base(spatial::bed_pose(posed.lower, posed.upper, pair.normal).place);
    const LongVector arm_lower = rotated(posed.lower.turn, pair.lower.anchor) + place;
    const LongVector moment_upper = torque + cross(arm_upper, force), moment_lower = torque + cross(arm_lower, force);

    const long double h = 3e-9L;
    long double worst = 0;
    const auto compare = [&](const auto& move, Long want) {
        Pair plus = pair, minus = pair;
        move(plus, h);
        move(minus, -h);
        const long double slope = (load_of(plus).energy.v - load_of(minus).energy.v) / (2 * h);
        worst = std::max(worst, std::fabs(want.v + slope) / load.force.v);
    };
    for (int i = 0; i < 3; ++i) {
        const auto unit = [&](long double s) { return long_vector(i == 0 ? s : 0, i == 1 ? s : 0, i == 2 ? s : 0); };
        const auto of = [&](const LongVector& v) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
        const auto push = [&](spatial::BedBody<Long>& body, long double s) {
            body.displacement = body.displacement + unit(s);
        };
        const auto turn = [&](spatial::BedBody<Long>& body, long double s) {
            const LongVector v = unit(s);
            body.q = product(rotation_by<Long>(v.x.v, v.y.v, v.z.v), body.q);
        };
        compare([&](Pair& p, long double s) { push(p.upper, s); }, of(force));
        compare([&](Pair& p, long double s) { push(p.lower, s); }, Long(0.0L) - of(force));
        compare([&](Pair& p, long double s) { turn(p.upper, s); }, of(moment_upper));
        compare([&](Pair& p, long double s) { turn(p.lower, s); }, Long(0.0L) - of(moment_lower));
    }
    return worst;
}

/// Two bodies in any attitude whose faces meet with the given tilt, at a random offset and depth.
Pair random_pair(std::mt19937_64& random, double tilt, double upper_radius, double lower_radius)
{
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    const auto attitude = [&](double most) {
        return rotation_by<Long>(uniform(-most, most), uniform(-most, most), uniform(-most, most));
    };
    Pair pair;
    pair.normal = static_cast<Axis>(std::uniform_int_distribution<>(0, 2)(random));
    pair.bed = {Long(1e9L), Long(upper_radius), Long(lower_radius)};
    pair.lower.q = attitude(1.5);
    const double direction = uniform(0, 2 * std::acos(-1.0));
    const auto relative = product(rotation_by<Long>(-tilt * std::sin(direction), tilt * std::cos(direction), 0),
                                  rotation_by<Long>(0, 0, uniform(-3, 3)));
    const auto axes = spatial::from_joint(LongVector{relative.x, relative.y, relative.z}, pair.normal);
    pair.upper.q = product(pair.lower.q, {relative.w, axes.x, axes.y, axes.z});
    pair.lower.turn = spatial::minus_identity(pair.lower.q);
    pair.upper.turn = spatial::minus_identity(pair.upper.q);
    const auto anywhere = [&](double most) {
        return long_vector(uniform(-most, most), uniform(-most, most), uniform(-most, most));
    };
    pair.lower.anchor = anywhere(1);
    pair.upper.anchor = anywhere(1);
    pair.lower.displacement = anywhere(1);
    // P from -1 (nothing presses) to +1.5 (all does) of the tilt's rise
    const LongVector place = long_vector(uniform(-0.3, 0.3), uniform(-0.3, 0.3), std::sin(tilt) * uniform(-1.5, 0.9));
    pair.upper.displacement =
        pair.lower.displacement + rotated(pair.lower.turn, spatial::from_joint(place, pair.normal)) +
        displaced(pair.lower.turn, pair.lower.anchor) - displaced(pair.upper.turn, pair.upper.anchor);
    return pair;
}

TEST(SpatialDiscBed, LoadIsTheGradientOfTheEnergy)
{
    std::mt19937_64 random(5);
    const double radii[][2] = {{1, 1}, {0.9, 1}, {1, 0.9}, {0.4, 1}, {1, 0.4}, {1, 1000}};
    for (const auto& [upper, lower] : radii)
        for (const double tilt : {1e-3, 0.03, 0.3, 0.9}) {
            int partial = 0, full = 0;
            for (int i = 0; i < 200; ++i) {
                const Pair pair = random_pair(random, tilt, upper, lower);
                const auto load = load_of(pair);
                const long double smaller = std::min(upper, lower), area = load.area.v / (pi * smaller * smaller);
                if (!(area > 0.01L))
                    continue;
                (load.first_x.v == 0 || area > 0.999L ? full : partial) += 1;
                EXPECT_LT(gradient_error(pair), 1e-7L) << upper << ' ' << lower << ' ' << tilt << ' ' << i;
            }
            EXPECT_GT(partial, 20);
        }
}

} // namespace
} // namespace stylobate
