/// The command line.

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "studies/cli/command.hpp"
#include "studies/cluster/mpi_ranks.hpp"
#include "studies/cluster/together.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/results/kept_animations.hpp"
#include "studies/usage/usage.hpp"
#include "studies/version.hpp"
#include "studies/workflow/bench/bench.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>

using namespace stylobate;

namespace {

/// Ends all ranks after an error of this one; the others would wait for it. An error that all ranks find is printed by
/// rank 0: the others wait 2 s before they print theirs.
[[noreturn]] void end_ranks(Ranks& ranks, const std::string& message, int status)
{
    if (!ranks.leads())
        std::this_thread::sleep_for(std::chrono::seconds(2));
    say_error(message);
    ranks.abort(status);
    std::_Exit(status);
}

/// An error of the command line, in the form of all other messages.
std::string usage_message(const CLI::App* app, const CLI::Error& error)
{
    const auto verbs = app->get_subcommands();
    return fmt::format("stylobate: {}\n  stylobate {}--help lists the options.\n", error.what(),
                       verbs.empty() ? "" : verbs.front()->get_name() + " ");
}

/// The command line: each verb with its options, and what they are read into.
class CommandLine {
public:
    CommandLine()
    {
        app_.name("stylobate");
        app_.require_subcommand(1);
        app_.failure_message(usage_message);
        app_.set_version_flag("--version", code_version());
        app_.get_formatter()->column_width(help_column);
        add_run();
        add_merge();
        add_check();
        decisions_.add_compare();
        add_replay();
        add_verify();
        add_record();
        add_calibrate();
        add_diagnose();
        decisions_.add_risk();
        decisions_.add_past();
        add_export();
        add_report();
        add_new();
        add_schema();
        add_info();
        add_bench();
        app_.footer(notes_text(help_column));
        add_texts();
        check_numbers(app_);
    }

    /// Parses the words and runs the verb.
    /// @returns the exit status   @throws InputError and what else a verb throws
    int run(int argc, char** argv)
    {
        std::vector<std::string> words = checked_words(app_, argc, argv);
        std::ranges::reverse(words); // as CLI11 takes them
        try {
            app_.parse(words);
        } catch (const CLI::ParseError& error) {
            refuse_unknown_option(app_);
            return app_.exit(error) == 0 ? exit_done : exit_bad_input;
        }
        return status_;
    }

private:
    static constexpr std::size_t help_column = 34; ///< where the texts begin

    /// Options for the build, hidden from users, who have these texts installed.
    void add_texts()
    {
        const auto print = [this](const char* flag, std::string (*text)(const Usage&)) {
            app_.add_flag_callback(flag,
                                   [this, text] {
                                       fmt::print("{}", text(usage_of(app_)));
                                       throw CLI::Success();
                                   })
                ->group("");
        };
        print("--man", [](const Usage& usage) { return manual_page(usage, code_version()); });
        print("--bash-completion", [](const Usage& usage) { return bash_completion(usage, settable_keys()); });
    }

    void add_check()
    {
        auto* check = app_.add_subcommand(
            "check", "before a run: what will be run, its time, memory and file; where the study is weak; what its "
                     "numerics and its contact law change in its collapse probability; a drawing of the structure");
        check->add_option("STUDY", file_, "study file (TOML)")->required();
        check
            ->add_option("--trial-seconds", check_.trial_seconds,
                         "duration of the trial in seconds; it runs a fair sample of the realizations, from which time "
                         "and results of the run are estimated (0: no trial)")
            ->check(CLI::Range(0.0, 3600.0))
            ->capture_default_str();
        check->add_option("--pilot", check_.pilot,
                          "realizations that are run twice, the second time with finer numerics (default: 1024; 0: "
                          "none)");
        check
            ->add_option("--law-seconds", check_.law_seconds,
                         "most seconds to spend on the pilot under other contact laws, for the band of the collapse "
                         "probability over them (0: none)")
            ->check(CLI::Range(0.0, 86400.0))
            ->capture_default_str();
        add_word(*check, "--to", drawing_.format,
                 "draw the structure to scale with its dimensions: png, svg or pdf (default: by the file "
                 "extension of -o)")
            ->check(CLI::IsMember({"png", "svg", "pdf"}));
        add_word(*check, "-o,--output", drawing_.output,
                 "the drawing (default: the study's name with _structure and the format, here)");
        add_all(*check, options_);
        check->callback([this] { status_ = check_command(options_, file_, check_, drawing_); });
    }

