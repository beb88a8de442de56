#include "studies/experiment/loaded_study.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_motion.hpp"
#include "io/records/ground_motion.hpp"
#include "io/records/record.hpp"
#include "io/records/record_pair.hpp"
#include "io/store/result_layout.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/motions.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace stylobate {

namespace {

/// Of the beds, in the order of `lay_out`: "drum 2 on drum 1".
std::vector<std::string> bed_names(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const auto name = [&](int block) {
        return block < 0 ? std::string("the ground") : layout.blocks[static_cast<std::size_t>(block)].name;
    };
    std::vector<std::string> names;
    for (const PlacedBed& bed : layout.beds)
        names.push_back(name(bed.upper) + " on " + name(bed.lower));
    return names;
}

// the only settings that results take: where a record lies now
constexpr char of_record[] = "excitation.file=", of_second[] = "excitation.second.file=";

/// Of a vertical record.
const char* of_vertical(const Study& study)
{
    return study.structure.spatial() ? "excitation.vertical.file=" : "mechanisms.vertical_motion.file=";
}

/// @param what it is: "record", "second", "vertical"
std::string fingerprint(const Motion& motion, const char* what)
{
    uLong crc = crc32(0, nullptr, 0);
    crc = crc32(crc, reinterpret_cast<const Bytef*>(motion.acceleration_m_s2.data()),
                static_cast<uInt>(motion.acceleration_m_s2.size() * sizeof(double)));
    return fmt::format("# {}: {} samples, dt {} s, PGA {:.4f} m/s2, predominant frequency {:.4f} Hz, crc {:08x}\n",
                       what, motion.acceleration_m_s2.size(), motion.dt_s, motion.pga_m_s2,
                       motion.predominant_frequency_hz, crc);
}

/// The text by which the motions of a study are known again, a line each.
std::string fingerprints(const Motions& motions)
{
    std::string text;
    if (motions.drawn)
        for (std::size_t i = 0; i < motions.drawn->size(); ++i) {
            const std::string name = "motion " + motions.drawn->names[i];
            text += fingerprint(*motions.drawn->motions[i], name.c_str());
            if (const auto second = motions.drawn->second(i))
                text += fingerprint(*second, (name + ", second").c_str());
            if (const auto vertical = motions.drawn->vertical(i))
                text += fingerprint(*vertical, (name + ", vertical").c_str());
        }
    if (motions.record)
        text += fingerprint(*motions.record, "record");
    if (motions.second)
        text += fingerprint(*motions.second, "second");
    if (motions.vertical)
        text += fingerprint(*motions.vertical, "vertical");
    return text;
}

/// Refuses a record that is not there with the key that names it: a study just begun has a name to be replaced.
void check_record_is_there(const std::string& file)
{
    if (!std::filesystem::exists(file))
        throw InputError(file, 0,
                         "no such file. It is excitation.file of the study: give the path of your ground-motion "
                         "record there, or by --set excitation.file=PATH.");
}

/// How a study's record is scaled, and whether it is a horizontal one.
void add_record(const LoadedStudy& loaded, StudyFacts& facts)
{
    const Study& study = loaded.study();
    const Motion& record = *loaded.record();
    facts.pga_m_s2 = record.pga_m_s2;
    facts.motion_frequency_hz = record.predominant_frequency_hz;
    const Axis* pga = study.design().pga_m_s2;
    const double strongest = pga ? std::max(pga->from, pga->to) : study.excitation.pga_m_s2;
    facts.scaled.push_back({record.source, strongest > 0 ? strongest / record.pga_m_s2 : 1});
    if (record.is_vertical.value_or(false))
        facts.vertical_motions.push_back(record.source);
}

/// How the motions of a set are scaled, which ones are equal, and whether they are horizontal ones.
void add_set(const LoadedStudy& loaded, const MotionTable& table, StudyFacts& facts)
{
    const MotionSetSpec& spec = *loaded.study().design().motions;
    const MotionSet& set = *loaded.experiment().motions().drawn;
    const int strongest = spec.intensity.from > spec.intensity.to ? 0 : spec.stripes() - 1;
    const bool recorded = !spec.records.empty();
    for (std::size_t i = 0; i < set.size(); ++i) {
        const Motion& motion = *set.motions[i];
        const double factor = motion_scale(spec, set, i, strongest);
        facts.pga_m_s2 = std::max(facts.pga_m_s2, motion.pga_m_s2);
        facts.scaled_pga_m_s2 = std::max(facts.scaled_pga_m_s2, factor * motion.pga_m_s2);
        if (recorded)
            facts.scaled.push_back({set.names[i], factor});
        if (motion.is_vertical.value_or(false))
            facts.vertical_motions.push_back(set.names[i]);
    }
    if (!recorded)
        return; // those that are drawn from one set of parameters are refused
    const MotionGroups groups = motion_groups(loaded.study(), table);
    std::vector<std::vector<std::string>> names(groups.groups);
    for (std::size_t i = 0; i < set.size(); ++i)
        names[groups.group[i]].push_back(set.names[i]);
    std::erase_if(names, [](const auto& group) { return group.size() < 2; });
    facts.equal_motions = std::move(names);
}

/// The components of a record in space beside the first one.
void add_components(const Study& study, const Record& first, Motions& motions)
{
    const ExcitationSpec& excitation = study.excitation;
    const auto motion = [&](const ComponentSpec& spec, const char* key, Direction direction) {
        const OtherComponent other{key, spec, direction, excitation.unit};
        return make_motion(other_component(first, other, pga_range(study)), excitation.baseline, excitation.band_pass);
    };
    if (excitation.second)
        motions.second = motion(*excitation.second, "excitation.second", Direction::horizontal);
    if (study.vertical)
        motions.vertical = motion(*study.vertical, "excitation.vertical", Direction::vertical);
}

/// The same of a table.
void add_tables(const Study& study, Motions& motions)
{
    const auto motion = [&](const std::string& file, const char* key) {
        Motion other = read_base_table(file, {}, pga_range(study));
        const Motion& first = *motions.record;
        if (std::fabs(other.dt_s - first.dt_s) > 1e-6 * first.dt_s)
            throw InputError(file, 0,
                             fmt::format("{}: it has a sample every {:g} s, and the first component every {:g} s.\n  "
                                         "Give tables of one motion.",
                                         key, other.dt_s, first.dt_s));
        if (other.acceleration_m_s2.size() < first.acceleration_m_s2.size())
            throw InputError(file, 0,
                             fmt::format("{}: it has {} samples, fewer than the {} of the first component.\n  Give the "
                                         "complete file, or this one as the first component.",
                                         key, other.acceleration_m_s2.size(), first.acceleration_m_s2.size()));
        return other;
    };
    if (study.excitation.second)
        motions.second = motion(*study.excitation.second->file, "excitation.second");
    if (study.vertical)
        motions.vertical = motion(*study.vertical->file, "excitation.vertical");
}

Experiment with_motions(Study study)
{
    Motions motions = motions_of(study);
    return Experiment(std::move(study), std::move(motions));
}

} // namespace

