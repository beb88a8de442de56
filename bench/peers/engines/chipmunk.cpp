/// Chipmunk 7: planar, double precision, sequential impulses.
///
/// Its customary unit is a pixel (a collision slop of 0.1 by default), so a millimetre is one here; times are as they
/// are.

#include "bench/peers/engine.hpp"

#include <chipmunk/chipmunk.h>

#include <array>
#include <cmath>

namespace stylobate::peers {

namespace {

struct Setting {
    const char* name;
    int iterations;
    double slop;
};
constexpr std::array settings{Setting{"10 iterations", 10, 0.1}, Setting{"50 iterations", 50, 0.1},
                              Setting{"50 iterations, slop 0.01", 50, 0.01}};
constexpr double units_per_metre = 1000;

class ChipmunkWorld final : public World {
public:
    ChipmunkWorld(const Scene& scene, const Setting& setting, double step_s)
        : space_(cpSpaceNew()), gravity_(scene.gravity_m_s2), step_(step_s)
    {
        cpSpaceSetIterations(space_, setting.iterations);
        cpSpaceSetCollisionSlop(space_, setting.slop);
        const std::vector<double> factors = friction_factors(scene);
        for (const Body& body : scene.bodies) {
            const double b = units_per_metre * body.half_width_m, h = units_per_metre * body.half_height_m;
            cpBody* made = body.fixed ? cpBodyNewStatic() : cpBodyNew(body.mass_kg, body.mass_kg * (b * b + h * h) / 3);
            cpBodySetPosition(made, {units_per_metre * body.start.x_m, units_per_metre * body.start.y_m});
            cpBodySetAngle(made, body.start.theta_rad);
            cpSpaceAddBody(space_, made);
            cpShape* shape = cpBoxShapeNew(made, 2 * b, 2 * h, 0);
            cpShapeSetFriction(shape, factors[shapes_.size()]); // the friction of a pair is the product
            cpShapeSetElasticity(shape, 0);
            cpSpaceAddShape(space_, shape);
            bodies_.push_back(made);
            shapes_.push_back(shape);
        }
    }

    ~ChipmunkWorld() override
    {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            cpSpaceRemoveShape(space_, shapes_[i]);
            cpSpaceRemoveBody(space_, bodies_[i]);
            cpShapeFree(shapes_[i]);
            cpBodyFree(bodies_[i]);
        }
        cpSpaceFree(space_);
    }

    void step(double ground_acceleration) override
    {
        cpSpaceSetGravity(space_, {-units_per_metre * ground_acceleration, -units_per_metre * gravity_});
        cpSpaceStep(space_, step_);
    }

    Pose pose(std::size_t body) const override
    {
        const cpVect p = cpBodyGetPosition(bodies_[body]);
        return {p.x / units_per_metre, p.y / units_per_metre, cpBodyGetAngle(bodies_[body])};
    }

private:
    cpSpace* space_;
    double gravity_, step_;
    std::vector<cpBody*> bodies_;
    std::vector<cpShape*> shapes_;
};

} // namespace

Engine chipmunk_engine()
{
    return engine_of<ChipmunkWorld>("Chipmunk", cpVersionString, "planar by itself", 1.0 / 60, -0.5, settings);
}

} // namespace stylobate::peers
