/// The command line.

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "studies/app/command.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <system_error>

using namespace stylobate;

namespace {

void add_set(CLI::App& verb, CommonOptions& options)
{
    verb.add_option("--set", options.set, "KEY=VALUE: any key of the study file; may be given several times")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->allow_extra_args(false);
}

/// @param backends where the verb can compute
void add_common(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends = {"cpu"})
{
    verb.add_option("--threads", options.threads, "threads to use (default: all that the process may use)")
        ->check(CLI::Range(1, 4096));
    verb.add_option("--simd", options.simd, "instruction set")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    verb.add_option("--backend", options.backend, "where to compute")
        ->check(CLI::IsMember(backends))
        ->capture_default_str();
    verb.add_flag("--quiet", options.quiet, "no progress, no words: only results and errors");
    verb.add_flag("--json", options.json, "a machine-readable summary on standard output");
}

void add_force(CLI::App& verb, CommonOptions& options)
{
    verb.add_flag("--force", options.force, "replace what is there under the names of the outputs");
}

/// CLI11 would say of an unknown verb only that one is missing.
/// @throws InputError if the first word is no verb, or if there is none
void check_verb(const CLI::App& app, int argc, char** argv)
{
    const std::string word = argc > 1 ? argv[1] : "";
    std::vector<std::string> verbs;
    std::string list;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        verbs.push_back(verb->get_name());
        list += (list.empty() ? "" : ", ") + verbs.back();
    }
    if (word.starts_with('-') || std::find(verbs.begin(), verbs.end(), word) != verbs.end())
        return;
    const std::string meant = nearest_word(word, verbs);
    throw InputError(fmt::format("{}; the verbs are {}.\n  {}",
                                 word.empty() ? "no verb is given" : "'" + word + "' is no verb", list,
                                 meant.empty() ? "stylobate --help says more." : "Did you mean " + meant + "?"));
}

