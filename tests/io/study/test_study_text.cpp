/// The canonical text of a study: it reads back to itself, and is equal for equal studies only.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace stylobate::test_study_text {
namespace {

const std::string structure = R"(
[structure]
blocks = 7
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
)";

const std::string surface = R"(
[study]
kind = "surface"
realizations = 8
[excitation]
kind = "harmonic"
cycles = 8
[surface]
frequency_hz = { from = 0.5, to = 8, count = 5, spacing = "log" }
pga_m_s2 = { from = 1, to = 9, count = 3 }
)";

const std::string sensitivity = R"(
[study]
kind = "sensitivity"
[excitation]
kind = "harmonic"
frequency_hz = 4
pga_m_s2 = 5
[sensitivity]
samples = 100
factors = ["tilt", "phase"]
)";

const std::string perturbed = R"(
[perturbation]
phase = { distribution = "uniform" }
tilt = { distribution = "normal", sd_rad = 0.001, min = -0.003, max = 0.003 }
density = { distribution = "lognormal", sigma_ln = 0.1, per = "structure" }
drum_width = { distribution = "normal", sd_m = 0.0002 }
damping_ratio = { distribution = "log_uniform", from = 0.05, to = 0.5 }
tangential_stiffness = { distribution = "normal", sd_n_m = 1e5 }
)";

Study read(const std::string& text, const std::vector<std::string>& settings = {})
{
    return parse_study(text, "temple.toml", settings);
}

Study single(const std::string& excitation, const std::vector<std::string>& settings = {})
{
    return read("[study]\nkind = \"single\"\n" + structure + "[excitation]\n" + excitation, settings);
}

/// Studies that together use every key.
std::vector<Study> all_sorts()
{
    const std::string still = "kind = \"none\"\nduration_s = 2";
    std::vector<Study> studies = {read(surface + structure), read(surface + structure + perturbed), single(still),
                                  read(sensitivity + structure + perturbed)};
    for (const std::string excitation :
         {"kind = \"harmonic\"\nfrequency_hz = 0.1\npga_m_s2 = 0.3\nphase_rad = -0.0\nend = \"abrupt\"",
          "kind = \"full_sine\"\nfrequency_hz = 0.7\npga_m_s2 = 3.3\ntail_s = 1.5",
          "kind = \"record\"\nfile = 'C:\\quakes\\\"a\".at2'\nunit = \"g\"\ncomponent = \"NS\"\ntime_scale = 1.1",
          "kind = \"record\"\nfile = \"a\"\nband_pass_hz = [0.1, 25]",
          "kind = \"ricker\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3",
          "kind = \"pulse\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3\ngamma = 1.1\nphase_rad = 0.3",
          "kind = \"tapered\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3\nramp_cycles = 1.1\ncycles = 9.9",
          "kind = \"sweep\"\nfrom_hz = 0.3\nto_hz = 7.7\nduration_s = 41.3\npga_m_s2 = 3.3",
          "kind = \"noise\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3\nrise_s = 0.7"})
        studies.push_back(single(excitation));
    studies.push_back(single(still, {"contact.normal_damping_n_s_m=0.1", "contact.tangential_damping_n_s_m=0",
                                     "run.step_s=1e-7", "contact.damping_per=chord"}));
    for (const std::string survival :
         {"events = 1", "observed = { tolerance_m = 0.002 }\nprior = \"uniform\"\nlevel = 0.9",
          "observed = { joints = [0, 2], joint_offset_m = [0.001, -0.002], tolerance_m = 0.002, rotation_rad = [0, "
          "0.01, "
          "0, 0, 0, 0], rotation_tolerance_rad = 0.01, mirrored = true }\nevents = 3\npause_s = 2.5\nmonuments = 7",
          "stands_for_years = 2400\nhazard = { k0_per_year = 0.02, k = 2.5, sigma_ln = 1 }",
          "prior = \"hazard\"\nhazard = { intensity_m_s2 = [1, 2.5], rate_per_year = [0.1, 0.001], sigma_ln = 0.5 }"})
        studies.push_back(
            parse_study(surface + structure + "[survival]\n" + survival + "\n", "study.toml", {"study.kind=survival"}));
    const std::string colonnade = R"(
[study]
kind = "single"
[structure]
kind = "colonnade"
depth_m = 0.06
columns = 2
column_spacing_m = 0.09
drums = [ { width_m = 0.06, height_m = 0.05, mass_kg = 0.375, count = 2 } ]
epistyle_height_m = 0.06
epistyle_mass_kg = 1.14
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
[excitation]
)" + still;
    studies.push_back(read(colonnade));
    studies.push_back(read(colonnade, {"structure.epistyles=[]"}));
    studies.push_back(read(colonnade, {"outcome.follow=collapse"}));
    studies.push_back(read(colonnade, {"structure.capital={ width_m = 0.07, height_m = 0.01, mass_kg = 0.1 }"}));
    studies.push_back(read(colonnade, {"structure.fixed_blocks=1", "initial.tilt_from_block=1"}));
    studies.push_back(
        single(still, {"structure.capital={ width_m = 0.05, height_m = 0.01, mass_kg = 0.1, offset_m = 0.001, "
                       "friction = 0.3, normal_stiffness_n_m2 = 1e9, tangential_stiffness_n_m = 1e8 }"}));
    studies.push_back(
        single(still, {"run.allow_step_above_bound=true", "run.step_fraction=1.001", "run.step_bound=structure"}));
    return studies;
}

