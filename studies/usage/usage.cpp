#include "studies/usage/usage.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>

namespace stylobate {

namespace {

/// What CLI11 has of a type is one text: "TEXT:{png,svg}", "INT:INT in [1 - 4096]", "KEY=VALUE".
void read_type(const std::string& type, UsageOption& option)
{
    option.value = type.substr(0, type.find(':'));
    const auto between = [&](const std::string& begin, const char* end) -> std::optional<std::string> {
        const std::size_t from = type.find(begin);
        if (from == std::string::npos)
            return std::nullopt;
        return type.substr(from + begin.size(), type.find(end, from) - from - begin.size());
    };
    std::istringstream words(between("{", "}").value_or(""));
    for (std::string word; std::getline(words, word, ',');)
        option.choices.push_back(word);
    option.range = between(" in [", "]");
    if (!option.range)
        return;
    if (const std::size_t dash = option.range->find(" - "); dash != std::string::npos)
        option.range->replace(dash, 3, " to ");
}

UsageOption option_of(const CLI::Option& given)
{
    UsageOption option;
    for (const std::string& name : given.get_snames())
        option.names.push_back("-" + name);
    for (const std::string& name : given.get_lnames())
        option.names.push_back("--" + name);
    if (given.get_type_size() != 0)
        read_type(given.get_type_name(), option);
    if (!given.nonpositional())
        option.value = given.get_name();
    if (const std::string usual = given.get_default_str(); !usual.empty()) // as CLI11 has it
        option.usual = usual;
    option.text = given.get_description();
    option.required = given.get_required();
    option.repeated = given.get_items_expected_max() > 1;
    return option;
}

void read_options(const CLI::App& app, std::vector<UsageOption>& places, std::vector<UsageOption>& options)
{
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty())
            (option->nonpositional() ? options : places).push_back(option_of(*option));
}

} // namespace

Usage usage_of(const CLI::App& app)
{
    Usage usage;
    usage.text = app.get_description();
    std::vector<UsageOption> no_places;
    read_options(app, no_places, usage.options);
    for (const CLI::App* given : app.get_subcommands([](const CLI::App*) { return true; })) {
        UsageCommand command{given->get_name(), given->get_description(), {}, {}};
        read_options(*given, command.places, command.options);
        usage.commands.push_back(std::move(command));
    }
    return usage;
}

const std::vector<UsageSection>& usage_notes()
{
    static const std::vector<UsageSection> sections{
        {"Exit status",
         {{"0", "done"},
          {"1", "a failure that is none of the following, such as a full disk; of verify-file: a difference was found"},
          {"2", "bad input: one message on standard error, nothing written or changed"},
          {"3",
           "done, but more realizations are invalid than run.max_invalid_fraction allows; of check: run.accuracy is "
           "missed"},
          {"130", "interrupted by Ctrl-C; the same command continues a run, a comparison or a calibration"}}},
        {"Environment",
         {{"STYLOBATE_LIBRSVG", "path of the librsvg that draws png and pdf (default: librsvg-2.so.2 of the system)"},
          {"STYLOBATE_FFMPEG", "path of the ffmpeg that writes gif, mp4 and webm (default: the first in PATH)"},
          {"TMPDIR", "folder for temporary files (default: /tmp)"}}},
        {"Files",
         {{"NAME.toml", "a study; stylobate new writes one to begin with, stylobate schema --markdown lists every key"},
          {"NAME.h5", "results of run, replay, calibrate or diagnose, or a measured campaign"},
          {"/usr/share/stylobate/inputs", "studies that are ready to run, where the package for Debian has them"},
          {"/usr/share/doc/stylobate", "the pages of the documentation, in the package stylobate-doc"}}},
        {"Examples",
         {{"stylobate new surface", "write surface.toml, a study with comments that runs as it stands"},
          {"stylobate check surface.toml", "what a run will take, and where the study is weak"},
          {"stylobate run surface.toml", "run it; the results are in surface.h5"},
          {"stylobate run surface.toml -o quick.h5 --set study.realizations=8",
           "the same with another value of a key and another name of the results"},
          {"stylobate report surface.h5", "write surface.html, a page for a browser"},
          {"stylobate export surface.h5 --to png", "draw the probability of collapse over frequency and PGA"},
          {"stylobate replay surface.h5 --frequency 3 --pga 9.8 --fallen -o fall.h5",
           "run a realization of that cell again that collapsed, and keep its trajectory"},
          {"stylobate verify-file surface.h5",
           "verify the file against itself, its study, and 20 realizations that are run again"}}},
    };
    return sections;
}

std::string notes_text(std::size_t column)
{
    std::string text;
    for (const UsageSection& section : usage_notes()) {
        text += (text.empty() ? "" : "\n") + section.title + ":\n";
        for (const UsageNote& note : section.notes)
            text += note.name.size() + 3 > column ? fmt::format("  {}\n{:{}}{}\n", note.name, "", column, note.text)
                                                  : fmt::format("  {:{}}{}\n", note.name, column - 2, note.text);
    }
    text.pop_back(); // CLI11 ends it
    return text;
}

} // namespace stylobate
