#include "io/files/toml_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// Ends of keys and what they mean; a longer one stands before those that it ends with.
constexpr std::array unit_endings = {std::pair{"_n_s2_m2", "N s2/m2"},
                                     std::pair{"_rad_s2_m", "rad s2/m"},
                                     std::pair{"_n_s_m", "N s/m"},
                                     std::pair{"_n_m_s", "N m s"},
                                     std::pair{"_kg_m3", "kg/m3"},
                                     std::pair{"_n_m3", "N/m3"},
                                     std::pair{"_n_m2", "N/m2"},
                                     std::pair{"_n_m", "N/m"},
                                     std::pair{"_m_s2", "m/s2"},
                                     std::pair{"_m_rad", "m/rad"},
                                     std::pair{"_per_m", "1/m"},
                                     std::pair{"_m_s", "m/s"},
                                     std::pair{"_rad_s", "rad/s"},
                                     std::pair{"_s_m", "s/m"},
                                     std::pair{"_m2", "m2"},
                                     std::pair{"_rad", "rad"},
                                     std::pair{"_deg", "degrees"},
                                     std::pair{"_pa", "Pa"},
                                     std::pair{"_hz", "Hz"},
                                     std::pair{"_kg", "kg"},
                                     std::pair{"_mb", "1e6 bytes"},
                                     std::pair{"_n", "N"},
                                     std::pair{"_m", "m"},
                                     std::pair{"_s", "s"}};

/// A number for people: three decimals where they are exact (1.450), else as many digits as are worth reading.
std::string readable(double value)
{
    const auto thousandths = std::round(value * 1000);
    if (std::abs(thousandths) >= 1 && std::abs(thousandths - value * 1000) < 1e-9 * std::abs(thousandths))
        return fmt::format("{:.3f}", value);
    return fmt::format("{:.6g}", value);
}

template <class List, class Text>
std::string in_brackets(const List& values, const Text& text)
{
    std::string all;
    for (const auto& value : values)
        all += (all.empty() ? "" : ", ") + text(value);
    return "[" + all + "]";
}

} // namespace

bool Range::is_next_to_zero(double value) const
{
    return open && low == 0 && value > 0 && value < least_above_zero;
}

bool Range::contains(double value) const
{
    return std::isfinite(value) && (open ? value > low : value >= low) && value <= high && !is_next_to_zero(value);
}

std::optional<std::string> Range::meant(double value) const
{
    std::string all;
    for (const UnitSlip& slip : slips)
        if (contains(value * slip.factor))
            all += fmt::format("{} {} ({} {})", all.empty() ? "Did you mean" : " or", readable(value * slip.factor),
                               fmt::format("{:.6g}", value), slip.unit);
    return all.empty() ? std::nullopt : std::optional(all + "?");
}

std::string Range::text() const
{
    const auto bound = [](double value) {
        return std::abs(value) < 1e6 ? fmt::format("{}", value) : fmt::format("{:g}", value);
    };
    return fmt::format("{}{}, {}]", open ? '(' : '[', bound(low), bound(high));
}

std::string Range::text_for(double value) const
{
    return text() + (is_next_to_zero(value) ? fmt::format(", which begins at {:g}", least_above_zero) : "");
}

std::string toml_text(double value)
{
    return toml_number(value);
}
std::string toml_text(bool value)
{
    return value ? "true" : "false";
}
std::string toml_text(std::uint64_t value)
{
    return std::to_string(value);
}
std::string toml_text(const std::string& value)
{
    return toml_quoted(value);
}
std::string toml_text(const std::vector<double>& values)
{
    return in_brackets(values, [](double value) { return toml_number(value); });
}
std::string toml_text(const std::vector<int>& values)
{
    return in_brackets(values, [](int value) { return std::to_string(value); });
}
std::string toml_text(const std::vector<std::string>& values)
{
    return in_brackets(values, [](const std::string& value) { return toml_quoted(value); });
}

