#pragma once
/// Columns on a device, with a lane of a warp for every block: the step of `planar/step.hpp` for stacks of the paper's
/// model, without watched pairs.
///
/// Lane j of a realization holds free block j of its stack and the bed under it; a warp has as many realizations
/// (groups) as leave one lane spare, whose empty realization at rest is what the lowest and the top blocks read as
/// their neighbour. State and constants stay in registers while chunks are stepped. In each step a lane reads its lower
/// neighbour's pose and motion, and its upper one's force, from that lane's registers. The formulas are those of
/// `planar/bed.hpp`.
///
/// The sums over a realization (`Sum`, and the work of the base) add up bed by bed, step by step, as `Stepper::forces`
/// does, so that they have its bits: each lane leaves its factors in shared memory, and a lane for each sum makes the
/// chain, of one step while the next one is computed. What a chain does not use is 0 x 0 or 0 x 1, which changes no
/// bit.
///
/// A warp is a class W with
///   Real                  a number of each lane (`double` on a device)
///   Each<T>               any value of each lane: value[lane]
///   each(f)               calls f(lane) for every lane, in no order
///   of(real, lane)        that lane's number
///   from(real, lanes)     the number of another lane
///   any(flags), any_of_group(flags, groups, blocks)
///   sync()                what has been written to shared memory can be read by other lanes from now on
/// Between two calls of `sync` no lane may read what another one writes.

#include "kernels/planar/bed.hpp"
#include "kernels/planar/bundle.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

inline constexpr int warp_lanes = 32;

/// Free blocks of a stack that lanes step.
inline constexpr int most_lane_blocks = 12;

#if defined(__CUDACC__)
#define STYLOBATE_LANES __device__ __forceinline__
#define STYLOBATE_LANES_APART __device__ __noinline__
#define STYLOBATE_UNROLLED _Pragma("unroll")
#define STYLOBATE_ROLLED _Pragma("unroll 1")
#else
#define STYLOBATE_LANES inline
#define STYLOBATE_LANES_APART inline
#define STYLOBATE_UNROLLED
#define STYLOBATE_ROLLED
#endif

namespace detail {

/// The general overlap is rare; as a call it leaves the registers and the order of the step as they are.
template <class Real>
STYLOBATE_LANES_APART Overlap<Real> general_overlap_apart(const Placement<Real> place, const PairSizes<Real> sizes)
{
    return general_overlap(place, sizes);
}

} // namespace detail

/// What the lanes of a warp share. @tparam blocks free blocks of a realization
template <int blocks>
struct WarpMemory {
    static constexpr int groups = (warp_lanes - 1) / blocks;
    static constexpr int base_row = chunk_steps + 5; // odd, so that groups are in different banks

    /// What the sums are made of, of one bed in one step. (80 bytes: no two lanes of a quarter warp share a bank.)
    enum Factor : int { closing, dashpot, sliding, shear, slip, limit, turning, one, factors = 10 };
    struct alignas(16) Factors {
        double of[factors];
    };

    struct Sums {
        double moved[blocks][warp_lanes];     ///< motion in the last steps, for the momentum
        double pushed[groups + 1][blocks][2]; ///< momentum, and twice the base's mean motion, in the same steps
        double audit[3][warp_lanes];          ///< of the last step of a chunk
    };
    double base[groups + 1][base_row]; ///< [0] of the step before the chunk; the last row, of the spare lanes: 0
    Factors factor[2][warp_lanes];     ///< of even and odd steps
    double mass[warp_lanes], inertia[warp_lanes];
    union {
        double displacement[groups][base_row]; ///< of the base, while its table is made
        Sums sums;                             ///< while the chunk is stepped
    };
};

template <class W, int blocks>
class ColumnLanes {
public:
    using Real = typename W::Real;
    template <class T>
    using Each = typename W::template Each<T>;
    using Memory = WarpMemory<blocks>;
    static constexpr int groups = Memory::groups;

