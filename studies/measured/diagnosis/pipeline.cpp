#include "studies/measured/diagnosis/pipeline.hpp"

#include "io/study/study_file.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/direct/friction_judgement.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/measured/diagnosis/prediction.hpp"
#include "studies/measured/diagnosis/presentation.hpp"
#include "studies/measured/diagnosis/window_evidence.hpp"
#include "studies/report/words.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>

namespace stylobate {

namespace {

constexpr std::size_t most_wrong = 20;
constexpr std::size_t most_features = 8;
constexpr std::size_t most_candidates = 12;

/// "simulated campaigns: 72 of 1100, about 40 s left"
std::string campaigns_line(const Progress& p)
{
    const std::optional<double> left = p.seconds_left();
    return fmt::format("  simulated campaigns: {} of {}{}", p.done, p.total,
                       left ? fmt::format(", about {} left", duration_text(*left)) : "");
}

/// The stages of a diagnosis in their order; each leaves what it found for those after it.
/// A stage returns false if the observer stopped it.
class Pipeline {
public:
    Pipeline(const Campaign& measured, const Study& start, const DiagnosisOptions& options, const Tell& tell,
             Observer& observer)
        : measured_(measured), start_(start), options_(options), tell_(tell), observer_(observer),
          scales_(campaign_scales(measured)), // refuses what cannot be diagnosed, before anything is reported
          built_(build_specimen(measured.specimen)), study_(start)
    {
        study_.structure = built_.structure;
    }

    std::optional<Diagnosis> run();

private:
    void say_what_is_read();
    void test_base_and_sensors();
    void balance_forces();
    bool simulate_windows();
    bool simulate_campaigns();
    void reach_verdict();
    void state_verdict();
    void list_candidates();
    void list_indistinguishable();
    void describe_unexplained();
    void find_wrong_windows();
    void show_windows(const std::vector<ChosenWindow>& chosen);
    void judge_extended_study();
    void write_extended_study();
    void tell_method_and_cost();

    const Campaign& measured_;
    const Study& start_;
    const DiagnosisOptions& options_;
    const Tell& tell_;
    Observer& observer_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();

    CampaignScales scales_;
    SpecimenStructure built_;
    Study study_; ///< the baseline: with the specimen's structure, then with the contacts that the windows choose

