#include "studies/workflow/file_kind.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/records/record.hpp"
#include "io/store/result_seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <system_error>
#include <utility>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

struct KindWords {
    FileKind kind;
    const char* name;            ///< "a diagnosis"
    const char* taken = nullptr; ///< what a verb takes: "the results of a study"; null: no verb takes it
};
constexpr KindWords kind_words[] = {
    {FileKind::unknown, "not a file of stylobate"},
    {FileKind::study, "a study file", "a study file (TOML)"},
    {FileKind::results, "the results of a study", "the results of a study (HDF5)"},
    {FileKind::diagnosis, "a diagnosis", "a diagnosis"},
    {FileKind::calibration, "a calibration", "a calibration"},
    {FileKind::comparison, "a comparison of studies", "a comparison"},
    {FileKind::risk, "a risk estimate", "a risk estimate"},
    {FileKind::campaign, "a measured campaign", "a measured campaign (HDF5, or a folder of CSV files)"},
    {FileKind::outcomes, "a table of measured outcomes", "a table of measured outcomes (CSV with a column 'fell')"},
    {FileKind::record, "a record of ground motion", "records of ground motion"},
    {FileKind::table, "a table that 'stylobate export' wrote"},
    {FileKind::functions, "fragility functions for other tools"},
    {FileKind::picture, "a picture"},
    {FileKind::page, "a page (HTML)"},
};

const KindWords& words_of(FileKind kind)
{
    return *std::find_if(std::begin(kind_words), std::end(kind_words),
                         [&](const KindWords& words) { return words.kind == kind; });
}

struct Use {
    FileKind kind;
    const char* verb;
    const char* command; ///< {} is the file
    const char* purpose;
};
constexpr Use uses[] = {
    {FileKind::study, "check", "stylobate check {}",
     "before a run: its time, memory and file, and where the study is weak; --to png: draws the structure"},
    {FileKind::study, "run", "stylobate run {}", "runs it, or continues an unfinished result of it"},
    {FileKind::study, "compare", "stylobate compare {}",
     "compares it with its [variants], or with other studies, under the same draws"},
    {FileKind::results, "export", "stylobate export {} --to png", "draws it; --to csv: its tables"},
    {FileKind::results, "report", "stylobate report {}", "writes a page of it"},
    {FileKind::results, "replay", "stylobate replay {} --realization I",
     "runs one realization again, with its trajectory"},
    {FileKind::results, "verify-file", "stylobate verify-file {}", "verifies it, and runs some realizations again"},
    {FileKind::results, "merge", "stylobate merge {} OTHERS -o ALL.h5", "joins it with the other shards of its study"},
    {FileKind::results, "compare", "stylobate compare {} OTHERS -o COMPARISON.h5",
     "compares it with the results of variants of its study"},
    {FileKind::comparison, "export", "stylobate export {} --to png", "draws it; --to csv: its numbers"},
    {FileKind::comparison, "report", "stylobate report {}", "writes a page of it"},
    {FileKind::results, "risk", "stylobate risk {} --hazard HAZARD",
     "how often its limit states are reached at a site, and how likely that is over years"},
    {FileKind::comparison, "risk", "stylobate risk {} --hazard HAZARD",
     "what it changes of how often limit states are reached at a site, and over years (fragility studies)"},
    {FileKind::risk, "report", "stylobate report {}", "writes a page of it"},
    {FileKind::risk, "export", "stylobate export {} --to png", "draws it; --to csv: its tables"},
    {FileKind::results, "past", "stylobate past {} OTHERS", "the past that it has in common with other structures"},
    {FileKind::diagnosis, "report", "stylobate report {}", "writes a page of it"},
    {FileKind::calibration, "report", "stylobate report {}", "writes a page of it"},
    {FileKind::campaign, "diagnose", "stylobate diagnose {}", "finds the errors of the simulation and their causes"},
    {FileKind::campaign, "calibrate", "stylobate calibrate {}", "estimates contact parameters with intervals"},
    {FileKind::outcomes, "calibrate", "stylobate calibrate {} --study STUDY.toml",
     "estimates contact parameters with intervals"},
    {FileKind::record, "record", "stylobate record {}", "its intensity measures and spectrum"},
};