    void add_run()
    {
        auto* run = app_.add_subcommand("run", "run a study; continues an unfinished result of the same study");
        run->add_option("STUDY", file_, "study file (TOML)")->required();
        add_word(*run, "-o,--output", output_, "results file (default: the study's name with .h5)");
        add_word(*run, "--shard", shard_,
                 "K/N: only this part of the realizations, from 1/N to N/N, into its own file; `merge` joins "
                 "the files")
            ->type_name("K/N");
        run->add_flag("--laws", laws_,
                      "also under other contact laws, on the same draws: softer, stiffer and rigid contacts, dashpots "
                      "at the ends; the band of the probabilities goes into RESULTS_laws.h5")
            ->excludes("--shard");
        add_set(*run, options_);
        add_common(*run, options_, {"cpu", "cuda"});
        add_mpi(*run)->excludes("--shard")->excludes("--laws");
        run->callback([this] { on_ranks([this] { return run_command(options_, file_, output_, shard_, laws_); }); });
    }

    CLI::Option* add_mpi(CLI::App& verb)
    {
        return verb.add_flag("--mpi", mpi_,
                             "share the work among the processes of `mpirun -n N stylobate ... --mpi`; --threads is "
                             "that of each");
    }

    /// Runs a verb, with `--mpi` by all ranks: one message and one exit status.
    template <class F>
    void on_ranks(const F& verb)
    {
        if (!mpi_) {
            status_ = verb();
            return;
        }
        const std::unique_ptr<Ranks> ranks = mpi_ranks();
        options_.ranks = ranks.get();
        try {
            status_ = verb();
        } catch (const AllRefused& refused) {
            if (ranks->leads())
                say_error(refused.what());
            status_ = exit_bad_input;
        } catch (const InputError& error) {
            end_ranks(*ranks, error.what(), exit_bad_input);
        } catch (const std::exception& error) {
            end_ranks(*ranks, error.what(), exit_failed);
        }
        options_.ranks = nullptr;
        status_ = std::stoi(ranks->of_first(std::to_string(status_)));
    }

    void add_merge()
    {
        auto* merge = app_.add_subcommand("merge", "join the results of shards of a study into one file");
        merge->add_option("SHARD", files_, "results files of `run --shard`, or of earlier merges")->required();
        merge->add_option("-o,--output", output_, "results file")->required();
        merge->add_flag("--partial", partial_, "accept missing realizations; `run` can continue the file");
        add_all(*merge, options_);
        merge->callback([this] { status_ = merge_command(options_, files_, *output_, partial_); });
    }

    void add_replay()
    {
        auto* replay = app_.add_subcommand("replay", "repeat one realization of a result and compute its trajectory");
        replay->add_option("RESULTS", file_, "results file (HDF5)")->required();
        replay->add_option("--realization", choice_.index, "its index");
        replay->add_option("--frequency", choice_.cells.frequency_hz,
                           "surface: frequency of the cell, nearest value [Hz]");
        replay->add_option("--direction", choice_.cells.direction_deg,
                           "surface over directions: that of the cell, nearest value [degrees]");
        replay->add_option("--pga", choice_.cells.pga_m_s2, "surface: PGA of the cell, nearest value [m/s2]");
        add_word(*replay, "--motion", choice_.cells.motion, "fragility study: name or number (from 0) of the motion");
        replay->add_option("--intensity", choice_.cells.intensity, "fragility study: intensity level, nearest value");
        replay->add_flag("--fallen", choice_.fallen, "select a realization that fell");
        replay->add_flag("--stood", choice_.stood, "select a realization that did not fall");
        replay->add_option("--nth", choice_.nth,
                           "which of the selected ones, in the order of their indices, from 1 (default: 1)");
        add_word(*replay, "-o,--output", output_, "results file for the trajectory (default: not kept)");
        add_all(*replay, options_);
        replay->callback([this] { status_ = replay_command(options_, file_, choice_, output_); });
    }

