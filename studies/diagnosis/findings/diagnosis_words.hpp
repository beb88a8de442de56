#pragma once
/// A diagnosis in words: texts that are common to its page, its text and its headings.

#include "studies/diagnosis/findings/diagnosis.hpp"

#include <string>

namespace stylobate {

/// Three significant digits; "not known".
std::string number_words(MaybeReal value);
/// "0.49 to 0.66"; empty where neither end is known.
std::string interval_words(MaybeReal low, MaybeReal high);
/// "0.57 m (0.49 to 0.66)".
std::string estimate_words(MaybeReal value, MaybeReal low, MaybeReal high, const std::string& unit);
/// "< 0.001", "0.032".
std::string probability_words(MaybeReal p);
/// "block 3", "the base".
std::string block_words(int block);
/// "a", "a and b", "a, b and c".
std::string list_words(const std::vector<std::string>& list);
/// "one run", "3 runs".
std::string count_words(std::uint64_t n, const std::string& one, const std::string& many);

/// What a mechanism is, for who does not know its name; the name itself if it is none that studies can name.
std::string mechanism_words(const std::string& mechanism);

/// "at joint 0", "everywhere".
std::string place_words(const std::string& place);
/// What was found of a parameter of the baseline, beside its number: "not determined by these data: no joint slides".
std::string parameter_words(const CalibratedParameter& parameter);
/// What the stretches in which the baseline is off are worth as evidence, and in what their excess is counted.
std::string wrong_words(const Diagnosis& diagnosis);

/// "The simulation agrees with ...": a line.
std::string verdict_heading(const Diagnosis& diagnosis);
/// What a nat is, for who has not met one.
std::string nats_words();
/// The meaning of p for a candidate, and why a candidate with a small p may still be rejected.
std::string chance_words();
/// The verdict in one to three sentences: the pipeline's own, or else composed of what was found.
std::string verdict_words(const Diagnosis& diagnosis);
/// The gain on runs left out, in a sentence; empty where there is none.
std::string gain_words(const ModelGain& gain);
/// How well the collapses were predicted; empty where it is not known.
std::string collapse_words(const ModelGain& gain);
std::string cost_words(const DiagnosisCost& cost);

} // namespace stylobate
