#include "studies/cli/command.hpp"

#include "io/study/study_file.hpp"
#include "studies/workflow/file_kind.hpp"

#include <CLI/CLI.hpp>

namespace stylobate {

std::optional<Study> start_study(const CommonOptions& options, const std::string& measured, const char* verb,
                                 const std::optional<std::string>& study)
{
    check_kind(measured, verb);
    if (!study)
        return std::nullopt;
    check_option_kind(*study, FileKind::study, "--study");
    return read_study(*study, options.set);
}

int report_invalid(const std::optional<std::string>& message)
{
    if (!message)
        return exit_done;
    say_error(*message);
    return exit_invalid;
}

void print_written(const CommonOptions& options, const std::string& file)
{
    print(
        options, [&] { return file + "\n"; }, [&] { return Json::object().member("written", file); });
}

void add_set(CLI::App& verb, CommonOptions& options)
{
    add_repeated(verb, "--set", options.set,
                 "KEY=VALUE: overrides any key of the study file; may be given several times", "KEY=VALUE");
}

void add_common(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends)
{
    verb.add_option("--threads", options.threads, "threads to use (default: all that the process may use)")
        ->check(CLI::Range(1, 4096));
    verb.add_option("--simd", options.simd, "instruction set")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    verb.add_option("--backend", options.backend, "device that computes")
        ->check(CLI::IsMember(backends))
        ->capture_default_str();
    verb.add_flag("--quiet", options.quiet, "print results and errors only: no progress, notes and warnings");
    verb.add_flag("--json", options.json, "a machine-readable summary on standard output");
}

void add_force(CLI::App& verb, CommonOptions& options)
{
    verb.add_flag("--force", options.force, "overwrite existing output files");
}

void add_all(CLI::App& verb, CommonOptions& options, const std::vector<std::string>& backends)
{
    add_force(verb, options);
    add_set(verb, options);
    add_common(verb, options, backends);
}

CLI::Option* add_word(CLI::App& verb, const std::string& name, std::optional<std::string>& into,
                      const std::string& text)
{
    const auto keep = [&into](const std::string& word) {
        if (!word.empty())
            into = word;
    };
    return verb.add_option_function<std::string>(name, keep, text);
}

CLI::Option* add_repeated(CLI::App& verb, const std::string& name, std::vector<std::string>& into,
                          const std::string& text, const char* word)
{
    return verb.add_option(name, into, text)->type_name(word)->take_all()->allow_extra_args(false);
}

} // namespace stylobate
