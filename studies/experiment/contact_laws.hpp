#pragma once
/// Other contact laws under which a study is run on the same draws. A collapse probability depends on a law that is
/// not known for a monument: how stiff the joints are, what an impact loses, whether they yield at all.

#include "ensemble/experiment.hpp"
#include "ensemble/model/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The study under another contact law. Structure, shaking, outcomes and draws are those of the study.
struct ContactLaw {
    std::string name;                  ///< "softer", "stiffer", "rigid", "ends" or "centroid"
    std::string words;                 ///< "a third of the normal and the tangential stiffness"
    std::optional<std::string> note{}; ///< what else it changes, a sentence; nullopt: nothing
    std::optional<Study> study{};      ///< none: the law does not apply to the study
    std::string why_not{};             ///< then the reason, without a full stop
};

/// A third and three times the stiffness, normal and tangential alike, of [contact], of each bed that has its own, and
/// of spreads that replace the nominal value; rigid contacts; and the dashpots at the other place (`contact.damping`).
///
/// Rigid contacts have no stiffness and no dashpot: their spreads are left out, and the note states this. A law does
/// not apply where the study with it is refused, or where its draws would not be those of the study.
///
/// Replicas ([twins]) and kept trajectories are left out.
std::vector<ContactLaw> contact_laws(const Study& study);

/// Estimated processor time under a law relative to the study: steps times the cost of a step of the form.
/// @throws InputError if a realization cannot be run under the law
double law_cost(const Experiment& study, const Experiment& law);

/// "rigid: does not apply: ...", a sentence for each law that does not apply.
std::vector<std::string> laws_left_out(const std::vector<ContactLaw>& laws);

/// The text of a study as results have it, without its title.
/// @param motions with the lines that identify its motions
std::string study_text_of(const std::string& result_text, bool motions);

} // namespace stylobate