/// The first part of a file, by which its kind is recognised.
std::string beginning_of(const fs::path& file)
{
    constexpr std::uint64_t enough = 1 << 16;
    const FileHandle handle = FileHandle::open(file, false);
    std::string bytes(std::min(handle.size(), enough), '\0');
    handle.read(0, std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

/// Results, and what is computed from them, begin with a seal, before their HDF5 part.
RecognisedFile of_sealed(const fs::path& file)
{
    check_seal(FileHandle::open(file, false), file.string()); // before the library meets what may be damaged
    const hdf5::Label label = hdf5::label_of(file);
    if (label.format == "stylobate-diagnosis")
        return {FileKind::diagnosis};
    if (label.format == "stylobate-comparison")
        return {FileKind::comparison};
    if (label.format == "stylobate-risk")
        return {FileKind::risk};
    if (label.format == "stylobate-risk-change")
        return {FileKind::risk, risk_of_comparison};
    return label.format == "stylobate" ? RecognisedFile{FileKind::results, label.kind} : RecognisedFile{};
}

RecognisedFile of_hdf5(const fs::path& file)
{
    const std::optional<std::string> format = hdf5::label_of(file).format;
    return {format == "stylobate-calibration" ? FileKind::calibration
            : format == "stylobate-measured"  ? FileKind::campaign
                                              : FileKind::unknown};
}

/// A table heading of TOML that only one kind of file has.
FileKind of_toml(std::string_view text)
{
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        for (const char* heading : {"[study]", "[structure]"})
            if (line.starts_with(heading))
                return FileKind::study;
        if (line.starts_with("[campaign]"))
            return FileKind::campaign;
    }
    return FileKind::unknown;
}

/// By the names of the columns.
FileKind of_csv(std::string_view text)
{
    FileKind kind = FileKind::unknown;
    bool first = true;
    for_each_csv_line(text.substr(0, std::min(text.find_last_of('\n'), text.size())), [&](const CsvLine& line) {
        if (!std::exchange(first, false))
            return;
        const auto begins = [&](std::initializer_list<std::string_view> names) {
            return line.fields.size() > names.size() && std::equal(names.begin(), names.end(), line.fields.begin());
        };
        // what fell, or else what shook it: then the reader reports what is missing
        for (const std::string_view name :
             {"fell", "collapsed", "overturned", "toppled", "motion_file", "motion_id", "amplitude_m", "amplitude_cm",
              "amplitude_mm", "pga_m_s2", "pga_cm_s2", "pga_g"})
            if (std::find(line.fields.begin(), line.fields.end(), name) != line.fields.end())
                kind = FileKind::outcomes;
        if (begins({"index", "cell"}) || begins({"cell", "frequency_hz"}) || begins({"time_s", "base_x_m"}))
            kind = FileKind::table;
    });
    return kind;
}

RecognisedFile of_folder(const fs::path& folder)
{
    std::error_code ignored;
    if (fs::exists(folder / "campaign.toml", ignored))
        return {FileKind::campaign};
    for (const char* table : {"realizations.csv", "counts.csv"})
        if (fs::exists(folder / table, ignored))
            return {FileKind::table};
    return {};
}

RecognisedFile of_text(const fs::path& file, std::string_view text)
{
    if (const FileKind kind = of_toml(text); kind != FileKind::unknown)
        return {kind};
    if (file.extension() == ".toml")
        return {FileKind::study};
    if (text.find('\0') != std::string_view::npos)
        return {};
    if (text.find("<svg") < 1000)
        return {FileKind::picture, "SVG"};
    if (text.find("<html") < 1000)
        return {FileKind::page};
    if (text.find("<nrml") < 1000 || text.find("\"stylobate-fragility\"") < 1000)
        return {FileKind::functions};
    if (const FileKind kind = of_csv(text); kind != FileKind::unknown)
        return {kind};
    if (const auto format = record_format(file))
        return {FileKind::record, *format};
    return {};
}

} // namespace

