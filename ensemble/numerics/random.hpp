#pragma once
/// Random numbers that are a pure function of their use, without state: they depend neither on order nor on threads.
///
/// Philox4x64-10 of Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", Proceedings of the
/// International Conference for High Performance Computing, Networking, Storage and Analysis (2011), from Random123:
/// the key is (seed, realization index), the counter is (stream, element, 0, 0), and the first of the four words is the
/// draw.

#include <cstdint>

namespace stylobate {

/// The purpose of a draw. Numbers are permanent: a new entry takes a new number and none is reused, or the realizations
/// of every older study would change. 0 to 63 are for the perturbed quantities of a study, 128 to 1023 for the
/// parameters of its mechanisms.
enum class Stream : std::uint64_t {
    friction = 0,             ///< coefficient of friction; element = joint, from the bottom
    normal_stiffness = 1,     ///< K_N; element = joint
    tangential_stiffness = 2, ///< K_T; element = joint
    damping_ratio = 3,        ///< damping ratios of the dashpots; element = 0
    drum_width = 4,           ///< B; element = block, from the bottom
    drum_height = 5,          ///< H; element = block
    drum_offset = 6,          ///< horizontal offset of a drum; element = block
    density = 7,              ///< mass at given sizes; element = block
    tilt = 8,                 ///< tilt of the base; element = 0
    phase = 9,                ///< phase of the harmonic or pulse; element = 0
    pulse_frequency = 10,     ///< of a velocity pulse; element = 0
    pulse_gamma = 11,         ///< oscillatory character of a velocity pulse; element = 0
    drum_offset_z = 12,       ///< offset of a drum along z, in space; element = block
    tilt_x = 13,              ///< tilt of the base about x, in space; element = 0
    direction = 14,           ///< of the shaking in space; element = 0
    base_noise = 64,          ///< white noise of a synthetic earthquake; element = sample
    mean_peak = 65,           ///< white noise of the motions by which a mean peak is found; index = motion, from 0
    virtual_specimen = 66,    ///< contacts and scatter of a campaign with nothing hidden; index = campaign
    virtual_placement = 67,   ///< where its blocks are put; index = campaign
    camera_noise = 68,        ///< of its cameras; index = campaign x runs + run
    bootstrap = 69,           ///< which runs are resampled for an interval; index = resample, element = draw
    scramble = 70, ///< of Sobol points; index = cell, element = dimension x 2^32 + 2^digit + the digits before
    twin = 71,     ///< displacement of perturbed replicas of a fragility study; element = block
    subset = 72,   ///< of subset simulation; index = simulation x 2^32 + evaluation, element = number of the point;
                   ///< element 2^32 of the first evaluation of a level: which samples begin its chains
    sequence = 73, ///< which records follow a record; index = record, element = place in the sequence
    years = 74, ///< earthquakes of simulated years; index = history, element 0: their number, 3 i + 1 to 3 i + 3: time,
                ///< intensity and motion of earthquake i; from 2^32 on the same of those below the threshold
    past = 75,  ///< likelihoods that a count allows; index = cell, element = place of a draw in their order
    monument = 76,         ///< simulated monuments; index = monument, element = number of the draw
    structure = 77,        ///< seed of another structure of a site; index = its number, element = 0
    second_noise = 78,     ///< white noise of the second horizontal component; element = sample
    vertical_noise = 79,   ///< white noise of the vertical component; element = sample
    second_mean_peak = 80, ///< second components of the motions by which a mean peak is found; index = motion, from 0
    joint_test_placement = 81, ///< where the body of a simulated test is put; index = of subject and run
    joint_test_noise = 82,     ///< of the sensors of a simulated test; index likewise
    predicted_test = 90, ///< estimates of a test of a single joint that a belief predicts; index = draw, element 0: the
                         ///< hypothesis, 1: the radius, from 2^20 on: columns, from 2^21 on: spread of a hypothesis
    /// Parameter p of mechanism m (`ensemble/model/mechanism_spec.hpp`) has stream 128 + 8 m + p, up to 1023; element =
    /// joint or block, 0 of the base and of what is drawn once.
    mechanisms = 128
};

/// 64 random bits. Draws for the structure as a whole use element 0.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element);

/// The number in the open interval (0, 1) of 64 random bits: an odd multiple of 2^-53, each equally likely. Never 0 or
/// 1, exact in double, and so is its complement 1 - u, which is on the same grid.
double to_uniform01(std::uint64_t bits);

/// The standard normal number below which a part `u` of the distribution lies: algorithm AS 241 (PPND16) of Wichura,
/// "The percentage points of the normal distribution", Applied Statistics 37 (1988). Relative error below 1e-15; ten
/// times as fast as the quantile of Boost.Math: for draws by the million, as the noise of cameras.
/// @pre 0 < u < 1
double to_normal(double u);

/// Of `random_bits`.
double uniform01(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element);

} // namespace stylobate
