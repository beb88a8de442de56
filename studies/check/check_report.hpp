#pragma once
/// What `stylobate check` reports.

#include "studies/check/run_cost.hpp"
#include "studies/check/weak_spots.hpp"
#include "studies/experiment/numerics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct CheckReport {
    std::string file; ///< of the study
    const Study& study;
    RunOptions run;
    std::vector<std::string> warnings;
    std::string notice; ///< of the kind; empty: none
    std::string picture{};
    RunSize size{};
    std::optional<Trial> trial{};
    std::optional<RunTime> time{};
    double memory_bytes = 0;
    std::vector<WeakSpot> weak{};
    std::string why_no_pilot{};
    std::optional<NumericsCheck> pilot{};

    /// The error of the numerics is shown to be larger than `run.accuracy`.
    bool missed() const;
};

void print_check(const CheckReport& report, bool json);

} // namespace stylobate