RecognisedFile recognise(const fs::path& file)
{
    std::error_code ignored;
    if (fs::is_directory(file, ignored))
        return of_folder(file);
    if (!fs::exists(file, ignored))
        return {};
    std::string begin;
    try {
        begin = beginning_of(file);
    } catch (const InputError&) { // its reader reports why it cannot be read
        return {};
    }
    if (begin.starts_with("stylobate seal"))
        return of_sealed(file);
    if (begin.starts_with("\x89HDF\r\n\x1a\n"))
        return of_hdf5(file);
    if (begin.starts_with("\x89PNG"))
        return {FileKind::picture, "PNG"};
    if (begin.starts_with("%PDF"))
        return {FileKind::picture, "PDF"};
    return of_text(file, begin);
}

std::string describe(const RecognisedFile& file)
{
    if (file.kind == FileKind::results)
        return file.detail == "replay" ? "one realization that was run again, with its trajectory"
                                       : fmt::format("the results of a study of kind '{}'", file.detail.value_or(""));
    if (file.kind == FileKind::record && file.detail == "columns")
        return "a table of numbers, which may be a record of ground motion";
    const char* const name = words_of(file.kind).name;
    return file.detail ? fmt::format("{} ({})", name, *file.detail) : name;
}

std::vector<FileUse> uses_of(const RecognisedFile& file, const std::string& name)
{
    std::vector<FileUse> found;
    const auto is = [&](std::initializer_list<std::string_view> kinds) {
        return std::find(kinds.begin(), kinds.end(), file.detail) != kinds.end();
    };
    for (const Use& use : uses)
        if (const std::string_view verb = use.verb;
            use.kind == file.kind && !(verb == "replay" && is({"rare"})) &&
            !(verb == "compare" && is({"rare", "sensitivity", "survival", "replay"})) &&
            (verb != "risk" || file.kind != FileKind::results || is({"fragility"})) &&
            (verb != "past" || is({"survival"})))
            found.push_back({use.verb, fmt::format(fmt::runtime(use.command), name), use.purpose});
    return found;
}

void check_kind(const std::string& file, std::string_view verb)
{
    const RecognisedFile found = recognise(file);
    std::string takes;
    for (const Use& use : uses)
        if (use.verb == verb) {
            if (use.kind == found.kind)
                return;
            takes += std::string(takes.empty() ? "" : ", or ") + words_of(use.kind).taken;
        }
    if (found.kind == FileKind::unknown)
        return;
    std::string instead;
    std::vector<FileUse> others = uses_of(found, file);
    std::erase_if(others, [&](const FileUse& use) { // few results are shards, or have variants
        return use.verb == "merge" || (use.verb == "compare" && found.kind == FileKind::results);
    });
    for (const FileUse& use : others)
        instead += fmt::format("\n  {}: {}", use.command, use.purpose);
    throw InputError(file, 0,
                     fmt::format("is {}; stylobate {} takes {}.{}\n  stylobate info {}: prints its content",
                                 describe(found), verb, takes, instead, file));
}

void check_option_kind(const std::string& file, FileKind wanted, const std::string& option)
{
    RecognisedFile found;
    try {
        found = recognise(file);
    } catch (const InputError&) { // the verb that reads or continues it reports the fault
        return;
    }
    if (found.kind != wanted && found.kind != FileKind::unknown)
        throw InputError(fmt::format("{} {}: is {}; it takes {}.\n  stylobate info {}: prints its content", option,
                                     file, describe(found), words_of(wanted).taken, file));
}

void check_no_settings(const std::vector<std::string>& set, const std::string& file)
{
    if (!set.empty())
        throw InputError(
            fmt::format("--set {}: only a study can be set; {} is {}", set.front(), file, describe(recognise(file))));
}

} // namespace stylobate
