#include "ensemble/sampling/plausible.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/numerics/unit_slip.hpp"
#include "ensemble/planar/structure/nominal_statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace stylobate {
namespace {

/// Largest accelerations that were recorded: 40.2 m/s2 as the vector of three components, 14.3 m/s2 of a horizontal
/// one (IWTH25, Iwate-Miyagi Nairiku 2008), 27.0 m/s2 of a horizontal one (MYG004, Tohoku 2011); K-NET and KiK-net.
constexpr double strongest_record_m_s2 = 30, strongest_table_m_s2 = 50, no_record_m_s2 = 100;
/// Largest horizontal velocities near faults are 3 to 4 m/s (Chi-Chi 1999, TCU068); the fastest shaking tables reach 2.
constexpr double fastest_ground_m_s = 5, no_ground_m_s = 50;
/// Spectral accelerations are about 2.5 times the peak of the ground (plateau of the elastic spectrum of EN
/// 1998-1:2004).
constexpr double spectral_amplification = 2.5;
constexpr double standard_gravity = 9.80665;

using Finding = std::optional<Implausibility>;
struct Subject {
    const Study& study;
    const StudyFacts& facts;
};

/// " Did you mean cm/s2 (1.2 m/s2) or mm/s2 (0.12 m/s2)?": those with which the value is plausible.
std::string meant(double value, std::span<const UnitSlip> slips, double high, const char* unit, double low = 0.05)
{
    std::string all;
    for (const UnitSlip& slip : slips)
        if (value * slip.factor >= low && value * slip.factor <= high)
            all += fmt::format("{} {} ({:.4g} {})", all.empty() ? " Did you mean" : " or", slip.unit,
                               value * slip.factor, unit);
    return all.empty() ? all : all + "?";
}

/// "a, b, c and 4 others"
std::string some_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 4;
    const std::size_t shown = names.size() <= most + 1 ? names.size() : most;
    std::string all;
    for (std::size_t i = 0; i < shown; ++i)
        all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return shown == names.size() ? all : fmt::format("{} and {} others", all, names.size() - shown);
}

template <class... Values>
Implausibility implausible(bool refused, fmt::format_string<Values...> text, Values&&... values)
{
    return {"", refused, fmt::format(text, std::forward<Values>(values)...)};
}

/// Motions of one frequency, whose velocity decides whether a table or the ground can reach it; small structures are
/// tested with stronger and faster motions than large ones.
bool is_sine(ExcitationKind kind)
{
    return kind == ExcitationKind::harmonic || kind == ExcitationKind::half_sine || kind == ExcitationKind::full_sine ||
           kind == ExcitationKind::tapered || kind == ExcitationKind::sweep;
}

/// The range of an axis, or of what is given in its place.
struct Extent {
    double low = 0, high = 0;
};

Extent extent(const Axis& axis)
{
    return {std::min(axis.from, axis.to), std::max(axis.from, axis.to)};
}

/// Frequencies of the shaking; zeros where there are none or they are not known.
Extent shaking_hz(const Subject& s)
{
    const ExcitationSpec& e = s.study.excitation;
    const double sweep_low = std::min(e.from_hz, e.to_hz), sweep_high = std::max(e.from_hz, e.to_hz);
    if (const Axis* frequency = s.study.design().frequency_hz) {
        const Extent axis = extent(*frequency);
        if (e.kind != ExcitationKind::sweep)
            return axis;
        const double central = e.central_frequency_hz(); // to which the axis stretches it
        return {axis.low * sweep_low / central, axis.high * sweep_high / central};
    }
    if (e.kind == ExcitationKind::sweep)
        return {sweep_low, sweep_high};
    if (e.frequency_hz > 0)
        return {e.frequency_hz, e.frequency_hz};
    const double stretched = s.facts.motion_frequency_hz / e.time_scale;
    return {stretched, stretched};
}

/// The strongest of the shaking [m/s2]; 0: not known.
double strongest_m_s2(const Subject& s)
{
    if (const Axis* pga = s.study.design().pga_m_s2)
        return extent(*pga).high;
    if (const MotionSetSpec* f = s.study.design().motions) {
        const double intensity = extent(f->intensity).high;
        if (f->method == FragilityMethod::cloud)
            return f->scale * s.facts.pga_m_s2;
        return f->measure == IntensityMeasure::pga  ? intensity
               : f->measure == IntensityMeasure::sa ? intensity / spectral_amplification
                                                    : 0;
    }
    return s.study.excitation.pga_m_s2 > 0 ? s.study.excitation.pga_m_s2 : s.facts.pga_m_s2;
}

