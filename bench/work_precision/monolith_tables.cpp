/// The monolith against the rigid block.

#include "bench/work_precision/page.hpp"

#include "io/tables/table.hpp"
#include "studies/evidence/verification/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace stylobate::work {

namespace {

struct Form {
    ContactForm form;
    DampingAt damping;
    std::string text() const
    {
        return form == ContactForm::area ? fmt::format("area, {}", name(damping)) : std::string(name(form));
    }
};
const std::vector<Form> forms{{ContactForm::area, DampingAt::centroid},
                              {ContactForm::area, DampingAt::ends},
                              {ContactForm::two_corner, DampingAt::centroid},
                              {ContactForm::points, DampingAt::centroid}};

constexpr double soft_shear = 0.2;

/// In per cent, with its sign; "-" where there is none.
std::string percent(double error, int digits = 3)
{
    return std::isfinite(error) ? fmt::format("{:+.{}f}", 100 * error, digits) : "-";
}

struct Errors {
    double cost = 0, quarter = 0, overturning = 0;
};

Errors errors(const Setting& setting)
{
    return {monolith_cost(setting), quarter_period_s(setting) / exact_quarter_period_s() - 1,
            overturning_eta(setting) / exact_overturning_eta() - 1};
}

void stiffness_and_step(Report& report)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out, "### Stiffness, step, contact form\n\nErrors in per cent relative to the rigid block. *Step*: "
                        "the change due to the time step alone, relative to an eighth of the bound.\n\n");
    fmt::format_to(out, "{}",
                   markdown_head("form, dashpot | K_N [N/m2] | fraction of the bound | block-steps per s | quarter "
                                 "period | step | overturning | step"));
    for (const Form& form : forms)
        for (const double K : {1e6, 1e8, 1e10}) {
            Setting setting;
            setting.form = form.form;
            setting.damping = form.damping;
            setting.K_n = K;
            setting.step_fraction = 0.125;
            const Errors limit = errors(setting);
            for (const double fraction : {1.0, 0.5, 0.25}) {
                setting.step_fraction = fraction;
                const Errors e = errors(setting);
                fmt::format_to(out, "| {} | {:.0e} | {} | {:.0f} | {} | {} | {} | {} |\n", form.text(), K, fraction,
                               e.cost, percent(e.quarter), percent(e.quarter - limit.quarter, 4),
                               percent(e.overturning), percent(e.overturning - limit.overturning, 4));
            }
        }
}

/// Stiffnesses 1e6 N/m2 x 2^i with the step of a study.
constexpr int stiffnesses = 22;
double stiffness(std::size_t i)
{
    return 1e6 * std::pow(2.0, static_cast<double>(i));
}

std::vector<Errors> over_stiffness(const Form& form, double shear)
{
    std::vector<Errors> all;
    for (std::size_t i = 0; i < stiffnesses; ++i) {
        Setting setting;
        setting.form = form.form;
        setting.damping = form.damping;
        setting.shear = shear;
        setting.K_n = stiffness(i);
        all.push_back(errors(setting));
    }
    return all;
}

/// A way from the answers at some stiffnesses to that of rigid blocks.
struct Way {
    const char* text;
    std::vector<std::size_t> doublings; ///< of K_N, of each run
    std::function<double(const std::vector<double>&)> limit;
};

const Way one_run{"one run", {0}, [](const std::vector<double>& v) { return v[0]; }};
const std::vector<Way> ways{
    one_run,
    {"K, 4 K: exponent 1/2", {0, 2}, [](const auto& v) { return verification::richardson(v, 4, {0.5}); }},
    {"K, 4 K: exponent 0.4", {0, 2}, [](const auto& v) { return verification::richardson(v, 4, {0.4}); }},
    {"K, 4 K, 16 K: exponents 1/2 and 1",
     {0, 2, 4},
     [](const auto& v) {
         return verification::richardson(v, 4, {0.5, 1});
     }},
    {"K, 4 K, 16 K: Aitken", {0, 2, 4}, verification::aitken},
    {"K, 16 K, 256 K: Aitken", {0, 4, 8}, verification::aitken}};

struct Point {
    double K = 0, cost = 0, error = 0;
};

std::vector<Point> along(const Way& way, const std::vector<Errors>& runs, double Errors::*answer)
{
    std::vector<Point> points;
    for (std::size_t i = 0; i + way.doublings.back() < runs.size(); ++i) {
        double cost = 0;
        std::vector<double> values;
        for (const std::size_t more : way.doublings) {
            cost += runs[i + more].cost;
            values.push_back(runs[i + more].*answer);
        }
        points.push_back({stiffness(i), cost, way.limit(values)});
    }
    return points;
}

/// The softest from which on all are within the limit, so that no change of sign passes for accuracy.
/// @return with a cost that is not a number if there is none, or only one
Point within(const std::vector<Point>& points, double limit)
{
    const auto first_bad =
        std::find_if(points.rbegin(), points.rend(), [&](const Point& p) { return !(std::fabs(p.error) <= limit); });
    const auto first = first_bad.base();
    if (points.end() - first < 2)
        return {0, std::numeric_limits<double>::quiet_NaN(), 0};
    return *first;
}

std::string cost_text(const Point& p, double single)
{
    if (!std::isfinite(p.cost))
        return "- | - | -";
    return fmt::format("{:.1e} | {:.0f} | {}", p.K, p.cost,
                       std::isfinite(single) ? fmt::format("{:.1f}", single / p.cost) : "-");
}

