#pragma once
/// The command line as plain data, and what is written of it: the manual page, the completion of bash, the end of the
/// help text; and what CLI11 does not report of a command line, or not with what was meant.

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stylobate {

/// An option, or (without names) a word that has its place.
struct UsageOption {
    std::vector<std::string> names;   ///< "-o", "--output"
    std::optional<std::string> value; ///< what stands for its value: "KEY=VALUE"; nullopt: it takes none
    std::vector<std::string> choices; ///< the words that it may be; none: anything
    std::optional<std::string> range; ///< of a number: "1 to 4096"
    std::optional<std::string> usual; ///< the value where it is not given
    std::string text;                 ///< its meaning
    bool required = false;
    bool repeated = false; ///< may be given several times

    bool operator==(const UsageOption&) const = default;
};

struct UsageCommand {
    std::string name, text;
    std::vector<UsageOption> places; ///< in their order
    std::vector<UsageOption> options;
};

/// The program: its commands, and the options without a command. Hidden options are left out.
struct Usage {
    std::string text;
    std::vector<UsageOption> options;
    std::vector<UsageCommand> commands;
};

Usage usage_of(const CLI::App& app);

/// What a user of the command line has to know besides its commands and options: `stylobate --help` ends with it, and
/// the manual page has it as sections.
struct UsageNote {
    std::string name, text;
};

struct UsageSection {
    std::string title; ///< "Exit status"
    std::vector<UsageNote> notes;
};

const std::vector<UsageSection>& usage_notes();

/// The notes as the end of a help text. @param column where the texts begin
std::string notes_text(std::size_t column);

/// The manual page stylobate(1), made from the texts of `--help`: all commands, in the language of man(7). Options that
/// four commands or more have in the same form are described once, in a section of their own.
/// @param version stands at its foot
std::string manual_page(const Usage& usage, const std::string& version);

/// A key that `--set` can give a value.
struct SettableKey {
    std::string path;               ///< "contact.form"
    std::vector<std::string> words; ///< the values, where they are a list of words
};

/// Every key of the study file but tables, and but those in lists of tables, which `--set` gives as a whole.
std::vector<SettableKey> settable_keys();

/// A script for bash: commands, options, words that an option may be, files by their endings, and keys for `--set`.
std::string bash_completion(const Usage& usage, const std::vector<SettableKey>& keys);

/// The words after the program's name, with `help` and `help VERB` as --help of the program and of a verb.
/// @throws InputError if the first word is no verb and no option, and for a long option with one dash
std::vector<std::string> checked_words(const CLI::App& app, int argc, char** argv);

/// Makes all options of all verbs refuse numbers that their types do not have.
void check_numbers(CLI::App& app);

/// Of a command line that CLI11 refused: it reports an unknown option only where nothing else is wrong.
/// @throws InputError if there is one
void refuse_unknown_option(const CLI::App& app);

} // namespace stylobate
