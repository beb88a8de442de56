#include "io/tables/table_hdf5.hpp"

#include <type_traits>

namespace stylobate {

namespace {

void write_column(hid_t group, const Table::Column& column)
{
    const hdf5::Dims dims(column.shape.begin(), column.shape.end());
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
            if constexpr (!std::is_same_v<T, std::string>)
                hdf5::write_array(group, column.name, values, dims, column.unit);
            else if (column.words.empty())
                hdf5::write_texts(group, column.name, values);
            else
                hdf5::write_words(group, column.name, values, column.words);
        },
        column.values);
}

Table::Values read_values(hid_t group, const std::string& name, const hdf5::Dims& dims)
{
    switch (hdf5::kind_of(group, name)) {
    case hdf5::Kind::real:
        return hdf5::read_doubles(group, name, dims);
    case hdf5::Kind::count:
        return hdf5::read_counts(group, name, dims);
    case hdf5::Kind::integer:
        return hdf5::read_integers(group, name, dims);
    case hdf5::Kind::text:
        return hdf5::read_texts(group, name, dims);
    case hdf5::Kind::word:
        return hdf5::read_words(group, name, dims);
    }
    throw hdf5::Error("'" + name + "' has no known type");
}

} // namespace

void write_content(hid_t group, const Table& table)
{
    for (const auto& [name, value] : table.attributes())
        if (const auto* text = std::get_if<std::string>(&value))
            hdf5::write_text(group, name, *text);
        else if (const auto* number = std::get_if<double>(&value))
            hdf5::write_real(group, name, *number);
        else
            hdf5::write_number(group, name, H5T_STD_U64LE, std::get<std::uint64_t>(value));
    for (const Table::Column& column : table.columns())
        write_column(group, column);
    for (const Table& below : table.tables())
        write_table(group, below);
}

void write_table(hid_t parent, const Table& table)
{
    write_content(hdf5::create_group(parent, table.name()).id(), table);
}

Table read_content(hid_t group, const std::string& name, const std::string& file)
{
    Table table(name, file);
    for (const std::string& attribute : hdf5::attributes_of(group))
        switch (hdf5::kind_of_attribute(group, attribute)) {
        case hdf5::Kind::text:
            table.set(attribute, hdf5::read_text(group, attribute));
            break;
        case hdf5::Kind::real:
            table.set(attribute, hdf5::read_any_number(group, attribute));
            break;
        default:
            table.set(attribute, hdf5::read_number(group, attribute));
        }
    for (const std::string& part : hdf5::names_in(group))
        if (hdf5::is_group(group, part)) {
            table.add(read_table(group, part, file));
        } else {
            const hdf5::Dims dims = hdf5::dims_of(group, part);
            table.add(part, read_values(group, part, dims), {dims.begin(), dims.end()});
        }
    return table;
}

Table read_table(hid_t parent, const std::string& name, const std::string& file)
{
    return hdf5::exists(parent, name) ? read_content(hdf5::open_group(parent, name).id(), name, file)
                                      : Table(name, file);
}

} // namespace stylobate
