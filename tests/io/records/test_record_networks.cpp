/// Readers of the files of strong-motion networks: GeoNet, COSMOS, ESM, K-NET and KiK-net, UNAM. Small files made here,
/// so what they hold is known, and original files whose headers state their peaks.

#include "tests/io/records/record_network_files.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace stylobate {
namespace {

/// Every component of a text in memory.
std::vector<Record> records_of(const std::string& content, const std::string& unit = "")
{
    return read_records(std::string_view(content), "record.txt", unit);
}

/// Cut behind each of its lines from `first` on, with its line end and without, a file is refused with a line.
void expect_cuts_refused(const std::string& text, std::size_t first_line)
{
    std::size_t end = 0, line = 0;
    while ((end = text.find('\n', end)) != std::string::npos && end + 1 < text.size()) {
        ++line;
        if (line >= first_line) {
            SCOPED_TRACE(fmt::format("cut behind line {}", line));
            expect_says(message_for(text.substr(0, end + 1)), {"record.txt:"});
            expect_says(message_for(text.substr(0, end)), {"record.txt:"});
        }
        ++end;
    }
}

// ---- GeoNet

TEST(GeoNet, BothVolumesGiveTheAccelerationsOfThreeComponents)
{
    for (const int volume : {1, 2})
        for (const std::string end : {"\n", "\r\n"}) {
            SCOPED_TRACE(fmt::format("V{}A, line ends of {} characters", volume, end.size()));
            const auto all = records_of(with_ends(geonet(volume), end));
            ASSERT_EQ(all.size(), 3u);
            expect_samples(all[0], 23, 10);
            expect_samples(all[1], 20, 10, 3);
            expect_samples(all[2], 21, 10, 7);
            EXPECT_EQ(all[0].orientation, "N28W");
            EXPECT_EQ(all[1].orientation, "S62W");
            EXPECT_EQ(all[2].component, "Up");
            EXPECT_DOUBLE_EQ(*all[0].header_pga_m_s2, 0.5);
            for (const Record& r : all) {
                EXPECT_EQ(r.format, "geonet");
                EXPECT_EQ(r.unit, "mm/s2");
                EXPECT_EQ(r.station, "XYZ1");
                EXPECT_EQ(r.title, "Some Where, 2003 January 01 10:00:00 UT");
                EXPECT_EQ(r.dt_s, 0.02); // and not the instrument's 0.005
            }
        }
}

TEST(GeoNet, OneDirectionForTwoComponentsNamesThemApart)
{
    const auto all = records_of(geonet_component(2, "S62W", 20) + geonet_component(2, "S62W", 20, 1));
    EXPECT_EQ(all[0].component, "S62W");
    EXPECT_EQ(all[1].component, "S62W (2)");
    EXPECT_EQ(all[1].orientation, "S62W");
}

TEST(GeoNet, WhatContradictsItselfIsRefused)
{
    const std::string good = geonet_component(2, "N28W", 23);
    expect_says(message_for(good, "g"), {"record.txt:14:", "mm/s2", "unit given is g"});
    expect_says(message_for(replaced(good, "mm/s/s at", "cm/s/s at")), {"record.txt:14:", "cm/s/s"});
    expect_says(message_for(replaced(geonet(1), "units of 1.00", "units of 0.10")), {"record.txt:11:", "0.10 mm/s/s"});
    expect_says(message_for(replaced(good, "Component", "Direction")), {"record.txt:13:", "N28W"});
    // the count of accelerations, one less or more: the blocks slide into each other
    const std::string counts = "      23      22      22";
    expect_says(message_for(replaced(good, counts, "      22      22      22")), {"record.txt:", "wrong"});
    expect_says(message_for(replaced(good, counts, "      24      22      22")), {"record.txt:", "missing"});
    expect_says(message_for(replaced(good, counts, "      23      22       0")), {"record.txt:33:", "should begin"});
    expect_says(message_for(replaced(good, counts, "       0      22      22")), {"record.txt:20:", "at least 2"});
    // the interval against the duration
    expect_says(message_for(replaced(good, "  0.0050  0.0200", "  0.0050  0.0050")),
                {"record.txt:23:", "duration", "0.44"});
    expect_says(message_for(replaced(good, "   240.0", "   24O.0")), {"record.txt:", "not a number"});
}

TEST(GeoNet, CutFilesAreRefused)
{
    // what ends behind a whole component is a file of fewer components
    expect_cuts_refused(geonet_component(2, "N28W", 23), 2);
    expect_cuts_refused(geonet_component(1, "N28W", 23), 2);
}

// ---- COSMOS

TEST(Cosmos, EveryUnitAndLayoutOfBothVolumes)
{
    struct Case {
        int volume, code;
        const char *unit, *format;
        double factor, m_s2;
    };
    for (const Case& c : {Case{2, 4, "cm/sec2(04)", "(1E15.6)", 1000, 0.01},
                          {2, 4, "cm/s^2", "(8F10.5)", 1000, 0.01},
                          {2, 10, "gal (10)", "(5E15.6)", 1000, 0.01},
                          {1, 2, "g.     (02)", "(8F10.5)", 1, g}}) {
        SCOPED_TRACE(c.unit);
        CosmosChannel channel;
        channel.volume = c.volume;
        channel.unit_code = c.code;
        channel.unit = c.unit;
        channel.format = c.format;
        channel.factor = c.factor;
        const auto all = records_of(cosmos(channel));
        ASSERT_EQ(all.size(), 1u);
        expect_samples(all[0], 20, c.factor * c.m_s2);
        EXPECT_NEAR(*all[0].header_pga_m_s2, 0.05 * c.factor * c.m_s2, 1e-12);
        EXPECT_EQ(all[0].dt_s, 0.005); // real 62; real 34 has 0.02
        EXPECT_EQ(all[0].format, "cosmos");
        EXPECT_EQ(all[0].unit, c.code == 2 ? "g" : "cm/s2");
        EXPECT_EQ(all[0].station, "XY-ABC");
        EXPECT_EQ(all[0].component, "chan 1");
        EXPECT_EQ(all[0].orientation, "360");
        EXPECT_EQ(all[0].title, "Record of Made-up Earthquake of Wed Jan 1, 2003 10:00 UTC");
    }
}

TEST(Cosmos, DirectionsByTheirCodes)
{
    for (const auto& [azimuth, orientation] : {std::pair{90, "90"},
                                               {400, "Up"},
                                               {401, "Down"},
                                               {402, "Vertical"},
                                               {600, "Longitudinal"},
                                               {0, "BNZ"},
                                               {-999, "BNZ"},
                                               {2000, "BNZ"}}) {
        CosmosChannel channel;
        channel.azimuth = azimuth;
        channel.channel = "  ?";
        channel.code = "BNZ";
        const Record r = records_of(cosmos(channel)).front();
        EXPECT_EQ(r.orientation, orientation);
        EXPECT_EQ(r.component, "BNZ"); // the channel's number is not known
    }
}

TEST(Cosmos, ChannelsOneBelowTheOtherAndOnlyTheirAccelerations)
{
    CosmosChannel first, second, velocity;
    // the other series of a channel stand as blocks below, or as channels of their own
    first.below = cosmos_values(first, "velocity", "cm/sec(05)") + cosmos_values(first, "displacement", "cm(06)");
    velocity.quantity = 2;
    velocity.unit_code = 5;
    velocity.unit = "cm/sec(05)";
    velocity.name = "velocity";
    velocity.shift = 1;
    second.channel = "  2";
    second.azimuth = 400;
    second.n = 24;
    second.shift = 5;
    const auto all = records_of(cosmos(first) + cosmos(velocity) + "\n" + cosmos(second));
    ASSERT_EQ(all.size(), 2u);
    expect_samples(all[0], 20, 10);
    expect_samples(all[1], 24, 10, 5);
    EXPECT_EQ(all[1].component, "chan 2");
    EXPECT_EQ(all[1].orientation, "Up");
    expect_says(message_for(cosmos(velocity)), {"\"velocity\"", "no acceleration"});
}

TEST(Cosmos, WhatIsNoAccelerationOrOfAnUnknownUnitIsRefused)
{
    CosmosChannel counts;
    counts.volume = 0;
    counts.unit_code = 50;
    counts.unit = "counts (50)";
    counts.name = "raw accel.  ";
    expect_says(message_for(cosmos(counts)), {"counts", "unit 50"});
    CosmosChannel mg;
    mg.unit_code = 11;
    mg.unit = "mg(11)";
    expect_says(message_for(cosmos(mg)), {"code 11", "\"mg\"", "known are"});
    mg.unit_code = -999;
    expect_says(message_for(cosmos(mg)), {"code is 11", "-999"});
    // the spelling against the code, the quantity against the spelling
    const std::string good = cosmos();
    expect_says(message_for(good, "g"), {"cm/s2", "unit given is g"});
    expect_says(message_for(replaced(good, "units=cm/sec2(04)", "units=g(04)")), {"\"g\"", "code 4"});
    expect_says(message_for(replaced(good, "units=cm/sec2(04)", "units=cm/sec2(05)")), {"code is 05 here"});
    expect_says(message_for(replaced(good, "       2       1       4", "       2       2       4")),
                {"record.txt:15:", "code 2", "acceleration"});
    // spectra have no line of points
    expect_says(message_for(replaced(good, "acceleration pts,", "spectral values at")), {"spectra?"});
}

TEST(Cosmos, MissingValuesAreRefused)
{
    CosmosChannel channel;
    channel.format = "(8F10.5)";
    const std::string good = cosmos(channel);
    EXPECT_EQ(message_for(good), "");
    const std::string second_row = fmt::format("\n{:10.5f}", 1000 * sample(8));
    expect_says(message_for(replaced(good, second_row, "\n-999.00000")), {"record.txt:47:", "value 1", "unknown"});
    // the header says which value it is
    const std::string other = replaced(good, "-999, -999.00\n", "-999,  -50.00\n");
    expect_says(message_for(other), {"-50", "unknown"});
    expect_says(message_for(replaced(good, "     5.000000", "  -999.000000")), {"real 62"});
}

TEST(Cosmos, WhatContradictsItselfIsRefused)
{
    const std::string good = cosmos();
    expect_says(message_for(replaced(good, "     5.000000", "    10.000000")), {"real 63", "0.2"});
    CosmosChannel seconds; // 5 ms in the wrong unit
    seconds.dt_ms = 0.005;
    expect_says(message_for(cosmos(seconds)), {"sampling interval"});
    expect_says(message_for(replaced(good, "approx    0 secs", "approx    9 secs")), {"9 s", "real 62"});
    expect_says(message_for(replaced(good, "   1 Comment", "   2 Comment")), {"2 comment lines", "1 follow"});
    expect_says(message_for(replaced(good, "      20 accel", "      19 accel")), {"record.txt:", "End-of-data"});
    expect_says(message_for(replaced(good, "      20 accel", "      21 accel")), {"record.txt:", "End-of-data"});
    EXPECT_EQ(message_for(replaced(good, "(1E15.6)", "(E15.6)")), ""); // one to a line
    expect_says(message_for(replaced(good, "(1E15.6)", "(1A15)")), {"(1A15)", "(8f9.6)"});
    expect_says(message_for(replaced(good, "(10I8)", "")), {"format of the values"});
    expect_says(message_for(good + "Response spectra\n"), {"next channel should begin"});
}

TEST(Cosmos, CutFilesAreRefused)
{
    expect_cuts_refused(cosmos(), 1);
}

// ---- ESM

TEST(Esm, ValuesBelowItsKeys)
{
    for (const std::string end : {"\n", "\r\n"}) {
        const Record r = records_of(with_ends(esm(), end)).front();
        expect_samples(r, 21, 10);
        EXPECT_EQ(r.format, "esm");
        EXPECT_EQ(r.unit, "cm/s2");
        EXPECT_EQ(r.dt_s, 0.005);
        EXPECT_EQ(r.station, "ABC");
        EXPECT_EQ(r.orientation, "HNE");
        EXPECT_EQ(r.component, "HNE");
        EXPECT_EQ(r.title, "MADE-UP, 20030101, Some Where");
        EXPECT_DOUBLE_EQ(*r.header_pga_m_s2, 0.5);
    }
    // Turkey's leaves more of them empty
    const Record r = records_of(esm(21, {"DURATION_S: ", "PGA_CM/S^2: ", "STATION_NAME: ", "SAMPLING_INTERVAL_S: 0.005",
                                         "DATA_TYPE: Acceleration", "STREAM: "}))
                         .front();
    expect_samples(r, 21, 10);
    EXPECT_EQ(r.header_pga_m_s2, std::nullopt);
    EXPECT_EQ(r.component, "acceleration");
    EXPECT_EQ(r.orientation, "");
}

TEST(Esm, AHeaderOfAnotherLengthEndsWithItsLastKey)
{
    std::string text = esm();
    for (int i = 25; i < 46; ++i)
        text = replaced(text, fmt::format("OTHER_{}: \n", i), "");
    expect_samples(records_of(text).front(), 21, 10);
}

TEST(Esm, WhatIsNoAccelerationIsRefusedByName)
{
    for (const std::string type : {"VELOCITY", "Displacement", "ACCELERATION RESPONSE SPECTRUM"})
        expect_says(message_for(esm(21, {"DATA_TYPE: " + type})), {"record.txt:20:", "\"" + type + "\""});
    expect_says(message_for(esm(21, {"DATA_TYPE: "})), {"record.txt:20:", "DATA_TYPE has no value"});
    expect_says(message_for(esm(21, {"UNITS: cm/s"})), {"record.txt:15:", "\"cm/s\""});
    expect_says(message_for(esm(), "g"), {"record.txt:15:", "unit given is g"});
    expect_says(message_for(esm(21, {"UNITS: "})), {"record.txt:15:", "UNITS has no value"});
    expect_says(message_for(replaced(esm(), "UNITS: ", "UNIT: ")), {"no line \"UNITS:\""});
}

TEST(Esm, CountsThatDisagreeAreRefused)
{
    expect_says(message_for(esm(21, {"NDATA: 22", "DURATION_S: "})), {"record.txt:65:", "truncated"});
    expect_says(message_for(esm(21, {"NDATA: 20"})), {"record.txt:85:", "header counts"});
    expect_says(message_for(esm(21, {"NDATA: 21.0"})), {"record.txt:12:", "21.0"});
    expect_says(message_for(esm(21, {"DURATION_S: 0.210"})), {"record.txt:13:", "0.21 s"});
    expect_says(message_for(esm(21, {"SAMPLING_INTERVAL_S: 5"})), {"record.txt:11:", "sampling interval"});
    expect_says(message_for(replaced(esm(), "\n-50.000000\n", "\n-50.00O000\n")), {"record.txt:65:", "not a number"});
    expect_says(message_for(replaced(esm(), "\n-50.000000\n", "\nnan\n")), {"record.txt:65:", "not finite"});
}

TEST(Esm, CutFilesAreRefused)
{
    expect_cuts_refused(esm(), 64);
    const std::string whole = esm();
    EXPECT_EQ(message_for(whole.substr(0, whole.size() - 1)), "");
    expect_says(message_for(whole.substr(0, whole.size() - 2)), {"record.txt:85:", "inside its last number"});
    expect_says(message_for(whole.substr(0, whole.find("USER5"))), {"record.txt:"});
}

// ---- K-NET and KiK-net

/// What a file of `knet` holds, the mean of its counts subtracted.
void expect_knet(const Record& r, std::size_t n = 100)
{
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i)
        mean += sample(static_cast<int>(i)) / static_cast<double>(n);
    ASSERT_EQ(r.acceleration_m_s2.size(), n);
    for (std::size_t i = 0; i < n; ++i)
        ASSERT_NEAR(r.acceleration_m_s2[i], 10 * (sample(static_cast<int>(i)) - mean), 1e-9) << i;
}

