#pragma once
/// What `run.accuracy` chooses of the numerics where a study gives nothing, while the study is read. Each choice is
/// noted in `Study::chosen` with its reason; where no choice is known to reach the accuracy, the study is refused.
///
/// The figures are measured: `docs/rigid_limit.md` (rigid contacts and their steps) and `docs/work_precision.md` (the
/// others), both with `bench/accuracy_studies.cpp`.

#include "io/files/key_reader.hpp"

#include "ensemble/model/study.hpp"

namespace stylobate {

/// The weight on a bed over K_N B, as a part of the smaller side of the block above. Between this and a tenth of it,
/// that is ten times the stiffness, collapse probabilities of eleven studies with contacts at two corners differ by
/// less than 0.1.
inline constexpr double two_corner_sinkage = 1e-5;

/// The largest such part of a study's beds.
double largest_sinkage_part(const Study& study);

/// What is chosen of the contacts before they are read.
struct ChosenContact {
    std::optional<ContactForm> form;      ///< none: as given
    std::optional<double> stiffness_n_m2; ///< K_N; none: as given, or none of rigid contacts
};

/// Form and K_N of a study with an accuracy and without K_N.
/// @param top of the file   @param study its structure and outcome must be read
/// @throws InputError where the accuracy cannot be reached, with the reason
ChosenContact choose_contact(const KeyReader& top, Study& study);

/// The steps and the precision of contacts that yield; `run.accuracy` must be read. Nothing without an accuracy.
void choose_steps(const KeyReader& keys_of_run, Study& study);

} // namespace stylobate
