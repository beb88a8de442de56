#include "studies/pages/result_picture.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "io/plots/plot_order.hpp"
#include "io/plots/plot_strip.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/surface/surface.hpp"
#include "studies/pages/fall_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

struct Followed {
    Trajectory trajectory;
    std::vector<double> fall_time_s; ///< (blocks)
};

/// The trajectory that the file holds, or else the realization run again.
Followed trajectory_of(const Rerun& rerun, const ResultReader& reader, const std::string& results, std::uint64_t index)
{
    const std::vector<std::uint64_t> stored = reader.trajectory_indices();
    if (std::find(stored.begin(), stored.end(), index) != stored.end())
        return {reader.trajectory(index), reader.row(index).outcome.fall_time_s};
    const ResultHeader& header = reader.header();
    check_replayable(header, results);
    const LoadedStudy loaded = LoadedStudy::from_results(header, results, rerun.settings);
    const std::uint64_t end = realizations_end(header, loaded.study());
    if (index < header.first || index >= end)
        throw InputError(
            fmt::format("--realization {}: {} has realizations {} to {}", index, results, header.first, end - 1));
    FollowedRealization f = follow(loaded.experiment(), index, rerun.isa);
    return {std::move(f.trajectory), std::move(f.outcome.fall_time_s)};
}

std::string strip_title(const ResultReader& reader, const std::string& results, std::uint64_t index)
{
    std::string title = fmt::format("{}, realization {}", title_of(reader, results), index);
    if (reader.has(index)) {
        const ResultRow row = reader.row(index);
        if (row.frequency_hz > 0)
            title += fmt::format(": {:.3g} Hz, {:.3g} m/s²", row.frequency_hz, row.pga_m_s2);
        title += fmt::format(", {}", to_string(row.outcome.state));
    }
    return title;
}

/// 12345 as "12,345".
std::string grouped(std::uint64_t number)
{
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;)
        text.insert(at -= 3, ",");
    return text;
}

Study study_of(const ResultReader& reader, const std::string& results)
{
    return parse_study(reader.header().study_toml, results + " (its study)");
}

} // namespace

std::string title_of(const ResultReader& reader, const std::string& results)
{
    const std::string title = study_of(reader, results).title;
    return title.empty() ? fs::path(results).stem().string() : title;
}

void check_complete(const ResultReader& reader, const std::string& results)
{
    if (!reader.complete())
        throw InputError(fmt::format("{}: the run is not complete; run the same study again to continue it", results));
}

void check_replayable(const ResultHeader& header, const std::string& results)
{
    if (header.kind == "rare")
        throw InputError(
            fmt::format("{}: a realization of a chain follows from all before it; none can be run again by "
                        "itself",
                        results));
}

bool followed_to_rest(const ResultReader& reader, const std::string& results)
{
    return study_of(reader, results).outcome.follow == Follow::rest;
}

bool has_twins(const ResultReader& reader, const std::string& results)
{
    return reader.complete() && !reader.header().frequency_hz.empty() && study_of(reader, results).twins.has_value();
}

std::vector<ResultRow> original_rows(const ResultReader& reader, const std::string& results)
{
    const Study study = study_of(reader, results);
    std::vector<ResultRow> rows = reader.rows();
    if (study.twins && reader.header().kind != "replay")
        std::erase_if(rows, [&](const ResultRow& row) { return row.index >= study.originals(); });
    return rows;
}

SurfaceTable surface_so_far(const ResultReader& reader, const std::string& results, LimitState limit)
{
    const ResultHeader& header = reader.header();
    if (header.frequency_hz.empty())
        throw InputError(fmt::format("{}: a result of kind '{}' has no surface; use --picture strip or order", results,
                                     header.kind));
    if (limit == LimitState::collapse && reader.complete())
        return reader.surface();
    if (limit == LimitState::total && !followed_to_rest(reader, results))
        throw InputError(fmt::format("--limit total: {} followed each realization until its first fall only. Run the "
                                     "study again with outcome.follow = \"rest\".",
                                     results));
    if (const Tally* tally = reader.tally())
        return surface_of(header, *tally, limit);
    SurfaceCounts counts(header.frequency_hz, header.pga_m_s2, limit);
    const std::uint64_t originals = study_of(reader, results).originals();
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
    if (std::ranges::all_of(table.trials, [](std::uint64_t n) { return n == 0; }))
        check_complete(reader, results); // there is nothing to draw yet
    return table;
}

