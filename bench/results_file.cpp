#include "bench/results_file.hpp"

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <stdexcept>

namespace stylobate {

double Measured::rate() const
{
    for (const char* counter : {"block_steps_per_second", "realizations_per_second", "flops_per_second"})
        if (const auto found = counters.find(counter); found != counters.end())
            return found->second;
    return 0;
}

double ResultsFile::best(const std::string& name, const std::string& counter) const
{
    double best = 0;
    for (const Measured& run : runs)
        if (run.name == name)
            if (const auto found = run.counters.find(counter); found != run.counters.end())
                best = std::max(best, found->second);
    return best;
}

ResultsFile read_results(const std::string& path)
{
    namespace pt = boost::property_tree;
    pt::ptree tree;
    try {
        pt::read_json(path, tree);
    } catch (const pt::json_parser_error& error) {
        throw std::runtime_error(path + ", line " + std::to_string(error.line()) + ": " + error.message() +
                                 ". A file that Google Benchmark writes with --benchmark_out is needed.");
    }
    ResultsFile file;
    file.processor = tree.get("context.processor", "");
    file.commit = tree.get("context.stylobate", "");
    file.date = tree.get("context.date", "");
    const auto list = tree.get_child_optional("benchmarks");
    if (!list)
        throw std::runtime_error(path + ": no \"benchmarks\" in it. A file that Google Benchmark writes with "
                                        "--benchmark_out is needed.");
    for (const auto& [key, entry] : *list) {
        if (entry.get("run_type", "iteration") != "iteration" || entry.get("error_occurred", false))
            continue;
        Measured run;
        run.name = entry.get("run_name", entry.get<std::string>("name", ""));
        for (const auto& [name, value] : entry)
            if (const auto number = value.get_value_optional<double>())
                run.counters[name] = *number;
        file.runs.push_back(std::move(run));
    }
    return file;
}

} // namespace stylobate
