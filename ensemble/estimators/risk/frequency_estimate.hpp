#pragma once
/// How often a limit state is reached: the fragility over the hazard,
///
///   lambda = integral of P(limit state | im) |d lambda_IM(im)|
///
/// (Cornell & Krawinkler, "Progress and challenges in seismic performance assessment", PEER Center News 3 (2000) 1), of
/// structures that meet every event as new. Its interval by the fragility is that of the records; `RiskNumber`
/// joins that of the hazard.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/model/fields.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

// A frequency or a probability with what is not known of it: of the fragility, of the hazard, and of both.

/// A frequency at three curves of the hazard, over its value at the best estimate: the limits of a central interval
/// and the median.
struct HazardSpread {
    double low = 1, middle = 1, high = 1;
};

struct RiskNumber {
    double value = 0;
    Limits total;     ///< of both
    Limits fragility; ///< with the hazard's best estimate
    Limits hazard;    ///< with the fragility's best estimate; the value itself where the hazard has no fractiles
    /// Part of the squared width of `total`, on the scale of the logarithm, that is of the fragility: of the whole
    /// interval, or of its upper half where the lower limit is 0. NaN where the width is 0 or not finite.
    double fragility_part = 0;
};

template <class F>
void visit_fields(std::type_identity<RiskNumber>, F&& f)
{
    f("value", &RiskNumber::value);
    f("lower", within(&RiskNumber::total, &Limits::lower));
    f("upper", within(&RiskNumber::total, &Limits::upper));
    f("fragility_lower", within(&RiskNumber::fragility, &Limits::lower));
    f("fragility_upper", within(&RiskNumber::fragility, &Limits::upper));
    f("hazard_lower", within(&RiskNumber::hazard, &Limits::lower));
    f("hazard_upper", within(&RiskNumber::hazard, &Limits::upper));
    f("fragility_part", &RiskNumber::fragility_part, {.unit = "1"});
}

/// Both intervals together, by their distances from the value on the scale of the logarithm: the limits of a sum of
/// independent terms are at the root of the sum of their squared distances (MOVER; Zou & Donner, "Construction of
/// confidence limits about effect measures: a general approach", Statistics in Medicine 27 (2008) 1693). Exact limits
/// where one of them is certain. The interval is about the value at the hazard's median, as a mean hazard may lie
/// outside of all fractiles that are asked for.
/// @param hazard nothing where its uncertainty is not known
RiskNumber combined(double value, const Limits& fragility, const std::optional<HazardSpread>& hazard);

/// 1 - exp(-frequency x years): at least one event in these years, of a Poisson process.
double probability_over(double frequency, double years);
RiskNumber probability_over(const RiskNumber& frequency, double years);

/// What the probability is between the intensities of the runs, and beyond them.
enum class FragilityForm {
    lognormal, ///< the fitted curve, at all intensities
    shares     ///< those of the stripes, linear in ln im between them (`HazardCurve::node_weights`)
};
const char* to_string(FragilityForm form);

/// A part of the frequency, of events in a range of intensities.
struct FrequencyPart {
    double from = 0, to = 0; ///< the first part begins at 0, the last one has no end
    RiskNumber frequency;    ///< [1/year]
};

struct FrequencyOptions {
    double level = 0.9;
    std::size_t parts = 12; ///< within the range of the runs, equally wide in ln im
};

struct FrequencyEstimate {
    FragilityForm form = FragilityForm::lognormal;
    RiskNumber frequency; ///< [1/year]
    /// [1/year] by the mean of the hazard over its fractiles (`mean_curve`); NaN without fractiles.
    double by_mean_hazard = std::numeric_limits<double>::quiet_NaN();
    /// Below the range of the runs, `parts` within it, above it.
    std::vector<FrequencyPart> parts;
    double below = 0, above = 0; ///< shares of the frequency that come from outside of the range of the runs
    double beyond_hazard = 0;    ///< share from outside of the hazard's points
    /// What any non-decreasing curve would give: lognormal, that agrees with the fitted one within the range of the
    /// runs (0 or the fitted curve below it, the last value or 1 above it); shares, that passes through those of the
    /// stripes (their monotone ones): steps, and 1 above the last one. Of the best estimate of the hazard. The upper
    /// one is infinite where a share at the first stripe is not 0 and the hazard has no least intensity; else weaker
    /// events count from the hazard's first point on, or from where the estimate's line reaches 0.
    Limits bounds;
    /// Of shares: what the runs do not exclude at the stripes below the first one with damage (the last one where none
    /// has it) [1/year]: the upper limit of each one's share (of a central interval, and no greater than that of any
    /// stronger stripe) times its events. It is in no interval of the frequency: a structure that cannot be damaged
    /// there has it too. 0: there is no such stripe. A part of the frequency that lies there alone has it as its upper
    /// limit.
    double unseen = 0;
    /// Of shares: whether one stripe divides all that reached the state from all that did not. Then nothing is known of
    /// the form between two stripes.
    bool separated = false;
};

/// The interval by the records: the jackknife of ln lambda over records (the frequencies without each record in turn),
/// with the degrees of freedom of its gradient (`record_spread`), as of the curve itself (`jackknife_limits`). From 0
/// to infinity where it cannot be given: fewer than `least_records`, or a curve that depends on one record.
/// @param shares of the data: the interval then contains that of `share_frequency` too, of each part in which a run
///        reached the state (own choice). A curve of which no lack of fit was found is not known to be the true one,
///        and the interval of the form that such a test chooses does not contain what is not known of the form
///        (docs/risk.md has the coverage of both).
/// @pre the data have one measure and a fitted curve that rises with the intensity (`FragilityCurve::maximum`)
FrequencyEstimate lognormal_frequency(const FragilityData& data, const HazardModel& hazard,
                                      const FrequencyOptions& options = {}, const StripeShares* shares = nullptr);

/// Weights w of the stripes [1/year]: the frequency by shares is sum_j w_j p_j, over all intensities and with the best
/// estimate of the hazard (`HazardCurve::node_weights`).
/// @param intensity (stripes >= 2) ascending, > 0
std::vector<double> stripe_weights(const std::vector<double>& intensity, const HazardModel& hazard);

/// The frequency is linear in the shares, so it is the mean over records of each one's own frequency y_g. A record
/// without runs at a stripe takes the share of the others there. The interval is Student's of ln lambda by the scatter
/// of the y_g, with (sum y_g)^2 / sum y_g^2 - 1 degrees of freedom (own choice, of the form of `RecordSpread`: records
/// under which the state is not reached do not show the scatter). Where fewer than `least_records` records count so, or
/// where one record alone has all the scatter, it is that of a bounded mean (`stripe_shares.hpp`), y_g between 0 and
/// the frequency at P = 1 from the first stripe with damage on, which holds with no damage at all, and is wide.
///
/// Between two stripes the form is not known: the interval also contains its own limits with a lognormal curve through
/// the shares of every two stripes instead of the straight line. Where the stripes separate
/// (`FrequencyEstimate::separated`), it contains every curve that rises: steps through the limits of the stripes'
/// shares (both own choices).
/// @param shares of the data   @pre two stripes at least
FrequencyEstimate share_frequency(const FragilityData& data, const StripeShares& shares, const HazardModel& hazard,
                                  const FrequencyOptions& options = {});

} // namespace stylobate
