#pragma once
/// When a block counts as fallen, in words: the one statement that pages, texts and the study reference use.

#include "ensemble/model/study.hpp"

#include <string>

namespace stylobate {

/// One sentence without its full stop, "a block has fallen when ...": what `LimitStates` looks for.
std::string collapse_criterion(const OutcomeSpec& outcome);

/// How long a realization is followed: "until the first block has fallen", for example.
std::string followed_until(const OutcomeSpec& outcome);

} // namespace stylobate
