/// Readers of ground-motion files: every spelling that occurs, and every way in which a file lies. The files are made
/// here, so what they hold is known.

#include "tests/io/records/record_files.hpp"

#include <algorithm>
#include <random>
#include <tuple>
#include <utility>

namespace stylobate {
namespace {

// ---- PEER AT2

TEST_F(RecordFiles, At2InEverySpellingAndLineEnd)
{
    for (const std::string size :
         {"NPTS=    23, DT=   .0100 SEC,            ", "NPTS=   23  DT=   .0100 SEC,     ",
          "NPTS=   23  DT=   .0100 SEC", "NPTS=  23, DT= .01000 SEC",
          "NPTS=   23  DT=   .0100 SEC,  -5 POLE @      .05000 HZ,   0 POLE @      .00000",
          "npts = 23, dt = 1.0E-02 sec", "    23    .0100    NPTS, DT", "  .0100    23    DT, NPTS",
          "DT=   .0100 SEC, NPTS=    23", "NPTS: 23, DT: .01", "NPTS 23 , DT .0100SEC", "NPTS=23,DT=.01s,AMAX=.05"})
        for (const std::string end : {"\n", "\r\n", "\r\r\n", "\r"})
            for (const int per_line : {5, 8}) {
                SCOPED_TRACE(fmt::format("'{}', end of {} characters, {} to a line", size, end.size(), per_line));
                const Record r = read_record(file(at2(size, 23, end, per_line)), "", "");
                expect_samples(r, 23, g);
                EXPECT_EQ(r.dt_s, 0.01);
                EXPECT_EQ(r.format, "peer-at2");
                EXPECT_EQ(r.unit, "g");
                EXPECT_EQ(r.component, "180");
                EXPECT_EQ(r.orientation, "180");
                EXPECT_EQ(r.station, "El Centro Array #9");
                EXPECT_FALSE(r.header_pga_m_s2);
                EXPECT_EQ(r.title, "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180");
            }
}

TEST_F(RecordFiles, At2WithAHeaderInWordsOfItsOwn)
{
    std::string text =
        "Data for El Centro 1940\n5 points in the format of 8F10.5, i.e., 8 points across in a row\n"
        "The units are (g)\nNPTS=  5, DT= .02000 SEC\n   0.00630   0.00364  -0.00099   0.00428  -0.03758";
    const Record r = read_record(file(text), "", "g");
    EXPECT_EQ(r.acceleration_m_s2.size(), 5u);
    EXPECT_DOUBLE_EQ(r.acceleration_m_s2[4], -0.03758 * g);
    EXPECT_EQ(r.dt_s, 0.02);
    EXPECT_EQ(r.component, "acceleration");
}

TEST_F(RecordFiles, At2CountMustBeTheHeaders)
{
    expect_says(refusal(at2("NPTS=    24, DT=   .0100 SEC", 23)), {"record.txt:4:", "24", "23", "truncated"});
    expect_says(refusal(at2("NPTS=    22, DT=   .0100 SEC", 23)), {"22", "23 values"});
    // a claim that no memory could hold costs nothing
    expect_says(refusal(at2("NPTS=9000000000000000000, DT=   .0100 SEC", 23)), {"9000000000000000000", "23 values"});
    for (const std::string npts : {"0", "1", "-23", "23.5", "2x", "", "99999999999999999999999"})
        expect_says(refusal(at2("NPTS= " + npts + ", DT=   .0100 SEC", 23)), {"record.txt:4:", "at least 2"});
}

TEST_F(RecordFiles, At2CutAnywhereIsRefused)
{
    const std::string whole = at2();
    const std::size_t last_value = whole.find_last_of("0123456789");
    for (std::size_t length = 0; length <= last_value; ++length)
        refusal(whole.substr(0, length));
    // only the line end is gone: nothing is lost
    expect_samples(read_record(file(whole.substr(0, last_value + 1)), "", ""), 23, g);
}

TEST_F(RecordFiles, At2LastNumberCutInsideItsExponentIsNamed)
{
    std::string text = at2();
    text.resize(text.size() - 2); // "...E-02\n" to "...E-0": still a number, and the count is right
    expect_says(refusal(text), {"record.txt:9:", "inside its last number"});
    // free format without aligned columns: the number of decimals tells
    expect_says(refusal("UNITS ARE G\nNPTS= 6, DT= .01\n0.001 0.002 -0.003\n-0.001 0.02"), {"6", "5 values"});
    expect_says(refusal("UNITS ARE G\nNPTS= 6, DT= .01\n0.001 0.002 -0.003\n-0.001 0.020 0.01"), {"last number"});
}

TEST_F(RecordFiles, At2BadNumbersAreNamedWithTheirLine)
{
    const std::string line_7 = fmt::format("{:15.7E}", sample(12));
    for (const std::string bad :
         {"      0.1234O67", "            abc", "        1..0E-1", "         1.0E-1x", "   ********   "})
        expect_says(refusal(replaced(at2(), line_7, bad)), {"record.txt:7:", "is not a number"});
    for (const std::string bad : {"            nan", "            inf", "      -Infinity"})
        expect_says(refusal(replaced(at2(), line_7, bad)), {"record.txt:7:", "not finite"});
    expect_says(refusal(replaced(at2(), line_7, "          1E999")), {"record.txt:7:", "range"});
    expect_says(refusal(at2() + "see the report\n"), {"record.txt:10:", "\"see\" is not a number"});
}

TEST_F(RecordFiles, At2SamplingIntervalIsChecked)
{
    for (const std::string dt : {"0", "-.01", "10.0", "1E-9"})
        expect_says(refusal(at2("NPTS= 23, DT= " + dt + " SEC", 23)), {"record.txt:4:", "sampling interval", "0.5"});
    expect_says(refusal(at2("NPTS= 23, DT= nan SEC", 23)), {"record.txt:4:", "not finite"});
    expect_says(refusal(at2("NPTS= 23", 23)), {"record.txt:4:", "DT is missing"});
    expect_says(refusal(replaced(at2(), "NPTS", "NPQS")), {"no line like", "NPTS"});
}

TEST_F(RecordFiles, At2OfVelocityOrDisplacementIsRefused)
{
    const std::string line = "ACCELERATION TIME SERIES IN UNITS OF G";
    for (const auto& [words, series] : {std::pair{"VELOCITY TIME SERIES IN UNITS OF CM/S", "velocity"},
                                        {"VELOCITY TIME HISTORY IN UNITS OF CM/SEC", "velocity"},
                                        {"Velocity  time history", "velocity"}, // whatever unit is given
                                        {"VELOCITY IN UNITS OF G", "velocity"},
                                        {"DISPLACEMENT TIME SERIES IN UNITS OF CM", "displacement"}})
        for (const char* unit : {"", "g"})
            expect_says(refusal(replaced(at2(), line, words), unit),
                        {"record.txt:3:", series, "not an acceleration", ".AT2"});
    expect_says(refusal(replaced(at2(), line, "UNITS OF CM/S")), {"\"cm/s\" is not one of acceleration"});
}

TEST_F(RecordFiles, At2SaysItsUnit)
{
    EXPECT_EQ(read_record(file(at2()), "", "g").unit, "g");
    for (const std::string unit : {"m/s2", "cm/s2", "gal", "mm/s2"})
        expect_says(refusal(at2(), unit), {"record.txt:3:", "in the file is g"});
    EXPECT_DOUBLE_EQ(read_record(file(replaced(at2(), "UNITS OF G", "UNITS OF CM/S/S")), "", "").acceleration_m_s2[0],
                     -0.0005);
    expect_says(refusal(replaced(at2(), "UNITS OF G", "UNITS OF FURLONG")), {"record.txt:3:", "furlong"});
    expect_says(
        refusal(replaced(at2(), "ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S")),
        {"record.txt:3:", "velocity"});
    const std::string silent = replaced(at2(), "IN UNITS OF G", "");
    expect_says(refusal(silent), {"does not contain the unit"});
    expect_samples(read_record(file(silent), "", "m/s2"), 23, 1);
    expect_says(refusal(at2(), "ft/s2"), {"unit = \"ft/s2\"", "\"mm/s2\""});
}

// ---- plain columns

TEST_F(RecordFiles, ColumnsWithAnySeparatorAndAnyFirstTime)
{
    for (const std::string separator : {"  ", ",", ", ", ";", "\t", " , "})
        for (const double first : {0.0, 0.005, 12.5, -1.0}) {
            SCOPED_TRACE(fmt::format("'{}' from {} s", separator, first));
            const auto all = read_records(file(columns(12, 3, separator, first)), "m/s2");
            ASSERT_EQ(all.size(), 3u);
            for (int c = 0; c < 3; ++c) {
                expect_samples(all[static_cast<std::size_t>(c)], 12, 1, c);
                EXPECT_EQ(all[static_cast<std::size_t>(c)].component, fmt::format("column {}", c + 2));
                EXPECT_EQ(all[static_cast<std::size_t>(c)].dt_s, 0.005);
                EXPECT_EQ(all[static_cast<std::size_t>(c)].format, "columns");
            }
        }
}

TEST_F(RecordFiles, ColumnsUnitIsGivenNeverGuessed)
{
    expect_says(refusal(columns()), {"do not contain the unit", "cm/s2"});
    for (const auto& [unit, canonical, factor] :
         {std::tuple{"g", "g", g}, {"m/s2", "m/s2", 1.0}, {"cm/s2", "cm/s2", 0.01}, {"gal", "cm/s2", 0.01}}) {
        const Record r = read_record(file(columns()), "", unit);
        expect_samples(r, 12, factor);
        EXPECT_EQ(r.unit, canonical);
    }
    const Record r = read_record(file("0 0\n0.01 900\n0.02 -150\n"), "", "mm/s2");
    EXPECT_DOUBLE_EQ(r.acceleration_m_s2[1], 0.9);
    EXPECT_DOUBLE_EQ(r.acceleration_m_s2[2], -0.15);
}

TEST_F(RecordFiles, ColumnsMayHaveCommentsAndNames)
{
    const std::string body = columns(12, 2, ",");
    const auto all = read_records(file("# Kalamata, harbour\n% second\n\ntime (s), N-S acc, E-W acc\n" + body), "m/s2");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].component, "N-S acc");
    EXPECT_EQ(all[1].component, "E-W acc");
    EXPECT_EQ(all[0].title, "Kalamata, harbour");
    expect_samples(all[1], 12, 1, 1);
    // one name for each column, or numbers
    EXPECT_EQ(read_records(file("Time (s) Acc (m/s2)\n" + body), "m/s2")[1].component, "column 3");
    EXPECT_EQ(read_records(file("t a a\n" + body), "m/s2")[1].component, "column 3");
    // a damaged first row is not a line of names
    expect_says(refusal("0.0O00,0.1,0.1\n" + body, "m/s2", "2"), {"an unknown format"});
    expect_says(refusal("t a b\nof two lines\n" + body, "m/s2", "2"), {"an unknown format"});
}

