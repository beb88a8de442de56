#include "ensemble/engine/lane_bases.hpp"

namespace stylobate {

LaneBases::LaneBases(const Study& study, const KernelTable& kernels, int lanes, bool twice)
    : kernels_(kernels), formula_(BaseMotion::formula(study.excitation.kind)), on_host_(BaseMotion::on_host(study)),
      twice_(twice), memory_(aligned_array<double>(9 * static_cast<std::size_t>(lanes)))
{
    double* p = memory_.get();
    for (double** array : {&parameters_.cycles_per_step, &parameters_.amplitude_m, &parameters_.cycles,
                           &parameters_.phase_cycles, &parameters_.offset, &parameters_.start_ramps_per_cycle,
                           &parameters_.end_ramps_per_cycle, &parameters_.end_velocity, &first_step_}) {
        *array = p;
        p += lanes;
    }
}

void LaneBases::clear(int lane)
{
    store(lane, BaseMotion{});
    // an empty lane must not divide by a rate of zero
    parameters_.cycles_per_step[lane] = 1;
    first_step_[lane] = 0;
}

std::array<double, chunk_steps> LaneBases::chunk(const BaseMotion& motion, double first_step) const
{
    std::array<double, chunk_steps> table{};
    if (on_host_) {
        motion.fill(first_step, table.data(), 1);
        return table;
    }
    std::array<double, 8> values{};
    const FormulaParameters one{&values[0], &values[1], &values[2], &values[3],
                                &values[4], &values[5], &values[6], &values[7]};
    motion.store(one, 0);
    stylobate::kernels(Isa::scalar).fill(formula_, one, &first_step, table.data());
    return table;
}

} // namespace stylobate
