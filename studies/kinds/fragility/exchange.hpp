#pragma once
/// A fragility study as functions for other tools.

#include "ensemble/model/fragility_model.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Limit states that follow upon each other are one model: "peak", "residual", and of a colonnade "seat", each up to
/// the collapse. A model has the shares of the stripes as a discrete function, and the lognormal curves where all its
/// states have one and these do not cross within the study's intensities (`FragilityFunction::note` says where they
/// do).
/// @return none where no limit state has a curve or two stripes
std::vector<FragilityModel> fragility_models(const Fragility& fragility, const std::string& study);

/// Each model as ID.xml (NRML 0.5), ID.json or fragility_ID.csv: names of files and their texts.
/// @param format "nrml", "json" or "csv"   @throws InputError if a model cannot be written so
std::vector<std::pair<std::string, std::string>> model_files(const std::vector<FragilityModel>& models,
                                                             const std::string& format);

/// The motions and what they measure, a line for each.
Table motions_list(const MotionTable& motions);

} // namespace stylobate
