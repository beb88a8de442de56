#include "bench/peers/restitution.hpp"

#include "bench/peers/rocking.hpp"
#include "bench/peers/scan.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

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

} // namespace stylobate::peers