TEST(KNet, CountsTimesScaleWithoutTheirMean)
{
    for (const std::string max : {"Max. Acc. (gal)   ", "Max Acc. (gal)    "})
        for (const std::string end : {"\n", "\r\n"}) {
            const Record r = records_of(with_ends(knet("N-S", 100, max), end)).front();
            expect_knet(r);
            EXPECT_EQ(r.format, "knet");
            EXPECT_EQ(r.unit, "cm/s2");
            EXPECT_EQ(r.dt_s, 0.02);
            EXPECT_EQ(r.station, "ABC001");
            EXPECT_EQ(r.orientation, "N-S");
            EXPECT_EQ(r.title, "2003/01/01 10:00:00, M 6.0");
            EXPECT_DOUBLE_EQ(*r.header_pga_m_s2, 0.498);
            EXPECT_EQ(r.note.value_or("").find("without the mean of its counts, -155"), 0U)
                << r.note.value_or(""); // -7771 counts
        }
}

TEST(KNet, KikNetNumbersItsChannels)
{
    for (const auto& [number, name, orientation] : {std::tuple{"1", "NS1", "N-S"},
                                                    {"2", "EW1", "E-W"},
                                                    {"3", "UD1", "U-D"},
                                                    {"4", "NS2", "N-S"},
                                                    {"5", "EW2", "E-W"},
                                                    {"6", "UD2", "U-D"},
                                                    {"7", "7", "7"},
                                                    {"U-D", "U-D", "U-D"}}) {
        const Record r = records_of(knet(number)).front();
        EXPECT_EQ(r.component, name);
        EXPECT_EQ(r.orientation, orientation);
    }
}

