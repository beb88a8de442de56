#pragma once
/// The ranks that this process was started with (`mpirun`, `srun`).

#include "ensemble/run/ranks.hpp"

#include <memory>
#include <optional>
#include <string>

namespace stylobate {

/// Alone it is one rank. @throws InputError if this program was built without MPI
std::unique_ptr<Ranks> mpi_ranks();

/// The MPI that this program was built with, such as "Open MPI v4.1.4"; nullopt: none.
std::optional<std::string> mpi_library();

} // namespace stylobate
