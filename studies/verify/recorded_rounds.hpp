#pragma once
/// The rounds of a run whose realizations are in a results file: what the kind asks for is looked up there, and a
/// sample of it is run again.

#include "io/store/result_store.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/rounds.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace stylobate {

/// A number that orders indices by chance: the same for the same seed, whatever else is chosen from.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index);

/// At most `most` realizations whose rows are in the file, ascending, spread evenly over the cells.
std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed);

/// What is asked of the file, and what takes the realizations that are run again; the takers are called from one thread
/// at a time.
struct Recorded {
    std::vector<std::uint64_t> sample;                    ///< ascending
    std::function<bool(std::uint64_t index)> there;       ///< whether the file has the realization
    std::function<void(const ResultRow&)> take;           ///< a realization of the sample
    std::function<void(const Trajectory&)> take_movement; ///< its trajectory, of a study that follows them one by one
    std::vector<std::uint64_t> followed;                  ///< all that such a study has
    bool ends_at_missing = false; ///< whether the rounds end where one is missing: the next depends on it
};

class RecordedRounds : public Rounds {
public:
    /// As of a part of the study, so that nothing follows on the rounds.
    RecordedRounds(const Experiment& experiment, const RunOptions& options, Observer& observer, Recorded recorded);

    bool run(const Round& round) override;
    bool trace(std::uint64_t kept_trajectories) override;

    /// Realizations that were asked for, and the first of them that is not there.
    std::uint64_t asked() const { return asked_; }
    std::optional<std::uint64_t> missing() const { return missing_; }
    /// Those of the sample that were run again.
    std::uint64_t again() const { return again_; }
    bool stopped() const { return stopped_; }

private:
    void look_for(std::uint64_t index, std::vector<std::uint64_t>& of_sample);

    Recorded recorded_;
    std::uint64_t asked_ = 0, again_ = 0;
    std::optional<std::uint64_t> missing_;
    bool stopped_ = false;
};

} // namespace stylobate
