/// Malformed studies, made from the main one and from one of a colonnade with a fixed seed: each is refused with a
/// message, or is a study whose canonical text reads back to itself. Nothing else may happen.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace stylobate {
namespace {

std::string main_study()
{
    std::ifstream in(STYLOBATE_SOURCE_DIR "/studies/inputs/small_scale_column.toml", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The main study of another structure: what a column of equal drums has no key for.
std::string colonnade_study()
{
    const std::string structure = R"([structure]
kind = "colonnade"
depth_m = 1.0
drum_width_m = 1.0                   # where a drum says nothing else
drum_height_m = 2.0
density_kg_m3 = 2700
column_list = [
    { x_m = 1.5, blocks = 3, top_width_m = 0.8 },
    { x_m = 4.5, drums = [
        { width_m = 1.2, height_m = 0.5, count = 2 },    # a stepped foot
        { height_m = 3.0, mass_kg = 8000, friction = 0.5 }
    ] },
    { x_m = 7.5, fixed_blocks = 1, blocks = 2 },
    { x_m = 10.5, blocks = 1, drum_height_m = 3.5, capital = { width_m = 1.3, height_m = 0.5 } }
]
epistyle_height_m = 0.75
epistyle_density_kg_m3 = 2600
epistyles = [
    { first_column = 1, last_column = 2, length_m = 3.5, normal_stiffness_n_m2 = 2e8 },
    { first_column = 2, last_column = 3, length_m = 2.25, x_m = 9.0, mass_kg = 5000, height_m = 0.8 }
]

)";
    std::string text = main_study();
    const auto begin = text.find("[structure]");
    text.replace(begin, text.find("[contact]") - begin, structure);
    // what fits drums of centimetres does not fit these
    const auto perturbation = text.find("drum_width = {");
    text.replace(perturbation, text.find("density = {") - perturbation,
                 "drum_width = { distribution = \"normal\", cov = 0.01, per = \"block\" }\n");
    return text + "follow = \"collapse\"\n[initial]\ntilt_rad = 0.01\ntilt_from_block = 1\n";
}

enum class Verdict { refused, accepted };

/// Any exception but InputError fails the test.
Verdict judge(const std::string& text, const std::vector<std::string>& settings = {})
{
    try {
        const auto study = parse_study(text, "fuzz.toml", settings);
        const auto again = parse_study(study.text, "again.toml");
        EXPECT_EQ(again.text, study.text) << "from:\n" << text;
        EXPECT_TRUE(again.structure == study.structure) << "from:\n" << text;
        return Verdict::accepted;
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.find("fuzz.toml") == 0 || message.find("--set") == 0) << message << "\nfrom:\n" << text;
        EXPECT_GT(message.size(), 20u);
        for (const char c : message)
            EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << "control character in: " << message;
        return Verdict::refused;
    }
}

class Fuzz : public testing::TestWithParam<std::string (*)()> {
protected:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    const std::string text_ = GetParam()();

    /// The keys and values of the study's plain lines: where they begin and end.
    struct Field {
        std::size_t key, key_end, value, value_end;
    };
    std::vector<Field> fields() const
    {
        std::vector<Field> all;
        for (std::size_t begin = 0; begin < text_.size(); begin = text_.find('\n', begin) + 1) {
            const std::size_t end = std::min(text_.find('\n', begin), text_.find('#', begin));
            const std::size_t equals = text_.find(" = ", begin);
            if (equals < end)
                all.push_back({begin, equals, equals + 3, text_.find_last_not_of(' ', end - 1) + 1});
        }
        return all;
    }

private:
    std::mt19937_64 random_{20240917};
};

TEST_P(Fuzz, TheStudyItselfIsAccepted)
{
    ASSERT_EQ(judge(text_), Verdict::accepted);
    ASSERT_GE(fields().size(), 30u);
}

TEST_P(Fuzz, Truncations)
{
    int refused = 0;
    for (int i = 0; i < 150; ++i)
        refused += judge(text_.substr(0, below(text_.size()))) == Verdict::refused;
    EXPECT_GT(refused, 75); // all that lack a needed section
}

TEST_P(Fuzz, FlippedBytes)
{
    int refused = 0, accepted = 0;
    for (int i = 0; i < 400; ++i) {
        auto text = text_;
        for (std::size_t n = 1 + below(3); n > 0; --n)
            text[below(text.size())] ^= static_cast<char>(1u << below(8));
        (judge(text) == Verdict::refused ? refused : accepted)++;
    }
    EXPECT_GT(refused, 100); // in keys, numbers and strings
    EXPECT_GT(accepted, 10); // in comments and digits
}

TEST_P(Fuzz, ReplacedInsertedAndDeletedBytes)
{
    const std::string bytes = "\"'{}[]=.,#\n\r\t -+e_0 9azZ\\\x01\x7f\xc3\xff";
    for (int i = 0; i < 400; ++i) {
        auto text = text_;
        const auto at = below(text.size());
        switch (below(3)) {
        case 0:
            text[at] = bytes[below(bytes.size())];
            break;
        case 1:
            text.insert(at, 1, bytes[below(bytes.size())]);
            break;
        default:
            text.erase(at, 1 + below(40));
        }
        judge(text);
    }
    judge(text_ + std::string("\0\0\0", 3));
}

TEST_P(Fuzz, SwappedFields)
{
    const auto all = fields();
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        auto a = all[below(all.size())], b = all[below(all.size())];
        if (a.value == b.value)
            continue;
        if (a.value > b.value)
            std::swap(a, b);
        const auto value_a = text_.substr(a.value, a.value_end - a.value);
        const auto value_b = text_.substr(b.value, b.value_end - b.value);
        auto text = text_;
        text.replace(b.value, b.value_end - b.value, value_a).replace(a.value, a.value_end - a.value, value_b);
        refused += judge(text) == Verdict::refused;
    }
    EXPECT_GT(refused, 100);
}

