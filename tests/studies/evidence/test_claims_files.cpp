/// Claim files read and refused, the page that is written from them, and a small run from file to samples.

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/claims/claim.hpp"
#include "studies/evidence/claims/claim_page.hpp"
#include "studies/evidence/claims/sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

namespace stylobate::claims {
namespace {

namespace fs = std::filesystem;

const std::string study = R"(
[study]
kind = "surface"
realizations = 6
[structure]
kind = "column"
blocks = 1
drum_width_m = 0.048
drum_height_m = 0.174
depth_m = 0.048
drum_mass_kg = 0.813
[contact]
normal_stiffness_n_m2 = 1e9
friction = 0.68
[excitation]
kind = "harmonic"
ramp_cycles = 1
cycles = 4
[surface]
frequency_hz = { from = 4, to = 8, count = 2, spacing = "log" }
pga_m_s2 = { from = 0.5, to = 16, count = 2, spacing = "log" }
[perturbation]
tilt = { distribution = "normal", sd_rad = 0.002, per = "structure" }
)";

const std::string claim = R"(
[claim]
what = "one block"
[[claim.axis]]
name = "mu"
label = "friction"
levels = [{ name = "0.68" }, { name = "0.1", set = ["contact.friction=0.1"] }]
[[claim.test]]
id = "P1"
says = ["Two", "parts."]
section = "5, Fig. 1"
criterion = { kind = "bound", measure = "probability", event = "rocked", at_least = 0.5, pga_m_s2 = 16 }
figures = ["shares"]
[claim.test.reason]
depends = "It {split}; {number:mu=0.1}; {finding:mu=0.68}; {rigid:}."
[[claim.figure]]
name = "shares"
title = "Shares"
x = "frequency"
y_label = "probability"
measures = [{ measure = "probability", event = "rocked" }]
)";

std::string replaced(std::string text, const std::string& old, const std::string& fresh)
{
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), fresh);
}

