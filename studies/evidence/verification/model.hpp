#pragma once
/// The structures of the verification cases as hand-built realizations, and two ways to run them.
///
/// SPEC: six free drums 48 x 29 mm, 0.1355 kg.  MONO: the same as one block, 48 x 174 mm, 0.813 kg.
/// Nothing here goes through a study file, the sampler or the choice of the step.

#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/structure/static_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace stylobate::model {

inline constexpr double pi = std::numbers::pi;
inline constexpr double gravity = 9.81; // m/s2

/// One free block, sizes in full [m], mass [kg], and its offset from the axis [m].
struct Stone {
    double width = 0, height = 0, mass = 0, offset = 0;
};

/// A bed: K_T = K_N B; the dashpots are C = 2 xi sqrt(k m), of the lowest stone.
struct Bed {
    double K_n = 1e8;       ///< [N/m2]
    double xi = 0;          ///< damping ratio of both dashpots
    double mu = 0.68;       ///< friction
    bool per_chord = false; ///< dashpots in proportion to the contact length (their values hold at the full width)
};

inline const Stone spec_drum{0.048, 0.029, 0.1355};
inline const Stone mono_stone{0.048, 0.174, 0.813};

/// sqrt(K_N B / m) [rad/s].
inline double bed_rate(const Bed& bed, const Stone& stone)
{
    return std::sqrt(bed.K_n * stone.width / stone.mass);
}

/// A free block with its foot at a place.
inline Block block_of(const Stone& s, double x, double bottom)
{
    const double inertia = s.mass * (s.width * s.width + s.height * s.height) / 12;
    return {0.5 * s.width, 0.5 * s.height, s.mass, inertia, x, bottom + 0.5 * s.height, false};
}

/// @param length of the contact, by which the dashpots are chosen   @param width of K_T = K_N B
inline Joint joint_of(const Bed& bed, int lower, int upper, double mass, double length, double width)
{
    const double C = 2 * bed.xi * std::sqrt(bed.K_n * length * mass);
    return {lower, upper, bed.K_n, bed.K_n * width, C, C, bed.per_chord ? length : 0, bed.mu};
}

/// A stack on a fixed block.
/// @param base_width of the fixed block [m]; 0: that of the lowest stone (flush, as in the specimen)
inline Realization stack(const std::vector<Stone>& stones, const Bed& bed, double step_s, double base_width = 0)
{
    Realization r;
    const Stone& first = stones.front();
    const double base_height = first.height;
    r.blocks.push_back(
        {0.5 * (base_width > 0 ? base_width : first.width), 0.5 * base_height, 1, 1, 0, -0.5 * base_height, true});
    double top = 0;
    for (const Stone& s : stones) {
        const int upper = static_cast<int>(r.blocks.size());
        r.blocks.push_back(block_of(s, s.offset, top));
        r.joints.push_back(joint_of(bed, upper - 1, upper, first.mass, first.width, first.width));
        top += s.height;
    }
    r.drums = static_cast<int>(r.blocks.size());
    r.step_s = step_s;
    return r;
}

/// Six drums, each narrower than the one below by 2 `taper` of the width. A taper far above the displacements of a test
/// and far below its tolerance keeps the sides of neighbours from crossing each other: where they do, the contact
/// direction jumps by overlap / width.
inline Realization spec(const Bed& bed, double step_s, double taper = 0)
{
    std::vector<Stone> stones(6, spec_drum);
    for (std::size_t i = 0; i < stones.size(); ++i)
        stones[i].width *= 1 - 2 * taper * static_cast<double>(i);
    return stack(stones, bed, step_s, taper > 0 ? 2 * spec_drum.width : 0);
}

inline Realization single(const Stone& stone, const Bed& bed, double step_s, double base_width = 0)
{
    return stack({stone}, bed, step_s, base_width);
}

/// A stone that moves vertically on its bed: a mass on a spring of rate w, 1 kg on 1 m, tall enough to let it sink in.
inline Realization oscillator(double w, double xi, double step_s)
{
    return single({1, 20, 1}, {w * w, xi, 1}, step_s, 2);
}

/// p = sqrt(3 g / (4 R)) of a rigid block [rad/s], and its slenderness angle [rad].
inline double rocking_rate(const Stone& s)
{
    return std::sqrt(0.75 * gravity / (0.5 * std::hypot(s.width, s.height)));
}
inline double slenderness(const Stone& s)
{
    return std::atan(s.width / s.height);
}

