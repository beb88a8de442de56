/// Whether a component is horizontal or vertical, from the names that agencies give.
///
/// Names that occur, in either case of letters and with a sign before or after them:
///   vertical     UP, DOWN, DWN, VER, VERT, VERTICAL, V, Z, UD, U-D, UP/DOWN; UD1, V2; the third letter Z of a SEED
///                code (HNZ, HGZ, BHZ); az, a_z; 400, 401 and 402 of COSMOS
///   horizontal   an azimuth (0 to 360, "90 Deg"), a compass direction (N, N-S, N10W, S00E), L, T, LONG, TRAN, RADIAL,
///                H1, H2, FN, FP; the third letter N, E, R, T, 1 or 2 of a SEED code; 500, 501, 600, 601 of COSMOS
///
/// X and Y are unknown: in the plane of an experiment, Y is often the vertical.

#include "io/records/record_parser.hpp"

#include <algorithm>
#include <filesystem>

namespace stylobate {

namespace {

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool is_lower_letter(char c)
{
    return c >= 'a' && c <= 'z';
}

/// Words that mean the vertical wherever they stand: in a title, at the end of a file's name.
bool is_plainly_vertical(std::string_view word)
{
    return is_one_of(word, {"up", "down", "dwn", "updown", "ud", "ver", "vert", "vrt", "vertical", "verticale",
                            "vertikal", "dusey"});
}

Direction direction_of_seed_code(std::string_view code)
{
    constexpr std::string_view bands = "fgdcesbhmlvu", instruments = "hlngpm";
    if (code.size() != 3 || bands.find(code[0]) == std::string_view::npos ||
        instruments.find(code[1]) == std::string_view::npos)
        return Direction::unknown;
    if (code[2] == 'z')
        return Direction::vertical;
    return std::string_view("ner12t").find(code[2]) == std::string_view::npos ? Direction::unknown
                                                                              : Direction::horizontal;
}

/// An azimuth in degrees, or a code of COSMOS for what has none.
Direction direction_of_number(std::string_view word)
{
    if (word.empty() || word.size() > 3 || !std::all_of(word.begin(), word.end(), is_digit))
        return Direction::unknown;
    const int value = std::stoi(std::string(word));
    if (value <= 360 || value == 500 || value == 501 || value == 600 || value == 601)
        return Direction::horizontal;
    return value >= 400 && value <= 402 ? Direction::vertical : Direction::unknown;
}

/// "n", "ns", "n90e", "s00w", "eo" (Spanish: este, oeste).
bool is_compass_direction(std::string_view word)
{
    constexpr std::string_view points = "nsewo";
    if (word.empty() || points.find(word.front()) == std::string_view::npos || word == "o")
        return false;
    word.remove_prefix(1);
    while (!word.empty() && is_digit(word.front()))
        word.remove_prefix(1);
    return word.empty() || (word.size() == 1 && points.find(word.front()) != std::string_view::npos);
}

/// Of a name without separators, in lower case.
Direction direction_of_word(std::string_view word)
{
    if (const Direction direction = direction_of_number(word); direction != Direction::unknown)
        return direction;
    if (is_compass_direction(word))
        return Direction::horizontal;
    if (const Direction direction = direction_of_seed_code(word); direction != Direction::unknown)
        return direction;
    // one of several sensors: "ud2", "v2", "l1"
    const bool counted = word.size() >= 2 && is_digit(word.back()) && !is_digit(word[word.size() - 2]);
    const std::string_view name = counted ? word.substr(0, word.size() - 1) : word;
    if (is_plainly_vertical(name) || is_one_of(name, {"v", "z", "az", "accz", "dn", "du", "u"}))
        return Direction::vertical;
    if (is_compass_direction(name) ||
        is_one_of(name,
                  {"north",       "south", "east", "west", "northsouth", "eastwest",     "h",    "hor",   "horiz",
                   "horizontal",  "l",     "t",    "long", "ln",         "longitudinal", "tran", "trans", "transverse",
                   "transversal", "tr",    "r",    "rad",  "radial",     "tangential",   "fn",   "fp"}))
        return Direction::horizontal;
    return Direction::unknown;
}

/// Vertical if the name of the file ends so: "I-ELC-UP.AT2", "HECVER.AT2", "BAM-V.AT2".
bool has_vertical_name(const Record& record)
{
    const std::filesystem::path path = record.file;
    const std::string stem = path.stem().string();
    const std::vector<std::string> words = words_of(stem);
    for (const std::string& word : words_of(path.extension().string()))
        if (is_plainly_vertical(word) || is_one_of(word, {"ud1", "ud2"}))
            return true;
    if (words.size() >= 2 &&
        (is_plainly_vertical(words.back()) || direction_of_seed_code(words.back()) == Direction::vertical))
        return true;
    if (record.format != at2_parser.format || words.empty())
        return false;
    if (words.size() >= 2 && is_one_of(words.back(), {"v", "z"}))
        return true;
    // PEER puts UP, DWN and VER behind a station's code of three letters or so, in capitals
    const std::string& last = words.back();
    const bool capitals = std::none_of(stem.begin(), stem.end(), is_lower_letter);
    const std::size_t code = 3;
    return capitals && last.size() > code && is_one_of(std::string_view(last).substr(code), {"up", "dwn", "ver"});
}

/// In ASCII: "accélération" is acceleration, in UTF-8 and in Latin-1; blanks for all that is no letter of Latin-1.
std::string without_accents(std::string_view name)
{
    constexpr std::string_view latin = "aaaaaaaceeeeiiiidnooooo ouuuuyts"; // À to ß, and à to ÿ
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto byte = static_cast<unsigned char>(name[i]),
                   next = static_cast<unsigned char>(i + 1 < name.size() ? name[i + 1] : 0);
        const bool pair = byte >= 0xC2 && next >= 0x80 && next < 0xC0; // of UTF-8
        if (byte < 0xC0)
            plain += name[i];
        else if (!pair || byte == 0xC3)
            plain += latin[(pair ? next : byte) & 0x1F];
        else
            plain += byte == 0xC4 && (next | 1) == 0xB1 ? 'i' : ' '; // the two of Turkish
        i += pair;
    }
    return plain;
}

} // namespace

