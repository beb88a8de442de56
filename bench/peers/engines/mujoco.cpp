/// MuJoCo: spatial in joint coordinates, double precision, soft contacts by convex optimisation.

#include "bench/peers/engine.hpp"
#include "bench/peers/engines/mujoco_simulation.hpp"

#include <fmt/format.h>

#include <array>

namespace stylobate::peers {

namespace {

/// How soft its contacts are: the time constant of what corrects them [s], and the impedance. The shortest constant
/// that it allows is two steps.
struct Setting {
    const char* name;
    double time_constant_s; ///< 0: two steps
    const char* impedance;
};
constexpr std::array settings{Setting{"contacts as by default", 0.02, "0.9 0.95 0.001"},
                              Setting{"stiff contacts", 0, "0.9 0.95 0.001"},
                              Setting{"stiff contacts, impedance 0.999", 0, "0.999 0.9999 0.0001"}};

/// x to the right and z up are the plane; the hinge's axis is -y, so that its angle is counter-clockwise.
std::string model_text(const Scene& scene, const Setting& setting, double step_s)
{
    std::string bodies;
    int priority = 0; // of a pair the geom with the higher one decides: the upper block has the friction of its bed
    for (const Body& body : scene.bodies) {
        const std::string box = fmt::format(
            "<geom type='box' size='{} {} {}' mass='{}' friction='{} 0 0' priority='{}' solref='{} 1' solimp='{}'",
            body.half_width_m, body.depth_m / 2, body.half_height_m, body.fixed ? 1 : body.mass_kg, body.friction,
            priority++, setting.time_constant_s > 0 ? setting.time_constant_s : 2 * step_s, setting.impedance);
        if (body.fixed)
            bodies += fmt::format("{} pos='{} 0 {}'/>", box, body.start.x_m, body.start.y_m);
        else
            bodies += fmt::format("<body pos='{} 0 {}'><joint type='slide' axis='1 0 0'/><joint type='slide' "
                                  "axis='0 0 1'/><joint type='hinge' axis='0 -1 0'/>{}/></body>",
                                  body.start.x_m, body.start.y_m, box);
    }
    return fmt::format("<mujoco><compiler boundmass='0' boundinertia='0'/>"
                       "<option timestep='{}' cone='elliptic'/><size njmax='500' nconmax='100'/>"
                       "<worldbody>{}</worldbody></mujoco>",
                       step_s, bodies);
}

class MujocoWorld final : public World {
public:
    MujocoWorld(const Scene& scene, const Setting& setting, double step_s)
        : scene_(scene), simulation_(model_text(scene, setting, step_s))
    {
        int joint = 0;
        for (const Body& body : scene.bodies) {
            joints_.push_back(body.fixed ? -1 : joint);
            if (body.fixed)
                continue;
            simulation_.positions()[joint + 2] = body.start.theta_rad;
            joint += 3;
        }
    }

    void step(double ground_acceleration) override { simulation_.step(-ground_acceleration, 0, -scene_.gravity_m_s2); }

    Pose pose(std::size_t body) const override
    {
        Pose at = scene_.bodies[body].start;
        if (const int joint = joints_[body]; joint >= 0) {
            at.x_m += simulation_.positions()[joint];
            at.y_m += simulation_.positions()[joint + 1];
            at.theta_rad = simulation_.positions()[joint + 2];
        }
        return at;
    }

private:
    Scene scene_;
    MujocoSimulation simulation_;
    std::vector<int> joints_; ///< first of each body's three; -1: fixed
};

} // namespace

Engine mujoco_engine()
{
    return engine_of<MujocoWorld>("MuJoCo", mj_versionString(), "two slides and one hinge for every body", 0.002, 0.5,
                                  settings);
}

} // namespace stylobate::peers
