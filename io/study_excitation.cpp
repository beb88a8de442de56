#include "io/study_excitation.hpp"

#include "io/study_names.hpp"
#include "io/study_ranges.hpp"

#include <fmt/format.h>

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
        return {"kind", "frequency_hz", "pga_m_s2", "tail_s"};
    case ExcitationKind::record:
        break;
    }
    return {"kind", "file", "component", "unit", "scale_to_pga_m_s2", "time_scale", "baseline", "tail_s"};
}

void read_harmonic(const KeyReader& keys, ExcitationSpec& e)
{
    e.start = keys.choice_or("start", edge_names, e.start);
    e.end = keys.choice_or("end", edge_names, e.end);
    e.ramp_cycles = keys.number_or("ramp_cycles", cycles_range, e.ramp_cycles);
    e.cycles = keys.number_or("cycles", cycles_range, e.cycles);
    e.phase_rad = keys.number_or("phase_rad", phase_range, e.phase_rad);
    const int ramps = (e.start == HarmonicEdge::smooth ? 1 : 0) + (e.end == HarmonicEdge::smooth ? 1 : 0);
    if (ramps * e.ramp_cycles > e.cycles) {
        const auto what = fmt::format("does not fit: {} of {} cycles each in {} cycles",
                                      ramps == 2 ? "two ramps" : "a ramp", e.ramp_cycles, e.cycles);
        const char* todo = "Give more cycles or shorter ramps, or start or end = \"abrupt\".";
        for (const char* key : {"ramp_cycles", "cycles"})
            if (keys.has(key))
                keys.refuse(key, what, todo);
    }
}

void read_record(const KeyReader& keys, bool in_surface, ExcitationSpec& e)
{
    if (!keys.has("file"))
        keys.missing("file", "Name the record here, or on the command line: --set excitation.file=PATH");
    e.file = keys.text("file");
    e.component = keys.text_or_empty("component");
    if (keys.has("unit")) {
        const std::vector<std::string> units = {"m/s2", "cm/s2", "gal", "mm/s2", "g"};
        e.unit = units[keys.word_index("unit", units)];
        if (e.unit == "gal")
            e.unit = "cm/s2"; // one name for one unit, so that equal studies have equal texts
    }
    if (!in_surface) {
        e.pga_m_s2 = keys.number_or("scale_to_pga_m_s2", acceleration_range, e.pga_m_s2);
        e.time_scale = keys.number_or("time_scale", time_scale_range, e.time_scale);
    }
    e.baseline = keys.boolean_or("baseline", e.baseline);
}

} // namespace

ExcitationSpec read_excitation(const KeyReader& keys, bool in_surface)
{
    keys.allow_only({"kind", "duration_s", "frequency_hz", "pga_m_s2", "start", "end", "ramp_cycles", "cycles",
                     "phase_rad", "file", "component", "unit", "scale_to_pga_m_s2", "time_scale", "baseline",
                     "tail_s"});
    ExcitationSpec e;
    e.kind = keys.choice("kind", excitation_kind_names);
    keys.refuse_unused(excitation_keys(e.kind),
                       fmt::format("excitation.kind = \"{}\"", word_for(excitation_kind_names, e.kind)));
    if (in_surface) {
        if (e.kind == ExcitationKind::none)
            keys.refuse("kind", "shakes nothing, and study.kind is \"surface\"",
                        "Give another excitation, or study.kind = \"single\".");
        for (const char* key : {"frequency_hz", "pga_m_s2", "scale_to_pga_m_s2", "time_scale"})
            if (keys.has(key))
                keys.refuse(key, "is not used by study.kind = \"surface\"",
                            "Remove it: frequency and PGA come from the axes of [surface].");
    }
    switch (e.kind) {
    case ExcitationKind::none:
        e.duration_s = keys.number("duration_s", duration_range);
        return e;
    case ExcitationKind::record:
        read_record(keys, in_surface, e);
        break;
    case ExcitationKind::harmonic:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        if (!in_surface) {
            e.frequency_hz = keys.number("frequency_hz", frequency_range);
            e.pga_m_s2 = keys.number("pga_m_s2", acceleration_range);
        }
        if (e.kind == ExcitationKind::harmonic)
            read_harmonic(keys, e);
        break;
    }
    e.tail_s = keys.maybe_number("tail_s", tail_range);
    return e;
}

} // namespace stylobate
