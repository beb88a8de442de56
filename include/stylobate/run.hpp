#pragma once
/// Running all realizations of an experiment.

#include "stylobate/experiment.hpp"
#include "stylobate/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace stylobate::api {

/// Progress of a run.
struct Progress {
    std::uint64_t done = 0;  ///< realizations that have ended
    std::uint64_t total = 0; ///< of the study, or the most that it can take
    std::uint64_t collapsed = 0;
    std::uint64_t invalid = 0;
    double seconds = 0; ///< since the run began
    double realizations_per_second = 0;
    double probability = 0; ///< of collapse in the whole study, from a fair sample of it; NaN: not known yet
    double lower = 0;       ///< its 95 % interval
    double upper = 1;
};

struct RunOptions {
    int threads = 0;           ///< 0: as many as the process may use
    std::string simd = "auto"; ///< "auto", or an instruction set: "scalar", "avx2", "avx512", "neon"
    /// Called about ten times a second, from one thread at a time; returns false to stop the run. May be empty.
    std::function<bool(const Progress&)> progress = {};
};

/// Runs the experiment and returns the outcomes of its realizations. The result is not complete if `progress` stopped
/// it.
/// @throws InputError for options that this machine does not have, and for a realization that cannot be built
Result run(const Experiment& experiment, const RunOptions& options = {});

/// Runs a study into a file, which has the bytes of `stylobate run`. A file of the same study that is not
/// complete is continued, and one that is complete is read; killed at any moment, the next call goes on where this one
/// stopped.
/// @throws InputError as above, if the file is another study's or damaged, or if it cannot be written
Result run_to_file(const Experiment& experiment, const std::filesystem::path& file, const RunOptions& options = {});

} // namespace stylobate::api
