#pragma once
/// A study on the pages of `stylobate report`.

#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Summary of a study: structure, contact, excitation, perturbed quantities.
/// @param one of all its realizations the one that a page is about, its frequency, PGA and draws instead of the study's
///        axes and distributions; null: all of them
/// @param inputs names of the row's inputs
std::vector<std::pair<std::string, std::string>> study_facts(const Study& study, const ResultRow* one = nullptr,
                                                             const std::vector<std::string>& inputs = {});

} // namespace stylobate
