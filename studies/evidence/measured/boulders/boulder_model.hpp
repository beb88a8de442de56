#pragma once
/// A boulder as a planar rigid rectangle on the shaking table: what a test does to it, by the engine.
///
/// Shake-table tests of two boulders: the measured motion of the table and whether each fell (rock_shake_table).

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/evidence/measured/parts/fall_table.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::measured {

inline constexpr std::size_t boulders = 2;

/// One test: both boulders stood on the table.
struct BoulderTest {
    int number = 0;
    std::string ground_motion;
    double pga_g = 0;          ///< as published
    double pgv_over_pga_s = 0; ///< as published
    std::array<bool, boulders> fell{};
    /// Published numerical predictions (in the order of `BoulderData::published`).
    std::array<std::vector<bool>, boulders> predicted;
    Motion motion; ///< of the table, its strong part (`strong_part`); empty where it was not measured
};

struct BoulderData {
    std::vector<BoulderTest> tests;                           ///< with a measured motion, by number
    std::array<std::vector<std::string>, boulders> published; ///< names of the numerical models
    int without_motion = 0;                                   ///< tests that are left out
};

/// Where a motion is worth following: from half a second before the acceleration first exceeds `level` until half a
/// second after it last does. Empty range where it never does.
/// @return first sample and one past the last
std::pair<std::size_t, std::size_t> strong_part(const std::vector<double>& acceleration_m_s2, double dt_s,
                                                double level_m_s2);

/// Below this nothing moves that could fall: far under the least slenderness that is tried [m/s2].
inline constexpr double still_below_m_s2 = 0.6;

/// @param folder with tests.csv and table_motion_200Hz.h5
/// @throws InputError naming the file, and the line or data set
BoulderData read_boulders(const std::filesystem::path& folder);

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

/// The rectangle: its mass is the boulder's; its slenderness and height are effective ones.
struct BoulderModel {
    double slenderness = 0.2;           ///< width over height, tan alpha
    double height_m = 0.5;              ///< of the rectangle, twice that of its centre
    double normal_stiffness_n_m2 = 1e9; ///< K_N
    double damping_ratio = 0.1;         ///< of both dashpots
    bool ends = false;                  ///< whether the normal dashpot acts at the ends of the contact (face damping)
    double eccentricity_m = 0;          ///< of the centre of mass: the block falls more easily to one side
    double slenderness_spread = 0;      ///< of a study's ensemble: sigma of ln(width)

    /// Of the equal rigid block, p = sqrt(3 g / (4 R)) [rad/s].
    double rocking_rate_rad_s() const;
};

inline constexpr double boulder_mass_kg = 353.8;
inline constexpr double boulder_depth_m = 0.6;
inline constexpr double boulder_friction = 0.7;

/// The study of such a block, as `stylobate run` takes it; its record is to be given.
/// @param realizations 1 without a spread
Study boulder_study(const BoulderModel& model, std::uint64_t realizations = 1);

/// How the realizations of a study end in a test; none in one whose motion is too weak to move anything.
/// @throws InputError if all are invalid
Ends ensemble_ends(const Study& study, const Motion& motion, const RunOptions& run);

/// What the block keeps of its rocking speed at an impact: from free rocking, released at half of alpha, by the energy
/// of the highest point after the impact (still base; compliance of the bed included).
double restitution(const BoulderModel& model);

/// One choice of all but the slenderness, and what it does to every test.
struct BoulderTable {
    BoulderModel variant; ///< its slenderness and spread are of no meaning
    FallTable falls;
};

/// Simulates every test with every slenderness; on several threads.
BoulderTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run);

/// A fitted model of both boulders: they share all but the slenderness.
struct BoulderFit {
    std::array<BoulderModel, boulders> model;
    double slip = 0.05;        ///< share of tests that end as they like: P = slip / 2 + (1 - slip) share
    double log_likelihood = 0; ///< of the tests that were fitted on [nat]
};

/// The most likely table, slendernesses, spread and slip.
/// @param use which of the tests are fitted on   @param spreads that are tried
BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads);

/// Forecasts of the held-out tests: those of the first boulder, then those of the second one.
struct Predictor {
    std::string name;
    std::vector<Forecast> held;
    double log_likelihood = 0; ///< on the fitting half, of what was fitted by likelihood; else 0
};

/// What one variant of the contact does to the impacts, and how likely it makes what was measured.
struct Dissipation {
    BoulderFit best;        ///< over sizes and stiffnesses
    double restitution = 0; ///< of its first boulder
    double housner = 0;     ///< 1 - 1.5 sin2 alpha
};

struct BoulderResults {
    BoulderData data;
    std::vector<bool> fits; ///< (tests) whether it is in the fitting half
    std::size_t fitting_motions = 0, held_motions = 0;
    BoulderFit baseline, scattered, extended, one_sided;
    Predictor by_rate, by_box, by_published, by_intensity, by_baseline, by_scattered, by_extended;
    std::array<std::vector<Predictor>, boulders> published; ///< each numerical model on its boulder's held-out tests
    std::array<Predictor, boulders> extended_of;            ///< the extended model on one boulder's alone
    std::vector<Dissipation> dissipation;
    Estimate swapped_brier, swapped_right; ///< extended - baseline, fitted on the other half and judged on this one
    std::vector<Stance> stances;
    MeshBody body;
    int realizations = 0;
    Ends fitting, judging; ///< of the tables that are fitted with, and of the three judged models' ensembles
};

/// Text of the page. @param images path of the pictures, seen from it
std::string boulder_page(const BoulderResults& results, const std::string& images);
void draw_boulders(const BoulderResults& results, const PagePlace& place);

} // namespace stylobate::measured
