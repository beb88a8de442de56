/// Study files. One that is accepted has a canonical text, which is read back to itself, and so has each of its
/// variants that is accepted; the numbers that a search chooses stay within their limits. Inputs are made from the
/// description of all keys (io/keys), from which docs/study_reference.md is made too.

#include "io/keys/study_tables.hpp"
#include "io/study/study_file.hpp"
#include "tests/fuzz/text_mutation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace stylobate::fuzz {
namespace {

void check_text(const Study& study)
{
    try {
        const Study again = parse_study(study.text, "again.toml");
        promise(again.text == study.text, "the canonical text of a study has another canonical text");
        promise(again.structure == study.structure, "the canonical text of a study has another structure");
        promise(again.total() == study.total() && study.total() > 0, "a study has no realizations, or others again");
    } catch (const InputError& error) {
        throw Finding(std::string("the canonical text of a study is refused: ") + error.what());
    }
}

/// What `stylobate compare` reads beside the study itself.
void check_decisions(std::string_view input)
{
    if (input.find("variants") == std::string_view::npos && input.find("optimise") == std::string_view::npos)
        return;
    const std::filesystem::path file = folder() / "study.toml";
    write_file(file, input);
    judged([&] {
        for (const std::string& name : read_variant_names(file)) {
            Study variant;
            if (judged([&] { variant = read_variant(file, name); }) == Verdict::accepted)
                check_text(variant);
        }
    });
    judged([&] {
        if (const auto search = read_optimisation(file))
            for (const SearchedKey& key : search->keys)
                for (const double place : {0.0, 0.25, 0.5, 1.0}) {
                    const double value = key.value(place);
                    promise(value >= key.from && value <= key.to, "a search leaves the limits of a key");
                    const double back = key.place(value);
                    promise(back >= 0 && back <= 1 + 1e-12, "a value of a search has no place within its limits");
                }
    });
}

Verdict judge(std::string_view input)
{
    Study study;
    const Verdict verdict = judged([&] { study = parse_study(std::string(input), "fuzz.toml"); });
    if (verdict == Verdict::accepted) {
        check_text(study);
        check_decisions(input);
    }
    return verdict;
}

std::string number_in(double low, double high, Random& random)
{
    const double part = static_cast<double>(below(random, 1001)) / 1000;
    switch (random() % 8) {
    case 0:
        return toml_number(low);
    case 1:
        return toml_number(high);
    case 2:
        return any_number(random);
    case 3:
    case 4: // of ranges over decades
        if (high > 0)
            return toml_number(std::exp(std::lerp(std::log(std::max(low, high * 1e-12)), std::log(high), part)));
        [[fallthrough]];
    default:
        return toml_number(std::lerp(low, std::min(high, low + 100), part));
    }
}

std::string whole_in(std::uint64_t low, std::uint64_t high, Random& random)
{
    switch (random() % 6) {
    case 0:
        return fmt::format("{}", high);
    case 1:
        return any_number(random);
    default:
        return fmt::format("{}", low + below(random, std::min<std::uint64_t>(high - low, 20) + 1));
    }
}

std::string value_of(const TomlKey& key, Random& random, int depth);

std::string table_of(const TomlKey& key, Random& random, int depth)
{
    std::string text;
    for (const TomlKey* each : key.keys)
        if (each->needed() ? random() % 8 != 0 : random() % 4 == 0)
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", each->name, value_of(*each, random, depth + 1));
    return "{ " + text + " }";
}

template <class Entry>
std::string list_of(Random& random, const Entry& entry)
{
    std::string text;
    for (std::size_t n = below(random, 5); n > 0; --n)
        text += (text.empty() ? "" : ", ") + entry();
    return "[" + text + "]";
}

std::string text_value(Random& random)
{
    static const std::vector<std::string> texts = {"a", "", "records/a.at2", "é \\u00e9", "\\n", "360", "g", "*.at2"};
    return "\"" + texts[below(random, texts.size())] + "\"";
}

std::string value_of(const TomlKey& key, Random& random, int depth)
{
    if (random() % 4 == 0 && (key.example || key.absent_is_value))
        return key.example ? *key.example : *key.absent;
    if (!key.words.empty() && (key.type == KeyType::word || random() % 4 == 0))
        return toml_quoted(key.words[below(random, key.words.size())]);
    const auto number = [&] { return number_in(key.range.low, key.range.high, random); };
    switch (key.type) {
    case KeyType::number:
        return number();
    case KeyType::whole: {
        const auto& whole = static_cast<const WholeKey&>(key);
        return whole_in(whole.low, whole.high, random);
    }
    case KeyType::boolean:
        return random() % 2 == 0 ? "true" : "false";
    case KeyType::numbers:
    case KeyType::interval:
        return list_of(random, number);
    case KeyType::wholes:
        return list_of(random, [&] { return whole_in(0, 1000, random); });
    case KeyType::texts:
        return list_of(random, [&] { return text_value(random); });
    case KeyType::table:
    case KeyType::named:
    case KeyType::tables:
    case KeyType::table_or_list:
        if (depth > 3)
            return "{}";
        if (key.type == KeyType::table || key.type == KeyType::named ||
            (key.type == KeyType::table_or_list && random() % 2 == 0))
            return table_of(key, random, depth);
        return list_of(random, [&] { return table_of(key, random, depth); });
    case KeyType::word:
    case KeyType::text:
        break;
    }
    return text_value(random);
}

/// KEY = VALUE for a key with its table before it, as [variants] and [optimise] name those of the study.
struct DottedKey {
    std::string name; ///< in quotes
    const TomlKey* key = nullptr;
};

DottedKey any_dotted(Random& random)
{
    const std::vector<const TomlKey*>& tables = study_file_keys().keys;
    const TomlKey& table = *tables[below(random, tables.size())];
    if (table.keys.empty())
        return {"\"contact.friction\"", nullptr};
    const TomlKey& key = *table.keys[below(random, table.keys.size())];
    return {toml_quoted(table.name + "." + key.name), &key};
}

/// A line of a table whose names are the user's: a variant, or a number that a search chooses.
std::string named_line(const TomlKey& key, Random& random)
{
    if (!key.keys.empty()) {
        const DottedKey chosen = any_dotted(random);
        const auto limit = [&] { return number_in(chosen.key->range.low, chosen.key->range.high, random); };
        return fmt::format("{} = {}\n", chosen.name,
                           chosen.key && random() % 2 == 0 ? fmt::format("{{ from = {}, to = {} }}", limit(), limit())
                                                           : table_of(key, random, 0));
    }
    std::string text;
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) {
        const DottedKey changed = any_dotted(random);
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", changed.name,
                            changed.key ? value_of(*changed.key, random, 1) : "0.4");
    }
    return fmt::format("{} = {{ {} }}\n", "abc"[below(random, 3)], text);
}

