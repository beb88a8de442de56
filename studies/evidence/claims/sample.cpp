#include "studies/evidence/claims/sample.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/contact_laws.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace stylobate::claims {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// The path of the base is summed over so many pieces of each period: the error is (pi / pieces)2 / 6 of it.
constexpr int pieces_per_cycle = 200;

/// When a motion first reaches half its PGA.
double half_peak_s(const ExcitationSpec& e, const Realization& r, const Motion* record)
{
    if (SyntheticMotion::covers(e.kind) && !r.motion) {
        const SyntheticMotion motion(e, r);
        const double dt = 1 / (motion.fastest_hz() * pieces_per_cycle);
        double t = 0;
        while (t < motion.duration_s() && std::fabs(motion.acceleration_m_s2(t)) < r.pga_m_s2 / 2)
            t += dt;
        return t;
    }
    const Motion& motion = r.motion ? *r.motion : *record;
    const auto& a = motion.acceleration_m_s2;
    const auto first = std::find_if(a.begin(), a.end(), [&](double v) { return std::fabs(v) >= motion.pga_m_s2 / 2; });
    // what each realization has of its own is in its own time
    const bool stretched = e.kind == ExcitationKind::record || e.kind == ExcitationKind::table;
    const double stretch = stretched ? record->predominant_frequency_hz / r.frequency_hz : 1;
    return static_cast<double>(first - a.begin()) * motion.dt_s * stretch;
}

double strong_start_s(const ExcitationSpec& e, const Realization& r, const Motion* record)
{
    switch (e.kind) {
    case ExcitationKind::harmonic:
        return e.start == HarmonicEdge::smooth ? e.ramp_cycles / r.frequency_hz : 0;
    case ExcitationKind::none:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        return 0;
    default:
        return half_peak_s(e, r, record);
    }
}

double base_path_m(const ExcitationSpec& e, const Realization& r, const Motion* record, double until_s)
{
    const BaseMotion motion(e, r, record);
    const double end = std::min(until_s, motion.duration_s());
    const auto pieces = static_cast<long>(std::ceil(end * r.frequency_hz * pieces_per_cycle));
    double path = 0, before = motion.displacement_m(0);
    for (long i = 1; i <= pieces; ++i) {
        const double now = motion.displacement_m(end * static_cast<double>(i) / static_cast<double>(pieces));
        path += std::fabs(now - before);
        before = now;
    }
    return path;
}

/// Without what is drawn.
Realization nominal_realization(const Study& study, const Motion* record)
{
    Study plain = study;
    plain.perturbations.clear();
    plain.mechanism_perturbations.clear();
    plain.vertical.reset(); // nothing that is asked of it moves
    return Sampler(plain, record).realization(0);
}

/// Rigid column on its lowest face: g (foot's width) / (twice the height of its centre of mass). NaN for a colonnade,
/// whose limit is no formula.
double rigid_limit(const Study& study, const Realization& r)
{
    if (study.structure.kind != StructureKind::column)
        return nan;
    double mass = 0, moment = 0;
    double bottom = std::numeric_limits<double>::infinity(), width = 0;
    for (const Block& block : r.blocks) {
        if (block.fixed)
            continue;
        mass += block.mass_kg;
        moment += block.mass_kg * block.y_m;
        if (block.y_m - block.half_height_m < bottom) {
            bottom = block.y_m - block.half_height_m;
            width = 2 * block.half_width_m;
        }
    }
    return r.gravity_m_s2 * width / (2 * (moment / mass - bottom));
}

constexpr double infinity = std::numeric_limits<double>::infinity();

bool counts(const Observation& o, const Measure& measure)
{
    return !measure.given || o.has(*measure.given, measure.within_cycles);
}

/// The largest k for which fewer than k heads in n fair throws have at most the probability `tail`; 0 if there is none.
std::size_t rank_of_tail(std::size_t n, double tail)
{
    const auto log_factorial = [](std::size_t i) { return log_gamma(static_cast<double>(i) + 1); };
    double sum = 0; // of the chances of fewer than k heads
    std::size_t k = 0;
    while (k < n) {
        sum += std::exp(log_factorial(n) - log_factorial(k) - log_factorial(n - k) -
                        static_cast<double>(n) * std::numbers::ln2);
        if (sum > tail)
            break;
        ++k;
    }
    return k;
}

namespace fs = std::filesystem;

/// A name for a file: letters, digits, points, minus and plus stay.
std::string file_name(std::string text)
{
    for (char& c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
                           c == '-' || c == '+';
        if (!plain)
            c = '_';
    }
    return text + ".h5";
}

