#pragma once
/// The motions of the bases of a bundle's lanes, in one or several channels: parameters of their formula, and the
/// tables of the next chunk.

#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "kernels/isa.hpp"

#include <array>
#include <span>
#include <vector>

namespace stylobate {

class LaneBases {
public:
    /// @param channels motions that a base has   @param twice whether the bundle has two registers
    LaneBases(const Study& study, const KernelTable& kernels, int channels, int lanes, bool twice);

    /// Takes over the motions of a lane's base.
    /// @param motions (channels)
    void store(int lane, std::span<const BaseMotion> motions);
    /// An empty lane has a base at rest.
    void clear(int lane);
    /// Number of the step with which a lane's next chunk begins.
    double& first_step(int lane) { return first_step_[lane]; }
    double first_step(int lane) const { return first_step_[lane]; }

    /// Whether `BaseMotion::fill` makes the tables, lane by lane; else one of the two below makes those of all lanes.
    bool on_host() const { return on_host_; }
    void fill(int channel, double* table) const
    {
        (twice_ ? kernels_.fill_twice : kernels_.fill)(formula_, parameters(channel), first_step_, table);
    }
    void fill(int channel, float* table) const
    {
        kernels_.fill_single(formula_, parameters(channel), first_step_, table);
    }
    /// Second differences of one base's displacement [m], for `chunk_steps` steps from one of the realization's own on.
    std::array<double, chunk_steps> chunk(const BaseMotion& motion, double first_step) const;

    const FormulaParameters& parameters(int channel) const { return parameters_[static_cast<std::size_t>(channel)]; }

private:
    const KernelTable& kernels_;
    const MotionFormula formula_;
    const bool on_host_, twice_;
    AlignedArray<double> memory_;
    std::vector<FormulaParameters> parameters_; ///< (channels)
    double* first_step_ = nullptr;
};

} // namespace stylobate
