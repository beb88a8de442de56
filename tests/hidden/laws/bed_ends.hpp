#pragma once
/// Where two bodies touch: the ends of their bed, each the corner of one body against the face of the other.

#include "tests/hidden/laws/model.hpp"

namespace stylobate::hidden {

/// One end of a bed: a corner, and the face that it meets.
struct BedEnd {
    double x = 0, y = 0;   ///< the corner, in the laboratory
    double nx = 0, ny = 1; ///< normal of the face, from the lower to the upper body
    double gap = 0;        ///< distance of the corner from the face, negative inside
};

struct BedEnds {
    BedEnd end[2];       ///< left and right
    double width = 0;    ///< from one to the other, along the lower face; negative: no common bed
    double position = 0; ///< middle of the upper face against the middle of the lower one, along the lower face
};

/// Velocity of the point (x, y) of a body that moves with `of`.
template <class Moving>
void velocity_at(const Moving& of, double x, double y, double& vx, double& vy)
{
    vx = of.vx - of.omega * (y - of.y);
    vy = of.vy + of.omega * (x - of.x);
}

/// The ends of a bed. At each end the corner that lies further inside is the one that touches: the upper body's on the
/// lower face, or the lower body's on the upper face.
///
/// @param base the table; used where the bed has no lower body
BedEnds ends_of_bed(const Model& model, int bed, const State& state, const BaseState& base);

/// Middle of a body's rectangle; the state is that of its centre of mass.
void geometric_centre(const Model& model, int body, const BodyState& state, double& x, double& y);

} // namespace stylobate::hidden
