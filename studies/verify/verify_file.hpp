#pragma once
/// The verification of a results file: of its values among each other, against the study, and against realizations
/// that are run again. `docs/verify_file.md` describes the checks.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/verify/verification.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct VerifyOptions {
    static constexpr std::uint64_t usual_replay = 20;

    std::uint64_t replay = usual_replay; ///< realizations to run again
    std::uint64_t seed = 1;              ///< of their choice
    std::vector<std::string> settings;   ///< KEY=VALUE: only where a record lies now
    RunOptions run;
};

/// Verifies the results of a study of any kind, complete or not, or a replay.
/// @throws InputError if there is no such file, if it is no results file, if a checksum in it is wrong, or if a setting
///         is not allowed
FileVerification verify_file(const std::string& file, const VerifyOptions& options, Observer& observer);

} // namespace stylobate
