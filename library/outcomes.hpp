#pragma once
/// From the engine's rows and tables to the plain data of the public headers.

#include "io/store/result_store.hpp"
#include "io/tables/fragility_table.hpp"
#include "studies/experiment/limit_state.hpp"
#include "stylobate/result.hpp"

#include <string>

namespace stylobate::api {

Outcome outcome_of(const stylobate::ResultRow& row);
Share share_of(const stylobate::Share& share);
Surface surface_of(const stylobate::SurfaceTable& table, const std::string& limit_state);
Fragility fragility_of(const stylobate::FragilityTable& table);

} // namespace stylobate::api
