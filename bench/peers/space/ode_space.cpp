/// Open Dynamics Engine with cylinders: on a plane by its own contact points, on each other by those of libccd, with
/// which Debian builds it.

#include "bench/peers/space/space_engine.hpp"

#include <ode/ode.h>

#include <array>
#include <cstdarg>
#include <stdexcept>

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
        : iterations_(setting.iterations), friction_(scene.friction), gravity_(scene.gravity_m_s2), step_(step_s)
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
        if (iterations_ > 0)
            dWorldSetQuickStepNumIterations(world_, iterations_);
        if (scene.on_plane())
            dCreatePlane(space_, 0, 0, 1, 0);
        for (const Drum& d : scene.drums) {
            const dGeomID geom = dCreateCylinder(space_, d.radius_m, 2 * d.half_height_m);
            const SpaceVector at = y_third(d.centre_m), v = y_third(d.velocity_m_s), w = y_third(d.omega_rad_s);
            const SpaceAttitude q = y_third(d.attitude);
            const dQuaternion turn{q.w, q.x, q.y, q.z};
            if (!d.fixed) {
                const dBodyID made = dBodyCreate(world_);
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

    ~OdeInSpace() override
    {
        dJointGroupDestroy(group_);
        dSpaceDestroy(space_); // and what is in it
        dWorldDestroy(world_);
    }

    void step(const SpaceVector& a) override
    {
        const SpaceVector pull = y_third(SpaceVector{0 - a.x, 0 - a.y - gravity_, 0 - a.z});
        dWorldSetGravity(world_, pull.x, pull.y, pull.z);
        dSpaceCollide(space_, this, &OdeInSpace::meet);
        if (iterations_ > 0)
            dWorldQuickStep(world_, step_);
        else
            dWorldStep(world_, step_);
        dJointGroupEmpty(group_);
    }

    SpacePose pose(std::size_t drum) const override
    {
        const dReal* p = dGeomGetPosition(geoms_[drum]);
        dQuaternion q;
        dGeomGetQuaternion(geoms_[drum], q);
        return {y_second(SpaceVector{p[0], p[1], p[2]}), y_second(SpaceAttitude{q[0], q[1], q[2], q[3]})};
    }

private:
    static void meet(void* self, dGeomID a, dGeomID b)
    {
        auto& world = *static_cast<OdeInSpace*>(self);
        const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
        if (first == nullptr && second == nullptr)
            return;
        constexpr int most = 8;
        dContact contacts[most] = {};
        const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = world.friction_;
            dJointAttach(dJointCreateContact(world.world_, world.group_, &contacts[i]), first, second);
        }
    }

    int iterations_;
    double friction_, gravity_, step_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID group_;
    std::vector<dGeomID> geoms_;
};

} // namespace

std::vector<SpaceContender> ode_in_space()
{
    return space_contenders_of<OdeInSpace>("ODE", STYLOBATE_ODE_VERSION, settings);
}

} // namespace stylobate::peers
