#include "studies/workflow/past.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"
#include "studies/kinds/survival/survival_kind.hpp"
#include "studies/kinds/survival/survival_text.hpp"
#include "studies/results/results.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <deque>
#include <limits>
#include <system_error>
#include <utility>

namespace stylobate {

namespace {

/// The results of a structure with its counts.
struct ReadStructure {
    Results results;
    std::optional<SurvivalCounts> counts;

    explicit ReadStructure(const std::string& file) : results(file)
    {
        if (!dynamic_cast<const SurvivalKind*>(&results.kind()))
            throw InputError(fmt::format("{} is a result of kind '{}', which has no likelihood of a past.\n  Give "
                                         "results of study.kind = \"survival\".",
                                         file, results.header().kind));
        check_complete(results.reader(), file);
        counts.emplace(results.study(), results.header());
        results.reader().for_each_row([this](const ResultRow& row) { counts->add(row); });
    }
};

/// Each structure by one event, and all together by one event and by more: f(name, events, exclusion).
template <class F>
void for_each_exclusion(const CombinedPast& past, const F& f)
{
    for (std::size_t k = 0; k < past.files.size(); ++k)
        f(past.files[k], std::uint64_t{1}, past.alone[k]);
    for (std::size_t e = 0; e < past.together.by_events.size(); ++e)
        f("together", std::uint64_t{e + 1}, past.together.by_events[e]);
}

void add_estimate(IntervalArray& array, const PastEstimate& estimate)
{
    const auto open = [](double value) { // an end that is not on the axis
        return value < 1e300 ? value : std::numeric_limits<double>::infinity();
    };
    array.add(open(estimate.value), open(estimate.lower), open(estimate.upper));
}

} // namespace

CombinedPast past_of_files(const std::vector<std::string>& files, const std::optional<std::filesystem::path>& picture,
                           bool force)
{
    std::error_code none;
    for (std::size_t k = 0; k < files.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (std::filesystem::equivalent(files[k], files[other], none))
                throw InputError(
                    fmt::format("{} is given twice, and would count as two structures.\n  Give the results "
                                "of each structure once.",
                                files[k]));
    std::deque<ReadStructure> read;
    std::vector<StructurePast> structures;
    for (const std::string& file : files) {
        check_kind(file, "past");
        read.emplace_back(file);
        structures.push_back({file, read.back().results.study(), *read.back().counts});
    }
    CombinedPast past = combined_past(structures);
    if (picture) {
        check_drawing(*picture);
        for (const std::string& file : files)
            check_output(file, *picture, force);
        draw_past(past, *picture);
    }
    return past;
}

void draw_past(const CombinedPast& past, const std::filesystem::path& picture)
{
    check_drawing(picture);
    write_figure(combined_figure(past), "Shaking that several structures exclude",
                 "bands: 95 % intervals of the counts", picture);
}

std::vector<Table> tables_of(const CombinedPast& past)
{
    Table exclusion("exclusion"), likelihood("likelihood");
    std::vector<std::string> structures, likelihood_of;
    std::vector<std::uint64_t> events, likelihood_events;
    std::vector<double> intensity;
    IntervalArray from, weaker, by_profile, by_posterior, values;
    for_each_exclusion(past, [&](const std::string& name, std::uint64_t number, const Exclusion& each) {
        structures.push_back(name);
        events.push_back(number);
        add_estimate(from, each.by_likelihood);
        add_estimate(weaker, each.weaker);
        add_estimate(by_profile, each.by_profile);
        add_estimate(by_posterior, each.by_posterior);
        for (std::size_t i = 0; i < each.likelihood.size(); ++i) {
            likelihood_of.push_back(name);
            likelihood_events.push_back(number);
            intensity.push_back(past.axes.intensity[i]);
            add_estimate(values, each.likelihood[i]);
        }
    });
    const Table::Shape rows{structures.size()}, points{intensity.size()};
    exclusion.set("level", past.level);
    exclusion.set("prior", past.prior);
    exclusion.add("structure", std::move(structures));
    exclusion.add("events", std::move(events), rows);
    exclusion.add("by_likelihood_m_s2", from, rows);
    exclusion.add("by_profile_m_s2", by_profile, rows);
    exclusion.add("by_posterior_m_s2", by_posterior, rows);
    exclusion.add("weaker_m_s2", weaker, rows);
    likelihood.add("structure", std::move(likelihood_of));
    likelihood.add("events", std::move(likelihood_events), points);
    likelihood.add("pga_m_s2", std::move(intensity), points, "m/s2");
    likelihood.add("likelihood", values, points);
    return {std::move(exclusion), std::move(likelihood)};
}

} // namespace stylobate
