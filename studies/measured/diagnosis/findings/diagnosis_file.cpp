#include "studies/measured/diagnosis/findings/diagnosis_file.hpp"

#include "io/sealed/sealed_file.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_fields.hpp"

/// The diagnosis itself is a table of one item, the root.
namespace stylobate {
namespace {

/// 3: windows in motion; 2: spans in figures
constexpr SealedFormat format{"stylobate-diagnosis", "diagnosis", 3, 2, "run the diagnosis again"};

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
        if (const std::string fault = diagnosis.motion->fault(); !fault.empty())
            table.refuse(fault);
    for (Candidate& candidate : diagnosis.candidates) // 0.2.0 stored 0 where none was computed
        if (candidate.decision == Decision::not_shown && candidate.probability == 0.0)
            candidate.probability.reset();
    return diagnosis;
}

} // namespace stylobate
