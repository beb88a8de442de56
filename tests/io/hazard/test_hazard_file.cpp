/// Hazard curves from files and from a power law: numbers by hand, one message for each fault.

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

class HazardFile : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("hazard_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string file(const std::string& text, const std::string& name = "hazard.csv") const
    {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    /// The message of a refusal, without the folder.
    std::string refusal(const std::vector<std::string>& given, const std::string& measure = "pga_m_s2",
                        const std::string& site = {}) const
    {
        try {
            read_hazard(given, measure, site);
        } catch (const InputError& error) {
            std::string text = error.what();
            for (std::size_t at = text.find(folder_.string()); at != std::string::npos;
                 at = text.find(folder_.string()))
                text.erase(at, folder_.string().size() + 1);
            return text;
        }
        return "read";
    }
    std::string csv_refusal(const std::string& text) const { return refusal({file(text)}); }

    fs::path folder_;
};

void expect_begins(const std::string& text, const std::string& beginning)
{
    EXPECT_TRUE(text.starts_with(beginning)) << text << "\n  should begin with " << beginning;
    EXPECT_NE(text.find("\n  "), std::string::npos) << text << "\n  has no remedy";
}

// ---- power law ------------------------------------------------------------------------------------------------------

TEST_F(HazardFile, PowerLawInItsUnit)
{
    const HazardModel hazard = read_hazard({"k0=1e-4,k=2.5,measure=pga_g,sigma_ln=0.5"}, "pga_m_s2");
    EXPECT_TRUE(hazard.unbounded);
    EXPECT_DOUBLE_EQ(hazard.intensity[0], 9.80665);
    EXPECT_DOUBLE_EQ(hazard.frequency[0], 1e-4);
    EXPECT_NEAR(std::log(hazard.frequency[0] / hazard.frequency[1]) /
                    std::log(hazard.intensity[1] / hazard.intensity[0]),
                2.5, 1e-14);
    ASSERT_EQ(hazard.fractiles.size(), 2U);
    EXPECT_NEAR(std::log(hazard.fractiles[1].frequency[0] / hazard.fractiles[0].frequency[0]), 2 * 1.6448536 * 0.5,
                1e-6);
    EXPECT_EQ(read_hazard({"k0=1e-4,k=2.5,measure=pga"}, "pga_m_s2").intensity[0], 1);
    EXPECT_EQ(read_hazard({"k0=1e-4,k=2.5,measure=sa_0.5s"}, "sa_0.5s_m_s2").measure, "sa_0.5s_m_s2");
}

/// OpenQuake's hazard library has PGA and SA in g, PGV in cm/s, PGD in cm, IA in m/s and CAV in g s.
TEST_F(HazardFile, MeasuresOfOpenQuakeAreInItsUnits)
{
    const struct {
        const char *openquake, *own;
        double si; ///< one of its unit
    } measures[] = {{"PGA", "pga_m_s2", 9.80665}, {"SA(0.5)", "sa_0.5s_m_s2", 9.80665},
                    {"PGV", "pgv_m_s", 0.01},     {"PGD", "pgd_m", 0.01},
                    {"IA", "arias_m_s", 1},       {"CAV", "cav_m_s", 9.80665}};
    for (const auto& measure : measures) {
        const std::string text =
            std::string("#,,,\"generated_by='OpenQuake engine 3.16', kind='mean', investigation_time=1.0, imt='") +
            measure.openquake + "'\"\nlon,lat,depth,poe-0.1000000,poe-0.2000000\n1,2,0,0.2,0.1\n";
        const HazardModel hazard = read_hazard({file(text)}, measure.own);
        EXPECT_NEAR(hazard.intensity[0], 0.1 * measure.si, 1e-12) << measure.openquake;
        EXPECT_NEAR(hazard.intensity[1], 0.2 * measure.si, 1e-12) << measure.openquake;
    }
    // 1 m/s = 0.10197 g s
    EXPECT_NEAR(read_hazard({file("cav_g_s,annual_frequency\n0.10197162,1e-2\n1,1e-3\n")}, "cav_m_s").intensity[0], 1,
                1e-7);
    EXPECT_NEAR(read_hazard({"k0=1e-3,k=2,measure=cav_g_s"}, "cav_m_s").intensity[0], 9.80665, 1e-12);
}

TEST_F(HazardFile, PowerLawRefusals)
{
    for (const auto& [given, what] : std::initializer_list<std::pair<const char*, const char*>>{
             {"k0=1e-4,measure=pga", "--hazard k0=1e-4,measure=pga: k is missing."},
             {"k0=1e-4,k=2", "--hazard k0=1e-4,k=2: measure is missing."},
             {"k0=1e-4,k=2,measure=pha", "--hazard k0=1e-4,k=2,measure=pha: measure = 'pha' is none of pga_m_s2,"},
             {"k0=-1,k=2,measure=pga", "--hazard k0=-1,k=2,measure=pga: k0 = -1 is outside [1e-100, 1000000]."},
             {"k0=1e-4,k=-2,measure=pga", "--hazard k0=1e-4,k=-2,measure=pga: k = -2 is outside [0.01, 30]."},
             {"k0=1e-4,k=2,k=3,measure=pga", "--hazard k0=1e-4,k=2,k=3,measure=pga: k is given twice."},
             {"k0=1,q=2", "--hazard k0=1,q=2: 'q' is no part of a power law."}})
        expect_begins(refusal({given}), what);
    expect_begins(refusal({"k0=1e-4,k=2,measure=pgv"}),
                  "k0=1e-4,k=2,measure=pgv: the hazard is of pgv_m_s, the study of pga_m_s2.");
}

// ---- tables ---------------------------------------------------------------------------------------------------------

TEST_F(HazardFile, TableWithFractilesAndUnits)
{
    const HazardModel hazard = read_hazard({file("# by a study\npga_g,annual_frequency,low,fractile_0.5,high\n"
                                                 "0.05,2e-2,1e-2,1.8e-2,4e-2\n0.1,5e-3,2e-3,4e-3,1e-2\n"
                                                 "0.4,1e-4,2e-5,7e-5,4e-4\n0.8,0,0,0,0\n")},
                                           "pga_m_s2");
    ASSERT_EQ(hazard.intensity.size(), 3U);
    EXPECT_DOUBLE_EQ(hazard.intensity[2], 0.4 * 9.80665);
    EXPECT_EQ(hazard.frequency, (std::vector<double>{2e-2, 5e-3, 1e-4}));
    ASSERT_EQ(hazard.fractiles.size(), 3U);
    EXPECT_EQ(hazard.fractiles[0].probability, 0.05);
    EXPECT_EQ(hazard.fractiles[1].frequency[1], 4e-3);
    EXPECT_EQ(hazard.fractiles[2].frequency[2], 4e-4);
    EXPECT_FALSE(hazard.unbounded);
    ASSERT_EQ(hazard.says.size(), 1U);
    EXPECT_EQ(hazard.says[0], "Left out at the upper end of the hazard: 1 intensity with a frequency of 0, of the best "
                              "estimate or of a fractile.");

    // for want of a mean
    const HazardModel median = read_hazard(
        {file("pgv_cm_s,fractile_0.16,fractile_0.5,fractile_0.84\n10,1e-3,2e-3,3e-3\n50,1e-5,2e-5,4e-5\n")}, "pgv_m_s");
    EXPECT_DOUBLE_EQ(median.intensity[1], 0.5);
    EXPECT_EQ(median.frequency[0], 2e-3);
}

TEST_F(HazardFile, TableRefusals)
{
    for (const auto& [text, what] : std::initializer_list<std::pair<const char*, const char*>>{
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,2e-3\n",
              "hazard.csv:3: annual frequency = 0.002 at pga_g = 0.2 is above 0.001 at the weaker one before it"},
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,1e-3\n",
              "hazard.csv:3: annual frequency = 0.001 at pga_g = 0.2 is that of the intensity before it"},
             {"pga_g,annual_frequency\n0.2,1e-3\n0.1,1e-2\n",
              "hazard.csv:3: pga_g = 0.1 is not above pga_g = 0.2 before it"},
             {"pga_g,annual_frequency\n0,1e-3\n0.1,1e-2\n", "hazard.csv:2: pga_g = 0 is not above 0"},
             {"pga_g,annual_frequency\n0.1,1e-3\n0.10000000001,1e-4\n",
              "hazard.csv:3: pga_g = 0.10000000001 is within a millionth of pga_g = 0.1 before it"},
             {"pga_g,annual_frequency\n0.1,1e-3\n1e308,1e-4\n",
              "hazard.csv:3: pga_g = 1e308 is not finite in SI units"},
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,1e-320\n",
              "hazard.csv:3: annual frequency = 1e-320 at pga_g = 0.2 is outside [1e-150, 1e+150]"},
             {"pga_g,annual_frequency\n0.1,1e-3\n", "hazard.csv: has 1 intensity with a finite frequency above 0"},
             {"pga_ft,annual_frequency\n0.1,1e-3\n",
              "hazard.csv:1: the first column 'pga_ft' is no intensity measure with its unit."},
             {"pga_g,frequency\n0.1,1e-3\n", "hazard.csv:1: the column 'frequency' is not known."},
             {"pga_g,anual_frequency\n0.1,1e-3\n",
              "hazard.csv:1: the column 'anual_frequency' is not known. Did you mean annual_frequency?"},
             {"pga_g\n0.1\n", "hazard.csv:1: has no column after the intensity."},
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,much\n",
              "hazard.csv:3: annual_frequency = \"much\" is not a number."},
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,\n", "hazard.csv:3: annual_frequency is empty."},
             {"pga_g,low,high\n0.1,1e-3,2e-3\n0.2,1e-4,2e-4\n", "hazard.csv: has no best estimate."},
             {"pga_g,annual_frequency,low\n0.1,1e-3,5e-4\n0.2,1e-4,5e-5\n",
              "hazard.csv: has one fractile (0.05) alone, which bounds one side."},
             {"pga_g,annual_frequency,low,high\n0.1,1e-3,2e-3,1e-3\n0.2,1e-4,5e-5,2e-4\n",
              "hazard.csv:2: fractile 0.95 = 0.001 at pga_g = 0.1 is below fractile 0.05 = 0.002."},
             {"pga_g,annual_frequency\n", "hazard.csv: has no line below its header."},
             // a sign that slipped in is no end of the curve
             {"pga_g,annual_frequency\n0.1,1e-3\n0.2,1e-4\n0.3,-1e-5\n",
              "hazard.csv:4: annual frequency = -1e-05 at pga_g = 0.3 is not above 0 and finite."},
             {"", "hazard.csv: is empty."}})
        expect_begins(csv_refusal(text), what);
    expect_begins(csv_refusal("pgv_m_s,annual_frequency\n0.1,1e-3\n0.2,1e-4\n"),
                  "hazard.csv: the hazard is of pgv_m_s, the study of pga_m_s2.");
    expect_begins(refusal({file("pga_g,annual_frequency\n0.1,1e-3\n0.2,1e-4\n")}, "sa_1s_m_s2"),
                  "hazard.csv: the hazard is of pga_m_s2, the study of sa_1s_m_s2.");
    EXPECT_NE(refusal({"no_such_file.csv"}).find("no_such_file.csv"), std::string::npos);
}

