#pragma once
/// An axis of a study file: { from, to, count, spacing }.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"
#include "io/keys/axis_key.hpp"

namespace stylobate {

/// @param table which has the axis
/// @param range of its values, if this study allows others than the key
/// @throws InputError naming the key
Axis read_axis(const KeyReader& table, const AxisKey& key, const Range& range);
inline Axis read_axis(const KeyReader& table, const AxisKey& key)
{
    return read_axis(table, key, key.from.range);
}

} // namespace stylobate
