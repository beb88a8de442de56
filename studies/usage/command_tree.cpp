#include "studies/usage/command_tree.hpp"

#include <CLI/CLI.hpp>

#include <regex>
#include <sstream>

namespace stylobate {

namespace {

/// What CLI11 has of a type is one text: "TEXT:{png,svg}", "INT:INT in [1 - 4096]", "KEY=VALUE".
void read_type(const std::string& type, UsageOption& option)
{
    static const std::regex list(R"(\{(.*)\})"), interval(R"(in \[(\S+) - (\S+)\])");
    option.value = type.substr(0, type.find(':'));
    std::smatch found;
    if (std::regex_search(type, found, list)) {
        std::istringstream words(found[1]);
        for (std::string word; std::getline(words, word, ',');)
            option.choices.push_back(word);
    } else if (std::regex_search(type, found, interval)) {
        option.range = found[1].str() + " to " + found[2].str();
    }
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
    option.usual = given.get_default_str();
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

} // namespace stylobate
