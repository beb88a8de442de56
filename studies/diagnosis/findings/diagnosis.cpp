#include "studies/diagnosis/findings/diagnosis.hpp"

#include <algorithm>

namespace stylobate {

const char* to_string(Verdict verdict)
{
    switch (verdict) {
    case Verdict::none:
        return "none";
    case Verdict::named:
        return "named";
    default:
        return "unexplained";
    }
}

const char* to_string(TestOutcome outcome)
{
    switch (outcome) {
    case TestOutcome::passed:
        return "passed";
    case TestOutcome::failed:
        return "failed";
    default:
        return "not judged";
    }
}

const char* to_string(Decision decision)
{
    switch (decision) {
    case Decision::named:
        return "named";
    case Decision::in_set:
        return "in the set";
    case Decision::not_shown:
        return "not shown by these data";
    default:
        return "could not be judged";
    }
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
