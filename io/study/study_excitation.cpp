#include "io/study/study_excitation.hpp"

#include "io/study/study_names.hpp"
#include "io/study/study_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::vector<std::string> excitation_keys(ExcitationKind kind)
{
    switch (kind) {
    case ExcitationKind::none:
        return {"kind", "duration_s"};
    case ExcitationKind::harmonic:
        return {"kind", "frequency_hz", "pga_m_s2", "start", "end", "ramp_cycles", "cycles", "phase_rad", "tail_s"};
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
    case ExcitationKind::ricker:
        return {"kind", "frequency_hz", "pga_m_s2", "tail_s"};
    case ExcitationKind::pulse:
        return {"kind", "frequency_hz", "pga_m_s2", "phase_rad", "gamma", "tail_s"};
    case ExcitationKind::tapered:
        return {"kind", "frequency_hz", "pga_m_s2", "ramp_cycles", "cycles", "phase_rad", "tail_s"};
    case ExcitationKind::sweep:
        return {"kind", "from_hz", "to_hz", "spacing", "duration_s", "pga_m_s2", "ramp_cycles", "tail_s"};
    case ExcitationKind::noise:
        return {"kind",          "frequency_hz",          "pga_m_s2", "pga_of",   "ground_damping_ratio",
                "low_cut_ratio", "low_cut_damping_ratio", "rise_s",   "strong_s", "decay_s",
                "tail_s"};
    case ExcitationKind::table:
        return {"kind", "file", "run", "scale_to_pga_m_s2", "time_scale", "tail_s"};
    case ExcitationKind::record:
        break;
    }
    return {"kind",       "file",     "component",    "unit",  "scale_to_pga_m_s2",
            "time_scale", "baseline", "band_pass_hz", "tail_s"};
}

/// @param ramps that must fit into the cycles
void check_ramps(const KeyReader& keys, int ramps, const ExcitationSpec& e, double cycles)
{
    if (ramps * e.ramp_cycles <= cycles)
        return;
    const auto what = fmt::format("does not fit: {} of {} cycles each in {} cycles",
                                  ramps == 2 ? "two ramps" : "a ramp", e.ramp_cycles, cycles);
    const char* todo = e.kind == ExcitationKind::harmonic
                           ? "Give more cycles or shorter ramps, or start or end = \"abrupt\"."
                       : e.kind == ExcitationKind::sweep ? "Give a longer duration_s or shorter ramps."
                                                         : "Give more cycles or shorter ramps.";
    for (const char* key : {"ramp_cycles", "cycles", "duration_s"})
        if (keys.has(key))
            keys.refuse(key, what, todo);
}

void read_harmonic(const KeyReader& keys, ExcitationSpec& e)
{
    e.start = keys.choice_or("start", edge_names, e.start);
    e.end = keys.choice_or("end", edge_names, e.end);
    e.ramp_cycles = keys.number_or("ramp_cycles", cycles_range, e.ramp_cycles);
    e.cycles = keys.number_or("cycles", cycles_range, e.cycles);
    e.phase_rad = keys.number_or("phase_rad", phase_range, e.phase_rad);
    check_ramps(keys, (e.start == HarmonicEdge::smooth ? 1 : 0) + (e.end == HarmonicEdge::smooth ? 1 : 0), e, e.cycles);
}

void read_tapered(const KeyReader& keys, ExcitationSpec& e)
{
    e.ramp_cycles = keys.number_or("ramp_cycles", taper_range, e.ramp_cycles);
    e.cycles = keys.number_or("cycles", cycles_range, e.cycles);
    e.phase_rad = keys.number_or("phase_rad", phase_range, e.phase_rad);
    check_ramps(keys, 2, e, e.cycles);
}