/// Columns of equal drums on wide ground, one epistyle over each bay or one over all.
struct Colonnade {
    int columns = 2;
    int drums = 1; ///< of each column
    double spacing = 0.09;
    Stone drum{0.06, 0.1, 0.75};
    Stone epistyle{0.15, 0.06, 1.14};
    bool one_epistyle = true; ///< over all bays
};

/// COLO of the paper: two columns of 60 x 100 mm with a flush epistyle of 150 x 60 mm.
inline Colonnade paper_colonnade(int drums)
{
    Colonnade c;
    c.drums = drums;
    c.drum = {0.06, 0.1 / drums, 0.75 / drums};
    return c;
}

/// @param watch also lists all pairs that are no beds, so that whatever falls is caught
inline Realization colonnade(const Colonnade& c, const Bed& bed, double step_s, bool watch = true)
{
    Realization r;
    const auto add = [&](const Stone& s, double x, double bottom, BlockRole role, int column) {
        r.blocks.push_back(block_of(s, x, bottom));
        r.blocks.back().role = role;
        r.blocks.back().column = column;
        return static_cast<int>(r.blocks.size()) - 1;
    };
    const int ground = c.columns * c.drums + (c.one_epistyle ? 1 : c.columns - 1);
    const auto join = [&](int lower, int upper, double mass, double width) {
        r.joints.push_back(joint_of(bed, lower, upper, mass, width, c.drum.width));
    };
    for (int column = 0; column < c.columns; ++column)
        for (int i = 0; i < c.drums; ++i) {
            const int at = add(c.drum, column * c.spacing, i * c.drum.height, BlockRole::drum, column);
            join(i == 0 ? ground : at - 1, at, c.drum.mass, c.drum.width);
        }
    for (int k = 0; k < ground - c.columns * c.drums; ++k) {
        const double middle = c.one_epistyle ? 0.5 * (c.columns - 1) : k + 0.5;
        const int at = add(c.epistyle, middle * c.spacing, c.drums * c.drum.height, BlockRole::epistyle, -1);
        for (int column = c.one_epistyle ? 0 : k; column <= (c.one_epistyle ? c.columns - 1 : k + 1); ++column) {
            const double right =
                std::min(c.epistyle.width / 2 + middle * c.spacing, column * c.spacing + c.drum.width / 2);
            const double left =
                std::max(-c.epistyle.width / 2 + middle * c.spacing, column * c.spacing - c.drum.width / 2);
            join(column * c.drums + c.drums - 1, at, c.drum.mass, right - left);
        }
    }
    const double far = 50 * c.columns * c.spacing;
    r.blocks.push_back({far, c.drum.height, 1, 1, 0, -c.drum.height, true, BlockRole::ground, -1});
    r.drums = ground;
    const auto lie_together = [&](int a, int b) {
        for (const Joint& joint : r.joints)
            if ((joint.lower == a && joint.upper == b) || (joint.lower == b && joint.upper == a))
                return true;
        return false;
    };
    if (watch) {
        std::vector<std::pair<int, int>> pairs;
        for (int a = 0; a < ground; ++a)
            for (int b = a + 1; b < ground; ++b)
                pairs.emplace_back(a, b);
        for (int b = 0; b < ground; ++b)
            pairs.emplace_back(ground, b);
        for (const auto& [a, b] : pairs) {
            if (lie_together(a, b))
                continue;
            const auto long_face = [&](int i) {
                const Block& block = r.blocks[static_cast<std::size_t>(i)];
                return 2 * std::max(block.half_width_m, block.half_height_m);
            };
            const double chord = std::min(long_face(a), long_face(b));
            join(a, b, c.drum.mass, chord);
            r.joints.back().damping_chord_m = chord;
            ++r.watched;
        }
    }
    r.step_s = step_s;
    return r;
}

inline Study still(double duration_s)
{
    Study study;
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = duration_s;
    return study;
}

inline Study pulse(ExcitationKind kind)
{
    Study study;
    study.excitation.kind = kind;
    return study;
}

inline Study harmonic(double cycles, double ramp_cycles)
{
    Study study;
    study.excitation.kind = ExcitationKind::harmonic;
    study.excitation.cycles = cycles;
    study.excitation.ramp_cycles = ramp_cycles;
    return study;
}

/// Called after every chunk of steps of a realization that is still running, with its place in the list.
using Look = std::function<void(std::size_t index, const Snapshot&)>;

/// Runs one that rigid contacts have handed over to its end.
inline Outcome finish(const Study& study, const HandOver& handed, const Motion* record = nullptr)
{
    CompliantSet set(study, record, kernels(best_isa()), handed.realization);
    set.take(handed);
    Outcome outcome;
    while (!set.empty())
        set.advance([&](const Realization&, const Outcome& ended) { outcome = ended; });
    return outcome;
}

