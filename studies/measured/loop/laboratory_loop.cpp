#include "studies/measured/loop/laboratory_loop.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "studies/measured/loop/choice.hpp"
#include "studies/measured/loop/known_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace stylobate {

namespace {

constexpr RunKind joint_test_kinds[] = {RunKind::pull, RunKind::push,  RunKind::drop, RunKind::slide,
                                        RunKind::tilt, RunKind::board, RunKind::rest};
constexpr double told_belief = 0.02;    // shares that are told
constexpr double told_deviations = 2.5; // estimates that are told in words
constexpr double usual_friction = 0.6;  // where the specimen states none
constexpr double listed_belief = 0.7;   // of candidates that the first diagnosis lists without a probability
constexpr double most_told_nats = 8;
constexpr double like_the_plan = 0.1; // of the largest displacement: farther, and a run was another test

/// One performance of a test on one joint.
struct DoneTest {
    RunKind kind = RunKind::pull;
    int joint = 0;
    int order = 0; ///< of its first run among all
    std::vector<MeasuredRun> runs;
};

std::vector<int> joints_alone(const Specimen& specimen)
{
    std::vector<int> joints;
    for (int joint = 0; joint < static_cast<int>(specimen.joints.size()); ++joint)
        if (stands_alone(specimen, joint))
            joints.push_back(joint);
    return joints;
}

std::string joints_in_words(const std::vector<int>& joints)
{
    return fmt::format("{}", fmt::join(joints, ", "));
}

/// Runs of a test that was done several times come apart by their order: each performance has as many as are planned.
std::vector<DoneTest> done_tests(const Campaign& campaign, TestStory& story)
{
    std::map<std::pair<RunKind, int>, std::vector<std::pair<int, const MeasuredRun*>>> all;
    for (std::size_t r = 0; r < campaign.tests.size(); ++r) {
        const MeasuredRun& run = campaign.tests[r];
        if (run.joint && stands_alone(campaign.specimen, *run.joint))
            all[{run.test, *run.joint}].emplace_back(run.run_order.value_or(static_cast<int>(r)), &run);
        else if (run.joint || run.test != RunKind::rest) // what was measured at rest stands in the specimen
            story.notes.push_back(
                fmt::format("Run {} is left out: {}.", run.name,
                            run.joint ? "what stands on its joint stands on others too" : "it names no joint"));
    }
    std::vector<DoneTest> out;
    for (auto& [what, runs] : all) {
        std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        // what was measured at rest stands in the specimen, once
        const std::size_t each =
            what.first == RunKind::rest
                ? runs.size()
                : std::max<std::size_t>(
                      1, planned_runs(campaign.specimen, campaign.laboratory, what.first, what.second).size());
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (i % each == 0)
                out.push_back({what.first, what.second, runs[i].first, {}});
            out.back().runs.push_back(*runs[i].second);
        }
    }
    if (const Specimen& s = campaign.specimen;
        !s.centre_of_mass_m.empty() || !s.bearing_left_m.empty() || !s.bearing_right_m.empty())
        for (int joint = 0; joint < static_cast<int>(s.joints.size()); ++joint)
            if (stands_alone(s, joint) && !all.contains({RunKind::rest, joint})) {
                MeasuredRun run;
                run.test = RunKind::rest;
                run.joint = joint;
                out.push_back({RunKind::rest, joint, -1, {run}});
            }
    std::stable_sort(out.begin(), out.end(), [](const DoneTest& a, const DoneTest& b) { return a.order < b.order; });
    return out;
}

/// Tests that follow each other and are of one kind, at joints each of which occurs once.
std::vector<std::vector<DoneTest>> steps_of(std::vector<DoneTest> done)
{
    std::vector<std::vector<DoneTest>> steps;
    for (DoneTest& test : done) {
        const bool more = !steps.empty() && steps.back().front().kind == test.kind &&
                          std::ranges::none_of(steps.back(), [&](const DoneTest& t) { return t.joint == test.joint; });
        if (!more)
            steps.emplace_back();
        steps.back().push_back(std::move(test));
    }
    return steps;
}

