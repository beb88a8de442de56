#pragma once
/// The manual page stylobate(1), made from the texts of `--help`.

#include "studies/usage/command_tree.hpp"

#include <string>

namespace stylobate {

/// One page with all commands, in the language of man(7). Options that four commands or more have in the same form are
/// described once, in a section of their own.
/// @param version stands at its foot
std::string manual_page(const Usage& usage, const std::string& version);

} // namespace stylobate
