/// Every ready study at a reduced size gives the numbers that are pinned in `pinned_outcomes.txt`, with every
/// instruction set. Moves of code, new interfaces and faster loops must not change one bit of them.
///
/// A change that is meant: run this program with STYLOBATE_UPDATE_PINNED=1, and write in the changelog why results
/// move, with the checksum of the new file (a test compares them). The numbers are those of Debian 12 on an x86-64
/// processor with AVX2 and FMA: the sampler uses the C library's logarithm and exponential, which depend on FMA.

#include "tests/program/program.hpp"

#include "kernels/isa.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <sstream>

namespace stylobate {
namespace {

const fs::path pinned_file = fs::path(STYLOBATE_SOURCE_DIR) / "tests/program/pinned_outcomes.txt";

/// FNV-1a, 64 bits.
struct Checksum {
    std::uint64_t value = 14695981039346656037U;

    void add(const void* data, std::size_t size)
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i)
            value = (value ^ bytes[i]) * 1099511628211U;
    }
    void add(std::string_view text) { add(text.data(), text.size()); }
    std::string text() const { return fmt::format("{:016x}", value); }
};

/// The checksum of each numerical dataset of a file, by its path: its shape and its bytes. Attributes are left out:
/// they hold the study's text and the version of the code.
std::map<std::string, std::string> checksums(const fs::path& file)
{
    std::map<std::string, std::string> found;
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    EXPECT_GE(opened, 0) << file;
    const auto visit = [](hid_t in, const char* name, const H5O_info_t* info, void* to) -> herr_t {
        if (info->type != H5O_TYPE_DATASET)
            return 0;
        const hid_t dataset = H5Dopen2(in, name, H5P_DEFAULT);
        const hid_t stored = H5Dget_type(dataset);
        const H5T_class_t kind = H5Tget_class(stored);
        if (kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM) {
            const hid_t type = H5Tget_native_type(stored, H5T_DIR_ASCEND);
            const hid_t space = H5Dget_space(dataset);
            std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
            H5Sget_simple_extent_dims(space, shape.data(), nullptr);
            std::vector<unsigned char> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) *
                                              H5Tget_size(type));
            EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
            Checksum sum;
            sum.add(shape.data(), shape.size() * sizeof(hsize_t));
            sum.add(values.data(), values.size());
            static_cast<std::map<std::string, std::string>*>(to)->emplace(name, sum.text());
            H5Sclose(space);
            H5Tclose(type);
        }
        H5Tclose(stored);
        H5Dclose(dataset);
        return 0;
    };
    H5Ovisit2(opened, H5_INDEX_NAME, H5_ITER_INC, visit, &found, H5O_INFO_BASIC);
    H5Fclose(opened);
    return found;
}

/// What is pinned of a study: the rows of its realizations, and all other datasets (counts, curves, trajectories).
struct Pinned {
    std::string rows, rest;
    bool operator==(const Pinned&) const = default;
};

Pinned pinned(const std::map<std::string, std::string>& datasets)
{
    Checksum rows, rest;
    for (const auto& [name, sum] : datasets) {
        Checksum& to = name.starts_with("realizations/") ? rows : rest;
        to.add(name);
        to.add(sum);
    }
    return {rows.text(), rest.text()};
}

struct ReducedStudy {
    std::string input;
    std::vector<std::string> settings;
};

void PrintTo(const ReducedStudy& study, std::ostream* to)
{
    *to << study.input;
}