/// Signatures are simulated for planned runs: a table that moved otherwise did another test.
void check_like_plan(const Campaign& campaign, const DoneTest& test, TestStory& story)
{
    const std::vector<MeasuredRun> planned =
        planned_runs(campaign.specimen, campaign.laboratory, test.kind, test.joint);
    for (std::size_t r = 0; r < test.runs.size() && r < planned.size(); ++r) {
        const auto largest = [](const Series& series) {
            double low = 0, high = 0;
            for (const double value : series.values)
                if (std::isfinite(value)) {
                    low = std::min(low, value);
                    high = std::max(high, value);
                }
            return high - low;
        };
        const double wanted = largest(planned[r].base_displacement_m), was = largest(test.runs[r].base_displacement_m);
        if (wanted > 0 && std::fabs(was - wanted) > like_the_plan * wanted)
            story.notes.push_back(
                fmt::format("Run {}: the table moved by {:.3g} m, and {:.3g} m are planned; what it is compared with "
                            "was simulated for the planned motion.",
                            test.runs[r].name, was, wanted));
    }
}

class Loop {
public:
    Loop(const Campaign& campaign, const std::vector<LoopCause>& causes, const TestSamples& samples,
         const SequencePrior& prior, const LoopOptions& options)
        : campaign_(campaign), causes_(causes), options_(options), known_(samples, prior), model_(known_.model())
    {
    }

    void tell(const std::vector<std::vector<DoneTest>>& steps, const std::vector<int>& joints, TestStory& story)
    {
        story.prior = beliefs(belief_of(model_, known_.seen()), belief_of(model_, known_.seen()));
        for (const std::vector<DoneTest>& step : steps)
            tell_step(step, story);
        const SequenceJudgement now = judgement_of(model_, known_.seen());
        story.verdict = now.verdict;
        story.log_evidence = now.log_evidence;
        story.share = now.share;
        tell_causes(now, story);
        for (const SizeLimit& limit : limits_of(model_, known_.seen()))
            if (now.verdict != SequenceVerdict::named || !now.cause || !(limit.cause == *now.cause))
                story.limits.push_back({limit.cause.label() + (limit.below_neutral ? ", downwards" : ""),
                                        limit.size ? size_words(cause_of(limit.cause), *limit.size) : std::string()});
        choose(now, joints, story);
        story.text = answer(now, story);
    }

private:
    const Cause& cause_of(const CausePlace& place) const
    {
        const auto at = std::ranges::find_if(causes_, [&](const LoopCause& c) { return c.named.at() == place; });
        return at->told;
    }

    std::vector<StoryBelief> beliefs(const Belief& before, const Belief& after) const
    {
        std::vector<StoryBelief> all{{"nothing", before.nothing, after.nothing},
                                     {"what is not listed", before.unlisted, after.unlisted}};
        for (std::size_t i = 0; i < after.causes.size(); ++i)
            all.push_back({model_.hypotheses.causes[i].label(), before.causes[i], after.causes[i]});
        std::erase_if(all, [](const StoryBelief& b) { return std::max(b.before, b.after) < told_belief; });
        std::ranges::stable_sort(all, [](const StoryBelief& a, const StoryBelief& b) { return a.after > b.after; });
        return all;
    }

    void tell_step(const std::vector<DoneTest>& tests, TestStory& story)
    {
        StoryStep step;
        step.test = to_string(tests.front().kind);
        std::vector<int> joints;
        std::vector<Estimate> measured;
        const std::size_t first = known_.seen().size();
        for (const DoneTest& test : tests) {
            joints.push_back(test.joint);
            check_like_plan(campaign_, test, story);
            const std::vector<Estimate> found = estimates(campaign_.specimen, test.runs, options_.plan.floor);
            if (found.empty())
                story.notes.push_back(
                    fmt::format("{} at joint {} gave no estimate: nothing slid or turned, it fell, or "
                                "it was not seen.",
                                step.test, test.joint));
            for (const Estimate& e : found)
                if (const std::optional<Eigen::Index> column = column_of(e)) {
                    known_.add(*column, e);
                    measured.push_back(e);
                }
            known_.done(test.kind, test.joint);
        }
        std::ranges::sort(joints);
        step.joints = joints_in_words(joints);
        const std::span<const SeenEstimate> seen = known_.seen(), so_far = seen.first(first);
        model_ = known_.model();
        const Belief before = belief_of(model_, so_far), after = belief_of(model_, seen);
        step.beliefs = beliefs(before, after);
        const SequenceJudgement now = judgement_of(model_, known_.seen());
        step.log_evidence = now.log_evidence;
        step.verdict = now.verdict;
        const std::vector<SeenDeviation> deviations = deviations_of(model_.signatures, seen.subspan(first));
        for (const SeenDeviation& d : deviations) {
            const TestColumn& column = model_.signatures.columns[static_cast<std::size_t>(d.column)];
            StoryEstimate e{column.name, words_of(column.name), column.joint,     d.value, 0, column.unit,
                            d.expected,  d.deviations,          d.from_the_others};
            for (const Estimate& m : measured)
                if (m.name == column.name && m.joint == column.joint)
                    e.sd = m.sd;
            step.seen.push_back(std::move(e));
        }
        step.text = what_it_showed(step, now);
        story.steps.push_back(std::move(step));
    }

