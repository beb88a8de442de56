#include "studies/results/cell_outcomes.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/store/surface_axis.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace stylobate {
namespace {

struct OfCell {
    std::array<std::uint64_t, 5> states{}; ///< in the order of `State`
    std::map<std::int32_t, std::uint64_t> first;
    std::vector<double> fall_time_s;
};

std::string name_of(std::int32_t block, const std::vector<std::string>& names)
{
    return block == several_blocks ? "several together" : names.at(static_cast<std::size_t>(block));
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
    Json first = Json::object(), times = Json::object();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::vector<double> sorted = cells[i].fall_time_s;
        if (sorted.empty())
            continue;
        std::sort(sorted.begin(), sorted.end());
        Json of_cell = Json::list();
        for (const auto& [block, count] : cells[i].first)
            of_cell.item(Json::list().item(name_of(block, names)).item_as_is(fmt::format("{}", count)));
        first.member(fmt::format("{}", i), of_cell);
        times.member(fmt::format("{}", i),
                     Json::brief(std::vector<double>{
                         sorted.front(), sorted_quantile(sorted, 0.5, QuantileDefinition::linear), sorted.back()}));
    }
    json.member("first", first).member("times", times);
}

} // namespace

std::string cells_json(const SurfaceTable& table, const std::vector<ResultRow>& trials,
                       const std::vector<std::string>& block_names, const std::string& file)
{
    Json json = Json::object();
    json.member("frequency_hz", Json::brief(table.frequency_hz))
        .member("pga_m_s2", Json::brief(table.pga_m_s2))
        .member("interval", describe_interval(table.interval))
        .member("trials", Json::brief(table.trials))
        .member("collapses", Json::brief(table.collapses))
        .member("probability", Json::brief(table.probability))
        .member("lower", Json::brief(table.lower))
        .member("upper", Json::brief(table.upper))
        .member("file", file);
    if (!table.method.empty()) {
        Json methods = Json::list();
        for (const IntervalMethod method : table.method)
            methods.item(
                std::string_view(method == IntervalMethod::surface ? "neighbouring cells too" : "this cell alone"));
        json.member("method", methods);
    }
    if (trials.empty())
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
    }
    add_outcomes(json, cells, block_names);
    return json.text();
}

} // namespace stylobate
