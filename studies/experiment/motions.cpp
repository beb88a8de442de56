#include "studies/experiment/motions.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/drawn_motions.hpp"
#include "io/files/utf8.hpp"
#include "io/records/ground_motion.hpp"
#include "io/records/record.hpp"
#include "io/records/record_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

/// In a time as many times as long.
void stretch(Motion& motion, double scale)
{
    motion.dt_s *= scale;
    motion.predominant_frequency_hz /= scale;
    for (double& v : motion.velocity_m_s)
        v *= scale;
    for (double& u : motion.displacement_m)
        u *= scale * scale;
}

/// A component of a record as it drives a structure.
std::shared_ptr<const Motion> motion_of(const Record& component, const ExcitationSpec& excitation)
{
    Motion motion = make_motion(component, excitation.baseline, excitation.band_pass);
    if (excitation.time_scale != 1)
        stretch(motion, excitation.time_scale);
    return std::make_shared<const Motion>(std::move(motion));
}

/// The other components of a record in space, as the record or the excitation asks for them.
void add_components(const Study& study, const Record& first, std::size_t number, MotionSet& set)
{
    const MotionSetSpec& spec = *study.design().motions;
    const RecordSpec& record = spec.records[number];
    const auto other = [&](const std::optional<ComponentSpec>& component, const char* key, Direction direction) {
        const OtherComponent wanted{fmt::format("fragility.records[{}].{}", number, key),
                                    component.value_or(ComponentSpec{}), direction, record.unit};
        return component ? motion_of(other_component(first, wanted, pga_range(study)), study.excitation) : nullptr;
    };
    if (study.has_pairs())
        set.seconds.push_back(
            other(record.second ? record.second : study.excitation.second, "second", Direction::horizontal));
    const bool of_all = study.vertical.has_value();
    if (of_all || std::ranges::any_of(spec.records, [](const RecordSpec& each) { return each.vertical.has_value(); }))
        set.verticals.push_back(
            other(record.vertical || !of_all ? record.vertical : ComponentSpec{}, "vertical", Direction::vertical));
}

MotionSet read_motions(const Study& study)
{
    MotionSet set;
    for (const RecordSpec& record : study.design().motions->records) {
        const Record first = read_record(record.file, record.component, record.unit, pga_range(study));
        add_components(study, first, set.size(), set);
        std::string name = std::filesystem::path(record.file).filename().string();
        if (record.component)
            name += " " + *record.component;
        if (!is_plain_text(name)) // else the results, whose study has it in a comment, could not be read again
            throw InputError(
                fmt::format("{}: the name of a motion is that of its file{}, and has a line break, another "
                            "control character or a byte that is no UTF-8.\n  Rename the file.",
                            record.file, record.component ? " with its component" : ""));
        set.names.push_back(std::move(name));
        set.motions.push_back(motion_of(first, study.excitation));
    }
    return set;
}

/// That an excitation of which nothing is drawn makes the same motion again and again is seen before it is run.
void check_differ(const Study& study, const MotionSet& set)
{
    if (set.size() < 2)
        return;
    for (const auto& motion : set.motions)
        if (motion->acceleration_m_s2 != set.motions.front()->acceleration_m_s2 ||
            motion->dt_s != set.motions.front()->dt_s)
            return;
    throw InputError(
        fmt::format("fragility.motions = {}: all motions are identical because no parameter of the excitation is "
                    "random.\n  Perturb pulse_frequency, pulse_gamma or phase in [perturbation], or give "
                    "excitation.kind = \"noise\".",
                    study.design().motions->motions));
}

void measure(const MotionSetSpec& spec, MotionSet& set)
{
    const auto add = [&set](const std::string& name, double exponent) -> std::vector<double>& {
        set.measures.push_back({name, exponent, {}});
        return set.measures.back().value;
    };
    std::vector<IntensityMeasures> all;
    for (std::size_t i = 0; i < set.size(); ++i)
        all.push_back(set.second(i) ? intensity_of_pair(*set.motions[i], *set.second(i), spec.of_pair)
                                    : intensity_measures(*set.motions[i]));
    const auto field = [&](const std::string& name, double exponent, double IntensityMeasures::*member) {
        std::vector<double>& values = add(name, exponent);
        for (const IntensityMeasures& im : all)
            values.push_back(im.*member);
    };
    field("pga_m_s2", 1, &IntensityMeasures::pga_m_s2);
    field("pgv_m_s", 1, &IntensityMeasures::pgv_m_s);
    field("pgd_m", 1, &IntensityMeasures::pgd_m);
    field("arias_m_s", 2, &IntensityMeasures::arias_m_s);
    field("cav_m_s", 1, &IntensityMeasures::cav_m_s);
    std::vector<double> periods = spec.periods_s;
    if (spec.measure == IntensityMeasure::sa &&
        std::find(periods.begin(), periods.end(), spec.period_s) == periods.end())
        periods.push_back(spec.period_s);
    for (const double period : periods) {
        std::vector<double>& values = add(measure_name(IntensityMeasure::sa, period), 1);
        for (std::size_t i = 0; i < set.size(); ++i) {
            const Motion& motion = *set.motions[i];
            values.push_back(set.second(i)
                                 ? spectral_acceleration_of_pair(motion, *set.second(i), period, spec.of_pair)
                                 : spectral_acceleration(motion.acceleration_m_s2, motion.dt_s, {period}).front());
        }
    }
    field("d5_95_s", 0, &IntensityMeasures::d5_95_s);
    field("pgv_per_pga_s", 0, &IntensityMeasures::pgv_per_pga_s);
    field("mean_frequency_hz", 0, &IntensityMeasures::mean_frequency_hz);
}

} // namespace

