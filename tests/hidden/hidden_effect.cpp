#include "tests/hidden/hidden_effect.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace stylobate::hidden {

namespace {

/// What a draw of place and strength has at hand.
struct Drawing {
    const Planned& planned;
    const Model& model;
    Draws& draws;
    HiddenEffect& made;

    double width() const { return planned.specimen.half_width_m.front() * 2; }
    /// Velocity of a table that shakes the specimen hard at its middle frequency.
    double speed() const
    {
        return planned.rocking_m_s2 / (6.28 * std::sqrt(planned.band.low_hz * planned.band.high_hz));
    }
    double weight() const { return planned.specimen.mass_kg.front() * planned.specimen.gravity_m_s2; }

    /// One bed, as the place of the effect.
    BedEffect& a_bed()
    {
        const int bed = draws.below(model.bed_count);
        made.place = "joint " + std::to_string(bed);
        return made.effects.beds[static_cast<std::size_t>(bed)];
    }
    BodyEffect& a_body()
    {
        const int body = draws.below(model.body_count);
        made.place = "block " + std::to_string(body);
        return made.effects.bodies[static_cast<std::size_t>(body)];
    }
    template <class Change>
    void all_beds(Change change)
    {
        made.place = "all";
        for (int j = 0; j < model.bed_count; ++j)
            change(made.effects.beds[static_cast<std::size_t>(j)]);
    }
    template <class Change>
    void all_bodies(Change change)
    {
        made.place = "all";
        for (int i = 0; i < model.body_count; ++i)
            change(made.effects.bodies[static_cast<std::size_t>(i)], i);
    }
    BaseEffect& base()
    {
        made.place = "base";
        return made.effects.base;
    }
    double size(const char* parameter, double value)
    {
        made.parameter = parameter;
        return made.size = value;
    }
    /// Weight of what lies above a bed's lower face, without the parts that other columns carry.
    double pressed(const BedEffect& bed) const
    {
        const auto j = static_cast<std::size_t>(&bed - made.effects.beds.data());
        const Specimen& s = planned.specimen;
        const double from = s.rest_y_m[static_cast<std::size_t>(s.joints[j].second)];
        double mass = 0, columns = 0;
        for (std::size_t i = 0; i < s.mass_kg.size(); ++i)
            if (s.rest_y_m[i] >= from - 1e-9)
                mass += s.mass_kg[i];
        for (const auto& joint : s.joints)
            columns += std::abs(s.rest_y_m[static_cast<std::size_t>(joint.second)] - from) < 1e-9 ? 1 : 0;
        return mass * s.gravity_m_s2 / columns;
    }
};

using Draw1 = std::function<void(Drawing&)>;

/// The mechanisms.
const std::vector<std::pair<std::string, Draw1>>& listed()
{
    static const std::vector<std::pair<std::string, Draw1>> effects = {
        {"stribeck",
         [](Drawing& d) {
             const double ratio = d.size("dynamic_ratio", d.draws.uniform(0.4, 0.9));
             const double over = d.speed() * d.draws.log_uniform(0.03, 0.4);
             d.all_beds([&](BedEffect& bed) {
                 bed.dynamic_ratio = ratio;
                 bed.stribeck_m_s = over;
             });
         }},
        {"joint_friction",
         [](Drawing& d) {
             const bool less = d.draws.chance(0.8);
             d.a_bed().friction_ratio = d.size("ratio", less ? d.draws.uniform(0.4, 0.9) : d.draws.uniform(1.12, 1.6));
         }},
        {"drag",
         [](Drawing& d) { // part of the weight at the velocity of a hard shaking
             const double c =
                 d.size("coefficient_n_s2_m2", d.draws.log_uniform(0.02, 0.5) * d.weight() / (d.speed() * d.speed()));
             d.all_bodies([&](BodyEffect& body, int) { body.drag_kg_m = c; });
         }},
        {"corner_loss",
         [](Drawing& d) {
             BedEffect& bed = d.a_bed();
             const double chip = d.size("loss_m", d.width() * d.draws.log_uniform(0.015, 0.15));
             (d.draws.chance(0.5) ? bed.chip_left_m : bed.chip_right_m) = chip;
         }},
        {"hertz",
         [](Drawing& d) {
             const double more = d.size("exponent_change", d.draws.uniform(-0.5, 1.5));
             d.made.size_comparable = false;
             d.made.is_law = true;
             d.all_beds([&](BedEffect& bed) { bed.exponent_change = more; });
         }},
        {"rate_damping",
         [](Drawing& d) {
             d.a_bed().rate_factor = d.size("factor", d.draws.log_uniform(2, 15));
             d.made.size_comparable = false;
         }},
        {"face_damping",
         [](Drawing& d) { // of the critical damping of a corner under one block's weight
             BedEffect& bed = d.a_bed();
             const Body& body = d.model.bodies[0];
             const double stiffness = 0.75 * body.mass_kg * d.model.gravity_m_s2 / d.model.parameters.reference_m;
             bed.end_dashpot_n_s_m =
                 d.size("dashpot_n_s_m", d.draws.log_uniform(0.05, 0.5) * 2 * std::sqrt(stiffness * body.mass_kg));
             d.made.size_comparable = false;
         }},
        {"friction_wear",
         [](Drawing& d) { // friction lost over a path of a tenth of the width
             const double k = d.size("wear_per_m", d.draws.log_uniform(0.1, 1.5) / (0.1 * d.width()));
             d.a_bed().wear_per_m = k;
             d.made.effects.persists = d.draws.chance(0.5);
         }},
        {"corner_wear",
         [](Drawing& d) {
             const double k = d.size("corner_wear_m_rad", d.width() * d.draws.log_uniform(0.01, 0.1));
             d.a_bed().corner_wear_m_rad = k;
             d.made.effects.persists = d.draws.chance(0.5);
         }},
        {"table_pitch",
         [](Drawing& d) { // rotation at the acceleration at which the specimen begins to rock
             d.base().pitch_rad_s2_m =
                 d.size("rotation_rad_s2_m", d.draws.sign() * d.draws.log_uniform(5e-4, 2e-2) / d.planned.rocking_m_s2);
         }},
        {"vertical_motion",
         [](Drawing& d) {
             BaseEffect& base = d.base();
             if (d.draws.chance(0.5)) {
                 base.vertical_ratio = d.size("ratio", d.draws.sign() * d.draws.log_uniform(0.05, 0.5));
             } else {
                 base.vertical_m_s2 = d.size("peak_m_s2", d.draws.log_uniform(0.3, 3));
                 base.vertical_hz = d.draws.uniform(1.2, 2.5) * d.planned.band.high_hz;
                 d.made.size_comparable = false;
             }
         }},
        {"harmonic_distortion",
         [](Drawing& d) {
             BaseEffect& base = d.base();
             base.distortion_order = 2 + d.draws.below(2);
             base.distortion_ratio = d.size("ratio", d.draws.sign() * d.draws.log_uniform(0.04, 0.35));
         }},
        {"time_offset",
         [](Drawing& d) { // of a period of the middle frequency
             const double period = 1 / std::sqrt(d.planned.band.low_hz * d.planned.band.high_hz);
             d.base().time_offset_s = d.size("offset_s", d.draws.sign() * period * d.draws.log_uniform(0.01, 0.1));
         }},
        {"sensor_gain",
         [](Drawing& d) {
             const double off = d.draws.log_uniform(0.03, 0.25);
             d.base().gain = d.size("gain", d.draws.chance(0.5) ? 1 / (1 + off) : 1 + off);
         }},
        {"dowel",
         [](Drawing& d) {
             BedEffect& bed = d.a_bed();
             const double above = d.pressed(bed);
             bed.dowel_gap_m = d.width() * d.draws.log_uniform(0.002, 0.02);
             bed.dowel_yield_n = d.size("yield_n", above * d.draws.log_uniform(0.1, 2));
             bed.dowel_n_m = bed.dowel_yield_n / (d.width() * 0.002);
         }},
        {"adhesion",
         [](Drawing& d) { // of the friction of the same bed
             BedEffect& bed = d.a_bed();
             bed.adhesion_n_m = d.size("adhesion_n_m", d.draws.log_uniform(0.3, 2) * 0.65 * d.pressed(bed) / d.width());
         }},
        {"eccentricity",
         [](Drawing& d) {
             d.a_body().eccentricity_m =
                 d.size("offset_m", d.draws.sign() * d.width() * d.draws.log_uniform(0.008, 0.08));
         }},
        {"wedge",
         [](Drawing& d) {
             d.a_bed().wedge_rad = d.size("angle_rad", d.draws.sign() * d.draws.log_uniform(3e-4, 8e-3));
         }},
        {"drum_offset",
         [](Drawing& d) {
             d.a_body().offset_m = d.size("offset_m", d.draws.sign() * d.width() * d.draws.log_uniform(0.006, 0.06));
         }},
    };
    return effects;
}

/// The same mechanisms in another form, which no seed draws.
const std::vector<std::pair<std::string, Draw1>>& variants()
{
    static const std::vector<std::pair<std::string, Draw1>> effects = {
        {"bond",
         [](Drawing& d) { // adhesion that holds tension too, of the weight above per width
             d.made.name = "adhesion";
             BedEffect& bed = d.a_bed();
             const double weight = d.pressed(bed) / d.width();
             bed.adhesion_n_m = d.size("adhesion_n_m", d.draws.log_uniform(0.3, 2) * 0.65 * weight);
             bed.tension_n_m = d.draws.log_uniform(0.05, 0.5) * weight;
         }},
    };
    return effects;
}

/// And what no list has.
const std::vector<std::pair<std::string, Draw1>>& outside()
{
    static const std::vector<std::pair<std::string, Draw1>> effects = {
        {"heat_memory",
         [](Drawing& d) { // friction lost to the heat of sliding through a tenth of the width
             const double k = d.size("heat_per_j", d.draws.log_uniform(0.2, 2) / (0.065 * d.weight() * d.width()));
             const double time = d.draws.uniform(0.1, 0.5) * d.planned.band.duration_s;
             d.all_beds([&](BedEffect& bed) {
                 bed.heat_per_j = k;
                 bed.heat_time_s = time;
             });
         }},
        {"coriolis",
         [](Drawing& d) {
             const double w = d.size("rate_per_s", d.draws.sign() * d.draws.log_uniform(0.05, 1) *
                                                       d.planned.rocking_m_s2 / d.speed());
             d.all_bodies([&](BodyEffect& body, int) { body.coriolis_per_s = w; });
         }},
        {"magnet",
         [](Drawing& d) {
             BodyEffect& body = d.a_body();
             body.magnet_n = d.size("force_n", d.weight() * d.draws.log_uniform(0.05, 0.4));
             body.magnet_at_m = d.width() * d.draws.sign() * d.draws.uniform(0.1, 0.4);
             body.magnet_range_m = d.width() * d.draws.uniform(0.05, 0.3);
         }},
        {"direction",
         [](Drawing& d) {
             const double more = d.size("ratio", d.draws.sign() * d.draws.log_uniform(0.05, 0.4));
             d.all_beds([&](BedEffect& bed) { bed.direction = more; });
         }},
        {"draught",
         [](Drawing& d) {
             const double force = d.size("force_n", d.draws.sign() * d.weight() * d.draws.log_uniform(0.01, 0.12));
             const double from = d.draws.uniform(0.2, 0.5) * d.planned.band.duration_s;
             const double to = from + d.draws.uniform(0.1, 0.4) * d.planned.band.duration_s;
             d.all_bodies([&](BodyEffect& body, int) {
                 body.draught_n = force;
                 body.draught_from_s = from;
                 body.draught_to_s = to;
             });
         }},
        {"patch",
         [](Drawing& d) {
             BedEffect& bed = d.a_bed();
             bed.patch_drop = d.size("ratio", d.draws.uniform(0.15, 0.7));
             bed.patch_at_m = d.width() * d.draws.sign() * d.draws.uniform(0, 0.02);
             bed.patch_width_m = d.width() * d.draws.uniform(0.005, 0.02);
         }},
        {"slosh",
         [](Drawing& d) {
             BodyEffect& body = d.a_body();
             body.slosh_ratio = d.size("mass_ratio", d.draws.log_uniform(0.03, 0.3));
             body.slosh_hz = d.draws.log_uniform(d.planned.band.low_hz, 1.5 * d.planned.band.high_hz);
         }},
        {"spin",
         [](Drawing& d) { // of the moment that a block's weight has about its edge, at 1 rad/s on the small scale
             BodyEffect& body = d.a_body();
             const double turning = std::sqrt(d.planned.specimen.gravity_m_s2 / d.width());
             body.spin_n_m_s =
                 d.size("moment_n_m_s", d.draws.log_uniform(0.05, 1) * 0.5 * d.weight() * d.width() / (0.1 * turning));
         }},
    };
    return effects;
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, Draw1>>& effects)
{
    std::vector<std::string> names;
    for (const auto& effect : effects)
        names.push_back(effect.first);
    return names;
}

/// `to` takes over every member of `from` that is not neutral.
template <class Part>
void take(Part& to, const Part& from, double Part::*member)
{
    static const Part neutral;
    if (from.*member != neutral.*member)
        to.*member = from.*member;
}

} // namespace

