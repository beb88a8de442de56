#pragma once
/// What all engines are asked to do: rectangles on shaken ground, in a plane. One file for each engine makes its
/// worlds.

#include "ensemble/motion/base_motion.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::peers {

/// Place of a rectangle: its centre [m], y up, and its rotation [rad], counter-clockwise.
struct Pose {
    double x_m = 0, y_m = 0, theta_rad = 0;
};

struct Body {
    double half_width_m = 0, half_height_m = 0, depth_m = 0;
    double mass_kg = 0;  ///< spread evenly; of a fixed one without meaning
    Pose start;          ///< at rest
    bool fixed = false;  ///< to the ground
    double friction = 0; ///< mu between it and the body before it in the scene
};

struct Scene {
    std::vector<Body> bodies;
    double gravity_m_s2 = 9.81;
};

/// One number for each body, for engines that multiply the numbers of a pair: the product for two neighbours in the
/// scene is their friction. Pairs that are no neighbours, which meet after a fall, get some product near it.
std::vector<double> friction_factors(const Scene& scene);

/// One scene in motion, in the frame of the ground: shaking comes as a horizontal acceleration of all bodies, which is
/// the same as moving the ground and keeps every engine's coordinates small.
class World {
public:
    virtual ~World() = default;
    World() = default;
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// One time step of the length for which the world was made, the ground being accelerated all along it [m/s2].
    virtual void step(double ground_acceleration) = 0;
    virtual Pose pose(std::size_t body) const = 0;
};

/// An engine as it is installed. Nothing bounces (restitution 0) and nothing is put to sleep in any of them.
struct Engine {
    std::string name;
    std::string version;
    std::string planar;          ///< how it is kept in a plane
    double customary_step_s = 0; ///< of its documentation's first example
    /// By how many steps its clock is ahead of its motion after a start from rest: half a step where it moves bodies
    /// with their new velocities, minus half a step where with their old ones. No error of its physics.
    double ahead_steps = 0;
    std::vector<std::string> settings; ///< of its solver; the first one is customary
    std::function<std::unique_ptr<World>(const Scene&, std::size_t setting, double step_s)> make;
};

/// An engine whose worlds are `AWorld(scene, setting, step_s)`.
/// @param settings each has a `name`; they live as long as the engine
template <class AWorld, class Settings>
Engine engine_of(std::string name, std::string version, std::string planar, double customary_step_s, double ahead_steps,
                 const Settings& settings)
{
    Engine engine{std::move(name), std::move(version), std::move(planar), customary_step_s, ahead_steps, {}, {}};
    for (const auto& setting : settings)
        engine.settings.emplace_back(setting.name);
    engine.make = [&settings](const Scene& scene, std::size_t setting, double step_s) -> std::unique_ptr<World> {
        return std::make_unique<AWorld>(scene, settings.at(setting), step_s);
    };
    return engine;
}

/// The engines that were found when this was built.
std::vector<Engine> engines();

Engine box2d_engine();
Engine chipmunk_engine();
Engine ode_engine();
Engine bullet_engine();
Engine mujoco_engine();

// The motion of the ground as an engine gets it: the same formulas as the project's own
// (`ensemble/motion/base_motion.hpp`).

/// Second difference of the ground's displacement about the begin of step n, over the step squared [m/s2]: what a
/// scheme that takes velocities first and places after makes of a ground that is moved along its path.
inline double mean_acceleration(const BaseMotion& base, int n, double step_s)
{
    const auto at = [&](int k) { return base.displacement_m(k * step_s); };
    return ((at(n + 1) - at(n)) - (at(n) - at(n - 1))) / (step_s * step_s);
}

} // namespace stylobate::peers