    std::optional<Eigen::Index> column_of(const Estimate& e) const
    {
        const std::vector<TestColumn>& columns = model_.signatures.columns;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (columns[k].name == e.name && columns[k].joint == e.joint)
                return static_cast<Eigen::Index>(k);
        return std::nullopt;
    }

    static std::string words_of(const std::string& estimator)
    {
        for (const RunKind kind : joint_test_kinds)
            for (const EstimatorName& name : estimator_names(kind))
                if (name.name == estimator)
                    return name.what;
        return estimator;
    }

    static std::string what_it_showed(const StoryStep& step, const SequenceJudgement& now)
    {
        const StoryEstimate* farthest = nullptr;
        for (const StoryEstimate& e : step.seen)
            if (!farthest || std::fabs(e.deviations) > std::fabs(farthest->deviations))
                farthest = &e;
        if (!farthest)
            return "It gave no estimate.";
        if (std::fabs(farthest->deviations) < told_deviations)
            return fmt::format("All estimates are within {:.1f} standard deviations of healthy specimens.",
                               std::fabs(farthest->deviations));
        std::string text = fmt::format(
            "At joint {}: {}, {:.1f} standard deviations from what {}.", farthest->joint, farthest->what,
            farthest->deviations, farthest->from_the_others ? "the other joints let expect" : "healthy specimens give");
        if (now.cause)
            text += fmt::format(" The likeliest cause is {} ({:.0f} %).", now.cause->label(), 100 * now.share);
        return text;
    }

    /// The named cause, then one after the other those at other places that the tests name with it given.
    void tell_causes(SequenceJudgement now, TestStory& story) const
    {
        for (SequenceModel model = model_; now.verdict == SequenceVerdict::named;) {
            const Cause& cause = cause_of(*now.cause);
            StoryCause told{now.cause->mechanism,
                            now.cause->place_words(),
                            cause.parameter,
                            cause.unit,
                            parameter_of(cause, now.size),
                            {},
                            {},
                            now.share,
                            now.log_evidence};
            const std::optional<SizeInterval> sizes = size_of(model, known_.seen(), *now.cause);
            if (sizes) {
                told.size = parameter_of(cause, sizes->mean);
                const double at_low = parameter_of(cause, sizes->low), at_high = parameter_of(cause, sizes->high);
                told.low = std::min(at_low, at_high);
                told.high = std::max(at_low, at_high);
            }
            story.named.push_back(std::move(told));
            if (!sizes)
                return;
            model = given(model, *now.cause, *sizes);
            if (model.signatures.causes.empty())
                return;
            now = judgement_of(model, known_.seen());
        }
    }

    void choose(const SequenceJudgement& now, const std::vector<int>& joints, TestStory& story) const
    {
        std::vector<TestOption> tests;
        for (const RunKind kind : joint_test_kinds) {
            double cost = default_cost(kind);
            for (const auto& [of, stated] : campaign_.laboratory.cost)
                if (of == kind)
                    cost = stated;
            std::optional<std::string> cannot = cannot_do(campaign_.specimen, campaign_.laboratory, kind);
            if (kind == RunKind::rest && known_.was_done(kind))
                cannot = "It is measured, and stands in the specimen";
            tests.push_back({kind, std::nullopt, cost, std::move(cannot)});
        }
        const Prospects prospects = [&](const TestOption& option) { return known_.models_after(option.test); };
        const std::vector<RatedTest> all = rated_tests(model_, known_.seen(), tests, {}, prospects);
        for (const RatedTest& rated : all)
            story.options.push_back({to_string(rated.option.test), rated.option.cost, rated.entropy_fall,
                                     rated.belief_gain, rated.per_cost, rated.left_out.value_or("")});
        if (now.verdict == SequenceVerdict::named || now.verdict == SequenceVerdict::unexplained)
            return;
        std::vector<RatedTest> next;
        if (options_.planned > 1)
            next = planned_tests(model_, tests, options_.planned, {}, prospects);
        else if (std::optional<RatedTest> one = chosen_test(model_, known_.seen(), all))
            next.push_back(std::move(*one));
        for (const RatedTest& test : next)
            story.next.emplace_back(to_string(test.option.test));
        if (!next.empty())
            story.sheet = sheet_of(campaign_.specimen, campaign_.laboratory, next.front().option.test, joints);
    }

