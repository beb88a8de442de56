#include "studies/app/warnings.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

/// What to add to a study that is meant as it stands.
std::string allow_text(const std::string& check)
{
    return fmt::format("study.allow = [\"{}\"]", check);
}

} // namespace

std::vector<std::string> warnings_of(const LoadedStudy& loaded, const std::string& file)
{
    std::vector<std::string> warnings;
    for (const Doubt& doubt : loaded.doubts()) {
        if (doubt.refused)
            throw InputError(
                fmt::format("{}: {}\n  If it is intended: {}.", file, doubt.text, allow_text(doubt.check)));
        warnings.push_back(fmt::format("{} If it is intended: {}.", doubt.text, allow_text(doubt.check)));
    }
    return warnings;
}

} // namespace stylobate
