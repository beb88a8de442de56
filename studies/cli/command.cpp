#include "studies/cli/command.hpp"

#include "io/study/study_file.hpp"
#include "studies/workflow/file_kind.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace stylobate {

namespace {

constexpr std::pair<std::string_view, ProgressStyle> progress_styles[] = {{"auto", ProgressStyle::automatic},
                                                                          {"plain", ProgressStyle::plain},
                                                                          {"json", ProgressStyle::json},
                                                                          {"none", ProgressStyle::none}};

std::vector<std::string> progress_words()
{
    std::vector<std::string> words;
    for (const auto& [word, style] : progress_styles)
        words.emplace_back(word);
    return words;
}

} // namespace

Console CommonOptions::console(const char* verb) const
{
    if (!leads())
        return Console(true, ProgressStyle::none, verb);
    const auto* chosen =
        std::ranges::find(progress_styles, progress, &std::pair<std::string_view, ProgressStyle>::first);
    return Console(quiet, chosen->second, verb);
}

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
    verb.add_option("--progress", options.progress,
                    "progress on standard error: auto, one line that is rewritten on a terminal and plain lines "
                    "elsewhere; plain, a line every ten seconds; json, an object a line every second, notes and "
                    "warnings too; none")
        ->check(CLI::IsMember(progress_words()))
        ->capture_default_str();
    verb.add_flag(
        "--quiet", options.quiet,
        "print results and errors only: no notes and warnings, and no progress unless --progress asks for it");
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
