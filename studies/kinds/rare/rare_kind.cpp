#include "studies/kinds/rare/rare_kind.hpp"

#include "ensemble/estimators/designs/subset_simulation.hpp"
#include "studies/kinds/rare/rare_figures.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

namespace stylobate {

namespace {

constexpr double level = 0.95;
/// A larger share of chains that never moved is reported.
constexpr double many_stuck = 0.25;

/// Thrown through the chains when the user has asked to stop.
struct Stopped {};

/// The distribution function of the standard normal, within (0, 1). Not in long double, which depends on the maker of
/// the processor (`elementary.hpp`).
double probability_of(double z)
{
    const double below = std::erfc(-z / std::numbers::sqrt2) / 2;
    return std::clamp(below, 0x1p-53, 1 - 0x1p-53);
}

double response_of(const Outcome& outcome)
{
    switch (outcome.state) {
    case State::invalid:
        return std::nan("");
    case State::collapsed:
        return std::numeric_limits<double>::infinity();
    default:
        return outcome.peak_top_displacement_m;
    }
}

/// @param all the pilot, whose realizations count as cost only, and the repeats
RareTable table_of(const std::vector<SubsetRun>& all)
{
    RareTable table;
    table.realizations = all.front().evaluations;
    const std::span runs(all.begin() + 1, all.end());
    for (const SubsetRun& run : runs) {
        table.repeats.push_back(run.probability);
        table.realizations += run.evaluations;
        table.levels = std::max(table.levels, run.levels.size());
    }
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (const SubsetRun& run : runs)
        for (std::size_t l = 0; l < table.levels; ++l) {
            const bool there = l < run.levels.size(), chains = there && l > 0;
            table.threshold_m.push_back(chains ? run.levels[l].threshold : none);
            table.share.push_back(there ? run.levels[l].probability : none);
            table.acceptance.push_back(chains ? run.levels[l].acceptance : none);
            table.stuck.push_back(chains ? run.levels[l].stuck : none);
        }
    const Estimate estimate = mean_of_repeats(table.repeats, level);
    table.probability = estimate.value;
    table.lower = estimate.lower;
    table.upper = estimate.upper;
    table.interval = fmt::format("repeats {}", level);
    table.plain_realizations = plain_sampling_cost(table.repeats);
    return table;
}

/// Mean of what there is of a level; NaN of nothing.
double mean_of_level(const RareTable& table, const std::vector<double>& of, std::size_t l)
{
    double sum = 0, n = 0;
    for (std::size_t r = 0; r < table.repeats.size(); ++r)
        if (const double x = of[r * table.levels + l]; !std::isnan(x)) {
            sum += x;
            ++n;
        }
    return n > 0 ? sum / n : std::nan("");
}

std::string text_of(double x)
{
    return std::isnan(x) ? "–" : fmt::format("{:.3g}", x);
}

/// For the end of a run and the page of a result.
std::vector<std::string> rare_sentences(const RareTable& table)
{
    std::vector<std::string> sentences;
    if (std::isnan(table.probability)) {
        sentences.push_back(fmt::format("None of the {} repeats reached a collapse: its probability is too small for "
                                        "{} levels, or the peak displacement is not a suitable measure.",
                                        table.repeats.size(), table.levels));
    } else {
        const std::string interval = std::isnan(table.lower)
                                         ? std::string("without an interval")
                                         : fmt::format("{:.3g} to {:.3g}, {:.0f} % interval of {} repeats", table.lower,
                                                       table.upper, 100 * level, table.repeats.size());
        sentences.push_back(fmt::format("Probability of collapse {:.3g} ({}), with {} realizations.", table.probability,
                                        interval, table.realizations));
        sentences.push_back(
            fmt::format("Plain Monte Carlo sampling would need about {:.3g} for the same error, {:.3g} times as many.",
                        table.plain_realizations, table.plain_realizations / static_cast<double>(table.realizations)));
        if (const auto none = std::count(table.repeats.begin(), table.repeats.end(), 0.0); none > 0)
            sentences.push_back(fmt::format("{} of {} repeats reached no collapse and count as 0, so no interval can "
                                            "be given. Increase rare.samples.",
                                            none, table.repeats.size()));
    }
    for (std::size_t l = 1; l < table.levels; ++l)
        if (const double stuck = mean_of_level(table, table.stuck, l); stuck > many_stuck)
            sentences.push_back(
                fmt::format("On level {} {:.0f} % of the chains never moved: increase rare.samples.", l, 100 * stuck));
    return sentences;
}

} // namespace

std::uint64_t RareKind::drawn_first() const
{
    return 10 * study_.rare->samples;
}

bool RareKind::plan(Rounds& rounds)
{
    const RareSpec& spec = *study_.rare;
    const Sampler& sampler = rounds.experiment.sampler();
    const std::size_t dimension = sampler.size();
    Progress& progress = rounds.progress;
    progress.open_end = true;
    progress.total = study_.total();
    std::vector<SubsetRun> runs; ///< the pilot, and the repeats

    const Response response = [&](const std::vector<double>& points, std::uint64_t first) {
        const std::size_t n = points.size() / dimension;
        const std::uint64_t begin = runs.size() * RareSpec::indices_of_simulation + first;
        std::vector<double> numbers(points.size());
        std::transform(points.begin(), points.end(), numbers.begin(), probability_of);
        std::vector<std::uint64_t> batch(n);
        std::iota(batch.begin(), batch.end(), begin);

        // estimated from the simulations so far; nothing before the first one has ended
        const std::uint64_t finished =
            std::accumulate(runs.begin(), runs.end(), std::uint64_t{0},
                            [](auto sum, const SubsetRun& r) { return sum + r.evaluations; });
        progress.expected = runs.empty() ? 0 : finished * spec.simulations() / runs.size();
        const auto realize = [&](std::uint64_t index) {
            const auto at = static_cast<std::size_t>(index - begin) * dimension;
            return sampler.realization(index, std::span(numbers).subspan(at, dimension));
        };
        if (!rounds.run({.indices = batch, .realize = realize}))
            throw Stopped{};
        std::vector<double> responses;
        for (const std::uint64_t index : batch)
            responses.push_back(response_of(outcome_.at(index)));
        return responses;
    };

    SubsetOptions subset;
    subset.samples = spec.samples;
    subset.level_probability = RareSpec::level_probability;
    subset.most_levels = RareSpec::most_levels;
    subset.limit = std::numeric_limits<double>::infinity();
    subset.seed = study_.seed;
    try {
        runs.push_back(subset_pilot(dimension, response, subset));
        while (runs.size() < spec.simulations())
            runs.push_back(subset_simulation(dimension, response, subset, runs.front().levels, runs.size()));
    } catch (const Stopped&) {
        return false;
    }
    progress.open_end = false;
    progress.total = progress.done;
    table_ = table_of(runs);
    return true;
}

std::string RareKind::text() const
{
    std::string text;
    for (const std::string& sentence : rare_sentences(table_))
        text += "  " + sentence + "\n";
    return text;
}

void RareKind::add_to(Json& json) const
{
    const RareTable& table = table_;
    Json repeats = Json::list(), levels = Json::list();
    for (const double p : table.repeats)
        repeats.item(Json::object().member("probability", p));
    for (std::size_t l = 0; l < table.levels; ++l)
        levels.item(Json::object()
                        .member("threshold_m", mean_of_level(table, table.threshold_m, l))
                        .member("share", mean_of_level(table, table.share, l))
                        .member("acceptance", mean_of_level(table, table.acceptance, l))
                        .member("stuck", mean_of_level(table, table.stuck, l)));
    json.member("rare", Json::object()
                            .member("probability", table.probability)
                            .member("lower", table.lower)
                            .member("upper", table.upper)
                            .member("interval", table.interval)
                            .member("realizations", table.realizations)
                            .member("plain_realizations", table.plain_realizations)
                            .member("repeats", repeats)
                            .member("levels", levels));
}

Picture RareKind::picture(const ResultReader& reader, const std::string& results, const PictureRequest&) const
{
    check_complete(reader, results);
    return {"rare", "Probability of collapse", "",
            [this](const std::string& title, const std::filesystem::path& file) { plot_rare(table_, title, file); }};
}

std::optional<Answer> RareKind::answer() const
{
    const std::vector<std::string> sentences = rare_sentences(table_);
    std::string more;
    for (std::size_t i = std::isnan(table_.lower) ? 1 : 0; i < sentences.size(); ++i)
        more += (more.empty() ? "" : " ") + sentences[i];
    if (std::isnan(table_.lower))
        return Answer{sentences.front(), more};
    return Answer{fmt::format("The probability of collapse is {:.3g} to {:.3g} ({:.0f} % interval).", table_.lower,
                              table_.upper, 100 * level),
                  more};
}

bool RareKind::summary(PageWriter& writer) const
{
    const RareTable& table = table_;
    Document& page = writer.page;
    HtmlTable levels{"rrrrr",
                     {"level", "above [m]", "conditional probability", "candidates taken", "chains that never moved"},
                     {},
                     "Subset simulation on the peak displacement of the top; means over the repeats"};
    for (std::size_t l = 0; l < table.levels; ++l)
        levels.rows.push_back({fmt::format("{}", l), text_of(mean_of_level(table, table.threshold_m, l)),
                               text_of(mean_of_level(table, table.share, l)),
                               text_of(mean_of_level(table, table.acceptance, l)),
                               text_of(mean_of_level(table, table.stuck, l))});
    page.table(levels);
    std::string repeats;
    for (const double p : table.repeats)
        repeats += (repeats.empty() ? "" : ", ") + text_of(p);
    page.note("The repeats: " + repeats + ".");
    const std::vector<Figure> figures = rare_figures(table);
    page.figure(figure_svg(figures[0]),
                "The probability that the top moves by more than a displacement, level by level for each repeat.");
    page.figure(
        figure_svg(figures[1], 220),
        "The probability of collapse that each repeat found; and their mean with its interval. A repeat without "
        "a collapse counts as 0 and has no point.");
    return true;
}

} // namespace stylobate
