/// The seeds of the fuzzer, and some thousands of their mutations, the same ones each time. For millions, see
/// scripts/fuzz.sh.

#include "tests/io/records/record_maker_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <sstream>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

/// Each seed begins with a byte that says what unit is given with it: "0" none, "1" g.
std::map<std::string, std::string> seeds_made_here()
{
    return {{"at2", "0" + at2()},
            {"at2-crcrlf", "0" + at2("npts = 23, dt = 1.0E-02 sec", 23, "\r\r\n", 8)},
            {"at2-names-behind", "0" + at2("    23    .0100    NPTS, DT", 23)},
            {"bhrc", "0" + with_ends(bhrc_component("L1", 12) + bhrc_component("V2", 11, 1), "\r\n")},
            {"columns", "1# title\n% dt = 0.005\ntime, a, b\n" + columns(12, 2, ",")},
            {"columns-names", "0" + named_columns("Time [s],Acceleration [g],Velocity [m/s],Displacement [m]", 3)},
            {"columns-one", "1# dt = 0.01\n0.1\n0.2\n-0.3\n"},
            {"cosmos", "0" + cosmos()},
            {"csmip-pairs", "0" + renadic(12, "  0.000  0.013\n")},
            {"csmip-v1", "0" + csmip_v1_channel(1, "360 Deg", 12)},
            {"csmip-v2", "0" + csmip_v2_channel(1, " 90 DEG", 10)},
            {"esm", "0" + esm()},
            {"geonet-v1", "0" + geonet_component(1, "S62W", 20) + geonet_component(1, "Up", 20)},
            {"geonet-v2", "0" + geonet_component(2, "N28W", 23)},
            {"headed-columns", "0" + nsmn()},
            {"headed-lines", "0" + european()},
            {"knet", "0" + knet("5")},
            {"npts-dt", "1" + named_size()},
            {"smc", "0" + smc()},
            {"unam", "0" + unam()},
            {"usc", "0" + usc()}};
}

fs::path corpus()
{
    return fs::path(STYLOBATE_SOURCE_DIR) / "tests/fuzz/corpus/record";
}

std::string content_of(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<std::string> seeds()
{
    std::set<fs::path> paths; // in one order on every file system
    for (const auto& entry : fs::directory_iterator(corpus()))
        paths.insert(entry.path());
    std::vector<std::string> texts;
    for (const fs::path& path : paths)
        texts.push_back(content_of(path));
    return texts;
}

/// The records of a seed or of its mutation.
std::vector<Record> read_seed(const std::string& seed)
{
    return read_records(std::string_view(seed).substr(1), "seed", seed[0] % 2 == 0 ? std::string() : std::string("g"));
}

TEST(RecordCorpus, IsWhatTheGeneratorsMake)
{
    // to write it again after a change of a generator: STYLOBATE_WRITE_CORPUS=1 test_record_fuzz
    const bool write = std::getenv("STYLOBATE_WRITE_CORPUS") != nullptr;
    for (const auto& [name, text] : seeds_made_here()) {
        if (write)
            std::ofstream(corpus() / name, std::ios::binary) << text;
        EXPECT_EQ(content_of(corpus() / name), text) << corpus() / name;
    }
}

TEST(RecordCorpus, HoldsEveryFormatWholeAndSmall)
{
    std::set<std::string> formats;
    for (const std::string& seed : seeds()) {
        EXPECT_LE(seed.size(), 4096u) << seed.substr(0, 60); // scripts/fuzz.sh cuts there
        try {
            formats.insert(read_seed(seed).front().format);
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
    for (const char* format : {"peer-at2", "csmip", "cosmos", "bhrc", "usc-volume-1", "usgs-smc", "geonet", "esm",
                               "knet", "unam", "headed", "npts-dt", "columns"})
        EXPECT_TRUE(formats.contains(format)) << format;
}

/// Bytes flipped, removed, doubled, digits changed, lines swapped and joined with those of other seeds.
std::string mutation(const std::vector<std::string>& all, std::mt19937& random)
{
    std::string text = all[random() % all.size()];
    for (unsigned changes = 1 + random() % 4; changes > 0 && text.size() > 1; --changes) {
        const std::size_t at = 1 + random() % (text.size() - 1);
        const std::string& other = all[random() % all.size()];
        switch (random() % 6) {
        case 0:
            text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
            break;
        case 1:
            text.erase(at, 1 + random() % 40);
            break;
        case 2:
            text.insert(at, other.substr(random() % other.size(), random() % 90));
            break;
        case 3:
            if (const std::size_t digit = text.find_first_of("0123456789", at); digit != std::string::npos)
                text[digit] = "0123456789-.E *"[random() % 15];
            break;
        case 4: {
            const std::size_t line = text.find('\n', at);
            if (line != std::string::npos)
                text.erase(line + 1, text.find('\n', line + 1) - line);
            break;
        }
        default:
            text.resize(at);
        }
    }
    return text;
}

TEST(RecordCorpus, MutationsAreRefusedOrSound)
{
    const std::vector<std::string> all = seeds();
    ASSERT_FALSE(all.empty());
    std::mt19937 random(1);
    constexpr int trials = 20000;
    int refused = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const std::string text = mutation(all, random);
        try {
            for (const Record& r : read_seed(text)) {
                ASSERT_GT(r.dt_s, 0) << text;
                ASSERT_GE(r.acceleration_m_s2.size(), 2u) << text;
                for (const double a : r.acceleration_m_s2)
                    ASSERT_LE(std::fabs(a), largest_pga_m_s2) << text;
            }
        } catch (const InputError& error) {
            ASSERT_TRUE(std::string(error.what()).starts_with("seed")) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(refused, trials / 2);
    EXPECT_LT(refused, trials * 99 / 100); // a test whose every input is refused would show little
}

} // namespace
} // namespace stylobate
