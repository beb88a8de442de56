#include "studies/evidence/measured/planar_impact/planar_impact_page.hpp"
#include "studies/evidence/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stylobate::measured::impact {

namespace {

using verification::curves;
using verification::picture_size;
using verification::Series;

/// Part of the errors below each of them.
Series cumulative(const std::string& title, std::vector<double> errors, int colour)
{
    std::sort(errors.begin(), errors.end());
    Series s{title, {}, {}, true, {}, {}, colour};
    for (std::size_t k = 0; k < errors.size(); ++k) {
        s.x.push_back(100 * errors[k]);
        s.y.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(errors.size()));
    }
    return s;
}

double restitution(const ImpactStudy& s, std::size_t impact, const Velocity& after)
{
    const Impact& one = s.impacts[impact];
    const Arms arms = lowest_point(s.body, one.theta + s.orientation);
    return -at_contact(after, arms).n / at_contact(one.before, arms).n;
}

/// Medians of a value in bins of equally many impacts along the surface, quartiles as bars if asked for.
template <class Value>
Series along_surface(const ImpactStudy& s, const std::string& title, const Value& value, bool bars, int colour)
{
    std::vector<std::size_t> order = s.other;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return s.impacts[a].x < s.impacts[b].x; });
    Series series{title, {}, {}, !bars, {}, {}, colour};
    constexpr std::size_t bins = 14;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        std::vector<double> x, y;
        for (std::size_t k = bin * order.size() / bins; k < (bin + 1) * order.size() / bins; ++k) {
            x.push_back(s.impacts[order[k]].x);
            y.push_back(value(order[k]));
        }
        series.x.push_back(quantile(x, 0.5));
        series.y.push_back(quantile(y, 0.5));
        if (bars) {
            series.low.push_back(quantile(y, 0.25));
            series.high.push_back(quantile(y, 0.75));
        }
    }
    return series;
}

} // namespace

void draw(const ImpactStudy& s, const std::filesystem::path& folder)
{
    const auto& laws = s.laws;
    const auto put = [&](const char* name, const std::string& script) {
        run_gnuplot(script, picture_size, folder / (std::string("planar_impact_") + name + ".png"));
    };
    put("errors", curves({"error of the velocity after the impact, % (kinetic energy norm)", false, 0, 60},
                         {"part of the other half's impacts", false, 0, 1},
                         {cumulative("constant mu, e (Newton, Coulomb)", laws[ImpactStudy::newton].error, 5),
                          cumulative("the engine's law, constant", laws[ImpactStudy::constant].error, 1),
                          cumulative("rate damping as a function of the place", laws[ImpactStudy::place_rate].error, 2),
                          cumulative("extended law", laws[ImpactStudy::extended].error, 0),
                          cumulative("best impulse in the contact point", s.point_floor, 3)},
                         "bottom right"));
    const auto of = [&](std::size_t which) {
        return [&s, which](std::size_t k) { return restitution(s, k, s.laws[which].after[k]); };
    };
    put("place", curves({"place of the impact along the surface, m", false, 0, 0},
                        {"normal restitution at the contact point", false, 0.4, 0.75},
                        {along_surface(
                             s, "measured, median and quartiles",
                             [&s](std::size_t k) { return restitution(s, k, s.impacts[k].after); }, true, 5),
                         along_surface(s, "the engine's law, constant", of(ImpactStudy::constant), false, 1),
                         along_surface(s, "extended law", of(ImpactStudy::extended), false, 0)},
                        "top right"));
    const auto sliding = [&](std::size_t which, const std::string& title, int colour) {
        Series series{title, {}, {}, false, {}, {}, colour};
        for (const std::size_t k : s.other) {
            const Arms arms = lowest_point(s.body, s.impacts[k].theta + s.orientation);
            series.x.push_back(at_contact(s.impacts[k].after, arms).t);
            series.y.push_back(at_contact(laws[which].after[k], arms).t);
        }
        return series;
    };
    put("sliding", "set pointsize 0.5\n" +
                       curves({"measured sliding speed of the contact point after the impact, m/s", false, -2, 1.5},
                              {"predicted, m/s", false, -2, 1.5},
                              {sliding(ImpactStudy::newton, "constant mu, e (Newton, Coulomb)", 1),
                               sliding(ImpactStudy::extended, "extended law", 0),
                               {"", {-2, 1.5}, {-2, 1.5}, true, {}, {}, 5}},
                              "top left"));
}

} // namespace stylobate::measured::impact