void read_sweep(const KeyReader& keys, ExcitationSpec& e)
{
    e.from_hz = keys.number("from_hz", frequency_range);
    e.to_hz = keys.number("to_hz", frequency_range);
    if (e.from_hz == e.to_hz)
        keys.refuse("to_hz", "is from_hz too", "Give two frequencies, or excitation.kind = \"harmonic\".");
    e.spacing = keys.choice_or("spacing", spacing_names, e.spacing);
    e.duration_s = keys.number("duration_s", duration_range);
    e.ramp_cycles = keys.number_or("ramp_cycles", cycles_range, e.ramp_cycles);
    const double cycles =
        e.duration_s *
        (e.spacing == Spacing::log ? (e.to_hz - e.from_hz) / std::log(e.to_hz / e.from_hz) : (e.from_hz + e.to_hz) / 2);
    if (!cycles_range.contains(cycles))
        keys.refuse("duration_s", fmt::format("makes {:.0f} cycles, more than {:.0f}", cycles, cycles_range.high),
                    "Give a shorter sweep or lower frequencies.");
    check_ramps(keys, 2, e, cycles);
}

void read_noise(const KeyReader& keys, ExcitationSpec& e)
{
    e.pga_of = keys.choice_or("pga_of", pga_of_names, e.pga_of);
    e.ground_damping_ratio = keys.number_or("ground_damping_ratio", filter_damping_range, e.ground_damping_ratio);
    e.low_cut_ratio = keys.number_or("low_cut_ratio", low_cut_ratio_range, e.low_cut_ratio);
    e.low_cut_damping_ratio = keys.number_or("low_cut_damping_ratio", filter_damping_range, e.low_cut_damping_ratio);
    e.rise_s = keys.number_or("rise_s", rise_range, e.rise_s);
    e.strong_s = keys.number_or("strong_s", strong_range, e.strong_s);
    e.decay_s = keys.number_or("decay_s", rise_range, e.decay_s);
}

/// What records and tables share. @param what is in the file
void read_sampled(const KeyReader& keys, const char* what, StudyKind kind, ExcitationSpec& e)
{
    if (kind != StudyKind::fragility) {
        if (!keys.has("file"))
            keys.missing("file", fmt::format("Name {} here, or on the command line: --set excitation.file=PATH", what));
        e.file = keys.text("file");
    }
    if (kind != StudyKind::surface && kind != StudyKind::fragility)
        e.pga_m_s2 = keys.number_or("scale_to_pga_m_s2", acceleration_range, e.pga_m_s2);
    if (kind != StudyKind::surface)
        e.time_scale = keys.number_or("time_scale", time_scale_range, e.time_scale);
}

void read_record(const KeyReader& keys, StudyKind kind, ExcitationSpec& e)
{
    read_sampled(keys, "the record", kind, e);
    e.component = keys.text_or_empty("component");
    e.unit = acceleration_unit(keys);
    e.baseline = keys.boolean_or("baseline", e.baseline);
    if (const auto corners = keys.maybe_interval("band_pass_hz", corner_range)) {
        if (!e.baseline)
            keys.refuse("band_pass_hz", "is not used by excitation.baseline = false",
                        "The filter is a part of the correction: remove it, or give baseline = true.");
        e.band_pass = BandPass{(*corners)[0], (*corners)[1]};
    }
}

/// Of a fragility study: motions of which there can be many.
void check_fragility_source(const KeyReader& keys, const ExcitationSpec& e)
{
    const bool sine = e.kind == ExcitationKind::harmonic || e.kind == ExcitationKind::half_sine ||
                      e.kind == ExcitationKind::full_sine;
    if (sine || e.kind == ExcitationKind::table)
        keys.refuse("kind", "is no ground motion of a fragility study",
                    "Give \"record\", with fragility.records or fragility.folder, or \"pulse\", \"noise\", "
                    "\"ricker\", \"tapered\" or \"sweep\".");
    for (const char* key : {"file", "component", "unit", "scale_to_pga_m_s2", "pga_m_s2", "pga_of"})
        if (keys.has(key))
            keys.refuse(key, "is not used by study.kind = \"fragility\"",
                        "Remove it: the motions and their intensities are given by [fragility].");
}

} // namespace

