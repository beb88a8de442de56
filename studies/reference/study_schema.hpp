#pragma once
/// A JSON Schema of the study file, by which editors complete and check TOML.

#include <string>

namespace stylobate {

/// Draft 7, made from the descriptions in `io/keys/`. It accepts every study that the reader accepts, and refuses
/// unknown keys, wrong types, values out of range, missing keys, and keys that the kinds of the study, the structure,
/// the excitation and the method do not use; relations between values are the reader's alone.
std::string study_schema();

} // namespace stylobate
