#include "studies/decisions/risk/sequences.hpp"

#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/drawn_motions.hpp"
#include "ensemble/sampling/structure_builder.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double harmless_dislocation = 0.001; // of a width
constexpr double harmless_share = 0.99;
constexpr double most_events = 100; // expected in a history

struct Event {
    double time = 0; ///< part of the years
    double intensity = 0;
    std::size_t motion = 0;
};

std::uint64_t poisson(double mean, double u)
{
    double p = std::exp(-mean), below = p;
    std::uint64_t n = 0;
    // the sum may stay below a u next to 1 by rounding
    while (u > below && (static_cast<double>(n) < mean || p > 1e-18)) {
        p *= mean / static_cast<double>(++n);
        below += p;
    }
    return n;
}

/// The structures, motions and earthquakes of the histories: pure functions of (results, options, history).
class Histories {
public:
    Histories(const Results& results, const HazardModel& hazard, const SequenceOptions& options, double threshold)
        : options_(options), hazard_(best_curve(hazard)), threshold_(threshold),
          experiment_(widened(results, options.histories), results.experiment().motions())
    {
        const MotionSetSpec& set = *study().design().motions;
        measure_ = &motions().measure(measure_name(set.measure, set.period_s));
    }

    const Experiment& experiment() const { return experiment_; }
    double rate(double threshold) const { return hazard_.frequency(std::log(threshold)); }

    /// Those above the threshold, in the order of their times.
    /// @param down_to lower threshold, for additional ones; that of the histories: none
    std::vector<Event> events(std::uint64_t history, double down_to) const
    {
        std::vector<Event> all;
        draw(history, 0, 0, rate(threshold_), all);
        if (down_to < threshold_)
            draw(history, std::uint64_t{1} << 32, rate(threshold_), rate(down_to), all);
        std::stable_sort(all.begin(), all.end(), [](const Event& a, const Event& b) { return a.time < b.time; });
        return all;
    }

    /// The structure of a history under earthquakes that follow each other.
    Realization realization(std::uint64_t history, std::span<const Event> events) const
    {
        const auto set = static_cast<std::uint64_t>(motions().size());
        const std::uint64_t stripes = study().design().columns;
        // motion x structure of the study numbers the structures
        const std::uint64_t index = history % set * stripes * study().realizations + history / set;
        Realization r = experiment_.sampler().realization(index);
        std::vector<ScaledMotion> shakings;
        r.pga_m_s2 = 0;
        for (const Event& event : events) {
            const double scale = std::pow(event.intensity / measure_->value[event.motion], 1 / measure_->exponent);
            const Motion& motion = *motions().motions[event.motion];
            shakings.push_back({&motion, scale});
            r.pga_m_s2 = std::max(r.pga_m_s2, scale * motion.pga_m_s2);
        }
        r.frequency_hz = shakings.front().motion->predominant_frequency_hz;
        if (events.size() == 1) {
            r.motion = motions().motions[events[0].motion];
            r.motion_scale = shakings[0].scale;
            return r;
        }
        Motion motion = in_succession(shakings, pause_s(r)).motion;
        motion.predominant_frequency_hz = r.frequency_hz;
        motion.pga_m_s2 = r.pga_m_s2;
        r.motion = std::make_shared<const Motion>(std::move(motion));
        r.motion_scale = 1;
        return r;
    }

private:
    /// The study with as many structures under its motions as there are histories, each with its own imperfections and
    /// contacts.
    static Study widened(const Results& results, std::uint64_t histories)
    {
        const auto motions = static_cast<std::uint64_t>(results.study().design().motions->motions);
        Study study = with_structures(results.study(), (histories + motions - 1) / motions);
        study.outcome.follow = Follow::collapse;
        study.excitation.tail = Tail::structure; // only falls are counted
        return study;
    }

    const Study& study() const { return experiment_.study(); }
    double pause_s(const Realization& r) const
    {
        return options_.pause_s.value_or(
            std::max(study().design().motions->pause_s.value_or(0), pause_until_rest(StructureBuilder::scales(r))));
    }
    const MotionSet& motions() const { return *experiment_.motions().drawn; }

    /// Events with frequencies of exceedance between two.
    void draw(std::uint64_t history, std::uint64_t element, double from, double to, std::vector<Event>& all) const
    {
        const auto uniform = [&](std::uint64_t i) {
            return uniform01(options_.seed, history, Stream::years, element + i);
        };
        const std::uint64_t n = poisson((to - from) * options_.years, uniform(0));
        for (std::uint64_t i = 0; i < n; ++i) {
            const double exceeded = from + (to - from) * uniform(3 * i + 2);
            all.push_back({uniform(3 * i + 1), std::exp(hazard_.log_intensity(exceeded)),
                           static_cast<std::size_t>(uniform(3 * i + 3) * static_cast<double>(motions().size()))});
        }
    }

    const SequenceOptions options_;
    HazardCurve hazard_;
    double threshold_;
    Experiment experiment_;
    const MotionMeasure* measure_ = nullptr;
};

