#include "ensemble/sampling/plausible_structure.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/structure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate::plausible {
namespace {

/// Stiffness per area of a bed of stone [N/m3].
double area_stiffness(const Study& study, const PlacedBed& bed)
{
    if (study.structure.spatial())
        return bed.bed.normal_stiffness_n_m3.value_or(study.contact.normal_stiffness_n_m3);
    return bed.bed.normal_stiffness_n_m2.value_or(study.contact.normal_stiffness_n_m2) / study.structure.depth_m;
}

/// The smallest size of a block; in the plane, where a placed block has no depth, that of its rectangle.
double least_size_m(const PlacedBlock& block)
{
    const double least = std::min(block.width_m, block.height_m);
    return block.depth_m > 0 ? std::min(least, block.depth_m) : least;
}

/// A column that is a sliver, or a drum that is a sheet: a length in another unit.
Finding check_proportions(const PlacedBlock& drum)
{
    constexpr double most = 100; // ten times as slender as ancient columns are
    constexpr double smallest = 0.005, largest = 5;
    const double narrow = drum.depth_m > 0 ? std::min(drum.width_m, drum.depth_m) : drum.width_m;
    const bool slender = drum.top() > most * narrow, flat = drum.width_m > most * drum.height_m;
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

} // namespace

/// " Did you mean cm/s2 (1.2 m/s2) or mm/s2 (0.12 m/s2)?": those with which the value is plausible.
std::string meant(double value, std::span<const UnitSlip> slips, double high, const char* unit, double low)
{
    std::string all;
    for (const UnitSlip& slip : slips)
        if (value * slip.factor >= low && value * slip.factor <= high)
            all += fmt::format("{} {} ({:.4g} {})", all.empty() ? " Did you mean" : " or", slip.unit,
                               value * slip.factor, unit);
    return all.empty() ? all : all + "?";
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
        const double part = sinkage[i] / least_size_m(upper);
        if (part > worst) {
            worst = part;
            bed = i;
        }
    }
    if (worst <= much)
        return std::nullopt;
    if (s.study.structure.spatial())
        return implausible(
            worst > absurd,
            "Under its own weight {} overlaps its support by {:.3g} mm, {:.2g} % of its size: "
            "normal_stiffness_n_m3 = {:.3g} is {} times softer than the value for 0.01 %. A bed of stone "
            "has 1e9 to 1e10 N/m3.",
            layout.blocks[static_cast<std::size_t>(layout.beds[bed].upper)].name, 1000 * sinkage[bed], 100 * worst,
            area_stiffness(s.study, layout.beds[bed]), static_cast<long>(std::lround(worst / 1e-4)));
    const double K_N = layout.beds[bed].bed.normal_stiffness_n_m2.value_or(s.study.contact.normal_stiffness_n_m2);
    return implausible(worst > absurd,
                       "Under its own weight {} overlaps its support by {:.3g} mm, {:.2g} % of its size: "
                       "normal_stiffness_n_m2 = {:.3g} is {} times softer than the value for 0.01 %. Does it "
                       "include the depth (a bed of stone has 1e9 to 1e10 N/m3, times the depth {:.3g} m)?",
                       layout.blocks[static_cast<std::size_t>(layout.beds[bed].upper)].name, 1000 * sinkage[bed],
                       100 * worst, K_N, static_cast<long>(std::lround(worst / 1e-4)), s.study.structure.depth_m);
}