/// The message with which a text is refused; empty if it is not.
std::string refusal(const std::string& text)
{
    try {
        parse_claims(text, "made_up.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

class ClaimFolder : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::temp_directory_path() / ("stylobate_claims_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    fs::path folder_;
};

TEST(ClaimText, IsReadWhole)
{
    const ClaimFile file = parse_claims(study + claim, "folder/made_up.toml");
    EXPECT_EQ(file.name, "made_up");
    EXPECT_EQ(file.what, "one block");
    ASSERT_EQ(file.axes.size(), 1u);
    EXPECT_EQ(file.axes[0].levels[1].set, std::vector<std::string>{"contact.friction=0.1"});
    ASSERT_EQ(file.tests.size(), 1u);
    const claims::Test& test = file.tests[0];
    EXPECT_EQ(test.says, "Two parts.");
    EXPECT_EQ(test.criterion.measure.event, Event::rocked);
    EXPECT_EQ(test.criterion.pga.from, 16);
    EXPECT_EQ(test.criterion.pga.to, 16);
    EXPECT_EQ(test.ranges.size(), 1u);
    EXPECT_EQ(criterion_text(file, test), "The probability that it rocks is at least 0.5 in every cell, at 16 m/s².");
    EXPECT_EQ(file.figures.at(0).name, "shares");
}

TEST(ClaimText, AStudyWithClaimsIsAnOrdinaryStudy)
{
    const Study with = parse_study(study + claim, "made_up.toml"), without = parse_study(study, "made_up.toml");
    EXPECT_EQ(with.text, without.text);
}

TEST(ClaimText, RefusesWithTheLineAndTheWord)
{
    const std::string text = study + claim;
    EXPECT_NE(refusal(study).find("claim is missing"), std::string::npos);
    EXPECT_NE(refusal(replaced(text, "event = \"rocked\", at_least", "event = \"roked\", at_least")).find("rocked"),
              std::string::npos);
    EXPECT_NE(refusal(replaced(text, "at_least = 0.5, ", "")).find("at_least"), std::string::npos);
    EXPECT_NE(refusal(replaced(text, "section = \"5, Fig. 1\"\n", "")).find("section is missing"), std::string::npos);
    EXPECT_NE(
        refusal(replaced(text, "kind = \"bound\", measure = \"probability\", event = \"rocked\", at_least = 0.5",
                         "kind = \"paired\", measure = \"onset\", event = \"rocked\", direction = \"falls\", along = "
                         "\"mu\""))
            .find("probability"),
        std::string::npos);
    EXPECT_NE(refusal(replaced(text, "says =", "say =")).find("Did you mean says"), std::string::npos);
    EXPECT_NE(refusal(replaced(text, "pga_m_s2 = 16 }", "pga_m_s2 = [3, 2] }")).find("is not a window"),
              std::string::npos);
    EXPECT_NE(refusal(replaced(text, "figures = [\"shares\"]", "only = [\"mu=0.2\"]")).find("mu=0.2"),
              std::string::npos);
    EXPECT_NE(refusal(replaced(text, "x = \"frequency\"", "x = \"nu\"")).find("axis"), std::string::npos);
    EXPECT_NE(refusal(replaced(text, "kind = \"bound\"", "kind = \"order\", direction = \"falls\", along = \"nu\""))
                  .find("is no axis"),
              std::string::npos);
    EXPECT_NE(refusal(text).find("made_up.toml:"), 0u); // the text itself is right
    EXPECT_EQ(refusal(text), "");
    // the line is that of the word
    const std::string wrong = replaced(text, "event = \"rocked\", at_least", "event = \"roked\", at_least");
    const auto line = std::count(wrong.begin(), wrong.begin() + static_cast<long>(wrong.find("roked")), '\n') + 1;
    EXPECT_EQ(refusal(wrong).rfind("made_up.toml:" + std::to_string(line) + ":", 0), 0u) << refusal(wrong);
}

TEST(ClaimText, VariantsAreThoseThatTheLevelsAllow)
{
    std::vector<VariantAxis> axes{{"K", "K", {{"soft", {}, {}, {}}, {"stiff", {}, {"start=smooth"}, {}}}},
                                  {"start", "start", {{"smooth", {}, {}, {}}, {"abrupt", {}, {}, {}}}}};
    EXPECT_EQ(variants(axes), (std::vector<Levels>{{0, 0}, {0, 1}, {1, 0}}));
    EXPECT_TRUE(picked(axes, {0, 1}, {"K=soft", "K=stiff", "start=abrupt"}));
    EXPECT_FALSE(picked(axes, {0, 1}, {"start=smooth"}));
    EXPECT_EQ(variants({}).size(), 1u);
}

TEST(ClaimText, SettingsThatHoldTogetherWithOtherLevels)
{
    const std::vector<VariantAxis> axes{
        {"drums", "drums", {{"1", {"a=1"}, {}, {{{"height=3 m"}, {"h=3"}}, {{"height=4 m"}, {"h=4"}}}}}},
        {"height", "height", {{"3 m", {}, {}, {}}, {"4 m", {"b=2"}, {}, {}}}}};
    EXPECT_EQ(settings_of(axes, {0, 0}), (std::vector<std::string>{"a=1", "h=3"}));
    EXPECT_EQ(settings_of(axes, {0, 1}), (std::vector<std::string>{"a=1", "h=4", "b=2"}));
}

TEST(ClaimText, EveryVariantOfThePaperIsAStudy)
{
    std::size_t files = 0, studies = 0;
    std::vector<std::string> ids;
    for (const auto& entry : fs::directory_iterator(fs::path(STYLOBATE_SOURCE_DIR) / "studies/evidence/paper")) {
        if (entry.path().extension() != ".toml")
            continue;
        ++files;
        const ClaimFile file = read_claims(entry.path());
        for (const Levels& levels : variants(file.axes)) {
            const Study one = read_study(entry.path(), settings_of(file.axes, levels));
            EXPECT_GE(one.realizations, 200u) << file.name;
            ++studies;
        }
        for (const claims::Test& test : file.tests)
            ids.push_back(test.id);
    }
    EXPECT_GT(files, 5u);
    EXPECT_GT(studies, files);
    // P1 to P25, whole or in parts
    for (int i = 1; i <= 25; ++i) {
        const std::string id = "P" + std::to_string(i);
        EXPECT_TRUE(std::any_of(ids.begin(), ids.end(), [&](const std::string& one) {
            return one == id || (one.size() == id.size() + 1 && one.starts_with(id) && one.back() >= 'a');
        })) << id;
    }
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

TEST(ClaimPage, OrderOfClaimsIsThatOfTheirNumbers)
{
    EXPECT_TRUE(comes_before("P2", "P10"));
    EXPECT_TRUE(comes_before("P14a", "P14b"));
    EXPECT_FALSE(comes_before("P14b", "P14a"));
}

TEST_F(ClaimFolder, RunsResumesAndWritesThePage)
{
    const fs::path path = write("made_up.toml", study + claim);
    const ClaimFile file = read_claims(path);
    const RunPlace place{folder_ / "results", folder_, 0, {}};
    Observer observer;
    const RunOptions one{Isa::scalar, 1}, two{best_isa(), 2};
    const auto samples = run_variants(file, place, one, observer);
    ASSERT_EQ(samples.size(), 2u);
    ASSERT_EQ(samples[0].cells.size(), 4u);
    EXPECT_EQ(samples[0].cells[0].size(), 6u);
    EXPECT_NEAR(samples[0].rigid_m_s2, 9.81 * 0.048 / 0.174, 1e-9);
    // Shenton: far below both limits nothing moves; far above, friction 0.68 rocks the block and 0.1 makes it slide
    for (std::size_t f = 0; f < 2; ++f) {
        EXPECT_FALSE(samples[0].cell(f, 0)[0].rocked);
        EXPECT_TRUE(samples[0].cell(f, 1)[0].rocked);
        EXPECT_TRUE(samples[1].cell(f, 1)[0].slid);
    }

    const Result result = judged(file, file.tests[0], samples);
    EXPECT_EQ(filled("{cases} {rigid:}", result), "2 2.706");
    EXPECT_THROW(filled("{nonsense}", result), InputError);
    const std::string page = claims_page({result}, "images", "1.2.3");
    for (const char* part : {"## P1", "**The paper, in our words, section 5, Fig. 1.** Two parts.", "version 1.2.3",
                             "](images/shares.png)", "| friction | number | margin 0 | 5 % | 20 % |"})
        EXPECT_NE(page.find(part), std::string::npos) << part;

    // the same page whatever computes it, and from the result files when they are there
    fs::remove_all(folder_ / "results");
    for (int round = 0; round < 2; ++round) {
        const auto again = run_variants(file, place, two, observer);
        const Result r = judged(file, file.tests[0], again);
        EXPECT_EQ(claims_page({r}, "images", "1.2.3"), page) << round;
    }
}

TEST_F(ClaimFolder, GoesOnAfterAnInterruption)
{
    class Stopping : public Observer {
    public:
        bool stop_requested() override { return true; }
    };
    const std::string longer = replaced(study, "realizations = 6", "realizations = 200");
    const ClaimFile file = read_claims(write("made_up.toml", longer + claim));
    const RunPlace place{folder_ / "results", folder_, 0, {}};
    Stopping stopping;
    Observer observer;
    EXPECT_LT(run_variants(file, place, {Isa::scalar, 1}, stopping).size(), 2u);
    const auto samples = run_variants(file, place, {best_isa(), 2}, observer);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[1].cells[3].size(), 200u);
}

TEST_F(ClaimFolder, AnAbsentRecordIsSaid)
{
    const std::string with_record = replaced(study, "kind = \"harmonic\"\nramp_cycles = 1\ncycles = 4",
                                             "kind = \"record\"\nfile = \"text/none.txt\"\nunit = \"g\"");
    const ClaimFile file = read_claims(write("made_up.toml", with_record + claim));
    Observer observer;
    const auto samples = run_variants(file, {folder_ / "results", folder_, 0, {}}, {Isa::scalar, 1}, observer);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].why_not, "record absent: text/none.txt");
    const Result r = judged(file, file.tests[0], samples);
    EXPECT_EQ(r.verdict.judgement, Judgement::not_run);
    EXPECT_NE(claims_page({r}, "images", "1").find("record absent: text/none.txt"), std::string::npos);
}

TEST_F(ClaimFolder, FiguresHaveOneCurveForEachVariant)
{
    const ClaimFile file = parse_claims(study + claim, "made_up.toml");
    std::vector<Sample> samples(2);
    for (std::size_t i = 0; i < 2; ++i) {
        samples[i].levels = {i};
        samples[i].frequency_hz = {4, 8};
        samples[i].pga_m_s2 = {0.5, 16};
        samples[i].cells.assign(4, std::vector<Observation>(10));
        samples[i].cells[1][0].rocked = true; // 4 Hz, 16 m/s2
    }
    Figure figure = file.figures[0];
    figure.pga.values = {16};
    std::vector<Curve> curves = curves_of(file, figure, samples);
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[1].label, "friction 0.1");
    ASSERT_EQ(curves[0].points.size(), 2u);
    EXPECT_EQ(curves[0].points[0].x, 4);
    EXPECT_DOUBLE_EQ(curves[0].points[0].y.value, 0.1);
    EXPECT_DOUBLE_EQ(curves[0].points[1].y.value, 0);
    draw_figure(file, figure, curves, folder_ / "shares.png");
    EXPECT_GT(fs::file_size(folder_ / "shares.png"), 10000u);

    // along an axis the levels are the places, and what is not drawn tells the curves apart
    figure.x = "mu";
    curves = curves_of(file, figure, samples);
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[0].label, "4 Hz");
    EXPECT_EQ(curves[0].points[1].x, 1);
    draw_figure(file, figure, {}, folder_ / "empty.png");
    EXPECT_TRUE(fs::exists(folder_ / "empty.png"));
}

