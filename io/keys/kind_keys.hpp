#pragma once
/// The keys of the tables that belong to kinds of studies: [surface], [twins], [fragility], [sensitivity], [rare]; of
/// [survival] see survival_keys.hpp.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/words.hpp"

namespace stylobate {

inline constexpr std::uint64_t most_realizations = 1'000'000'000; ///< of a study, in all

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
                               {"0.5", "2.0", "8", "\"log\""});
inline const AxisKey pga("pga_m_s2", "PGA of the motion, np values", acceleration_range,
                         {"1.0", "8.0", "8", "\"linear\""});
inline const TableKey adaptive("adaptive", "realizations where they are needed, instead of equal numbers in each cell",
                               {&adaptive_keys::budget, &adaptive_keys::minimum, &adaptive_keys::half_width,
                                &adaptive_keys::pooled},
                               {.absent = "equal numbers in each cell", .used = {in_studies({StudyKind::surface})}});
inline const TableKey table("surface", "the axes of a surface: every frequency with every PGA",
                            {&frequency, &pga, &adaptive},
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
inline const TableKey table("twins", "perturbed replicas of every realization of a surface",
                            {&moves, &block, &step_ratio, &precision, &forms, &followed, &tolerance},
                            {.absent = "no replicas", .used = {in_studies({StudyKind::surface})}});

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
inline const TableKey records("records", "the records; fewer than 8 give shares without intervals; or give `folder`",
                              {&file, &component, &record_unit},
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
                            {&method, &records, &folder, &pattern, &unit, &motions, &intensity, &scale, &shakings,
                             &pause, &contacts, &twins, &twin, &peak_limits, &residual_limits, &periods},
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
} // namespace stylobate
