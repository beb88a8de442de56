#pragma once
/// Where a verb writes.

#include <filesystem>
#include <string>

namespace stylobate {

/// "folder/name.h5" -> "folder/name" + `ending`.
std::filesystem::path beside(const std::string& input, const std::string& ending);

/// Results are never lost, not even to a slip in the name of the output.
/// @throws InputError if the output is the input
void check_output(const std::string& input, const std::string& output);

} // namespace stylobate
