#pragma once
/// Mutations of texts by lines and words, which reach deeper than those of bytes.

#include "tests/fuzz/target.hpp"

#include <span>

namespace stylobate::fuzz {

/// A number as text: at the ends of types and ranges, or an ordinary one.
std::string any_number(Random& random);

/// One to four changes: of words for others of the text, of `words` or for numbers; of lines (removed, doubled,
/// exchanged), of single bytes, and now and then a cut.
/// @param words of the format
std::string mutated_text(std::string_view text, Random& random, std::span<const std::string> words);

/// Some bytes changed, inserted or removed: of inputs that are recipes.
std::string mutated_bytes(std::string_view bytes, Random& random);

} // namespace stylobate::fuzz