TomlKey::TomlKey(std::string key, KeyType of_type, std::string means, KeyFacts facts)
    : name(std::move(key)), type(of_type), meaning(std::move(means)), words(std::move(facts.words)),
      absent(std::move(facts.absent)), used(std::move(facts.used)), example(std::move(facts.example)),
      excludes(std::move(facts.excludes)), models(std::move(facts.models))
{
}

void TomlKey::set_default(std::string toml)
{
    if (absent)
        return; // a word that stands for it
    absent = std::move(toml);
    absent_is_value = true;
}

bool TomlKey::used_where(std::string_view key, std::string_view value) const
{
    if (key == model_key) {
        const char* model = model_names[value == "3" ? 1 : 0];
        return std::find(models.begin(), models.end(), model) != models.end();
    }
    return std::all_of(used.begin(), used.end(), [&](const Condition& condition) {
        return condition.key != key ||
               std::find(condition.values.begin(), condition.values.end(), value) != condition.values.end();
    });
}

bool KeyUse::of(const TomlKey& key) const
{
    return std::find(apart.begin(), apart.end(), &key) == apart.end() &&
           std::all_of(kinds.begin(), kinds.end(),
                       [&](const auto& kind) { return key.used_where(kind.first, kind.second); });
}

KeyUse KeyUse::without(std::initializer_list<const TomlKey*> keys) const
{
    KeyUse use = *this;
    use.apart.insert(use.apart.end(), keys.begin(), keys.end());
    return use;
}

std::optional<std::string> TomlKey::unit() const
{
    if (type != KeyType::number && type != KeyType::numbers && type != KeyType::interval && type != KeyType::table)
        return std::nullopt;
    return unit_in_name(name);
}

std::optional<std::string> unit_in_name(std::string_view name)
{
    for (const auto& [ending, unit] : unit_endings)
        if (name.ends_with(ending))
            return unit;
    return std::nullopt;
}

NumberKey::NumberKey(std::string key, const Range& allowed, std::string means, KeyFacts facts)
    : TomlKey(std::move(key), KeyType::number, std::move(means), std::move(facts))
{
    range = allowed;
}

WholeKey::WholeKey(std::string key, Limits allowed, std::string means, KeyFacts facts)
    : TomlKey(std::move(key), KeyType::whole, std::move(means), std::move(facts)), low(allowed.low), high(allowed.high),
      hint(std::move(allowed.hint))
{
    range = {static_cast<double>(low), static_cast<double>(high)};
}

BooleanKey::BooleanKey(std::string key, std::string means, KeyFacts facts)
    : TomlKey(std::move(key), KeyType::boolean, std::move(means), std::move(facts))
{
}

TextKey::TextKey(std::string key, std::string means, KeyFacts facts)
    : TomlKey(std::move(key), KeyType::text, std::move(means), std::move(facts))
{
    if (!words.empty())
        type = KeyType::word;
}

ListKey::ListKey(std::string key, KeyType of_type, const Range& allowed, std::string means, KeyFacts facts)
    : TomlKey(std::move(key), of_type, std::move(means), std::move(facts))
{
    range = allowed;
}

TableKey::TableKey(std::string key, std::string means, std::vector<const TomlKey*> of_table, KeyFacts facts,
                   KeyType of_type)
    : TomlKey(std::move(key), of_type, std::move(means), std::move(facts))
{
    keys = std::move(of_table);
}

std::vector<std::string> TableKey::names() const
{
    std::vector<std::string> all;
    for (const TomlKey* key : keys)
        all.push_back(key->name);
    return all;
}

std::vector<std::string> TableKey::names_where(std::string_view key, std::string_view value) const
{
    std::vector<std::string> all;
    for (const TomlKey* each : keys)
        if (each->used_where(key, value))
            all.push_back(each->name);
    return all;
}

} // namespace stylobate