TEST(ClaimObservation, PathOfTheBaseAndStartOfTheStrongShaking)
{
    // abrupt, no ramps: u = A sin wt over 4 cycles has the path 16 A
    Study s = parse_study(replaced(study, "ramp_cycles = 1", "start = \"abrupt\"\nend = \"abrupt\""), "made_up.toml");
    Realization r = Sampler(s, nullptr).realization(0);
    r.frequency_hz = 5;
    r.pga_m_s2 = 3;
    r.step_s = 1e-4;
    Outcome o;
    o.state = State::collapsed;
    o.collapse_time_s = 0.5;
    o.end_time_s = 10;
    o.top_path_m = 0.1;
    o.energy_friction_j = 1;
    o.energy_damping_j = 3;
    Observation seen = observe(s, r, nullptr, o, true);
    const double amplitude = 3 / std::pow(2 * std::numbers::pi * 5, 2);
    EXPECT_NEAR(seen.amount[static_cast<std::size_t>(Amount::top_path_ratio)], 0.1 / (16 * amplitude),
                1e-3 * 0.1 / (16 * amplitude));
    EXPECT_DOUBLE_EQ(seen.amount[static_cast<std::size_t>(Amount::friction_share)], 0.25);
    EXPECT_DOUBLE_EQ(seen.cycles_to_collapse, 2.5);
    EXPECT_TRUE(seen.rocked); // what collapsed has rocked
    s.excitation.start = HarmonicEdge::smooth;
    s.excitation.ramp_cycles = 2;
    EXPECT_DOUBLE_EQ(observe(s, r, nullptr, o, false).cycles_to_collapse, 0.5);
}

