#pragma once
/// Runs the variants of a claim file, each into a result file of its own, so that an interrupted run of all claims
/// goes on where it stopped.

#include "studies/evidence/claims/sample.hpp"

#include "ensemble/run/executor.hpp"

#include <filesystem>
#include <functional>

namespace stylobate::claims {

struct RunPlace {
    std::filesystem::path results;  ///< folder of the result files
    std::filesystem::path data;     ///< folder that the claim files' records are relative to
    std::uint64_t realizations = 0; ///< instead of the study's; 0: the study's
    /// Told of each variant that is about to be computed; may be empty.
    std::function<void(const Levels&)> begins = {};
};

/// One sample for each variant, in the order of `variants(file.axes)`. A complete result file of the same study is
/// read, not computed again; an unfinished one of the same study and the same code goes on; any other is replaced.
/// A variant whose record is absent has no realizations and the reason in `why_not`.
///
/// @return fewer samples than variants if the observer asked to stop
/// @throws InputError for whatever is wrong with the study or a level's settings
std::vector<Sample> run_variants(const ClaimFile& file, const RunPlace& place, const RunOptions& options,
                                 Observer& observer);

} // namespace stylobate::claims
