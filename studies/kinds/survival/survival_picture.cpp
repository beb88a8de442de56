#include "studies/kinds/survival/survival_text.hpp"

#include "io/plots/plot_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

void plot_likelihood(const Survival& s, const std::string& title, const std::filesystem::path& png)
{
    MapPicture picture;
    picture.title = title;
    picture.subtitle = fmt::format("{} of {} realizations agree", s.agree, s.valid);
    picture.frequency_hz = s.axes.frequency_hz;
    picture.pga_m_s2 = s.axes.intensity;
    const std::size_t of_one = s.axes.cells_of_one(), panels = std::min<std::size_t>(s.axes.events, 6);
    picture.columns = panels > 4 ? 3 : static_cast<int>(std::min<std::size_t>(panels, 2));
    const auto share = [&](const std::vector<std::uint64_t>& counts, std::size_t c) {
        return s.trials[c] == 0 ? std::nan("") : static_cast<double>(counts[c]) / static_cast<double>(s.trials[c]);
    };
    double most = 0;
    for (std::size_t c = 0; c < s.trials.size(); ++c)
        most = std::max(most, s.trials[c] == 0 ? 0 : share(s.agreeing, c));
    for (std::size_t e = 0; e < panels; ++e) {
        MapPanel panel;
        panel.title = e == 0 ? "1 event" : fmt::format("{} events in succession", e + 1);
        for (std::size_t c = e * of_one; c < (e + 1) * of_one; ++c)
            panel.value.push_back(share(s.agreeing, c));
        panel.high = most > 0 ? most : 1;
        picture.panels.push_back(std::move(panel));
    }
    if (s.state_measured && s.axes.frequency_hz.size() > 1) {
        for (std::size_t c = 0; c < of_one; ++c)
            picture.line.push_back(share(s.standing, c));
        picture.key = "lines: probability of standing after 1 event: 5, 50 and 95 % · colours: share of the "
                      "realizations that agree with the observed state";
    }
    plot_maps(picture, png);
}

FigureSeries likelihood_series(const std::string& name, const std::vector<double>& intensity,
                               const Exclusion& exclusion)
{
    double most = 0;
    for (const PastEstimate& at : exclusion.likelihood)
        most = std::max(most, at.value);
    FigureSeries series{name, SeriesKind::line, intensity, {}, {}, {}};
    for (const PastEstimate& at : exclusion.likelihood) {
        series.y.push_back(at.value / most);
        series.low.push_back(at.lower / most);
        series.high.push_back(at.upper / most);
    }
    return series;
}

FigureSeries threshold_series(const std::vector<double>& intensity, const Exclusion& exclusion)
{
    double most = 0;
    for (const PastEstimate& at : exclusion.likelihood)
        most = std::max(most, at.value);
    FigureSeries series{"threshold of one event", SeriesKind::line, intensity, exclusion.rule.part, {}, {}};
    for (double& part : series.y)
        part /= exclusion.rule.absolute ? most : 1;
    return series;
}

Figure exclusion_figure(const Survival& s)
{
    Figure figure;
    figure.title = "Excluded shaking";
    figure.x_label = "peak ground acceleration [m/s²]";
    figure.y_label = "likelihood / largest likelihood";
    figure.x_log = s.axes.intensity.back() > 4 * s.axes.intensity.front();
    for (std::size_t e = 0; e < s.past->by_events.size(); ++e)
        figure.series.push_back(likelihood_series(e == 0 ? "1 event" : fmt::format("{} events", e + 1),
                                                  s.axes.intensity, s.past->by_events[e]));
    for (std::size_t e = 1; e < figure.series.size(); ++e)
        figure.series[e].shown = false; // the bands of several hide each other
    figure.series.push_back(threshold_series(s.axes.intensity, s.past->by_events.front()));
    return figure;
}

Figure rates_figure(const Survival& s)
{
    constexpr int points = 201;
    Figure figure;
    figure.title = "Factor on the rates of the hazard curve";
    figure.x_label = "factor on all rates";
    figure.y_label = "density over its logarithm";
    figure.x_log = true;
    // of an exposure L T; the curves of its interval's ends are the band
    const auto density = [&](double exposure) {
        std::vector<double> values;
        double sum = 0;
        for (int i = 0; i < points; ++i) {
            const double z = -4 + 8.0 * i / (points - 1);
            values.push_back(std::exp(-z * z / 2 - exposure * std::exp(s.sigma_ln * z)));
            sum += values.back();
        }
        for (double& value : values)
            value /= sum * s.sigma_ln * 8.0 / (points - 1);
        return values;
    };
    FigureSeries prior{"before", SeriesKind::line, {}, density(0), {}, {}};
    for (int i = 0; i < points; ++i)
        prior.x.push_back(std::exp(s.sigma_ln * (-4 + 8.0 * i / (points - 1))));
    FigureSeries posterior{fmt::format("given that it has stood for {:g} years", s.years),
                           SeriesKind::line,
                           prior.x,
                           density(s.rates->collapse_rate.value * s.years),
                           {},
                           {}};
    const std::vector<double> a = density(s.rates->collapse_rate.lower * s.years),
                              b = density(s.rates->collapse_rate.upper * s.years);
    for (std::size_t i = 0; i < a.size(); ++i) {
        posterior.low.push_back(std::min({a[i], b[i], posterior.y[i]}));
        posterior.high.push_back(std::max({a[i], b[i], posterior.y[i]}));
    }
    figure.series = {std::move(prior), std::move(posterior)};
    return figure;
}

} // namespace stylobate
