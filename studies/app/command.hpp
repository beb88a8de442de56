#pragma once
/// The verbs of the command line and the options that they share.

#include "ensemble/run/executor.hpp"
#include "kernels/isa.hpp"
#include "studies/app/choose_realization.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stylobate {

/// Exit statuses of the command line.
enum Exit : int { exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_invalid = 3, exit_interrupted = 130 };

struct CommonOptions {
    std::vector<std::string> set; ///< KEY=VALUE, any key of the study file
    int threads = 0;              ///< 0: as many as the process may use
    std::string simd = "auto";
    std::string backend = "cpu";
    bool quiet = false;
    bool json = false;
    bool force = false;     ///< replace files that are there
    Ranks* ranks = nullptr; ///< the processes that run the verb together; null: this one is alone

    /// @throws InputError if the instruction set is unknown, or if this machine lacks it
    Isa isa() const;
    int thread_count() const;
    /// Where and how to run.
    /// @throws InputError as `isa`, or if the backend has no device here
    RunOptions run_options() const;
};

/// @name Options of a verb, read into those that verbs share.
/// @{
void add_set(CLI::App& verb, CommonOptions& options);
/// @param backends where the verb can compute
void add_common(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends = {"cpu"});
void add_force(CLI::App& verb, CommonOptions& options);
/// @}

/// Options of `export`; empty, or -1: not given.
struct ExportOptions {
    std::string format;              ///< "png", "svg" or "pdf" of a picture; "csv", "nrml" or "json" of tables; "vtk"
    std::string picture;             ///< of `picture_names`
    std::string output;              ///< file of the picture, folder of the tables
    std::string limit;               ///< limit state of a surface or slice
    long long realization = -1;      ///< of a strip, or of "vtk"
    long long cell = -1;             ///< of a surface, for the order of falls
    std::vector<double> frequencies; ///< of a slice [Hz]
    std::string title;               ///< of the picture, instead of the study's or the file's name
};

/// Options of `check`.
struct CheckOptions {
    std::optional<std::uint64_t> pilot; ///< realizations that are run twice; 0: none
    double trial_seconds = 2;           ///< of the trial; 0: none
    double law_seconds = 20;            ///< of the pilot under other contact laws; 0: none
    std::string format;                 ///< of the drawing: "png", "svg", "pdf"; empty: by `output`
    std::string output;                 ///< the drawing; empty and no format: none
};

/// Options of `verify-file`.
struct VerifyChoice {
    std::optional<std::uint64_t> replay; ///< realizations that are run again
    std::uint64_t seed = 1;              ///< of their choice
};

/// Options of `report`.
struct ReportOptions {
    std::string output;                    ///< the page; empty: beside the file, with .html
    std::string title;                     ///< of the page, instead of the study's or the file's name
    std::optional<std::uint64_t> animate;  ///< N that fell and N that stood, of each cell
    std::optional<double> animate_mb;      ///< of all animations together [1e6 bytes]
    std::optional<double> animate_seconds; ///< for running them again
};

/// Options of `compare` (studies/app/decisions).
struct CompareOptions {
    std::vector<std::string> files; ///< study files or finished results, the base first; one study file: its [variants]
    std::string output;             ///< the comparison; empty: the base's name with _comparison.h5
    double level = 0.95;            ///< of intervals and verdicts
    std::optional<std::uint64_t> adaptive; ///< pairs of each variant at most, where they are needed; none: all
    double margin = 0.05;                  ///< of an adaptive comparison: a difference that does not matter
    bool search = false;                   ///< for the values of [optimise]
};

/// Options of `calibrate`.
struct CalibrateOptions {
    std::string study;              ///< to begin from; empty: by the specimen (`default_study`)
    std::string output;             ///< results; empty: by the name of the measured file
    std::vector<std::string> fit;   ///< "KEY" or "KEY=FROM:TO", beside the contact's or instead of them
    std::vector<std::string> hold;  ///< keys of the contact that keep the study's value
    std::vector<std::string> forms; ///< contact forms, or "all"; empty: the study's
    bool outcomes = false;          ///< use the outcomes (fell or stood) even where histories are available
    bool held_out = true;           ///< cross-validation over motions
};