// ---- OpenQuake ------------------------------------------------------------------------------------------------------

std::string openquake(const std::string& kind, const std::string& poes, const std::string& more = "")
{
    return "#,,,,\"generated_by='OpenQuake engine 3.16.0', start_date='2024-01-01T00:00:00', checksum=1, kind='" +
           kind + "', investigation_time=50.0, imt='PGA'\"\nlon,lat,depth,poe-0.0100000,poe-0.1000000,poe-0.5000000\n" +
           "23.72600,37.97100,0.00000," + poes + "\n" + more;
}

TEST_F(HazardFile, OpenQuakeTable)
{
    const HazardModel hazard = read_hazard({file(openquake("mean", "9.9E-01,3.0E-01,2.0E-03"))}, "pga_m_s2");
    EXPECT_EQ(hazard.site, "23.726,37.971");
    ASSERT_EQ(hazard.intensity.size(), 3U);
    EXPECT_NEAR(hazard.intensity[1], 0.980665, 1e-12);
    EXPECT_NEAR(hazard.frequency[0], -std::log(0.01) / 50, 1e-14);
    EXPECT_NEAR(hazard.frequency[1], -std::log(0.7) / 50, 1e-15);
    EXPECT_NEAR(hazard.frequency[2], 4.004005e-5, 1e-10);

    // a probability of 1 has no frequency
    const HazardModel saturated = read_hazard({file(openquake("mean", "1.0E+00,3.0E-01,2.0E-03"))}, "pga_m_s2");
    EXPECT_EQ(saturated.intensity.size(), 2U);
    EXPECT_EQ(saturated.says.size(), 1U);
}

