#include "studies/kinds/replicas/discordance.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double level = 0.95;
constexpr double two_sided = 1.959963984540054; ///< of the normal distribution at this level
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// With n pairs, a and b collapsed: all n^2 comparisons less those within a pair.
double independent_share(const PairCounts& c)
{
    const auto n = static_cast<double>(c.trials()), a = static_cast<double>(c.original + c.both),
               b = static_cast<double>(c.replica + c.both);
    return n < 2 ? nan : (a * (n - b) + (n - a) * b - static_cast<double>(c.discordant())) / (n * (n - 1));
}

} // namespace

Sureness sureness(double discordant_probability)
{
    return discordant_probability < certain_below      ? Sureness::certain
           : discordant_probability <= coin_flip_above ? Sureness::probable
                                                       : Sureness::coin_flip;
}

DiscordantShare discordant_share(const PairCounts& counts)
{
    DiscordantShare share;
    share.trials = counts.trials();
    share.discordant = counts.discordant();
    share.probability =
        share.trials > 0 ? static_cast<double>(share.discordant) / static_cast<double>(share.trials) : nan;
    const BinomialInterval interval = jeffreys(share.trials, share.discordant, level);
    share.lower = interval.lower;
    share.upper = interval.upper;
    share.independent = independent_share(counts);
    return share;
}

std::uint64_t fewest_pairs()
{
    std::uint64_t pairs = 1;
    while (sureness(jeffreys(pairs, 0, level).upper) != Sureness::certain)
        ++pairs;
    return pairs;
}

DiscordanceRatio discordance_ratio(const std::vector<PairCounts>& cells)
{
    PairCounts all;
    double pairs = 0, independent = 0;
    for (const PairCounts& c : cells)
        if (c.trials() >= 2) {
            all.neither += c.neither;
            all.original += c.original;
            all.replica += c.replica;
            all.both += c.both;
            const auto n = static_cast<double>(c.trials());
            pairs += n;
            independent += n * independent_share(c);
        }
    DiscordanceRatio ratio;
    ratio.all = discordant_share(all);
    ratio.all.independent = pairs > 0 ? independent / pairs : nan;
    const double discordant = static_cast<double>(all.discordant());
    ratio.ratio = independent > 0 ? discordant / independent : nan;
    ratio.lower = ratio.upper = ratio.ratio;
    if (!(independent > 0))
        return ratio;
    if (all.discordant() == 0) { // nothing to take a variance of
        ratio.upper = ratio.all.upper / ratio.all.independent;
        return ratio;
    }
    // What a pair adds to discordant - ratio x independent: the latter by Hajek's projection, pair i against all others
    double variance = 0;
    for (const PairCounts& c : cells) {
        if (c.trials() < 2)
            continue;
        const auto n = static_cast<double>(c.trials());
        const double a = static_cast<double>(c.original + c.both) / n, b = static_cast<double>(c.replica + c.both) / n;
        const std::array<double, 4> count = {static_cast<double>(c.neither), static_cast<double>(c.original),
                                             static_cast<double>(c.replica), static_cast<double>(c.both)};
        const std::array<double, 4> adds = {-ratio.ratio * (a + b), 1 - ratio.ratio * (1 - b + a),
                                            1 - ratio.ratio * (b + 1 - a), -ratio.ratio * (2 - a - b)};
        double sum = 0, squares = 0;
        for (std::size_t k = 0; k < count.size(); ++k) {
            sum += count[k] * adds[k];
            squares += count[k] * adds[k] * adds[k];
        }
        variance += std::max(0.0, squares - sum * sum / n) * n / (n - 1);
    }
    const double half = two_sided * std::sqrt(variance) / independent;
    ratio.lower = std::max(0.0, ratio.ratio - half);
    ratio.upper = ratio.ratio + half;
    return ratio;
}

} // namespace stylobate