    /// @param first_slot of the bundle's lanes (slots), which the warp's first group has;
    /// @param busy(slot) whether there is a realization in a slot that is to be stepped
    template <class Busy>
    STYLOBATE_LANES ColumnLanes(const W& warp, const Topology& topology, const Bundle& bundle, Memory& shared,
                                int first_slot, const Busy& busy)
        : w_(warp), b_(bundle), fixed_(topology.fixed), shared_(shared)
    {
        w_.each([&](int lane) {
            const bool mine = lane < groups * blocks;
            group_[lane] = mine ? lane / blocks : groups;
            block_[lane] = mine ? lane % blocks : 0;
            below_[lane] = mine && block_[lane] > 0 ? lane - 1 : spare;
            above_[lane] = mine && block_[lane] + 1 < blocks ? lane + 1 : spare;
            slot_[lane] = first_slot + group_[lane];
            busy_[lane] = mine && busy(slot_[lane]);
            for (int n = 0; n < own_sums; ++n) {
                first_[n][lane] = first_factor(own_sum(block_[lane], n));
                second_[n][lane] = second_factor(own_sum(block_[lane], n));
            }
        });
    }

    STYLOBATE_LANES const Each<bool>& busy() const { return busy_; }
    STYLOBATE_LANES int slot(int lane) const { return slot_[lane]; }
    /// Number of the lane's block among the free ones, and in the bundle.
    STYLOBATE_LANES int block(int lane) const { return block_[lane]; }
    STYLOBATE_LANES int row(int lane) const { return fixed_ + block_[lane]; }
    STYLOBATE_LANES const Each<int>& group() const { return group_; }
    /// The motion of the base of the lane's realization in the steps of the chunk, from [1] on: to be filled before it.
    STYLOBATE_LANES double* base(int lane) { return shared_.base[group_[lane]]; }
    /// (chunk_steps + 2) Room to make it, until the chunk is stepped.
    STYLOBATE_LANES double* displacement(int lane) { return shared_.displacement[group_[lane]]; }
    STYLOBATE_LANES Planar<double> position(int lane)
    {
        return {W::of(s_.pose.x, lane), W::of(s_.pose.y, lane), W::of(s_.pose.theta, lane)};
    }
    /// After a chunk, in every lane of the realization: 2 dt2 x its kinetic and dt2 x its potential energy.
    STYLOBATE_LANES double kinetic(int lane) const { return kinetic_[lane]; }
    STYLOBATE_LANES double potential(int lane) const { return potential_[lane]; }

    /// From now on the realizations of these lanes rest.
    STYLOBATE_LANES void stop(const Each<bool>& lanes)
    {
        w_.each([&](int lane) { busy_[lane] = busy_[lane] && !lanes[lane]; });
    }

    /// Takes the realizations from the bundle; in place of what is not busy there is one that rests. A `sync` is to
    /// follow before the next chunk.
    STYLOBATE_LANES void load()
    {
        w_.each([&](int lane) {
            const bool on = busy_[lane];
            const int slot = slot_[lane], i = row(lane), j = block_[lane];
            each_number([&](auto field, int row, auto& number,
                            bool) { W::of(number, lane) = on ? value(field, row, slot) : 0.0; },
                        i, j);
            each_constant([&](auto field, int row, auto& number,
                              double rest) { W::of(number, lane) = on ? value(field, row, slot) : rest; },
                          i, j);
            shared_.mass[lane] = on ? b_.at(OfBlock::mass, i, slot) : 0;
            shared_.inertia[lane] = on ? b_.at(OfBlock::inertia, i, slot) : 0;
            for (auto& step : shared_.factor)
                for (int k = 0; k < Memory::factors; ++k)
                    step[lane].of[k] = k == Memory::one ? 1 : 0;
            if (lane == spare)
                for (double& step : shared_.base[groups])
                    step = 0;
            if (j == 0 && group_[lane] < groups)
                shared_.base[group_[lane]][0] = on ? b_.at(OfRealization::base_step, slot) : 0;
            inside_[lane] = -1;
        });
        turn();
    }

