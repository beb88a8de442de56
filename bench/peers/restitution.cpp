#include "bench/peers/restitution.hpp"

#include "bench/peers/contender.hpp"
#include "bench/peers/rocking.hpp"
#include "bench/peers/table.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate::peers {

namespace {

verification::RigidBlock rigid()
{
    return verification::rigid_block(Monolith::width_m, Monolith::height_m);
}

/// Turning point of the parabola through three places at equal distances.
double vertex(double before, double at, double after)
{
    const double bend = before - 2 * at + after, slope = (after - before) / 2;
    return bend == 0 ? at : at - slope * slope / (2 * bend);
}

} // namespace

double exact_restitution()
{
    return static_cast<double>(verification::housner_restitution(rigid().alpha));
}

double lean_of_quarter_period(double time_s)
{
    const auto block = rigid();
    return static_cast<double>(block.alpha) * (1 - 1 / std::cosh(static_cast<double>(block.p) * time_s));
}

double restitution(BlockRun& block, double start_rad)
{
    const auto rigid_block = rigid();
    const double alpha = static_cast<double>(rigid_block.alpha), p = static_cast<double>(rigid_block.p);
    // an engine whose clock is ahead or behind has come from a turning point a little further out
    const double ahead_s = block.ahead_steps * block.step_s;
    const double start = start_rad + p * p * std::sin(alpha - start_rad) * ahead_s * ahead_s / 2;
    const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
    double before = start_rad, at = start_rad;
    for (int n = 0; n * block.step_s < 8 / p; ++n) {
        block.world->step(0);
        const double now = block.world->pose(1).theta_rad;
        if (at < -1e-3 * alpha && now > at)
            return std::sqrt(energy(-vertex(before, at, now)) / energy(start));
        before = at;
        at = now;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double Impacts::worst() const
{
    return std::max(std::fabs(least), std::fabs(largest));
}

Impacts impacts(const Contender& contender, double dial)
{
    static const double middle_s = exact_quarter_period();
    const double wanted = exact_restitution();
    const double step_s = contender.block(dial, Monolith::lean).step_s;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Impacts all{0, infinity, -infinity};
    for (int i = 0; i < impact_phases; ++i) {
        const double lean = lean_of_quarter_period(middle_s + step_s * i / impact_phases);
        BlockRun block = contender.block(dial, lean);
        const double error = restitution(block, lean) / wanted - 1;
        if (!std::isfinite(error))
            return {infinity, -infinity, infinity};
        all.mean += error / impact_phases;
        all.least = std::min(all.least, error);
        all.largest = std::max(all.largest, error);
    }
    return all;
}

std::optional<std::size_t> first_within(const std::vector<Impacts>& impacts, double target)
{
    constexpr std::size_t confirming = 2;
    for (std::size_t i = 0; i + 1 < impacts.size(); ++i) {
        const std::size_t end = std::min(impacts.size(), i + confirming + 1);
        if (std::all_of(impacts.begin() + static_cast<std::ptrdiff_t>(i),
                        impacts.begin() + static_cast<std::ptrdiff_t>(end),
                        [&](const Impacts& each) { return each.worst() <= target; }))
            return i;
    }
    return std::nullopt;
}

ImpactScan scan_impacts(const Contender& contender, double seconds)
{
    ImpactScan scan{contender, {}, {}, {}};
    for (int k = 0; k < (contender.compliant ? 6 : 9); ++k) {
        scan.dials.push_back(contender.compliant ? 1e7 * std::pow(4, k) : 1.0 / 60 * std::pow(2, -k));
        scan.impacts.push_back(impacts(contender, scan.dials.back()));
    }
    for (std::size_t t = 0; t < targets.size(); ++t)
        if (const auto i = first_within(scan.impacts, targets[t])) {
            const double dial = scan.dials[*i];
            if (t > 0 && scan.reached[t - 1] && scan.reached[t - 1]->dial == dial)
                scan.reached[t] = scan.reached[t - 1];
            else
                scan.reached[t] = {dial, contender.step_s(dial), contender.columns(dial, true, seconds)};
        }
    return scan;
}

namespace {

std::string cell(const Impacts& impacts)
{
    return std::isfinite(impacts.worst()) ? fmt::format("{:+.2f} ({:.2f})", 100 * impacts.mean, 100 * impacts.scatter())
                                          : "none";
}

std::string dial_text(const Contender& contender, double dial)
{
    return contender.compliant ? fmt::format("K_N {:.2g}", dial) : fmt::format("1/{:.0f}", 1 / dial);
}

/// Errors over the dials of those that have such dials.
std::string errors_table(const std::vector<ImpactScan>& scans, bool compliant)
{
    std::string text;
    for (const ImpactScan& scan : scans) {
        const Contender& c = scan.contender;
        if (c.compliant != compliant)
            continue;
        if (text.empty()) {
            text = "engine | setting";
            for (const double dial : scan.dials)
                text += " | " + dial_text(c, dial);
            text = markdown_head(text);
        }
        std::string row = engine_text(c) + " | " + c.setting;
        for (const Impacts& each : scan.impacts)
            row += " | " + cell(each);
        text += markdown_row("{}", row);
    }
    return text.empty() ? text : text + '\n';
}

std::string reached_text(const ImpactScan& scan, std::size_t target)
{
    if (!scan.reached[target])
        return "never | ";
    const ImpactScan::Reached& at = *scan.reached[target];
    return fmt::format("{} | {}{}", dial_text(scan.contender, at.dial), rate_text(at.shaken.realizations_per_second),
                       at.shaken.moved > 0 ? fmt::format(" ({} of {} columns moved)", at.shaken.moved, at.shaken.count)
                                           : "");
}

} // namespace

std::string impact_markdown(const std::vector<ImpactScan>& scans, const std::string& processor)
{
    std::string text = fmt::format(
        "One core of {}; Stylobate {}. Errors of the restitution in per cent of Housner's {:.4f}: mean (largest less "
        "least) over {} phases of the impact within a step.\n\n",
        processor, code_version(), exact_restitution(), impact_phases);
    text += errors_table(scans, false) + errors_table(scans, true);
    text += markdown_head("engine | setting | within 1 % at every phase | realizations/s | within 0.2 % | "
                          "realizations/s");
    for (const ImpactScan& scan : scans)
        text += markdown_row("{} | {} | {} | {}", engine_text(scan.contender), scan.contender.setting,
                             reached_text(scan, 0), reached_text(scan, 1));
    return text;
}

std::string impact_json(const std::vector<ImpactScan>& scans, const std::string& processor)
{
    Json rows = Json::list();
    for (const ImpactScan& scan : scans) {
        const Contender& c = scan.contender;
        Json scanned = Json::list();
        for (std::size_t i = 0; i < scan.dials.size(); ++i)
            scanned.item(Json::object()
                             .member(dial_key(c), scan.dials[i])
                             .member("mean_error", scan.impacts[i].mean)
                             .member("least_error", scan.impacts[i].least)
                             .member("largest_error", scan.impacts[i].largest));
        Json row = Json::object();
        row.member("engine", c.engine).member("version", c.version).member("setting", c.setting);
        for (std::size_t t = 0; t < targets.size(); ++t)
            if (scan.reached[t])
                row.member("within " + target_text(t), Json::object()
                                                           .member(dial_key(c), scan.reached[t]->dial)
                                                           .member("column_step_s", scan.reached[t]->step_s)
                                                           .member("shaken", json_of(scan.reached[t]->shaken)));
        rows.item(row.member("scanned", scanned));
    }
    return json_head(processor).member("phases", impact_phases).member("results", rows).text() + '\n';
}

} // namespace stylobate::peers
