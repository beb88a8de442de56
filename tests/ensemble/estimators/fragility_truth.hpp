#pragma once
/// Outcomes drawn from a known fragility curve, with records that differ, and a hazard of a power law.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace stylobate {

inline HazardModel power_law(double k0, double k, double sigma_ln = 0)
{
    HazardModel hazard;
    hazard.measure = "pga_m_s2";
    hazard.intensity = {1, 10};
    hazard.frequency = {k0, k0 * std::pow(10, -k)};
    hazard.unbounded = true;
    if (sigma_ln > 0)
        for (const double p : {0.05, 0.95}) {
            const double factor = std::exp(sigma_ln * link_quantile(Link::probit, p));
            hazard.fractiles.push_back({p, {k0 * factor, k0 * factor * std::pow(10, -k)}});
        }
    return hazard;
}

/// The shares of the stripes alone, as their monotone ones too: without the test of monotonicity and the limits, which
/// take their time.
inline StripeShares plain_shares(const FragilityData& data)
{
    StripeShares shares;
    shares.stripes.resize(data.points());
    for (const FragilityRow& row : data.rows) {
        shares.stripes[row.point].trials += row.trials;
        shares.stripes[row.point].reached += row.reached;
    }
    double highest = 0;
    for (StripeShare& stripe : shares.stripes) {
        stripe.share = stripe.reached / stripe.trials;
        highest = std::max(highest, stripe.share);
        stripe.monotone = highest;
    }
    return shares;
}

/// ln capacity = ln median + record's own part + run's own part; so over all records the curve is lognormal with
/// dispersion hypot(between, within), whatever its parts.
struct FragilityTruth {
    double median = 1;
    double between = 0.3; ///< standard deviation of ln capacity between records
    double within = 0.3;  ///< and between runs of one record
    std::size_t records = 40;
    std::size_t runs = 5;    ///< of each record at each of its stripes
    bool own_stripe = false; ///< each record at one stripe only (multiple stripes), or all at all
    std::vector<double> stripes = {0.5, 0.65, 0.8, 1, 1.25, 1.55, 1.9, 2.4};
    /// Share of the probability that is taken away at one of the stripes: no lognormal curve has such a dip.
    std::size_t dip_stripe = 0;
    double dip = 0;

    double dispersion() const { return std::hypot(between, within); }
    double probability(double intensity) const
    {
        return link_at(Link::probit, std::log(intensity / median) / dispersion()).below;
    }

    std::vector<FragilityRun> draw(std::uint64_t seed, std::uint64_t repeat) const
    {
        std::uint64_t element = 0;
        const auto uniform = [&] { return uniform01(seed, repeat, Stream::virtual_specimen, element++); };
        std::vector<FragilityRun> drawn;
        for (std::size_t g = 0; g < records; ++g) {
            const double own = between * link_quantile(Link::probit, uniform());
            for (std::size_t j = 0; j < stripes.size(); ++j) {
                if (own_stripe && g % stripes.size() != j)
                    continue;
                double p = link_at(Link::probit, (std::log(stripes[j] / median) - own) / within).below;
                if (dip > 0 && j == dip_stripe)
                    p *= 1 - dip;
                double reached = 0;
                for (std::size_t i = 0; i < runs; ++i)
                    reached += uniform() < p ? 1 : 0;
                drawn.push_back({static_cast<std::uint32_t>(g), {stripes[j]}, reached, static_cast<double>(runs)});
            }
        }
        return drawn;
    }
};

/// Structures, or records, of several kinds, each with its own lognormal capacity: a fragility that is no lognormal
/// curve, with a frequency in closed form.
struct MixedTruth {
    struct Kind {
        double weight = 1; ///< of all of them the sum is 1
        double median = 1, between = 0.3, within = 0.3;
    };
    std::vector<Kind> kinds = {};
    bool of_records = false; ///< each record is of one kind, or each run
    std::size_t records = 20, runs = 5;
    std::vector<double> stripes = {};

    /// Over the power law k0 im^-k: the mean of Cornell's closed form over the kinds.
    double frequency(double k0, double k) const
    {
        double sum = 0;
        for (const Kind& kind : kinds)
            sum += kind.weight * k0 * std::pow(kind.median, -k) *
                   std::exp(k * k * (kind.between * kind.between + kind.within * kind.within) / 2);
        return sum;
    }

    std::vector<FragilityRun> draw(std::uint64_t seed, std::uint64_t repeat) const
    {
        std::uint64_t element = 0;
        const auto uniform = [&] { return uniform01(seed, repeat, Stream::virtual_specimen, element++); };
        const auto kind_at = [&](double u) {
            std::size_t kind = 0;
            for (; kind + 1 < kinds.size() && u > kinds[kind].weight; ++kind)
                u -= kinds[kind].weight;
            return kind;
        };
        std::vector<FragilityRun> drawn;
        for (std::size_t g = 0; g < records; ++g) {
            const double z = link_quantile(Link::probit, uniform());
            const std::size_t of_record = kind_at(uniform());
            for (const double im : stripes) {
                double reached = 0;
                for (std::size_t i = 0; i < runs; ++i) {
                    const Kind& kind = kinds[of_records ? of_record : kind_at(uniform())];
                    const double eta = (std::log(im / kind.median) - kind.between * z) / kind.within;
                    reached += uniform() < link_at(Link::probit, eta).below ? 1 : 0;
                }
                drawn.push_back({static_cast<std::uint32_t>(g), {im}, reached, static_cast<double>(runs)});
            }
        }
        return drawn;
    }
};

} // namespace stylobate
