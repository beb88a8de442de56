/// Box2D 2.4: planar, single precision, sequential impulses.
///
/// Its tolerances are lengths fixed at its build, meant for blocks of 0.1 to 10 units: a slop of 0.005 and a skin of
/// 0.01 around every polygon. So the specimen is built in larger units, gravity with it, which leaves times as they
/// are; and polygons are lower than their blocks by what faces at rest keep apart, so that these rest where they
/// should.

#include "bench/peers/engine.hpp"

#include <box2d/box2d.h>

#include <array>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    float units_per_metre;
    int velocity_iterations, position_iterations;
};
constexpr std::array settings{Setting{"8 + 3 iterations", 100, 8, 3}, Setting{"6 + 2 iterations", 100, 6, 2},
                              Setting{"20 + 8 iterations", 100, 20, 8},
                              Setting{"8 + 3 iterations, unit 5 mm", 200, 8, 3},
                              Setting{"8 + 3 iterations, unit 1 mm", 1000, 8, 3}};

class Box2dWorld final : public World {
public:
    Box2dWorld(const Scene& scene, const Setting& setting, double step_s)
        : setting_(setting), world_({0, 0}), gravity_(scene.gravity_m_s2), step_(static_cast<float>(step_s))
    {
        // faces at rest: two skins less the slop that position correction leaves
        const float gap = 2 * b2_polygonRadius - b2_linearSlop;
        world_.SetAllowSleeping(false);
        const std::vector<double> factors = friction_factors(scene);
        for (const Body& body : scene.bodies) {
            b2BodyDef definition;
            definition.type = body.fixed ? b2_staticBody : b2_dynamicBody;
            definition.position = {units(body.start.x_m), units(body.start.y_m)};
            definition.angle = static_cast<float>(body.start.theta_rad);
            b2Body* made = world_.CreateBody(&definition);
            b2PolygonShape shape;
            shape.SetAsBox(units(body.half_width_m), units(body.half_height_m) - gap / 2);
            b2FixtureDef fixture;
            fixture.shape = &shape;
            fixture.density = 1;
            const double factor = factors[bodies_.size()];
            fixture.friction = static_cast<float>(factor * factor); // the friction of a pair is the geometric mean
            made->CreateFixture(&fixture);
            if (!body.fixed) {
                const float mass = static_cast<float>(body.mass_kg), b = units(body.half_width_m),
                            h = units(body.half_height_m);
                const b2MassData data{mass, {0, 0}, mass * (b * b + h * h) / 3};
                made->SetMassData(&data);
            }
            bodies_.push_back(made);
        }
    }

    void step(double ground_acceleration) override
    {
        world_.SetGravity({units(-ground_acceleration), units(-gravity_)});
        world_.Step(step_, setting_.velocity_iterations, setting_.position_iterations);
    }

    Pose pose(std::size_t body) const override
    {
        const b2Body& b = *bodies_[body];
        return {b.GetPosition().x / setting_.units_per_metre, b.GetPosition().y / setting_.units_per_metre,
                b.GetAngle()};
    }

private:
    float units(double metres) const { return static_cast<float>(metres) * setting_.units_per_metre; }

    Setting setting_;
    b2World world_;
    double gravity_;
    float step_;
    std::vector<b2Body*> bodies_; ///< of the world
};

} // namespace

Engine box2d_engine()
{
    return engine_of<Box2dWorld>("Box2D", STYLOBATE_BOX2D_VERSION, "planar by itself", 1.0 / 60, 0.5, settings);
}

} // namespace stylobate::peers