    /// Steps all by a chunk, along the base's motion in `base`.
    STYLOBATE_LANES void run_chunk()
    {
        w_.each([&](int lane) { inside_[lane] = -1; });
        STYLOBATE_ROLLED
        for (int step = 0, turn = 0; step < chunk_steps; ++step) {
            this->step(step, turn, step + 1 == chunk_steps);
            turn = turn + 1 == blocks ? 0 : turn + 1;
        }
        sum_up((chunk_steps - 1) & 1);
        energies();
        w_.sync();
        w_.each([&](int lane) { // the next chunk's first step has none before it to sum up
            for (int k = 0; k < Memory::one; ++k)
                shared_.factor[(chunk_steps - 1) & 1][lane].of[k] = 0;
            if (block_[lane] == 0 && group_[lane] < groups)
                base(lane)[0] = base(lane)[chunk_steps];
        });
    }

    /// What a check reads, and what the host takes over, into the bundle.
    STYLOBATE_LANES void store()
    {
        w_.each([&](int lane) {
            if (!busy_[lane])
                return;
            const int slot = slot_[lane], i = row(lane), j = block_[lane];
            each_number(
                [&](auto field, int row, auto& number, bool own) {
                    if (own)
                        value(field, row, slot) = W::of(number, lane);
                },
                i, j);
            b_.at(OfBlock::sine, i, slot) = W::of(s_.pose.sine, lane);
            b_.at(OfBlock::versine, i, slot) = W::of(s_.pose.versine, lane);
            b_.at(OfBlock::inside, i, slot) = static_cast<double>(inside_[lane]);
            if (j == 0) {
                b_.at(OfRealization::base_step, slot) = base(lane)[chunk_steps];
                b_.at(OfRealization::kinetic, slot) = kinetic_[lane];
                b_.at(OfRealization::potential, slot) = potential_[lane];
            }
        });
        w_.sync();
    }

    /// Two numbers of each realization, for its lowest lane: the sum of the slip, and the top's displacement.
    /// @param found (lane, slip, top) called for the lowest lanes
    template <class Found>
    STYLOBATE_LANES void slip_and_top(const Found& found)
    {
        constexpr int slip_lane = slip_sum % blocks, slip_place = slip_sum / blocks;
        w_.each([&](int lane) {
            if (block_[lane] == slip_lane)
                shared_.sums.audit[0][lane] = W::of(sum_[slip_place], lane);
            if (block_[lane] == blocks - 1)
                shared_.sums.audit[1][lane] = W::of(s_.pose.x, lane);
        });
        w_.sync();
        w_.each([&](int lane) {
            if (block_[lane] == 0 && group_[lane] < groups)
                found(lane, shared_.sums.audit[0][lane + slip_lane], shared_.sums.audit[1][lane + blocks - 1]);
        });
    }

private:
    static constexpr int spare = warp_lanes - 1;

    /// The sums over a realization that have a chain of their own, and how many of them a lane makes: sums j,
    /// j + blocks and so on are lane j's.
    enum Sum : int { dashpot_energy, shear_energy, friction_energy, slip_sum, path, rocking_path, sums };
    static constexpr int own_sums = (sums + blocks - 1) / blocks;
    STYLOBATE_LANES static constexpr int own_sum(int block, int n) { return block + n * blocks; }
    STYLOBATE_LANES static OfRealization::Field sum_field(int k)
    {
        return k == dashpot_energy    ? OfRealization::dashpot_energy
               : k == shear_energy    ? OfRealization::shear_energy
               : k == friction_energy ? OfRealization::friction_energy
               : k == slip_sum        ? OfRealization::slip
               : k == path            ? OfRealization::path
                                      : OfRealization::rocking_path;
    }
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

    struct State {
        Pose<Real> pose;
        Planar<Real> motion; ///< in the last step
        Real spring, dashpot, shear, max_rotation;
        Real peak, path;  ///< of this lane's block: the top's count
        Real base_energy; ///< every lane of a realization has it
    };
    struct Constants {
        Real half_width, half_height, lower_half_width, lower_half_height;
        Real reference_x, height, depth_limit;
        JointLaw<Real> law;
        Real per_K_t, dt2_per_mass, dt2_per_inertia, least_y, most_turn;
        Real gravity_dx, gravity_dy;
    };

