#include "studies/evidence/measured/double_pulse/double_pulse.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/measured/parts/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate::measured {

namespace {

constexpr double gravity = 9.81;
constexpr double density = 2500; // of no consequence: stiffness and dashpots are in proportion to the weight
constexpr double depth = 0.1;
/// Static overlap over width times slenderness: so stiff that the contact's compliance hardly lowers what overturns.
constexpr double softness = 2e-4;

} // namespace

std::vector<DoublePulse> read_double_pulses(const std::filesystem::path& file)
{
    const Table table(file);
    std::vector<DoublePulse> tests;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string& marker = table.text(row, "marker");
        const bool stood = marker.find("no overturning") != std::string::npos;
        if (!stood && marker.find("overturning") == std::string::npos)
            throw InputError(file.string(), static_cast<long>(row) + 2,
                             fmt::format("marker = '{}' is neither 'overturning' nor 'no overturning'", marker));
        const DoublePulse test{table.number(row, "BD_m"), table.number(row, "v_peak_m_s"), !stood};
        if (!(test.distance_m > 0 && test.velocity_m_s > 0))
            throw InputError(file.string(), static_cast<long>(row) + 2, "distance and velocity must be above 0");
        tests.push_back(test);
    }
    return tests;
}

Motion base_motion_of(const DoublePulse& test, double pulse_s)
{
    // middles of the two pulses are distance / velocity apart, in samples of which half a pulse is a whole number
    const double apart = test.distance_m / test.velocity_m_s;
    const double half = std::min(pulse_s, apart) / 2;
    const auto per_half = std::max(1L, std::lround(half / 2.5e-4));
    const auto samples_apart = std::max(2 * per_half, std::lround(apart / half * static_cast<double>(per_half)));
    const double dt = apart / static_cast<double>(samples_apart);
    const double peak = test.velocity_m_s / (static_cast<double>(per_half) * dt);
    const auto triangle = [&](long from_middle) {
        return peak * std::max(0.0, 1 - std::fabs(static_cast<double>(from_middle)) / static_cast<double>(per_half));
    };
    std::vector<double> acceleration;
    for (long i = 0; i <= samples_apart + 2 * per_half; ++i)
        acceleration.push_back(triangle(i - per_half) - triangle(i - per_half - samples_apart));
    Motion motion = motion_of(std::move(acceleration), dt);
    motion.predominant_frequency_hz = 1; // nothing stretches it
    motion.source = fmt::format("{} m/s over {} m", test.velocity_m_s, test.distance_m);
    return motion;
}

Study pulsed_study(const PulsedBlock& block)
{
    Study study;
    const double width = block.slenderness * block.height_m;
    const double mass = density * width * block.height_m * depth;
    study.structure = equal_column(1, 0, width, block.height_m, depth, mass);
    study.contact.normal_stiffness_n_m2 = mass * gravity / (softness * width * block.slenderness * width);
    study.contact.tangential_stiffness_n_m = study.contact.normal_stiffness_n_m2 * width;
    study.contact.normal_damping_ratio = block.damping_ratio;
    study.contact.tangential_damping_ratio = block.damping_ratio;
    study.contact.friction = block.friction;
    study.contact.damping = block.ends ? DampingAt::ends : DampingAt::centroid;
    study.excitation.kind = ExcitationKind::table;
    study.excitation.file = "motion.csv"; // what --set excitation.file replaces
    // beyond balance, but well before its side hits the ground
    study.outcome.collapse_height_fraction = 0.85;
    study.text = study_text(study);
    return study;
}

} // namespace stylobate::measured
