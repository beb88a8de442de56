#pragma once
/// A diagnosis as a page of plain text.

#include "studies/diagnosis/findings/diagnosis.hpp"

#include <string>

namespace stylobate {

/// What is printed at the end of a diagnosis: the verdict first, then what it rests on; lines of 100 characters at most
/// but where a name is longer, the last one ended too.
std::string diagnosis_text(const Diagnosis& diagnosis);

} // namespace stylobate