bool ratio_needed(const ClaimFile& file)
{
    const auto is_ratio = [](const Measure& m) {
        return m.kind == Measure::Kind::median &&
               (m.amount == Amount::top_path_ratio || m.amount == Amount::face_path_ratio);
    };
    return std::any_of(file.tests.begin(), file.tests.end(),
                       [&](const Test& test) { return is_ratio(test.criterion.measure); }) ||
           std::any_of(file.figures.begin(), file.figures.end(), [&](const Figure& figure) {
               return std::any_of(figure.measures.begin(), figure.measures.end(), is_ratio);
           });
}

/// A result file of this study: complete, to be continued, or not there (what lay in its place has been removed).
enum class Found { complete, unfinished, nothing };

Found look_for(const fs::path& results, const ResultHeader& header)
{
    if (!fs::exists(results))
        return Found::nothing;
    try {
        const ResultReader reader(results);
        if (reader.header().study_toml == header.study_toml) {
            if (reader.complete())
                return Found::complete;
            if (reader.header().code_version == header.code_version)
                return Found::unfinished;
        }
    } catch (const InputError&) {
        // damaged, or no result at all: computed anew
    }
    fs::remove(results);
    return Found::nothing;
}

/// @return whether all realizations are done
bool compute(const LoadedStudy& loaded, const fs::path& results, bool resume, const RunOptions& options,
             Observer& observer)
{
    const ResultHeader header = loaded.result_header();
    SurfaceCounts counts(header);
    const std::unique_ptr<ResultWriter> writer =
        resume ? ResultWriter::resume(results, header) : ResultWriter::create(results, header);
    RunPlan plan;
    plan.total = loaded.study().total();
    if (resume)
        ResultReader(results).for_each_row([&](const ResultRow& row) { counts.add(row); });
    plan.mark_done([&](std::uint64_t index) { return writer->state(index); });
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(loaded.study(), realization, outcome);
        writer->add(row);
        counts.add(row);
    };
    const Progress progress = run_ensemble(loaded.experiment(), options, plan, observer);
    if (progress.done < progress.total) {
        writer->flush();
        return false;
    }
    const SurfaceTable table = counts.table();
    writer->finish(loaded.study().surface ? &table : nullptr);
    return true;
}

/// Where the record of a study lies; nothing if the study has none or it is found without help.
std::vector<std::string> record_setting(const Study& study, const RunPlace& place)
{
    const ExcitationKind kind = study.excitation.kind;
    const bool in_file = kind == ExcitationKind::record || kind == ExcitationKind::table;
    if (!in_file || fs::path(study.excitation.file).is_absolute())
        return {};
    return {"excitation.file=" + fs::absolute(place.data / study.excitation.file).lexically_normal().string()};
}

/// The study of a variant, under the contact law that its levels name.
LoadedStudy load(const std::string& file, const std::vector<std::string>& settings,
                 const std::optional<std::string>& law)
{
    if (!law)
        return LoadedStudy::from_file(file, settings);
    for (ContactLaw& one : contact_laws(read_study(file, settings)))
        if (one.name == law) {
            if (!one.study)
                throw InputError(file, 0, fmt::format("law = \"{}\" does not apply: {}", *law, one.why_not));
            Motions motions = motions_of(*one.study);
            return LoadedStudy(Experiment(std::move(*one.study), std::move(motions)));
        }
    throw InputError(file, 0,
                     fmt::format("law = \"{}\" is no contact law.\n  Known: softer, stiffer, rigid, ends, "
                                 "centroid.",
                                 *law));
}

/// @pre the rows are of this study; invalid ones are counted and left out
Sample make_sample(const Study& study, const Sampler& sampler, const Motion* record, const std::vector<ResultRow>& rows,
                   bool path_needed)
{
    Sample sample;
    const Realization nominal = nominal_realization(study, record);
    sample.f1_hz = study.contact.form == ContactForm::rigid ? std::numeric_limits<double>::infinity()
                                                            : first_mode_of_paper(nominal).frequency_hz;
    sample.rigid_m_s2 = rigid_limit(study, nominal);
    if (study.surface) {
        for (int i = 0; i < study.surface->frequency_hz.count; ++i)
            sample.frequency_hz.push_back(study.surface->frequency_hz.value(i));
        for (int i = 0; i < study.surface->pga_m_s2.count; ++i)
            sample.pga_m_s2.push_back(study.surface->pga_m_s2.value(i));
    } else {
        sample.frequency_hz = {nominal.frequency_hz};
        sample.pga_m_s2 = {nominal.pga_m_s2};
    }
    sample.cells.resize(sample.frequency_hz.size() * sample.pga_m_s2.size());
    for (const ResultRow& row : rows) {
        if (row.outcome.state == State::invalid)
            ++sample.invalid;
        else
            sample.cells.at(row.cell).push_back(
                observe(study, sampler.realization(row.index), record, row.outcome, path_needed));
    }
    for (std::vector<Observation>& cell : sample.cells)
        std::sort(cell.begin(), cell.end(),
                  [](const Observation& a, const Observation& b) { return a.index < b.index; });
    return sample;
}

} // namespace

