#include "studies/kinds/surface/surface_kind.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "io/plots/plot_surface.hpp"
#include "io/store/surface_axis.hpp"
#include "studies/kinds/law_band.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/html_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace stylobate {

namespace {

/// Counts with their probabilities and intervals.
SurfaceTable with_shares(SurfaceTable table)
{
    table.interval = interval_name();
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        const Share share = share_of(table.trials[i], table.collapses[i]);
        table.probability.push_back(share.probability);
        table.lower.push_back(share.lower);
        table.upper.push_back(share.upper);
    }
    return table;
}

} // namespace

SurfaceCounts::SurfaceCounts(const SurfaceAxes& axes, LimitState limit) : limit_(limit)
{
    table_.axes() = axes;
    table_.trials.resize(axes.cells());
    table_.collapses.resize(axes.cells());
}

SurfaceCounts SurfaceCounts::of(const SurfaceTable& counted)
{
    SurfaceCounts counts(counted.axes());
    counts.table_.trials = counted.trials;
    counts.table_.collapses = counted.collapses;
    return counts;
}

void SurfaceCounts::add(const ResultRow& row)
{
    if (row.outcome.state == State::invalid || row.cell >= table_.trials.size())
        return;
    ++table_.trials[row.cell];
    table_.collapses[row.cell] += reached(limit_, row.outcome);
}

SurfaceTable SurfaceCounts::table() const
{
    return with_shares(table_);
}

SurfaceTable surface_of(const ResultHeader& header, const Tally& tally, LimitState limit)
{
    SurfaceTable table;
    table.axes() = header;
    table.trials = tally.trials;
    for (std::size_t cell = 0; cell < tally.cells(); ++cell)
        table.collapses.push_back(tally.reached[cell * tally.limit_states + static_cast<std::size_t>(limit)]);
    return with_shares(table);
}

namespace {

/// 12345 as "12,345".
std::string grouped(std::uint64_t number)
{
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;)
        text.insert(at -= 3, ",");
    return text;
}

/// How many cells have intervals below their probabilities in the table of a page.
constexpr std::size_t most_with_intervals = 10;

