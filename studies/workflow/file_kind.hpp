#pragma once
/// Type of a file, from its content, and the commands that accept it: the only place that identifies files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

enum class FileKind {
    unknown,     ///< none of the others: the command that reads it reports the error
    study,       ///< TOML
    results,     ///< of a study, or one realization that was run again
    diagnosis,   ///< by `diagnose`
    calibration, ///< by `calibrate`
    comparison,  ///< by `compare`
    risk,        ///< by `risk`
    campaign,    ///< measured histories: HDF5, a folder with campaign.toml, or that file
    outcomes,    ///< measured outcomes: CSV
    record,      ///< a ground motion
    table,       ///< a table by `export --to csv`, or their folder
    functions,   ///< fragility functions by `export --to nrml` or `json`
    picture,     ///< PNG, SVG or PDF
    page         ///< HTML
};

inline constexpr const char* risk_of_comparison = "of a comparison"; ///< detail of a risk estimate of several studies

struct RecognisedFile {
    FileKind kind = FileKind::unknown;
    /// Of results the kind of the study; of a record and of a picture the format; of a risk estimate of several studies
    /// `risk_of_comparison`.
    std::optional<std::string> detail{};
};

/// @throws InputError if it is a file of stylobate that is damaged, truncated or of another format version
RecognisedFile recognise(const std::filesystem::path& file);

/// "a diagnosis", "the results of a study of kind 'surface'".
std::string describe(const RecognisedFile& file);

/// What can be done with a file: a command line, and what it does.
struct FileUse {
    std::string verb;    ///< that takes the file as its own
    std::string command; ///< "stylobate report FILE"
    std::string purpose; ///< "writes a page of it"
};
std::vector<FileUse> uses_of(const RecognisedFile& file, const std::string& name);

/// Says what a file is, and which verb takes it, before a verb that takes others reads it.
/// @throws InputError if it was recognised and is none that the verb takes, and as `recognise`
void check_kind(const std::string& file, std::string_view verb);

/// Checks the file of an option ("--study", "-o") as `check_kind` does. One that is not there, or is damaged, passes.
/// @throws InputError if it was recognised and is of another kind
void check_option_kind(const std::string& file, FileKind wanted, const std::string& option);

/// @param set given by --set   @throws InputError if there are any: the file has no study whose keys could be set
void check_no_settings(const std::vector<std::string>& set, const std::string& file);

} // namespace stylobate
