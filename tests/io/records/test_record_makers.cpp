/// Files in the manner of many agencies, programs and people: each one is read rightly, or refused with a message that
/// names what it is and the remedy.

#include "tests/io/records/record_maker_files.hpp"

namespace stylobate {
namespace {

struct Made {
    const char* name;
    std::string content;
    std::string unit; ///< given with it
    const char* format;
    std::size_t samples;
    double factor; ///< of `sample`, in m/s2
    double dt_s;
    const char* directions; ///< first letters, of all components
};

std::string lines_below(const std::string& text, const std::string& more)
{
    return text + more + "\n";
}

std::vector<Made> made_files()
{
    const std::string free_csmip = replaced(csmip_v1_channel(1, "360 Deg", 23), "      Format: (8f9.6)  ", "");
    const std::string sampled = "23 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)";
    return {
        // marks behind the last value
        {"AT2, *** End Data ***", lines_below(at2(), "*** End Data ***"), "", "peer-at2", 23, g, 0.01, "h"},
        {"AT2, END", lines_below(at2(), "END"), "", "peer-at2", 23, g, 0.01, "h"},
        {"AT2, a rule and EOF", lines_below(at2(), "-----\n\nEOF"), "", "peer-at2", 23, g, 0.01, "h"},
        {"ESM, end of data", lines_below(esm(), "End of data"), "", "esm", 21, 10, 0.005, "h"},
        {"SMC, /&", lines_below(smc(), "/&"), "", "usgs-smc", 21, 10, 0.005, "h"},
        {"K-NET, EOF", lines_below(knet(), "EOF"), "", "knet", 100, 0, 0.02, "h"},
        {"columns, # end", lines_below(columns(), "# end"), "g", "columns", 12, g, 0.005, "u"},
        {"GeoNet, a rule", lines_below(geonet_component(2, "N28W", 23), "======"), "", "geonet", 23, 10, 0.02, "h"},
        // packings that are not stated
        {"CSMIP V1, 8F9.6 without a format", free_csmip, "", "csmip", 23, g, 0.005, "h"},
        {"CSMIP, points of accel data in 8F9.6",
         replaced(free_csmip, "    23 Accelerogram points at 200 pts/sec in units of g .", "    " + sampled), "",
         "csmip", 23, g, 0.005, "h"},
        // comments
        {"COSMOS, a blank before the bar", replaced(cosmos(), "|<SCNL>", " |<SCNL>"), "", "cosmos", 20, 10, 0.005, "h"},
        {"COSMOS, ended by /&", replaced(cosmos(), "End-of-data for", "/& ---- End of data for"), "", "cosmos", 20, 10,
         0.005, "h"},
        {"COSMOS, tab before the bar", replaced(cosmos(), "|<SCNL>", "\t|<SCNL>"), "", "cosmos", 20, 10, 0.005, "h"},
        // pairs of time and value
        {"RENADIC", renadic(), "", "csmip", 23, g / 10, 0.01, "h"},
        {"RENADIC, other lines above", renadic(23, "  0.000  0.013  0.010  0.036  0.020  0.036\n"), "", "csmip", 23,
         g / 10, 0.01, "h"},
        // headers in words
        {"NSMN", nsmn(), "", "headed", 21, 10, 0.01, "hhv"},
        {"NSMN, CR LF", with_ends(nsmn(), "\r\n"), "", "headed", 21, 10, 0.01, "hhv"},
        {"European data base", european(), "", "headed", 23, 1, 0.005, "h"},
        {"a header of equals signs",
         "Station = X\nSampling rate (Hz) = 200\nNumber of samples = 23\nUnits = mg\n" +
             rows(23, 1, [](int i) { return fmt::format("{:.4f}", sample(i)); }),
         "refused", "", 0, 0, 0, ""},
        {"a rate and a unit",
         "Station: X\nComponent: Z\nSampling rate: 200 Hz\nNPTS: 23\nUnit: cm/s^2\n" +
             rows(23, 8, [](int i) { return fmt::format(" {:.4f}", 1000 * sample(i)); }),
         "", "headed", 23, 10, 0.005, "v"},
        {"NPTS and DT on lines of their own",
         "NPTS = 23\nDT = 0.01\nacceleration in g\n" +
             rows(23, 4, [](int i) { return fmt::format(" {:.4f}", sample(i)); }),
         "", "headed", 23, g, 0.01, "u"},
        {"other keys that are no count and no interval",
         "Number of data channels : 3\nDelta (km) : 35\nTime of PGA (s) : 3.2\nVelocity unit : cm/s\nNumber of samples "
         ": "
         "23\nSample interval : 5 ms\nAcceleration unit : cm/s2\n" +
             rows(23, 1, [](int i) { return fmt::format("{:.3f}", 1000 * sample(i)); }),
         "", "headed", 23, 10, 0.005, "u"},
        {"Spanish",
         "Estacion: X\nNumero de muestras: 23\nTasa de muestreo: 100 Hz\nUnidades: gal\n" +
             rows(23, 1, [](int i) { return fmt::format("{:.3f}", 1000 * sample(i)); }),
         "", "headed", 23, 10, 0.01, "u"},
        // a name, the size, the values
        {"eqsig, a name that begins with a number", replaced(named_size(), "motion 1", "1999 motion"), "m/s2",
         "npts-dt", 23, 1, 0.005, "u"},
        {"eqsig, a name that is a number", replaced(named_size(), "motion 1", "12"), "m/s2", "npts-dt", 23, 1, 0.005,
         "u"},
        {"eqsig", named_size(), "m/s2", "npts-dt", 23, 1, 0.005, "u"},
        {"dt first, no name", "0.01 23\n" + rows(23, 5, [](int i) { return fmt::format(" {:.4f}", sample(i)); }), "g",
         "npts-dt", 23, g, 0.01, "u"},
        {"the unit in the text above",
         "Acceleration (cm/s2)\n23, 0.005\n" +
             rows(23, 1, [](int i) { return fmt::format("{:.3f}", 1000 * sample(i)); }),
         "", "npts-dt", 23, 10, 0.005, "u"},
        // Fortran
        {"AT2, D exponents", with_d_exponents(at2()), "", "peer-at2", 23, g, 0.01, "h"},
        {"ESM, D exponents", esm(21, {"SAMPLING_INTERVAL_S: 5.0D-03", "PGA_CM/S^2: -5.0D+01"}), "", "esm", 21, 10,
         0.005, "h"},
        {"BHRC, D exponents", with_d_exponents(bhrc_component("L1", 22)), "", "bhrc", 22, g / 10, 0.005, "h"},
        {"COSMOS, D exponents", replaced(cosmos(), "-5.000000e+01", "-5.000000D+01"), "", "cosmos", 20, 10, 0.005, "h"},
        {"columns, D exponents", replaced(columns(), "-0.0500", "-5.00D-2"), "g", "columns", 12, g, 0.005, "u"},
        // units in names and comments
        {"a unit in brackets", named_columns("Time [s],acc [cm/s2]", 1), "", "columns", 12, 0.01, 0.005, "u"},
        {"a unit behind an underscore", named_columns("time_s,NS_m_s2", 1), "", "columns", 12, 1, 0.005, "h"},
        {"a unit behind a comma", named_columns("t;Acceleration, g", 1, ";"), "", "columns", 12, g, 0.005, "u"},
        {"units between blanks", named_columns("Time (s) Acc (m/s^2)", 1, " "), "", "columns", 12, 1, 0.005, "u"},
        {"a line of units", named_columns("time,N-S,E-W\ns,gal,gal", 2), "", "columns", 12, 0.01, 0.005, "hh"},
        {"names in a comment", named_columns("# time [s], acc NS [m/s2]", 1), "", "columns", 12, 1, 0.005, "h"},
        {"a unit in a comment", named_columns("# station X\n# unit: cm/s2", 1), "", "columns", 12, 0.01, 0.005, "u"},
        {"a superscript", named_columns("time (s),a (m/s\xc2\xb2)", 1), "", "columns", 12, 1, 0.005, "u"},
        {"milliseconds",
         "t [ms],a [g]\n" + rows(24, 2,
                                 [](int i) {
                                     return i % 2 == 0 ? fmt::format("{},", 5 * (i / 2))
                                                       : fmt::format("{:.3f}", sample(i / 2));
                                 }),
         "", "columns", 12, g, 0.005, "u"},
        {"one column with its unit",
         "# dt = 0.01\nacceleration [gal]\n" + rows(12, 1, [](int i) { return fmt::format("{:.3f}", sample(i)); }), "",
         "columns", 12, 0.01, 0.01, "u"},
        {"Taiwan's CWB",
         "#StationCode: X\n#SampleRate(Hz): 200\n#AmplitudeUnit:  gal. DCOffset(mean) subtracted\n#DataSequence: Time "
         "U(+); "
         "N(+); E(+)\n" +
             columns(12, 3),
         "", "columns", 12, 0.01, 0.005, "vhh"},
        // other quantities beside the acceleration
        {"acceleration, velocity, displacement",
         named_columns("\xef\xbb\xbfTime [s],Acceleration [g],Velocity [m/s],Displacement [m]", 3), "", "columns", 12,
         g, 0.005, "u"},
        {"t a v d", named_columns("t a v d", 3, " "), "m/s2", "columns", 12, 1, 0.005, "u"},
        {"names that are units", named_columns("t,cm/s2,cm/s,cm", 3), "", "columns", 12, 0.01, 0.005, "u"},
        {"a superscript in Latin-1", named_columns("t [s],acc [m/s\xb2],v [m/s]", 2), "", "columns", 12, 1, 0.005, "u"},
        {"units only", named_columns("t,A [m/s2],B [cm/s],C [cm]", 3), "", "columns", 12, 1, 0.005, "u"},
        {"acc_x, vel_x, disp_x", named_columns("time,acc_x,vel_x,disp_x", 3), "g", "columns", 12, g, 0.005, "u"},
        {"blanks between names with units", named_columns("Time (s) Acc (g) Vel (m/s) Disp (cm)", 3, " "), "",
         "columns", 12, g, 0.005, "u"},
        {"kines", named_columns("Time,NS (gal),V_NS (kine)", 2), "", "columns", 12, 0.01, 0.005, "h"},
        {"a column of no known quantity", named_columns("time,acceleration,temperature", 2), "g", "columns", 12, g,
         0.005, "u"},
    };
}

TEST(RecordMakers, AreReadRightly)
{
    int read = 0;
    for (const Made& made : made_files()) {
        SCOPED_TRACE(made.name);
        if (made.unit == "refused") {
            expect_says(message_for(made.content), {"\"mg\" is not one of acceleration"});
            continue;
        }
        try {
            const std::vector<Record> records = read_records(made.content, "record.txt", made.unit);
            ASSERT_FALSE(records.empty());
            EXPECT_EQ(records.front().format, made.format);
            EXPECT_DOUBLE_EQ(records.front().dt_s, made.dt_s);
            std::string directions;
            for (const Record& record : records)
                directions += *to_string(record.direction);
            EXPECT_EQ(directions, made.directions);
            for (std::size_t c = 0; c < records.size() && made.factor > 0; ++c)
                expect_samples(records[c], made.samples, made.factor, static_cast<int>(c));
            EXPECT_EQ(records.front().acceleration_m_s2.size(), made.samples);
            if (records.front().header_pga_m_s2 && made.factor > 0) {
                EXPECT_NEAR(*records.front().header_pga_m_s2, made.factor * 0.05, 1e-9);
            }
            ++read;
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_GE(read, 40);
}

TEST(RecordMakers, DecimalCommasAreNamedInEveryFormat)
{
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"AT2", at2()},
                                     {"ESM", esm()},
                                     {"CSMIP", csmip_v1_channel(1, "360 Deg", 23)},
                                     {"COSMOS", cosmos()},
                                     {"NSMN", nsmn()},
                                     {"European", european()},
                                     {"eqsig", named_size()},
                                     {"semicolons", columns(12, 2, ";")},
                                     {"tabs", columns(12, 1, "\t")},
                                     {"blanks", columns(12, 1)},
                                     {"UNAM", unam()}}) {
        SCOPED_TRACE(name);
        const std::string unit = name == "ESM" ? "" : "g"; // ESM states another one
        expect_says(message_for(with_decimal_commas(text), unit), {"decimal comma", "by points"});
    }
    // points in the times alone: "0.005 0,123" is not three columns
    std::string mixed;
    for (int i = 0; i < 12; ++i)
        mixed += fmt::format("{:.3f} {}\n", 0.005 * i, with_decimal_commas(fmt::format("{:.3f}", sample(i))));
    expect_says(message_for(mixed, "g"), {"decimal comma"});
    // a comma between columns is none, of whole numbers neither
    const Record whole = read_records("time_ms,acc_mm_s2\n0,12\n5,13\n10,4\n15,-8\n20,9\n", "record.txt", "")[0];
    EXPECT_DOUBLE_EQ(whole.dt_s, 0.005);
    EXPECT_DOUBLE_EQ(whole.acceleration_m_s2[1], 0.013);
    expect_samples(read_records(columns(12, 1, ","), "record.txt", "g")[0], 12, g);
    expect_samples(read_records("# dt = 0.01\n" + rows(12, 1, [](int i) { return fmt::format("{:.3f}", sample(i)); }),
                                "record.txt", "g")[0],
                   12, g);
}

TEST(RecordMakers, EncodingsAndContainersAreNamed)
{
    for (const std::string& text : {at2(), columns(), esm(), knet()})
        for (const bool mark : {true, false})
            expect_says(message_for(in_utf16(text, mark), "g"), {"UTF-16", "iconv"});
    expect_says(message_for(std::string("PK\x03\x04\x14\0\0", 7)), {"zip archive", "spreadsheet"});
    expect_says(message_for("\x1f\x8b\x08"), {"gzip"});
    expect_says(message_for(std::string("000001D ABC  \0\0", 15)), {"miniSEED", "ObsPy"});
}

TEST(RecordMakers, ColumnsThatAreNoAccelerationNeverBecomeMotions)
{
    for (const char* names :
         {"Time [s],Velocity [m/s]", "time,vel", "t,v", "t,disp_cm", "Time (s),Displacement (mm)", "time,Velocidad",
          "temps,Déplacement", "temps,D\xe9placement", "temps,Vélocité", "Zaman,Hız", "time,u", "t,cm/s", "t,cm",
          "time,Speed", "time,Dis.", "t,x_mm", "time,PSA", "t,EW (kine)", "time,vx"})
        expect_says(message_for(named_columns(names, 1), "g"), {"record.txt:1:", "no column is an acceleration"});
    for (const char* names : {"Period [s],Sa [g]", "Frequency (Hz),a [g]", "acc,t", "Displacement [m],Force [kN]"})
        expect_says(message_for(named_columns(names, 1), "g"), {"record.txt:1:", "must be the time"});
    // names that do not fit the columns, and name a velocity
    expect_says(message_for(named_columns("Time Acceleration Velocity of it", 2), "g"), {"record.txt:1:", "velocity"});
    // one column
    expect_says(message_for("# dt = 0.01\nvelocity\n0.1\n0.2\n-0.1\n", "g"),
                {"record.txt:2:", "no column is an acceleration"});
    expect_says(message_for(european(23, "Velocity time series in m/s"), "g"), {"velocity and not an acceleration"});
    expect_says(
        message_for("velocity\n23 0.005\n" + rows(23, 1, [](int i) { return fmt::format("{:.3f}", sample(i)); }), "g"),
        {"velocity and not an acceleration"});
    // what is left out is said, and cannot be selected
    const std::string avd = named_columns("time,acc [g],vel,disp", 3);
    const Record record = read_records(avd, "record.txt", "")[0];
    expect_says(record.note.value_or(""), {"\"vel\" (a velocity)", "\"disp\" (a displacement)"});
    // letters that are directions
    std::string directions;
    for (const Record& component : read_records(named_columns("time,L,T,V", 3), "record.txt", "g"))
        directions += *to_string(component.direction);
    EXPECT_EQ(directions, "hhv");
    EXPECT_EQ(read_records(named_columns("time,E,N,U", 3), "record.txt", "g").size(), 3u);
    EXPECT_EQ(read_records(named_columns("time,U-D", 1), "record.txt", "g").size(), 1u);
}

TEST(RecordMakers, AUnitInANameIsComparedWithTheOneGiven)
{
    for (const char* names : {"t,acc [g]", "t,acc_g", "time (s),a (g)", "# unit: g", "# Acceleration (g)"})
        for (const char* unit : {"m/s2", "cm/s2", "gal"})
            expect_says(message_for(named_columns(names, 1), unit),
                        {"record.txt:1:", "the unit in the file is g", unit[0] == 'm' ? "m/s2" : "cm/s2"});
    expect_says(message_for(named_columns("t,acc [m]", 1), "g"),
                {"an acceleration by its name", "a displacement by its unit"});
    expect_says(message_for(named_columns("t,velocity [g]", 1), "g"),
                {"a velocity by its name", "an acceleration by its unit"});
    expect_says(message_for(named_columns("t,acc [mg]", 1)), {"another quantity by its unit"});
    // each column by its own
    const auto two = read_records(named_columns("t,NS [g],EW [gal]", 2), "record.txt", "");
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(two[0].acceleration_m_s2[0], g * sample(0), 1e-12);
    EXPECT_NEAR(two[1].acceleration_m_s2[0], 0.01 * sample(1), 1e-12);
    // one with and one without
    expect_says(message_for(named_columns("t,NS [g],EW", 2)), {"do not contain the unit"});
    // a unit of a spectrum is not one of the samples
    expect_says(message_for(named_columns("# Spectral acceleration (g)", 1)), {"do not contain the unit"});
}

TEST(RecordMakers, WhatIsMissingIsReportedTogether)
{
    std::string body = rows(12, 1, [](int i) { return fmt::format("{:.3f}", sample(i)); });
    expect_says(message_for(body), {"the unit of the acceleration", "--unit", "no time", "# dt = 0.01"});
    expect_says(message_for("acceleration\n" + body), {"the unit of the acceleration", "no time"});
    const std::string no_dt = replaced(replaced(at2(), ", DT=   .0100 SEC,", ""), "IN UNITS OF G", "");
    expect_says(message_for(no_dt), {"DT is missing", "the unit of the acceleration", "--unit"});
}

TEST(RecordMakers, ContradictionsAndDamageAreRefused)
{
    expect_says(message_for(nsmn().substr(0, nsmn().size() - 45)), {"20", "truncated"});
    expect_says(message_for(replaced(nsmn(), "DATA          : 21", "DATA          : 20")),
                {"follows after all values"});
    expect_says(message_for(replaced(european(), "Data                : 23", "Data                : 24")),
                {"truncated"});
    expect_says(message_for(replaced(european(), "Data                : 23", "Data                : 22")), {"count"});
    expect_says(message_for(european(), "g"), {"the unit in the file is m/s2"});
    // a unit beside the peak only, and samples in another one
    expect_says(message_for(replaced(nsmn(), "(N-S) 50.0", "(N-S) 0.05")), {"beside the peak only", "--unit"});
    expect_says(message_for(named_size(23, "24 0.005"), "g"), {"24 values should follow", "truncated"});
    expect_says(message_for(named_size(23, "22 0.005"), "g"), {"follows after all values"});
    const std::string pairs = renadic();
    expect_says(message_for(pairs.substr(0, pairs.size() - 120)), {"truncated"});
    // pairs that are counted too low are not the end of them
    expect_says(message_for(replaced(renadic(), "POINTS =     23", "POINTS =      8")), {"count is wrong"});
    expect_says(message_for(replaced(at2(), "NPTS=    23", "NPTS=    24") + "*** End Data ***\n"), {"truncated"});
    // a mark amid the values is none
    expect_says(message_for(replaced(esm(), "\n-13.000000", "\nEND\n-13.000000")), {"\"END\" is not a number"});
}

/// Those beside the checkout, as far as they are there.
TEST(RecordMakers, CasesFromOutside)
{
    const auto folder = std::filesystem::path(STYLOBATE_DATA_DIR).parent_path() / "cases/records";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << folder << " is absent";
    const auto read = [&](const char* name, const char* unit = "") { return read_records(folder / name, unit); };
    const auto peak = [&](const char* name, const char* unit = "") { return pga_of(read(name, unit)[0]); };
    EXPECT_NEAR(peak("at2_end_mark.AT2"), 0.27364 * g, 1e-9);
    EXPECT_EQ(read("csmip_8f9_6.RAW")[0].acceleration_m_s2, read("csmip_8f10_6.RAW")[0].acceleration_m_s2);
    EXPECT_NEAR(peak("cosmos_blank_bar.v1"), 1.61962, 1e-5);
    EXPECT_EQ(read("renadic_pairs.v1")[0].acceleration_m_s2.size(), 200u);
    EXPECT_NEAR(read("renadic_pairs.v1")[0].acceleration_m_s2[50], 0, 1e-12);
    EXPECT_NEAR(read("renadic_pairs.v1")[0].acceleration_m_s2[51], 0.056 * g / 10, 1e-12);
    ASSERT_EQ(read("turkey_nsmn.txt").size(), 3u);
    EXPECT_EQ(read("turkey_nsmn.txt")[2].direction, Direction::vertical);
    EXPECT_NEAR(read("turkey_nsmn.txt")[0].acceleration_m_s2[1], 0.0001644, 1e-12);
    EXPECT_NEAR(peak("europe_cor.acc"), 1.2871778, 1e-9);
    EXPECT_NEAR(peak("eqsig_name_npts_dt.txt", "m/s2"), 1.287178, 1e-9);
    EXPECT_NEAR(peak("dexp.AT2"), 0.19177871 * g, 1e-9);
    for (const char* name : {"comma.AT2", "utf16.AT2"})
        EXPECT_THROW(read(name), InputError);
    ASSERT_EQ(read_records(folder.parent_path() / "columns/avd/m0.csv", "").size(), 1u);
    EXPECT_THROW(read_records(folder.parent_path() / "columns/avd/m0.csv", "m/s2"), InputError);
}

} // namespace
} // namespace stylobate
