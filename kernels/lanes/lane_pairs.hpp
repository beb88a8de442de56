#pragma once
/// The watched pairs of structures whose beds are spread over lanes: blocks that share no bed but may meet.
///
/// As in `Stepper`, the pairs that are close are listed, and those of the list whose bounding boxes meet are evaluated
/// (`planar/neighbours.hpp`). Lane j of a group takes pairs j, j + width and so on, and leaves their forces in shared
/// memory; the lanes of the blocks add them up in the order of the list. A pair that does not touch changes no bit, so
/// it does not matter when the lists were made.
///
/// Both functions are calls, as the general overlap is one: what they need would crowd the step's registers.

#include "kernels/lanes/lane_sums.hpp"
#include "kernels/planar/neighbours.hpp"

namespace stylobate {

namespace detail {

/// The general overlap is rare; as a call it leaves the registers and the order of the step as they are.
template <class Real>
STYLOBATE_LANES_APART Overlap<Real> general_overlap_apart(const Placement<Real> place, const PairSizes<Real> sizes)
{
    return general_overlap(place, sizes);
}

} // namespace detail

/// Where a warp finds its pairs, and what they meet.
template <class W, class Memory>
struct PairPlaces {
    W warp;
    Memory* shared;                      ///< its `block` is that of this step
    double *block, *joint, *realization; ///< rows of a bundle's fields (`Bundle::rows`)
    int slots;                           ///< lanes of the bundle
    const TopologyJoint* ends;           ///< of the joints
    const int* owner;                    ///< of each block, its lane in the group; -1: a fixed one
    int beds, joints;
    int* close; ///< (pairs x slots) the list of each slot
};

template <class W, int width>
class LanePairs {
public:
    using Real = typename W::Real;
    template <class T>
    using Each = typename W::template Each<T>;
    using Places = PairPlaces<W, WarpMemory<width, true>>;

    /// What a lane works for. Its group's realization is stepped, or `on` is false.
    struct Lane {
        int slot, number, lowest; ///< `lowest`: the group's first lane
        int owner;                ///< lane of the warp that its block is of; -2: it holds no block
        bool on;
    };
    struct Added {
        Planar<Real> force; ///< on the block of each lane
        Real sum;           ///< its first sum, with what the pairs add
    };

    /// Lists the pairs that can meet before a block has strayed by the skin: those less than two skins apart.
    /// @return how many each lane's realization has
    STYLOBATE_LANES_APART static Each<int> look_around(const Places p, const Each<Lane> lanes)
    {
        const W& w = p.warp;
        Each<int> close, groups;
        w.each([&](int lane) {
            close[lane] = 0;
            groups[lane] = lane / width;
        });
        for (int first = p.beds; first < p.joints; first += width) {
            Each<int> joint;
            w.each([&](int lane) {
                const int mine = first + lanes[lane].number;
                joint[lane] = lanes[lane].on && mine < p.joints ? mine : -1;
            });
            Pair pair;
            take(p, lanes, joint, pair);
            const auto meets = pair.meets(Real(2.0));
            Each<bool> flags;
            w.each([&](int lane) { flags[lane] = joint[lane] >= 0 && W::of(meets, lane); });
            const Each<std::uint32_t> votes = w.votes_of_group(flags, groups, width);
            w.each([&](int lane) {
                if (flags[lane])
                    p.close[static_cast<long>(close[lane] + earlier_votes(votes[lane], lanes[lane].number)) * p.slots +
                            lanes[lane].slot] = joint[lane];
                if (lanes[lane].on)
                    close[lane] += earlier_votes(votes[lane], width);
            });
        }
        w.sync();
        return close;
    }

    /// The forces of the pairs that meet.
    /// @param close number of pairs in each realization's list;  @param sum each lane's first sum, beds included
    /// @param audit the last step of a chunk: the pairs' elastic energies are written
    STYLOBATE_LANES_APART static Added meet(const Places p, const Each<Lane> lanes, const Each<int> close, Real sum,
                                            bool audit)
    {
        const W& w = p.warp;
        const Real zero(0.0);
        Added added{{zero, zero, zero}, sum};
        for (int first = 0;; first += width) {
            Each<bool> left;
            Each<int> joint;
            w.each([&](int lane) {
                const Lane& l = lanes[lane];
                const int mine = first + l.number;
                left[lane] = first < close[lane];
                joint[lane] = mine < close[lane] ? p.close[static_cast<long>(mine) * p.slots + l.slot] : -1;
            });
            if (!w.any(left))
                return added;
            Pair pair;
            take(p, lanes, joint, pair);
            const auto meets = pair.meets(Real(1e-3)); // boxes that touch to rounding are included
            Each<bool> met;
            w.each([&](int lane) { met[lane] = joint[lane] >= 0 && W::of(meets, lane); });
            if (!w.any(met))
                continue;
            w.sync(); // the loads of the pairs before have been read
            if (w.any(touch_each(p, lanes, joint, met, pair, audit))) {
                w.sync();
                add_up(p, lanes, added);
            }
        }
    }

private:
    /// A pair of each lane; where there is none, blocks that are far apart.
    struct Pair {
        Pose<Real> lower, upper;
        Planar<Real> lower_motion, upper_motion;
        PairSizes<Real> sizes;
        Real reference_x, height, skin;
        Real spring, shear, dashpot; ///< forces at the last step

