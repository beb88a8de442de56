#pragma once
/// The keys of [mechanisms], made from the mechanisms' rules.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace stylobate {

namespace vertical_keys {

inline const TextKey file("file", &VerticalSpec::file, "record of the vertical motion; excludes `ratio`",
                          {.absent = "by `ratio`"});
inline const TextKey component("component", &VerticalSpec::component, "which one, where the file has several",
                               {.absent = "the only one"});
inline const TextKey unit("unit", &VerticalSpec::unit, "unit of its acceleration",
                          {.absent = "as in the file", .words = acceleration_units});
inline const BooleanKey baseline("baseline", &VerticalSpec::baseline, "correct the baseline of the vertical record");

} // namespace vertical_keys

/// The table of one mechanism.
struct MechanismKey : TableKey {
    explicit MechanismKey(const MechanismRule& rule);
    MechanismKey(const MechanismKey&) = delete; // `keys` points into it

    std::optional<WholeKey> place;     ///< "joint" or "block"; none for the base
    std::optional<ListKey> places;     ///< "joints" or "blocks"
    std::vector<NumberKey> parameters; ///< in the order of the rule's
};

const MechanismKey& mechanism_key(Mechanism mechanism);

/// What a parameter may be, with what it is as the hint.
Range range_of(const MechanismParameter& parameter);

/// [mechanisms]
const TableKey& mechanisms_table();

} // namespace stylobate
