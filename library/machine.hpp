#pragma once
/// On what to run.

#include "ensemble/engine/executor.hpp"

#include <string>

namespace stylobate::api {

/// @param threads 0: as many as the process may use   @param simd "auto", or an instruction set
/// @throws stylobate::InputError if this machine lacks it
stylobate::RunOptions run_options(int threads, const std::string& simd);

} // namespace stylobate::api
