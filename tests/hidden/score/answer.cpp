#include "tests/hidden/score/answer.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/toml_document.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace stylobate::hidden {

namespace {

const TomlValue& entry(const TomlValue& table, const char* key, TomlValue::Type type)
{
    const TomlValue* found = table.find(key);
    if (found == nullptr || found->type != type)
        throw InputError(table.place.source, found != nullptr ? found->place.line : table.place.line,
                         fmt::format("an answer needs '{}' here, as 'hidden_campaigns generate' writes it.", key));
    return *found;
}

double number(const TomlValue& table, const char* key)
{
    const TomlValue* found = table.find(key);
    if (found != nullptr && found->type == TomlValue::Type::integer)
        return found->number;
    return entry(table, key, TomlValue::Type::number).number;
}

} // namespace

std::string Answer::verdict() const
{
    if (effects.empty())
        return "none";
    for (const AnswerEffect& effect : effects)
        if (effect.listed)
            return "named";
    return "unexplained";
}

std::string text_of(const Answer& answer)
{
    std::string text =
        fmt::format("# what is hidden in campaign_{}.h5\nseed = {}\nlaw = {}\nspecimen = {}\nverdict = {}\nruns = {}\n"
                    "collapses = {}\nfriction = {}\n",
                    answer.seed, answer.seed, toml_quoted(answer.law), toml_quoted(answer.specimen),
                    toml_quoted(answer.verdict()), answer.runs, answer.collapses, toml_number(answer.friction));
    for (const AnswerEffect& effect : answer.effects)
        text += fmt::format("\n[[effect]]\nname = {}\nlisted = {}\nplace = {}\nparameter = {}\nsize = {}\n"
                            "size_comparable = {}\nsnr_noise = {}\nsnr_scatter = {}\nlaw_share = {}\ndetectable = {}\n",
                            toml_quoted(effect.name), effect.listed, toml_quoted(effect.place),
                            toml_quoted(effect.parameter), toml_number(effect.size), effect.size_comparable,
                            toml_number(effect.snr_noise), toml_number(effect.snr_scatter),
                            toml_number(effect.law_share), effect.detectable);
    return text;
}

Answer read_answer(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string(), 0, "cannot be read. Give the folder of the answers.");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    using Type = TomlValue::Type;
    const TomlValue root = parse_toml(text, file.string());
    Answer answer;
    answer.seed = static_cast<std::uint64_t>(entry(root, "seed", Type::integer).integer);
    answer.law = entry(root, "law", Type::string).text;
    answer.specimen = entry(root, "specimen", Type::string).text;
    answer.runs = static_cast<int>(entry(root, "runs", Type::integer).integer);
    answer.collapses = static_cast<int>(entry(root, "collapses", Type::integer).integer);
    answer.friction = number(root, "friction");
    if (const TomlValue* effects = root.find("effect"))
        for (const TomlValue& one : effects->entries) {
            AnswerEffect effect;
            effect.name = entry(one, "name", Type::string).text;
            effect.listed = entry(one, "listed", Type::boolean).boolean;
            effect.place = entry(one, "place", Type::string).text;
            effect.parameter = entry(one, "parameter", Type::string).text;
            effect.size = number(one, "size");
            effect.size_comparable = entry(one, "size_comparable", Type::boolean).boolean;
            effect.snr_noise = number(one, "snr_noise");
            effect.snr_scatter = number(one, "snr_scatter");
            effect.law_share = number(one, "law_share");
            effect.detectable = entry(one, "detectable", Type::boolean).boolean;
            answer.effects.push_back(effect);
        }
    return answer;
}

} // namespace stylobate::hidden
