/// MuJoCo with cylinders: free joints, elliptic friction cones.

#include "bench/peers/engines/mujoco_simulation.hpp"
#include "bench/peers/space/space_engine.hpp"

#include <fmt/format.h>

#include <array>

namespace stylobate::peers {

namespace {

/// How soft its contacts are: the time constant of what corrects them [s]; the shortest that it allows is two steps.
struct Setting {
    const char* name;
    double time_constant_s; ///< 0: two steps
    bool several_points;    ///< of convex bodies (`multiccd`)
};
constexpr std::array settings{Setting{"contacts as by default", 0.02, false}, Setting{"stiff contacts", 0, false},
                              Setting{"stiff contacts, multiccd", 0, true}};

std::string model_text(const SpaceScene& scene, const Setting& setting, double step_s)
{
    const std::string law = fmt::format("friction='{} 0 0' condim='3' solref='{} 1'", scene.friction,
                                        setting.time_constant_s > 0 ? setting.time_constant_s : 2 * step_s);
    std::string bodies = scene.on_plane() ? fmt::format("<geom type='plane' size='0 0 1' {}/>", law) : "";
    for (const Drum& d : scene.drums) {
        const SpaceVector at = y_third(d.centre_m);
        const SpaceAttitude q = y_third(d.attitude);
        const std::string place =
                              fmt::format("pos='{} {} {}' quat='{} {} {} {}'", at.x, at.y, at.z, q.w, q.x, q.y, q.z),
                          geom = fmt::format("<geom type='cylinder' size='{} {}' mass='{}' {}", d.radius_m,
                                             d.half_height_m, d.fixed ? 1 : d.mass_kg, law);
        bodies += d.fixed ? fmt::format("{} {}/>", geom, place)
                          : fmt::format("<body {}><freejoint/>{}/></body>", place, geom);
    }
    return fmt::format("<mujoco><compiler boundmass='0' boundinertia='0'/>"
                       "<option timestep='{}' cone='elliptic'><flag multiccd='{}'/></option>"
                       "<size njmax='500' nconmax='100'/><worldbody>{}</worldbody></mujoco>",
                       step_s, setting.several_points ? "enable" : "disable", bodies);
}

class MujocoInSpace final : public SpaceWorld {
public:
    MujocoInSpace(const SpaceScene& scene, const Setting& setting, double step_s)
        : scene_(scene), simulation_(model_text(scene, setting, step_s))
    {
        int joint = 0;
        for (const Drum& d : scene.drums) {
            joints_.push_back(d.fixed ? -1 : joint);
            if (d.fixed)
                continue;
            // its rotation is in the body's own frame
            const SpaceVector v = y_third(d.velocity_m_s),
                              w = y_third(rotated_back(spatial::minus_identity(d.attitude), d.omega_rad_s));
            mjtNum* const at = simulation_.velocities() + 6 * joint;
            at[0] = v.x, at[1] = v.y, at[2] = v.z, at[3] = w.x, at[4] = w.y, at[5] = w.z;
            ++joint;
        }
    }

    void step(const SpaceVector& a) override
    {
        const SpaceVector pull = y_third(SpaceVector{0 - a.x, 0 - a.y - scene_.gravity_m_s2, 0 - a.z});
        simulation_.step(pull.x, pull.y, pull.z);
    }

    SpacePose pose(std::size_t drum) const override
    {
        if (joints_[drum] < 0)
            return {scene_.drums[drum].centre_m, scene_.drums[drum].attitude};
        const mjtNum* const q = simulation_.positions() + 7 * joints_[drum];
        return {y_second(SpaceVector{q[0], q[1], q[2]}), y_second(SpaceAttitude{q[3], q[4], q[5], q[6]})};
    }

private:
    SpaceScene scene_;
    MujocoSimulation simulation_;
    std::vector<int> joints_; ///< of each drum among the free ones; -1: fixed
};

} // namespace

std::vector<SpaceContender> mujoco_in_space()
{
    return space_contenders_of<MujocoInSpace>("MuJoCo", mj_versionString(), settings);
}

} // namespace stylobate::peers
