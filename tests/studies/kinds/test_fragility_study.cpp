/// Fragility studies: what their file may say, which structures and motions they draw, how strong those are, and which
/// limit states an outcome has reached.

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/sampling/drawn_motions.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/records/ground_motion.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/motions.hpp"
#include "studies/kinds/fragility/damage.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {
namespace {

const std::string inputs = STYLOBATE_SOURCE_DIR "/studies/inputs/";

Study small(const std::vector<std::string>& more = {})
{
    std::vector<std::string> settings{"study.realizations=12", "fragility.motions=9", "fragility.intensity.count=4"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(inputs + "fragility_column.toml", settings);
}

void expect_refused(const std::vector<std::string>& settings, const std::vector<std::string>& words)
{
    try {
        small(settings);
        ADD_FAILURE() << "accepted: " << testing::PrintToString(settings);
    } catch (const InputError& error) {
        for (const std::string& word : words)
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << "no '" << word << "' in:\n"
                                                                               << error.what();
    }
}

struct Loaded {
    Study study;
    std::shared_ptr<const MotionSet> motions;
    Sampler sampler;
    explicit Loaded(const Study& s)
        : study(s), motions(std::make_shared<const MotionSet>(load_motions(study))),
          sampler(study, nullptr, nullptr, motions)
    {
    }
    /// Of a structure under a motion in a stripe.
    Realization of(std::uint64_t motion, std::uint64_t stripe, std::uint64_t structure) const
    {
        const auto stripes = static_cast<std::uint64_t>(study.fragility->stripes());
        return sampler.realization((motion * stripes + stripe) * study.realizations + structure);
    }
};

} // namespace

TEST(FragilityStudy, ItsTextReadsBackAsItself)
{
    for (const auto& settings : {std::vector<std::string>{},
                                 {"fragility.intensity.measure=sa", "fragility.intensity.period_s=1.5"},
                                 {"fragility.peak_limits=[0.1, 0.2]", "fragility.twins=1", "fragility.contacts=1"}}) {
        const Study study = small(settings);
        EXPECT_EQ(parse_study(study.text, "canonical").text, study.text);
        EXPECT_EQ(study.total(), 9U * 4U * 12U);
    }
}

TEST(FragilityStudy, RefusesWhatCannotGiveACurve)
{
    expect_refused({"fragility.motions=0"}, {"fragility.motions = 0", "[1, 100000]"});
    expect_refused({"fragility.peak_limits=[0.35, 0.15, 1]"}, {"peak_limits", "0.35 comes before 0.15"});
    expect_refused({"fragility.residual_limits=[0.01, 0.01]"}, {"residual_limits", "0.01 comes before 0.01"});
    expect_refused({"fragility.contacts=5"}, {"study.realizations = 12", "contacts x twins = 10", "Give 10 or 20."});
    expect_refused({"study.realizations=3"}, {"study.realizations = 3", "contacts x twins = 6", "Give 6."});
    expect_refused({"fragility.method=cloud"}, {"fragility.method", "synthetic"});
    expect_refused({"fragility.intensity.measure=pgx"}, {"fragility.intensity.measure", "pgv"});
    expect_refused({"fragility.intensity.period_s=1"}, {"period_s", "\"sa\""});
    expect_refused({"fragility.folder=records"}, {"fragility.folder", "excitation.kind = \"pulse\""});
    expect_refused({"excitation.kind=harmonic"}, {"excitation.kind", "no ground motion"});
    expect_refused({"excitation.pga_m_s2=3"}, {"excitation.pga_m_s2", "[fragility]"});
    expect_refused({"fragility.shakings=0"}, {"fragility.shakings = 0"});
    expect_refused({"study.sampling=sobol"}, {"study.sampling"});
    expect_refused({"study.realizations=60000000"}, {"study.realizations", "36 cells", "1000000000"});
    expect_refused({"surface.frequency_hz.from=1"}, {"surface", "study.kind = \"fragility\""});
}

TEST(FragilityStudy, MotionsThatAreAllTheSameAreRefused)
{
    // nothing of a wavelet is drawn
    std::ifstream in(inputs + "fragility_column.toml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    for (const char* line : {"pulse_frequency", "pulse_gamma", "phase"})
        text.insert(text.find(std::string("\n") + line) + 1, "# ");
    try {
        load_motions(parse_study(text, "same.toml", {"excitation.kind=ricker"}));
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("all motions are identical"), std::string::npos) << error.what();
    }
}

TEST(FragilityStudy, AStructureKeepsItselfInAllStripesOfItsMotionAlone)
{
    const Loaded l(small());
    for (std::uint64_t structure : {0U, 5U, 11U}) {
        const Realization a = l.of(2, 0, structure);
        EXPECT_EQ(l.of(2, 3, structure).inputs, a.inputs);
        EXPECT_NE(l.of(3, 0, structure).inputs, a.inputs);
        EXPECT_EQ(l.of(2, 3, structure).motion, a.motion);
        EXPECT_NE(l.of(3, 0, structure).motion, a.motion);
    }
}

/// 12 structures: two with other imperfections, each with three contacts, each with two twins.
TEST(FragilityStudy, StructuresShareWhatTheDesignSays)
{
    const Loaded l(small());
    const auto width = [](const Realization& r) { return r.blocks[2].half_width_m; };
    const auto friction = [](const Realization& r) { return r.joints[2].friction; };
    for (std::uint64_t s = 0; s + 1 < 12; ++s) {
        const Realization a = l.of(1, 2, s), b = l.of(1, 2, s + 1);
        EXPECT_EQ(width(a) == width(b), s / 6 == (s + 1) / 6) << s;
        EXPECT_EQ(friction(a) == friction(b), s / 2 == (s + 1) / 2) << s;
        double apart = 0;
        for (std::size_t i = 0; i < a.blocks.size(); ++i)
            apart = std::max(apart, std::fabs(a.blocks[i].x_m - b.blocks[i].x_m));
        if (s / 2 == (s + 1) / 2) {
            EXPECT_GT(apart, 0);
            EXPECT_LT(apart, 1e-8);
            EXPECT_NEAR(a.step_s, b.step_s, 1e-6 * a.step_s);
        }
    }
}

/// The motion that reaches the structure has the intensity that its stripe asks for, by every measure.
TEST(FragilityStudy, MotionsAreScaledToTheirStripe)
{
    const std::pair<const char*, double> cases[] = {{"pga", 3},   {"pgv", 0.6}, {"pgd", 0.3},
                                                    {"arias", 2}, {"cav", 4},   {"sa", 5}};
    for (const auto& [measure, from] : cases) {
        SCOPED_TRACE(measure);
        std::vector<std::string> settings{std::string("fragility.intensity.measure=") + measure,
                                          "fragility.intensity.from=" + std::to_string(from),
                                          "fragility.intensity.to=" + std::to_string(3 * from)};
        if (std::string(measure) == "sa")
            settings.push_back("fragility.intensity.period_s=0.7");
        const Loaded l(small(settings));
        for (const std::uint64_t stripe : {0U, 3U}) {
            const Realization r = l.of(4, stripe, 0);
            // as the structure feels it: second differences of the base's displacement
            const BaseMotion base(l.study.excitation, r, nullptr);
            const double dt = r.motion->dt_s;
            std::vector<double> u;
            for (std::size_t i = 0; i < r.motion->acceleration_m_s2.size(); ++i)
                u.push_back(base.displacement_m(dt * static_cast<double>(i)));
            const Motion felt = motion_of(acceleration_through(u, dt), dt);
            const IntensityMeasures im = intensity_measures(felt);
            const double sa = spectral_acceleration(felt.acceleration_m_s2, dt, {0.7}).front();
            const std::map<std::string, double> got = {{"pga", im.pga_m_s2},    {"pgv", im.pgv_m_s}, {"pgd", im.pgd_m},
                                                       {"arias", im.arias_m_s}, {"cav", im.cav_m_s}, {"sa", sa}};
            const double want = stripe == 0 ? from : 3 * from;
            EXPECT_NEAR(got.at(measure), want, 2e-3 * want);
            EXPECT_NEAR(r.pga_m_s2, im.pga_m_s2, 2e-3 * r.pga_m_s2);
        }
    }
}

TEST(FragilityStudy, ACloudTakesRecordsAsTheyAre)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("stylobate-cloud-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    for (int k = 0; k < 8; ++k) {
        std::ofstream out(folder / ("motion" + std::to_string(k) + ".csv"));
        out << "# time [s], acceleration [m/s2]\n";
        for (int i = 0; i <= 400; ++i) {
            const double t = 0.01 * i;
            out << t << ", " << (1 + k) * std::sin(2 * 3.14159265358979 * 2 * t) * std::sin(3.14159265358979 * t / 4)
                << "\n";
        }
    }
    std::ifstream in(inputs + "fragility_column.toml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    for (const char* line : {"pulse_frequency", "pulse_gamma", "phase", "frequency_hz", "motions", "intensity"})
        text.insert(text.find(std::string("\n") + line) + 1, "# ");
    const auto read = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"excitation.kind=record", "fragility.method=cloud", "fragility.unit=m/s2"});
        return parse_study(text, "cloud.toml", more);
    };
    const Study study = read({"fragility.folder=" + folder.string()});
    ASSERT_EQ(study.fragility->motions, 8);
    EXPECT_EQ(study.total(), 8 * study.realizations);
    EXPECT_EQ(parse_study(study.text, "canonical").text, study.text);
    const Loaded l(study), twice(read({"fragility.folder=" + folder.string(), "fragility.scale=2"}));
    for (std::uint64_t m = 0; m < 8; ++m) {
        const Realization r = l.of(m, 0, 0);
        EXPECT_EQ(r.motion_scale, 1);
        EXPECT_NEAR(r.pga_m_s2, static_cast<double>(m + 1), 0.05 * static_cast<double>(m + 1));
        EXPECT_EQ(twice.of(m, 0, 0).pga_m_s2, 2 * r.pga_m_s2);
    }
    EXPECT_THROW(read({"fragility.folder=" + (folder / "nowhere").string()}), InputError);
    EXPECT_THROW(read({"fragility.folder=" + folder.string(), "fragility.pattern=*.AT2"}), InputError);
    EXPECT_EQ(read({"fragility.folder=" + folder.string(), "fragility.pattern=motion[0-5].csv"}).fragility->motions, 6);
    fs::remove_all(folder);
}

