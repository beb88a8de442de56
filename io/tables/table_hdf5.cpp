#include "io/tables/table_hdf5.hpp"

namespace stylobate {

namespace {

void write_column(hid_t parent, const std::string& group, const Table::Column& column)
{
    const std::string path = group + "/" + column.name;
    const hdf5::Dims dims(column.shape.begin(), column.shape.end());
    if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values))
        return hdf5::write_texts(parent, path, *texts);
    if (const auto* numbers = std::get_if<std::vector<double>>(&column.values))
        return hdf5::write_array(parent, path, *numbers, dims, column.unit);
    if (const auto* counts = std::get_if<std::vector<std::uint64_t>>(&column.values))
        return hdf5::write_array(parent, path, *counts, dims, column.unit);
    hdf5::write_array(parent, path, std::get<std::vector<std::int32_t>>(column.values), dims, column.unit);
}

Table::Values read_values(hid_t parent, const std::string& path, const hdf5::Dims& dims)
{
    switch (hdf5::kind_of(parent, path)) {
    case hdf5::Kind::real:
        return hdf5::read_doubles(parent, path, dims);
    case hdf5::Kind::count:
        return hdf5::read_counts(parent, path, dims);
    case hdf5::Kind::integer:
        return hdf5::read_integers(parent, path, dims);
    case hdf5::Kind::text:
        return hdf5::read_texts(parent, path, dims);
    }
    throw hdf5::Error("'" + path + "' has no known type");
}

} // namespace

void write_table(hid_t parent, const Table& table)
{
    const hdf5::Handle made = hdf5::create_group(parent, table.name());
    for (const auto& [name, value] : table.attributes())
        if (const auto* text = std::get_if<std::string>(&value))
            hdf5::write_text(made.id(), name, *text);
        else if (const auto* number = std::get_if<double>(&value))
            hdf5::write_real(made.id(), name, *number);
        else
            hdf5::write_number(made.id(), name, H5T_STD_U64LE, std::get<std::uint64_t>(value));
    for (const Table::Column& column : table.columns())
        write_column(parent, table.name(), column);
}

Table read_table(hid_t parent, const std::string& name, const std::string& file)
{
    Table table(name, file);
    if (!hdf5::exists(parent, name))
        return table;
    const hdf5::Handle group = hdf5::open_group(parent, name);
    for (const std::string& attribute : hdf5::attributes_of(group.id()))
        switch (hdf5::kind_of_attribute(group.id(), attribute)) {
        case hdf5::Kind::text:
            table.set(attribute, hdf5::read_text(group.id(), attribute));
            break;
        case hdf5::Kind::real:
            table.set(attribute, hdf5::read_any_number(group.id(), attribute));
            break;
        default:
            table.set(attribute, hdf5::read_number(group.id(), attribute));
        }
    for (const std::string& column : hdf5::names_in(group.id())) {
        const std::string path = name + "/" + column;
        const hdf5::Dims dims = hdf5::dims_of(parent, path);
        table.add(column, read_values(parent, path, dims), {dims.begin(), dims.end()});
    }
    return table;
}

} // namespace stylobate
