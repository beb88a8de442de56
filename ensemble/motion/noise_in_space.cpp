#include "ensemble/motion/noise_in_space.hpp"

#include "ensemble/model/motion.hpp"

#include <cmath>

namespace stylobate {

double HorizontalNoise::peak(OfPair definition) const
{
    const double of_first = stylobate::peak(first);
    if (second.empty() || definition == OfPair::first)
        return of_first;
    return size_of_pair(definition, of_first, stylobate::peak(second), peak_at_once(first, second));
}

HorizontalNoise horizontal_noise(const SyntheticNoise& noise, const ExcitationSpec& excitation, std::uint64_t seed,
                                 std::uint64_t index, Stream first, Stream second)
{
    HorizontalNoise pair{noise.acceleration(seed, index, first), {}};
    if (!(excitation.second_ratio > 0))
        return pair;
    const double shared = excitation.second_ratio * excitation.second_correlation;
    const double own =
        excitation.second_ratio * std::sqrt(1 - excitation.second_correlation * excitation.second_correlation);
    pair.second = noise.acceleration(seed, index, second);
    for (std::size_t i = 0; i < pair.second.size(); ++i)
        pair.second[i] = shared * pair.first[i] + own * pair.second[i];
    return pair;
}

double mean_peak(const SyntheticNoise& noise, const ExcitationSpec& excitation, std::uint64_t seed)
{
    if (excitation.pga_of_pair == OfPair::first)
        return noise.mean_peak(seed);
    double sum = 0;
    for (std::uint64_t i = 0; i < motions_for_mean_peak; ++i)
        sum += horizontal_noise(noise, excitation, seed, i, Stream::mean_peak, Stream::second_mean_peak)
                   .peak(excitation.pga_of_pair);
    return sum / static_cast<double>(motions_for_mean_peak);
}

} // namespace stylobate