/// Three pulses one after the other: each is there, as strong as the first by the study's measure, and at rest between.
TEST(FragilityStudy, ShakingsFollowOneAnother)
{
    const Study study = small({"fragility.shakings=3", "fragility.pause_s=2"});
    EXPECT_EQ(parse_study(study.text, "canonical").text, study.text);
    const MotionSet all = drawn_motions(study), sequences = load_motions(study);
    ASSERT_EQ(all.size(), 27U);
    ASSERT_EQ(sequences.size(), 9U);
    for (const std::size_t i : {0U, 4U, 8U}) {
        const Motion& sequence = *sequences.motions[i];
        const std::vector<double>& ends = sequences.ends_s[i];
        ASSERT_EQ(ends.size(), 3U);
        double begin = 0;
        const double pgv = intensity_measures(*all.motions[i]).pgv_m_s;
        for (std::size_t k = 0; k < 3; ++k) {
            const Motion& alone = *all.motions[k == 0 ? i : 9 + 2 * i + k - 1];
            EXPECT_NEAR(ends[k] - begin, alone.duration_s(), 4 * sequence.dt_s);
            double peak = 0, rest = 0;
            for (std::size_t s = 0; s < sequence.acceleration_m_s2.size(); ++s) {
                const double t = sequence.dt_s * static_cast<double>(s);
                if (t >= begin && t <= ends[k])
                    peak = std::max(peak, std::fabs(sequence.velocity_m_s[s]));
                else if (t > ends[k] && t < ends[k] + 2 && k < 2)
                    rest = std::max(rest, std::fabs(sequence.acceleration_m_s2[s]));
            }
            EXPECT_NEAR(peak, pgv, 2e-3 * pgv) << k;
            EXPECT_EQ(rest, 0) << k;
            begin = ends[k] + 2;
        }
    }
    const Loaded l(study);
    EXPECT_EQ(l.of(3, 2, 0).motion->acceleration_m_s2, sequences.motions[3]->acceleration_m_s2);
}

