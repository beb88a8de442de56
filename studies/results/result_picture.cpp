#include "studies/results/result_picture.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/structure.hpp"
#include "io/plots/plot_strip.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/report/animation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

std::string strip_title(const Results& results, const TracedMotion& motion)
{
    const std::uint64_t index = motion.trajectory.index;
    std::string title = realization_title(results, index);
    return title + (results.reader().has(index) ? fmt::format(", {}", to_string(motion.state)) : "");
}

/// The blocks whose histories are drawn: all that can move, or the tops where these are too many.
std::vector<std::size_t> told_blocks(const std::vector<PlacedBlock>& blocks)
{
    constexpr std::size_t most = 6; // and the base: as many as there are colours
    std::vector<std::size_t> all, tops;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks[i].fixed)
            continue;
        all.push_back(i);
        if (is_top(blocks, i))
            tops.push_back(i);
    }
    std::vector<std::size_t> told = all.size() <= most ? all : tops;
    told.resize(std::min(told.size(), most));
    return told;
}

} // namespace

std::optional<std::string> motion_words(const Results& results, const ResultRow& row)
{
    const StudyDesign design = results.study().design();
    const std::vector<std::string>& names = results.header().motions.names;
    const std::uint64_t motion = row.cell / design.columns;
    if (!design.motions || motion >= names.size())
        return std::nullopt;
    const MotionSetSpec& set = *design.motions;
    const std::string name = names[motion].starts_with("motion ") ? names[motion] : "motion " + names[motion];
    if (set.method == FragilityMethod::cloud)
        return fmt::format("{} at PGA {:.3g} m/s²", name, row.pga_m_s2);
    const std::string measure = measure_name(set.measure, set.period_s);
    const std::string unit = measure_unit(measure);
    return fmt::format("{} at {} {:.3g} {}", name, short_measure(measure),
                       set.intensity.value(static_cast<int>(row.cell % design.columns)),
                       unit == "m/s2" ? "m/s²" : unit);
}

std::string shaking_words(const Results& results, const ResultRow& row)
{
    if (const std::optional<std::string> motion = motion_words(results, row))
        return *motion;
    const ResultHeader& header = results.header();
    std::string words;
    if (row.frequency_hz > 0)
        words = fmt::format("{:.3g} Hz, {:.3g} m/s²", row.frequency_hz, row.pga_m_s2);
    if (!header.direction_deg.empty())
        words += fmt::format("{}{:.3g}°", words.empty() ? "" : ", ",
                             header.direction_deg[row.cell / header.pga_m_s2.size()]);
    return words;
}

std::string realization_title(const Results& results, std::uint64_t index)
{
    std::string title = fmt::format("{}, realization {}", results.title(), index);
    if (!results.reader().has(index))
        return title;
    const std::string shaking = shaking_words(results, results.reader().row(index));
    return shaking.empty() ? title : title + ": " + shaking;
}

TracedMotion traced_motion(const Results& results, Isa isa, std::uint64_t index)
{
    const ResultReader& reader = results.reader();
    const auto azimuth = [&](const Outcome& outcome) {
        return results.study().structure.spatial() ? outcome.fall_azimuth_rad
                                                   : std::numeric_limits<double>::quiet_NaN();
    };
    const std::vector<std::uint64_t> stored = reader.trajectory_indices();
    if (std::find(stored.begin(), stored.end(), index) != stored.end()) {
        const ResultRow row = reader.row(index);
        return {reader.trajectory(index), row.outcome.fall_time_s, row.outcome.state, row.frequency_hz, row.pga_m_s2,
                azimuth(row.outcome)};
    }
    const Experiment& experiment = results.experiment();
    if (index < results.header().first || index >= results.end())
        throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", index, results.file(),
                                     results.header().first, results.end() - 1));
    TracedRealization f = trace(experiment, index, isa);
    const double azimuth_rad = azimuth(f.outcome);
    return {std::move(f.trajectory),    std::move(f.outcome.fall_time_s), f.outcome.state,
            f.realization.frequency_hz, f.realization.pga_m_s2,           azimuth_rad};
}