        STYLOBATE_LANES auto meets(Real skins) const
        {
            const Real one(1.0);
            return pair_meets(reference_x + (upper.x - lower.x), height + (upper.y - lower.y),
                              TurnedBox<Real>{sizes.lower_half_width, sizes.lower_half_height, abs_of(lower.sine),
                                              abs_of(one - lower.versine)},
                              TurnedBox<Real>{sizes.upper_half_width, sizes.upper_half_height, abs_of(upper.sine),
                                              abs_of(one - upper.versine)},
                              abs_of(spring) + abs_of(shear) + abs_of(dashpot), skin * skins);
        }
    };

    STYLOBATE_LANES static double& at(const Places& p, OfBlock::Field f, int row, int slot)
    {
        return p.block[static_cast<long>(row * OfBlock::count + f) * p.slots + slot];
    }
    STYLOBATE_LANES static double& at(const Places& p, OfJoint::Field f, int row, int slot)
    {
        return p.joint[static_cast<long>(row * OfJoint::count + f) * p.slots + slot];
    }
    /// The lane of the warp that has a block; the spare one for those that are fixed.
    STYLOBATE_LANES static int lane_of_block(const Places& p, const Lane& lane, int block)
    {
        return p.owner[block] < 0 ? spare_lane : lane.lowest + p.owner[block];
    }

    STYLOBATE_LANES static void take(const Places& p, const Each<Lane>& lanes, const Each<int>& joint, Pair& pair)
    {
        p.warp.each([&](int lane) {
            const Lane& l = lanes[lane];
            const bool has = joint[lane] >= 0;
            const TopologyJoint ends = has ? p.ends[joint[lane]] : TopologyJoint{};
            const auto block = [&](int number, Pose<Real>& pose, Planar<Real>& motion, Real& half_width,
                                   Real& half_height) {
                const auto& b = p.shared->block[has ? lane_of_block(p, l, number) : spare_lane];
                W::of(pose.sine, lane) = b.sine;
                W::of(pose.versine, lane) = b.versine;
                W::of(pose.theta, lane) = b.theta;
                W::of(pose.x, lane) = b.x;
                W::of(pose.y, lane) = b.y;
                W::of(motion.x, lane) = b.dx;
                W::of(motion.y, lane) = b.dy;
                W::of(motion.theta, lane) = b.dtheta;
                W::of(half_width, lane) = has ? at(p, OfBlock::half_width, number, l.slot) : 1;
                W::of(half_height, lane) = has ? at(p, OfBlock::half_height, number, l.slot) : 1;
            };
            block(ends.lower, pair.lower, pair.lower_motion, pair.sizes.lower_half_width, pair.sizes.lower_half_height);
            block(ends.upper, pair.upper, pair.upper_motion, pair.sizes.upper_half_width, pair.sizes.upper_half_height);
            const auto of = [&](OfJoint::Field f, double none) { return has ? at(p, f, joint[lane], l.slot) : none; };
            W::of(pair.reference_x, lane) = of(OfJoint::reference_x, 0);
            W::of(pair.height, lane) = of(OfJoint::height, 1e3);
            W::of(pair.spring, lane) = of(OfJoint::spring, 0);
            W::of(pair.shear, lane) = of(OfJoint::shear_force, 0);
            W::of(pair.dashpot, lane) = of(OfJoint::dashpot_force, 0);
            W::of(pair.skin, lane) = has ? p.realization[static_cast<long>(OfRealization::skin) * p.slots + l.slot] : 0;
        });
    }

