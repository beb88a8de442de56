/// The pause between two events, or two shakings: a longer one than the default changes nothing where the contacts stop
/// the rocking, a short one does.

#include "io/study/study_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "tests/studies/kinds/single_runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace stylobate {
namespace {

/// A column of two small drums, 120 / p = 12.8 s. @param kind lines of the kind, with those of its tables
std::string column(const std::string& kind, const std::string& pause, const std::string& tables)
{
    return "[study]\nkind = \"" + kind +
           "\"\nrealizations = 8\n[structure]\nblocks = 2\ndrum_width_m = 0.05\n"
           "drum_height_m = 0.08\ndepth_m = 0.05\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 1e8\n"
           "friction = 0.7\ndamping = \"ends\"\nnormal_damping_ratio = 0.3\n[perturbation]\n"
           "friction = { distribution = \"normal\", cov = 0.1, min = 0.4, max = 1 }\n"
           "drum_offset = { distribution = \"normal\", sd_m = 0.001, per = \"block\" }\n" +
           tables + "\n" + pause + "\n";
}

/// Two pulses of a survival study.
std::string events(const std::string& pause)
{
    return column("survival", pause,
                  "phase = { distribution = \"uniform\" }\n[excitation]\nkind = \"pulse\"\n"
                  "[surface]\nfrequency_hz = { from = 3, to = 5, count = 2 }\n"
                  "pga_m_s2 = { from = 5, to = 12, count = 6 }\n[survival]\nevents = 2");
}

/// Two pulses of a fragility study.
std::string shakings(const std::string& pause)
{
    return column("fragility", pause,
                  "phase = { distribution = \"uniform\" }\n[excitation]\nkind = \"pulse\"\nfrequency_hz = 3\n"
                  "[fragility]\nmotions = 3\nintensity = { measure = \"pga\", from = 3, to = 9, count = 4 }\n"
                  "shakings = 2");
}

/// How many realizations collapse under one of the two alone.
std::size_t differ(const std::string& a, const std::string& b)
{
    const auto outcomes = [](const std::string& text) {
        const Study study = parse_study(text, "pause.toml");
        return collapsed_of(Experiment(study, motions_of(study)), best_isa());
    };
    const auto of_a = outcomes(a), of_b = outcomes(b);
    EXPECT_EQ(of_a.size(), of_b.size());
    std::size_t n = 0, fallen = 0;
    for (const auto& [index, collapsed] : of_a) {
        n += collapsed != of_b.at(index);
        fallen += collapsed;
    }
    EXPECT_GT(fallen, of_a.size() / 8);
    EXPECT_LT(fallen, of_a.size() * 7 / 8);
    return n;
}

TEST(Pause, TwiceTheDefaultChangesNothingWhereContactsStopTheRocking)
{
    const double rest_s = 120 / std::sqrt(3 * 9.81 / (4 * std::hypot(0.08, 0.025)));
    for (const auto& study : {events, shakings}) {
        EXPECT_LE(differ(study(""), study(fmt::format("pause_s = {}", 2 * rest_s))), 1U);
        EXPECT_GT(differ(study(""), study("pause_s = 0.05")), 3U);
    }
}

} // namespace
} // namespace stylobate
