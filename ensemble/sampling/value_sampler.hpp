#pragma once
/// What is drawn of the realizations of a study: which of their values, by which distributions, under which names.

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/distribution.hpp"
#include "ensemble/sampling/point_set.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The stream of a parameter's draws.
Stream stream_of(Mechanism mechanism, std::size_t parameter);

class ValueSampler {
public:
    ValueSampler() = default;
    /// @param nominal    values of a realization of which nothing is drawn
    /// @param mechanisms those of the study
    /// @throws InputError if a perturbation leaves no probability between its limits
    ValueSampler(const Study& study, const RealizationValues& nominal, const std::vector<ActingMechanism>& mechanisms);

    /// The values of a realization: the nominal ones, or drawn.
    /// @param inputs takes those that were drawn, in the order of `input_names()`
    RealizationValues values(const PointSet& points, std::uint64_t index, std::vector<double>& inputs) const;

    /// The nominal values but for those on which its duration and its step mainly depend, which are drawn: stiffness
    /// and damping of the contacts, frequency and shape of a pulse. It takes a fraction of the time of `values`.
    RealizationValues rough_values(const PointSet& points, std::uint64_t index) const;

    /// "friction[0]", "friction[1]" and so on for each bed (or block) of the layout; the name alone for what is drawn
    /// once for the structure, which is then the value of the first bed or block. In space "drum_offset_z" and "tilt_x"
    /// follow "drum_offset" and "tilt", and stiffnesses are per area: "bed_normal_stiffness". Then the parameters of
    /// mechanisms: "stribeck_velocity[0]" and so on for each joint or block if it is drawn for more than one, with the
    /// neutral value where the mechanism does not act; else the name alone.
    const std::vector<std::string>& input_names() const { return input_names_; }
    const PointSet& points() const { return points_; }

private:
    struct Drawn {
        std::size_t slot; ///< of `RealizationValues::all`
        Stream stream;
        bool once;                                    ///< one draw for all places
        std::size_t inputs;                           ///< how many of the values are recorded; 1: the first drawn one
        int factor;                                   ///< of a sensitivity study; -1: none
        std::vector<std::size_t> places = {};         ///< at which it is drawn
        std::vector<Distribution> distributions = {}; ///< at each of them

        std::size_t draws() const { return once ? 1 : places.size(); }
        std::uint64_t element(std::size_t i) const { return once ? 0 : places[i]; }
    };

    /// Draws into its places of the values.
    static void draw(const Drawn& drawn, const PointSet& points, std::uint64_t index, RealizationValues& values);
    void add(Perturbation perturbation, int factor);
    void add(const Study& study, MechanismPerturbation perturbation, const std::vector<ActingMechanism>& mechanisms);
    void name(const std::string& quantity, std::optional<std::size_t> numbered);

    RealizationValues nominal_;
    bool spatial_ = false;
    std::vector<Drawn> drawn_; ///< in the order of the study
    std::vector<std::string> input_names_;
    PointSet points_;
    std::optional<Distribution> twin_; ///< how far a drum is from its place in structures with the same contacts
};

} // namespace stylobate
