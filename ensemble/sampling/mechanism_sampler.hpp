#pragma once
/// The mechanisms of a study, applied to a realization.

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/planar/structure/realization.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/distribution.hpp"
#include "ensemble/sampling/point_set.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

/// The stream of a parameter's draws.
Stream stream_of(Mechanism mechanism, std::size_t parameter);

class MechanismSampler {
public:
    /// The parameters of the mechanisms that the study names, in the order of its rules: [mechanism][parameter][place].
    using Values = std::vector<std::array<std::vector<double>, most_parameters>>;

    /// @param layout of the study's structure
    /// @throws InputError if a perturbation leaves no probability between its limits
    MechanismSampler(const Study& study, const Layout& layout);

    /// Names of the inputs that `draw` appends: "stribeck_velocity[0]" and so on for each joint or block if it is drawn
    /// for more than one, with the neutral value where the mechanism does not act; else the name alone.
    const std::vector<std::string>& input_names() const { return input_names_; }
    /// The numbers that are drawn, with the factors of a sensitivity study.
    std::vector<PointSet::Place> places(const Study& study) const;
    /// The values of a realization: those of the study, or drawn.
    Values draw(const PointSet& points, std::uint64_t index, std::vector<double>& inputs) const;

    /// Offset of a block from its place [m].
    double offset_m(const Values& values, std::size_t block) const;

    /// Writes everything else into a realization whose blocks and joints exist.
    /// @throws InputError if the drawn structure cannot be built: a face that is lost as a whole, a centre of mass
    ///                    outside its block, values that contradict each other
    void apply(const Values& values, Realization& realization) const;

private:
    /// A mechanism with all places at which it acts.
    struct Acting {
        const MechanismRule* rule;
        std::vector<bool> at; ///< joint by joint, block by block, or the base
        bool may_act = false; ///< not neutral everywhere, or drawn
    };
    struct Drawn {
        std::size_t acting;
        std::size_t parameter;
        Stream stream;
        bool once;                               ///< one draw for all places
        std::vector<std::size_t> places;         ///< at which it is drawn
        std::vector<Distribution> distributions; ///< at each of them
    };

    void add(const MechanismSpec& spec, const Layout& layout);
    void add(const MechanismPerturbation& perturbation);
    void check(const MechanismRule& rule, const Values::value_type& values, std::size_t place,
               std::uint64_t index) const;
    void check_room(const Realization& realization) const;

    double friction_ = 0; ///< of [contact]
    double depth_m_ = 0;  ///< of all blocks
    DampingAt damping_ = DampingAt::centroid;
    bool with_mechanisms_ = false;
    bool strengthened_ = false;
    std::vector<int> right_; ///< (blocks) the neighbour at the right; -1: none
    ContactForm form_ = ContactForm::area;
    std::vector<Acting> acting_;
    Values nominal_;
    std::vector<Drawn> drawn_;
    std::vector<std::string> input_names_;
};

} // namespace stylobate