Motions motions_of(const Study& study, const Record* record)
{
    Motions motions;
    const ExcitationSpec& excitation = study.excitation;
    const PgaRange pga = pga_range(study);
    if (study.design().motions)
        motions.drawn = std::make_shared<const MotionSet>(load_motions(study));
    else if (excitation.kind == ExcitationKind::record) {
        if (!record)
            check_record_is_there(excitation.file);
        const Record first =
            record ? *record : read_record(excitation.file, excitation.component, excitation.unit, pga);
        motions.record = make_motion(first, excitation.baseline, excitation.band_pass);
        if (study.structure.spatial())
            add_components(study, first, motions);
    } else if (excitation.kind == ExcitationKind::table) {
        motions.record = read_base_table(excitation.file, excitation.run, pga);
        if (study.structure.spatial())
            add_tables(study, motions);
    }
    if (const std::optional<VerticalSpec>& spec = study.vertical; spec && !study.structure.spatial())
        motions.vertical = make_motion(read_record(*spec->file, spec->component, spec->unit, pga), spec->baseline);
    return motions;
}

void check_settings(const Study& study, const std::string& file, const std::vector<std::string>& settings)
{
    if (settings.empty())
        return;
    const ExcitationKind kind = study.excitation.kind;
    const bool has_record =
        (kind == ExcitationKind::record || kind == ExcitationKind::table) && !study.design().motions;
    for (const std::string& setting : settings) {
        const bool record = setting.starts_with(of_record), second = setting.starts_with(of_second);
        const std::string vertical = of_vertical(study);
        if (!record && !second && !setting.starts_with(vertical))
            throw InputError(fmt::format("--set {}: the study of {} is fixed; only excitation.file may be set, the "
                                         "present path of its record (and {}{})",
                                         setting, file, study.excitation.second ? "excitation.second.file and " : "",
                                         vertical.substr(0, vertical.size() - 1)));
        if (record ? !has_record : second ? !study.excitation.second : !study.vertical)
            throw InputError(fmt::format("--set {}: the study of {} is not driven by a record", setting, file));
    }
}

LoadedStudy::LoadedStudy(Experiment experiment)
    : experiment_(std::move(experiment)), text_(study().text + fingerprints(experiment_.motions()))
{
    if (experiment_.motions().drawn)
        motions_ = motion_table(*experiment_.motions().drawn);
}

