#pragma once

#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"
#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/diagnosis/direct/friction_judgement.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/window_evidence.hpp"

#include <optional>
#include <string>
#include <vector>

/// Findings of the stages of a diagnosis as tables, figures and sentences.
namespace stylobate {

/// A cause as a row of the table of candidates.
/// @param chance_known whether campaigns with nothing hidden were simulated
Candidate candidate_of(const JudgedCause& j, const Campaign& campaign, Decision decision, bool chance_known,
                       const Decided& decided);

/// Gains of the candidates beside what chance gives; those that are named among them, however they were found.
DiagnosisFigure candidates_figure(const std::vector<Candidate>& candidates);

/// A number that carries a named cause, against healthy campaigns and ones with that cause.
DiagnosisFigure carrying_figure(const CarryingNumber& number, const Candidate& named);

/// The score of a cause that the balance of forces names.
/// @param scouts first campaigns, which are not of laws like the measured one
CarryingNumber carrying_score(const EnsembleDiagnosis& ensemble, std::uint64_t scouts, const Cause& cause);

/// Mechanisms that these data would hardly show, and how often, for the list of what could not be judged.
/// @param decided what is named or in the set is left out
std::vector<Missing> hardly_shown(const EnsembleDiagnosis& ensemble, const Decided& decided);

/// The friction as the balance of forces judges it, for the table of the baseline.
CalibratedParameter baseline_friction(const FrictionJudgement& judged, const Study& start);

/// Friction of the sliding joints, sample by sample; nothing where none slides.
/// @pre balance.fit
std::optional<DiagnosisFigure> friction_figure(const BalanceEvidence& balance, const Campaign& campaign);

/// Where the joints turn that rock, sample by sample; nothing where fewer than 5 windows show it.
/// @pre balance.fit
std::optional<DiagnosisFigure> turning_figure(const BalanceEvidence& balance);

/// Adds what could not be judged. Things with one reason are reported in one sentence.
void add_missing(Diagnosis& d, const std::string& what, const std::string& why);

/// What the reader of the campaign noticed; what it noticed in several runs is one sentence.
std::vector<std::string> finding_texts(const std::vector<Finding>& findings);

/// The verdict with its causes, in one or two sentences.
std::string verdict_text(const Diagnosis& d);

} // namespace stylobate
