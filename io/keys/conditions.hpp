#pragma once
/// Conditions under which a key is used, in the words of the study file.

#include "io/keys/words.hpp"

#include <algorithm>
#include <initializer_list>

namespace stylobate {

template <class List, class Enum>
Condition where(const char* key, const List& names, std::initializer_list<Enum> values)
{
    Condition condition{key, {}};
    for (const Enum value : values)
        condition.values.emplace_back(word_for(names, value));
    return condition;
}

inline Condition in_studies(std::initializer_list<StudyKind> kinds)
{
    return where("study.kind", study_kind_names, kinds);
}

/// All kinds but these.
inline Condition not_in_studies(std::initializer_list<StudyKind> kinds)
{
    Condition condition{"study.kind", {}};
    for (const Name<StudyKind>& name : study_kind_names)
        if (std::find(kinds.begin(), kinds.end(), name.value) == kinds.end())
            condition.values.emplace_back(name.word);
    return condition;
}

inline Condition with_forms(std::initializer_list<ContactForm> forms)
{
    return where("contact.form", contact_form_names, forms);
}

/// Forms whose contacts yield: what has springs, dashpots and a step that must resolve their vibration.
inline Condition compliant()
{
    return with_forms({ContactForm::area, ContactForm::two_corner, ContactForm::points});
}

inline Condition for_motions(std::initializer_list<ExcitationKind> kinds)
{
    return where("excitation.kind", excitation_kind_names, kinds);
}

inline Condition of_structures(std::initializer_list<StructureKind> kinds)
{
    return where("structure.kind", structure_kind_names, kinds);
}

/// What the kinds of a study let its keys be used for.
inline KeyUse key_use(const Study& study)
{
    KeyUse use{{{"study.kind", word_for(study_kind_names, study.kind)},
                {"structure.kind", word_for(structure_kind_names, study.structure.kind)},
                {"contact.form", word_for(contact_form_names, study.contact.form)},
                {"excitation.kind", word_for(excitation_kind_names, study.excitation.kind)}}};
    if (study.fragility)
        use.kinds.emplace("fragility.method", word_for(fragility_method_names, study.fragility->method));
    return use;
}

} // namespace stylobate