/// What is run: a history whole, one of its earthquakes, or the history with weaker ones too.
struct Job {
    enum class Of : std::uint8_t { carried, fresh, check };
    std::uint64_t history = 0;
    Of of = Of::carried;
    std::uint32_t event = 0;
};

/// How a history ended.
struct Ending {
    bool carried = false, fresh = false, check = false, invalid = false;
};

/// All runs, history by history; counts the earthquakes.
std::vector<Job> jobs_of(const Histories& histories, SequenceRisk& s)
{
    std::vector<Job> jobs;
    for (std::uint64_t h = 0; h < s.histories; ++h) {
        const auto events = static_cast<std::uint32_t>(histories.events(h, s.threshold).size());
        s.events += events;
        s.most_events = std::max<std::uint64_t>(s.most_events, events);
        s.with_two += events > 1;
        if (events > 0)
            jobs.push_back({h, Job::Of::carried, 0});
        if (events > 1)
            for (std::uint32_t e = 0; e < events; ++e)
                jobs.push_back({h, Job::Of::fresh, e});
        if (h < s.checked && histories.events(h, s.checked_threshold).size() > events)
            jobs.push_back({h, Job::Of::check, 0});
    }
    return jobs;
}

void estimate(SequenceRisk& s, const std::vector<Ending>& endings)
{
    PairedCounts counts; // fresh structures are the base
    std::uint64_t valid = 0;
    for (const Ending& e : endings) {
        s.invalid += e.invalid;
        if (e.invalid)
            continue;
        ++valid;
        s.carried += e.carried;
        s.fresh += e.fresh;
        s.both += e.carried && e.fresh;
    }
    counts.both = s.both;
    counts.variant_only = s.carried - s.both;
    counts.base_only = s.fresh - s.both;
    counts.neither = valid - s.both - counts.discordant();
    const auto share = [&](std::uint64_t fallen) -> SequenceNumber {
        const BinomialInterval limits = jeffreys(valid, fallen, s.level);
        return {valid ? static_cast<double>(fallen) / static_cast<double>(valid) : std::nan(""),
                {limits.lower, limits.upper}};
    };
    s.carried_share = share(s.carried);
    s.fresh_share = share(s.fresh);
    const auto difference_of = [&](const PairedCounts& of) -> SequenceNumber {
        if (of.pairs() == 0)
            return {std::nan(""), {-1, 1}};
        const PairedDifference d = paired_difference(of, s.level);
        return {d.value, {d.lower, d.upper}};
    };
    s.difference = difference_of(counts);
    const PairedRatio ratio = paired_ratio(counts, s.level);
    s.ratio = {ratio.value, {ratio.lower, ratio.upper}};
    s.check_difference = difference_of({0, s.then_stood, s.then_fell, s.checked - s.then_fell - s.then_stood});
}

/// Passes on the progress without a share of collapses: a run is a whole history or one of its earthquakes, so that the
/// share of the runs is not that of the histories.
class WithoutShare : public Observer {
public:
    explicit WithoutShare(Observer& outer) : outer_(outer) {}
    void progress(const Progress& progress) override
    {
        Progress shown = progress;
        shown.share = shown.share_lower = shown.share_upper = std::nan("");
        outer_.progress(shown);
    }
    void warn(const std::string& text) override { outer_.warn(text); }
    bool stop_requested() override { return outer_.stop_requested(); }

private:
    Observer& outer_;
};

const StateRisk& collapse_of(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (s.state != "collapse")
        throw InputError(fmt::format("--sequences: histories end by a collapse, and the estimate is of '{}'.\n  Omit "
                                     "--state, or give --state collapse.",
                                     s.state));
    return s;
}

/// The strongest stripe up to which no structure has fallen and 99 of 100 keep no dislocation above 0.001 of a width;
/// else the weakest stripe.
struct Threshold {
    double intensity = 0;
    std::string says;
};

Threshold harmless_intensity(const Results& results)
{
    const MotionSetSpec& f = *results.study().design().motions;
    const auto stripes = static_cast<std::size_t>(f.stripes());
    std::vector<std::uint64_t> trials(stripes), moved(stripes), fallen(stripes);
    for (const ResultRow& row : results.trials()) {
        const bool fell = row.outcome.state == State::collapsed;
        if (row.outcome.state == State::invalid || (!fell && row.outcome.at_rest == 0)) // its residual is not known
            continue;
        const std::size_t stripe = row.cell % stripes;
        ++trials[stripe];
        moved[stripe] += fell || row.outcome.residual_dislocation > harmless_dislocation;
        fallen[stripe] += fell;
    }
    std::size_t harmless = 0;
    while (harmless < stripes && trials[harmless] > 0 && fallen[harmless] == 0 &&
           static_cast<double>(moved[harmless]) <= (1 - harmless_share) * static_cast<double>(trials[harmless]))
        ++harmless;
    const auto at = [&](std::size_t i) { return f.intensity.value(static_cast<int>(i)); };
    if (harmless == 0)
        return {at(0),
                fmt::format("{:.3g}, the weakest of the study: there {} of {} structures keep a dislocation above "
                            "{:g} of a width, and {} fall.",
                            at(0), moved[0], trials[0], harmless_dislocation, fallen[0])};
    return {at(harmless - 1),
            fmt::format("{:.3g}, the strongest of the study up to which none falls and 99 of 100 structures keep no "
                        "dislocation above {:g} of a width ({} of {} do at it).",
                        at(harmless - 1), harmless_dislocation, moved[harmless - 1], trials[harmless - 1])};
}

} // namespace

