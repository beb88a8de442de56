#pragma once
/// The keys of studies, and those in which studies differ.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Dotted keys and their values in full: {"contact.friction", "0.68"}. The entries of a list of tables have keys of
/// their own: "structure.drums[3].mass_kg".
using StudyKeys = std::map<std::string, std::string>;

/// @param toml canonical text of a study   @param name for messages
/// @throws InputError if it is not TOML
StudyKeys study_keys(const std::string& toml, const std::string& name);

/// A key that has not the same value in all studies.
struct DifferentKey {
    std::string key;
    std::vector<std::optional<std::string>> values; ///< (studies) nullopt: the study has no such key
};

/// The keys in which studies differ, without their titles, in the order of their names; numbers inside a key are
/// ordered by value.
/// @param studies texts of canonical studies
/// @throws InputError as `study_keys` does
std::vector<DifferentKey> different_keys(const std::vector<std::string>& studies);

} // namespace stylobate
