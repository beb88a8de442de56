#pragma once
/// A case of verification: one thing that the engine computes, and what it should be by something else.
///
/// The page and the tests (`tests/studies/evidence/test_verification.cpp`) run the same cases. The page has every case
/// with its oracle, its numbers and its pictures.

#include "io/plots/figure.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::verification {

enum class Relation { equals, at_least, at_most };

/// One number against one oracle. `equals`: |measured - expected| <= tolerance; the other two: measured may miss
/// expected by no more than tolerance.
struct Check {
    std::string what; ///< with its unit
    double expected = 0;
    double measured = 0;
    double tolerance = 0;
    Relation relation = Relation::equals;
    bool passed() const; ///< false for what is not a number
};

/// A quantity over a parameter that should lead to `exact`.
struct Convergence {
    std::string parameter; ///< with its unit
    std::string quantity;  ///< with its unit
    std::vector<double> at, value;
    double exact = 0;
    double order = 0; ///< fitted exponent of |value - exact| over the parameter
};

/// Fits the order, by least squares of the logarithms.
/// @pre at least two values that differ from `exact`
Convergence convergence(std::string parameter, std::string quantity, std::vector<double> at, std::vector<double> value,
                        double exact);

/// The limit of three values whose errors form a geometric series, as they do where the parameter grows by a constant
/// factor (Aitken); with `values` longer than three, of the last three.
double aitken(const std::vector<double>& values);

/// The limit of values whose errors are a sum of powers of the parameter, which grows by `factor` from one value to the
/// next (Richardson): c1 / parameter^exponents[0] + c2 / parameter^exponents[1] + ...
/// @pre one value more than exponents
double richardson(std::vector<double> values, double factor, const std::vector<double>& exponents);

/// A picture of a case.
struct Picture {
    std::string name; ///< of the file, without folder and extension
    std::string caption;
    std::vector<Figure> figures; ///< side by side
};

/// What a case found.
struct Finding {
    std::vector<Check> checks;
    std::vector<Convergence> convergences;
    std::vector<Picture> pictures;
    std::vector<std::string> remarks; ///< measured facts that no check judges
    bool passed() const;              ///< there are checks, and all passed

    void equals(std::string what, double expected, double measured, double tolerance);
    void at_least(std::string what, double bound, double measured);
    void at_most(std::string what, double bound, double measured);
};

enum class Duration { quick, slow };

struct Case {
    std::string name;      ///< one word
    std::string subject;   ///< heading of the page
    std::string compares;  ///< what with what
    std::string oracle;    ///< where the expected value comes from
    std::string tolerance; ///< why it is what it is
    std::function<Finding()> run;
    Duration duration = Duration::quick; ///< slow: more than some seconds
};

using Cases = std::vector<Case>;

Cases contact_cases();
Cases scheme_cases();
Cases vibration_cases();
Cases static_cases();
Cases rocking_cases();
Cases overturning_cases();
Cases initiation_cases();
Cases sliding_cases();
Cases frame_cases();
Cases sensitivity_cases();

/// All of them, subject by subject.
Cases all_cases();

struct RunCase {
    Case the_case;
    Finding finding;
    std::optional<std::string> error; ///< what was thrown: then it has failed; nullopt: nothing was
    bool passed() const { return !error && finding.passed(); }
};

/// Runs the cases, several at a time; results in their order.
std::vector<RunCase> run_cases(const Cases& cases);

/// Markdown. Failures first, if there are any, then subject by subject.
/// @param images folder of the pictures as seen from the page, with '/' at the end
/// @param made_by line with the version and machine of the computation
std::string page(const std::vector<RunCase>& runs, const std::string& images, const std::string& made_by);

/// Draws the pictures of all cases, those of the convergences included.
/// @throws InputError as `write_picture`
void draw(const std::vector<RunCase>& runs, const std::filesystem::path& folder);

} // namespace stylobate::verification
