/// The ground motions of a fragility study as people have them: downloads with other files beside the accelerations,
/// vertical components, the same motion under several names, weak motions scaled far, and few motions.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/check/weak_spots.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/motions.hpp"
#include "studies/kinds/fragility/exchange.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"
#include "studies/workflow/check.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// A motion of its own for each number: two waves whose frequencies depend on it.
std::vector<double> samples(int number, double factor = 1)
{
    std::vector<double> a(400);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double t = 0.01 * static_cast<double>(i);
        a[i] = factor * std::sin(M_PI * t / 4) *
               (std::sin((9 + number) * t) + 0.4 * std::sin((23 - 1.7 * number) * t + number));
    }
    return a;
}

const char* const in_g = "ACCELERATION TIME SERIES IN UNITS OF G";

/// A file as PEER delivers it.
std::string at2(const std::vector<double>& values, const std::string& title, const std::string& quantity = in_g)
{
    std::string text = "PEER NGA STRONG MOTION DATABASE RECORD\n" + title + "\n" + quantity +
                       fmt::format("\nNPTS= {}, DT= 0.0100 SEC\n", values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{:15.7E}{}", values[i], i % 5 == 4 || i + 1 == values.size() ? "\n" : "");
    return text;
}

class MotionSets : public testing::Test {
protected:
    TemporaryFolder scratch_;
    const fs::path folder = scratch_.path();

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    /// @param count motions RSN1_X_090.AT2, ... in g
    void motions(int count, double factor = 0.1) const
    {
        for (int k = 0; k < count; ++k)
            write(fmt::format("RSN{}_X_090.AT2", k),
                  at2(samples(k, factor), fmt::format("Event, 1/1/1999, St {}, 090", k)));
    }
    /// What `check` prints without running anything.
    static std::string checked(LoadedStudy loaded)
    {
        WorkObserver quiet;
        return check_text(check_study(std::move(loaded), "study.toml", {.pilot = 0, .trial_seconds = 0},
                                      {.threads = 1, .simd = "scalar"}, quiet)
                              .value());
    }
    /// The study of these motions.
    static std::string text(const std::string& of_motions, const std::string& pga = "from = 2.0, to = 6.0")
    {
        return "[study]\nkind = \"fragility\"\nrealizations = 2\n[structure]\nblocks = 3\ndrum_width_m = 1.0\n"
               "drum_height_m = 1.6\ndepth_m = 1.0\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 3e9\n"
               "friction = 0.68\n[excitation]\nkind = \"record\"\n[fragility]\n" +
               of_motions + "\nintensity = { measure = \"pga\", " + pga +
               ", count = 3, spacing = \"log\" }\n"
               "[perturbation]\ndrum_offset = { distribution = \"normal\", sd_m = 0.005, per = \"block\" }\n";
    }
    LoadedStudy load(const std::string& of_study, const std::vector<std::string>& settings = {}) const
    {
        write("study.toml", of_study);
        fs::create_directories(folder / "m");
        return LoadedStudy::from_file((folder / "study.toml").string(), settings);
    }
    LoadedStudy of_folder(const std::vector<std::string>& settings = {}) const
    {
        return load(text("folder = \"" + folder.string() + "\"\npattern = \"[!s]*\""), settings);
    }
    std::string refusal(const std::vector<std::string>& settings = {}) const
    {
        try {
            of_folder(settings).warnings("study.toml");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    static std::string implausible(const LoadedStudy& loaded, const std::string& check)
    {
        for (const Implausibility& one : loaded.implausibilities())
            if (one.check == check)
                return one.text;
        return "";
    }
    static std::string weak(const LoadedStudy& loaded, const std::string& name)
    {
        for (const WeakSpot& spot : weak_spots(loaded, loaded.implausibilities(), nullptr))
            if (spot.name == name)
                return spot.text + " " + spot.todo;
        return "";
    }
    /// Results in which a motion's structures fall from a stripe on that is its number's.
    static Fragility results(const LoadedStudy& loaded)
    {
        std::vector<FragilityOutcome> rows;
        const Study& study = loaded.study();
        for (std::uint64_t i = 0; i < study.total(); ++i) {
            const Realization r = loaded.sampler().realization(i);
            FragilityOutcome row{i, study.cell(i), r.pga_m_s2, {}};
            const std::uint64_t stripe = row.cell % 3, motion = row.cell / 3;
            row.outcome.state = stripe + (motion + i) % 2 > 1 ? State::collapsed : State::stood;
            rows.push_back(row);
        }
        return fragility_of(study, loaded.result_header(), std::move(rows));
    }
};

TEST_F(MotionSets, ADownloadHasOtherFilesBesideTheAccelerations)
{
    motions(8);
    for (int k = 0; k < 8; ++k) {
        write(fmt::format("RSN{}_X_090.VT2", k), at2(samples(k), "Event", "VELOCITY TIME SERIES IN UNITS OF CM/S"));
        write(fmt::format("RSN{}_X_090.DT2", k), at2(samples(k), "Event", "DISPLACEMENT TIME SERIES IN UNITS OF CM"));
    }
    write("_SearchResults.csv", "Record, Magnitude\n1, 6.5\n2, 7\n");
    write("_readME.txt", "This folder was downloaded.\n");
    const LoadedStudy loaded = of_folder();
    EXPECT_EQ(loaded.study().fragility->motions, 8);
    for (const RecordSpec& record : loaded.study().fragility->records)
        EXPECT_TRUE(record.file.ends_with(".AT2")) << record.file;
    const std::string said = implausible(loaded, "left_out");
    EXPECT_NE(said.find("18 files or components"), std::string::npos) << said;
    EXPECT_NE(said.find("RSN0_X_090.DT2"), std::string::npos) << said;
    EXPECT_EQ(implausible(of_folder({"fragility.pattern=*.AT2"}), "left_out"), "");
    // the canonical text names the files that were taken
    EXPECT_EQ(parse_study(loaded.study().text, "canonical").text, loaded.study().text);
}

TEST_F(MotionSets, ADamagedFileAmongItsLikeIsNotLeftOut)
{
    motions(8);
    std::string cut = at2(samples(8, 0.1), "Event");
    write("RSN9_X_090.AT2", cut.substr(0, cut.size() / 2));
    const std::string said = refusal();
    EXPECT_NE(said.find("RSN9_X_090.AT2"), std::string::npos) << said;
    EXPECT_NE(said.find("fragility.pattern"), std::string::npos) << said;
    EXPECT_EQ(refusal({"fragility.pattern=RSN[0-7]*"}), "");
    for (int k = 0; k < 8; ++k)
        fs::remove(folder / fmt::format("RSN{}_X_090.AT2", k));
    EXPECT_NE(refusal().find("No file of fragility.folder can be read"), std::string::npos) << refusal();
}

TEST_F(MotionSets, VerticalComponentsAreNoHorizontalMotions)
{
    motions(3);
    write("RSN7_X-UP.AT2", at2(samples(9, 0.1), "Event, 1/1/1999, Station, UP"));
    write("RSN8_X_VER.AT2", at2(samples(10, 0.1), "Event, 1/1/1999, Station, VER"));
    const LoadedStudy loaded = of_folder();
    EXPECT_EQ(loaded.study().fragility->motions, 3);
    EXPECT_NE(implausible(loaded, "left_out").find("RSN7_X-UP.AT2 (vertical) and RSN8_X_VER.AT2 (vertical)"),
              std::string::npos)
        << implausible(loaded, "left_out");
    EXPECT_EQ(weak(loaded, "unknown_direction"), "") << "all state an azimuth";

    // by its own name it is refused, unless it is meant
    const std::string named = text("records = [{ file = \"RSN0_X_090.AT2\" }, { file = \"RSN7_X-UP.AT2\" }]");
    try {
        load(named).warnings("study.toml");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find("RSN7_X-UP.AT2"), std::string::npos) << said;
        EXPECT_NE(said.find("study.allow = [\"direction\"]"), std::string::npos) << said;
    }
    EXPECT_NO_THROW(load(named, {"study.allow=[\"direction\"]"}).warnings("study.toml"));
}

TEST_F(MotionSets, AnUnknownDirectionIsNamed)
{
    motions(2);
    std::string columns = "time_s,acceleration_m_s2\n";
    const std::vector<double> a = samples(5);
    for (std::size_t i = 0; i < a.size(); ++i)
        columns += fmt::format("{},{}\n", 0.01 * static_cast<double>(i), a[i]);
    write("plain.csv", columns);
    const LoadedStudy loaded =
        load(text("records = [{ file = \"RSN0_X_090.AT2\" }, { file = \"plain.csv\", unit = \"m/s2\" }]"));
    const std::string said = weak(loaded, "unknown_direction");
    EXPECT_NE(said.find("1 motion is unknown"), std::string::npos) << said;
    EXPECT_NE(said.find("plain.csv"), std::string::npos) << said;
}

TEST_F(MotionSets, EqualMotionsAreFoundByTheirSamples)
{
    motions(8);
    write("copy.AT2", at2(samples(3, 0.1), "Another event, 5/5/2005, Elsewhere, 180"));
    write("bigger.AT2", at2(samples(3, 0.35), "Event, 1/1/1999, Scaled, 090"));
    write("in_cm.AT2", at2(samples(5, 98.0665), "Event", "ACCELERATION TIME SERIES IN UNITS OF CM/S/S"));
    const LoadedStudy loaded = of_folder();
    const MotionGroups groups = motion_groups(loaded.study(), motion_table(*loaded.experiment().motions().drawn));
    EXPECT_EQ(groups.group.size(), 11U);
    EXPECT_EQ(groups.groups, 8U);
    const std::string said = implausible(loaded, "equal_motions");
    EXPECT_NE(said.find("RSN3_X_090.AT2, bigger.AT2 and copy.AT2"), std::string::npos) << said;
    EXPECT_NE(said.find("RSN5_X_090.AT2 and in_cm.AT2"), std::string::npos) << said;
    EXPECT_NE(said.find("3 of the 11 motions are"), std::string::npos) << said;
    bool kept = false;
    for (const std::string& warning : loaded.result_header().warnings) // of the page
        kept = kept || warning == said;
    EXPECT_TRUE(kept);
    for (int k = 0; k < 8; ++k)
        for (int l = 0; l < k; ++l)
            EXPECT_NE(groups.group[static_cast<std::size_t>(k)], groups.group[static_cast<std::size_t>(l)]);
}

TEST_F(MotionSets, EqualMotionsAreOneInEveryInterval)
{
    for (int k = 0; k < 16; ++k) // each of eight twice
        write(fmt::format("m{:02}.AT2", k), at2(samples(k / 2, 0.1), "Event, 1/1/1999, Station, 090"));
    const Fragility twice = results(of_folder());
    EXPECT_EQ(twice.motions, 16U);
    EXPECT_EQ(twice.different, 8U);
    const StateFragility& state = twice.states.front();
    EXPECT_EQ(state.data.records, 8U);
    EXPECT_EQ(state.curve.trials, 16 * 3 * 2);
    ASSERT_TRUE(state.shares);
    EXPECT_EQ(state.shares->records, 8U);
    EXPECT_NE(fragility_text(twice).find("16 motions (8 different)"), std::string::npos) << fragility_text(twice);
    EXPECT_NE(checked(of_folder()).find("interval: 8 ground motions fix a probability"), std::string::npos);
    EXPECT_NE(weak(of_folder(), "wide_interval").find("8 ground motions fix"), std::string::npos);

    for (int k = 0; k < 16; ++k) // one motion sixteen times
        write(fmt::format("m{:02}.AT2", k), at2(samples(0, 0.1 + 0.01 * k), "Event, 1/1/1999, Station, 090"));
    const Fragility one = results(of_folder());
    EXPECT_EQ(one.different, 1U);
    EXPECT_NE(weak(of_folder(), "wide_interval").find("1 ground motion fixes"), std::string::npos);
    EXPECT_NE(weak(of_folder(), "wide_interval").find("give different ground motions: 97"), std::string::npos);
    for (const StripeShare& stripe : one.states.front().stripes->stripes)
        EXPECT_TRUE(std::isnan(stripe.limits.lower) && std::isnan(stripe.limits.upper));
}

TEST_F(MotionSets, FewMotionsGiveSharesWithoutIntervals)
{
    for (const int count : {1, 2, 7, 8}) {
        for (int k = 0; k < count; ++k)
            write(fmt::format("m{}.AT2", k), at2(samples(k, 0.1), "Event, 1/1/1999, Station, 090"));
        const LoadedStudy loaded = of_folder();
        const Fragility f = results(loaded);
        ASSERT_FALSE(f.states.empty()) << count;
        const StateFragility& state = f.states.front();
        ASSERT_TRUE(state.stripes) << count;
        ASSERT_EQ(state.stripes->stripes.size(), 3U);
        EXPECT_EQ(state.stripes->stripes[0].share, 0);
        EXPECT_EQ(state.stripes->stripes[1].share, 0.5);
        EXPECT_EQ(state.stripes->stripes[2].share, 1);
        const bool interval = count >= 8;
        EXPECT_EQ(std::isnan(state.stripes->stripes[1].limits.lower), !interval) << count;
        EXPECT_EQ(std::isnan(state.curve.median.records.lower), !interval) << count;
        const std::string text = fragility_text(f), json = fragility_json(f).text();
        EXPECT_EQ(text.find("too few for an interval over motions") == std::string::npos, interval) << text;
        EXPECT_EQ(json.find("too few for an interval over motions") == std::string::npos, interval) << json;
        EXPECT_EQ(text.find("nan"), std::string::npos) << text;
        EXPECT_EQ(text.find("1 records"), std::string::npos) << text;

        for (const char* format : {"nrml", "json", "csv"})
            EXPECT_NO_THROW(model_files(fragility_models(f, "few"), format)) << format << ", " << count;

        LimitCounts counts(3, motion_groups(loaded.study(), loaded.result_header().motions));
        counts.add(ResultRow{});
        EXPECT_EQ(counts.interval(), interval ? "motions 0.95" : "none");
        EXPECT_EQ(std::isnan(counts.share(LimitState::collapse).lower), !interval);
    }
}

TEST_F(MotionSets, NothingIsKnownOfResidualsWhereAllStillMove)
{
    motions(8);
    const LoadedStudy loaded = of_folder();
    std::vector<FragilityOutcome> rows;
    for (std::uint64_t i = 0; i < loaded.study().total(); ++i) {
        rows.push_back({i, loaded.study().cell(i), loaded.sampler().realization(i).pga_m_s2, {}});
        rows.back().outcome.state = State::stood;
    }
    const Fragility f = fragility_of(loaded.study(), loaded.result_header(), std::move(rows));
    const auto state = std::ranges::find_if(
        f.states, [](const StateFragility& s) { return s.state.kind == DamageState::Kind::residual; });
    ASSERT_NE(state, f.states.end());
    EXPECT_EQ(state->moving, 48U);
    EXPECT_TRUE(std::isnan(state->curve.median.value) && std::isnan(state->curve.dispersion.value));
    ASSERT_EQ(state->curve.says.size(), 1U);
    EXPECT_EQ(state->curve.says[0], "No realization fell or came to rest: nothing is known of this limit state. Give "
                                    "excitation.tail_s = \"rest\", or more damping.");
    const std::string text = fragility_text(f);
    EXPECT_NE(text.find("48 of 48 realizations stand and still moved at the end"), std::string::npos) << text;
    EXPECT_EQ(f.states.front().curve.says[0].find("None of 48 runs of 8 records"), 0U)
        << f.states.front().curve.says[0];
}

TEST_F(MotionSets, WeakMotionsAreNotScaledFarWithoutAWord)
{
    motions(8, 0.002); // 0.02 to 0.03 m/s2
    const std::string said = implausible(of_folder(), "scale");
    EXPECT_NE(said.find("8 of 8 motions from files are scaled by more than a factor of 10: RSN"), std::string::npos)
        << said;
    EXPECT_NE(said.find("(factor "), std::string::npos) << said;
    motions(8, 0.1); // about 1.2 m/s2
    EXPECT_EQ(implausible(of_folder(), "scale"), "");
}

TEST_F(MotionSets, TheVerticalMotionIsAVerticalComponent)
{
    motions(1);
    write("up.AT2", at2(samples(2, 0.1), "Event, 1/1/1999, Station, UP"));
    std::string single = text("").substr(0, text("").find("[fragility]"));
    single.replace(single.find("fragility"), 9, "single").replace(single.find("realizations = 2\n"), 17, "");
    single += "file = \"RSN0_X_090.AT2\"\n[mechanisms]\nvertical_motion = { file = \"FILE\" }\n";
    const auto with = [&](const std::string& file) {
        std::string of = single;
        return load(of.replace(of.find("FILE"), 4, file));
    };
    EXPECT_EQ(implausible(with("up.AT2"), "direction"), "");
    EXPECT_NE(implausible(with("RSN0_X_090.AT2"), "direction").find("the study has no vertical record"),
              std::string::npos);
    // the vertical component as the horizontal motion
    EXPECT_NE(implausible(load(single.substr(0, single.find("[mechanisms]")),
                               {"excitation.file=" + (folder / "up.AT2").string()}),
                          "direction")
                  .find("Vertical component would shake the base horizontally"),
              std::string::npos);
}

TEST_F(MotionSets, AStrongerMotionThanAnyEarthquakeIsAllowedByName)
{
    std::string columns = "time_s,acceleration_m_s2\n";
    for (int i = 0; i < 100; ++i)
        columns += fmt::format("{},{}\n", 0.001 * i, i > 20 && i < 40 ? 112.6 : i > 50 && i < 70 ? -112.6 : 0.0);
    write("impulse.csv", columns);
    std::string single = text("").substr(0, text("").find("[fragility]"));
    single.replace(single.find("fragility"), 9, "single").replace(single.find("realizations = 2\n"), 17, "");
    single += "file = \"impulse.csv\"\nunit = \"m/s2\"\nbaseline = false\n";
    try {
        load(single);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("study.allow = [\"pga\"]"), std::string::npos) << error.what();
    }
    const LoadedStudy loaded = load(single, {"study.allow=[\"pga\"]"});
    EXPECT_NO_THROW(loaded.warnings("study.toml"));
    EXPECT_EQ(loaded.record()->pga_m_s2, 112.6);
}

TEST_F(MotionSets, ADriftIsNoMotion)
{
    std::string columns = "time_s,acceleration_m_s2\n";
    for (int i = 0; i < 500; ++i)
        columns += fmt::format("{},{}\n", 0.01 * i, 0.02 * i - 3);
    write("drift.csv", columns);
    std::string single = text("").substr(0, text("").find("[fragility]"));
    single.replace(single.find("fragility"), 9, "single").replace(single.find("realizations = 2\n"), 17, "");
    try {
        load(single + "file = \"drift.csv\"\nunit = \"m/s2\"\n");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("no motion"), std::string::npos) << error.what();
    }
}

