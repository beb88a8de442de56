#include "io/records/record_pair.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

namespace stylobate {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_direction = 12; ///< characters of a direction in the name of a file

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool is_letter_or_digit(char c)
{
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool all_digits(std::string_view word)
{
    return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
}

std::optional<double> azimuth_of_point(char point)
{
    switch (point) {
    case 'n':
        return 0;
    case 'e':
        return 90;
    case 's':
        return 180;
    case 'w':
    case 'o': // oeste
        return 270;
    default:
        return std::nullopt;
    }
}

/// "n10w": from the first point by an angle towards the second one.
std::optional<double> azimuth_of_bearing(std::string_view word)
{
    const std::optional<double> from = azimuth_of_point(word.front()), towards = azimuth_of_point(word.back());
    const std::string_view angle = word.substr(1, word.size() - 2);
    if (!from || !towards || !all_digits(angle) || angle.size() > 2)
        return std::nullopt;
    const double sense = std::remainder(*towards - *from, 360) > 0 ? 1 : -1;
    return std::fmod(*from + sense * std::stod(std::string(angle)) + 360, 360);
}

/// Of a name without separators, in lower case.
std::optional<double> azimuth_of_word(std::string_view word)
{
    if (all_digits(word) && word.size() <= 3 && std::stoi(std::string(word)) <= 360)
        return std::stoi(std::string(word)) % 360;
    if (word.size() > 2)
        if (const std::optional<double> bearing = azimuth_of_bearing(word))
            return bearing;
    // one of several sensors: "ns2", "e1"
    if (word.size() > 1 && is_digit(word.back()) && !is_digit(word[word.size() - 2]))
        word.remove_suffix(1);
    if (is_one_of(word, {"n", "ns", "north", "northsouth"}))
        return 0;
    if (is_one_of(word, {"e", "ew", "eo", "east", "eastwest"}))
        return 90;
    if (is_one_of(word, {"s", "sn", "south", "southnorth"}))
        return 180;
    if (is_one_of(word, {"w", "we", "o", "oe", "west", "westeast"}))
        return 270;
    const bool seed_code = word.size() == 3 && direction_of_name(word) == Direction::horizontal;
    return seed_code && (word.back() == 'n' || word.back() == 'e') ? azimuth_of_point(word.back()) : std::nullopt;
}

/// A direction in the name of a file, and what stands around it.
struct NamedDirection {
    std::string before, direction, after;
};

/// Words of letters and digits that are a direction, and numbers at the end of a word that can be an azimuth.
std::vector<NamedDirection> directions_in(const std::string& name)
{
    std::vector<NamedDirection> all;
    const auto add = [&](std::size_t begin, std::size_t end) {
        all.push_back({name.substr(0, begin), name.substr(begin, end - begin), name.substr(end)});
    };
    for (std::size_t begin = 0; begin < name.size();) {
        if (!is_letter_or_digit(name[begin])) {
            ++begin;
            continue;
        }
        std::size_t end = begin;
        while (end < name.size() && is_letter_or_digit(name[end]))
            ++end;
        const std::string word = name.substr(begin, end - begin);
        const bool counts = all_digits(word) && word.size() < 3; // the "7" of "7_x.csv" is no azimuth
        if (!counts && direction_of_name(word) != Direction::unknown)
            add(begin, end);
        std::size_t digits = end;
        while (digits > begin && is_digit(name[digits - 1]))
            --digits;
        if (digits > begin && end - digits == 3 && azimuth_of_word(name.substr(digits, 3)))
            add(digits, end);
        begin = end;
    }
    return all;
}

/// "2" of "NS2": of several sensors of a station; empty of a direction without such a number (H1 and HN2 are axes).
std::string sensor_of(std::string_view direction)
{
    if (direction.size() < 2 || !is_digit(direction.back()) || is_digit(direction[direction.size() - 2]))
        return {};
    const std::string axis = lower_case(direction.substr(0, direction.size() - 1));
    return azimuth_of_word(axis) || is_one_of(axis, {"l", "t", "ud", "up", "v", "z"}) ? std::string(1, direction.back())
                                                                                      : std::string();
}

/// What a component's direction is called: by its header, else by the name of its file.
std::string direction_name(const Record& record)
{
    for (const std::string& name : {record.orientation, record.component})
        if (!name.empty() && name != "acceleration" && !name.starts_with("column ") && !name.starts_with("chan ") &&
            !name.starts_with("canal-"))
            return name;
    const std::vector<NamedDirection> named = directions_in(fs::path(record.file).filename().string());
    return named.empty() ? std::string() : named.back().direction;
}

/// "FILE, component N10W", for messages.
std::string where(const Record& record)
{
    return fmt::format("{}, component \"{}\"", record.file, record.component);
}

enum class Axes {
    unknown, ///< the names do not state them
    same,
    orthogonal,
    oblique
};

Axes axes_of(const Record& first, const Record& second)
{
    const std::string a = direction_name(first), b = direction_name(second);
    const std::optional<double> from = azimuth_of_name(a), to = azimuth_of_name(b);
    if (from && to) {
        const double apart = std::fabs(std::remainder(*to - *from, 180)); // 0 to 90
        return apart <= axes_tolerance_deg        ? Axes::same
               : 90 - apart <= axes_tolerance_deg ? Axes::orthogonal
                                                  : Axes::oblique;
    }
    return !a.empty() && lower_case(a) == lower_case(b) ? Axes::same : Axes::unknown;
}

bool one_station(const Record& a, const Record& b)
{
    return a.station.empty() || b.station.empty() || a.station == b.station;
}

/// The files beside that of a component whose names differ from its name in the direction alone.
std::vector<fs::path> files_named_like(const Record& first, Direction direction)
{
    const fs::path file = first.file;
    const std::string name = file.filename().string();
    std::vector<fs::path> found;
    std::error_code error;
    for (const auto& entry :
         fs::directory_iterator(file.has_parent_path() ? file.parent_path() : fs::path("."), error)) {
        const std::string other = entry.path().filename().string();
        if (other == name || !entry.is_regular_file(error))
            continue;
        const std::vector<NamedDirection> named = directions_in(name);
        const bool alike = std::any_of(named.begin(), named.end(), [&](const NamedDirection& part) {
            if (!other.starts_with(part.before) || !other.ends_with(part.after) ||
                other.size() <= part.before.size() + part.after.size())
                return false;
            const std::string middle =
                other.substr(part.before.size(), other.size() - part.before.size() - part.after.size());
            return middle.size() <= longest_direction && direction_of_name(middle) == direction &&
                   sensor_of(middle) == sensor_of(part.direction);
        });
        if (alike)
            found.push_back(file.has_parent_path() ? entry.path() : fs::path(other));
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// The only one of the components that can be the one asked for.
/// @param named whether the names of their files state their direction, where the files do not
Record only_one(const Record& first, const OtherComponent& other, std::vector<Record> found, bool named,
                const std::string& looked)
{
    const bool vertical = other.direction == Direction::vertical;
    std::erase_if(found, [&](const Record& record) {
        const bool fits = record.direction == other.direction || (named && record.direction == Direction::unknown);
        const Axes axes = vertical ? Axes::orthogonal : axes_of(first, record);
        return !fits || !one_station(first, record) || axes == Axes::same || axes == Axes::oblique;
    });
    if (found.size() == 1)
        return std::move(found.front());
    std::string names;
    for (const Record& record : found)
        names += (names.empty() ? ": " : "; ") + where(record);
    throw InputError(first.file, 0,
                     fmt::format("{}: {} {} component belongs to component \"{}\" {}{}.\n  Give it: {} = {{ file = "
                                 "\"...\", component = \"...\" }}.",
                                 other.key, found.empty() ? "no" : "more than one",
                                 vertical ? "vertical" : "second horizontal", first.component, looked, names,
                                 other.key));
}

/// Of a file, by its direction where there are several.
Record of_file(const Record& first, const OtherComponent& other, const std::optional<std::string>& unit)
{
    std::vector<Record> records = read_records(*other.spec.file, unit, PgaRange::any);
    return records.size() == 1 ? std::move(records.front())
                               : only_one(first, other, std::move(records), false, "in " + *other.spec.file);
}

/// By its direction, in the file of the first one or in the files named like it.
Record by_direction(const Record& first, const OtherComponent& other, const std::optional<std::string>& unit)
{
    std::vector<Record> records = read_records(first.file, unit, PgaRange::any);
    if (records.size() > 1) {
        std::erase_if(records, [&](const Record& record) { return record.component == first.component; });
        return only_one(first, other, std::move(records), false, "in its file");
    }
    records.clear();
    for (const fs::path& file : files_named_like(first, other.direction))
        for (Record& record : read_records(file, unit, PgaRange::any))
            records.push_back(std::move(record));
    return only_one(first, other, std::move(records), true,
                    "in the files beside it whose names differ from its name in the direction alone");
}

void check_direction(const Record& first, const Record& second, const OtherComponent& other)
{
    const auto refuse = [&](const std::string& what, const std::string& todo) {
        throw InputError(second.file, 0,
                         fmt::format("{}: component \"{}\" {}.\n  {}", other.key, second.component, what, todo));
    };
    const bool vertical = other.direction == Direction::vertical;
    if (vertical && second.direction == Direction::horizontal)
        refuse("is a horizontal one by its name", "Give the vertical component of the recording.");
    if (vertical)
        return;
    if (second.direction == Direction::vertical)
        refuse("is the vertical one by its name", "Give the other horizontal component of the recording.");
    if (first.direction == Direction::vertical)
        refuse(fmt::format("belongs to {}, which is vertical by its name", where(first)),
               "Give a horizontal component as excitation.component.");
    if (first.acceleration_m_s2 == second.acceleration_m_s2)
        refuse(fmt::format("has the samples of {}", where(first)), "Give the other horizontal component.");
    const Axes axes = axes_of(first, second);
    const std::string names = fmt::format("\"{}\" and \"{}\"", direction_name(first), direction_name(second));
    if (axes == Axes::same)
        refuse(fmt::format("has the axis of {}: {}", where(first), names),
               "Two files of one component are no pair: give the other horizontal component.");
    if (axes == Axes::oblique)
        refuse(fmt::format("is not orthogonal to {}: {}", where(first), names),
               "Both components of a pair are at right angles: give those, or rotate the records.");
}

void check_samples(const Record& first, const Record& second, const OtherComponent& other)
{
    const auto refuse = [&](const std::string& what, const std::string& todo) {
        throw InputError(second.file, 0,
                         fmt::format("{}: component \"{}\" {}.\n  {}", other.key, second.component, what, todo));
    };
    if (std::fabs(second.dt_s - first.dt_s) > 1e-6 * first.dt_s)
        refuse(fmt::format("has a sample every {:g} s, and the first component every {:g} s", second.dt_s, first.dt_s),
               "Give components of one recording, or resample one of them.");
    const bool horizontal = other.direction == Direction::horizontal; // a vertical one ends by itself
    if (horizontal && second.acceleration_m_s2.size() < first.acceleration_m_s2.size())
        refuse(fmt::format("has {} samples, fewer than the {} of the first component", second.acceleration_m_s2.size(),
                           first.acceleration_m_s2.size()),
               "Give the complete file, or this component as the first one.");
}

/// Turns a component that is positive 90 degrees counter-clockwise from the first one.
void turn(const Record& first, Record& second)
{
    const std::optional<double> from = azimuth_of_name(direction_name(first)),
                                to = azimuth_of_name(direction_name(second));
    if (!from || !to || std::remainder(*to - *from, 360) > 0)
        return;
    for (double& a : second.acceleration_m_s2)
        a = 0 - a;
    second.note = (second.note ? *second.note + "; " : "") +
                  "sign turned: positive 90 degrees clockwise from the first component";
}

} // namespace

std::optional<double> azimuth_of_name(std::string_view name)
{
    std::vector<std::string> words = words_of(name);
    std::erase_if(words, [](const std::string& word) { return is_one_of(word, {"deg", "degree", "degrees"}); });
    std::string joined; // "N-S", "N 10 W"
    for (const std::string& word : words)
        joined += word;
    if (joined.empty() || direction_of_name(name) != Direction::horizontal)
        return std::nullopt;
    if (const std::optional<double> azimuth = azimuth_of_word(joined))
        return azimuth;
    std::optional<double> found; // "acc_ns (g)"
    for (const std::string& word : words)
        if (!all_digits(word) && !is_one_of(word, {"g", "m", "s", "s2", "cm", "mm", "gal", "sec", "o"}))
            if (const std::optional<double> azimuth = azimuth_of_word(word))
                found = azimuth;
    return found;
}

Record other_component(const Record& first, const OtherComponent& other, PgaRange pga)
{
    const ComponentSpec& spec = other.spec;
    const std::optional<std::string> unit = spec.unit ? spec.unit : other.unit;
    std::string file = spec.file.value_or(first.file);
    std::optional<std::string> component = spec.component;
    if (!component) {
        const Record named = spec.file ? of_file(first, other, unit) : by_direction(first, other, unit);
        file = named.file;
        component = named.component;
    }
    Record found = read_record(file, component, unit, pga);
    check_direction(first, found, other);
    check_samples(first, found, other);
    if (other.direction == Direction::horizontal)
        turn(first, found);
    return found;
}

} // namespace stylobate
