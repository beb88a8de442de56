/// What a diagnosis names is what the extended study runs: both ways of putting a cause into the model agree.

#include "measured_samples.hpp"

#include "ensemble/sampler.hpp"
#include "ensemble/specimen.hpp"
#include "studies/diagnosis/cause_model.hpp"
#include "studies/diagnosis/track.hpp"

#include <gtest/gtest.h>

#include <set>

namespace stylobate {
namespace {

/// Two columns of one drum under an epistyle; each stands on a block fixed to the table.
Specimen small_colonnade()
{
    Specimen s;
    s.name = "colonnade";
    s.friction_nominal = 0.6;
    s.half_width_m = {0.03, 0.03, 0.075};
    s.half_height_m = {0.05, 0.05, 0.03};
    s.depth_m = {0.06, 0.06, 0.06};
    s.mass_kg = {0.9, 0.9, 1.4};
    s.rest_x_m = {-0.05, 0.05, 0};
    s.rest_y_m = {0.05, 0.05, 0.13};
    s.joints = {{-1, 0}, {-1, 1}, {0, 2}, {1, 2}};
    return s;
}

Study study_of(const SpecimenStructure& built)
{
    Study study;
    study.realizations = 1;
    study.structure = built.structure;
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 4.8e6;
    study.contact.friction = 0.6;
    study.excitation.frequency_hz = 3;
    study.excitation.pga_m_s2 = 3;
    return study;
}

double size_of(const Cause& cause)
{
    const std::string& m = cause.mechanism;
    return m == "joint_friction"  ? 0.7
           : m == "stribeck"      ? 0.8
           : m == "dowel"         ? 2e4
           : m == "drag"          ? 0.3
           : m == "friction_wear" ? 0.5
                                  : 1e-3;
}

class CauseModel : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Specimens, CauseModel, testing::Bool(),
                         [](const auto& with) { return with.param ? "colonnade" : "column"; });

TEST_P(CauseModel, TheStudyRunsWhatWasFitted)
{
    const Specimen specimen = GetParam() ? small_colonnade() : sample_specimen();
    const SpecimenStructure built = build_specimen(specimen);
    TrackScales scales;
    scales.time_s = 0.1;
    std::set<std::string> mechanisms;
    std::vector<Cause> causes = balance_causes(specimen, scales);
    causes.push_back({"table_pitch", "base", "rotation_rad_s2_m", "rad s2/m", 0});
    causes.push_back({"vertical_motion", "base", "ratio", "", 0});
    causes.push_back({"adhesion", "joint 1", "adhesion_n_m", "N/m", 0, 1});
    for (const Cause& cause : causes) {
        SCOPED_TRACE(cause.label());
        mechanisms.insert(cause.mechanism);
        const SizedCause sized{cause, size_of(cause)};
        const Study baseline = study_of(built);
        const Realization plain = Sampler(baseline, nullptr).realization(0);
        Realization applied = plain;
        apply_cause(sized, built, applied);
        Study extended = baseline;
        add_mechanism(sized, built, extended);
        ASSERT_EQ(extended.mechanisms.size(), 1u);
        const Realization sampled = Sampler(extended, nullptr).realization(0);

        EXPECT_TRUE(sampled.extended || cause.mechanism == "joint_friction");
        bool changed = applied.base != plain.base;
        ASSERT_EQ(sampled.joints.size(), applied.joints.size());
        for (std::size_t j = 0; j < applied.joints.size(); ++j) {
            const JointExtension &a = applied.joints[j].extension, &b = sampled.joints[j].extension;
            EXPECT_DOUBLE_EQ(applied.joints[j].friction, sampled.joints[j].friction) << j;
            EXPECT_DOUBLE_EQ(a.dynamic_ratio, b.dynamic_ratio) << j;
            EXPECT_EQ(a.stribeck_velocity_m_s, b.stribeck_velocity_m_s) << j;
            EXPECT_EQ(a.wear_per_m, b.wear_per_m) << j;
            EXPECT_EQ(a.adhesion_n_m, b.adhesion_n_m) << j;
            EXPECT_EQ(a.dowel_stiffness_n_m, b.dowel_stiffness_n_m) << j;
            EXPECT_EQ(a.dowel_yield_n, b.dowel_yield_n) << j;
            EXPECT_EQ(a.dowel_gap_m, b.dowel_gap_m) << j;
            EXPECT_EQ(a.chip_left_m, b.chip_left_m) << j;
            EXPECT_EQ(a.chip_right_m, b.chip_right_m) << j;
            EXPECT_EQ(a.corner_wear_m_rad, b.corner_wear_m_rad) << j;
            changed =
                changed || !(a == plain.joints[j].extension) || applied.joints[j].friction != plain.joints[j].friction;
        }
        ASSERT_EQ(sampled.blocks.size(), applied.blocks.size());
        for (std::size_t b = 0; b < applied.blocks.size(); ++b) {
            if (applied.blocks[b].mass_kg > 0) {
                EXPECT_EQ(applied.blocks[b].extension, sampled.blocks[b].extension) << b;
            }
            changed = changed || !(applied.blocks[b].extension == plain.blocks[b].extension);
        }
        EXPECT_EQ(applied.base, sampled.base);
        EXPECT_TRUE(changed);
    }
    EXPECT_EQ(mechanisms.size(), 11u); // the eight of the balance and three more
}

} // namespace
} // namespace stylobate
