#include "studies/reference/study_reference.hpp"

#include "io/keys/spread_key.hpp"
#include "io/keys/study_tables.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace stylobate {

namespace {

/// "a", "b" or "c"
std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + toml_quoted(words[i]);
    return text;
}

/// Of whole numbers, digit by digit.
std::string whole_range(const Range& range)
{
    constexpr double largest = 9e18; // the largest of a signed integer is no double
    return fmt::format("[{:.0f}, {}]", range.low,
                       range.high > largest ? "2^63 - 1" : fmt::format("{:.0f}", range.high));
}

/// A vertical bar would end the cell of a table.
std::string cell(std::string text)
{
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, "\\");
    return text;
}

std::string default_words(const TomlKey& key)
{
    if (key.needed())
        return "**needed**";
    return key.absent_is_value ? "`" + *key.absent + "`" : cell(*key.absent);
}

class Page {
public:
    std::string text() const { return out_; }

    void paragraph(const std::string& text) { out_ += text + "\n\n"; }

    /// A heading, what the table is, and its keys; then the tables in it.
    void table(const TomlKey& table, const std::string& path, int depth)
    {
        printed_[&table] = path;
        out_ += fmt::format("{} `[{}]`\n\n", std::string(static_cast<std::size_t>(depth), '#'), path);
        std::string about = table.meaning;
        about[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(about[0])));
        about += ".";
        if (const std::optional<std::string> use = use_words(table))
            about += fmt::format(" Used where {}.", *use);
        if (!table.needed() && table.type != KeyType::tables)
            about += fmt::format(" If the table is absent: {}.", *table.absent);
        paragraph(about);
        keys(table, path);
        for (const TomlKey* key : table.keys)
            if (!key->keys.empty() && !printed_.contains(key))
                this->table(*key, path + "." + key->name, depth + 1);
    }

    void keys(const TomlKey& table, const std::string& path)
    {
        out_ += markdown_head("key | type and range | default | meaning");
        for (const TomlKey* key : table.keys) {
            std::string meaning = key->meaning;
            if (const std::optional<std::string> use = use_words(*key))
                meaning += fmt::format("; used where {}", *use);
            if (const auto seen = printed_.find(key); seen != printed_.end())
                meaning += fmt::format(" (keys: see `[{}]`)", seen->second);
            else if (!key->keys.empty())
                meaning += fmt::format(" (keys: see `[{}.{}]` below)", path, key->name);
            out_ += markdown_row("`{}` | {} | {} | {}", key->name, cell(type_words(*key)), default_words(*key),
                                 cell(meaning));
        }
        out_ += "\n";
    }

    /// The keys of a distribution once, for all quantities.
    void perturbation()
    {
        const TableKey& table = perturbation_table();
        out_ += fmt::format("## `[{}]`\n\n", table.name);
        paragraph("What differs from one realization to the next: `QUANTITY = { distribution = ..., ... }`. A quantity "
                  "that is not named keeps its nominal value. Each quantity has these keys:");
        out_ += markdown_head("key | type and range | default | meaning");
        const SpreadKey& any = spread_key(Quantity::friction);
        for (const TomlKey* key : any.keys) {
            const bool of_value = key == &any.from || key == &any.to || key == &any.min || key == &any.max;
            const bool varies = of_value || key == &any.sd;
            const std::string type = of_value ? "number in the range of the quantity"
                                     : key == &any.sd
                                         ? "number above 0, no larger than the smallest nominal value; its "
                                           "unit is part of the key"
                                     : key == &any.per ? "\"joint\", \"block\" or \"structure\"; see the quantity"
                                                       : type_words(*key);
            out_ += markdown_row("`{}` | {} | {} | {}", key->name, type,
                                 key == &any.per ? "the first one of the quantity" : default_words(*key),
                                 key->meaning + (varies && key != &any.sd ? ", in the unit of the quantity" : ""));
        }
        out_ += "\n";
        paragraph("The quantities. Those without `cov` can have either sign: their distributions are normal and "
                  "uniform.");
        out_ += markdown_head("quantity | keys of the deviation | range | per | meaning");
        for (int i = 0; i < perturbable_count; ++i)
            quantity(spread_key(static_cast<Quantity>(i)), "");
        out_ += "\n";
        paragraph("### `[perturbation.mechanisms]`\n\nA parameter of a mechanism that `[mechanisms]` names: "
                  "`MECHANISM.PARAMETER = { distribution = ..., ... }`, with the same keys.");
        out_ += markdown_head("parameter | keys of the deviation | range | per | meaning");
        for (const MechanismRule& rule : mechanism_rules())
            for (std::size_t i = 0; i < rule.parameters.size(); ++i)
                quantity(spread_key(rule.mechanism, i), std::string(rule.name) + ".");
        out_ += "\n";
    }