void check_sequences(const Results& results)
{
    const MotionSetSpec& f = *results.study().design().motions;
    if (f.shakings > 1)
        throw InputError(fmt::format("--sequences: {} is a study of sequences (fragility.shakings = {}) itself.\n  Run "
                                     "the study with fragility.shakings = 1.",
                                     results.file(), f.shakings));
    if (f.method != FragilityMethod::stripes)
        throw InputError(
            fmt::format("--sequences: the motions of {} are a cloud, which is not scaled.\n  Run the study "
                        "with fragility.method = \"stripes\".",
                        results.file()));
}

std::optional<SequenceRisk> simulate_sequences(const Results& results, const Risk& risk, const SequenceOptions& options,
                                               const RunOptions& run, Observer& observer)
{
    check_sequences(results);
    const StateRisk& collapse = collapse_of(risk);
    SequenceRisk s;
    s.years = options.years;
    s.level = options.level;
    s.histories = options.histories;
    const Threshold threshold =
        options.threshold ? Threshold{*options.threshold, fmt::format("{:.3g}, as given.", *options.threshold)}
                          : harmless_intensity(results);
    if (!(threshold.intensity > 0) || !std::isfinite(threshold.intensity))
        throw InputError(
            fmt::format("--threshold {}: is not above 0 and finite.\n  Give an intensity in the SI unit of "
                        "the study's measure, {}.",
                        threshold.intensity, risk.hazard.measure));
    s.threshold = threshold.intensity;
    s.threshold_says = threshold.says;
    s.checked_threshold = threshold.intensity / 2;
    const Histories histories(results, risk.hazard, options, s.threshold);
    s.events_a_year = histories.rate(s.threshold);
    if (s.events_a_year * s.years > most_events)
        throw InputError(fmt::format("--threshold {:.3g}: a history of {:g} years would have {:.3g} earthquakes, more "
                                     "than {:g}.\n  Give a higher threshold, or fewer --years.",
                                     s.threshold, s.years, s.events_a_year * s.years, most_events));
    const bool check = histories.rate(s.checked_threshold) * s.years <= 4 * most_events;
    s.checked = check ? std::min(options.checked, options.histories) : 0;

    const std::vector<Job> jobs = jobs_of(histories, s);
    std::vector<Ending> endings(options.histories);
    std::vector<bool> rerun(options.histories);
    RunPlan plan;
    plan.total = jobs.size();
    plan.realize = [&](std::uint64_t index) {
        const Job& job = jobs[index];
        const std::vector<Event> events =
            histories.events(job.history, job.of == Job::Of::check ? s.checked_threshold : s.threshold);
        Realization r = histories.realization(
            job.history, job.of == Job::Of::fresh ? std::span(events).subspan(job.event, 1) : std::span(events));
        r.index = index;
        return r;
    };
    plan.sink = [&](const Realization& r, const Outcome& outcome) {
        const Job& job = jobs[r.index];
        Ending& ending = endings[job.history];
        const bool fell = outcome.state == State::collapsed;
        const bool invalid = outcome.state == State::invalid;
        s.steps += outcome.steps;
        ++s.runs;
        switch (job.of) {
        case Job::Of::carried:
            ending.carried = fell;
            ending.invalid |= invalid;
            break;
        case Job::Of::fresh:
            ending.fresh |= fell;
            ending.invalid |= invalid;
            break;
        case Job::Of::check:
            ending.check = fell;
            rerun[job.history] = !invalid;
        }
    };
    WithoutShare shown(observer);
    if (plan.total > 0 && run_ensemble(histories.experiment(), run, plan, shown).done < plan.total)
        return std::nullopt;
    for (std::uint64_t h = 0; h < options.histories; ++h) {
        if (histories.events(h, s.threshold).size() == 1)
            endings[h].fresh = endings[h].carried;
        s.then_fell += rerun[h] && endings[h].check && !endings[h].carried;
        s.then_stood += rerun[h] && !endings[h].check && endings[h].carried;
    }
    estimate(s, endings);
    const RiskNumber expected = probability_over(collapse.estimate.frequency, s.years);
    const double unknown = std::nan("");
    s.closed_form = collapse.determined ? SequenceNumber{expected.value, expected.fragility}
                                        : SequenceNumber{unknown, {unknown, unknown}};
    return s;
}

} // namespace stylobate
