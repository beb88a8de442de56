/// Fragility studies under pairs of motions: which files of a folder are one, how strong a pair is, and the shaking of
/// a realization under it.

#include "ensemble/model/input_error.hpp"
#include "ensemble/motion/motions_in_space.hpp"
#include "ensemble/motion/shaking.hpp"
#include "io/files/atomic_file.hpp"
#include "io/records/ground_motion.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/motions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr double pi = std::numbers::pi;

/// Two waves whose frequencies depend on a number.
std::vector<double> pair_samples(int number, std::size_t count = 400)
{
    std::vector<double> a(count);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double t = 0.01 * static_cast<double>(i);
        a[i] = 0.1 * std::sin(pi * t / 4) * (std::sin((9 + number) * t) + 0.4 * std::sin((23 - 1.7 * number) * t));
    }
    return a;
}

std::string pair_file(const std::vector<double>& values, const std::string& direction)
{
    std::string text = "PEER NGA STRONG MOTION DATABASE RECORD\nEvent, 1/1/1999, Station, " + direction +
                       "\nACCELERATION TIME SERIES IN UNITS OF G\n" +
                       fmt::format("NPTS= {}, DT= 0.0100 SEC\n", values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{:15.7E}{}", values[i], i % 5 == 4 || i + 1 == values.size() ? "\n" : "");
    return text;
}

class MotionPairs : public testing::Test {
protected:
    TemporaryFolder scratch_;
    const fs::path folder = scratch_.path();

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    /// Recordings RSN0, RSN1, ...: two horizontal components and a vertical one each.
    void recordings(int count) const
    {
        for (int k = 0; k < count; ++k) {
            write(fmt::format("RSN{}_X_000.AT2", k), pair_file(pair_samples(3 * k), "000"));
            write(fmt::format("RSN{}_X_090.AT2", k), pair_file(pair_samples(3 * k + 1), "090"));
            write(fmt::format("RSN{}_X_UP.AT2", k), pair_file(pair_samples(3 * k + 2), "UP"));
        }
    }
    Study study(const std::string& excitation, const std::string& fragility) const
    {
        return parse_study("[study]\nkind = \"fragility\"\nrealizations = 2\n[structure]\ndimensions = 3\nblocks = 3\n"
                           "drum_width_m = 1.0\ndrum_height_m = 1.6\ndensity_kg_m3 = 2700\n[contact]\n"
                           "normal_stiffness_n_m3 = 3e9\nfriction = 0.68\n[excitation]\n" +
                               excitation + "[fragility]\n" + fragility +
                               "intensity = { measure = \"pga\", from = 2, to = 6, count = 3, spacing = \"log\" }\n",
                           "pairs.toml");
    }
    Study of_folder(const std::string& excitation, const std::string& more = "") const
    {
        return study("kind = \"record\"\n" + excitation, "folder = \"" + folder.string() + "\"\n" + more);
    }
    static double peak_of(const std::vector<double>& values) { return peak(values); }
};

TEST_F(MotionPairs, OfAFolder)
{
    recordings(3);
    const Study one = of_folder("");
    EXPECT_EQ(one.fragility->motions, 6) << "every component by itself";
    const Study pairs = of_folder("second = {}\nvertical = {}\n");
    ASSERT_EQ(pairs.fragility->motions, 3);
    for (const RecordSpec& record : pairs.fragility->records) {
        ASSERT_TRUE(record.second);
        EXPECT_NE(record.file.find("_X_000.AT2"), std::string::npos);
        std::string other = record.file;
        other.replace(other.find("_000"), 4, "_090");
        EXPECT_EQ(record.second->file, other);
    }
    EXPECT_EQ(parse_study(pairs.text, "again.toml").text, pairs.text);
    const MotionSet set = load_motions(pairs);
    ASSERT_EQ(set.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(set.second(i) && set.vertical(i));
        EXPECT_NE(set.second(i)->source.find(fmt::format("RSN{}_X_090", i)), std::string::npos);
        EXPECT_NE(set.vertical(i)->source.find(fmt::format("RSN{}_X_UP", i)), std::string::npos);
    }
    EXPECT_TRUE(load_motions(one).seconds.empty());
}

TEST_F(MotionPairs, AComponentWithoutItsOtherOneIsRefused)
{
    recordings(2);
    fs::remove(folder / "RSN1_X_090.AT2");
    try {
        of_folder("second = {}\n");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("RSN1_X_000.AT2"), std::string::npos) << message;
        EXPECT_NE(message.find("no second horizontal component"), std::string::npos) << message;
    }
    // the shorter one of a pair is its first one
    write("RSN1_X_090.AT2", pair_file(pair_samples(4, 390), "090"));
    const Study shorter = of_folder("second = {}\n");
    ASSERT_EQ(shorter.fragility->motions, 2);
    EXPECT_NE(shorter.fragility->records[1].file.find("RSN1_X_090.AT2"), std::string::npos);
    EXPECT_THROW(of_folder("second = { component = \"090\" }\n"), InputError) << "belongs to one record";
    EXPECT_THROW(of_folder("", "of_pair = \"larger\"\n"), InputError) << "there is no pair";
}

