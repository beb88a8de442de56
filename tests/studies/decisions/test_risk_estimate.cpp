/// The risk of limit states made by hand: frequencies in closed form, the choice of the form, and what is not
/// determined.

#include "ensemble/model/input_error.hpp"
#include "studies/decisions/risk/risk.hpp"

#include <boost/math/distributions/normal.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace stylobate {
namespace {

TEST(WhyUndetermined, NamesWhereTheFrequencyComesFrom)
{
    const auto why = [](double below, double above, double beyond) {
        FrequencyEstimate e;
        e.below = below;
        e.above = above;
        e.beyond_hazard = beyond;
        return why_undetermined(e, 0.25);
    };
    EXPECT_EQ(why(0.12, 0.12, 0.24), std::nullopt);
    EXPECT_EQ(why(0.3, 0.1, 0), "40 % of the frequency would come from intensities outside of the range of the runs, "
                                "more than 25 %. Run the study with weaker intensities.");
    EXPECT_EQ(why(0.1, 0.3, 0), "40 % of the frequency would come from intensities outside of the range of the runs, "
                                "more than 25 %. Run the study with stronger intensities.");
    EXPECT_EQ(why(0.1, 0.1, 0.3), "30 % of the frequency would come from intensities outside of the hazard's points, "
                                  "more than 25 %. Give the hazard over a wider range.");
    EXPECT_NE(why(0.2, 0.1, 0.31).value().find("outside of the hazard's points"), std::string::npos)
        << "the larger one";
    EXPECT_NE(why(0.2, 0.2, 0.31).value().find("with stronger intensities"), std::string::npos) << "as much: more runs";
}

/// A power law 1e-3 a^-2 of the frequencies of exceedance.
double exceeded(double a)
{
    return 1e-3 / (a * a);
}

/// Of events between a and b: of P that is linear in ln a there, integral of P d lambda by parts.
double piece(double a, double b, double from, double to)
{
    return from * exceeded(a) - to * exceeded(b) + (to - from) / std::log(b / a) / 2 * (exceeded(a) - exceeded(b));
}

/// The same with a lognormal curve from one share to the other, by Simpson's rule.
double curved_piece(double a, double b, double from, double to)
{
    const boost::math::normal_distribution<double> normal;
    const double low = quantile(normal, from), high = quantile(normal, to), range = std::log(b / a);
    double sum = 0;
    constexpr int parts = 2000;
    for (int i = 0; i <= parts; ++i) {
        const double part = static_cast<double>(i) / parts;
        sum += (i == 0 || i == parts ? 1
                : i % 2 == 1         ? 4
                                     : 2) *
               cdf(normal, low + (high - low) * part) * 2 * exceeded(a * std::exp(range * part));
    }
    return sum * range / parts / 3;
}

/// Twelve records at three stripes, two runs each: 0, 1/4, 3/4 of them reach the state.
Fragility fragility_with(double p_value)
{
    StateFragility s;
    s.state.name = "collapse";
    std::vector<double> trials(36, 2), reached;
    for (int record = 0; record < 12; ++record)
        for (const int of : {0, record < 6 ? 1 : 0, record < 6 ? 2 : 1})
            reached.push_back(of);
    s.data = grouped({0.5, 1, 2}, trials, reached);
    s.curve = fragility_curve(s.data, {.at = {{0.5}, {1}, {2}}});
    s.stripes = stripe_shares(s.data);
    s.fit.p_value = p_value;
    Fragility f;
    f.states.push_back(s);
    return f;
}

HazardModel hazard()
{
    HazardModel h;
    h.measure = "pgv_m_s";
    h.intensity = {0.01, 100};
    h.frequency = {exceeded(0.01), exceeded(100)};
    h.unbounded = true;
    return h;
}

TEST(RiskOf, FrequenciesAreTheirClosedForms)
{
    RiskOptions options;
    options.most_outside = 1;
    const Fragility f = fragility_with(0.05);
    const Risk risk = risk_of(f, hazard(), options);
    ASSERT_EQ(risk.states.size(), 2U);
    const StateRisk &curve = risk.states[0], &shares = risk.states[1];
    // Cornell's k0 median^-k exp(k^2 beta^2 / 2)
    const double median = f.states[0].curve.median.value, beta = f.states[0].curve.dispersion.value;
    EXPECT_NEAR(curve.estimate.frequency.value / (1e-3 / (median * median) * std::exp(2 * beta * beta)), 1, 1e-6);
    // shares: 0 at 0.5, so that nothing comes from below; beyond 2 the last one
    const double within = piece(0.5, 1, 0, 0.25) + piece(1, 2, 0.25, 0.75), above = 0.75 * exceeded(2);
    EXPECT_NEAR(shares.estimate.frequency.value, within + above, 1e-12);
    EXPECT_NEAR(shares.estimate.above, above / (within + above), 1e-9);
    EXPECT_NEAR(shares.estimate.below, 0, 1e-12);
    ASSERT_EQ(shares.fragility.size(), 3U);
    EXPECT_EQ(shares.fragility[1].intensity, 1);
    EXPECT_EQ(shares.fragility[1].probability, 0.25);
    for (const StateRisk& s : risk.states)
        for (const FragilityPoint& at : s.fragility) {
            EXPECT_GE(at.lower, 0);
            EXPECT_LE(at.upper, 1);
            EXPECT_LE(at.lower, at.probability);
            EXPECT_GE(at.upper, at.probability);
        }
    // the records are of two kinds with mean frequencies y: Student's interval of ln lambda by their scatter, with
    // (sum y)^2 / sum y^2 - 1 degrees of freedom (frequency_estimate.hpp)
    const double y[2] = {piece(0.5, 1, 0, 0.5) + piece(1, 2, 0.5, 1) + exceeded(2),
                         piece(1, 2, 0, 0.5) + 0.5 * exceeded(2)};
    EXPECT_NEAR((y[0] + y[1]) / 2, within + above, 1e-15);
    const double mean = (y[0] + y[1]) / 2, deviation = std::fabs(y[0] - y[1]) / 2 * std::sqrt(12.0 / 11);
    const double half = std::log(shares.estimate.frequency.fragility.upper / mean);
    // the lower limit also holds lognormal curves between the stripes; none of 24 counts as half of 25
    const double curved = curved_piece(0.5, 1, 0.02, 0.25) + curved_piece(1, 2, 0.25, 0.75) + above;
    EXPECT_LT(curved, 0.99 * mean);
    EXPECT_NEAR(std::log(mean / shares.estimate.frequency.fragility.lower), half + std::log(mean / curved), 1e-9);
    const double freedom = 12 * mean * mean / ((y[0] * y[0] + y[1] * y[1]) / 2) - 1;
    // Student's quantile of 0.95 after Cornish and Fisher (Abramowitz & Stegun 26.7.5), to 1e-3 from 7 degrees on
    const double z = 1.6448536, z3 = z * z * z, z5 = z3 * z * z;
    const double t = z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
    EXPECT_GT(freedom, 6);
    EXPECT_NEAR(half, t * deviation / std::sqrt(12.0) / mean, 0.01 * half);
}

TEST(RiskOf, TheLognormalCurveIsChosenWhereItFits)
{
    RiskOptions options;
    options.most_outside = 1;
    const Risk fits = risk_of(fragility_with(0.05), hazard(), options),
               misses = risk_of(fragility_with(0.049), hazard(), options);
    for (const Risk* risk : {&fits, &misses}) {
        ASSERT_EQ(risk->states.size(), 2U);
        EXPECT_TRUE(risk->states[0].chosen);
        EXPECT_FALSE(risk->states[1].chosen);
        EXPECT_EQ(risk->chosen().size(), 1U);
    }
    EXPECT_EQ(fits.states[0].form, FragilityForm::lognormal);
    EXPECT_EQ(misses.states[0].form, FragilityForm::shares);
}

TEST(RiskOf, TooMuchFromOutsideIsNotDetermined)
{
    // 3/4 of 1e-3 / 4 of 5.1e-4 come from above 2 m/s: 37 %
    const double share = 0.75 * exceeded(2) / (piece(0.5, 1, 0, 0.25) + piece(1, 2, 0.25, 0.75) + 0.75 * exceeded(2));
    const auto with = [&](double most) {
        RiskOptions options;
        options.most_outside = most;
        return risk_of(fragility_with(0.01), hazard(), options).states.front();
    };
    EXPECT_TRUE(with(share + 1e-6).determined);
    try {
        EXPECT_FALSE(with(share - 1e-6).determined);
        ADD_FAILURE() << "the chosen form is the only one of the only limit state";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("Run the study with stronger intensities"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace stylobate
