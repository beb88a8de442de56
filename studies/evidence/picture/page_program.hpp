#pragma once
/// What the programs that write pages of docs/ have in common.

#include "ensemble/model/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace stylobate {

/// Reads the command line and runs the program.
/// @returns the status of `run`; 2 for bad input, 1 for any other failure, each with a message on standard error
template <class Run>
int page_program(CLI::App& app, int argc, char** argv, const char* name, const Run& run)
{
    try {
        app.parse(argc, argv);
        return run();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const InputError& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
        return 1;
    }
}

/// The cases with these names, in the order of the names; all where none is given.
/// @param unknown the message for an unknown name, for `fmt::format`   @throws InputError for one
template <class Case>
std::vector<Case> chosen(const std::vector<Case>& all, const std::vector<std::string>& names, const char* unknown)
{
    std::vector<Case> some;
    for (const std::string& name : names) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
        if (found == all.end()) {
            std::string known;
            for (const Case& one : all)
                known += (known.empty() ? "" : ", ") + one.name;
            throw InputError(fmt::format(fmt::runtime(unknown), name) + ".\n  Known: " + known + ".");
        }
        some.push_back(*found);
    }
    return names.empty() ? all : some;
}

} // namespace stylobate
