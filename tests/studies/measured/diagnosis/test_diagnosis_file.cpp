/// The file of a diagnosis: what is written is read, whole or not at all, and damaged files are refused.

#include "ensemble/model/input_error.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_fields.hpp"
#include "tests/io/store/result_samples.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace stylobate {
namespace {

/// Field by field through the fields' list, NaN equal to itself. Returns how many single values were compared.
template <class T>
std::size_t expect_equal(const T& a, const T& b, const std::string& where)
{
    std::size_t compared = 0;
    if constexpr (std::is_same_v<T, double>) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << where;
        return 1;
    } else if constexpr (std::is_same_v<T, std::string> || std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        EXPECT_EQ(a, b) << where;
        return 1;
    } else if constexpr (requires { a.has_value(); }) {
        EXPECT_EQ(a.has_value(), b.has_value()) << where;
        return a && b ? expect_equal(*a, *b, where) : 1;
    } else if constexpr (requires { a.size(); }) {
        EXPECT_EQ(a.size(), b.size()) << where;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            compared += expect_equal(a[i], b[i], where + "[" + std::to_string(i) + "]");
    } else {
        visit_fields(std::type_identity<T>(), [&](const char* name, auto field, const FieldFacts& = {}) {
            compared += expect_equal(a.*field, b.*field, where + "." + name);
        });
    }
    return compared;
}

