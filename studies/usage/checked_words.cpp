#include "studies/usage/usage.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace stylobate {

namespace {

/// CLI11 reports an unknown verb only as a missing one.
/// @throws InputError if a word is no verb, or empty
const CLI::App& verb_of(const CLI::App& app, const std::string& word)
{
    std::vector<std::string> verbs;
    std::string list;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (verb->get_name() == word)
            return *verb;
        verbs.push_back(verb->get_name());
        list += (list.empty() ? "" : ", ") + verbs.back();
    }
    verbs.emplace_back("help");
    auto meant = nearest_word(word, verbs);
    for (const std::string& verb : verbs)
        if (!meant && word.size() > 2 && verb.starts_with(word))
            meant = verb;
    throw InputError(fmt::format("{}; the commands are {}.\n  {}",
                                 word.empty() ? "no command is given" : "'" + word + "' is not a command", list,
                                 meant ? "Did you mean " + *meant + "?" : "Run stylobate --help."));
}

[[noreturn]] void refuse_option(const CLI::App& app, const CLI::App& verb, const std::string& name)
{
    std::vector<std::string> known;
    for (const CLI::Option* option : verb.get_options())
        for (const std::string& long_name : option->get_lnames())
            known.push_back("--" + long_name);
    const auto meant =
        name.size() == 2 ? std::nullopt : nearest_word(name.starts_with("--") ? name : "-" + name, known);
    const std::optional<std::string> of = &verb == &app ? std::nullopt : std::optional(verb.get_name());
    throw InputError(fmt::format("{} is not an option{}.\n  {}stylobate {}--help lists the options.", name,
                                 of ? " of " + *of : "", meant ? "Did you mean " + *meant + "? " : "",
                                 of ? *of + " " : ""));
}

/// Of the values of an option: empty, or why one is no such number. CLI11 takes the nearest number of 64 bits for a
/// whole number beyond them, and 2^64 - 1 for -1.
std::string number_fault(const std::string& value, char type)
{
    char* end = nullptr;
    errno = 0;
    if (type == 'U')
        std::strtoull(value.c_str(), &end, 0);
    else if (type == 'I')
        std::strtoll(value.c_str(), &end, 0);
    else
        std::strtod(value.c_str(), &end);
    if (!value.empty() && *end == '\0' && errno == 0 && !(type == 'U' && value.starts_with('-')))
        return {};
    return fmt::format("{} is not a {}", value,
                       type == 'U'   ? "whole number in [0, 18446744073709551615]"
                       : type == 'I' ? "whole number in [-9223372036854775808, 9223372036854775807]"
                                     : "number");
}

} // namespace

std::vector<std::string> checked_words(const CLI::App& app, int argc, char** argv)
{
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (!words.empty() && words.front() == "help") {
        const bool of_verb = words.size() > 1 && words[1] != "help" && !words[1].starts_with('-');
        words = of_verb ? std::vector<std::string>{words[1], "--help"} : std::vector<std::string>{"--help"};
    }
    const CLI::App* verb = &app;
    if (words.empty() || !words.front().starts_with('-'))
        verb = &verb_of(app, words.empty() ? "" : words.front());
    for (const std::string& word : words) // CLI11 reads -output as -o utput
        if (const std::string name = word.substr(0, word.find('='));
            name.size() > 2 && name[0] == '-' && name[1] != '-' && verb->get_option_no_throw("-" + name) != nullptr)
            refuse_option(app, *verb, name);
    return words;
}

void check_numbers(CLI::App& app)
{
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; }))
        for (CLI::Option* option : verb->get_options()) {
            const std::string type = option->get_type_name(); // as CLI11 names it
            if (type.starts_with("UINT") || type.starts_with("INT") || type.starts_with("FLOAT"))
                option->check([first = type[0]](const std::string& value) { return number_fault(value, first); });
        }
}

void refuse_unknown_option(const CLI::App& app)
{
    const auto verbs = app.get_subcommands();
    const CLI::App& verb = verbs.empty() ? app : *verbs.front();
    for (const std::string& word : verb.remaining())
        if (word.starts_with('-') && word != "--")
            refuse_option(app, verb, word.substr(0, word.find('=')));
}

} // namespace stylobate
