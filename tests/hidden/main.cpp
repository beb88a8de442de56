/// hidden_campaigns: makes virtual shake-table campaigns with hidden effects, and scores diagnoses of them.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_file.hpp"
#include "tests/hidden/joint_test.hpp"
#include "tests/hidden/score/answer.hpp"
#include "tests/hidden/score/coverage.hpp"
#include "tests/hidden/score/detectability.hpp"
#include "tests/hidden/score/score.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

namespace fs = std::filesystem;
using namespace stylobate;
using namespace stylobate::hidden;

namespace {

struct Seeds {
    std::uint64_t first = 0, last = 0;
};

/// "A..B", or one number.
Seeds parse_seeds(const std::string& text)
{
    const std::size_t dots = text.find("..");
    const std::string from = text.substr(0, dots), to = dots == std::string::npos ? from : text.substr(dots + 2);
    Seeds seeds;
    const auto number = [](const std::string& word, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error == std::errc() && end == word.data() + word.size();
    };
    if (!number(from, seeds.first) || !number(to, seeds.last) || seeds.last < seeds.first ||
        seeds.last - seeds.first >= 100000)
        throw InputError(
            "--seeds", 0,
            fmt::format("'{}' is not A..B with whole numbers A <= B < A + 100000.\n  For example 1..60.", text));
    return seeds;
}

void check_effect(const std::string& name)
{
    std::vector<std::string> names = listed_names();
    for (const auto* more : {&variant_names(), &outside_names()})
        names.insert(names.end(), more->begin(), more->end());
    if (std::find(names.begin(), names.end(), name) != names.end())
        return;
    const auto meant = nearest_word(name, names);
    throw InputError(
        "--effect", 0,
        fmt::format("'{}' is not an effect.\n  {}", name,
                    meant ? "Did you mean " + *meant + "?" : fmt::format("They are {}.", fmt::join(names, ", "))));
}

Answer answer_of(const VirtualCampaign& made)
{
    Answer answer;
    answer.seed = made.seed;
    answer.law = made.model.law == Law::nonsmooth ? "nonsmooth" : "compliant";
    answer.specimen = made.planned.specimen.name;
    answer.runs = static_cast<int>(made.runs.size());
    for (int j = 0; j < made.model.bed_count; ++j)
        answer.friction += made.model.beds[static_cast<std::size_t>(j)].friction / made.model.bed_count;
    for (const TrueRun& run : made.runs)
        answer.collapses += run.history.collapsed ? 1 : 0;
    const std::vector<Detectability> seen = detectability_of(made);
    for (std::size_t k = 0; k < made.effects.size(); ++k) {
        const HiddenEffect& effect = made.effects[k];
        answer.effects.push_back({effect.name, effect.listed, effect.place, effect.parameter, effect.size,
                                  effect.size_comparable, seen[k].snr_noise, seen[k].snr_scatter, seen[k].law_share,
                                  seen[k].detectable()});
    }
    return answer;
}

void write_text(const fs::path& path, const std::string& text)
{
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

/// The answer is written last: a campaign that has one is complete, and is not made again.
void generate(const Seeds& seeds, const fs::path& out, const Wish& wish)
{
    std::error_code error;
    fs::create_directories(out / "answers", error);
    if (error)
        throw InputError(out.string(), 0, "the folder cannot be created: " + error.message() + ". Give another one.");
    for (std::uint64_t seed = seeds.first; seed <= seeds.last; ++seed) {
        const fs::path answer = out / "answers" / fmt::format("{}.toml", seed);
        if (fs::exists(answer))
            continue;
        const VirtualCampaign made = make_campaign(seed, wish);
        write_campaign(made.campaign, out / fmt::format("campaign_{}.h5", seed));
        write_text(out / fmt::format("campaign_{}.toml", seed), study_text_of(made.planned));
        write_text(answer, text_of(answer_of(made)));
        fmt::print("campaign {}: {}, {} runs\n", seed, made.planned.specimen.name, made.runs.size());
        std::fflush(stdout);
    }
}

/// The answers of a folder, in the order of their seeds.
std::vector<Answer> answers_of(const fs::path& answers)
{
    if (!fs::is_directory(answers))
        throw InputError(answers.string(), 0,
                         "is not a folder. Give the folder of the answers, DIR/answers of 'generate'.");
    std::vector<Answer> known;
    for (const auto& entry : fs::directory_iterator(answers))
        if (entry.path().extension() == ".toml")
            known.push_back(read_answer(entry.path()));
    if (known.empty())
        throw InputError(answers.string(), 0, "contains no answers (SEED.toml). Give DIR/answers of 'generate'.");
    std::sort(known.begin(), known.end(), [](const Answer& a, const Answer& b) { return a.seed < b.seed; });
    return known;
}

/// What was said of each campaign, in DIR/SEED.json; nothing where there is no such file.
template <class Read>
auto said_of(const std::vector<Answer>& answers, const fs::path& folder, Read&& read)
{
    std::vector<std::optional<decltype(read(folder))>> said;
    for (const Answer& answer : answers) {
        const fs::path file = folder / fmt::format("{}.json", answer.seed);
        said.push_back(fs::exists(file) ? std::optional(read(file)) : std::nullopt);
    }
    return said;
}

void tell(const std::string& text, const std::string& page)
{
    fmt::print("{}", text);
    if (!page.empty())
        write_text(page, text);
}

void score_folder(const fs::path& answers, const fs::path& diagnoses, const std::string& page)
{
    const std::vector<Answer> known = answers_of(answers);
    tell(markdown(score(known, said_of(known, diagnoses, read_diagnosis))), page);
}

void coverage_of_folder(const fs::path& answers, const fs::path& calibrations, const std::string& page)
{
    const std::vector<Answer> known = answers_of(answers);
    tell(markdown(coverage(known, said_of(known, calibrations, read_calibration))), page);
}

/// The shakes of the campaign are done before if they leave something behind.
void do_tests(std::uint64_t seed, Wish wish, const fs::path& plan, const fs::path& out)
{
    const Campaign planned = read_campaign(plan);
    Wish brief = wish;
    brief.most_motions = 0;
    VirtualCampaign made = make_campaign(seed, brief);
    if (made.model.effects.persists)
        made = make_campaign(seed, wish);
    const Campaign done = tested(made, planned);
    write_campaign(done, out);
    for (const MeasuredRun& run : done.tests)
        fmt::print("run {}: {}{}\n", run.name, to_string(run.test),
                   run.collapsed.value_or(false) ? fmt::format(", fell at {:.2f} s", run.collapse_time_s) : "");
}

/// What a campaign is wished to be, by options of a command.
class WishOptions {
public:
    explicit WishOptions(CLI::App& command)
    {
        command
            .add_option("--effect", effects_, "the hidden effect, instead of that of the seed; given twice for a pair")
            ->allow_extra_args(false);
        command.add_flag("--nothing", nothing_, "no hidden effect, for any seed")->excludes("--effect");
        command.add_flag("--short", brief_, "two runs without repeats, for tests");
        command.add_option("--law", law_, "baseline contact law, instead of that of the seed")
            ->check(CLI::IsMember({"nonsmooth", "compliant"}));
        command
            .add_option("--specimen", specimen_, "column: of small blocks, as loop_assessment has them, for any seed")
            ->check(CLI::IsMember({"column"}));
        slippery_ = command
                        .add_option("--friction", friction_,
                                    "FROM TO: true friction over the nominal one of the file, uniform in the logarithm")
                        ->check(CLI::Range(0.1, 3.0));
    }

    Wish wish() const
    {
        Wish wish;
        if (brief_)
            wish.most_motions = 2;
        if (specimen_ == "column")
            wish.specimen = SpecimenKind::small_column;
        if (!law_.empty())
            wish.law = law_ == "nonsmooth" ? Law::nonsmooth : Law::compliant;
        if (slippery_->count() > 0 && friction_.first > friction_.second)
            throw InputError("--friction", 0, "the first number is above the second. Give FROM TO with FROM <= TO.");
        if (slippery_->count() > 0)
            wish.friction = friction_;
        for (const std::string& name : effects_)
            check_effect(name);
        for (const std::string& name : effects_)
            if (wish.law && !applies(name, *wish.law))
                throw InputError(
                    "--effect", 0,
                    fmt::format("{} is not defined under the law {}.\n  Choose the other law.", name, law_));
        if (nothing_ || !effects_.empty())
            wish.effects = effects_;
        return wish;
    }

private:
    std::string law_, specimen_;
    std::vector<std::string> effects_;
    bool nothing_ = false, brief_ = false;
    std::pair<double, double> friction_;
    CLI::Option* slippery_ = nullptr;
};

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Virtual shake-table campaigns with hidden effects, and the score of their diagnoses.");
    app.require_subcommand(1);

    std::string seeds, out;
    auto* make = app.add_subcommand(
        "generate", "writes campaign_SEED.h5, its study and answers/SEED.toml; continues an interrupted run");
    make->add_option("--seeds", seeds, "A..B")->required();
    make->add_option("--out", out, "folder")->required();
    WishOptions wish(*make);

    std::string plan, tests_file;
    std::uint64_t seed = 0;
    auto* test = app.add_subcommand("test", "does the tests on single joints that a file plans, with the specimen of a "
                                            "campaign; options as for 'generate' of that campaign");
    test->add_option("--campaign-seed", seed, "seed of the campaign")->required();
    test->add_option("--plan", plan, "measured data of version 2 with runs that have no measured series")->required();
    test->add_option("--out", tests_file, "the same file with what was measured")->required();
    WishOptions test_wish(*test);

    std::string answers, diagnoses, page;
    auto* judge_them = app.add_subcommand("score", "compares diagnoses with answers");
    judge_them->add_option("--answers", answers, "folder of SEED.toml")->required();
    judge_them->add_option("--diagnoses", diagnoses, "folder of SEED.json, as 'diagnose --json' prints them")
        ->required();
    judge_them->add_option("--markdown", page, "file for a copy of the tables");

    auto* list = app.add_subcommand("effects", "prints the names of all effects, those outside the list last");

    std::string calibrations;
    auto* cover = app.add_subcommand("coverage", "coverage of the intervals of the friction in calibrations");
    cover->add_option("--answers", answers, "folder of SEED.toml")->required();
    cover->add_option("--calibrations", calibrations, "folder of SEED.json, as 'calibrate --json' prints them")
        ->required();
    cover->add_option("--markdown", page, "file for a copy of the table");

    try {
        app.parse(argc, argv);
        if (make->parsed()) {
            generate(parse_seeds(seeds), out, wish.wish());
        } else if (test->parsed()) {
            do_tests(seed, test_wish.wish(), plan, tests_file);
        } else if (list->parsed()) {
            for (const auto* names : {&listed_names(), &outside_names()})
                for (const std::string& name : *names)
                    fmt::print("{}\n", name);
        } else if (cover->parsed()) {
            coverage_of_folder(answers, calibrations, page);
        } else {
            score_folder(answers, diagnoses, page);
        }
    } catch (const CLI::ParseError& error) {
        const int status = app.exit(error);
        return status == 0 ? 0 : 2;
    } catch (const InputError& error) {
        fmt::print(stderr, "hidden_campaigns: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "hidden_campaigns: {}\n", error.what());
        return 1;
    }
    return 0;
}
