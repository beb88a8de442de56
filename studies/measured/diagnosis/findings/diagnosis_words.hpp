#pragma once
/// A diagnosis in words, as JSON and as a page: texts that are common to its page, its text and its headings.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"
#include "studies/report/words.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// Three significant digits; "not known".
std::string number_words(MaybeReal value);
/// "0.49 to 0.66"; nullopt where neither end is known.
std::optional<std::string> interval_words(MaybeReal low, MaybeReal high);
/// "0.57 m (0.49 to 0.66)".
std::string estimate_words(MaybeReal value, MaybeReal low, MaybeReal high, const std::string& unit);
/// "< 0.001", "0.032".
std::string probability_words(MaybeReal p);
/// "block 3", "the base".
std::string block_words(int block);

/// The meaning of a mechanism; its name if no study can have it.
std::string mechanism_words(const std::string& mechanism);

/// "at joint 0", "everywhere".
std::string place_words(const std::string& place);
/// What was found of a parameter of the baseline, beside its number: "not determined by these data: no joint slides".
std::string parameter_words(const CalibratedParameter& parameter);
/// The unit of the excess of wrong stretches, and whether these are evidence.
std::string wrong_words(const Diagnosis& diagnosis);

/// "The cause: joint_friction", "No cause identified; best candidate: friction of joint 0 x 0.63 (p = 0.056)".
std::string verdict_heading(const Diagnosis& diagnosis);
/// The meaning of a nat.
std::string nats_words();
/// The meaning of p for a candidate; where a cause is named also why one with a small p may not be.
std::string chance_words(const Diagnosis& diagnosis);
/// Whether a candidate was compared with the null distribution: then gains, p-values and probabilities have a meaning.
bool compared_with_nulls(const Diagnosis& diagnosis);
/// The verdict in one to three sentences.
inline const std::string& verdict_words(const Diagnosis& diagnosis)
{
    return diagnosis.verdict_text;
}
/// The gain on runs left out, in a sentence; nullopt where there is none.
std::optional<std::string> gain_words(const ModelGain& gain);
/// How well the collapses were predicted; nullopt where it is not known.
std::optional<std::string> collapse_words(const ModelGain& gain);
std::string cost_words(const DiagnosisCost& cost);

/// What is printed at the end of a diagnosis: the verdict first, then what it rests on; lines of 100 characters at most
/// but where a name is longer, the last one ended too.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// The object that `diagnose --json` prints. First, in this order: verdict, causes, indistinguishable, unexplained,
/// wrong, gain, next_test, extended_study (where it was written), simulations, seconds; all else follows. What is not
/// known is null.
Json diagnosis_json(const Diagnosis& diagnosis);

/// The verdict first, then what it rests on.
/// @param file for names
/// @param title of the page; nullopt: by the specimen
Document diagnosis_page(const Diagnosis& diagnosis, const std::string& file,
                        const std::optional<std::string>& title = std::nullopt);

} // namespace stylobate
