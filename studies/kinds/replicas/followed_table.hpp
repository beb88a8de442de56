#pragma once
/// The table /twins of a results file: pairs that were followed.

#include "ensemble/model/followed_twin.hpp"
#include "io/tables/table.hpp"

#include <vector>

namespace stylobate {

Table to_table(const std::vector<FollowedTwin>& twins);
/// Empty if there is none. @throws InputError if it is not as it was written
std::vector<FollowedTwin> followed_twins(const Table& table);

} // namespace stylobate
