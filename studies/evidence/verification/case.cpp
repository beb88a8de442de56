#include "studies/evidence/verification/case.hpp"

#include "ensemble/numerics/in_parallel.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/picture/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate::verification {

namespace {

/// |value - exact| over the parameter, both logarithmic, with the fitted slopes.
/// @pre the same parameter, and two to each
Figure error_curves(const std::vector<Convergence>& convergences)
{
    std::vector<Series> lines, marks;
    for (const Convergence& c : convergences) {
        Series measured{fmt::format("{} (slope {:.2f})", c.quantity, c.order), {}, {}, false, {}, {}};
        Series fitted{std::nullopt, c.at, {}, true, {}, {}};
        double level = 0;
        for (std::size_t i = 0; i < c.at.size(); ++i) {
            const double error = std::fabs(c.value[i] - c.exact);
            if (error == 0)
                continue;
            measured.x.push_back(c.at[i]);
            measured.y.push_back(error);
            level += std::log(error) - c.order * std::log(c.at[i]);
        }
        for (double at : c.at)
            fitted.y.push_back(std::exp(level / static_cast<double>(measured.x.size()) + c.order * std::log(at)));
        marks.push_back(measured);
        lines.push_back(fitted);
    }
    std::vector<Series> all = marks; // the same colours in both
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k].colour = static_cast<int>(k);
        all.push_back(lines[k]);
    }
    return curves({convergences.front().parameter, true, 0, 0}, {"error", true, 0, 0}, all);
}

/// As many digits as a number and its tolerance deserve.
std::string number(double value, double tolerance)
{
    if (!std::isfinite(value))
        return fmt::format("{}", value);
    const double size = std::fabs(value);
    if (tolerance <= 0 || size == 0)
        return fmt::format("{:.6g}", value);
    const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(size / tolerance))) + 2, 3, 10);
    return fmt::format("{:.{}g}", value, digits);
}

std::string convergence_picture(const Case& c)
{
    return c.name + "_convergence";
}

/// Vertical bars would end a cell of a table.
std::string cell(std::string text)
{
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
    return text;
}

std::string table(const std::vector<Check>& checks)
{
    std::string text = markdown_head("quantity | expected | measured | difference | tolerance |");
    for (const Check& c : checks) {
        const char* relation = c.relation == Relation::at_least  ? "at least "
                               : c.relation == Relation::at_most ? "at most "
                                                                 : "";
        text += markdown_row("{} | {}{} | {} | {:+.2g} | {} | {}", cell(c.what), relation,
                             number(c.expected, c.tolerance), number(c.measured, c.tolerance), c.measured - c.expected,
                             c.relation == Relation::equals ? fmt::format("{:.2g}", c.tolerance) : "",
                             c.passed() ? "passed" : "**failed**");
    }
    return text;
}

/// Aitken's limit of the last three, where the parameter grows by one factor; else not a number.
double limit(const Convergence& c)
{
    const std::size_t n = c.at.size();
    if (n < 3 || std::fabs(c.at[n - 1] / c.at[n - 2] - c.at[n - 2] / c.at[n - 3]) > 1e-6 * c.at[n - 1] / c.at[n - 2])
        return std::numeric_limits<double>::quiet_NaN();
    return aitken(c.value);
}

std::string table(const Convergence& c)
{
    std::string text = fmt::format("\n| {} |", cell(c.parameter));
    std::string rule = "|---|", row = fmt::format("| {} |", cell(c.quantity)), error = "| error |";
    const auto column = [&](const std::string& head, double value) {
        const double e = value - c.exact;
        text += fmt::format(" {} |", head);
        rule += "---|";
        row += fmt::format(" {} |", number(value, std::fabs(e)));
        error += fmt::format(" {:+.2g} |", e);
    };
    for (std::size_t i = 0; i < c.at.size(); ++i)
        column(fmt::format("{:.3g}", c.at[i]), c.value[i]);
    if (const double all = limit(c); std::isfinite(all))
        column("limit of the last three", all);
    return text + fmt::format(" exact |\n{}---|\n{} {:.8g} |\n{} order {:.2f} |\n", rule, row, c.exact, error, c.order);
}

std::string section(const RunCase& run, const std::string& images)
{
    const Case& c = run.the_case;
    std::string text = fmt::format("### {}: {}\n\n{}\n\n*Oracle:* {} *Tolerance:* {}\n\n", c.name,
                                   run.passed() ? "passed" : "failed", c.compares, c.oracle, c.tolerance);
    if (run.error)
        return text + fmt::format("The case could not be computed: {}\n\n", *run.error);
    text += table(run.finding.checks);
    for (const Convergence& shown : run.finding.convergences)
        text += table(shown);
    if (!run.finding.convergences.empty())
        text += fmt::format("\n![{}: error over {}]({}{}.png)\n", c.name, run.finding.convergences.front().parameter,
                            images, convergence_picture(c));
    for (const std::string& remark : run.finding.remarks)
        text += fmt::format("\n{}\n", remark);
    for (const Picture& p : run.finding.pictures)
        text += fmt::format("\n![{0}]({1}{2}.png)\n\n*{0}*\n", p.caption, images, p.name);
    return text + '\n';
}

} // namespace

bool Check::passed() const
{
    switch (relation) {
    case Relation::at_least:
        return measured >= expected - tolerance;
    case Relation::at_most:
        return measured <= expected + tolerance;
    default:
        return std::fabs(measured - expected) <= tolerance;
    }
}

Convergence convergence(std::string parameter, std::string quantity, std::vector<double> at, std::vector<double> value,
                        double exact)
{
    assert(at.size() == value.size() && "one value for each parameter");
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (value[i] == exact)
            continue;
        const double u = std::log(at[i]), v = std::log(std::fabs(value[i] - exact));
        n += 1;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const double order = (n * xy - x * y) / (n * xx - x * x);
    return {std::move(parameter), std::move(quantity), std::move(at), std::move(value), exact, order};
}

