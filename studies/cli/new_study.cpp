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

int new_command(const CommonOptions& options, const NewStudyOptions& wanted, std::string output)
{
    TemplateChoice choice;
    choice.study = value_of(study_kind_names, wanted.kind);
    choice.structure = value_of(structure_kind_names, wanted.structure);
    choice.dimensions = wanted.dimensions;
    if (!wanted.excitation.empty())
        choice.excitation = value_of(excitation_kind_names, wanted.excitation);
    const std::string text = study_template(choice);
    if (output.empty())
        output = wanted.kind + ".toml";
    check_output("", output, options.force);
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
