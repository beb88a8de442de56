#pragma once
/// The keys of the tables that every kind of study has: [study], [contact], [excitation], [initial], [output],
/// [outcome], [run]; and [structure], which has a file of its own.

#include "ensemble/model/study.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/structure_keys.hpp"
#include "io/keys/words.hpp"

#include <limits>
#include <optional>

namespace stylobate {

namespace contact_keys {

inline const NumberKey
    normal_stiffness("normal_stiffness_n_m2", &ContactSpec::normal_stiffness_n_m2, normal_stiffness_range,
                     "K_N, the force per overlap area for the whole depth; a dry bed of marble has "
                     "1e9 to 1e10 N/m3 times the depth",
                     {.needed = true, .used = {compliant()}, .example = "3e9", .models = in_plane()});
inline const NumberKey tangential_stiffness("tangential_stiffness_n_m", &ContactSpec::tangential_stiffness_n_m,
                                            tangential_stiffness_range, "K_T, the force per tangential displacement",
                                            {.absent = "K_N times the width of the widest drum",
                                             .used = {compliant()},
                                             .models = in_plane()});
inline const NumberKey area_stiffness("normal_stiffness_n_m3", &ContactSpec::normal_stiffness_n_m3, bed_stiffness_range,
                                      "stiffness of the beds: force per area and depth; a dry bed of marble has 1e9 to "
                                      "1e10",
                                      {.needed = true, .example = "3e9", .models = in_space()});
inline const NumberKey area_tangential_stiffness("tangential_stiffness_n_m3", &ContactSpec::tangential_stiffness_n_m3,
                                                 bed_stiffness_range, "tangential stiffness of the beds, per area",
                                                 {.absent = "normal_stiffness_n_m3", .models = in_space()});
inline const NumberKey normal_damping_ratio("normal_damping_ratio", &ContactSpec::normal_damping_ratio,
                                            damping_ratio_range, "normal dashpot as a fraction of the critical damping",
                                            {.used = {compliant()}});
inline const NumberKey normal_damping(
    "normal_damping_n_s_m", &ContactSpec::normal_damping_n_s_m, damping_range,
    "coefficient C_N of the normal dashpot, instead of its ratio",
    {.absent = "from the ratio", .used = {compliant()}, .excludes = {"normal_damping_ratio"}, .models = in_plane()});
inline const NumberKey tangential_damping_ratio("tangential_damping_ratio", &ContactSpec::tangential_damping_ratio,
                                                damping_ratio_range,
                                                "tangential dashpot as a fraction of the critical damping",
                                                {.used = {compliant()}});
inline const NumberKey tangential_damping("tangential_damping_n_s_m", &ContactSpec::tangential_damping_n_s_m,
                                          damping_range,
                                          "coefficient C_T of the tangential dashpot, instead of its ratio",
                                          {.absent = "from the ratio",
                                           .used = {compliant()},
                                           .excludes = {"tangential_damping_ratio"},
                                           .models = in_plane()});
inline const WordKey<DampingAt> damping("damping", &ContactSpec::damping, damping_at_names,
                                        "where the normal dashpot acts: at the centroid of the overlap (the paper's "
                                        "model, in the plane alone), or at the ends of the contact",
                                        {.absent = "\"centroid\"; in space it is spread over the contact",
                                         .used = {compliant()}});
inline const WordKey<DampingPer> damping_per("damping_per", &ContactSpec::damping_per, damping_per_names,
                                             "whether the dashpot's coefficient is that of each contact, or grows with "
                                             "the length of the contact",
                                             {.used = {compliant()}, .models = in_plane()});
inline const WordKey<ContactForm> form("form", &ContactSpec::form, contact_form_names,
                                       "how the overlap becomes a force: by its area (the paper's model), by the "
                                       "penetration of two corners, by points along the face; or not at all, as of "
                                       "rigid blocks",
                                       {.models = in_plane()});
inline const NumberKey friction("friction", &ContactSpec::friction, friction_range,
                                "coefficient of friction mu; stone on stone has about 0.4 to 0.8",
                                {.needed = true, .example = "0.68"});

inline const NumberKey restitution("restitution", &ContactSpec::restitution, restitution_range,
                                   "what an impact gives back: a part of the velocity or of the impulse",
                                   {.used = {with_rigid_contacts()}, .models = in_plane()});
inline const WordKey<RestitutionLaw> restitution_law(
    "restitution_law", &ContactSpec::restitution_law, restitution_law_names,
    "whether an end that meets its face parts again with the part of its closing velocity (Newton), or every end "
    "gives back the part of the impulse with which the impact compresses it (Poisson)",
    {.used = {with_rigid_contacts()}, .models = in_plane()});

inline const TableKey table("contact", "the joints between blocks",
                            {&normal_stiffness, &tangential_stiffness, &area_stiffness, &area_tangential_stiffness,
                             &normal_damping_ratio, &normal_damping, &tangential_damping_ratio, &tangential_damping,
                             &damping, &damping_per, &form, &friction, &restitution, &restitution_law});

} // namespace contact_keys

namespace excitation_keys {

using Motion = ExcitationKind;

inline const Condition with_frequency =
    not_for_motions({Motion::none, Motion::sweep, Motion::record, Motion::table}); // of one value
inline const Condition synthetic = not_for_motions({Motion::none, Motion::record, Motion::table});
inline const Condition sampled = for_motions({Motion::record, Motion::table});
inline const Condition moving = not_for_motions({Motion::none});
inline const Condition one_motion = not_in_studies({StudyKind::surface, StudyKind::fragility, StudyKind::survival});
inline const Condition no_list = not_in_studies({StudyKind::fragility});

inline const WordKey<ExcitationKind> kind("kind", &ExcitationSpec::kind, excitation_kind_names,
                                          "the motion of the base", {.needed = true, .example = "\"harmonic\""});
inline const NumberKey
    duration("duration_s", &ExcitationSpec::duration_s, duration_range, "simulated time; of a sweep its length",
             {.needed = true, .used = {for_motions({Motion::none, Motion::sweep})}, .example = "10.0"});
inline const NumberKey frequency("frequency_hz", &ExcitationSpec::frequency_hz, frequency_range,
                                 "frequency of the sine or pulse; of noise that of the ground, 0.05 to 25",
                                 {.needed = true, .used = {with_frequency, without_frequencies()}, .example = "1.0"});
inline const NumberKey pga("pga_m_s2", &ExcitationSpec::pga_m_s2, acceleration_range,
                           "largest acceleration; of a harmonic motion and a sweep the amplitude on the plateau, which "
                           "the ramps exceed (by up to 2.0 % with 2 cycles, 61 % with half a cycle)",
                           {.needed = true, .used = {synthetic, one_motion}, .example = "4.0"});
inline const WordKey<HarmonicEdge> start("start", &ExcitationSpec::start, edge_names,
                                         "whether the motion begins with a ramp of the displacement",
                                         {.used = {for_motions({Motion::harmonic})}});
inline const WordKey<HarmonicEdge> end("end", &ExcitationSpec::end, edge_names, "the same at its end",
                                       {.used = {for_motions({Motion::harmonic})}});
inline const NumberKey ramp_cycles("ramp_cycles", &ExcitationSpec::ramp_cycles, cycles_range,
                                   "length of each ramp, in cycles; of a tapered motion at least 1",
                                   {.used = {for_motions({Motion::harmonic, Motion::tapered, Motion::sweep})}});
inline const NumberKey cycles("cycles", &ExcitationSpec::cycles, motion_cycles_range,
                              "number of cycles, including the ramps",
                              {.used = {for_motions({Motion::harmonic, Motion::tapered})}});
inline const NumberKey phase("phase_rad", &ExcitationSpec::phase_rad, phase_range, "phase of the sine or pulse",
                             {.used = {for_motions({Motion::harmonic, Motion::pulse, Motion::tapered})}});
inline const NumberKey gamma("gamma", &ExcitationSpec::gamma, gamma_range,
                             "oscillatory character of a pulse: cycles in its envelope; near faults mostly 1 to 3",
                             {.used = {for_motions({Motion::pulse})}});
inline const NumberKey from("from_hz", &ExcitationSpec::from_hz, frequency_range, "first frequency of the sweep",
                            {.needed = true, .used = {for_motions({Motion::sweep})}, .example = "0.5"});
inline const NumberKey to("to_hz", &ExcitationSpec::to_hz, frequency_range, "last frequency of the sweep",
                          {.needed = true, .used = {for_motions({Motion::sweep})}, .example = "5.0"});
inline const WordKey<Spacing> spacing("spacing", &ExcitationSpec::spacing, spacing_names,
                                      "whether the frequency of the sweep grows by equal differences or equal ratios",
                                      {.used = {for_motions({Motion::sweep})}});
inline const WordKey<PgaOf> pga_of("pga_of", &ExcitationSpec::pga_of, pga_of_names,
                                   "whether each realization is scaled to the PGA, or their mean is",
                                   {.used = {for_motions({Motion::noise}), no_list}});
inline const NumberKey ground_damping("ground_damping_ratio", &ExcitationSpec::ground_damping_ratio,
                                      filter_damping_range, "damping of the ground filter",
                                      {.used = {for_motions({Motion::noise})}});
inline const NumberKey low_cut("low_cut_ratio", &ExcitationSpec::low_cut_ratio, low_cut_ratio_range,
                               "frequency of the low-cut filter over that of the ground",
                               {.used = {for_motions({Motion::noise})}});
inline const NumberKey low_cut_damping("low_cut_damping_ratio", &ExcitationSpec::low_cut_damping_ratio,
                                       filter_damping_range, "damping of the low-cut filter",
                                       {.used = {for_motions({Motion::noise})}});
inline const NumberKey rise("rise_s", &ExcitationSpec::rise_s, rise_range, "time in which the noise grows",
                            {.used = {for_motions({Motion::noise})}});
inline const NumberKey strong("strong_s", &ExcitationSpec::strong_s, strong_range, "time of strong shaking",
                              {.used = {for_motions({Motion::noise})}});
inline const NumberKey decay("decay_s", &ExcitationSpec::decay_s, rise_range, "time in which it falls to 1/e",
                             {.used = {for_motions({Motion::noise})}});
inline const TextKey file("file", &ExcitationSpec::file,
                          "the record, or the table of samples: a path relative to the study file",
                          {.needed = true, .used = {sampled, no_list}, .example = "\"record.at2\""});
inline const TextKey run("run", &ExcitationSpec::run, "run of a measured campaign",
                         {.absent = "the file has one motion", .used = {for_motions({Motion::table})}});
inline const TextKey component("component", &ExcitationSpec::component,
                               "which one, where the file has several: its name or its column",
                               {.absent = "the only one", .used = {for_motions({Motion::record}), no_list}});
inline const TextKey
    unit("unit", &ExcitationSpec::unit, "unit of the record's acceleration",
         {.absent = "as in the file", .used = {for_motions({Motion::record}), no_list}, .words = acceleration_units});
inline const NumberKey scale_to_pga("scale_to_pga_m_s2", &ExcitationSpec::pga_m_s2, acceleration_range,
                                    "PGA to which the motion is scaled",
                                    {.absent = "as recorded", .used = {sampled, one_motion}});
inline const NumberKey time_scale("time_scale", &ExcitationSpec::time_scale, time_scale_range,
                                  "factor by which the motion is stretched in time",
                                  {.used = {sampled, without_frequencies()}});
inline const BooleanKey baseline("baseline", &ExcitationSpec::baseline, "correct the baseline of the record",
                                 {.used = {for_motions({Motion::record})}});
inline const ListKey band_pass("band_pass_hz", KeyType::interval, corner_range, "corners of a band-pass filter",
                               {.absent = "no filter", .used = {for_motions({Motion::record})}});

// in space

inline const NumberKey direction(
    "direction_deg", &ExcitationSpec::direction_deg, azimuth_range,
    "direction of the first component, which is the motion above: from x towards z, clockwise seen from above",
    {.used = {moving, without_directions()}, .models = in_space()});
inline const NumberKey second_ratio(
    "second_ratio", &ExcitationSpec::second_ratio, component_ratio_range,
    "second horizontal component (at direction_deg + 90) over the first one: PGA over PGA; of noise standard deviation "
    "over standard deviation. 0: no second component",
    {.used = {for_motions({Motion::harmonic, Motion::pulse, Motion::tapered, Motion::noise})}, .models = in_space()});
inline const NumberKey second_phase("second_phase_deg", &ExcitationSpec::second_phase_deg, azimuth_range,
                                    "phase of the second component after that of the first: 90 makes an ellipse with "
                                    "its axes along both, 0 a straight line",
                                    {.used = {for_motions({Motion::harmonic, Motion::pulse, Motion::tapered})},
                                     .models = in_space()});
inline const NumberKey second_correlation("second_correlation", &ExcitationSpec::second_correlation, correlation_range,
                                          "correlation of both horizontal components of noise; 0: they are independent",
                                          {.used = {for_motions({Motion::noise})}, .models = in_space()});
inline const NumberKey vertical_ratio("vertical_ratio", &ExcitationSpec::vertical_ratio, component_ratio_range,
                                      "vertical component over the first one: the same motion; of noise an independent "
                                      "one, standard deviation over standard deviation. 0: no vertical component",
                                      {.used = {moving}, .models = in_space()});
inline const TableKey second(
    "second",
    "second horizontal component, which is at direction_deg + 90; {} takes the other horizontal component of the "
    "same recording",
    component_keys::all, {.absent = "no second component", .used = {sampled}, .models = in_space()});
inline const TableKey
    vertical("vertical", "vertical component, as `second`; in the time and with the factor of the first component",
             component_keys::all,
             {.absent = "by vertical_ratio", .used = {sampled}, .excludes = {"vertical_ratio"}, .models = in_space()});
inline const WordKey<OfPair> pga_of_pair("pga_of_pair", &ExcitationSpec::pga_of_pair, of_pair_names,
                                         "what the PGA of two horizontal components is: that of the first one, of the "
                                         "larger one, the geometric mean of both, "
                                         "or the largest length of their vector at once",
                                         {.used = {moving, no_list}, .models = in_space()});

inline const NumberKey tail(
    "tail_s", tail_range, "longest simulated time after the shaking",
    {.absent = "\"rest\" in fragility and sensitivity studies, which count residual displacements, and in survival "
               "studies with an observed state: until the realization lies still, at most 240 / p; else "
               "\"structure\": 12 / p, p = sqrt(3 g / (4 R)) of the whole column of each realization, R half its "
               "diagonal",
     .used = {moving},
     .words = {tail_names[0].word, tail_names[1].word}});

inline const TableKey table("excitation", "the motion of the base",
                            {&kind,
                             &duration,
                             &frequency,
                             &pga,
                             &start,
                             &end,
                             &ramp_cycles,
                             &cycles,
                             &phase,
                             &gamma,
                             &from,
                             &to,
                             &spacing,
                             &pga_of,
                             &ground_damping,
                             &low_cut,
                             &low_cut_damping,
                             &rise,
                             &strong,
                             &decay,
                             &file,
                             &run,
                             &component,
                             &unit,
                             &scale_to_pga,
                             &time_scale,
                             &baseline,
                             &band_pass,
                             &direction,
                             &second_ratio,
                             &second_phase,
                             &second_correlation,
                             &second,
                             &vertical_ratio,
                             &vertical,
                             &pga_of_pair,
                             &tail});

} // namespace excitation_keys

namespace study_keys {

inline const WordKey<StudyKind> kind("kind", &Study::kind, study_kind_names, "what the study computes",
                                     {.needed = true});
inline const TextKey title("title", &Study::title,
                           "title of pictures and pages, at most 200 bytes; not a part of the study's identity",
                           {.absent = "the name of the file"});
inline const WholeKey seed("seed", &Study::seed,
                           {0, static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())},
                           "seed of all random numbers", {.example = "1"});
inline const WholeKey realizations(
    "realizations", &Study::realizations, {1, most_realizations},
    "number of realizations: of a surface or a survival study in each cell, of a fragility study under each "
    "motion in each stripe, of a single study in all",
    {.absent = "1 for a single study; needed for a surface, a fragility and a survival study",
     .used = {in_studies({StudyKind::single, StudyKind::surface, StudyKind::fragility, StudyKind::survival})},
     .example = "32"});
inline const WordKey<Sampling> sampling("sampling", &Study::sampling, sampling_names,
                                        "independent random numbers, or scrambled Sobol points",
                                        {.used = {not_in_studies({StudyKind::fragility, StudyKind::rare})}});
inline const ListKey allow("allow", &Study::allow, {}, "plausibility checks that the study fails intentionally",
                           {.absent = "none"});
inline const TableKey table("study", "the kind of study", {&kind, &title, &seed, &realizations, &sampling, &allow});

} // namespace study_keys

