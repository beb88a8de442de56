#include "studies/measured/loop/choice.hpp"

#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

constexpr double least_gain = 0.003; // of the belief: less is within the error of the draws

/// Numbers of one draw. A column has the same number in every test; what varies between specimens has others.
class PredictionDraw {
public:
    PredictionDraw(const ChoiceSettings& settings, int draw) : settings_(settings), draw_(draw) {}
    double uniform(std::uint64_t element) const
    {
        return uniform01(settings_.seed, static_cast<std::uint64_t>(draw_), Stream::predicted_test, element);
    }
    /// Of the estimates in these columns, and of the spread of a hypothesis.
    Eigen::VectorXd normals(const std::vector<Eigen::Index>& columns, Eigen::Index ranks) const
    {
        const auto n = static_cast<Eigen::Index>(columns.size());
        Eigen::VectorXd out(n + ranks);
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = columns.begin() + i;
            const auto repeat = static_cast<std::uint64_t>(std::count(columns.begin(), at, *at));
            out(i) = to_normal(uniform(first_column + (repeat << 16) + static_cast<std::uint64_t>(*at)));
        }
        for (Eigen::Index k = 0; k < ranks; ++k)
            out(n + k) = to_normal(uniform(first_rank + static_cast<std::uint64_t>(k)));
        return out;
    }
    static constexpr std::uint64_t radius = 1, hypothesis = 0, first_column = 1ULL << 20, first_rank = 1ULL << 21;

private:
    const ChoiceSettings& settings_;
    int draw_;
};

/// Whether a shift of a listed cause shows in one of the columns.
bool any_cause_shows(const SequenceModel& model, const std::vector<Eigen::Index>& columns,
                     const std::optional<std::string>& group)
{
    return std::any_of(model.signatures.causes.begin(), model.signatures.causes.end(), [&](const CauseSignature& c) {
        return (!group || cause_group(c.cause.mechanism) == *group) && c.shift(columns).squaredNorm() > 0;
    });
}

std::optional<std::string> why_left_out(const SequenceModel& model, const TestOption& option,
                                        const std::vector<Eigen::Index>& columns)
{
    if (option.cannot)
        return option.cannot;
    if (columns.empty())
        return "it gives no estimate in more than a quarter of the simulated specimens";
    if (!any_cause_shows(model, columns, std::nullopt))
        return "no cause of the list shows in it";
    return std::nullopt;
}

/// In the mechanism at the place where a hypothesis acts.
double belief_in(const SequenceModel& model, const Belief& belief, std::size_t hypothesis)
{
    const int cause = model.hypotheses.each[hypothesis].cause;
    return cause < 0 ? belief.unlisted : belief.at_place(model.hypotheses, static_cast<std::size_t>(cause));
}

ExpectedBelief present_belief(const SequenceModel& model, std::span<const SeenEstimate> seen)
{
    const Belief now = belief_of(model, seen);
    ExpectedBelief out{now.entropy(), 0};
    for (std::size_t h = 0; h < now.hypothesis.size(); ++h)
        out.in_truth += now.hypothesis[h] * belief_in(model, now, h);
    return out;
}

/// Rates a test that is done after others of which the outcome is not known yet.
/// @param planned columns of those
RatedTest rated(const SequenceModel& model, std::span<const SeenEstimate> seen,
                const std::vector<Eigen::Index>& planned, const TestOption& option, const ChoiceSettings& settings,
                const Prospects& prospects)
{
    RatedTest test{option, 0, 0, 0, std::nullopt};
    std::vector<SequenceModel> models;
    if (prospects && !option.cannot)
        models = prospects(option);
    if (models.empty())
        models.push_back(model);
    std::optional<std::string> why;
    std::size_t useful = 0;
    for (const SequenceModel& one : models) {
        const std::vector<Eigen::Index> columns = columns_of(one.signatures, option);
        if ((why = why_left_out(one, option, columns)))
            continue;
        ++useful;
        std::vector<Eigen::Index> before = planned;
        std::erase_if(before, [&](Eigen::Index k) { return !one.signatures.used[static_cast<std::size_t>(k)]; });
        std::vector<Eigen::Index> all = before;
        all.insert(all.end(), columns.begin(), columns.end());
        const ExpectedBelief without = before.empty() ? present_belief(one, seen)
                                                      : expected_belief(one, seen, before, settings),
                             with = expected_belief(one, seen, all, settings);
        const auto n = static_cast<double>(models.size());
        test.entropy_fall += (without.entropy - with.entropy) / n;
        test.belief_gain += (with.in_truth - without.in_truth) / n;
    }
    test.per_cost = test.belief_gain / test.option.cost;
    if (useful == 0)
        test.left_out = why;
    else if (test.belief_gain < least_gain)
        test.left_out = "it is expected to tell nothing more";
    return test;
}

