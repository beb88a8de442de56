/// What the name of a column says: its quantity and its unit.
///
///   "Acceleration [g]", "acc_cm_s2", "a (m/s/s)", "Acc N-S, gal"    accelerations, with their unit
///   "Velocity [m/s]", "vel", "x [mm]", "disp_cm"                    no accelerations
///   "Time (ms)", "t", "time_s"                                      the time
///   "N-S", "090", "channel 3"                                       no quantity: what it is, the table decides

#include "io/records/record_parser.hpp"

#include <algorithm>
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
    if (!canonical_unit(spelling).empty())
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
    std::string unit; ///< as it is spelled; empty if there is none
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
        return {{}, std::string(name)};
    const std::string_view last = name.substr(gap + 1), rest = name.substr(0, gap);
    bool plain = false;
    if (quantity_of_unit(last) != Quantity::unnamed && quantity_of_words(rest, plain) != Quantity::unnamed)
        return {std::string(last), std::string(rest)};
    return {{}, std::string(name)};
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
    meaning.of_unit = found.unit.empty() ? Quantity::unnamed : quantity_of_unit(found.unit);
    meaning.of_words = quantity_of_words(found.rest, meaning.plain);
    return meaning;
}

std::string unit_in_line(std::string_view line)
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
        if (!canonical_unit(word).empty())
            return std::string(word);
    }
    const UnitInName found = unit_in(line);
    const std::vector<std::string> words = words_of(found.rest);
    bool plain = false; // a spectral acceleration is another quantity
    const bool named = std::any_of(words.begin(), words.end(), names_acceleration) &&
                       quantity_of_words(found.rest, plain) != Quantity::other;
    return named && !canonical_unit(found.unit).empty() ? found.unit : "";
}

} // namespace stylobate
