#include "studies/measured/calibration/fit_keys.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/files/toml_document.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace stylobate {

namespace {

constexpr double friction_method_deviation = 0.01;
constexpr const char* of_calibration = "the study to be calibrated";

} // namespace

void check_range(const Study& study, const FitKey& key)
{
    if (!(std::isfinite(key.from) && std::isfinite(key.to) && key.from < key.to))
        throw InputError(fmt::format("--fit {}: the range from {} to {} is empty; give KEY=FROM:TO with FROM below TO",
                                     key.key, key.from, key.to));
    with_values(study, {key.key}, {key.from});
    with_values(study, {key.key}, {key.to});
}

double number_in(const Study& study, const std::string& key)
{
    const TomlValue root = parse_toml(study.text.empty() ? study_text(study) : study.text, of_calibration);
    const TomlValue* value = &root;
    for (std::size_t begin = 0; value != nullptr && begin <= key.size();) {
        const std::size_t end = std::min(key.find('.', begin), key.size());
        value = value->type == TomlValue::Type::table ? value->find(key.substr(begin, end - begin)) : nullptr;
        begin = end + 1;
    }
    if (value == nullptr || (value->type != TomlValue::Type::number && value->type != TomlValue::Type::integer))
        throw InputError(fmt::format("--fit {}: the study has no number of that name. Give a start value in the study "
                                     "file, or by --set {}=VALUE.",
                                     key, key));
    return value->number;
}

Study with_values(const Study& study, const std::vector<std::string>& keys, const std::vector<double>& values)
{
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < keys.size(); ++i)
        settings.push_back(keys[i] + "=" + toml_number(values[i]));
    return parse_study(study.text.empty() ? study_text(study) : study.text, of_calibration, settings);
}

std::vector<FitKey> contact_keys(const Study& study)
{
    const ContactSpec& c = study.contact;
    std::vector<FitKey> keys = {
        {"contact.normal_stiffness_n_m2", c.normal_stiffness_n_m2 / 30, c.normal_stiffness_n_m2 * 10},
        {"contact.tangential_stiffness_n_m", c.tangential_stiffness_n_m / 30, c.tangential_stiffness_n_m * 10}};
    const auto damping = [&](const std::string& ratio, const std::string& coefficient,
                             const std::optional<double>& given) {
        if (!given)
            keys.push_back({"contact." + ratio, 0.01, 0.7});
        else if (*given > 0)
            keys.push_back({"contact." + coefficient, *given / 10, *given * 10});
    };
    damping("normal_damping_ratio", "normal_damping_n_s_m", c.normal_damping_n_s_m);
    damping("tangential_damping_ratio", "tangential_damping_n_s_m", c.tangential_damping_n_s_m);
    keys.push_back({friction_key, c.friction / 3, std::min(c.friction * 1.6, 2.0), true, friction_method_deviation});
    return keys;
}

FitKey fit_key(const Study& study, const std::string& text)
{
    FitKey key;
    const std::size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
    key.key = text.substr(0, equals);
    const double start = number_in(study, key.key);
    if (equals == std::string::npos) {
        if (!(start > 0))
            throw InputError(fmt::format("--fit {}: the start value is {}, for which there is no default range; give "
                                         "--fit {}=FROM:TO",
                                         key.key, start, key.key));
        key.from = start / 5;
        key.to = start * 5;
    } else {
        const auto number = [&](const std::string& word) { // with a point, whatever the caller's locale is
            double value = 0;
            const std::size_t sign = word.starts_with('+') ? 1 : 0;
            const char* const end = word.data() + word.size();
            const auto [rest, error] = std::from_chars(word.data() + sign, end, value);
            if (error != std::errc() || rest != end)
                throw InputError(fmt::format("--fit {}: '{}' is not a number; give KEY=FROM:TO, such as "
                                             "contact.friction=0.3:0.9",
                                             text, word));
            return value;
        };
        key.from = number(text.substr(equals + 1, colon == std::string::npos ? colon : colon - equals - 1));
        key.to = colon == std::string::npos ? number("") : number(text.substr(colon + 1));
    }
    key.logarithmic = key.from > 0 && key.to / key.from > 3;
    if (key.key == friction_key)
        key.method_deviation = friction_method_deviation;
    key.asked = true;
    check_range(study, key);
    return key;
}

std::vector<FitKey> fitted_keys(const Study& study, const std::vector<std::string>& fit,
                                const std::vector<std::string>& hold)
{
    std::vector<FitKey> keys = contact_keys(study);
    for (const std::string& held : hold) {
        const auto found = std::find_if(keys.begin(), keys.end(), [&](const FitKey& k) { return k.key == held; });
        if (found == keys.end()) {
            std::string known;
            for (const FitKey& key : keys)
                known += (known.empty() ? "" : ", ") + key.key;
            throw InputError(
                fmt::format("--hold {}: it is not fitted, so it cannot be held; fitted parameters: {}", held, known));
        }
        keys.erase(found);
    }
    for (const std::string& text : fit) {
        const FitKey key = fit_key(study, text);
        const auto same = std::find_if(keys.begin(), keys.end(), [&](const FitKey& k) { return k.key == key.key; });
        if (same == keys.end())
            keys.push_back(key);
        else
            *same = key;
    }
    if (keys.empty())
        throw InputError("--hold: nothing is left to be fitted; name fewer keys");
    return keys;
}

std::vector<ContactForm> fitted_forms(const std::vector<std::string>& words)
{
    std::vector<ContactForm> forms;
    for (const std::string& word : words) {
        bool found = false;
        std::vector<std::string> known{"all"};
        for (const auto& name : contact_form_names) {
            known.emplace_back(name.word);
            if (word != name.word && word != "all")
                continue;
            found = true;
            if (std::find(forms.begin(), forms.end(), name.value) == forms.end())
                forms.push_back(name.value);
        }
        if (found)
            continue;
        const auto meant = nearest_word(word, known);
        throw InputError(fmt::format("--form {}: it is no contact form; give {}.{}", word, fmt::join(known, ", "),
                                     meant ? "\n  Did you mean " + *meant + "?" : ""));
    }
    return forms;
}

} // namespace stylobate
