#include "studies/usage/command_tree.hpp"

#include <CLI/CLI.hpp>

#include <sstream>

namespace stylobate {

namespace {

/// What CLI11 has of a type is one text: "TEXT:{png,svg}", "INT:INT in [1 - 4096]", "KEY=VALUE".
void read_type(const std::string& type, UsageOption& option)
{
    option.value = type.substr(0, type.find(':'));
    const auto between = [&](const char* begin, const char* end) {
        const std::size_t from = type.find(begin);
        return from == std::string::npos ? ""
                                         : type.substr(from + std::string(begin).size(),
                                                       type.find(end, from) - from - std::string(begin).size());
    };
    std::istringstream words(between("{", "}"));
    for (std::string word; std::getline(words, word, ',');)
        option.choices.push_back(word);
    option.range = between(" in [", "]");
    if (const std::size_t dash = option.range.find(" - "); dash != std::string::npos)
        option.range.replace(dash, 3, " to ");
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
