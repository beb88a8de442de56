/// `stylobate replay`: one realization of a result again, with its trajectory.

#include "ensemble/input_error.hpp"
#include "io/result_store.hpp"
#include "studies/command.hpp"
#include "studies/json.hpp"
#include "studies/loaded_study.hpp"
#include "studies/trajectory.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

namespace stylobate {

int replay_command(const CommonOptions& options, const std::string& results, long long realization,
                   const std::string& trajectory)
{
    const ResultReader reader(results);
    const ResultHeader& header = reader.header();
    if (realization < 0 || static_cast<std::uint64_t>(realization) >= header.first + header.total ||
        static_cast<std::uint64_t>(realization) < header.first)
        throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", realization, results,
                                     header.first, header.first + header.total - 1));
    const auto index = static_cast<std::uint64_t>(realization);
    const LoadedStudy loaded = LoadedStudy::from_results(header, results, options.set);

    ResultHeader one = header;
    one.first = index;
    one.total = 1;
    one.kind = "replay"; // of one realization: there is no surface to it
    one.frequency_hz.clear();
    one.pga_m_s2.clear();
    one.code_version = code_version();
    const FollowedRealization f = follow(loaded, index, options.isa());
    const ResultRow row = result_row(loaded.study(), f.realization, f.outcome);
    if (!trajectory.empty()) { // made only now: an interrupted replay leaves no file
        const std::unique_ptr<ResultWriter> writer = ResultWriter::create(trajectory, one);
        writer->add(row);
        writer->add(f.trajectory);
        writer->finish(nullptr);
    }

    const bool known = reader.has(index);
    const bool same = known && same_bits(reader.row(index), row);
    const Outcome& o = f.outcome;
    if (options.json) {
        Json json = Json::object();
        json.member("realization", index)
            .member("frequency_hz", row.frequency_hz)
            .member("pga_m_s2", row.pga_m_s2)
            .member("state", to_string(o.state))
            .member("collapse_time_s", o.collapse_time_s)
            .member("first_collapse_block", o.first_collapse_block)
            .member("peak_top_displacement_m", o.peak_top_displacement_m)
            .member("residual_top_displacement_m", o.residual_top_displacement_m)
            .member("total_sliding_m", o.total_sliding_m)
            .member("total_rocking_rad", o.total_rocking_rad)
            .member("energy_residual", o.energy_residual)
            .member("end_time_s", o.end_time_s)
            .member("step_s", o.step_s)
            .member("in_results", known)
            .member("same_bits", same);
        if (!trajectory.empty())
            json.member("trajectory", trajectory);
        fmt::print("{}\n", json.text());
    } else if (!options.quiet) {
        fmt::print("realization {} at {:.4g} Hz, {:.4g} m/s2: {}", index, row.frequency_hz, row.pga_m_s2,
                   to_string(o.state));
        if (o.state == State::collapsed)
            fmt::print(" at {:.4f} s, block {} first", o.collapse_time_s, o.first_collapse_block);
        if (o.state == State::invalid)
            fmt::print(" ({})", to_string(o.invalid_reason));
        fmt::print("\n  peak top displacement {:.4g} m, residual {:.4g} m, sliding {:.4g} m, rocking {:.4g} rad\n",
                   o.peak_top_displacement_m, o.residual_top_displacement_m, o.total_sliding_m, o.total_rocking_rad);
        fmt::print("  {}\n", !known ? "not in the results yet"
                             : same ? "the same bits as in the results"
                                    : "NOT the bits of the results");
        if (!trajectory.empty())
            fmt::print("  trajectory in {}\n", trajectory);
    }
    if (known && !same) {
        fmt::print(stderr,
                   "stylobate: realization {} came out otherwise than in {}, which was made by version {} (this "
                   "is {})\n",
                   index, results, header.code_version, code_version());
        return exit_failed;
    }
    return exit_done;
}

} // namespace stylobate
