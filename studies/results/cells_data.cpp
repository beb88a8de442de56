#include "studies/results/cells_data.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/store/surface_axis.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/surface/surface_kind.hpp"
#include "studies/report/animation.hpp"
#include "studies/report/json.hpp"
#include "studies/results/fall_rose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

namespace stylobate {
namespace {

struct OfCell {
    std::array<std::uint64_t, 5> states{}; ///< in the order of `State`
    std::map<std::int32_t, std::uint64_t> first;
    std::vector<double> fall_time_s; ///< ascending
    FallRose rose;
};

std::string name_of(std::int32_t block, const std::vector<std::string>& names)
{
    return block == several_blocks ? "several together" : names.at(static_cast<std::size_t>(block));
}

/// The times of all first falls, for histograms. They are rounded to a thousandth of the last one.
void add_falls(Json& json, const std::vector<OfCell>& cells)
{
    double last_s = 0;
    for (const OfCell& cell : cells)
        if (!cell.fall_time_s.empty())
            last_s = std::max(last_s, cell.fall_time_s.back());
    if (last_s <= 0)
        return;
    const double quantum_s = last_s / 1000;
    Json of_cells = Json::object();
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (!cells[i].fall_time_s.empty())
            of_cells.member(fmt::format("{}", i), ascending_text(cells[i].fall_time_s, quantum_s));
    json.member("falls", Json::object().member("quantum_s", quantum_s).member("cells", of_cells));
}

void add_outcomes(Json& json, const std::vector<OfCell>& cells, const std::vector<std::string>& names)
{
    Json outcomes = Json::object();
    for (const State state : {State::stood, State::rocked, State::slid, State::invalid}) {
        std::vector<std::uint64_t> counts;
        for (const OfCell& cell : cells)
            counts.push_back(cell.states[static_cast<std::size_t>(state)]);
        if (state != State::invalid || std::ranges::any_of(counts, [](std::uint64_t n) { return n > 0; }))
            outcomes.member(to_string(state), Json::brief(counts));
    }
    json.member("outcomes", outcomes);
    Json first = Json::object(), times = Json::object(), roses = Json::object();
    bool any_rose = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::vector<double>& sorted = cells[i].fall_time_s;
        if (sorted.empty())
            continue;
        Json of_cell = Json::list();
        for (const auto& [block, count] : cells[i].first)
            of_cell.item(Json::list().item(name_of(block, names)).item_as_is(fmt::format("{}", count)));
        first.member(fmt::format("{}", i), of_cell);
        times.member(fmt::format("{}", i),
                     Json::brief(std::vector<double>{
                         sorted.front(), sorted_quantile(sorted, 0.5, QuantileDefinition::linear), sorted.back()}));
        if (cells[i].rose.falls() == 0)
            continue;
        roses.member(fmt::format("{}", i), Json::brief(cells[i].rose.counts()));
        any_rose = true;
    }
    json.member("first", first).member("times", times);
    add_falls(json, cells);
    if (any_rose)
        json.member("rose", roses);
}

/// How often each limit state was reached, by cell; each interval once, as it depends on counts alone.
void add_limits(Json& json, const SurfaceTable& collapse, const Results& results)
{
    const ResultHeader& header = results.header();
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::pair<double, double>> intervals;
    const auto limit_json = [](LimitState limit) {
        return Json::object()
            .member("name", limit_state_names()[static_cast<std::size_t>(limit)])
            .member("words", describe(limit));
    };
    Json limits = Json::list();
    for (const LimitState limit :
         header.selected ? std::vector{LimitState::collapse} : counted_limits(results.study())) {
        if (limit == LimitState::collapse) { // its table has its own probabilities
            limits.item(limit_json(limit));
            continue;
        }
        SurfaceTable table;
        if (const Tally* tally = results.reader().tally()) {
            table = surface_of(header, *tally, limit);
        } else {
            SurfaceCounts counts(collapse.axes(), limit);
            for (const ResultRow& row : results.trials())
                counts.add(row);
            table = counts.table();
        }
        for (std::size_t cell = 0; cell < table.trials.size(); ++cell)
            intervals[{table.trials[cell], table.collapses[cell]}] = {table.lower[cell], table.upper[cell]};
        limits.item(limit_json(limit).member("reached", Json::brief(table.collapses)));
    }
    Json list = Json::list();
    for (const auto& [counts, ends] : intervals)
        list.item(Json::list()
                      .item(counts.first)
                      .item(counts.second)
                      .item(Json::brief(std::vector<double>{ends.first, ends.second})));
    json.member("limits", limits).member("intervals", list);
}

/// Where the values of an axis lie in the frame, from 0 to 1.
Json places_json(const std::vector<double>& values, const char* name)
{
    const CellAxis axis = make_cell_axis(values, name);
    std::vector<double> places;
    for (const double value : values)
        places.push_back(axis.in_unit(value));
    return Json::brief(places);
}

} // namespace

std::vector<LimitState> counted_limits(const Study& study)
{
    std::vector<LimitState> limits;
    for (std::size_t i = 0; i < limit_state_names().size(); ++i) {
        const auto limit = static_cast<LimitState>(i);
        if ((limit == LimitState::total && study.outcome.follow != Follow::rest) ||
            (limit == LimitState::unseated && study.structure.epistyles.empty()))
            continue;
        limits.push_back(limit);
    }
    return limits;
}

std::string cells_json(const SurfaceTable& table, const Results& results)
{
    const ResultHeader& header = results.header();
    const RowQuantity& of = table.row_quantity();
    Json json = Json::object();
    json.member("rows", Json::brief(table.rows()))
        .member("row_key", of.key)
        .member("row_name", of.name)
        .member("row_symbol", of.symbol)
        .member("row_label", of.label)
        .member("row_option", of.option)
        .member("row_at", places_json(table.rows(), of.key))
        .member("pga_m_s2", Json::brief(table.pga_m_s2))
        .member("pga_at", places_json(table.pga_m_s2, "pga_m_s2"))
        .member("interval", describe_interval(table.interval))
        .member("trials", Json::brief(table.trials))
        .member("collapses", Json::brief(table.collapses))
        .member("probability", Json::brief(table.probability))
        .member("lower", Json::brief(table.lower))
        .member("upper", Json::brief(table.upper))
        .member("file", std::filesystem::path(results.file()).filename().string());
    if (!table.method.empty()) {
        Json methods = Json::list();
        for (const IntervalMethod method : table.method)
            methods.item(
                std::string_view(method == IntervalMethod::surface ? "neighbouring cells too" : "this cell alone"));
        json.member("method", methods);
    }
    add_limits(json, table, results);
    const std::vector<ResultRow>& trials = results.trials();
    if (trials.empty()) // counts alone
        return json.text();
    std::vector<OfCell> cells(table.trials.size());
    for (const ResultRow& row : trials) {
        if (row.cell >= cells.size())
            continue;
        OfCell& cell = cells[row.cell];
        ++cell.states[static_cast<std::size_t>(row.outcome.state)];
        if (row.outcome.state != State::collapsed)
            continue;
        cell.fall_time_s.push_back(row.outcome.collapse_time_s);
        ++cell.first[row.outcome.first_collapse_block];
        if (header.dimensions == 3)
            cell.rose.add(row.outcome);
    }
    for (OfCell& cell : cells)
        std::ranges::sort(cell.fall_time_s);
    add_outcomes(json, cells, header.block_names);
    return json.text();
}

} // namespace stylobate