    DirectResult direct_;
    Campaign campaign_;                      ///< as measured, with its base corrected by the direct tests
    std::vector<SizedCause> known_;          ///< of the direct tests, for the model
    std::optional<BalanceEvidence> balance_; ///< after its stage
    WindowEvidence windows_;
    std::optional<EnsembleDiagnosis> ensemble_; ///< nothing where no campaigns are simulated
    Decided decided_;
    SimulationCount count_;
    Diagnosis d_;
};

std::optional<Diagnosis> Pipeline::run()
{
    say_what_is_read();
    test_base_and_sensors();
    balance_forces();
    if (!all_agree(options_.run.ranks, simulate_windows()) || !simulate_campaigns())
        return std::nullopt;
    reach_verdict();
    if (observer_.stop_requested())
        return std::nullopt;
    find_wrong_windows();
    judge_extended_study();
    if (observer_.stop_requested())
        return std::nullopt;
    tell_method_and_cost();
    return std::move(d_);
}

void Pipeline::say_what_is_read()
{
    d_.measured_file = measured_.source;
    d_.specimen = measured_.specimen.name;
    d_.code_version = code_version();
    d_.seed = options_.seed;
    d_.options = {fmt::format("nulls = {}", options_.plan.nulls), fmt::format("threads = {}", options_.run.threads)};
    d_.runs = measured_.runs.size();
    d_.runs_used = static_cast<std::uint64_t>(
        std::count_if(measured_.runs.begin(), measured_.runs.end(),
                      [](const MeasuredRun& run) { return !run.blocks.x_m.empty() && run.time_s.size() > 1; }));
    d_.data_findings = finding_texts(measured_.findings);
    tell_(
        fmt::format("{}: {} runs of {} blocks", measured_.source, measured_.runs.size(), measured_.specimen.blocks()));
}

void Pipeline::test_base_and_sensors()
{
    direct_ = direct_tests(measured_, scales_);
    d_.base_tests = direct_.base_tests;
    d_.sensor_tests = direct_.sensor_tests;
    for (const DataTest& test : direct_.base_tests) {
        tell_(fmt::format("  {:<12} {}: {}", to_string(test.outcome), test.name, test.sentence));
        if (test.outcome == TestOutcome::not_judged)
            add_missing(d_, test.name, test.sentence);
    }
    for (const DataTest& test : direct_.sensor_tests)
        if (test.outcome == TestOutcome::failed)
            tell_(fmt::format("  {:<12} {} at {}: {}", to_string(test.outcome), test.name, test.place, test.sentence));
    campaign_ = corrected(measured_, direct_);
    for (const CauseFit& fit : direct_.found)
        if (fit.cause.mechanism == "wedge" || fit.cause.mechanism == "table_pitch" ||
            (fit.cause.mechanism == "vertical_motion" && !unrecorded_vertical(fit.cause)))
            known_.push_back({fit.cause, fit.size});
}

void Pipeline::balance_forces()
{
    balance_.emplace(balance_evidence(measured_, scales_, direct_.base_m));
    if (balance_->fit) {
        int sliding = 0, rocking = 0;
        for (const LawSample& s : balance_->fit->samples())
            for (const LawTerm& t : s.terms)
                ++(t.law == Law::sliding ? sliding : rocking);
        tell_(fmt::format("  balance of forces: {} windows in which a joint slides, {} in which one rocks", sliding,
                          rocking));
        if (auto figure = friction_figure(*balance_, measured_))
            d_.figures.push_back(*figure);
        if (auto figure = turning_figure(*balance_))
            d_.figures.push_back(*figure);
        std::vector<std::string> still;
        for (int j = 0; j < static_cast<int>(measured_.specimen.joints.size()); ++j)
            if (balance_->fit->samples_of(Law::sliding, j) < 5)
                still.push_back(fmt::format("{}", j));
        if (!still.empty())
            add_missing(
                d_, fmt::format("the friction of joint{} {} by itself", still.size() > 1 ? "s" : "", list_words(still)),
                "It slides too rarely for the balance of forces to separate its friction from that of the others. A "
                "strong motion of low frequency, under which it slides, would determine it.");
    } else {
        d_.missing.push_back({"balance of forces", balance_->why_not});
        tell_("  balance of forces: " + balance_->why_not);
    }
    d_.baseline.push_back(baseline_friction(judge_friction(measured_, scales_, direct_.base_m), start_));
}

bool Pipeline::simulate_windows()
{
    // a vertical motion without a model of its own would be blamed on something
    if (!beyond_simulation(direct_))
        windows_ = window_evidence(campaign_, study_, scales_, known_, options_.run, observer_);
    else {
        windows_.complete = true;
        windows_.why_not = "The table has a vertical motion that the base motion does not contain.";
    }
    count_ += windows_.cost;
    if (!windows_.complete)
        return false;
    if (!windows_.baselines.empty()) {
        const WindowBaseline& best = windows_.baselines.front();
        study_ = best.study;
        for (const WindowBaseline& b : windows_.baselines)
            tell_(fmt::format("  windows: {} scores {:.1f} nats", b.contacts, b.score - best.score));
        d_.baseline.push_back({"contact.form", "", std::nullopt, std::nullopt, std::nullopt, true,
                               best.contacts + " (best of the tested forms; the factors are relative to the start "
                                               "study of the diagnosis, without intervals: see stylobate calibrate)"});
    } else {
        d_.missing.push_back({"free windows", windows_.why_not});
    }
    study_.text = study_text(study_);
    d_.study_toml = study_.text;
    return true;
}

bool Pipeline::simulate_campaigns()
{
    if (options_.plan.nulls == 0) {
        add_missing(d_, "joints and blocks",
                    "No campaigns were simulated (--nulls 0): only direct tests can name a cause.");
        return true;
    }
    if (beyond_simulation(direct_)) {
        add_missing(d_, "joints and blocks",
                    "The simulated campaigns by which they are judged cannot contain what was found of the base.");
        return true;
    }
    EnsemblePlan plan = options_.plan;
    plan.seed = options_.seed;
    const auto begun = std::chrono::steady_clock::now();
    std::optional<std::uint64_t> cached;
    ensemble_.emplace(ensemble_diagnosis(
        campaign_, start_, scales_, known_, direct_.base_m, plan, options_.cache, options_.run,
        [&](std::uint64_t done, std::uint64_t total) {
            if (!cached)
                cached = done;
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
            Progress progress{.done = done, .total = total, .seconds = passed.count()};
            progress.rate = static_cast<double>(done - *cached) / std::max(passed.count(), 1e-9);
            if (options_.campaigns)
                options_.campaigns(campaigns_line(progress), progress);
        },
        observer_));
    count_ += ensemble_->ensemble.cost;
    if (!ensemble_->ensemble.complete)
        return false;
    const std::vector<double>& likeness = ensemble_->by_statistics.null_weights;
    const double least_p = 1 / (1 + std::accumulate(likeness.begin(), likeness.end(), 0.0));
    if (least_p > EnsembleRule{}.named)
        add_missing(
            d_, "joints and blocks",
            fmt::format("Too few healthy campaigns were simulated (--nulls {}): the smallest p-value that a cause "
                        "can have is {:.2g}, and {} or less is needed.",
                        plan.nulls, least_p, EnsembleRule{}.named));
    d_.nulls.push_back({"area, two_corner and points", plan.healthy() - plan.scouts(),
                        "healthy contact laws of a wide family that are like the measured one, friction of the joints, "
                        "widths and masses of the blocks, noise of the cameras; the blocks where they were put"});
    return true;
}

void Pipeline::reach_verdict()
{
    if (ensemble_)
        for (const std::string& line : tests_in_words(*ensemble_))
            tell_("  " + line);
    decided_ = decide(direct_, *balance_, ensemble_ ? &*ensemble_ : nullptr, options_.rule);
    state_verdict();
}

void Pipeline::state_verdict()
{
    d_.verdict = decided_.verdict;
    list_candidates();
    list_indistinguishable();
    if (decided_.unexplained)
        describe_unexplained();
    d_.verdict_text = verdict_text(d_);
    tell_("  " + d_.verdict_text);
    if (!d_.candidates.empty())
        d_.figures.push_back(candidates_figure(d_.candidates));
    if (!ensemble_)
        return;
    for (std::size_t i = 0; i < decided_.named.size(); ++i) {
        const JudgedCause& j = decided_.named[i];
        const int best = ensemble_->by_statistics.best;
        if (j.channel == Channel::forces)
            d_.figures.push_back(
                carrying_figure(carrying_score(*ensemble_, options_.plan.scouts(), j.fit.cause), d_.candidates[i]));
        else if (j.channel == Channel::statistics &&
                 ensemble_->causes[static_cast<std::size_t>(best)].cause.mechanism == j.fit.cause.mechanism)
            d_.figures.push_back(carrying_figure(ensemble_->carrying, d_.candidates[i]));
    }
    for (const Missing& missing : hardly_shown(*ensemble_, decided_))
        d_.missing.push_back(missing);
}

/// One for each mechanism and place: as it was named first, else as it is in the set, else as it was judged. Of those
/// that are not shown the likeliest.
void Pipeline::list_candidates()
{
    std::set<std::pair<std::string, std::string>> told;
    const auto add = [&](const JudgedCause& j, Decision decision) {
        const bool listed = decision != Decision::not_shown || d_.candidates.size() < most_candidates;
        if (listed && told.emplace(j.fit.cause.mechanism, j.fit.cause.place).second)
            d_.candidates.push_back(candidate_of(j, measured_, decision, ensemble_.has_value(), decided_));
    };
    for (const JudgedCause& j : decided_.named)
        add(j, Decision::named);
    for (const JudgedCause& j : decided_.in_set)
        add(j, Decision::in_set);
    for (const JudgedCause& j : decided_.judged)
        add(j, Decision::not_shown);
}

void Pipeline::list_indistinguishable()
{
    std::vector<std::string>& names = d_.indistinguishable;
    for (const JudgedCause& j : decided_.named)
        if (j.channel != Channel::direct && !decided_.in_set.empty() && names.empty())
            names.push_back(j.fit.cause.mechanism);
    for (const JudgedCause& j : decided_.in_set)
        if (std::find(names.begin(), names.end(), j.fit.cause.mechanism) == names.end())
            names.push_back(j.fit.cause.mechanism);
}

void Pipeline::describe_unexplained()
{
    const Structure& s = decided_.unexplained->structure;
    Unexplained u;
    u.block = s.block;
    u.coordinate = s.coordinate;
    u.depends_on = s.depends_on;
    double best = 0;
    if (decided_.by_tie) {
        for (const JudgedCause& j : decided_.judged)
            best = std::max(best, stands_for_unknown(j.fit.cause) ? 0 : j.fit.gain);
    } else {
        for (const CauseFit& fit : balance_->causes)
            best = std::max(best, fit.gain);
    }
    std::string too;
    for (const Cause& cause : decided_.beside_too)
        too += fmt::format(", and beside {}, which the statistics name", cause.label());
    u.text = decided_.beside
                 ? fmt::format("{}. It gains {:.1f} nats beside the best known cause, {}, which gains {:.1f}{}", s.text,
                               decided_.unexplained->gain, decided_.beside->cause.label(), decided_.beside->gain, too)
                 : fmt::format("{}. Its gain over the baseline is {:.1f} nats; that of the best known cause in its "
                               "place is {:.1f}",
                               s.text, decided_.unexplained->gain, best);
    for (std::size_t k = 0; k < balance_->structures.size() && k < most_features; ++k) {
        const StructureFit& f = balance_->structures[k];
        u.features.push_back(
            {fmt::format("{} (block {}, {})", f.structure.depends_on, f.structure.block, f.structure.coordinate),
             f.gain, decided_.structure95});
    }
    d_.unexplained = u;
}

void Pipeline::find_wrong_windows()
{
    WrongWindows wrong = wrong_windows(measured_, study_, most_wrong, options_.run, count_, observer_);
    d_.wrong = std::move(wrong.stretches);
    std::move(wrong.figures.begin(), wrong.figures.end(), std::back_inserter(d_.figures));
    show_windows(wrong.shown);
}

/// Measured and simulated blocks in these windows: of the baseline, and of the extended study where there is one.
void Pipeline::show_windows(const std::vector<ChosenWindow>& chosen)
{
    std::vector<ShownModel> models{{"baseline", measured_, with_causes(study_, built_, {})}};
    if (std::any_of(decided_.named.begin(), decided_.named.end(),
                    [](const JudgedCause& j) { return !unrecorded_vertical(j.fit.cause); }))
        models.push_back({"extended", campaign_, with_causes(study_, built_, model_causes(decided_.named))});
    d_.motion = window_motions(chosen, models, {}, options_.run, count_, observer_);
}

/// What the extended study gains on runs left out, and its text.
void Pipeline::judge_extended_study()
{
    if (d_.verdict == Verdict::unexplained)
        d_.missing.push_back(
            {"the gain of an extended model", "No extended model was made because part of the error is unexplained."});
    if (d_.verdict != Verdict::named)
        return;
    if (!windows_.baselines.empty())
        d_.gain =
            predictive_gain(measured_, scales_, study_, decided_.named, options_.seed, options_.run, count_, observer_);
    write_extended_study();
    if (!d_.gain)
        d_.missing.push_back(
            {"the gain of the extended model",
             windows_.baselines.empty()
                 ? "No free windows could be simulated: " + windows_.why_not
                 : "Runs of at least two motions with windows are needed, so that some can be held out."});
}

void Pipeline::write_extended_study()
{
    Study extended = study_;
    std::vector<std::string> left_out;
    for (const JudgedCause& j : decided_.named) {
        if (unrecorded_vertical(j.fit.cause)) {
            left_out.push_back("vertical_motion (its record is not known)");
            continue;
        }
        if (j.fit.cause.mechanism == "harmonic_distortion") {
            add_distortion(direct_.distortion, direct_.gain, extended);
            continue;
        }
        add_mechanism({j.fit.cause, j.fit.size}, built_, extended);
    }
    extended.excitation = ExcitationSpec{};
    extended.excitation.kind = ExcitationKind::table;
    extended.excitation.file = std::filesystem::absolute(measured_.source).string();
    extended.excitation.run = measured_.runs.front().name;
    extended.text = study_text(extended);
    d_.extended_study = extended.text;
    if (std::any_of(decided_.named.begin(), decided_.named.end(),
                    [](const JudgedCause& j) { return j.fit.cause.persists; }))
        add_missing(d_, "wear from run to run in the extended study",
                    "In a study each run begins with a new specimen.");
    if (!left_out.empty())
        d_.missing.push_back({"all of the extended study", "It lacks " + list_words(left_out) + "."});
}

void Pipeline::tell_method_and_cost()
{
    d_.method = {
        "Base and sensors are tested directly, while the lowest block moves with the table and while all blocks are at "
        "rest.",
        "The forces in the joints follow from the smoothed accelerations of the blocks by Newton's law. Where a joint "
        "slides or rocks, its law is tested without contact stiffness, damping or simulation.",
        "The simulation is nudged towards the measured motion (an observer). Free windows that start from its states "
        "are "
        "compared with the measurement: they determine the contacts of the baseline."};
    if (ensemble_)
        d_.method.push_back(
            "Simulated campaigns judge joints and blocks: healthy ones whose contact laws come nearer to the measured "
            "one round by round, and ones with a known cause. The statistics of the campaign (paths, openings, losses "
            "of speed, friction of each joint, scores of the balance of forces) have a likelihood under each cause. "
            "The largest gain over all causes is compared with the same of the healthy campaigns. A cause is named if "
            "its p-value is at most 0.015, and if such names are right in more than half of the campaigns with a known "
            "cause. The scores of the balance of forces are a test of their own, because contact laws move them "
            "little: "
            "where they are beyond those of the healthy campaigns (p of 0.015), the cause that explains the forces "
            "best is "
            "named, unless a force of no known kind is left beside it.");
    d_.cost.simulations = count_.simulations;
    d_.cost.window_simulations = count_.window_simulations;
    d_.cost.block_steps = count_.block_steps;
    d_.cost.threads = options_.run.threads;
    d_.cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

} // namespace

void check_cache(const DiagnosisOptions& options)
{
    if (options.cache)
        refuse_foreign_cache(*options.cache);
}

std::optional<Diagnosis> diagnose(const Campaign& measured, const Study& start, const DiagnosisOptions& options,
                                  const Tell& tell, Observer& observer)
{
    check_cache(options);
    return Pipeline(measured, start, options, tell, observer).run();
}

} // namespace stylobate