std::string acceleration_unit(const KeyReader& keys)
{
    if (!keys.has("unit"))
        return {};
    const std::vector<std::string> units = {"m/s2", "cm/s2", "gal", "mm/s2", "g"};
    const std::string& unit = units[keys.word_index("unit", units)];
    return unit == "gal" ? "cm/s2" : unit; // one name for one unit, so that equal studies have equal texts
}

ExcitationSpec read_excitation(const KeyReader& keys, StudyKind kind)
{
    std::vector<std::string> known;
    for (const auto& name : excitation_kind_names)
        for (std::string& key : excitation_keys(name.value))
            if (std::find(known.begin(), known.end(), key) == known.end())
                known.push_back(std::move(key));
    keys.allow_only(known);
    ExcitationSpec e;
    e.kind = keys.choice("kind", excitation_kind_names);
    keys.refuse_unused(excitation_keys(e.kind),
                       fmt::format("excitation.kind = \"{}\"", word_for(excitation_kind_names, e.kind)));
    if (kind != StudyKind::single && e.kind == ExcitationKind::none)
        keys.refuse("kind", fmt::format("has no motion, but study.kind is \"{}\"", word_for(study_kind_names, kind)),
                    "Give another excitation, or study.kind = \"single\".");
    if (kind == StudyKind::fragility)
        check_fragility_source(keys, e);
    if (kind == StudyKind::surface) {
        for (const char* key : {"frequency_hz", "pga_m_s2", "scale_to_pga_m_s2", "time_scale"})
            if (keys.has(key))
                keys.refuse(key, "is not used by study.kind = \"surface\"",
                            "Remove it: frequency and PGA are given by the axes of [surface].");
    }
    if (e.kind == ExcitationKind::none) {
        e.duration_s = keys.number("duration_s", duration_range);
        return e;
    }
    if (e.kind != ExcitationKind::record && e.kind != ExcitationKind::table && kind != StudyKind::surface) {
        if (e.kind != ExcitationKind::sweep)
            e.frequency_hz =
                keys.number("frequency_hz", e.kind == ExcitationKind::noise ? noise_frequency_range : frequency_range);
        // the motions of a fragility study are scaled later
        e.pga_m_s2 = kind == StudyKind::fragility ? 1 : keys.number("pga_m_s2", acceleration_range);
    }
    switch (e.kind) {
    case ExcitationKind::none:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
    case ExcitationKind::ricker:
        break;
    case ExcitationKind::harmonic:
        read_harmonic(keys, e);
        break;
    case ExcitationKind::pulse:
        e.phase_rad = keys.number_or("phase_rad", phase_range, e.phase_rad);
        e.gamma = keys.number_or("gamma", gamma_range, e.gamma);
        break;
    case ExcitationKind::tapered:
        read_tapered(keys, e);
        break;
    case ExcitationKind::sweep:
        read_sweep(keys, e);
        break;
    case ExcitationKind::noise:
        read_noise(keys, e);
        break;
    case ExcitationKind::record:
        read_record(keys, kind, e);
        break;
    case ExcitationKind::table:
        read_sampled(keys, "the table of samples", kind, e);
        e.run = keys.text_or_empty("run");
        break;
    }
    if (const TomlValue* tail = keys.find("tail_s");
        tail == nullptr || tail->type != TomlValue::Type::string || tail->text != tail_of_structure)
        e.tail_s = keys.maybe_number("tail_s", tail_range);
    return e;
}

void check_axes(const KeyReader& surface, const ExcitationSpec& excitation, const SurfaceSpec& axes)
{
    const Axis& frequency = axes.frequency_hz;
    if (excitation.kind != ExcitationKind::noise ||
        (noise_frequency_range.contains(frequency.from) && noise_frequency_range.contains(frequency.to)))
        return;
    surface.refuse(
        "frequency_hz",
        fmt::format("is outside {}, which excitation.kind = \"noise\" can have", noise_frequency_range.text()),
        noise_frequency_range.hint);
}

} // namespace stylobate
