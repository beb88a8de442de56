#pragma once
/// The words of the command line, checked before CLI11 reads them: its messages name neither what was meant nor ranges.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace stylobate {

/// The words after the program's name, with `help` and `help VERB` as --help of the program and of a verb.
/// @throws InputError if the first word is no verb and no option
std::vector<std::string> checked_words(const CLI::App& app, int argc, char** argv);

/// CLI11 reports an unknown option only where nothing else is missing, and takes whole numbers beyond 64 bits.
/// @throws InputError at the first word that has the form of an option and is none of the app's or of the verb's, and
/// at the first such number
void check_options(const CLI::App& app, const std::vector<std::string>& words);

/// CLI11's "Could not convert: --nth = 1e30" with what the option takes.
std::string with_range(std::string what, const CLI::App& verb);

} // namespace stylobate
