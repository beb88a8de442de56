#pragma once
/// The sums over a realization whose blocks and beds are spread over lanes, with the bits of those of `Stepper`.
///
/// There each sum adds up bed by bed, step by step. Here each lane leaves the factors of its bed in shared memory, and
/// a lane for each sum makes the chain, of one step while the next one is computed. What a chain does not use is 0 x 0
/// or 0 x 1, which changes no bit. The base's work starts anew in every step: lane j makes the momentum of the j-th of
/// as many steps as the group has lanes.

#include "kernels/lanes/warp.hpp"
#include "kernels/planar/bed.hpp"
#include "kernels/planar/bundle.hpp"

#include <type_traits>

namespace stylobate {

namespace detail {

/// Of structures whose forces are added up by lists (`lane_list.hpp`), and which have watched pairs.
struct ListMemory {
    struct alignas(16) Load { ///< of a bed (`BedLoad`)
        double x, y, upper_moment, lower_moment;
    };
    struct alignas(16) BlockAt { ///< in this step
        double sine, versine, theta, x, y;
        double dx, dy, dtheta;
    };
    struct alignas(16) PairLoad { ///< of a pair on its blocks, and what it adds to the sums
        double x, y, upper_moment, lower_moment;
        double first_factor[3], second_factor[3]; ///< of dashpot, shear and friction energy
        long lower, upper; ///< lanes of the warp that own the blocks; -1: the pair does not touch
    };
    Load load[warp_lanes];
    BlockAt block[warp_lanes];
    PairLoad pair[warp_lanes];
};
struct NoLists {};

} // namespace detail

/// What the lanes of a warp share.
/// @tparam width lanes of a group, each group having one realization
/// @tparam lists whether forces are added up by lists
template <int width, bool lists>
struct WarpMemory : std::conditional_t<lists, detail::ListMemory, detail::NoLists> {
    static constexpr int groups = (warp_lanes - 1) / width;
    static constexpr int base_row = chunk_steps + 5; // odd, so that groups are in different banks

    /// What the sums are made of, of one bed in one step. (80 bytes: no two lanes of a quarter warp share a bank.)
    enum Factor : int { closing, dashpot, sliding, shear, slip, limit, turning, one, factors = 10 };
    struct alignas(16) Factors {
        double of[factors];
    };

    struct Sums {
        double moved[width][warp_lanes];     ///< motion in the last steps, for the momentum
        double pushed[groups + 1][width][2]; ///< momentum, and twice the base's mean motion, in the same steps
        double audit[3][warp_lanes];         ///< of the last step of a chunk
    };
    double base[groups + 1][base_row]; ///< [0] of the step before the chunk; the last row, of the lanes at rest: 0
    Factors factor[2][warp_lanes];     ///< of even and odd steps
    double mass[warp_lanes], inertia[warp_lanes];
    union {
        double displacement[groups][base_row]; ///< of the base, while its table is made
        Sums sums;                             ///< while the chunk is stepped
    };
};

template <class W, int width, bool lists>
class LaneSums {
public:
    using Real = typename W::Real;
    template <class T>
    using Each = typename W::template Each<T>;
    using Memory = WarpMemory<width, lists>;
    static constexpr int groups = Memory::groups;

    STYLOBATE_LANES LaneSums(const W& warp, Memory& shared) : w_(warp), shared_(shared)
    {
        w_.each([&](int lane) {
            const bool in_group = lane < groups * width;
            group_[lane] = in_group ? lane / width : groups;
            number_[lane] = in_group ? lane % width : 0;
            for (int n = 0; n < own_sums; ++n) {
                first_[n][lane] = first_factor(own_sum(number_[lane], n));
                second_[n][lane] = second_factor(own_sum(number_[lane], n));
            }
        });
    }

    STYLOBATE_LANES const Each<int>& group() const { return group_; }
    /// Of the lane in its group.
    STYLOBATE_LANES int number(int lane) const { return number_[lane]; }
    /// After a chunk, in every lane of the realization: 2 dt2 x its kinetic and dt2 x its potential energy.
    STYLOBATE_LANES double kinetic(int lane) const { return kinetic_[lane]; }
    STYLOBATE_LANES double potential(int lane) const { return potential_[lane]; }

protected:
    /// The sums over a realization that have a chain of their own, and how many of them a lane makes: sums j,
    /// j + width and so on are lane j's.
    enum Sum : int { dashpot_energy, shear_energy, friction_energy, slip_sum, path, rocking_path, sums };
    static constexpr int own_sums = (sums + width - 1) / width;
    static_assert(!lists || own_sums == 1);
    STYLOBATE_LANES static constexpr int own_sum(int number, int n) { return number + n * width; }
    STYLOBATE_LANES static OfRealization::Field sum_field(int k)
    {
        return k == dashpot_energy    ? OfRealization::dashpot_energy
               : k == shear_energy    ? OfRealization::shear_energy
               : k == friction_energy ? OfRealization::friction_energy
               : k == slip_sum        ? OfRealization::slip
               : k == path            ? OfRealization::path
                                      : OfRealization::rocking_path;
    }

