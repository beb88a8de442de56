/// Measured campaigns in files: what is written is read again bit by bit, what other programs write is read, and what
/// is damaged is refused.

#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_file.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/io/measured/same_campaign.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// Every field in use, every optional one absent somewhere.
Campaign full_campaign()
{
    Campaign campaign = sample_campaign(2);
    MeasuredRun& run = campaign.runs[0];
    run.run_order = 7;
    run.collapsed = true;
    run.collapse_time_s = 2.1;
    run.base_source = BaseSource::command;
    run.base_clock = "table computer";
    run.table.x_m = run.base_displacement_m;
    run.table.y_m.values.assign(run.time_s.size(), 1e-3 / 3);
    run.table.theta_rad.values.assign(run.time_s.size(), -0.0);
    for (std::size_t i = run.blocks.x_m.values.size() - 600; i < run.blocks.x_m.values.size(); ++i)
        run.blocks.x_m.values[i] = run.blocks.theta_rad.values[i] = run.blocks.y_m.values[i] = nan_value;
    campaign.runs[1].collapsed.reset();
    campaign.runs[1].blocks.y_m = {};
    campaign.runs[1].base_displacement_m.noise_sd.reset();
    campaign.runs[1].motion_id = -3;
    campaign.runs[2].base_acceleration_m_s2 = {};
    campaign.runs[2].kind.reset();
    return campaign;
}

TEST(MeasuredFile, RoundTripOfHdf5IsBitForBit)
{
    const MeasuredFolder folder("h5");
    const Campaign campaign = full_campaign();
    write_campaign(campaign, folder / "a.h5");
    expect_same(campaign, read_campaign(folder / "a.h5"));
    write_campaign(campaign, folder / "a.h5"); // replaces
    for (const auto& entry : fs::directory_iterator(folder / "."))
        EXPECT_EQ(entry.path().filename(), "a.h5") << "left behind";
}

TEST(MeasuredFile, RoundTripOfCsvIsBitForBit)
{
    const MeasuredFolder folder("csv");
    const Campaign campaign = full_campaign();
    write_campaign(campaign, folder / "a");
    expect_same(campaign, read_campaign(folder / "a"));
    expect_same(campaign, read_campaign(folder / "a/campaign.toml"));
    EXPECT_NE(refusal([&] { write_campaign(campaign, folder / "a"); }).find("exists already"), std::string::npos);
    EXPECT_NE(refusal([&] { write_campaign(campaign, folder / "none/a"); }), "");
    EXPECT_NE(refusal([&] { write_campaign(campaign, folder / "none/a.h5"); }), "");
}

TEST(MeasuredFile, NothingButTheFormatIsNeeded)
{
    const MeasuredFolder folder("empty");
    Campaign campaign;
    campaign.runs.resize(1);
    campaign.runs[0].name = "only";
    for (const char* name : {"a.h5", "a"}) {
        write_campaign(campaign, folder / name);
        expect_same(campaign, read_campaign(folder / name));
    }
}

TEST(MeasuredFile, WithoutAClockTheRateIsOne)
{
    const MeasuredFolder folder("clock");
    Campaign campaign = sample_campaign(1);
    campaign.runs.resize(1);
    write_campaign(campaign, folder / "a");
    std::string text = content_of(folder / "a/runs/000.csv");
    std::string without;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        without += line.substr(line.find(',') + 1) + "\n";
    write_content(folder / "a/runs/000.csv", without);
    const Campaign read = read_campaign(folder / "a");
    ASSERT_EQ(read.runs[0].time_s.size(), campaign.runs[0].time_s.size());
    EXPECT_DOUBLE_EQ(read.runs[0].time_s.back(), campaign.runs[0].time_s.back());
    ASSERT_FALSE(read.findings.empty());
    EXPECT_NE(read.findings[0].text.find("no clock"), std::string::npos);

    std::string toml = content_of(folder / "a/campaign.toml");
    toml.replace(toml.find("rate_hz"), std::string("rate_hz").size(), "#");
    write_content(folder / "a/campaign.toml", toml);
    EXPECT_NE(refusal([&] { read_campaign(folder / "a"); }).find("neither time_s nor rate_hz"), std::string::npos);
}

/// Files as other programs write them.
class Foreign {
public:
    explicit Foreign(const fs::path& path) : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
    ~Foreign() { H5Fclose(file_); }

