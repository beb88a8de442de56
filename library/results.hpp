#pragma once
/// What a `Result` holds.

#include "io/store/result_store.hpp"
#include "library/inside.hpp"
#include "studies/experiment/limit_state.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate::api {

struct Result::Data {
    /// @param file its name in messages
    Data(const inner::ResultReader& reader, const std::string& file);

    inner::ResultHeader header;
    inner::Study study;
    std::string name; ///< in messages
    bool complete = false;
    std::uint64_t done = 0, invalid = 0;
    inner::LimitCounts limits;
    std::vector<Outcome> outcomes;             ///< by index
    std::vector<inner::SurfaceTable> surfaces; ///< of each limit state; empty for other kinds
    inner::RareTable rare;
    inner::FragilityTable fragility;
};

} // namespace stylobate::api
