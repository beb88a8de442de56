/// Stylobate in space among the others: beds of the given stiffness, the step that a study would take.

#include "bench/peers/column.hpp"
#include "bench/peers/space/space_engine.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/settle.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "ensemble/spatial/structure/step_bound.hpp"
#include "kernels/isa.hpp"
#include "studies/version.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate::peers {

namespace {

using spatial::OfBaseX;
using spatial::OfBaseY;
using spatial::OfBaseZ;
using spatial::OfBody;
using spatial::OfJoint;
using spatial::OfRealization;

struct Setting {
    const char* name;
    double damping_ratio; ///< normal and tangential, of a layer in a bed
};
constexpr std::array settings{Setting{"beds, damping ratio 0.1", 0.1}, Setting{"beds, damping ratio 0.5", 0.5}};

/// A plane is the face of a fixed drum that is wider by this.
constexpr double plane_radii = 10;

Solid solid_of(const Drum& d, double centre_height_m)
{
    const double r2 = d.radius_m * d.radius_m, across = d.mass_kg * (r2 / 4 + d.half_height_m * d.half_height_m / 3);
    Solid s;
    s.bottom = s.top = {true, d.radius_m, d.radius_m};
    s.height_m = 2 * d.half_height_m;
    s.mass_kg = d.mass_kg;
    s.inertia_kg_m2 = {across, d.mass_kg * r2 / 2, across};
    s.centre_m = {0, centre_height_m, 0};
    s.centre_height_m = d.half_height_m;
    s.fixed = d.fixed;
    return s;
}

/// Upright, with faces that just touch.
Realization realization_of(const SpaceScene& scene, const Setting& setting, double stiffness_n_m3)
{
    Realization r;
    r.gravity_m_s2 = scene.gravity_m_s2;
    double top_m = 0;
    if (scene.on_plane()) {
        Drum plane = scene.drums.front();
        plane.radius_m *= plane_radii;
        plane.fixed = true;
        r.space.solids.push_back(solid_of(plane, -plane.half_height_m));
    } else {
        top_m = -2 * scene.drums.front().half_height_m;
    }
    for (const Drum& d : scene.drums) {
        r.space.solids.push_back(solid_of(d, top_m + d.half_height_m));
        top_m += 2 * d.half_height_m;
    }
    r.space.drums = static_cast<int>(r.space.solids.size());
    for (int i = 1; i < r.space.drums; ++i) {
        const Solid &lower = r.space.solids[static_cast<std::size_t>(i - 1)],
                    &upper = r.space.solids[static_cast<std::size_t>(i)];
        const double area = std::numbers::pi * std::pow(upper.bottom.half_x_m, 2);
        SolidJoint j;
        j.lower = i - 1;
        j.upper = i;
        j.point_m = {0, upper.centre_m[1] - upper.centre_height_m, 0};
        j.lower_face = lower.top;
        j.upper_face = upper.bottom;
        j.normal_stiffness_n_m3 = stiffness_n_m3;
        j.tangential_stiffness_n_m = stiffness_n_m3 * area;
        j.normal_damping_n_s_m3 = j.tangential_damping_n_s_m3 =
            2 * setting.damping_ratio * std::sqrt(stiffness_n_m3 * upper.mass_kg / area);
        j.friction = scene.friction;
        r.space.joints.push_back(j);
    }
    r.step_s = RunSpec{}.step_fraction * spatial_step_bound_s(r);
    return r;
}

bool upright(const Drum& d)
{
    return d.attitude.w == 1;
}

/// The scene in the lanes of a register: every lane is the same realization.
class OwnLanes {
public:
    OwnLanes(const SpaceScene& scene, const Setting& setting, double stiffness_n_m3, Isa isa)
        : realization_(realization_of(scene, setting, stiffness_n_m3)), topology_(realization_.space),
          table_(kernels(isa)),
          numbers_(spatial::bundle_registers(topology_.kernel()) * static_cast<std::size_t>(table_.lanes)),
          memory_(aligned_array<double>(numbers_)),
          bundle_(spatial::bind_bundle(topology_.kernel(), table_.lanes, memory_.get())),
          ground_(scene.on_plane() ? 1 : 0)
    {
        for (int lane = 0; lane < table_.lanes; ++lane) {
            store_solids(realization_, topology_, bundle_, lane);
            for (int i = 0; i < topology_.kernel().bodies; ++i) { // nothing is asked of falls
                bundle_.at(OfBody::least_y, i, lane) = -std::numeric_limits<double>::max();
                bundle_.at(OfBody::least_upright, i, lane) = -2;
            }
            start(scene, lane);
        }
    }

    int lanes() const { return table_.lanes; }
    double step_s() const { return realization_.step_s; }
    int body(std::size_t drum) const { return topology_.place_of(drum + static_cast<std::size_t>(ground_)); }
    const Solid& solid(std::size_t drum) const
    {
        return realization_.space.solids[drum + static_cast<std::size_t>(ground_)];
    }
    SpaceVector vector(OfBody::Field field, int i) const
    {
        return {bundle_.at(field, i, 0), bundle_.at(static_cast<OfBody::Field>(field + 1), i, 0),
                bundle_.at(static_cast<OfBody::Field>(field + 2), i, 0)};
    }
    double of_body(OfBody::Field field, int i) const { return bundle_.at(field, i, 0); }

