#include "studies/measured/loop/sequence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t told_shares = 4, told_estimates = 4, told_tests = 5; // rows of the tables; data have them all

std::vector<BelievedShare> told_belief(const SequenceModel& model, const Belief& belief)
{
    std::vector<BelievedShare> out = {{"nothing", belief.nothing}, {"not listed", belief.unlisted}};
    for (std::size_t i = 0; i < belief.causes.size(); ++i)
        out.push_back({model.hypotheses.causes[i].label(), belief.causes[i]});
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    return out;
}

SequenceFinding told_finding(const SequenceModel& model, const SequenceJudgement& judgement)
{
    SequenceFinding out;
    out.verdict = judgement.verdict;
    out.log_evidence = judgement.log_evidence;
    out.share = judgement.share;
    out.size = judgement.size;
    out.deviations = judgement.deviations;
    out.doubtful = judgement.doubtful;
    if (judgement.cause) {
        out.cause = judgement.cause->label();
        for (const CauseSignature& c : model.signatures.causes)
            if (c.cause.mechanism == judgement.cause->mechanism)
                out.unit = c.cause.unit;
    }
    for (const Eigen::Index column : judgement.off)
        out.off.push_back(model.signatures.columns[static_cast<std::size_t>(column)]);
    return out;
}

std::string percent(double share)
{
    return share >= 0.995 && share < 1  ? "> 99 %"
           : share > 0 && share < 0.005 ? "< 1 %"
                                        : fmt::format("{:.0f} %", 100 * share);
}