LoadedStudy LoadedStudy::from_file(const std::string& file, const std::vector<std::string>& settings)
{
    return LoadedStudy(with_motions(read_study(file, settings)));
}

LoadedStudy LoadedStudy::from_variant(const std::string& file, const std::string& variant,
                                      const std::vector<std::string>& settings)
{
    return LoadedStudy(with_motions(read_variant(file, variant, settings)));
}

LoadedStudy LoadedStudy::from_results(const Study& of_results, const ResultHeader& header, const std::string& file,
                                      const std::vector<std::string>& settings)
{
    check_settings(of_results, file, settings);
    LoadedStudy loaded(
        with_motions(settings.empty() ? of_results : parse_study(header.study_toml, file + " (its study)", settings)));
    const Study& study = loaded.study();
    const auto check = [&](const std::string& record, const std::string& setting, const std::string& print) {
        if (header.study_toml.find(print) == std::string::npos)
            throw InputError(fmt::format("{} is not the record that {} was computed with: its samples differ. Give the "
                                         "right one by --set {}PATH",
                                         record, file, setting));
    };
    // the text of a loaded study ends with its fingerprints, line by line
    for (std::size_t at = study.text.size(); at < loaded.text_.size();) {
        const std::size_t end = loaded.text_.find('\n', at) + 1;
        const std::string print = loaded.text_.substr(at, end - at);
        if (print.starts_with("# motion "))
            check(print.substr(2, print.find(": ") - 2), "fragility.records=", print);
        else if (print.starts_with("# second"))
            check(loaded.experiment().motions().second->source, of_second, print);
        else if (print.starts_with("# vertical"))
            check(study.structure.spatial() ? loaded.experiment().motions().vertical->source : *study.vertical->file,
                  of_vertical(study), print);
        else
            check(study.excitation.file, of_record, print);
        at = end;
    }
    return loaded;
}

ResultHeader LoadedStudy::result_header() const
{
    ResultHeader header = plain_header();
    for (const Implausibility& one : implausibilities())
        header.warnings.push_back(one.text);
    return header;
}

std::vector<std::string> LoadedStudy::warnings(const std::string& file) const
{
    std::vector<std::string> warnings;
    for (const Implausibility& one : implausibilities()) {
        const std::string intended = fmt::format("If it is intended: study.allow = [\"{}\"].", one.check);
        if (one.refused)
            throw InputError(fmt::format("{}: {}\n  {}", file, one.text, intended));
        warnings.push_back(one.text + " " + intended);
    }
    return warnings;
}

std::vector<Implausibility> LoadedStudy::implausibilities() const
{
    const ResultHeader header = plain_header();
    StudyFacts facts;
    if (record())
        add_record(*this, facts);
    if (study().design().motions)
        add_set(*this, motions_, facts);
    if (const std::optional<Motion>& vertical = experiment_.motions().vertical)
        if (!vertical->is_vertical.value_or(true))
            facts.vertical_motion = vertical->source;
    if (header.has_rows())
        facts.file_bytes = static_cast<double>(header.total) * static_cast<double>(ResultLayout(header).row_bytes());
    return stylobate::implausibilities(study(), facts);
}

ResultHeader LoadedStudy::plain_header() const
{
    ResultHeader header;
    header.kind = word_for(study_kind_names, study().kind);
    header.motions = motions_;
    header.study_toml = text_;
    header.seed = study().seed;
    header.code_version = code_version();
    header.build = code_build();
    header.dimensions = study().structure.dimensions;
    const StudyDesign design = study().design();
    header.total = design.most;
    header.selected = design.selected;
    if (study().kept == KeptRealizations::none)
        header.limit_states = limit_state_names();
    header.input_names = sampler().input_names();
    header.block_names = block_names(study());
    if (design.end_state)
        header.bed_names = bed_names(study());
    if (study().surface) {
        const auto values = [](const Axis& axis) {
            std::vector<double> all;
            for (int i = 0; i < axis.count; ++i)
                all.push_back(axis.value(i));
            return all;
        };
        (study().surface->direction_deg ? header.direction_deg : header.frequency_hz) = values(study().surface->rows());
        header.pga_m_s2 = values(study().surface->pga_m_s2);
    }
    return header;
}

std::vector<std::string> block_names(const Study& study)
{
    std::vector<std::string> names;
    for (const PlacedBlock& block : lay_out(study.structure).blocks)
        names.push_back(block.name);
    return names;
}

std::uint64_t realizations_end(const ResultHeader& header, const Study& study)
{
    return header.selected ? study.total() : header.first + header.total;
}

} // namespace stylobate