/// Gives a key of a table of the file a value: in the place of its line, or under the heading of the table, which is
/// added where it is not there.
void set_key(std::string& text, Random& random)
{
    const std::vector<const TomlKey*>& tables = study_file_keys().keys;
    const TomlKey& table = *tables[below(random, tables.size())];
    if (table.keys.empty())
        return;
    const TomlKey& key = *table.keys[below(random, table.keys.size())];
    const std::string line = key.type == KeyType::named ? named_line(key, random)
                                                        : fmt::format("{} = {}\n", key.name, value_of(key, random, 0));
    const std::string heading = fmt::format("[{}]", table.name);
    std::size_t begin = text.find("\n" + heading);
    if (begin == std::string::npos && !text.starts_with(heading)) {
        text += fmt::format("\n{}\n{}", heading, line);
        return;
    }
    begin = std::min(text.find('\n', begin == std::string::npos ? 0 : begin + 1), text.size() - 1) + 1;
    const std::size_t end = std::min(text.find("\n[", begin), text.size());
    const std::size_t old = text.find(key.name + " = ", begin);
    if (old < end && (old == begin || text[old - 1] == '\n'))
        text.erase(old, std::min(text.find('\n', old), text.size() - 1) + 1 - old);
    text.insert(begin, line);
}

std::string mutated(std::string_view input, Random& random)
{
    static const std::vector<std::string> words = [] {
        std::vector<std::string> all;
        for_each_key([&](const std::string& path, const TomlKey& key) {
            all.push_back(key.name);
            all.push_back("[" + path + "]\n");
            for (const std::string& word : key.words)
                all.push_back(toml_quoted(word));
        });
        return all;
    }();
    std::string text(input);
    if (random() % 4 == 0)
        return mutated_text(text, random, words);
    for (std::size_t keys = 1 + below(random, 3); keys > 0; --keys)
        set_key(text, random);
    return text;
}

} // namespace

const Target study_target = {"study", judge, mutated, 4096, 10000};

} // namespace stylobate::fuzz