/// Runs each realization to its end, a register at a time, on the widest instruction set; outcomes in their order.
/// @param record of a study whose excitation is one
inline std::vector<Outcome> run_all(const Study& study, const std::vector<Realization>& realizations,
                                    const Motion* record = nullptr, const Look& look = {})
{
    LaneSet set(study, record, kernels(best_isa()), realizations.front());
    const auto lanes = static_cast<std::size_t>(set.lanes());
    std::vector<Outcome> outcomes(realizations.size());
    for (std::size_t begin = 0; begin < realizations.size(); begin += lanes) {
        for (std::size_t i = begin; i < std::min(begin + lanes, realizations.size()); ++i)
            set.load(static_cast<int>(i - begin), realizations[i]);
        while (set.active() > 0) {
            for (std::size_t i = 0; i < lanes; ++i)
                if (look && !set.free(static_cast<int>(i)))
                    look(begin + i, set.snapshot(static_cast<int>(i)));
            set.advance();
            for (std::size_t i = 0; i < lanes; ++i) {
                const int lane = static_cast<int>(i);
                if (set.free(lane) || !set.done(lane))
                    continue;
                outcomes[begin + i] = set.outcome(lane) ? *set.outcome(lane) : finish(study, *set.handed(lane), record);
                set.clear(lane); // a heap would slow the others
            }
        }
    }
    return outcomes;
}

inline Outcome run_one(const Study& study, const Realization& realization)
{
    return run_all(study, {realization}).front();
}

/// Which of several amplitudes do it.
using Trial = std::function<std::vector<bool>(const std::vector<double>&)>;

/// Where `happens` changes from false to true, to `tolerance`: each pass tries a register full of amplitudes between
/// one that does not and one that does.
/// @throws std::runtime_error when the ends do not bracket it
inline double threshold(const Trial& happens, double low, double high, double tolerance)
{
    const std::vector<bool> ends = happens({low, high});
    if (ends[0] || !ends[1])
        throw std::runtime_error("the ends do not bracket the threshold");
    const int count = kernels(best_isa()).lanes;
    while (high - low > tolerance) {
        const double step = (high - low) / (count + 1);
        std::vector<double> tries;
        for (int i = 1; i <= count; ++i)
            tries.push_back(low + step * i);
        const std::vector<bool> results = happens(tries);
        int first = 0;
        while (first < count && !results[static_cast<std::size_t>(first)])
            ++first;
        low += step * first;
        if (first < count)
            high = low + step;
    }
    return 0.5 * (low + high);
}

/// Least amplitude that overturns.
/// @param at the realization with an amplitude
inline double least_overturning(const Study& study, const std::function<Realization(double)>& at, double low,
                                double high, double tolerance, const Motion* record = nullptr)
{
    return threshold(
        [&](const std::vector<double>& amplitudes) {
            std::vector<Realization> tries;
            for (double amplitude : amplitudes)
                tries.push_back(at(amplitude));
            std::vector<bool> falls;
            for (const Outcome& o : run_all(study, tries, record))
                falls.push_back(o.state == State::collapsed);
            return falls;
        },
        low, high, tolerance);
}