/// Exponent of the error over the last stiffnesses of some, by least squares.
double exponent(const std::vector<Errors>& runs, double Errors::*answer, std::size_t from, std::size_t to)
{
    std::vector<double> at, value;
    for (std::size_t i = from; i <= to; ++i) {
        at.push_back(stiffness(i));
        value.push_back(runs[i].*answer);
    }
    return verification::convergence("", "", at, value, 0).order;
}

verification::Series series(const std::string& title, const std::vector<Point>& points, int colour, bool line)
{
    verification::Series s{line ? "" : title, {}, {}, line, {}, {}, colour};
    for (const Point& p : points)
        if (std::isfinite(p.error) && p.error != 0) {
            s.x.push_back(p.cost);
            s.y.push_back(std::fabs(p.error));
        }
    return s;
}

/// What K_T takes of the step.
void shear_and_step(Report& report)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out, "\n### Tangential stiffness\n\nBlock-steps per simulated second at K_N = 1e8 N/m2, 0.9 of the "
                        "bound; the specimen has six free drums of 48 x 29 mm.\n\n");
    fmt::format_to(out, "{}", markdown_head("form, dashpot | structure | K_T = K_N B | 1/2 | 1/3 | 1/5 | 1/10"));
    for (const Form& form : forms)
        for (const auto& [structure, cost] :
             {std::pair{"monolith", &monolith_cost}, std::pair{"specimen", &specimen_cost}}) {
            fmt::format_to(out, "| {} | {} |", form.text(), structure);
            for (const double shear : {1.0, 1 / 2.0, 1 / 3.0, 1 / 5.0, 1 / 10.0}) {
                Setting setting;
                setting.form = form.form;
                setting.damping = form.damping;
                setting.shear = shear;
                fmt::format_to(out, " {:.0f} |", cost(setting));
            }
            fmt::format_to(out, "\n");
        }
}

void limits_of_stiffness(Report& report)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out,
                   "\n### Cost for a given error\n\nThe step is 0.9 of the bound. *K* is the softest stiffness, in "
                   "factors of 2, at and above which every stiffness is within the error. The cost is that of all "
                   "runs of a method together; the gain is relative to one run of the same form with K_T = K_N B. "
                   "*Exponent*: of the error over K_N from 1.3e8 to 1.3e11 N/m2, for one run. The softest "
                   "stiffness tested is 1e6 N/m2. Methods without a gain at either error are omitted.\n\n");
    std::string tables[2];
    const char* titles[] = {"Quarter period", "Overturning amplitude"};
    double Errors::*answers[] = {&Errors::quarter, &Errors::overturning};
    for (std::string& table : tables)
        table = markdown_head("form, dashpot | K_T / (K_N B) | exponent | method | 1 %: K [N/m2] | block-steps per s | "
                              "gain | 0.2 %: K [N/m2] | block-steps per s | gain");
    int colour = 0;
    for (const Form& form : forms) {
        double single[2][2];
        for (const double shear : {1.0, soft_shear}) {
            const std::vector<Errors> runs = over_stiffness(form, shear);
            for (int a = 0; a < 2; ++a) {
                auto& curves = a == 0 ? report.quarter_period : report.overturning;
                for (const Way& way : ways) {
                    const std::vector<Point> points = along(way, runs, answers[a]);
                    const Point percent1 = within(points, 0.01), percent02 = within(points, 0.002);
                    const bool one = way.doublings.size() == 1;
                    if (one && shear == 1) {
                        single[a][0] = percent1.cost;
                        single[a][1] = percent02.cost;
                    }
                    if (one || percent1.cost < single[a][0] || percent02.cost < single[a][1])
                        fmt::format_to(std::back_inserter(tables[a]), "| {} | {} | {} | {} | {} | {} |\n", form.text(),
                                       shear, one ? fmt::format("{:.2f}", exponent(runs, answers[a], 7, 17)) : "",
                                       way.text, cost_text(percent1, single[a][0]), cost_text(percent02, single[a][1]));
                    const bool best = &way == (a == 0 ? &ways[3] : &ways[5]);
                    if (form.damping == DampingAt::centroid && shear == 1 &&
                        (one || (best && form.form == ContactForm::area))) {
                        const std::string title = one ? name(form.form) : fmt::format("area, {}", way.text);
                        const int of = one ? colour : 3;
                        curves.push_back(series(title, points, of, false));
                        curves.push_back(series(title, points, of, true));
                    }
                }
            }
        }
        colour += form.damping == DampingAt::centroid;
    }
    for (int a = 0; a < 2; ++a)
        fmt::format_to(out, "**{}**\n\n{}\n", titles[a], tables[a]);
}

} // namespace

void monolith_tables(Report& report)
{
    report.text += fmt::format("The monolith is one block of 48 x 174 mm, damping ratio 0.1. Oracles: quarter period "
                               "{:.6f} s from half its slenderness, overturning by a half sine of w = 4 p at "
                               "{:.6f} g tan alpha (`studies/evidence/verification/rigid_block.hpp`).\n\n",
                               exact_quarter_period_s(), exact_overturning_eta());
    stiffness_and_step(report);
    shear_and_step(report);
    limits_of_stiffness(report);
}

} // namespace stylobate::work
