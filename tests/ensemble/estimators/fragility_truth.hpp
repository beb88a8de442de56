#pragma once
/// Outcomes drawn from a known fragility curve, with records that differ, and a hazard of a power law.

#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/fragility/link.hpp"
#include "ensemble/estimators/risk/hazard.hpp"
#include "ensemble/numerics/random.hpp"

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

} // namespace stylobate
