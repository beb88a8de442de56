#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include "io/store/result_seal.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_fields.hpp"

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

namespace {

/// 4: tests of single joints; 3: windows in motion; 2: spans in figures
constexpr SealedFormat format{"stylobate-diagnosis", "diagnosis", 4, 2, "run the diagnosis again"};

} // namespace

void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file)
{
    Table table(format.kind);
    add_items<Diagnosis>(table, {&diagnosis});
    write_sealed_file(file, format, diagnosis.code_version, table);
}

Diagnosis read_diagnosis(const std::filesystem::path& file)
{
    const auto [table, version] = read_sealed_file(file, format);
    Diagnosis diagnosis = std::move(items_of<Diagnosis>(table, 1, version).front());
    if (diagnosis.motion)
        if (const std::optional<std::string> fault = diagnosis.motion->fault())
            table.refuse(*fault);
    for (Candidate& candidate : diagnosis.candidates) // 0.2.0 stored 0 where none was computed
        if (candidate.decision == Decision::not_shown && candidate.probability == 0.0)
            candidate.probability.reset();
    return diagnosis;
}

} // namespace stylobate