/// One message in the manner of all others.
std::string usage_message(const CLI::App* app, const CLI::Error& error)
{
    const auto verbs = app->get_subcommands();
    return fmt::format("stylobate: {}\n  stylobate {}--help says more.\n", error.what(),
                       verbs.empty() ? "" : verbs.front()->get_name() + " ");
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Stylobate: ensembles of rocking and sliding multi-drum columns, in SIMD lockstep.");
    app.require_subcommand(1);
    app.failure_message(usage_message);
    app.set_version_flag("--version", code_version());
    app.get_formatter()->column_width(34);
    CommonOptions options;
    int status = exit_done;

    std::string study, results;
    auto* run = app.add_subcommand("run", "run a study; continues an unfinished result of the same study");
    run->add_option("STUDY", study, "study file (TOML)")->required();
    run->add_option("-o,--output", results, "results file (default: the study's name with .h5)");
    add_set(*run, options);
    add_common(*run, options, {"cpu", "cuda"});
    run->callback([&] { status = run_command(options, study, results); });

    std::string trajectory;
    RealizationChoice choice;
    auto* replay = app.add_subcommand("replay", "run one realization of a result again, with its trajectory");
    replay->add_option("RESULTS", results, "results file (HDF5)")->required();
    replay->add_option("--realization", choice.index, "its index");
    replay->add_option("--frequency", choice.frequency_hz, "instead, of a surface: the cell nearest to it [Hz]");
    replay->add_option("--pga", choice.pga_m_s2, "of a surface: the cell nearest to it [m/s2]");
    replay->add_option("--motion", choice.motion, "of a fragility study: name or number (from 0) of its motion");
    replay->add_option("--intensity", choice.intensity, "of a fragility study: the level nearest to it");
    replay->add_flag("--fallen", choice.fallen, "one that fell");
    replay->add_flag("--stood", choice.stood, "one that did not fall");
    replay->add_option("--nth", choice.nth, "which of those, in the order of their indices, from 1 (default: 1)");
    replay->add_option("-o,--output", trajectory, "results file for the trajectory (default: none is kept)");
    add_force(*replay, options);
    add_set(*replay, options);
    add_common(*replay, options);
    replay->callback([&] { status = replay_command(options, results, choice, trajectory); });

    std::vector<std::string> files;
    std::string unit, component, block;
    auto* record = app.add_subcommand("record", "read ground motions: format, PGA, duration, frequencies, ...");
    record->add_option("FILE", files, "records of any known format")->required();
    record->add_option("--unit", unit,
                       "unit of the acceleration where the file does not say it: m/s2, cm/s2, mm/s2, g, g/10");
    record->add_option("--component", component,
                       "one component: its name, its orientation, or its column counted from 1");
    record->add_option("--block", block,
                       "WIDTHxHEIGHT of a rigid block in metres, such as 1x4.4: adds the measures of its rocking");
    add_common(*record, options);
    record->callback([&] { status = record_command(options, files, unit, component, block); });

    std::string measured;
    CalibrateOptions calibration;
    bool keep_all = false;
    auto* calibrate = app.add_subcommand("calibrate", "contact parameters from measured response, with intervals");
    calibrate
        ->add_option("MEASURED", measured,
                     "measured campaign (HDF5, or a folder of CSV files), or a table of outcomes (CSV)")
        ->required();
    calibrate->add_option("--study", calibration.study,
                          "study file to begin from (default: the specimen, nominal friction, a bed of 2e9 N/m3; a "
                          "table of outcomes needs one)");
    calibrate->add_option("-o,--output", calibration.output, "results (HDF5); the calibrated study lies beside it");
    calibrate
        ->add_option("--fit", calibration.fit,
                     "KEY or KEY=FROM:TO: a number of the study file to fit too; several times")
        ->type_name("KEY")
        ->take_all()
        ->allow_extra_args(false);
    calibrate->add_option("--hold", calibration.hold, "KEY: a contact parameter that keeps its value; several times")
        ->type_name("KEY")
        ->take_all()
        ->allow_extra_args(false);
    calibrate->add_option("--form", calibration.forms, "contact forms: area, two_corner, points, or all")
        ->delimiter(',')
        ->check(CLI::IsMember({"area", "two_corner", "points", "all"}));
    calibrate->add_flag("--outcomes", calibration.outcomes,
                        "use who fell and who stood even where there are histories");
    calibrate->add_flag("--no-held-out", keep_all, "do not predict each motion by what the others say");
    add_force(*calibrate, options);
    add_set(*calibrate, options);
    add_common(*calibrate, options);
    calibrate->callback([&] {
        calibration.held_out = !keep_all;
        status = calibrate_command(options, measured, calibration);
    });

    long long nulls = 32, seed = 1;
    bool windows = false;
    auto* diagnosing = app.add_subcommand("diagnose", "what the simulation gets wrong of measured data, the cause, the "
                                                      "extended model, the gain");
    diagnosing->add_option("MEASURED", measured, "measured campaign (HDF5, or a folder of CSV files)")->required();
    diagnosing->add_option("--study", study, "study file with the contacts to begin with (default: a bed of stone)");
    diagnosing->add_option("-o,--output", results,
                           "file of the diagnosis (default: the campaign's name with _diagnosis.h5)");
    diagnosing
        ->add_option("--nulls", nulls, "campaigns with nothing hidden that are simulated to learn what chance gives")
        ->check(CLI::Range(0LL, 10000LL))
        ->capture_default_str();
    diagnosing->add_option("--seed", seed, "of what is drawn in them")
        ->check(CLI::Range(0LL, 999999999999LL))
        ->capture_default_str();
    diagnosing->add_flag("--windows", windows,
                         "let free windows of the simulation judge causes too: slow, and less sure than the balance of "
                         "forces");
    add_force(*diagnosing, options);
    add_set(*diagnosing, options);
    add_common(*diagnosing, options);
    diagnosing->callback([&] { status = diagnose_command(options, measured, study, results, nulls, seed, windows); });

    ExportOptions wanted;
    auto* exporting = app.add_subcommand("export", "write a result in other formats");
    exporting->add_option("RESULTS", results, "results file (HDF5)")->required();
    exporting
        ->add_option("--to", wanted.format,
                     "a picture: png, svg or pdf; tables: csv, or of fragility studies nrml or json (default: by the "
                     "ending of -o)")
        ->check(CLI::IsMember({"png", "svg", "pdf", "csv", "nrml", "json"}));
    exporting
        ->add_option("--picture", wanted.picture,
                     "surface, slice, twins, predictability, fragility, sensitivity, rare, strip or order (default: by "
                     "the kind of the study)")
        ->check(CLI::IsMember(
            {"surface", "slice", "twins", "predictability", "fragility", "sensitivity", "rare", "strip", "order"}));
    exporting->add_option(
        "--limit", wanted.limit,
        "surface, slice: collapse, total, unseated, rocked or slid (default: collapse); fragility: a limit "
        "state of the study (default: peaks and collapse)");
    exporting->add_option("--realization", wanted.realization, "strip: which one (default: 0)")
        ->check(CLI::Range(0LL, 999999999999LL));
    exporting->add_option("--cell", wanted.cell, "order: one cell of a surface (default: all of them)")
        ->check(CLI::Range(0LL, 999999999999LL));
    exporting
        ->add_option("--frequency", wanted.frequencies,
                     "slice: frequencies in Hz, within the axis; the nearest ones of it are drawn (default: three)")
        ->delimiter(',');
    exporting->add_option("--title", wanted.title, "of the picture (default: by study.title, or the file's name)");
    exporting->add_option("-o,--output", wanted.output,
                          "the picture, whose ending says its format (.png, .svg, .pdf), or the folder of the tables");
    add_force(*exporting, options);
    add_set(*exporting, options);
    add_common(*exporting, options);
    exporting->callback([&] { status = export_command(options, results, wanted); });

    std::string page, title;
    auto* report = app.add_subcommand("report", "one self-contained page of a result, a diagnosis or a calibration");
    report->add_option("FILE", results, "results file, diagnosis or calibration (HDF5)")->required();
    report->add_option("-o,--output", page, "the page, .html (default: the file's name with that ending)");
    report->add_option("--title", title, "of the page (default: by study.title, or the file's name)");
    add_force(*report, options);
    add_set(*report, options);
    add_common(*report, options);
    report->callback([&] { status = report_command(options, results, page, title); });

    std::string held;
    auto* info = app.add_subcommand("info", "version, instruction sets, threads; or what a file holds");
    info->add_option(
        "FILE", held,
        "any file that stylobate reads: a study, results, a replay, a diagnosis, a calibration, measured data (HDF5, "
        "folder), measured outcomes (CSV), a record");
    add_set(*info, options);
    add_common(*info, options);
    info->callback([&] { status = info_command(options, held); });

    try {
        check_verb(app, argc, argv);
        app.parse(argc, argv);
        if (std::fflush(stdout) != 0)
            throw std::system_error(errno, std::generic_category(), "standard output cannot be written");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_bad_input;
    } catch (const InputError& error) {
        fmt::print(stderr, "stylobate: {}\n", error.what());
        return exit_bad_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "stylobate: {}\n", error.what());
        return exit_failed;
    }
    return status;
}
