#pragma once
/// The [mechanisms] section of a study file, read and written by the one table of `ensemble/model/mechanism_spec.hpp`.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Reads the section into `study.mechanisms` and `study.vertical`: each mechanism a table, or an array of tables where
/// it acts at several places with different values. Places with the same values become one entry.
/// @param study with its structure, contact and excitation filled in
/// @throws InputError for a name, key or number that is not allowed, a place that the structure has not or that is
///         given twice, a mechanism that the excitation has no use for, and values that do not fit into the blocks
void read_mechanisms(const KeyReader& section, Study& study);

/// The entries of the section: key and value, in TOML.
std::vector<std::pair<std::string, std::string>> mechanism_entries(const Study& study);

} // namespace stylobate
