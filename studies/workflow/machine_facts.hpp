#pragma once
/// This machine as its system describes it: processor, cores, memory nodes, load; and what follows for a run.

#include "studies/report/json.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace stylobate {

/// A part of the machine with memory of its own, which its processors reach sooner than others do.
struct NumaNode {
    int number = 0;
    std::vector<int> processors{}; ///< as the system counts them: threads of cores
    std::optional<double> memory_bytes{};
    int usable = 0; ///< those of its processors that this process may use
};

/// What is not known is absent.
struct MachineFacts {
    std::string processor;      ///< "AMD EPYC (Zen 3)"
    int usable = 0;             ///< processors that this process may use
    std::optional<int> cores{}; ///< of these processors
    std::vector<NumaNode> nodes{};
    std::optional<std::string> governor{}; ///< of the clock: "performance", "powersave"
    std::optional<double> load{};          ///< processes that want to run, mean of the last minute

    /// Whether other programs take so much that measured rates are too low: a load above half of the cores.
    bool busy() const { return load && *load > 0.5 * cores.value_or(usable); }
    /// Nodes of which the process may use processors.
    int nodes_used() const;
};

/// The processors that this process may use, as the system counts them; empty: not known.
std::set<int> usable_processors();

/// @param root where /proc and /sys are   @param usable processors that this process may use; empty: all
MachineFacts machine_facts(const std::filesystem::path& root = "/", const std::set<int>& usable = usable_processors());

/// The processor's name, with the microarchitecture where the system's name leaves it out: "AMD EPYC (Zen 3)".
std::string processor(const std::filesystem::path& root = "/");

/// The machine in lines: processor and cores, nodes, clock, load; the advice below if there is one.
std::string machine_text(const MachineFacts& machine);

Json machine_json(const MachineFacts& machine);

/// How to run on a machine with several nodes; nullopt: the process uses one.
std::optional<std::string> numa_advice(const MachineFacts& machine);

} // namespace stylobate
