#pragma once
/// Structures on a device, with a lane of a warp for every bed: the step of `planar/step.hpp` for blocks of the paper's
/// model.
///
/// Lane j of a realization holds bed j and the block that lies on it; a warp has as many realizations (groups) as leave
/// one lane spare. In a single stack of blocks, lane j + 1 is the upper neighbour of lane j. Other structures, such as
/// colonnades, and those with watched pairs, have lists of what each lane holds (`lane_list.hpp`). State and constants
/// stay in registers while chunks are stepped. In each step a lane reads the pose and motion of the block below its bed
/// from that block's lane. The force on a block is the sum of those of its beds: in a stack of the lane's own and its
/// upper neighbour's, by registers; else by shared memory, in the order of the list and after the pairs'
/// (`lane_pairs.hpp`). The formulas are those of `planar/bed.hpp`.

#include "kernels/lanes/lane_list.hpp"
#include "kernels/lanes/lane_pairs.hpp"
#include "kernels/lanes/lane_sums.hpp"
#include "kernels/lanes/warp.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

/// Free blocks of a single stack whose number of lanes is just that.
inline constexpr int most_lane_blocks = 12;

/// @tparam width lanes of a group: of a stack, its free blocks; else `lanes_of_group`
/// @tparam lists whether the structure has lists
template <class W, int width, bool lists>
class BedLanes : public LaneSums<W, width, lists> {
    using Sums = LaneSums<W, width, lists>;
    using Pairs = LanePairs<W, width>;

public:
    using typename Sums::Memory;
    using typename Sums::Real;
    template <class T>
    using Each = typename W::template Each<T>;
    using Sums::groups;
    using Sums::number;

    /// @param held of structures with lists
    /// @param first_slot of the bundle's lanes (slots), which the warp's first group has;
    /// @param busy(slot) whether there is a realization in a slot that is to be stepped
    template <class Busy>
    STYLOBATE_LANES BedLanes(const W& warp, const Topology& topology, const LaneLists& held, const Bundle& bundle,
                             Memory& shared, int first_slot, const Busy& busy)
        : Sums(warp, shared), t_(topology), held_(held), b_(bundle)
    {
        w_.each([&](int lane) {
            const int j = number_[lane], lowest = lane - j;
            const bool in_group = group_[lane] < groups;
            slot_[lane] = first_slot + group_[lane];
            busy_[lane] = in_group && busy(slot_[lane]);
            if constexpr (lists) {
                const bool some = in_group && j < t_.beds();
                const LaneBed mine = some ? held_.bed[j] : LaneBed{0, -1, 0xFFFFFFFFU};
                row_[lane] = mine.block;
                below_[lane] = mine.lower < 0 ? spare_lane : lowest + mine.lower;
                owner_[lane] = some ? lowest + held_.owner[mine.block] : nobody;
                beds_[lane] = mine.beds;
            } else {
                below_[lane] = in_group && j > 0 ? lane - 1 : spare_lane;
                above_[lane] = in_group && j + 1 < width ? lane + 1 : spare_lane;
            }
        });
    }

