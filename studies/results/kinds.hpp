#pragma once
/// The kinds of study: the one place where they are listed.

#include "studies/kinds/kind.hpp"

#include <memory>
#include <vector>

namespace stylobate {

/// The kind of a study, or of its results. @param study, header must outlive it
std::unique_ptr<Kind> make_kind(const Study& study, const ResultHeader& header);

/// The pictures of all kinds, each once.
std::vector<PictureKind> kind_pictures();

} // namespace stylobate
