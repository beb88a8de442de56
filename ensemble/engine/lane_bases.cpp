#include "ensemble/engine/lane_bases.hpp"

namespace stylobate {

LaneBases::LaneBases(const Study& study, const KernelTable& kernels, int channels, int lanes, bool twice)
    : kernels_(kernels), formula_(BaseMotion::formula(study.excitation.kind)), on_host_(BaseMotion::on_host(study)),
      twice_(twice), memory_(aligned_array<double>(static_cast<std::size_t>((8 * channels + 1) * lanes))),
      parameters_(static_cast<std::size_t>(channels))
{
    double* p = memory_.get();
    const auto take = [&](double*& array) {
        array = p;
        p += lanes;
    };
    for (FormulaParameters& of : parameters_) {
        for (double** array : {&of.cycles_per_step, &of.amplitude_m, &of.cycles, &of.phase_cycles, &of.offset,
                               &of.start_ramps_per_cycle, &of.end_ramps_per_cycle, &of.end_velocity})
            take(*array);
        if (first_step_ == nullptr) // behind those of the first channel, as a device reads them
            take(first_step_);
    }
}

void LaneBases::store(int lane, std::span<const BaseMotion> motions)
{
    for (std::size_t i = 0; i < parameters_.size(); ++i)
        motions[i].store(parameters_[i], lane);
}

void LaneBases::clear(int lane)
{
    for (const FormulaParameters& of : parameters_) {
        BaseMotion{}.store(of, lane);
        of.cycles_per_step[lane] = 1; // an empty lane must not divide by a rate of zero
    }
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
