#include "ensemble/estimators/search/search_answer.hpp"

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double least_groups = 7;      ///< degrees of freedom from which on the scatter of groups is relied on
constexpr double most_excess = 4;       ///< T of places that a draw may have its smallest value at
constexpr std::size_t most_drawn = 250; ///< places of a joint draw
constexpr std::size_t draws_number = 1000;
constexpr std::uint64_t draws_seed = 1;

std::size_t lowest(const std::vector<ResponseSurface::Value>& values)
{
    const auto found =
        std::min_element(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
    return static_cast<std::size_t>(found - values.begin());
}

/// T of each candidate.
std::vector<double> excesses(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates,
                             const SearchPlace& best)
{
    std::vector<double> excess;
    for (const ResponseSurface::Value& d : surface.differences(candidates, best))
        excess.push_back(d.mean <= 0 ? 0 : d.sd > 0 ? d.mean / d.sd : std::numeric_limits<double>::infinity());
    return excess;
}

/// From joint draws over the places.
struct Drawn {
    double critical = 0; ///< c
    double regret = 0;   ///< mean of p(best) - least p
};

/// By joint draws over the places that can be the least ones, or evenly chosen ones of them.
Drawn drawn_of(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates,
               const std::vector<double>& excess, const SearchPlace& best_place, double level)
{
    std::vector<std::size_t> all, chosen;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (excess[i] <= most_excess)
            all.push_back(i);
    const std::size_t stride = (all.size() + most_drawn - 1) / most_drawn;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i % stride == 0 || excess[all[i]] == 0) // the best place is among them
            chosen.push_back(all[i]);
    std::vector<SearchPlace> places;
    for (const std::size_t i : chosen)
        places.push_back(candidates[i]);
    const auto best = static_cast<std::size_t>(std::find(places.begin(), places.end(), best_place) - places.begin());
    std::vector<double> found;
    double regret = 0;
    for (const std::vector<double>& draw : surface.draws(places, draws_number, draws_seed)) {
        const auto least = std::min_element(draw.begin(), draw.end()) - draw.begin();
        found.push_back(excess[chosen[static_cast<std::size_t>(least)]]);
        regret += (draw[best] - draw[static_cast<std::size_t>(least)]) / static_cast<double>(draws_number);
    }
    std::sort(found.begin(), found.end());
    const auto rank = static_cast<std::size_t>(std::ceil(level * static_cast<double>(found.size())));
    return {found[std::clamp<std::size_t>(rank, 1, found.size()) - 1], regret};
}

/// Half the distance of neighbouring candidates of a number.
double half_spacing(const std::vector<SearchPlace>& candidates, std::size_t k)
{
    std::vector<double> values;
    for (const SearchPlace& place : candidates)
        values.push_back(place[k]);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values.size() > 1 ? 0.5 * (values.back() - values.front()) / static_cast<double>(values.size() - 1) : 0;
}

/// Student's where the scatter is that of groups.
double quantile_of(double probability, double freedom)
{
    return std::isfinite(freedom) ? student_quantile(probability, std::max(freedom, 1.0))
                                  : normal_quantile(probability);
}

} // namespace

MeanLimits mean_limits(double mean, double sd, double most, double freedom, double groups, double level)
{
    const double probability = (1 + level) / 2;
    double q = normal_quantile(probability);
    if (std::isfinite(freedom) && freedom >= least_groups)
        q = student_quantile(probability, freedom);
    else if (std::isfinite(freedom))
        sd = std::sqrt(sd * sd + 0.5 * most * most / (groups * groups));
    if (!(sd > 0))
        return {mean, mean};
    const double inside = std::clamp(mean, std::min(sd, 0.5 * most), std::max(most - sd, 0.5 * most));
    const double odds = inside / (most - inside), reach = std::exp(q * sd * most / (inside * (most - inside)));
    MeanLimits limits{most * (odds / reach) / (1 + odds / reach), most - most / (1 + odds * reach)};
    if (mean < sd)
        limits.lower = 0;
    if (mean > most - sd)
        limits.upper = most;
    return limits;
}

SearchAnswer search_answer(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates, double level)
{
    SearchAnswer answer;
    const std::vector<ResponseSurface::Value> values = surface.values(candidates);
    const std::size_t best = lowest(values);
    const PairedNoise& noise = surface.noise();
    answer.best = candidates[best];
    const std::vector<double> excess = excesses(surface, candidates, answer.best);
    const Drawn drawn = drawn_of(surface, candidates, excess, answer.best, level);
    answer.freedom = noise.freedom[lowest(surface.values(surface.points()))];
    const MeanLimits limits =
        mean_limits(values[best].mean, values[best].sd, noise.most, answer.freedom, noise.groups, level);
    answer.value = std::clamp(values[best].mean, limits.lower, limits.upper);
    answer.lower = limits.lower;
    answer.upper = std::min(limits.upper + drawn.regret, noise.most);
    answer.critical = std::min(drawn.critical, quantile_of((1 + level) / 2, answer.freedom));
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (excess[i] <= answer.critical)
            answer.flat.push_back(candidates[i]);
    for (std::size_t k = 0; k < answer.best.size(); ++k) {
        double from = 1, to = 0;
        for (const SearchPlace& place : answer.flat) {
            from = std::min(from, place[k]);
            to = std::max(to, place[k]);
        }
        const double half = half_spacing(candidates, k);
        answer.from.push_back(std::max(0.0, from - half));
        answer.to.push_back(std::min(1.0, to + half));
    }
    return answer;
}

NextPlace next_place(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates)
{
    const std::vector<SearchPlace>& points = surface.points();
    const std::vector<ResponseSurface::Value> change =
        surface.differences(candidates, points[lowest(surface.values(points))]);
    NextPlace next{{}, -1};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (std::find(points.begin(), points.end(), candidates[i]) != points.end())
            continue;
        const double sd = change[i].sd, u = sd > 0 ? -change[i].mean / sd : 0;
        const double improvement = sd > 0 ? sd * (u * normal_below(u) + normal_density(u)) : 0;
        if (improvement > next.improvement)
            next = {candidates[i], improvement};
    }
    return next;
}

} // namespace stylobate
