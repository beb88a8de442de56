/// A realization in space in a lane of the engine: its start at rest, and which of its bodies fell first.

#include "ensemble/engine/lanes.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/spatial/spatial_model.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace stylobate {
namespace {

using OfDowel = spatial::OfJointMechanisms;
using OfSolid = spatial::OfBody;

/// Four drums on the ground, not shaken.
Study four_drums()
{
    return parse_study("[study]\nkind = \"single\"\n[structure]\ndimensions = 3\nblocks = 4\ndrum_width_m = 1.0\n"
                       "drum_height_m = 1.0\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m3 = 3e9\n"
                       "friction = 0.7\n[excitation]\nkind = \"none\"\nduration_s = 1\n",
                       "study.toml");
}

/// A realization in the only lane of its set.
struct Loaded {
    explicit Loaded(Realization r) : lanes(study, nullptr, kernels(Isa::scalar), r), solids(r.space)
    {
        lanes.load(0, std::move(r));
    }
    static Realization nominal()
    {
        const Study study = four_drums();
        return Sampler(study, nullptr).realization(0);
    }
    template <class Field>
    double& at(Field field, int row, int k = 0)
    {
        return lanes.model().bundle().at(static_cast<Field>(field + k), row, 0);
    }
    int row(int drum) const { return solids.place_of(static_cast<std::size_t>(drum)); }
    /// Leans a drum; by the step `inside` of the next check it was within its limits.
    void lean(int drum, double angle_rad, double azimuth_rad, bool low, int inside)
    {
        const int i = row(drum);
        at(OfSolid::q_w, i) = std::cos(angle_rad / 2);
        at(OfSolid::q_x, i) = std::sin(angle_rad / 2) * std::sin(azimuth_rad);
        at(OfSolid::q_y, i) = 0;
        at(OfSolid::q_z, i) = -std::sin(angle_rad / 2) * std::cos(azimuth_rad);
        at(OfSolid::y, i) =
            low ? -2 * lanes.realization(0).space.solids[static_cast<std::size_t>(drum)].centre_m[1] : 0;
        at(OfSolid::inside, i) = inside;
    }
    void check()
    {
        lanes.place(0).watch.steps += chunk_steps;
        lanes.model().check_limits(0, lanes.place(0), chunk_steps);
    }
    Outcome ended()
    {
        SpatialModel::conclude(lanes.place(0));
        Outcome o;
        lanes.model().measure(0, lanes.place(0), State::collapsed, o);
        return o;
    }

    Study study = four_drums();
    SpatialLaneSet lanes;
    SolidTopology solids;
};

TEST(SpatialModel, DowelsThatYieldUnderTheWeightStartWithTheirSet)
{
    Realization r = Loaded::nominal();
    r.space.base_tilt_rad = {0.03, -0.04};
    r.space.with_mechanisms = true;
    constexpr double stiff = 1e9, yields_at = 50;
    for (SolidJoint& joint : r.space.joints) {
        joint.mechanisms.dowel_stiffness_n_m = stiff;
        joint.mechanisms.dowel_yield_n = yields_at;
    }
    Loaded loaded(r);
    std::array<double, 8> set{};
    for (int j = 0; j < 4; ++j) {
        const double x = loaded.at(OfDowel::dowel_at, j), z = loaded.at(OfDowel::dowel_at, j, 1), b = std::hypot(x, z);
        ASSERT_GT(b, 2 * yields_at / stiff) << j;
        EXPECT_NEAR(std::hypot(loaded.at(OfDowel::dowel_force, j), loaded.at(OfDowel::dowel_force, j, 1)), yields_at,
                    1e-9 * yields_at);
        // the play is centred F_d / k_d short of the offset
        for (int k = 0; k < 2; ++k) {
            set[static_cast<std::size_t>(2 * j + k)] = loaded.at(OfDowel::dowel_set, j, k);
            EXPECT_NEAR(loaded.at(OfDowel::dowel_set, j, k),
                        loaded.at(OfDowel::dowel_at, j, k) * (1 - yields_at / stiff / b), 1e-9 * b)
                << j;
        }
    }
    // the first increment is half a0 dt2: of the weight 1e-6 is not balanced
    const double fall = 0.5 * r.gravity_m_s2 * r.step_s * r.step_s;
    for (int drum = 0; drum < 4; ++drum)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(std::fabs(loaded.at(OfSolid::dx, loaded.row(drum), k)), 1e-6 * fall) << drum;
    for (int chunk = 0; chunk < 20; ++chunk)
        loaded.lanes.advance();
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 2; ++k)
            EXPECT_NEAR(loaded.at(OfDowel::dowel_set, j, k), set[static_cast<std::size_t>(2 * j + k)], 1e-12) << j;
    EXPECT_LT(std::fabs(loaded.lanes.model().balance(0, loaded.lanes.place(0)).residual), 1e-9);
}

TEST(SpatialModel, TheFirstToFallIsTheEarliestAndNotTheFirstOfTheList)
{
    Loaded loaded(Loaded::nominal());
    loaded.lean(1, 1.0, 2.0, true, 20);
    loaded.lean(3, 1.0, -1.0, true, 10);
    loaded.check();
    const Outcome o = loaded.ended();
    EXPECT_EQ(o.first_collapse_block, 3);
    EXPECT_NEAR(o.fall_azimuth_rad, -1.0, 1e-12);
    EXPECT_EQ(o.fallen_column, 0);
}

TEST(SpatialModel, WhatHasTurnedBeforeAnotherFellIsFirst)
{
    Loaded loaded(Loaded::nominal());
    loaded.lean(3, 1.0, 2.0, false, 30);
    loaded.check(); // it may come back
    ASSERT_FALSE(SpatialModel::fallen(loaded.lanes.place(0)));
    loaded.lean(1, 1.0, -1.0, true, 10);
    loaded.check();
    ASSERT_TRUE(SpatialModel::fallen(loaded.lanes.place(0)));
    const Outcome o = loaded.ended();
    EXPECT_EQ(o.first_collapse_block, 3);
    EXPECT_NEAR(o.fall_azimuth_rad, 2.0, 1e-12);
}

TEST(SpatialModel, OneThatTurnedAndDidNotComeBackHasADirection)
{
    Loaded loaded(Loaded::nominal());
    loaded.lean(2, 1.0, 0.5, false, 30);
    loaded.check();
    const Outcome o = loaded.ended();
    EXPECT_EQ(o.first_collapse_block, 2);
    EXPECT_NEAR(o.fall_azimuth_rad, 0.5, 1e-12);
}

TEST(SpatialModel, OfSeveralAtOneStepTheFarthestBeyondItsLimitHasTheDirection)
{
    Loaded loaded(Loaded::nominal());
    loaded.lean(1, 0.9, 2.0, true, 10);
    loaded.lean(2, 1.3, -2.5, true, 10);
    loaded.lean(3, 1.1, -1.0, true, 10);
    loaded.check();
    const Outcome o = loaded.ended();
    EXPECT_EQ(o.first_collapse_block, several_blocks);
    EXPECT_NEAR(o.fall_azimuth_rad, -2.5, 1e-12);
    loaded.lean(2, 0.05, -2.5, true, 10);
    loaded.at(OfSolid::x, loaded.row(2)) = 0.3; // it lies lower and hardly leans: the others are turned farther
    EXPECT_NEAR(loaded.ended().fall_azimuth_rad, -1.0, 1e-12);
}

} // namespace
} // namespace stylobate
