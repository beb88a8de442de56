#pragma once
/// Results files of parts of a study: shards, runs that were interrupted, and parts that were joined before.

#include "ensemble/numerics/run_order.hpp"
#include "io/store/result_store.hpp"
#include "studies/kinds/kind.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A file, and what it has.
struct ShardFile {
    std::string file;
    Shard shard;  ///< that it is meant for; all: it is itself joined, or a run that was interrupted
    DoneSet done; ///< by places in the order of the run
};

/// @throws InputError if it is no unfinished results file of a study with shards
void check_is_part(const ResultReader& reader, const std::string& file);

/// @param header of the study
/// @throws InputError if it is no part of this study, or of another version
ShardFile read_shard_file(const std::string& file, const ResultHeader& header);

/// All that the files have together.
/// @throws InputError if two of them have the same realization
DoneSet joined(const std::vector<ShardFile>& files, const RunOrder& order);

/// A message of what is missing, with the commands that compute it.
/// @param done, total realizations that there are, and of the study
std::string missing_text(const std::vector<ShardFile>& files, const Kind& kind, std::uint64_t done,
                         std::uint64_t total);

} // namespace stylobate