    STYLOBATE_LANES const Each<bool>& busy() const { return busy_; }
    STYLOBATE_LANES int slot(int lane) const { return slot_[lane]; }
    /// Whether the lane has a bed and a block.
    STYLOBATE_LANES bool holds(int lane) const
    {
        if constexpr (lists)
            return owner_[lane] != nobody;
        else
            return group_[lane] < groups;
    }
    /// Whether its block is stepped; if not, it rests.
    STYLOBATE_LANES bool moves(int lane) const { return busy_[lane] && holds(lane); }
    /// The number of its block in the bundle.   @pre holds
    STYLOBATE_LANES int row(int lane) const
    {
        if constexpr (lists)
            return row_[lane];
        else
            return t_.fixed + number_[lane];
    }
    /// The motion of the base of the lane's realization in the steps of the chunk, from [1] on: to be filled before it.
    STYLOBATE_LANES double* base(int lane) { return shared_.base[group_[lane]]; }
    /// (chunk_steps + 2) Room to make it, until the chunk is stepped.
    STYLOBATE_LANES double* displacement(int lane) { return shared_.displacement[group_[lane]]; }
    /// Of the lane's block, and of the one below its bed.
    STYLOBATE_LANES Planar<Real> position() const { return {s_.pose.x, s_.pose.y, s_.pose.theta}; }
    STYLOBATE_LANES Planar<Real> position_below() const
    {
        return {w_.from(s_.pose.x, below_), w_.from(s_.pose.y, below_), w_.from(s_.pose.theta, below_)};
    }

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
            const int slot = slot_[lane];
            each_number(lane, [&](auto field, int row, auto& number, bool has, bool) {
                W::of(number, lane) = on && has ? value(field, row, slot) : 0.0;
            });
            each_constant(lane, [&](auto field, int row, auto& number, double rest) {
                W::of(number, lane) = moves(lane) ? value(field, row, slot) : rest;
            });
            const bool own = on && owns(lane);
            shared_.mass[lane] = own ? b_.at(OfBlock::mass, row(lane), slot) : 0;
            shared_.inertia[lane] = own ? b_.at(OfBlock::inertia, row(lane), slot) : 0;
            this->forget_factors(0, lane);
            this->forget_factors(1, lane);
            if (lane == spare_lane)
                for (double& step : shared_.base[groups])
                    step = 0;
            if (number_[lane] == 0 && group_[lane] < groups)
                shared_.base[group_[lane]][0] = on ? b_.at(OfRealization::base_step, slot) : 0;
            inside_[lane] = -1;
        });
        turn();
        if constexpr (lists)
            begin_pairs();
    }

    /// Steps all by a chunk, along the base's motion in `base`.
    STYLOBATE_LANES void run_chunk()
    {
        w_.each([&](int lane) { inside_[lane] = -1; });
        STYLOBATE_ROLLED
        for (int step = 0, turn = 0; step < chunk_steps; ++step) {
            this->step(step, turn, step + 1 == chunk_steps);
            turn = turn + 1 == width ? 0 : turn + 1;
        }
        sum_up_last((chunk_steps - 1) & 1);
        this->energies();
        w_.sync();
        w_.each([&](int lane) { // the next chunk's first step has none before it to sum up
            this->forget_factors((chunk_steps - 1) & 1, lane);
            if (number_[lane] == 0 && group_[lane] < groups)
                base(lane)[0] = base(lane)[chunk_steps];
        });
    }

    /// What a check reads, and what the host takes over, into the bundle.
    STYLOBATE_LANES void store()
    {
        w_.each([&](int lane) {
            if (!busy_[lane])
                return;
            const int slot = slot_[lane];
            each_number(lane, [&](auto field, int row, auto& number, bool, bool stores) {
                if (stores)
                    value(field, row, slot) = W::of(number, lane);
            });
            if (owns(lane)) {
                const int i = row(lane);
                b_.at(OfBlock::sine, i, slot) = W::of(s_.pose.sine, lane);
                b_.at(OfBlock::versine, i, slot) = W::of(s_.pose.versine, lane);
                b_.at(OfBlock::inside, i, slot) = static_cast<double>(inside_[lane]);
            }
            if (number_[lane] == 0) {
                b_.at(OfRealization::base_step, slot) = base(lane)[chunk_steps];
                b_.at(OfRealization::kinetic, slot) = this->kinetic(lane);
                b_.at(OfRealization::potential, slot) = this->potential(lane);
            }
        });
        w_.sync();
    }

    /// Two numbers of each realization, for its lowest lane: the sum of the slip, and the top's displacement.
    /// @param found (lane, slip, top) called for the lowest lanes
    template <class Found>
    STYLOBATE_LANES void slip_and_top(const Found& found)
    {
        constexpr int slip_lane = Sums::slip_sum % width, slip_place = Sums::slip_sum / width;
        w_.each([&](int lane) {
            if (number_[lane] == slip_lane)
                shared_.sums.audit[0][lane] = W::of(this->sum_[slip_place], lane);
            if (number_[lane] == top())
                shared_.sums.audit[1][lane] = W::of(s_.pose.x, lane);
        });
        w_.sync();
        w_.each([&](int lane) {
            if (number_[lane] == 0 && group_[lane] < groups)
                found(lane, shared_.sums.audit[0][lane + slip_lane], shared_.sums.audit[1][lane + top()]);
        });
    }

