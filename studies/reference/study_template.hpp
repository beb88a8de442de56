#pragma once
/// A commented study to begin with.

#include "ensemble/model/study.hpp"

#include <optional>
#include <string>

namespace stylobate {

struct TemplateChoice {
    StudyKind study = StudyKind::surface;
    StructureKind structure = StructureKind::column;
    std::optional<ExcitationKind> excitation = {}; ///< none: the usual one of the kind (`usual_excitation`)
};

/// "harmonic", and of a fragility study "noise".
ExcitationKind usual_excitation(StudyKind study);

/// A study file of this kind: what is needed with values to begin with, and every other key that it can use as a
/// comment with its default and meaning. It runs as it stands, but for the files that it names.
/// @throws InputError if the kinds do not go together: the message names them
std::string study_template(const TemplateChoice& choice);

} // namespace stylobate
