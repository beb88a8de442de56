#pragma once
/// What `stylobate info FILE` prints: what a file is, what it holds, and what can be done with it.

#include "studies/app/command.hpp"

#include <string>

namespace stylobate {

/// Prints it; as JSON where that is asked for.
/// @throws InputError if there is no such file, if it is damaged, or if its content is wrong
void print_file(const CommonOptions& options, const std::string& file);

} // namespace stylobate
