#pragma once
/// Words of messages: the nearest of the words that are allowed ("did you mean"), and numbers with their nouns.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Damerau-Levenshtein distance in its optimal-string-alignment form: insertions, deletions, substitutions and swaps of
/// neighbours, each counting one and no part edited twice. Bytes, case counts.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word` (upper case taken as lower case), the first of equals; nullopt if none is near
/// enough to be what was meant: at most one edit for every three letters of the candidate, and never fewer than one.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// A key without the unit that is part of it: "drum_width_m" -> "drum_width"; unchanged if it has none.
std::string_view without_unit(std::string_view key);

/// The known key that was meant by an unknown one: the same name with another unit or with none, else the nearest;
/// nullopt if there is none.
std::optional<std::string> meant_key(std::string_view key, const std::vector<std::string>& known);

/// A number with its noun: "1 run", "3 runs".
std::string counted(std::uint64_t n, std::string_view noun);

} // namespace stylobate
