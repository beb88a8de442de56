#pragma once
/// A diagnosis for other programs.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/report/json.hpp"

namespace stylobate {

/// The object that `diagnose --json` prints. First, in this order: verdict, causes, indistinguishable, unexplained,
/// wrong, gain, next_test, extended_study (where it was written), simulations, seconds; all else follows. What is not
/// known is null.
Json diagnosis_json(const Diagnosis& diagnosis);

} // namespace stylobate