private:
    using Sums::group_;
    using Sums::number_;
    using Sums::shared_;
    using Sums::w_;
    static constexpr int nobody = -2; ///< owner of a lane that holds nothing

    struct State {
        Pose<Real> pose;
        Planar<Real> motion; ///< in the last step
        Real spring, dashpot, shear, max_rotation;
        Real peak, path; ///< of this lane's block: the top's count
    };
    struct Constants {
        Real half_width, half_height, lower_half_width, lower_half_height;
        Real reference_x, height, depth_limit;
        JointLaw<Real> law;
        Real per_K_t, dt2_per_mass, dt2_per_inertia, least_y, most_turn;
        Real gravity_dx, gravity_dy;
    };

    /// Whether the lane's block is its own, not a copy.
    STYLOBATE_LANES bool owns(int lane) const
    {
        if constexpr (lists)
            return owner_[lane] == lane;
        else
            return holds(lane);
    }
    STYLOBATE_LANES int top() const { return lists ? held_.top : width - 1; }

    STYLOBATE_LANES double& value(OfBlock::Field f, int row, int slot) const { return b_.at(f, row, slot); }
    STYLOBATE_LANES double& value(OfJoint::Field f, int row, int slot) const { return b_.at(f, row, slot); }
    STYLOBATE_LANES double& value(OfRealization::Field f, int, int slot) const { return b_.at(f, slot); }
    /// Calls f(field, its row, the number, whether the lane has it, whether it is this lane that stores it) for what a
    /// step changes.
    template <class F>
    STYLOBATE_LANES void each_number(int lane, F&& f)
    {
        const int i = row(lane), j = number_[lane];
        const bool bed = holds(lane), own = owns(lane), top = bed && j == this->top();
        f(OfBlock::x, i, s_.pose.x, bed, own);
        f(OfBlock::y, i, s_.pose.y, bed, own);
        f(OfBlock::theta, i, s_.pose.theta, bed, own);
        f(OfBlock::dx, i, s_.motion.x, bed, own);
        f(OfBlock::dy, i, s_.motion.y, bed, own);
        f(OfBlock::dtheta, i, s_.motion.theta, bed, own);
        f(OfJoint::spring, j, s_.spring, bed, bed);
        f(OfJoint::dashpot_force, j, s_.dashpot, bed, bed);
        f(OfJoint::shear_force, j, s_.shear, bed, bed);
        f(OfJoint::max_rotation, j, s_.max_rotation, bed, bed);
        f(OfRealization::peak_top, 0, s_.peak, bed, top);
        f(OfRealization::top_path, 0, s_.path, bed, top);
        f(OfRealization::base_energy, 0, this->base_energy_, true, j == 0);
        for (int n = 0; n < Sums::own_sums; ++n) {
            const int sum = Sums::own_sum(j, n);
            f(Sums::sum_field(sum), 0, this->sum_[n], true, sum < Sums::sums);
        }
    }

    /// Calls f(field, its row, the number, what it is in a realization that rests) for what stays as it is.
    template <class F>
    STYLOBATE_LANES void each_constant(int lane, F&& f)
    {
        constexpr double some = 0.01; // m: no width of nothing
        const int i = row(lane), j = number_[lane];
        const int lower = lists ? (holds(lane) ? t_.joint[j].lower : 0) : i - 1;
        f(OfBlock::half_width, i, c_.half_width, some);
        f(OfBlock::half_height, i, c_.half_height, 0.0);
        f(OfBlock::half_width, lower, c_.lower_half_width, some);
        f(OfBlock::half_height, lower, c_.lower_half_height, 0.0);
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
        if constexpr (lists)
            f(OfRealization::skin, 0, skin_, 0.0);
    }

    STYLOBATE_LANES void turn()
    {
        const Angle<Real> a = angle(s_.pose.theta);
        s_.pose.sine = a.sine;
        s_.pose.versine = a.versine;
    }

    /// @param turn step % width;  @param audit the last step of a chunk
    // long: one chain of formulas whose values stay in registers
    STYLOBATE_LANES void step(int step, int turn, bool audit)
    {
        const Real zero(0.0);
        sum_up_last(~step & 1); // of the step before
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
        Touch<Real> t;
        touch(size, o, o.moment_x * size.per_area, fnma(o.moment_depth, size.per_area, c_.lower_half_height),
              lower_sine, lower_versine, apart_x, apart_y, lower_motion, s_.motion, t);
        const ContactForce<Real> f = contact_force(c_.law, t.area, t.chord, t.closing, t.sliding, s_.spring);
        const BedLoad<Real> load = bed_load(f, t, apart_x, apart_y);
        const Real dashpot = fnma(c_.law.K_n, t.area, f.normal);
        this->put_factors(step & 1, t, dashpot + s_.dashpot, f.tangential + s_.shear, f.excess * c_.per_K_t,
                          c_.law.mu * f.normal, s_.motion.theta - lower_motion.theta);
        s_.spring = f.spring;
        s_.dashpot = dashpot;
        s_.shear = f.tangential;
        // the block
        const Planar<Real> force = force_on_block(step, load, audit);
        Real base;
        w_.each([&](int lane) {
            W::of(base, lane) = shared_.base[moves(lane) ? group_[lane] : groups][1 + step];
            shared_.sums.moved[turn][lane] = owns(lane) ? W::of(s_.motion.x, lane) : 0;
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
        if constexpr (lists)
            stray(next);
        w_.sync();
        if (turn == width - 1 || audit) [[unlikely]]
            this->push_base(step - turn, turn + 1);
    }

    /// The sums of the last step, if a meeting of pairs has not made them already.
    STYLOBATE_LANES void sum_up_last(int at)
    {
        if constexpr (lists) {
            if (!summed_)
                this->sum_up(at);
            summed_ = false;
        } else {
            this->sum_up(at);
        }
    }

    /// Sum of the contact forces on the lane's block.
    /// @param load of its bed
    STYLOBATE_LANES Planar<Real> force_on_block(int step, const BedLoad<Real>& load, bool audit)
    {
        const Real zero(0.0);
        if constexpr (lists) {
            w_.each([&](int lane) {
                shared_.load[lane] = {W::of(load.x, lane), W::of(load.y, lane), W::of(load.upper_moment, lane),
                                      W::of(load.lower_moment, lane)};
            });
            Planar<Real> force{zero, zero, zero};
            if (t_.watched > 0)
                force = force_of_pairs(step, audit);
            w_.sync();
            w_.each([&](int lane) {
                const int lowest = lane - number_[lane];
                double x = W::of(force.x, lane), y = W::of(force.y, lane), moment = W::of(force.theta, lane);
                STYLOBATE_UNROLLED
                for (int k = 0; k < most_beds_of_block; ++k) {
                    const unsigned entry = beds_[lane] >> 8 * k & 255U;
                    if (entry == 255U)
                        break;
                    const auto& bed = shared_.load[lowest + static_cast<int>(entry >> 1)];
                    const bool carries = (entry & 1U) != 0;
                    x = carries ? x - bed.x : x + bed.x;
                    y = carries ? y - bed.y : y + bed.y;
                    moment = carries ? moment - bed.lower_moment : moment + bed.upper_moment;
                }
                W::of(force.x, lane) = x;
                W::of(force.y, lane) = y;
                W::of(force.theta, lane) = moment;
            });
            return force;
        } else {
            return {(zero + load.x) - w_.from(load.x, above_), (zero + load.y) - w_.from(load.y, above_),
                    (zero + load.upper_moment) - w_.from(load.lower_moment, above_)};
        }
    }

    /// The pairs are to be listed before the next step.
    STYLOBATE_LANES void begin_pairs()
    {
        const Real zero(0.0);
        moved_ = zero;
        steps_ = 0;
        near_ = summed_ = false;
        listed_ = t_.watched == 0;
        const Real radius = c_.half_width + c_.half_height;
        radius2_ = radius * radius;
        w_.each([&](int lane) { close_[lane] = 0; });
    }

    /// How far each block may have strayed since the pairs were listed: the bound of `Neighbours::Path`, of one block.
    STYLOBATE_LANES void stray(const Planar<Real>& next)
    {
        moved_ = fma(next.x, next.x, fma(next.y, next.y, fma(radius2_ * next.theta, next.theta, moved_)));
        ++steps_;
    }

    /// On the lane's block.
    STYLOBATE_LANES Planar<Real> force_of_pairs(int step, bool audit)
    {
        const Real zero(0.0);
        const auto far = moved_ * Real(2.0 * steps_) > skin_ * skin_;
        Each<bool> strayed;
        w_.each([&](int lane) {
            strayed[lane] = W::of(far, lane);
            if (audit && busy_[lane])
                for (int joint = t_.beds() + number_[lane]; joint < t_.joints; joint += width)
                    b_.at(OfJoint::elastic, joint, slot_[lane]) = 0;
        });
        const bool look = !listed_ || w_.any(strayed);
        if (!look && !near_)
            return {zero, zero, zero};
        Each<typename Pairs::Lane> lanes;
        w_.each([&](int lane) {
            shared_.block[lane] = {W::of(s_.pose.sine, lane), W::of(s_.pose.versine, lane), W::of(s_.pose.theta, lane),
                                   W::of(s_.pose.x, lane),    W::of(s_.pose.y, lane),       W::of(s_.motion.x, lane),
                                   W::of(s_.motion.y, lane),  W::of(s_.motion.theta, lane)};
            lanes[lane] = {slot_[lane], number_[lane], lane - number_[lane], owner_[lane], busy_[lane]};
        });
        const typename Pairs::Places places{w_,
                                            &shared_,
                                            b_.template rows<OfBlock::Field>(),
                                            b_.template rows<OfJoint::Field>(),
                                            b_.template rows<OfRealization::Field>(),
                                            b_.lanes,
                                            t_.joint,
                                            held_.owner,
                                            t_.beds(),
                                            t_.joints,
                                            b_.close};
        w_.sync();
        if (look) {
            close_ = Pairs::look_around(places, lanes);
            Each<bool> some;
            w_.each([&](int lane) { some[lane] = close_[lane] > 0; });
            near_ = w_.any(some);
            listed_ = true;
            moved_ = zero;
            steps_ = 0;
        }
        if (!near_)
            return {zero, zero, zero};
        this->sum_up(step & 1); // the beds add to the sums before the pairs
        summed_ = true;
        const typename Pairs::Added added = Pairs::meet(places, lanes, close_, this->sum_[0], audit);
        this->sum_[0] = added.sum;
        return added.force;
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
            const bool own = owns(lane);
            shared_.sums.audit[0][lane] = own ? W::of(twice, lane) : 0;
            shared_.sums.audit[1][lane] = own ? W::of(turning, lane) : 0;
            shared_.sums.audit[2][lane] = own ? W::of(height, lane) : 0;
            if (!moves(lane))
                return;
            const int slot = slot_[lane], i = row(lane), j = number_[lane];
            b_.at(OfJoint::force_x, j, slot) = W::of(of_bed[0], lane);
            b_.at(OfJoint::force_y, j, slot) = W::of(of_bed[1], lane);
            b_.at(OfJoint::upper_moment, j, slot) = W::of(of_bed[2], lane);
            b_.at(OfJoint::lower_moment, j, slot) = W::of(of_bed[3], lane);
            b_.at(OfJoint::elastic, j, slot) = W::of(of_bed[4], lane);
            if (!own)
                return;
            b_.at(OfBlock::force_x, i, slot) = W::of(on_block[0], lane);
            b_.at(OfBlock::force_y, i, slot) = W::of(on_block[1], lane);
            b_.at(OfBlock::moment, i, slot) = W::of(on_block[2], lane);
        });
    }

    const Topology& t_;
    const LaneLists& held_;
    const Bundle& b_;
    Each<int> below_, slot_, inside_;
    Each<bool> busy_;
    Constants c_;
    State s_;
    // of a stack
    Each<int> above_;
    // with lists
    Each<int> row_, owner_;
    Each<std::uint32_t> beds_;
    Real moved_, radius2_, skin_;
    Each<int> close_;
    int steps_;                   ///< since the pairs were listed
    bool listed_, near_, summed_; ///< whether they are; some are close; the last step's sums are made
};

} // namespace stylobate