namespace initial_keys {

inline const NumberKey tilt("tilt_rad", &InitialSpec::tilt_rad, initial_tilt_range,
                            "angle by which the structure leans at the start, counter-clockwise; in space towards "
                            "tilt_direction_rad");
inline const NumberKey tilt_direction("tilt_direction_rad", &InitialSpec::tilt_direction_rad, phase_range,
                                      "azimuth towards which it leans, from x towards z; pi: to the left, as "
                                      "counter-clockwise",
                                      {.models = in_space()});
inline const WholeKey tilt_from_block("tilt_from_block", &InitialSpec::tilt_from_block,
                                      {0, 199, "A block of each column, counted from 0, from the bottom."},
                                      "in each column this block and all above it lean, or are raised; 0: the whole "
                                      "column");
inline const NumberKey lift("lift_m", &InitialSpec::lift_m, {0, 10, false, "Lengths are in metres."},
                            "height above its bed from which that part falls", {.models = in_plane()});
inline const TableKey table("initial", "the start of the motion", {&tilt, &tilt_direction, &tilt_from_block, &lift},
                            {.absent = "at rest, upright"});

} // namespace initial_keys

namespace output_keys {

inline const NumberKey trajectory_rate(
    "trajectory_rate_hz", &OutputSpec::trajectory_rate_hz, {0, 1e6, true, "Samples per second."},
    "sampling rate of trajectories, also for `replay`",
    {.absent = "100 samples in 2 pi / p of the block that rocks fastest, 20 in a period of the fastest shaking, at "
               "least 100 a second"});
inline const WordKey<KeptRealizations> realizations("realizations", &Study::kept, kept_realizations_names,
                                                    "all: a row of each; none: only the counts of a surface");
inline const WholeKey trajectories(
    "trajectories",
    {0, most_realizations,
     "The number of realizations, from the first; or \"all\", or \"fit\": as many as fit into most_mb."},
    "number of realizations whose trajectories are kept, from the first; \"fit\": as many as fit into most_mb",
    {.absent = "\"fit\"", .used = {in_studies({StudyKind::single})}, .words = {trajectories_fit, trajectories_all}});
inline const NumberKey most_mb("most_mb", &OutputSpec::most_mb,
                               {0, 1e6, true, "The trajectories of a results file, in 1e6 bytes."},
                               "size of the trajectories in a results file",
                               {.used = {in_studies({StudyKind::single})}});
inline const TableKey table("output", "what is kept", {&trajectory_rate, &realizations, &trajectories, &most_mb},
                            {.absent = "the defaults of its keys"});

} // namespace output_keys