/// Options of `diagnose`.
struct DiagnoseOptions {
    long long nulls = 192; ///< healthy campaigns that are simulated near the measured contact law
    long long seed = 1;    ///< of what is drawn in them
};

/// Options of `risk`.
struct RiskCommandOptions {
    std::vector<std::string> hazard; ///< files, or a power law
    std::string site;                ///< of several in the hazard
    std::string output;              ///< the estimate; empty: beside the results, with _risk.h5
    std::string state;               ///< one limit state; empty: all
    std::vector<double> years;       ///< empty: 50 and 100
    double level = 0.9;
    double most_outside = 0.25;      ///< largest share of a frequency from outside of the ranges of runs and hazard
    std::uint64_t sequences = 0;     ///< simulated histories with the damage carried along
    std::optional<double> threshold; ///< of their earthquakes [SI unit of the measure]; none: by the results
    std::optional<double> pause_s;   ///< of rest between earthquakes; none: as long as the structure needs
    std::uint64_t seed = 1;          ///< of the histories
};

/// Options of `new`, in the words of a study file; empty: the default.
struct NewStudyOptions {
    std::string kind, structure, excitation;
};

/// Each verb returns an exit status; bad input is thrown as `InputError`.
/// @param shard "3/8": that part of the study alone; empty: all of it
/// @param laws also under other contact laws
int run_command(const CommonOptions& options, const std::string& study, std::string results, const std::string& shard,
                bool laws);
int merge_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& output,
                  bool partial);
int compare_command(const CommonOptions& options, const CompareOptions& wanted);
int check_command(const CommonOptions& options, const std::string& study, const CheckOptions& wanted);
int verify_command(const CommonOptions& options, const std::string& results, const VerifyChoice& wanted);
int replay_command(const CommonOptions& options, const std::string& results, const RealizationChoice& choice,
                   const std::string& trajectory);
/// @param block "WIDTHxHEIGHT" of a rigid block in metres, for the measures of rocking; empty: none
int record_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& unit,
                   const std::string& component, const std::string& block);
/// The pictures of results of every kind.
std::vector<std::string> picture_names();
/// Of a comparison. @param format "png", "csv", ...   @returns the file
std::string export_comparison(const CommonOptions& options, const std::string& file, const ExportOptions& wanted,
                              const std::string& format);
int export_command(const CommonOptions& options, const std::string& results, const ExportOptions& wanted);
int report_command(const CommonOptions& options, const std::string& file, const ReportOptions& wanted);
/// @param study contacts to begin with; empty: a bed of stone   @param output empty: the campaign's name with
/// _diagnosis.h5
int diagnose_command(const CommonOptions& options, const std::string& measured, const std::string& study,
                     std::string output, const DiagnoseOptions& wanted);
/// @param file measured data, outcomes or results; empty: about the program
/// @param mpi of this program; empty: none
int info_command(const CommonOptions& options, const std::string& file, bool all, const std::string& mpi);
/// Its part about a file: what it is, what it holds, and what can be done with it; as JSON with --json.
/// @throws InputError if there is no such file, if it is damaged, or if its content is wrong
void print_file(const CommonOptions& options, const std::string& file, bool all);
/// @param output the study file; empty: KIND.toml
int new_command(const CommonOptions& options, const NewStudyOptions& wanted, std::string output);
/// @param results of a fragility study
int risk_command(const CommonOptions& options, const std::string& results, const RiskCommandOptions& wanted);
/// Prints the JSON Schema of the study file, or its reference page. @param markdown the page
int schema_command(bool markdown);
/// @param picture of the likelihoods; empty: none
int past_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& picture);
int calibrate_command(const CommonOptions& options, const std::string& measured, const CalibrateOptions& wanted);

} // namespace stylobate
