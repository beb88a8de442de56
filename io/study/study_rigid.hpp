#pragma once
/// What a study with rigid contacts may not have.

#include "io/files/key_reader.hpp"

#include "ensemble/model/study.hpp"

namespace stylobate {

/// Refuses what needs a contact that yields, and what the step of the rigid form leaves out. (Keys that only other
/// forms use are refused where they are read.)
/// @param top of the file   @param study whose structure, contacts, mechanisms and outcome have been read
/// @throws InputError
void check_rigid(const KeyReader& top, const Study& study);

/// Refuses the restitution of a bed with contacts that yield.
void refuse_restitution(const KeyReader& top, const Study& study);

} // namespace stylobate
