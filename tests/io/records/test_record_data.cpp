/// Real earthquakes: every file beside the checkout, against figures that other code computed from them, and against
/// what each file says of itself.

#include "tests/io/records/record_files.hpp"
#include "tests/io/store/csv_line.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/records/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

fs::path folder()
{
    return fs::path(STYLOBATE_DATA_DIR) / "records";
}

/// Plain columns do not say their unit.
const std::map<std::string, std::string> units = {{"text/CHV1-20140203E.txt", "cm/s2"},
                                                  {"text/LXR1-20140203E.txt", "cm/s2"},
                                                  {"text/LXR1-20140203N.txt", "cm/s2"},
                                                  {"text/Northridge_Sylmar_County.dat", "m/s2"},
                                                  {"text/SanSalvador1986GIC090.txt", "m/s2"},
                                                  {"text/Spitak.dat", "m/s2"},
                                                  {"text/sct190985.txt", "g"}};

/// Files that may be refused as of no known format, and the format that they have: as long as it has no reader.
const std::map<std::string, std::string> may_be_unknown = {
    {"formats/20101114230825_3104_ap_RawAcc_E.asc", "esm"},
    {"formats/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", "esm"},
    {"formats/HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC", "esm"},
    {"formats/HL.DLFA..HNE.D.20190728.160908.C.ACC.ASC", "esm"},
    {"formats/20161113_110259_WTMC_20.V2A", "geonet"},
    {"formats/AICH040010061330.EW2", "knet"},
    {"formats/CHB0021412312349.EW", "knet"},
    {"formats/CUP50401.012", "unam"},
    {"formats/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c", "cosmos"}};

/// Whether it is for want of a reader that the file is refused: the message lists the formats that have one.
bool waits_for_its_reader(const std::string& file, const std::string& message)
{
    const auto format = may_be_unknown.find(file);
    return format != may_be_unknown.end() && message.find("has an unknown format (") != std::string::npos &&
           message.find(", " + format->second + ",") == std::string::npos;
}

/// Files whose header states another peak than their samples have, and why that is the file's fault.
const std::map<std::string, std::string> header_contradicts = {};

struct Expected {
    double n = 0, dt_s = 0, pga_m_s2 = 0;
    std::string header; ///< as the summary quotes it
};

/// What was computed from a file, one entry for each of its components in turn.
std::map<std::string, std::vector<Expected>> expectations()
{
    std::map<std::string, std::vector<Expected>> all;
    std::ifstream summary(folder() / "summary.csv");
    std::string line;
    std::getline(summary, line); // names
    while (std::getline(summary, line)) {
        while (line.ends_with('\r'))
            line.pop_back();
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() >= 13)
            all[cells[0]].push_back({std::stod(cells[2]), std::stod(cells[3]), std::stod(cells[5]), cells[12]});
    }
    // not in the summary: decoded by a few lines of Python, columns by hand; the last on the grid of its milliseconds
    all["formats/CE89146.V1"] = {{13200, 0.005, 0.77649, ""}, {13200, 0.005, 0.20648, ""}, {13200, 0.005, 0.44414, ""}};
    all["formats/5526-1.V1"] = {{9472, 0.005, 0.058010, ""}, {9472, 0.005, 0.063750, ""}, {9472, 0.005, 0.129420, ""}};
    all["formats/017m30lw.s0a"] = {{34717, 0.001, 2.595820, ""}};
    return all;
}

/// "header Max. Acc. 6.847 gal" to m/s2.
double quoted_m_s2(const std::string& header)
{
    std::smatch match;
    EXPECT_TRUE(std::regex_search(header, match, std::regex("(-?[0-9]+\\.[0-9]+) (cm/s2|mm/s/s|gal)"))) << header;
    return std::fabs(std::stod(match[1])) * (match[2] == "mm/s/s" ? 0.001 : 0.01);
}

void expect_within(double value, double want, double part, const char* what)
{
    EXPECT_NEAR(value, want, part * std::fabs(want)) << what;
}

void check(const std::string& file, const std::vector<Record>& records, const std::vector<Expected>& want)
{
    ASSERT_TRUE(want.empty() || records.size() == want.size()) << records.size() << " components";
    for (std::size_t c = 0; c < records.size(); ++c) {
        const Record& record = records[c];
        SCOPED_TRACE(file + ", " + record.component);
        if (!want.empty()) {
            EXPECT_LE(std::fabs(static_cast<double>(record.acceleration_m_s2.size()) - want[c].n), 2); // padding rows
            expect_within(record.dt_s, want[c].dt_s, 0.01, "dt");
            expect_within(pga_of(record), want[c].pga_m_s2, 0.01, "PGA");
            if (!want[c].header.empty()) {
                ASSERT_TRUE(record.header_pga_m_s2);
                expect_within(*record.header_pga_m_s2, quoted_m_s2(want[c].header), 1e-3, "header");
            }
        }
        // with neither a row of the summary nor a peak of its own, nothing would be compared
        EXPECT_TRUE(!want.empty() || record.header_pga_m_s2);
        if (record.header_pga_m_s2 && !header_contradicts.contains(file))
            expect_within(pga_of(record), *record.header_pga_m_s2, 0.01, "the header's PGA");
        if (record.format != "columns" && file != "at2/elCentro_opensees.AT2") { // which has no title
            EXPECT_NE(record.orientation, "");
            EXPECT_NE(record.station, "");
        }
    }
}

TEST(RecordData, EveryFileIsRead)
{
    if (!fs::exists(folder() / "summary.csv"))
        GTEST_SKIP() << "the records are not here: " << folder();
    const auto want = expectations();
    std::set<std::string> seen;
    for (const char* part : {"at2", "text", "formats"})
        for (const auto& entry : fs::directory_iterator(folder() / part)) {
            const std::string file = std::string(part) + "/" + entry.path().filename().string();
            SCOPED_TRACE(file);
            seen.insert(file);
            const auto unit = units.find(file);
            const auto expected = want.find(file);
            try {
                check(file, read_records(entry.path(), unit == units.end() ? "" : unit->second),
                      expected == want.end() ? std::vector<Expected>{} : expected->second);
            } catch (const InputError& error) {
                if (waits_for_its_reader(file, error.what()))
                    std::cout << "not read: " << file << ", of format " << may_be_unknown.at(file) << '\n';
                else
                    ADD_FAILURE() << error.what();
            }
        }
    EXPECT_GE(seen.size(), 42u);
    for (const auto& [file, rows] : want)
        EXPECT_TRUE(seen.contains(file)) << file;
}

/// The record on the grid has the root mean square that the agency stated of its uneven samples.
TEST(RecordData, UnevenRecordKeepsItsRootMeanSquare)
{
    const fs::path file = folder() / "formats" / "017m30lw.s0a";
    if (!fs::exists(file))
        GTEST_SKIP() << "the record is not here: " << file;
    const Record record = read_records(file, "").front();
    double sum = 0;
    for (const double a : record.acceleration_m_s2)
        sum += a * a;
    const double rms = std::sqrt(sum / static_cast<double>(record.acceleration_m_s2.size()));
    EXPECT_NEAR(rms, 0.400 * 0.980665, 0.01 * 0.392); // "RMS ACCLN. OF COMPLETE RECORD = .400 G/10"
}

} // namespace
} // namespace stylobate