/// Every file of studies/inputs, with what makes a second's work of it; some realizations fall in each.
const std::vector<ReducedStudy>& reduced_studies()
{
    const auto surface = [](const std::string& name, double f_from, double f_to, double a_from, double a_to,
                            std::vector<std::string> more = {}) {
        more.insert(more.end(), {"study.realizations=4",
                                 fmt::format("surface.frequency_hz={{from={:.1f},to={:.1f},count=2,spacing=\"log\"}}",
                                             f_from, f_to),
                                 fmt::format("surface.pga_m_s2={{from={:.1f},to={:.1f},count=2}}", a_from, a_to)});
        return ReducedStudy{name, more};
    };
    static const std::vector<ReducedStudy> all = {
        surface("clamped_colonnade", 0.5, 1, 3, 8),
        surface("doric_column", 1, 3, 4, 12),
        {"fragility_colonnade",
         {"study.realizations=4", "fragility.motions=8",
          "fragility.intensity={measure=\"sa\",period_s=1,from=2.0,to=20.0,count=3,spacing=\"log\"}"}},
        {"fragility_column",
         {"study.realizations=6", "fragility.motions=8",
          "fragility.intensity={measure=\"pgv\",from=0.5,to=3.0,count=3,spacing=\"log\"}"}},
        {"free_rocking", {}},
        surface("full_scale_colonnade_four", 0.4, 0.8, 1.6, 2.6),
        surface("full_scale_colonnade_one", 0.4, 0.8, 1.6, 2.6),
        surface("full_scale_colonnade_two", 0.4, 0.8, 1.6, 2.6),
        surface("isolated_column", 1, 3, 4, 12),
        {"mechanisms", {"study.realizations=12", "excitation.pga_m_s2=9.0"}},
        {"monument_past",
         {"study.realizations=4", "surface.frequency_hz.count=2", "surface.pga_m_s2.count=3", "survival.monuments=10"}},
        {"monument_risk",
         {"study.realizations=6", "fragility.motions=8",
          "fragility.intensity={measure=\"pgv\",from=0.5,to=3.0,count=3,spacing=\"log\"}"}},
        surface("near_fault_pulse", 0.4, 1, 4, 12),
        {"rare_collapse", {"rare.samples=200", "rare.repeats=5"}},
        surface("record", 1, 3, 4, 12),
        surface("restored_column", 1, 3, 4, 12),
        surface("rigid_column", 1, 4, 4, 12),
        surface("round_column", 0.5, 1.5, 3, 6),
        {"sensitivity_column", {"sensitivity.samples=6", "sensitivity.inner=2", "excitation.pga_m_s2=7"}},
        surface("small_scale_clamped", 1, 3, 6, 16),
        surface("small_scale_colonnade", 1, 3, 6, 16),
        surface("small_scale_colonnade_drums", 1, 3, 6, 16),
        surface("small_scale_column", 1, 4, 4, 12),
        surface("small_scale_column_adaptive", 1, 4, 4, 12,
                {"surface.adaptive={budget=60,minimum=4,half_width=0.05,borrow=true}"}),
        surface("small_scale_monolith", 1, 4, 4, 12),
        surface("small_scale_restored", 1, 4, 4, 12),
        surface("small_scale_strengthened", 1, 4, 4, 12),
        surface("strengthening_dowels", 1, 3, 4, 12),
        surface("strengthening_joints", 1, 3, 4, 12),
        surface("strengthening_tendon", 1, 3, 4, 12),
        surface("synthetic_earthquake", 1, 4, 4, 12),
        surface("twins_column", 1, 4, 4, 12, {"twins.followed=1"}),
    };
    return all;
}

std::map<std::string, Pinned> read_pinned()
{
    std::map<std::string, Pinned> all;
    std::istringstream lines(read_bytes(pinned_file));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        Pinned sums;
        if (!line.starts_with('#') && words >> name >> sums.rows >> sums.rest)
            all[name] = sums;
    }
    return all;
}

/// Writes the line of one study anew; the other lines stay.
void write_pinned(const std::string& name, const Pinned& sums)
{
    std::map<std::string, Pinned> all = read_pinned();
    all[name] = sums;
    std::string text =
        "# study, checksum of its realizations, checksum of its other datasets (test_pinned_outcomes.cpp)\n";
    for (const auto& [study, pinned] : all)
        text += fmt::format("{:<38} {} {}\n", study, pinned.rows, pinned.rest);
    write_bytes(pinned_file, text);
}

std::string input_of(const std::string& study)
{
    return fmt::format("{}/studies/inputs/{}.toml", STYLOBATE_SOURCE_DIR, study);
}

class PinnedOutcomes : public Program, public testing::WithParamInterface<ReducedStudy> {};

TEST_P(PinnedOutcomes, AreUnchangedWithEveryInstructionSet)
{
    const ReducedStudy& study = GetParam();
    std::vector<std::string> settings = study.settings;
    if (study.input == "record") {
        write_bytes(folder / "burst.at2", Burst{}.at2());
        settings.push_back("excitation.file=burst.at2");
    }
    const std::string input = input_of(study.input);
    std::string other = to_string(usable_isas().back()); // that verifies what another one has written
    for (const Isa isa : usable_isas()) {
        const std::string name = to_string(isa);
        const Ended ended = run(run_words(input, settings, {"-o", name + ".h5", "--simd", name, "--quiet"}));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const auto datasets = checksums(folder / (name + ".h5"));
        ASSERT_FALSE(datasets.empty());
        if (std::getenv("STYLOBATE_UPDATE_PINNED") != nullptr)
            write_pinned(study.input, pinned(datasets));
        std::string list;
        for (const auto& [dataset, sum] : datasets)
            list += fmt::format("{} {}\n", sum, dataset);
        const Pinned want = read_pinned()[study.input], got = pinned(datasets);
        EXPECT_TRUE(want == got) << study.input << ", " << name << ": " << got.rows << ' ' << got.rest << " instead of "
                                 << want.rows << ' ' << want.rest << "\n"
                                 << list;
        Words verify = {"verify-file", name + ".h5", "--simd", other, "--replay", "6", "--json"};
        if (study.input == "record")
            verify.insert(verify.end(), {"--set", "excitation.file=burst.at2"});
        const Ended verified = run(verify);
        EXPECT_EQ(verified.status, 0) << testing::PrintToString(verified);
        const JsonValue said = json_of(verified);
        ASSERT_EQ(said["checks"].items.size(), 5U);
        for (const JsonValue& check : said["checks"].items)
            EXPECT_EQ(check["verdict"].text, "ok") << check["name"].text << ": " << check["text"].text;
        other = name;
    }
}

