#include "ensemble/sampling/plausible.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/numerics/unit_slip.hpp"
#include "ensemble/planar/structure/nominal_statics.hpp"
#include "ensemble/sampling/plausible_structure.hpp"

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

using namespace plausible;

/// Largest accelerations that were recorded: 40.2 m/s2 as the vector of three components, 14.3 m/s2 of a horizontal
/// one (IWTH25, Iwate-Miyagi Nairiku 2008), 27.0 m/s2 of a horizontal one (MYG004, Tohoku 2011); K-NET and KiK-net.
constexpr double strongest_record_m_s2 = 30, strongest_table_m_s2 = 50, no_record_m_s2 = 100;
/// Largest horizontal velocities near faults are 3 to 4 m/s (Chi-Chi 1999, TCU068); the fastest shaking tables reach 2.
constexpr double fastest_ground_m_s = 5, no_ground_m_s = 50;
/// Spectral accelerations are about 2.5 times the peak of the ground (plateau of the elastic spectrum of EN
/// 1998-1:2004).
constexpr double spectral_amplification = 2.5;

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

/// Motions of one frequency, whose velocity decides whether a table or the ground can reach it; small structures are
/// tested with stronger and faster motions than large ones.
bool is_sine(ExcitationKind kind)
{
    return kind == ExcitationKind::harmonic || kind == ExcitationKind::half_sine || kind == ExcitationKind::full_sine ||
           kind == ExcitationKind::tapered || kind == ExcitationKind::sweep;
}

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
    bool of_plane = false;     ///< by statics that are known in the plane alone
};
constexpr std::array checks = {Check{"pga", check_pga},
                               Check{"weak_shaking", check_weak_shaking, false, true},
                               Check{"scale", check_scale},
                               Check{"equal_motions", check_equal_motions},
                               Check{"direction", check_direction},
                               Check{"left_out", check_left_out},
                               Check{"shaking_frequency", check_shaking_frequency},
                               Check{"size", check_size}, // before what a wrong length makes of the rest
                               Check{"sinkage", check_sinkage, true},
                               Check{"first_frequency", check_first_frequency, true, true},
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
        if (study.allows(check.name) || (check.of_compliant && study.contact.form == ContactForm::rigid) ||
            (check.of_plane && study.structure.spatial()))
            continue;
        if (Finding found = check.find({study, facts})) {
            found->check = check.name;
            all.push_back(std::move(*found));
        }
    }
    return all;
}

} // namespace stylobate
