#include "studies/decisions/compare/compare_studies.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/comparable.hpp"
#include "studies/decisions/compare/drawn_quantities.hpp"
#include "studies/decisions/compare/pairing.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stylobate {

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

Comparison comparison_facts(const Study& base, const ResultHeader& header, const std::string& name,
                            const std::string& file, double level)
{
    const PairLayout layout = pair_layout(base, header.motions, level);
    Comparison comparison;
    comparison.kind = header.kind;
    comparison.title = base.title;
    comparison.base_name = name;
    comparison.base_results = fs::path(file).filename().string();
    comparison.base_toml = header.study_toml;
    comparison.code_version = code_version();
    comparison.level = level;
    comparison.adjustment = layout.cells == 1 ? "" : layout.groups > 0 ? "holm" : "benjamini-hochberg";
    comparison.frequency_hz = header.frequency_hz;
    comparison.pga_m_s2 = header.pga_m_s2;
    comparison.motions = layout.groups;
    if (const auto& fragility = base.fragility) {
        comparison.measure = measure_name(fragility->measure, fragility->period_s);
        if (fragility->method == FragilityMethod::stripes)
            for (int i = 0; i < fragility->intensity.count; ++i)
                comparison.intensity.push_back(fragility->intensity.value(i));
    }
    return comparison;
}

void add_variant(Comparison& comparison, VariantComparison found, const std::string& name, const std::string& file,
                 const ResultHeader& base, const ResultHeader& variant)
{
    found.name = name;
    found.results = fs::path(file).filename().string();
    found.study_toml = variant.study_toml;
    found.notes = differences_to_know(base, variant);
    comparison.variants.push_back(std::move(found));
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

} // namespace stylobate
