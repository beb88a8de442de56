#pragma once
/// How a realization ended. Plain data, SI units.

#include "ensemble/model/fields.hpp"

#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stylobate {

enum class State : std::uint8_t { stood = 0, rocked = 1, slid = 2, collapsed = 3, invalid = 4 };
enum class InvalidReason : std::uint8_t { none = 0, not_finite = 1, energy = 2 };

/// `Outcome::first_collapse_block` where several blocks met the collapse criterion at the same step: they fell
/// together.
inline constexpr std::int32_t several_blocks = -2;

const char* to_string(State state);
const char* to_string(InvalidReason reason);

/// What stands for "none" in the fields of an outcome. A time of what did not happen is -1 in memory.
inline constexpr char it_did_not_happen[] = "NaN: it did not happen";
inline constexpr char it_still_moved[] = "NaN: the structure still moved at the end";
inline constexpr char nothing_fell[] = "NaN: nothing fell";
inline constexpr char no_block[] = "-1: no block; -2: several blocks, together";
inline constexpr char no_column[] = "-1: nothing fell, or an epistyle fell first";

/// Each number has its line, with its meaning, in `outcome_fields.inc`.
struct Outcome {
#define STYLOBATE_OUTCOME(type, name, value, ...) type name = value;
#include "include/stylobate/outcome_fields.inc"
    std::vector<double> fall_time_s; ///< (blocks but the ground) when each met the collapse criterion, exact to a step;
                                     ///< -1 = never. Equal times: together
    // Of a survival study, else empty; of one that was set aside 0.
    std::vector<double> bed_offset_m; ///< (beds) how far the faces lie from where they lay, > 0: the upper block to the
                                      ///< right
    std::vector<double> rotation_rad; ///< (blocks but the ground) from upright, at the end
};

/// The numbers of an outcome.
template <class F>
void visit_fields(std::type_identity<Outcome>, F&& f)
{
#define STYLOBATE_OUTCOME(type, name, value, ...) f(#name, &Outcome::name, FieldFacts{__VA_ARGS__});
#include "include/stylobate/outcome_fields.inc"
}

/// Sets what the model does not have: NaN, of whole numbers the value before a run. What comes out of the engine and
/// what comes out of a file thus have the same bits.
/// @param dimensions of the structure, 2 or 3
inline void leave_out_other_models(Outcome& outcome, int dimensions)
{
    visit_fields(std::type_identity<Outcome>(), [&](const char*, auto field, const FieldFacts& facts) {
        if (has_model(facts.models, dimensions))
            return;
        if constexpr (std::is_same_v<decltype(field), double Outcome::*>)
            outcome.*field = std::numeric_limits<double>::quiet_NaN();
        else
            outcome.*field = Outcome().*field;
    });
}

/// Its lists: f(name, field, what they have a value of: "block" or "bed", facts).
template <class F>
void visit_lists(std::type_identity<Outcome>, F&& f)
{
    f("fall_time_s", &Outcome::fall_time_s, "block",
      FieldFacts{.says = "time at which each block fell",
                 .none = it_did_not_happen,
                 .more = "It is when the block met the collapse criterion, exact to one step (`step_s`): the first "
                         "step after which "
                         "it was outside its limits and did not come back. Blocks with the same time fell together."});
    f("bed_offset_m", &Outcome::bed_offset_m, "bed",
      FieldFacts{.says = "displacement of the faces of each joint at the end",
                 .more =
                     "It is from where they lay at the start, along the lower face; positive: the upper block moved to "
                     "the right.",
                 .is_signed = true});
    f("rotation_rad", &Outcome::rotation_rad, "block",
      FieldFacts{.says = "rotation of each block at the end",
                 .more = "It is from upright, counter-clockwise.",
                 .is_signed = true});
}

constexpr bool is_event_time(const FieldFacts& facts)
{
    return facts.none == it_did_not_happen;
}

/// A time as files and tables have it: NaN, if it is of what did not happen.
inline double event_time(double time_s)
{
    return time_s == -1 ? std::numeric_limits<double>::quiet_NaN() : time_s;
}
/// A number of an outcome as files and tables have it.
template <class Number>
Number without_none(const FieldFacts& facts, Number value)
{
    if constexpr (std::is_same_v<Number, double>)
        return is_event_time(facts) ? event_time(value) : value;
    else
        return value;
}

} // namespace stylobate
