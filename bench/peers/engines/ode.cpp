/// Open Dynamics Engine: spatial, double precision, a complementarity problem in each step, solved exactly or
/// iterated.

#include "bench/peers/engine.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <stdexcept>

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
        : setting_(setting), gravity_(scene.gravity_m_s2), step_(step_s)
    {
        static const bool ready = dInitODE2(0) != 0; // for the life of the process
        if (!ready)
            throw std::runtime_error("ODE does not start");
        // its exact solver complains of every redundant contact, and goes on
        dSetMessageHandler([](int, const char*, va_list) {});
        dRandSetSeed(0);
        world_ = dWorldCreate();
        space_ = dSimpleSpaceCreate(nullptr);
        group_ = dJointGroupCreate(0);
        dWorldSetAutoDisableFlag(world_, 0);
        if (setting.iterations > 0)
            dWorldSetQuickStepNumIterations(world_, setting.iterations);
        for (const Body& body : scene.bodies) {
            const dGeomID geom =
                dCreateBox(space_, 2 * body.half_width_m, 2 * body.half_height_m, body.fixed ? 1 : body.depth_m);
            dQuaternion turn;
            dQFromAxisAndAngle(turn, 0, 0, 1, body.start.theta_rad);
            if (body.fixed) {
                bodies_.push_back(nullptr);
            } else {
                const dBodyID made = dBodyCreate(world_);
                dMass mass;
                dMassSetBoxTotal(&mass, body.mass_kg, 2 * body.half_width_m, 2 * body.half_height_m, body.depth_m);
                dBodySetMass(made, &mass);
                dGeomSetBody(geom, made);
                bodies_.push_back(made);
                dJointAttach(dJointCreatePlane2D(world_, nullptr), made, nullptr);
            }
            dGeomSetPosition(geom, body.start.x_m, body.start.y_m, 0);
            dGeomSetQuaternion(geom, turn);
            dGeomSetData(geom, reinterpret_cast<void*>(geoms_.size()));
            geoms_.push_back(geom);
            friction_.push_back(body.friction);
        }
    }

    ~OdeWorld() override
    {
        dJointGroupDestroy(group_);
        for (const dGeomID geom : geoms_)
            dGeomDestroy(geom);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void step(double ground_acceleration) override
    {
        dWorldSetGravity(world_, -ground_acceleration, -gravity_, 0);
        dSpaceCollide(space_, this, &OdeWorld::meet);
        if (setting_.iterations > 0)
            dWorldQuickStep(world_, step_);
        else
            dWorldStep(world_, step_);
        dJointGroupEmpty(group_);
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
    static void meet(void* self, dGeomID a, dGeomID b)
    {
        auto& world = *static_cast<OdeWorld*>(self);
        const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
        if (first == nullptr && second == nullptr)
            return;
        constexpr int most = 8;
        dContact contacts[most] = {};
        const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
        // of neighbours in the scene the later one has the friction of their bed
        const auto later = std::max(reinterpret_cast<std::uintptr_t>(dGeomGetData(a)),
                                    reinterpret_cast<std::uintptr_t>(dGeomGetData(b)));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = world.friction_[later];
            dJointAttach(dJointCreateContact(world.world_, world.group_, &contacts[i]), first, second);
        }
    }

    Setting setting_;
    double gravity_, step_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID group_;
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
