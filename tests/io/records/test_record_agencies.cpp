/// Readers of the files of agencies, each with the traps of its format: touching fields, counts that lie, channels of
/// different lengths, uneven times. The files are made here, so what they hold is known.

#include "tests/io/records/record_files.hpp"

#include "io/records/record_parser.hpp"

#include <algorithm>
#include <tuple>

namespace stylobate {
namespace {

const std::vector<std::string> line_ends = {"\n", "\r\n", "\r\r\n", "\r"};

std::vector<Record> read(const std::string& content, const std::string& unit = "")
{
    return read_records(content, "record.txt", unit);
}

/// Every beginning of a file is refused, up to the one that holds all that is needed.
void expect_no_part_is_taken(const std::string& content, std::size_t needed)
{
    ASSERT_EQ(message_for(content.substr(0, needed)), "");
    for (std::size_t length = 0; length < needed; ++length)
        ASSERT_NE(message_for(content.substr(0, length)), "") << content.substr(0, length);
}

/// With what stands from `at` on replaced.
std::string overwritten(std::string text, std::size_t at, const std::string& by)
{
    return text.replace(at, by.size(), by);
}

// ---- what the readers share

std::string message_of(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(RecordFields, FixedWidthNumbers)
{
    const RecordText text{"f", {"head", " 1.5-2.5 3.5", " 4.5", ""}, true};
    EXPECT_EQ(fixed_width_numbers(text, 1, 4, 4, 3), (std::vector<double>{1.5, -2.5, 3.5, 4.5}));
    EXPECT_EQ(fixed_width_numbers(text, 2, 1, 3, 3, 1), (std::vector<double>{4.5}));
    EXPECT_EQ(fixed_width_numbers(text, 1, 0, 4, 3), std::vector<double>{});
    const auto message = [&](const RecordText& t, std::size_t count) {
        return message_of([&] { fixed_width_numbers(t, 1, count, 4, 3); });
    };
    EXPECT_EQ(message(text, 3), "");
    expect_says(message(text, 2), {"f:2:", "\"3.5\" follows after the 2 values of 4 columns"});
    expect_says(message(text, 5), {"f:3:", "value 2", "missing, in columns 5 to 8"});
    expect_says(message({"f", {"head", " 1.5-2.5 3.5"}, true}, 4), {"f:2:", "4 values", "ends after 3", "truncated"});
    // the last row of a file without a last line end is cut, and not damaged
    expect_says(message({"f", {"head", " 1.5-2.5 3."}, false}, 3), {"f:2:", "3 values", "ends after 2", "truncated"});
    expect_says(message({"f", {"head", " 1.5-2.5 3."}, true}, 3), {"f:2:", "value 3", "cut, in columns 9 to 12"});
    EXPECT_EQ(message({"f", {"head", " 1.5-2.5 3.5"}, false}, 3), "");
    expect_says(message({"f", {"head"}, true}, 1), {"f:1:", "1 values", "ends after 0"});
}

TEST(RecordFields, FreeNumbers)
{
    const RecordText text{"f", {"head", "1.5 -2.5", "", "\t3.5", "tail"}, true};
    std::size_t next = 0;
    EXPECT_EQ(read_numbers(text, 1, 3, &next), (std::vector<double>{1.5, -2.5, 3.5}));
    EXPECT_EQ(next, 4u);
    EXPECT_EQ(read_numbers(text, 1, 2), (std::vector<double>{1.5, -2.5}));
    const auto message = [&](const RecordText& t, std::size_t count) {
        return message_of([&] { read_numbers(t, 1, count); });
    };
    expect_says(message(text, 1), {"f:2:", "1 beyond the 1 values"});
    expect_says(message(text, 4), {"f:5:", "\"tail\" is not a number"});
    expect_says(message({"f", {"head", "1.5 2.5"}, true}, 3), {"f:2:", "3 values", "ends after 2", "truncated"});
    expect_says(message({"f", {"head", "1.50 2.50", "1.50 2.5"}, false}, 4), {"f:3:", "inside its last number"});
}

TEST(RecordFields, HeaderWords)
{
    EXPECT_EQ(word_after("NO. OF  POINTS =   9472   DURATION", "no. of points"), "9472");
    EXPECT_EQ(word_after("Peak: -1.5, at", "peak"), "-1.5");
    EXPECT_EQ(word_after("Peak", "peak"), "");
    EXPECT_EQ(word_after("nothing", "peak"), "");
    const RecordText text{"f", {"a", "Peak  OF it", "c"}, true};
    EXPECT_EQ(find_line(text, 0, 9, "peak of"), 1u);
    EXPECT_EQ(find_line(text, 2, 9, "peak of"), 3u);
    EXPECT_EQ(find_line(text, 0, 1, "peak of"), 1u); // the end: it is not in there
    EXPECT_EQ(message_of([&] { refuse_more({"f", {"a", " ", "\t"}, true}, 1); }), "");
    expect_says(message_of([&] { refuse_more(text, 2); }), {"f:3:", "\"c\" follows"});
}

TEST(RecordFormat, IsKnownByTheContentNotTheName)
{
    const std::vector<std::pair<std::string, std::string>> contents = {{"csmip", csmip_v1()}, {"csmip", csmip_v2()},
                                                                       {"bhrc", bhrc()},      {"usc-volume-1", usc()},
                                                                       {"usgs-smc", smc()},   {"peer-at2", at2()}};
    for (const auto& [format, content] : contents)
        for (const char* name : {"a.at2", "a.V2", "a.smc", "a.csv", "a"}) {
            const auto records = read_records(content, name, "");
            EXPECT_EQ(records.front().format, format);
            EXPECT_EQ(records.front().file, name);
        }
}

TEST(RecordFormat, StatesItsUnit)
{
    for (const auto& [content, unit] :
         {std::pair{csmip_v1(), "g"}, {csmip_v2(), "cm/s2"}, {bhrc(), "g/10"}, {usc(), "g/10"}, {smc(), "cm/s2"}}) {
        EXPECT_EQ(read(content, unit).front().unit, unit);
        expect_says(message_for(content, "mm/s2"), {std::string("in the file is ") + unit, "given is mm/s2"});
    }
    expect_says(message_for(replaced(bhrc(), "G/10", "FT/S2")), {"record.txt:12:", "\"FT/S2\" is not one of"});
    expect_says(message_for(replaced(csmip_v1(), "in units of g .", "in units of v .")), {"\"v\" is not one of"});
}

// ---- CSMIP

TEST(Csmip, Volume1)
{
    for (const std::string& end : line_ends) {
        SCOPED_TRACE(end.size());
        const auto all = read(with_ends(csmip_v1(), end));
        ASSERT_EQ(all.size(), 2u);
        expect_samples(all[0], 23, g);
        expect_samples(all[1], 21, g, 4);
        EXPECT_EQ(all[0].component, "chan 1");
        EXPECT_EQ(all[0].orientation, "360");
        EXPECT_EQ(all[1].component, "chan 2");
        EXPECT_EQ(all[1].orientation, "Up");
        for (const Record& record : all) {
            EXPECT_EQ(record.station, "Some Where");
            EXPECT_EQ(record.title, "Made-up Event of Jan 1, 2003");
            EXPECT_EQ(record.dt_s, 0.005);
            ASSERT_TRUE(record.header_pga_m_s2);
            EXPECT_NEAR(*record.header_pga_m_s2, pga_of(record), 1e-9);
        }
    }
}

TEST(Csmip, Volume2HasChannelsOfDifferentLengths)
{
    const auto all = read(csmip_v2());
    ASSERT_EQ(all.size(), 3u);
    const std::size_t n[] = {25, 24, 24};
    const int shift[] = {0, 3, 0};
    const char* orientation[] = {"90", "UP", "0"};
    for (std::size_t c = 0; c < 3; ++c) {
        expect_samples(all[c], n[c], 10, shift[c]); // 1000 cm/s2 for 1, and neither velocity nor displacement
        EXPECT_EQ(all[c].orientation, orientation[c]);
        EXPECT_EQ(all[c].component, fmt::format("chan {}", c + 1));
        EXPECT_EQ(all[c].dt_s, 0.02);
        EXPECT_EQ(all[c].unit, "cm/s2");
    }
    EXPECT_NEAR(*all[0].header_pga_m_s2, 0.5, 1e-12);
    EXPECT_NEAR(*all[1].header_pga_m_s2, 0.49, 1e-12); // what the header says, whatever the samples are
    // without velocity and displacement, and with words between the numbers as later files have them
    std::string later = csmip_v2_channel(1, " 90 Deg", 25);
    const std::size_t velocity = later.find("   25 POINTS OF VELOC");
    later.erase(velocity, later.find("/&") - velocity);
    later = replaced(later, "SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)", "spaced at  .020 sec, in cm/sec2. (8f10.3)");
    expect_samples(read(later).front(), 25, 10);
}

TEST_F(RecordFiles, CsmipChannelIsChosenByNameOrByTheOrientationThatOnlyItHas)
{
    const auto path = file(csmip_v2());
    for (const char* name : {"chan 2", "CHAN 2", "up"})
        expect_samples(read_record(path, name, ""), 24, 10, 3);
    expect_says(refusal(csmip_v2(), "", "180"), {"\"chan 1\" (90), \"chan 2\" (UP), \"chan 3\" (0)"});
    expect_says(refusal(csmip_v1_channel(1, "90 Deg", 20) + csmip_v1_channel(2, "90 Deg", 20), "", "90"),
                {"\"90\" is not in it"});
}

TEST(Csmip, FieldsMayTouch)
{
    const std::string all_small = csmip_v1_channel(1, "360 Deg", 16);
    const std::size_t first = all_small.find("-0.050000");
    std::string row;
    for (int i = 0; i < 8; ++i)
        row += fmt::format("{:9.6f}", -1 - i / 8.0);
    const Record record = read(overwritten(all_small, first, row)).front();
    ASSERT_EQ(record.acceleration_m_s2.size(), 16u);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(record.acceleration_m_s2[i], -g * (1 + static_cast<double>(i) / 8), 1e-12);
    EXPECT_NEAR(record.acceleration_m_s2[8], g * sample(8), 1e-12);
}

TEST(Csmip, ValuesThatAreMissingOrNoNumbersAreNamed)
{
    const std::string text = csmip_v1_channel(1, "360 Deg", 23);
    const std::size_t second_row = text.find(fmt::format("{:9.6f}", sample(8)));
    const long line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(second_row), '\n');
    const auto says = [&](std::size_t column, const char* field, const std::string& what) {
        expect_says(message_for(overwritten(text, second_row + column, field)),
                    {fmt::format("record.txt:{}:", line), what});
    };
    says(9, "         ", "value 2 of the 8 in this line is missing, in columns 10 to 18");
    says(0, "*********", "not a number");
    says(18, " -.0O0012", "not a number");
    says(63, "      nan", "not finite");
    // a row that has lost its end, and one that has gained one
    expect_says(message_for(text.substr(0, second_row + 40) + text.substr(second_row + 72)), {"is cut, in columns"});
    expect_says(message_for(text.substr(0, second_row + 72) + " 0.001000" + text.substr(second_row + 72)),
                {fmt::format("record.txt:{}:", line), "follows after the 8 values"});
    EXPECT_NE(message_for(text.substr(0, second_row) + text.substr(second_row + 73)), ""); // a row less
}

TEST(Csmip, CountsThatLieAreRefused)
{
    const std::string v1 = csmip_v1_channel(1, "360 Deg", 23), v2 = csmip_v2_channel(1, " 90 DEG", 25);
    const std::string data_line = "    23 Accelerogram points";
    for (const char* count : {"    21", "    22", "    24", "    25", "    15", "    31"})
        expect_says(message_for(replaced(v1, data_line, std::string(count) + " Accelerogram points")),
                    {"record.txt:28:", "values follow, but line 11 states"});
    const std::string silent = replaced(v1, "No. of Points =  23", "");
    EXPECT_EQ(message_for(silent), "");
    for (const char* count : {"    21", "    22", "    24", "    25", "    15", "    31"})
        EXPECT_NE(message_for(replaced(silent, data_line, std::string(count) + " Accelerogram points")), "") << count;
    expect_says(message_for(replaced(silent, data_line, "9999999999999999999 Accelerogram points")), {"record.txt:"});
    expect_says(message_for(replaced(silent, data_line, "     1 Accelerogram points")), {"at least 2"});
    for (const char* series : {"ACCEL DATA", "VELOC", "DISPL"})
        for (const char* count : {"   23", "   24", "   26", "   27", "   17", "   33"})
            EXPECT_NE(message_for(replaced(v2, fmt::format("   25 POINTS OF {}", series),
                                           fmt::format("{} POINTS OF {}", count, series))),
                      "")
                << count << series;
}

TEST(Csmip, CutAnywhereIsRefused)
{
    for (const std::string& text : {csmip_v1_channel(1, "360 Deg", 23), csmip_v2_channel(1, " 90 DEG", 25)}) {
        expect_no_part_is_taken(text, text.rfind("/&") + 2);
        const std::string two = text + text;
        for (std::size_t length = text.size() + 1; length < two.rfind("/&"); length += 7)
            EXPECT_NE(message_for(two.substr(0, length)), "") << two.substr(0, length);
        expect_says(message_for(text + "more\n"), {"\"more\" stands where the next channel should begin"});
    }
}

TEST(Csmip, WhatIsNoAccelerationIsRefused)
{
    std::string text = csmip_v2_channel(1, " 90 DEG", 25);
    const std::size_t acceleration = text.find("   25 POINTS OF ACCEL DATA");
    text.erase(acceleration, text.find("   25 POINTS OF VELOC") - acceleration);
    expect_says(message_for(text), {"VELOC", "not an acceleration"});
    expect_says(message_for("CORRECTED ACCELEROGRAM 1\nCHAN 1: 90 DEG\nRESPONSE AND FOURIER AMPLITUDE SPECTRA\n"),
                {"record.txt:1:", "truncated, or of spectra"});
}

TEST(Csmip, FormatAndIntervalOfTheDataLineAreChecked)
{
    const std::string text = csmip_v1_channel(1, "360 Deg", 23);
    for (const char* format : {"(8x9.6)", "(8f.6)", "(8f999.6)", "(0f9.6)", "()", ""})
        expect_says(message_for(replaced(text, "(8f9.6)", format)), {"record.txt:28:", "(8f9.6)"});
    // without a format it is that of the first line, if that line has one
    const std::string silent = replaced(text, "Format: (8f9.6)", "");
    expect_samples(read_records(silent, "record.txt", "")[0], 23, g);
    expect_says(message_for(replaced(silent, "-0.050000", "-0.05 000")), {"record.txt:29:"});
    EXPECT_NE(message_for(replaced(text, "(8f9.6)", "(9f8.6)")), "");
    for (const char* rate : {"0", "-200", "1", "1e9", "x", "nan"})
        expect_says(message_for(replaced(text, "at 200 pts", fmt::format("at {} pts", rate))), {"record.txt:28:"});
}

// ---- BHRC

TEST(Bhrc, ThreeComponents)
{
    for (const std::string& end : line_ends) {
        const auto all = read(with_ends(bhrc(), end));
        ASSERT_EQ(all.size(), 3u);
        const std::size_t n[] = {22, 22, 20};
        const char *component[] = {"L1", "V2", "T3"}, *orientation[] = {"50", "V", "140"};
        for (std::size_t c = 0; c < 3; ++c) {
            expect_samples(all[c], n[c], g / 10, static_cast<int>(c));
            EXPECT_EQ(all[c].component, component[c]);
            EXPECT_EQ(all[c].orientation, orientation[c]);
            EXPECT_EQ(all[c].station, "Some Where");
            EXPECT_EQ(all[c].unit, "g/10");
            EXPECT_EQ(all[c].dt_s, 0.005);
            EXPECT_FALSE(all[c].header_pga_m_s2);
        }
    }
}

TEST(Bhrc, LiesOfTheHeaderAndCutsAreRefused)
{
    const std::string text = bhrc_component("L1", 22);
    for (const char* points :
         {"    20", "    21", "    23", "    24", "    12", "    32", "    1 ", " 22.0 ", "     x"})
        EXPECT_NE(message_for(replaced(text, "POINTS =     22", std::string("POINTS = ") + points)), "") << points;
    expect_says(message_for(replaced(text, "  0.110", "  0.200")), {"record.txt:11:", "duration", "0.2 s"});
    expect_says(message_for(replaced(text, ".200000E+03", ".000000E+00")), {"record.txt:22:", "sampling interval"});
    expect_says(message_for(replaced(text, "NO. OF POINTS", "NUMBER")), {"record.txt:1:", "no. of points"});
    expect_says(message_for(text + "more\n"), {"\"more\" stands where the next component should begin"});
    expect_no_part_is_taken(text, text.rfind("/&") + 2);
}

TEST(Bhrc, FieldsMayTouch)
{
    std::string text = bhrc_component("L1", 12), row;
    for (int i = 0; i < 10; ++i)
        row += fmt::format("-{:.6f}E+00", 0.5 + i); // 13 characters, no blank
    ASSERT_EQ(row.size(), 130u);
    const Record record = read(overwritten(text, text.rfind(" -.500000E-01"), row)).front();
    ASSERT_EQ(record.acceleration_m_s2.size(), 12u);
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_NEAR(record.acceleration_m_s2[i], -g / 10 * (0.5 + static_cast<double>(i)), 1e-12);
}

// ---- USC

TEST(Usc, UnevenTimesGoOntoAGridThatHasAllOfThem)
{
    const int n = 21;
    for (const std::string& end : line_ends) {
        const auto all = read(with_ends(usc(n), end));
        ASSERT_EQ(all.size(), 1u);
        const Record& record = all.front();
        EXPECT_EQ(record.orientation, "N90E");
        EXPECT_EQ(record.component, "N90E");
        EXPECT_EQ(record.station, "SOME WHERE");
        EXPECT_EQ(record.title, "MADE-UP EARTHQUAKE JAN 1, 2003 -1000 GMT");
        EXPECT_EQ(record.dt_s, 0.001);
        expect_says(record.note.value_or(""), {"21 uneven samples", "up to 13 ms", "grid of 1 ms"});
        ASSERT_EQ(record.acceleration_m_s2.size(), static_cast<std::size_t>(usc_time_ms(n - 1)) + 1);
        for (int i = 0; i < n; ++i) // each sample at its time, to the last bit
            EXPECT_EQ(record.acceleration_m_s2[static_cast<std::size_t>(usc_time_ms(i))], 0.980665 * sample(i));
        EXPECT_EQ(pga_of(record), 0.980665 * 0.05);
        for (int i = 0; i + 1 < n; ++i) // and a straight line between
            for (int ms = usc_time_ms(i); ms < usc_time_ms(i + 1); ++ms) {
                const double part = (ms - usc_time_ms(i)) / static_cast<double>(usc_steps_ms[i % 5]);
                EXPECT_NEAR(record.acceleration_m_s2[static_cast<std::size_t>(ms)],
                            0.980665 * ((1 - part) * sample(i) + part * sample(i + 1)), 1e-12);
            }
    }
}

TEST(Usc, TheGridIsTheWidestThatWillDo)
{
    // even times stay as they are, 20 ms; steps of 20 and 30 ms have 10 ms in common, wherever the times begin
    const Record even = read(usc(21, [](int i) { return 20 * i; })).front();
    EXPECT_EQ(even.dt_s, 0.02);
    EXPECT_EQ(even.note, std::nullopt);
    expect_samples(even, 21, g / 10);
    const Record odd = read(usc(21, [](int i) { return 3 + 20 * i + 10 * (i / 2); })).front();
    EXPECT_EQ(odd.dt_s, 0.01);
    EXPECT_EQ(odd.acceleration_m_s2.size(), 51u);
}

TEST(Usc, FieldsMayTouch)
{
    // beyond 100 s and -10 g/10 time and value fill their seven columns
    const auto time = [](int i) { return 99900 + 20 * i; };
    const auto value = [](int i) { return -10 - i / 8.0; };
    // times begin at 99.9 s; a gap to zero would have to be filled
    const Record record = read(usc(20, time, value)).front();
    ASSERT_EQ(record.acceleration_m_s2.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i)
        EXPECT_NEAR(record.acceleration_m_s2[i], g / 10 * value(static_cast<int>(i)), 1e-12);
}

TEST(Usc, TimesThatLieAreRefused)
{
    const auto with_time = [](int which, int ms) { return usc(21, [=](int i) { return i == which ? ms : 20 * i; }); };
    expect_says(message_for(with_time(7, 120)), {"record.txt:29:", "0.12 s follows 0.12 s", "must increase"});
    expect_says(message_for(with_time(7, 90)), {"record.txt:29:", "must increase"});
    expect_says(message_for(usc(21, [](int i) { return 20 * i + (i > 9 ? 600 : 0); })),
                {"record.txt:30:", "0.18 s to 0.8 s", "missing"});
    expect_says(message_for(replaced(usc(), "DURATION =   0.120", "DURATION =   0.220")),
                {"record.txt:11:", "0.22 s", "0.12 s"});
    expect_says(message_for(replaced(usc(), "  0.004", " 0.0041")), {"whole number of milliseconds"});
    expect_says(message_for(replaced(usc(), "  0.000 -0.050", " -0.001 -0.050")), {"whole number of milliseconds"});
}

TEST(Usc, CountsThatLieAndCutsAreRefused)
{
    const std::string text = usc();
    for (const char* points : {"    19", "    20", "    22", "    23", "    16", "    26", "     x", "     1"})
        EXPECT_NE(message_for(replaced(text, "POINTS =     21", std::string("POINTS = ") + points)), "") << points;
    expect_says(message_for(replaced(text, "POINTS =     21", "POINTS = 9999999999999999999")),
                {"record.txt:11:", "more than the size of the file allows"});
    expect_says(message_for(text + "more\n"), {"\"more\" follows after all values"});
    expect_no_part_is_taken(text, text.size() - 1);
    const auto both = read(text + "/&\n" + usc(16)); // components one below the other
    EXPECT_EQ(both.size(), 2u);
}

// ---- SMC

TEST(Smc, FieldsTouch)
{
    for (const std::string& end : line_ends)
        for (const int n : {2, 8, 21, 24}) {
            const auto all = read(with_ends(smc(n), end));
            ASSERT_EQ(all.size(), 1u);
            expect_samples(all.front(), static_cast<std::size_t>(n), 10);
            EXPECT_EQ(all.front().orientation, "360");
            EXPECT_EQ(all.front().component, "360");
            EXPECT_EQ(all.front().station, "Some Where, 1 Street");
            EXPECT_EQ(all.front().title, "2003 1 1 1000 Made-up, XY");
            EXPECT_EQ(all.front().dt_s, 0.005);
            EXPECT_NEAR(*all.front().header_pga_m_s2, 0.5, 1e-9);
        }
    EXPECT_NE(smc().find("-5.0000E+1-1.3000E+1"), std::string::npos); // the file does have what is tested
}

TEST(Smc, WhatTheHeaderDoesNotKnow)
{
    const Record silent =
        read(replaced(replaced(smc(), "0.5000000E+02", "0.1700000E+39"), "-0.4900000E+02", " 0.1700000E+39")).front();
    EXPECT_FALSE(silent.header_pga_m_s2);
    expect_says(message_for(smc(21, "2 CORRECTED ACCELEROGRAM", 1.7e38, 1.7e38)), {"record.txt:18:", "sampling rate"});
    expect_says(message_for(smc(21, "2 CORRECTED ACCELEROGRAM", 1.7e38, 1)), {"record.txt:18:", "sampling interval"});
    EXPECT_EQ(read(replaced(smc(), "component=    360", "component=")).front().component, "acceleration");
}

TEST(Smc, WhatIsNoAccelerationIsRefused)
{
    EXPECT_EQ(read(smc(21, "1 UNCORRECTED ACCELEROGRAM")).size(), 1u);
    for (const char* kind : {"3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA", "6 FOURIER AMPLITUDE SPECTRA"})
        expect_says(message_for(smc(21, kind)), {"record.txt:1:", kind, "not an acceleration"});
}

TEST(Smc, LiesOfTheHeaderAndCutsAreRefused)
{
    const std::string text = smc();
    const auto with_count = [&](int n) {
        return replaced(text, fmt::format("{:10}{:10}", 21, -32768), fmt::format("{:10}{:10}", n, -32768));
    };
    for (const int n : {-21, 0, 1, 16, 19, 20, 22, 23, 24, 25, 1000000000})
        EXPECT_NE(message_for(with_count(n)), "") << n;
    for (const char* comments : {"         1\n", "         3\n", "        -1\n", "    -32768\n"})
        EXPECT_NE(message_for(replaced(text, "         2\n", comments)), "") << comments;
    expect_says(message_for(text + "more\n"), {"\"more\" follows after all values"});
    expect_says(message_for(replaced(text, "-5.0000E+1", "          ")), {"record.txt:30:", "value 1", "missing"});
    expect_no_part_is_taken(text, text.size() - 1);
}

} // namespace
} // namespace stylobate