const std::vector<std::string>& listed_names()
{
    static const std::vector<std::string> names = names_of(listed());
    return names;
}

const std::vector<std::string>& outside_names()
{
    static const std::vector<std::string> names = names_of(outside());
    return names;
}

const std::vector<std::string>& variant_names()
{
    static const std::vector<std::string> names = names_of(variants());
    return names;
}

bool applies(std::string_view name, Law law)
{
    // rigid corners have neither an exponent nor dashpots
    return law == Law::compliant || (name != "hertz" && name != "rate_damping" && name != "face_damping");
}

bool needs_command(std::string_view name)
{
    return name == "harmonic_distortion";
}

HiddenEffect draw_effect(std::string_view name, const Planned& planned, const Model& model, Draws& draws)
{
    HiddenEffect made;
    made.name = name;
    for (const auto* list : {&listed(), &variants(), &outside()})
        for (const auto& [its_name, draw] : *list)
            if (its_name == name) {
                made.listed = list != &outside();
                Drawing drawing{planned, model, draws, made};
                draw(drawing);
            }
    return made;
}

Effects together(const std::vector<HiddenEffect>& effects)
{
    Effects all;
    for (const HiddenEffect& one : effects) {
        for (std::size_t j = 0; j < max_beds; ++j) {
            BedEffect& to = all.beds[j];
            const BedEffect& from = one.effects.beds[j];
            for (const auto member :
                 {&BedEffect::friction_ratio,  &BedEffect::dynamic_ratio, &BedEffect::stribeck_m_s,
                  &BedEffect::wear_per_m,      &BedEffect::adhesion_n_m,  &BedEffect::tension_n_m,
                  &BedEffect::dowel_n_m,       &BedEffect::dowel_yield_n, &BedEffect::dowel_gap_m,
                  &BedEffect::exponent_change, &BedEffect::rate_factor,   &BedEffect::end_dashpot_n_s_m,
                  &BedEffect::chip_left_m,     &BedEffect::chip_right_m,  &BedEffect::corner_wear_m_rad,
                  &BedEffect::wedge_rad,       &BedEffect::heat_per_j,    &BedEffect::heat_time_s,
                  &BedEffect::direction,       &BedEffect::patch_drop,    &BedEffect::patch_at_m,
                  &BedEffect::patch_width_m})
                take(to, from, member);
        }
        for (std::size_t i = 0; i < max_bodies; ++i)
            for (const auto member :
                 {&BodyEffect::drag_kg_m, &BodyEffect::eccentricity_m, &BodyEffect::offset_m,
                  &BodyEffect::coriolis_per_s, &BodyEffect::magnet_n, &BodyEffect::magnet_at_m,
                  &BodyEffect::magnet_range_m, &BodyEffect::draught_n, &BodyEffect::draught_from_s,
                  &BodyEffect::draught_to_s, &BodyEffect::slosh_ratio, &BodyEffect::slosh_hz, &BodyEffect::spin_n_m_s})
                take(all.bodies[i], one.effects.bodies[i], member);
        for (const auto member :
             {&BaseEffect::pitch_rad_s2_m, &BaseEffect::vertical_ratio, &BaseEffect::vertical_m_s2,
              &BaseEffect::vertical_hz, &BaseEffect::distortion_ratio, &BaseEffect::time_offset_s, &BaseEffect::gain})
            take(all.base, one.effects.base, member);
        if (one.effects.base.distortion_ratio != 0)
            all.base.distortion_order = one.effects.base.distortion_order;
        all.persists = all.persists || one.effects.persists;
    }
    return all;
}

} // namespace stylobate::hidden
