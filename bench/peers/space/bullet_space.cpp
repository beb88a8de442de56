/// Bullet with cylinders, in its build with double precision.
///
/// Its tolerances are meant for bodies of 0.2 to 5 units, so the unit is the first drum's diameter, gravity with it;
/// times are as they are. A cylinder is rounded by its margin.

#include "bench/peers/space/space_engine.hpp"

#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    int iterations;
    double margin; ///< of a cylinder, in units; 0: as by default, 0.04
};
constexpr std::array settings{Setting{"10 iterations", 10, 0}, Setting{"50 iterations, margin 0.001", 50, 0.001}};

class BulletInSpace final : public SpaceWorld {
public:
    BulletInSpace(const SpaceScene& scene, const Setting& setting, double step_s)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
          unit_(1 / (2 * scene.drums.front().radius_m)), gravity_(scene.gravity_m_s2), step_(step_s)
    {
        world_.getSolverInfo().m_numIterations = setting.iterations;
        if (scene.on_plane())
            add(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0), 0, btTransform::getIdentity(),
                scene.friction);
        for (const Drum& d : scene.drums) {
            auto shape = std::make_unique<btCylinderShape>(
                btVector3(unit_ * d.radius_m, unit_ * d.half_height_m, unit_ * d.radius_m));
            if (setting.margin > 0)
                shape->setMargin(setting.margin);
            const SpaceAttitude& q = d.attitude;
            drums_.push_back(add(std::move(shape), d.fixed ? 0 : d.mass_kg,
                                 btTransform(btQuaternion(q.x, q.y, q.z, q.w), scaled(d.centre_m)), scene.friction));
            drums_.back()->setLinearVelocity(scaled(d.velocity_m_s));
            drums_.back()->setAngularVelocity({d.omega_rad_s.x, d.omega_rad_s.y, d.omega_rad_s.z});
        }
    }

    ~BulletInSpace() override
    {
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }

    void step(const SpaceVector& a) override
    {
        for (btRigidBody* drum : drums_)
            drum->setGravity(scaled({0 - a.x, 0 - a.y - gravity_, 0 - a.z}));
        world_.stepSimulation(step_, 0); // one step of just this length
    }

    SpacePose pose(std::size_t drum) const override
    {
        const btVector3& p = drums_[drum]->getWorldTransform().getOrigin();
        const btQuaternion q = drums_[drum]->getWorldTransform().getRotation();
        return {{p.x() / unit_, p.y() / unit_, p.z() / unit_}, {q.w(), q.x(), q.y(), q.z()}};
    }

private:
    btVector3 scaled(const SpaceVector& v) const { return {unit_ * v.x, unit_ * v.y, unit_ * v.z}; }

    btRigidBody* add(std::unique_ptr<btCollisionShape> shape, double mass, const btTransform& at, double friction)
    {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) { // that of its default is of a box
            const btCylinderShape& c = static_cast<const btCylinderShape&>(*shape);
            const double r = c.getRadius(), h = c.getHalfExtentsWithMargin().y(), across = r * r / 4 + h * h / 3;
            inertia = mass * btVector3(across, r * r / 2, across);
        }
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        info.m_startWorldTransform = at;
        info.m_friction = std::sqrt(friction); // the friction of a pair is the product
        shapes_.push_back(std::move(shape));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
        return bodies_.back().get();
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    double unit_; ///< per metre
    double gravity_, step_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<btRigidBody*> drums_;
};

} // namespace

std::vector<SpaceContender> bullet_in_space()
{
    return space_contenders_of<BulletInSpace>(
        "Bullet", std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100), settings);
}

} // namespace stylobate::peers
