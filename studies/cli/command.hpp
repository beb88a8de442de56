#pragma once
/// The verbs of the command line and the options that they share.

#include "ensemble/run/executor.hpp"
#include "studies/results/results.hpp"
#include "studies/workflow/calibrate.hpp"
#include "studies/workflow/check.hpp"
#include "studies/workflow/compare.hpp"
#include "studies/workflow/console.hpp"
#include "studies/workflow/diagnose.hpp"
#include "studies/workflow/report.hpp"
#include "studies/workflow/risk.hpp"
#include "studies/workflow/run.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace stylobate {

struct CommonOptions : Machine {
    std::vector<std::string> set; ///< KEY=VALUE, any key of the study file
    bool quiet = false;
    bool json = false;
    bool force = false;            ///< replace files that are there
    std::string progress = "auto"; ///< of `progress_styles`

    /// What a verb shows on standard error; of several ranks the first one alone shows something.
    Console console(const char* verb) const;
};

/// The study that a calibration or a diagnosis begins from; none: that of the measured data.
/// @throws InputError if one of the files is not what the verb takes, or if there is no such study
std::optional<Study> start_study(const CommonOptions& options, const std::string& measured, const char* verb,
                                 const std::optional<std::string>& study);

/// Prints what a verb has found on standard output, as lines or as JSON.
template <class Text, class ToJson>
void print(const CommonOptions& options, const Text& text, const ToJson& json)
{
    if (options.json)
        fmt::print("{}\n", json().text());
    else
        fmt::print("{}", text());
}

/// Prints the message of too many invalid realizations. @returns the exit status
int report_invalid(const std::optional<std::string>& message);

/// Prints the name of a file that was written.
void print_written(const CommonOptions& options, const std::string& file);

/// @name Options of a verb, read into those that verbs share.
/// @{
void add_set(CLI::App& verb, CommonOptions& options);
/// @param backends where the verb can compute
void add_common(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends = {"cpu"});
void add_force(CLI::App& verb, CommonOptions& options);
/// All of these, of a verb that writes files.
void add_all(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends = {"cpu"});
/// An option with one word; an empty word is none.
CLI::Option* add_word(CLI::App& verb, const std::string& name, std::optional<std::string>& into,
                      const std::string& text);
/// An option that may be given several times, with one word each. @param word what is given, in the help
CLI::Option* add_repeated(CLI::App& verb, const std::string& name, std::vector<std::string>& into,
                          const std::string& text, const char* word);
/// @}

/// The selection of a realization; nullopt: not given.
struct RealizationChoice {
    std::optional<long long> index; ///< alone
    CellChoice cells;
    bool fallen = false;          ///< one that collapsed
    bool stood = false;           ///< a valid one that did not
    std::optional<long long> nth; ///< of those, in the order of their indices, from 1
};

/// Options of `export`; nullopt, an empty list or -1: not given.
struct ExportOptions {
    std::optional<std::string> format;  ///< "png", "svg", "pdf" of a picture; "csv", "nrml", "json" of tables; "vtk"
    std::optional<std::string> picture; ///< of `picture_names`
    std::optional<std::string> output;  ///< file of the picture, folder of the tables
    std::optional<std::string> limit;   ///< limit state of a surface or slice
    long long realization = -1;         ///< of a strip, or of "vtk"
    long long cell = -1;                ///< of a surface, for the order of falls
    std::vector<double> frequencies;    ///< of a slice [Hz]
    std::vector<double> directions;     ///< of a slice of a surface over directions [degrees]
    /// What is given of the two; nullopt: neither is.
    std::optional<std::string> rows_option() const
    {
        return !directions.empty()    ? "--direction"
               : !frequencies.empty() ? "--frequency"
                                      : std::optional<std::string>();
    }
    const std::vector<double>& rows() const { return directions.empty() ? frequencies : directions; }
    std::optional<std::string> title; ///< of the picture, instead of the study's or the file's name
};

