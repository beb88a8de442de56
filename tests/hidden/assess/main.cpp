/// loop_assessment: the laboratory in the loop, assessed. For each seed a virtual campaign is made; the loop proposes a
/// test, the virtual laboratory does it, and so on, until something is decided or the tests are used up. A line for
/// each seed: what was hidden, and what was found.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/joint_tests/procedures.hpp"
#include "studies/measured/loop/laboratory_loop.hpp"
#include "tests/hidden/joint_test.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace stylobate;
using namespace stylobate::hidden;

namespace {

struct Assessment {
    std::uint64_t first = 1, last = 1;
    std::vector<std::string> effects;
    bool in_turn = false;   ///< one of the effects for each seed, one after the other
    std::size_t second = 0; ///< with `in_turn`, not 0: also the effect that stands so many further on, a pair each
    int blocks = 0;         ///< not 0: seeds of columns with other numbers of blocks are passed over
    std::size_t most = 0;   ///< specimens; 0: all seeds
    bool nothing = false;
    std::string law, specimen;
    std::string prior = "flat"; ///< "flat", "group" (the right one), or a folder of diagnoses
    int tests = 3;
    std::string cache = "loop_cache";
    std::uint64_t healthy = 128, of_each = 16;
    int threads = 2;
    std::size_t estimates = 4;      ///< of a step, that are told
    bool options = false;           ///< what is expected of each test is told
    bool by_entropy = false;        ///< the test that lets the entropy of the belief fall most per cost
    std::vector<std::string> order; ///< of the tests, instead of those that are proposed
    bool signatures = false;        ///< only what the tests give is told
    std::vector<std::string> only;  ///< tests of which that is told; empty: of all
};

std::vector<int> joints_alone(const Specimen& specimen)
{
    std::vector<int> joints;
    for (int joint = 0; joint < static_cast<int>(specimen.joints.size()); ++joint)
        if (stands_alone(specimen, joint))
            joints.push_back(joint);
    return joints;
}

/// The planned runs of one more test, with names of their own.
void add_test(const Campaign& campaign, const std::string& test, std::vector<MeasuredRun>& tests)
{
    const int round = static_cast<int>(tests.empty() ? 0 : *tests.back().run_order / 1000 + 1);
    int order = 1000 * round;
    Campaign plan = planned_campaign(campaign, {test});
    for (MeasuredRun& run : plan.tests) {
        run.name = fmt::format("{:02}_{}", round, run.name);
        run.run_order = order++;
        tests.push_back(std::move(run));
    }
}

/// What healthy specimens give at the first joint, and by how many standard deviations each cause shifts it.
void tell_signatures(const Campaign& campaign, const Study& study, const LoopOptions& options,
                     const std::vector<std::string>& only)
{
    const std::vector<int> joints = joints_alone(campaign.specimen);
    std::vector<RunKind> kinds;
    for (const RunKind kind :
         {RunKind::pull, RunKind::push, RunKind::drop, RunKind::slide, RunKind::tilt, RunKind::board, RunKind::rest})
        if (!cannot_do(campaign.specimen, campaign.laboratory, kind) &&
            (only.empty() || std::ranges::find(only, to_string(kind)) != only.end()))
            kinds.push_back(kind);
    const std::vector<LoopCause> causes =
        loop_causes(campaign.specimen, joints, campaign.specimen.friction_nominal.value_or(0.6),
                    study.contact.normal_stiffness_n_m2);
    Observer observer;
    const SimulatedSamples found = simulated_samples(
        campaign.specimen, study, planned_tests_of(campaign.specimen, campaign.laboratory, kinds, joints), causes,
        options.plan, options.cache, options.run, {}, observer);
    const Signatures s = signatures_of(found.samples);
    fmt::print("scale {:.2f}\n", s.scale);
    for (std::size_t k = 0; k < s.columns.size(); ++k) {
        if (s.columns[k].joint != joints.front())
            continue;
        const auto at = static_cast<Eigen::Index>(k);
        double given = 0;
        for (const std::vector<Eigen::Index>& group : s.alike)
            if (const auto in = std::ranges::find(group, at); in != group.end())
                given = s.sd_given_others(group)(in - group.begin());
        fmt::print("{}{}: mean {:.4g} sd {:.3g} given the other joints {:.3g} floor {:.3g};", s.columns[k].name,
                   s.used[k] ? "" : " (not used)", s.mean(at), std::sqrt(s.covariance(at, at)), given,
                   s.columns[k].floor_sd);
        for (const CauseSignature& c : s.causes)
            if (c.shift(at) != 0)
                fmt::print(" {} {} {:.3g}: {:.1f}", c.cause.mechanism, c.cause.place, c.cause.size,
                           c.shift(at) / given);
        fmt::print("\n");
    }
}

std::vector<PriorShare> prior_of(const Assessment& how, const VirtualCampaign& made)
{
    if (how.prior == "group" && !made.effects.empty() && made.effects.front().listed)
        return {{cause_group(loop_mechanism(made.effects.front().name)), std::nullopt, 0.7}};
    const fs::path file = fs::path(how.prior) / fmt::format("{}.h5", made.seed);
    return fs::exists(file) ? prior_shares(read_diagnosis(file)) : std::vector<PriorShare>();
}

/// Whether the cause is what the effect is, where it is.
bool is_that(const StoryCause& cause, const HiddenEffect& effect)
{
    return cause.mechanism == loop_mechanism(effect.name) &&
           (cause.place == effect.place || cause.place.starts_with(effect.place + " "));
}

/// How a verdict stands to several effects: which of them are named, and how many other names there are.
std::string judged_together(const std::vector<HiddenEffect>& effects, const TestStory& story)
{
    std::size_t right = 0;
    for (const HiddenEffect& e : effects)
        right += std::ranges::any_of(story.named, [&](const StoryCause& c) { return is_that(c, e); });
    const auto wrong = std::ranges::count_if(story.named, [&](const StoryCause& c) {
        return std::ranges::none_of(effects, [&](const HiddenEffect& e) { return is_that(c, e); });
    });
    return fmt::format("{} of {} named, {} wrong", right, effects.size(), wrong);
}

/// How a verdict stands to what is hidden.
std::string judged(const VirtualCampaign& made, const TestStory& story)
{
    if (made.effects.size() > 1)
        return judged_together(made.effects, story);
    const bool named = story.verdict == SequenceVerdict::named;
    if (made.effects.empty())
        return named || story.verdict == SequenceVerdict::unexplained ? "false alarm" : "quiet";
    const HiddenEffect& e = made.effects.front();
    if (!e.listed)
        return named ? "wrong name" : story.verdict == SequenceVerdict::unexplained ? "right" : "missed";
    if (!named)
        return story.verdict == SequenceVerdict::unexplained ? "unexplained" : "missed";
    const StoryCause& first = story.named.front();
    if (first.mechanism != loop_mechanism(e.name))
        return "wrong name";
    if (!is_that(first, e))
        return "wrong place";
    return story.named.size() > 1 ? "right, and a wrong one beside it" : "right";
}

/// Whether the interval has the size; empty: the two are not the same quantity.
std::string size_within(const VirtualCampaign& made, const TestStory& story)
{
    if (made.effects.size() != 1 || story.named.empty() || !judged(made, story).starts_with("right"))
        return "";
    const StoryCause& first = story.named.front();
    const HiddenEffect& effect = made.effects.front();
    if (!first.low || !effect.size_comparable || first.parameter != effect.parameter)
        return "";
    return effect.size >= *first.low && effect.size <= *first.high ? "within" : "outside";
}

/// What is to be hidden in the specimen of this number.
std::vector<std::string> effects_of(const Assessment& how, std::size_t number)
{
    if (!how.in_turn)
        return how.effects;
    std::vector<std::string> effects = {how.effects[number % how.effects.size()]};
    if (how.second > 0)
        effects.push_back(how.effects[(number + how.second) % how.effects.size()]);
    return effects;
}

/// A line of what was hidden and what was found, and a remark for each step.
/// @param done the tests   @param estimates of a step, that are told
void tell(const VirtualCampaign& made, const TestStory& story, const std::string& done, std::size_t estimates)
{
    const StoryCause named = story.named.empty() ? StoryCause{} : story.named.front();
    std::vector<std::string> names, places, sizes;
    for (const HiddenEffect& e : made.effects) {
        names.push_back(e.listed ? e.name : "outside:" + e.name);
        places.push_back(e.place);
        sizes.push_back(fmt::format("{:.4g}", e.size));
    }
    const std::string hidden =
        names.empty() ? "nothing\t\t"
                      : fmt::format("{}\t{}\t{}", fmt::join(names, "+"), fmt::join(places, "+"), fmt::join(sizes, "+"));
    fmt::print("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.2f}\t{:.1f}\t{}\t{}\t{}\n", made.seed,
               made.model.law == hidden::Law::nonsmooth ? "A" : "B", made.planned.specimen.name, hidden,
               to_string(story.verdict), named.mechanism, named.place,
               story.named.empty() ? "" : fmt::format("{:.4g}", named.size),
               named.low ? fmt::format("{:.4g}..{:.4g}", *named.low, *named.high) : "", story.share, story.log_evidence,
               done, judged(made, story), size_within(made, story));
    for (const StoryStep& step : story.steps) {
        std::vector<const StoryEstimate*> order;
        for (const StoryEstimate& e : step.seen)
            order.push_back(&e);
        std::ranges::sort(order, [](auto* a, auto* b) { return std::fabs(a->deviations) > std::fabs(b->deviations); });
        std::string told;
        for (std::size_t k = 0; k < std::min(estimates, order.size()); ++k)
            told +=
                fmt::format(" {}[{}]={:+.1f}{} ({:.3g} +- {:.2g})", order[k]->name, order[k]->joint,
                            order[k]->deviations, order[k]->from_the_others ? "o" : "", order[k]->value, order[k]->sd);
        fmt::print("#   {} lnE {:.1f} {}:{}\n", step.test, step.log_evidence, to_string(step.verdict), told);
    }
}

/// @param number of the specimen, from 0   @returns whether it was assessed
bool assess(const Assessment& how, std::uint64_t seed, std::size_t number)
{
    Wish wish;
    wish.most_motions = 0;
    if (how.nothing || !how.effects.empty())
        wish.effects = effects_of(how, number);
    if (!how.law.empty())
        wish.law = how.law == "nonsmooth" ? hidden::Law::nonsmooth : hidden::Law::compliant;
    if (how.specimen == "column")
        wish.specimen = SpecimenKind::small_column;
    const VirtualCampaign made = make_campaign(seed, wish);
    if (how.blocks > 0 && made.planned.specimen.blocks() != how.blocks)
        return false;
    Campaign campaign;
    campaign.source = made.campaign.source;
    campaign.specimen = made.planned.specimen;
    const Study study = parse_study(study_text_of(made.planned), "study", {});
    LoopOptions options;
    options.plan.healthy = how.healthy;
    options.plan.of_each_cause = how.of_each;
    options.run.isa = best_isa();
    options.run.threads = how.threads;
    fs::create_directories(how.cache);
    options.cache = fs::path(how.cache) /
                    fmt::format("{}_{:g}.txt", campaign.specimen.blocks(), campaign.specimen.half_width_m.front());
    Observer observer;
    if (how.signatures) {
        tell_signatures(campaign, study, options, how.only);
        return true;
    }
    std::vector<MeasuredRun> plans;
    std::string done;
    std::optional<TestStory> story;
    const std::vector<PriorShare> prior = prior_of(how, made);
    for (int i = 0;; ++i) {
        story = laboratory_loop(campaign, study, prior, options, observer);
        if (how.options) {
            std::string told;
            for (const StoryOption& o : story->options)
                told += fmt::format(" {} {:.3f}{}", o.test, o.per_cost, o.left_out.empty() ? "" : "!");
            fmt::print("#   fall per cost:{}\n", told);
        }
        if (how.by_entropy && !story->next.empty()) {
            const auto fall = [](const StoryOption& o) { return o.left_out.empty() ? o.entropy_fall / o.cost : 0.0; };
            story->next = {std::ranges::max_element(story->options, {}, fall)->test};
        }
        if (!how.order.empty())
            story->next = i < static_cast<int>(how.order.size()) ? std::vector{how.order[static_cast<std::size_t>(i)]}
                                                                 : std::vector<std::string>();
        if (story->next.empty() || i == how.tests)
            break;
        done += (done.empty() ? "" : " ") + story->next.front();
        add_test(campaign, story->next.front(), plans);
        Campaign plan;
        plan.specimen = made.planned.specimen;
        plan.tests = plans;
        campaign = tested(made, plan);
    }
    tell(made, *story, done, how.estimates);
    std::fflush(stdout);
    return true;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("The laboratory in the loop, on virtual specimens.");
    Assessment how;
    app.add_option("--first", how.first, "first seed")->required();
    app.add_option("--last", how.last, "last seed")->required();
    app.add_option("--effect", how.effects, "hidden effects, instead of those of the seeds");
    app.add_flag("--in-turn", how.in_turn, "one of the effects for each seed, one after the other");
    app.add_option("--second", how.second, "with --in-turn: also the effect that stands so many further on");
    app.add_option("--blocks", how.blocks, "columns of so many blocks alone");
    app.add_option("--most", how.most, "at most so many specimens");
    app.add_flag("--nothing", how.nothing, "no hidden effect");
    app.add_option("--law", how.law)->check(CLI::IsMember({"nonsmooth", "compliant"}));
    app.add_option("--specimen", how.specimen)->check(CLI::IsMember({"column"}));
    app.add_option("--prior", how.prior, "flat, group (the right one), or a folder of diagnoses SEED.h5");
    app.add_option("--tests", how.tests, "at most");
    app.add_option("--cache", how.cache, "folder");
    app.add_option("--healthy", how.healthy);
    app.add_option("--of-each", how.of_each);
    app.add_option("--threads", how.threads);
    app.add_option("--estimates", how.estimates, "of a step, that are told");
    app.add_flag("--options", how.options, "tells what is expected of each test");
    app.add_flag("--by-entropy", how.by_entropy,
                 "the test that lets the entropy of the belief fall most per cost, instead of the proposed one");
    app.add_option("--order", how.order, "tests that are done, instead of those that are proposed");
    app.add_option("--only", how.only, "with --signatures: of these tests");
    app.add_flag("--signatures", how.signatures, "tells what healthy specimens and causes give, and does no test");
    try {
        app.parse(argc, argv);
        std::size_t number = 0;
        for (std::uint64_t seed = how.first; seed <= how.last && (how.most == 0 || number < how.most); ++seed)
            number += assess(how, seed, number) ? 1 : 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "loop_assessment: {}\n", error.what());
        return 1;
    }
    return 0;
}
