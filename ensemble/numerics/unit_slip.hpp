#pragma once
/// Units in which people give a number by mistake, for "did you mean".

namespace stylobate {

struct UnitSlip {
    double factor;    ///< from it to the SI unit that was meant
    const char* unit; ///< "mm"
};

inline constexpr UnitSlip from_lengths[] = {{1e-3, "mm"}, {1e-2, "cm"}};
inline constexpr UnitSlip from_velocities[] = {{1e-2, "cm/s"}, {1e-3, "mm/s"}};
inline constexpr UnitSlip from_accelerations[] = {{1e-2, "cm/s2"}, {1e-3, "mm/s2"}};

} // namespace stylobate