HtmlTable cell_table(const SurfaceTable& surface)
{
    const std::size_t nf = surface.rows().size(), np = surface.pga_m_s2.size();
    const bool intervals = nf <= most_with_intervals;
    HtmlTable table;
    table.caption = fmt::format("Probability of collapse [%]{}; columns: {}, rows: PGA [m/s²]",
                                intervals ? ", below it its interval" : "", surface.row_quantity().label);
    table.align = "r" + std::string(nf, 'c');
    table.head = {"PGA"};
    for (const double value : surface.rows())
        table.head.emplace_back(fmt::format("{:.3g}", value));
    for (std::size_t p = np; p-- > 0;) {
        std::vector<Html> row = {fmt::format("{:.3g}", surface.pga_m_s2[p])};
        for (std::size_t f = 0; f < nf; ++f) {
            const std::size_t cell = f * np + p;
            if (surface.trials[cell] == 0) {
                row.emplace_back("–");
                continue;
            }
            std::string text = fmt::format("{:.0f}", 100 * surface.probability[cell]);
            if (intervals)
                text += fmt::format("<br><small>{:.0f} to {:.0f}</small>", 100 * surface.lower[cell],
                                    100 * surface.upper[cell]);
            row.push_back(Html::ready(std::move(text)));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// The probability over PGA at some frequencies or directions, with its intervals.
Figure slice_figure(const SurfaceTable& table)
{
    Figure figure;
    const RowQuantity& of = table.row_quantity();
    figure.title = fmt::format("Probability of collapse over PGA at some {}", of.plural);
    figure.x_label = "PGA [m/s²]";
    figure.y_label = "probability of collapse";
    figure.x_log = make_cell_axis(table.pga_m_s2, "pga_m_s2").log;
    const std::size_t np = table.pga_m_s2.size();
    for (const std::size_t row : slice_rows(table, {})) {
        FigureSeries series{
            fmt::format("{:.3g}{}", table.rows()[row], of.symbol), SeriesKind::line, table.pga_m_s2, {}, {}, {}};
        for (std::size_t p = 0; p < np; ++p) {
            series.y.push_back(table.probability[row * np + p]);
            series.low.push_back(table.lower[row * np + p]);
            series.high.push_back(table.upper[row * np + p]);
        }
        figure.series.push_back(std::move(series));
    }
    return figure;
}

/// What the picture shows of the band over contact laws.
std::optional<SurfaceRange> range_of(const LawBand* laws, LimitState limit)
{
    const LawBand::Limit* found = laws ? laws->limit(limit_state_names()[static_cast<std::size_t>(limit)]) : nullptr;
    if (!found)
        return std::nullopt;
    SurfaceRange range;
    range.words = law_band_words(*found, *laws);
    for (const LawBand::Place& cell : found->cells) {
        range.low.push_back(cell.low());
        range.high.push_back(cell.high());
    }
    return range;
}

} // namespace

SurfaceKind::SurfaceKind(const Study& study, const ResultHeader& header) : Kind(study, header), counts_by_cell_(header)
{
}

void SurfaceKind::take(const ResultRow& row)
{
    if (is_trial(row.index))
        counts_by_cell_.add(row);
}

void SurfaceKind::take(const Tally& tally)
{
    counts_by_cell_ = SurfaceCounts::of(surface_of(header_, tally, LimitState::collapse));
}

ChosenCells SurfaceKind::choose(const CellChoice& choice, const std::string& results) const
{
    const bool directions = !header_.direction_deg.empty();
    if (choice.motion || choice.intensity || (directions ? choice.frequency_hz : choice.direction_deg))
        return Kind::choose(choice, results);
    std::optional<std::uint64_t> f, p;
    ChosenCells cells;
    const RowQuantity& of = header_.row_quantity();
    if (const auto& value = directions ? choice.direction_deg : choice.frequency_hz) {
        f = nearest_on_axis(header_.rows(), *value, of.option, of.unit, results);
        cells.words = fmt::format("at {:.4g}{}", header_.rows()[*f], of.symbol);
    }
    if (choice.pga_m_s2) {
        p = nearest_on_axis(header_.pga_m_s2, *choice.pga_m_s2, "--pga", "m/s2", results);
        cells.words = fmt::format("{}{:.4g} m/s2", f ? *cells.words + ", " : "at ", header_.pga_m_s2[*p]);
    }
    cells.has = [f, p, np = header_.pga_m_s2.size()](std::uint64_t cell) {
        return (!f || cell / np == *f) && (!p || cell % np == *p);
    };
    return cells;
}

Picture SurfaceKind::picture(const ResultReader& reader, const std::string& results,
                             const PictureRequest& request) const
{
    const std::vector<std::string>& known = limit_state_names();
    if (request.limit && std::find(known.begin(), known.end(), *request.limit) == known.end())
        throw InputError(
            fmt::format("--limit {}: the limit states of a surface are {}", *request.limit, fmt::join(known, ", ")));
    if (const RowQuantity& of = header_.row_quantity(); request.rows_by && *request.rows_by != of.option)
        throw InputError(
            fmt::format("{}: {} is a surface over {}; give {}", *request.rows_by, results, of.plural, of.option));
    const LimitState limit = request.limit ? limit_state_of(*request.limit) : LimitState::collapse;
    const SurfaceTable surface = surface_so_far(reader, study_, results, limit);
    Picture picture;
    picture.name = request.name;
    if (!request.rows.empty())
        for (const std::size_t row : slice_rows(surface, request.rows))
            picture.name += fmt::format("_{:.4g}{}", surface.rows()[row], surface.direction_deg.empty() ? "Hz" : "deg");
    if (request.limit)
        picture.name += "_" + *request.limit;
    picture.title = "Probability of " + std::string(describe(limit));
    picture.partial = partial_words(reader, study_, surface);
    if (request.name == "slice")
        picture.draw = [surface, limit, rows = request.rows](const std::string& title,
                                                             const std::filesystem::path& file) {
            plot_slice(surface, rows, describe(limit), title, file);
        };
    else
        picture.draw = [surface, limit, range = range_of(request.laws, limit)](const std::string& title,
                                                                               const std::filesystem::path& file) {
            plot_surface(surface, describe(limit), title, file, range);
        };
    return picture;
}

void SurfaceKind::map(PageWriter& writer) const
{
    const SurfaceTable table = *surface();
    writer.page.part("instrument", [&] {
        writer.page.part("of-map", [&] {
            writer.page.figure(map_svg(table),
                               fmt::format("The probability of collapse over {} and PGA. Lines: 0.05, 0.5 and 0.95.",
                                           table.row_quantity().name));
        });
    });
}

void SurfaceKind::sections(PageWriter& writer) const
{
    const SurfaceTable table = *surface();
    writer.page.section("Probability of collapse");
    if (table.pga_m_s2.size() > 1)
        writer.page.figure(
            figure_svg(slice_figure(table)),
            fmt::format("The probability at some {}; bands: the intervals of the cells.", table.row_quantity().plural));
    writer.page.table(cell_table(table));
    if (const std::optional<std::string> more = remark(table))
        writer.page.note(*more);
    writer.page.note(describe_realizations(table) + "; " + describe_interval(table.interval) +
                     (table.rows().size() <= most_with_intervals
                          ? "."
                          : ". The intervals of all cells are in the file, and in the tables of stylobate export "
                            "--to csv."));
}

std::string partial_words(const ResultReader& reader, const Study& study, const SurfaceTable& surface)
{
    if (reader.complete())
        return "";
    const auto n = std::accumulate(surface.trials.begin(), surface.trials.end(), std::uint64_t{0});
    const std::string of = reader.header().selected ? "" : "of " + grouped(study.originals()) + " ";
    // of those kept some are not drawn: invalid ones, and ones that ended before others that were begun earlier
    const bool of_kept = study.originals() == study.total() && n < reader.done();
    return of_kept ? fmt::format(" – partial: {} of the {} realizations kept{}", grouped(n), grouped(reader.done()),
                                 of.empty() ? "" : ", " + of.substr(0, of.size() - 1))
                   : fmt::format(" – partial: {} {}realizations", grouped(n), of);
}

SurfaceTable surface_so_far(const ResultReader& reader, const Study& study, const std::string& results,
                            LimitState limit)
{
    const ResultHeader& header = reader.header();
    if (limit == LimitState::collapse && reader.complete())
        return reader.surface();
    if (limit == LimitState::total && study.outcome.follow != Follow::rest)
        throw InputError(fmt::format("--limit total: {} computed each realization only until its first fall. Run the "
                                     "study again with outcome.follow = \"rest\".",
                                     results));
    if (const Tally* tally = reader.tally())
        return surface_of(header, *tally, limit);
    SurfaceCounts counts(header, limit);
    const std::uint64_t originals = study.originals();
    const RunOrder order(originals);
    std::uint64_t places = header.selected ? 0 : originals; // those of an adaptive surface are begun round by round
    if (!reader.complete() && !header.selected)
        for (places = 0; places < originals && reader.has(order.index(places));)
            ++places;
    places = header.selected ? 0 : order.fair(places);
    reader.for_each_row([&](const ResultRow& row) {
        if (row.index < originals && (header.selected || order.place(row.index) < places))
            counts.add(row);
    });
    SurfaceTable table = counts.table();
    if (std::ranges::all_of(table.trials, [](std::uint64_t n) { return n == 0; })) // there is nothing to draw yet
        check_complete(reader, results);
    return table;
}

} // namespace stylobate
