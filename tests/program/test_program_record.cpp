/// Records through the program: what it says of them, and a small surface under each.

#include "tests/io/records/record_files.hpp"
#include "tests/io/store/csv_line.hpp"
#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"

#include <sstream>

namespace stylobate {
namespace {

class Records : public Program {
protected:
    /// `record --json` of one file: the object of the component, or of the only one.
    JsonValue describe(const fs::path& file, const std::string& unit, const std::string& component) const
    {
        Words words = {"record", file, "--json"};
        if (!unit.empty())
            words.insert(words.end(), {"--unit", unit});
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(ended.err, "");
        const JsonValue list = json_of(ended);
        EXPECT_EQ(list.kind, JsonValue::Kind::list);
        for (const JsonValue& object : list.items) {
            for (const char* key : {"file", "format", "station", "component", "orientation", "unit"})
                EXPECT_EQ(object[key].kind, JsonValue::Kind::text) << key;
            for (const char* key : {"dt_s", "duration_s", "pga_m_s2", "pgv_m_s", "predominant_frequency_hz"})
                EXPECT_EQ(object[key].kind, JsonValue::Kind::number) << key;
            EXPECT_EQ(object["file"].text, file.string());
            if (component.empty() || object["component"].text == component)
                return object;
        }
        ADD_FAILURE() << "no component " << component;
        return {};
    }