TEST_F(RecordFiles, ComponentIsNamedAmongSeveral)
{
    const std::string text = "time,090,Up\n" + columns(12, 2, ",");
    expect_says(refusal(text, "m/s2"), {"2 components", "\"090\", \"Up\""});
    expect_says(refusal(columns(12, 3), "m/s2"), {"\"column 2\", \"column 3\", \"column 4\""});
    expect_says(refusal(text, "m/s2", "north"), {"\"north\" is not in it", "\"090\", \"Up\""});
    for (const std::string bad : {"1", "4", "0", "-2", "column 1", "column"}) // the first column is the time
        expect_says(refusal(text, "m/s2", bad), {"is not in it"});
    for (const std::string name : {"up", "UP", "3", "column 3"})
        expect_samples(read_record(file(text), name, "m/s2"), 12, 1, 1);
    expect_samples(read_record(file(text), "090", "m/s2"), 12, 1, 0);
    EXPECT_EQ(read_record(file(at2()), "180", "").component, "180");
    expect_says(refusal(at2(), "", "270"), {"\"180\""});
    expect_says(refusal(at2(), "", "2"), {"\"180\""});
}

TEST_F(RecordFiles, SingleColumnSaysItsIntervalInAComment)
{
    std::string body;
    for (int i = 0; i < 12; ++i)
        body += fmt::format("{:.4f}\n", sample(i));
    expect_says(refusal(body, "m/s2"), {"single column", "# dt = 0.01"});
    for (const std::string line : {"# dt = 0.01\n", "%dt_s: 0.01 s\n", "# title\n# DT=1e-2\nacceleration\n"}) {
        const Record r = read_record(file(line + body), "", "m/s2");
        expect_samples(r, 12, 1);
        EXPECT_EQ(r.dt_s, 0.01);
        EXPECT_EQ(r.component, "column 1");
    }
    expect_says(refusal("# dt = 10 ms\n" + body, "m/s2"), {"record.txt:1:", "seconds"});
    expect_says(refusal("# dt = 10\n" + body, "m/s2"), {"record.txt:1:", "sampling interval"});
    expect_says(refusal("# dt = 0.01\n" + columns(), "m/s2"), {"0.01", "0.005"});
}

