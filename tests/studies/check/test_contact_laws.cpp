/// The laws of a study, the draws that they have in common, and the band that `check` measures, counted again from
/// single runs.

#include "studies/experiment/contact_laws.hpp"

#include "io/study/study_file.hpp"
#include "studies/check/law_share.hpp"
#include "tests/studies/kinds/single_runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace stylobate {
namespace {

const std::string inputs = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/";

Study column(const std::vector<std::string>& settings = {})
{
    return read_study(inputs + "small_scale_column.toml", settings);
}

const ContactLaw& law_called(const std::vector<ContactLaw>& laws, const std::string& name)
{
    return *std::ranges::find(laws, name, &ContactLaw::name);
}

TEST(ContactLaws, ChangeTheContactAndNothingElse)
{
    const Study base = column();
    const std::vector<ContactLaw> laws = contact_laws(base);
    ASSERT_EQ(laws.size(), 4U);
    for (const ContactLaw& law : laws)
        ASSERT_TRUE(law.study) << law.name << ": " << law.why_not;
    const Study &softer = *law_called(laws, "softer").study, &stiffer = *law_called(laws, "stiffer").study,
                &rigid = *law_called(laws, "rigid").study, &ends = *law_called(laws, "ends").study;
    EXPECT_DOUBLE_EQ(softer.contact.normal_stiffness_n_m2, 1e8 / 3);
    EXPECT_DOUBLE_EQ(softer.contact.tangential_stiffness_n_m, 1.6e6);
    EXPECT_DOUBLE_EQ(stiffer.contact.normal_stiffness_n_m2, 3e8);
    EXPECT_DOUBLE_EQ(stiffer.contact.tangential_stiffness_n_m, 1.44e7);
    EXPECT_EQ(rigid.contact.form, ContactForm::rigid);
    EXPECT_DOUBLE_EQ(rigid.contact.friction, 0.68);
    EXPECT_EQ(rigid.perturbations.size(), base.perturbations.size() - 2); // of stiffness and damping
    EXPECT_TRUE(law_called(laws, "rigid").note);
    EXPECT_EQ(ends.contact.damping, DampingAt::ends);
    for (const ContactLaw& law : laws) {
        EXPECT_EQ(law.study->seed, base.seed);
        EXPECT_EQ(law.study->total(), base.total());
        EXPECT_EQ(law.study->structure, base.structure);
    }
}

/// The same structures under the same shaking: what a law does not concern is drawn to the same bits.
TEST(ContactLaws, HaveTheDrawsOfTheStudy)
{
    for (const char* distribution : {"{ distribution = \"lognormal\", sigma_ln = 0.7 }",
                                     "{ distribution = \"log_uniform\", from = 3e7, to = 3e8 }"}) {
        const Study base = column({std::string("perturbation.normal_stiffness=") + distribution});
        const Experiment experiment(base);
        for (const ContactLaw& law : contact_laws(base)) {
            ASSERT_TRUE(law.study) << law.name << ": " << law.why_not;
            const Experiment other(*law.study);
            for (const std::uint64_t index : {0U, 1U, 777U, 65535U}) {
                const Realization a = experiment.sampler().realization(index), b = other.sampler().realization(index);
                ASSERT_EQ(a.blocks.size(), b.blocks.size());
                for (std::size_t i = 0; i < a.blocks.size(); ++i) {
                    EXPECT_EQ(a.blocks[i].half_width_m, b.blocks[i].half_width_m);
                    EXPECT_EQ(a.blocks[i].mass_kg, b.blocks[i].mass_kg);
                    EXPECT_EQ(a.blocks[i].x_m, b.blocks[i].x_m);
                }
                for (std::size_t j = 0; j < a.joints.size(); ++j) {
                    EXPECT_EQ(a.joints[j].friction, b.joints[j].friction);
                    const double ratio = law.name == "softer"  ? 1.0 / 3
                                         : law.name == "rigid" ? 0
                                         : law.name == "ends"  ? 1
                                                               : 3;
                    EXPECT_NEAR(b.joints[j].normal_stiffness_n_m2 / a.joints[j].normal_stiffness_n_m2, ratio, 1e-12)
                        << law.name;
                }
                EXPECT_EQ(a.phase_rad, b.phase_rad);
                EXPECT_EQ(a.base_tilt_rad, b.base_tilt_rad);
                EXPECT_EQ(a.pga_m_s2, b.pga_m_s2);
            }
        }
    }
}

/// A stiffness of a bed of its own is a stiffness, and what replaces the nominal value moves with it.
TEST(ContactLaws, ScaleEveryStiffness)
{
    Study base = column();
    base.structure.columns[0].drums[3].bed.normal_stiffness_n_m2 = 6e7;
    const std::vector<ContactLaw> laws = contact_laws(base);
    EXPECT_DOUBLE_EQ(*law_called(laws, "stiffer").study->structure.columns[0].drums[3].bed.normal_stiffness_n_m2,
                     1.8e8);
    EXPECT_FALSE(law_called(laws, "rigid").study); // a bed that yields is a part of the structure
    EXPECT_NE(law_called(laws, "rigid").why_not, "");
}

TEST(ContactLaws, StateWhyOneDoesNotApply)
{
    const auto without = [](const Study& study) {
        std::string names;
        for (const ContactLaw& law : contact_laws(study))
            if (!law.study) {
                EXPECT_GT(law.why_not.size(), 10U) << law.name;
                names += law.name + " ";
            }
        return names;
    };
    EXPECT_EQ(without(column()), "");
    EXPECT_EQ(without(column({"study.sampling=\"sobol\""})), "rigid ");
    EXPECT_EQ(without(column({"contact.form=\"two_corner\""})), "ends ");
    EXPECT_EQ(without(column({"mechanisms.dowel={ stiffness_n_m = 1e6, yield_n = 20 }"})), "rigid ");
    EXPECT_EQ(without(read_study(inputs + "rigid_column.toml")), "softer stiffer rigid ends ");
    const std::vector<ContactLaw> of_ends = contact_laws(column({"contact.damping=\"ends\""}));
    EXPECT_EQ(law_called(of_ends, "centroid").study->contact.damping, DampingAt::centroid);
    // in space there are no rigid contacts, and the other dashpots are spread
    const Study space = read_study(inputs + "round_column.toml");
    EXPECT_EQ(without(space), "rigid ");
    const Study space_ends = *law_called(contact_laws(space), "ends").study;
    EXPECT_EQ(space_ends.contact.damping, DampingAt::ends);
    EXPECT_EQ(law_called(contact_laws(space_ends), "spread").study->text, space.text);
    const std::vector<std::string> sentences = laws_left_out(contact_laws(column({"contact.form=\"two_corner\""})));
    ASSERT_EQ(sentences.size(), 1U);
    EXPECT_TRUE(sentences[0].starts_with("ends (")) << sentences[0];
}

/// A fixed step is above the bound of a stiffer contact; it is the same part of it.
TEST(ContactLaws, AFixedStepFollowsTheStiffness)
{
    const Study base = column({"run.step_s=1e-6"});
    const std::vector<ContactLaw> laws = contact_laws(base);
    EXPECT_NEAR(*law_called(laws, "stiffer").study->run.step_s, 1e-6 / std::sqrt(3.0), 1e-20);
    EXPECT_FALSE(law_called(laws, "rigid").study->run.step_s);
    EXPECT_NEAR(law_cost(Experiment(base), Experiment(*law_called(laws, "stiffer").study)), std::sqrt(3.0), 1e-9);
}

TEST(LawShare, IsCountedFromTheRuns)
{
    const Study study = column({"study.realizations=12", "structure.blocks=4", "excitation.cycles=4",
                                "contact.normal_stiffness_n_m2=4e6", "contact.tangential_stiffness_n_m=2e5",
                                "surface.frequency_hz={ from = 4.0, to = 6.0, count = 2 }",
                                "surface.pga_m_s2={ from = 4.0, to = 12.0, count = 2 }"});
    const Experiment experiment(study);
    Observer quiet;
    std::vector<std::string> told;
    const RunOptions options{best_isa(), 2};
    const PartRun plain = run_part(experiment, options, spread_evenly(24, study.total()), quiet);
    const LawShare share = measure_law_share(
        experiment, options, plain, 1e4, [&](const std::string& line) { told.push_back(line); }, quiet);
    ASSERT_TRUE(share.measured()) << share.why_none.value_or("");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_NE(told[0].find("24 realizations under each"), std::string::npos) << told[0];
    ASSERT_EQ(share.laws.size(), 4U);
    const std::map<std::uint64_t, bool> base = collapsed_of(study);
    double lowest = 1, highest = 0;
    const auto take = [&](const std::map<std::uint64_t, bool>& all) {
        std::uint64_t n = 0;
        for (std::uint64_t i = 0; i < 24; ++i) // of 48: every second
            n += all.at(2 * i);
        lowest = std::min(lowest, static_cast<double>(n) / 24);
        highest = std::max(highest, static_cast<double>(n) / 24);
        return n;
    };
    const std::uint64_t as_given = take(base);
    EXPECT_EQ(share.base_collapsed, as_given);
    EXPECT_EQ(share.base_valid, 24U);
    const std::vector<ContactLaw> laws = contact_laws(study);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::map<std::uint64_t, bool> other = collapsed_of(*laws[k].study);
        const std::uint64_t fell = take(other);
        double apart = 0;
        for (std::uint64_t i = 0; i < 24; ++i)
            apart += base.at(2 * i) != other.at(2 * i);
        const double d = (static_cast<double>(fell) - static_cast<double>(as_given)) / 24;
        EXPECT_EQ(share.laws[k].name, laws[k].name);
        EXPECT_EQ(share.laws[k].pairs.first, fell) << laws[k].name;
        EXPECT_DOUBLE_EQ(share.laws[k].pairs.difference, d);
        EXPECT_EQ(static_cast<double>(share.laws[k].pairs.differ), apart);
        EXPECT_NEAR(share.laws[k].pairs.sd, std::sqrt(std::max(apart, 1.0) / 576 - d * d / 24), 1e-12);
    }
    EXPECT_DOUBLE_EQ(share.probabilities().low(), lowest);
    EXPECT_DOUBLE_EQ(share.probabilities().high(), highest);
    EXPECT_LT(lowest, highest);
    const NumericsCheck numerics{.difference = 0.005, .sd = 0.009};
    const std::string text = law_share_text(share, &numerics, "study.toml");
    EXPECT_TRUE(text.starts_with(fmt::format("contact law: {:.3g} to {:.3g} (", lowest, highest))) << text;
    EXPECT_NE(text.find("; numerics: +0.005 ± 0.009;"), std::string::npos) << text;
}

