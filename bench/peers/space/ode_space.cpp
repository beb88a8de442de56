/// Open Dynamics Engine with cylinders: on a plane by its own contact points, on each other by those of libccd, with
/// which Debian builds it.

#include "bench/peers/engines/ode_simulation.hpp"
#include "bench/peers/space/space_engine.hpp"

#include <array>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    int iterations; ///< of the iterated solver; 0: the exact one
};
constexpr std::array settings{Setting{"QuickStep, 20 iterations", 20}, Setting{"exact (Dantzig)", 0}};

constexpr double aside_part = 1e-6;

class OdeInSpace final : public SpaceWorld {
public:
    OdeInSpace(const SpaceScene& scene, const Setting& setting, double step_s)
        : gravity_(scene.gravity_m_s2),
          simulation_(setting.iterations, step_s, [mu = scene.friction](dGeomID, dGeomID) { return mu; })
    {
        if (scene.on_plane())
            dCreatePlane(simulation_.space(), 0, 0, 1, 0);
        for (const Drum& d : scene.drums) {
            const dGeomID geom = dCreateCylinder(simulation_.space(), d.radius_m, 2 * d.half_height_m);
            const SpaceVector at = y_third(d.centre_m), v = y_third(d.velocity_m_s), w = y_third(d.omega_rad_s);
            const SpaceAttitude q = y_third(d.attitude);
            const dQuaternion turn{q.w, q.x, q.y, q.z};
            if (!d.fixed) {
                const dBodyID made = dBodyCreate(simulation_.world());
                dMass mass;
                dMassSetCylinderTotal(&mass, d.mass_kg, 3, d.radius_m, 2 * d.half_height_m);
                dBodySetMass(made, &mass);
                dBodySetLinearVel(made, v.x, v.y, v.z);
                dBodySetAngularVel(made, w.x, w.y, w.z);
                dGeomSetBody(geom, made);
            }
            // cylinders on exactly one axis end the program by an assertion of its own
            const double aside = geoms_.size() % 2 == 0 ? 0 : aside_part * d.radius_m;
            dGeomSetPosition(geom, at.x + aside, at.y, at.z);
            dGeomSetQuaternion(geom, turn);
            geoms_.push_back(geom);
        }
    }

    void step(const SpaceVector& a) override
    {
        const SpaceVector pull = y_third(SpaceVector{0 - a.x, 0 - a.y - gravity_, 0 - a.z});
        simulation_.step(pull.x, pull.y, pull.z);
    }

    SpacePose pose(std::size_t drum) const override
    {
        const dReal* p = dGeomGetPosition(geoms_[drum]);
        dQuaternion q;
        dGeomGetQuaternion(geoms_[drum], q);
        return {y_second(SpaceVector{p[0], p[1], p[2]}), y_second(SpaceAttitude{q[0], q[1], q[2], q[3]})};
    }

private:
    double gravity_;
    OdeSimulation simulation_;
    std::vector<dGeomID> geoms_;
};

} // namespace

std::vector<SpaceContender> ode_in_space()
{
    return space_contenders_of<OdeInSpace>("ODE", STYLOBATE_ODE_VERSION, settings);
}

} // namespace stylobate::peers
