#pragma once
/// Outcomes of the realizations of a study.

#include "stylobate/answer.hpp"
#include "stylobate/fragility.hpp"
#include "stylobate/surface.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

/// How a realization ended.
enum class State : std::uint8_t {
    stood = 0,
    rocked = 1,    ///< beyond `outcome.rocking_threshold_rad`, without a fall
    slid = 2,      ///< beyond `outcome.sliding_threshold`, without a fall
    collapsed = 3, ///< a block has fallen
    invalid = 4    ///< set aside: a number was not finite, or the residual of the energy balance was too large
};
/// "stood", "rocked", "slid", "collapsed", "invalid"
const char* to_string(State state);

/// Why a realization was set aside.
enum class InvalidReason : std::uint8_t { none = 0, not_finite = 1, energy = 2 };
/// "none", "not_finite", "energy"
const char* to_string(InvalidReason reason);

/// One realization. Times are from the start of the simulation; -1 where a thing did not happen. The numbers that every
/// outcome has, from `state` to `steps`, are listed in `outcome_fields.inc`. A number that is of the other model (in
/// the plane or in space) is NaN, and a column -1.
struct Outcome {
    std::uint64_t index = 0;
    std::uint64_t cell = 0;  ///< of a surface, frequency by frequency; of a fragility study, motion by motion
    double frequency_hz = 0; ///< of the shaking
    double pga_m_s2 = 0;     ///< of the shaking
#define STYLOBATE_OUTCOME(type, name, value, ...) type name = value;
#define STYLOBATE_OUTCOME_AS(public_type, public_name, type, name, value, ...) public_type public_name = value;
#include "stylobate/outcome_fields.inc" // each number with its meaning
    std::vector<double> fall_time_s;    ///< (blocks) when each fell
    std::vector<double> inputs;         ///< (`Result::input_names`) what was drawn
};

/// Share of the valid realizations.
struct Share {
    std::uint64_t trials = 0;
    std::uint64_t count = 0;
    double probability = 0; ///< NaN without a trial
    double lower = 0;       ///< 95 % interval: Jeffreys'; of a fragility study, by how the motions differ
    double upper = 1;
};

/// The realizations of a study that have been run, all of them or not. A copy is cheap.
class Result {
public:
    /// Reads a results file of `stylobate run` or `run_to_file`, complete or not.
    /// @throws InputError if there is no such file, or if it is damaged or no result of stylobate
    static Result from_file(const std::filesystem::path& file);

    std::string kind() const;       ///< of the study; "replay" for a file of one realization
    std::string study_text() const; ///< canonical, followed by comments that identify its records
    std::string code_version() const;
    int dimensions() const;             ///< of the structure: 2 in the plane, 3 in space
    bool complete() const;              ///< whether every realization of the study has been run
    std::uint64_t realizations() const; ///< that have been run
    std::uint64_t invalid() const;      ///< those that were set aside
    /// What the command line prints, with exit status 3, where a complete run has more invalid realizations than
    /// `run.max_invalid_fraction` allows; else nullopt.
    std::optional<std::string> too_many_invalid() const;
    std::vector<std::string> warnings() const;

    /// How often a limit state was reached, over all cells or motions.
    /// @param limit_state "collapse", "total", "unseated", "rocked", "slid" or "moving"
    /// @throws InputError for any other word, and for a study of rare events, whose realizations are biased towards
    /// collapse
    Share share(const std::string& limit_state = "collapse") const;

    /// By index. Empty for a study that keeps no rows (`output.realizations = "none"`).
    const std::vector<Outcome>& outcomes() const;
    std::vector<std::string> input_names() const; ///< "friction[0]"
    std::vector<std::string> input_units() const; ///< "N/m2"; "" for a ratio
    std::vector<std::string> block_names() const; ///< in layout order

    /// The surface of a limit state, of a result that is complete or not.
    /// @throws InputError if the study is of another kind, for a word that is no limit state, and for an adaptive
    ///         surface that is not complete or of another limit state than the collapse
    Surface surface(const std::string& limit_state = "collapse") const;

    /// @throws InputError if the study is of another kind, or not complete
    Fragility fragility() const;

    /// What the study computes of its realizations beside shares and surface (io/FORMAT.md): "fragility", "rare",
    /// "sensitivity", "survival", "twins". Empty: its kind has none, or the run is not complete.
    const std::vector<Table>& tables() const;

    Result(const Result&) = default;
    Result& operator=(const Result&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Result(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

} // namespace stylobate::api