/// No structure can rest above this acceleration: some free block slides.
double sliding_bound_m_s2(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    double friction = study.contact.friction;
    for (const PlacedBed& bed : layout.beds)
        friction = std::max(friction, bed.bed.friction.value_or(friction));
    return friction * study.structure.gravity_m_s2;
}

Finding check_pga(const Subject& s)
{
    const double pga = strongest_m_s2(s);
    const ExcitationKind kind = s.study.excitation.kind;
    if (const MotionSetSpec* f = s.study.design().motions; f && f->measure == IntensityMeasure::pgv) {
        const double pgv = extent(f->intensity).high;
        if (f->method == FragilityMethod::cloud || pgv <= fastest_ground_m_s)
            return std::nullopt;
        return implausible(pgv > no_ground_m_s,
                           "The motions have velocities up to {:.4g} m/s; the largest recorded velocities are "
                           "about 4 m/s.{}",
                           pgv, meant(pgv, from_velocities, fastest_ground_m_s, "m/s"));
    }
    if (pga <= strongest_record_m_s2)
        return std::nullopt;
    const auto beyond_records = [&](bool refused) {
        return implausible(refused,
                           "The shaking has up to {:.4g} m/s2; the largest recorded horizontal "
                           "acceleration is 27 m/s2.{}",
                           pga, meant(pga, from_accelerations, strongest_record_m_s2, "m/s2"));
    };
    if (!is_sine(kind))
        return beyond_records(pga > no_record_m_s2);
    const double hz = shaking_hz(s).low;
    const double omega = 2 * std::numbers::pi * hz;
    if (!(hz > 0) || pga / omega <= fastest_ground_m_s) // a shaking table may reach it, at high frequencies
        return pga > strongest_table_m_s2 ? Finding(beyond_records(false)) : std::nullopt;
    return implausible(pga / omega > no_ground_m_s,
                       "{:.4g} m/s2 at {:.4g} Hz corresponds to a velocity of {:.3g} m/s and an amplitude of {:.3g} m; "
                       "ground motions and shaking tables reach about 4 m/s.{}",
                       pga, hz, pga / omega, pga / omega / omega,
                       meant(pga, from_accelerations, strongest_record_m_s2, "m/s2"));
}

/// Beds into which blocks sink by a considerable part of their size are too soft for stone.
Finding check_sinkage(const Subject& s)
{
    constexpr double much = 2e-3, absurd = 2e-2;
    const Layout layout = lay_out(s.study.structure);
    const std::vector<double> sinkage = static_sinkage_m(s.study);
    double worst = 0;
    std::size_t bed = 0;
    for (std::size_t i = 0; i < sinkage.size(); ++i) {
        const PlacedBlock& upper = layout.blocks[static_cast<std::size_t>(layout.beds[i].upper)];
        const double part = sinkage[i] / std::min(upper.width_m, upper.height_m);
        if (part > worst) {
            worst = part;
            bed = i;
        }
    }
    if (worst <= much)
        return std::nullopt;
    const double K_N = layout.beds[bed].bed.normal_stiffness_n_m2.value_or(s.study.contact.normal_stiffness_n_m2);
    return implausible(worst > absurd,
                       "Under its own weight {} overlaps its support by {:.3g} mm, {:.2g} % of its size: "
                       "normal_stiffness_n_m2 = {:.3g} is {} times softer than the value for 0.01 %. Does it "
                       "include the depth (a bed of stone has 1e9 to 1e10 N/m3, times the depth {:.3g} m)?",
                       layout.blocks[static_cast<std::size_t>(layout.beds[bed].upper)].name, 1000 * sinkage[bed],
                       100 * worst, K_N, static_cast<long>(std::lround(worst / 1e-4)), s.study.structure.depth_m);
}

