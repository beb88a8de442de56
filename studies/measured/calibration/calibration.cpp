#include "studies/measured/calibration/calibration.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration_evidence.hpp"
#include "studies/measured/calibration/calibration_search.hpp"
#include "studies/measured/diagnosis/direct/friction_judgement.hpp"
#include "studies/measured/windows/window_motions.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace stylobate {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_folds = 6;
constexpr std::size_t most_keys = 12;

/// What the units of the evidence belong to: a run of a campaign, a row of a table.
struct CalibrationRun {
    std::string name;
    int motion_id = 0;
};

/// Units whose motions are left out together: motions in the order in which they come, dealt to at most six folds.
std::vector<std::size_t> folds_of(const std::vector<CalibrationRun>& all, const std::vector<std::size_t>& runs,
                                  std::size_t& folds)
{
    std::map<int, std::size_t> motions;
    std::vector<std::size_t> fold;
    for (const std::size_t run : runs)
        fold.push_back(motions.try_emplace(all[run].motion_id, motions.size() % most_folds).first->second);
    folds = std::min(motions.size(), most_folds);
    return fold;
}

/// A vertical record is no number that can be fitted, and the measured motions would have to be its own.
void refuse_vertical_record(const Study& study)
{
    if (study.vertical)
        throw InputError("mechanisms.vertical_motion.file: a calibration has no vertical record of each test. Omit it, "
                         "or give mechanisms.vertical_motion.ratio.");
}

/// Progress of the whole calibration, from that of its parts.
class Counting : public Observer, public SearchProgress {
public:
    Counting(Observer& outer, std::size_t total, const CalibrationOptions& options, const CalibrationEvidence& evidence)
        : outer_(outer), options_(options), evidence_(evidence)
    {
        progress_.total = total;
    }
    void stage(const std::string& what) override
    {
        if (options_.stage)
            options_.stage(what);
    }
    void advance(std::size_t done) override
    {
        progress_.done = std::min<std::uint64_t>(progress_.done + done, progress_.total);
        tell();
    }
    void spare(std::size_t sets) override
    {
        progress_.total = std::max<std::uint64_t>(progress_.total - sets, progress_.done);
        tell();
    }
    void progress(const Progress&) override { tell(); }
    bool stop_requested() override { return outer_.stop_requested(); }

private:
    void tell()
    {
        progress_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        // what was kept took no time
        const auto simulated =
            static_cast<double>(progress_.done - std::min<std::uint64_t>(evidence_.restored(), progress_.done));
        progress_.rate = simulated / std::max(progress_.seconds, 1e-9);
        outer_.progress(progress_);
    }
    Observer& outer_;
    const CalibrationOptions& options_;
    const CalibrationEvidence& evidence_;
    Progress progress_;
    const Clock::time_point start_ = Clock::now();
};

} // namespace

std::string interval_words(const FittedParameter& p)
{
    if (!p.determined && !p.effective)
        return "no interval";
    return fmt::format("({}{:.4g} to {:.4g}, 95 %)", p.effective ? "of the model's value " : "", p.low, p.high);
}

Study default_study(const Campaign& campaign)
{
    constexpr double bed_n_m3 = 2e9;
    Study study;
    study.structure = structure_of(campaign.specimen);
    double width = 0;
    for (const double half : campaign.specimen.half_width_m)
        width += 2 * half / static_cast<double>(campaign.specimen.blocks());
    study.contact.normal_stiffness_n_m2 = bed_n_m3 * study.structure.depth_m;
    study.contact.tangential_stiffness_n_m = study.contact.normal_stiffness_n_m2 * width;
    study.contact.friction = campaign.specimen.friction_nominal.value_or(0.6);
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = 1;
    study.text = study_text(study);
    return study;
}