TEST_F(RecordFiles, ColumnsTimesMustBeUniform)
{
    const std::string body = columns();
    expect_says(refusal(replaced(body, "0.0300  ", "0.0330  "), "m/s2"), {"record.txt:7:", "0.033"});
    const std::size_t row = body.find("0.0300"), next = body.find("0.0350");
    expect_says(refusal(body.substr(0, row) + body.substr(next), "m/s2"), {"record.txt:7:", "missing"});
    expect_says(refusal(body.substr(0, next) + body.substr(row), "m/s2"), {"record.txt:8:", "duplicated"});
    // each step almost right, the whole not: a clock that drifts
    std::string drift;
    for (int i = 0; i < 100; ++i)
        drift += fmt::format("{:.6f} {:.4f}\n", 0.01 * i * (1 + 0.0004 * i), sample(i));
    expect_says(refusal(drift, "m/s2"), {"off the uniform"});
    // rounded times are uniform: 1/256 s in four decimals, and 1/3 of 0.01 s in five
    for (const auto& [dt, decimals] : {std::pair{1.0 / 256, 4}, {0.01 / 3, 5}}) {
        std::string rounded;
        for (int i = 0; i < 2000; ++i)
            rounded += fmt::format("{:.{}f} {:.4f}\n", dt * i, decimals, sample(i));
        EXPECT_NEAR(read_record(file(rounded), "", "m/s2").dt_s, dt, 2e-5 * dt);
    }
    // milliseconds
    std::string milliseconds;
    for (int i = 0; i < 12; ++i)
        milliseconds += fmt::format("{} {:.4f}\n", 5 * i, sample(i));
    expect_says(refusal(milliseconds, "m/s2"), {"sampling interval is 5 s"});
    // values without a time, several to a line
    expect_says(refusal("0.1 0.2 0.3\n-0.1 0.2 0.1\n-0.2 0.1 0.3\n", "m/s2", "2"), {"does not increase"});
}