Finding check_density(const Subject& s)
{
    // pumice to basalt; 100: no solid that is built with; 25000: heavier than any metal
    constexpr double lightest = 1000, heaviest = 4000, no_solid = 100, no_metal = 25000;
    const bool spatial = s.study.structure.spatial();
    Finding found;
    for (const PlacedBlock& block : lay_out(s.study.structure).blocks) {
        const double depth = spatial ? block.depth_m : s.study.structure.depth_m;
        const double density = block.mass_kg / volume_m3(s.study.structure, block);
        const bool refused = density < no_solid || density > no_metal;
        if (block.fixed || (density >= lightest && density <= heaviest) || (found && (found->refused || !refused)))
            continue;
        const double thousand = density * 1000, of_weight = thousand / standard_gravity;
        const std::string meant = thousand >= lightest && thousand <= heaviest
                                      ? fmt::format(" Did you mean {:.4g} kg/m3 ({:.4g} g/cm3)?", thousand, density)
                                  : of_weight >= lightest && of_weight <= heaviest
                                      ? fmt::format(" Did you mean {:.4g} kg/m3 ({:.4g} kN/m3)?", of_weight, density)
                                  : spatial ? " Are mass, width and height in kg and m?"
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
    double worst = area_stiffness(s.study, {});
    for (const PlacedBed& bed : lay_out(s.study.structure).beds)
        if (const double own = area_stiffness(s.study, bed); own < softest || own > stiffest)
            worst = own;
    if (worst >= softest && worst <= stiffest)
        return std::nullopt;
    if (s.study.structure.spatial())
        return implausible(false, "normal_stiffness_n_m3 is {:.3g} N/m3; beds of stone have 1e9 to 1e10.", worst);
    return implausible(false,
                       "normal_stiffness_n_m2 over depth_m is {:.3g} N/m3; beds of stone have 1e9 to "
                       "1e10. The stiffness is that of the whole depth of {:.3g} m.",
                       worst, depth);
}

Finding check_size(const Subject& s)
{
    // the highest ancient columns have 20 m, the obelisks of Axum and Rome 24 to 33; drums are up to 3.6 m wide,
    // architraves up to 20 m long
    constexpr double smallest = 0.005, tallest = 35, flattest = 20, widest_drum = 5, longest = 20;
    const bool spatial = s.study.structure.spatial();
    const std::vector<PlacedBlock> blocks = lay_out(s.study.structure).blocks;
    for (const PlacedBlock& block : blocks)
        if (block.role == BlockRole::drum && !block.fixed)
            if (Finding found = check_proportions(block))
                return found;
    double top = 0;
    for (const PlacedBlock& block : blocks) {
        const double depth = spatial ? block.depth_m : s.study.structure.depth_m;
        const double least = std::min({block.width_m, block.height_m, depth});
        if (least < smallest)
            return implausible(false,
                               "{} is {:.4g} x {:.4g} m, {:.4g} m deep: a size below {} m is implausible "
                               "for a stone block. Lengths are in metres.",
                               block.name, block.width_m, block.height_m, depth, smallest);
        if (const double ratio = depth / block.width_m; ratio > flattest || 1 / ratio > flattest)
            return implausible(false, "{} is {:.4g} m wide and {:.4g} m deep. {}", block.name, block.width_m, depth,
                               spatial ? "Lengths are in metres." : "Is depth_m in metres?");
        top = std::max(top, block.top());
        const double wide = std::max(block.width_m, spatial ? depth : 0.0);
        if (const double most = block.role == BlockRole::drum ? widest_drum : longest; wide > most)
            return implausible(false,
                               "{} is {:.4g} m wide; ancient {} have up to {} m. Lengths are in metres: "
                               "{:.4g} mm would be {:.4g} m, {:.4g} cm would be {:.4g} m.",
                               block.name, wide, block.role == BlockRole::drum ? "columns and obelisks" : "architraves",
                               most, wide, wide / 1000, wide, wide / 100);
    }
    if (top <= tallest)
        return std::nullopt;
    return implausible(false,
                       "The structure is {:.4g} m high; the highest ancient columns have 20 m, obelisks "
                       "33 m. Lengths are in metres.",
                       top);
}

Finding check_spread(const Subject& s)
{
    constexpr double size_part = 0.2, cov = 0.5, sigma_ln = 1.5;
    double width = std::numeric_limits<double>::infinity(), height = width;
    for (const PlacedBlock& block : lay_out(s.study.structure).blocks) {
        width = std::min(width, block.depth_m > 0 ? std::min(block.width_m, block.depth_m) : block.width_m);
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

} // namespace stylobate::plausible
