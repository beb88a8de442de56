#pragma once
/// The verification page: every case with its oracle, its numbers and its pictures.

#include "studies/evidence/verification/case.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::verification {

struct RunCase {
    Case the_case;
    Finding finding;
    std::string error; ///< what was thrown, if something was: then it has failed
    bool passed() const { return error.empty() && finding.passed(); }
};

/// Runs the cases, several at a time; results in their order.
std::vector<RunCase> run_cases(const Cases& cases);

/// Markdown. Failures first, if there are any, then subject by subject.
/// @param images folder of the pictures as seen from the page, with '/' at the end
/// @param made_by line with the version and machine of the computation
std::string page(const std::vector<RunCase>& runs, const std::string& images, const std::string& made_by);

/// Draws the pictures of all cases, those of the convergences included.
/// @throws InputError as `run_gnuplot`
void draw(const std::vector<RunCase>& runs, const std::filesystem::path& folder);

} // namespace stylobate::verification
