#pragma once
/// What chance gives: the evidence of campaigns with nothing hidden, kept in a file so that it is made once for a
/// specimen and its motions, and so that an interrupted diagnosis goes on.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "studies/diagnosis/decision/evidence.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stylobate {

struct ChanceOptions {
    std::uint64_t campaigns = 32;
    std::uint64_t seed = 1;
    std::filesystem::path cache; ///< empty: none
    bool windows = false;        ///< whether windows judge causes too
    RunOptions run;
};

struct Chance {
    ChanceGains gains;
    std::vector<std::string> contacts; ///< of each campaign, in words
    std::uint64_t campaigns = 0;
    std::uint64_t cached = 0; ///< of them from the file
    std::uint64_t simulations = 0, window_simulations = 0, block_steps = 0;
    bool complete = false; ///< false: the observer stopped it
};

/// @param told called after each campaign, and once before if some are in the cache: how many there are, and how many
/// of them were in the cache
Chance chance_of(const Campaign& campaign, const Study& study, const ChanceOptions& options,
                 const std::function<void(std::uint64_t done, std::uint64_t cached)>& told, Observer& observer);

/// What a specimen, its motions and its cameras are known by: changes of anything else leave the cache valid.
std::string chance_key(const Campaign& campaign, const Study& study, const ChanceOptions& options);

} // namespace stylobate