TEST_F(RecordFiles, ColumnsDamageIsNamedWithItsLine)
{
    const std::string body = columns(12, 2, ",");
    const std::string row = body.substr(body.find("0.0100,"), body.find("0.0150,") - body.find("0.0100,") - 1);
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 2);
    for (const auto& [bad, what] : {std::pair{"0.0100,0.1", "2 columns"},
                                    {"0.0100,0.1,0.1,0.1", "4 columns"},
                                    {"0.0100,0.1,", "missing between"},
                                    {"0.0100,,0.1", "missing between"},
                                    {"", "empty line"},
                                    {"0.0100,0.1,0.l", "is not a number"},
                                    {"0.0100,0.1,nan", "not finite"},
                                    {"# 0.0100,0.1,0.1", "columns"},
                                    {"0.0100,0.1,1e-999", "range"}})
        expect_says(refusal(replaced(body, row, bad), "m/s2", "2"), {"record.txt:3:", what});
    expect_says(refusal("0.0 0.1\n", "m/s2"), {"one row"});
    // cut inside the last row: its columns, or the last number's decimals
    for (std::size_t cut = 2; cut < row.size(); ++cut) {
        std::string text = body.substr(0, body.size() - cut);
        if (text.back() != '\n')
            refusal(text, "m/s2", "2");
    }
    expect_samples(read_record(file(body.substr(0, body.size() - 1)), "3", "m/s2"), 12, 1, 1);
    // right-aligned numbers of different lengths: the column where they end tells
    const std::string aligned = "  0.00       0\n  0.01   0.125\n  0.02  -0.250\n  0.03   0.111";
    EXPECT_EQ(read_record(file(aligned), "", "m/s2").acceleration_m_s2.size(), 4u);
    expect_says(refusal(aligned.substr(0, aligned.size() - 1), "m/s2"), {"record.txt:4:", "inside its last number"});
}

