#pragma once
/// Other programs that a film or a check needs: found at run time, run without a shell.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The first executable of that name in PATH.
std::optional<std::filesystem::path> find_program(const char* name);

/// The program that an environment variable names, or else the one in PATH.
/// @param lacking what cannot be done without it: "no picture can be drawn"   @param package of Debian that has it
/// @throws InputError if there is none, with what to install
std::filesystem::path find_tool(const char* name, const char* variable, const std::string& lacking,
                                const std::string& package);

/// All bytes of a file; none if it cannot be read.
std::string content_of(const std::filesystem::path& file);

/// Runs a program in `folder`, its output and its errors in `log`. The status is the program's exit status, or 128 +
/// the signal that ended it.
/// @param input piece after piece of its standard input, until an empty one; what a program does not read is lost.
///        Without it the standard input is empty
/// @throws InputError if it cannot be started
int run_program(const std::filesystem::path& program, std::vector<std::string> arguments,
                const std::filesystem::path& folder, const std::filesystem::path& log,
                const std::function<std::string()>& input = nullptr);

} // namespace stylobate