TEST(KNet, WhatContradictsItselfIsRefused)
{
    const std::string good = knet();
    expect_says(message_for(knet("N-S", 99)), {"record.txt:18:", "100 values", "after 99"});
    expect_says(message_for(knet("N-S", 101)), {"record.txt:30:", "beyond the 100"});
    expect_says(message_for(knet("N-S", 108)), {"record.txt:30:", "beyond the 100"});
    expect_says(message_for(knet("N-S", 104)), {"record.txt:30:", "beyond the 100"});
    expect_says(message_for(good + "     100\n"), {"record.txt:31:", "follows"});
    expect_says(message_for(good, "g"), {"record.txt:14:", "unit given is g"});
    expect_says(message_for(replaced(good, "(gal)/", "/")), {"record.txt:14:", "3920(gal)/6182761"});
    expect_says(message_for(replaced(good, "(gal)/100000", "(gal)/0")), {"record.txt:14:", "positive"});
    expect_says(message_for(replaced(good, "Duration Time(s)  2", "Duration Time(s)  0")), {"record.txt:12:", "0"});
    expect_says(message_for(replaced(good, "50Hz", "")), {"record.txt:11:", "column 19"});
    expect_says(message_for(replaced(good, "50Hz", "0Hz")), {"record.txt:11:", "sampling interval"});
    expect_says(message_for(replaced(good, "Dir.", "Axis")), {"no line \"dir.\""});
}