Finding check_first_frequency(const Subject& s)
{
    const double first = first_frequency_hz(s.study);
    if (first == 0)
        return implausible(true,
                           "The structure buckles under its own weight on beds of normal_stiffness_n_m2 = "
                           "{:.3g}: they are too soft to keep it upright.",
                           s.study.contact.normal_stiffness_n_m2);
    const Extent shaking = shaking_hz(s);
    if (std::sqrt(shaking.low * shaking.high) <= first)
        return std::nullopt;
    return implausible(false,
                       "The first natural frequency of the structure on its beds is {:.3g} Hz, below {} of the "
                       "shaking: the compliance of the beds (normal_stiffness_n_m2 = {:.3g}) then governs the "
                       "response, more than the rocking of rigid blocks.",
                       first,
                       shaking.low == shaking.high
                           ? fmt::format("the {:.3g} Hz", shaking.low)
                           : fmt::format("the middle of the {:.3g} to {:.3g} Hz", shaking.low, shaking.high),
                       s.study.contact.normal_stiffness_n_m2);
}

/// A shaking below the static limit, at which no rigid block moves, that is one of an earthquake if it is in g. (A rare
/// event is one of the drawn structures, not of the nominal one.)
Finding check_weak_shaking(const Subject& s)
{
    const Study& study = s.study;
    if (study.excitation.kind == ExcitationKind::none || study.initial.tilt_rad != 0 || !study.mechanisms.empty() ||
        study.vertical || study.design().chained())
        return std::nullopt;
    constexpr double strongest_in_g = 1.5;
    const double pga = std::max(strongest_m_s2(s), s.facts.scaled_pga_m_s2), in_g = pga * standard_gravity;
    if (!(pga > 0) || pga > strongest_in_g || pga >= sliding_bound_m_s2(study))
        return std::nullopt;
    const std::optional<StaticLimit> limit = static_limit(study);
    if (!limit || pga >= limit->limit_m_s2 || in_g <= limit->limit_m_s2)
        return std::nullopt;
    return implausible(false,
                       "The strongest shaking has {:.4g} m/s2. Rigid blocks of this structure begin to "
                       "move at {:.4g} m/s2 (static limit; g B / H for a column that rocks). Did you mean "
                       "g ({:.4g} g is {:.4g} m/s2)?",
                       pga, limit->limit_m_s2, pga, in_g);
}

Finding check_scale(const Subject& s)
{
    constexpr double much = 10;
    std::vector<StudyFacts::Scaled> worst;
    for (const StudyFacts::Scaled& motion : s.facts.scaled)
        if (motion.factor > much)
            worst.push_back(motion);
    if (worst.empty())
        return std::nullopt;
    std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.factor > b.factor; });
    std::vector<std::string> names;
    for (const StudyFacts::Scaled& motion : worst)
        names.push_back(fmt::format("{} (factor {:.3g})", motion.name, motion.factor));
    return implausible(false,
                       "{} of {} motion{} from files {} scaled by more than a factor of {}: {}. A weak "
                       "motion scaled so far has not the frequencies and the duration of a strong one. "
                       "Choose stronger records, or a lower intensity.",
                       worst.size(), s.facts.scaled.size(), s.facts.scaled.size() == 1 ? "" : "s",
                       worst.size() == 1 ? "is" : "are", much, some_of(names));
}

Finding check_equal_motions(const Subject& s)
{
    if (s.facts.equal_motions.empty())
        return std::nullopt;
    std::vector<std::string> groups;
    std::size_t copies = 0;
    for (const std::vector<std::string>& equal : s.facts.equal_motions) {
        groups.push_back(some_of(equal));
        copies += equal.size() - 1;
    }
    std::string text;
    constexpr std::size_t most = 4;
    for (std::size_t i = 0; i < std::min(groups.size(), most); ++i)
        text += (i == 0 ? "" : "; ") + groups[i];
    if (groups.size() > most)
        text += fmt::format("; and {} other group{}", groups.size() - most, groups.size() == most + 1 ? "" : "s");
    return implausible(false,
                       "The same ground motion is in the set several times (equal samples, up to a "
                       "factor): {}. {} of the {} motions {} therefore no additional evidence: intervals "
                       "over motions count each ground motion once. Remove the copies.",
                       text, copies, s.study.design().motions->motions, copies == 1 ? "is" : "are");
}

Finding check_direction(const Subject& s)
{
    if (!s.facts.vertical_motions.empty())
        return implausible(s.study.design().motions != nullptr,
                           "Vertical component{} would shake the base horizontally: {}. Take the "
                           "horizontal components of the record.",
                           s.facts.vertical_motions.size() == 1 ? "" : "s", some_of(s.facts.vertical_motions));
    if (!s.facts.vertical_motion)
        return std::nullopt;
    return implausible(false,
                       "The vertical motion {} is a horizontal component by the names in its file: the "
                       "study has no vertical record. Give a vertical component by "
                       "mechanisms.vertical_motion.component or .file.",
                       *s.facts.vertical_motion);
}

