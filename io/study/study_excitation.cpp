#include "io/study/study_excitation.hpp"

#include "ensemble/motion/noise_duration.hpp"
#include "io/keys/excitation_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

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
    e.start = keys.read(excitation_keys::start);
    e.end = keys.read(excitation_keys::end);
    e.ramp_cycles = keys.read(excitation_keys::ramp_cycles);
    e.cycles = keys.read(excitation_keys::cycles);
    e.phase_rad = keys.read(excitation_keys::phase);
    check_ramps(keys, (e.start == HarmonicEdge::smooth ? 1 : 0) + (e.end == HarmonicEdge::smooth ? 1 : 0), e, e.cycles);
}

void read_tapered(const KeyReader& keys, ExcitationSpec& e)
{
    e.ramp_cycles = keys.read_within(excitation_keys::ramp_cycles, taper_range);
    e.cycles = keys.read(excitation_keys::cycles);
    e.phase_rad = keys.read(excitation_keys::phase);
    check_ramps(keys, 2, e, e.cycles);
}

void read_sweep(const KeyReader& keys, ExcitationSpec& e)
{
    e.from_hz = keys.read(excitation_keys::from);
    e.to_hz = keys.read(excitation_keys::to);
    if (e.from_hz == e.to_hz)
        keys.refuse("to_hz", "is from_hz too", "Give two frequencies, or excitation.kind = \"harmonic\".");
    e.spacing = keys.read(excitation_keys::spacing);
    e.duration_s = keys.read(excitation_keys::duration);
    e.ramp_cycles = keys.read(excitation_keys::ramp_cycles);
    const double cycles =
        e.duration_s *
        (e.spacing == Spacing::log ? (e.to_hz - e.from_hz) / std::log(e.to_hz / e.from_hz) : (e.from_hz + e.to_hz) / 2);
    if (cycles > motion_cycles_range.high)
        keys.refuse("duration_s",
                    fmt::format("makes {:.0f} cycles, more than {:.0f}", cycles, motion_cycles_range.high),
                    "Give a shorter sweep or lower frequencies.");
    if (cycles < motion_cycles_range.low)
        keys.refuse("duration_s", fmt::format("makes {:.2g} cycles, less than {}", cycles, motion_cycles_range.low),
                    "Give a longer sweep or higher frequencies.");
    check_ramps(keys, 2, e, cycles);
}

void read_noise(const KeyReader& keys, ExcitationSpec& e)
{
    e.pga_of = keys.read(excitation_keys::pga_of);
    e.ground_damping_ratio = keys.read(excitation_keys::ground_damping);
    e.low_cut_ratio = keys.read(excitation_keys::low_cut);
    e.low_cut_damping_ratio = keys.read(excitation_keys::low_cut_damping);
    e.rise_s = keys.read(excitation_keys::rise);
    e.strong_s = keys.read(excitation_keys::strong);
    e.decay_s = keys.read(excitation_keys::decay);
    if (const double planned = e.rise_s + e.strong_s + noise_decays * e.decay_s; planned < shortest_noise_s)
        for (const TomlKey* key : std::initializer_list<const TomlKey*>{
                 &excitation_keys::strong, &excitation_keys::decay, &excitation_keys::rise})
            if (keys.has(*key))
                keys.refuse(key->name,
                            fmt::format("gives noise of {:.3g} s (rise_s + strong_s + {} decay_s), shorter than {} s",
                                        planned, noise_decays, shortest_noise_s),
                            "It has too few samples to be a motion: give a longer strong_s, rise_s or decay_s.");
}

/// What records and tables share. @param what is in the file
void read_sampled(const KeyReader& keys, const char* what, StudyKind kind, ExcitationSpec& e)
{
    if (kind != StudyKind::fragility) {
        if (!keys.has(excitation_keys::file))
            keys.missing("file", fmt::format("Name {} here, or on the command line: --set excitation.file=PATH", what));
        e.file = keys.read(excitation_keys::file);
    }
    if (!has_axes(kind) && kind != StudyKind::fragility)
        e.pga_m_s2 = keys.read_or(excitation_keys::scale_to_pga, e.pga_m_s2);
    if (!has_axes(kind))
        e.time_scale = keys.read(excitation_keys::time_scale);
}

