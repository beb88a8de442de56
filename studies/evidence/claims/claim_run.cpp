#include "studies/evidence/claims/claim_run.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/contact_laws.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/surface/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace stylobate::claims {

namespace {

namespace fs = std::filesystem;

/// A name for a file: letters, digits, points, minus and plus stay.
std::string file_name(std::string text)
{
    for (char& c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
                           c == '-' || c == '+';
        if (!plain)
            c = '_';
    }
    return text + ".h5";
}

bool ratio_needed(const ClaimFile& file)
{
    const auto is_ratio = [](const Measure& m) {
        return m.kind == Measure::Kind::median &&
               (m.amount == Amount::top_path_ratio || m.amount == Amount::face_path_ratio);
    };
    return std::any_of(file.tests.begin(), file.tests.end(),
                       [&](const Test& test) { return is_ratio(test.criterion.measure); }) ||
           std::any_of(file.figures.begin(), file.figures.end(), [&](const Figure& figure) {
               return std::any_of(figure.measures.begin(), figure.measures.end(), is_ratio);
           });
}

/// A result file of this study: complete, to be continued, or not there (what lay in its place has been removed).
enum class Found { complete, unfinished, nothing };

Found look_for(const fs::path& results, const ResultHeader& header)
{
    if (!fs::exists(results))
        return Found::nothing;
    try {
        const ResultReader reader(results);
        if (reader.header().study_toml == header.study_toml) {
            if (reader.complete())
                return Found::complete;
            if (reader.header().code_version == header.code_version)
                return Found::unfinished;
        }
    } catch (const InputError&) {
        // damaged, or no result at all: computed anew
    }
    fs::remove(results);
    return Found::nothing;
}

/// @return whether all realizations are done
bool compute(const LoadedStudy& loaded, const fs::path& results, bool resume, const RunOptions& options,
             Observer& observer)
{
    const ResultHeader header = loaded.result_header();
    SurfaceCounts counts(header.frequency_hz, header.pga_m_s2);
    const std::unique_ptr<ResultWriter> writer =
        resume ? ResultWriter::resume(results, header) : ResultWriter::create(results, header);
    RunPlan plan;
    plan.total = loaded.study().total();
    if (resume)
        ResultReader(results).for_each_row([&](const ResultRow& row) { counts.add(row); });
    plan.mark_done([&](std::uint64_t index) { return writer->state(index); });
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(loaded.study(), realization, outcome);
        writer->add(row);
        counts.add(row);
    };
    const Progress progress = run_ensemble(loaded.experiment(), options, plan, observer);
    if (progress.done < progress.total) {
        writer->flush();
        return false;
    }
    const SurfaceTable table = counts.table();
    writer->finish(loaded.study().surface ? &table : nullptr);
    return true;
}

/// Where the record of a study lies; nothing if the study has none or it is found without help.
std::vector<std::string> record_setting(const Study& study, const RunPlace& place)
{
    const ExcitationKind kind = study.excitation.kind;
    const bool in_file = kind == ExcitationKind::record || kind == ExcitationKind::table;
    if (!in_file || fs::path(study.excitation.file).is_absolute())
        return {};
    return {"excitation.file=" + fs::absolute(place.data / study.excitation.file).lexically_normal().string()};
}

/// The study of a variant, under the contact law that its levels name.
LoadedStudy load(const std::string& file, const std::vector<std::string>& settings, const std::string& law)
{
    if (law.empty())
        return LoadedStudy::from_file(file, settings);
    for (ContactLaw& one : contact_laws(read_study(file, settings)))
        if (one.name == law) {
            if (!one.study)
                throw InputError(file, 0, fmt::format("law = \"{}\" does not apply: {}", law, one.why_not));
            Motions motions = motions_of(*one.study);
            return LoadedStudy(Experiment(std::move(*one.study), std::move(motions)));
        }
    throw InputError(file, 0,
                     fmt::format("law = \"{}\" is no contact law.\n  Known: softer, stiffer, rigid, ends, "
                                 "centroid.",
                                 law));
}

} // namespace

std::vector<Sample> run_variants(const ClaimFile& file, const RunPlace& place, const RunOptions& options,
                                 Observer& observer)
{
    const bool path_needed = ratio_needed(file);
    const fs::path folder = place.results / file.name;
    fs::create_directories(folder);
    std::vector<Sample> samples;
    for (const Levels& levels : variants(file.axes)) {
        std::vector<std::string> settings = settings_of(file.axes, levels);
        if (place.realizations > 0)
            settings.push_back(fmt::format("study.realizations={}", place.realizations));
        const Study study = read_study(file.file, settings);
        if (study.surface && study.surface->adaptive)
            throw InputError(
                file.file, 0,
                "surface.adaptive: a claim is tested on cells with equal numbers of realizations; leave it "
                "out");
        if (study.kept == KeptRealizations::none)
            throw InputError(
                file.file, 0,
                "output.realizations = \"none\": a claim is tested on the rows of all realizations; omit this key");
        const std::vector<std::string> record = record_setting(study, place);
        settings.insert(settings.end(), record.begin(), record.end());

        Sample sample;
        if (!record.empty() && !fs::exists(place.data / study.excitation.file)) {
            sample.why_not = "record absent: " + study.excitation.file;
        } else {
            const LoadedStudy loaded = load(file.file, settings, law_of(file.axes, levels));
            const fs::path results = folder / file_name(variant_key(file.axes, levels));
            const Found found = look_for(results, loaded.result_header());
            if (found != Found::complete && place.begins)
                place.begins(levels);
            if (found != Found::complete && !compute(loaded, results, found == Found::unfinished, options, observer))
                return samples;
            const ResultReader reader(results);
            sample = make_sample(loaded.study(), loaded.sampler(), loaded.record(), reader.rows(), path_needed);
            sample.version = reader.header().code_version;
        }
        sample.levels = levels;
        samples.push_back(std::move(sample));
    }
    return samples;
}

} // namespace stylobate::claims
