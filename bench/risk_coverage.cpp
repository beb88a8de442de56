/// How often the intervals of annual frequencies hold the truth, where a test of fit chooses the form of the fragility:
/// a Markdown table on standard output.
///
///   stylobate_risk_coverage [--repeats N]
///
/// Campaigns are drawn from fragilities that are known (`tests/ensemble/estimators/fragility_truth.hpp`); no mechanics.
/// `scripts/tables.sh risk_coverage` writes the table into docs/risk.md.

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "io/tables/table.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

constexpr double k0 = 1e-3, k = 3;
/// Of the frequency from outside of the range of the runs: more gives no estimate (`RiskOptions::most_outside`).
constexpr double most_outside = 0.25;

struct Case {
    const char* name;
    std::vector<MixedTruth::Kind> kinds;
    bool of_records = false;
};

std::vector<Case> cases()
{
    return {{"lognormal, most of the scatter between motions", {{1, 1, 0.4, 0.2}}},
            {"lognormal, most of the scatter within motions", {{1, 1, 0.1, 0.4}}},
            {"slight misfit: 20 % of the structures at 0.6", {{0.8, 1, 0.3, 0.3}, {0.2, 0.6, 0.2, 0.15}}},
            {"slight misfit: 20 % of the motions at 0.6", {{0.8, 1, 0.25, 0.3}, {0.2, 0.6, 0.1, 0.2}}, true},
            {"two kinds of structures, 0.6 and 1.8", {{0.5, 0.6, 0.15, 0.15}, {0.5, 1.8, 0.15, 0.15}}},
            {"two kinds of motions, 0.6 and 1.8", {{0.5, 0.6, 0.15, 0.15}, {0.5, 1.8, 0.15, 0.15}}, true}};
}

/// Intervals that hold the truth, of those that there are.
struct Held {
    double held = 0, count = 0;

    void add(const FrequencyEstimate& e, double truth)
    {
        const Limits& l = e.frequency.total;
        held += l.lower <= truth && truth <= l.upper ? 1 : 0;
        ++count;
    }
    std::string text() const { return count > 0 ? fmt::format("{:.1f}", 100 * held / count) : "none"; }
};

void coverage(std::size_t repeats)
{
    fmt::print("Percent of {} campaigns in which the 90 % interval of the annual frequency holds the true one (one "
               "standard error: {:.1f}). Fragilities as named, medians in parts of 1 m/s2 and 5 runs of each motion at "
               "each of the stripes from 0.3 to 4 m/s2; a certain hazard 1e-3 im^-3. Rejected: campaigns in which the "
               "lognormal curve is rejected at 5 %, so that the shares are chosen. Not determined: more than 25 % of "
               "the frequency would come from outside of the stripes; these are not counted.\n\n",
               repeats, 100 * std::sqrt(0.09 / static_cast<double>(repeats)));
    fmt::print("{}", markdown_head("fragility | motions × stripes | rejected | not determined | lognormal alone | "
                                   "shares alone | **reported**"));
    for (const Case& c : cases())
        for (const auto& [motions, stripes] :
             {std::pair<std::size_t, int>{8, 6}, {8, 10}, {12, 8}, {20, 6}, {20, 10}}) {
            MixedTruth truth{c.kinds, c.of_records, motions, 5, {}};
            for (int j = 0; j < stripes; ++j)
                truth.stripes.push_back(0.3 * std::pow(4 / 0.3, j / (stripes - 1.0)));
            const double want = truth.frequency(k0, k);
            Held curves, shares, reported;
            double rejected = 0, undetermined = 0;
            for (std::size_t r = 0; r < repeats; ++r) {
                const FragilityData data = grouped(truth.draw(91, r));
                const HazardModel hazard = power_law(k0, k);
                const StripeShares found = plain_shares(data);
                const FrequencyEstimate by_shares = share_frequency(data, found, hazard, {.parts = 1});
                const FittedCurve curve = fitted_curve(data, log_predictors(data), Link::probit);
                const bool has_curve = curve.fit.maximum == Maximum::inside && curve.fit.coefficients[1] > 0;
                const bool fits = has_curve && lack_of_fit(curve).p_value >= fit_significance;
                rejected += has_curve && !fits ? 1 : 0;
                if (has_curve)
                    curves.add(lognormal_frequency(data, hazard, {.parts = 1}), want);
                shares.add(by_shares, want);
                const FrequencyEstimate chosen =
                    fits ? lognormal_frequency(data, hazard, {.parts = 1}, &found) : by_shares;
                if (chosen.below + chosen.above > most_outside)
                    ++undetermined;
                else
                    reported.add(chosen, want);
            }
            const auto all = static_cast<double>(repeats) / 100;
            fmt::print("| {} | {} × {} | {:.1f} | {:.1f} | {} | {} | {} |\n",
                       motions == 8 && stripes == 6 ? c.name : "", motions, stripes, rejected / all, undetermined / all,
                       curves.text(), shares.text(), reported.text());
            std::fflush(stdout);
        }
}

} // namespace
} // namespace stylobate

int main(int argc, char** argv)
{
    CLI::App app("Coverage of the intervals of annual frequencies, as a Markdown table");
    std::size_t repeats = 2000;
    app.add_option("--repeats", repeats, "campaigns of each kind")->check(CLI::Range(10, 1000000));
    CLI11_PARSE(app, argc, argv);
    stylobate::coverage(repeats);
    return 0;
}