std::string partial_words(const ResultReader& reader, const std::string& results, const SurfaceTable& surface)
{
    if (reader.complete())
        return "";
    const auto n = std::accumulate(surface.trials.begin(), surface.trials.end(), std::uint64_t{0});
    const std::string of = reader.header().selected ? "" : " of " + grouped(study_of(reader, results).originals());
    return fmt::format(" – partial: {}{} realizations", grouped(n), of);
}

SensitivityTable finished_sensitivity(const ResultReader& reader, const std::string& results)
{
    if (reader.header().kind != "sensitivity")
        throw InputError(fmt::format("{}: a result of kind '{}' has no sensitivities; a study of study.kind = "
                                     "\"sensitivity\" has",
                                     results, reader.header().kind));
    check_complete(reader, results);
    return reader.sensitivity();
}

RareTable finished_rare(const ResultReader& reader, const std::string& results)
{
    if (reader.header().kind != "rare")
        throw InputError(
            fmt::format("{}: a result of kind '{}' has no rare event; a study of study.kind = \"rare\" has", results,
                        reader.header().kind));
    check_complete(reader, results);
    return reader.rare();
}

void strip_picture(const Rerun& rerun, const ResultReader& reader, const std::string& results, std::uint64_t index,
                   const std::string& title, const fs::path& file)
{
    const Followed f = trajectory_of(rerun, reader, results, index);
    plot_strip(f.trajectory, f.fall_time_s, title.empty() ? strip_title(reader, results, index) : title, file);
}

void order_picture(const ResultReader& reader, const std::string& results, long long cell,
                   const std::string& given_title, const fs::path& file)
{
    const ResultHeader& header = reader.header();
    check_complete(reader, results);
    if (!header.has_rows())
        throw InputError(
            fmt::format("{}: keeps no rows of its realizations (output.realizations = \"none\"), and so not "
                        "when each block fell; which fell first is in counts.csv of 'export --to csv'",
                        results));
    std::vector<ResultRow> rows = original_rows(reader, results);
    std::string title = "Falls: " + title_of(reader, results);
    const std::size_t np = header.pga_m_s2.size();
    const std::size_t cells = header.frequency_hz.size() * np;
    if (cell >= 0) {
        const auto wanted = static_cast<std::size_t>(cell);
        if (cells == 0)
            throw InputError(
                fmt::format("--cell {}: a result of kind '{}' has no cells; leave --cell out", cell, header.kind));
        if (wanted >= cells)
            throw InputError(fmt::format("--cell {}: {} has the cells 0 to {} (frequency number x {} + PGA number)",
                                         cell, results, cells - 1, np));
        std::erase_if(rows, [&](const ResultRow& row) { return row.cell != wanted; });
        title +=
            fmt::format(", {:.3g} Hz, {:.3g} m/s²", header.frequency_hz[wanted / np], header.pga_m_s2[wanted % np]);
    } else if (cells > 1) {
        title += ", all cells";
    }
    const Study study = study_of(reader, results);
    FallOrder falls = fall_order(header.block_names, rows, cells_of_motion(study));
    for (const PlacedBlock& block : lay_out(study.structure).blocks)
        falls.places.push_back({block.left(), block.right(), block.bottom(), block.top()});
    std::string note =
        followed_to_rest(reader, results) ? "" : "each realization was followed until its first fall only";
    if (falls.together > 0)
        note += fmt::format("{}in {} several fell first, together", note.empty() ? "" : " · ", falls.together);
    plot_order(falls, given_title.empty() ? title : given_title, note, file);
}

} // namespace stylobate
