#pragma once
/// The verification of a results file: of its values among each other, against the study, and against realizations that
/// are run again, check by check; what was found as data, text and JSON. `docs/verify_file.md` describes the checks.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "io/store/result_store.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

enum class CheckVerdict {
    passed,
    differs, ///< the file is not what the program makes of its study
    not_done ///< could not be checked; the text has the reason
};

/// One value of the file and what it should be.
struct ValueDifference {
    std::string where;                        ///< "outcome/end_time_s", "surface/trials[3]"
    std::optional<std::uint64_t> realization; ///< whose value it is
    std::string stored, expected;             ///< without an expected value `stored` is the whole message
};

struct FileCheck {
    static constexpr std::size_t most_differences = 20; ///< that are kept; the others are counted

    std::string name{}; ///< "rows"
    CheckVerdict verdict = CheckVerdict::passed;
    std::string text{}; ///< what was looked at, or why it was not
    std::vector<ValueDifference> differences{};
    std::uint64_t more = 0; ///< differences that are not kept

    void add(ValueDifference difference);
    std::uint64_t found() const { return differences.size() + more; }
    bool full() const { return differences.size() >= most_differences; }
};

struct FileVerification {
    std::string file;
    std::string kind; ///< of the study
    std::uint64_t realizations = 0, done = 0;
    bool complete = false;
    std::string code_version;         ///< of the program that began the file
    std::optional<std::string> build; ///< of that program; nullopt where the file does not state it
    std::string study_crc32;          ///< eight hexadecimal digits
    bool same_version = false;        ///< whether it was this one
    bool stopped = false;             ///< at the user's request, before the end
    std::vector<FileCheck> checks;

    /// Whether no check has found a difference.
    bool well() const;
};

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

/// A line for each check, and below it one for each difference.
std::string text_of(const FileVerification& verification);
Json json_of(const FileVerification& verification);

/// A number that orders indices by chance: the same for the same seed, whatever else is chosen from.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index);

/// At most `most` realizations whose rows are in the file, ascending, spread evenly over the cells.
std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed);

} // namespace stylobate
