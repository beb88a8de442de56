/// `stylobate new` and `stylobate schema`: the study file for who writes one.

#include "io/files/atomic_file.hpp"
#include "io/keys/words.hpp"
#include "studies/cli/command.hpp"
#include "studies/reference/study_reference.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

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

} // namespace

int new_command(const CommonOptions& options, const NewStudyOptions& wanted,
                const std::optional<std::string>& wanted_file)
{
    TemplateChoice choice;
    choice.study = value_of(study_kind_names, wanted.kind);
    if (wanted.structure)
        choice.structure = value_of(structure_kind_names, *wanted.structure);
    if (wanted.excitation)
        choice.excitation = value_of(excitation_kind_names, *wanted.excitation);
    choice.dimensions = wanted.dimensions;
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
