#include "io/keys/study_tables.hpp"
#include "studies/reference/study_reference.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace stylobate {

namespace {

Json number(const TomlKey& key, const char* type)
{
    Json schema = Json::object();
    schema.member("type", type);
    schema.member(key.range.open ? "exclusiveMinimum" : "minimum", key.range.low);
    schema.member("maximum", key.range.high);
    return schema;
}

Json array_of(const Json& items)
{
    Json schema = Json::object();
    schema.member("type", "array").member("items", items);
    return schema;
}

Json any_of(const Json& one, const Json& other)
{
    Json schema = Json::object();
    schema.member("anyOf", Json::list().item(one).item(other));
    return schema;
}

Json one_of_words(const TomlKey& key)
{
    Json schema = Json::object();
    schema.member("type", "string").member("enum", Json::list(key.words));
    return schema;
}

/// The keys of `table` that a value of the key at `path` excludes, and those that it makes necessary.
struct Consequence {
    std::vector<std::string> unused, needed;
};

/// How many conditions a key has. The models that use it are one, if they are not all.
std::size_t conditions(const TomlKey& key)
{
    return key.used.size() + (key.models.size() < model_names.size());
}

bool depends_on(const TomlKey& key, const std::string& path)
{
    if (path == model_key)
        return key.models.size() < model_names.size();
    return std::any_of(key.used.begin(), key.used.end(),
                       [&](const Condition& condition) { return condition.key == path; });
}

/// A value of a key on which others depend: a word, or a whole number; of one that must only be there, any.
Json is_value(const std::string& path, const std::string& value)
{
    Json schema = Json::object();
    if (value == key_given)
        return schema;
    if (path == model_key)
        schema.member_as_is("const", value);
    else
        schema.member("const", value);
    return schema;
}

/// By key on which others depend, and by its value. @param paths of all keys on which some key depends
std::map<std::string, std::map<std::string, Consequence>>
consequences(const TomlKey& table, const std::map<std::string, std::vector<std::string>>& paths)
{
    std::map<std::string, std::map<std::string, Consequence>> all;
    for (const auto& deciding : paths)
        for (const std::string& value : deciding.second)
            for (const TomlKey* key : table.keys) {
                const std::string& path = deciding.first;
                if (!depends_on(*key, path))
                    continue;
                if (!key->used_where(path, value))
                    all[path][value].unused.push_back(key->name);
                else if (key->needed() && conditions(*key) == 1)
                    all[path][value].needed.push_back(key->name);
            }
    return all;
}

/// Keys on which some key depends, with their values.
std::map<std::string, std::vector<std::string>> deciding_keys()
{
    std::set<std::string> paths;
    for_each_key([&](const std::string&, const TomlKey& key) {
        for (const Condition& condition : key.used)
            paths.insert(condition.key);
    });
    std::map<std::string, std::vector<std::string>> all;
    for_each_key([&](const std::string& path, const TomlKey& key) {
        if (paths.contains(path))
            all[path] = key.type == KeyType::table ? std::vector<std::string>{key_given, key_absent} : key.words;
    });
    all[model_key] = {"2", "3"};
    return all;
}

Json never(const std::vector<std::string>& names)
{
    Json properties = Json::object();
    for (const std::string& name : names)
        properties.member(name, false);
    return properties;
}

/// { "properties": { NAME: INNER }, "required": [ NAME ] }
Json has_property(const std::string& name, const Json& inner)
{
    Json schema = Json::object();
    schema.member("properties", Json::object().member(name, inner));
    schema.member("required", Json::list().item(std::string_view(name)));
    return schema;
}

/// That a key of a table has this value.
Json holds(const std::string& name, const std::string& path, const std::string& value)
{
    return value == key_absent ? Json::object().member("properties", never({name}))
                               : has_property(name, is_value(path, value));
}

Json consequence_of(const Consequence& consequence)
{
    Json then = Json::object();
    if (!consequence.unused.empty())
        then.member("properties", never(consequence.unused));
    if (!consequence.needed.empty())
        then.member("required", Json::list(consequence.needed));
    return then;
}

class Schema {
public:
    Json file() const
    {
        Json schema = Json::object();
        schema.member("$schema", "http://json-schema.org/draft-07/schema#");
        schema.member("title", "Study of Stylobate");
        schema.member("description", study_file_keys().meaning);
        return table(study_file_keys(), "", std::move(schema));
    }

private:
    Json of(const TomlKey& key, const std::string& path) const
    {
        switch (key.type) {
        case KeyType::number:
        case KeyType::whole: {
            const Json schema = number(key, key.type == KeyType::number ? "number" : "integer");
            return key.words.empty() ? schema : any_of(schema, one_of_words(key));
        }
        case KeyType::boolean:
            return Json::object().member("type", "boolean");
        case KeyType::word:
            return one_of_words(key);
        case KeyType::text:
            return Json::object().member("type", "string").member("minLength", 1);
        case KeyType::numbers:
            return array_of(number(key, "number")).member("minItems", 1);
        case KeyType::interval:
            return array_of(number(key, "number")).member("minItems", 2).member("maxItems", 2);
        case KeyType::wholes:
            return array_of(number(key, "integer")).member("minItems", 1);
        case KeyType::texts:
            return array_of(Json::object().member("type", "string"));
        case KeyType::table:
            return table(key, path, Json::object());
        case KeyType::named:
            return key.keys.empty() ? Json::object().member("type", "object") : table(key, path, Json::object());
        case KeyType::tables:
            return array_of(table(key, path, Json::object()));
        case KeyType::table_or_list: {
            const Json one = table(key, path, Json::object());
            return any_of(one, array_of(one).member("minItems", 1));
        }
        }
        return Json::object();
    }