bool Observation::has(Event event, double within_cycles) const
{
    switch (event) {
    case Event::rocked:
        return rocked;
    case Event::slid:
        return slid;
    case Event::collapsed:
        return collapsed;
    case Event::stood:
        return !rocked && !slid && !collapsed;
    case Event::rocked_only:
        return rocked && !slid;
    case Event::slid_only:
        return slid && !rocked;
    case Event::rocked_and_slid:
        return rocked && slid;
    case Event::rocked_or_slid:
        return rocked || slid;
    case Event::collapsed_early:
        return collapsed && cycles_to_collapse <= within_cycles;
    case Event::upright:
        break;
    }
    return !collapsed;
}

Observation observe(const Study& study, const Realization& realization, const Motion* record, const Outcome& o,
                    bool path_needed)
{
    Observation seen;
    seen.index = realization.index;
    seen.collapsed = o.state == State::collapsed;
    seen.rocked = seen.collapsed || o.max_relative_rotation_rad > study.outcome.rocking_threshold_rad;
    seen.slid = o.total_sliding_m > study.outcome.sliding_threshold * scales_of(realization).width_m;
    seen.cycles_to_collapse =
        seen.collapsed
            ? (o.collapse_time_s - strong_start_s(study.excitation, realization, record)) * realization.frequency_hz
            : nan;

    const double base = path_needed ? base_path_m(study.excitation, realization, record, o.end_time_s) : nan;
    const double dissipated = o.energy_friction_j + o.energy_damping_j;
    const auto set = [&](Amount amount, double value) { seen.amount[static_cast<std::size_t>(amount)] = value; };
    set(Amount::total_sliding_m, o.total_sliding_m);
    set(Amount::total_rocking_rad, o.total_rocking_rad);
    set(Amount::top_path_ratio, base > 0 ? o.top_path_m / base : nan);
    const auto columns = static_cast<double>(study.structure.columns.size());
    set(Amount::face_path_ratio, base > 0 ? o.sliding_path_m / (base * columns) : nan);
    set(Amount::friction_share, dissipated > 0 ? o.energy_friction_j / dissipated : nan);
    set(Amount::collapse_cycles, seen.collapsed ? o.collapse_time_s * realization.frequency_hz : nan);
    return seen;
}

Estimate probability(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    std::uint64_t trials = 0, successes = 0;
    for (const Observation& o : cell)
        if (counts(o, measure)) {
            ++trials;
            successes += o.has(measure.event, measure.within_cycles);
        }
    if (trials == 0)
        return {};
    const BinomialInterval interval = jeffreys(trials, successes, level);
    return {static_cast<double>(successes) / static_cast<double>(trials), interval.lower, interval.upper,
            static_cast<std::size_t>(trials)};
}

Estimate minority(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    const Estimate p = probability(cell, measure, level);
    if (!p.known())
        return p;
    const double at_ends = std::min(std::min(p.lower, 1 - p.lower), std::min(p.upper, 1 - p.upper));
    const double peak = p.lower <= 0.5 && p.upper >= 0.5
                            ? 0.5
                            : std::max(std::min(p.lower, 1 - p.lower), std::min(p.upper, 1 - p.upper));
    return {std::min(p.value, 1 - p.value), at_ends, peak, p.realizations};
}

Estimate median(const std::vector<Observation>& cell, const Measure& measure, double level)
{
    std::vector<double> values;
    for (const Observation& o : cell) {
        const double value = o.amount[static_cast<std::size_t>(measure.amount)];
        if (counts(o, measure) && !std::isnan(value))
            values.push_back(value);
    }
    const std::size_t n = values.size(), k = rank_of_tail(n, (1 - level) / 2);
    if (k == 0)
        return {};
    std::sort(values.begin(), values.end());
    return {sorted_median(values), values[k - 1], values[n - k], n};
}

