#pragma once
/// The keys of [excitation].

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

namespace stylobate::excitation_keys {

using Motion = ExcitationKind;

inline const Condition with_frequency =
    not_for_motions({Motion::none, Motion::sweep, Motion::record, Motion::table}); // of one value
inline const Condition synthetic = not_for_motions({Motion::none, Motion::record, Motion::table});
inline const Condition sampled = for_motions({Motion::record, Motion::table});
inline const Condition moving = not_for_motions({Motion::none});
inline const Condition no_axes = not_in_studies({StudyKind::surface, StudyKind::survival});
inline const Condition one_motion = not_in_studies({StudyKind::surface, StudyKind::fragility, StudyKind::survival});
inline const Condition no_list = not_in_studies({StudyKind::fragility});

inline const WordKey<ExcitationKind> kind("kind", &ExcitationSpec::kind, excitation_kind_names,
                                          "the motion of the base", {.needed = true, .example = "\"harmonic\""});
inline const NumberKey
    duration("duration_s", &ExcitationSpec::duration_s, duration_range, "simulated time; of a sweep its length",
             {.needed = true, .used = {for_motions({Motion::none, Motion::sweep})}, .example = "10.0"});
inline const NumberKey frequency("frequency_hz", &ExcitationSpec::frequency_hz, frequency_range,
                                 "frequency of the sine or pulse; of noise that of the ground, 0.05 to 25",
                                 {.needed = true, .used = {with_frequency, no_axes}, .example = "1.0"});
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
                                  "factor by which the motion is stretched in time", {.used = {sampled, no_axes}});
inline const BooleanKey baseline("baseline", &ExcitationSpec::baseline, "correct the baseline of the record",
                                 {.used = {for_motions({Motion::record})}});
inline const ListKey band_pass("band_pass_hz", KeyType::interval, corner_range, "corners of a band-pass filter",
                               {.absent = "no filter", .used = {for_motions({Motion::record})}});
inline const NumberKey tail(
    "tail_s", tail_range, "longest simulated time after the shaking",
    {.absent = "\"rest\" in fragility and sensitivity studies, which count residual displacements, and in survival "
               "studies with an observed state: until the realization lies still, at most 240 / p; else "
               "\"structure\": 12 / p, p = sqrt(3 g / (4 R)) of the whole column of each realization, R half its "
               "diagonal",
     .used = {moving},
     .words = {tail_names[0].word, tail_names[1].word}});

inline const TableKey table(
    "excitation", "the motion of the base",
    {&kind, &duration, &frequency, &pga,    &start,          &end,        &ramp_cycles,     &cycles,    &phase,  &gamma,
     &from, &to,       &spacing,   &pga_of, &ground_damping, &low_cut,    &low_cut_damping, &rise,      &strong, &decay,
     &file, &run,      &component, &unit,   &scale_to_pga,   &time_scale, &baseline,        &band_pass, &tail});

} // namespace stylobate::excitation_keys
