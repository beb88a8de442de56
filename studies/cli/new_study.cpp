/// `stylobate new` and `stylobate schema`: the study file, or the campaign of measured data, for who writes one.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_layout.hpp"
#include "studies/cli/command.hpp"
#include "studies/reference/campaign_template.hpp"
#include "studies/reference/study_reference.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace stylobate {

namespace {

/// @pre the word is one of the list: the command line has checked it
template <class List>
auto value_of(const List& names, const std::string& word)
{
    for (const auto& name : names)
        if (name.word == word)
            return name.value;
    return names[0].value;
}

int new_campaign(const CommonOptions& options, const NewStudyOptions& wanted, const std::filesystem::path& folder)
{
    const CampaignTemplate made = campaign_template(run_kind(wanted.test.value_or("shake")).value());
    check_output_folder("", folder, options.force);
    std::error_code error;
    std::filesystem::create_directories(folder / "runs", error);
    if (error)
        throw InputError(
            folder.string(), 0,
            fmt::format("cannot be made: {}.\n  Name a folder in one that can be written, by -o.", error.message()));
    const std::filesystem::path toml = folder / "campaign.toml", table = folder / "runs" / (made.run + ".csv");
    if (!made.header.empty())
        write_whole(table, made.header + "\n");
    write_whole(toml, made.toml);
    fmt::print("{}\n", toml.string());
    if (!made.header.empty())
        fmt::print("{}\n", table.string());
    if (!options.quiet)
        fmt::print("{}  stylobate info {}    what was read, with warnings\n",
                   made.header.empty() ? "" : "  fill the table with rows, one for each time\n", folder.string());
    return exit_done;
}

} // namespace

int new_command(const CommonOptions& options, const NewStudyOptions& wanted,
                const std::optional<std::string>& wanted_file)
{
    if (wanted.kind == new_campaign_word) {
        if (wanted.structure || wanted.excitation || wanted.dimensions)
            throw InputError("--structure, --dimensions and --excitation are of a study, not of a campaign.\n  Omit "
                             "them; --test is the kind of its run.");
        return new_campaign(options, wanted, wanted_file.value_or(wanted.kind));
    }
    if (wanted.test)
        throw InputError("--test is of a campaign.\n  stylobate new campaign --test KIND writes one.");
    TemplateChoice choice;
    choice.study = value_of(study_kind_names, wanted.kind);
    if (wanted.structure)
        choice.structure = value_of(structure_kind_names, *wanted.structure);
    if (wanted.excitation)
        choice.excitation = value_of(excitation_kind_names, *wanted.excitation);
    choice.dimensions = wanted.dimensions.value_or(choice.dimensions);
    const std::string text = study_template(choice);
    const std::string output = wanted_file.value_or(wanted.kind + ".toml");
    check_output(std::nullopt, output, options.force);
    write_whole(output, text);
    fmt::print("{}\n", output);
    if (!options.quiet)
        fmt::print("  stylobate info {0}    what it would run, with warnings\n"
                   "  stylobate check {0}    its time, memory and file, and where it is weak\n  stylobate run {0}\n",
                   output);
    return exit_done;
}

int schema_command(bool markdown)
{
    fmt::print("{}", markdown ? study_reference() : study_schema());
    return exit_done;
}

} // namespace stylobate