Finding check_left_out(const Subject& s)
{
    const MotionSetSpec* set = s.study.design().motions;
    if (set == nullptr || set->left_out.empty())
        return std::nullopt;
    const std::vector<std::string>& files = set->left_out;
    return implausible(false,
                       "{} file{} or component{} of fragility.folder {} no horizontal acceleration and "
                       "{} left out: {}. To choose files give fragility.pattern.",
                       files.size(), files.size() == 1 ? "" : "s", files.size() == 1 ? "" : "s",
                       files.size() == 1 ? "is" : "are", files.size() == 1 ? "is" : "are", some_of(files));
}

Finding check_shaking_frequency(const Subject& s)
{
    constexpr double low = 0.05, high = 100;
    const Extent hz = shaking_hz(s);
    if (hz.high <= high && (hz.low >= low || hz.high == 0))
        return std::nullopt;
    return implausible(false, "The shaking has {:.4g} Hz; earthquakes and shaking tables have {} to {} Hz.",
                       hz.high > high ? hz.high : hz.low, low, high);
}

Finding check_density(const Subject& s)
{
    // pumice to basalt; 100: no solid that is built with; 25000: heavier than any metal
    constexpr double lightest = 1000, heaviest = 4000, no_solid = 100, no_metal = 25000;
    const double depth = s.study.structure.depth_m;
    Finding found;
    for (const PlacedBlock& block : lay_out(s.study.structure).blocks) {
        const double density = block.mass_kg / (block.width_m * block.height_m * depth);
        const bool refused = density < no_solid || density > no_metal;
        if (block.fixed || (density >= lightest && density <= heaviest) || (found && (found->refused || !refused)))
            continue;
        const double thousand = density * 1000, of_weight = thousand / standard_gravity;
        const std::string meant = thousand >= lightest && thousand <= heaviest
                                      ? fmt::format(" Did you mean {:.4g} kg/m3 ({:.4g} g/cm3)?", thousand, density)
                                  : of_weight >= lightest && of_weight <= heaviest
                                      ? fmt::format(" Did you mean {:.4g} kg/m3 ({:.4g} kN/m3)?", of_weight, density)
                                      : " Are mass, width, height and depth_m in kg and m?";
        found = implausible(
            refused, "{} has {:.4g} kg/m3 ({:.4g} kg in {:.4g} x {:.4g} x {:.4g} m); stone has {:.0f} to {:.0f}.{}",
            block.name, density, block.mass_kg, block.width_m, block.height_m, depth, lightest, heaviest, meant);
    }
    return found;
}

Finding check_friction(const Subject& s)
{
    constexpr double low = 0.1, high = 1.2, absurd = 3; // of dry and wet stone 0.36 to 0.84 are measured
    Extent mu{s.study.contact.friction, s.study.contact.friction};
    const auto meet = [&mu](double value) { mu = {std::min(mu.low, value), std::max(mu.high, value)}; };
    for (const PlacedBed& bed : lay_out(s.study.structure).beds)
        meet(bed.bed.friction.value_or(mu.high));
    for (const Perturbation& p : s.study.perturbations)
        if (p.quantity == Quantity::friction &&
            (p.distribution == DistributionKind::uniform || p.distribution == DistributionKind::log_uniform)) {
            meet(p.from);
            meet(p.to);
        }
    if (mu.low >= low && mu.high <= high)
        return std::nullopt;
    const double worst = mu.high > high ? mu.high : mu.low;
    return implausible(worst > absurd, "The friction is {:.4g}; that of stone on stone is 0.4 to 0.8.{}", worst,
                       worst > high && worst / 100 >= low ? fmt::format(" Did you mean {:.4g}?", worst / 100)
                                                          : std::string());
}

Finding check_damping(const Subject& s)
{
    constexpr double most = 0.7;
    const ContactSpec& c = s.study.contact;
    double width = 0, mass = std::numeric_limits<double>::infinity();
    for (const PlacedBlock& block : lay_out(s.study.structure).blocks)
        if (!block.fixed && block.mass_kg < mass) {
            mass = block.mass_kg;
            width = block.width_m;
        }
    const double normal = c.normal_damping_n_s_m
                              ? *c.normal_damping_n_s_m / (2 * std::sqrt(c.normal_stiffness_n_m2 * width * mass))
                              : c.normal_damping_ratio;
    const double tangential = c.tangential_damping_n_s_m
                                  ? *c.tangential_damping_n_s_m / (2 * std::sqrt(c.tangential_stiffness_n_m * mass))
                                  : c.tangential_damping_ratio;
    const double ratio = std::max(normal, tangential);
    if (ratio <= most)
        return std::nullopt;
    return implausible(false,
                       "The damping ratio of the contacts is {:.3g} ({} direction); impacts of stone have 0.05 to 0.5.",
                       ratio, normal == ratio ? "normal" : "tangential");
}

