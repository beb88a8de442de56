/// Comparisons and risk estimates, which lie behind a seal. An input is a recipe: which file, and what is changed in
/// it. Most change the tables that a file has, in memory, which reaches what reads them a thousand times as often.
/// Changes of the file by the HDF5 library are followed by a right seal, so that they are met by all that comes behind
/// it. Other bytes are changed without one: then nothing may come out.

#include "io/files/file_handle.hpp"
#include "io/store/result_seal.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/risk_text.hpp"
#include "tests/fuzz/hdf5_edits.hpp"
#include "tests/fuzz/table_edits.hpp"
#include "tests/fuzz/text_mutation.hpp"
#include "tests/studies/decisions/decision_samples.hpp"

#include <vector>

namespace stylobate::fuzz {
namespace {

namespace fs = std::filesystem;

enum class What { comparison, risk, risk_change };

struct Original {
    std::vector<Table> tables;
    std::string bytes;
    std::vector<Hdf5Object> objects;
    std::uint64_t block = 0; ///< of the seal
    What what = What::comparison;
};

const std::vector<Original>& originals()
{
    static const std::vector<Original> all = [] {
        std::vector<Original> made;
        const fs::path file = folder() / "original.h5";
        for (const bool risk : {false, true})
            for (const bool other : {false, true}) {
                Original& original = made.emplace_back();
                if (risk) {
                    original.what = What::risk;
                    original.tables = tables_of(sample_risk(other));
                    write_risk(sample_risk(other), file);
                } else {
                    original.tables = tables_of(sample_comparison(other));
                    write_comparison(sample_comparison(other), file);
                }
                original.bytes = file_content(file);
            }
        Original& change = made.emplace_back();
        change.what = What::risk_change;
        change.tables = tables_of(sample_risk_change());
        write_risk(sample_risk_change(), file);
        change.bytes = file_content(file);
        for (Original& original : made) {
            write_file(file, original.bytes);
            original.objects = objects_in(file);
            original.block = original.bytes.find("\x89HDF\r\n\x1a\n");
        }
        return made;
    }();
    return all;
}

/// What the verbs make of it in words.
void tell(const Comparison& comparison)
{
    promise(!comparison.variants.empty(), "a comparison has no variant");
    comparison_text(comparison);
    comparison_json(comparison);
    for (const VariantComparison& variant : comparison.variants) {
        promise(!variant.limits.empty(), "a variant has no limit state");
        for (const LimitComparison& limit : variant.limits)
            promise(limit.cells.size() == comparison.places(), "a limit state has other cells than the comparison");
        answer_text(comparison, variant);
        harm_text(comparison, variant);
        what_would_change_it(comparison, variant);
    }
}

void tell(const Risk& risk)
{
    promise(!risk.chosen().empty() && !risk.years.empty(), "a risk estimate has no limit state or no years");
    risk_text(risk);
    risk_json(risk);
    risk_csv(risk);
    risk_answer(risk);
    risk_grounds(risk);
}

void tell(const RiskChange& change)
{
    promise(!change.variants.empty() && !change.years.empty(), "a change of risk has no variant or no years");
    risk_text(change);
    risk_json(change);
    risk_csv(change);
    for (const VariantChange& variant : change.variants) {
        promise(!variant.states.empty(), "a variant has no limit state");
        risk_change_answer(change, variant);
    }
}

/// What was read is told, written, read and written again: both files have the same bytes.
template <class Read, class Write>
Verdict judge_file(const fs::path& file, const Read& read, const Write& write)
{
    decltype(read(file)) found;
    const Verdict verdict = judged([&] { found = read(file); });
    if (verdict == Verdict::refused)
        return verdict;
    tell(found);
    const fs::path once = folder() / "once.h5", twice = folder() / "twice.h5";
    try {
        write(found, once);
        write(read(once), twice);
    } catch (const InputError& error) {
        throw Finding(std::string("what was read is refused when it is written: ") + error.what());
    }
    promise(file_content(once) == file_content(twice), "what was read changes when it is written");
    return verdict;
}

Verdict judge_file(const Original& original, const fs::path& file)
{
    const auto write = [](const auto& risk, const fs::path& to) { write_risk(risk, to); };
    return original.what == What::risk          ? judge_file(file, read_risk, write)
           : original.what == What::risk_change ? judge_file(file, read_risk_change, write)
                                                : judge_file(file, read_comparison, write_comparison);
}

/// As `judge_file`, without the file between.
template <class Read>
Verdict judge_tables(const std::vector<Table>& tables, const Read& read)
{
    const std::string file = "a file";
    decltype(read(tables, file)) found;
    const Verdict verdict = judged([&] { found = read(tables, file); });
    if (verdict == Verdict::refused)
        return verdict;
    tell(found);
    const std::vector<Table> once = tables_of(found);
    try {
        promise(same_tables(tables_of(read(once, file)), once), "what was read changes when it is written");
    } catch (const InputError& error) {
        throw Finding(std::string("what was read is refused when it is written: ") + error.what());
    }
    return verdict;
}

Verdict judge_tables(const Original& original, ByteSource& recipe)
{
    const std::vector<Table> tables = edited_tables(original.tables, recipe);
    return original.what == What::risk          ? judge_tables(tables, risk_from)
           : original.what == What::risk_change ? judge_tables(tables, risk_change_from)
                                                : judge_tables(tables, comparison_from);
}

/// Bytes of the file as it was written: changed, cut, or more behind the end.
Verdict damaged(const Original& original, const fs::path& file, ByteSource& recipe)
{
    const std::string bytes = damaged_bytes(original.bytes, recipe);
    write_file(file, bytes);
    const Verdict verdict = judge_file(original, file);
    promise(verdict == Verdict::refused || bytes == original.bytes, "a damaged file is accepted");
    return verdict;
}

constexpr std::uint8_t kinds_of_files = 16; ///< second byte of a recipe, from which on tables are changed in memory

Verdict judge(std::string_view input)
{
    ByteSource recipe(input);
    const fs::path file = folder() / "decision.h5";
    const Original& original = originals()[recipe.below(originals().size())];
    const std::uint8_t how = recipe.byte();
    if (how >= kinds_of_files)
        return judge_tables(original, recipe);
    if (how % 4 == 0)
        return damaged(original, file, recipe);
    write_file(file, original.bytes);
    if (how % 4 != 1 && !edit_hdf5_file(file, original.objects, recipe, how / 4 + 1))
        return Verdict::refused;
    {
        FileHandle handle = FileHandle::open(file, true);
        write_seal(handle, original.block, {});
    }
    return judge_file(original, file);
}

/// Of tables 511 times of 512: files take a hundred times as long.
std::string mutated(std::string_view input, Random& random)
{
    std::string recipe = mutated_bytes(input, random);
    if (recipe.size() > 1 && random() % 512 != 0)
        recipe[1] = static_cast<char>(recipe[1] | kinds_of_files);
    return recipe;
}

} // namespace

const Target decision_target = {"decision", judge, mutated, 256, 1000};

} // namespace stylobate::fuzz
