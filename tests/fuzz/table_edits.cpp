#include "tests/fuzz/table_edits.hpp"

#include "tests/fuzz/any_value.hpp"

#include <bit>
#include <limits>
#include <type_traits>

namespace stylobate::fuzz {
namespace {

using Attributes = std::vector<std::pair<std::string, Table::Attribute>>;

/// A table whose parts can be changed.
struct Parts {
    std::string name;
    Attributes attributes;
    std::vector<Table::Column> columns;
};

std::string stored_text(const std::string& before, ByteSource& recipe)
{
    const std::string text = any_text(before, recipe);
    return text.substr(0, text.find('\0'));
}

template <class T>
void change_value(T& value, ByteSource& recipe)
{
    if constexpr (std::is_same_v<T, std::string>)
        value = stored_text(value, recipe);
    else if constexpr (std::is_same_v<T, double>)
        value = any_double(recipe);
    else
        value = static_cast<T>(any_count(recipe));
}

void change_attribute(Attributes& attributes, ByteSource& recipe)
{
    if (attributes.empty())
        return;
    const std::size_t at = recipe.below(attributes.size());
    auto& [name, value] = attributes[at];
    switch (recipe.byte() % 8) {
    case 0:
        attributes.erase(attributes.begin() + static_cast<std::ptrdiff_t>(at));
        break;
    case 1:
        name = stored_text(name, recipe);
        break;
    case 2: // of another type
        if (std::holds_alternative<double>(value))
            value = any_count(recipe);
        else
            value = any_double(recipe);
        break;
    default:
        std::visit([&](auto& held) { change_value(held, recipe); }, value);
    }
}

/// The first values that there were, then zeros: as many as the shape says.
void change_shape(Table::Column& column, ByteSource& recipe)
{
    constexpr std::size_t longest = 64;
    const std::uint8_t how = recipe.byte();
    if (how % 3 == 0 && column.shape.size() < 4)
        column.shape.push_back(recipe.below(4));
    else if (how % 3 == 1 && !column.shape.empty())
        column.shape[recipe.below(column.shape.size())] = recipe.below(8);
    else if (!column.shape.empty())
        column.shape.pop_back();
    std::size_t count = 1;
    for (const std::size_t n : column.shape)
        count *= n;
    if (count > longest)
        column.shape = {count = longest};
    std::visit([&](auto& values) { values.resize(count); }, column.values);
}

void change_type(Table::Column& column, ByteSource& recipe)
{
    const std::size_t count = std::visit([](const auto& values) { return values.size(); }, column.values);
    switch (recipe.below(4)) {
    case 0:
        column.values = std::vector<double>(count, any_double(recipe));
        break;
    case 1:
        column.values = std::vector<std::uint64_t>(count, any_count(recipe));
        break;
    case 2:
        column.values = std::vector<std::int32_t>(count, static_cast<std::int32_t>(any_count(recipe)));
        break;
    default:
        column.values = std::vector<std::string>(count, stored_text("", recipe));
    }
}

void change_column(std::vector<Table::Column>& columns, ByteSource& recipe)
{
    if (columns.empty())
        return;
    const std::size_t at = recipe.below(columns.size());
    Table::Column& column = columns[at];
    switch (recipe.byte() % 8) {
    case 0:
        columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(at));
        break;
    case 1:
        column.name =
            recipe.byte() % 2 == 0 ? columns[recipe.below(columns.size())].name : stored_text(column.name, recipe);
        break;
    case 2:
        change_shape(column, recipe);
        break;
    case 3:
        change_type(column, recipe);
        break;
    default:
        std::visit(
            [&](auto& values) {
                if (!values.empty())
                    change_value(values[recipe.below(values.size())], recipe);
            },
            column.values);
    }
}

void change_table(std::vector<Parts>& tables, ByteSource& recipe)
{
    const std::size_t at = recipe.below(tables.size());
    switch (recipe.byte() % 4) {
    case 0:
        tables.erase(tables.begin() + static_cast<std::ptrdiff_t>(at));
        break;
    case 1:
        tables[at].name = stored_text(tables[at].name, recipe);
        break;
    case 2: // the content of another one
        tables[at].columns = tables[recipe.below(tables.size())].columns;
        break;
    default:
        tables[at].name = tables[recipe.below(tables.size())].name;
    }
}

template <class T>
bool same_value(const T& a, const T& b)
{
    if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    else
        return a == b;
}

template <class Variant, class Same>
bool same_held(const Variant& a, const Variant& b, const Same& same)
{
    return a.index() == b.index() &&
           std::visit([&]<class Held>(const Held& held) { return same(held, std::get<Held>(b)); }, a);
}

bool same_columns(const Table::Column& a, const Table::Column& b)
{
    return a.name == b.name && a.shape == b.shape && a.unit == b.unit &&
           same_held(a.values, b.values, [](const auto& x, const auto& y) {
               return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                                 [](const auto& v, const auto& w) { return same_value(v, w); });
           });
}

bool same_attributes(const Attributes::value_type& a, const Attributes::value_type& b)
{
    return a.first == b.first &&
           same_held(a.second, b.second, [](const auto& x, const auto& y) { return same_value(x, y); });
}

} // namespace

std::vector<Table> edited_tables(const std::vector<Table>& tables, ByteSource& recipe)
{
    std::vector<Parts> parts;
    for (const Table& table : tables)
        parts.push_back({table.name(), table.attributes(), table.columns()});
    while (!recipe.empty() && !parts.empty()) {
        const std::uint8_t how = recipe.byte();
        if (how < 16) {
            change_table(parts, recipe);
            continue;
        }
        Parts& table = parts[recipe.below(parts.size())];
        if (how < 96)
            change_attribute(table.attributes, recipe);
        else
            change_column(table.columns, recipe);
    }
    std::vector<Table> made;
    for (Parts& part : parts) {
        Table& table = made.emplace_back(part.name, "a file");
        for (auto& [name, value] : part.attributes)
            table.set(std::move(name), std::move(value));
        for (Table::Column& column : part.columns)
            table.add(std::move(column.name), std::move(column.values), std::move(column.shape),
                      std::move(column.unit));
    }
    return made;
}

bool same_tables(const std::vector<Table>& a, const std::vector<Table>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Table& x, const Table& y) {
        return x.name() == y.name() &&
               std::equal(x.attributes().begin(), x.attributes().end(), y.attributes().begin(), y.attributes().end(),
                          same_attributes) &&
               std::equal(x.columns().begin(), x.columns().end(), y.columns().begin(), y.columns().end(), same_columns);
    });
}

} // namespace stylobate::fuzz