TEST(StudyText, ReadsBackToItself)
{
    for (const auto& study : all_sorts()) {
        ASSERT_FALSE(study.text.empty());
        EXPECT_EQ(parse_study(study.text, "again.toml").text, study.text);
        EXPECT_EQ(study_text(study), study.text);
    }
}

TEST(StudyText, DoesNotDependOnHowTheStudyIsWritten)
{
    const std::string other = R"(
contact.friction = 0.680            # sections in another order, one without a header
contact.normal_stiffness_n_m2 = 100_000_000.0
[surface.pga_m_s2]
count = 3
to = 9.0
from = 1.0
[surface.frequency_hz]
spacing = 'log'
count = 5
from = 0.5
to = 8
[structure]
depth_m = 48e-3
drum_mass_kg = 0.1355
drum_height_m = 0.029
drum_width_m = 0.048
gravity_m_s2 = 9.81
fixed_blocks = 1
blocks = 0x7
[excitation]
kind = "harmonic"
phase_rad = -0.0
start = "smooth"
cycles = 8.0
[study]
realizations = 8.0
seed = 1
kind = "surface"
)";
    EXPECT_EQ(read(other).text, read(surface + structure).text);
}

void expect_other_texts(const Study& base, const std::vector<std::function<void(Study&)>>& changes)
{
    for (std::size_t i = 0; i < changes.size(); ++i) {
        auto changed = base;
        changes[i](changed);
        EXPECT_NE(study_text(changed), base.text) << "change " << i;
    }
}

TEST(StudyText, HasTheTitleWhereThereIsOne)
{
    const Study plain = all_sorts()[1];
    EXPECT_EQ(plain.text.find("title"), std::string::npos); // as before there were titles
    const Study titled = read(surface + structure + perturbed, {"study.title=\"It's the \\\"south\\\" side: 5 %\""});
    EXPECT_EQ(titled.title, "It's the \"south\" side: 5 %");
    EXPECT_EQ(parse_study(titled.text, "again").title, titled.title);
    EXPECT_EQ(parse_study(titled.text, "again").text, titled.text);
    for (const std::string& bad : {std::string(201, 'x'), std::string("two\\nlines")})
        EXPECT_THROW(read(surface + structure, {"study.title=\"" + bad + "\""}), InputError) << bad;
}

