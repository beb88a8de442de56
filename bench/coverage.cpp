/// How often the intervals of fragility estimates hold the truth, as Markdown tables on standard output.
///
///   stylobate_coverage [--repeats N] [--resamples N]
///
/// Outcomes are drawn from curves that are known (`tests/ensemble/estimators/fragility_truth.hpp`); no mechanics.
/// `scripts/tables.sh coverage` writes the tables into docs/fragility_statistics.md.

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/dispersion_shares.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "io/tables/table.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"
#include "tests/ensemble/estimators/nested_truth.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {
namespace {

struct Case {
    std::string name;
    FragilityTruth truth;
};

std::vector<Case> cases()
{
    const auto all = [](std::size_t records, double between, double within) {
        return Case{fmt::format("{} records, all at all stripes; between {}, within {}", records, between, within),
                    {.between = between, .within = within, .records = records}};
    };
    const auto own = [](std::size_t records) {
        return Case{fmt::format("{} records, each at one stripe; between 0.3, within 0.3", records),
                    {.records = records, .own_stripe = true}};
    };
    return {all(10, 0.3, 0.3), all(20, 0.3, 0.3), all(40, 0.3, 0.3), all(100, 0.3, 0.3),
            all(40, 0.4, 0.1), all(40, 0.1, 0.4), own(40),           own(96)};
}

bool covers(const Limits& limits, double value)
{
    return limits.lower <= value && value <= limits.upper;
}

void curve_coverage(std::uint64_t repeats, std::size_t resamples)
{
    fmt::print(
        "\n### Curves\n\nPercent of {} repeats in which the 95 % interval contains the truth (one standard error: "
        "{:.2f}); bootstrap in a fifth of them with {} resamples. Stripes at 0.5 to 2.4 of the median, 5 runs "
        "of a record at each "
        "of its stripes. A repeat without a maximum of the likelihood gives no curve and is not counted.\n\n",
        repeats, 100 * std::sqrt(0.0475 / static_cast<double>(repeats)), resamples);
    fmt::print("{}",
               markdown_head("records | of | profile, by runs | profile, by records | CR3 | **jackknife** | percentile "
                             "| BCa | studentized | no maximum"));
    for (const Case& c : cases()) {
        const FragilityTruth& truth = c.truth;
        const double beta = truth.dispersion(), low = std::exp(-beta), high = std::exp(1.5 * beta);
        const auto at = [](double im) { return CurveTarget::sum((ParameterVector(2) << 1, std::log(im)).finished()); };
        const std::vector<CurveTarget> targets = {CurveTarget::log_median(), CurveTarget::slope(), at(low), at(high)};
        const double values[] = {0, 1 / beta, -1, 1.5};
        const char* const names[] = {"median", "dispersion", "P where it is 0.16", "P where it is 0.93"};
        std::array<std::array<std::uint64_t, 7>, 4> covered{};
        std::uint64_t counted = 0, drawn_again = 0;
        for (std::uint64_t r = 0; r < repeats; ++r) {
            const FragilityData data = grouped(truth.draw(31, r));
            const FittedCurve curve = fitted_curve(data, log_predictors(data), Link::probit);
            if (curve.fit.maximum != Maximum::inside)
                continue;
            ++counted;
            const Jackknife without = jackknife(curve);
            std::vector<BootstrapLimits> resampled(targets.size());
            const bool again = r < repeats / 5;
            drawn_again += again ? 1 : 0;
            if (again)
                resampled = bootstrap_limits(curve, targets, 0.95, resamples, r);
            for (std::size_t t = 0; t < targets.size(); ++t) {
                const Limits limits[] = {profile_limits(curve, targets[t], 0.95),
                                         record_limits(curve, targets[t], 0.95),
                                         wald_limits(curve, targets[t], 0.95),
                                         jackknife_limits(curve, without, targets[t], 0.95),
                                         resampled[t].percentile,
                                         resampled[t].accelerated,
                                         resampled[t].studentized};
                for (std::size_t m = 0; m < (again ? 7 : 4); ++m)
                    covered[t][m] += covers(limits[m], values[t]) ? 1 : 0;
            }
        }
        for (std::size_t t = 0; t < targets.size(); ++t) {
            fmt::print("| {} | {} |", t == 0 ? c.name : "", names[t]);
            for (std::size_t m = 0; m < 7; ++m)
                fmt::print(" {:.1f} |", 100 * static_cast<double>(covered[t][m]) /
                                            static_cast<double>(m < 4 ? counted : drawn_again));
            fmt::print(" {} |\n", t == 0 ? std::to_string(repeats - counted) : "");
        }
        std::fflush(stdout);
    }
}

void fit_sizes(std::uint64_t repeats)
{
    fmt::print("\n### Lack of fit\n\nPercent of {} repeats in which the lognormal curve is rejected at 5 %, by records "
               "and by the deviance from the shares of the stripes, which counts runs as independent; last columns: "
               "the probability of the stripe at 1.55 is reduced.\n\n",
               repeats);
    fmt::print("{}",
               markdown_head(
                   "records | true curve, by records | true curve, by deviance | reduced by 30 % | reduced by 60 %"));
    for (const Case& c : cases()) {
        std::array<std::uint64_t, 4> rejected{};
        for (std::uint64_t r = 0; r < repeats; ++r) {
            const double dips[] = {0, 0.3, 0.6};
            for (std::size_t d = 0; d < 3; ++d) {
                FragilityTruth truth = c.truth;
                truth.dip_stripe = 5;
                truth.dip = dips[d];
                const FragilityData data = grouped(truth.draw(32, r));
                const FittedCurve curve = fitted_curve(data, log_predictors(data), Link::probit);
                rejected[d == 0 ? 0 : d + 1] += lack_of_fit(curve).p_value < 0.05 ? 1 : 0;
                if (d > 0 || curve.fit.maximum != Maximum::inside)
                    continue;
                double saturated = 0;
                for (Eigen::Index i = 0; i < curve.counts.trials.size(); ++i) {
                    const double n = curve.counts.trials[i], k = curve.counts.reached[i];
                    saturated += (k > 0 ? k * std::log(k / n) : 0) + (k < n ? (n - k) * std::log1p(-k / n) : 0);
                }
                rejected[1] += 2 * (saturated - curve.fit.log_likelihood) > 12.5916 ? 1 : 0; // chi-square, 6 degrees
            }
        }
        fmt::print("| {} |", c.name);
        for (const std::uint64_t count : rejected)
            fmt::print(" {:.1f} |", 100 * static_cast<double>(count) / static_cast<double>(repeats));
        fmt::print("\n");
        std::fflush(stdout);
    }
}

void stripe_coverage(std::uint64_t repeats)
{
    fmt::print("\n### Shares by stripe and the monotone band\n\nPercent of {} repeats in which the interval of a "
               "stripe contains its probability (lowest, mean and highest of the eight), in which the band contains "
               "all at once, and in which a decrease is reported at 5 % although the truth only grows.\n\n",
               repeats);
    fmt::print("{}", markdown_head("records | lowest | mean | highest | band | decrease reported"));
    for (const Case& c : cases()) {
        std::vector<double> covered(c.truth.stripes.size(), 0);
        double band = 0, falls = 0;
        for (std::uint64_t r = 0; r < repeats; ++r) {
            const StripeShares shares = stripe_shares(grouped(c.truth.draw(33, r)), 0.95, r);
            bool all = true;
            for (std::size_t j = 0; j < covered.size(); ++j) {
                const double p = c.truth.probability(c.truth.stripes[j]);
                covered[j] += covers(shares.stripes[j].limits, p) ? 1 : 0;
                all = all && covers(shares.stripes[j].band, p);
            }
            band += all ? 1 : 0;
            falls += shares.p_monotone < 0.05 ? 1 : 0;
        }
        const double scale = 100 / static_cast<double>(repeats);
        double mean = 0;
        for (const double count : covered)
            mean += count * scale / static_cast<double>(covered.size());
        fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", c.name,
                   scale * *std::min_element(covered.begin(), covered.end()), mean,
                   scale * *std::max_element(covered.begin(), covered.end()), scale * band, scale * falls);
        std::fflush(stdout);
    }
}

