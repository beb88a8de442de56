#pragma once
/// Known functions of one to three numbers, and searches of them with binomial noise.

#include "ensemble/estimators/search/search_answer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace stylobate {

/// Realizations that are the same at all points: half of what decides is common to all of them. Where there are
/// motions, 0.6 of that is the motion's. Of the other half 0.7 may be a smooth function of the place, so that
/// neighbours have more in common.
class CommonRealizations {
public:
    /// @param motions 0: each realization by itself
    CommonRealizations(std::size_t number, std::size_t motions, bool smooth, std::uint64_t seed)
        : random_(seed), motions_(motions), smooth_(smooth)
    {
        std::vector<double> motion(motions);
        for (double& level : motion)
            level = normal_(random_);
        for (std::size_t r = 0; r < number; ++r) {
            const double own = normal_(random_);
            level_.push_back(motions > 0 ? std::sqrt(0.6) * motion[r % motions] + std::sqrt(0.4) * own : own);
            std::vector<double> wave;
            for (std::size_t i = 0; smooth && i < waves * 4; ++i)
                wave.push_back(i % 4 == 0 ? uniform_(random_) : 2.5 * normal_(random_));
            wave_.push_back(std::move(wave));
        }
    }

    /// One point more.
    void add(double p, const SearchPlace& place)
    {
        std::vector<char> column;
        for (std::size_t r = 0; r < level_.size(); ++r) {
            const double own = normal_(random_);
            const double other = smooth_ ? std::sqrt(0.7) * wave_at(r, place) + std::sqrt(0.3) * own : own;
            const double z = std::sqrt(0.5) * (level_[r] + other);
            column.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)) < p);
        }
        reached_.push_back(std::move(column));
    }

    PairedNoise noise() const
    {
        const std::size_t n = level_.size(), m = reached_.size(), groups = motions_ > 0 ? motions_ : n;
        std::vector<double> reached(groups * m), size(groups);
        for (std::size_t r = 0; r < n; ++r) {
            size[r % groups] += 1;
            for (std::size_t i = 0; i < m; ++i)
                reached[r % groups * m + i] += reached_[i][r];
        }
        return paired_noise(reached, size, std::vector<std::size_t>(groups), m);
    }

private:
    static constexpr std::size_t waves = 6;

    /// Nearly normal, of variance 1.
    double wave_at(std::size_t r, const SearchPlace& place) const
    {
        double sum = 0;
        for (std::size_t w = 0; w < waves; ++w) {
            double angle = wave_[r][4 * w];
            for (std::size_t k = 0; k < place.size(); ++k)
                angle += wave_[r][4 * w + 1 + k] * place[k];
            sum += std::sqrt(2.0 / static_cast<double>(waves)) * std::cos(angle);
        }
        return sum;
    }

    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> uniform_{0, 2 * M_PI};
    std::size_t motions_;
    bool smooth_;
    std::vector<double> level_;
    std::vector<std::vector<double>> wave_;
    std::vector<std::vector<char>> reached_;
};

/// A function with its least place.
struct KnownFunction {
    std::string name;
    std::function<double(const SearchPlace&)> p;
    SearchPlace optimum;
    std::vector<bool> matters; ///< of each number; of one that does not, any value is as good
};

inline std::vector<KnownFunction> known_functions(std::size_t dimensions)
{
    const auto sq = [](double a) { return a * a; };
    using X = const SearchPlace&;
    if (dimensions == 1)
        return {{"quadratic", [=](X x) { return 0.15 + 1.2 * sq(x[0] - 0.37); }, {0.37}, {true}},
                {"edge", [=](X x) { return 0.2 + 0.3 * x[0] + 0.2 * sq(x[0]); }, {0}, {true}},
                {"narrow", [=](X x) { return 0.5 - 0.35 * std::exp(-sq((x[0] - 0.62) / 0.15)); }, {0.62}, {true}},
                {"small", [=](X x) { return 0.02 + 0.3 * sq(x[0] - 0.37); }, {0.37}, {true}},
                {"flat", [=](X) { return 0.3; }, {0.5}, {false}}};
    if (dimensions == 2)
        return {{"quadratic",
                 [=](X x) { return 0.1 + 0.8 * sq(x[0] - 0.6) + 0.5 * sq(x[1] - 0.3); },
                 {0.6, 0.3},
                 {true, true}},
                {"edge", [=](X x) { return 0.2 + 0.3 * x[0] + 0.5 * sq(x[1] - 0.3); }, {0, 0.3}, {true, true}},
                {"valley",
                 [=](X x) { return 0.15 + 2.5 * sq(x[0] - x[1]) + 0.3 * sq(x[0] + x[1] - 0.9); },
                 {0.45, 0.45},
                 {true, true}},
                {"narrow",
                 [=](X x) { return 0.5 - 0.35 * std::exp(-sq((x[0] - 0.62) / 0.2) - sq((x[1] - 0.4) / 0.3)); },
                 {0.62, 0.4},
                 {true, true}},
                {"one key", [=](X x) { return 0.15 + 0.8 * sq(x[0] - 0.37); }, {0.37, 0.5}, {true, false}}};
    return {{"quadratic",
             [=](X x) { return 0.1 + 0.8 * sq(x[0] - 0.6) + 0.5 * sq(x[1] - 0.3) + 0.6 * sq(x[2] - 0.5); },
             {0.6, 0.3, 0.5},
             {true, true, true}},
            {"edge",
             [=](X x) { return 0.15 + 0.3 * x[0] + 0.5 * sq(x[1] - 0.3) + 0.5 * sq(x[2] - 0.7); },
             {0, 0.3, 0.7},
             {true, true, true}},
            {"valley",
             [=](X x) { return 0.15 + 1.5 * sq(x[0] - x[1]) + 0.3 * sq(x[0] + x[1] - 0.9) + 0.4 * sq(x[2] - 0.4); },
             {0.45, 0.45, 0.4},
             {true, true, true}},
            {"one key", [=](X x) { return 0.15 + 0.8 * sq(x[0] - 0.37); }, {0.37, 0.5, 0.5}, {true, false, false}}};
}

