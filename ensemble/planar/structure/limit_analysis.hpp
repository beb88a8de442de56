#pragma once
/// Static limit analysis of rigid blocks in dry contact: the greatest horizontal acceleration of the base under which
/// forces exist that hold every block, pressing within the faces and inside the friction cones.
///
/// A linear programme. Each bed carries two pressures N1, N2 >= 0 at its ends (a resultant anywhere between them) and
/// a shear T with |T| <= mu (N1 + N2); each free block has three equations of equilibrium under its weight and the
/// inertia -m a. By the static theorem the maximum bounds the load at which anything moves from above for friction
/// (whose flow is not normal) and equals it for rocking alone.

#include "ensemble/realization/realization.hpp"

#include <vector>

namespace stylobate {

struct LimitLoad {
    double acceleration_m_s2 = 0;
    std::vector<double> pressure_n; ///< (beds) N1 + N2
    std::vector<double> shear_n;    ///< (beds) T on the upper block, towards +x
    std::vector<double> at;         ///< (beds) place of the resultant, -1 to 1 over the bed; NaN without pressure
};

/// @throws std::runtime_error if the structure cannot stand even without shaking
/// @pre the beds are horizontal in the reference state; watched pairs carry nothing
LimitLoad limit_acceleration(const Realization& realization);

/// Maximum of c x subject to A x = b, x >= 0, by the two-phase simplex method with Bland's rule, which cannot cycle.
/// Dense, in extended precision: for tens of unknowns.
/// @param a (rows x columns) row by row
/// @throws std::runtime_error if nothing fulfils the equations, or the maximum has no bound
std::vector<long double> maximise(std::vector<long double> a, std::vector<long double> b,
                                  const std::vector<long double>& c);

} // namespace stylobate