/// Nine motions at two stripes, four structures each, two shakings. Of motion m and stripe s k1 have fallen by the end
/// of the first one and k2 by that of the second: shares of 36 without a motion left out, of 32 with one.
TEST(FragilityStudy, SharesOfASequenceByHand)
{
    const Study study = small({"fragility.shakings=2", "fragility.pause_s=2", "study.realizations=4",
                               "fragility.contacts=1", "fragility.twins=1", "fragility.intensity.count=2"});
    ResultHeader header;
    header.motions = motion_table(load_motions(study));
    const double k1[9][2] = {{0, 1}, {1, 2}, {0, 0}, {0, 3}, {2, 2}, {1, 1}, {0, 2}, {0, 0}, {1, 4}},
                 k2[9][2] = {{1, 3}, {1, 3}, {0, 2}, {1, 4}, {3, 4}, {2, 2}, {0, 3}, {1, 1}, {2, 4}};
    std::vector<FragilityOutcome> rows;
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        const std::uint64_t motion = i / 8, stripe = i / 4 % 2;
        const auto structure = static_cast<double>(i % 4);
        FragilityOutcome row{i, study.cell(i), 1, {}};
        ASSERT_EQ(row.cell, 2 * motion + stripe);
        if (structure < k2[motion][stripe]) {
            row.outcome.state = State::collapsed;
            row.outcome.collapse_time_s = structure < k1[motion][stripe] ? 0.1 : 1e3;
        } else
            row.outcome.state = State::stood;
        rows.push_back(row);
    }
    const Fragility found = fragility_of(study, header, rows);
    ASSERT_EQ(found.different, 9U);
    const auto shares = [&](std::size_t without) {
        double fallen = 0, fresh = 0;
        for (std::size_t s = 0; s < 2; ++s) {
            double n = 0, by_1 = 0, by_2 = 0;
            for (std::size_t m = 0; m < 9; ++m)
                if (m != without) {
                    n += 4;
                    by_1 += k1[m][s];
                    by_2 += k2[m][s];
                }
            fallen += by_2 / n / 2;
            fresh += (1 - (1 - by_1 / n) * (1 - by_1 / n)) / 2;
        }
        return std::pair(fallen, fresh);
    };
    const auto [fallen, fresh] = shares(9);
    double sum = 0, square = 0;
    for (std::size_t m = 0; m < 9; ++m) {
        const auto [f, g] = shares(m);
        sum += f - g;
        square += (f - g) * (f - g);
    }
    // Student's quantile of eight degrees of freedom
    const double reach = 2.306004135 * std::sqrt(8.0 / 9 * (square - sum * sum / 9));
    ASSERT_EQ(found.sequence.size(), 2U);
    EXPECT_NEAR(found.sequence[1].fallen, fallen, 1e-12);
    EXPECT_NEAR(found.sequence[1].fresh, fresh, 1e-12);
    EXPECT_NEAR(found.sequence[1].beyond.lower, fallen - fresh - reach, 1e-8);
    EXPECT_NEAR(found.sequence[1].beyond.upper, fallen - fresh + reach, 1e-8);
    EXPECT_EQ(found.sequence[0].beyond.upper, 0);
}

