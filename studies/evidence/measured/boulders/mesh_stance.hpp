#pragma once
/// Rocking properties from the photogrammetric shape of a body: tilting over its edges in each direction.

#include <array>
#include <filesystem>
#include <vector>

namespace stylobate::measured {

/// A closed surface of triangles, z up, standing on its lowest points.
struct Mesh {
    std::vector<std::array<double, 3>> vertices; ///< [m]
    std::vector<std::array<std::size_t, 3>> triangles;
};

/// Reads a Wavefront .obj, gzipped or not: its lines `v` and `f` (faces of three corners).
/// @throws InputError naming the file and line
Mesh read_obj(const std::filesystem::path& file);

struct MeshBody {
    double volume_m3 = 0;
    std::array<double, 3> centroid_m{};
    std::array<double, 3> extent_m{}; ///< of its bounding box
};
MeshBody body_of(const Mesh& mesh);

/// Leaning towards one direction on a flat floor, quasi-statically, without slip: at each angle it stands on its lowest
/// point, so that its centre rises as the support function of its convex hull.
struct Stance {
    double azimuth_rad = 0;
    double start_slenderness = 0; ///< horizontal over vertical distance of the centre from the edge, leaned by 1 degree
    double balance_rad = 0;       ///< lean at which the centre is highest
    double barrier = 0;           ///< rise of the centre up to there, over its height at rest
    double effective_slenderness() const; ///< of a rectangle with the same barrier: 1 / cos(alpha) = 1 + barrier
};
std::vector<Stance> stances(const Mesh& mesh, int directions);

} // namespace stylobate::measured
