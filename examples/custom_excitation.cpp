// A column under a shaking of one's own: the base acceleration is a function of time.
//
//   custom_excitation

#include <stylobate/stylobate.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace sb = stylobate::api;

namespace {

// A study can be a text as well as a file. The unit is a part of each key; what is left out has its default.
// Its excitation is replaced below.
const char* const column = R"(
[study]
kind = "single"
seed = 7
realizations = 32

[structure]
kind = "column"
blocks = 4                       # drums, the lowest one fixed to the ground
fixed_blocks = 1
drum_width_m = 0.5
drum_height_m = 0.6
depth_m = 0.5
density_kg_m3 = 2700

[contact]
normal_stiffness_n_m2 = 1e9
tangential_stiffness_n_m = 5e8
friction = 0.7

[excitation]
kind = "none"
duration_s = 1

[perturbation]                   # what differs from one realization to the next
friction = { distribution = "normal", cov = 0.1, per = "joint" }
drum_offset = { distribution = "normal", sd_m = 0.002, per = "block" }

[output]
trajectories = 0
)";

// Six cycles of a sine whose amplitude rises and falls, in m/s2. Times are in seconds, from 0 on.
double pulse(double time_s)
{
    constexpr double duration_s = 4, frequency_hz = 1.5, amplitude_m_s2 = 7;
    const double envelope = std::sin(std::numbers::pi * time_s / duration_s);
    return amplitude_m_s2 * envelope * std::sin(2 * std::numbers::pi * frequency_hz * time_s);
}

} // namespace

int main()
try {
    const sb::Study study = sb::Study::from_text(column);
    // sampled every 5 ms for 4 s; the column is then watched until it has come to rest
    const sb::Experiment experiment(study, pulse, 0.005, 4.0);
    const sb::Result result = sb::run(experiment);

    for (const char* limit_state : {"collapse", "rocked"}) {
        const sb::Share share = result.share(limit_state);
        std::printf("%s: %llu of %llu, %.4f (%.4f to %.4f)\n", limit_state,
                    static_cast<unsigned long long>(share.count), static_cast<unsigned long long>(share.trials),
                    share.probability, share.lower, share.upper);
    }
    double largest_m = 0;
    for (const sb::Outcome& outcome : result.outcomes())
        largest_m = std::fmax(largest_m, outcome.peak_top_displacement_m);
    std::printf("largest displacement of the top: %.6f m\n", largest_m);
} catch (const sb::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