TEST(StudyText, DiffersWhereverAStudyDoes)
{
    const auto sorts = all_sorts();
    for (std::size_t i = 0; i < sorts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NE(sorts[i].text, sorts[j].text) << i << ' ' << j;

    const auto base = sorts[1];
    const auto up = [](double& x) { x = std::nextafter(x, 1e300); }; // by one bit
    const std::vector<std::function<void(Study&)>> changes = {
        [](Study& s) { s.seed += 1; },
        [](Study& s) { s.realizations += 1; },
        [](Study& s) { s.sampling = Sampling::sobol; },
        [](Study& s) { s.allow = {"pga"}; },
        [](Study& s) { s.kept = KeptRealizations::none; },
        [](Study& s) { s.surface->adaptive = AdaptiveSpec{}; },
        [](Study& s) { s.structure.kind = StructureKind::colonnade; },
        [](Study& s) { s.structure.columns[0].drums.push_back(s.structure.columns[0].drums[0]); },
        [](Study& s) { s.structure.columns[0].fixed_blocks = 0; },
        [](Study& s) { s.structure.columns[0].drums[6].capital = true; },
        [&](Study& s) { up(s.structure.columns[0].drums[0].width_m); },
        [&](Study& s) { up(s.structure.columns[0].drums[6].height_m); },
        [](Study& s) { s.structure.columns[0].drums[2].offset_m = 0.001; },
        [](Study& s) { s.structure.columns[0].drums[2].bed.friction = 0.68; },
        [](Study& s) { s.structure.columns[0].drums[2].bed.normal_stiffness_n_m2 = 1e8; },
        [](Study& s) { s.structure.columns[0].drums[2].bed.tangential_stiffness_n_m = 4.8e6; },
        [](Study& s) { s.structure.columns[0].drums[2].bed.normal_damping_ratio = 0.1; },
        [](Study& s) { s.structure.columns[0].drums[2].bed.tangential_damping_ratio = 0.1; },
        [&](Study& s) { up(s.structure.depth_m); },
        [&](Study& s) { up(s.structure.columns[0].drums[3].mass_kg); },
        [&](Study& s) { up(s.structure.gravity_m_s2); },
        [&](Study& s) { up(s.contact.normal_stiffness_n_m2); },
        [&](Study& s) { up(s.contact.tangential_stiffness_n_m); },
        [&](Study& s) { up(s.contact.normal_damping_ratio); },
        [&](Study& s) { up(s.contact.tangential_damping_ratio); },
        [](Study& s) { s.contact.normal_damping_n_s_m = 0.1; },
        [](Study& s) { s.contact.tangential_damping_n_s_m = 0.1; },
        [](Study& s) { s.contact.damping_per = DampingPer::chord; },
        [&](Study& s) { up(s.contact.friction); },
        [](Study& s) { s.excitation.start = HarmonicEdge::abrupt; },
        [](Study& s) { s.excitation.end = HarmonicEdge::abrupt; },
        [&](Study& s) { up(s.excitation.ramp_cycles); },
        [&](Study& s) { up(s.excitation.cycles); },
        [&](Study& s) { up(s.excitation.phase_rad); },
        [](Study& s) { s.excitation.tail_s = 1; },
        [&](Study& s) { up(s.surface->frequency_hz.from); },
        [&](Study& s) { up(s.surface->pga_m_s2.to); },
        [](Study& s) { s.surface->pga_m_s2.count += 1; },
        [](Study& s) { s.surface->pga_m_s2.spacing = Spacing::log; },
        [](Study& s) { s.perturbations.pop_back(); },
        [&](Study& s) { up(s.perturbations[0].sd); },
        [&](Study& s) { up(s.perturbations[1].from); },
        [&](Study& s) { up(s.perturbations[1].to); },
        [](Study& s) { s.perturbations[0].min = 1; },
        [](Study& s) { s.perturbations[0].max = 1e9; },
        [](Study& s) { s.perturbations[0].per = Per::joint; },
        [&](Study& s) { up(s.initial.tilt_rad); },
        [](Study& s) { s.initial.tilt_from_block = 2; },
        [&](Study& s) { up(s.output.trajectory_rate_hz); },
        [](Study& s) { s.outcome.follow = Follow::rest; },
        [&](Study& s) { up(s.outcome.collapse_height_fraction); },
        [&](Study& s) { up(s.outcome.rocking_threshold_rad); },
        [&](Study& s) { up(s.outcome.sliding_threshold); },
        [](Study& s) { s.run.precision = Precision::single; },
        [&](Study& s) { up(s.run.step_fraction); },
        [](Study& s) { s.run.step_bound = StepBasis::structure; },
        [](Study& s) { s.run.step_s = 1e-5; },
        [](Study& s) { s.run.allow_step_above_bound = true; },
        [&](Study& s) { up(s.run.max_invalid_fraction); },
    };
    expect_other_texts(base, changes);
}

TEST(StudyText, DiffersWhereverTheTrajectoriesDo)
{
    const Study base = single("kind = \"none\"\nduration_s = 2");
    expect_other_texts(base, {
                                 [](Study& s) { s.output.trajectories = 0; },
                                 [](Study& s) { s.output.trajectories = OutputSpec::all; },
                                 [](Study& s) { s.output.most_mb = 101; },
                             });
    for (const char* kept : {"\"all\"", "7", "0", "\"fit\""}) {
        const Study study = single("kind = \"none\"\nduration_s = 2", {std::string("output.trajectories=") + kept});
        EXPECT_EQ(parse_study(study.text, "again").text, study.text);
    }
}

TEST(StudyText, AnAdaptiveSurfaceReadsBackToItself)
{
    Study base = all_sorts()[1];
    base.realizations = 400;
    base.sampling = Sampling::sobol;
    base.surface->adaptive = AdaptiveSpec{1000000, 9, 0.037, false};
    const Study again = parse_study(study_text(base), "again");
    EXPECT_EQ(again.sampling, Sampling::sobol);
    ASSERT_TRUE(again.surface->adaptive);
    EXPECT_EQ(again.surface->adaptive->budget, 1000000U);
    EXPECT_EQ(again.surface->adaptive->minimum, 9U);
    EXPECT_EQ(again.surface->adaptive->half_width, 0.037);
    EXPECT_FALSE(again.surface->adaptive->borrow);
    EXPECT_EQ(again.text, study_text(base));
    base.surface->adaptive->borrow = true;
    EXPECT_NE(again.text, study_text(base));
}

TEST(StudyText, DiffersWhereverASensitivityStudyDoes)
{
    const std::string text = sensitivity + structure + perturbed;
    const Study study = read(text);
    EXPECT_EQ(study.sensitivity->factors, (std::vector<std::string>{"tilt", "phase"}));
    EXPECT_EQ(study.sensitivity->inner, 4U);
    for (const char* setting : {"sensitivity.samples=101", "sensitivity.inner=3", "sensitivity.method=morris",
                                "sensitivity.factors=[\"tilt\"]"})
        EXPECT_NE(read(text, {setting}).text, study.text) << setting;
    EXPECT_EQ(read(text, {"sensitivity.factors=[\"phase\", \"tilt\"]"}).text, study.text) << "no order";
}

TEST(StudyText, DiffersWhereverAColonnadeDoes)
{
    const auto up = [](double& x) { x = std::nextafter(x, 1e300); };
    const auto sorts = all_sorts();
    const auto base = *std::find_if(sorts.begin(), sorts.end(), [](const Study& study) {
        return study.structure.kind == StructureKind::colonnade && !study.structure.epistyles.empty();
    });
    expect_other_texts(base, {
                                 [&](Study& s) { up(s.structure.columns[1].x_m); },
                                 [](Study& s) { s.structure.columns[1].fixed_blocks = 1; },
                                 [&](Study& s) { up(s.structure.columns[1].drums[0].mass_kg); },
                                 [](Study& s) { s.structure.columns.pop_back(); },
                                 [](Study& s) { s.structure.epistyles.pop_back(); },
                                 [](Study& s) { s.structure.epistyles[0].first_column = 1; },
                                 [](Study& s) { s.structure.epistyles[0].last_column = 0; },
                                 [&](Study& s) { s.structure.epistyles[0].x_m = 0.001; },
                                 [&](Study& s) { up(s.structure.epistyles[0].length_m); },
                                 [&](Study& s) { up(s.structure.epistyles[0].height_m); },
                                 [&](Study& s) { up(s.structure.epistyles[0].mass_kg); },
                                 [](Study& s) { s.structure.epistyles[0].bed.friction = 0.68; },
                                 [](Study& s) { s.structure.epistyles[0].bed.normal_stiffness_n_m2 = 1e8; },
                                 [](Study& s) { s.structure.epistyles[0].bed.tangential_stiffness_n_m = 1e8; },
                                 [](Study& s) { s.structure.epistyles[0].bed.normal_damping_ratio = 0.1; },
                                 [](Study& s) { s.structure.epistyles[0].bed.tangential_damping_ratio = 0.1; },
                             });
}

TEST(StudyText, DiffersWhereverAnExcitationDoes)
{
    const auto up = [](double& x) { x = std::nextafter(x, 1e300); };
    const auto with = [](const std::string& kind) {
        return single("kind = \"" + kind + "\"\nfrequency_hz = 0.7\npga_m_s2 = 3.3");
    };
    const Study pulse = with("pulse"), tapered = with("tapered"), noise = with("noise");
    const Study sweep = single("kind = \"sweep\"\nfrom_hz = 0.3\nto_hz = 7.7\nduration_s = 41.3\npga_m_s2 = 3.3");
    const Study record = single("kind = \"record\"\nfile = \"a\"\nband_pass_hz = [0.1, 25]");
    const std::vector<std::pair<Study, std::function<void(ExcitationSpec&)>>> of_kinds = {
        {pulse, [&](ExcitationSpec& e) { up(e.gamma); }},
        {pulse, [&](ExcitationSpec& e) { up(e.phase_rad); }},
        {pulse, [&](ExcitationSpec& e) { up(e.frequency_hz); }},
        {pulse, [&](ExcitationSpec& e) { up(e.pga_m_s2); }},
        {tapered, [&](ExcitationSpec& e) { up(e.ramp_cycles); }},
        {tapered, [&](ExcitationSpec& e) { up(e.cycles); }},
        {tapered, [&](ExcitationSpec& e) { up(e.phase_rad); }},
        {sweep, [&](ExcitationSpec& e) { up(e.from_hz); }},
        {sweep, [&](ExcitationSpec& e) { up(e.to_hz); }},
        {sweep, [&](ExcitationSpec& e) { up(e.duration_s); }},
        {sweep, [&](ExcitationSpec& e) { up(e.ramp_cycles); }},
        {sweep, [&](ExcitationSpec& e) { up(e.pga_m_s2); }},
        {sweep, [](ExcitationSpec& e) { e.spacing = Spacing::linear; }},
        {noise, [](ExcitationSpec& e) { e.pga_of = PgaOf::mean; }},
        {noise, [&](ExcitationSpec& e) { up(e.ground_damping_ratio); }},
        {noise, [&](ExcitationSpec& e) { up(e.low_cut_ratio); }},
        {noise, [&](ExcitationSpec& e) { up(e.low_cut_damping_ratio); }},
        {noise, [&](ExcitationSpec& e) { up(e.rise_s); }},
        {noise, [&](ExcitationSpec& e) { up(e.strong_s); }},
        {noise, [&](ExcitationSpec& e) { up(e.decay_s); }},
        {noise, [&](ExcitationSpec& e) { up(e.frequency_hz); }},
        {record, [&](ExcitationSpec& e) { up(e.band_pass->low_hz); }},
        {record, [&](ExcitationSpec& e) { up(e.band_pass->high_hz); }},
        {record, [](ExcitationSpec& e) { e.band_pass.reset(); }},
    };
    for (std::size_t i = 0; i < of_kinds.size(); ++i) {
        Study changed = of_kinds[i].first;
        of_kinds[i].second(changed.excitation);
        EXPECT_NE(study_text(changed), of_kinds[i].first.text) << "change of a kind " << i;
    }
}

} // namespace
} // namespace stylobate::test_study_text
