#include "studies/decisions/compare/compare_studies.hpp"

#include "ensemble/estimators/paired/paired_allocation.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/decisions/compare/study_difference.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

namespace stylobate {

namespace {

/// Keys, or beginnings of keys (with a dot), that both studies need alike.
std::vector<std::string> fixed_keys()
{
    std::vector<std::string> fixed = {"study.kind",
                                      "study.seed",
                                      "study.realizations",
                                      "study.sampling",
                                      "structure.gravity_m_s2",
                                      "excitation.",
                                      "surface.",
                                      "fragility.",
                                      "outcome.",
                                      "perturbation.phase.",
                                      "perturbation.direction.",
                                      "perturbation.pulse_frequency.",
                                      "perturbation.pulse_gamma."};
    for (const MechanismRule& rule : mechanism_rules()) // what changes the shaking itself
        if (rule.place == MechanismPlace::base) {
            fixed.push_back(fmt::format("mechanisms.{}.", rule.name));
            fixed.push_back(fmt::format("perturbation.mechanisms.{}.", rule.name));
        }
    return fixed;
}

bool is_fixed(const std::string& key)
{
    static const std::vector<std::string> fixed = fixed_keys();
    return std::any_of(fixed.begin(), fixed.end(),
                       [&](const std::string& one) { return one.ends_with('.') ? key.starts_with(one) : key == one; });
}

/// The first key of a kind that is not alike, in the order of the names; nullopt where all are alike.
template <class Wanted>
std::optional<std::string> first_difference(const StudyKeys& base, const StudyKeys& variant, const Wanted& wanted)
{
    StudyKeys all = base;
    all.insert(variant.begin(), variant.end());
    for (const auto& [key, value] : all) {
        const auto a = base.find(key), b = variant.find(key);
        if (wanted(key) && (a == base.end() || b == variant.end() || a->second != b->second))
            return key;
    }
    return std::nullopt;
}

std::string value_or_absent(const StudyKeys& keys, const std::string& key)
{
    const auto found = keys.find(key);
    return found == keys.end() ? "is absent" : "= " + found->second;
}

/// The lines behind the study that identify its records.
std::vector<std::string> fingerprints(const ResultHeader& header)
{
    std::vector<std::string> lines;
    std::istringstream text(header.study_toml);
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("# "))
            lines.push_back(line.substr(2));
    return lines;
}

} // namespace

void check_can_be_compared(const ResultHeader& header, const std::string& name)
{
    if (header.kind != "surface" && header.kind != "fragility" && header.kind != "single")
        throw InputError(name, 0,
                         fmt::format("study.kind = \"{}\" has no realizations that a variant could repeat one by "
                                     "one.\n  Compare studies of kind surface, fragility or single.",
                                     header.kind));
    if (header.selected)
        throw InputError(name, 0,
                         "surface.adaptive chooses the realizations of each study by its own outcomes, which leaves "
                         "no pairs.\n  Remove it; compare --adaptive BUDGET chooses them for both together.");
    if (!header.has_rows())
        throw InputError(name, 0,
                         "keeps no row of each realization, so that none can be paired.\n  Give "
                         "output.realizations = \"all\", or omit it.");
}

void check_comparable(const ResultHeader& base, const std::string& base_name, const ResultHeader& variant,
                      const std::string& variant_name)
{
    const StudyKeys a = study_keys(base.study_toml, base_name), b = study_keys(variant.study_toml, variant_name);
    std::optional<std::string> key;
    for (const char* first : {"study.kind", "study.seed", "study.realizations"}) // these name the cause best
        if (!key)
            key = first_difference(a, b, [&](const std::string& one) { return one == first; });
    if (!key)
        key = first_difference(a, b, is_fixed);
    if (key)
        throw InputError(fmt::format("{0}: {1} {2}, and {3} has {1} {4}.\n  Realizations are compared pair by pair, "
                                     "under the same draws and the same shaking: give both the same value.",
                                     variant_name, *key, value_or_absent(b, *key), base_name,
                                     value_or_absent(a, *key)));
    const std::vector<std::string> records = fingerprints(base), others = fingerprints(variant);
    for (std::size_t i = 0; i < std::max(records.size(), others.size()); ++i)
        if (i >= records.size() || i >= others.size() || records[i] != others[i])
            throw InputError(fmt::format("{}: its motion is not that of {}: {}, and there {}.\n  Give both the same "
                                         "record.",
                                         variant_name, base_name, i < others.size() ? others[i] : "none",
                                         i < records.size() ? records[i] : "none"));
}

namespace {

namespace fs = std::filesystem;

std::string stem(const std::string& file)
{
    return fs::path(file).stem().string();
}

/// Two results files cannot have one name.
void check_names(const std::vector<std::string>& names)
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
            names.begin() + static_cast<std::ptrdiff_t>(i))
            throw InputError(
                fmt::format("compare: two of the studies are called '{}', and their results would have one "
                            "file.\n  Rename one of the study files.",
                            names[i]));
}

