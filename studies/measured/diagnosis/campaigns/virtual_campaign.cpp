#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"

#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "io/measured/measured_check.hpp"
#include "io/measured/measured_motion.hpp"
#include "io/store/result_seal.hpp"
#include "studies/measured/diagnosis/campaigns/candidate_causes.hpp"
#include "studies/measured/diagnosis/evidence/law_samples.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

namespace stylobate {

namespace {

/// Places in the stream of a specimen's draws: far behind those of its scatter. Numbers are permanent.
enum class LawDraw : std::uint64_t {
    stiffness = 1u << 16,
    shear,
    exponent,
    damping,
    tangential_damping,
    where,
    face_share,
    rate,
    inset,
    friction
};

constexpr double impact_part = 0.1; // of sqrt(g x height)
constexpr double least_tangential = 0.01, most_tangential = 0.2;

struct Range {
    double least, most;
};

/// Ratios of the dashpots.
Range damping_of(DampingKind kind)
{
    switch (kind) {
    case DampingKind::light:
    case DampingKind::rate:
        return {0.003, 0.03};
    case DampingKind::dashpot:
        return {0.03, 0.5};
    case DampingKind::plastic:
        return {0.5, 1};
    }
    return {};
}

double log_uniform(Range range, double u)
{
    return range.least * std::pow(range.most / range.least, u);
}

double rate_of(DampingKind kind, double u)
{
    switch (kind) {
    case DampingKind::light:
        return 0;
    case DampingKind::rate:
        return log_uniform({0.5, 5}, u);
    case DampingKind::dashpot:
    case DampingKind::plastic:
        return u;
    }
    return 0;
}

} // namespace

double safe_step_s(const Realization& realization)
{
    Realization linear = realization;
    bool softens = false;
    for (Joint& joint : linear.joints) {
        softens = softens || joint.mechanisms.force_exponent < 1;
        joint.mechanisms.force_exponent = 1;
    }
    const double step = step_bound(realization).dt_s;
    return softens ? std::min(step, step_bound(linear).dt_s) : step;
}

const char* to_string(DampingKind kind)
{
    constexpr const char* words[] = {"light", "dashpot", "rate", "plastic"};
    return words[static_cast<std::size_t>(kind)];
}

HealthyLaw draw_law(const LawFamily& family, std::uint64_t seed, std::uint64_t number)
{
    const auto draw = [&](LawDraw which) {
        return uniform01(seed, number, Stream::virtual_specimen, static_cast<std::uint64_t>(which));
    };
    HealthyLaw law;
    law.form = family.forms[number % family.forms.size()];
    law.kind = family.kinds[number / family.forms.size() % family.kinds.size()];
    law.stiffness = log_uniform({family.least_stiffness, family.most_stiffness}, draw(LawDraw::stiffness));
    law.shear = log_uniform({family.least_shear, family.most_shear}, draw(LawDraw::shear));
    law.exponent =
        law.form == ContactForm::points
            ? log_uniform({family.least_points_exponent, family.most_points_exponent}, draw(LawDraw::exponent))
            : log_uniform({family.least_exponent, family.most_exponent}, draw(LawDraw::exponent));
    law.damping = log_uniform(damping_of(law.kind), draw(LawDraw::damping));
    law.tangential_damping = log_uniform({least_tangential, most_tangential}, draw(LawDraw::tangential_damping));
    law.face_share = draw(LawDraw::where) < 0.5 ? draw(LawDraw::face_share) : 1;
    law.rate = rate_of(law.kind, draw(LawDraw::rate));
    law.inset = family.most_inset * std::pow(draw(LawDraw::inset), 2);
    law.friction = std::exp(family.common_friction * to_normal(draw(LawDraw::friction)));
    return law;
}

HealthyLaw draw_near(const LawFamily& family, const HealthyLaw& parent, double spread, std::uint64_t seed,
                     std::uint64_t number)
{
    const auto normal = [&](LawDraw which) {
        return to_normal(uniform01(seed, number, Stream::virtual_specimen, static_cast<std::uint64_t>(which)));
    };
    const auto moved = [&](double value, double part, LawDraw which, double least, double most) {
        return std::clamp(value * std::exp(part * spread * normal(which)), least, most);
    };
    HealthyLaw law = parent;
    law.stiffness = moved(law.stiffness, 1, LawDraw::stiffness, family.least_stiffness, family.most_stiffness);
    law.shear = moved(law.shear, 1, LawDraw::shear, family.least_shear, family.most_shear);
    const bool points = law.form == ContactForm::points;
    law.exponent =
        moved(law.exponent, 0.25, LawDraw::exponent, points ? family.least_points_exponent : family.least_exponent,
              points ? family.most_points_exponent : family.most_exponent);
    law.damping = moved(law.damping, 1, LawDraw::damping, 1e-3, 1);
    law.tangential_damping =
        moved(law.tangential_damping, 1, LawDraw::tangential_damping, least_tangential, most_tangential);
    law.face_share = std::clamp(law.face_share + 0.3 * spread * normal(LawDraw::face_share), 0.0, 1.0);
    law.rate *= std::exp(spread * normal(LawDraw::rate));
    law.inset =
        std::clamp(law.inset + 0.3 * spread * family.most_inset * normal(LawDraw::inset), 0.0, family.most_inset);
    law.friction *= std::exp(0.9 * spread * family.common_friction * normal(LawDraw::friction));
    return law;
}

void apply_law(const HealthyLaw& law, Study& study)
{
    study.contact.form = law.form;
    study.contact.normal_stiffness_n_m2 *= law.stiffness;
    study.contact.tangential_stiffness_n_m *= law.stiffness * law.shear;
    study.contact.normal_damping_ratio = law.damping;
    study.contact.tangential_damping_ratio = law.tangential_damping;
    study.contact.normal_damping_n_s_m.reset();
    study.contact.tangential_damping_n_s_m.reset();
    study.contact.friction *= law.friction;
}

void apply_law(const HealthyLaw& law, const Specimen& specimen, const SpecimenStructure& built, double step_fraction,
               Realization& r)
{
    double height = 0;
    for (const double y : specimen.rest_y_m)
        height = std::max(height, y);
    const double impact = impact_part * std::sqrt(specimen.gravity_m_s2 * height);
    r.with_mechanisms = true;
    for (Joint& joint : r.joints) {
        JointMechanisms& e = joint.mechanisms;
        e.face_damping += (1 - e.face_damping) * law.face_share;
        e.rate_s_m += law.rate / impact;
    }
    const std::vector<double> weights = rest_weights(specimen);
    for (std::size_t j = 0; j < built.bed.size(); ++j) {
        Joint& joint = r.joints[static_cast<std::size_t>(built.bed[j])];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        const double inset = law.inset * std::min(lower.half_width_m, upper.half_width_m);
        joint.mechanisms.chip_left_m += inset;
        joint.mechanisms.chip_right_m += inset;
        if (law.exponent != 1) {
            joint.mechanisms.force_exponent = law.exponent;
            // the beds rest alike, whatever the exponent
            joint.mechanisms.reference_overlap_m2 = weights[j] / joint.normal_stiffness_n_m2;
        }
    }
    r.step_s = step_fraction * safe_step_s(r);
}

namespace {

constexpr double common_friction = 0.03; // 1 sigma, relative
constexpr double joint_friction = 0.03;  // likewise, of each joint
// A block has fallen whose centre is below this part of its height at rest, or that leans by more.
constexpr double fallen = 0.6;
constexpr double most_lean = 0.8; // rad

std::uint32_t crc(const std::vector<double>& values, std::uint32_t before)
{
    return crc32_of(std::as_bytes(std::span(values)), before);
}

/// Numbers of one campaign, one after the other.
class Draws {
public:
    Draws(std::uint64_t seed, std::uint64_t campaign, Stream stream) : seed_(seed), campaign_(campaign), stream_(stream)
    {
    }
    double uniform() { return uniform01(seed_, campaign_, stream_, next_++); }
    double normal() { return to_normal(uniform()); }
    void skip(std::uint64_t draws) { next_ += draws; }

private:
    std::uint64_t seed_, campaign_;
    Stream stream_;
    std::uint64_t next_ = 0;
};

} // namespace

Realization draw_specimen(const Specimen& specimen, const Study& about, const SpecimenStructure& built,
                          std::uint64_t seed, std::uint64_t number, const HealthyLaw* law,
                          const std::vector<SizedCause>& causes)
{
    Draws draw(seed, number, Stream::virtual_specimen);
    Study study = about;
    double friction = 1; // of all joints, over the study's
    if (law) {
        apply_law(*law, study);
    } else { // a draw keeps its place: those beside the friction were of contacts
        draw.skip(2);
        friction = 1 + common_friction * draw.normal();
        draw.skip(draw.uniform() < 0.5 ? 4 : 3);
    }
    Realization r = nominal_realization(study, built.structure);
    for (Joint& joint : r.joints)
        joint.friction *= friction * (1 + joint_friction * draw.normal());
    for (Block& block : r.blocks) {
        const double wider = 1 + specimen.width_tolerance * draw.normal();
        const double heavier = 1 + specimen.mass_tolerance * draw.normal();
        if (block.fixed)
            continue;
        block.half_width_m *= wider;
        block.mass_kg *= heavier;
        block.inertia_kg_m2 *= heavier * wider * wider;
    }
    r.with_mechanisms = true;
    for (const SizedCause& cause : causes)
        apply_cause(cause, built, r);
    if (law)
        apply_law(*law, specimen, built, study.run.step_fraction, r);
    return r;
}

namespace {

/// Displacement of the base at the cameras' samples.
std::vector<double> displacement_at_samples(const MeasuredRun& run, const Motion& base)
{
    std::vector<double> out;
    for (const double time_s : run.time_s) {
        const double at = std::clamp((time_s - run.time_s.front()) / base.dt_s, 0.0,
                                     static_cast<double>(base.displacement_m.size() - 1));
        const auto k0 = std::min(static_cast<std::size_t>(at), base.displacement_m.size() - 2);
        const double part = at - static_cast<double>(k0);
        out.push_back((1 - part) * base.displacement_m[k0] + part * base.displacement_m[k0 + 1]);
    }
    return out;
}

/// Where the blocks of the specimen are at the cameras' samples, with their noise.
/// @param base_m displacement of the base at these samples
void see(const Campaign& measured, const MeasuredRun& source, const SpecimenStructure& built, const Realization& r,
         const std::vector<double>& base_m, const Readings& readings, Draws& noise, MeasuredRun& run)
{
    const Specimen& s = measured.specimen;
    const std::size_t columns = s.half_width_m.size(), blocks = r.blocks.size(), n = source.time_s.size();
    const auto missing = std::numeric_limits<double>::quiet_NaN();
    run.blocks = source.blocks;
    run.collapsed = false;
    run.collapse_time_s = -1;
    std::size_t fell = n;
    for (std::size_t i = 0; i < n && fell == n; ++i)
        for (std::size_t b = 0; b < columns; ++b) {
            const auto k = static_cast<std::size_t>(built.block[b]);
            const double y = r.blocks[k].y_m + readings.y_m[i * blocks + k];
            if (!std::isfinite(y) || y < fallen * r.blocks[k].y_m ||
                std::fabs(readings.theta_rad[i * blocks + k]) > most_lean)
                fell = i;
        }
    if (fell < n) {
        run.collapsed = true;
        run.collapse_time_s = source.time_s[fell];
    }
    for (Series* series : {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad})
        series->values.assign(n * columns, missing);
    for (std::size_t i = 0; i < fell; ++i) {
        const double moved = base_m[i];
        for (std::size_t b = 0; b < columns; ++b) {
            const auto k = static_cast<std::size_t>(built.block[b]);
            const std::size_t row = i * blocks + k, out = i * columns + b;
            run.blocks.x_m.values[out] = built.origin_x_m + r.blocks[k].x_m + readings.x_m[row] + moved +
                                         source.blocks.x_m.noise_sd.value_or(0) * noise.normal();
            run.blocks.y_m.values[out] = built.origin_y_m + r.blocks[k].y_m + readings.y_m[row] +
                                         source.blocks.y_m.noise_sd.value_or(0) * noise.normal();
            run.blocks.theta_rad.values[out] =
                readings.theta_rad[row] + source.blocks.theta_rad.noise_sd.value_or(0) * noise.normal();
        }
    }
}

/// @param draw one number for each block, in any case
void put_blocks(const VirtualLaboratory& laboratory, std::size_t run, const HealthyScatter& scatter, Draws& draw,
                Realization& r)
{
    const SeenPlaces& seen = laboratory.placed[run];
    const bool as_seen = scatter.placed_as_seen && !seen.offset_m.empty();
    if (as_seen)
        for (std::size_t b = 0; b < seen.offset_m.size(); ++b)
            r.blocks[static_cast<std::size_t>(laboratory.built.block[b])].x_m += seen.offset_m[b];
    const double sd = as_seen ? seen.sd_m : laboratory.measured.specimen.placement_tolerance_m;
    for (Block& block : r.blocks)
        if (!block.fixed)
            block.x_m += sd * draw.normal();
}

} // namespace

std::string campaign_key(const Campaign& campaign, const Study& study, std::uint64_t seed)
{
    const Specimen& s = campaign.specimen;
    std::uint32_t sum = 0;
    for (const auto* values : {&s.half_width_m, &s.half_height_m, &s.depth_m, &s.mass_kg, &s.rest_x_m, &s.rest_y_m})
        sum = crc(*values, sum);
    sum = crc({s.gravity_m_s2, s.friction_nominal.value_or(-1), s.mass_tolerance, s.width_tolerance,
               s.placement_tolerance_m, s.base_block_half_width_m.value_or(-1), s.base_block_top_m},
              sum);
    for (const auto& [lower, upper] : s.joints)
        sum = crc({static_cast<double>(lower), static_cast<double>(upper)}, sum);
    for (const MeasuredRun& run : campaign.runs) {
        sum = crc(run.time_s, sum);
        sum = crc(run.base_displacement_m.values, sum);
        sum = crc(run.base_acceleration_m_s2.values, sum);
        sum = crc(seen_places(s, run).offset_m, sum);
        sum = crc({run.blocks.x_m.noise_sd.value_or(-1), run.blocks.y_m.noise_sd.value_or(-1),
                   run.blocks.theta_rad.noise_sd.value_or(-1)},
                  sum);
    }
    const ContactSpec& c = study.contact;
    sum = crc({c.normal_stiffness_n_m2, c.tangential_stiffness_n_m, c.friction, static_cast<double>(seed)}, sum);
    return fmt::format("{} {:08x}", code_version(), sum);
}

SeenPlaces seen_places(const Specimen& specimen, const MeasuredRun& run)
{
    constexpr std::size_t fewest = 20; // in the last of these the base may move: slowly at first
    const std::size_t rest = std::max(fewest, samples_at_rest(run));
    if (run.blocks.x_m.empty() || run.time_s.size() < rest)
        return {};
    std::vector<double> place = places_at_rest(specimen, run, rest);
    if (run.table.x_m.empty()) {
        double sum = 0, count = 0;
        for (const auto& [lower, upper] : specimen.joints)
            if (lower < 0) {
                sum += place[static_cast<std::size_t>(upper)];
                ++count;
            }
        for (double& x : place)
            x -= sum / count;
    }
    if (!std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }))
        return {};
    return {std::move(place), run.blocks.x_m.noise_sd.value_or(0) / std::sqrt(static_cast<double>(rest))};
}

