#pragma once
/// From a study and an index to one realization.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/shaking.hpp"
#include "ensemble/sampling/structure_builder.hpp"
#include "ensemble/sampling/value_sampler.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Draws the realizations of a study, which a model's builder makes of the drawn values. Each is a pure function
/// of (study, index): requesting them in another order, twice, or from several threads at once changes nothing.
///
/// It refers to its study, which must outlive it, stay where it is and not change (`Experiment` keeps both).
///
/// A builder has: Realization, a `RealizationHeader` with the model's structure; Builder(study); nominal() and
/// mechanisms(), from which the drawn values are made; build(values, header); scales(realization); step_s(realization),
/// of one that is shaken; move(replica, original, realization).
template <class Builder>
class SamplerOf {
public:
    using Realization = typename Builder::Realization;

    /// @param record   the base motion of a study with `excitation.kind` "record" or "table", else ignored; not kept
    /// @param vertical that of a study with a vertical record, else ignored; not kept
    /// @param motions  those of a study with a set of motions, else ignored
    /// @param second   the second horizontal component of a record in space, else ignored; not kept
    /// @throws InputError if the structure cannot stand, or a perturbation leaves no probability between its limits
    /// @throws std::invalid_argument if such a study comes without its record, second component, vertical record or
    ///         motions
    SamplerOf(const Study& study, const Motion* record, const Motion* vertical = nullptr,
              std::shared_ptr<const MotionSet> motions = nullptr, const Motion* second = nullptr)
        : study_(&study), builder_(study), shaking_(study, record, vertical, std::move(motions), second),
          values_(study, builder_.nominal(), builder_.mechanisms())
    {
        if (const ReplicasSpec* replicas = study.design().replica_set)
            for (const Replica& kind : replicas->kinds)
                forms_.push_back(kind.by == ReplicaBy::form
                                     ? std::make_shared<const OtherForm>(study, kind.form, record, vertical, second)
                                     : nullptr);
    }
    SamplerOf(const Study&&, const Motion*, const Motion* = nullptr, std::shared_ptr<const MotionSet> = nullptr,
              const Motion* = nullptr) = delete;

    /// @param index from 0 to study.total() - 1; in a surface it identifies the cell too. A perturbed replica has all
    ///              properties of its original except the one of its kind: if displaced, its step stays; in another
    ///              form, it has that form's own step
    /// @throws InputError if the study's own step is above the realization's safe bound and the study does not allow it
    ///                    explicitly, or if the drawn structure cannot be built: blocks that miss each other or overlap
    Realization realization(std::uint64_t index) const
    {
        assert(index < study_->total() && "the index is one of the study's");
        const Replica* replica = study_->replica(index);
        if (replica == nullptr)
            return build(index, values_.points());
        const std::uint64_t original = study_->original(index);
        const OtherForm* form = forms_[static_cast<std::size_t>(index / study_->originals() - 1)].get();
        Realization realization = (form ? form->sampler : *this).realization(original);
        realization.index = index;
        if (replica->by == ReplicaBy::move)
            builder_.move(*replica, original, realization);
        if (replica->by == ReplicaBy::step)
            realization.step_s *= replica->size;
        return realization;
    }

    /// About how many steps a realization takes that neither falls nor comes to rest: those of its shaking and of what
    /// is simulated after it (`Watch::last_step`), over a step for drawn contacts and nominal blocks. By this long
    /// realizations are found in a fraction of the time in which they are made.
    /// @throws InputError if the nominal structure cannot be built
    double most_steps(std::uint64_t index) const
    {
        if (const Replica* replica = study_->replica(index)) {
            const OtherForm* form = forms_[static_cast<std::size_t>(index / study_->originals() - 1)].get();
            const double steps = (form ? form->sampler : *this).most_steps(study_->original(index));
            return replica->by == ReplicaBy::step ? steps / replica->size : steps;
        }
        RealizationHeader header;
        header.index = index;
        RealizationValues values = values_.rough_values(values_.points(), index);
        const DrawnShaking shaking = shaking_of(values);
        Realization realization = builder_.build(std::move(values), std::move(header));
        const Scales scales = builder_.scales(realization);
        const double shaken_s = shaking_.duration_s(*study_, shaking, scales, realization);
        const double end_s = std::max(0.0, shaken_s - realization.change.offset_s);
        const double step_s = study_->run.step_s ? *study_->run.step_s : builder_.step_s(realization);
        return (end_s + tail_s(study_->excitation, scales)) / step_s;
    }

    /// Of a study whose realizations follow from each other: one whose uniform numbers are given, in any order that is
    /// always the same.
    /// @param numbers (size()) each in (0, 1)
    Realization realization(std::uint64_t index, std::span<const double> numbers) const
    {
        return build(index, values_.points().given(numbers));
    }
    /// How many numbers those are.
    std::size_t size() const { return values_.points().size(); }

    /// Names of `RealizationHeader::inputs` (`ValueSampler::input_names`).
    const std::vector<std::string>& input_names() const { return values_.input_names(); }

private:
    /// The originals of a study with perturbed replicas, in another contact form.
    struct OtherForm {
        Study study; // stays where it is: the sampler refers to it
        SamplerOf sampler;

        OtherForm(const Study& of, ContactForm form, const Motion* record, const Motion* vertical, const Motion* second)
            : study(in_form(of, form)), sampler(study, record, vertical, nullptr, second)
        {
        }
        OtherForm(const OtherForm&) = delete;
        OtherForm& operator=(const OtherForm&) = delete;

        static Study in_form(const Study& study, ContactForm form)
        {
            Study originals = study.without_replicas();
            originals.contact.form = form;
            return originals;
        }
    };

    /// What of the shaking is drawn.
    static DrawnShaking shaking_of(const RealizationValues& values)
    {
        return {values[Quantity::phase][0], values[Quantity::pulse_frequency][0], values[Quantity::pulse_gamma][0],
                values[Quantity::direction][0] * (std::numbers::pi / 180)};
    }

    /// An original.
    Realization build(std::uint64_t index, const PointSet& points) const
    {
        RealizationHeader header;
        header.index = index;
        RealizationValues values = values_.values(points, index, header.inputs);
        const DrawnShaking shaking = shaking_of(values);
        Realization realization = builder_.build(std::move(values), std::move(header));
        shaking_.apply(*study_, shaking, builder_.scales(realization), realization);
        realization.step_s = builder_.step_s(realization);
        return realization;
    }

    const Study* study_;
    Builder builder_;
    Shaking shaking_;
    ValueSampler values_;
    std::vector<std::shared_ptr<const OtherForm>> forms_; ///< (kinds of replicas) of another contact form, else null
};

using Sampler = SamplerOf<StructureBuilder>;

} // namespace stylobate
