/// `stylobate replay`: one realization of a result again, with its trajectory.

#include "ensemble/model/input_error.hpp"
#include "io/store/result_store.hpp"
#include "studies/cli/command.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/report/json.hpp"
#include "studies/results/results.hpp"
#include "studies/version.hpp"
#include "studies/workflow/console.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <unistd.h>

namespace stylobate {

namespace {

struct ChosenRealization {
    std::uint64_t index = 0;
    /// "number 2 of the 143 that fell, of 256 at 3.02 Hz, 9.8 m/s2"; nullopt if the index was given.
    std::optional<std::string> words;
};

/// The options must select in one way.
void check_asked(const RealizationChoice& choice)
{
    const bool by_property = choice.cells.frequency_hz || choice.cells.direction_deg || choice.cells.pga_m_s2 ||
                             choice.cells.motion || choice.cells.intensity || choice.fallen || choice.stood ||
                             choice.nth;
    if (choice.index && by_property)
        throw InputError(
            fmt::format("--realization {}: names one realization; omit the options that select among them "
                        "(--frequency, --direction, --pga, --motion, --intensity, --fallen, --stood, --nth)",
                        *choice.index));
    if (!choice.index && !by_property)
        throw InputError("no realization is given.\n  Give its index by --realization I, or select one: --frequency HZ "
                         "(or --direction DEGREES) --pga M_S2 of a surface, --motion NAME --intensity X of a fragility "
                         "study, --fallen or "
                         "--stood, --nth N.");
    if (choice.fallen && choice.stood)
        throw InputError("--fallen --stood: these options exclude each other; give one of them");
    if (choice.nth && *choice.nth < 1)
        throw InputError(fmt::format("--nth {}: counts from 1", *choice.nth));
}

/// @throws InputError if nothing is selected, if the selection contradicts itself or lies outside an axis, or if there
/// is no such realization
ChosenRealization choose_realization(const Results& of, const RealizationChoice& choice)
{
    const ResultReader& reader = of.reader();
    const std::string& results = of.file();
    check_asked(choice);
    const ResultHeader& header = reader.header();
    if (choice.index) {
        const std::uint64_t end = of.end();
        const auto index = static_cast<std::uint64_t>(std::max(*choice.index, 0LL));
        if (*choice.index < 0 || index >= end || index < header.first)
            throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", *choice.index, results,
                                         header.first, end - 1));
        return {index, std::nullopt};
    }
    const ChosenCells cells = of.kind().choose(choice.cells, results);
    const bool by_outcome = choice.fallen || choice.stood;
    std::vector<std::uint64_t> found;
    std::uint64_t all = 0;
    const auto consider = [&](std::uint64_t index, std::uint64_t cell, State state) {
        // perturbed replicas are not among the realizations of a cell
        if (!cells.has(cell) || !of.kind().is_trial(index))
            return;
        ++all;
        const bool fell = state == State::collapsed, valid = state != State::invalid;
        if (!by_outcome || (choice.fallen ? fell : valid && !fell))
            found.push_back(index);
    };
    if (header.has_rows())
        reader.for_each_row([&](const ResultRow& row) { consider(row.index, row.cell, row.outcome.state); });
    else if (by_outcome)
        throw InputError(fmt::format("--{}: {} has no rows of realizations (output.realizations = \"none\"), so it "
                                     "does not record which realization fell. Select by {}, --pga and --nth.",
                                     choice.fallen ? "fallen" : "stood", results, header.row_quantity().option));
    else
        for (std::uint64_t i = header.first; i < header.first + header.total; ++i)
            consider(i, of.study().cell(i), State::stood);
    std::sort(found.begin(), found.end());

    const std::string what = choice.fallen ? "fell" : choice.stood ? "stood" : "there are";
    const std::string where = cells.words ? " " + *cells.words : "";
    const std::string among = fmt::format("{} of {}{}{}", found.size(), all, where,
                                          header.has_rows() && !reader.complete() ? ", of those run so far" : "");
    const auto nth = static_cast<std::uint64_t>(choice.nth.value_or(1));
    if (found.empty())
        throw InputError(by_outcome ? fmt::format("{}: no realization {}: {}", results, what, among)
                                    : fmt::format("{}: no realization{} was run", results, where));
    if (nth > found.size())
        throw InputError(fmt::format("--nth {}: only {} {}", nth, among, by_outcome ? what : "are there"));
    return {found[nth - 1],
            by_outcome ? fmt::format("number {} of the {} that {}, of {}{}", nth, found.size(), what, all, where)
                       : fmt::format("number {} of {}{}", nth, all, where)};
}