    /// What the sums of a step are made of.
    /// @param dashpot, shear sum of the forces at the two ends of the step [N];  @param slip, turning in it
    /// @param limit of friction [N]
    STYLOBATE_LANES void put_factors(int at, const Touch<Real>& t, const Real& dashpot, const Real& shear,
                                     const Real& slip, const Real& limit, const Real& turning)
    {
        using M = Memory;
        Real factor[M::factors - 2];
        factor[M::closing] = t.closing;
        factor[M::dashpot] = dashpot;
        factor[M::sliding] = abs_of(t.sliding); // the same product as without the two signs
        factor[M::shear] = turn_sign(shear, t.sliding);
        factor[M::slip] = slip;
        factor[M::limit] = limit;
        factor[M::turning] = abs_of(turning);
        factor[M::one] = Real(1.0);
        w_.each([&](int lane) {
            struct alignas(16) Two { // stored at once
                double a, b;
            };
            auto* const to = reinterpret_cast<Two*>(shared_.factor[at][lane].of);
            STYLOBATE_UNROLLED
            for (int k = 0; k < M::factors / 2 - 1; ++k)
                to[k] = {W::of(factor[2 * k], lane), W::of(factor[2 * k + 1], lane)};
        });
    }

    /// The sums over the realizations, from the lowest bed to the highest, of the step whose factors these are.
    STYLOBATE_LANES void sum_up(int at)
    {
        w_.each([&](int lane) {
            const auto* const bed = &shared_.factor[at][group_[lane] < groups ? lane - number_[lane] : 0];
            STYLOBATE_UNROLLED
            for (int n = 0; n < own_sums; ++n) {
                const int a = first_[n][lane], b = second_[n][lane];
                double sum = W::of(sum_[n], lane);
                STYLOBATE_UNROLLED
                for (int j = 0; j < width; ++j)
                    sum = fma(bed[j].of[a], bed[j].of[b], sum);
                W::of(sum_[n], lane) = sum;
            }
        });
    }
    /// The lane's bed adds nothing to the next sums that are made of these.
    STYLOBATE_LANES void forget_factors(int at, int lane)
    {
        for (int k = 0; k < Memory::factors; ++k)
            shared_.factor[at][lane].of[k] = k == Memory::one ? 1 : 0;
    }

    /// The work of the base in `count` steps from `first` on: lane j adds up the momentum of the j-th of them, and each
    /// lane the work.
    STYLOBATE_LANES void push_base(int first, int count)
    {
        auto& memory = shared_.sums;
        w_.each([&](int lane) {
            if (group_[lane] == groups)
                return;
            const int k = number_[lane], lowest = lane - k;
            double momentum = 0;
            STYLOBATE_UNROLLED
            for (int i = 0; i < width; ++i)
                momentum = fma(shared_.mass[lowest + i], memory.moved[k][lowest + i], momentum);
            const bool some = k < count;
            const double* const base = &shared_.base[group_[lane]][1 + first + (some ? k : 0)];
            memory.pushed[group_[lane]][k][0] = some ? momentum : 0;
            memory.pushed[group_[lane]][k][1] = some ? base[-1] + base[0] : 0;
        });
        w_.sync();
        w_.each([&](int lane) {
            if (group_[lane] == groups)
                return;
            double energy = W::of(base_energy_, lane);
            STYLOBATE_UNROLLED
            for (int k = 0; k < width; ++k)
                energy = fnma(memory.pushed[group_[lane]][k][1], memory.pushed[group_[lane]][k][0], energy);
            W::of(base_energy_, lane) = energy;
        });
    }

    /// Of the last step of the chunk, from the lowest block to the highest.
    STYLOBATE_LANES void energies()
    {
        w_.each([&](int lane) {
            double kinetic = 0, potential = 0;
            if (group_[lane] < groups) {
                const int lowest = lane - number_[lane];
                STYLOBATE_UNROLLED
                for (int i = lowest; i < lowest + width; ++i) {
                    kinetic = fma(shared_.mass[i], shared_.sums.audit[0][i],
                                  fma(shared_.inertia[i], shared_.sums.audit[1][i], kinetic));
                    potential = fnma(shared_.mass[i], shared_.sums.audit[2][i], potential);
                }
            }
            kinetic_[lane] = kinetic;
            potential_[lane] = potential;
        });
    }

    const W& w_;
    Memory& shared_;
    Each<int> group_, number_;
    Real sum_[own_sums];
    Real base_energy_; ///< every lane of a realization has it

private:
    /// The two factors of a sum. (What a lane makes beyond the last one nobody reads.)
    STYLOBATE_LANES static int first_factor(int k)
    {
        return k == dashpot_energy ? Memory::dashpot
               : k == shear_energy ? Memory::shear
               : k == path         ? Memory::sliding
               : k == rocking_path ? Memory::turning
                                   : Memory::slip;
    }
    STYLOBATE_LANES static int second_factor(int k)
    {
        return k == dashpot_energy    ? Memory::closing
               : k == shear_energy    ? Memory::sliding
               : k == friction_energy ? Memory::limit
                                      : Memory::one;
    }

    Each<int> first_[own_sums], second_[own_sums]; ///< factors of these
    Each<double> kinetic_, potential_;
};

} // namespace stylobate
