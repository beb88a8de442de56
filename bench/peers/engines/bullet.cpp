/// Bullet: spatial, in its build with double precision, sequential impulses.
///
/// Its tolerances are meant for bodies of 0.2 to 5 units, so the specimen is built in units of a decimetre, gravity
/// with it; times are as they are.

#include "bench/peers/engine.hpp"

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    int iterations; ///< of sequential impulses; 0: the exact solver
};
constexpr std::array settings{Setting{"10 iterations", 10}, Setting{"50 iterations", 50},
                              Setting{"exact (Dantzig)", 0}};
constexpr double units_per_metre = 10;

class BulletWorld final : public World {
public:
    BulletWorld(const Scene& scene, const Setting& setting, double step_s)
        : dispatcher_(&configuration_), gravity_(scene.gravity_m_s2), step_(step_s)
    {
        if (setting.iterations > 0)
            solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
        else
            solver_ = std::make_unique<btMLCPSolver>(&dantzig_);
        world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_, solver_.get(), &configuration_);
        if (setting.iterations > 0)
            world_->getSolverInfo().m_numIterations = setting.iterations;
        const std::vector<double> factors = friction_factors(scene);
        for (const Body& body : scene.bodies) {
            const btVector3 half(units_per_metre * body.half_width_m, units_per_metre * body.half_height_m,
                                 units_per_metre * body.depth_m / 2);
            shapes_.push_back(std::make_unique<btBoxShape>(half));
            btVector3 inertia(0, 0, 0);
            const double mass = body.fixed ? 0 : body.mass_kg;
            if (!body.fixed)
                shapes_.back()->calculateLocalInertia(mass, inertia);
            btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
            info.m_startWorldTransform =
                btTransform(btQuaternion(btVector3(0, 0, 1), body.start.theta_rad),
                            btVector3(units_per_metre * body.start.x_m, units_per_metre * body.start.y_m, 0));
            info.m_friction = factors[bodies_.size()]; // the friction of a pair is the product
            auto made = std::make_unique<btRigidBody>(info);
            made->setActivationState(DISABLE_DEACTIVATION);
            made->setLinearFactor({1, 1, 0});
            made->setAngularFactor({0, 0, 1});
            world_->addRigidBody(made.get());
            bodies_.push_back(std::move(made));
        }
    }

    ~BulletWorld() override
    {
        for (const auto& body : bodies_)
            world_->removeRigidBody(body.get());
    }

    void step(double ground_acceleration) override
    {
        const btVector3 pull(-units_per_metre * ground_acceleration, -units_per_metre * gravity_, 0);
        for (const auto& body : bodies_)
            body->setGravity(pull);
        world_->stepSimulation(step_, 0); // one step of just this length
    }

    Pose pose(std::size_t body) const override
    {
        const btTransform& at = bodies_[body]->getWorldTransform();
        const btMatrix3x3& turn = at.getBasis();
        return {at.getOrigin().x() / units_per_metre, at.getOrigin().y() / units_per_metre,
                std::atan2(turn[1][0], turn[0][0])};
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btDantzigSolver dantzig_;
    std::unique_ptr<btConstraintSolver> solver_;
    std::unique_ptr<btDiscreteDynamicsWorld> world_;
    std::vector<std::unique_ptr<btBoxShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    double gravity_, step_;
};

} // namespace

Engine bullet_engine()
{
    return engine_of<BulletWorld>(
        "Bullet", std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100),
        "linear factor (1, 1, 0) and angular factor (0, 0, 1) of every body", 1.0 / 60, 0.5, settings);
}

} // namespace stylobate::peers