MotionSet load_motions(const Study& study)
{
    const MotionSetSpec& spec = *study.design().motions;
    MotionSet set;
    if (spec.records.empty()) {
        set = drawn_motions(study);
        check_differ(study, set);
    } else {
        set = read_motions(study);
    }
    if (!spec.records.empty() && spec.shakings > spec.motions)
        throw InputError(fmt::format(
            "fragility.shakings = {}: there are {} records, and a sequence contains each record at most once.\n  "
            "Give fewer shakings or more records.",
            spec.shakings, spec.motions));
    measure(spec, set);
    return spec.shakings > 1 ? in_sequence(study, set) : set;
}

MotionTable motion_table(const MotionSet& set)
{
    MotionTable table;
    table.names = set.names;
    for (const MotionMeasure& measure : set.measures) {
        table.measures.push_back(measure.name);
        table.exponent.push_back(measure.exponent);
    }
    for (std::size_t i = 0; i < set.size(); ++i)
        for (const MotionMeasure& measure : set.measures)
            table.value.push_back(measure.value[i]);
    for (const std::vector<double>& ends : set.ends_s)
        table.shaking_end_s.insert(table.shaking_end_s.end(), ends.begin(), ends.end());
    return table;
}

namespace {

/// For each motion the first one that is equal to it, itself where none is.
std::vector<std::size_t> first_equal(const MotionTable& motions, double tolerance)
{
    const std::size_t n = motions.names.size(), measures = motions.measures.size();
    const auto pga = static_cast<std::size_t>(std::find(motions.measures.begin(), motions.measures.end(), "pga_m_s2") -
                                              motions.measures.begin());
    std::vector<std::size_t> first(n), order(n);
    std::iota(first.begin(), first.end(), std::size_t{0});
    if (pga >= measures || measures < 2)
        return first;
    std::vector<std::vector<double>> shape(n); // what scaling does not change
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < measures; ++k)
            if (k != pga)
                shape[i].push_back(motions.value[i * measures + k] /
                                   std::pow(motions.value[i * measures + pga], motions.exponent[k]));
    const auto near = [tolerance](double a, double b) {
        return std::fabs(a - b) <= tolerance * std::max(std::fabs(a), std::fabs(b));
    };
    order = first;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shape[a] < shape[b]; });
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n && near(shape[order[i]][0], shape[order[j]][0]); ++j)
            if (std::equal(shape[order[i]].begin(), shape[order[i]].end(), shape[order[j]].begin(), near)) {
                std::size_t a = order[i], b = order[j]; // each to the first of its group
                while (first[a] != a)
                    a = first[a];
                while (first[b] != b)
                    b = first[b];
                first[std::max(a, b)] = std::min(a, b);
            }
    for (std::size_t i = 0; i < n; ++i) // those before i point to the first of their group already
        first[i] = first[first[i]];
    return first;
}

} // namespace

MotionGroups motion_groups(const Study& study, const MotionTable& motions)
{
    MotionGroups all;
    const StudyDesign design = study.design();
    if (!design.motions)
        return all;
    all.cells = design.columns;
    all.group.resize(static_cast<std::size_t>(design.motions->motions));
    std::iota(all.group.begin(), all.group.end(), std::size_t{0});
    all.groups = all.group.size();
    if (motions.names.size() != all.group.size())
        return all;
    // files round their samples; of motions that are drawn, parameters that nearly agree are no copies
    const double tolerance = design.motions->records.empty() ? 1e-12 : 1e-4;
    all.groups = 0;
    const std::vector<std::size_t> first = first_equal(motions, tolerance);
    for (std::size_t i = 0; i < first.size(); ++i)
        all.group[i] = first[i] == i ? all.groups++ : all.group[first[i]];
    return all;
}

} // namespace stylobate