TEST(KNet, CutFilesAreRefused)
{
    expect_cuts_refused(knet(), 14);
    const std::string whole = knet();
    EXPECT_EQ(message_for(whole.substr(0, whole.size() - 2)), "") << "without its last blank and line end";
    expect_says(message_for(whole.substr(0, whole.size() - 3)), {"record.txt:30:", "inside its last number"});
}

// ---- UNAM

TEST(Unam, ThreeChannelsAndNoneOfTheirPadding)
{
    for (const std::string end : {"\n", "\r\n"})
        for (const int padding : {0, 2}) {
            const auto all = records_of(with_ends(unam(20, padding), end));
            ASSERT_EQ(all.size(), 3u);
            for (std::size_t c = 0; c < 3; ++c) {
                expect_samples(all[c], 20, 10, static_cast<int>(c));
                EXPECT_EQ(all[c].component, fmt::format("canal-{}", c + 1));
                EXPECT_EQ(all[c].note.value_or("").starts_with("without the 2 rows beyond the 20"), padding == 2);
                EXPECT_EQ(all[c].format, "unam");
                EXPECT_EQ(all[c].unit, "cm/s2");
                EXPECT_EQ(all[c].station, "ABC1");
                EXPECT_EQ(all[c].dt_s, 0.004);
                EXPECT_EQ(all[c].title, "2003/01/01, SOME WHERE");
            }
            EXPECT_EQ(all[0].orientation, "V");
            EXPECT_EQ(all[1].orientation, "N90E");
            EXPECT_EQ(all[2].orientation, "N00E");
            EXPECT_DOUBLE_EQ(*all[0].header_pga_m_s2, 0.5);
            EXPECT_DOUBLE_EQ(*all[1].header_pga_m_s2, 0.49);
        }
}

