#pragma once
/// An axis of a study file: { from, to, count, spacing }.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// @param table which has the axis under `key`
/// @param more  keys that it may have besides, read elsewhere
/// @throws InputError naming the key
Axis read_axis(const KeyReader& table, std::string_view key, const Range& range,
               const std::vector<std::string>& more = {});

} // namespace stylobate