    void add_verify()
    {
        auto* verify = app_.add_subcommand(
            "verify-file", "verify a result: its checksums, its values against each other and against the study, and "
                           "some realizations by running them again");
        verify->add_option("RESULTS", file_, "results file (HDF5)")->required();
        verify->add_option("--replay", verify_.replay,
                           "realizations to run again, spread over the cells (default: 20; 0: none)");
        verify->add_option("--seed", verify_.seed, "seed of their choice")->capture_default_str();
        add_set(*verify, options_);
        add_common(*verify, options_);
        verify->callback([this] { status_ = verify_command(options_, file_, verify_); });
    }

    void add_record()
    {
        auto* record = app_.add_subcommand("record", "read ground motions: format, PGA, duration, frequencies, ...");
        record->add_option("FILE", files_, "records of any known format")->required();
        add_word(*record, "--unit", unit_,
                 "unit of the acceleration if the file does not give it: m/s2, cm/s2, mm/s2, g, g/10");
        add_word(*record, "--component", component_,
                 "component to read: its name, its orientation, or its column counted from 1");
        add_word(*record, "--block", block_,
                 "WIDTHxHEIGHT of a rigid block in metres, such as 1x4.4: adds the measures of its rocking");
        add_common(*record, options_);
        record->callback([this] { status_ = record_command(options_, files_, unit_, component_, block_); });
    }

    void add_calibrate()
    {
        auto* calibrate = app_.add_subcommand("calibrate", "contact parameters from measured response, with intervals");
        calibrate
            ->add_option("MEASURED", calibration_.measured,
                         "measured campaign (HDF5, or a folder of CSV files), or a table of outcomes (CSV)")
            ->required();
        add_word(*calibrate, "--study", study_,
                 "start study (default: the specimen, nominal friction, a bed of 2e9 N/m3; required for a "
                 "table of outcomes)");
        add_word(*calibrate, "-o,--output", output_, "results (HDF5); the calibrated study is written beside it");
        add_repeated(*calibrate, "--fit", calibration_.fit,
                     "KEY or KEY=FROM:TO: an additional number of the study file to fit; may be given several times",
                     "KEY");
        add_repeated(*calibrate, "--hold", calibration_.hold,
                     "KEY: a contact parameter to keep fixed; may be given several times", "KEY");
        const std::vector<std::string> forms = words_of(contact_form_names);
        std::vector<std::string> with_all = forms;
        with_all.emplace_back("all");
        calibrate
            ->add_option("--form", calibration_.forms, fmt::format("contact forms: {}, or all", fmt::join(forms, ", ")))
            ->delimiter(',')
            ->check(CLI::IsMember(with_all));
        calibrate->add_flag("--outcomes", calibration_.outcomes,
                            "use the outcomes (fell or stood) even where histories are available");
        calibrate->add_flag("--no-held-out", keep_all_, "omit the cross-validation over motions");
        add_all(*calibrate, options_);
        add_mpi(*calibrate);
        calibrate->callback([this] {
            calibration_.held_out = !keep_all_;
            on_ranks([this] { return calibrate_command(options_, calibration_, study_, output_); });
        });
    }