void read_record(const KeyReader& keys, StudyKind kind, ExcitationSpec& e)
{
    read_sampled(keys, "the record", kind, e);
    e.component = keys.read_or(excitation_keys::component, {});
    e.unit = acceleration_unit(keys, excitation_keys::unit);
    e.baseline = keys.read(excitation_keys::baseline);
    if (const auto corners = keys.maybe_interval(excitation_keys::band_pass.name, excitation_keys::band_pass.range)) {
        if (!e.baseline)
            keys.refuse("band_pass_hz", "is not used by excitation.baseline = false",
                        "The filter is a part of the correction: remove it, or give baseline = true.");
        e.band_pass = BandPass{(*corners)[0], (*corners)[1]};
    }
}

/// Refuses keys that this kind of study does not use.
void refuse_of_other_studies(const KeyReader& keys, StudyKind kind, const char* todo)
{
    const char* word = word_for(study_kind_names, kind);
    for (const TomlKey* each : excitation_keys::table.keys)
        if (!each->used_where("study.kind", word) && keys.has(*each))
            keys.refuse(each->name, fmt::format("is not used by study.kind = \"{}\"", word), todo);
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
    refuse_of_other_studies(keys, StudyKind::fragility,
                            "Remove it: the motions and their intensities are given by [fragility].");
}

/// A number, or one of the words.
void read_tail(const KeyReader& keys, ExcitationSpec& e)
{
    const TomlValue* tail = keys.find(excitation_keys::tail.name);
    if (tail == nullptr)
        return;
    if (const auto* word = std::ranges::find_if(
            tail_names,
            [&](const auto& name) { return tail->type == TomlValue::Type::string && tail->text == name.word; });
        word != tail_names.end())
        e.tail = word->value;
    else
        e.tail_s = keys.maybe(excitation_keys::tail);
}

} // namespace

std::string acceleration_unit(const KeyReader& keys, const TextKey& key)
{
    if (!keys.has(key))
        return {};
    const std::string& unit = key.words[keys.word_index(key.name, key.words)];
    return unit == "gal" ? "cm/s2" : unit; // one name for one unit, so that equal studies have equal texts
}

ExcitationSpec read_excitation(const KeyReader& keys, StudyKind kind)
{
    ExcitationSpec e;
    e.kind = keys.read(excitation_keys::kind);
    const char* word = word_for(excitation_kind_names, e.kind);
    keys.refuse_unused(excitation_keys::table.names_where("excitation.kind", word),
                       fmt::format("excitation.kind = \"{}\"", word));
    if (kind != StudyKind::single && e.kind == ExcitationKind::none)
        keys.refuse("kind", fmt::format("has no motion, but study.kind is \"{}\"", word_for(study_kind_names, kind)),
                    "Give another excitation, or study.kind = \"single\".");
    if (kind == StudyKind::fragility)
        check_fragility_source(keys, e);
    if (has_axes(kind)) {
        refuse_of_other_studies(keys, kind, "Remove it: frequency and PGA are given by the axes of [surface].");
    }
    if (e.kind == ExcitationKind::none) {
        e.duration_s = keys.read(excitation_keys::duration);
        return e;
    }
    if (e.kind != ExcitationKind::record && e.kind != ExcitationKind::table && !has_axes(kind)) {
        if (e.kind != ExcitationKind::sweep)
            e.frequency_hz = keys.read_within(excitation_keys::frequency, e.kind == ExcitationKind::noise
                                                                              ? noise_frequency_range
                                                                              : excitation_keys::frequency.range);
        // the motions of a fragility study are scaled later
        e.pga_m_s2 = kind == StudyKind::fragility ? 1 : keys.read(excitation_keys::pga);
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
        e.phase_rad = keys.read(excitation_keys::phase);
        e.gamma = keys.read(excitation_keys::gamma);
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
        e.run = keys.read_or(excitation_keys::run, {});
        break;
    }
    read_tail(keys, e);
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