TEST(ClaimObservation, StrongShakingOfWhatIsNoHarmonicMotion)
{
    Study s = parse_study(study, "made_up.toml");
    const Realization plain = Sampler(s, nullptr).realization(0);
    Outcome o;
    o.state = State::collapsed;
    o.collapse_time_s = 8;
    const auto start_s = [&](ExcitationKind kind, const Realization& r, const Motion* record) {
        s.excitation.kind = kind;
        return o.collapse_time_s - observe(s, r, record, o, false).cycles_to_collapse / r.frequency_hz;
    };
    // acceleration grows to 2 m/s2 within 10 s: half of it after 5
    std::vector<double> ramp;
    for (int i = 0; i <= 1000; ++i)
        ramp.push_back(0.002 * i);
    Motion motion = motion_of(ramp, 0.01);
    motion.predominant_frequency_hz = 3;
    Realization r = plain;
    r.frequency_hz = 3;
    EXPECT_NEAR(start_s(ExcitationKind::record, r, &motion), 5, 1e-9);
    EXPECT_NEAR(start_s(ExcitationKind::table, r, &motion), 5, 1e-9);
    r.frequency_hz = 6; // in half the time
    EXPECT_NEAR(start_s(ExcitationKind::table, r, &motion), 2.5, 1e-9);
    // a realization's own motion is in its own time
    r.motion = std::make_shared<const Motion>(motion);
    EXPECT_NEAR(start_s(ExcitationKind::noise, r, nullptr), 5, 1e-9);
    // a tapered sine of 4 cycles of ramp and 12 in all: the envelope has half its size two cycles on, a crest near it
    r = plain;
    r.frequency_hz = 2;
    r.pga_m_s2 = 3;
    s.excitation.ramp_cycles = 4;
    s.excitation.cycles = 12;
    EXPECT_NEAR(start_s(ExcitationKind::tapered, r, nullptr), 1, 0.3);
    // Ricker's wavelet: its trough of 0.446 of the crest is no strong shaking, the crest is, in the middle
    s.excitation.tail_s.reset();
    const double start = start_s(ExcitationKind::ricker, r, nullptr);
    const double middle = SyntheticMotion(s.excitation, r).duration_s() / 2;
    // (1 - 2 q) exp(-q) = 1 / 2 at q = (pi f t)2 = 0.18868
    EXPECT_NEAR(start, middle - std::sqrt(0.18868) / (std::numbers::pi * r.frequency_hz), 0.003);
    EXPECT_EQ(start_s(ExcitationKind::full_sine, r, nullptr), 0);
}

} // namespace
} // namespace stylobate::claims