Finding check_stiffness(const Subject& s)
{
    constexpr double softest = 1e7, stiffest = 1e13;
    const double depth = s.study.structure.depth_m;
    double worst = s.study.contact.normal_stiffness_n_m2 / depth;
    for (const PlacedBed& bed : lay_out(s.study.structure).beds)
        if (const double own = bed.bed.normal_stiffness_n_m2.value_or(s.study.contact.normal_stiffness_n_m2) / depth;
            own < softest || own > stiffest)
            worst = own;
    if (worst >= softest && worst <= stiffest)
        return std::nullopt;
    return implausible(false,
                       "normal_stiffness_n_m2 over depth_m is {:.3g} N/m3; beds of stone have 1e9 to "
                       "1e10. The stiffness is that of the whole depth of {:.3g} m.",
                       worst, depth);
}

/// A column that is a sliver, or a drum that is a sheet: a length in another unit.
Finding check_proportions(const PlacedBlock& drum)
{
    constexpr double most = 100; // ten times as slender as ancient columns are
    constexpr double smallest = 0.005, largest = 5;
    const bool slender = drum.top() > most * drum.width_m, flat = drum.width_m > most * drum.height_m;
    if (!slender && !flat)
        return std::nullopt;
    const std::string units = meant(slender ? drum.height_m : drum.width_m, from_lengths, largest, "m", smallest);
    const bool height =
        slender != units.empty(); // too large in the unit; without such a unit the other one is too small
    return implausible(true,
                       "{} is {:.4g} m wide and {:.4g} m high, and its top {:.4g} m above the base: "
                       "no column of stone has such proportions. {} = {:.4g} is in metres.{}",
                       drum.name, drum.width_m, drum.height_m, drum.top(),
                       height ? "drum_height_m (or height_m)" : "drum_width_m (or width_m)",
                       height ? drum.height_m : drum.width_m, units);
}

Finding check_size(const Subject& s)
{
    // the highest ancient columns have 20 m, the obelisks of Axum and Rome 24 to 33; drums are up to 3.6 m wide,
    // architraves up to 20 m long
    constexpr double smallest = 0.005, tallest = 35, flattest = 20, widest_drum = 5, longest = 20;
    const double depth = s.study.structure.depth_m;
    const std::vector<PlacedBlock> blocks = lay_out(s.study.structure).blocks;
    for (const PlacedBlock& block : blocks)
        if (block.role == BlockRole::drum && !block.fixed)
            if (Finding found = check_proportions(block))
                return found;
    double top = 0;
    for (const PlacedBlock& block : blocks) {
        const double least = std::min({block.width_m, block.height_m, depth});
        if (least < smallest)
            return implausible(false,
                               "{} is {:.4g} x {:.4g} m, {:.4g} m deep: a size below {} m is implausible "
                               "for a stone block. Lengths are in metres.",
                               block.name, block.width_m, block.height_m, depth, smallest);
        if (const double ratio = depth / block.width_m; ratio > flattest || 1 / ratio > flattest)
            return implausible(false, "{} is {:.4g} m wide and {:.4g} m deep. Is depth_m in metres?", block.name,
                               block.width_m, depth);
        top = std::max(top, block.top());
        if (const double most = block.role == BlockRole::drum ? widest_drum : longest; block.width_m > most)
            return implausible(false,
                               "{} is {:.4g} m wide; ancient {} have up to {} m. Lengths are in metres: "
                               "{:.4g} mm would be {:.4g} m, {:.4g} cm would be {:.4g} m.",
                               block.name, block.width_m,
                               block.role == BlockRole::drum ? "columns and obelisks" : "architraves", most,
                               block.width_m, block.width_m / 1000, block.width_m, block.width_m / 100);
    }
    if (top <= tallest)
        return std::nullopt;
    return implausible(false,
                       "The structure is {:.4g} m high; the highest ancient columns have 20 m, obelisks "
                       "33 m. Lengths are in metres.",
                       top);
}