INSTANTIATE_TEST_SUITE_P(Studies, PinnedOutcomes, testing::ValuesIn(reduced_studies()),
                         [](const auto& tested) { return tested.param.input; });

/// @param colonnade that of full scale alone: it takes as long as all others, and has the clamps of a small one
std::vector<ReducedStudy> studies_with_variants(bool colonnade)
{
    std::vector<ReducedStudy> all;
    for (const ReducedStudy& study : reduced_studies())
        if (read_bytes(input_of(study.input)).find("\n[variants") != std::string::npos &&
            colonnade == (study.input == "clamped_colonnade"))
            all.push_back(study);
    return all;
}

/// Their results are pinned as STUDY.VARIANT.
class PinnedVariants : public PinnedOutcomes {};

TEST_P(PinnedVariants, AreUnchangedWithEveryInstructionSet)
{
    const ReducedStudy& study = GetParam();
    Words words = {"compare", input_of(study.input), "--quiet", "--force", "-o", "comparison.h5"};
    for (const std::string& setting : study.settings)
        words.insert(words.end(), {"--set", setting});
    for (const Isa isa : usable_isas()) {
        for (const auto& entry : fs::directory_iterator(folder))
            fs::remove(entry);
        Words with_isa = words;
        with_isa.insert(with_isa.end(), {"--simd", to_string(isa)});
        const Ended ended = run(with_isa);
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        int variants = 0;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string stem = entry.path().stem();
            if (!stem.starts_with(study.input + "_"))
                continue;
            const std::string name = study.input + "." + stem.substr(study.input.size() + 1);
            const Pinned got = pinned(checksums(entry));
            if (std::getenv("STYLOBATE_UPDATE_PINNED") != nullptr)
                write_pinned(name, got);
            const Pinned want = read_pinned()[name];
            EXPECT_TRUE(want == got) << name << ", " << to_string(isa) << ": " << got.rows << ' ' << got.rest
                                     << " instead of " << want.rows << ' ' << want.rest;
            ++variants;
        }
        EXPECT_GE(variants, 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Studies, PinnedVariants, testing::ValuesIn(studies_with_variants(false)),
                         [](const auto& tested) { return tested.param.input; });
INSTANTIATE_TEST_SUITE_P(Long, PinnedVariants, testing::ValuesIn(studies_with_variants(true)),
                         [](const auto& tested) { return tested.param.input; });

TEST(PinnedOutcomesFile, HasEveryReadyStudy)
{
    auto sums = read_pinned();
    std::erase_if(sums, [](const auto& study) { return study.first.find('.') != std::string::npos; });
    std::size_t inputs = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(STYLOBATE_SOURCE_DIR) / "studies/inputs"))
        if (entry.path().extension() == ".toml") {
            EXPECT_TRUE(sums.contains(entry.path().stem())) << entry.path() << ": its outcomes are not pinned";
            ++inputs;
        }
    EXPECT_EQ(inputs, sums.size());
    EXPECT_EQ(inputs, reduced_studies().size());
}

/// Nobody moves results in silence.
TEST(PinnedOutcomesFile, IsNamedInTheChangelog)
{
    Checksum sum;
    sum.add(read_bytes(pinned_file));
    const std::string line = fmt::format("pinned outcomes `{}`", sum.text());
    const std::string changelog = read_bytes(fs::path(STYLOBATE_SOURCE_DIR) / "CHANGELOG.md");
    EXPECT_NE(changelog.find(line), std::string::npos) << "tests/program/pinned_outcomes.txt has changed: write in "
                                                          "CHANGELOG.md which results move and why, and end the line "
                                                          "with: "
                                                       << line;
}

} // namespace
} // namespace stylobate