namespace {

/// What a calibration begins from.
struct Begin {
    Study nominal;                       ///< the study as it was given, of the measured structure
    Study base;                          ///< with what is held at another value
    std::vector<FitKey> keys;            ///< that are searched
    std::vector<FittedParameter> judged; ///< that are not
    Clock::time_point time = Clock::now();
};

/// The friction as the balance of forces judges it, in the place of a search (`friction_judgement.hpp`).
void take_friction(const Campaign& campaign, Begin& begin)
{
    const auto key = std::find_if(begin.keys.begin(), begin.keys.end(),
                                  [](const FitKey& k) { return k.key == friction_key && !k.asked; });
    if (key == begin.keys.end())
        return;
    const FrictionJudgement judged = judge_friction(campaign);
    FittedParameter p;
    p.key = key->key;
    p.start = p.value = number_in(begin.nominal, key->key);
    p.low = p.from = key->from;
    p.high = p.to = key->to;
    p.determined = p.bounded_below = p.bounded_above = judged.determined;
    p.note = judged.note;
    if (judged.determined) {
        p.value = judged.value;
        p.low = judged.low;
        p.high = judged.high;
        p.from = std::min(p.from, p.low);
        p.to = std::max(p.to, p.high);
        begin.base = with_values(begin.base, {key->key}, {p.value});
    } else {
        p.note = "not determined by these data, held at the study's: " + judged.note;
    }
    begin.judged.push_back(p);
    begin.keys.erase(key);
}

/// What was found by the search is a value of the model.
void mark_effective(FormCalibration& form)
{
    for (FittedParameter& p : form.parameters) {
        p.effective = true;
        if (!p.determined)
            continue;
        p.determined = false;
        p.note = fmt::format("effective: a value of this model with the contact form {}, not of the specimen; its "
                             "interval is not valid for another contact law",
                             word_for(contact_form_names, form.form));
    }
}

/// Parameters that were not searched, behind those that were; they correlate with nothing.
void append_judged(FormCalibration& form, const std::vector<FittedParameter>& judged)
{
    const std::size_t before = form.parameters.size(), n = before + judged.size();
    std::vector<double> correlation(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            correlation[i * n + k] = i < before && k < before ? form.correlation[i * before + k] : i == k;
    form.correlation = std::move(correlation);
    form.parameters.insert(form.parameters.end(), judged.begin(), judged.end());
}

/// Adds the results of the other contact forms for the same parameter.
void compare_forms(std::vector<FormCalibration>& forms)
{
    for (FormCalibration& form : forms)
        for (std::size_t i = 0; i < form.parameters.size(); ++i) {
            if (!form.parameters[i].effective)
                continue;
            for (const FormCalibration& other : forms)
                if (&other != &form)
                    form.parameters[i].note += fmt::format(
                        "; form {} has {:.4g}", word_for(contact_form_names, other.form), other.parameters[i].value);
        }
}

/// Searches with each contact form, by one evidence.
/// @param all what the runs of the evidence are
void search_forms(Calibration& result, Begin begin, const CalibrationOptions& options, CalibrationEvidence& evidence,
                  const std::vector<CalibrationRun>& all, const RunOptions& run, Observer& observer)
{
    if (result.from_outcomes)
        for (FitKey& key : begin.keys)
            key.method_deviation = 0; // nothing is tracked
    const std::vector<ContactForm> forms =
        options.forms.empty() ? std::vector<ContactForm>{begin.base.contact.form} : options.forms;
    std::size_t folds = 0;
    const std::vector<std::size_t> fold = folds_of(all, evidence.runs(), folds);
    if (folds < 2)
        result.notes.emplace_back("all runs are of one motion: cross-validation over motions is not possible");

    Counting counting(observer, forms.size() * CalibrationSearch::planned(begin.keys.size(), options, folds), options,
                      evidence);
    const auto of_form = [](Study study, ContactForm form) {
        study.contact.form = form;
        study.text = study_text(study);
        return study;
    };
    for (const ContactForm form : forms) {
        CalibrationSearch search(of_form(begin.nominal, form), of_form(begin.base, form), begin.keys, options, evidence,
                                 run, counting, counting);
        std::optional<FormCalibration> found = search.run(fold, folds);
        if (!found)
            return;
        for (std::size_t r = 0, u = 0; r < found->runs.size(); u += found->runs[r++].units) {
            const CalibrationRun& measured = all[evidence.runs()[u]];
            found->runs[r].run = measured.name;
            found->runs[r].motion_id = measured.motion_id;
        }
        mark_effective(*found);
        append_judged(*found, begin.judged);
        result.forms.push_back(std::move(*found));
    }
    compare_forms(result.forms);
    const auto merit = [&](const FormCalibration& f) {
        double sum = 0; // on runs left out where there are such
        for (const RunScore& r : f.runs)
            sum += r.calibrated;
        return sum;
    };
    for (std::size_t f = 1; f < result.forms.size(); ++f)
        if (merit(result.forms[f]) > merit(result.forms[result.best]))
            result.best = f;
    const SimulationCount cost = evidence.cost();
    result.parameter_sets = evidence.candidates();
    result.restored_sets = evidence.restored();
    result.simulations = cost.simulations;
    result.window_simulations = cost.window_simulations;
    result.block_steps = cost.block_steps;
    result.seconds = std::chrono::duration<double>(Clock::now() - begin.time).count();
    result.complete = true;
}

/// Searches, with what is predicted kept in a file where one is named.
void search_and_keep(Calibration& result, Begin begin, const CalibrationOptions& options,
                     std::unique_ptr<CalibrationEvidence> evidence, const std::vector<CalibrationRun>& all,
                     const RunOptions& run, Observer& observer)
{
    if (!run.leads())
        return serve_evidence(*run.ranks, *evidence, run, observer);
    if (run.ranks)
        evidence = std::make_unique<SharedEvidence>(std::move(evidence), *run.ranks);
    if (!options.kept) {
        search_forms(result, std::move(begin), options, *evidence, all, run, observer);
        return;
    }
    std::string runs;
    for (const std::size_t r : options.runs)
        runs += fmt::format(" {}", r);
    KeptEvidence kept(std::move(evidence), *options.kept,
                      fmt::format("{} {} {} windows {} ensemble {} runs{}", code_version(), options.kept_key,
                                  result.from_outcomes ? "outcomes" : "histories", options.window_s, options.ensemble,
                                  runs));
    search_forms(result, std::move(begin), options, kept, all, run, observer);
    result.kept_sets = kept.kept();
    if (result.complete)
        kept.remove();
}

/// The keys to be fitted, all of them ones that the study can have.
std::vector<FitKey> checked_keys(const Study& base, const CalibrationOptions& options)
{
    std::vector<FitKey> keys = options.keys.empty() ? contact_keys(base) : options.keys;
    if (keys.size() > most_keys)
        throw InputError(fmt::format("--fit: {} parameters at once are too many; at most {}", keys.size(), most_keys));
    for (const FitKey& key : keys)
        check_range(base, key);
    return keys;
}

/// Measured and simulated blocks in the windows in which the best study is off most, and in a typical one.
void show_windows(Calibration& result, const Campaign& campaign, const Study& nominal,
                  const CalibrationOptions& options, const RunOptions& run, Observer& observer)
{
    const WindowOptions windows{options.window_s, options.runs, {}};
    WindowComparison comparison(campaign, windows);
    const ModelVariant best{result.forms[result.best].study}, start{nominal};
    StopOnly stop_only(observer);
    const std::vector<WindowResiduals> residuals = comparison.residuals({best}, run, stop_only);
    SimulationCount cost = comparison.cost();
    if (!residuals.empty())
        result.motion =
            window_motions(choose_windows(comparison.windows(),
                                          excess_of(comparison, residuals.front(), build_specimen(campaign.specimen))),
                           {{"calibrated", campaign, best}, {"start", campaign, start}}, windows, run, cost, stop_only);
    result.simulations += cost.simulations;
    result.window_simulations += cost.window_simulations;
    result.block_steps += cost.block_steps;
}

} // namespace

Calibration calibrate(const Campaign& campaign, const Study& start, const CalibrationOptions& options,
                      const RunOptions& run, Observer& observer)
{
    Begin begin;
    Calibration result;
    result.measured = campaign.source;
    refuse_vertical_record(start);
    begin.nominal = start;
    begin.nominal.structure = structure_of(campaign.specimen);
    begin.nominal.text = study_text(begin.nominal);
    begin.base = begin.nominal;
    begin.keys = checked_keys(begin.base, options);

    std::unique_ptr<CalibrationEvidence> evidence;
    if (!options.outcomes)
        evidence = history_evidence(campaign, options.runs, options.window_s);
    if (!evidence) {
        evidence = outcome_evidence(outcome_tests(campaign, options.runs),
                                    start.perturbations.empty() ? tolerances(campaign.specimen) : start.perturbations,
                                    options.ensemble);
        result.from_outcomes = true;
    }
    if (!evidence)
        throw InputError(
            fmt::format("{}: no run has both a base motion and either histories of the blocks or an "
                        "outcome (collapsed): a calibration is not possible. Give base/acceleration_m_s2 and "
                        "blocks/x_m, blocks/theta_rad, or collapsed.",
                        campaign.source));
    const std::set<std::size_t> used(evidence->runs().begin(), evidence->runs().end());
    if (used.size() < campaign.runs.size() && options.runs.empty())
        result.notes.push_back(fmt::format("{} of {} runs are used: the others lack a base motion, or {}", used.size(),
                                           campaign.runs.size(),
                                           result.from_outcomes ? "an outcome" : "histories of the blocks"));
    std::vector<CalibrationRun> all;
    for (const MeasuredRun& measured : campaign.runs)
        all.push_back({measured.name, measured.motion_id});
    if (!result.from_outcomes)
        take_friction(campaign, begin);
    const Study nominal = begin.nominal;
    search_and_keep(result, std::move(begin), options, std::move(evidence), all, run, observer);
    if (result.complete && !result.from_outcomes)
        show_windows(result, campaign, nominal, options, run, observer);
    return result;
}

Calibration calibrate(const OutcomeTable& table, const Study& start, const CalibrationOptions& options,
                      const RunOptions& run, Observer& observer)
{
    Begin begin;
    Calibration result;
    result.measured = table.source;
    result.from_outcomes = true;
    for (const Finding& finding : table.findings)
        result.notes.push_back(finding.place + ": " + finding.text);
    refuse_vertical_record(start);
    begin.nominal = start;
    begin.nominal.text = study_text(begin.nominal);
    begin.base = begin.nominal;
    begin.keys = checked_keys(begin.base, options);
    std::unique_ptr<CalibrationEvidence> evidence =
        outcome_evidence(outcome_tests(table, start),
                         start.perturbations.empty() ? tolerances(Specimen{}) : start.perturbations, options.ensemble);
    if (!evidence)
        throw InputError(table.source, 0,
                         "has no test with both a motion and an outcome: a calibration is not possible.\n  "
                         "io/FORMAT.md has the layout.");
    std::vector<CalibrationRun> all;
    std::size_t fell = 0;
    for (const MeasuredOutcome& row : table.rows) {
        all.push_back({fmt::format("line {}", row.line), row.motion_id});
        fell += row.fell;
    }
    if (fell == 0 || fell == all.size())
        result.notes.push_back(
            fmt::format("all tests had the same outcome (all {}): they bound a parameter on one side only",
                        fell == 0 ? "stood" : "fell"));
    search_and_keep(result, std::move(begin), options, std::move(evidence), all, run, observer);
    return result;
}

} // namespace stylobate