    void add_diagnose()
    {
        auto* diagnosing = app_.add_subcommand(
            "diagnose",
            "find the errors of the simulation of measured data, their cause, an extended model and its gain");
        diagnosing->add_option("MEASURED", diagnosis_.measured, "measured campaign (HDF5, or a folder of CSV files)")
            ->required();
        add_word(*diagnosing, "--study", study_, "study file with the initial contacts (default: a bed of stone)");
        add_word(*diagnosing, "-o,--output", output_,
                 "file of the diagnosis (default: the campaign's name with _diagnosis.h5)");
        diagnosing
            ->add_option("--nulls", nulls_,
                         "number of simulated healthy campaigns near the measured contact law; the others are in "
                         "proportion. 0: none; only direct tests of base and sensors can name a cause. Below "
                         "about 50 no cause of joints and blocks can be significant")
            ->check(CLI::Range(0LL, 10000LL))
            ->capture_default_str();
        diagnosing
            ->add_option(
                "--specimens", specimens_,
                "number of simulated healthy specimens that go through tests of single joints, with --plan and "
                "where the campaign has such tests")
            ->check(CLI::Range(40LL, 10000LL))
            ->capture_default_str();
        diagnosing
            ->add_option("--tests", diagnosis_.tests,
                         "files with tests of its joints that are not in MEASURED, in the order in which they "
                         "were done")
            ->type_name("FILE...");
        diagnosing->add_flag("--plan", diagnosis_.plan,
                             "propose tests of single joints: the three that tell most. Shake runs are not needed");
        diagnosing->add_option("--seed", seed_, "seed of the simulated campaigns")
            ->check(CLI::Range(0LL, 999999999999LL))
            ->capture_default_str();
        add_all(*diagnosing, options_);
        add_mpi(*diagnosing);
        diagnosing->callback([this] {
            diagnosis_.nulls = static_cast<std::uint64_t>(nulls_);
            diagnosis_.specimens = static_cast<std::uint64_t>(specimens_);
            diagnosis_.seed = static_cast<std::uint64_t>(seed_);
            on_ranks([this] { return diagnose_command(options_, diagnosis_, study_, output_); });
        });
    }

    void add_export()
    {
        const std::vector<std::string> pictures = picture_names();
        auto* exporting = app_.add_subcommand("export", "write a result in other formats");
        exporting->add_option("RESULTS", file_, "results file or risk estimate (HDF5)")->required();
        add_word(*exporting, "--to", export_.format,
                 "picture: png, svg or pdf; tables: csv, for fragility studies also nrml or json; vtk: a "
                 "realization for ParaView; one "
                 "realization in motion: html, or by ffmpeg gif, mp4 or webm (default: by the file extension "
                 "of -o)")
            ->check(CLI::IsMember({"png", "svg", "pdf", "csv", "nrml", "json", "vtk", "html", "gif", "mp4", "webm"}));
        add_word(*exporting, "--picture", export_.picture,
                 fmt::format("{} (default: by the kind of the study)", fmt::join(pictures, ", ")))
            ->check(CLI::IsMember(pictures));
        add_word(*exporting, "--limit", export_.limit,
                 "surface, slice: collapse, total, unseated, rocked or slid (default: collapse); fragility: a limit "
                 "state of the study (default: peaks and collapse)");
        exporting
            ->add_option("--realization", export_.realization,
                         "strip, vtk, motion: index of the realization (default: 0)")
            ->check(CLI::Range(0LL, 999999999999LL));
        exporting->add_option("--cell", export_.cell, "order: one cell of a surface (default: all cells)")
            ->check(CLI::Range(0LL, 999999999999LL));
        exporting
            ->add_option(
                "--frequency", export_.frequencies,
                "slice: frequencies in Hz, within the axis; the nearest ones of the axis are drawn (default: three)")
            ->delimiter(',');
        exporting
            ->add_option("--direction", export_.directions,
                         "slice of a surface over directions: these, in degrees, in the place of --frequency")
            ->delimiter(',')
            ->excludes("--frequency");
        add_word(*exporting, "--title", export_.title,
                 "title of the picture (default: study.title, or the file's name)");
        add_word(*exporting, "-o,--output", export_.output,
                 "the picture, with a file extension for the format (.png, .svg, .pdf), or the folder of "
                 "the tables or of vtk");
        add_all(*exporting, options_);
        exporting->callback([this] { status_ = export_command(options_, file_, export_); });
    }

