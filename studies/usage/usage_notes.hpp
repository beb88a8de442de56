#pragma once
/// What a user of the command line has to know besides its commands and options: `stylobate --help` ends with it, and
/// the manual page has it as sections.

#include <string>
#include <vector>

namespace stylobate {

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

} // namespace stylobate