std::string with_unit(double value, const std::string& unit)
{
    return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

/// E in a range that can be read.
std::string evidence_text(double log_evidence)
{
    return log_evidence > 13.8 ? fmt::format("E = 1e{:.0f}", std::floor(log_evidence / std::log(10.0)))
                               : fmt::format("E = {:.2g}", std::exp(log_evidence));
}

std::string estimate_text(const TestColumn& column)
{
    return fmt::format("{} ({} at joint {})", column.name, test_kind_name(column.test), column.joint);
}

std::string believed_text(const std::vector<BelievedShare>& shares)
{
    std::string out;
    for (std::size_t i = 0; i < std::min(told_shares, shares.size()); ++i)
        out += fmt::format("{}{} {}", i > 0 ? ", " : "", shares[i].what, percent(shares[i].share));
    return out;
}

void add_step(Document& document, const SequenceStep& step, std::size_t number)
{
    document.heading(
        fmt::format("{}. {}{}", number, test_words(step.test, step.joint), step.repeat ? ", repeated" : ""));
    document.facts({{"Believed before", believed_text(step.before)},
                    {"Believed after", believed_text(step.after)},
                    {"Evidence", evidence_text(step.finding.log_evidence)}});
    HtmlTable table;
    table.align = "lrrrl";
    table.head = {"estimate", "value", "expected", "standard deviations", "expected by"};
    for (std::size_t i = 0; i < std::min(told_estimates, step.seen.size()); ++i) {
        const auto& [column, seen] = step.seen[i];
        table.rows.push_back({fmt::format("{} at joint {}", column.name, column.joint),
                              with_unit(seen.value, column.unit), with_unit(seen.expected, column.unit),
                              fmt::format("{:+.1f}", seen.deviations),
                              seen.from_the_others ? "the other joints" : "healthy specimens"});
    }
    if (!table.rows.empty())
        document.table(table);
}

void add_limits(Document& document, const SequenceReport& report)
{
    HtmlTable table;
    table.align = "lr";
    table.head = {"cause", "size at most (95 %)"};
    for (const SizeLimit& limit : report.limits)
        table.rows.push_back({limit.cause.label() + (limit.below_neutral ? ", below 0" : ""),
                              limit.size ? with_unit(*limit.size, limit.unit)
                                         : fmt::format("no limit up to {}", with_unit(limit.strongest, limit.unit))});
    if (!table.rows.empty())
        document.table(table);
    if (!report.untested.empty()) {
        std::string names;
        for (const std::string& name : report.untested)
            names += (names.empty() ? "" : ", ") + name;
        document.paragraph("Not tested: " + names + ".");
    }
}

void add_rated(Document& document, const std::vector<RatedTest>& tests, std::size_t most)
{
    HtmlTable table;
    table.align = "lrrr";
    table.head = {"test", "cost", "expected fall of entropy", "per cost"};
    std::vector<Html> reasons;
    for (const RatedTest& test : tests)
        if (test.left_out)
            reasons.push_back(test_words(test.option.test, test.option.joint) + ": " + *test.left_out);
        else if (table.rows.size() < most)
            table.rows.push_back({test_words(test.option.test, test.option.joint),
                                  fmt::format("{:g}", test.option.cost), fmt::format("{:.2f}", test.entropy_fall),
                                  fmt::format("{:.3g}", test.per_cost)});
    if (!table.rows.empty())
        document.table(table);
    if (!reasons.empty()) {
        document.paragraph("Left out:");
        document.list(reasons);
    }
}

Json shares_json(const std::vector<BelievedShare>& shares)
{
    return json_list(
        shares, [](const BelievedShare& s) { return Json::object().member("what", s.what).member("share", s.share); });
}

Json& with_test(Json& json, RunKind test, const std::optional<int>& joint)
{
    json.member("test", test_kind_name(test));
    return joint ? json.member("joint", *joint) : json.member("joint", "all");
}

Json column_json(const TestColumn& c)
{
    Json json = Json::object();
    return with_test(json, c.test, c.joint)
        .member("estimate", c.name)
        .member("unit", c.unit)
        .member("depends_on", c.depends_on);
}

Json& with_finding(Json& json, const SequenceFinding& f)
{
    json.member("verdict", to_string(f.verdict)).member("ln_evidence", f.log_evidence);
    if (f.cause)
        json.member("cause", *f.cause)
            .member("share", f.share)
            .member("size", f.size)
            .member("unit", f.unit)
            .member("standard_deviations", f.deviations);
    return json.member("doubtful", f.doubtful).member("off", json_list(f.off, column_json));
}

Json step_json(const SequenceStep& step)
{
    Json json = Json::object();
    with_test(json, step.test, step.joint)
        .member("repeat", step.repeat)
        .member("believed_before", shares_json(step.before))
        .member("seen", json_list(step.seen,
                                  [](const ToldEstimate& e) {
                                      Json seen = column_json(e.column);
                                      return seen.member("value", e.seen.value)
                                          .member("expected", e.seen.expected)
                                          .member("standard_deviations", e.seen.deviations)
                                          .member("expected_by",
                                                  e.seen.from_the_others ? "other joints" : "healthy specimens");
                                  }))
        .member("believed_after", shares_json(step.after));
    return with_finding(json, step.finding);
}

Json limit_json(const SizeLimit& limit)
{
    Json json = Json::object();
    json.member("cause", limit.cause.label())
        .member("unit", limit.unit)
        .member("below_neutral", limit.below_neutral)
        .member("strongest", limit.strongest);
    return limit.size ? json.member("at_most", *limit.size) : json.member_as_is("at_most", "null");
}

Json rated_json(const RatedTest& test)
{
    Json json = Json::object();
    with_test(json, test.option.test, test.option.joint).member("cost", test.option.cost);
    if (test.left_out)
        return json.member("left_out", *test.left_out);
    return json.member("entropy_fall", test.entropy_fall).member("per_cost", test.per_cost);
}

} // namespace

