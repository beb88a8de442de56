#include "tests/hidden/sensors.hpp"

#include <limits>

namespace stylobate::hidden {

void add_noise(Series& series, double sd, Draws& draws)
{
    for (double& value : series.values)
        value += sd * draws.normal();
    series.noise_sd = sd;
}

SeenMotion by_cameras(const std::vector<const BodyState*>& places, double zero_m, const Planned& planned,
                      Draws& cameras)
{
    const double missing = std::numeric_limits<double>::quiet_NaN();
    SeenMotion motion;
    for (const BodyState* place : places) {
        motion.x_m.values.push_back(place ? place->x + zero_m : missing);
        motion.y_m.values.push_back(place ? place->y : missing);
        motion.theta_rad.values.push_back(place ? place->theta : missing);
    }
    add_noise(motion.x_m, planned.camera_m, cameras);
    add_noise(motion.y_m, planned.camera_m, cameras);
    add_noise(motion.theta_rad, planned.camera_rad, cameras);
    return motion;
}

} // namespace stylobate::hidden
