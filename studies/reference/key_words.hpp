#pragma once
/// A key of the study file in words.

#include "io/files/toml_key.hpp"

#include <string>

namespace stylobate {

/// "number in (0, 10], m", "\"smooth\" or \"abrupt\"", "list of numbers in [0, 1]", "table".
std::string type_words(const TomlKey& key);

/// "excitation.kind = \"harmonic\" or \"tapered\"; not ..."; empty: always used.
std::string use_words(const TomlKey& key);

} // namespace stylobate
