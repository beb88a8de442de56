#pragma once
/// The horizontal motion of the bases of a bundle's lanes: parameters of its formula, and the table of the next chunk.

#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "kernels/isa.hpp"

#include <array>

namespace stylobate {

class LaneBases {
public:
    /// @param twice whether the bundle has two registers
    LaneBases(const Study& study, const KernelTable& kernels, int lanes, bool twice);

    /// Takes over the motion of a lane's base.
    void store(int lane, const BaseMotion& motion) { motion.store(parameters_, lane); }
    /// An empty lane has a base at rest.
    void clear(int lane);
    /// Number of the step with which a lane's next chunk begins.
    double& first_step(int lane) { return first_step_[lane]; }
    double first_step(int lane) const { return first_step_[lane]; }

    /// Whether `BaseMotion::fill` makes the tables, lane by lane; else one of the two below makes those of all lanes.
    bool on_host() const { return on_host_; }
    void fill(double* table) const
    {
        (twice_ ? kernels_.fill_twice : kernels_.fill)(formula_, parameters_, first_step_, table);
    }
    void fill(float* table) const { kernels_.fill_single(formula_, parameters_, first_step_, table); }
    /// Second differences of one base's displacement [m], for `chunk_steps` steps from one of the realization's own on.
    std::array<double, chunk_steps> chunk(const BaseMotion& motion, double first_step) const;

    const FormulaParameters& parameters() const { return parameters_; }

private:
    const KernelTable& kernels_;
    const MotionFormula formula_;
    const bool on_host_, twice_;
    AlignedArray<double> memory_;
    FormulaParameters parameters_{};
    double* first_step_ = nullptr;
};

} // namespace stylobate
