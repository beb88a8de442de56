/// Mass, centre and inertia of drums and prisms: closed forms of textbooks, and slices added up.

#include "ensemble/model/frustum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace stylobate {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Frustum, OfEqualFacesIsACylinderOrABox)
{
    const Frustum drum{Shape::round, 1.2, 1.2, 0.8, 1};
    EXPECT_NEAR(drum.volume_m3(), pi * 0.36 * 0.8, 1e-15);
    EXPECT_DOUBLE_EQ(drum.centre_height_m(), 0.4);
    const std::array<double, 3> inertia = drum.inertia_per_mass_m2();
    EXPECT_NEAR(inertia[0], (3 * 0.36 + 0.64) / 12, 1e-15);
    EXPECT_NEAR(inertia[1], 0.36 / 2, 1e-15);
    EXPECT_EQ(inertia[2], inertia[0]);

    const Frustum box{Shape::rectangle, 2, 3, 5, 1};
    EXPECT_NEAR(box.volume_m3(), 30, 1e-14);
    EXPECT_NEAR(box.inertia_per_mass_m2()[0], (9.0 + 25) / 12, 1e-14);
    EXPECT_NEAR(box.inertia_per_mass_m2()[1], (9.0 + 4) / 12, 1e-14);
    EXPECT_NEAR(box.inertia_per_mass_m2()[2], (4.0 + 25) / 12, 1e-14);
}

/// A frustum with a top next to nothing is a cone, or a pyramid: 3/10 R2 about its axis, 3/20 R2 + 3/80 h2 about a
/// line across it through the centre of mass, which is at h / 4.
TEST(Frustum, OfNoTopIsAConeOrAPyramid)
{
    const double none = 1e-12, R = 0.7, h = 2.1;
    const Frustum cone{Shape::round, 2 * R, 2 * R, h, none};
    EXPECT_NEAR(cone.volume_m3(), pi * R * R * h / 3, 1e-11);
    EXPECT_NEAR(cone.centre_height_m(), h / 4, 1e-11);
    EXPECT_NEAR(cone.inertia_per_mass_m2()[1], 0.3 * R * R, 1e-11);
    EXPECT_NEAR(cone.inertia_per_mass_m2()[0], 3.0 / 20 * R * R + 3.0 / 80 * h * h, 1e-11);

    const Frustum pyramid{Shape::square, 1, 1, h, none};
    EXPECT_NEAR(pyramid.volume_m3(), h / 3, 1e-11);
    EXPECT_NEAR(pyramid.inertia_per_mass_m2()[1], 1.0 / 10, 1e-11);
    EXPECT_NEAR(pyramid.inertia_per_mass_m2()[2], 1.0 / 20 + 3.0 / 80 * h * h, 1e-11);
}

/// Gauss points of each of many slices are exact for the polynomials of degree four that a frustum has.
TEST(Frustum, IsTheSumOfItsSlices)
{
    const std::vector<Frustum> bodies = {{Shape::round, 1.0, 1.0, 0.9, 0.93},
                                         {Shape::round, 0.5, 0.5, 3.0, 1.4},
                                         {Shape::square, 1.5, 1.5, 0.3, 0.6},
                                         {Shape::rectangle, 0.8, 2.4, 1.7, 0.8}};
    const std::array<double, 3> point = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
    const std::array<double, 3> weight = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    for (const Frustum& f : bodies) {
        constexpr int slices = 50;
        const double dy = f.height_m / slices;
        double volume = 0, first = 0, second = 0, xx = 0, zz = 0;
        for (int i = 0; i < slices; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const double y = (i + 0.5 + point[k] / 2) * dy;
                const double s = 1 + (f.top_ratio - 1) * y / f.height_m;
                const double a = s * f.width_m, b = s * f.depth_m;
                const double area = f.shape == Shape::round ? pi * a * b / 4 : a * b;
                const double part = f.shape == Shape::round ? 16 : 12;
                const double dv = area * weight[k] / 2 * dy;
                volume += dv;
                first += y * dv;
                second += y * y * dv;
                xx += a * a / part * dv;
                zz += b * b / part * dv;
            }
        const double centre = first / volume, upright = second / volume - centre * centre;
        EXPECT_NEAR(f.volume_m3(), volume, 1e-12 * volume);
        EXPECT_NEAR(f.centre_height_m(), centre, 1e-12 * f.height_m);
        const std::array<double, 3> inertia = f.inertia_per_mass_m2();
        EXPECT_NEAR(inertia[0], zz / volume + upright, 1e-11);
        EXPECT_NEAR(inertia[1], (xx + zz) / volume, 1e-11);
        EXPECT_NEAR(inertia[2], xx / volume + upright, 1e-11);
    }
}

/// A capital is a cone frustum below a prism: the same numbers from slices of both.
TEST(Frustum, OfACapitalIsAnEchinusBelowAnAbacus)
{
    // half of 0.8 m is an echinus from 0.9 m to the 1.2 m of the narrower side
    const Frustum capital{Shape::rectangle, 1.5, 1.2, 0.8, 0.9, 0.5, 0.6};
    constexpr int slices = 200000;
    const double dy = 0.8 / slices;
    double volume = 0, first = 0, second = 0, xx = 0, zz = 0;
    for (int i = 0; i < slices; ++i) {
        const double y = (i + 0.5) * dy, up = (y - 0.4) / 0.4;
        const double d = 0.9 + 0.3 * (y / 0.4), s = 1 - 0.1 * up;
        const double area = y < 0.4 ? pi * d * d / 4 : s * s * 1.5 * 1.2;
        volume += area * dy;
        first += y * area * dy;
        second += y * y * area * dy;
        xx += area * (y < 0.4 ? d * d / 16 : s * s * 1.5 * 1.5 / 12) * dy;
        zz += area * (y < 0.4 ? d * d / 16 : s * s * 1.2 * 1.2 / 12) * dy;
    }
    const double centre = first / volume, yy = second / volume - centre * centre;
    EXPECT_NEAR(capital.volume_m3(), volume, 1e-9);
    EXPECT_NEAR(capital.centre_height_m(), centre, 1e-9);
    const std::array<double, 3> inertia = capital.inertia_per_mass_m2();
    EXPECT_NEAR(inertia[0], zz / volume + yy, 1e-9);
    EXPECT_NEAR(inertia[1], (xx + zz) / volume, 1e-9);
    EXPECT_NEAR(inertia[2], xx / volume + yy, 1e-9);
}

} // namespace
} // namespace stylobate
