#include "ensemble/motion/repeated_motion.hpp"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace stylobate {

Motion repeated_motion(std::span<const Motion> events, double pause_s)
{
    assert(!events.empty() && "a past without an event has no motion");
    const Motion& first = events.front();
    const auto pause = static_cast<std::size_t>(std::ceil(pause_s / first.dt_s));
    std::vector<double> acceleration;
    for (const Motion& event : events) {
        assert(event.dt_s == first.dt_s && "events have one spacing of samples");
        if (!acceleration.empty())
            acceleration.resize(acceleration.size() + pause);
        acceleration.insert(acceleration.end(), event.acceleration_m_s2.begin(), event.acceleration_m_s2.end());
    }
    Motion motion = motion_of(std::move(acceleration), first.dt_s);
    motion.pga_m_s2 = first.pga_m_s2; // by which it is scaled
    motion.predominant_frequency_hz = first.predominant_frequency_hz;
    motion.source = first.source;
    return motion;
}

} // namespace stylobate
