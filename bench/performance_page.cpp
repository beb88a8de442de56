/// Writes the tables of docs/performance.md from files of results: no figure on that page is typed.
///
///   performance_page RESULTS.json     all tables of one run
///   performance_page --kinds FOLDER   one table, with the rows of every kind of processor of which it has results

#include "bench/results_file.hpp"
#include "io/tables/table.hpp"
#include "studies/workflow/bench/speed_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

using namespace stylobate;

namespace {

const char* const isas[] = {"scalar", "avx2", "avx512"};

std::string millions(double rate)
{
    return rate > 0 ? fmt::format("{:.0f}", rate / 1e6) : "";
}

std::string times(double a, double b)
{
    return a > 0 && b > 0 ? fmt::format("{:.1f}", a / b) : "";
}

void kernel(const ResultsFile& file)
{
    const auto best = [&](const char* family, const std::string& isa, int blocks, const char* counter) {
        return file.best(fmt::format("{}/{}/{}", family, isa, blocks), counter);
    };
    fmt::print("Million block-steps per second of one core: the steps alone, and with base motion and termination "
               "checks as in the ensemble (with all); best of the repetitions.\n\n"
               "| free blocks | steps: scalar | AVX2 | AVX-512 | with all: scalar | AVX2 | AVX-512 |\n"
               "|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const int blocks : {2, 3, 4, 7, 13, 25, 49}) {
        fmt::print("| {} |", blocks - 1);
        for (const char* family : {"BM_Kernel", "BM_Step"})
            for (const char* isa : isas)
                fmt::print(" {} |", millions(best(family, isa, blocks, "block_steps_per_second")));
        fmt::print("\n");
    }
    fmt::print("\nThe seven-block specimen (six of them free): operations counted with a counting number type in the "
               "kernel's template, a multiply-add is two; peak: multiply-adds on registers, same run.\n\n");
    fmt::print("{}", markdown_head("| scalar | AVX2 | AVX-512", Align::numbers));
    const auto row = [&](const char* name, const auto& value) {
        fmt::print("| {} |", name);
        for (const char* isa : isas)
            fmt::print(" {} |", value(isa));
        fmt::print("\n");
    };
    const auto peak = [&](const char* isa) { return file.best(fmt::format("BM_PeakFma/{}", isa), "flops_per_second"); };
    row("operations of a block-step",
        [&](const char* isa) { return fmt::format("{:.0f}", best("BM_Step", isa, 7, "flops_per_block_step")); });
    row("of these divisions and roots",
        [&](const char* isa) { return fmt::format("{:.0f}", best("BM_Step", isa, 7, "divisions_per_block_step")); });
    row("peak, GFLOP/s", [&](const char* isa) { return fmt::format("{:.1f}", peak(isa) / 1e9); });
    for (const char* family : {"BM_Kernel", "BM_Step"}) {
        const bool alone = std::string(family) == "BM_Kernel";
        row(alone ? "steps, GFLOP/s" : "with all, GFLOP/s",
            [&](const char* isa) { return fmt::format("{:.1f}", best(family, isa, 7, "flops_per_second") / 1e9); });
        row("fraction of the peak", [&](const char* isa) {
            return peak(isa) > 0 ? fmt::format("{:.0f} %", 100 * best(family, isa, 7, "flops_per_second") / peak(isa))
                                 : "";
        });
        row("times the scalar rate", [&](const char* isa) {
            return times(best(family, isa, 7, "block_steps_per_second"),
                         best(family, "scalar", 7, "block_steps_per_second"));
        });
    }
}

void structures(const ResultsFile& file)
{
    fmt::print("\n");
    fmt::print("{}", markdown_head("structure, million block-steps/s | scalar | AVX2 | AVX-512", Align::numbers));
    const std::pair<const char*, const char*> scenes[] = {{"column", "the specimen"},
                                                          {"column_two_corner", "the same, contact at two corners"},
                                                          {"column_points", "the same, contact at five points"},
                                                          {"column_watched", "the same, all pairs watched"},
                                                          {"colonnade_2x1", "two columns of one drum"},
                                                          {"colonnade_2x2", "two columns of two drums"},
                                                          {"colonnade_4x4", "four columns of four drums"},
                                                          {"heap_2x2", "two columns of two drums, fallen"},
                                                          {"heap_4x4", "four columns of four drums, fallen"}};
    for (const auto& [scene, name] : scenes) {
        fmt::print("| {} |", name);
        for (const char* isa : isas)
            fmt::print(" {} |",
                       millions(file.best(fmt::format("BM_Structure/{}/{}", isa, scene), "block_steps_per_second")));
        fmt::print("\n");
    }
}

void ensembles(const ResultsFile& file)
{
    fmt::print("\n");
    fmt::print("{}", markdown_head(
                         "ensemble (small surface, realizations/s) | 1 thread | 2 threads | times | occupancy of lanes",
                         Align::numbers));
    for (const char* isa : isas) {
        const auto at = [&](int threads, const char* counter) {
            double best = 0;
            for (const char* tail : {"", "/real_time"})
                best = std::max(best, file.best(fmt::format("BM_Ensemble/{}/{}{}", isa, threads, tail), counter));
            return best;
        };
        const double one = at(1, "realizations_per_second"), two = at(2, "realizations_per_second");
        fmt::print("| {} | {:.0f} | {:.0f} | {} | {:.2f} |\n", isa, one, two, times(two, one), at(1, "occupancy"));
    }
}

/// The rows of one kind of processor: one for each instruction set that it has.
void rows_of_kind(const ResultsFile& file)
{
    for (const char* isa : isas) {
        const auto best = [&](const char* benchmark, const char* counter) {
            return file.best(fmt::format(fmt::runtime(benchmark), isa), counter);
        };
        const double steps = best("BM_Kernel/{}/7", "block_steps_per_second");
        const double peak = best("BM_PeakFma/{}", "flops_per_second");
        if (steps == 0 || peak == 0)
            continue;
        int threads = 1; // the most that were measured
        for (const Measured& run : file.runs)
            if (const std::string family = fmt::format("BM_Ensemble/{}/", isa); run.name.starts_with(family))
                threads = std::max(threads, std::stoi(run.name.substr(family.size())));
        fmt::print("{}", speed_row({.processor = file.processor,
                                    .threads = threads,
                                    .isa = isa,
                                    .steps = steps,
                                    .of_the_peak = best("BM_Kernel/{}/7", "flops_per_second") / peak,
                                    .times_scalar = steps / file.best("BM_Kernel/scalar/7", "block_steps_per_second"),
                                    .with_all = best("BM_Step/{}/7", "block_steps_per_second"),
                                    .one_thread = best("BM_Ensemble/{}/1", "realizations_per_second"),
                                    .all_threads = file.best(fmt::format("BM_Ensemble/{}/{}", isa, threads),
                                                             "realizations_per_second"),
                                    .main_job_s = best("BM_MainJob/{}/iterations:1/repeats:1", "seconds")}));
    }
}

/// Of every processor the results that were made last.
void kinds(const std::filesystem::path& folder)
{
    std::map<std::string, ResultsFile> last;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json" || entry.path().filename().string().starts_with("peers-"))
            continue;
        const ResultsFile file = read_results(entry.path().string());
        if (file.best("BM_Kernel/scalar/7", "block_steps_per_second") == 0)
            continue; // of something else
        ResultsFile& kept = last[file.processor];
        if (kept.date < file.date)
            kept = file;
    }
    fmt::print("{}", speed_head());
    for (const auto& [name, file] : last)
        rows_of_kind(file);
}

} // namespace

int main(int argc, char** argv)
{
    const bool all = argc == 2, of_kinds = argc == 3 && std::string(argv[1]) == "--kinds";
    if (!all && !of_kinds) {
        fmt::print(stderr, "performance_page: give one results file of scripts/bench.sh, or --kinds FOLDER\n");
        return 2;
    }
    try {
        if (of_kinds) {
            kinds(argv[2]);
            return 0;
        }
        const ResultsFile file = read_results(argv[1]);
        fmt::print("{}; Stylobate {}.\n\n", file.processor, file.commit);
        kernel(file);
        structures(file);
        ensembles(file);
    } catch (const std::exception& error) {
        fmt::print(stderr, "performance_page: {}\n", error.what());
        return 2;
    }
    return 0;
}
