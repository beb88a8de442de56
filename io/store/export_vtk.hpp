#pragma once
/// A trajectory for ParaView: one file of polygons per time (VTP), and the list of their times (PVD).

#include "io/store/result_store.hpp"

#include <filesystem>

namespace stylobate {

/// Writes NAME.pvd and NAME_00000.vtp, NAME_00001.vtp and so on into a new folder, all of them or none.
///
/// Each VTP has the blocks in layout order and then the base, as polygons in the plane z = 0 [m], counter-clockwise
/// from the lower left corner, in the laboratory frame: the displacement of the base is added to the places of the
/// blocks. The base is drawn as a slab below y = 0. Data of each polygon: `block_id` (the base: -1), `rotation` [rad],
/// counter-clockwise, and `velocity` of the centre [m/s] in the laboratory frame, the central difference of the samples
/// (one-sided at both ends). A trajectory has no contacts: forces and openings of joints are left out.
///
/// @param name without an ending, for the names of the files
/// @throws InputError if the arrays of the trajectory do not fit each other, if it has no times, or if the folder holds
///         files or cannot be written
void write_vtk(const std::filesystem::path& folder, const std::string& name, const Trajectory& trajectory);

} // namespace stylobate