namespace outcome_keys {

inline const WordKey<Follow> follow("follow", &OutcomeSpec::follow, follow_names,
                                    "how long a realization is followed: until a block has fallen, or until all "
                                    "blocks are at rest",
                                    {.absent = "\"collapse\" for a column and in space, \"rest\" for a colonnade"});
inline const NumberKey height_fraction("height_fraction", &OutcomeSpec::collapse_height_fraction,
                                       {0.01, 0.99, false, "A fraction of the rest height.", from_percent},
                                       "a block whose centre is below this fraction of its height at rest has fallen");
inline const TableKey collapse("collapse", "when a block has fallen", {&height_fraction},
                               {.absent = "the default of its key"});
inline const NumberKey rocking_threshold("rocking_threshold_rad", &OutcomeSpec::rocking_threshold_rad,
                                         {0, 1.5, true, "Angles are in radians.", from_degrees},
                                         "largest relative rotation below which a column has not rocked");
inline const NumberKey sliding_threshold("sliding_threshold", &OutcomeSpec::sliding_threshold,
                                         {0, 100, true, "A fraction of the drum's width."},
                                         "total sliding over the drum's width below which a column has not slid");
inline const TableKey table("outcome", "the definition of outcomes",
                            {&follow, &collapse, &rocking_threshold, &sliding_threshold},
                            {.absent = "the defaults of its keys"});

} // namespace outcome_keys

