#include "studies/diagnosis/decision/statistics_verdict.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double half_width90 = 1.6449; // of a normal interval of 90 %, in standard deviations

JudgedCause judged(const EnsembleDiagnosis& ensemble, std::size_t candidate, const CauseLikelihood& found)
{
    const EnsembleVerdict& verdict = ensemble.verdict;
    const CandidateCause& cause = ensemble.causes[candidate];
    JudgedCause j;
    j.channel = Channel::statistics;
    j.fit.cause = cause.cause;
    j.fit.size = cause.size_of(found.size);
    j.fit.sd = std::fabs(cause.size_of(found.high) - cause.size_of(found.low)) / (2 * half_width90);
    j.fit.gain = std::max(found.gain, 0.0);
    std::vector<double> nulls = verdict.null_gains;
    std::sort(nulls.begin(), nulls.end());
    j.chance95 = nulls.empty() ? 0 : sorted_quantile(nulls, 0.95, QuantileDefinition::linear);
    j.chance = conformal_p_value(verdict.null_gains, found.gain);
    j.surprise = found.gain - j.chance95;
    return j;
}

/// What of the residual stands out most beside the best cause, in words.
StructureFit left_over(const EnsembleDiagnosis& ensemble)
{
    const EnsembleVerdict& verdict = ensemble.verdict;
    const Eigen::VectorXd left = verdict.residual - verdict.shift;
    Eigen::Index most = 0;
    left.cwiseAbs().maxCoeff(&most);
    const StatisticLabel& label =
        ensemble.statistics[static_cast<std::size_t>(verdict.used[static_cast<std::size_t>(most)])];
    StructureFit fit;
    fit.structure.block = label.block >= 0 ? label.block : label.joint;
    const bool turns =
        label.name.find("rotation") != std::string::npos || label.name.find("open") != std::string::npos ||
        label.name.find("turning") != std::string::npos || label.name.find("closure") != std::string::npos;
    fit.structure.coordinate = turns ? "theta" : "x";
    fit.structure.depends_on = label.name;
    const std::string where = label.joint >= 0   ? fmt::format("joint {}", label.joint)
                              : label.block >= 0 ? fmt::format("block {}", label.block)
                                                 : std::string("the campaign");
    fit.structure.text =
        fmt::format("{} of {}{} is {:.1f} standard deviations from what the best cause gives", label.name, where,
                    label.motion >= 0 ? fmt::format(" under motion {}", label.motion) : "", left(most));
    fit.gain = left.squaredNorm() / 2;
    return fit;
}

} // namespace

Decided decide(const DirectResult& direct, const EnsembleDiagnosis& ensemble)
{
    Decided out;
    out.named = named_directly(direct);
    const EnsembleVerdict& verdict = ensemble.verdict;
    std::vector<std::size_t> order(ensemble.causes.size());
    for (std::size_t c = 0; c < order.size(); ++c)
        order[c] = c;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return verdict.causes[a].gain > verdict.causes[b].gain; });
    const bool probable = verdict.named && verdict.probability >= least_probability;
    for (const std::size_t c : order) {
        JudgedCause j = judged(ensemble, c, verdict.causes[c]);
        const bool best = static_cast<int>(c) == verdict.best;
        const bool in_set =
            std::find(verdict.set.begin(), verdict.set.end(), ensemble.mechanism_of(c)) != verdict.set.end();
        if (best) {
            j.considered = probable && !verdict.unexplained;
            j.probability = verdict.named ? verdict.probability : 0;
            if (!verdict.named)
                j.why_not = fmt::format("the p-value of the gain is {:.2g}", verdict.p_value);
            else if (!probable)
                j.why_not = fmt::format("possible, with a probability of {:.2f}", verdict.probability);
            if (j.considered)
                out.named.push_back(j);
        } else if (probable && in_set && !verdict.unexplained && j.fit.gain > 0) {
            j.considered = true;
            out.in_set.push_back(j);
        }
        out.judged.push_back(std::move(j));
    }
    if (probable && !verdict.unexplained && verdict.second >= 0) {
        JudgedCause second = judged(ensemble, static_cast<std::size_t>(verdict.second), verdict.second_likelihood);
        second.considered = true;
        second.chance = verdict.second_p_value;
        second.probability = std::min(verdict.probability, 1 - verdict.second_p_value);
        std::erase_if(out.in_set,
                      [&](const JudgedCause& j) { return j.fit.cause.mechanism == second.fit.cause.mechanism; });
        out.named.push_back(second);
    }
    if (verdict.unexplained) {
        out.unexplained = left_over(ensemble);
        out.unexplained_chance = verdict.left_p_value;
    }
    out.verdict = out.unexplained ? Verdict::unexplained : out.named.empty() ? Verdict::none : Verdict::named;
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const JudgedCause& a, const JudgedCause& b) { return a.probability > b.probability; });
    return out;
}

} // namespace stylobate