TEST(FragilityStudy, ACollapseCountsForItsShaking)
{
    const std::vector<DamageState> states = damage_states(small({"fragility.shakings=3"}));
    Outcome o;
    o.state = State::collapsed;
    o.collapse_time_s = 12;
    std::map<std::string, bool> got;
    for (const DamageState& state : states)
        got[state.name] = reached(state, o, 1, state.shaking == 1 ? 10 : state.shaking == 2 ? 20 : INFINITY).value();
    EXPECT_FALSE(got.at("collapse_by_1"));
    EXPECT_TRUE(got.at("collapse_by_2"));
    EXPECT_FALSE(got.contains("collapse_by_3"));
    EXPECT_TRUE(got.at("collapse"));
}

TEST(FragilityStudy, LimitStatesAreNested)
{
    const Study study = small();
    const std::vector<DamageState> states = damage_states(study);
    ASSERT_EQ(states.size(), 7U);
    const double width = base_width_m(study.structure);
    EXPECT_EQ(width, 1.0);
    Outcome o;
    o.at_rest = 1;
    const auto count = [&] {
        int n = 0;
        for (const DamageState& state : states)
            n += reached(state, o, width).value();
        return n;
    };
    EXPECT_EQ(count(), 0);
    o.peak_top_displacement_m = 0.36;
    EXPECT_EQ(count(), 2);
    o.residual_dislocation = 0.006;
    EXPECT_EQ(count(), 3);
    o = {};
    o.state = State::collapsed;
    EXPECT_EQ(count(), 7);
}

TEST(FragilityStudy, TheResidualOfWhatStillMovesIsNotKnown)
{
    Outcome o;
    o.peak_top_displacement_m = 0.36;
    o.residual_dislocation = std::nan("");
    for (const DamageState& state : damage_states(small()))
        EXPECT_EQ(reached(state, o, 1).has_value(), state.kind != DamageState::Kind::residual) << state.name;
}

} // namespace stylobate