StudySide side_of(const Study& study, const ResultReader& reader)
{
    StudySide side(study, reader.header());
    reader.for_each_row([&](const ResultRow& row) { side.add(row); });
    return side;
}

/// The study of a results file with its rows.
struct ReadStudy {
    explicit ReadStudy(const std::string& file)
        : reader(file), study(parse_study(reader.header().study_toml, file + " (its study)")),
          side(side_of(study, reader))
    {
    }
    const ResultReader reader;
    const Study study;
    const StudySide side;
};

/// What differs and is not refused, and yet no intervention or no common draw, in sentences: numerics, and the number
/// of blocks.
std::vector<std::string> differences_to_know(const ResultHeader& base, const ResultHeader& variant)
{
    if (base.study_toml == variant.study_toml)
        return {"It is the study of the base: the variant changes nothing."};
    std::vector<std::string> notes;
    const StudyKeys a = study_keys(base.study_toml, "base"), b = study_keys(variant.study_toml, "variant");
    const auto numeric = [](const std::string& key) {
        return key.starts_with("run.") && key != "run.max_invalid_fraction";
    };
    if (const std::optional<std::string> key = first_difference(a, b, numeric))
        notes.push_back(fmt::format("The numerics differ ({} {} in the base, {} in the variant): a part of the "
                                    "difference may be theirs.",
                                    *key, value_or_absent(a, *key), value_or_absent(b, *key)));
    if (base.block_names != variant.block_names)
        notes.push_back(fmt::format("The base has {} blocks, the variant {}: draws of blocks and joints are common "
                                    "where both have one of the same number.",
                                    base.block_names.size(), variant.block_names.size()));
    return notes;
}

/// A comparison with the base and without variants. @param file of its results
Comparison comparison_facts(const Study& base, const ResultHeader& header, const std::string& name,
                            const std::string& file, double level)
{
    const PairLayout layout = pair_layout(base, header.motions, level);
    Comparison comparison;
    comparison.kind = header.kind;
    comparison.title = base.title.value_or("");
    comparison.base_name = name;
    comparison.base_results = fs::path(file).filename().string();
    comparison.base_toml = header.study_toml;
    comparison.code_version = code_version();
    comparison.level = level;
    if (layout.cells != 1)
        comparison.adjustment = layout.groups > 0 ? "holm" : "benjamini-hochberg";
    comparison.axes() = header;
    comparison.motions = layout.groups;
    if (const MotionSetSpec* motions = base.design().motions) {
        comparison.measure = measure_name(motions->measure, motions->period_s);
        if (motions->method == FragilityMethod::stripes)
            for (int i = 0; i < motions->intensity.count; ++i)
                comparison.intensity.push_back(motions->intensity.value(i));
    }
    return comparison;
}

/// Adds a variant to a comparison with the base: its name, results file and study, and what else differs.
/// @param found of the pairs   @param file of its results
void add_variant(Comparison& comparison, VariantComparison found, const std::string& name, const std::string& file,
                 const ResultHeader& base, const ResultHeader& variant)
{
    found.name = name;
    found.results = fs::path(file).filename().string();
    found.study_toml = variant.study_toml;
    found.notes = differences_to_know(base, variant);
    comparison.variants.push_back(std::move(found));
}

} // namespace

StudyRuns studies_to_compare(const StudyFiles& asked)
{
    const std::string& base = asked.files.front();
    const auto beside = [&](const std::string& name) { return (fs::path(asked.folder) / (name + ".h5")).string(); };
    StudyRuns studies;
    const auto add = [&](LoadedStudy loaded, const std::string& name, const std::string& results) {
        const ResultHeader header = loaded.result_header();
        check_can_be_compared(header, name);
        if (!studies.empty())
            check_comparable(studies.front()->header(), base, header, name);
        studies.push_back(std::make_unique<StudyRun>(std::move(loaded), name, beside(results)));
    };
    if (asked.files.size() > 1) {
        std::vector<std::string> names;
        for (const std::string& file : asked.files)
            names.push_back(stem(file));
        check_names(names);
        for (std::size_t i = 0; i < names.size(); ++i)
            add(LoadedStudy::from_file(asked.files[i], asked.settings), asked.files[i], names[i]);
        return studies;
    }
    const std::vector<std::string> variants = read_variant_names(base, asked.settings);
    if (variants.empty())
        throw InputError(base, 0,
                         "has no [variants], and no other study is given to compare it with.\n  Give compare "
                         "BASE.toml VARIANT.toml, or a table [variants] with lines NAME = { \"KEY\" = VALUE }.");
    add(LoadedStudy::from_file(base, asked.settings), base, stem(base));
    for (const std::string& variant : variants)
        add(LoadedStudy::from_variant(base, variant, asked.settings), fmt::format("{} (variant {})", base, variant),
            stem(base) + "_" + variant);
    return studies;
}