/// Relative spread of a perturbation; 0 where it has none.
double spread_of(const Perturbation& p, double least_width, double least_height)
{
    const auto furthest = [&p] {
        return p.distribution == DistributionKind::normal ? p.sd : std::max(std::abs(p.from), std::abs(p.to)) / 2;
    };
    switch (p.quantity) {
    case Quantity::drum_width:
    case Quantity::drum_height:
        if (p.distribution == DistributionKind::normal && p.sd > 0)
            return p.sd / (p.quantity == Quantity::drum_width ? least_width : least_height);
        break;
    case Quantity::drum_offset:
        if (p.cov == 0)
            return furthest() / least_width;
        break;
    case Quantity::tilt:
        return 2 * furthest(); // 0.1 rad counts as much as a fifth of a size
    default:
        break;
    }
    return 0;
}

Finding check_spread(const Subject& s)
{
    constexpr double size_part = 0.2, cov = 0.5, sigma_ln = 1.5;
    double width = std::numeric_limits<double>::infinity(), height = width;
    for (const PlacedBlock& block : lay_out(s.study.structure).blocks) {
        width = std::min(width, block.width_m);
        height = std::min(height, block.height_m);
    }
    for (const Perturbation& p : s.study.perturbations) {
        const double part = spread_of(p, width, height);
        if (part > size_part)
            return implausible(false, "{}",
                               p.quantity == Quantity::tilt
                                   ? fmt::format("perturbation.tilt has a spread of {:.3g} rad, which is implausible "
                                                 "for the level of a base. Angles are in radians.",
                                                 part / 2)
                                   : fmt::format("perturbation.{} has a spread of {:.3g} of a block's size; masonry "
                                                 "tolerances are about 0.01. Lengths are in metres.",
                                                 to_string(p.quantity), part));
        if (p.distribution == DistributionKind::normal && p.cov > cov)
            return implausible(false, "perturbation.{} has a coefficient of variation of {:.3g}: 10 % is 0.1.",
                               to_string(p.quantity), p.cov);
        if (p.distribution == DistributionKind::lognormal && p.sigma_ln > sigma_ln)
            return implausible(false,
                               "perturbation.{} has sigma_ln = {:.3g}: one in three realizations deviates "
                               "by more than a factor of {:.3g}.",
                               to_string(p.quantity), p.sigma_ln, std::exp(p.sigma_ln));
    }
    return std::nullopt;
}

Finding check_file_size(const Subject& s)
{
    constexpr double large = 4e9, absurd = 1e11;
    if (s.facts.file_bytes <= large)
        return std::nullopt;
    return implausible(s.facts.file_bytes > absurd,
                       "The results of {} realizations need {:.3g} GB. Reduce their number, or for a surface "
                       "give output.realizations = \"none\" (counts only).",
                       s.study.total(), s.facts.file_bytes / 1e9);
}

struct Check {
    const char* name;
    Finding (*find)(const Subject&);
    bool of_compliant = false; ///< not of rigid contacts
};
constexpr std::array checks = {Check{"pga", check_pga},
                               Check{"weak_shaking", check_weak_shaking},
                               Check{"scale", check_scale},
                               Check{"equal_motions", check_equal_motions},
                               Check{"direction", check_direction},
                               Check{"left_out", check_left_out},
                               Check{"shaking_frequency", check_shaking_frequency},
                               Check{"size", check_size}, // before what a wrong length makes of the rest
                               Check{"sinkage", check_sinkage, true},
                               Check{"first_frequency", check_first_frequency, true},
                               Check{"stiffness", check_stiffness, true},
                               Check{"density", check_density},
                               Check{"friction", check_friction},
                               Check{"damping", check_damping, true},
                               Check{"spread", check_spread},
                               Check{"file_size", check_file_size}};

} // namespace

std::vector<std::string> check_names()
{
    std::vector<std::string> names;
    for (const Check& check : checks)
        names.emplace_back(check.name);
    return names;
}

std::vector<Implausibility> implausibilities(const Study& study, const StudyFacts& facts)
{
    std::vector<Implausibility> all;
    for (const Check& check : checks) {
        if (study.allows(check.name) || (check.of_compliant && study.contact.form == ContactForm::rigid))
            continue;
        if (Finding found = check.find({study, facts})) {
            found->check = check.name;
            all.push_back(std::move(*found));
        }
    }
    return all;
}

} // namespace stylobate
