#pragma once
/// Conditions under which a key is used, in the words of the study file.

#include "io/keys/words.hpp"

#include <algorithm>
#include <initializer_list>

namespace stylobate {

/// Where the key has one of these words.
template <class List, class Enum>
Condition where(const char* key, const List& names, std::initializer_list<Enum> values)
{
    Condition condition{key, {}};
    for (const Enum value : values)
        condition.values.emplace_back(word_for(names, value));
    return condition;
}
/// Where it has another one.
template <class List, class Enum>
Condition where_not(const char* key, const List& names, std::initializer_list<Enum> values)
{
    Condition condition{key, {}};
    for (const auto& name : names)
        if (std::find(values.begin(), values.end(), name.value) == values.end())
            condition.values.emplace_back(name.word);
    return condition;
}

inline Condition in_studies(std::initializer_list<StudyKind> kinds)
{
    return where("study.kind", study_kind_names, kinds);
}
inline Condition not_in_studies(std::initializer_list<StudyKind> kinds)
{
    return where_not("study.kind", study_kind_names, kinds);
}

inline Condition for_motions(std::initializer_list<ExcitationKind> kinds)
{
    return where("excitation.kind", excitation_kind_names, kinds);
}
inline Condition not_for_motions(std::initializer_list<ExcitationKind> kinds)
{
    return where_not("excitation.kind", excitation_kind_names, kinds);
}

inline Condition with_rigid_contacts()
{
    return where("contact.form", contact_form_names, {ContactForm::rigid});
}
/// Forms whose contacts yield: what has springs, dashpots and a step that must resolve their vibration.
inline Condition compliant()
{
    return where_not("contact.form", contact_form_names, {ContactForm::rigid});
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