/// Few motions that are damaged, or none: one stripe, where the probability is small.
void few_coverage(std::uint64_t repeats)
{
    fmt::print("\n### Few or no damaged records\n\nOne stripe, 30 runs of each record. Percent of {} repeats in which "
               "the 95 % interval contains the probability (one standard error: {:.1f}); in brackets its mean upper "
               "limit. Weak: the records have 10 % of the variance of ln capacity; strong: 80 %; complete: 99.9 %, so "
               "that all runs of a record have the same outcome.\n\n",
               repeats, 100 * std::sqrt(0.0475 / static_cast<double>(repeats)));
    fmt::print("{}", markdown_head("records | clustering | p = 0.005 | 0.01 | 0.02 | 0.05 | 0.2 | 0.5"));
    constexpr std::pair<const char*, double> clusterings[] = {{"weak", 0.1}, {"strong", 0.8}, {"complete", 0.999}};
    for (const std::size_t records : {10, 30, 100})
        for (const auto& [name, part] : clusterings) {
            fmt::print("| {} | {} |", records, name);
            for (const double p : {0.005, 0.01, 0.02, 0.05, 0.2, 0.5}) {
                FragilityTruth truth{.between = 0.4 * std::sqrt(part), .within = 0.4 * std::sqrt(1 - part)};
                truth.records = records;
                truth.runs = 30;
                truth.stripes = {std::exp(truth.dispersion() * link_quantile(Link::probit, p))};
                double held = 0, upper = 0;
                for (std::uint64_t r = 0; r < repeats; ++r) {
                    std::vector<RecordCount> counts;
                    for (const FragilityRun& run : truth.draw(36, r))
                        counts.push_back({run.trials, run.reached});
                    const Limits limits = record_share_limits(counts, 0.95);
                    held += covers(limits, p) ? 1 : 0;
                    upper += limits.upper;
                }
                fmt::print(" {:.1f} ({:.3f}) |", 100 * held / static_cast<double>(repeats),
                           upper / static_cast<double>(repeats));
            }
            fmt::print("\n");
            std::fflush(stdout);
        }
}

