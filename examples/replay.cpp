// One realization of a study through time, and its picture.
//
//   replay STUDY.toml PICTURE.svg

#include <stylobate/stylobate.hpp>

#include <cstdio>

namespace sb = stylobate::api;

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: replay STUDY.toml PICTURE.svg\n");
        return 2;
    }
    const sb::Study study = sb::Study::from_file(argv[1], {"study.realizations=16",
                                                           "surface.frequency_hz={ from = 1.0, to = 1.0, count = 1 }",
                                                           "surface.pga_m_s2={ from = 6.0, to = 6.0, count = 1 }"});
    const sb::Experiment experiment(study);

    // Realization 3, whatever else is run: each is a pure function of the study and its index.
    const sb::Trajectory trajectory = sb::replay(experiment, 3);
    const sb::Outcome& outcome = trajectory.outcome;
    std::printf("realization %llu %s after %.6f s\n", static_cast<unsigned long long>(outcome.index),
                sb::to_string(outcome.state), outcome.end_time_s);
    if (outcome.state == sb::State::collapsed && outcome.first_fallen_block >= 0)
        std::printf("%s fell first, at %.6f s\n",
                    trajectory.name[static_cast<std::size_t>(outcome.first_fallen_block)].c_str(),
                    outcome.collapse_time_s);

    // Places and angles lie time by time, block by block: here those of the last block, the top of the column.
    const std::size_t top = trajectory.blocks() - 1;
    for (double time_s = 0; time_s < trajectory.time_s.back(); time_s += 0.5) {
        const std::size_t sample = trajectory.sample_at(time_s);
        const std::size_t at = sample * trajectory.blocks() + top;
        std::printf("%.3f s: %s at x = %.6f m, turned by %.6f rad\n", trajectory.time_s[sample],
                    trajectory.name[top].c_str(), trajectory.x_m[at], trajectory.theta_rad[at]);
    }

    sb::write_svg(trajectory, trajectory.time_s.back(), argv[2]);
    std::printf("the last moment: %s\n", argv[2]);
} catch (const sb::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
