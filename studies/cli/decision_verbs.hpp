#pragma once
/// The verbs that answer an engineer's questions, with their options: compare, risk, past.

#include "studies/cli/command.hpp"

#include <string>
#include <vector>

namespace stylobate {

class DecisionVerbs {
public:
    /// @param app, options, status of the command line; must outlive it
    DecisionVerbs(CLI::App& app, CommonOptions& options, int& status) : app_(app), options_(options), status_(status) {}

    void add_compare();
    void add_past();
    void add_risk();

private:
    CLI::App& app_;
    CommonOptions& options_;
    int& status_;
    ComparisonRequest compare_;
    RiskRequest risk_;
    bool search_ = false;
    std::string output_;
    std::vector<std::string> files_;
};

} // namespace stylobate
