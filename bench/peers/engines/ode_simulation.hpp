#pragma once
/// A scene in the Open Dynamics Engine, planar or in space: its world, and the contacts of what meets.

#include <ode/ode.h>

#include <cstdarg>
#include <functional>
#include <stdexcept>
#include <utility>

namespace stylobate::peers {

class OdeSimulation {
public:
    /// @param iterations of the iterated solver; 0: the exact one
    /// @param friction   coefficient of two bodies that meet
    OdeSimulation(int iterations, double step_s, std::function<double(dGeomID, dGeomID)> friction)
        : iterations_(iterations), step_(step_s), friction_(std::move(friction))
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
    }
    OdeSimulation(const OdeSimulation&) = delete;
    OdeSimulation& operator=(const OdeSimulation&) = delete;
    ~OdeSimulation()
    {
        dJointGroupDestroy(group_);
        dSpaceDestroy(space_); // and what is in it
        dWorldDestroy(world_);
    }

    dWorldID world() const { return world_; }
    dSpaceID space() const { return space_; }

    /// One step under this pull [m/s2].
    void step(double x, double y, double z)
    {
        dWorldSetGravity(world_, x, y, z);
        dSpaceCollide(space_, this, &OdeSimulation::meet);
        if (iterations_ > 0)
            dWorldQuickStep(world_, step_);
        else
            dWorldStep(world_, step_);
        dJointGroupEmpty(group_);
    }

private:
    static void meet(void* self, dGeomID a, dGeomID b)
    {
        const auto& simulation = *static_cast<OdeSimulation*>(self);
        const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
        if (first == nullptr && second == nullptr)
            return;
        constexpr int most = 8;
        dContact contacts[most] = {};
        const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
        const double friction = simulation.friction_(a, b);
        for (int i = 0; i < count; ++i) {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = friction;
            dJointAttach(dJointCreateContact(simulation.world_, simulation.group_, &contacts[i]), first, second);
        }
    }

    int iterations_;
    double step_;
    std::function<double(dGeomID, dGeomID)> friction_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID group_;
};

} // namespace stylobate::peers