/// The blocks that fell, in the order of their times.
std::vector<std::size_t> fall_sequence(const std::vector<double>& fall_time_s)
{
    std::vector<std::size_t> sequence;
    for (std::size_t i = 0; i < fall_time_s.size(); ++i)
        if (fall_time_s[i] >= 0)
            sequence.push_back(i);
    std::stable_sort(sequence.begin(), sequence.end(),
                     [&](std::size_t a, std::size_t b) { return fall_time_s[a] < fall_time_s[b]; });
    return sequence;
}

Json falls_json(const std::vector<std::size_t>& sequence, const std::vector<std::string>& names,
                const std::vector<double>& fall_time_s)
{
    Json list = Json::list();
    for (const std::size_t block : sequence)
        list.item(
            Json::object().member("block", block).member("name", names[block]).member("time_s", fall_time_s[block]));
    return list;
}

/// "A 1.2000 s, B and C together 1.3000 s".
std::string falls_text(const std::vector<std::size_t>& sequence, const std::vector<std::string>& names,
                       const std::vector<double>& fall_time_s)
{
    std::string text;
    for (std::size_t k = 0; k < sequence.size();) {
        const double time_s = fall_time_s[sequence[k]];
        text += (k > 0 ? ", " : "") + names[sequence[k]];
        std::size_t end = k + 1;
        for (; end < sequence.size() && fall_time_s[sequence[end]] == time_s; ++end)
            text += " and " + names[sequence[end]];
        text += fmt::format("{} {:.4f} s", end > k + 1 ? " together" : "", time_s);
        k = end;
    }
    return text;
}

/// When all had collapsed, -1 if never. NaN where that is not known: of a run that ended at its first fall, unless
/// nothing else was there to fall.
double total_collapse_s(const Study& study, const TracedRealization& f)
{
    const std::vector<PlacedBlock> blocks = lay_out(study.structure).blocks;
    const auto free = std::ranges::count_if(blocks, [](const PlacedBlock& block) { return !block.fixed; });
    const bool known =
        study.outcome.follow == Follow::rest || f.outcome.fallen_blocks == 0 || f.outcome.fallen_blocks == free;
    return known ? f.outcome.total_collapse_time_s : std::numeric_limits<double>::quiet_NaN();
}

/// One that is there is replaced as a whole: it stays until the new one is complete.
void write_replay(const std::filesystem::path& file, const ResultHeader& header, const ResultRow& row,
                  const Trajectory& trajectory)
{
    std::filesystem::path made = file;
    if (std::filesystem::exists(file))
        made.replace_filename(fmt::format(".{}.{}", file.filename().string(), ::getpid()));
    {
        const std::unique_ptr<ResultWriter> writer = ResultWriter::create(made, header);
        writer->add(row);
        writer->add(trajectory);
        writer->finish(nullptr);
    }
    if (made != file)
        std::filesystem::rename(made, file);
}

/// What is known of a replayed realization.
struct Replayed {
    const ResultRow& row;
    const std::vector<std::string>& names; ///< of the blocks
    double total_s = 0;                    ///< `total_collapse_s`
    std::optional<std::string> chosen;     ///< how it was chosen, in words
    std::optional<std::string> trajectory; ///< file
    bool keeps_rows = true;                ///< the results
    bool complete = true;                  ///< the results
    bool known = false;                    ///< whether they have a row of it
    bool same = false;                     ///< whether that row has the same bits
    bool spatial = false;                  ///< whether the structure is in space
};

void print_json(const Replayed& r)
{
    const Outcome& o = r.row.outcome;
    const std::vector<std::size_t> falls = fall_sequence(o.fall_time_s);
    Json json = Json::object();
    json.member("realization", r.row.index)
        .member("frequency_hz", r.row.frequency_hz)
        .member("pga_m_s2", r.row.pga_m_s2)
        .member("state", to_string(o.state))
        .member("collapse_time_s", event_time(o.collapse_time_s))
        .member("first_collapse_block", o.first_collapse_block)
        .member("fallen_blocks", o.fallen_blocks)
        .member("unseated_block", o.unseated_block)
        .member("unseating_time_s", event_time(o.unseating_time_s))
        .member("total_collapse_time_s", event_time(r.total_s))
        .member("falls", falls_json(falls, r.names, o.fall_time_s))
        .member("at_rest", o.at_rest != 0)
        .member("peak_top_displacement_m", o.peak_top_displacement_m)
        .member("residual_top_displacement_m", o.residual_top_displacement_m)
        .member("total_sliding_m", o.total_sliding_m)
        .member("total_rocking_rad", o.total_rocking_rad);
    visit_fields(std::type_identity<Outcome>(), [&](const char* name, auto field, const FieldFacts& facts) {
        if constexpr (!std::is_enum_v<std::remove_cvref_t<decltype(o.*field)>>)
            if (r.spatial && facts.models == Models::space)
                json.member(name, o.*field);
    });
    json.member("energy_residual", o.energy_residual)
        .member("end_time_s", o.end_time_s)
        .member("step_s", o.step_s)
        .member("in_results", r.known)
        .member("same_bits", r.same);
    if (r.chosen)
        json.member("chosen", *r.chosen);
    if (r.trajectory)
        json.member("trajectory", *r.trajectory);
    fmt::print("{}\n", json.text());
}

