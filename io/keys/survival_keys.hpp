#pragma once
/// The keys of [survival]: the state in which a structure is found, the prior, and the hazard.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

namespace stylobate::survival_keys {

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

inline const TableKey table("survival", "past shaking, inferred from the state of a structure",
                            {&observed, &prior, &level, &events, &pause, &monuments, &structure, &per_motion, &built,
                             &standing, &stands_for, &hazard},
                            {.absent = "the defaults of its keys", .used = {in_studies({StudyKind::survival})}});

} // namespace stylobate::survival_keys