TEST(LawShare, WordsOfARange)
{
    const std::vector<std::string> names = {"as given", "softer"};
    EXPECT_EQ(law_range_words({{0.25, 0.5}}, names), "contact law: 0.25 to 0.5 (as given to softer)");
    EXPECT_EQ(law_range_words({{0.25, 0.25}}, names), "contact law: 0.25 under each law");
}

/// Less time: fewer of the same realizations; too little: none, with the option that runs them.
TEST(LawShare, StaysWithinItsTime)
{
    const Study study = column({"study.realizations=4"});
    const Experiment experiment(study);
    PartRun plain{.indices = spread_evenly(64, study.total()),
                  .collapsed = std::vector<std::optional<bool>>(64, false)};
    Observer quiet;
    double cost = 0;
    for (const ContactLaw& law : contact_laws(study))
        cost += law_cost(experiment, Experiment(*law.study));
    plain.seconds = 1e6 / cost; // so 1e6 s for all
    const LawShare none = measure_law_share(experiment, {best_isa(), 2}, plain, 1e5, {}, quiet);
    ASSERT_FALSE(none.measured());
    EXPECT_NE(none.why_none->find("--law-seconds"), std::string::npos) << *none.why_none;
    EXPECT_NEAR(none.whole_run, cost, 1e-9);

    struct Stopped : Observer {
        bool stop_requested() override { return true; }
    } stopped;
    const LawShare quarter = measure_law_share(experiment, {best_isa(), 2}, plain, 2.51e5, {}, stopped);
    EXPECT_TRUE(quarter.measured());
    EXPECT_EQ(quarter.realizations, 16U);
}

} // namespace
} // namespace stylobate
