#include "tests/program/json.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace stylobate {

namespace {

using Json = nlohmann::ordered_json;

JsonValue value_of(const Json& json)
{
    JsonValue value;
    if (json.is_boolean()) {
        value.kind = JsonValue::Kind::boolean;
        value.boolean = json.get<bool>();
    } else if (json.is_number()) {
        value.kind = JsonValue::Kind::number;
        value.number = json.get<double>();
    } else if (json.is_string()) {
        value.kind = JsonValue::Kind::text;
        value.text = json.get<std::string>();
    } else if (json.is_array()) {
        value.kind = JsonValue::Kind::list;
        for (const Json& item : json)
            value.items.push_back(value_of(item));
    } else if (json.is_object()) {
        value.kind = JsonValue::Kind::object;
        for (const auto& [name, member] : json.items())
            value.members.push_back({name, value_of(member)});
    }
    return value;
}

} // namespace

JsonValue JsonParser::parse(std::string_view text)
{
    std::vector<std::set<std::string>> keys; // of the objects that are open
    const auto no_key_twice = [&](int, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start)
            keys.emplace_back();
        else if (event == Json::parse_event_t::object_end)
            keys.pop_back();
        else if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
            throw std::runtime_error("JSON: the key " + parsed.get<std::string>() + " comes twice");
        return true;
    };
    try {
        return value_of(Json::parse(text, no_key_twice));
    } catch (const Json::exception& error) {
        throw std::runtime_error(error.what());
    }
}

} // namespace stylobate
