#pragma once
/// The specimens of the virtual laboratory: as planned, as made, and as put on the table.

#include "ensemble/model/campaign.hpp"
#include "tests/hidden/draws.hpp"
#include "tests/hidden/shaking.hpp"

#include <string>

namespace stylobate::hidden {

enum class SpecimenKind {
    small_column,     ///< 3 to 6 free blocks 48 x 29 mm on a fixed one
    two_drums,        ///< two drums 60 x 50 mm
    frame,            ///< two monolithic columns 60 x 100 mm, epistyle 150 x 60 mm
    frame_of_drums,   ///< the same, two drums 60 x 50 mm each
    full_scale_column ///< 4 to 6 drums 1.5 x 1 m
};

struct Planned {
    SpecimenKind kind = SpecimenKind::small_column;
    Specimen specimen;       ///< nominal, as the file gives it
    ShakingBand band;        ///< motions that suit it
    double rocking_m_s2 = 0; ///< base acceleration at which a rigid one would begin to rock or slide, about
    double camera_m = 0;     ///< noise of the cameras, 1 sigma
    double camera_rad = 0;
    double sensor_m = 0; ///< of the table's displacement
};

Planned plan_specimen(SpecimenKind kind, Draws& draws);

/// Scatter of what is made, 1 sigma, relative; that of widths and masses is in the file.
inline constexpr double friction_scatter = 0.03;

/// The specimen as it was made: friction of each bed, widths and masses about the nominal ones; with the law's
/// parameters drawn and its step chosen. The effects are neutral.
Model make_specimen(const Planned& planned, Law law, Draws making, Draws parameters);

/// Scatters friction, widths and masses of a model once more, by their tolerances.
void scatter(Model& model, const Specimen& specimen, Draws& draws);

/// Laid by hand, bed by bed: every block within the placement's tolerance of its place, and what an effect shifts.
State laid_by_hand(const Model& model, const Specimen& specimen, Draws placement);

/// Left alone on the still table until it rests: then its beds remember nothing but where they are.
void let_rest(const Model& model, State& state);

/// Laid by hand, and left alone until it rests.
State put_on_table(const Model& model, const Specimen& specimen, Draws placement);

/// The study file that a user would write for the specimen: nominal sizes and friction, and the usual stiffness of dry
/// joints of stone, which was not measured.
std::string study_text_of(const Planned& planned);

} // namespace stylobate::hidden