    void group(const char* path) { H5Gclose(H5Gcreate2(file_, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); }
    template <class T>
    void data(const char* path, hid_t stored, hid_t native, std::vector<hsize_t> dims, const std::vector<T>& values,
              bool packed = false)
    {
        const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
        const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
        if (packed) {
            H5Pset_chunk(creation, static_cast<int>(dims.size()), dims.data());
            H5Pset_shuffle(creation);
            H5Pset_deflate(creation, 9);
        }
        const hid_t set = H5Dcreate2(file_, path, stored, space, H5P_DEFAULT, creation, H5P_DEFAULT);
        ASSERT_GE(set, 0) << path;
        ASSERT_GE(H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
        H5Dclose(set);
        H5Pclose(creation);
        H5Sclose(space);
    }
    /// Of fixed length, padded with blanks as Fortran does.
    void text(const char* object, const char* name, std::string value)
    {
        value.resize(40, ' ');
        const hid_t type = H5Tcopy(H5T_FORTRAN_S1);
        H5Tset_size(type, value.size());
        attribute(object, name, type, type, value.data());
        H5Tclose(type);
    }
    template <class T>
    void number(const char* object, const char* name, hid_t stored, hid_t native, T value, bool list = false)
    {
        attribute(object, name, stored, native, &value, list);
    }

private:
    void attribute(const char* object, const char* name, hid_t stored, hid_t native, const void* value,
                   bool list = false)
    {
        const hsize_t one = 1;
        const hid_t space = list ? H5Screate_simple(1, &one, nullptr) : H5Screate(H5S_SCALAR);
        const hid_t at = H5Oopen(file_, object, H5P_DEFAULT);
        const hid_t set = H5Acreate2(at, name, stored, space, H5P_DEFAULT, H5P_DEFAULT);
        ASSERT_GE(H5Awrite(set, native, value), 0);
        H5Aclose(set);
        H5Oclose(at);
        H5Sclose(space);
    }
    hid_t file_;
};

/// A specimen of one block and a run of 400 samples, in unusual types.
void write_foreign(Foreign& file, const char* unit_of_x = "mm")
{
    file.text("/", "format", "stylobate-measured");
    file.number("/", "format_version", H5T_STD_U8BE, H5T_NATIVE_INT, 1, true);
    file.group("/specimen");
    file.data<float>("/specimen/half_width_m", H5T_IEEE_F32BE, H5T_NATIVE_FLOAT, {1}, {0.5f});
    file.data<float>("/specimen/half_height_m", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {1}, {1.0f});
    file.data<float>("/specimen/depth_m", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {1}, {1.0f});
    file.data<int>("/specimen/mass_kg", H5T_STD_I16BE, H5T_NATIVE_INT, {1}, {5000});
    file.data<int>("/specimen/rest_x_m", H5T_STD_I64LE, H5T_NATIVE_INT, {1}, {0});
    file.data<int>("/specimen/rest_y_m", H5T_STD_I8LE, H5T_NATIVE_INT, {1}, {1});
    file.data<int>("/specimen/joints", H5T_STD_I8LE, H5T_NATIVE_INT, {1, 2}, {-1, 0});
    file.group("/runs");
    file.group("/runs/7");
    file.number("/runs/7", "motion_id", H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, 3.0);
    file.text("/runs/7", "kind", "sweep");
    std::vector<float> time, x;
    for (int i = 0; i < 400; ++i) {
        time.push_back(2.0f * static_cast<float>(i)); // ms
        x.push_back(0.01f * static_cast<float>(i % 7));
    }
    file.data("/runs/7/time_s", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {400}, time);
    file.text("/runs/7/time_s", "unit", "ms");
    file.group("/runs/7/blocks");
    file.data("/runs/7/blocks/x_m", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {400, 1}, x, true);
    file.text("/runs/7/blocks/x_m", "unit", unit_of_x);
    file.number("/runs/7/blocks/x_m", "noise_sd", H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, 0.05);
}

TEST(MeasuredFile, OtherProgramsTypesAndUnitsAreRead)
{
    const MeasuredFolder folder("foreign");
    {
        Foreign file(folder / "a.h5");
        write_foreign(file);
    }
    const Campaign campaign = read_campaign(folder / "a.h5");
    EXPECT_EQ(campaign.specimen.mass_kg, std::vector<double>{5000});
    EXPECT_EQ(campaign.specimen.joints, (std::vector<std::pair<int, int>>{{-1, 0}}));
    ASSERT_EQ(campaign.runs.size(), 1u);
    const MeasuredRun& run = campaign.runs[0];
    EXPECT_EQ(run.name, "7");
    EXPECT_EQ(run.motion_id, 3);
    EXPECT_EQ(run.kind, "sweep");
    EXPECT_DOUBLE_EQ(run.time_s[399], 0.798);
    EXPECT_DOUBLE_EQ(run.blocks.x_m.values[6], 0.06f * 1e-3);
    EXPECT_NEAR(*run.blocks.x_m.noise_sd, 5e-5, 1e-12);
    EXPECT_EQ(std::count_if(campaign.findings.begin(), campaign.findings.end(),
                            [](const Finding& f) { return f.text.find("converted from m") != std::string::npos; }),
              2);
}

TEST(MeasuredFile, UnknownUnitsAndWrongTypesAreRefusedByName)
{
    const MeasuredFolder folder("refused");
    const auto message = [&](auto&& change) {
        {
            Foreign file(folder / "a.h5");
            change(file);
        }
        const std::string text = refusal([&] { read_campaign(folder / "a.h5"); });
        EXPECT_NE(text.find("a.h5"), std::string::npos) << text;
        return text;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos ? ::testing::AssertionSuccess()
                                                    : ::testing::AssertionFailure() << part << " not in: " << text;
    };
    EXPECT_TRUE(has(message([](Foreign& f) { write_foreign(f, "furlong"); }), "blocks/x_m: its unit \"furlong\""));
    EXPECT_TRUE(has(message([](Foreign& f) { f.text("/", "format", "stylobate"); }), "contains results"));
    EXPECT_TRUE(has(message([](Foreign& f) { f.group("/runs"); }), "is not a file of measured data"));
    EXPECT_TRUE(has(message([](Foreign& f) {
                        write_foreign(f);
                        f.data<float>("/runs/7/blocks/theta_rad", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {1, 400},
                                      std::vector<float>(400));
                    }),
                    "blocks/theta_rad is 1 x 400"));
    EXPECT_TRUE(has(message([](Foreign& f) {
                        write_foreign(f);
                        f.data<float>("/runs/7/blocks/theta_rad", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {399, 1},
                                      std::vector<float>(399));
                    }),
                    "blocks/theta_rad has 399 rows where time_s has 400"));
    EXPECT_TRUE(has(message([](Foreign& f) {
                        write_foreign(f);
                        f.number("/specimen", "friction_nominal", H5T_STD_REF_OBJ, H5T_STD_REF_OBJ, hobj_ref_t(0));
                    }),
                    "does not hold numbers"));
    EXPECT_TRUE(has(message([](Foreign& f) {
                        write_foreign(f);
                        f.number("/runs/7", "repeat", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 0.5);
                    }),
                    "repeat = 0.5 is not a whole number"));
}

TEST(MeasuredFile, UnknownDataAreTold)
{
    const MeasuredFolder folder("unknown");
    {
        Foreign file(folder / "a.h5");
        write_foreign(file);
        file.data<float>("/runs/7/blocks/tehta_rad", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, {400, 1},
                         std::vector<float>(400));
    }
    const Campaign campaign = read_campaign(folder / "a.h5");
    EXPECT_TRUE(std::any_of(campaign.findings.begin(), campaign.findings.end(), [](const Finding& f) {
        return f.place == "runs/7/blocks/tehta_rad" && f.text.find("Did you mean theta_rad?") != std::string::npos;
    }));
}

TEST(MeasuredFile, ColumnsOfCsvSayTheirUnits)
{
    const MeasuredFolder folder("columns");
    fs::create_directories(folder / "a/runs");
    write_content(folder / "a/campaign.toml", "[campaign]\nformat = \"stylobate-measured\"\nformat_version = 1\n"
                                              "[[run]]\nname = \"x\"\nrate_hz = 2.0\nnoise_x_m = 0.001\n");
    write_content(folder / "a/runs/x.csv", "# made by hand\ntime_ms, base_acceleration_g, theta1_deg, x1_mm\r\n"
                                           "0, 0.5, 90, 1\r\n500, +1e0, , 3\r\n");
    const Campaign campaign = read_campaign(folder / "a");
    const MeasuredRun& run = campaign.runs[0];
    EXPECT_EQ(run.time_s, (std::vector<double>{0, 0.5}));
    EXPECT_NEAR(run.base_acceleration_m_s2.values[1], 9.80665, 1e-12);
    ASSERT_EQ(run.blocks.x_m.values.size(), 4u); // two blocks, the first one never seen
    EXPECT_TRUE(std::isnan(run.blocks.x_m.values[0]));
    EXPECT_DOUBLE_EQ(run.blocks.x_m.values[3], 0.003);
    EXPECT_NEAR(run.blocks.theta_rad.values[1], std::numbers::pi / 2, 1e-12);
    EXPECT_TRUE(std::isnan(run.blocks.theta_rad.values[3]));

    const auto refused = [&](const std::string& csv, const std::string& part) {
        write_content(folder / "a/runs/x.csv", csv);
        const std::string text = refusal([&] { read_campaign(folder / "a"); });
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    refused("time_s,thta0_rad\n0,0\n", "Did you mean theta0_rad?");
    refused("time_s,thta0_deg\n0,0\n", "Did you mean theta0_deg?"); // in the unit of the file
    refused("time_s,x0_furlong\n0,0\n",
            "Did you mean x0_m? The unit is part of the name, and the values must be in it: "
            "known units are m, cm, mm, um.");
    refused("time_s;x0_mm\n0;0,5\n", "x.csv:2: x0_mm = \"0,5\" has a decimal comma");
    refused(std::string("\xff\xfet\0i\0", 6), "UTF-16");
    refused("time_s,x0_m\n0,0\n1\n", "x.csv:3: has 1 fields where there are 2 columns");
    refused("time_s,x0_m\n0,O\n", "x.csv:2: x0_m = \"O\" is not a number");
    refused("time_s,x0_m,x0_m\n", "\"x0_m\" occurs twice");
    refused("time_s,x0_m,x0_mm\n", "\"x0_m\" and \"x0_mm\" are the same series");
    refused("", "no line of column names");
}

TEST(MeasuredFile, CsvOfOtherProgramsIsRead)
{
    const MeasuredFolder folder("separators");
    fs::create_directories(folder / "a/runs");
    write_content(folder / "a/campaign.toml", "[campaign]\nformat = \"stylobate-measured\"\nformat_version = 1\n"
                                              "[[run]]\nname = \"x\"\nrate_hz = 2.0\nnoise_x_m = 0.001\n");
    for (const char* csv :
         {"time_s,X0_mm\n0,1.5\n0.5,2\n", "Time_s;X0_MM\n0;1.5\n0.5;2\n", "time_s\tx0_mm\n0\t1.5\n0.5\t2\n",
          "\xef\xbb\xbftime_s; x0_m\n0; 1.5D-03\n5.0d-01; 2.0D-3\n"}) {
        SCOPED_TRACE(csv);
        write_content(folder / "a/runs/x.csv", csv);
        const MeasuredRun run = read_campaign(folder / "a").runs[0];
        EXPECT_EQ(run.time_s, (std::vector<double>{0, 0.5}));
        ASSERT_EQ(run.blocks.x_m.values.size(), 2u);
        EXPECT_DOUBLE_EQ(run.blocks.x_m.values[0], 0.0015);
        EXPECT_DOUBLE_EQ(run.blocks.x_m.values[1], 0.002);
    }
}

TEST(MeasuredFile, PracticeCampaignsAreRead)
{
    const auto files = practice_campaigns();
    if (files.empty())
        GTEST_SKIP() << "no practice campaigns beside this checkout";
    EXPECT_EQ(files.size(), 11u);
    const MeasuredFolder folder("practice");
    for (const fs::path& file : files) {
        const Campaign campaign = read_campaign(file);
        EXPECT_EQ(campaign.runs.size(), 10u) << file;
        EXPECT_GE(campaign.specimen.blocks(), 2) << file;
        EXPECT_EQ(campaign.specimen.joints.size(),
                  campaign.specimen.rest_x_m.size() + (file.stem() == "campaign_02" || file.stem() == "campaign_04"));
        for (const MeasuredRun& run : campaign.runs) {
            EXPECT_EQ(run.rate_hz, 500) << file;
            EXPECT_EQ(run.blocks.x_m.values.size(), run.time_s.size() * campaign.specimen.rest_x_m.size());
            EXPECT_TRUE(run.base_acceleration_m_s2.noise_sd && run.collapsed) << file;
        }
        if (file == files.front()) {
            write_campaign(campaign, folder / "a.h5");
            expect_same(campaign, read_campaign(folder / "a.h5"));
            write_campaign(campaign, folder / "a");
            expect_same(campaign, read_campaign(folder / "a"));
        }
    }
}

/// Reads what may be damaged: it is refused with its name, or read; anything else is a failure of the test.
bool refused(const fs::path& path)
{
    const std::string message = refusal([&] { read_campaign(path); });
    EXPECT_TRUE(message.empty() || message.find(path.stem().string()) != std::string::npos) << message;
    return !message.empty();
}

TEST(MeasuredFileFaults, TruncatedFilesAreRefused)
{
    const MeasuredFolder folder("cut");
    Campaign campaign = sample_campaign(2);
    for (MeasuredRun& run : campaign.runs)
        run = sample_run(campaign.specimen, run.name, 5, {}, 50);
    write_campaign(campaign, folder / "whole.h5");
    const std::string whole = content_of(folder / "whole.h5");
    for (std::size_t i = 0; i < 60; ++i) {
        write_content(folder / "cut.h5", whole.substr(0, whole.size() * i / 60));
        EXPECT_TRUE(refused(folder / "cut.h5")) << i;
    }
    EXPECT_TRUE(refused(folder / "missing.h5"));
}

class Mutations : public testing::TestWithParam<unsigned> {};

TEST_P(Mutations, OfHdf5AreRefusedOrRead)
{
    const MeasuredFolder folder("h5_mutations_" + std::to_string(GetParam()));
    Campaign campaign = sample_campaign(2);
    for (MeasuredRun& run : campaign.runs)
        run = sample_run(campaign.specimen, run.name, 5, {}, 50);
    write_campaign(campaign, folder / "whole.h5");
    const std::string whole = content_of(folder / "whole.h5");
    std::mt19937 random(GetParam());
    int refusals = 0;
    for (int trial = 0; trial < 50; ++trial) {
        std::string text = whole;
        for (auto changes = 1 + random() % 8; changes > 0; --changes)
            text[random() % text.size()] ^= static_cast<char>(1 + random() % 255);
        write_content(folder / "mutation.h5", text);
        refusals += refused(folder / "mutation.h5");
    }
    EXPECT_GT(refusals, 0);
    EXPECT_LT(refusals, 50);
}

// in parts, so that no test is long
INSTANTIATE_TEST_SUITE_P(MeasuredFileFaults, Mutations, testing::Values(1U, 2U, 3U, 4U));

TEST(MeasuredFileFaults, MutationsOfCsvAndTomlAreRefusedOrRead)
{
    const MeasuredFolder folder("csv_mutations");
    Campaign campaign = sample_campaign(2);
    campaign.runs.resize(1);
    campaign.runs[0] = sample_run(campaign.specimen, "000", 5, {}, 10);
    write_campaign(campaign, folder / "mutation");
    std::mt19937 random(2);
    int refusals = 0;
    for (const char* name : {"mutation/campaign.toml", "mutation/runs/000.csv"}) {
        const std::string whole = content_of(folder / name);
        for (int trial = 0; trial < 200; ++trial) {
            std::string text = whole;
            for (auto changes = 1 + random() % 3; changes > 0; --changes) {
                const std::size_t at = random() % text.size();
                switch (random() % 4) {
                case 0:
                    text[at] ^= static_cast<char>(1 << random() % 8);
                    break;
                case 1:
                    text.erase(at, 1 + random() % 20);
                    break;
                case 2:
                    text.insert(at, whole.substr(random() % whole.size(), random() % 40));
                    break;
                default:
                    text[at] = "0123456789-.eE,[]\"\n ="[random() % 21];
                }
            }
            write_content(folder / name, text);
            refusals += refused(folder / "mutation");
        }
        write_content(folder / name, whole);
    }
    EXPECT_GT(refusals, 100);
    EXPECT_LT(refusals, 396);
}

} // namespace
} // namespace stylobate