TEST_F(HazardFile, OpenQuakeFractilesInFilesOfTheirOwn)
{
    const std::string mean = file(openquake("mean", "9.0E-01,3.0E-01,2.0E-03"), "mean.csv"),
                      low = file(openquake("quantile-0.16", "8.0E-01,2.0E-01,1.0E-03"), "low.csv"),
                      high = file(openquake("quantile-0.84", "9.5E-01,4.0E-01,4.0E-03"), "high.csv");
    const HazardModel hazard = read_hazard({high, mean, low}, "pga_m_s2");
    ASSERT_EQ(hazard.fractiles.size(), 2U);
    EXPECT_EQ(hazard.fractiles[0].probability, 0.16);
    EXPECT_NEAR(hazard.fractiles[0].frequency[1], -std::log(0.8) / 50, 1e-15);
    EXPECT_NEAR(hazard.frequency[1], -std::log(0.7) / 50, 1e-15);
    EXPECT_EQ(hazard.source, high + ", " + mean + ", " + low);
    // a fault is reported of the file that has it
    const std::string rises = file(openquake("quantile-0.5", "8.0E-01,2.0E-01,3.0E-01"), "rises.csv");
    expect_begins(refusal({mean, rises}), "rises.csv:3: annual frequency = 0.0071335 at poe-0.5000000 is above");
    expect_begins(refusal({mean, mean}), "mean.csv: has a mean, as mean.csv.");
    expect_begins(refusal({low, high}), "low.csv: has no best estimate.");
    expect_begins(refusal({mean, "k0=1e-4,k=2,measure=pga"}),
                  "k0=1e-4,k=2,measure=pga: is a power law or goes with one: mean.csv.");
}

