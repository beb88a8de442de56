#pragma once
/// Diagnoses against answers.

#include "ensemble/numerics/interval.hpp"
#include "tests/hidden/score/answer.hpp"
#include "tests/hidden/score/diagnosis_summary.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::hidden {

/// How a diagnosis stands to the answer.
enum class Judgement {
    hit,         ///< the cause, or both of two, are named first; or "unexplained" where no list has it
    in_set,      ///< it is in a stated set of three or fewer: half
    one_of_two,  ///< one of two hidden effects is named: half
    wrong_name,  ///< something else is named, or "unexplained" is named
    abstained,   ///< nothing was found, or something listed was called unexplained
    quiet,       ///< nothing is hidden, or nothing that could be seen, and nothing was said
    false_alarm, ///< nothing is hidden, and something was said
};
inline constexpr int judgements = 7;
const char* name_of(Judgement judgement);

/// @pre an effect that is not detectable need not be named, but may be
Judgement judge(const Answer& answer, const DiagnosisSummary& said);

/// What a campaign hides, for the tables.
enum class Group {
    nothing,
    single,      ///< one listed effect, detectable
    pair,        ///< two, both detectable
    outside,     ///< outside the list, detectable
    undetectable ///< what is hidden lies below the thresholds
};
inline constexpr int groups = 5;
const char* name_of(Group group);
Group group_of(const Answer& answer);

/// Among how many, how many.
struct Share {
    int of = 0;
    int count = 0;
    double value() const { return of > 0 ? static_cast<double>(count) / of : 0; }
    BinomialInterval interval() const
    {
        return jeffreys(static_cast<unsigned>(of), static_cast<unsigned>(count), 0.95);
    }
};

/// Probabilities that were stated, from one tenth to another.
struct ReliabilityBin {
    double from = 0, to = 1;
    int causes = 0;
    int right = 0;
    double mean_probability = 0;
};

struct Score {
    int campaigns = 0;
    std::vector<std::uint64_t> missing; ///< seeds without a diagnosis
    std::array<std::array<int, judgements>, groups> counts{};
    Share false_alarms;      ///< among the campaigns with nothing hidden
    Share named_alarms;      ///< of these, a cause named
    Share places;            ///< the right place among the effects named rightly
    Share coverage;          ///< sizes within their interval, of those that can be compared
    int other_parameter = 0; ///< sizes that could not be compared, as the parameter is another
    double points = 0;       ///< hits, and halves
    int to_find = 0;         ///< campaigns of `single`, `pair` and `outside`
    Share stated;            ///< causes that are hidden, among all that are stated, also beside the first one
    double brier = 0;        ///< mean of (probability - right)2 over all stated causes
    std::vector<ReliabilityBin> reliability;
    std::map<std::string, std::map<std::string, int>> confusion; ///< hidden -> said -> campaigns
    /// hits with the effect's strength over scatter: below 0.5, 1, 2, 4, above
    std::vector<std::pair<double, Share>> by_strength;
    double seconds = 0; ///< of all diagnoses
};

/// @param said by seed, as the answers; nothing where the diagnosis is missing
Score score(const std::vector<Answer>& answers, const std::vector<std::optional<DiagnosisSummary>>& said);

/// As Markdown tables, which are plain text too.
std::string markdown(const Score& score);

} // namespace stylobate::hidden