TEST_F(MotionPairs, AreAsStrongAsTheirDefinition)
{
    recordings(2);
    for (const char* definition : {"first", "larger", "geometric_mean", "at_once"}) {
        const Study pairs = of_folder("second = {}\n", fmt::format("of_pair = \"{}\"\n", definition));
        EXPECT_NE(pairs.text.find(fmt::format("of_pair = \"{}\"", definition)), std::string::npos);
        const auto set = std::make_shared<const MotionSet>(load_motions(pairs));
        for (std::size_t i = 0; i < set->size(); ++i) {
            const std::vector<double>&a = set->motions[i]->acceleration_m_s2, &b = set->second(i)->acceleration_m_s2;
            double at_once = 0;
            for (std::size_t k = 0; k < a.size(); ++k)
                at_once = std::max(at_once, std::hypot(a[k], b[k]));
            const std::string word = definition;
            const double want = word == "first"     ? peak_of(a)
                                : word == "larger"  ? std::max(peak_of(a), peak_of(b))
                                : word == "at_once" ? at_once
                                                    : std::sqrt(peak_of(a) * peak_of(b));
            EXPECT_NEAR(set->measure("pga_m_s2").value[i], want, 1e-12 * want) << definition;
            // a realization of the last stripe, 6 m/s2: both components have one factor
            RealizationHeader header;
            header.index = (3 * i + 2) * 2;
            header.step_s = 1e-3;
            Shaking(pairs, nullptr, nullptr, set).apply(pairs, {}, {}, header);
            EXPECT_NEAR(header.pga_m_s2, 6, 1e-12);
            const auto motions = motions_in_space(pairs.excitation, header, nullptr);
            for (const double t : {0.7, 1.9, 3.3}) {
                const auto at = static_cast<std::size_t>(std::lround(t / 0.01));
                EXPECT_NEAR(motions[0].displacement_m(t), 6 / want * set->motions[i]->displacement_m[at], 1e-12);
                EXPECT_NEAR(motions[1].displacement_m(t), 6 / want * set->second(i)->displacement_m[at], 1e-12);
            }
        }
    }
}

TEST_F(MotionPairs, SpectralAccelerationAtOnceIsTheLargestOfAllDirections)
{
    recordings(1);
    const MotionSet set = load_motions(of_folder("second = {}\n"));
    const std::vector<double>&a = set.motions[0]->acceleration_m_s2, &b = set.second(0)->acceleration_m_s2;
    for (const double period : {0.3, 0.6, 1.5}) {
        double largest = 0;
        for (int degree = 0; degree < 180; ++degree) {
            std::vector<double> turned(a.size());
            for (std::size_t i = 0; i < a.size(); ++i)
                turned[i] = a[i] * std::cos(degree * pi / 180) + b[i] * std::sin(degree * pi / 180);
            largest = std::max(largest, spectral_acceleration(turned, 0.01, {period}).front());
        }
        // a degree off is 1.5e-4 of it at most
        EXPECT_NEAR(spectral_acceleration_of_pair(*set.motions[0], *set.second(0), period, OfPair::at_once), largest,
                    2e-4 * largest)
            << period;
        const double first = spectral_acceleration(a, 0.01, {period}).front(),
                     second = spectral_acceleration(b, 0.01, {period}).front();
        EXPECT_NEAR(spectral_acceleration_of_pair(*set.motions[0], *set.second(0), period, OfPair::geometric_mean),
                    std::sqrt(first * second), 1e-12);
        EXPECT_EQ(spectral_acceleration_of_pair(*set.motions[0], *set.second(0), period, OfPair::larger),
                  std::max(first, second));
    }
}

