/// `rest`: what callipers, a level, two scales and a print of the bed give; nothing moves.
///
///   centre         the block's centre of mass from its middle, to the right [m]. By the reaction R of one of two
///   supports
///                  a width apart: (R / N - 1/2) 2 b; scales of 0.1 g a hundred grams: 50 um for a width of 50 mm
///   bearing_left   where the joint begins to carry, from the left edge [m]; the edge of a print: 0.1 mm
///   bearing_right  likewise, from the right edge
///   wedge          rotation of the block against what is below it [rad], from the cameras, where they were used;
///   error:
///                  their noise over the samples
///
/// Blind to all that needs motion: friction, bonds, dowels, damping, drag.

#include "studies/measured/joint_tests/joint_run.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <cmath>

namespace stylobate {

namespace {

constexpr double centre_error = 1e-3; // over the width: of two scales
constexpr double print_error_m = 1e-4;
constexpr double lies_within = 0.2; // of the floor of lengths: dust in the bed, and not the edge of a print

std::vector<Estimate> rest_of(const Specimen& specimen, std::span<const MeasuredRun> runs)
{
    const int joint = *runs.front().joint;
    const auto j = static_cast<std::size_t>(joint), u = static_cast<std::size_t>(specimen.joints[j].second);
    const LaboratoryFloor geometry = {.friction = 0, .geometry_m = 1, .force = 0, .damping = 0};
    const double width = 2 * specimen.half_width_m[u];
    std::vector<Estimate> all;
    if (u < specimen.centre_of_mass_m.size())
        all.push_back({"rest.centre", joint, specimen.centre_of_mass_m[u], centre_error * width, geometry});
    if (j < specimen.bearing_left_m.size())
        all.push_back({"rest.bearing_left", joint, specimen.bearing_left_m[j], print_error_m, geometry});
    if (j < specimen.bearing_right_m.size())
        all.push_back({"rest.bearing_right", joint, specimen.bearing_right_m[j], print_error_m, geometry});
    double turn = 0, variance = 0, count = 0;
    for (const MeasuredRun& run : runs)
        if (const auto seen = joint_run(specimen, run, false)) {
            std::vector<double> turns;
            for (std::size_t i = 0; i < seen->samples; ++i)
                turns.push_back(seen->theta_rad[i] - seen->below_rad[i]);
            const auto [mean, samples] = finite_mean(turns, 0, turns.size());
            if (samples == 0)
                continue;
            turn += mean;
            variance += seen->turn_sd() * seen->turn_sd() / samples;
            ++count;
        }
    if (count > 0)
        all.push_back({"rest.wedge",
                       joint,
                       turn / count,
                       std::sqrt(variance) / count,
                       {.friction = 0, .geometry_m = lies_within / width, .force = 0, .damping = 0}});
    return all;
}

} // namespace

const TestEstimators& rest_estimators()
{
    static const TestEstimators all = {
        rest_of,
        {{"rest.centre", "m", "centre of mass of the upper block, to the right of its middle", "joints"},
         {"rest.bearing_left", "m", "left end of the bed, from the upper block's edge", "all but corners"},
         {"rest.bearing_right", "m", "right end of the bed, from the upper block's edge", "all but corners"},
         {"rest.wedge", "rad", "rotation of the upper block against what is below it", "all but wedges"}}};
    return all;
}

} // namespace stylobate