/// A random function, nearly a Gaussian process with the surface's own correlation and length 0.4, of deviation 0.07.
inline KnownFunction random_function(std::size_t dimensions, std::uint64_t seed)
{
    constexpr std::size_t waves = 60;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::chi_squared_distribution<double> chi(5);
    std::uniform_real_distribution<double> uniform(0, 2 * M_PI);
    std::vector<double> wave; // the spectrum of Matern 5/2 is Student's t with 5 degrees of freedom
    for (std::size_t w = 0; w < waves; ++w) {
        wave.push_back(uniform(random));
        const double over = std::sqrt(5 / chi(random)) / 0.4;
        for (std::size_t k = 0; k < dimensions; ++k)
            wave.push_back(over * normal(random));
    }
    KnownFunction function{"random", nullptr, SearchPlace(dimensions), std::vector<bool>(dimensions, true)};
    function.p = [wave, dimensions](const SearchPlace& place) {
        double sum = 0;
        for (std::size_t w = 0; w < waves; ++w) {
            double angle = wave[w * (dimensions + 1)];
            for (std::size_t k = 0; k < dimensions; ++k)
                angle += wave[w * (dimensions + 1) + 1 + k] * place[k];
            sum += std::sqrt(2.0 / waves) * std::cos(angle);
        }
        return std::min(std::max(0.3 + 0.07 * sum, 0.02), 0.98);
    };
    return function;
}

struct SearchRepeats {
    double place = 0;          ///< share of the searches whose range holds the optimum in all keys that matter
    double value = 0;          ///< share whose interval holds p at the answer
    double excess = 0;         ///< mean of p at the answer above the least one
    double interval = 0;       ///< mean width of the interval
    std::vector<double> range; ///< mean width of the range of each number
};

struct SearchSetup {
    std::size_t points = 12, realizations = 300, motions = 0;
    bool smooth = false;
    int repeats = 200;
    int spacings = 100; ///< of the candidates: a divisor of those that the program looks at
};

inline std::vector<SearchPlace> coarse_candidates(std::size_t dimensions, int spacings)
{
    std::vector<SearchPlace> candidates = candidate_places(dimensions);
    std::erase_if(candidates, [&](const SearchPlace& place) {
        for (const double x : place)
            if (std::abs(x * spacings - std::round(x * spacings)) > 1e-9)
                return true;
        return false;
    });
    return candidates;
}

/// The least place among the candidates.
inline SearchPlace least_place(const KnownFunction& function, const std::vector<SearchPlace>& candidates)
{
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const SearchPlace& a, const SearchPlace& b) { return function.p(a) < function.p(b); });
}

/// @param of a known function, or "random": another one in each repeat
inline SearchRepeats searches_of(const KnownFunction& of, const SearchSetup& setup)
{
    const std::size_t d = of.optimum.size();
    const std::vector<SearchPlace> candidates = coarse_candidates(d, setup.spacings);
    KnownFunction function = of;
    SearchRepeats found;
    found.range.resize(d);
    const double each = 1.0 / setup.repeats;
    for (int repeat = 0; repeat < setup.repeats; ++repeat) {
        if (of.name == "random") {
            function = random_function(d, static_cast<std::uint64_t>(repeat) + 1);
            function.optimum = least_place(function, candidates);
        }
        CommonRealizations realizations(setup.realizations, setup.motions, setup.smooth,
                                        static_cast<std::uint64_t>(repeat) + 1);
        std::vector<SearchPlace> places = first_places(d);
        for (const SearchPlace& place : places)
            realizations.add(function.p(place), place);
        while (places.size() < setup.points) {
            const NextPlace next = next_place(ResponseSurface(places, realizations.noise()), candidates);
            if (next.place.empty())
                break;
            places.push_back(next.place);
            realizations.add(function.p(next.place), next.place);
        }
        const SearchAnswer answer = search_answer(ResponseSurface(places, realizations.noise()), candidates, 0.95);
        bool inside = true;
        for (std::size_t k = 0; k < d; ++k) {
            found.range[k] += each * (answer.to[k] - answer.from[k]);
            if (function.matters[k])
                inside = inside && answer.from[k] <= function.optimum[k] && function.optimum[k] <= answer.to[k];
        }
        const double truth = function.p(answer.best);
        found.place += each * inside;
        found.value += each * (answer.lower <= truth && truth <= answer.upper);
        found.interval += each * (answer.upper - answer.lower);
        found.excess += each * (truth - function.p(function.optimum));
    }
    return found;
}

} // namespace stylobate