std::vector<std::unique_ptr<Results>> results_to_compare(const std::vector<std::string>& files)
{
    std::vector<std::unique_ptr<Results>> all;
    for (const std::string& file : files) {
        all.push_back(std::make_unique<Results>(file));
        if (all.back()->header().kind == "replay")
            throw InputError(file, 0, "is one realization that was run again, and no study that could be compared.");
        check_can_be_compared(all.back()->header(), file);
        check_complete(all.back()->reader(), file);
        if (all.size() > 1)
            check_comparable(all.front()->header(), files.front(), all.back()->header(), file);
    }
    return all;
}

Comparison comparison_of(const std::vector<std::string>& names, const std::vector<std::string>& files, double level)
{
    const ReadStudy base(files.front());
    const ResultHeader& header = base.reader.header();
    const PairLayout layout = pair_layout(base.study, header.motions, level);
    Comparison comparison = comparison_facts(base.study, header, names.front(), files.front(), level);
    for (std::size_t i = 1; i < files.size(); ++i) {
        const ReadStudy variant(files[i]);
        VariantComparison found =
            compare_sides(base.side, header.input_names, variant.side, variant.reader.header().input_names, layout);
        if (!found.limits.empty()) {
            const auto number = [&](const StudySide& side) {
                const auto at = std::ranges::find(side.limits(), found.limits.front().name, &LimitDefinition::name);
                return static_cast<std::size_t>(at - side.limits().begin());
            };
            found.depends = input_dependences(base.reader, base.side, variant.side, number(base.side),
                                              number(variant.side), layout);
        }
        add_variant(comparison, std::move(found), names[i], files[i], header, variant.reader.header());
    }
    return comparison;
}

namespace {

constexpr std::uint64_t first_look = 8; ///< pairs of each cell

StudySide side_now(const StudyRun& run)
{
    StudySide side(run.study(), run.header());
    run.for_each_row([&](const ResultRow& row) { side.add(row); });
    return side;
}

PairedBudget budget_of(const Study& base, const AdaptiveChoice& choice)
{
    return {choice.budget, std::min(first_look, base.realizations), choice.margin};
}

} // namespace

void check_adaptive(const Study& base, const std::string& name, const AdaptiveChoice& choice)
{
    if (!base.surface)
        throw InputError(fmt::format("--adaptive {}: {} is no study of kind \"surface\", whose cells pairs could go "
                                     "to.\n  Leave --adaptive out.",
                                     choice.budget, name));
    const auto cells = static_cast<std::uint64_t>(base.surface->cells());
    const std::uint64_t least = cells * budget_of(base, choice).minimum;
    if (choice.budget < least)
        throw InputError(
            fmt::format("--adaptive {}: {} has {} cells, whose first look takes {} pairs.\n  Give at least "
                        "{}.",
                        choice.budget, name, cells, least, least));
}

std::optional<Comparison> compare_adaptively(const StudyRuns& studies, const std::vector<std::string>& names,
                                             const AdaptiveChoice& choice, double level, const RunOptions& options,
                                             Observer& observer)
{
    StudyRun& base = *studies.front();
    PairLayout layout = pair_layout(base.study(), base.header().motions, level);
    Comparison comparison = comparison_facts(base.study(), base.header(), names.front(), base.results(), level);
    comparison.adaptive_budget = choice.budget;
    comparison.adaptive_margin = choice.margin;
    for (std::size_t i = 1; i < studies.size(); ++i) {
        StudyRun& variant = *studies[i];
        PairedAllocation allocation(budget_of(base.study(), choice), layout.cells, layout.per_cell, level);
        layout.looks = &allocation.looks();
        layout.asked.assign(layout.cells, 0);
        std::vector<PairedCounts> counts(layout.cells);
        while (true) {
            const std::vector<std::uint64_t> before = layout.asked;
            layout.asked = allocation.next(counts);
            std::vector<std::uint64_t> indices;
            for (std::size_t cell = 0; cell < layout.cells; ++cell)
                for (std::uint64_t k = before[cell]; k < layout.asked[cell]; ++k)
                    indices.push_back(cell * layout.per_cell + k);
            if (indices.empty())
                break;
            if (!base.run_some(indices, options, observer) || !variant.run_some(indices, options, observer))
                return std::nullopt;
            counts = count_pairs(side_now(base), side_now(variant), 0, 0, layout);
        }
        VariantComparison found = compare_sides(side_now(base), base.header().input_names, side_now(variant),
                                                variant.header().input_names, layout);
        comparison.adaptive_rounds = std::max(comparison.adaptive_rounds, allocation.rounds());
        add_variant(comparison, std::move(found), names[i], variant.results(), base.header(), variant.header());
    }
    return comparison;
}

} // namespace stylobate
