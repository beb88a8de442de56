/// `stylobate past`: the shaking of a site, from the state of several structures that have been through it.

#include "ensemble/model/input_error.hpp"
#include "studies/app/command.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/kinds/survival/combined_past.hpp"
#include "studies/kinds/survival/survival_picture.hpp"
#include "studies/results/results.hpp"

#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <optional>
#include <system_error>

namespace stylobate {

namespace {

/// The results of a structure with its counts.
struct Structure {
    Results results;
    std::optional<SurvivalCounts> counts;

    explicit Structure(const std::string& file) : results(file)
    {
        if (!results.study().survival || results.header().kind == "replay")
            throw InputError(fmt::format("{} is a result of kind '{}', which has no likelihood of a past.\n  Give "
                                         "results of study.kind = \"survival\".",
                                         file, results.header().kind));
        check_complete(results.reader(), file);
        counts.emplace(results.study(), results.header());
        results.reader().for_each_row([this](const ResultRow& row) { counts->add(row); });
    }
};

} // namespace

int past_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& picture)
{
    std::error_code none;
    for (std::size_t k = 0; k < files.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (std::filesystem::equivalent(files[k], files[other], none))
                throw InputError(
                    fmt::format("{} is given twice, and would count as two structures.\n  Give the results "
                                "of each structure once.",
                                files[k]));
    std::deque<Structure> read;
    std::vector<StructurePast> structures;
    for (const std::string& file : files) {
        check_kind(file, "past");
        read.emplace_back(file);
        structures.push_back({file, read.back().results.study(), *read.back().counts});
    }
    const CombinedPast combined = combined_past(structures);
    if (!picture.empty()) {
        check_drawing(picture);
        for (const std::string& file : files)
            check_output(file, picture, options.force);
        plot_curves(combined_figure(combined), "Shaking that several structures exclude", picture);
    }
    if (options.json)
        fmt::print(
            "{}\n",
            (picture.empty() ? combined_json(combined) : combined_json(combined).member("written", picture)).text());
    else
        fmt::print("{}{}", combined_text(combined), picture.empty() ? "" : picture + "\n");
    return exit_done;
}

} // namespace stylobate
