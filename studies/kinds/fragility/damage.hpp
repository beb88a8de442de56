#pragma once
/// The limit states of a fragility study.
///
/// Three levels each of the peak and of the residual deformation are those of Psycharis, Fragiadakis & Stefanou,
/// "Seismic reliability assessment of classical columns subjected to near-fault ground motions", Earthquake Engineering
/// and Structural Dynamics 42 (2013) 2061, in the plane:
///
///   u_top, the largest displacement of the top over the width at the base: 0.15 damage limitation, 0.35 significant
///   damage, 1 near collapse; u_d, the largest residual dislocation of a joint over its width: 0.005 limited
///   deformation, 0.01 light damage, 0.02 significant damage
///
/// and further that a block falls (or all do), and that an epistyle loses its seat. A structure that has fallen has
/// reached every level. The top of a colonnade is its last block, the epistyle at the right.

#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct DamageState {
    enum class Kind { peak, residual, unseated, collapse, total };
    Kind kind = Kind::collapse;
    double limit = 0;     ///< of `peak` and `residual`
    std::string name;     ///< "peak_0.15", "collapse": one word
    std::string describe; ///< "the top moves by more than 0.15 of the width"
    int shaking = 0;      ///< of sequences: reached by the end of this one, counted from 1; 0: of them all
};

/// Those of a study: each kind from the slightest to the worst; of sequences also the collapse by each shaking.
std::vector<DamageState> damage_states(const Study& study);

/// Of the lowest block, by which peak displacements are measured [m].
double base_width_m(const StructureSpec& structure);

/// When the shaking of a sequence that a damage state belongs to is over, and the next one begins; infinite after the
/// last one.
double next_shaking_s(const Study& study, const MotionTable& motions, std::size_t motion, int shaking);

/// Whether a valid realization reached it; nothing: it stands, and still moved at the end, so that its residual is not
/// known.
/// @param until_s when the state's shaking is over and the next one begins
std::optional<bool> reached(const DamageState& state, const Outcome& outcome, double base_width_m,
                            double until_s = std::numeric_limits<double>::infinity());

} // namespace stylobate
