/// Ten thousand repeats: the intervals of curves and of shares of the dispersion hold the truth in 95 +- 1 % of them,
/// give or take two standard errors of the repeats themselves (.0044).

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/dispersion_shares.hpp"
#include "tests/ensemble/estimators/fragility_truth.hpp"
#include "tests/ensemble/estimators/nested_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace stylobate;

namespace {

constexpr std::uint64_t repeats = 10000;

bool covers(const Limits& limits, double value)
{
    return limits.lower <= value && value <= limits.upper;
}

} // namespace

TEST(FragilityCoverageLong, CurvesByTheJackknife)
{
    for (const std::size_t records : {20, 40, 100}) {
        const FragilityTruth truth{.records = records};
        const CurveTarget median = CurveTarget::log_median(), slope = CurveTarget::slope();
        std::uint64_t median_held = 0, slope_held = 0;
        for (std::uint64_t r = 0; r < repeats; ++r) {
            const FragilityData data = grouped(truth.draw(51, r));
            const FittedCurve curve = fitted_curve(data, log_predictors(data), Link::probit);
            const Jackknife without = jackknife(curve);
            median_held += covers(jackknife_limits(curve, without, median, 0.95), std::log(truth.median)) ? 1 : 0;
            slope_held += covers(jackknife_limits(curve, without, slope, 0.95), 1 / truth.dispersion()) ? 1 : 0;
        }
        EXPECT_NEAR(static_cast<double>(median_held) / repeats, 0.95, 0.0144) << records;
        EXPECT_NEAR(static_cast<double>(slope_held) / repeats, 0.95, 0.0144) << records;
    }
}

TEST(FragilityCoverageLong, SharesOfTheDispersion)
{
    for (const std::size_t records : {40, 100}) {
        const NestedTruth truth{.records = records};
        double total = 0;
        for (const double sd : truth.sd)
            total += sd * sd;
        std::array<std::uint64_t, dispersion_levels> held{};
        for (std::uint64_t r = 0; r < repeats; ++r) {
            const DispersionShares shares = dispersion_shares(truth.draw(52, r));
            for (std::size_t l = 0; l < dispersion_levels; ++l)
                held[l] += covers(shares.levels[l].share_limits, truth.sd[l] * truth.sd[l] / total) ? 1 : 0;
        }
        for (std::size_t l = 0; l < dispersion_levels; ++l)
            EXPECT_NEAR(static_cast<double>(held[l]) / repeats, 0.95, 0.0144) << records << ' ' << l;
    }
}
