#pragma once
/// A study of studies/inputs, with other values.

#include "studies/experiment/loaded_study.hpp"

#include <string>
#include <vector>

namespace stylobate {

inline LoadedStudy ready(const std::string& name, const std::vector<std::string>& settings = {})
{
    return LoadedStudy::from_file(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/" + name + ".toml", settings);
}

} // namespace stylobate
