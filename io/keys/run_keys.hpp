#pragma once
/// The keys of [study], and of what every study has at its end: [initial], [output], [outcome], [run].

#include "ensemble/model/study.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

#include <limits>

namespace stylobate {

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
                            "angle by which the structure leans at the start, counter-clockwise");
inline const WholeKey tilt_from_block("tilt_from_block", &InitialSpec::tilt_from_block,
                                      {0, 199, "A block of each column, counted from 0, from the bottom."},
                                      "in each column this block and all above it lean; 0: the whole column");
inline const TableKey table("initial", "the start of the motion", {&tilt, &tilt_from_block},
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
                                    {.absent = "\"collapse\" for a column, \"rest\" for a colonnade"});
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
                                          "arithmetic of the steps; single supports only the paper's model");
inline const NumberKey step_fraction("step_fraction", &RunSpec::step_fraction, stable_step,
                                     "time step as a fraction of the largest safe step; up to 100 with "
                                     "allow_step_above_bound; excludes step_s",
                                     {.used = {compliant()}});
inline const WordKey<StepBasis> step_bound("step_bound", &RunSpec::step_bound, step_basis_names,
                                           "whether the largest safe step is that of each block held by its "
                                           "neighbours, or of the whole structure (longer)",
                                           {.used = {compliant()}});
inline const NumberKey step("step_s", &RunSpec::step_s, {1e-12, 1, false, "Times are in seconds.", from_ms},
                            "a fixed time step instead",
                            {.absent = "from step_fraction", .excludes = {"step_fraction"}});
inline const NumberKey accuracy("accuracy", &RunSpec::accuracy,
                                {0.001, 0.2, false, "A difference of probabilities.", from_percent},
                                "largest change of a collapse probability by the numerics: those that the study does "
                                "not give are chosen for it (form and stiffness of the contacts, step, step_bound, "
                                "precision), or the study is refused; excludes step_s and step_fraction",
                                {.absent = "none", .excludes = {"step_s", "step_fraction"}});
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