std::string bytes_of(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

std::string refusal(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

class DiagnosisFile : public ResultStore {};

TEST_F(DiagnosisFile, AFilledOneReadsBackEqual)
{
    const Diagnosis want = filled_diagnosis();
    write_diagnosis(want, file);
    // series of thousands of samples, and some two hundred single values
    EXPECT_GT(expect_equal(want, read_diagnosis(file), "diagnosis"), 15000U);
}

template <class T>
std::size_t listed()
{
    std::size_t fields = 0;
    visit_fields(std::type_identity<T>(), [&](const char*, auto, const FieldFacts& = {}) { ++fields; });
    return fields;
}

/// A field that is missing in the list would be lost in silence.
TEST_F(DiagnosisFile, EveryFieldOfTheStructuresIsListed)
{
    // equality of these is the compiler's own, over all fields
    const Diagnosis want = filled_diagnosis();
    write_diagnosis(want, file);
    const Diagnosis got = read_diagnosis(file);
    EXPECT_EQ(want.base_tests, got.base_tests);
    EXPECT_EQ(want.sensor_tests, got.sensor_tests);
    EXPECT_EQ(want.baseline, got.baseline);
    EXPECT_EQ(want.wrong, got.wrong);
    EXPECT_EQ(want.candidates, got.candidates);
    EXPECT_EQ(want.nulls, got.nulls);
    EXPECT_EQ(want.unexplained, got.unexplained);
    EXPECT_EQ(want.gain, got.gain);
    EXPECT_EQ(want.missing, got.missing);
    EXPECT_EQ(want.tests, got.tests);
    EXPECT_EQ(want.cost, got.cost);
    // of the others the compiler counts the fields: one name too few or too many here is an error
    const Figure figure; // that of a diagnosis has its place besides
    [[maybe_unused]] const auto& [title, caption, x_label, y_label, x_log, y_log, x_ticks, all_series, x_range, y_range,
                                  cells] = figure; // the last three: of no diagnosis
    EXPECT_EQ(listed<DiagnosisFigure>(), 9U);
    const FigureSeries series;
    [[maybe_unused]] const auto& [name, kind, x, y, low, high, group, layer, colour, dashed, weight, shown] =
        series; // the last six: of no diagnosis
    EXPECT_EQ(listed<FigureSeries>(), 6U);
    const Diagnosis whole;
    [[maybe_unused]] const auto& [d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12, d13, d14, d15, d16, d17, d18,
                                  d19, d20, d21, d22, d23, d24, d25, d26, d27, d28, d29] = whole;
    EXPECT_EQ(listed<Diagnosis>(), 30U);
    const WindowMotions motion;
    [[maybe_unused]] const auto& [blocks, windows] = motion;
    EXPECT_EQ(listed<WindowMotions>(), 2U);
    const ShownBlock block;
    [[maybe_unused]] const auto& [of_block, half_width, half_height, rest_x, rest_y] = block;
    EXPECT_EQ(listed<ShownBlock>(), 5U);
    const WindowMotion window;
    [[maybe_unused]] const auto& [w0, w1, w2, w3, w4, w5, w6, w7] = window;
    EXPECT_EQ(listed<WindowMotion>(), 8U);
    const MotionTrack track;
    [[maybe_unused]] const auto& [model, excess, at_block, at_coordinate, places] = track;
    EXPECT_EQ(listed<MotionTrack>(), 5U);
    const MotionSample sample;
    [[maybe_unused]] const auto& [sample_time, sample_base] = sample;
    EXPECT_EQ(listed<MotionSample>(), 2U);
    const BlockPlace place;
    [[maybe_unused]] const auto& [place_x, place_y, place_theta] = place;
    EXPECT_EQ(listed<BlockPlace>(), 3U);
}

/// Of what no program of ours has written, but whose bytes are sealed.
TEST_F(DiagnosisFile, RefusesWindowsThatDoNotFitTogether)
{
    const std::vector<std::pair<std::string, std::function<void(WindowMotions&)>>> faults = {
        {"as many", [](WindowMotions& m) { m.windows[1].tracks[2].places.pop_back(); }},
        {"as many", [](WindowMotions& m) { m.windows[0].samples.pop_back(); }},
        {"no size", [](WindowMotions& m) { m.blocks[1].half_height_m = 0; }},
        {"no place", [](WindowMotions& m) { m.blocks[0].rest_x_m = std::nan(""); }},
        {"at the end", [](WindowMotions& m) { std::swap(m.blocks[0], m.blocks[2]); }},
        {"ascend", [](WindowMotions& m) { m.windows[0].samples[4].time_s = m.windows[0].samples[3].time_s; }},
        {"ascend", [](WindowMotions& m) { m.windows[0].samples[4].base_x_m = std::nan(""); }},
        {"lacks", [](WindowMotions& m) { m.windows[0].tracks[0].model = "seen"; }},
        {"lacks", [](WindowMotions& m) { m.windows[0].tracks.resize(1); }},
        {"lacks", [](WindowMotions& m) { m.windows[1].samples.resize(1); }},
        {"different models", [](WindowMotions& m) { m.windows[1].tracks[2].model = "another"; }},
    };
    for (const auto& [words, spoil] : faults) {
        Diagnosis d;
        d.motion = sample_motion();
        spoil(*d.motion);
        write_diagnosis(d, file);
        const std::string said = refusal([&] { read_diagnosis(file); });
        EXPECT_NE(said.find("is damaged"), std::string::npos) << said;
        EXPECT_NE(said.find(words), std::string::npos) << words << ": " << said;
    }
}

TEST_F(DiagnosisFile, AnEmptyOneReadsBackEqual)
{
    const Diagnosis want;
    write_diagnosis(want, file);
    const Diagnosis got = read_diagnosis(file);
    expect_equal(want, got, "diagnosis");
    EXPECT_EQ(got.verdict, Verdict::none);
    EXPECT_FALSE(got.unexplained || got.gain || got.motion);
}

TEST_F(DiagnosisFile, EqualDiagnosesAreEqualFiles)
{
    write_diagnosis(filled_diagnosis(), file);
    write_diagnosis(filled_diagnosis(), folder / "again.h5");
    EXPECT_EQ(bytes_of(file), bytes_of(folder / "again.h5"));
}

TEST_F(DiagnosisFile, ReplacesAFileWholeAndLeavesNothingElse)
{
    write_bytes(file, "what was there before");
    write_diagnosis(filled_diagnosis(), file);
    EXPECT_EQ(read_diagnosis(file).verdict, filled_diagnosis().verdict);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(DiagnosisFile, RefusesAFolderAndAMissingOne)
{
    fs::create_directory(file);
    EXPECT_NE(refusal([&] { write_diagnosis(Diagnosis{}, file); }).find("nothing was written"), std::string::npos);
    EXPECT_NE(refusal([&] { write_diagnosis(Diagnosis{}, folder / "no" / "d.h5"); }), "");
    EXPECT_TRUE(fs::is_empty(file));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(DiagnosisFile, EveryChangedByteIsFound)
{
    write_diagnosis(filled_diagnosis(), file);
    const std::string good = bytes_of(file);
    ASSERT_GT(good.size(), 10000U);
    std::size_t tried = 0;
    for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 300, ++tried) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        write_bytes(folder / "bad.h5", bad);
        EXPECT_NE(refusal([&] { read_diagnosis(folder / "bad.h5"); }), "") << "byte " << at;
    }
    EXPECT_GT(tried, 250U);
    for (const std::size_t size : {std::size_t{0}, std::size_t{100}, std::size_t{600}, good.size() - 1}) {
        write_bytes(folder / "bad.h5", good.substr(0, size));
        EXPECT_NE(refusal([&] { read_diagnosis(folder / "bad.h5"); }), "") << size << " bytes";
    }
}

TEST_F(DiagnosisFile, AResultIsNoDiagnosisAndADiagnosisNoResult)
{
    ResultHeader header = sample_header(3);
    auto writer = ResultWriter::create(folder / "result.h5", header);
    EXPECT_NE(refusal([&] { read_diagnosis(folder / "result.h5"); }).find("contains no diagnosis"), std::string::npos);

    write_diagnosis(filled_diagnosis(), file);
    EXPECT_NE(refusal([&] { ResultReader reader(file); }), "");
    EXPECT_NE(refusal([&] { read_diagnosis(folder / "none.h5"); }), "");
}

TEST_F(DiagnosisFile, AProbabilityThatOldFilesStoreAsZeroIsNone)
{
    Diagnosis d = diagnosis_without_cause();
    d.candidates.front().probability = 0.0;
    write_diagnosis(d, folder / "old.h5");
    EXPECT_FALSE(read_diagnosis(folder / "old.h5").candidates.front().probability);
    d.candidates.front().probability = 0.4; // of a best cause that is too improbable
    write_diagnosis(d, folder / "new.h5");
    EXPECT_EQ(read_diagnosis(folder / "new.h5").candidates.front().probability, 0.4);
}

} // namespace
} // namespace stylobate