    /// Two realizations under the record; both must end as something, and PGAs and frequency be those of the cells.
    void expect_surface(const Words& settings) const
    {
        Words all = two_under_a_record;
        all.insert(all.end(), settings.begin(), settings.end());
        const Ended ended = run(run_words(record_study, all, {"-o", "out.h5"}));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const ResultReader reader(folder / "out.h5");
        ASSERT_TRUE(reader.complete());
        const auto rows = reader.rows();
        ASSERT_EQ(rows.size(), 2u);
        for (const ResultRow& row : rows) {
            EXPECT_NE(row.outcome.state, State::invalid);
            EXPECT_EQ(row.frequency_hz, 4);
            EXPECT_GT(row.outcome.peak_top_displacement_m, 1e-6); // it was shaken
            EXPECT_LT(std::abs(row.outcome.energy_residual), 0.02);
        }
        EXPECT_EQ(rows[0].pga_m_s2, 3);
        EXPECT_EQ(rows[1].pga_m_s2, 9);
        EXPECT_GT(rows[1].outcome.peak_top_displacement_m, rows[0].outcome.peak_top_displacement_m);
        fs::remove(folder / "out.h5");
    }
};

TEST_F(Records, OfAKnownFormula)
{
    const Burst burst;
    write_bytes(folder / "burst.at2", burst.at2());
    write_bytes(folder / "burst.txt", burst.columns());
    const double pi = 3.14159265358979323846;
    double pga = 0;
    for (int i = 0; i < burst.samples; ++i)
        pga = std::max(pga, std::abs(g * burst.value_g(i)));
    // many cycles in the burst: its velocity peaks where the sine passes zero at the middle, and its spectrum at f
    const double pgv = g * burst.amplitude_g / (2 * pi * burst.frequency_hz);
    struct Case {
        const char *file, *unit, *format, *component;
    };
    for (const Case& c : {Case{"burst.at2", "", "peer-at2", "090"}, Case{"burst.txt", "m/s2", "columns", "column 2"}}) {
        const JsonValue r = describe(c.file, c.unit, "");
        EXPECT_EQ(r["format"].text, c.format);
        EXPECT_EQ(r["component"].text, c.component);
        EXPECT_EQ(r["samples"].number, burst.samples);
        EXPECT_NEAR(r["dt_s"].number, burst.dt_s, 1e-12);
        EXPECT_NEAR(r["duration_s"].number, 10, 1e-9);
        EXPECT_NEAR(r["pga_m_s2"].number, pga, 1e-6 * pga);
        EXPECT_NEAR(r["pgv_m_s"].number, pgv, 0.03 * pgv);
        EXPECT_NEAR(r["predominant_frequency_hz"].number, burst.frequency_hz, 0.01 * burst.frequency_hz);
        Words settings = {std::string("excitation.file=") + c.file};
        if (*c.unit != '\0')
            settings.push_back(std::string("excitation.unit=") + c.unit);
        expect_surface(settings);
    }
    // several files, one list; and words for people
    const JsonValue both = json_of(run({"record", "burst.at2", "burst.at2", "--json"}));
    EXPECT_EQ(both.items.size(), 2u);
    const Ended plain = run({"record", "burst.at2"});
    for (const char* part : {"burst.at2\n", "peer-at2", "1001", "PGA", "predominant"})
        EXPECT_NE(plain.out.find(part), std::string::npos) << part;
}

TEST_F(Records, OfABlockThatRocks)
{
    const Burst burst;
    write_bytes(folder / "burst.at2", burst.at2());
    const JsonValue list = json_of(run({"record", "burst.at2", "--block", "1x4", "--json"}));
    ASSERT_EQ(list.items.size(), 1u);
    const JsonValue& r = list.items[0];
    const JsonValue& rocking = r["rocking"];
    // a block of 1 x 4 m: tan alpha = 1/4, p = sqrt(3 g / (4 R)) with R = sqrt(17) / 2, g = 9.81 m/s2
    const double p = 1.889156352;
    EXPECT_NEAR(rocking["tan_alpha"].number, 0.25, 1e-12);
    EXPECT_NEAR(rocking["p_rad_s"].number, p, 1e-9);
    EXPECT_NEAR(rocking["pga_over_g_tan_alpha"].number, r["pga_m_s2"].number / (9.81 / 4), 1e-9);
    EXPECT_NEAR(rocking["p_pgv_over_g_tan_alpha"].number, p * r["pgv_m_s"].number / (9.81 / 4), 1e-9);
    EXPECT_NEAR(rocking["omega_p_over_p"].number, 6.283185307179586 * r["predominant_frequency_hz"].number / p, 1e-8);
    EXPECT_NEAR(r["pgv_per_pga_s"].number, r["pgv_m_s"].number / r["pga_m_s2"].number, 1e-12);
    EXPECT_GT(r["cav_m_s"].number, 0);
    EXPECT_LT(std::abs(r["residual_velocity_m_s"].number), 0.01 * r["pgv_m_s"].number);
    const Ended plain = run({"record", "burst.at2", "--block", "1x4"});
    for (const char* part : {"CAV", "PGV/PGA", "baseline", "rocking      PGA/(g tan alpha)"})
        EXPECT_NE(plain.out.find(part), std::string::npos) << part;
    for (const char* block : {"1", "1x", "x4", "1x-4", "1x4m", "0x4", "1x1000"}) {
        const Ended refused = run({"record", "burst.at2", "--block", block});
        EXPECT_EQ(refused.status, 2) << block;
        EXPECT_NE(refused.err.find("WIDTHxHEIGHT"), std::string::npos) << refused.err;
        EXPECT_TRUE(refused.out.empty()) << block;
    }
}

TEST_F(Records, SaysWhereTheHeadersPeakContradictsTheSamples)
{
    // the samples of channels 1 and 3 peak at 50 cm/s2, as their headers state; those of channel 2 do not at 300
    write_bytes(folder / "three.v2", csmip_v2_channel(1, " 90 DEG", 25, 0, -50) +
                                         csmip_v2_channel(2, "UP", 24, 3, 300) +
                                         csmip_v2_channel(3, "0 DEG", 24, 0, 50));
    const JsonValue list = json_of(run({"record", "three.v2", "--json"}));
    ASSERT_EQ(list.items.size(), 3u);
    for (const std::size_t c : {0u, 1u, 2u}) {
        const JsonValue& r = list.items[c];
        EXPECT_EQ(r["station"].text, "SOME WHERE");
        EXPECT_EQ(r["component"].text, "chan " + std::to_string(c + 1));
        EXPECT_EQ(r["orientation"].text, c == 0 ? "90" : c == 1 ? "UP" : "0");
        EXPECT_EQ(r["unit"].text, "cm/s2");
        const double header = c == 1 ? 3.0 : 0.5;
        EXPECT_NEAR(r["header_pga_m_s2"].number, header, 1e-9);
        EXPECT_NEAR(r["header_pga_difference"].number, (r["pga_m_s2"].number - header) / header, 1e-9);
        EXPECT_EQ(r["header_pga_contradicts"].kind, JsonValue::Kind::boolean);
        EXPECT_EQ(r["header_pga_contradicts"].boolean, c == 1);
    }
    const double pga = list.items[1]["pga_m_s2"].number;
    const Ended plain = run({"record", "three.v2"});
    EXPECT_EQ(plain.status, 0);
    const std::string said = "its header   3.0000 m/s2: CONTRADICTED by the samples, by ";
    ASSERT_NE(plain.out.find(said), std::string::npos) << plain.out;
    EXPECT_NEAR(std::stod(plain.out.substr(plain.out.find(said) + said.size())), pga - 3, 1e-4);
    EXPECT_EQ(plain.out.find("CONTRADICTED"), plain.out.rfind("CONTRADICTED")); // of channel 2 alone
    EXPECT_NE(plain.out.find("its header   0.5000 m/s2\n"), std::string::npos);
    // a header that states none has no word of it
    write_bytes(folder / "burst.at2", Burst{}.at2());
    EXPECT_EQ(run({"record", "burst.at2"}).out.find("its header"), std::string::npos);
    EXPECT_EQ(run({"record", "burst.at2", "--json"}).out.find("header_pga"), std::string::npos);
}

TEST_F(Records, ATitleInLatin1IsStillJson)
{
    std::string text = Burst{}.at2();
    text.replace(text.find("Some Where"), 10, "Cat\xe1stro\x66\x65\"\\");
    write_bytes(folder / "latin.at2", text);
    const JsonValue r = describe("latin.at2", "", "");
    EXPECT_TRUE(r["title"].text.starts_with("Cat\xc3\xa1strofe\"\\,")) << r["title"].text;
}

/// A line of records/summary.csv, whose numbers were computed by other code.
struct Summary {
    std::string file, component;
    double n = 0, dt_s = 0, duration_s = 0, pga_m_s2 = 0, frequency_hz = 0;
};

Summary summary_of(const fs::path& csv, const std::string& file, const std::string& component)
{
    std::istringstream text(read_bytes(csv));
    for (std::string line; std::getline(text, line);) {
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() > 8 && cells[0] == file && (component.empty() || cells[1] == component))
            return {cells[0],
                    cells[1],
                    std::stod(cells[2]),
                    std::stod(cells[3]),
                    std::stod(cells[4]),
                    std::stod(cells[5]),
                    std::stod(cells[8])};
    }
    ADD_FAILURE() << csv << " has no " << file << ' ' << component;
    return {};
}

TEST_F(Records, OfEarthquakes)
{
    const fs::path data = fs::path(STYLOBATE_DATA_DIR) / "records";
    if (!fs::exists(data / "summary.csv"))
        GTEST_SKIP() << "the records are not here: " << data;
    struct Case {
        std::string file, unit, component, in_summary;
    };
    for (const Case& c :
         {Case{"text/sct190985.txt", "g", "column 2", "SCT N-S"}, Case{"at2/RSN825_CAPEMEND_CPM000.AT2", "", "", ""},
          Case{"at2/RSN6_IMPVALL.I_I-ELC180.AT2", "", "", ""}}) {
        SCOPED_TRACE(c.file);
        const Summary want = summary_of(data / "summary.csv", c.file, c.in_summary);
        const JsonValue r = describe(data / c.file, c.unit, c.component);
        EXPECT_EQ(r["samples"].number, want.n);
        EXPECT_NEAR(r["dt_s"].number, want.dt_s, 0.01 * want.dt_s);
        EXPECT_NEAR(r["duration_s"].number, want.duration_s, 0.01 * want.duration_s);
        EXPECT_NEAR(r["pga_m_s2"].number, want.pga_m_s2, 0.01 * want.pga_m_s2);
        EXPECT_NEAR(r["predominant_frequency_hz"].number, want.frequency_hz, 0.01 * want.frequency_hz);
        Words settings = {"excitation.file=" + (data / c.file).string()};
        if (!c.unit.empty())
            settings.insert(settings.end(), {"excitation.unit=" + c.unit, "excitation.component=2"});
        expect_surface(settings);
    }
}

class ReplayUnderARecord : public Records {
protected:
    void SetUp() override
    {
        Records::SetUp();
        write_bytes(folder / "burst.at2", Burst{}.at2());
        Words settings = two_under_a_record;
        settings.push_back("excitation.file=burst.at2");
        ASSERT_EQ(run(run_words(record_study, settings, {"-o", "out.h5"})).status, 0);
    }
    const Words replay_ = {"replay", "out.h5", "--realization", "1"};
};

TEST_F(ReplayUnderARecord, FindsTheRecordWhereItWas)
{
    const Ended ended = run(replay_);
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_NE(ended.out.find("bitwise identical"), std::string::npos);
}

TEST_F(ReplayUnderARecord, SaysWhatToDoWhereTheRecordHasMoved)
{
    fs::create_directory(folder / "records");
    fs::rename(folder / "burst.at2", folder / "records" / "moved.at2");
    expect_refused(replay_, {"burst.at2", "no such file"});
    Words words = replay_;
    words.insert(words.end(), {"--set", "excitation.file=records/moved.at2"});
    const Ended ended = run(words);
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_NE(ended.out.find("bitwise identical"), std::string::npos);
    const Ended strip = run({"export", "out.h5", "--to", "png", "--picture", "strip", "--realization", "1", "--set",
                             "excitation.file=records/moved.at2"});
    EXPECT_EQ(strip.status, 0) << testing::PrintToString(strip);
}

TEST_F(ReplayUnderARecord, RefusesAnotherRecordOfThatName)
{
    Burst other;
    other.amplitude_g *= 1.0001;
    write_bytes(folder / "burst.at2", other.at2());
    expect_refused(replay_, {"burst.at2", "is not the record", "--set excitation.file=PATH"});
    // and to continue or to repeat the run under it is another study, too
    Words settings = two_under_a_record;
    settings.push_back("excitation.file=burst.at2");
    expect_refused(run_words(record_study, settings, {"-o", "out.h5"}), {"out.h5", "another study", "record: "});
}

TEST_F(ReplayUnderARecord, ChangesNothingElseOfTheStudy)
{
    Words words = replay_;
    words.insert(words.end(), {"--set", "contact.friction=0.5"});
    expect_refused(words, {"contact.friction=0.5", "out.h5", "only excitation.file"});
}

} // namespace
} // namespace stylobate