TEST(Unam, RowsBeyondTheCountMustBeCopiesOfTheLast)
{
    const std::string good = unam(20, 0);
    expect_says(message_for(good + "     0.001     0.002     0.003\n"), {"record.txt:48:", "20 rows", "not a copy"});
    expect_says(message_for(good + "     0.001\n"), {"record.txt:48:", "not a copy"});
    // one of the padding rows is another
    std::string damaged = unam(20, 2);
    damaged[damaged.size() - 2] = damaged[damaged.size() - 2] == '9' ? '8' : '9';
    expect_says(message_for(damaged), {"record.txt:49:", "not a copy"});
    // the rows after a count that is too small are no padding, unless the motion stands still there
    expect_says(message_for(replaced(unam(20, 0), "/20/20/20", "/19/19/19")), {"record.txt:47:", "not a copy"});
}

TEST(Unam, WhatContradictsItselfIsRefused)
{
    const std::string good = unam();
    expect_says(message_for(good, "g"), {"cm/s2", "unit given is g"});
    expect_says(message_for(replaced(good, "Gal (cm", "cm/s (cm")), {"\"cm/s\""});
    expect_says(message_for(replaced(good, "/20/20/20", "/20/20/19")), {"differ"});
    expect_says(message_for(replaced(good, "/20/20/20", "/20/20")), {"2 values stand for the 3 channels"});
    expect_says(message_for(replaced(good, "/20/20/20", "/99999999999/99999999999/99999999999")), {"truncated"});
    expect_says(message_for(replaced(good, "/0.004/0.004/0.004", "/0.004/0.008/0.004")), {"duration", "0.16"});
    // every second sample was left out: the interval is the double, and so the duration
    expect_says(message_for(replaced(good, "DECIMACION                   : 1", "DECIMACION                   : 2")),
                {"duration"});
    expect_says(message_for(replaced(good, "3F10.3", "2F10.3")), {"rows have 2 values", "3 channels"});
    expect_says(message_for(replaced(good, "CANALES                      : 3", "CANALES                      : 13")),
                {"1 to 12"});
    const std::string half =
        replaced(replaced(good, "DECIMACION                   : 1", "DECIMACION                   : 2"),
                 "/0.08/0.08/0.08", "/0.16/0.16/0.16");
    EXPECT_EQ(records_of(half).front().dt_s, 0.008);
}