    /// The contacts of those that meet, and what they leave for others.
    /// @return which of them touch
    STYLOBATE_LANES static Each<bool> touch_each(const Places& p, const Each<Lane>& lanes, const Each<int>& joint,
                                                 const Each<bool>& met, const Pair& pair, bool audit)
    {
        const W& w = p.warp;
        const Real zero(0.0);
        JointLaw<Real> law;
        Real per_K_t;
        w.each([&](int lane) {
            const auto of = [&](OfJoint::Field f) { return met[lane] ? at(p, f, joint[lane], lanes[lane].slot) : 0; };
            W::of(law.K_n, lane) = of(OfJoint::K_n);
            W::of(law.K_t, lane) = of(OfJoint::K_t);
            W::of(law.C_n_per_dt, lane) = of(OfJoint::C_n_per_dt);
            W::of(law.C_t_per_dt, lane) = of(OfJoint::C_t_per_dt);
            W::of(law.C_n_chord, lane) = of(OfJoint::C_n_chord);
            W::of(law.C_t_chord, lane) = of(OfJoint::C_t_chord);
            W::of(law.mu, lane) = of(OfJoint::mu);
            W::of(per_K_t, lane) = of(OfJoint::per_K_t);
        });
        const Pose<Real>&lower = pair.lower, &upper = pair.upper;
        const PairSizes<Real>& sizes = pair.sizes;
        const Real x = pair.reference_x + (upper.x - lower.x), rise = upper.y - lower.y, y = rise + pair.height;
        Placement<Real> place = bed_placement(lower.sine, lower.versine, upper.sine, upper.versine, x, rise,
                                              pair.height, sizes.upper_half_height);
        place.depth =
            pair_depth(place.cosine, lower.sine, lower.versine, x, y, sizes.lower_half_height, sizes.upper_half_height);
        const Overlap<Real> o = detail::general_overlap_apart(place, sizes);
        const ContactSize<Real> size = contact_size(o);
        Touch<Real> t;
        touch(size, o, o.moment_x * size.per_area, fnma(o.moment_depth, size.per_area, sizes.lower_half_height),
              lower.sine, lower.versine, x, y, pair.lower_motion, pair.upper_motion, t);
        const ContactForce<Real> f = contact_force(law, t.area, t.chord, t.closing, t.sliding, pair.spring);
        const BedLoad<Real> load = bed_load(f, t, x, y);
        Real dashpot = fnma(law.K_n, t.area, f.normal);
        Real elastic = select(size.pressed, law.K_n * o.elastic, zero);
        Real both_dashpot = dashpot + pair.dashpot, both_shear = f.tangential + pair.shear;
        Real slip = f.excess * per_K_t, limit = law.mu * f.normal;
        Each<bool> touches;
        w.each([&](int lane) {
            const Lane& l = lanes[lane];
            auto& mine = p.shared->pair[lane];
            touches[lane] = met[lane] && W::of(t.area, lane) > 0;
            if (met[lane]) {
                at(p, OfJoint::spring, joint[lane], l.slot) = W::of(f.spring, lane);
                at(p, OfJoint::dashpot_force, joint[lane], l.slot) = W::of(dashpot, lane);
                at(p, OfJoint::shear_force, joint[lane], l.slot) = W::of(f.tangential, lane);
                if (audit)
                    at(p, OfJoint::elastic, joint[lane], l.slot) = W::of(elastic, lane);
            }
            mine.lower = mine.upper = -1;
            for (int k = 0; k < 3; ++k)
                mine.first_factor[k] = mine.second_factor[k] = 0;
            if (!touches[lane])
                return;
            mine.x = W::of(load.x, lane);
            mine.y = W::of(load.y, lane);
            mine.upper_moment = W::of(load.upper_moment, lane);
            mine.lower_moment = W::of(load.lower_moment, lane);
            mine.first_factor[0] = W::of(both_dashpot, lane);
            mine.second_factor[0] = W::of(t.closing, lane);
            mine.first_factor[1] = W::of(both_shear, lane);
            mine.second_factor[1] = W::of(t.sliding, lane);
            mine.first_factor[2] = W::of(slip, lane);
            mine.second_factor[2] = W::of(limit, lane);
            mine.lower = lane_of_block(p, l, p.ends[joint[lane]].lower);
            mine.upper = lane_of_block(p, l, p.ends[joint[lane]].upper);
        });
        return touches;
    }

    /// In the order of the list: on the block of each lane, and to the sums of the first three.
    STYLOBATE_LANES static void add_up(const Places& p, const Each<Lane>& lanes, Added& added)
    {
        p.warp.each([&](int lane) {
            const Lane& l = lanes[lane];
            if (!l.on)
                return;
            double x = W::of(added.force.x, lane), y = W::of(added.force.y, lane);
            double moment = W::of(added.force.theta, lane), sum = W::of(added.sum, lane);
            STYLOBATE_ROLLED
            for (int k = 0; k < width; ++k) {
                const auto& pair = p.shared->pair[l.lowest + k];
                if (pair.upper == l.owner) {
                    x = x + pair.x;
                    y = y + pair.y;
                    moment = moment + pair.upper_moment;
                }
                if (pair.lower == l.owner) {
                    x = x + (0.0 - pair.x);
                    y = y + (0.0 - pair.y);
                    moment = moment + (0.0 - pair.lower_moment);
                }
                if (l.number < 3)
                    sum = fma(pair.first_factor[l.number], pair.second_factor[l.number], sum);
            }
            W::of(added.force.x, lane) = x;
            W::of(added.force.y, lane) = y;
            W::of(added.force.theta, lane) = moment;
            W::of(added.sum, lane) = sum;
        });
    }
};

} // namespace stylobate
