#include "kernels/fused_steps.hpp"
#include "kernels/instances/instantiate.hpp"
#include "kernels/soft_wide.hpp"

#include <algorithm>
#include <vector>

namespace stylobate {

FusedSteps fused_steps;

namespace {

struct Here {};

/// The state of a bundle, kept to be restored.
class KeptState {
public:
    KeptState(const Topology& topology, const Bundle& bundle)
        : state_(bundle.rows<OfBlock::Field>()),
          numbers_((bundle_registers(topology) - table_registers(topology)) * static_cast<std::size_t>(bundle.lanes))
    {
        memory_.assign(state_, state_ + numbers_);
    }
    void restore() const { std::copy(memory_.begin(), memory_.end(), state_); }

private:
    double* state_;
    std::size_t numbers_;
    static inline std::vector<double> memory_; // of the one thread
};

// The paper's model is stepped without the library, and once more with it where that is needed.
void run(const Topology& topology, const Bundle& bundle, int first, int last)
{
    if (fused_steps.planar != nullptr)
        return fused_steps.planar(&topology, &bundle, first, last);
    if (!topology.model.mechanisms && topology.model.form == ContactForm::area) {
        const KeptState before(topology, bundle);
        soft::Noted::unsure = {};
        run_steps<SoftWideBy<soft::Noted>, OfFile<Here, Baseline>>(topology, bundle, first, last);
        if (!soft::Noted::any_unsure())
            return;
        before.restore();
    }
    run_model<SoftWide, Here>(topology, bundle, first, last);
}

void run_spatial(const spatial::Topology& topology, const spatial::Bundle& bundle, int first, int last)
{
    if (fused_steps.spatial != nullptr)
        return fused_steps.spatial(&topology, &bundle, first, last);
    spatial::run_steps<SoftWide, Here>(topology, bundle, first, last);
}

constexpr KernelTable wasm_table()
{
    KernelTable table = kernel_table<SoftWide, float, Here>(Isa::wasm);
    table.planar.run = run;
    table.spatial.run = run_spatial;
    return table;
}

} // namespace

extern const KernelTable wasm_kernels = wasm_table();

} // namespace stylobate
