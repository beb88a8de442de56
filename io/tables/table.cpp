#include "io/tables/table.hpp"

#include "ensemble/model/input_error.hpp"

#include <algorithm>
#include <stdexcept>

namespace stylobate {

namespace {

std::size_t size_of(const Table::Values& values)
{
    return std::visit([](const auto& list) { return list.size(); }, values);
}

} // namespace

void Table::add(std::string name, Values values, Shape shape, std::string unit)
{
    std::size_t size = 1;
    for (const std::size_t n : shape)
        size *= n;
    if (size_of(values) != size)
        throw std::invalid_argument("the values of '" + name_ + "/" + name + "' do not fit its shape");
    columns_.push_back({std::move(name), std::move(values), std::move(shape), std::move(unit)});
}

void Table::add(std::string name, Values values)
{
    const std::size_t size = size_of(values);
    add(std::move(name), std::move(values), {size});
}

void Table::add(const std::string& name, const IntervalArray& array, const Shape& shape)
{
    add(name, array.value, shape);
    add(name + "_lower", array.lower, shape);
    add(name + "_upper", array.upper, shape);
}

const Table::Column* Table::find(const std::string& column) const
{
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& each) { return each.name == column; });
    return found == columns_.end() ? nullptr : &*found;
}

void Table::refuse(const std::string& what) const
{
    throw InputError(file_, 0,
                     "is damaged: " + what + ". Use a backup copy, or run the study again into another file.");
}

const Table::Shape& Table::shape(const std::string& column) const
{
    const Column* found = find(column);
    if (!found)
        refuse("there is no '" + name_ + "/" + column + "'");
    return found->shape;
}

template <class T>
const std::vector<T>& Table::values(const std::string& column, const Shape* shape) const
{
    if (shape && this->shape(column) != *shape)
        refuse("'" + name_ + "/" + column + "' does not have the required shape");
    const Column* found = find(column);
    const auto* list = found ? std::get_if<std::vector<T>>(&found->values) : nullptr;
    if (!list)
        refuse("'" + name_ + "/" + column + "' is missing, or does not have the required type");
    return *list;
}

const std::vector<double>& Table::numbers(const std::string& column, const Shape& shape) const
{
    return values<double>(column, &shape);
}

const std::vector<std::uint64_t>& Table::counts(const std::string& column, const Shape& shape) const
{
    return values<std::uint64_t>(column, &shape);
}

const std::vector<std::int32_t>& Table::integers(const std::string& column, const Shape& shape) const
{
    return values<std::int32_t>(column, &shape);
}

const std::vector<std::string>& Table::texts(const std::string& column) const
{
    return values<std::string>(column, nullptr);
}

IntervalArray Table::intervals(const std::string& column, const Shape& shape) const
{
    return {numbers(column, shape), numbers(column + "_lower", shape), numbers(column + "_upper", shape)};
}

template <class T>
const T& Table::value(const std::string& attribute) const
{
    for (const auto& [name, value] : attributes_)
        if (const T* found = std::get_if<T>(&value); found && name == attribute)
            return *found;
    refuse("'" + name_ + "' does not have its attribute '" + attribute + "'");
}

const std::string& Table::text(const std::string& attribute) const
{
    return value<std::string>(attribute);
}

double Table::number(const std::string& attribute) const
{
    return value<double>(attribute);
}

std::uint64_t Table::count(const std::string& attribute) const
{
    return value<std::uint64_t>(attribute);
}

const Table& table_named(const std::vector<Table>& tables, const std::string& name, const std::string& file)
{
    const auto found = std::ranges::find(tables, name, &Table::name);
    if (found == tables.end())
        Table(name, file).refuse("the table " + name + " is missing");
    return *found;
}

} // namespace stylobate
