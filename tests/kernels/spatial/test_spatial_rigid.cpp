// The step in space against rigid blocks: rocking of a drum, a prism and a portal, rolling, the turn of a drum that
// falls face down, spin-down, and sliding on an orbiting table. The penalty bed tends to them as it gets stiffer.

#include "tests/kernels/spatial/leaning.hpp"

#include <gtest/gtest.h>

namespace stylobate::spatial {

namespace {

constexpr double g = Scene::gravity_m_s2, pi = std::numbers::pi;

/// Follows the direction in which the axis of body i leans, as an angle in the horizontal plane.
class Azimuth {
public:
    Azimuth(Scene& s, int i) : s_(s), i_(i), last_(now()) {}
    double add()
    {
        const double next = now(), step = next - last_;
        turned_ += step > pi ? step - 2 * pi : step < -pi ? step + 2 * pi : step;
        last_ = next;
        return turned_;
    }

private:
    double now() { return std::atan2(s_.axis(i_).x, s_.axis(i_).z); }

    Scene& s_;
    int i_;
    double last_, turned_ = 0;
};

/// A drum of the given radius and half height on a wide fixed one.
Scene drum_on_plane(double step_s, double radius, double half_height, double mass, const Scene::Law& law)
{
    Scene s(step_s);
    s.drum({0, -half_height, 0}, 10 * radius, 2 * half_height, 1, true);
    s.drum({0, half_height, 0}, radius, 2 * half_height, mass);
    s.joint(0, 1, BedKind::disc, {0, 0, 0}, law);
    s.build();
    return s;
}

// ---------------------------------------------------------------- rocking

// quarter periods [s] of a rigid drum and of a rigid square prism on its corner, of half height 0.087 m and radius or
// half width 0.024 m, released at 0.1, 0.3 and 0.5 of its angle of overturning
constexpr double parts[] = {0.1, 0.3, 0.5};
constexpr double drum_periods[] = {0.05188679, 0.09930988, 0.14584489};
constexpr double corner_periods[] = {0.05270351, 0.10071992, 0.14774003};

double rocking_period(BedKind kind, double part, double k)
{
    const double b = 0.024, h = 0.087, mass = 0.7, K = k * (kind == BedKind::disc ? pi : 4) * b * b;
    const double step_s = 0.2 * std::sqrt(mass / (6 * K));
    const Scene::Law law{k, K, 10, 0, 0};
    if (kind == BedKind::disc) {
        Scene s = drum_on_plane(step_s, b, h, mass, law);
        const Lean lean{{0.6, 0, 0.8}, part * std::atan2(b, h), b, h};
        place(s, 1, 0, lean, mass * g);
        return quarter_period(s, 1, lean);
    }
    const double to_corner = b * std::numbers::sqrt2;
    Scene s(step_s);
    s.box({0, -0.01, 0}, {0.2, 0.02, 0.2}, 1, true);
    s.box({0, h, 0}, {2 * b, 2 * h, 2 * b}, mass);
    s.joint(0, 1, kind, {0, 0, 0}, law);
    s.build();
    const Lean lean{{std::sqrt(0.5), 0, std::sqrt(0.5)}, part * std::atan2(to_corner, h), to_corner, h};
    place(s, 1, 0, lean, mass * g);
    return quarter_period(s, 1, lean);
}

TEST(SpatialRigid, ADrumRocksOnItsRimAndAPrismOnItsCorner)
{
    for (int i = 0; i < 3; ++i)
        for (const auto& [kind, periods] :
             {std::pair{BedKind::disc, drum_periods}, std::pair{BedKind::rectangle, corner_periods}}) {
            const double soft = rocking_period(kind, parts[i], 2e10) / periods[i] - 1;
            const double stiff = rocking_period(kind, parts[i], 2e12) / periods[i] - 1;
            EXPECT_GT(stiff, 0) << parts[i];
            EXPECT_LT(stiff, 0.005) << parts[i];
            EXPECT_GT(soft, 3 * stiff) << parts[i];
        }
}

// A portal of two columns of 1 m x 1 m x 4 m, 8 m apart, with a beam of 9.4 m x 1 m x 1 m that is as heavy as both.
// Quarter periods [s] along it, as a rocking frame, and across it, as one block, at 0.1, 0.3 and 0.5 of atan(1/4).
constexpr double along_periods[] = {0.28673632, 0.54896215, 0.80637727};
constexpr double across_periods[] = {0.38957001, 0.81492981, 1.47293130};

double portal_period(bool across, double part, double k)
{
    const double b = 0.5, h = 2, m = 1e4, angle = part * std::atan2(b, h);
    Scene s(0.06 * std::sqrt(m / k));
    const double places[] = {0, 8};
    for (const double x : places)
        s.box({x, -0.5, 0}, {3, 1, 3}, 1, true);
    for (const double x : places)
        s.box({x, h, 0}, {1, 4, 1}, m);
    const int beam = s.box({4, 2 * h + 0.5, 0}, {9.4, 1, 1}, 2 * m);
    const Scene::Law law{k, k, 10, 0, 0};
    for (int i = 0; i < 2; ++i)
        s.joint(i, 2 + i, BedKind::rectangle, {places[i], 0, 0}, law);
    for (int i = 0; i < 2; ++i)
        s.joint(2 + i, beam, BedKind::rectangle, {places[i], 2 * h, 0}, law);
    s.build();

    // an edge of 1 m that carries N lies sqrt(2 N sin(angle) / k) deep
    const Lean lean{across ? Vec{0, 0, 1} : Vec{1, 0, 0}, angle, b, h};
    const double foot = std::sqrt(4 * m * g * std::sin(angle) / k), head = std::sqrt(2 * m * g * std::sin(angle) / k);
    for (int i = 2; i < 4; ++i) {
        s.set_attitude(i, lean.axis(), angle);
        s.set_vector(OfBody::x, i, lean.displacement() - Vec{0, foot, 0});
    }
    const double sine = std::sin(angle), versine = 1 - std::cos(angle);
    if (across) { // it leans with the columns
        s.set_attitude(beam, lean.axis(), angle);
        s.set_vector(OfBody::x, beam,
                     Lean{lean.towards, angle, b, 2 * h + 0.5}.displacement() - Vec{0, foot + m * g / k, 0});
    } else {
        s.set_vector(OfBody::x, beam,
                     {2 * h * sine + 2 * b * versine, 2 * b * sine - 2 * h * versine - foot - head, 0});
    }
    return quarter_period(s, 2, lean);
}

TEST(SpatialRigid, APortalRocksAsAFrameAlongItAndAsOneBlockAcross)
{
    for (int i = 0; i < 3; ++i)
        for (const bool across : {false, true}) {
            const double rigid = across ? across_periods[i] : along_periods[i];
            const double soft = portal_period(across, parts[i], 1e10) / rigid - 1;
            const double stiff = portal_period(across, parts[i], 1e11) / rigid - 1;
            EXPECT_GT(stiff, 0) << across << ' ' << parts[i];
            EXPECT_LT(stiff, 0.01) << across << ' ' << parts[i];
            EXPECT_GT(soft, 2 * stiff) << across << ' ' << parts[i];
        }
}

// ---------------------------------------------------------------- rolling

TEST(SpatialRigid, ADrumRollsSteadilyOnItsRim)
{
    // rigid, without spin about the vertical: the rate [rad/s] at which a drum leaning by 0.1 rolls round
    const double R = 0.024, h = 0.0145, mass = 0.1064214508, angle = 0.1, rate = 66.37395833;
    double before = 0;
    for (const double K : {1e7, 1e8, 1e9, 1e10}) {
        Scene s = drum_on_plane(0.3 * std::sqrt(mass / K), R, h, mass, {K / (pi * R * R), K, 5, 0, 0});
        const Lean lean{{0, 0, 1}, angle, R, h};
        place(s, 1, 0, lean, mass * g);
        // the axis goes round; the drum turns about it so that the rotation has no vertical part
        const Vec omega{0, 0, 0 - rate * std::tan(angle)};
        s.set_motion(1, cross(lean.to_pivot(), omega), omega);
        Azimuth azimuth(s, 1);
        double turned = 0, tilts = 0;
        long count = 0;
        for (; s.time_s() < 0.5; ++count) {
            s.run(1);
            turned = azimuth.add();
            tilts += s.tilt(1);
        }
        const double ratio = turned / (s.time_s() * rate);
        EXPECT_GT(ratio, before);
        EXPECT_LT(ratio, 1);
        EXPECT_NEAR(tilts / static_cast<double>(count), angle, 0.005 * angle); // nothing brakes it
        before = ratio;
    }
    EXPECT_GT(before, 0.999);
}

TEST(SpatialRigid, ADrumThatFallsFaceDownRisesOnTheOtherSideTurned)
{
    // rigid: the angle between the two rims, with gravity and a small motion aside [deg]
    for (const auto& [h, rigid] : {std::pair{0.0145, 281.672}, std::pair{0.087, 189.810}}) {
        const double R = 0.024, mass = 0.1, tilt = 0.01, aside = 0.03, K = 1e10;
        Scene s = drum_on_plane(0.3 * std::sqrt(mass / K), R, h, mass, {K / (pi * R * R), K, 50, 0, 0});
        const Lean lean{{0, 0, 1}, tilt, R, h};
        place(s, 1, 0, lean, mass * g);
        const double rate = std::sqrt(g * R / ((R * R / 4 + h * h / 3 + h * h + R * R) * tilt));
        const Vec omega{0, 0, aside * tilt * rate};
        s.set_motion(1, cross(lean.to_pivot(), omega), omega);
        Azimuth azimuth(s, 1);
        double highest = 0, turned = 0;
        for (bool down = false; s.time_s() < 6 / rate && !(highest > 0.7 * tilt && s.tilt(1) < 0.8 * highest);) {
            s.run(1);
            const double at = azimuth.add();
            down |= s.tilt(1) < 0.3 * tilt;
            if (down && s.tilt(1) > highest) {
                highest = s.tilt(1);
                turned = at;
            }
        }
        EXPECT_GT(highest, 0.9 * tilt);
        EXPECT_NEAR(std::fabs(turned) * 180 / pi, rigid, 0.01 * rigid);
    }
}

// ---------------------------------------------------------------- friction

TEST(SpatialRigid, ASpinningDrumStopsAfterItsTime)
{
    // 3 R w / (4 mu g) with the exact friction of an evenly pressed disc, here with its friction sphere
    const double R = 0.5, mass = 2000, mu = 0.6, spin = 10, K = 1e9, c = 0.2 * std::sqrt(K * mass);
    Scene s = drum_on_plane(0.2 * std::sqrt(mass / K), R, 0.5, mass, {K / (pi * R * R), K, mu, c, c});
    s.at(OfBody::y, 1) = -mass * g / K;
    s.set_motion(1, {0, 0, 0}, {0, spin, 0});
    do
        s.run(1);
    while (s.omega(1).y > 0 && s.time_s() < 2);
    EXPECT_NEAR(s.time_s(), 3 * R * spin / (4 * mu * g), 5e-4);
}

TEST(SpatialRigid, ABlockOnAnOrbitingTableSlidesAfterIt)
{
    // the path of the slip over that of the base: sqrt(1 - (mu g / a)^2), a twice the friction here
    const double R = 0.5, mass = 500, mu = 0.5, K = 1e8, rate = 2 * pi, amplitude = 2 * mu * g / (rate * rate);
    Scene s =
        drum_on_plane(0.2 * std::sqrt(mass / K), R, 0.1, mass, {K / (pi * R * R), K, mu, 0.2 * std::sqrt(K * mass), 0});
    s.at(OfBody::y, 1) = -mass * g / K;
    const double dt = s.step_s();
    const auto base = [&](double t) {
        const double x = t < 4 ? t / 4 : 1, ramp = x * x * x * (10 - 15 * x + 6 * x * x);
        return amplitude * ramp * Vec{std::cos(rate * t), 0, std::sin(rate * t)};
    };
    const auto acceleration = [&](double t) {
        return 1 / (dt * dt) * ((base(t + dt) - base(t)) - (base(t) - base(t - dt)));
    };
    double slip = 0, path = 0;
    while (s.time_s() < 16) {
        s.run(1, acceleration);
        if (s.time_s() > 10) {
            slip += length(s.vector(OfBody::dx, 1));
            path += length(base(s.time_s()) - base(s.time_s() - dt));
        }
    }
    EXPECT_NEAR(slip / path, std::sqrt(0.75), 1.5e-3);
}

} // namespace

} // namespace stylobate::spatial