TEST(Unam, CutFilesAreRefused)
{
    expect_cuts_refused(unam(20, 0), 23);
}

// ---- original files

struct Original {
    const char* file;
    const char* format;
    const char* component;
    const char* orientation;
    const char* station;
    std::size_t n;
    double dt_s;
    double header_pga_m_s2;
    double digit_m_s2; ///< the last one of the header's peak
};

class OriginalFiles : public ::testing::TestWithParam<Original> {};

TEST_P(OriginalFiles, HaveTheirOwnHeadersPeak)
{
    const Original& want = GetParam();
    const auto path = std::filesystem::path(STYLOBATE_DATA_DIR) / "records" / "formats" / want.file;
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "no measured records: " << path << " is absent";
    const Record r = read_record(path, want.component, "");
    EXPECT_EQ(r.format, want.format);
    EXPECT_EQ(r.orientation, want.orientation);
    EXPECT_EQ(r.station, want.station);
    EXPECT_EQ(r.acceleration_m_s2.size(), want.n);
    EXPECT_DOUBLE_EQ(r.dt_s, want.dt_s);
    double pga = 0;
    for (const double a : r.acceleration_m_s2)
        pga = std::max(pga, std::fabs(a));
    EXPECT_NEAR(pga, want.header_pga_m_s2, 0.5001 * want.digit_m_s2);
    ASSERT_TRUE(r.header_pga_m_s2);
    EXPECT_NEAR(*r.header_pga_m_s2, want.header_pga_m_s2, 1e-12);
}