namespace run_keys {

inline const Range stable_step{
    1e-6, 1, false,
    "It is a fraction of the largest safe step; a value above 1 needs run.allow_step_above_bound = true."};
inline const Range any_step{1e-6, 100, false, stable_step.hint};

inline const WordKey<Precision> precision("precision", &RunSpec::precision, precision_names,
                                          "arithmetic of the steps; single supports only the paper's model",
                                          {.models = in_plane()});
inline const NumberKey step_fraction("step_fraction", &RunSpec::step_fraction, stable_step,
                                     "time step as a fraction of the largest safe step; up to 100 with "
                                     "allow_step_above_bound; excludes step_s",
                                     {.used = {compliant()}});
inline const WordKey<StepBasis> step_bound("step_bound", &RunSpec::step_bound, step_basis_names,
                                           "whether the largest safe step is that of each block held by its "
                                           "neighbours, or of the whole structure (longer)",
                                           {.used = {compliant()}, .models = in_plane()});
inline const NumberKey step("step_s", &RunSpec::step_s, {1e-12, 1, false, "Times are in seconds.", from_ms},
                            "a fixed time step instead",
                            {.absent = "from step_fraction", .excludes = {"step_fraction"}});
inline const NumberKey accuracy("accuracy", &RunSpec::accuracy,
                                {0.001, 0.2, false, "A difference of probabilities.", from_percent},
                                "largest change of a collapse probability by the numerics: those that the study does "
                                "not give are chosen for it (form and stiffness of the contacts, step, step_bound, "
                                "precision), or the study is refused; excludes step_s and step_fraction",
                                {.absent = "none", .excludes = {"step_s", "step_fraction"}, .models = in_plane()});
inline const BooleanKey allow_step_above_bound("allow_step_above_bound", &RunSpec::allow_step_above_bound,
                                               "run even with a step above the largest safe one",
                                               {.used = {compliant()}});
inline const NumberKey max_invalid("max_invalid_fraction", &RunSpec::max_invalid_fraction,
                                   {0, 1, false, "A fraction of all realizations.", from_percent},
                                   "fraction of invalid realizations above which the exit status is 3");
inline const TableKey table("run", "the computation",
                            {&precision, &accuracy, &step_fraction, &step_bound, &step, &allow_step_above_bound,
                             &max_invalid},
                            {.absent = "the defaults of its keys"});

} // namespace run_keys
} // namespace stylobate