TEST_F(HazardFile, OpenQuakeSites)
{
    const std::string two = file(openquake("mean", "9.0E-01,3.0E-01,2.0E-03", "22.5,37.5,0,8.0E-01,1.0E-01,1.0E-03\n"));
    expect_begins(refusal({two}), "hazard.csv: has hazard curves of 2 sites: 0 (23.726,37.971), 1 (22.5,37.5).");
    for (const char* site : {"1", "22.5,37.5", "22.5004,37.4996"})
        EXPECT_NEAR(read_hazard({two}, "pga_m_s2", site).frequency[1], -std::log(0.9) / 50, 1e-15) << site;
    expect_begins(refusal({two}, "pga_m_s2", "2"), "--site 2: hazard.csv has 2 sites, from 0 to 1");
    expect_begins(refusal({two}, "pga_m_s2", "22.6,37.5"),
                  "--site 22.6,37.5: hazard.csv has no site within 0.001 degrees; the nearest is 22.5,37.5.");
    EXPECT_TRUE(refusal({two}, "pga_m_s2", "here,there").starts_with("--site here,there: is neither"));
    EXPECT_TRUE(refusal({"k0=1e-4,k=2,measure=pga"}, "pga_m_s2", "0").starts_with("--site 0: a power law"));
}

TEST_F(HazardFile, OpenQuakeRefusals)
{
    EXPECT_EQ(csv_refusal(openquake("mean", "1.5E+00,3.0E-01,2.0E-03")),
              "hazard.csv:3: poe-0.0100000 = 1.5 is no probability in [0, 1].");
    expect_begins(csv_refusal(openquake("mean", "3.0E-01,4.0E-01,2.0E-03")),
                  "hazard.csv:3: annual frequency = 0.0102165 at poe-0.1000000 is above 0.0071335");
    EXPECT_TRUE(csv_refusal("#,\"imt='MMI', investigation_time=50\"\nlon,lat,poe-1\n1,2,0.1\n")
                    .starts_with("hazard.csv:1: imt = 'MMI' is none of"));
    expect_begins(csv_refusal("#,\"imt='PGA'\"\nlon,lat,poe-1\n1,2,0.1\n"),
                  "hazard.csv:1: the comment has no investigation_time above 0");
    expect_begins(csv_refusal("#,\"imt='PGA', investigation_time=50\"\nlon,lat\n1,2\n"),
                  "hazard.csv:2: the header has no columns lon, lat and poe-INTENSITY.");
}