    /// @param schema to which the members of a table are added
    Json table(const TomlKey& table, const std::string& path, Json schema) const
    {
        schema.member("type", "object");
        Json properties = Json::object();
        std::vector<std::string> required;
        const TomlKey* named = nullptr; // tables of all other names
        Json others = Json::object();
        for (const TomlKey* key : table.keys) {
            const std::string inner = path.empty() ? key->name : path + "." + key->name;
            Json described = of(*key, inner);
            describe(*key, described);
            if (key->type == KeyType::named) {
                named = key;
                others = described;
                continue;
            }
            properties.member(key->name, described);
            if (key->needed() && conditions(*key) == 0)
                required.push_back(key->name);
        }
        if (path.empty())
            properties.member("claim", Json::object().member("description", "read by stylobate_claims"));
        schema.member("properties", properties);
        if (named)
            schema.member("additionalProperties", others);
        else
            schema.member("additionalProperties", false);
        if (!required.empty())
            schema.member("required", Json::list(required));
        const Json conditions = path.empty() ? of_studies() : of_own_keys(table, path);
        if (conditions.text() != Json::list().text())
            schema.member("allOf", conditions);
        return schema;
    }

    static void describe(const TomlKey& key, Json& schema)
    {
        std::string text = key.meaning;
        if (!key.keys.empty() || key.type == KeyType::boolean || key.type == KeyType::text)
            text += ".";
        else
            text += " (" + type_words(key) + ").";
        if (const std::optional<std::string> use = use_words(key))
            text += " Used where " + *use + ".";
        if (!key.needed() && !key.absent_is_value)
            text += " Default: " + *key.absent + ".";
        schema.member("description", text);
        if (key.absent_is_value) // numbers, words, booleans and lists of numbers are the same in JSON
            schema.member_as_is("default", *key.absent);
    }

    /// What a table's own kind or method excludes: `excitation.kind` in [excitation].
    Json of_own_keys(const TomlKey& table, const std::string& path) const
    {
        Json list = Json::list();
        for (const auto& [deciding, values] : consequences(table, deciding_)) {
            if (!deciding.starts_with(path + ".") || deciding.find('.', path.size() + 1) != std::string::npos)
                continue;
            const std::string name = deciding.substr(path.size() + 1);
            for (const auto& [value, consequence] : values) {
                Json condition = holds(name, deciding, value);
                const auto key = std::find_if(table.keys.begin(), table.keys.end(),
                                              [&name = name](const TomlKey* k) { return k->name == name; });
                if ((*key)->absent == toml_quoted(value) || (*key)->absent == value) // it holds without the key, too
                    condition =
                        Json::object().member("properties", Json::object().member(name, is_value(deciding, value)));
                list.item(Json::object().member("if", condition).member("then", consequence_of(consequence)));
            }
        }
        return list;
    }

    /// What the kind of the study, or the kind of another table, excludes.
    Json of_studies() const
    {
        Json list = Json::list();
        for (const TomlKey* table : study_file_keys().keys)
            for (const auto& [deciding, values] : consequences(*table, deciding_)) {
                const std::size_t dot = deciding.find('.');
                if (deciding.substr(0, dot) == table->name && table->name != "study")
                    continue; // its own
                for (const auto& [value, consequence] : values) {
                    const Json kind = holds(deciding.substr(dot + 1), deciding, value);
                    const Json then = Json::object().member(
                        "properties", Json::object().member(table->name, consequence_of(consequence)));
                    list.item(
                        Json::object().member("if", has_property(deciding.substr(0, dot), kind)).member("then", then));
                }
            }
        add_needs_of_models(list);
        // whole tables
        for (const auto& [deciding, values] : consequences(study_file_keys(), deciding_))
            for (const auto& [value, consequence] : values) {
                const std::size_t dot = deciding.find('.');
                const Json kind = has_property(deciding.substr(dot + 1), is_value(deciding, value));
                list.item(Json::object()
                              .member("if", has_property(deciding.substr(0, dot), kind))
                              .member("then", consequence_of(consequence)));
            }
        return list;
    }

    /// Adds keys that one model needs under a condition of their own table: K_N in the plane, of contacts that yield.
    static void add_needs_of_models(Json& list)
    {
        for (const TomlKey* table : study_file_keys().keys)
            for (const TomlKey* key : table->keys) {
                if (!key->needed() || key->models.size() != 1 || key->used.size() != 1 ||
                    !key->used.front().key.starts_with(table->name + "."))
                    continue;
                const Condition& condition = key->used.front();
                const std::string name = condition.key.substr(table->name.size() + 1);
                Json in_space = has_property("structure", has_property("dimensions", is_value(model_key, "3")));
                if (key->used_where(model_key, "2"))
                    in_space = Json::object().member("not", in_space);
                const Json where = Json::object().member(
                    "properties",
                    Json::object().member(name, Json::object().member("enum", Json::list(condition.values))));
                const Json needs =
                    Json::object()
                        .member("if", where)
                        .member("then",
                                Json::object().member("required", Json::list().item(std::string_view(key->name))));
                const Json then = Json::object().member("properties", Json::object().member(table->name, needs));
                list.item(Json::object().member("if", in_space).member("then", then));
            }
    }

    const std::map<std::string, std::vector<std::string>> deciding_ = deciding_keys();
};

} // namespace

std::string study_schema()
{
    return Schema().file().text() + "\n";
}

} // namespace stylobate