    STYLOBATE_LANES double& value(OfBlock::Field f, int row, int slot) const { return b_.at(f, row, slot); }
    STYLOBATE_LANES double& value(OfJoint::Field f, int row, int slot) const { return b_.at(f, row, slot); }
    STYLOBATE_LANES double& value(OfRealization::Field f, int, int slot) const { return b_.at(f, slot); }
    /// Calls f(field, its row, the number, whether it is this lane that stores it) for what a step changes.
    template <class F>
    STYLOBATE_LANES void each_number(F&& f, int i, int j)
    {
        const bool top = j == blocks - 1;
        f(OfBlock::x, i, s_.pose.x, true);
        f(OfBlock::y, i, s_.pose.y, true);
        f(OfBlock::theta, i, s_.pose.theta, true);
        f(OfBlock::dx, i, s_.motion.x, true);
        f(OfBlock::dy, i, s_.motion.y, true);
        f(OfBlock::dtheta, i, s_.motion.theta, true);
        f(OfJoint::spring, j, s_.spring, true);
        f(OfJoint::dashpot_force, j, s_.dashpot, true);
        f(OfJoint::shear_force, j, s_.shear, true);
        f(OfJoint::max_rotation, j, s_.max_rotation, true);
        f(OfRealization::peak_top, 0, s_.peak, top);
        f(OfRealization::top_path, 0, s_.path, top);
        f(OfRealization::base_energy, 0, s_.base_energy, j == 0);
        for (int n = 0; n < own_sums; ++n)
            f(sum_field(own_sum(j, n)), 0, sum_[n], own_sum(j, n) < sums);
    }

    /// Calls f(field, its row, the number, what it is in a realization that rests) for what stays as it is.
    template <class F>
    STYLOBATE_LANES void each_constant(F&& f, int i, int j)
    {
        constexpr double some = 0.01; // m: no width of nothing
        f(OfBlock::half_width, i, c_.half_width, some);
        f(OfBlock::half_height, i, c_.half_height, 0.0);
        f(OfBlock::half_width, i - 1, c_.lower_half_width, some);
        f(OfBlock::half_height, i - 1, c_.lower_half_height, 0.0);
        f(OfJoint::reference_x, j, c_.reference_x, 0.0);
        f(OfJoint::height, j, c_.height, 0.0);
        f(OfJoint::depth_limit, j, c_.depth_limit, 1.0);
        f(OfJoint::K_n, j, c_.law.K_n, 0.0);
        f(OfJoint::K_t, j, c_.law.K_t, 0.0);
        f(OfJoint::C_n_per_dt, j, c_.law.C_n_per_dt, 0.0);
        f(OfJoint::C_t_per_dt, j, c_.law.C_t_per_dt, 0.0);
        f(OfJoint::C_n_chord, j, c_.law.C_n_chord, 0.0);
        f(OfJoint::C_t_chord, j, c_.law.C_t_chord, 0.0);
        f(OfJoint::mu, j, c_.law.mu, 0.0);
        f(OfJoint::per_K_t, j, c_.per_K_t, 0.0);
        f(OfBlock::dt2_per_mass, i, c_.dt2_per_mass, 0.0);
        f(OfBlock::dt2_per_inertia, i, c_.dt2_per_inertia, 0.0);
        f(OfBlock::least_y, i, c_.least_y, 0.0);
        f(OfBlock::most_turn, i, c_.most_turn, 0.0);
        f(OfRealization::gravity_dx, 0, c_.gravity_dx, 0.0);
        f(OfRealization::gravity_dy, 0, c_.gravity_dy, 0.0);
    }

    STYLOBATE_LANES void turn()
    {
        const Angle<Real> a = angle(s_.pose.theta);
        s_.pose.sine = a.sine;
        s_.pose.versine = a.versine;
    }