TEST_F(MotionPairs, TheOtherMeasuresOfAPairByHand)
{
    const Motion first = motion_of({0, 3, 0, 0, 0}, 0.5), second = motion_of({0, 4, 0, 0, 0}, 0.5);
    const IntensityMeasures at_once = intensity_of_pair(first, second, OfPair::at_once),
                            mean = intensity_of_pair(first, second, OfPair::geometric_mean);
    EXPECT_DOUBLE_EQ(at_once.pga_m_s2, 5);
    EXPECT_DOUBLE_EQ(mean.pga_m_s2, std::sqrt(12.0));
    EXPECT_DOUBLE_EQ(at_once.pgv_m_s, 2.5); // a triangle of 5 m/s2 over 1 s
    EXPECT_DOUBLE_EQ(mean.pgv_m_s, std::sqrt(1.5 * 2.0));
    EXPECT_DOUBLE_EQ(at_once.cav_m_s, 2.5);
    EXPECT_DOUBLE_EQ(at_once.arias_m_s, pi / (2 * 9.80665) * 25 * 0.5); // by the trapezium rule
    EXPECT_DOUBLE_EQ(mean.arias_m_s, pi / (2 * 9.80665) * 12 * 0.5);
    EXPECT_DOUBLE_EQ(at_once.pgv_per_pga_s, 0.5);
}

TEST_F(MotionPairs, SequencesKeepTheirComponentsTogether)
{
    recordings(3);
    const Study pairs = of_folder("second = {}\nvertical = {}\n", "shakings = 2\npause_s = 1\n");
    const MotionSet set = load_motions(pairs);
    ASSERT_EQ(set.size(), 3U);
    for (std::size_t i = 0; i < set.size(); ++i) {
        ASSERT_TRUE(set.second(i) && set.vertical(i));
        const std::size_t n = set.motions[i]->acceleration_m_s2.size();
        EXPECT_EQ(set.second(i)->acceleration_m_s2.size(), n);
        EXPECT_EQ(set.vertical(i)->acceleration_m_s2.size(), n);
        EXPECT_EQ(set.second(i)->dt_s, set.motions[i]->dt_s);
        // each is at rest in the pause
        for (const auto& motion : {set.motions[i], set.second(i), set.vertical(i)})
            for (std::size_t k = 401; k < 499; ++k)
                EXPECT_EQ(motion->acceleration_m_s2[k], 0) << i << ' ' << k;
    }
}

TEST_F(MotionPairs, SyntheticOnesAreDrawnFromTheSeed)
{
    const Study noise = study("kind = \"noise\"\nfrequency_hz = 2\nstrong_s = 1\nsecond_ratio = 0.8\n"
                              "vertical_ratio = 0.5\n",
                              "motions = 3\n");
    const MotionSet set = load_motions(noise), again = load_motions(noise);
    ASSERT_EQ(set.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(set.second(i) && set.vertical(i));
        EXPECT_EQ(set.second(i)->acceleration_m_s2, again.second(i)->acceleration_m_s2);
        EXPECT_NE(set.second(i)->acceleration_m_s2, set.second((i + 1) % 3)->acceleration_m_s2);
        EXPECT_NEAR(set.measure("pga_m_s2").value[i],
                    std::sqrt(peak_of(set.motions[i]->acceleration_m_s2) * peak_of(set.second(i)->acceleration_m_s2)),
                    1e-12)
            << "the geometric mean is the default";
    }
}

} // namespace
} // namespace stylobate
