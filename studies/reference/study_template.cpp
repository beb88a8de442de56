#include "studies/reference/study_reference.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/study_tables.hpp"
#include "io/keys/words.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

constexpr std::size_t comment_column = 44;
constexpr const char* to_be_given = "..."; ///< of a key that has no value to begin with

/// "key = value" and behind it what it means.
std::string line(const std::string& text, const std::string& comment)
{
    return fmt::format("{:<{}} # {}\n", text, comment_column, comment);
}

class Template {
public:
    explicit Template(const Study& kinds)
        : use_(key_use(kinds)), comes_to_rest_(kinds.kind != StudyKind::surface && kinds.kind != StudyKind::rare)
    {
    }

    std::string text() const
    {
        std::string out;
        for (const TomlKey* table : study_file_keys().keys)
            if (use_.of(*table))
                out += "\n" + section(*table);
        return out;
    }

private:
    /// A table with all its keys; as a comment if none of them is given.
    std::string section(const TomlKey& table) const
    {
        std::string keys;
        bool given = table.needed();
        for (const TomlKey* key : table.keys)
            if (use_.of(*key)) {
                const std::optional<std::string> value = value_of(*key, table.name + "." + key->name);
                given = given || value;
                keys += line_of(*key, value);
            }
        std::string about = table.meaning;
        if (!table.needed())
            about += "; without this table: " + *table.absent;
        return line((given ? "[" : "# [") + table.name + "]", about) + keys;
    }

    /// What the study gives; nullopt: it leaves the key to its default.
    std::optional<std::string> value_of(const TomlKey& key, const std::string& path) const
    {
        if (const auto kind = use_.kinds.find(path);
            kind != use_.kinds.end() && path != "fragility.method" && !path.starts_with("surface."))
            return path == model_key ? kind->second : toml_quoted(kind->second);
        // Where residual displacements are counted: dashpots at the centroid hardly damp rocking (docs/check.md).
        // In space they are spread, and do.
        if (path == "contact.damping" && comes_to_rest_ && use_.kinds.at(model_key) == "2")
            return toml_quoted(word_for(damping_at_names, DampingAt::ends));
        if (key.example)
            return *key.example;
        return key.needed() && !key.keys.empty() ? std::optional(inline_table(key)) : std::nullopt;
    }

    std::string line_of(const TomlKey& key, const std::optional<std::string>& value) const
    {
        std::string about = key.meaning;
        if (key.type == KeyType::word)
            about += ": " + type_words(key);
        else if (const auto unit = key.unit(); unit && key.keys.empty())
            about += " [" + *unit + "]";
        if (!key.needed() && !key.absent_is_value && key.keys.empty())
            about += "; default: " + *key.absent;
        if (value)
            return line(key.name + " = " + *value, about);
        if (key.absent_is_value)
            return line("# " + key.name + " = " + *key.absent, about);
        if (key.type == KeyType::named)
            return line("# " + (key.keys.empty() ? key.name + " = { \"TABLE.KEY\" = ... }"
                                                 : "\"TABLE.KEY\" = " + inline_table(key)),
                        about);
        const bool of_tables = !key.keys.empty() && !key.keys.front()->keys.empty(); // [perturbation.mechanisms]
        if (of_tables)
            return line("# " + key.name + ".NAME.KEY = { distribution = \"normal\", sd = ... }", about);
        return line("# " + key.name + " = " + (key.keys.empty() ? to_be_given : inline_table(key)), about);
    }

    /// { KEY = VALUE, ... } of those keys that are needed, have a value to begin with, or a default.
    std::string inline_table(const TomlKey& table) const
    {
        std::string entries;
        for (const TomlKey* key : table.keys) {
            if (!key->used_where(model_key, use_.kinds.at(model_key)) ||
                (!key->needed() && !key->absent_is_value && !key->example))
                continue;
            const std::string value = key->example ? *key->example : key->needed() ? to_be_given : *key->absent;
            entries += (entries.empty() ? "" : ", ") + key->name + " = " + value;
        }
        return table.type == KeyType::tables ? "[ { " + entries + " }, ... ]" : "{ " + entries + " }";
    }

    KeyUse use_;
    bool comes_to_rest_;
};

} // namespace

ExcitationKind usual_excitation(StudyKind study)
{
    return study == StudyKind::fragility ? ExcitationKind::noise : ExcitationKind::harmonic;
}

std::string study_template(const TemplateChoice& choice)
{
    const ExcitationKind kind = choice.excitation.value_or(usual_excitation(choice.study));
    const std::string study = word_for(study_kind_names, choice.study);
    const std::string motion = word_for(excitation_kind_names, kind);
    const auto refuse = [&](const char* instead) {
        throw InputError(fmt::format("a study of kind \"{}\" cannot have excitation.kind = \"{}\".\n  Give {}.", study,
                                     motion, instead));
    };
    using Motion = ExcitationKind;
    if (kind == Motion::none && choice.study != StudyKind::single)
        refuse("another --excitation, or the kind \"single\"");
    const bool many =
        kind == Motion::record || kind == Motion::noise || kind == Motion::pulse || kind == Motion::tapered;
    if (choice.study == StudyKind::fragility && !many) // the others have no random parameter, or are no ground motions
        refuse("--excitation record, noise, pulse or tapered");
    if (choice.study == StudyKind::rare && kind == Motion::noise)
        refuse("another --excitation: each synthetic earthquake draws thousands of numbers");
    if (choice.study == StudyKind::survival && choice.dimensions == 3)
        throw InputError(fmt::format("a study of kind \"{}\" cannot have structure.dimensions = 3.\n  Give another "
                                     "kind, or --dimensions 2.",
                                     study));
    Study kinds;
    kinds.kind = choice.study;
    kinds.structure.kind = choice.structure;
    kinds.structure.dimensions = choice.dimensions;
    kinds.excitation.kind = kind;
    kinds.fragility.emplace();
    return fmt::format(
               "# A study of kind \"{}\", to begin with: change the values, and remove the # of a key to give it.\n"
               "# All units are SI. Every key: stylobate schema --markdown\n"
               "#\n"
               "#   stylobate info THIS_FILE.toml       warnings, without a run\n"
               "#   stylobate run THIS_FILE.toml        the results go to THIS_FILE.h5\n",
               study) +
           Template(kinds).text();
}

} // namespace stylobate