std::string nrml(const std::string& attributes, const std::string& curves)
{
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns:gml=\"http://www.opengis.net/gml\"\n      "
           "xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  <hazardCurves " +
           attributes + ">\n    <IMLs>0.01 0.1 0.5</IMLs>\n" + curves + "  </hazardCurves>\n</nrml>\n";
}
std::string curve(const std::string& place, const std::string& poes)
{
    return "    <hazardCurve>\n      <gml:Point><gml:pos>" + place + "</gml:pos></gml:Point>\n      <poEs>" + poes +
           "</poEs>\n    </hazardCurve>\n";
}

TEST_F(HazardFile, Nrml)
{
    const std::string mean = file(nrml("statistics=\"mean\" IMT=\"SA\" saPeriod=\"0.5\" saDamping=\"5.0\" "
                                       "investigationTime=\"50.0\"",
                                       curve("23.726 37.971", "0.9 0.3 0.002")),
                                  "mean.xml");
    const HazardModel hazard = read_hazard({mean}, "sa_0.5s_m_s2");
    EXPECT_EQ(hazard.site, "23.726,37.971");
    EXPECT_NEAR(hazard.intensity[2], 0.5 * 9.80665, 1e-12);
    EXPECT_NEAR(hazard.frequency[1], -std::log(0.7) / 50, 1e-15);
    const auto quantile = [&](const char* p, const char* poes) {
        return file(nrml("statistics=\"quantile\" quantileValue=\"" + std::string(p) +
                             "\" IMT=\"SA\" saPeriod=\"0.5\" investigationTime=\"50.0\"",
                         curve("23.726 37.971", poes)),
                    std::string(p) + ".xml");
    };
    const std::string low = quantile("0.1", "0.8 0.2 0.001"), high = quantile("0.9", "0.95 0.4 0.004");
    EXPECT_EQ(read_hazard({mean, low, high}, "sa_0.5s_m_s2").fractiles.size(), 2U);
    expect_begins(refusal({mean}), "mean.xml: the hazard is of sa_0.5s_m_s2, the study of pga_m_s2.");
}

