/// Collapse probabilities with common random numbers.

#include "bench/work_precision/page.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace stylobate::work {

namespace {

constexpr double fine_fraction = 0.125;

/// Standard error of the difference of two probabilities of the same draws.
double difference_error(std::uint64_t differ, std::uint64_t realizations)
{
    return std::sqrt(static_cast<double>(differ)) / static_cast<double>(realizations);
}

struct Case {
    ContactForm form;
    DampingAt damping;
    double K_n;
    std::string text() const
    {
        return fmt::format("{} | {} | {:.0e}", name(form), form == ContactForm::area ? name(damping) : "", K_n);
    }
};

void over_step(Report& report, std::uint64_t realizations)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out,
                   "### Collapse probability\n\nThe specimen (six free drums), {} realizations of the same draws "
                   "(friction, drum widths), 10 cycles of 3 Hz at an amplitude at which about half of them collapse. "
                   "*Difference from the fine step*: relative to an eighth of the bound, with the standard error of "
                   "the difference, root(differ) / {}. *Differ*: number of realizations with a different outcome.\n\n",
                   realizations, realizations);
    fmt::format_to(out, "{}",
                   markdown_head("form | dashpot | K_N [N/m2] | amplitude [m/s2] | step | block-steps per s | "
                                 "collapsed | difference from the fine step | differ"));
    struct Sum {
        double difference = 0, variance = 0;
        int cases = 0;
    };
    const std::vector<std::pair<StepBasis, double>> steps{{StepBasis::structure, 0.9},
                                                          {StepBasis::block, 1},
                                                          {StepBasis::block, 0.9},
                                                          {StepBasis::block, 0.5},
                                                          {StepBasis::block, 0.25}};
    std::vector<Sum> sums(steps.size());
    int colour = 0;
    for (const Case& one :
         {Case{ContactForm::area, DampingAt::centroid, 1e7}, Case{ContactForm::area, DampingAt::centroid, 1e8},
          Case{ContactForm::area, DampingAt::centroid, 4e8}, Case{ContactForm::area, DampingAt::ends, 1e8},
          Case{ContactForm::two_corner, DampingAt::centroid, 1e8},
          Case{ContactForm::points, DampingAt::centroid, 1e8}}) {
        Setting setting;
        setting.form = one.form;
        setting.damping = one.damping;
        setting.K_n = one.K_n;
        const double pga = steep_place(setting);
        setting.step_fraction = fine_fraction;
        const Ensemble fine = collapses(setting, pga, realizations);
        verification::Series marks{
            fmt::format("{}{}, K_N = {:.0e}", name(one.form), one.damping == DampingAt::ends ? ", ends" : "", one.K_n),
            {},
            {},
            false,
            {},
            {},
            colour++};
        for (std::size_t i = 0; i < steps.size(); ++i) {
            setting.basis = steps[i].first;
            setting.step_fraction = steps[i].second;
            if (setting.basis == StepBasis::structure && setting.damping != DampingAt::ends)
                continue; // it has no longer step
            const Ensemble e = collapses(setting, pga, realizations);
            const double difference = e.probability() - fine.probability();
            const double error = difference_error(differing(e, fine), realizations);
            fmt::format_to(out, "| {} | {:.2f} | {}{} | {:.0f} | {:.3f} | {:+.3f} ± {:.3f} | {} |\n", one.text(), pga,
                           steps[i].second, setting.basis == StepBasis::structure ? " of the structure" : "", e.cost,
                           e.probability(), difference, error, differing(e, fine));
            sums[i].difference += difference;
            sums[i].variance += error * error;
            ++sums[i].cases;
            marks.x.push_back(e.cost);
            marks.y.push_back(difference);
            marks.low.push_back(difference - error);
            marks.high.push_back(difference + error);
        }
        fmt::format_to(out, "| {} | {:.2f} | {} (fine) | {:.0f} | {:.3f} | | |\n", one.text(), pga, fine_fraction,
                       fine.cost, fine.probability());
        report.collapse.push_back(marks);
    }
    fmt::format_to(out, "\nMean difference over all settings:");
    for (std::size_t i = 1; i < steps.size(); ++i)
        fmt::format_to(out, "{} {:+.4f} ± {:.4f} at {} of the bound", i == 1 ? "" : ",",
                       sums[i].difference / sums[i].cases, std::sqrt(sums[i].variance) / sums[i].cases,
                       steps[i].second);
    fmt::format_to(out, ".\n");
}

void bound_of_the_structure(Report& report, std::uint64_t realizations)
{
    auto out = std::back_inserter(report.text);
    fmt::format_to(out, "\n### The step bound of the structure\n\nThe same specimen with K_N = 1e8 N/m2 and its "
                        "dashpots at the ends, at 0.9 of both bounds.\n\n");
    fmt::format_to(
        out, "{}",
        markdown_head("damping ratio | amplitude [m/s2] | block-steps per s: blocks | structure | fewer steps | "
                      "collapsed: blocks | structure | difference | energy residual, worst: blocks | structure"));
    for (const double xi : {0.05, 0.1, 0.3, 0.5}) {
        Setting setting;
        setting.damping = DampingAt::ends;
        setting.xi = xi;
        const double pga = steep_place(setting);
        const Ensemble blocks = collapses(setting, pga, realizations);
        setting.basis = StepBasis::structure;
        const Ensemble whole = collapses(setting, pga, realizations);
        fmt::format_to(out,
                       "| {} | {:.2f} | {:.0f} | {:.0f} | {:.2f} | {:.3f} | {:.3f} | {:+.3f} ± {:.3f} | {:.3f} | "
                       "{:.3f} |\n",
                       xi, pga, blocks.cost, whole.cost, blocks.cost / whole.cost, blocks.probability(),
                       whole.probability(), whole.probability() - blocks.probability(),
                       difference_error(differing(whole, blocks), realizations), blocks.worst_residual,
                       whole.worst_residual);
    }
}

} // namespace

void collapse_tables(Report& report, std::uint64_t realizations)
{
    over_step(report, realizations);
    bound_of_the_structure(report, realizations);
}

} // namespace stylobate::work