/// One realization in a bundle of its own, on the scalar kernel, with every field open: for starts that are not a
/// static rest, and for a look at the forces. Blocks have their numbers of the realization.
class BareColumn {
public:
    /// @param skin_m how far a block may stray before close pairs are looked for again
    explicit BareColumn(const Realization& r, double skin_m = 0) : realization_(r), place_of_(r.blocks.size())
    {
        for (const bool fixed : {true, false})
            for (std::size_t i = 0; i < r.blocks.size(); ++i)
                if (r.blocks[i].fixed == fixed) {
                    place_of_[i] = topology_.blocks++;
                    topology_.fixed += fixed;
                }
        for (const Joint& joint : r.joints)
            joints_.push_back(
                {place_of_[static_cast<std::size_t>(joint.lower)], place_of_[static_cast<std::size_t>(joint.upper)]});
        topology_.top = topology_.blocks - 1;
        topology_.watched = r.watched;
        close_.resize(static_cast<std::size_t>(r.watched));
        topology_.joints = static_cast<int>(joints_.size());
        topology_.joint = joints_.data();
        bed_lists_.resize(static_cast<std::size_t>(bed_lists_size(topology_)));
        list_beds(topology_, bed_lists_.data());
        const std::size_t bytes = (bundle_registers(topology_) * sizeof(double) + 63) / 64 * 64;
        memory_.reset(static_cast<double*>(std::aligned_alloc(64, bytes)));
        std::fill(memory_.get(), memory_.get() + bytes / sizeof(double), 0.0);
        bundle_ = bind_bundle(topology_, 1, memory_.get(), close_.data());

        const double dt = r.step_s, dt2 = dt * dt;
        for (int i = 0; i < topology_.blocks; ++i) {
            const Block& block = r.blocks[static_cast<std::size_t>(i)];
            at(OfBlock::half_width, i) = block.half_width_m;
            at(OfBlock::half_height, i) = block.half_height_m;
            at(OfBlock::mass, i) = block.mass_kg;
            at(OfBlock::inertia, i) = block.inertia_kg_m2;
            at(OfBlock::dt2_per_mass, i) = block.fixed ? 0 : dt2 / block.mass_kg;
            at(OfBlock::dt2_per_inertia, i) = block.fixed ? 0 : dt2 / block.inertia_kg_m2;
        }
        for (int j = 0; j < topology_.joints; ++j) {
            const Joint& joint = r.joints[static_cast<std::size_t>(j)];
            const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
            const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
            at(OfJoint::reference_x, j) = upper.x_m - lower.x_m;
            at(OfJoint::height, j) = j < r.beds() ? lower.half_height_m + upper.half_height_m : upper.y_m - lower.y_m;
            at(OfJoint::depth_limit, j) = 0.1 * std::min(lower.half_height_m, upper.half_height_m);
            at(OfJoint::K_n, j) = joint.normal_stiffness_n_m2;
            at(OfJoint::K_t, j) = joint.tangential_stiffness_n_m;
            at(OfJoint::per_K_t, j) = 1 / joint.tangential_stiffness_n_m;
            at(OfJoint::mu, j) = joint.friction;
            const bool chord = joint.damping_chord_m > 0;
            const double per = 1 / (chord ? dt * joint.damping_chord_m : dt);
            at(chord ? OfJoint::C_n_chord : OfJoint::C_n_per_dt, j) = joint.normal_damping_n_s_m * per;
            at(chord ? OfJoint::C_t_chord : OfJoint::C_t_per_dt, j) = joint.tangential_damping_n_s_m * per;
        }
        bundle_.at(OfRealization::gravity_dy, 0) = -dt2 * r.gravity_m_s2;
        bundle_.at(OfRealization::skin, 0) = skin_m;
    }

    double& at(OfBlock::Field field, int block)
    {
        return bundle_.at(field, place_of_[static_cast<std::size_t>(block)], 0);
    }
    double& at(OfJoint::Field field, int joint) { return bundle_.at(field, joint, 0); }
    double& at(OfRealization::Field field) { return bundle_.at(field, 0); }
    int blocks() const { return topology_.blocks; }
    int joints() const { return topology_.joints; }
    const Realization& realization() const { return realization_; }

    /// Puts the blocks at displacements against the reference stack, at rest.
    void put(const StaticState& state)
    {
        for (int i = 0; i < blocks(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            at(OfBlock::x, i) = state.x_m[k];
            at(OfBlock::y, i) = state.y_m[k];
            at(OfBlock::theta, i) = state.theta_rad[k];
        }
        for (int j = 0; j < joints(); ++j)
            at(OfJoint::spring, j) = state.spring_n[static_cast<std::size_t>(j)];
    }

    /// Takes a part of all velocities: a drag that vanishes at rest, to find where a structure can stay.
    void slow_down(double part)
    {
        for (int i = 0; i < blocks(); ++i)
            for (OfBlock::Field field : {OfBlock::dx, OfBlock::dy, OfBlock::dtheta})
                at(field, i) *= 1 - part;
    }

    /// One step in which the base's displacement has this second difference [m].
    void step(double base_second_difference = 0)
    {
        bundle_.at(OfBase::second, 0, 0) = base_second_difference;
        kernels(Isa::scalar).planar.run(topology_, bundle_, 0, 1);
    }

private:
    struct Free {
        void operator()(double* p) const { std::free(p); }
    };
    Realization realization_;
    std::vector<int> place_of_; ///< realization's block -> kernel's block: the fixed ones first
    std::vector<TopologyJoint> joints_;
    std::vector<int> close_;
    std::vector<int> bed_lists_;
    Topology topology_;
    std::unique_ptr<double[], Free> memory_;
    Bundle bundle_;
};

} // namespace stylobate::model
