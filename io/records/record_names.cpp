/// What the name of a column says: its quantity and its unit.
///
///   "Acceleration [g]", "acc_cm_s2", "a (m/s/s)", "Acc N-S, gal"    accelerations, with their unit
///   "Velocity [m/s]", "vel", "x [mm]", "disp_cm"                    no accelerations
///   "Time (ms)", "t", "time_s"                                      the time
///   "N-S", "090", "channel 3"                                       no quantity: what it is, the table decides

#include "io/records/record_parser.hpp"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

namespace stylobate {

namespace {

using Quantity = ColumnMeaning::Quantity;

bool begins_with(std::string_view word, std::initializer_list<std::string_view> beginnings)
{
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](std::string_view beginning) { return word.starts_with(beginning); });
}

/// The quantity of a unit; `unnamed` of what is none.
Quantity quantity_of_unit(std::string_view spelling)
{
    if (canonical_unit(spelling))
        return Quantity::acceleration;
    const std::string unit = plain_unit(spelling);
    if (is_one_of(unit, {"m/s", "cm/s", "mm/s", "km/h", "in/s", "ft/s", "ms-1", "cms-1", "mms-1", "m.s-1", "cm.s-1",
                         "kine", "kines"}))
        return Quantity::velocity;
    if (is_one_of(unit, {"m", "cm", "mm", "um", "in", "inch", "ft", "km"}))
        return Quantity::displacement;
    if (is_one_of(unit, {"s", "seconds", "second", "ms", "min", "us"}))
        return Quantity::time;
    if (is_one_of(unit,
                  {"hz", "rad", "deg", "rad/s", "\xc2\xb0\x63", "%", "%g", "mg", "gs", "g*s", "cm*s", "strain"}) ||
        is_one_of(unit, {"kn", "kpa", "mpa", "volt", "volts", "mv", "count", "counts"}) ||
        is_one_of(unit, {"ft/s2", "in/s2", "in/s/s", "ft/s/s", "m2/s3", "cm/s3", "m/s3"}))
        return Quantity::other;
    return Quantity::unnamed;
}

bool names_acceleration(std::string_view word)
{
    return begins_with(word, {"acc", "acel", "beschl", "ivme"}) || word == "ag";
}

/// "v" of "v1": the word without the number of its sensor.
std::string_view without_number(std::string_view word)
{
    while (word.size() > 1 && word.back() >= '0' && word.back() <= '9')
        word.remove_suffix(1);
    return word;
}

/// @param[out] plain whether the name is a word and not a letter
Quantity quantity_of_words(std::string_view name, bool& plain)
{
    const std::vector<std::string> words = words_of(name);
    plain = true;
    for (const std::string& word : words) {
        if (begins_with(word, {"spectr", "psa", "psv", "freq", "period", "husid", "arias", "energ", "force", "jerk",
                               "strain", "angle", "rotation"}) ||
            is_one_of(word, {"sa", "sv", "sd", "cav"}))
            return Quantity::other;
    }
    for (const std::string& word : words) {
        if (names_acceleration(word))
            return Quantity::acceleration;
        if (begins_with(word, {"vel", "vitess", "geschw", "speed", "pgv"}) || word == "hiz")
            return Quantity::velocity;
        if (begins_with(word, {"disp", "despl", "depl", "versch", "posit", "pgd"}) || word == "dis")
            return Quantity::displacement;
        if (begins_with(word, {"time", "tiempo", "temps", "zeit", "zaman"}) || is_one_of(word, {"sec", "seconds"}))
            return Quantity::time;
    }
    plain = false;
    if (words.empty())
        return Quantity::unnamed;
    // a letter, and an axis behind it or not: "a", "vx", "d_z", "u2"
    const std::string_view first = without_number(words.front());
    const bool axis_behind = first.size() == 2 && std::string_view("xyz").find(first[1]) != std::string_view::npos;
    if (first.size() != 1 && !axis_behind)
        return Quantity::unnamed;
    switch (first[0]) {
    case 'a':
        return Quantity::acceleration;
    case 'v':
        return Quantity::velocity;
    case 'd':
    case 'u':
        return Quantity::displacement;
    case 't':
        return axis_behind ? Quantity::unnamed : Quantity::time;
    default:
        return Quantity::unnamed;
    }
}

/// A unit in a name, and the name without it.
struct UnitInName {
    std::optional<std::string> unit; ///< as it is spelled; nullopt if there is none
    std::string rest;
};