    void add_report()
    {
        auto* report = app_.add_subcommand(
            "report",
            "one self-contained page of a result, a comparison, a diagnosis, a calibration or a risk estimate");
        report
            ->add_option("FILE", report_.file,
                         "results file, comparison, diagnosis, calibration or risk estimate (HDF5)")
            ->required();
        add_word(*report, "-o,--output", output_,
                 "the page, .html, or its texts and tables as Markdown, .md, or JSON, .json (default: the file's name "
                 "with .html)");
        add_word(*report, "--web", report_.web,
                 "address of the page of docs/browser.md (scripts/web.sh): the page links to it with its study");
        add_word(*report, "--title", report_.title, "title of the page (default: study.title, or the file's name)");
        report
            ->add_option(
                "--animate", report_.animate,
                "realizations in motion: N that fell and N that stood, of each cell of a surface that has both, and "
                "one of each other cell (default: 1; 0: none)")
            ->check(CLI::Range(0LL, 1000LL));
        report
            ->add_option(
                "--animate-mb", report_.animate_mb,
                fmt::format("megabytes of the page for all animations together (default: {:g})", usual_animation_mb))
            ->check(CLI::Range(1e-6, 1000.0));
        report
            ->add_option(
                "--animate-seconds", report_.animate_seconds,
                fmt::format("seconds to spend on running realizations again (default: {:g})", usual_animation_seconds))
            ->check(CLI::Range(0.0, 1e6));
        add_all(*report, options_);
        report->callback([this] { status_ = report_command(options_, report_, output_); });
    }

    template <class List>
    static std::vector<std::string> words_of(const List& names)
    {
        std::vector<std::string> words;
        for (const auto& name : names)
            words.emplace_back(name.word);
        return words;
    }

    /// A structure where the kind of a study belongs: empty, or what to write instead.
    static std::string structure_as_kind(const std::string& word)
    {
        const std::vector<std::string> structures = words_of(structure_kind_names);
        return std::ranges::find(structures, word) == structures.end()
                   ? ""
                   : fmt::format("{0} is a structure, not a kind of study: for example `stylobate new surface "
                                 "--structure {0}`",
                                 word);
    }

    void add_new()
    {
        auto* begin =
            app_.add_subcommand("new", "write a commented study file, or a campaign of measured data, to begin with");
        std::vector<std::string> kinds = words_of(study_kind_names), tests;
        for (const RunKind kind : run_kinds)
            tests.emplace_back(to_string(kind));
        kinds.emplace_back(new_campaign_word);
        begin
            ->add_option("KIND", new_.kind,
                         fmt::format("kind of the study: {}; or {}, a folder for measured data",
                                     fmt::join(words_of(study_kind_names), ", "), new_campaign_word))
            ->required()
            ->check(structure_as_kind)
            ->check(CLI::IsMember(kinds));
        add_word(*begin, "--test", new_.test,
                 fmt::format("campaign: kind of its run: {} (default: shake)", fmt::join(tests, ", ")))
            ->check(CLI::IsMember(tests));
        add_word(*begin, "--structure", new_.structure, "column or colonnade (default: column)")
            ->check(CLI::IsMember(words_of(structure_kind_names)));
        begin->add_option("--dimensions", new_.dimensions, "2: in the plane, 3: in space (default: 2)")
            ->check(CLI::IsMember({2, 3}));
        add_word(*begin, "--excitation", new_.excitation,
                 fmt::format("{} (default: harmonic; for a fragility study noise)",
                             fmt::join(words_of(excitation_kind_names), ", ")))
            ->check(CLI::IsMember(words_of(excitation_kind_names)));
        add_word(*begin, "-o,--output", output_, "the study file (default: KIND.toml), or the campaign's folder");
        begin->add_flag("--quiet", options_.quiet, "print the name of the file only");
        add_force(*begin, options_);
        begin->callback([this] { status_ = new_command(options_, new_, output_); });
    }