double aitken(const std::vector<double>& values)
{
    assert(values.size() >= 3 && "Aitken's limit takes three values");
    const std::size_t n = values.size();
    const double d1 = values[n - 2] - values[n - 3], d2 = values[n - 1] - values[n - 2];
    return values[n - 1] + d2 * d2 / (d1 - d2);
}

double richardson(std::vector<double> values, double factor, const std::vector<double>& exponents)
{
    assert(values.size() == exponents.size() + 1 && "each value takes one power away");
    for (const double exponent : exponents) {
        const double ratio = std::pow(factor, exponent);
        for (std::size_t i = 0; i + 1 < values.size(); ++i)
            values[i] = (ratio * values[i + 1] - values[i]) / (ratio - 1);
        values.pop_back();
    }
    return values.front();
}

bool Finding::passed() const
{
    bool all = !checks.empty();
    for (const Check& check : checks)
        all = all && check.passed();
    return all;
}

void Finding::equals(std::string what, double expected, double measured, double tolerance)
{
    checks.push_back({std::move(what), expected, measured, tolerance, Relation::equals});
}

void Finding::at_least(std::string what, double bound, double measured)
{
    checks.push_back({std::move(what), bound, measured, 0, Relation::at_least});
}

void Finding::at_most(std::string what, double bound, double measured)
{
    checks.push_back({std::move(what), bound, measured, 0, Relation::at_most});
}

Cases all_cases()
{
    Cases all;
    for (Cases (*some)() : {contact_cases, scheme_cases, vibration_cases, static_cases, rocking_cases,
                            overturning_cases, initiation_cases, sliding_cases, frame_cases, sensitivity_cases})
        for (Case& one : some())
            all.push_back(std::move(one));
    return all;
}

std::vector<RunCase> run_cases(const Cases& cases)
{
    std::vector<RunCase> runs(cases.size());
    in_parallel(std::size_t(0), cases.size(), [&](std::size_t i) {
        runs[i].the_case = cases[i];
        try {
            runs[i].finding = cases[i].run();
        } catch (const std::exception& e) {
            runs[i].error = e.what();
        }
    });
    return runs;
}

std::string page(const std::vector<RunCase>& runs, const std::string& images, const std::string& made_by)
{
    struct Count {
        std::string subject;
        std::size_t cases = 0, checks = 0, passed = 0;
    };
    std::vector<Count> counts;
    std::size_t failed_cases = 0, checks = 0, passed = 0;
    for (const RunCase& run : runs) {
        if (counts.empty() || counts.back().subject != run.the_case.subject)
            counts.push_back({run.the_case.subject});
        Count& count = counts.back();
        ++count.cases;
        count.checks += run.finding.checks.size();
        for (const Check& c : run.finding.checks)
            count.passed += c.passed();
        failed_cases += !run.passed();
    }
    for (const Count& count : counts) {
        checks += count.checks;
        passed += count.passed;
    }
    std::string text = fmt::format(
        "# Verification\n\nThis page is generated by `scripts/verification.sh`. {}\n\n"
        "{} of {} comparisons in {} cases agree with their oracle. An expected value is a closed form, an eigenvalue, "
        "or the result of an independent algorithm in `studies/evidence/verification`. *The second solver* "
        "(`reference_solver.hpp`) steps the same equations in another, slower form, in extended precision. A "
        "*reference value* is recomputed by `reference_values.py`, a script of the standard library of Python alone, "
        "whose head states equations, methods and errors; a test compares its digits with those used here. "
        "Comparisons of the program with itself at another time step are marked as such. The comparisons answer two "
        "questions. The "
        "first is whether the program solves *its* equations; these results agree to many digits. The second is how "
        "much these equations differ from those of rigid blocks; these results converge slowly as the contact "
        "stiffness K_N grows. The tables give the order of convergence, and the limit extrapolated from the last three "
        "values under "
        "the assumption that their errors form a geometric series.\n\n"
        "SPEC is a column of six free drums of 48 x 29 mm and 0.1355 kg on a fixed drum. MONO is the same column as a "
        "single block of 48 x 174 mm. COLO is two columns of 60 x 100 mm (0.75 kg) that carry a block of 150 x 60 mm "
        "(1.14 kg). "
        "alpha = atan(width / height), p = sqrt(3 g / (4 R)), eta = a / (g tan alpha), xi the damping ratio of the "
        "dashpots.\n\n",
        made_by, passed, checks, runs.size());
    text += markdown_head("subject | cases | comparisons | passed");
    for (const Count& count : counts)
        text += markdown_row("{} | {} | {} | {}", count.subject, count.cases, count.checks, count.passed);
    text += '\n';
    if (failed_cases > 0) {
        text += "## Failed\n\n";
        for (const RunCase& run : runs)
            if (!run.passed())
                text += section(run, images);
    }
    std::string subject;
    for (const RunCase& run : runs) {
        if (!run.passed())
            continue;
        if (run.the_case.subject != subject)
            text += fmt::format("## {}\n\n", run.the_case.subject);
        subject = run.the_case.subject;
        text += section(run, images);
    }
    return text;
}

void draw(const std::vector<RunCase>& runs, const std::filesystem::path& folder)
{
    for (const RunCase& run : runs) {
        if (!run.finding.convergences.empty())
            write_small({error_curves(run.finding.convergences)},
                        folder / (convergence_picture(run.the_case) + ".png"));
        for (const Picture& p : run.finding.pictures)
            write_small(p.figures, folder / (p.name + ".png"));
    }
}

} // namespace stylobate::verification