VirtualLaboratory::VirtualLaboratory(const Campaign& campaign)
    : measured(campaign), built(build_specimen(campaign.specimen)), base(campaign.runs.size()),
      times_s(campaign.runs.size()), base_m(campaign.runs.size())
{
    in_parallel(std::size_t{0}, measured.runs.size(), [&](std::size_t i) {
        const MeasuredRun& run = measured.runs[i];
        if (!run.has_base() || !run.has_blocks())
            return;
        base[i] = std::make_shared<const Motion>(base_motion_of(run));
        base_m[i] = displacement_at_samples(run, *base[i]);
        auto seen = std::make_shared<std::vector<double>>();
        for (const double t : run.time_s)
            seen->push_back(t - run.time_s.front());
        times_s[i] = seen;
    });
    for (const MeasuredRun& run : measured.runs)
        placed.push_back(seen_places(measured.specimen, run));
    before = joint_paths(measured, campaign_scales(measured), base_m).before;
}

VirtualCampaigns virtual_campaigns(const VirtualLaboratory& laboratory, const Study& study, std::uint64_t seed,
                                   std::uint64_t first, std::uint64_t count, const HealthyScatter& scatter,
                                   const std::vector<std::vector<SizedCause>>& causes, const RunOptions& options,
                                   Observer& observer)
{
    assert((scatter.laws.empty() || scatter.laws.size() == count) && "one law for each campaign");
    const Campaign& measured = laboratory.measured;
    const SpecimenStructure& built = laboratory.built;
    VirtualCampaigns out;
    out.base_m = laboratory.base_m;
    std::vector<TrackingJob> jobs;
    std::vector<std::pair<std::size_t, std::size_t>> job_of; // campaign, run
    for (std::uint64_t c = 0; c < count; ++c) {
        const std::vector<SizedCause> acting =
            causes.empty() ? std::vector<SizedCause>() : causes[causes.size() > 1 ? c : 0];
        const Realization specimen = draw_specimen(measured.specimen, study, built, seed, first + c,
                                                   scatter.laws.empty() ? nullptr : &scatter.laws[c], acting);
        Campaign campaign;
        campaign.source = fmt::format("virtual campaign {}", first + c);
        campaign.specimen = measured.specimen;
        campaign.runs = measured.runs;
        Draws put(seed, first + c, Stream::virtual_placement);
        for (std::size_t i = 0; i < measured.runs.size(); ++i) {
            campaign.runs[i].table = {};
            TrackingJob job;
            job.realization = specimen;
            put_blocks(laboratory, i, scatter, put, job.realization);
            if (!laboratory.base[i])
                continue;
            for (const SizedCause& cause : acting)
                carry_wear(cause, built, laboratory.before[i], job.realization);
            job.realization.motion = laboratory.base[i];
            job.watched_s = laboratory.times_s[i];
            jobs.push_back(std::move(job));
            job_of.emplace_back(static_cast<std::size_t>(c), i);
        }
        out.campaigns.push_back(std::move(campaign));
    }
    const TrackingReport report = track(jobs, options, observer);
    out.cost = {jobs.size(), 0, report.block_steps};
    out.complete = report.complete;
    if (!out.complete)
        return out;
    // each run has noise of its own, so that their order does not matter
    tbb::task_arena(options.threads).execute([&] {
        in_parallel(std::size_t{0}, jobs.size(), [&](std::size_t j) {
            const auto [c, i] = job_of[j];
            Draws noise(seed, (first + c) * measured.runs.size() + i, Stream::camera_noise);
            see(measured, measured.runs[i], built, jobs[j].realization, out.base_m[i], report.results[j].watched, noise,
                out.campaigns[c].runs[i]);
        });
    });
    return out;
}

} // namespace stylobate