TEST_F(HazardFile, NrmlRefusals)
{
    const char* const plain = "IMT=\"PGA\" investigationTime=\"50\"";
    const auto said = [&](const std::string& text) { return refusal({file(text, "h.xml")}); };
    EXPECT_TRUE(said("<nrml><hazard").starts_with("h.xml:1: no XML")) << said("<nrml><hazard");
    expect_begins(said("<nrml>\n<fragilityModel/>\n</nrml>"), "h.xml:1: <nrml> contains no <hazardCurves>.");
    EXPECT_EQ(said(nrml("IMT=\"PGA\"", curve("1 2", "0.3 0.2 0.1"))),
              "h.xml:4: <hazardCurves> has no attribute 'investigationTime'.");
    EXPECT_EQ(said(nrml(plain, curve("1 2", "0.3 0.2"))), "h.xml:8: has 2 probabilities at 3 intensities.");
    EXPECT_EQ(said(nrml(plain, curve("1 2", "0.3 x 0.1"))), "h.xml:8: 'x' in <poEs> is not a number.");
    expect_begins(said(nrml(plain, curve("1 2", "0.3 0.4 0.1"))), "h.xml:8: annual frequency = ");
    expect_begins(said(nrml(plain, curve("1 2", "0.3 0.2 0.1") + curve("3 4", "0.3 0.2 0.1"))),
                  "h.xml: has hazard curves of 2 sites");
    EXPECT_EQ(said(nrml(plain, "")), "h.xml: contains no hazard curve of a site.");
}

/// Whatever a file holds: it is refused with one message, or it is a hazard that can be used.
TEST_F(HazardFile, MutatedFilesAreRefusedOrUsable)
{
    const std::vector<std::string> seeds = {
        openquake("quantile-0.16", "9.0E-01,3.0E-01,2.0E-03", "22.5,37.5,0,8.0E-01,1.0E-01,1.0E-03\n"),
        openquake("mean", "9.0E-01,3.0E-01,2.0E-03"),
        "pga_g,annual_frequency,low,high\n0.05,2e-2,1e-2,4e-2\n0.1,5e-3,2e-3,1e-2\n0.4,1e-4,2e-5,4e-4\n",
        nrml("statistics=\"mean\" IMT=\"PGA\" investigationTime=\"50\"", curve("1 2", "0.3 0.2 0.1"))};
    std::mt19937_64 random(3);
    int used = 0, refused = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string text = seeds[random() % seeds.size()];
        for (std::uint64_t edits = 1 + random() % 4; edits > 0; --edits) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
            case 0:
                text[at] = "0123456789.-e,\n<>='\"#x"[random() % 22];
                break;
            case 1:
                text.erase(at, 1 + random() % 9);
                break;
            case 2:
                text.insert(at, text.substr(random() % text.size(), random() % 20));
                break;
            default:
                text[at] = static_cast<char>(random());
            }
            if (text.empty())
                text = "\n";
        }
        try {
            const HazardModel hazard = read_hazard({file(text)}, "pga_m_s2");
            ++used;
            ASSERT_GE(hazard.intensity.size(), 2U);
            ASSERT_LT(hazard.frequency.back(), hazard.frequency[hazard.frequency.size() - 2]) << text;
            for (std::size_t k = 0; k < hazard.intensity.size(); ++k) {
                ASSERT_TRUE(hazard.frequency[k] > 0 && std::isfinite(hazard.frequency[k])) << text;
                ASSERT_TRUE(k == 0 || hazard.intensity[k] > hazard.intensity[k - 1]) << text;
                ASSERT_TRUE(k == 0 || hazard.frequency[k] <= hazard.frequency[k - 1]) << text;
                for (const HazardFractile& f : hazard.fractiles)
                    ASSERT_GT(f.frequency.at(k), 0) << text;
            }
        } catch (const InputError& error) {
            ++refused;
        }
    }
    EXPECT_GT(used, 100);
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace stylobate
