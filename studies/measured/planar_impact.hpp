#pragma once
/// Page `planar_impact`: one impact of a rigid ellipse on a surface, the contact law against 1110 measured ones.

#include "studies/measured/page_case.hpp"

namespace stylobate::measured {

/// Reads planar_impact/impacts.csv, writes docs/planar_impact.md and its pictures; where `place.predict` is set, what
/// the fitted laws predict for the impacts of that table too (docs/planar_impact_predictions.csv).
void planar_impact(const PagePlace& place);

} // namespace stylobate::measured
