#pragma once
/// The pictures of a results file: what `export` writes and `report` shows.

#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"
#include "studies/experiment/limit_state.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// What pictures and pages of the results are called: the study's title, or else the file's name without its ending.
std::string title_of(const ResultReader& reader, const std::string& results);

/// @throws InputError if the run is not complete
void check_complete(const ResultReader& reader, const std::string& results);

/// @throws InputError if its realizations cannot be run one by one
void check_replayable(const ResultHeader& header, const std::string& results);

/// Whether the realizations were followed beyond the first fall.
bool followed_to_rest(const ResultReader& reader, const std::string& results);

/// Whether the results are complete ones of a surface with twins.
bool has_twins(const ResultReader& reader, const std::string& results);

/// All rows but those of twins, which are no further trials; of a replayed twin its own.
std::vector<ResultRow> original_rows(const ResultReader& reader, const std::string& results);

/// The surface of the store, or that of another limit state from the rows. Of a run that is not complete, that of the
/// realizations that were begun first and have all ended: none of them is missing because it takes long.
/// @throws InputError if there is none, or if the limit state was not followed
SurfaceTable surface_so_far(const ResultReader& reader, const std::string& results, LimitState limit);

/// What the title of a surface says where the run is not complete: of how many realizations it is; else empty.
std::string partial_words(const ResultReader& reader, const std::string& results, const SurfaceTable& surface);

/// @throws InputError if there are none, or if the run is not complete
SensitivityTable finished_sensitivity(const ResultReader& reader, const std::string& results);

/// @throws InputError as above
RareTable finished_rare(const ResultReader& reader, const std::string& results);

/// How a picture runs a realization again whose trajectory the file does not hold.
struct Rerun {
    std::vector<std::string> settings; ///< KEY=VALUE: where the record lies now
    Isa isa;
};

/// One realization over time: from the file's trajectory, or else run again.
/// @param title empty: by the results, the realization and what became of it
/// @throws InputError if there is no such realization, and as `plot_strip` does
void strip_picture(const Rerun& rerun, const ResultReader& reader, const std::string& results, std::uint64_t index,
                   const std::string& title, const std::filesystem::path& file);

/// Which blocks fall, in which order and when.
/// @param cell of a surface; -1: all realizations
/// @param title empty: by the results and the cell
/// @throws InputError if there is no such cell, if the run is not complete, and as `plot_order` does
void order_picture(const ResultReader& reader, const std::string& results, long long cell, const std::string& title,
                   const std::filesystem::path& file);

} // namespace stylobate
