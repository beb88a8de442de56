#include "studies/evidence/verification/rocking_block.hpp"

#include <stdexcept>

namespace stylobate::verification {

namespace {

/// State after each step, from the start on, until `enough` says so.
template <class Enough>
void follow(const Realization& r, double limit_s, Enough enough, const ContactSpec& contact = {})
{
    Study study = model::still(limit_s + 1);
    study.contact = contact;
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    for (int n = 0; n * r.step_s < limit_s; ++n) {
        set.advance(n % chunk_steps, n % chunk_steps + 1);
        if (enough(n + 1, set.snapshot(0)))
            return;
    }
    throw std::runtime_error("the block did not come through the upright position in time");
}

double rate_of(const Realization& r, int block)
{
    const Block& b = r.blocks[static_cast<std::size_t>(block)];
    return std::sqrt(0.75 * r.gravity_m_s2 / std::hypot(b.half_width_m, b.half_height_m));
}

} // namespace

Realization leaned_block(const model::Stone& stone, double K_n, double part, double step_rate, double xi)
{
    const model::Bed bed{K_n, xi, 5, true};
    Realization r = model::single(stone, bed, step_rate / model::bed_rate(bed, stone), 2 * stone.width);
    r.initial_tilt_rad = part * model::slenderness(stone);
    return r;
}

double upright_time(const Realization& r, const std::vector<int>& blocks)
{
    double before = r.initial_tilt_rad, time = 0;
    follow(r, 5 / rate_of(r, blocks.front()), [&](int n, const Snapshot& state) {
        double now = 0;
        for (const int b : blocks)
            now += state.theta_rad[static_cast<std::size_t>(b)] / static_cast<double>(blocks.size());
        time = r.step_s * (n - 1 + before / (before - now));
        before = now;
        return now <= 0;
    });
    return time;
}

double impact_restitution(const Realization& r, const ContactSpec& contact)
{
    const Block& b = r.blocks[1];
    const double alpha = std::atan(b.half_width_m / b.half_height_m);
    double lowest = 0;
    follow(
        r, 8 / rate_of(r, 1),
        [&](int, const Snapshot& state) {
            const double now = state.theta_rad[1];
            const bool turned = lowest < -1e-3 * alpha && now > lowest;
            lowest = std::min(lowest, now);
            return turned;
        },
        contact);
    const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
    return std::sqrt(energy(-lowest) / energy(r.initial_tilt_rad));
}

} // namespace stylobate::verification
