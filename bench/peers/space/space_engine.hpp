#pragma once
/// What engines are asked to do in space: drums on a fixed plane or on each other, on shaken ground.

#include "kernels/spatial/rotation.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stylobate::peers {

using SpaceVector = spatial::Vector<double>;
using SpaceAttitude = spatial::Quaternion<double>;

/// A drum, its axis along its own y; start in the frame of the ground, y upwards.
struct Drum {
    double radius_m = 0, half_height_m = 0;
    double mass_kg = 0; ///< spread evenly; of a fixed one without meaning
    bool fixed = false;
    SpaceVector centre_m{0, 0, 0};
    SpaceAttitude attitude{1, 0, 0, 0};
    SpaceVector velocity_m_s{0, 0, 0}, omega_rad_s{0, 0, 0};
};

/// Drums from the bottom up. Upright each would stand on the one before, and the first on the plane y = 0, or with its
/// top in it if it is fixed.
struct SpaceScene {
    std::vector<Drum> drums;
    double friction = 0; ///< of every bed
    double gravity_m_s2 = 9.81;
    bool on_plane() const { return !drums.front().fixed; }
};

struct SpacePose {
    SpaceVector centre_m{0, 0, 0};
    SpaceAttitude attitude{1, 0, 0, 0};
};

/// One scene in motion, in the frame of the ground, whose motion comes as an acceleration of all bodies.
class SpaceWorld {
public:
    virtual ~SpaceWorld() = default;
    SpaceWorld() = default;
    SpaceWorld(const SpaceWorld&) = delete;
    SpaceWorld& operator=(const SpaceWorld&) = delete;

    /// One time step of the length for which the world was made, the ground being accelerated all along it [m/s2].
    virtual void step(const SpaceVector& ground_acceleration) = 0;
    virtual SpacePose pose(std::size_t drum) const = 0;
};

/// A world and its clock. From a start at rest every engine here moves bodies with their new velocities, so that its
/// motion is half a step ahead of its clock: no error of its physics.
struct SpaceRun {
    std::unique_ptr<SpaceWorld> world;
    double step_s = 0;
};

/// An engine in one setting, with the dial that makes it more accurate and slower: the time step, or for Stylobate the
/// stiffness of its beds.
struct SpaceContender {
    std::string engine, version, setting;
    bool own = false;
    std::vector<double> dials; ///< coarse to fine: steps [s], or stiffnesses [N/m3]
    std::function<SpaceRun(const SpaceScene&, double dial)> make;
    /// Processor time for one simulated second of a scene that is shaken [s]; of Stylobate that of one of the
    /// realizations of a full register.
    std::function<double(const SpaceScene&, double dial)> cost_s;
};

/// Engines of this kind: `AWorld(scene, setting, step_s)`, at 1/240, 1/960 and 1/3840 s.
/// @param settings each has a `name`; they live as long as the program
template <class AWorld, class Settings>
std::vector<SpaceContender> space_contenders_of(const std::string& engine, const std::string& version,
                                                const Settings& settings)
{
    std::vector<SpaceContender> all;
    for (const auto& setting : settings) {
        SpaceContender c;
        c.engine = engine;
        c.version = version;
        c.setting = setting.name;
        c.dials = {1.0 / 240, 1.0 / 960, 1.0 / 3840};
        c.make = [&setting](const SpaceScene& scene, double step_s) {
            return SpaceRun{std::make_unique<AWorld>(scene, setting, step_s), step_s};
        };
        all.push_back(std::move(c));
    }
    return all;
}

std::vector<SpaceContender> bullet_in_space();
std::vector<SpaceContender> mujoco_in_space();
std::vector<SpaceContender> ode_in_space();
std::vector<SpaceContender> own_in_space();

/// All that were found when this was built; Stylobate last.
std::vector<SpaceContender> space_contenders();

// Some engines have a cylinder's axis along their third axis: cyclic order turns y into it.

inline SpaceVector y_third(const SpaceVector& v)
{
    return {v.z, v.x, v.y};
}
inline SpaceVector y_second(const SpaceVector& v)
{
    return {v.y, v.z, v.x};
}
inline SpaceAttitude y_third(const SpaceAttitude& q)
{
    return {q.w, q.z, q.x, q.y};
}
inline SpaceAttitude y_second(const SpaceAttitude& q)
{
    return {q.w, q.y, q.z, q.x};
}

} // namespace stylobate::peers
