#pragma once
/// The keys of the tables that belong to kinds of studies: [surface], [twins], [fragility], [sensitivity], [rare],
/// [survival]; and those of [variants] and [optimise], which `stylobate compare` reads beside the study itself, and
/// which hold tables under names of the user's.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/words.hpp"

namespace stylobate {

inline constexpr std::uint64_t most_realizations = 1'000'000'000; ///< of a study, in all

// Of a component of a record beside the first one.
namespace component_keys {

inline const TextKey file("file", &ComponentSpec::file, "its file: a path relative to the study file",
                          {.absent = "the file of the first component, or the file beside it whose name differs in the "
                                     "direction alone"});
inline const TextKey component("component", &ComponentSpec::component,
                               "which one, where the file has several: its name or its column",
                               {.absent = "by its direction"});
inline const TextKey unit("unit", &ComponentSpec::unit, "unit of its acceleration",
                          {.absent = "that of the first component, or as in the file", .words = acceleration_units});
inline const std::vector<const TomlKey*> all = {&file, &component, &unit};

} // namespace component_keys

namespace adaptive_keys {

inline const WholeKey budget("budget", &AdaptiveSpec::budget, {1, most_realizations},
                             "realizations of the whole surface; at least `minimum` in each cell",
                             {.needed = true, .example = "10000"});
inline const WholeKey minimum("minimum", &AdaptiveSpec::minimum,
                              {1, most_realizations, "Realizations of each cell; at most study.realizations."},
                              "realizations of each cell; no more than study.realizations, which is also the default "
                              "where it is smaller");
inline const NumberKey half_width("half_width", &AdaptiveSpec::half_width,
                                  {0.01, 0.25, false, "Half the width of the 95 % interval of each cell's probability.",
                                   from_percent},
                                  "half the width that the 95 % interval of each cell's probability is to have");
inline const BooleanKey pooled("borrow", &AdaptiveSpec::borrow, "use the counts of neighbouring cells too");

} // namespace adaptive_keys

namespace surface_keys {

inline const AxisKey frequency("frequency_hz", "frequency of the motion, nf values", frequency_range,
                               {"0.5", "2.0", "8", "\"log\""}, {}, {.needed = true, .used = {without_directions()}});
inline const AxisKey direction("direction_deg",
                               "direction of the first component instead of the frequency, nf values; from x towards "
                               "z, clockwise seen from above. The frequency is then that of [excitation]",
                               azimuth_range, {"0.0", "90.0", "7", "\"linear\""}, {},
                               {.absent = "the direction is that of [excitation]",
                                .used = {in_studies({StudyKind::surface})},
                                .excludes = {"frequency_hz"},
                                .models = in_space()});
inline const AxisKey pga("pga_m_s2", "PGA of the motion, np values", acceleration_range,
                         {"1.0", "8.0", "8", "\"linear\""});
inline const TableKey adaptive("adaptive", "realizations where they are needed, instead of equal numbers in each cell",
                               {&adaptive_keys::budget, &adaptive_keys::minimum, &adaptive_keys::half_width,
                                &adaptive_keys::pooled},
                               {.absent = "equal numbers in each cell", .used = {in_studies({StudyKind::surface})}});
inline const TableKey table("surface",
                            "the axes of a surface: every frequency with every PGA, or in space every direction with "
                            "every PGA",
                            {&frequency, &pga, &direction, &adaptive},
                            {.used = {in_studies({StudyKind::surface, StudyKind::survival})}});

} // namespace surface_keys

namespace twins_keys {

inline const Range move_range{0, 10, false, "Lengths are in metres; at most a quarter of the drum's width.",
                              from_lengths};
/// From far below any difference that a hand or a survey could find, up to one that both can.
inline const std::vector<double> usual_moves_m = {1e-12, 1e-9, 1e-6, 1e-3};

inline const ListKey moves("moves_m", usual_moves_m, move_range,
                           "displacements of one drum to the right, ascending, a replica for each; at most a quarter "
                           "of the drum's width, and of the default those that are");
inline const WholeKey block("block", &ReplicasSpec::block,
                            {0, 199, "A free drum, counted from 0, column by column from the bottom."},
                            "the drum that is displaced, counted from 0, column by column from the bottom",
                            {.absent = "the uppermost drum of the first column"});
inline const NumberKey step_ratio("step_ratio", 0.8,
                                  {0.01, 1, false,
                                   "A fraction of the realization's own step; 1: no replicas with another step.",
                                   from_percent},
                                  "a replica with this fraction of the realization's own step; 1: none");
inline const BooleanKey precision("precision", "a replica in single precision",
                                  {.absent = "true where single precision supports the model, else false"});
inline const BooleanKey forms("forms", true, "replicas with the other contact forms");
inline const WholeKey followed("followed", &ReplicasSpec::followed,
                               {0, most_realizations,
                                "Realizations of each cell whose displaced replicas are tracked step by step."},
                               "realizations of each cell whose displaced replicas are tracked step by step; no more "
                               "than study.realizations");
inline const NumberKey tolerance(
    "tolerance", &ReplicasSpec::tolerance,
    {1e-6, 1, false, "The separation limit of replicas: a fraction of the drums' width, and radians.", from_percent},
    "separation at which a motion is no longer predictable: a fraction of the drums' width, and radians");
inline const TableKey
    table("twins", "perturbed replicas of every realization of a surface",
          {&moves, &block, &step_ratio, &precision, &forms, &followed, &tolerance},
          {.absent = "no replicas", .used = {in_studies({StudyKind::surface})}, .models = in_plane()});

} // namespace twins_keys

namespace fragility_keys {

inline const Condition by_stripes = where("fragility.method", fragility_method_names, {FragilityMethod::stripes});
inline const Condition by_cloud = where("fragility.method", fragility_method_names, {FragilityMethod::cloud});
inline const Condition recorded = for_motions({ExcitationKind::record});
inline const Condition drawn = for_motions({ExcitationKind::ricker, ExcitationKind::pulse, ExcitationKind::tapered,
                                            ExcitationKind::sweep, ExcitationKind::noise});

inline constexpr std::uint64_t most_motions = 100'000;
inline const Range period_range{0.01, 20, false, "Periods are in seconds.", from_ms};
inline const Range part_range{0, 100, true, "A fraction of the width.", from_percent};
/// Of all measures; each has its own (`range_of` in io/study/study_fragility.cpp).
inline const Range intensity_range{0, 10000, true, ""};

inline const WordKey<FragilityMethod> method("method", &FragilitySpec::method, fragility_method_names,
                                             "stripes: every motion is scaled to each intensity; cloud: every motion "
                                             "once, as recorded");
inline const TextKey file("file", &RecordSpec::file, "the record: a path relative to the study file",
                          {.needed = true, .example = "\"record.at2\""});
inline const TextKey component("component", &RecordSpec::component, "which one, where the file has several",
                               {.absent = "the only one"});
inline const TextKey record_unit("unit", &RecordSpec::unit, "unit of its acceleration",
                                 {.absent = "as in the file", .words = acceleration_units});
inline const TableKey second("second", "its second horizontal component", component_keys::all,
                             {.absent = "by excitation.second", .models = in_space()});
inline const TableKey vertical("vertical", "its vertical component", component_keys::all,
                               {.absent = "by excitation.vertical", .models = in_space()});
inline const TableKey records("records", "the records; fewer than 8 give shares without intervals; or give `folder`",
                              {&file, &component, &record_unit, &second, &vertical},
                              {.absent = "the files of `folder`", .used = {recorded}}, KeyType::tables);
inline const TextKey folder("folder",
                            "folder of the records: every horizontal component of its files is a motion; files without "
                            "accelerations are left out and listed",
                            {.absent = "the records of `records`", .used = {recorded}, .example = "\"records\""});
inline const TextKey pattern("pattern", "names of the files in the folder, as a shell pattern",
                             {.absent = "\"*\"", .used = {recorded}});
inline const TextKey unit("unit", "unit of the accelerations of the files in the folder",
                          {.absent = "as in each file", .used = {recorded}, .words = acceleration_units});
inline const WholeKey motions("motions", &FragilitySpec::motions,
                              {1, most_motions,
                               "Motions drawn from the seed. The interval of a curve is estimated from their scatter: "
                               "below 8 there is none, 20 are few, 100 are sufficient."},
                              "number of synthetic motions: 20 are few, 100 are sufficient",
                              {.needed = true, .used = {drawn}, .example = "40"});
inline const WordKey<IntensityMeasure> measure("measure", &FragilitySpec::measure, intensity_measure_names,
                                               "the intensity measure to which motions are scaled");
inline const NumberKey period("period_s", &FragilitySpec::period_s, period_range,
                              "period of the spectral acceleration, for measure = \"sa\"",
                              {.absent = "needed for \"sa\", not used otherwise"});
inline const AxisKey intensity("intensity",
                               "the stripes: intensities to which every motion is scaled, in m/s2 (pga, sa), m/s (pgv, "
                               "arias, cav) or m (pgd)",
                               intensity_range, {"1.0", "10.0", "8", "\"log\""}, {&measure, &period},
                               {.used = {by_stripes}});
inline const WordKey<OfPair> of_pair("of_pair", &FragilitySpec::of_pair, of_pair_names,
                                     "what an intensity measure of two horizontal components is: that of the first "
                                     "one, the larger one, the geometric mean of both, or that of their vector at once "
                                     "(of spectral accelerations RotD100)",
                                     {.models = in_space()});
inline const NumberKey scale("scale", &FragilitySpec::scale, {0, 100, true, "The scale factor of every motion."},
                             "factor on every motion", {.used = {by_cloud}});
inline const WholeKey shakings("shakings", &FragilitySpec::shakings, {1, 100, "Shakings in a sequence."},
                               "number of shakings, one after the other: the next finds what the last has displaced");
inline const NumberKey pause("pause_s", &FragilitySpec::pause_s, {0, 1000, false, "Times are in seconds.", from_ms},
                             "time between two shakings of a sequence",
                             {.absent = "until it rests: 120 / p, p = sqrt(3 g / (4 R)), R half the diagonal of a "
                                        "column"});
inline const WholeKey contacts("contacts", &FragilitySpec::contacts,
                               {1, most_realizations, "Structures of the same geometry with different contacts."},
                               "structures of the same geometry with different contacts; its product with `twins` "
                               "divides study.realizations");
inline const WholeKey twins("twins", &FragilitySpec::twins,
                            {1, most_realizations,
                             "Structures that differ only by fragility.twin_m: the effect of chaos."},
                            "structures of the same geometry and contacts that differ by `twin_m` only");
inline const NumberKey twin("twin_m", &FragilitySpec::twin_m,
                            {0, 1e-3, true, "The displacement of a perturbed replica, in metres."},
                            "standard deviation of their drums' displacements");
inline const ListKey peak_limits("peak_limits", &FragilitySpec::peak_limits, part_range,
                                 "limit states: largest displacement of the top over the width of the column, "
                                 "ascending");
inline const ListKey residual_limits("residual_limits", &FragilitySpec::residual_limits, part_range,
                                     "limit states: residual dislocation of a joint over its width, ascending");
inline const ListKey periods("periods_s", &FragilitySpec::periods_s, period_range,
                             "periods at which spectral accelerations are measured, ascending");
inline const TableKey table("fragility", "the motions, their intensities and the limit states of a fragility study",
                            {&method, &records, &folder, &pattern, &unit, &motions, &intensity, &of_pair, &scale,
                             &shakings, &pause, &contacts, &twins, &twin, &peak_limits, &residual_limits, &periods},
                            {.used = {in_studies({StudyKind::fragility})}});

} // namespace fragility_keys

namespace sensitivity_keys {

inline const WordKey<SensitivityMethod> method("method", &FactorDesign::method, sensitivity_method_names,
                                               "Sobol's indices, or Morris' screening");
inline const WholeKey samples("samples", &FactorDesign::samples, {2, most_realizations}, "rows of the design",
                              {.needed = true, .example = "256"});
inline const WholeKey inner("inner", &FactorDesign::inner, {1, 10000, "Realizations at each point of the design."},
                            "realizations at each point of the design",
                            {.absent = "4; or 1 where every perturbed quantity is a factor"});
inline const ListKey factors("factors", &FactorDesign::factors, {},
                             "perturbed quantities whose influence is estimated; of a mechanism MECHANISM_PARAMETER",
                             {.absent = "all of [perturbation]"});
inline const TableKey table("sensitivity", "the design of a sensitivity study", {&method, &samples, &inner, &factors},
                            {.used = {in_studies({StudyKind::sensitivity})}});

} // namespace sensitivity_keys

namespace rare_keys {

inline const WholeKey samples(
    "samples", &RareSpec::samples,
    {200, 1'000'000,
     "Realizations of each level; a tenth of them is the number of chains. With fewer, some repeats are often 0."},
    "realizations of each level of the subset simulation; a tenth of them is the number of chains");
inline const WholeKey repeats("repeats", &RareSpec::repeats,
                              {5, 1000, "Independent repeats: their scatter gives the interval."},
                              "independent repeats: their scatter gives the interval; a pilot that chooses the levels "
                              "comes first and is not counted");
inline const TableKey table("rare", "the subset simulation of a rare collapse", {&samples, &repeats},
                            {.absent = "the defaults of its keys", .used = {in_studies({StudyKind::rare})}});

} // namespace rare_keys

namespace survival_keys {

inline constexpr std::uint64_t most_joints = 199; ///< of a structure, counted from 0
inline constexpr std::uint64_t most_built = 24;   ///< sums of alternating sign keep nine digits

inline const Range offset_range{-10, 10, false, "Lengths are in metres, positive to the right.", from_lengths};
inline const Range tolerance_range{0, 10, true, "Lengths are in metres.", from_lengths};
inline const Range angle_range{-1.5, 1.5, false, "Angles are in radians, counter-clockwise.", from_degrees};
inline const Range angle_tolerance_range{0, 1.5, true, "Angles are in radians.", from_degrees};

inline const ListKey joints("joints", &ObservedState::joints,
                            {0, most_joints, false, "Joints are counted from 0, column by column from the bottom."},
                            "the joints that were measured, ascending; joint 0 is the bed of the lowest free drum",
                            {.absent = "all, where tolerance_m is given"});
inline const ListKey joint_offset("joint_offset_m", &ObservedState::offset_m, offset_range,
                                  "displacement of the upper face of each of them along the lower one since it was "
                                  "built, positive to the right",
                                  {.absent = "0 of each: as new"});
inline const NumberKey tolerance("tolerance_m", &ObservedState::tolerance_m, tolerance_range,
                                 "largest difference between the true and the measured displacement",
                                 {.absent = "displacements were not measured", .example = "0.002"});
inline const ListKey rotation("rotation_rad", &ObservedState::rotation_rad, angle_range,
                              "rotation of each free block from upright, in the plane, counter-clockwise",
                              {.absent = "not measured"});
inline const NumberKey rotation_tolerance("rotation_tolerance_rad", &ObservedState::tolerance_rad,
                                          angle_tolerance_range,
                                          "largest difference between the true and the measured rotation",
                                          {.absent = "rotations were not measured"});
inline const BooleanKey mirrored("mirrored", &ObservedState::mirrored,
                                 "the sense of the shaking is not known: the mirrored state agrees too");
inline const TableKey observed("observed",
                               "the state in which the structure is found; `tolerance_m` alone: as new, within that",
                               {&joints, &joint_offset, &tolerance, &rotation, &rotation_tolerance, &mirrored},
                               {.absent = "it is only known that the structure stands"});

inline const WordKey<PastPrior> prior("prior", &SurvivalSpec::prior, past_prior_names,
                                      "density over the PGA of the past: flat in its logarithm, flat, or in "
                                      "proportion to the rates of `hazard`; the frequency is flat in its logarithm");
inline const NumberKey level("level", &SurvivalSpec::level,
                             {0.5, 0.999, false, "A probability: 95 % is 0.95.", from_percent},
                             "of exclusions and of credible intervals");
inline const WholeKey events("events", &SurvivalSpec::events,
                             {1, 20, "Events in succession, each of the same frequency and PGA."},
                             "pasts of one event, of two in succession, and so on up to this number are computed");
inline const NumberKey pause("pause_s", &SurvivalSpec::pause_s, {0, 1000, false, "Times are in seconds.", from_ms},
                             "time between two events of a past",
                             {.absent = "until it rests: 120 / p, p = sqrt(3 g / (4 R)), R half the diagonal of a "
                                        "column"});
inline const WholeKey monuments("monuments", &SurvivalSpec::monuments, {0, 10'000, "Simulated monuments; 0: no test."},
                                "simulated monuments of known past, by which the credible intervals are tested; "
                                "exclusions are calibrated on as many at each PGA");
inline const WholeKey structure("structure", &SurvivalSpec::structure,
                                {1, 1000, "Structures of a site are counted from 1."},
                                "number of this structure at its site: structures of one site have the same "
                                "study.seed, and so the same motions, and each draws its own properties by its number");
inline const WholeKey per_motion("structures_per_motion", &SurvivalSpec::per_motion,
                                 {1, 1000, "Structures that have been through the same motion."},
                                 "so many realizations of a cell have the same motion; divides study.realizations");
inline const WholeKey built("built", &SurvivalSpec::built, {1, most_built, "Structures that were built alike."},
                            "structures that were built alike beside this one, itself included; at most "
                            "`structures_per_motion`");
inline const WholeKey standing("standing", &SurvivalSpec::standing, {1, most_built, "Structures that stand."},
                               "how many of them stand, itself included");
inline const NumberKey stands_for("stands_for_years", &SurvivalSpec::stands_for_years,
                                  {0, 1e7, true, "Times are in years."},
                                  "how long the structure has stood: updates the rates of `hazard`",
                                  {.absent = "not known, or not used"});

inline const NumberKey k0("k0_per_year", &HazardSpec::k0_per_year, {0, 1000, true, "A rate per year."},
                          "annual rate at which a PGA of 1 m/s2 is exceeded; the rate of a is k0_per_year a^-k",
                          {.absent = "give the points of the hazard curve", .example = "0.02"});
inline const NumberKey k("k", &HazardSpec::k, {0, 20, true, "The slope of a hazard curve; mostly 1 to 4."},
                         "slope of the hazard curve in logarithms",
                         {.absent = "needed beside k0_per_year", .example = "2.5"});
inline const ListKey intensities("intensity_m_s2", &HazardSpec::intensity_m_s2, acceleration_range,
                                 "PGA of the points of a hazard curve, ascending; between them the rate is a power of "
                                 "the PGA",
                                 {.absent = "give k0_per_year or a file"});
inline const ListKey rates("rate_per_year", &HazardSpec::rate_per_year, {0, 1000, true, "Rates per year."},
                           "annual rate at which each of them is exceeded, descending",
                           {.absent = "give k0_per_year or a file"});
inline const TextKey file("file",
                          "a hazard curve of PGA: a CSV file with the columns pga_m_s2 (or pga_g) and "
                          "annual_frequency, or one of OpenQuake (CSV, NRML); a path relative to the study file",
                          {.absent = "give k0_per_year or the points"});
inline const TextKey site("site", "of several in the file: \"LON,LAT\", or its number from 0",
                          {.absent = "the file has one"});
inline const NumberKey sigma_ln("sigma_ln", &HazardSpec::sigma_ln, sigma_ln_range,
                                "prior of the factor on all rates: lognormal with median 1 and this standard "
                                "deviation of its logarithm",
                                {.needed = true, .example = "1.0"});
inline const TableKey hazard("hazard", "the rates of shaking at the site, which are updated by `stands_for_years`",
                             {&k0, &k, &intensities, &rates, &file, &site, &sigma_ln}, {.absent = "no rates"});

inline const TableKey
    table("survival", "past shaking, inferred from the state of a structure",
          {&observed, &prior, &level, &events, &pause, &monuments, &structure, &per_motion, &built, &standing,
           &stands_for, &hazard},
          {.absent = "the defaults of its keys", .used = {in_studies({StudyKind::survival})}, .models = in_plane()});

} // namespace survival_keys

namespace variants_keys {

inline const TableKey any("NAME",
                          "a variant: KEY = VALUE for any key of the study, in quotes where it has dots, as in "
                          "{ \"contact.friction\" = 0.4 }",
                          {}, {.absent = "no variant"}, KeyType::named);
inline const TableKey table("variants",
                            "studies that `stylobate compare` compares with this one: each is this one with other "
                            "values of some keys; `run` runs this one alone",
                            {&any}, {.absent = "no variants"});

} // namespace variants_keys

namespace optimise_keys {

inline const Range any_number{-1e30, 1e30};

inline const TextKey minimise("minimise", "the limit state whose probability is to be smallest",
                              {.absent = "\"collapse\""});
inline const TextKey hazard("hazard",
                            "of a fragility study by stripes: a file with the hazard curve of the site, beside the "
                            "study file, or a power law such as \"k0=1e-4,k=2.5,measure=pga_g\", as `stylobate risk` "
                            "takes it; the annual frequency of the limit state is then to be smallest",
                            {.absent = "the probability is to be smallest"});
inline const WholeKey budget("budget", 20000, {1, most_realizations, "Realizations of the whole search."},
                             "realizations of the whole search; each point runs those of the study");
inline const NumberKey from("from", any_number, "smallest value");
inline const NumberKey to("to", any_number, "largest value");
inline const WordKey<Spacing> spacing("spacing", Spacing::linear, spacing_names,
                                      "equal steps are equal differences, or equal ratios");
inline const TableKey any("KEY", "a number of the study to choose, in quotes where it has dots; one to three of them",
                          {&from, &to, &spacing}, {.absent = "nothing to choose"}, KeyType::named);
inline const TableKey table("optimise", "numbers of the study that `stylobate compare --search` chooses",
                            {&minimise, &hazard, &budget, &any}, {.absent = "no search"});

} // namespace optimise_keys

} // namespace stylobate
