#pragma once
/// Tables of the library for Python.

#include "python/module/arrays.hpp"
#include "stylobate/answer.hpp"

#include <pybind11/stl.h>

#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace stylobate::python {

/// Its attributes, and name: (unit, values). Texts are a list, numbers a view that keeps the owner alive.
inline py::tuple table(const py::object& owner, const api::Table& from)
{
    py::dict attributes, columns;
    for (const auto& [name, value] : from.attributes)
        attributes[py::str(name)] = value;
    for (const api::Column& column : from.columns)
        columns[py::str(column.name)] = std::visit(
            [&](const auto& values) {
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, std::vector<std::string>>)
                    return py::make_tuple(column.unit, values);
                else
                    return py::make_tuple(column.unit, view(owner, values, {column.shape.begin(), column.shape.end()}));
            },
            column.values);
    return py::make_tuple(attributes, columns);
}

/// By their names.
inline py::dict tables(const py::object& owner, const std::vector<api::Table>& list)
{
    py::dict all;
    for (const api::Table& each : list)
        all[py::str(each.name)] = table(owner, each);
    return all;
}

} // namespace stylobate::python
