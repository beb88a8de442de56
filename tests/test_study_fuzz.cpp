/// Malformed studies, made from the main one with a fixed seed: each is refused with a message, or is a study whose
/// canonical text reads back to itself. Nothing else may happen.

#include "ensemble/input_error.hpp"
#include "io/study_file.hpp"

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

enum class Verdict { refused, accepted };

/// Any exception but InputError fails the test.
Verdict judge(const std::string& text, const std::vector<std::string>& settings = {})
{
    try {
        const auto study = parse_study(text, "fuzz.toml", settings);
        EXPECT_EQ(parse_study(study.text, "again.toml").text, study.text) << "from:\n" << text;
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

class Fuzz : public testing::Test {
protected:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    const std::string text_ = main_study();

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

TEST_F(Fuzz, TheStudyItselfIsAccepted)
{
    ASSERT_EQ(judge(text_), Verdict::accepted);
    ASSERT_GE(fields().size(), 30u);
}

TEST_F(Fuzz, Truncations)
{
    int refused = 0;
    for (int i = 0; i < 150; ++i)
        refused += judge(text_.substr(0, below(text_.size()))) == Verdict::refused;
    EXPECT_GT(refused, 75); // all that lack a needed section
}

TEST_F(Fuzz, FlippedBytes)
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

TEST_F(Fuzz, ReplacedInsertedAndDeletedBytes)
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

TEST_F(Fuzz, SwappedFields)
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

TEST_F(Fuzz, DeletedUnitsAreAlwaysRefused)
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

TEST_F(Fuzz, NegatedNumbersAreAlwaysRefused)
{
    int tried = 0;
    for (std::size_t at = 1; at < text_.size(); ++at) {
        const auto line = text_.rfind('\n', at) + 1;
        const bool comment = text_.find('#', line) < at;
        const bool number = text_[at] >= '0' && text_[at] <= '9' && text_[at - 1] == ' ' && text_[at - 2] == '=';
        if (comment || !number)
            continue;
        auto text = text_;
        text.insert(at, 1, '-'); // no number of this study may be negative
        EXPECT_EQ(judge(text), Verdict::refused) << text_.substr(line, text_.find('\n', line) - line);
        ++tried;
    }
    EXPECT_GE(tried, 30);
}

TEST_F(Fuzz, ExtremeNumbers)
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

TEST_F(Fuzz, Settings)
{
    const std::vector<std::string> keys = {"study.seed",     "structure.density_kg_m3", "surface.pga_m_s2",
                                           "excitation",     "perturbation.tilt",       "run.step_s",
                                           "a.b.c.d.e",      "contact.friction.x",      "excitation.file",
                                           "contact.damping"};
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

} // namespace
} // namespace stylobate