std::vector<Figure> history_figures(const Results& results, const TracedMotion& motion)
{
    const Trajectory& t = motion.trajectory;
    const StructureSpec& structure = results.study().structure;
    const std::vector<std::size_t> told = told_blocks(lay_out(structure).blocks);
    std::vector<Figure> figures;
    for (const std::string along : {"x", "z"}) {
        if (along == "z" && !structure.spatial())
            break;
        Figure figure;
        figure.title = fmt::format("Displacements of realization {} over time", t.index);
        if (structure.spatial())
            figure.title += ", along " + along;
        figure.x_label = "time [s]";
        figure.y_label = "displacement [m]";
        const std::vector<double>&place = t[along + "_m"], &rest = t["rest_" + along + "_m"];
        figure.series.push_back({"base", SeriesKind::line, t.time_s, t["base_" + along + "_m"], {}, {}});
        for (const std::size_t block : told) {
            FigureSeries series{t.name[block], SeriesKind::line, t.time_s, {}, {}, {}};
            for (std::size_t k = 0; k < t.time_s.size(); ++k)
                series.y.push_back(place[k * t.blocks() + block] - rest[block]);
            figure.series.push_back(std::move(series));
        }
        figures.push_back(std::move(figure));
    }
    return figures;
}

void strip_picture(const Results& results, const TracedMotion& motion, const std::optional<std::string>& title,
                   const fs::path& file)
{
    const Trajectory& t = motion.trajectory;
    const Study& study = results.study();
    plot_strip(t, motion.fall_time_s, title.value_or(strip_title(results, motion)), file, usual_snapshots,
               fastenings(study.mechanisms, study.contact.friction, lay_out(study.structure)));
}

FallOrder fall_order(const std::vector<std::string>& names, const std::vector<ResultRow>& rows,
                     const MotionGroups& motions)
{
    FallOrder order;
    for (const std::string& name : names)
        order.blocks.push_back({name, 0, {}, 0, 1});
    LimitCounts counts(names.size(), motions);
    order.interval = counts.interval();
    for (const ResultRow& row : rows) {
        counts.add(row);
        if (row.outcome.state == State::invalid)
            continue;
        order.end_time_s = std::max(order.end_time_s, row.outcome.end_time_s);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (row.outcome.fall_time_s[i] >= 0)
                order.blocks[i].fall_time_s.push_back(row.outcome.fall_time_s[i]);
    }
    order.trials = counts.trials();
    order.together = counts.first_together();
    for (std::size_t i = 0; i < names.size(); ++i) {
        FallOrder::Block& block = order.blocks[i];
        std::sort(block.fall_time_s.begin(), block.fall_time_s.end());
        block.first = counts.first()[i];
        const Share share = counts.share_fallen(i);
        block.lower = share.lower;
        block.upper = share.upper;
    }
    return order;
}

void order_picture(const Results& results, long long cell, const std::optional<std::string>& given_title,
                   const fs::path& file)
{
    const ResultHeader& header = results.header();
    check_complete(results.reader(), results.file());
    if (!header.has_rows())
        throw InputError(
            fmt::format("{}: has no rows of realizations (output.realizations = \"none\"), so it does not record when "
                        "each block fell; counts.csv of 'export --to csv' contains the first block to fall",
                        results.file()));
    std::vector<ResultRow> rows = results.trials();
    std::string title = "Falls: " + results.title();
    const std::size_t np = header.pga_m_s2.size();
    const std::size_t cells = header.cells();
    if (cell >= 0) {
        const auto wanted = static_cast<std::size_t>(cell);
        if (cells == 0)
            throw InputError(
                fmt::format("--cell {}: a result of kind '{}' has no cells; omit --cell", cell, header.kind));
        if (wanted >= cells)
            throw InputError(fmt::format("--cell {}: {} has the cells 0 to {} ({} number x {} + PGA number)", cell,
                                         results.file(), cells - 1, header.row_quantity().name, np));
        std::erase_if(rows, [&](const ResultRow& row) { return row.cell != wanted; });
        title += fmt::format(", {:.3g}{}, {:.3g} m/s²", header.rows()[wanted / np], header.row_quantity().symbol,
                             header.pga_m_s2[wanted % np]);
    } else if (cells > 1) {
        title += ", all cells";
    }
    const Study& study = results.study();
    FallOrder falls = fall_order(header.block_names, rows, motion_groups(study, header.motions));
    if (!study.structure.spatial()) // there, columns hide each other as seen from one side
        for (const PlacedBlock& block : lay_out(study.structure).blocks)
            falls.places.push_back({block.left(), block.right(), block.bottom(), block.top()});
    std::string note =
        study.outcome.follow == Follow::rest ? "" : "each realization was computed only until its first fall";
    if (falls.together > 0)
        note += fmt::format("{}in {} several fell first, simultaneously", note.empty() ? "" : " · ", falls.together);
    plot_order(falls, given_title.value_or(title), note, file);
}

} // namespace stylobate