UnitInName unit_in(std::string_view name)
{
    if (const Quantity quantity = quantity_of_unit(name); quantity != Quantity::unnamed && lower_case(name) != "s")
        return {std::string(name), {}}; // nothing but a unit, "cm/s"; S is south
    // in brackets
    for (std::size_t open = name.find_first_of("[("); open != std::string_view::npos;
         open = name.find_first_of("[(", open + 1)) {
        const std::size_t close = name.find(name[open] == '[' ? ']' : ')', open);
        if (close == std::string_view::npos)
            break;
        const std::string_view inside = name.substr(open + 1, close - open - 1);
        if (quantity_of_unit(inside) != Quantity::unnamed)
            return {std::string(inside), std::string(name.substr(0, open)) + " " + std::string(name.substr(close + 1))};
    }
    // behind an underscore, "acc_x_m_s2": the longest that is one
    for (std::size_t line = name.find('_'); line != std::string_view::npos && line > 0;
         line = name.find('_', line + 1)) {
        std::string unit(name.substr(line + 1));
        std::replace(unit.begin(), unit.end(), '_', '/');
        const Quantity quantity = quantity_of_unit(unit);
        bool plain = false;
        const Quantity named = quantity_of_words(name.substr(0, line), plain);
        const bool direction = unit == "s" && named != Quantity::time; // "acc_s" faces south
        const bool number = unit == "m" && named == Quantity::acceleration;
        if (quantity != Quantity::unnamed && !direction && !number)
            return {unit, std::string(name.substr(0, line))};
    }
    // behind a blank, a comma or "in", where the rest names the quantity: "Acceleration, g"
    const std::size_t gap = name.find_last_of(" ,");
    if (gap == std::string_view::npos)
        return {std::nullopt, std::string(name)};
    const std::string_view last = name.substr(gap + 1), rest = name.substr(0, gap);
    bool plain = false;
    if (quantity_of_unit(last) != Quantity::unnamed && quantity_of_words(rest, plain) != Quantity::unnamed)
        return {std::string(last), std::string(rest)};
    return {std::nullopt, std::string(name)};
}

} // namespace

const char* to_string(Quantity quantity)
{
    switch (quantity) {
    case Quantity::acceleration:
        return "an acceleration";
    case Quantity::velocity:
        return "a velocity";
    case Quantity::displacement:
        return "a displacement";
    case Quantity::time:
        return "a time";
    case Quantity::other:
        return "another quantity";
    case Quantity::unnamed:
        break;
    }
    return "not named as an acceleration";
}

ColumnMeaning meaning_of_column(std::string_view name)
{
    const UnitInName found = unit_in(name);
    ColumnMeaning meaning;
    meaning.unit = found.unit;
    meaning.of_unit = found.unit ? quantity_of_unit(*found.unit) : Quantity::unnamed;
    meaning.of_words = quantity_of_words(found.rest, meaning.plain);
    return meaning;
}

std::optional<std::string> unit_in_line(std::string_view line)
{
    const std::string lower = lower_case(line);
    for (const char* phrase : {"units of", "units are", "unit is", "units in", "units:", "units =", "unit:", "unit =",
                               "unit=", "units=", "unidades:", "unidad:", "einheit:"}) {
        const std::size_t at = lower.find(phrase);
        if (at == std::string::npos)
            continue;
        std::string_view word = trimmed(std::string_view(lower).substr(at + std::string_view(phrase).size()));
        const std::size_t first = std::min(word.find_first_not_of("([ \""), word.size());
        word = word.substr(first, word.find_first_of(" \t,;)]\"", first) - first);
        if (canonical_unit(word))
            return std::string(word);
    }
    const UnitInName found = unit_in(line);
    const std::vector<std::string> words = words_of(found.rest);
    bool plain = false; // a spectral acceleration is another quantity
    const bool named = std::any_of(words.begin(), words.end(), names_acceleration) &&
                       quantity_of_words(found.rest, plain) != Quantity::other;
    return named && found.unit && canonical_unit(*found.unit) ? found.unit : std::nullopt;
}

// Whether a component is horizontal or vertical, from the names that agencies give.
//
// Names that occur, in either case of letters and with a sign before or after them:
//   vertical     UP, DOWN, DWN, VER, VERT, VERTICAL, V, Z, UD, U-D, UP/DOWN; UD1, V2; the third letter Z of a SEED
//                code (HNZ, HGZ, BHZ); az, a_z; 400, 401 and 402 of COSMOS
//   horizontal   an azimuth (0 to 360, "90 Deg"), a compass direction (N, N-S, N10W, S00E), L, T, LONG, TRAN, RADIAL,
//                H1, H2, FN, FP; the third letter N, E, R, T, 1 or 2 of a SEED code; 500, 501, 600, 601 of COSMOS
//
// X and Y are unknown: in the plane of an experiment, Y is often the vertical.

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
