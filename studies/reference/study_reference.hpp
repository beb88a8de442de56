#pragma once
/// What is written from the descriptions of the keys (`io/keys/`): the reference page of the study file, a JSON Schema
/// of it, by which editors complete and check TOML, and commented studies to begin with.

#include "ensemble/model/study.hpp"
#include "io/files/toml_key.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// "number in (0, 10], m", "\"smooth\" or \"abrupt\"", "list of numbers in [0, 1]", "table".
std::string type_words(const TomlKey& key);

/// "excitation.kind = \"harmonic\" or \"tapered\", and study.kind = \"single\""; nullopt: always used.
std::optional<std::string> use_words(const TomlKey& key);

/// Every key with its type, unit, range, default and meaning, in Markdown; it is kept as docs/study_reference.md.
std::string study_reference();

/// Draft 7. It accepts every study that the reader accepts, and refuses unknown keys, wrong types, values out of range,
/// missing keys, and keys that the kinds of the study, the structure, the excitation and the method do not use;
/// relations between values are the reader's alone.
std::string study_schema();

struct TemplateChoice {
    StudyKind study = StudyKind::surface;
    StructureKind structure = StructureKind::column;
    std::optional<ExcitationKind> excitation = {}; ///< none: the usual one of the kind (`usual_excitation`)
    int dimensions = 2;                            ///< of `StructureSpec`
};

/// "harmonic", and of a fragility study "noise".
ExcitationKind usual_excitation(StudyKind study);

/// A study file of this kind: what is needed with values to begin with, and every other key that it can use as a
/// comment with its default and meaning. It runs as it stands, but for the files that it names.
/// @throws InputError if the kinds do not go together: the message names them
std::string study_template(const TemplateChoice& choice);

} // namespace stylobate
