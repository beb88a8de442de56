#include "bench/work_precision/page.hpp"

#include "bench/work_precision/measure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace stylobate::work {

namespace {

const char* name(ContactForm form)
{
    return form == ContactForm::area ? "area" : form == ContactForm::two_corner ? "two_corner" : "points";
}

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

constexpr double least_K = 1e6, most_K = 1e10;

/// Errors over K_N, the step and the contact form.
void stiffness_and_step(Report& report)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out,
                   "## Stiffness, step, contact form\n\nThe monolith (48 x 174 mm, one free block), damping ratio .1. "
                   "Errors in per cent against the rigid block; *step*: by how much the step alone changes the answer, "
                   "against an eighth of it.\n\n"
                   "| form | K_N [N/m2] | fraction of the bound | block-steps per s | quarter period | step | "
                   "overturning | step |\n|---|---|---|---|---|---|---|---|\n");
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        verification::Series curve{fmt::format("{}, step .9 of the bound", name(form)), {}, {}, false, {}, {}};
        for (double K = least_K; K <= 1.001 * most_K; K *= 10) {
            Setting fine;
            fine.form = form;
            fine.K_n = K;
            fine.step_fraction = 0.125;
            const Errors limit = errors(fine);
            for (const double fraction : {1.0, 0.9, 0.5, 0.25}) {
                Setting setting = fine;
                setting.step_fraction = fraction;
                const Errors e = errors(setting);
                fmt::format_to(out, "| {} | {:.0e} | {} | {:.0f} | {} | {} | {} | {} |\n", name(form), K, fraction,
                               e.cost, percent(e.quarter), percent(e.quarter - limit.quarter, 4),
                               percent(e.overturning), percent(e.overturning - limit.overturning, 4));
                if (fraction == 0.9 && std::isfinite(e.quarter)) {
                    curve.x.push_back(e.cost);
                    curve.y.push_back(std::fabs(e.quarter));
                }
            }
        }
        report.curves.push_back(curve);
    }
}

/// Two stiffnesses, and what their errors as K_N^-1/2 leave.
void extrapolation(Report& report)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(
        out, "\n## Extrapolation in K_N\n\nTwo runs, at K_N and 4 K_N, and 2 x the second - the first: exact for an "
             "error that goes with K_N^-1/2. Beside it one run at 9 K_N, which costs as many steps as the two. "
             "Errors in per cent.\n\n| form | K_N [N/m2] | block-steps per s | quarter period: extrapolated | one run "
             "| gain | overturning: extrapolated | one run | gain |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        verification::Series curve{fmt::format("{}, extrapolated", name(form)), {}, {}, true, {}, {}};
        curve.colour = static_cast<int>(report.curves.size()) - 3;
        for (double K = least_K; K <= 1.001 * most_K / 10; K *= 10) {
            Setting soft;
            soft.form = form;
            soft.K_n = K;
            Setting stiff = soft, one = soft;
            stiff.K_n = 4 * K;
            one.K_n = 9 * K;
            const Errors a = errors(soft), b = errors(stiff), c = errors(one);
            const double quarter = 2 * b.quarter - a.quarter, overturning = 2 * b.overturning - a.overturning;
            const auto gain = [](double single, double extrapolated) {
                const double ratio = std::fabs(single / extrapolated);
                return std::isfinite(ratio) ? fmt::format("{:.1f}", ratio) : "-";
            };
            fmt::format_to(out, "| {} | {:.0e} | {:.0f} | {} | {} | {} | {} | {} | {} |\n", name(form), K,
                           a.cost + b.cost, percent(quarter), percent(c.quarter), gain(c.quarter, quarter),
                           percent(overturning), percent(c.overturning), gain(c.overturning, overturning));
            if (std::isfinite(quarter)) {
                curve.x.push_back(a.cost + b.cost);
                curve.y.push_back(std::fabs(quarter));
            }
        }
        report.curves.push_back(curve);
    }
}

/// What the bound of the structure saves, and whether the answers stay.
void bounds(Report& report, std::uint64_t realizations)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(
        out,
        "\n## The step bound of the structure\n\nThe specimen (six free drums, K_N = 1e8 N/m2), {} realizations, "
        "friction "
        "and drum widths drawn, 3 Hz, 2.2 m/s2: a steep place. Share that collapses, and of how many realizations the "
        "outcome is another one than with an eighth of the step; the standard error of a difference of the shares is "
        "root(differ) / {}. Steps at .9 of the bound.\n\n| normal dashpot | damping ratio | bound of | block-steps per "
        "s | "
        "fewer steps | collapsed | with an eighth of the step | differ | energy residual, worst "
        "|\n|---|---|---|---|---|---|"
        "---|---|---|\n",
        realizations, realizations);
    for (const auto& [text, damping] : {std::pair{"centroid", DampingAt::centroid}, std::pair{"ends", DampingAt::ends}})
        for (const double xi : {0.05, 0.1, 0.2, 0.3, 0.5}) {
            Setting setting;
            setting.damping = damping;
            setting.xi = xi;
            setting.step_fraction = 0.9 / 8;
            const Ensemble fine = collapses(setting, realizations);
            setting.step_fraction = 0.9;
            double cost = 0;
            for (const StepBasis basis : {StepBasis::block, StepBasis::structure}) {
                setting.basis = basis;
                const Ensemble e = collapses(setting, realizations);
                if (basis == StepBasis::block)
                    cost = e.cost;
                else if (std::fabs(cost / e.cost - 1) < 1e-3)
                    continue; // it is the same one
                fmt::format_to(out, "| {} | {} | {} | {:.0f} | {:.2f} | {:.3f} | {:.3f} | {} | {:.3f} |\n", text, xi,
                               basis == StepBasis::block ? "blocks" : "structure", e.cost, cost / e.cost,
                               e.probability(), fine.probability(), differing(e, fine), e.worst_residual);
            }
        }
}

} // namespace

Report measure(std::uint64_t realizations)
{
    Report report;
    report.text =
        fmt::format("# Work and precision, measured\n\nWritten by `scripts/work_precision.sh`; "
                    "`docs/work_precision.md` says what follows from it. Cost is counted in block-steps per "
                    "simulated second, so no figure here depends on the machine. Oracles: quarter period {:.6f} "
                    "s, least overturning amplitude {:.6f} (`studies/verification/rigid_block.hpp`).\n\n"
                    "![Error of the quarter period](work-precision.png)\n\n",
                    exact_quarter_period_s(), exact_overturning_eta());
    stiffness_and_step(report);
    extrapolation(report);
    bounds(report, realizations);
    return report;
}

void draw(const Report& report, const std::filesystem::path& png)
{
    run_gnuplot(verification::curves({"block-steps per simulated second", true, 0, 0},
                                     {"error of the quarter period", true, 0, 0}, report.curves, "bottom left"),
                verification::picture_size, png);
}

} // namespace stylobate::work
