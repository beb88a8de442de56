#pragma once
/// Pairs of trials whose true difference is known.

#include "ensemble/estimators/paired/paired_difference.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace stylobate {

/// Independent pairs of two probabilities with a correlation of the two outcomes.
struct PairedTruth {
    double base = 0.5, variant = 0.5, correlation = 0;

    double both() const
    {
        return base * variant + correlation * std::sqrt(base * (1 - base) * variant * (1 - variant));
    }
    double discordant() const { return base + variant - 2 * both(); }
    double difference() const { return variant - base; }

    template <class Random>
    PairedCounts draw(std::uint64_t pairs, Random& random) const
    {
        std::uniform_real_distribution<double> uniform;
        PairedCounts counts;
        for (std::uint64_t i = 0; i < pairs; ++i) {
            const double u = uniform(random);
            counts.add(u < base, u < both() || (u >= base && u < base + variant - both()));
        }
        return counts;
    }
};

/// Pairs in groups: a realization falls where mean + the group's level + its own noise is above 0; the variant shifts
/// this, by another amount in each group. Both noises of a pair have a correlation.
struct GroupedTruth {
    double mean = 0, group_sd = 1, shift = 0, shift_sd = 0, correlation = 0.9;

    double difference() const
    {
        const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
        const double a = 1 + group_sd * group_sd;
        return below((mean + shift) / std::sqrt(a + shift_sd * shift_sd)) - below(mean / std::sqrt(a));
    }

    template <class Random>
    std::vector<PairedCounts> draw(std::size_t groups, std::size_t pairs, Random& random) const
    {
        std::normal_distribution<double> normal;
        std::vector<PairedCounts> all(groups);
        for (PairedCounts& group : all) {
            const double level = mean + group_sd * normal(random), other = level + shift + shift_sd * normal(random);
            for (std::size_t i = 0; i < pairs; ++i) {
                const double noise = normal(random);
                const double twin = correlation * noise + std::sqrt(1 - correlation * correlation) * normal(random);
                group.add(level + noise > 0, other + twin > 0);
            }
        }
        return all;
    }
};

} // namespace stylobate