    static std::string named_in_words(const TestStory& story)
    {
        std::vector<std::string> words;
        for (const StoryCause& c : story.named)
            words.push_back(fmt::format("{} at {}, {} = {:.3g}{}{}{} (belief {:.2f}, evidence e^{:.1f})", c.mechanism,
                                        c.place, c.parameter, c.size, c.unit.empty() ? "" : " ", c.unit,
                                        c.low ? fmt::format(" ({:.3g} to {:.3g}, 90 %)", *c.low, *c.high) : "", c.share,
                                        c.log_evidence));
        return fmt::format("The tests name {}.", fmt::join(words, "; beside it "));
    }

    std::string answer(const SequenceJudgement& now, const TestStory& story) const
    {
        const std::string next =
            story.next.empty() ? std::string() : fmt::format(" Next test: {}.", story.next.front());
        switch (now.verdict) {
        case SequenceVerdict::named:
            return named_in_words(story);
        case SequenceVerdict::unexplained: {
            const TestColumn& off = model_.signatures.columns[static_cast<std::size_t>(now.off.front())];
            return fmt::format("The tests show what no listed cause gives: {} at {}{}.", words_of(off.name),
                               now.off.size() > 1 ? "all joints" : fmt::format("joint {}", off.joint),
                               off.depends_on.empty() ? "" : fmt::format("; it depends on {}", off.depends_on));
        }
        case SequenceVerdict::none:
            return "The tests show no cause. Each cause that they would have shown has an upper limit." + next;
        case SequenceVerdict::open:
            break;
        }
        if (story.steps.empty())
            return "No test of a single joint was done." + next;
        return (now.cause ? fmt::format("The tests have not decided. The likeliest cause is {} (belief {:.2f}).",
                                        now.cause->label(), now.share)
                          : std::string("The tests have not decided.")) +
               next;
    }

    const Campaign& campaign_;
    const std::vector<LoopCause>& causes_;
    const LoopOptions& options_;
    KnownTests known_;
    SequenceModel model_;
};

} // namespace

std::vector<PriorShare> prior_shares(const Diagnosis& diagnosis)
{
    std::vector<PriorShare> shares;
    double sum = 0, likely = 0;
    for (const Candidate& c : diagnosis.candidates) {
        PriorShare share{loop_mechanism(c.mechanism), c.place,
                         std::expm1(std::min(c.gain_nats.value_or(0), most_told_nats) / 2)};
        likely += c.probability.value_or(0);
        sum += share.weight;
        shares.push_back(std::move(share));
    }
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i].weight = likely > 0 ? diagnosis.candidates[i].probability.value_or(0)
                           : sum > 0  ? listed_belief * shares[i].weight / sum
                                      : 0;
    return shares;
}

std::optional<TestStory> laboratory_loop(const Campaign& campaign, const Study& contacts,
                                         const std::vector<PriorShare>& shares, const LoopOptions& options,
                                         Observer& observer)
{
    const auto begun = std::chrono::steady_clock::now();
    const Specimen& specimen = campaign.specimen;
    const std::vector<int> joints = joints_alone(specimen);
    if (joints.empty())
        throw InputError(campaign.source + ": no block stands on a single joint, so that no joint can be tested by "
                                           "itself.");
    TestStory story;
    const std::vector<std::vector<DoneTest>> steps = steps_of(done_tests(campaign, story));
    std::vector<RunKind> kinds;
    for (const RunKind kind : joint_test_kinds)
        if (!cannot_do(specimen, campaign.laboratory, kind) ||
            std::ranges::any_of(steps, [&](const auto& step) { return step.front().kind == kind; }))
            kinds.push_back(kind);
    const std::vector<LoopCause> causes = loop_causes(
        specimen, joints, specimen.friction_nominal.value_or(usual_friction), contacts.contact.normal_stiffness_n_m2);
    SimulatedSamples samples =
        simulated_samples(specimen, contacts, planned_tests_of(specimen, campaign.laboratory, kinds, joints), causes,
                          options.plan, options.cache, options.run, options.progress, observer);
    if (!samples.complete)
        return std::nullopt;
    SequencePrior prior;
    prior.shares = shares;
    const Signatures signatures = signatures_of(samples.samples);
    std::erase_if(prior.shares, [&](const PriorShare& share) { // of base and sensors: no test of a joint shows them
        return std::ranges::none_of(signatures.causes, [&](const CauseSignature& c) {
            return (c.cause.mechanism == share.of || cause_group(c.cause.mechanism) == share.of) &&
                   (!share.place || c.cause.place == *share.place);
        });
    });
    Loop(campaign, causes, samples.samples, prior, options).tell(steps, joints, story);
    story.simulations = samples.cost.simulations;
    story.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return story;
}