private:
    void quantity(const SpreadKey& key, const std::string& above)
    {
        const std::optional<std::string> use = use_words(key);
        std::string per;
        for (const std::string& word : key.per.words)
            per += (per.empty() ? "" : ", ") + word;
        out_ += markdown_row("`{}{}` | `{}`{} | {} | {} | {}", above, key.name, key.sd.name,
                             key.relative ? ", `cov`, `sigma_ln`" : "", key.value.text(), per,
                             use ? key.meaning + "; used where " + *use : key.meaning);
    }

    std::string out_;
    std::map<const TomlKey*, std::string> printed_; ///< the tables that have been described, and where
};

} // namespace

std::string type_words(const TomlKey& key)
{
    const auto unit = key.unit();
    const std::string in_unit = unit ? ", " + *unit : "";
    const std::string or_word = key.words.empty() ? "" : "; or " + listed(key.words);
    switch (key.type) {
    case KeyType::number:
        return "number in " + key.range.text() + in_unit + or_word;
    case KeyType::whole:
        return "whole number in " + whole_range(key.range) + or_word;
    case KeyType::boolean:
        return "true or false";
    case KeyType::word:
        return listed(key.words);
    case KeyType::text:
        return "string";
    case KeyType::numbers:
        return "list of numbers in " + key.range.text() + in_unit;
    case KeyType::interval:
        return "[low, high] in " + key.range.text() + in_unit;
    case KeyType::wholes:
        return "list of whole numbers in " + whole_range(key.range);
    case KeyType::texts:
        return "list of strings";
    case KeyType::table:
        return "table" + in_unit;
    case KeyType::tables:
        return "list of tables";
    case KeyType::table_or_list:
        return "table, or list of tables";
    case KeyType::named:
        return "table under a name of your choice";
    }
    return {};
}

std::optional<std::string> use_words(const TomlKey& key)
{
    std::optional<std::string> text;
    for (const Condition& condition : key.used)
        text = (text ? *text + ", and " : "") + condition.key +
               (condition.values == std::vector<std::string>{key_absent} ? " is absent"
                                                                         : " = " + listed(condition.values));
    if (key.models != KeyFacts().models)
        text = (text ? *text + ", and " : "") +
               fmt::format("{} = {}", model_key, key.models.front() == model_names.front() ? 2 : 3);
    return text;
}

std::string study_reference()
{
    Page page;
    page.paragraph(
        "# Study file: every key\n\n"
        "This page is written by `stylobate schema --markdown`, from the same descriptions that the reader "
        "of study files uses; a test compares it with the program. [Studies ready to run]"
        "(../studies/inputs/README.md) explain the tables with examples. `stylobate new KIND` writes a study "
        "with all of these keys, and `stylobate schema` a JSON Schema for editors.");
    page.paragraph(
        "A study file is TOML. All units are SI, and the unit is part of the key. A key that is absent has its "
        "default; one that is **needed** must be given where it is used. A key that is unknown, or that the "
        "study does not use, is refused with a hint. Some ranges are narrower in a study than here: a block "
        "number cannot exceed the number of blocks. Ranges are given as (low, high] without the lower end, "
        "or [low, high] with it; (0, high] begins at 1e-30.");
    for (const TomlKey* table : study_file_keys().keys)
        if (table == &perturbation_table())
            page.perturbation();
        else
            page.table(*table, table->name, 2);
    std::string text = page.text();
    while (text.ends_with("\n\n"))
        text.pop_back();
    return text;
}

} // namespace stylobate
