#pragma once
/// Random numbers of a virtual campaign: a pure function of its seed, of what they are for, and of their order there.

#include "ensemble/numerics/random.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace stylobate::hidden {

/// What a sequence of draws is for. They lie above the streams of the ensemble and, like those, are never renumbered.
enum class Draw : std::uint64_t {
    plan = 2000,           ///< law, specimen, what is hidden
    making = 2001,         ///< friction, widths and masses of the specimen as it was made
    law = 2002,            ///< parameters of the healthy contact law
    effect = 2003,         ///< place and strength; index = effect
    motion = 2004,         ///< of the table; index = motion
    placement = 2005,      ///< by hand; index = run
    cameras = 2006,        ///< noise; index = run
    table = 2007,          ///< noise and zero of the table's sensors; index = run
    trial = 2008,          ///< amplitudes; index = motion
    scatter = 2009,        ///< the scatter that an effect is compared with; index = run
    friction = 2010,       ///< how far the friction is from the nominal one, where that is wished for
    test_placement = 2011, ///< of a test on a joint, by hand; index = test
    test_cameras = 2012,   ///< noise; index = test
    test_table = 2013,     ///< noise and zero of the table's sensors and the inclinometer; index = test
    test_gauge = 2014,     ///< noise and gain of the force gauges; index = test
    test_release = 2015,   ///< how level hands hold a body; index = test
    callipers = 2016       ///< noise of what is measured at rest; index = measurement
};

/// One sequence. Copies go on independently from where they are.
class Draws {
public:
    Draws(std::uint64_t seed, Draw what, std::uint64_t index = 0)
        : seed_(seed), index_(index), stream_(static_cast<Stream>(what))
    {
    }

    double uniform() { return uniform01(seed_, index_, stream_, element_++); }
    double uniform(double from, double to) { return from + (to - from) * uniform(); }
    /// Uniform in the logarithm. @pre 0 < from <= to
    double log_uniform(double from, double to) { return from * std::exp(uniform() * std::log(to / from)); }
    /// Standard normal, by Box and Muller's transform.
    double normal()
    {
        const double radius = std::sqrt(-2 * std::log(uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }
    /// 0 to n - 1. @pre n > 0
    int below(int n) { return static_cast<int>(uniform() * n); }
    bool chance(double probability) { return uniform() < probability; }
    double sign() { return chance(0.5) ? 1 : -1; }

private:
    std::uint64_t seed_, index_;
    Stream stream_;
    std::uint64_t element_ = 0;
};

} // namespace stylobate::hidden
