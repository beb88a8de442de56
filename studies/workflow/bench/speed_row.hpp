#pragma once
/// The table of speeds in README.md and docs/performance.md: one row for each machine and instruction set, from results
/// of Google Benchmark (`bench/performance_page.cpp`) or from `stylobate bench`.

#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <string>

namespace stylobate {

/// 0: not measured.
struct SpeedRow {
    std::string processor;
    int threads = 0; ///< in the columns of all threads
    std::string isa;
    double steps = 0;        ///< of the specimen, one thread [block-steps/s]
    double of_the_peak = 0;  ///< share of the multiply-add peak
    double times_scalar = 0; ///< rate of the steps over that of the scalar ones
    double with_all = 0;     ///< with base motion and termination checks [block-steps/s]
    double one_thread = 0;   ///< of the small surface [realizations/s]
    double all_threads = 0;
    double main_job_s = 0; ///< 65,536 realizations, all threads
};

inline std::string speed_head()
{
    return markdown_head(
        "processor | threads | instruction set | steps, million block-steps/s | of the peak | times the "
        "scalar rate | with all | small surface, realizations/s, 1 thread | all threads | main job, "
        "all threads [s]",
        Align::numbers);
}

inline std::string speed_row(const SpeedRow& row)
{
    const auto number = [](double value, const char* format, double unit = 1) {
        return value > 0 ? fmt::format(fmt::runtime(format), value / unit) : "";
    };
    return markdown_row("{} | {} | {} | {} | {} | {} | {} | {} | {} | {}", row.processor, row.threads, row.isa,
                        number(row.steps, "{:.0f}", 1e6), number(row.of_the_peak, "{:.0f} %", 0.01),
                        number(row.times_scalar, "{:.1f}"), number(row.with_all, "{:.0f}", 1e6),
                        number(row.one_thread, "{:.0f}"), number(row.all_threads, "{:.0f}"),
                        number(row.main_job_s, "{:.0f}"));
}

} // namespace stylobate
