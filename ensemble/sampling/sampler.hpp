#pragma once
/// From a study and an index to one realization.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/planar/structure/realization.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/shaking.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/distribution.hpp"
#include "ensemble/sampling/mechanism_sampler.hpp"
#include "ensemble/sampling/point_set.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Draws the realizations of a study. Each is a pure function of (study, index): requesting them in another order,
/// twice, or from several threads at once changes nothing.
///
/// It refers to its study, which must outlive it, stay where it is and not change (`Experiment` keeps both).
class Sampler {
public:
    /// @param record   the base motion of a study with `excitation.kind` "record" or "table", else ignored; not kept
    /// @param vertical that of a study with a vertical record, else ignored; not kept
    /// @param motions  those of a study with a set of motions, else ignored
    /// @throws InputError if the structure cannot stand, or a perturbation leaves no probability between its limits
    /// @throws std::invalid_argument if such a study comes without its record, vertical record or motions
    Sampler(const Study& study, const Motion* record, const Motion* vertical = nullptr,
            std::shared_ptr<const MotionSet> motions = nullptr);
    Sampler(const Study&&, const Motion*, const Motion* = nullptr, std::shared_ptr<const MotionSet> = nullptr) = delete;

    /// @param index from 0 to study.total() - 1; in a surface it identifies the cell too. A perturbed replica has all
    ///              properties of its original except the one of its kind: if displaced, its step stays; in another
    ///              form, it has that form's own step
    /// @throws InputError if the study's own step is above the realization's safe bound and the study does not allow it
    ///                    explicitly, or if the drawn structure cannot be built: blocks that miss each other or overlap
    Realization realization(std::uint64_t index) const;

    /// Of a study whose realizations follow from each other: one whose uniform numbers are given, in any order that is
    /// always the same.
    /// @param numbers (size()) each in (0, 1)
    Realization realization(std::uint64_t index, std::span<const double> numbers) const
    {
        return build(index, points_.given(numbers));
    }
    /// How many numbers those are.
    std::size_t size() const { return points_.size(); }

    /// Names of `Realization::inputs`: "friction[0]", "friction[1]" and so on for each bed (or block) of the layout;
    /// the name alone for what is drawn once for the structure, which is then the value of the first bed or block. Then
    /// those of the mechanisms (`MechanismSampler`).
    const std::vector<std::string>& input_names() const { return input_names_; }

private:
    /// One perturbed quantity.
    struct Drawn {
        Quantity quantity;
        Stream stream;
        std::size_t draws;                       ///< beds, blocks or 1
        std::vector<Distribution> distributions; ///< of each of its values; more than `draws`: all from the first draw
    };
    /// Each quantity of one realization, block by block, once, or bed by bed; of beds there is one value more, the last
    /// one, for blocks that meet elsewhere.
    struct Values {
        std::array<std::vector<double>, quantity_count> of;

        const std::vector<double>& operator[](Quantity quantity) const
        {
            return of[static_cast<std::size_t>(quantity)];
        }
    };
    struct Ratios {
        double normal;
        double tangential;
    };
    struct OtherForm; ///< the study in another contact form, with its sampler

    void watch_pairs();
    Realization build(std::uint64_t index, const PointSet& points) const;
    void move(const Replica& replica, Realization& realization) const;
    Values draw(const PointSet& points, std::uint64_t index, std::vector<double>& inputs) const;
    void stack(const Values& values, Realization& realization) const;
    void lay_epistyles(const Values& values, Realization& realization) const;
    Block block(const Values& values, std::size_t i, double height_m) const;
    Block ground() const;
    Ratios ratios(const Values& values) const;
    Joint joint(const Values& values, const std::vector<Block>& blocks, int lower, int upper, std::size_t value,
                double chord_m) const;
    void join(const Values& values, Realization& realization) const;
    void watch(const Values& values, Realization& realization) const;
    double step(const Realization& realization) const;
    double rigid_step(const Realization& realization) const;
    std::string name(int block) const;

    const Study* study_;
    Layout layout_;
    MechanismSampler mechanisms_;
    bool has_ground_ = false;
    std::vector<std::pair<int, int>> watched_; ///< lower and upper block
    Values nominal_;
    std::vector<double> restitution_; ///< (beds)
    Shaking shaking_;
    std::vector<Drawn> drawn_; ///< in the order of the study
    std::vector<std::string> input_names_;
    PointSet points_;
    std::vector<std::shared_ptr<const OtherForm>> forms_; ///< (kinds of replicas) of another contact form, else null
    std::optional<Distribution> twin_; ///< how far a drum is from its place in structures with the same contacts
};

} // namespace stylobate
