/// The designs of studies: indices by hand.

#include "ensemble/model/study.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

Study study_of_kind(StudyKind kind, std::uint64_t realizations)
{
    Study study;
    study.kind = kind;
    study.realizations = realizations;
    return study;
}

/// 2 frequencies x 3 PGAs.
Study surface_of_kind(StudyKind kind, std::uint64_t realizations)
{
    Study study = study_of_kind(kind, realizations);
    study.surface = SurfaceSpec{{1, 2, 2}, {1, 3, 3}};
    return study;
}

TEST(StudyDesign, OfASingleStudyIsNeutral)
{
    const Study study = study_of_kind(StudyKind::single, 7);
    const StudyDesign design = study.design();
    EXPECT_EQ(design.cells, 1U);
    EXPECT_EQ(design.total(), 7U);
    EXPECT_EQ(design.most, 7U);
    EXPECT_EQ(design.cell(6), 0U);
    EXPECT_EQ(design.original(6), 6U);
    EXPECT_EQ(design.motion_index(6), 6U);
    EXPECT_EQ(design.events_of(6), 1);
    EXPECT_EQ(design.replica(6), nullptr);
    EXPECT_EQ(design.factor("friction"), -1);
    EXPECT_EQ(design.drawn_alone(5), 5U);
    EXPECT_TRUE(design.traced);
    EXPECT_FALSE(design.chained() || design.selected || design.residuals || design.end_state);
}

TEST(StudyDesign, ReplicasAreLayersOfASurface)
{
    Study study = surface_of_kind(StudyKind::surface, 4);
    study.replicas.emplace().kinds = {{ReplicaBy::move, 1e-6}, {ReplicaBy::step, 0.5}};
    const StudyDesign design = study.design();
    EXPECT_EQ(design.originals(), 24U);
    EXPECT_EQ(design.total(), 72U);
    EXPECT_EQ(design.columns, 3U);
    EXPECT_EQ(design.replica(23), nullptr);
    EXPECT_EQ(design.replica(24)->by, ReplicaBy::move);
    EXPECT_EQ(design.replica(71)->by, ReplicaBy::step);
    EXPECT_EQ(design.original(71), 23U);
    EXPECT_EQ(design.cell(24 + 9), 2U);
    EXPECT_EQ(study.without_replicas().total(), 24U);
    EXPECT_EQ(study.as_single(5).total(), 5U);
    EXPECT_FALSE(study.as_single(5).surface);
}

TEST(StudyDesign, AnAdaptiveSurfaceRunsItsBudgetAtMost)
{
    Study study = surface_of_kind(StudyKind::surface, 100);
    study.surface->adaptive.emplace().budget = 250;
    EXPECT_TRUE(study.design().selected);
    EXPECT_EQ(study.design().most, 250U);
    EXPECT_EQ(study.total(), 600U);
}

TEST(StudyDesign, EventsAreLayersAndStructuresShareMotions)
{
    Study study = surface_of_kind(StudyKind::survival, 4);
    study.survival.emplace().events = 3;
    study.survival->per_motion = 2;
    const StudyDesign design = study.design();
    EXPECT_EQ(design.total(), 72U);
    EXPECT_EQ(design.events_of(23), 1);
    EXPECT_EQ(design.events_of(24), 2);
    EXPECT_EQ(design.cell(24 + 9), 2U);
    EXPECT_EQ(design.motion_index(8), 8U); // the first of cell 2
    EXPECT_EQ(design.motion_index(9), 8U);
    EXPECT_EQ(design.motion_index(11), 9U);
    EXPECT_TRUE(design.end_state);
    EXPECT_FALSE(design.residuals) << "nothing was measured";
    study.survival->observed.emplace();
    EXPECT_TRUE(study.design().residuals);
}

TEST(StudyDesign, AMotionIsARowOfCells)
{
    Study study = study_of_kind(StudyKind::fragility, 12);
    study.fragility.emplace().motions = 5;
    study.fragility->intensity = {1, 4, 3};
    study.fragility->contacts = 2;
    study.fragility->twins = 3;
    const StudyDesign design = study.design();
    EXPECT_EQ(design.cells, 15U);
    EXPECT_EQ(design.columns, 3U);
    EXPECT_EQ(design.recurring, 3U);
    EXPECT_EQ(design.cell(12 * 3), 3U) << "the first stripe of the second motion";
    EXPECT_EQ(design.same_contacts, 3U);
    EXPECT_EQ(design.same_imperfections, 6U);
    EXPECT_EQ(design.twin_m, 1e-9);
    study.fragility->twins = 1;
    EXPECT_EQ(study.design().twin_m, 0);
    study.fragility->method = FragilityMethod::cloud;
    EXPECT_EQ(study.cells(), 5U);
}

TEST(StudyDesign, FactorsAndChains)
{
    Study factors = study_of_kind(StudyKind::sensitivity, 1);
    factors.sensitivity = FactorDesign{SensitivityMethod::sobol, 10, 2, {"friction", "tilt"}};
    const StudyDesign design = factors.design();
    EXPECT_EQ(design.total(), 10U * 4 * 2);
    EXPECT_EQ(design.cell(79), 0U);
    EXPECT_EQ(design.factor("tilt"), 1);
    EXPECT_EQ(design.motion_index(8 + 2 * 3 + 1), 1 * 2 + 1U) << "row 1, point 3, draw 1";

    Study rare = study_of_kind(StudyKind::rare, 1);
    rare.rare.emplace().samples = 500;
    EXPECT_EQ(rare.total(), 11 * (std::uint64_t{1} << 32));
    EXPECT_EQ(rare.design().most, 11U * 500 * 11);
    EXPECT_EQ(rare.design().drawn_alone(rare.originals()), 500U);
    EXPECT_TRUE(rare.design().chained() && rare.design().selected);
}

} // namespace
} // namespace stylobate
