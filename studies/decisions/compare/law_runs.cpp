#include "studies/decisions/compare/law_runs.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/decisions/compare/compare_studies.hpp"
#include "studies/decisions/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

std::string beside(const std::string& results, const std::string& end)
{
    const fs::path file(results);
    return (file.parent_path() / (file.stem().string() + end + ".h5")).string();
}

/// Whether the variants of a comparison are the laws of the study.
bool is_of(const Comparison& comparison, const ResultHeader& header, const std::vector<ContactLaw>& laws)
{
    if (study_text_of(comparison.base_toml, true) != study_text_of(header.study_toml, true))
        return false;
    std::size_t variant = 0;
    for (const ContactLaw& law : laws) {
        if (!law.study)
            continue;
        if (variant == comparison.variants.size() || comparison.variants[variant].name != law.name ||
            study_text_of(comparison.variants[variant].study_toml, false) != study_text_of(law.study->text, false))
            return false;
        ++variant;
    }
    return variant > 0 && variant == comparison.variants.size();
}

/// The probability of the study and of each law. Of the study that of its most pairs: where a law has an invalid
/// realization, it has fewer.
LawBand::Place place_of(const std::vector<const PlaceComparison*>& variants)
{
    LawBand::Place place;
    const auto most =
        std::ranges::max_element(variants, {}, [](const PlaceComparison* variant) { return variant->counts.pairs(); });
    place.probability.push_back((*most)->base.probability);
    for (const PlaceComparison* variant : variants)
        place.probability.push_back(variant->variant.probability);
    return place;
}

LawBand band_of(const Comparison& comparison, const std::vector<ContactLaw>& laws, const std::string& file)
{
    LawBand band;
    band.file = fs::path(file).filename().string();
    band.laws = {"as given"};
    band.words = {"the law of the study"};
    for (const ContactLaw& law : laws)
        if (law.study) {
            band.laws.push_back(law.name);
            band.words.push_back(law.words);
            if (law.note)
                band.notes.push_back(law.name + ": " + *law.note);
        }
    band.left_out = laws_left_out(laws);
    band.axes() = comparison;
    band.measure = comparison.measure;
    band.intensity = comparison.intensity;
    for (std::size_t cell = 0; cell < comparison.variants.front().limits.front().cells.size(); ++cell)
        band.places.push_back(comparison.place(cell));
    band.level = comparison.level;
    band.pairs = comparison.variants.front().pairs;
    for (const VariantComparison& variant : comparison.variants)
        band.pairs = std::min(band.pairs, variant.pairs);
    for (std::size_t i = 0; i < comparison.variants.front().limits.size(); ++i) {
        const LimitComparison& first = comparison.variants.front().limits[i];
        LawBand::Limit limit{first.name, first.describe, {}, {}, {0}, {0}, {0}};
        const auto places = [&](const auto& of) {
            std::vector<const PlaceComparison*> all;
            for (const VariantComparison& variant : comparison.variants)
                all.push_back(&of(variant.limits[i]));
            return all;
        };
        for (std::size_t cell = 0; cell < first.cells.size(); ++cell)
            limit.cells.push_back(place_of(
                places([cell](const LimitComparison& one) -> const PlaceComparison& { return one.cells[cell]; })));
        const auto overall = places([](const LimitComparison& one) -> const PlaceComparison& { return one.overall; });
        limit.overall = place_of(overall);
        for (const PlaceComparison* place : overall) {
            limit.difference.push_back(place->difference);
            limit.lower.push_back(place->lower);
            limit.upper.push_back(place->upper);
        }
        band.limits.push_back(std::move(limit));
    }
    return band;
}

/// The file of the band beside the results: "column.h5" -> "column_laws.h5".
std::string law_file(const std::string& results)
{
    return beside(results, "_laws");
}

std::optional<LawBand> band_beside(const std::string& results, const ResultHeader& header,
                                   const std::vector<ContactLaw>& laws)
{
    const std::string file = law_file(results);
    const Comparison comparison = read_comparison(file);
    if (!is_of(comparison, header, laws))
        return std::nullopt;
    return band_of(comparison, laws, file);
}

} // namespace

std::optional<LawBand> law_band_beside(const std::string& results, const Study& study, const ResultHeader& header)
{
    std::error_code none;
    if (header.kind == "replay" || !fs::exists(law_file(results), none))
        return std::nullopt;
    try {
        return band_beside(results, header, contact_laws(study));
    } catch (const InputError&) { // another file of that name, or a damaged one: `run --laws` reports it
        return std::nullopt;
    }
}

LawRuns::LawRuns(const LoadedStudy& base, const std::string& file, std::string results)
    : results_(std::move(results)), laws_(contact_laws(base.study()))
{
    const ResultHeader header = base.result_header();
    check_can_be_compared(header, "--laws: " + file);
    if (std::ranges::none_of(laws_, [](const ContactLaw& law) { return law.study.has_value(); })) {
        std::string why;
        for (const std::string& law : laws_left_out(laws_))
            why += "\n  " + law;
        throw InputError(fmt::format("--laws: no other contact law applies to {}.{}{}", file, why,
                                     base.study().contact.form == ContactForm::rigid
                                         ? "\n  Give contact.form = \"two_corner\" and a stiffness: rigid contacts are "
                                           "then among the laws."
                                         : ""));
    }
    const std::string comparison = law_file(results_);
    AtomicFile::check(comparison);
    std::error_code none;
    if (fs::exists(comparison, none)) {
        band_ = band_beside(results_, header, laws_);
        if (!band_)
            throw InputError(comparison, 0,
                             "is the comparison of other studies, and nothing was run.\n  Remove it, or give another "
                             "results file by -o.");
    }
    for (const ContactLaw& law : laws_) {
        if (!law.study)
            continue;
        if (band_)
            break;
        const std::string name = fmt::format("{} (law {})", file, law.name);
        LoadedStudy loaded(Experiment(*law.study, base.experiment().motions()));
        check_comparable(header, file, loaded.result_header(), name);
        names_.push_back(law.name);
        costs_.push_back(law_cost(base.experiment(), loaded.experiment()));
        runs_.push_back(std::make_unique<StudyRun>(std::move(loaded), name, beside(results_, "_law_" + law.name)));
    }
}

std::string LawRuns::costs() const
{
    std::string text;
    double all = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const bool there = runs_[i]->finished();
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", names_[i],
                            there ? "finished" : fmt::format("{:.2g}", costs_[i]));
        all += there ? 0 : costs_[i];
    }
    return fmt::format("contact laws: {}: estimated time relative to the run of the study; together {:.2g} times that",
                       text, all);
}

const LawBand& LawRuns::conclude()
{
    if (band_)
        return *band_;
    std::vector<std::string> names = {fs::path(results_).stem().string()}, files = {results_};
    names.insert(names.end(), names_.begin(), names_.end());
    for (const auto& run : runs_)
        files.push_back(run->results());
    const std::string file = law_file(results_);
    const Comparison comparison = comparison_of(names, files, interval_level);
    write_comparison(comparison, file);
    band_ = band_of(comparison, laws_, file);
    return *band_;
}

} // namespace stylobate
