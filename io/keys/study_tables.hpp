#pragma once
/// Every table of a study file, with all its keys: what the reader knows, and documentation, schema and templates are
/// made from.

#include "io/files/toml_key.hpp"

#include <functional>
#include <string>

namespace stylobate {

/// The file itself: its keys are the tables.
const TableKey& study_file_keys();

/// Calls for every key with its dotted path ("surface.frequency_hz.from"), tables before what is in them.
void for_each_key(const std::function<void(const std::string& path, const TomlKey& key)>& call);

} // namespace stylobate
