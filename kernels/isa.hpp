#pragma once
/// The kernels of one instruction set behind plain function pointers, and the choice of one at run time.

#include "kernels/base_motion.hpp"
#include "kernels/planar/bundle.hpp"
#include "kernels/spatial/bundle.hpp"

#include <string_view>
#include <vector>

namespace stylobate {

enum class Isa { scalar, avx2, avx512, neon, wasm };

/// The planar model's step.
struct PlanarKernels {
    /// Runs steps `first` to `last - 1` of the table of base motion, after the topology's model.
    void (*run)(const Topology&, const Bundle&, int first, int last) = nullptr;
    /// `run` in single precision, for the paper's model and rigid blocks alone.
    void (*run_single)(const Topology&, const BundleOf<float>&, int first, int last) = nullptr;
    /// Two registers of realizations at a time (`twice.hpp`), for a stack of the paper's model without watched pairs:
    /// null where that is not built in. It is faster up to this number of free blocks.
    int twice_blocks = 0;
    void (*run_twice)(const Topology&, const Bundle&, int first, int last) = nullptr;
};

/// The spatial model's step.
struct SpatialKernels {
    /// Runs steps `first` to `last - 1` of the tables of base motion.
    void (*run)(const spatial::Topology&, const spatial::Bundle&, int first, int last) = nullptr;
};

struct KernelTable {
    Isa isa = Isa::scalar;
    int lanes = 1;        ///< realizations in a register
    int single_lanes = 1; ///< realizations in a register of single precision
    /// Fills a bundle's table of base motion by formula, for every model.
    void (*fill)(MotionFormula, const FormulaParameters&, const double* first_step, double* table) = nullptr;
    /// `fill` of a bundle in single precision.
    void (*fill_single)(MotionFormula, const FormulaParameters&, const double* first_step, float* table) = nullptr;
    /// Multiply-adds on registers, `count` of them: the peak of the machine. Returns a number, so that none is removed.
    double (*peak_fma)(long count) = nullptr;
    PlanarKernels planar{};
    SpatialKernels spatial{};
    /// `fill` of a bundle of two registers: null where `planar.run_twice` is.
    void (*fill_twice)(MotionFormula, const FormulaParameters&, const double* first_step, double* table) = nullptr;
};

const char* to_string(Isa isa);
/// "scalar", "avx2", "avx512", "neon" or "wasm"; false for any other word.
bool parse_isa(std::string_view name, Isa& isa);

/// The instruction sets that are built in and that this processor has, narrowest first.
std::vector<Isa> usable_isas();
inline Isa best_isa()
{
    return usable_isas().back();
}
/// @pre isa is usable
const KernelTable& kernels(Isa isa);

} // namespace stylobate
