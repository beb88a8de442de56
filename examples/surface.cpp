// How probable is the collapse of a column, over the frequency and the strength of the shaking?
//
//   surface STUDY.toml
//
// STUDY.toml is any study of kind "surface", such as share/stylobate/inputs/small_scale_column.toml of the
// installation. Here it is made small, so that it runs in seconds.

#include <stylobate/stylobate.hpp>

#include <cstdio>

namespace sb = stylobate::api;

int main(int argc, char** argv)
try {
    if (argc != 2) {
        std::fprintf(stderr, "usage: surface STUDY.toml\n");
        return 2;
    }

    // A study holds the structure, its contacts, the shaking, and what differs from one realization to the next.
    // Any key of the file can be set, here or later.
    sb::Study study = sb::Study::from_file(argv[1], {"study.realizations=16"});
    study.set("surface.frequency_hz={ from = 1.0, to = 4.0, count = 2 }");
    study.set("surface.pga_m_s2={ from = 2.0, to = 8.0, count = 3 }");

    // With its motions it is an experiment: everything that its realizations depend on. The same experiment gives the
    // same numbers on every machine, with any number of threads.
    const sb::Experiment experiment(study);
    for (const std::string& warning : experiment.warnings())
        std::fprintf(stderr, "warning: %s\n", warning.c_str());

    // Options are optional: without them the run takes all cores and says nothing.
    sb::RunOptions options;
    options.progress = [](const sb::Progress& p) {
        std::fprintf(stderr, "%llu of %llu\n", static_cast<unsigned long long>(p.done),
                     static_cast<unsigned long long>(p.total));
        return true; // false would stop the run
    };
    const sb::Result result = sb::run(experiment, options);

    // A probability never comes without its interval.
    const sb::Surface surface = result.surface("collapse");
    for (std::size_t i = 0; i < surface.frequency_hz.size(); ++i)
        for (std::size_t j = 0; j < surface.pga_m_s2.size(); ++j) {
            const sb::Cell cell = surface.cell(i, j);
            std::printf("%.2f Hz, %.2f m/s2: %llu of %llu collapse, %.4f (%.4f to %.4f)\n", cell.frequency_hz,
                        cell.pga_m_s2, static_cast<unsigned long long>(cell.reached),
                        static_cast<unsigned long long>(cell.trials), cell.probability, cell.lower, cell.upper);
        }
    const sb::Share all = result.share("collapse");
    std::printf("all cells: %.4f (%.4f to %.4f, %s)\n", all.probability, all.lower, all.upper,
                surface.interval.c_str());
} catch (const sb::InputError& error) { // a misspelt key, a number out of range: the message says what to do
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
