/// Tables of samples as base motions: what is read, and what is refused with which words.

#include "ensemble/model/input_error.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

constexpr double pi = std::numbers::pi;

/// A file that goes with the test.
class File {
public:
    explicit File(const std::string& content)
        : path_(std::filesystem::temp_directory_path() /
                ("stylobate_base_table_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                 ".csv"))
    {
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~File() { std::filesystem::remove(path_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Rows of 0, 0.01, ... s.
std::string rows(const std::string& head, int count, const std::function<std::string(double)>& row)
{
    std::string text = head + "\n";
    for (int i = 0; i < count; ++i) {
        char time[32];
        std::snprintf(time, sizeof time, "%.2f", i * 0.01);
        text += std::string(time) + "," + row(i * 0.01) + "\n";
    }
    return text;
}

std::string digits(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

double acceleration(double t)
{
    return 3 * t * std::sin(2 * pi * 2 * t);
}

TEST(BaseTable, AnAccelerationStandsAsItIs)
{
    const File file(rows("time_s,acceleration_m_s2", 200, [](double t) { return digits(acceleration(t)); }));
    const Motion motion = read_base_table(file.path());
    EXPECT_EQ(motion.dt_s, 0.01);
    ASSERT_EQ(motion.acceleration_m_s2.size(), 200u);
    double v = 0, largest = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        const double t = static_cast<double>(i) * 0.01;
        EXPECT_DOUBLE_EQ(motion.acceleration_m_s2[i], acceleration(t));
        if (i > 0)
            v += 0.005 * (acceleration(t - 0.01) + acceleration(t));
        EXPECT_NEAR(motion.velocity_m_s[i], v, 1e-12); // nothing corrected: it may drift
        largest = std::max(largest, std::fabs(acceleration(t)));
    }
    EXPECT_DOUBLE_EQ(motion.pga_m_s2, largest);
    EXPECT_NEAR(motion.predominant_frequency_hz, 2, 0.1);
    EXPECT_FALSE(motion.corrected);
}

TEST(BaseTable, TheMotionPassesThroughItsDisplacements)
{
    // a table that stands 5 mm off its zero
    const auto u = [](double t) { return 0.005 + 0.01 * (1 - std::cos(2 * pi * t)); };
    const File file(rows("time_s,displacement_m", 126, [&](double t) { return digits(u(t)); }));
    const Motion motion = read_base_table(file.path());
    for (std::size_t i = 0; i < 126; ++i) {
        const double t = static_cast<double>(i) * 0.01;
        EXPECT_NEAR(motion.displacement_m[i], u(t) - u(0), 1e-14);
        EXPECT_NEAR(motion.acceleration_m_s2[i], 0.01 * 4 * pi * pi * std::cos(2 * pi * t), 2e-4);
    }
}

TEST(BaseTable, OtherColumnsAreLeftAlone)
{
    const File file(
        rows("time_s,top_x_m,acceleration_m_s2", 50, [](double t) { return "7," + digits(acceleration(t)); }));
    EXPECT_DOUBLE_EQ(read_base_table(file.path()).acceleration_m_s2[30], acceleration(0.3));
}

TEST(BaseTable, UnitsInTheNamesCount)
{
    const auto value = [](double t) { return digits(acceleration(t)); };
    const Motion si = read_base_table(File(rows("time_s,acceleration_m_s2", 50, value)).path());
    for (const auto& [head, factor] : {std::pair{"time_s,acceleration_cm_s2", 0.01},
                                       {"time_s,acceleration_g", 9.80665},
                                       {"Time_s,Acceleration_gal", 0.01}}) {
        const Motion motion = read_base_table(File(rows(head, 50, value)).path());
        EXPECT_NEAR(motion.acceleration_m_s2[30], factor * si.acceleration_m_s2[30], 1e-12) << head;
        EXPECT_DOUBLE_EQ(motion.dt_s, si.dt_s) << head;
    }
    const auto small = [](double t) { return digits(0.01 * acceleration(t)); };
    const auto large = [](double t) { return digits(10 * acceleration(t)); };
    const Motion metres = read_base_table(File(rows("time_s,displacement_m", 50, small)).path());
    const Motion millimetres = read_base_table(File(rows("time_s,displacement_mm", 50, large)).path());
    EXPECT_NEAR(millimetres.displacement_m[30], metres.displacement_m[30], 1e-12);
}

void expect_refused(const std::string& content, const std::vector<std::string>& words)
{
    const File file(content);
    try {
        read_base_table(file.path());
        ADD_FAILURE() << "accepted:\n" << content.substr(0, 200);
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find(file.path().string()), 0u) << message;
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in:\n" << message;
    }
}

TEST(BaseTable, ABaseThatIsHitIsFasterThanAnyGround)
{
    const auto hit = [](double t) { return digits(300 * acceleration(t)); };
    const Motion motion = read_base_table(File(rows("time_s,acceleration_m_s2", 50, hit)).path());
    EXPECT_GT(motion.pga_m_s2, 200);
    EXPECT_LT(motion.pga_m_s2, 1000);
}

TEST(BaseTable, SaysWhatIsWrong)
{
    const auto one = [](double t) { return digits(acceleration(t)); };
    expect_refused(rows("time_s,acceleration", 50, one), {"acceleration_m_s2", "The unit is part of the name"});
    expect_refused(rows("time_s,displacment_m", 50, one), {"Did you mean displacement_m?"});
    expect_refused(rows("time_s,displacment_mm", 50, one),
                   {"Did you mean displacement_mm?"}); // in the unit of the file
    expect_refused(rows("time_s,displacement_furlong", 50, one), {"displacement_m?", "displacements in m, cm, mm"});
    expect_refused("time_s;displacement_m\n0,00;0,1\n0,01;0,2\n0,02;0,4\n", {"decimal commas"});
    expect_refused(rows("time_s,base_x_m", 50, one), {"has no motion", "base_x_m", "line of names"});
    expect_refused(rows("t,acceleration_m_s2", 50, one), {"begins with the column \"t\", not with time_s"});
    expect_refused(rows("# no names", 50, one), {"begins with the column \"column 1\""});
    expect_refused(rows("time_s,acceleration_m_s2", 5, one), {"5 samples", "at least 10"});
    expect_refused(rows("time_s,acceleration_m_s2", 50, [](double) { return "0"; }), {"there is no motion"});
    expect_refused(rows("time_s,displacement_m", 50, [](double) { return "0.1"; }), {"is 0.1 at all times"});
    expect_refused(rows("time_s,acceleration_m_s2", 50, [](double t) { return digits(1e4 * acceleration(t)); }),
                   {"acceleration_m_s2 reaches", "more than 1000", "a unit is wrong"});
    expect_refused(rows("time_s,displacement_m", 50, [](double t) { return digits(1000 * acceleration(t)); }),
                   {"displacement_m reaches", "more than 200", "a unit is wrong"});
    expect_refused(rows("time_s,displacement_m", 50, [](double t) { return digits(50 * acceleration(t)); }),
                   {"peak acceleration", "more than 50", "a unit is wrong"});
    expect_refused(rows("time_s,displacement_m,acceleration_m_s2", 50,
                        [](double t) { return digits(acceleration(t)) + (t > 0.4 ? ",8e300" : ",0.1"); }),
                   {"acceleration_m_s2 reaches 8e+300", "a unit is wrong"});
    expect_refused(rows("time_s,displacement_m", 50, [](double t) { return t > 0.2 ? "0.1" : "0"; }),
                   {"too few digits"});
    expect_refused(rows("time_s,acceleration_m_s2", 50, one) + "0.51,1\n", {":52:", "a row is missing"});
    expect_refused(rows("time_s,acceleration_m_s2", 50, one) + "0.50,x\n", {":52:"});
    expect_refused("", {"is empty"});
    expect_refused("time_s,acceleration_m_s2\n", {"no row of numbers"});
}

TEST(BaseTable, AccelerationAndDisplacementTogetherDoNotDrift)
{
    // the accelerometer has a bias, which alone would drift by 0.1 m in 10 s
    const double w = 2 * pi * 2;
    const auto u = [&](double t) { return 0.01 * (1 - std::cos(w * t)); };
    const auto a = [&](double t) { return 0.01 * w * w * std::cos(w * t) + 0.002 * std::sin(1e3 * t * t); };
    const auto both = [&](double t) {
        return digits(a(t) + 0.002) + "," + digits(u(t) + 1e-6 * std::sin(7e3 * t * t));
    };
    const File file(rows("time_s,acceleration_m_s2,displacement_m", 1000, both));
    const Motion motion = read_base_table(file.path());
    const double change = motion.displacement_m.back() - motion.displacement_m.front();
    EXPECT_NEAR(change, u(9.99) - u(0), 1e-4);
    EXPECT_NEAR(motion.acceleration_m_s2[500], 0.01 * w * w * std::cos(w * 5), 0.01);
}

TEST(BaseTable, ARunOfAMeasuredCampaign)
{
    const std::filesystem::path campaign = STYLOBATE_DATA_DIR "/practice_campaigns/campaign_03.h5";
    if (!std::filesystem::exists(campaign))
        GTEST_SKIP() << "no measured campaigns beside the checkout";
    const Campaign all = read_campaign(campaign);
    const std::string run = all.runs.front().name;
    const Motion motion = read_base_table(campaign, run), same = base_motion_of(all.runs.front());
    EXPECT_EQ(motion.acceleration_m_s2, same.acceleration_m_s2);
    EXPECT_GT(motion.predominant_frequency_hz, 0);
    EXPECT_NE(motion.source.find("run " + run), std::string::npos);
    EXPECT_THROW(read_base_table(campaign, "no such run"), InputError);
}

TEST(BaseTable, AFileThatIsNotThere)
{
    try {
        read_base_table("no/such/table.csv");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("no such file. Give the path of a table of the base motion."),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace stylobate
