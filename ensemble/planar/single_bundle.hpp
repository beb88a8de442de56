#pragma once
/// The bundle that is stepped in single precision, behind a bundle in double precision for the host.
///
/// The host writes realizations into the bundle in double precision and reads them there, as ever: `take` rounds what
/// it has written, `run` steps in single precision and gives back what a termination check of a realization needs.
/// Displacements and increments go in, and displacements come out, with their remainders: with about 48 binary digits.
/// The sums over time of slip, paths and works are kept in double precision: those of the steps between two checks are
/// added to them at the check.

#include "ensemble/numerics/aligned.hpp"
#include "kernels/isa.hpp"

namespace stylobate {

class SingleBundle {
public:
    /// @param topology, host must outlive this object; the host's bundle has `kernels.single_lanes` lanes
    SingleBundle(const Topology& topology, const Bundle& host, const KernelTable& kernels);

    /// Takes a lane over from the host's bundle, where it has been cleared or has got a realization.
    void take(int lane);
    /// Takes the host's table of base motion.
    void take_base();
    /// Where a table that is made by formula goes instead.
    float* base_table() const { return own_.rows<OfBase::Field>(); }
    /// Steps `first` to `last - 1` of a chunk; then the host's bundle has what they did.
    void run(int first, int last);

private:
    const Topology& topology_;
    const Bundle& host_;
    const KernelTable& kernels_;
    AlignedArray<float> memory_;
    BundleOf<float> own_;
};

} // namespace stylobate