    /// The ground's acceleration in a step of the chunk.
    void shake(int step, const SpaceVector& a)
    {
        const double dt2 = step_s() * step_s();
        for (int lane = 0; lane < lanes(); ++lane) {
            bundle_.at(OfBaseX::second, step, lane) = dt2 * a.x;
            bundle_.at(OfBaseY::second, step, lane) = dt2 * a.y;
            bundle_.at(OfBaseZ::second, step, lane) = dt2 * a.z;
        }
    }
    void run(int steps) { table_.spatial.run(topology_.kernel(), bundle_, 0, steps); }

private:
    void set(OfBody::Field field, int i, int lane, const SpaceVector& v)
    {
        bundle_.at(field, i, lane) = v.x;
        bundle_.at(static_cast<OfBody::Field>(field + 1), i, lane) = v.y;
        bundle_.at(static_cast<OfBody::Field>(field + 2), i, lane) = v.z;
    }

    void start(const SpaceScene& scene, int lane)
    {
        if (std::all_of(scene.drums.begin(), scene.drums.end(), upright))
            settle(realization_, topology_, bundle_, lane);
        else
            lean(scene, lane);
        for (std::size_t n = 0; n < scene.drums.size(); ++n) {
            const Drum& d = scene.drums[n];
            if (d.fixed)
                continue;
            const auto turn = spatial::minus_identity(d.attitude);
            const SpaceVector own = rotated_back(turn, d.omega_rad_s);
            const auto& inertia = solid(n).inertia_kg_m2;
            const SpaceVector momentum{inertia[0] * own.x, inertia[1] * own.y, inertia[2] * own.z};
            set(OfBody::dx, body(n), lane, step_s() * d.velocity_m_s);
            set(OfBody::l_x, body(n), lane, step_s() * rotated(turn, momentum));
        }
    }

    /// The last drum leans, as deep in what is below it that the bed carries its weight.
    void lean(const SpaceScene& scene, int lane)
    {
        const std::size_t last = scene.drums.size() - 1;
        const Drum& d = scene.drums[last];
        const int i = body(last), joint = topology_.kernel().joints - 1;
        bundle_.at(OfBody::q_w, i, lane) = d.attitude.w;
        set(OfBody::q_x, i, lane, {d.attitude.x, d.attitude.y, d.attitude.z});
        const auto& from = solid(last).centre_m;
        const SpaceVector displacement = d.centre_m - SpaceVector{from[0], from[1], from[2]};
        const std::vector<double> kept(memory_.get(), memory_.get() + numbers_);
        double low = 0, high = 0.01 * d.radius_m;
        for (int n = 0; n < 60; ++n) {
            const double sink = (low + high) / 2;
            set(OfBody::x, i, lane, displacement - SpaceVector{0, sink, 0});
            run(1);
            const bool carries = bundle_.at(OfJoint::normal, joint, lane) >= d.mass_kg * scene.gravity_m_s2;
            std::copy(kept.begin(), kept.end(), memory_.get());
            (carries ? high : low) = sink;
        }
        set(OfBody::x, i, lane, displacement - SpaceVector{0, (low + high) / 2, 0});
    }

    Realization realization_;
    SolidTopology topology_;
    const KernelTable& table_;
    std::size_t numbers_;
    AlignedArray<double> memory_;
    spatial::Bundle bundle_;
    int ground_; ///< solids before the first drum
};

/// One realization of it.
class OwnInSpace final : public SpaceWorld {
public:
    explicit OwnInSpace(std::unique_ptr<OwnLanes> lanes) : lanes_(std::move(lanes)) {}
    void step(const SpaceVector& a) override
    {
        lanes_->shake(0, a);
        lanes_->run(1);
    }
    SpacePose pose(std::size_t drum) const override
    {
        const int i = lanes_->body(drum);
        const auto& from = lanes_->solid(drum).centre_m;
        if (i < 0) // it touches nothing that moves
            return {{from[0], from[1], from[2]}, {1, 0, 0, 0}};
        const SpaceVector q = lanes_->vector(OfBody::q_x, i);
        return {SpaceVector{from[0], from[1], from[2]} + lanes_->vector(OfBody::x, i),
                {lanes_->of_body(OfBody::q_w, i), q.x, q.y, q.z}};
    }

private:
    std::unique_ptr<OwnLanes> lanes_;
};

/// The best of three times one simulated second, over the realizations of a register.
double own_cost_s(const SpaceScene& scene, const Setting& setting, double stiffness_n_m3)
{
    OwnLanes lanes(scene, setting, stiffness_n_m3, best_isa());
    for (int step = 0; step < chunk_steps; ++step)
        lanes.shake(step, {1, 0, 0.3}); // a steady push costs what a shaking does
    const auto chunks = static_cast<long>(std::ceil(1 / (lanes.step_s() * chunk_steps)));
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 3; ++n) {
        const double begin = processor_seconds();
        for (long k = 0; k < chunks; ++k)
            lanes.run(chunk_steps);
        best = std::min(best, (processor_seconds() - begin) /
                                  (static_cast<double>(chunks) * chunk_steps * lanes.step_s() * lanes.lanes()));
    }
    return best;
}

} // namespace

std::vector<SpaceContender> own_in_space()
{
    std::vector<SpaceContender> all;
    for (const Setting& setting : settings) {
        SpaceContender c;
        c.engine = "Stylobate";
        c.version = code_version();
        c.setting = setting.name;
        c.own = true;
        c.dials = {2e9, 1e11, 5e12};
        c.make = [&setting](const SpaceScene& scene, double stiffness_n_m3) {
            auto lanes = std::make_unique<OwnLanes>(scene, setting, stiffness_n_m3, Isa::scalar);
            const double step_s = lanes->step_s();
            return SpaceRun{std::make_unique<OwnInSpace>(std::move(lanes)), step_s};
        };
        c.cost_s = [&setting](const SpaceScene& scene, double stiffness_n_m3) {
            return own_cost_s(scene, setting, stiffness_n_m3);
        };
        all.push_back(std::move(c));
    }
    return all;
}

} // namespace stylobate::peers
