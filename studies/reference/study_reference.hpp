#pragma once
/// The reference page of the study file: every key with its type, unit, range, default and meaning.

#include <string>

namespace stylobate {

/// The page in Markdown, made from the descriptions in `io/keys/`; it is kept as docs/study_reference.md.
std::string study_reference();

} // namespace stylobate
