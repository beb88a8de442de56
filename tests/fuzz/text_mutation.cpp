#include "tests/fuzz/text_mutation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace stylobate::fuzz {
namespace {

/// Where a piece of a text begins and ends.
struct Piece {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
};

bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '-' || c == '+';
}

std::vector<Piece> words_of(std::string_view text)
{
    std::vector<Piece> words;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!is_word(text[at]))
            continue;
        const std::size_t begin = at;
        while (at < text.size() && is_word(text[at]))
            ++at;
        words.push_back({begin, at});
    }
    return words;
}

/// With their line breaks.
std::vector<Piece> lines_of(std::string_view text)
{
    std::vector<Piece> lines;
    for (std::size_t begin = 0; begin < text.size(); begin = lines.back().end)
        lines.push_back({begin, std::min(text.find('\n', begin), text.size() - 1) + 1});
    return lines;
}

template <class List>
const auto& any_of(const List& list, Random& random)
{
    return list[below(random, list.size())];
}

void change_word(std::string& text, Random& random, std::span<const std::string> words)
{
    const std::vector<Piece> pieces = words_of(text);
    if (pieces.empty())
        return;
    const Piece at = any_of(pieces, random);
    const Piece other = any_of(pieces, random);
    switch (words.empty() ? random() % 3 : random() % 4) {
    case 0:
        text.replace(at.begin, at.size(), any_number(random));
        break;
    case 1:
        text.replace(at.begin, at.size(), std::string(text, other.begin, other.size()));
        break;
    case 2: {
        const std::size_t digit = text.find_first_of("0123456789", at.begin);
        if (digit < at.end)
            text[digit] = "0123456789-.eE+"[random() % 15];
        break;
    }
    default:
        text.replace(at.begin, at.size(), any_of(words, random));
    }
}

void change_line(std::string& text, Random& random)
{
    const std::vector<Piece> lines = lines_of(text);
    if (lines.empty())
        return;
    const Piece at = any_of(lines, random), to = any_of(lines, random);
    const std::string line(text, at.begin, at.size());
    switch (random() % 3) {
    case 0:
        text.erase(at.begin, at.size());
        break;
    case 1:
        text.insert(to.begin, line);
        break;
    default:
        if (to.begin < at.begin)
            text.erase(at.begin, at.size()).insert(to.begin, line);
    }
}

} // namespace

std::string any_number(Random& random)
{
    static const std::vector<std::string> ends = {
        "0",    "-0.0", "-1",    "1",     "2",     "0.5",  "1e-320", "5e-324",     "1e-300",     "1e300",
        "1e19", "1e9",  "1e400", "inf",   "-inf",  "nan",  "255",    "65536",      "2147483647", "-2147483648",
        "1e-9", "1e6",  "0x10",  "1_000", "1e+06", "+0.1", "12.5",   "4294967296", "1000000",    "9223372036854775807",
    };
    switch (random() % 4) {
    case 0:
        return fmt::format("{}", below(random, 40));
    case 1:
        return fmt::format("{:.4g}", std::exp(static_cast<double>(below(random, 4000)) / 100.0 - 20));
    default:
        return any_of(ends, random);
    }
}

std::string mutated_text(std::string_view input, Random& random, std::span<const std::string> words)
{
    std::string text(input);
    for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) {
        const std::size_t at = below(random, text.size() + 1);
        switch (random() % 16) {
        case 0:
            text.insert(at, 1, "\"'{}[]=.,#\n\r\t -+_\\<>/@;:\x01\xc3\xff"[random() % 27]);
            break;
        case 1:
            text.erase(at, 1 + below(random, 20));
            break;
        case 2:
            if (at < text.size())
                text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
            break;
        case 3:
            if (!words.empty())
                text.insert(at, any_of(words, random));
            break;
        case 4:
            if (random() % 8 == 0)
                text.resize(at);
            break;
        case 5:
        case 6:
        case 7:
            change_line(text, random);
            break;
        default:
            change_word(text, random, words);
        }
    }
    return text;
}

std::string mutated_bytes(std::string_view input, Random& random)
{
    std::string bytes(input);
    for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) {
        const std::size_t at = below(random, bytes.size() + 1);
        switch (random() % 4) {
        case 0:
            bytes.insert(at, 1, static_cast<char>(random()));
            break;
        case 1:
            bytes.erase(at, 1 + below(random, 3));
            break;
        default:
            if (at < bytes.size())
                bytes[at] = static_cast<char>(random());
        }
    }
    return bytes;
}

} // namespace stylobate::fuzz
