/// `stylobate_claims`: runs claim files and writes the page of their verdicts.

#include "io/files/atomic_file.hpp"
#include "studies/evidence/claims/claim.hpp"
#include "studies/evidence/claims/claim_page.hpp"
#include "studies/evidence/claims/sample.hpp"
#include "studies/evidence/picture/page_program.hpp"
#include "studies/report/words.hpp"
#include "studies/version.hpp"
#include "studies/workflow/console.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>

using namespace stylobate;
using namespace stylobate::claims;
namespace fs = std::filesystem;

namespace {

struct Options {
    std::vector<std::string> files;
    std::vector<std::string> only;
    std::string page = "claims.md";
    std::string images = "images";
    RunPlace place{"results/claims", ".", 0, {}};
    Machine machine;
    bool quiet = false;
};

/// Keeps the tests that are asked for.
void keep_only(std::deque<ClaimFile>& files, const std::vector<std::string>& only)
{
    if (only.empty())
        return;
    const auto asked = [&](const Test& test) { return std::find(only.begin(), only.end(), test.id) != only.end(); };
    for (const std::string& id : only)
        if (std::none_of(files.begin(), files.end(), [&](const ClaimFile& file) {
                return std::any_of(file.tests.begin(), file.tests.end(), [&](const Test& t) { return t.id == id; });
            }))
            throw InputError(fmt::format("--only {}: no file has this claim", id));
    for (ClaimFile& file : files)
        std::erase_if(file.tests, [&](const Test& test) { return !asked(test); });
    std::erase_if(files, [](const ClaimFile& file) { return file.tests.empty(); });
}

int run(const Options& o)
{
    std::deque<ClaimFile> files;
    for (const std::string& file : o.files)
        files.push_back(read_claims(file));
    keep_only(files, o.only);

    const RunOptions options{o.machine.isa(), o.machine.thread_count()};
    std::deque<std::vector<Sample>> samples;
    std::vector<Result> results;
    const auto start = std::chrono::steady_clock::now();
    for (const ClaimFile& file : files) {
        const std::vector<Levels> planned = variants(file.axes);
        {
            RunPlace place = o.place;
            if (!o.quiet)
                place.begins = [&](const Levels& levels) {
                    fmt::print(stderr, "{} {}/{}: {}\n", file.name,
                               std::find(planned.begin(), planned.end(), levels) - planned.begin() + 1, planned.size(),
                               variant_text(file.axes, levels));
                };
            Console console(o.quiet);
            console.begin();
            samples.push_back(run_variants(file, place, options, console));
        }
        if (samples.back().size() < planned.size()) {
            fmt::print(stderr, "Interrupted. The same command continues the run.\n");
            return exit_interrupted;
        }
        for (const Test& test : file.tests) {
            Result result = judged(file, test, samples.back());
            if (!o.quiet)
                fmt::print("{:5} {}\n", test.id, to_string(result.verdict.judgement));
            results.push_back(std::move(result));
        }
        if (!o.quiet)
            fmt::print(stderr, "{}: {} variants, {} since the start\n", file.name, planned.size(),
                       duration_text(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
        std::fflush(stdout);
    }

    const fs::path page = fs::absolute(o.page), images = fs::absolute(o.images);
    fs::create_directories(page.parent_path());
    fs::create_directories(images);
    for (std::size_t i = 0; i < files.size(); ++i)
        for (const Figure& figure : files[i].figures)
            draw_figure(files[i], figure, curves_of(files[i], figure, samples[i]), images / (figure.name + ".png"));
    write_whole(page, claims_page(std::move(results), images.lexically_relative(page.parent_path()).generic_string(),
                                  code_version()));
    if (!o.quiet)
        fmt::print("{}\n", o.page);
    return exit_done;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Tests the claims of claim files and writes a page with the verdicts.");
    Options o;
    app.add_option("FILE", o.files, "claim files: studies with a section [claim]")->required();
    app.add_option("--page", o.page, "the page to write")->capture_default_str();
    app.add_option("--images", o.images, "folder for its pictures")->capture_default_str();
    app.add_option("--results", o.place.results, "folder for the result files")->capture_default_str();
    app.add_option("--data", o.place.data, "folder that the records lie in")->capture_default_str();
    app.add_option("--realizations", o.place.realizations, "for a trial: instead of the studies' own number");
    app.add_option("--only", o.only, "claims to test, for example P1,P14a (default: all)")->delimiter(',');
    app.add_option("--threads", o.machine.threads, "threads to use (default: all that the process may use)")
        ->check(CLI::Range(1, 4096));
    app.add_option("--simd", o.machine.simd, "instruction set")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    app.add_flag("--quiet", o.quiet, "no progress: only errors");
    app.set_version_flag("--version", code_version());
    return page_program(app, argc, argv, "stylobate_claims", [&] { return run(o); });
}