void best_first(std::vector<RatedTest>& tests)
{
    std::stable_sort(tests.begin(), tests.end(), [](const RatedTest& a, const RatedTest& b) {
        if (a.left_out.has_value() != b.left_out.has_value())
            return b.left_out.has_value();
        return a.per_cost > b.per_cost;
    });
}

} // namespace

std::vector<Eigen::Index> columns_of(const Signatures& signatures, const TestOption& option)
{
    std::vector<Eigen::Index> out;
    for (std::size_t j = 0; j < signatures.columns.size(); ++j)
        if (signatures.used[j] && signatures.columns[j].test == option.test &&
            (!option.joint || signatures.columns[j].joint == *option.joint))
            out.push_back(static_cast<Eigen::Index>(j));
    return out;
}

ExpectedBelief expected_belief(const SequenceModel& model, std::span<const SeenEstimate> seen,
                               const std::vector<Eigen::Index>& columns, const ChoiceSettings& settings)
{
    std::vector<Eigen::Index> all;
    std::vector<double> values;
    for (const SeenEstimate& estimate : seen)
        if (model.signatures.used[static_cast<std::size_t>(estimate.column)] && std::isfinite(estimate.value)) {
            all.push_back(estimate.column);
            values.push_back(estimate.value);
        }
    const auto known = static_cast<Eigen::Index>(all.size());
    all.insert(all.end(), columns.begin(), columns.end());
    const JointDensity density(model.signatures, model.hypotheses, all);
    Eigen::VectorXd padded = model.signatures.mean(all);
    padded.head(known) = Eigen::Map<const Eigen::VectorXd>(values.data(), known);
    const Eigen::VectorXd first = density.whitened(padded).head(known);
    const Belief now = belief_of(model, seen);

    ExpectedBelief sum;
    for (int i = 0; i < settings.draws; ++i) {
        const PredictionDraw draw(settings, i);
        // systematic: every hypothesis acts as often as it is believed in, to within one draw
        double left =
            (i + PredictionDraw(settings, 0).uniform(PredictionDraw::hypothesis)) / settings.draws - now.nothing;
        std::optional<std::size_t> acting;
        for (std::size_t h = 0; h < now.hypothesis.size() && left >= 0; ++h) {
            acting = h;
            left -= now.hypothesis[h];
        }
        const Eigen::Index ranks = acting ? model.hypotheses.each[*acting].spread.cols() : 0;
        const Eigen::VectorXd white =
            density.continued(acting, first, draw.normals(columns, ranks), draw.uniform(PredictionDraw::radius));
        const Belief after = belief_from(model, density.log_ratios(white));
        sum.entropy += after.entropy() / settings.draws;
        if (acting)
            sum.in_truth += belief_in(model, after, *acting) / settings.draws;
    }
    return sum;
}

std::vector<RatedTest> rated_tests(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                   const std::vector<TestOption>& options, const ChoiceSettings& settings,
                                   const Prospects& prospects)
{
    std::vector<RatedTest> out(options.size());
    in_parallel(std::size_t{0}, options.size(),
                [&](std::size_t i) { out[i] = rated(model, seen, {}, options[i], settings, prospects); });
    best_first(out);
    return out;
}

std::optional<RatedTest> chosen_test(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                     const std::vector<RatedTest>& rated)
{
    const SequenceJudgement judgement = judgement_of(model, seen);
    if (judgement.doubtful && judgement.cause && !seen.empty()) {
        const TestColumn& last = model.signatures.columns[static_cast<std::size_t>(seen.back().column)];
        const std::string group = cause_group(judgement.cause->mechanism);
        for (const RatedTest& test : rated)
            if (const TestOption& option = test.option;
                !test.left_out && ((option.test == last.test && (!option.joint || *option.joint == last.joint)) ||
                                   any_cause_shows(model, columns_of(model.signatures, option), group)))
                return test;
    }
    return !rated.empty() && !rated.front().left_out ? std::optional(rated.front()) : std::nullopt;
}

std::vector<RatedTest> planned_tests(const SequenceModel& model, const std::vector<TestOption>& options,
                                     std::size_t count, const ChoiceSettings& settings, const Prospects& prospects)
{
    std::vector<RatedTest> out;
    std::vector<Eigen::Index> planned;
    while (out.size() < count) {
        std::vector<TestOption> left = options;
        std::erase_if(left, [&](const TestOption& option) {
            return std::any_of(out.begin(), out.end(), [&](const RatedTest& t) { return t.option == option; });
        });
        std::vector<RatedTest> tests(left.size());
        in_parallel(std::size_t{0}, left.size(),
                    [&](std::size_t i) { tests[i] = rated(model, {}, planned, left[i], settings, prospects); });
        best_first(tests);
        if (tests.empty() || tests.front().left_out)
            break;
        const std::vector<Eigen::Index> more = columns_of(model.signatures, tests.front().option);
        planned.insert(planned.end(), more.begin(), more.end());
        out.push_back(tests.front());
    }
    return out;
}

} // namespace stylobate
