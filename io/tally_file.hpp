#pragma once
/// The part of a results file that holds counts instead of rows.

#include "io/hdf5.hpp"
#include "io/result_store.hpp"
#include "io/tally.hpp"

#include <cstdint>
#include <map>

namespace stylobate {

/// Chunks of realizations that are counted, as intervals: as many as there are gaps, which are as many at most as
/// realizations are stepped at the same time, and one.
class ChunkSet {
public:
    bool has(std::uint64_t chunk) const;
    /// @pre !has(chunk)
    void add(std::uint64_t chunk);
    /// Begin and end of each interval, in order, apart from each other.
    const std::map<std::uint64_t, std::uint64_t>& intervals() const { return intervals_; }
    /// Adds chunks begin to end - 1. @returns false if they do not lie behind all others
    bool append(std::uint64_t begin, std::uint64_t end);

private:
    std::map<std::uint64_t, std::uint64_t> intervals_;
};

struct TallyFile {
    Tally tally;
    ChunkSet done;
};

/// Realizations in a chunk; the last one has the rest.
std::uint64_t realizations_in(std::uint64_t chunk, const ResultHeader& header);

void write_tally(hid_t file, const ResultHeader& header, const TallyFile& counted);
/// @throws hdf5::Error if something is missing, has another shape, or does not fit the rest
TallyFile read_tally(hid_t file, const ResultHeader& header);

} // namespace stylobate