TEST_P(Fuzz, DeletedUnitsAreAlwaysRefused)
{
    int tried = 0;
    for (const auto& field : fields()) {
        const auto key = text_.substr(field.key, field.key_end - field.key);
        for (const std::string unit : {"_m", "_kg", "_n_m2", "_n_m", "_hz", "_m_s2"}) {
            if (key.size() <= unit.size() || key.substr(key.size() - unit.size()) != unit)
                continue;
            auto text = text_;
            text.erase(field.key_end - unit.size(), unit.size());
            EXPECT_EQ(judge(text), Verdict::refused) << key;
            ++tried;
        }
    }
    EXPECT_GE(tried, 7);
}

TEST_P(Fuzz, NegatedNumbersAreAlwaysRefused)
{
    int tried = 0;
    for (std::size_t at = 1; at < text_.size(); ++at) {
        const auto line = text_.rfind('\n', at) + 1;
        const bool comment = text_.find('#', line) < at;
        const bool number = text_[at] >= '0' && text_[at] <= '9' && text_[at - 1] == ' ' && text_[at - 2] == '=';
        if (comment || !number)
            continue;
        auto text = text_;
        text.insert(at, 1, '-');
        // no number of these studies may be negative, but a lean and the place of a column that stands alone
        if (text_.compare(line, 8, "tilt_rad") != 0 && text_.compare(at - 6, 9, "x_m = 1.5") != 0) {
            EXPECT_EQ(judge(text), Verdict::refused) << text_.substr(line, text_.find('\n', line) - line);
        }
        ++tried;
    }
    EXPECT_GE(tried, 30);
}

TEST_P(Fuzz, ExtremeNumbers)
{
    const std::vector<std::string> numbers = {"0",     "-0.0",  "1e-320", "1e-300", "1e308", "9223372036854775807",
                                              "1e400", "inf",   "-inf",   "nan",    "-1",    "1e9",
                                              "30000", "1e-12", "true",   "\"\"",   "[]",    "{}"};
    for (std::size_t at = 1; at < text_.size(); ++at) {
        const bool number = text_[at] >= '0' && text_[at] <= '9' && text_[at - 1] == ' ' && text_[at - 2] == '=';
        if (!number)
            continue;
        const auto end = text_.find_first_of(" ,\n", at);
        for (const auto& extreme : numbers)
            judge(std::string(text_).replace(at, end - at, extreme));
    }
}

TEST_P(Fuzz, Settings)
{
    const std::vector<std::string> keys = {"study.seed",         "structure.density_kg_m3", "surface.pga_m_s2",
                                           "excitation",         "perturbation.tilt",       "run.step_s",
                                           "a.b.c.d.e",          "contact.friction.x",      "excitation.file",
                                           "contact.damping",    "structure.drums",         "structure.column_list",
                                           "structure.epistyles"};
    const std::string bytes = "01.e-{}[]\"'=, ab_#\\\xc3\xa9\xff\n";
    for (int i = 0; i < 400; ++i) {
        std::string value;
        for (std::size_t n = below(8); n > 0; --n)
            value += bytes[below(bytes.size())];
        auto setting = keys[below(keys.size())] + "=" + value;
        if (below(8) == 0)
            setting.erase(below(setting.size()), 1);
        judge(text_, {setting});
    }
}

INSTANTIATE_TEST_SUITE_P(Column, Fuzz, testing::Values(&main_study));
INSTANTIATE_TEST_SUITE_P(Colonnade, Fuzz, testing::Values(&colonnade_study));

} // namespace
} // namespace stylobate
