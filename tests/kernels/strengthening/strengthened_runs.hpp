#pragma once
/// Realizations that are pushed by a known acceleration while they are watched, on the real kernel.

#include "studies/evidence/verification/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace stylobate::model {

/// Acceleration of a block by an external force, held for a chunk of steps.
struct Push {
    double x_m_s2 = 0, y_m_s2 = 0, theta_rad_s2 = 0;
};
/// Of a block, from a time on [s].
using PushAt = std::function<Push(int block, double time_s)>;
/// Called after each chunk with the displacements from the reference stack; false ends the run.
using WatchChunk = std::function<bool(double time_s, const Snapshot&)>;

/// Runs a realization under pushes, without other shaking.
/// @return its outcome if it came to its end
inline std::optional<Outcome> pushed(const Realization& realization, double duration_s, const PushAt& push,
                                     const WatchChunk& watch)
{
    Realization r = realization;
    r.with_mechanisms = true;
    const Study study = still(duration_s);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    double time = 0;
    while (!set.outcome(0)) {
        for (std::size_t b = 0; b < r.blocks.size(); ++b) {
            if (r.blocks[b].fixed)
                continue;
            const Push p = push(static_cast<int>(b), time);
            nudge(set, 0, static_cast<int>(b), p.x_m_s2, p.y_m_s2, p.theta_rad_s2);
        }
        set.advance();
        time += chunk_steps * r.step_s;
        if (set.outcome(0))
            break;
        Snapshot moved = set.snapshot(0);
        for (std::size_t b = 0; b < r.blocks.size(); ++b) {
            moved.x_m[b] -= r.blocks[b].x_m;
            moved.y_m[b] -= r.blocks[b].y_m;
        }
        if (!watch(time, moved))
            return std::nullopt;
    }
    return set.outcome(0);
}

/// A push that grows linearly from 0 to `most` at `duration_s`; the time at which `gone` first holds.
/// @param one the push of size 1, of block 1
inline double ramped(const Realization& r, double duration_s, double most, const Push& one,
                     const std::function<bool(const Snapshot&, double size)>& gone)
{
    double at = -1;
    pushed(
        r, duration_s,
        [&](int block, double time) {
            const double size = block == 1 ? most * time / duration_s : 0;
            return Push{size * one.x_m_s2, size * one.y_m_s2, size * one.theta_rad_s2};
        },
        [&](double time, const Snapshot& s) {
            const double size = most * time / duration_s;
            if (gone(s, size))
                at = size;
            return at < 0;
        });
    return at;
}

/// Horizontal acceleration that a block on a compliant bed bears, pressed by its weight and a constant force on its
/// axis whose line goes through the middle of the bed: the largest of (N (b - c / 3) - W h theta) / (m h) over the
/// rotation, with the pressed width c = sqrt(2 N / (K theta)).
inline double most_acceleration(const Stone& s, double K_n, double force)
{
    const double W = s.mass * gravity, N = W + force, h = 0.5 * s.height;
    const double theta = std::pow(N * std::sqrt(2 * N / K_n) / (6 * W * h), 2.0 / 3);
    return N * 0.5 * s.width / (s.mass * h) - 3 * gravity * theta;
}

} // namespace stylobate::model