Estimate onset(const Sample& sample, std::size_t frequency, const Measure& measure, double level)
{
    const std::vector<double>& pga = sample.pga_m_s2;
    std::vector<double> value, lower, upper;
    Estimate result;
    for (std::size_t j = 0; j < pga.size(); ++j) {
        const Estimate p = probability(sample.cell(frequency, j), measure, level);
        if (!p.known())
            return {};
        result.realizations += p.realizations;
        value.push_back(p.value);
        lower.push_back(p.lower);
        upper.push_back(p.upper);
    }
    const auto first = [](const std::vector<double>& curve) {
        return static_cast<std::size_t>(std::find_if(curve.begin(), curve.end(), [](double p) { return p >= 0.5; }) -
                                        curve.begin());
    };
    const auto crossing = [&](const std::vector<double>& curve, std::size_t j) {
        if (j == 0 || j == curve.size())
            return j == 0 ? pga.front() : infinity;
        const double share = (0.5 - curve[j - 1]) / (curve[j] - curve[j - 1]);
        return pga[j - 1] * std::pow(pga[j] / pga[j - 1], share);
    };
    const std::size_t at = first(value), possible = first(upper), certain = first(lower);
    result.value = crossing(value, at);
    result.lower = possible == 0 ? 0 : pga[possible - 1];
    result.upper = certain == pga.size() ? infinity : pga[certain];
    const auto open = [&](std::size_t j) { return value[j] > 0.05 && value[j] < 0.95; };
    if (measure.between_steps && at > 0 && at < pga.size() && (open(at - 1) || open(at))) {
        result.lower = possible == 0 ? 0 : crossing(upper, possible);
        result.upper = crossing(lower, certain);
    }
    return result;
}

Estimate estimate(const Sample& sample, std::size_t frequency, std::size_t pga, const Measure& measure, double level)
{
    switch (measure.kind) {
    case Measure::Kind::probability:
        return probability(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::minority:
        return minority(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::median:
        return median(sample.cell(frequency, pga), measure, level);
    case Measure::Kind::onset:
        break;
    }
    return onset(sample, frequency, measure, level);
}

std::string number_text(const Measure& m, const Estimate& e)
{
    if (!e.known())
        return "unknown";
    const double scale = is_length(m) ? 1000 : 1;
    const std::string unit = unit_text(m).empty() ? "" : " " + unit_text(m);
    if (m.kind == Measure::Kind::onset) {
        if (std::isinf(e.upper) && std::isinf(e.value))
            return fmt::format("above {:.3g}{}", e.lower, unit);
        if (e.lower == 0)
            return fmt::format("at most {:.3g}{}", e.upper, unit);
    }
    return fmt::format("{:.3g} [{:.3g}, {}]{}", scale * e.value, scale * e.lower,
                       std::isinf(e.upper) ? "∞" : fmt::format("{:.3g}", scale * e.upper), unit);
}

std::vector<Sample> run_variants(const ClaimFile& file, const RunPlace& place, const RunOptions& options,
                                 Observer& observer)
{
    const bool path_needed = ratio_needed(file);
    const fs::path folder = place.results / file.name;
    fs::create_directories(folder);
    std::vector<Sample> samples;
    for (const Levels& levels : variants(file.axes)) {
        std::vector<std::string> settings = settings_of(file.axes, levels);
        if (place.realizations > 0)
            settings.push_back(fmt::format("study.realizations={}", place.realizations));
        const Study study = read_study(file.file, settings);
        if (study.surface && study.surface->adaptive)
            throw InputError(
                file.file, 0,
                "surface.adaptive: a claim is tested on cells with equal numbers of realizations; leave it "
                "out");
        if (study.kept == KeptRealizations::none)
            throw InputError(
                file.file, 0,
                "output.realizations = \"none\": a claim is tested on the rows of all realizations; omit this key");
        const std::vector<std::string> record = record_setting(study, place);
        settings.insert(settings.end(), record.begin(), record.end());

        Sample sample;
        if (!record.empty() && !fs::exists(place.data / study.excitation.file)) {
            sample.why_not = "record absent: " + study.excitation.file;
        } else {
            const LoadedStudy loaded = load(file.file, settings, law_of(file.axes, levels));
            const fs::path results = folder / file_name(variant_key(file.axes, levels));
            const Found found = look_for(results, loaded.result_header());
            if (found != Found::complete && place.begins)
                place.begins(levels);
            if (found != Found::complete && !compute(loaded, results, found == Found::unfinished, options, observer))
                return samples;
            const ResultReader reader(results);
            sample = make_sample(loaded.study(), loaded.sampler(), loaded.record(), reader.rows(), path_needed);
            sample.version = reader.header().code_version;
        }
        sample.levels = levels;
        samples.push_back(std::move(sample));
    }
    return samples;
}

} // namespace stylobate::claims
