#pragma once
/// NumPy arrays that share the memory of a C++ object: read-only, and they keep the object alive.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace stylobate::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

inline py::array read_only(py::array array)
{
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

/// A view of all values, row by row.
/// @param owner the Python object in which the values lie
/// @param shape none: a list
template <class T>
py::array view(const py::object& owner, const std::vector<T>& values, Shape shape = {})
{
    if (shape.empty())
        shape = {static_cast<py::ssize_t>(values.size())};
    return read_only(py::array(py::dtype::of<T>(), std::move(shape), {}, values.data(), owner));
}

/// A view of one member of each row.
template <class Row, class T>
py::array column(const py::object& owner, const std::vector<Row>& rows, T Row::*member)
{
    using Number = typename std::conditional_t<std::is_enum_v<T>, std::underlying_type<T>, std::type_identity<T>>::type;
    const void* first = rows.empty() ? nullptr : &(rows.front().*member);
    return read_only(py::array(py::dtype::of<Number>(), {static_cast<py::ssize_t>(rows.size())},
                               {static_cast<py::ssize_t>(sizeof(Row))}, first, owner));
}

/// A copy of the same number of values from each row.
/// @param values gives those of a row
template <class Row, class F>
py::array matrix(const std::vector<Row>& rows, std::size_t width, const F& values)
{
    py::array_t<double> made({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(width)});
    double* to = made.mutable_data();
    for (const Row& row : rows)
        for (const double value : values(row))
            *to++ = value;
    return read_only(made);
}

template <class T>
py::array copied(const std::vector<T>& values)
{
    return read_only(py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data()));
}

} // namespace stylobate::python
