#include "kernels/instances/instantiate.hpp"
#include "kernels/soft_wide.hpp"

namespace stylobate {

namespace {

struct Here {};

// Only the paper's model has its multiply-adds where they are used: those of all models would make five times the code.
void run(const Topology& topology, const Bundle& bundle, int first, int last)
{
    if (!topology.model.mechanisms && topology.model.form == ContactForm::area)
        run_steps<SoftWide, OfFile<Here, Baseline>>(topology, bundle, first, last);
    else
        run_model<SoftWideBy<true>, Here>(topology, bundle, first, last);
}

constexpr KernelTable wasm_table()
{
    KernelTable table = kernel_table<SoftWideBy<true>, float, Here>(Isa::wasm);
    table.fill = fill_base_table<SoftWide, Here>;
    table.peak_fma = peak_fma<SoftWide, Here>;
    table.planar.run = run;
    return table;
}

} // namespace

extern const KernelTable wasm_kernels = wasm_table();

} // namespace stylobate