void print_text(const Replayed& r)
{
    const Outcome& o = r.row.outcome;
    const std::vector<std::size_t> falls = fall_sequence(o.fall_time_s);
    const auto name = [&](std::int32_t block) { return r.names.at(static_cast<std::size_t>(block)); };
    fmt::print("realization {} at {:.4g} Hz, {:.4g} m/s2: {}", r.row.index, r.row.frequency_hz, r.row.pga_m_s2,
               to_string(o.state));
    if (o.state == State::collapsed)
        fmt::print(" at {:.4f} s, {} first", o.collapse_time_s,
                   o.first_collapse_block == several_blocks ? "several blocks together" : name(o.first_collapse_block));
    if (o.unseating_time_s >= 0)
        fmt::print("; {} unseated at {:.4f} s",
                   o.unseated_block == several_blocks ? "several epistyles" : name(o.unseated_block),
                   o.unseating_time_s);
    if (o.state == State::invalid)
        fmt::print(" ({})", to_string(o.invalid_reason));
    if (r.chosen)
        fmt::print("\n  {}", *r.chosen);
    const std::string residual = o.at_rest != 0 ? fmt::format("residual {:.4g} m", o.residual_top_displacement_m)
                                                : "residual not known (it still moved at the end)";
    fmt::print("\n  centre of the top block: peak displacement {:.4g} m, {}; sliding {:.4g} m, rocking {:.4g} rad\n",
               o.peak_top_displacement_m, residual, o.total_sliding_m, o.total_rocking_rad);
    if (r.spatial) {
        fmt::print("  across the shaking {:.3g} of the peak; largest twist {:.4g} rad", o.out_of_plane_share,
                   o.max_twist_rad);
        if (std::isfinite(o.fall_azimuth_rad))
            fmt::print("; fell at {:.0f} degrees from x towards z", o.fall_azimuth_rad * 180 / std::acos(-1.0));
        fmt::print("\n");
    }
    if (falls.size() > 1) {
        fmt::print("  {} of {} blocks fell: {}\n", falls.size(), r.names.size(),
                   falls_text(falls, r.names, o.fall_time_s));
    }
    if (r.total_s >= 0)
        fmt::print("  total collapse at {:.4f} s: every column and every epistyle has fallen\n", r.total_s);
    else if (std::isnan(r.total_s))
        fmt::print("  computed only until the first fall (outcome.follow = \"collapse\")\n");
    fmt::print("  {}\n", !r.keeps_rows ? "the results have no rows of realizations: no comparison is possible"
                         : !r.known
                             ? (r.complete ? "not in the results: not needed by the run" : "not in the results yet")
                         : r.same ? "bitwise identical to the results"
                                  : "NOT bitwise identical to the results");
    if (r.trajectory)
        fmt::print("  trajectory in {}\n", *r.trajectory);
}

} // namespace

int replay_command(const CommonOptions& options, const std::string& results, const RealizationChoice& choice,
                   const std::optional<std::string>& trajectory)
{
    check_kind(results, "replay");
    const Results file(results, options.set);
    const ResultReader& reader = file.reader();
    const ResultHeader& header = reader.header();
    const Experiment& experiment = file.experiment();
    const ChosenRealization chosen = choose_realization(file, choice);
    const std::uint64_t index = chosen.index;
    if (trajectory)
        check_output(results, *trajectory, options.force);

    ResultHeader one = header;
    one.first = index;
    one.total = 1;
    one.selected = false;
    one.limit_states.clear();
    one.kind = "replay"; // of one realization: there is no surface to it
    one.axes() = {};
    one.code_version = code_version();
    one.build = code_build();
    const TracedRealization f = trace(experiment, index, options.isa());
    const ResultRow row = result_row(experiment.study(), f.realization, f.outcome);
    if (trajectory) // made only now: an interrupted replay leaves no file
        write_replay(*trajectory, one, row, f.trajectory);

    const bool known = reader.has(index);
    const bool same = known && same_bits(reader.row(index), row);
    const Replayed replayed{row,
                            header.block_names,
                            total_collapse_s(experiment.study(), f),
                            chosen.words,
                            trajectory,
                            header.has_rows(),
                            reader.complete(),
                            known,
                            same,
                            f.realization.spatial()};
    if (options.json)
        print_json(replayed);
    else
        print_text(replayed);
    if (known && !same) {
        say(fmt::format(
            "stylobate: realization {} differs from the one in {}, which was computed by version {} (this is {})\n",
            index, results, header.code_version, code_version()));
        return exit_failed;
    }
    return exit_done;
}

} // namespace stylobate
