#pragma once
/// What CLI11 does not report of a command line, or not with what was meant.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace stylobate {

/// The words after the program's name, with `help` and `help VERB` as --help of the program and of a verb.
/// @throws InputError if the first word is no verb and no option, and for a long option with one dash
std::vector<std::string> checked_words(const CLI::App& app, int argc, char** argv);

/// Makes all options of all verbs refuse numbers that their types do not have.
void check_numbers(CLI::App& app);

/// Of a command line that CLI11 refused: it reports an unknown option only where nothing else is wrong.
/// @throws InputError if there is one
void refuse_unknown_option(const CLI::App& app);

} // namespace stylobate