void share_coverage(std::uint64_t repeats)
{
    fmt::print("### Variance components\n\nStandard deviations 0.5 between records, 0.4 imperfections, 0.3 contact "
               "parameters, 0.3 chaos; 3 structures of a record, 2 sets of contact parameters of each, 2 replicas of "
               "each. Percent of {} repeats in which the 95 % interval of the share contains the truth, and the mean "
               "estimate with the truth (for outcomes: that of 200,000 records). Sum: the largest deviation of the sum "
               "of the four estimates from 1.\n\n",
               repeats);
    fmt::print("{}", markdown_head("response | records | record | imperfection | contact | chaos | sum"));
    for (const bool binary : {false, true}) {
        NestedTruth truth{.sd = {0.5, 0.4, 0.3, 0.3}, .binary = binary};
        std::array<double, 4> wanted{};
        if (binary) {
            truth.records = 200000;
            const DispersionShares large = dispersion_shares(truth.draw(34, 0));
            for (std::size_t l = 0; l < 4; ++l)
                wanted[l] = large.levels[l].share;
        } else
            for (std::size_t l = 0; l < 4; ++l)
                wanted[l] = truth.sd[l] * truth.sd[l] / 0.59;
        for (const std::size_t records : {20, 40, 100}) {
            truth.records = records;
            std::array<double, 4> covered{}, mean{};
            double away = 0;
            for (std::uint64_t r = 0; r < repeats; ++r) {
                const DispersionShares shares = dispersion_shares(truth.draw(35, r));
                double sum = 0;
                for (std::size_t l = 0; l < 4; ++l) {
                    covered[l] += covers(shares.levels[l].share_limits, wanted[l]) ? 1 : 0;
                    mean[l] += shares.levels[l].share / static_cast<double>(repeats);
                    sum += shares.levels[l].share;
                }
                away = std::max(away, std::abs(sum - 1));
            }
            fmt::print("| {} | {} |", binary ? "fallen or not" : "a number", records);
            for (std::size_t l = 0; l < 4; ++l)
                fmt::print(" {:.1f} ({:.3f}, truth {:.3f}) |", 100 * covered[l] / static_cast<double>(repeats), mean[l],
                           wanted[l]);
            fmt::print(" {:.0e} |\n", away);
            std::fflush(stdout);
        }
    }
}

} // namespace
} // namespace stylobate

int main(int argc, char** argv)
{
    CLI::App app("Coverage of the intervals of fragility estimates, as Markdown tables");
    std::uint64_t repeats = 10000;
    std::size_t resamples = 199;
    app.add_option("--repeats", repeats, "simulated campaigns of each kind")->check(CLI::Range(10, 1000000));
    app.add_option("--resamples", resamples, "resamples of each bootstrap")->check(CLI::Range(19, 100000));
    CLI11_PARSE(app, argc, argv);
    stylobate::share_coverage(repeats);
    stylobate::fit_sizes(repeats);
    stylobate::stripe_coverage(std::max<std::uint64_t>(10, repeats / 5));
    stylobate::few_coverage(std::max<std::uint64_t>(10, repeats / 5));
    stylobate::curve_coverage(repeats, resamples);
    return 0;
}