    /// @param turn step % blocks;  @param audit the last step of a chunk
    // long: one chain of formulas whose values stay in registers
    STYLOBATE_LANES void step(int step, int turn, bool audit)
    {
        const Real zero(0.0);
        sum_up(~step & 1); // of the step before
        // the bed: from geometry to forces, as the phases of `Stepper`
        const Real lower_sine = w_.from(s_.pose.sine, below_), lower_versine = w_.from(s_.pose.versine, below_);
        const Real lower_theta = w_.from(s_.pose.theta, below_);
        const Real lower_x = w_.from(s_.pose.x, below_), lower_y = w_.from(s_.pose.y, below_);
        const Planar<Real> lower_motion{w_.from(s_.motion.x, below_), w_.from(s_.motion.y, below_),
                                        w_.from(s_.motion.theta, below_)};
        const Real apart_x = c_.reference_x + (s_.pose.x - lower_x);
        const Real rise = s_.pose.y - lower_y;
        const Real apart_y = rise + c_.height;
        PentagonFrame<Real> frame;
        pentagon_frame(bed_placement(lower_sine, lower_versine, s_.pose.sine, s_.pose.versine, apart_x, rise, c_.height,
                                     c_.half_height),
                       c_.half_width, frame);
        s_.max_rotation = max_of(s_.max_rotation, abs_of(s_.pose.theta - lower_theta));
        Overlap<Real> o;
        auto fits = frame.slope < frame.slope;
        pentagon(frame, c_.lower_half_width, c_.depth_limit, fits, o);
        o.elastic = o.moment_depth;
        if (any(!fits)) [[unlikely]] {
            // (the placement once more: it does not stay in registers for this)
            const Placement<Real> place = bed_placement(lower_sine, lower_versine, s_.pose.sine, s_.pose.versine,
                                                        apart_x, rise, c_.height, c_.half_height);
            o = select(fits, o,
                       detail::general_overlap_apart(place, PairSizes<Real>{c_.lower_half_width, c_.lower_half_height,
                                                                            c_.half_width, c_.half_height}));
        }
        const ContactSize<Real> size = contact_size(o);
        const Touch<Real> t =
            touch(size, o, o.moment_x * size.per_area, fnma(o.moment_depth, size.per_area, c_.lower_half_height),
                  lower_sine, lower_versine, apart_x, apart_y, lower_motion, s_.motion);
        const ContactForce<Real> f = contact_force(c_.law, t.area, t.chord, t.closing, t.sliding, s_.spring);
        const BedLoad<Real> load = bed_load(f, t, apart_x, apart_y);
        const Real dashpot = fnma(c_.law.K_n, t.area, f.normal);
        put_factors(step & 1, t, f, dashpot, s_.motion.theta - lower_motion.theta);
        s_.spring = f.spring;
        s_.dashpot = dashpot;
        s_.shear = f.tangential;
        // the block
        const Planar<Real> force{(zero + load.x) - w_.from(load.x, above_), (zero + load.y) - w_.from(load.y, above_),
                                 (zero + load.upper_moment) - w_.from(load.lower_moment, above_)};
        Real base;
        w_.each([&](int lane) {
            W::of(base, lane) = shared_.base[group_[lane]][1 + step];
            shared_.sums.moved[turn][lane] = W::of(s_.motion.x, lane);
        });
        const Planar<Real> next =
            next_motion(force, s_.motion, c_.dt2_per_mass, c_.dt2_per_inertia, c_.gravity_dx - base, c_.gravity_dy);
        if (audit) [[unlikely]]
            put_audit(load, force, next, select(size.pressed, c_.law.K_n * o.elastic, zero));
        s_.motion = next;
        s_.pose.x = s_.pose.x + next.x;
        s_.pose.y = s_.pose.y + next.y;
        s_.pose.theta = s_.pose.theta + next.theta;
        this->turn();
        const auto out = (abs_of(s_.pose.theta) > c_.most_turn) | (s_.pose.y < c_.least_y);
        w_.each([&](int lane) {
            if (!W::of(out, lane))
                inside_[lane] = step;
        });
        s_.peak = max_of(s_.peak, abs_of(s_.pose.x));
        s_.path = s_.path + abs_of(next.x);
        w_.sync();
        if (turn == blocks - 1 || audit) [[unlikely]]
            push_base(step - turn, turn + 1);
    }