// Peaks as the files' headers have them, with as many digits. The header of CUP50401.012 counts 17500 rows, 70.00 s of
// 0.004 s, and the file has 17502: the last two repeat the 17500th and are left out.
constexpr const char* wtmc = "20161113_110259_WTMC_20.V2A";
constexpr const char* cup5 = "CUP50401.012";
constexpr Original originals[] = {
    {wtmc, "geonet", "N28W", "N28W", "WTMC", 8192, 0.02, 9.7331, 1e-4},
    {wtmc, "geonet", "S62W", "S62W", "WTMC", 8192, 0.02, 7.9664, 1e-4},
    {wtmc, "geonet", "Up", "Up", "WTMC", 8192, 0.02, 18.0219, 1e-4},
    {"us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c", "cosmos", "BNZ", "BNZ", "AK-BMR", 42000, 0.005, 0.06851512,
     1e-8},
    {"HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", "esm", "HNE", "HNE", "ARS1", 19128, 0.005, 0.00300022, 1e-8},
    {"HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC", "esm", "HNN", "HNN", "ARS1", 19128, 0.005, 0.00359017, 1e-8},
    {"HL.DLFA..HNE.D.20190728.160908.C.ACC.ASC", "esm", "HNE", "HNE", "DLFA", 13876, 0.005, 0.00227973, 1e-8},
    {"20101114230825_3104_ap_RawAcc_E.asc", "esm", "HNE", "HNE", "3104", 5600, 0.01, 0.01632, 1e-5},
    {"CHB0021412312349.EW", "knet", "E-W", "E-W", "CHB002", 6800, 0.01, 0.06847, 1e-5},
    {"AICH040010061330.EW2", "knet", "EW2", "E-W", "AICH04", 28600, 0.005, 0.03896, 1e-5},
    {cup5, "unam", "canal-1", "V", "CUP5", 17500, 0.004, 0.0047, 1e-4},
    {cup5, "unam", "N90E", "N90E", "CUP5", 17500, 0.004, 0.0119, 1e-4},
    {cup5, "unam", "N00E", "N00E", "CUP5", 17500, 0.004, 0.0122, 1e-4},
};

std::string name_of(const ::testing::TestParamInfo<Original>& info)
{
    std::string name = fmt::format("{}_{}_{}", info.param.format, info.param.station, info.param.component);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Networks, OriginalFiles, ::testing::ValuesIn(originals), name_of);

} // namespace
} // namespace stylobate
