#include "bench/results_file.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
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

Comparison compare(std::vector<double> ratios, double confidence, double matters)
{
    if (ratios.empty() ||
        std::any_of(ratios.begin(), ratios.end(), [](double r) { return !(r > 0) || !std::isfinite(r); }))
        throw std::invalid_argument("pairs: there must be some, with positive, finite ratios");
    std::sort(ratios.begin(), ratios.end());
    const std::size_t n = ratios.size();
    Comparison c;
    c.pairs = static_cast<int>(n);
    c.ratio = n % 2 == 1 ? ratios[n / 2] : std::sqrt(ratios[n / 2 - 1] * ratios[n / 2]);
    c.high = std::numeric_limits<double>::infinity();
    // between the k-th smallest and the k-th largest: 1 - 2 P(fewer than k of n on one side)
    const boost::math::binomial side(static_cast<double>(n), 0.5);
    for (std::size_t k = n / 2; k >= 1; --k) {
        const double covered = 1 - 2 * boost::math::cdf(side, static_cast<double>(k - 1));
        c.confidence = covered;
        if (covered >= confidence) {
            c.low = ratios[k - 1];
            c.high = ratios[n - k];
            break;
        }
    }
    if (c.low <= 0)
        return c;
    const bool differs = c.low > 1 || c.high < 1;
    if (differs && c.ratio > 1 + matters)
        c.verdict = Verdict::faster;
    else if (differs && c.ratio < 1 - matters)
        c.verdict = Verdict::slower;
    else if (differs || (c.low >= 1 - matters && c.high <= 1 + matters))
        c.verdict = Verdict::same;
    return c;
}

const char* to_string(Verdict verdict)
{
    switch (verdict) {
    case Verdict::faster:
        return "faster";
    case Verdict::slower:
        return "slower";
    case Verdict::same:
        return "the same";
    case Verdict::open:
        break;
    }
    return "not decided";
}

} // namespace stylobate
