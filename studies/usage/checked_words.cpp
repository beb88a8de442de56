#include "studies/usage/checked_words.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace stylobate {

namespace {

/// CLI11 reports an unknown verb only as a missing one.
/// @throws InputError if a word is no verb, or empty
void check_verb(const CLI::App& app, const std::string& word)
{
    std::vector<std::string> verbs;
    std::string list;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        verbs.push_back(verb->get_name());
        list += (list.empty() ? "" : ", ") + verbs.back();
    }
    if (std::find(verbs.begin(), verbs.end(), word) != verbs.end())
        return;
    verbs.emplace_back("help");
    std::string meant = nearest_word(word, verbs);
    for (const std::string& verb : verbs)
        if (meant.empty() && word.size() > 2 && verb.starts_with(word))
            meant = verb;
    throw InputError(fmt::format("{}; the commands are {}.\n  {}",
                                 word.empty() ? "no command is given" : "'" + word + "' is not a command", list,
                                 meant.empty() ? "Run stylobate --help." : "Did you mean " + meant + "?"));
}

/// The numbers that an option takes, by CLI11's name of its type; empty: no number, or CLI11 names its range.
std::string range_of(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    if (type.find(" in [") != std::string::npos)
        return "";
    return type.starts_with("UINT")    ? "whole number in [0, 18446744073709551615]"
           : type.starts_with("INT")   ? "whole number in [-9223372036854775808, 9223372036854775807]"
           : type.starts_with("FLOAT") ? "number"
                                       : "";
}

/// CLI11 takes the nearest number of 64 bits for a whole number beyond them, and -1 for 2^64 - 1.
/// @throws InputError for such a one
void check_range(const std::string& name, const CLI::Option& option, const std::string& value)
{
    const std::string range = range_of(option);
    if (!range.starts_with("whole"))
        return;
    const bool is_unsigned = option.get_type_name().starts_with("U");
    errno = 0;
    if (is_unsigned)
        std::strtoull(value.c_str(), nullptr, 0);
    else
        std::strtoll(value.c_str(), nullptr, 0);
    if (errno == ERANGE || (is_unsigned && value.starts_with('-')))
        throw InputError(fmt::format("{} = {} is not a {}.", name, value, range));
}

} // namespace

std::vector<std::string> checked_words(const CLI::App& app, int argc, char** argv)
{
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (!words.empty() && words.front() == "help") {
        const bool of_verb = words.size() > 1 && words[1] != "help" && !words[1].starts_with('-');
        words = of_verb ? std::vector<std::string>{words[1], "--help"} : std::vector<std::string>{"--help"};
    }
    if (words.empty() || !words.front().starts_with('-'))
        check_verb(app, words.empty() ? "" : words.front());
    return words;
}

void check_options(const CLI::App& app, const std::vector<std::string>& words)
{
    const bool of_verb = !words.empty() && !words.front().starts_with('-');
    const CLI::App& verb = of_verb ? *app.get_subcommand(words.front()) : app;
    for (std::size_t i = of_verb ? 1 : 0; i < words.size() && words[i] != "--"; ++i) {
        const std::string& word = words[i];
        const bool is_long = word.starts_with("--");
        const char first = word.size() > 1 ? word[1] : '0';
        if (!is_long && !(word.starts_with('-') && ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z'))))
            continue;
        const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
        const bool one_dash =
            !is_long && word.size() > 2 && verb.get_option_no_throw("-" + word.substr(0, word.find('='))) != nullptr;
        const CLI::Option* option = one_dash ? nullptr : verb.get_option_no_throw(name);
        if (option != nullptr) {
            const bool attached = is_long ? word.size() > name.size() : word.size() > 2;
            if (option->get_type_size_max() <= 0)
                continue;
            if (attached)
                check_range(name, *option, word.substr(name.size() + (is_long ? 1 : 0)));
            else if (++i < words.size()) // its value, whatever it looks like
                check_range(name, *option, words[i]);
            continue;
        }
        std::vector<std::string> known;
        for (const CLI::Option* each : verb.get_options())
            for (const std::string& long_name : each->get_lnames())
                known.push_back("--" + long_name);
        const std::string meant = one_dash ? "-" + word : is_long ? nearest_word(name, known) : "";
        throw InputError(fmt::format("{} is not an option{}.\n  {}stylobate {}--help lists the options.",
                                     one_dash ? word : name, of_verb ? " of " + words.front() : "",
                                     meant.empty() ? "" : "Did you mean " + meant + "? ",
                                     of_verb ? words.front() + " " : ""));
    }
}

std::string with_range(std::string what, const CLI::App& verb)
{
    const std::string before = "Could not convert: ", between = " = ";
    const std::size_t equals = what.find(between);
    if (!what.starts_with(before) || equals == std::string::npos)
        return what;
    const std::string name = what.substr(before.size(), equals - before.size());
    const CLI::Option* option = verb.get_option_no_throw(name);
    const std::string range = option != nullptr ? range_of(*option) : "";
    return range.empty() ? what : fmt::format("{} is not a {}.", what.substr(before.size()), range);
}

} // namespace stylobate
