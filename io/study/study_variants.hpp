#pragma once
/// [variants] and [optimise] of a study file: what `stylobate compare` is asked for beside the study itself.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// One number of a study that a search chooses.
struct SearchedKey {
    std::string key; ///< dotted
    double from = 0, to = 0;
    Spacing spacing = Spacing::linear;
    /// Its value at a place of [0, 1].
    double value(double place) const;
    /// The place of a value. @pre from <= value <= to
    double place(double value) const;
};

struct OptimiseSpec {
    std::string minimise = "collapse"; ///< name of a limit state
    std::string hazard = {};           ///< file, or a power law; empty: the probability is minimised
    std::uint64_t budget = 0;          ///< realizations
    std::vector<SearchedKey> keys;     ///< one to three, by name
};

/// Most keys that a search chooses.
inline constexpr std::size_t most_searched_keys = 3;

/// Names of the variants, in the order of their characters. Each is a part of a file's name.
/// @throws InputError if a name is none, or if a variant is no table
std::vector<std::string> variant_names(const KeyReader& top);

/// Lays a variant over the study: a key with dots, or any value but a table, replaces what is there; a table under a
/// key without dots is laid over it key by key.
/// @throws InputError if there is no such variant, with those that there are
void apply_variant(TomlValue& root, const std::string& name, const std::string& file);

/// @throws InputError for what is wrong with it; nothing if there is no [optimise]
std::optional<OptimiseSpec> read_optimise(const KeyReader& top);

} // namespace stylobate