std::vector<std::string> words_of(std::string_view name)
{
    std::vector<std::string> words(1);
    for (const char c : lower_case(without_accents(name))) {
        if (is_lower_letter(c) || is_digit(c))
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty())
        words.pop_back();
    return words;
}

const char* to_string(Direction direction)
{
    switch (direction) {
    case Direction::horizontal:
        return "horizontal";
    case Direction::vertical:
        return "vertical";
    case Direction::unknown:
        break;
    }
    return "unknown";
}

Direction direction_of_name(std::string_view name)
{
    std::vector<std::string> words = words_of(name);
    std::erase_if(words, [](const std::string& word) { return is_one_of(word, {"deg", "degree", "degrees"}); });
    std::string joined; // "U-D", "N 10 W", "UP/DOWN"
    for (const std::string& word : words)
        joined += word;
    if (const Direction direction = direction_of_word(joined); direction != Direction::unknown)
        return direction;
    Direction found = Direction::unknown;
    for (const std::string& word : words) {
        if (is_one_of(word, {"g", "m", "s", "s2", "cm", "mm", "gal", "sec", "t"}) ||
            direction_of_number(word) != Direction::unknown)
            continue; // a unit or a number, not a direction, among other words
        if (const Direction direction = direction_of_word(word); direction == Direction::vertical)
            return direction;
        else if (direction != Direction::unknown)
            found = direction;
    }
    return found;
}

Direction direction_of(const Record& record)
{
    Direction found = record.direction;
    for (const std::string& name : {record.orientation, record.component}) {
        if (found == Direction::unknown && !name.empty() && !name.starts_with("column ") &&
            !name.starts_with("chan ") && !name.starts_with("canal-"))
            found = direction_of_name(name);
    }
    if (found == Direction::vertical || has_vertical_name(record))
        return Direction::vertical;
    if (found == Direction::unknown) {
        const std::vector<std::string> words = words_of(record.title);
        if (!words.empty() && is_plainly_vertical(words.back()))
            return Direction::vertical;
        if (std::find(words.begin(), words.end(), "vertical") != words.end())
            return Direction::vertical;
    }
    return found;
}

} // namespace stylobate
