#pragma once
/// What several processes do together at the command line: one message for what all of them would report, one exit
/// status.

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "ensemble/run/ranks.hpp"

#include <optional>
#include <stdexcept>
#include <string>

namespace stylobate {

/// All ranks have been refused by what one of them found in the input.
struct AllRefused : std::runtime_error {
    using runtime_error::runtime_error;
};

/// Does what may be refused, on all ranks.
/// @param ranks null: this process is alone
/// @throws AllRefused on every rank, if f threw an InputError on any; alone, what f throws
template <class F>
void together(Ranks* ranks, const F& f)
{
    if (!ranks)
        return f();
    std::optional<std::string> refusal;
    try {
        f();
    } catch (const InputError& error) {
        refusal = error.what();
    }
    if (const auto first = first_said(*ranks, refusal))
        throw AllRefused(*first);
}

/// The part of what is done once that falls to this rank.
inline Shard part_of(const Ranks& ranks)
{
    return {static_cast<std::uint64_t>(ranks.rank()) + 1, static_cast<std::uint64_t>(ranks.size())};
}

} // namespace stylobate