/// The drawing of `check`; nullopt: not given.
struct DrawingOptions {
    std::optional<std::string> format; ///< "png", "svg", "pdf"
    std::optional<std::string> output;
};

/// Options of `verify-file`.
struct VerifyChoice {
    std::optional<std::uint64_t> replay; ///< realizations that are run again
    std::uint64_t seed = 1;              ///< of their choice
};

/// Options of `new`, in the words of a study file; nullopt: the default.
struct NewStudyOptions {
    std::string kind; ///< of the study, or `new_campaign_word`
    std::optional<std::string> structure, excitation;
    std::optional<int> dimensions;
    std::optional<std::string> test; ///< of a campaign
};
inline constexpr const char* new_campaign_word = "campaign";

/// Each verb returns an exit status; bad input is thrown as `InputError`. The options that
/// verbs share are put into its request here.
/// @param shard "3/8": that part of the study alone; nullopt: all of it   @param laws also under other contact laws
int run_command(const CommonOptions& options, const std::string& study, const std::optional<std::string>& results,
                const std::optional<std::string>& shard, bool laws);
int merge_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& output,
                  bool partial);
int check_command(const CommonOptions& options, const std::string& study, CheckRequest request,
                  const DrawingOptions& drawing);
int verify_command(const CommonOptions& options, const std::string& results, const VerifyChoice& wanted);
int replay_command(const CommonOptions& options, const std::string& results, const RealizationChoice& choice,
                   const std::optional<std::string>& trajectory);
/// @param block "WIDTHxHEIGHT" of a rigid block in metres, for the measures of rocking; nullopt: none
int record_command(const CommonOptions& options, const std::vector<std::string>& files,
                   const std::optional<std::string>& unit, const std::optional<std::string>& component,
                   const std::optional<std::string>& block);
/// The pictures of results of every kind.
std::vector<std::string> picture_names();
int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted);
/// @param output the page; nullopt: beside the file, with .html
int report_command(const CommonOptions& options, PageRequest request, const std::optional<std::string>& output);
/// @param study contacts to begin with; nullopt: a bed of stone
/// @param wanted the file; nullopt: the campaign's name with _diagnosis.h5
int diagnose_command(const CommonOptions& options, DiagnosisRequest request, const std::optional<std::string>& study,
                     const std::optional<std::string>& wanted);
/// @param seconds for all of it   @param markdown only the rows of the table of speeds
int bench_command(const CommonOptions& options, double seconds, bool markdown);
/// @param file measured data, outcomes or results; nullopt: about the program
/// @param mpi of this program (`mpi_library`)
int info_command(const CommonOptions& options, const std::optional<std::string>& file, bool all,
                 const std::optional<std::string>& mpi);
/// @param wanted_file the study file, or the campaign's folder; nullopt: KIND.toml, or "campaign"
int new_command(const CommonOptions& options, const NewStudyOptions& wanted,
                const std::optional<std::string>& wanted_file);
/// Prints the JSON Schema of the study file, or its reference page. @param markdown the page
int schema_command(bool markdown);
/// @param study to begin from; nullopt: by the specimen
/// @param output results; nullopt: by the name of the measured file
int calibrate_command(const CommonOptions& options, CalibrationRequest request, const std::optional<std::string>& study,
                      const std::optional<std::string>& output);

/// The verbs that answer an engineer's questions, with their options: compare, risk, past.
class DecisionVerbs {
public:
    /// @param app, options, status of the command line; must outlive it
    DecisionVerbs(CLI::App& app, CommonOptions& options, int& status) : app_(app), options_(options), status_(status) {}

    void add_compare();
    void add_past();
    void add_risk();

private:
    CLI::App& app_;
    CommonOptions& options_;
    int& status_;
    ComparisonRequest compare_;
    RiskRequest risk_;
    bool search_ = false;
    std::optional<std::string> output_;
    std::vector<std::string> files_;
};

} // namespace stylobate
