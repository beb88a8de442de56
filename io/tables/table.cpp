#include "io/tables/table.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/utf8.hpp"

#include <algorithm>
#include <cstddef>
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

void Table::add_words(std::string name, std::vector<std::string> texts, std::vector<std::string> words)
{
    add(std::move(name), std::move(texts));
    columns_.back().words = std::move(words);
}

void Table::add(const std::string& name, const IntervalArray& array, const Shape& shape)
{
    add(name, array.value, shape);
    add(name + "_lower", array.lower, shape);
    add(name + "_upper", array.upper, shape);
}

void Table::rename(const std::string& column, std::string name)
{
    const auto found = std::ranges::find(columns_, column, &Column::name);
    if (found == columns_.end())
        refuse("there is no '" + name_ + "/" + column + "'");
    found->name = std::move(name);
}

const Table::Column* Table::find(const std::string& column) const
{
    const auto found = std::ranges::find(columns_, column, &Column::name);
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

const Table::Shape& Table::list_shape(const std::string& column) const
{
    const Shape& found = shape(column);
    if (found.size() != 1)
        refuse("'" + name_ + "/" + column + "' is no list");
    return found;
}

template <class T>
const std::vector<T>& Table::values(const std::string& column, const Shape& shape) const
{
    if (this->shape(column) != shape)
        refuse("'" + name_ + "/" + column + "' does not have the required shape");
    const auto* list = std::get_if<std::vector<T>>(&find(column)->values);
    if (!list)
        refuse("'" + name_ + "/" + column + "' does not have the required type");
    return *list;
}
template const std::vector<double>& Table::values(const std::string&, const Shape&) const;
template const std::vector<std::uint64_t>& Table::values(const std::string&, const Shape&) const;
template const std::vector<std::int32_t>& Table::values(const std::string&, const Shape&) const;
template const std::vector<std::string>& Table::values(const std::string&, const Shape&) const;

const std::vector<double>& Table::numbers(const std::string& column, const Shape& shape) const
{
    return values<double>(column, shape);
}

const std::vector<std::uint64_t>& Table::counts(const std::string& column, const Shape& shape) const
{
    return values<std::uint64_t>(column, shape);
}

const std::vector<std::int32_t>& Table::integers(const std::string& column, const Shape& shape) const
{
    return values<std::int32_t>(column, shape);
}

const std::vector<std::string>& Table::texts(const std::string& column) const
{
    return values<std::string>(column, list_shape(column));
}

IntervalArray Table::intervals(const std::string& column, const Shape& shape) const
{
    return {numbers(column, shape), numbers(column + "_lower", shape), numbers(column + "_upper", shape)};
}

template <class T>
const T& Table::attribute(const std::string& name) const
{
    for (const auto& [known, value] : attributes_)
        if (const T* found = std::get_if<T>(&value); found && known == name)
            return *found;
    refuse("'" + name_ + "' does not have its attribute '" + name + "'");
}
template const std::string& Table::attribute(const std::string&) const;
template const double& Table::attribute(const std::string&) const;
template const std::uint64_t& Table::attribute(const std::string&) const;

const std::string& Table::text(const std::string& attribute) const
{
    return this->attribute<std::string>(attribute);
}

double Table::number(const std::string& attribute) const
{
    return this->attribute<double>(attribute);
}

std::uint64_t Table::count(const std::string& attribute) const
{
    return this->attribute<std::uint64_t>(attribute);
}

const Table& Table::table(const std::string& name) const
{
    return table_named(tables_, name, file_);
}

const Table* find_table(const std::vector<Table>& tables, const std::string& name)
{
    const auto found = std::ranges::find(tables, name, &Table::name);
    return found == tables.end() ? nullptr : &*found;
}

const Table& table_named(const std::vector<Table>& tables, const std::string& name, const std::string& file)
{
    const Table* found = find_table(tables, name);
    if (!found)
        Table(name, file).refuse("the table " + name + " is missing");
    return *found;
}

std::string csv_field(std::string_view value)
{
    std::string text = replaced_text(value);
    if (!text.empty() && std::string_view("=+-@\t").find(text[0]) != std::string_view::npos)
        text.insert(0, "'");
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out.append(c == '"' ? 2 : 1, c);
    return out + '"';
}

std::string csv_text(const Table& table)
{
    std::string text;
    const std::size_t rows = table.columns().empty() ? 0 : table.columns().front().shape.at(0);
    {
        CsvRow head(text);
        for (const Table::Column& column : table.columns()) {
            if (column.shape != Table::Shape{rows})
                throw std::invalid_argument("the columns of '" + table.name() + "' are not lists of equal length");
            head << column.name;
        }
    }
    for (std::size_t i = 0; i < rows; ++i) {
        CsvRow line(text);
        for (const Table::Column& column : table.columns())
            std::visit([&](const auto& values) { line << values[i]; }, column.values);
    }
    return text;
}

std::string markdown_head(std::string_view columns, Align align)
{
    std::string head = "|", rule = "|";
    for (std::size_t begin = 0; begin <= columns.size();) {
        const std::size_t end = std::min(columns.find('|', begin), columns.size());
        std::string_view name = columns.substr(begin, end - begin);
        while (name.starts_with(' '))
            name.remove_prefix(1);
        while (name.ends_with(' '))
            name.remove_suffix(1);
        head += ' ';
        head += name;
        head += name.empty() ? "|" : " |";
        rule += align == Align::numbers ? "---:|" : "---|";
        begin = end + 1;
    }
    if (align == Align::numbers)
        rule.replace(1, 5, "---|");
    return head + '\n' + rule + '\n';
}

} // namespace stylobate