    void add_schema()
    {
        auto* schema = app_.add_subcommand("schema", "print a JSON Schema of the study file, for editors");
        schema->add_flag("--markdown", markdown_, "print the reference page instead: every key with its meaning");
        schema->callback([this] { status_ = schema_command(markdown_); });
    }

    void add_info()
    {
        auto* info =
            app_.add_subcommand("info", "print version, instruction sets and threads, or the content of a file");
        add_word(
            *info, "FILE", asked_,
            "any file that stylobate reads: a study, results, a replay, a diagnosis, a calibration, a risk estimate, "
            "measured data (HDF5, "
            "folder), measured outcomes (CSV), a record");
        info->add_flag("--all", all_, "print every note on measured data, not one of each kind");
        add_set(*info, options_);
        add_common(*info, options_);
        info->callback([this] { status_ = info_command(options_, asked_, all_, mpi_library()); });
    }

    void add_bench()
    {
        auto* bench = app_.add_subcommand(
            "bench", "measure the speed of this machine: the rows of the table of speeds, and whole ensembles of "
                     "other structures, with one thread and with all; writes no file");
        bench->add_option("--seconds", bench_.seconds, "time for all measurements; each is made once at least")
            ->capture_default_str();
        auto* rows = bench->add_flag("--markdown", markdown_,
                                     "print the rows of the table of speeds alone, in Markdown: the best of the "
                                     "repeats, as in README.md");
        add_common(*bench, options_);
        rows->excludes("--json");
        bench->callback([this] { status_ = bench_command(options_, bench_.seconds, markdown_); });
    }

    CLI::App app_{"Stylobate: ensembles of rocking and sliding multi-drum columns, in SIMD lockstep."};
    CommonOptions options_;
    CheckRequest check_;
    BenchRequest bench_;
    DrawingOptions drawing_;
    VerifyChoice verify_;
    int status_ = exit_done;
    DecisionVerbs decisions_{app_, options_, status_};

    std::string file_;                          // input of a verb
    std::optional<std::string> study_, output_; // its study, its output
    std::optional<std::string> asked_;          // input of info
    RealizationChoice choice_;
    std::vector<std::string> files_;
    std::optional<std::string> shard_;
    bool partial_ = false, mpi_ = false, laws_ = false, all_ = false;
    std::optional<std::string> unit_, component_, block_;
    CalibrationRequest calibration_;
    bool keep_all_ = false;
    DiagnosisRequest diagnosis_;
    long long nulls_ = 192, specimens_ = 128, seed_ = 1;
    ExportOptions export_;
    NewStudyOptions new_;
    bool markdown_ = false;
    PageRequest report_;
};

/// Ends with a message on standard error. Nothing runs at the exit: a file that could not be written whole is still
/// open in the HDF5 library, which would write it again and break.
[[noreturn]] void end_with(const std::string& message, int status)
{
    say_error(message);
    std::fflush(stdout);
    std::_Exit(status);
}

/// Prepares the standard streams and signals. A closed descriptor of a standard stream would be reused by the next file
/// that is opened, and messages would be written into results; it is opened on /dev/null instead, so that writing to
/// the output fails and errors are lost. A file beyond the size limit of the process (ulimit -f) gives a message, no
/// signal.
void prepare_process()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0)
            continue; // no stream is left for a message
    std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace

int main(int argc, char** argv)
{
    prepare_process();
    try {
        const int status = CommandLine().run(argc, argv);
        if (std::fflush(stdout) != 0)
            throw std::system_error(errno, std::generic_category(), "standard output cannot be written");
        return status;
    } catch (const InputError& error) {
        end_with(error.what(), exit_bad_input);
    } catch (const std::exception& error) {
        end_with(error.what(), exit_failed);
    }
}
