/// Runs two builds of the benchmarks in turns and says which one is faster, how sure that is, or that these pairs do
/// not tell. One build right after the other, again and again: what neighbours do to a shared machine hits both alike.

#include "bench/results_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <unistd.h>

using namespace stylobate;

namespace {

/// For the shell, so that no character of it means anything.
std::string quoted(const std::string& text)
{
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// Rates of one run, by benchmark.
std::map<std::string, double> rates(const std::string& program, const std::string& filter, double seconds,
                                    const std::filesystem::path& out)
{
    const std::string command =
        fmt::format("{} --benchmark_filter={} --benchmark_min_time={} --benchmark_out={} --benchmark_out_format=json "
                    ">/dev/null 2>&1",
                    quoted(program), quoted(filter), seconds, quoted(out.string()));
    if (const int status = std::system(command.c_str()); status != 0)
        throw std::runtime_error(fmt::format("{} failed. Try: {}", program, command));
    std::map<std::string, double> rates;
    for (const Measured& run : read_results(out.string()).runs)
        if (run.rate() > 0)
            rates[run.name] = run.rate();
    if (rates.empty())
        throw std::runtime_error(fmt::format("{}: no benchmark with a rate matches '{}'", program, filter));
    return rates;
}

} // namespace

int main(int argc, char** argv)
{
    std::string before, after, filter = "BM_Step/.*/7$|BM_Structure/.*/(column_two_corner|colonnade_4x4)$";
    int pairs = 15;
    double seconds = 0.1, confidence = 0.95, matters = 0.01;
    CLI::App app{"Compares two builds of stylobate_bench pair by pair. Exit status 1: something is slower."};
    app.add_option("BEFORE", before, "stylobate_bench of the build to compare with")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("AFTER", after, "stylobate_bench of the build under test")->required()->check(CLI::ExistingFile);
    app.add_option("--filter", filter, "regular expression of the benchmarks")->capture_default_str();
    app.add_option("--pairs", pairs, "runs of each build")->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_option("--seconds", seconds, "seconds for each benchmark in each run")->check(CLI::Range(0.001, 60.0));
    app.add_option("--confidence", confidence, "level of the interval")
        ->check(CLI::Range(0.5, 0.9999))
        ->capture_default_str();
    app.add_option("--matters", matters, "smallest relevant relative difference")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const std::filesystem::path out =
        std::filesystem::temp_directory_path() / fmt::format("stylobate_speed_guard_{}.json", getpid());
    int status = 0;
    try {
        std::map<std::string, std::vector<double>> ratios;
        for (int pair = 0; pair < pairs; ++pair) {
            const bool turn = pair % 2 == 1; // who comes first alternates
            const auto first = rates(turn ? after : before, filter, seconds, out);
            const auto second = rates(turn ? before : after, filter, seconds, out);
            for (const auto& [name, rate] : turn ? second : first)
                if (const auto other = (turn ? first : second).find(name); other != (turn ? first : second).end())
                    ratios[name].push_back(other->second / rate);
            if (isatty(STDERR_FILENO))
                fmt::print(stderr, "\rpair {} of {}", pair + 1, pairs);
        }
        if (isatty(STDERR_FILENO))
            fmt::print(stderr, "\r                    \r");
        if (ratios.empty())
            throw std::runtime_error("the two builds have no benchmark in common that matches");
        fmt::print("| benchmark | speed relative to before | interval | verdict |\n|---|---:|---|---|\n");
        for (const auto& [name, all] : ratios) {
            const Comparison c = compare(all, confidence, matters);
            fmt::print("| {} | {:.3f} | {} | {} |\n", name, c.ratio,
                       c.low > 0 ? fmt::format("{:.3f} to {:.3f} ({:.1f} %)", c.low, c.high, 100 * c.confidence)
                                 : fmt::format("too few pairs for {:.0f} %", 100 * confidence),
                       to_string(c.verdict));
            if (c.verdict == Verdict::slower)
                status = 1;
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "speed_guard: {}\n", error.what());
        status = 2;
    }
    std::error_code ignored;
    std::filesystem::remove(out, ignored);
    return status;
}
