#pragma once
/// Steps that WebAssembly may find at run time, in a module of its own: with the processor's multiply-adds.

#include "kernels/planar/bundle.hpp"
#include "kernels/spatial/bundle.hpp"

namespace stylobate {

/// Null where there are none; else they take the place of those of `instances/step_wasm.cpp`, with the same bits.
struct FusedSteps {
    void (*planar)(const Topology*, const Bundle*, int first, int last) = nullptr;
    void (*spatial)(const spatial::Topology*, const spatial::Bundle*, int first, int last) = nullptr;
};
extern FusedSteps fused_steps;

} // namespace stylobate
