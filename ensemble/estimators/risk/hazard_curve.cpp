#include "ensemble/estimators/risk/hazard_curve.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate {

namespace {

/// (1 - Phi(z)) / phi(z), z >= 0: by its continued fraction where the quotient loses digits (Abramowitz & Stegun,
/// "Handbook of Mathematical Functions" (1964), 26.2.14).
double mills_ratio(double z)
{
    if (z < 5)
        return normal_below(-z) / normal_density(z);
    double fraction = z;
    for (int i = 60; i > 0; --i)
        fraction = z + i / fraction;
    return 1 / fraction;
}

} // namespace

HazardCurve::HazardCurve(std::span<const double> intensity, std::span<const double> frequency)
{
    const std::size_t n = intensity.size();
    assert(n >= 2 && frequency.size() == n && frequency[n - 1] < frequency[n - 2]);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double x = std::log(intensity[i]), next = std::log(intensity[i + 1]);
        const double k = std::log(frequency[i] / frequency[i + 1]) / (next - x);
        pieces_.push_back({x, next, std::log(frequency[i]) + k * x, k});
    }
    pieces_.front().from = -no_end;
    pieces_.back().to = no_end;
}

double HazardCurve::frequency(double x) const
{
    const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [x](const Piece& p) { return x <= p.to; });
    return piece->k > 0 ? std::exp(piece->c - piece->k * x) : std::exp(piece->c);
}

double HazardCurve::density(double x) const
{
    const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [x](const Piece& p) { return x <= p.to; });
    return piece->k > 0 ? piece->k * std::exp(piece->c - piece->k * x) : 0;
}

double HazardCurve::log_intensity(double frequency) const
{
    const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [frequency](const Piece& p) {
        return p.k > 0 && (std::isinf(p.to) || std::exp(p.c - p.k * p.to) <= frequency);
    });
    return std::clamp((piece->c - std::log(frequency)) / piece->k, piece->from, piece->to);
}

double HazardCurve::lognormal_integral(double intercept, double slope, double from, double to) const
{
    double sum = 0;
    for (const Piece& piece : pieces_) {
        const double low = std::max(piece.from, from), high = std::min(piece.to, to), shift = piece.k / slope;
        if (!(low < high) || piece.k == 0)
            continue;
        // lambda phi(eta) and lambda Phi(eta) at an end; both vanish at no_end
        struct End {
            double shifted, below, density;
        };
        const auto end = [&](double x) -> End {
            if (std::isinf(x))
                return {x, 0, 0};
            const double eta = intercept + slope * x, lambda = std::exp(piece.c - piece.k * x);
            return {eta + shift, lambda * normal_below(eta), lambda * normal_density(eta)};
        };
        const End a = end(low), b = end(high);
        // exp(...) Phi(-|z|) = lambda phi(eta) R(|z|), which neither overflows nor cancels far from the peak
        const auto tail = [](const End& e) {
            return std::isinf(e.shifted) ? 0 : e.density * mills_ratio(std::abs(e.shifted));
        };
        double within = 0;
        if (a.shifted >= 0)
            within = tail(a) - tail(b);
        else if (b.shifted <= 0)
            within = tail(b) - tail(a);
        else
            within = std::exp(piece.c + piece.k * intercept / slope + shift * shift / 2) - tail(a) - tail(b);
        sum += a.below - b.below + within;
    }
    return std::max(sum, 0.0);
}

std::vector<double> HazardCurve::node_weights(std::span<const double> nodes, double from, double to) const
{
    const std::size_t n = nodes.size();
    std::vector<double> weights(n);
    // the part of [low, high] on each piece: how often, and how far beyond `low` on the average
    const auto add = [&](double low, double high, auto&& take) {
        for (const Piece& piece : pieces_) {
            const double a = std::max({piece.from, from, low}), b = std::min({piece.to, to, high});
            if (!(a < b) || piece.k == 0)
                continue;
            const double at_a = std::exp(piece.c - piece.k * a);
            const double at_b = std::isinf(b) ? 0 : std::exp(piece.c - piece.k * b);
            const double length = b - a;
            // the integral of (x - a) k exp(c - k x)
            const double moment = std::isinf(b) ? at_a / piece.k : (at_a - at_b) / piece.k - length * at_b;
            take(at_a - at_b, moment + (a - low) * (at_a - at_b));
        }
    };
    const double first = nodes[1] - nodes[0];
    add(nodes[0] - first, nodes[0], [&](double, double moment) { weights[0] += moment / first; });
    for (std::size_t j = 0; j + 1 < n; ++j) {
        const double spacing = nodes[j + 1] - nodes[j];
        add(nodes[j], nodes[j + 1], [&](double often, double moment) {
            weights[j + 1] += moment / spacing;
            weights[j] += often - moment / spacing;
        });
    }
    add(nodes[n - 1], no_end, [&](double often, double) { weights[n - 1] += often; });
    return weights;
}

HazardCurve best_curve(const HazardModel& hazard)
{
    return {hazard.intensity, hazard.frequency};
}

namespace {

/// A curve at the intensities of the hazard; two curves that do not increase may be continued to one that does.
HazardCurve curve_of(const HazardModel& hazard, std::vector<double> frequency)
{
    for (std::size_t i = 1; i < frequency.size(); ++i)
        frequency[i] = std::min(frequency[i], frequency[i - 1]);
    if (!(frequency.back() < *(frequency.end() - 2)))
        frequency.back() *= 1 - 1e-12;
    return {hazard.intensity, frequency};
}

} // namespace

HazardCurve quantile_curve(const HazardModel& hazard, double probability)
{
    const auto& fractiles = hazard.fractiles;
    assert(fractiles.size() >= 2);
    // the two fractiles that are nearest around the probability, or the last two on its side
    const auto above = std::find_if(fractiles.begin() + 1, fractiles.end() - 1,
                                    [probability](const HazardFractile& f) { return f.probability >= probability; });
    const HazardFractile &high = *above, &low = *(above - 1);
    const double z = normal_quantile(probability), from = normal_quantile(low.probability);
    const double part = (z - from) / (normal_quantile(high.probability) - from);
    std::vector<double> frequency;
    for (std::size_t i = 0; i < hazard.intensity.size(); ++i)
        frequency.push_back(low.frequency[i] * std::pow(high.frequency[i] / low.frequency[i], part));
    return curve_of(hazard, std::move(frequency));
}

HazardCurve mean_curve(const HazardModel& hazard)
{
    const auto& fractiles = hazard.fractiles;
    assert(fractiles.size() >= 2);
    std::vector<double> frequency(hazard.intensity.size(), 0);
    for (std::size_t f = 0; f + 1 < fractiles.size(); ++f) {
        const HazardFractile &low = fractiles[f], &high = fractiles[f + 1];
        const double z1 = normal_quantile(low.probability), z2 = normal_quantile(high.probability);
        const bool first = f == 0, last = f + 2 == fractiles.size(); // these go on to the end
        for (std::size_t i = 0; i < frequency.size(); ++i) {
            const double b = std::log(high.frequency[i] / low.frequency[i]) / (z2 - z1);
            const double below = first ? 0 : normal_below(z1 - b);
            const double up_to = last ? 1 : normal_below(z2 - b);
            frequency[i] += low.frequency[i] * std::exp(b * (b / 2 - z1)) * (up_to - below);
        }
    }
    return curve_of(hazard, std::move(frequency));
}

} // namespace stylobate
