#include "studies/evidence/claims/claim.hpp"

#include <algorithm>

namespace stylobate::claims {

namespace {

std::string axis_of(const std::string& word)
{
    return word.substr(0, word.find('='));
}

} // namespace

bool picked(const std::vector<VariantAxis>& axes, const Levels& levels, const std::vector<std::string>& only)
{
    return std::all_of(only.begin(), only.end(), [&](const std::string& word) {
        const std::string name = axis_of(word);
        for (std::size_t i = 0; i < axes.size(); ++i)
            if (axes[i].name == name)
                return std::find(only.begin(), only.end(), name + '=' + axes[i].levels[levels[i]].name) != only.end();
        return false;
    });
}

std::vector<Levels> variants(const std::vector<VariantAxis>& axes)
{
    std::vector<Levels> all;
    Levels levels(axes.size(), 0);
    for (bool more = true; more;) {
        bool allowed = true;
        for (std::size_t i = 0; i < axes.size(); ++i)
            allowed = allowed && picked(axes, levels, axes[i].levels[levels[i]].only);
        if (allowed)
            all.push_back(levels);
        more = false;
        for (std::size_t i = axes.size(); i-- > 0 && !more;) {
            more = ++levels[i] < axes[i].levels.size();
            if (!more)
                levels[i] = 0;
        }
    }
    return all;
}

std::vector<std::string> settings_of(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::vector<std::string> settings;
    const auto add = [&](const std::vector<std::string>& more) {
        settings.insert(settings.end(), more.begin(), more.end());
    };
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Level& level = axes[i].levels[levels[i]];
        add(level.set);
        for (const Together& also : level.also)
            if (picked(axes, levels, also.only))
                add(also.set);
    }
    return settings;
}

std::string law_of(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (const Level& level = axes[i].levels[levels[i]]; !level.law.empty())
            return level.law;
    return {};
}

std::string variant_text(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (axes[i].levels.size() > 1)
            text += (text.empty() ? "" : ", ") + axes[i].label + ' ' + axes[i].levels[levels[i]].name;
    return text;
}

std::string variant_key(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i)
        text += (text.empty() ? "" : " ") + axes[i].name + '=' + axes[i].levels[levels[i]].name;
    return text;
}

} // namespace stylobate::claims