// ---- any file

TEST_F(RecordFiles, WhatIsNoRecordIsRefused)
{
    expect_says(refusal(""), {"is empty"});
    expect_says(refusal("\r\n \n\t\n"), {"is empty"});
    expect_says(refusal(std::string("\x89HDF\r\n\x1a\n\0\0\0", 11)), {"binary"});
    expect_says(refusal(std::string("0.0 0.1\n0.1 0.\0 2\n", 18), "m/s2"), {"record.txt:2:", "0x00", "binary"});
    expect_says(refusal("Dear reader,\nthis is a letter.\n", "g"), {"an unknown format", "peer-at2", "columns"});
    const auto message = [](const std::filesystem::path& path) {
        try {
            read_records(path, "g");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    expect_says(message(folder_ / "absent.at2"), {"absent.at2", "no such file"});
    expect_says(message(folder_), {"is not a file"});
    expect_says(message("/dev/zero"), {"is not a file"});
}

TEST_F(RecordFiles, PgaOutOfAllBoundsHintsAtTheUnit)
{
    std::string gal; // up to 600 cm/s2
    for (int i = 0; i < 12; ++i)
        gal += fmt::format("{:.2f} {:.2f}\n", 0.01 * i, 12000 * sample(i));
    expect_says(refusal(gal, "g"), {"PGA is 5883", "outside [0.0001, 50]", "in cm/s2 it would be 6 m/s2"});
    expect_says(refusal(gal, "m/s2"), {"PGA is 600", "in cm/s2 it would be 6 m/s2"});
    EXPECT_NEAR(read_record(file(gal), "", "gal").acceleration_m_s2[0], -6, 1e-12);
    expect_says(refusal(columns(), "mm/s2"), {"outside", "in g it would be 0.4903 m/s2"});
    expect_says(refusal("0 0\n0.1 0\n0.2 0\n", "g"), {"PGA is 0 m/s2"});
    // a dead channel does not stand in the way of the others, but is not passed over in silence
    const std::string dead = "0 0.1 0\n0.1 0.2 0\n0.2 -0.3 0\n";
    EXPECT_EQ(read_record(file(dead), "2", "m/s2").acceleration_m_s2.size(), 3u);
    EXPECT_THROW(read_records(file(dead), "m/s2"), InputError);
}

/// Bytes flipped, removed, doubled: either refused, or the shape that the file declares.
TEST_F(RecordFiles, DamagedBytesNeverCrashNorChangeTheShape)
{
    std::mt19937 random(7);
    const std::string good[] = {at2(), columns(12, 2, ",")};
    int refused = 0;
    constexpr int trials = 1500;
    for (int trial = 0; trial < trials; ++trial) {
        std::string text = good[trial % 2];
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
        case 0:
            text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
            break;
        case 1:
            text.erase(at, 1 + random() % 40);
            break;
        case 2:
            text.insert(at, text.substr(random() % text.size(), random() % 40));
            break;
        default:
            text.resize(at);
        }
        try {
            for (const Record& r : read_records(file(text), trial % 2 == 0 ? "" : "m/s2")) {
                for (const double a : r.acceleration_m_s2)
                    ASSERT_TRUE(std::isfinite(a));
                ASSERT_GE(r.acceleration_m_s2.size(), 2u);
                ASSERT_GT(r.dt_s, 0);
                if (trial % 2 == 0) {
                    ASSERT_EQ(r.acceleration_m_s2.size(), 23u) << text;
                }
            }
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, trials / 2); // what remains are digits of values and of the title
    EXPECT_LT(refused, trials);
}

} // namespace
} // namespace stylobate
