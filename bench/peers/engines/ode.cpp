/// Open Dynamics Engine: spatial, double precision, a complementarity problem in each step, solved exactly or
/// iterated.

#include "bench/peers/engine.hpp"
#include "bench/peers/engines/ode_simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    int iterations; ///< of the iterated solver; 0: the exact one
};
constexpr std::array settings{Setting{"QuickStep, 20 iterations", 20}, Setting{"QuickStep, 100 iterations", 100},
                              Setting{"exact (Dantzig)", 0}};

class OdeWorld final : public World {
public:
    OdeWorld(const Scene& scene, const Setting& setting, double step_s)
        : gravity_(scene.gravity_m_s2),
          simulation_(setting.iterations, step_s, [this](dGeomID a, dGeomID b) { return friction(a, b); })
    {
        for (const Body& body : scene.bodies) {
            const dGeomID geom = dCreateBox(simulation_.space(), 2 * body.half_width_m, 2 * body.half_height_m,
                                            body.fixed ? 1 : body.depth_m);
            dQuaternion turn;
            dQFromAxisAndAngle(turn, 0, 0, 1, body.start.theta_rad);
            if (body.fixed) {
                bodies_.push_back(nullptr);
            } else {
                const dBodyID made = dBodyCreate(simulation_.world());
                dMass mass;
                dMassSetBoxTotal(&mass, body.mass_kg, 2 * body.half_width_m, 2 * body.half_height_m, body.depth_m);
                dBodySetMass(made, &mass);
                dGeomSetBody(geom, made);
                bodies_.push_back(made);
                dJointAttach(dJointCreatePlane2D(simulation_.world(), nullptr), made, nullptr);
            }
            dGeomSetPosition(geom, body.start.x_m, body.start.y_m, 0);
            dGeomSetQuaternion(geom, turn);
            dGeomSetData(geom, reinterpret_cast<void*>(geoms_.size()));
            geoms_.push_back(geom);
            friction_.push_back(body.friction);
        }
    }

    void step(double ground_acceleration) override
    {
        simulation_.step(-ground_acceleration, -gravity_, 0);
        // what its manual asks for with Plane2D: the constraint's drift is taken out
        for (const dBodyID body : bodies_)
            if (body != nullptr) {
                const dReal* w = dBodyGetAngularVel(body);
                const dReal* q = dBodyGetQuaternion(body);
                const dReal length = std::hypot(q[0], q[3]);
                const dQuaternion turn{q[0] / length, 0, 0, q[3] / length};
                dBodySetQuaternion(body, turn);
                dBodySetAngularVel(body, 0, 0, w[2]);
            }
    }

    Pose pose(std::size_t body) const override
    {
        const dReal* p = dGeomGetPosition(geoms_[body]);
        dQuaternion q;
        dGeomGetQuaternion(geoms_[body], q);
        return {p[0], p[1], 2 * std::atan2(q[3], q[0])};
    }

private:
    /// Of neighbours in the scene the later one has the friction of their bed.
    double friction(dGeomID a, dGeomID b) const
    {
        return friction_[std::max(reinterpret_cast<std::uintptr_t>(dGeomGetData(a)),
                                  reinterpret_cast<std::uintptr_t>(dGeomGetData(b)))];
    }

    double gravity_;
    OdeSimulation simulation_;
    std::vector<dBodyID> bodies_; ///< null: fixed
    std::vector<dGeomID> geoms_;
    std::vector<double> friction_; ///< of each body against the one before
};

} // namespace

Engine ode_engine()
{
    return engine_of<OdeWorld>("ODE", STYLOBATE_ODE_VERSION, "its planar joint (Plane2D) on every body", 0.01, 0.5,
                               settings);
}

} // namespace stylobate::peers