SequenceReport sequence_report(const SequenceModel& model, const std::vector<DoneTest>& tests,
                               std::vector<RatedTest> next)
{
    SequenceReport out;
    out.next = std::move(next);
    out.prior = told_belief(model, belief_of(model, {}));
    std::vector<SeenEstimate> seen;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        SequenceStep step;
        step.test = tests[i].test;
        step.joint = tests[i].joint;
        step.repeat =
            std::any_of(tests.begin(), tests.begin() + static_cast<std::ptrdiff_t>(i), [&](const DoneTest& t) {
                return t.test == tests[i].test && (!t.joint || t.joint == tests[i].joint);
            });
        step.before = told_belief(model, belief_of(model, seen));
        const std::vector<SeenEstimate> more = seen_estimates(model.signatures, tests[i]);
        for (const SeenDeviation& d : deviations_of(model.signatures, more))
            step.seen.push_back({model.signatures.columns[static_cast<std::size_t>(d.column)], d});
        std::stable_sort(step.seen.begin(), step.seen.end(), [](const ToldEstimate& a, const ToldEstimate& b) {
            return std::fabs(a.seen.deviations) > std::fabs(b.seen.deviations);
        });
        seen.insert(seen.end(), more.begin(), more.end());
        step.after = told_belief(model, belief_of(model, seen));
        step.finding = told_finding(model, judgement_of(model, seen));
        out.steps.push_back(std::move(step));
    }
    out.finding = told_finding(model, judgement_of(model, seen));
    out.limits = limits_of(model, seen);
    for (const CausePlace& cause : model.hypotheses.causes)
        if (std::none_of(out.limits.begin(), out.limits.end(),
                         [&](const SizeLimit& l) { return l.cause.mechanism == cause.mechanism; }) &&
            std::find(out.untested.begin(), out.untested.end(), cause.mechanism) == out.untested.end())
            out.untested.push_back(cause.mechanism);
    return out;
}

std::string finding_words(const SequenceFinding& f)
{
    const std::string evidence = evidence_text(f.log_evidence);
    switch (f.verdict) {
    case SequenceVerdict::named:
        return fmt::format("{} acts, with a size of {}: {:.1f} standard deviations, {} ({:g} is needed), {} of the "
                           "belief.",
                           *f.cause, with_unit(f.size, f.unit), f.deviations, evidence, evidence_to_name,
                           percent(f.share));
    case SequenceVerdict::unexplained: {
        const TestColumn& first = f.off.front();
        return fmt::format("Unexplained: {}{} is beyond what healthy specimens show, and no cause of the list gives it "
                           "({}).{}",
                           estimate_text(first), f.off.size() > 1 ? " and at the other joints" : "", evidence,
                           first.depends_on.empty() ? "" : fmt::format(" What acts depends on {}.", first.depends_on));
    }
    case SequenceVerdict::none:
        return fmt::format("Nothing was found ({}; {:g} is needed). The limits below hold for the causes that were "
                           "tested.",
                           evidence, evidence_to_name);
    case SequenceVerdict::open:
        break;
    }
    if (!f.cause)
        return "Nothing is decided yet.";
    return fmt::format("Nothing is decided yet: {} is suspected, by {:.1f} standard deviations ({}; {:g} is needed).{}",
                       *f.cause, f.deviations, evidence, evidence_to_name,
                       f.doubtful ? " A repeat, or another test of its group, decides." : "");
}

void add_sequence(Document& document, const SequenceReport& report)
{
    document.answer(finding_words(report.finding));
    if (!report.next.empty()) {
        document.heading("The next test");
        if (report.next.front().left_out)
            document.paragraph("No test that the laboratory can do is expected to decide more.");
        add_rated(document, report.next, told_tests);
    }
    if (report.steps.empty())
        document.facts({{"Believed by the first diagnosis", believed_text(report.prior)}});
    for (std::size_t i = 0; i < report.steps.size(); ++i)
        add_step(document, report.steps[i], i + 1);
    if (!report.steps.empty()) {
        document.heading("Limits");
        add_limits(document, report);
    }
}

void add_test_plan(Document& document, const std::vector<RatedTest>& plan, const std::vector<RatedTest>& rated)
{
    document.heading("Planned tests");
    if (plan.empty())
        document.paragraph("No test that the laboratory can do is expected to tell anything.");
    std::vector<RatedTest> told = plan;
    std::copy_if(rated.begin(), rated.end(), std::back_inserter(told),
                 [](const RatedTest& test) { return test.left_out.has_value(); });
    add_rated(document, told, plan.size());
}

Json json_of(const SequenceReport& report)
{
    Json json = Json::object();
    return with_finding(json, report.finding)
        .member("prior", shares_json(report.prior))
        .member("steps", json_list(report.steps, step_json))
        .member("limits", json_list(report.limits, limit_json))
        .member("untested", Json::list(report.untested))
        .member("next", json_list(report.next, rated_json));
}

} // namespace stylobate
