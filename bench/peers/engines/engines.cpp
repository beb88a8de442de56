#include "bench/peers/engine.hpp"
#include "bench/peers/space/space_engine.hpp"

#include <cmath>

namespace stylobate::peers {

std::vector<double> friction_factors(const Scene& scene)
{
    std::vector<double> factors;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        factors.push_back(i == 0 ? std::sqrt(scene.bodies.at(1).friction) : scene.bodies[i].friction / factors.back());
    return factors;
}

std::vector<Engine> engines()
{
    std::vector<Engine> found;
#ifdef STYLOBATE_PEER_BOX2D
    found.push_back(box2d_engine());
#endif
#ifdef STYLOBATE_PEER_CHIPMUNK
    found.push_back(chipmunk_engine());
#endif
#ifdef STYLOBATE_PEER_BULLET
    found.push_back(bullet_engine());
#endif
#ifdef STYLOBATE_PEER_MUJOCO
    found.push_back(mujoco_engine());
#endif
#ifdef STYLOBATE_PEER_ODE
    found.push_back(ode_engine());
#endif
    return found;
}

std::vector<SpaceContender> space_contenders()
{
    std::vector<SpaceContender> found;
    const auto add = [&found](std::vector<SpaceContender> some) {
        for (SpaceContender& contender : some)
            found.push_back(std::move(contender));
    };
#ifdef STYLOBATE_PEER_BULLET
    add(bullet_in_space());
#endif
#ifdef STYLOBATE_PEER_MUJOCO
    add(mujoco_in_space());
#endif
#ifdef STYLOBATE_PEER_ODE
    add(ode_in_space());
#endif
    add(own_in_space());
    return found;
}

} // namespace stylobate::peers