/// Files of public kinds, where they are at hand.
TEST_F(MotionSets, OfPublicKinds)
{
    const fs::path cases = fs::path(STYLOBATE_SOURCE_DIR) / ".." / "shared" / "cases";
    if (!fs::exists(cases))
        GTEST_SKIP() << "no folder " << cases;
    const auto set = [&](const char* of) {
        return load(text("folder = \"" + fs::canonical(cases / of).string() + "\""));
    };
    EXPECT_EQ(set("vertical/knet").study().fragility->motions, 6);
    EXPECT_EQ(set("vertical/at2").study().fragility->motions, 5);
    EXPECT_EQ(set("columns/avd").study().fragility->motions, 3);

    const LoadedStudy download = set("records/peer_download");
    EXPECT_EQ(download.study().fragility->motions, 8);
    EXPECT_EQ(download.study().fragility->left_out.size(), 18U);

    const LoadedStudy same = set("records/same_record_eight_times");
    EXPECT_EQ(motion_groups(same.study(), same.result_header().motions).groups, 1U);
    EXPECT_NE(implausible(same, "equal_motions"), "");

    std::string single = text("").substr(0, text("").find("[fragility]"));
    single.replace(single.find("fragility"), 9, "single").replace(single.find("realizations = 2\n"), 17, "");
    single += "file = \"" + fs::canonical(cases / "physics/double_impulse.csv").string() + "\"\n";
    single.replace(single.find("\"record\""), 8, "\"table\"");
    EXPECT_THROW(load(single), InputError);
    EXPECT_NO_THROW(load(single, {"study.allow=[\"pga\"]"}).warnings("study.toml"));

    fs::create_directories(folder / "unam");
    fs::copy_file(cases / "vertical/asa_as_unam.asa", folder / "unam" / "a.asa");
    EXPECT_EQ(load(text("folder = \"unam\"")).study().fragility->motions, 2);
}

} // namespace
} // namespace stylobate