    /// What the sums of this step are made of.
    STYLOBATE_LANES void put_factors(int at, const Touch<Real>& t, const ContactForce<Real>& f, const Real& dashpot,
                                     const Real& turning)
    {
        using M = Memory;
        Real factor[M::factors - 2];
        factor[M::closing] = t.closing;
        factor[M::dashpot] = dashpot + s_.dashpot;
        factor[M::sliding] = abs_of(t.sliding); // the same product as without the two signs
        factor[M::shear] = turn_sign(f.tangential + s_.shear, t.sliding);
        factor[M::slip] = f.excess * c_.per_K_t;
        factor[M::limit] = c_.law.mu * f.normal;
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

    /// What the energies are made of, and what a balance of energy reads of beds and blocks.
    STYLOBATE_LANES void put_audit(const BedLoad<Real>& load, const Planar<Real>& force, const Planar<Real>& next,
                                   Real elastic)
    {
        const Planar<Real>& now = s_.motion;
        Real twice = fma(now.x, next.x, now.y * next.y), turning = now.theta * next.theta;
        Real height = fma(c_.gravity_dx, s_.pose.x, c_.gravity_dy * s_.pose.y);
        Real of_bed[5] = {load.x, load.y, load.upper_moment, load.lower_moment, elastic};
        Real on_block[3] = {force.x, force.y, force.theta};
        w_.each([&](int lane) {
            shared_.sums.audit[0][lane] = W::of(twice, lane);
            shared_.sums.audit[1][lane] = W::of(turning, lane);
            shared_.sums.audit[2][lane] = W::of(height, lane);
            if (!busy_[lane])
                return;
            const int slot = slot_[lane], i = row(lane), j = block_[lane];
            b_.at(OfJoint::force_x, j, slot) = W::of(of_bed[0], lane);
            b_.at(OfJoint::force_y, j, slot) = W::of(of_bed[1], lane);
            b_.at(OfJoint::upper_moment, j, slot) = W::of(of_bed[2], lane);
            b_.at(OfJoint::lower_moment, j, slot) = W::of(of_bed[3], lane);
            b_.at(OfJoint::elastic, j, slot) = W::of(of_bed[4], lane);
            b_.at(OfBlock::force_x, i, slot) = W::of(on_block[0], lane);
            b_.at(OfBlock::force_y, i, slot) = W::of(on_block[1], lane);
            b_.at(OfBlock::moment, i, slot) = W::of(on_block[2], lane);
        });
    }

    /// The sums over the realizations, from the lowest bed to the highest, of the step whose factors these are.
    STYLOBATE_LANES void sum_up(int at)
    {
        w_.each([&](int lane) {
            const auto* const bed = &shared_.factor[at][group_[lane] < groups ? lane - block_[lane] : 0];
            STYLOBATE_UNROLLED
            for (int n = 0; n < own_sums; ++n) {
                const int a = first_[n][lane], b = second_[n][lane];
                double sum = W::of(sum_[n], lane);
                STYLOBATE_UNROLLED
                for (int j = 0; j < blocks; ++j)
                    sum = fma(bed[j].of[a], bed[j].of[b], sum);
                W::of(sum_[n], lane) = sum;
            }
        });
    }

    /// The work of the base in `count` steps from `first` on: lane j adds up the momentum of the j-th of them, and each
    /// lane the work.
    STYLOBATE_LANES void push_base(int first, int count)
    {
        auto& memory = shared_.sums;
        w_.each([&](int lane) {
            if (group_[lane] == groups)
                return;
            const int k = block_[lane], lowest = lane - k;
            double momentum = 0;
            STYLOBATE_UNROLLED
            for (int i = 0; i < blocks; ++i)
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
            double energy = W::of(s_.base_energy, lane);
            STYLOBATE_UNROLLED
            for (int k = 0; k < blocks; ++k)
                energy = fnma(memory.pushed[group_[lane]][k][1], memory.pushed[group_[lane]][k][0], energy);
            W::of(s_.base_energy, lane) = energy;
        });
    }

    /// Of the last step of the chunk, from the lowest block to the highest.
    STYLOBATE_LANES void energies()
    {
        w_.each([&](int lane) {
            double kinetic = 0, potential = 0;
            if (group_[lane] < groups) {
                const int lowest = lane - block_[lane];
                STYLOBATE_UNROLLED
                for (int i = lowest; i < lowest + blocks; ++i) {
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
    const Bundle& b_;
    const int fixed_;
    Memory& shared_;
    Each<int> group_, block_, below_, above_, slot_, inside_;
    Each<bool> busy_;
    Constants c_;
    State s_;
    Real sum_[own_sums];
    Each<int> first_[own_sums], second_[own_sums]; ///< factors of these
    Each<double> kinetic_, potential_;
};

} // namespace stylobate
