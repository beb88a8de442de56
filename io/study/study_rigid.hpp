#pragma once
/// What a study with rigid contacts may not have.

#include "io/files/key_reader.hpp"

#include "ensemble/model/study.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// What needs a contact that yields, or what the step of the rigid form leaves out. (Keys that only other forms use
/// are refused where they are read.)
struct RigidObstacle {
    KeyReader where; ///< the table of the key
    std::string key, what, todo;

    [[noreturn]] void refuse() const { where.refuse(key, what, todo); }
};

/// The first one of a study; none: its contacts may be rigid.
/// @param top of the file
std::optional<RigidObstacle> rigid_obstacle(const KeyReader& top, const StructureSpec& structure);

/// Refuses the restitution of a bed with contacts that yield.
/// @param top of the file
void refuse_restitution(const KeyReader& top);

} // namespace stylobate
