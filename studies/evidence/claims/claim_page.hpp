#pragma once
/// The page: every claim with its criterion, verdict, numbers and reason, as Markdown; and its figures:
/// curves with intervals.
///
/// The words of a claim file may hold fields in braces that are filled with what was computed:
///   {cases}                   their number
///   {split}                   depends: what holds for which levels
///   {number:WORDS}            the number, with its interval, of the first case that the words pick
///   {finding:WORDS}           what that case came to at a margin of 0
///   {f1:WORDS} {rigid:WORDS}  first natural frequency [Hz] and rigid limit [m/s2] of the first variant
/// WORDS are AXIS=LEVEL and range=NAME with commas between, or nothing: any. Where there is no such case it reads
/// "(no such case)", and of a variant that was not run "(not run)".

#include "studies/evidence/claims/sample.hpp"
#include "studies/evidence/claims/verdict.hpp"

#include <filesystem>

namespace stylobate::claims {

/// One curve: points in order; where a number is unknown or beyond its axis there is none.
struct Curve {
    std::string label;
    struct Point {
        double x = 0;
        Estimate y;
    };
    std::vector<Point> points;
};

/// The curves of a figure: one for each variant and measure, and for each value of the coordinate that is not drawn
/// where the window holds several.
std::vector<Curve> curves_of(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples);

/// @throws InputError as `write_picture`
void draw_figure(const ClaimFile& file, const Figure& figure, const std::vector<Curve>& curves,
                 const std::filesystem::path& png);

/// A test with what it came to.
struct Result {
    const ClaimFile* file = nullptr;
    const Test* test = nullptr;
    const std::vector<Sample>* samples = nullptr;
    std::array<std::vector<Case>, margins.size()> cases; ///< by margin
    Verdict verdict;
};

/// At every margin. The result refers to what it is given.
Result judged(const ClaimFile& file, const Test& test, const std::vector<Sample>& samples);

/// In the order of the paper's claims: P2 before P10, P14a before P14b.
bool comes_before(const std::string& a, const std::string& b);

/// Fills the fields in braces of a text. @throws InputError with the file and the claim for an unknown one
std::string filled(const std::string& text, const Result& result);

/// The whole page. Nothing in it depends on time, machine or number of threads.
///
/// @param results in any order
/// @param images  name of the folder of the pictures as the page names it, "images/claims"
/// @param version of the code that writes the page
/// @throws InputError if a test names a figure that no file has, or has an unknown field
std::string claims_page(std::vector<Result> results, const std::string& images, const std::string& version);

} // namespace stylobate::claims