Campaign planned_campaign(const Campaign& campaign, const std::vector<std::string>& tests)
{
    Campaign plan;
    plan.source = campaign.source;
    plan.specimen = campaign.specimen;
    plan.laboratory = campaign.laboratory;
    for (const std::string& test : tests) {
        const auto kind =
            std::ranges::find(joint_test_kinds, test, [](RunKind k) { return std::string(to_string(k)); });
        if (kind == std::end(joint_test_kinds))
            continue;
        for (const int joint : joints_alone(campaign.specimen))
            for (MeasuredRun& run : planned_runs(campaign.specimen, campaign.laboratory, *kind, joint)) {
                run.run_order = static_cast<int>(plan.tests.size());
                plan.tests.push_back(std::move(run));
            }
    }
    return plan;
}

std::vector<std::string> sheet_of(const Specimen& specimen, const Laboratory& laboratory, RunKind kind,
                                  const std::vector<int>& joints)
{
    if (kind == RunKind::rest)
        return {"Weigh each block on two supports for its centre of mass.",
                "Print the beds with ink, and measure from each edge where they begin to carry.",
                "Let the cameras see each block for half a second on the one below it, nothing above it: how it lies.",
                "The numbers are lists of the specimen: centre_of_mass_m, bearing_left_m, bearing_right_m."};
    const std::vector<MeasuredRun> runs = planned_runs(specimen, laboratory, kind, joints.front());
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}: at joints {}, one after the other; the same body stands on each.", to_string(kind),
                                joints_in_words(joints)));
    lines.emplace_back("Clamp the blocks below the joint to the table. Take those above its upper block away.");
    if (!runs.empty() && !runs.front().dummies.empty())
        lines.push_back(fmt::format("Tape {} blocks like it onto the upper block ({:.3g} kg each, or dummies of that "
                                    "mass and size).",
                                    runs.front().dummies.size(), runs.front().dummies.front().mass_kg));
    const auto span = [](const Series& series) {
        const auto [low, high] = std::ranges::minmax(series.values);
        return std::max(-low, high);
    };
    switch (kind) {
    case RunKind::pull:
        lines.push_back(fmt::format("Hold the block by a rod to the laboratory with a force gauge, {:.3g} mm above the "
                                    "joint. Move the table by +-{:.3g} mm: two slow cycles, three fast ones, two slow "
                                    "ones, {:.3g} s in all.",
                                    1e3 * runs.front().forces.front().height_m,
                                    1e3 * span(runs.front().base_displacement_m), runs.front().time_s.back()));
        break;
    case RunKind::push:
        lines.push_back(
            fmt::format("Push the body by a rod with a force gauge, {:.3g} mm above the upper block's lower "
                        "face, at {:.3g} mm/s and by {:.3g} mm; once to the left and once to the right.",
                        1e3 * runs.front().forces.front().height_m,
                        1e3 * std::fabs(runs.front().forces.front().speed_m_s), 1e3 * push_reach_m));
        break;
    case RunKind::board:
    case RunKind::tilt:
        lines.push_back(fmt::format("Tilt the board slowly up to {:.3g} degrees, until the body {}; once to each side. "
                                    "The inclinometer's angle is base/tilt_rad.",
                                    57.29578 * span(runs.front().base_tilt_rad),
                                    kind == RunKind::board ? "slides" : "turns"));
        break;
    case RunKind::drop:
        lines.push_back(fmt::format("Let the body hang by a thread with a lean of {:.3g} degrees, its lower corner "
                                    "{:.3g} mm above the joint, and burn the thread; {} times, in turn with the left "
                                    "and the right corner below.",
                                    57.29578 * drop_lean_rad,
                                    1e3 * drop_height_m * tested_body(specimen, joints.front(), {}).length_ratio,
                                    drop_repeats));
        break;
    case RunKind::slide:
        lines.push_back(fmt::format("Shake the table harmonically by +-{:.3g} mm, so that the block slides throughout, "
                                    "{:.3g} s.",
                                    1e3 * span(runs.front().base_displacement_m), runs.front().time_s.back()));
        break;
    case RunKind::rest:
    case RunKind::shake:
        break;
    }
    lines.push_back(fmt::format("Cameras as in the shake runs; {} {} a joint. `stylobate new campaign --test {}` "
                                "writes a folder for them.",
                                runs.size(), runs.size() == 1 ? "run" : "runs", to_string(kind)));
    return lines;
}

} // namespace stylobate
