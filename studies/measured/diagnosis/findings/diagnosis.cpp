#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <algorithm>

namespace stylobate {

const char* to_string(Verdict verdict)
{
    constexpr const char* words[] = {"none", "named", "unexplained"};
    return words[static_cast<std::size_t>(verdict)];
}

const char* to_string(TestOutcome outcome)
{
    constexpr const char* words[] = {"passed", "failed", "not judged"};
    return words[static_cast<std::size_t>(outcome)];
}

const char* to_string(Decision decision)
{
    constexpr const char* words[] = {"named", "in the set", "not shown by these data", "could not be judged"};
    return words[static_cast<std::size_t>(decision)];
}

std::vector<const Candidate*> named_causes(const Diagnosis& diagnosis)
{
    std::vector<const Candidate*> causes;
    if (diagnosis.verdict != Verdict::none)
        for (const Candidate& candidate : diagnosis.candidates)
            if (candidate.decision == Decision::named)
                causes.push_back(&candidate);
    std::stable_sort(causes.begin(), causes.end(), [](const Candidate* a, const Candidate* b) {
        return a->probability.value_or(-1) > b->probability.value_or(-1);
    });
    return causes;
}

const Candidate* best_candidate(const Diagnosis& diagnosis)
{
    const Candidate* best = nullptr;
    if (diagnosis.verdict == Verdict::none)
        for (const Candidate& candidate : diagnosis.candidates)
            if (candidate.p && candidate.gain_nats && *candidate.gain_nats > 0 &&
                (!best || *candidate.gain_nats > *best->gain_nats))
                best = &candidate;
    return best;
}

} // namespace stylobate
