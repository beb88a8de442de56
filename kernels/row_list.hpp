#pragma once
/// Memory of a bundle by lists of fields: where each begins, how it is laid out, read and written, for every model.
///
/// A list is an enumeration `Of::Field` of `Of::count` fields, which each block (or joint, or step of a chunk) has. The
/// memory is rows of registers: a block has one row, a row has one register for each field.

#include "kernels/real.hpp"

#include <cstddef>
#include <type_traits>

namespace stylobate {

/// Steps between two termination checks of a realization, and the length of the table of base motion.
inline constexpr int chunk_steps = 64;

/// What has a row of a list.
enum class RowOf { block, joint, edge, realization, step };

/// Lists that every bundle has.
struct Always {
    template <class Number, class Topology>
    static constexpr bool in(const Topology&)
    {
        return true;
    }
};

/// @tparam Present whether a bundle has the list: `Present::in<Number>(topology)`
template <class Of, RowOf row_of, class Present = Always>
struct FieldList {
    using Field = typename Of::Field;
    static constexpr int fields = Of::count;
    static constexpr RowOf row = row_of;

    /// Registers of the list.
    template <class Number, class Topology>
    static constexpr int registers(const Topology& topology)
    {
        return Present::template in<Number>(topology) ? topology.rows(row) * fields : 0;
    }
};

/// The lists of a model, in the order of the memory.
template <class Number, class... Lists>
struct RowList {
    int lanes = 0;
    Number* begin[sizeof...(Lists)] = {}; ///< of each list; null: the bundle does not have it

    /// The number of a field's list.
    template <class Field>
    static constexpr int list = [] {
        constexpr bool is[] = {std::is_same_v<Field, typename Lists::Field>...};
        int number = 0;
        while (!is[number])
            ++number;
        return number;
    }();
    template <class Field>
    static constexpr int fields = ((std::is_same_v<Field, typename Lists::Field> ? Lists::fields : 0) + ...);

    /// The first number of a field's list, of row 0 and field 0.
    template <class Field>
    STYLOBATE_INLINE constexpr Number* rows() const
    {
        return begin[list<Field>];
    }
    /// A field of one lane.
    /// @param row number of the block, joint or step
    template <class Field>
    constexpr Number& at(Field field, int row, int lane) const
    {
        return rows<Field>()[(row * fields<Field> + field) * lanes + lane];
    }
    /// A field of a realization as a whole.
    template <class Field>
    constexpr Number& at(Field field, int lane) const
    {
        return rows<Field>()[field * lanes + lane];
    }

    /// Registers that the lists need, each of `lanes` numbers.
    /// @param which (RowOf) -> whether a list of these rows counts
    template <class Topology, class Which>
    static constexpr std::size_t registers(const Topology& topology, const Which& which)
    {
        return static_cast<std::size_t>(
            ((which(Lists::row) ? Lists::template registers<Number>(topology) : 0) + ... + 0));
    }

    /// Lays lists out, one behind the other.
    /// @param memory `registers` x lanes numbers
    template <class Topology, class Which>
    constexpr void bind(const Topology& topology, Number* memory, const Which& which)
    {
        int number = 0;
        const auto take = [&](RowOf row, int count) {
            if (which(row)) {
                begin[number] = count > 0 ? memory : nullptr;
                memory += static_cast<std::ptrdiff_t>(count) * lanes;
            }
            ++number;
        };
        (take(Lists::row, Lists::template registers<Number>(topology)), ...);
    }

    /// Begins at the place of one lane; the rows are `lanes` numbers apart as before.
    constexpr void move_to_lane(int lane)
    {
        for (Number*& each : begin)
            each = each == nullptr ? nullptr : each + lane;
    }
};

} // namespace stylobate
