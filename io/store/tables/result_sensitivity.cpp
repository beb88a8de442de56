#include "io/store/tables/result_sensitivity.hpp"

#include <algorithm>
#include <stdexcept>

namespace stylobate {

namespace {

constexpr char group[] = "sensitivity";

std::string in_group(const std::string& name)
{
    return std::string(group) + "/" + name;
}

void write(hid_t file, const std::string& name, const IntervalArray& array, const hdf5::Dims& dims)
{
    std::size_t size = 1;
    for (const hsize_t n : dims)
        size *= n;
    if (array.value.size() != size || array.lower.size() != size || array.upper.size() != size)
        throw std::invalid_argument("the table of sensitivities has not a value for each of its names");
    hdf5::write_array(file, in_group(name), array.value, dims, "");
    hdf5::write_array(file, in_group(name + "_lower"), array.lower, dims, "");
    hdf5::write_array(file, in_group(name + "_upper"), array.upper, dims, "");
}

IntervalArray read(hid_t file, const std::string& name, const hdf5::Dims& dims)
{
    return {hdf5::read_doubles(file, in_group(name), dims), hdf5::read_doubles(file, in_group(name + "_lower"), dims),
            hdf5::read_doubles(file, in_group(name + "_upper"), dims)};
}

} // namespace

void write_sensitivity(hid_t file, const SensitivityTable& table)
{
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_text(made.id(), "method", table.method);
    hdf5::write_text(made.id(), "interval", table.interval);
    hdf5::write_number(made.id(), "rows", H5T_STD_U64LE, table.rows);
    hdf5::write_number(made.id(), "invalid_rows", H5T_STD_U64LE, table.invalid_rows);
    hdf5::write_number(made.id(), "inner", H5T_STD_U64LE, table.inner);
    hdf5::write_texts(file, in_group("outcomes"), table.outcomes);
    hdf5::write_texts(file, in_group("units"), table.units);
    hdf5::write_texts(file, in_group("meanings"), table.meanings);
    hdf5::write_texts(file, in_group("factors"), table.factors);
    std::vector<std::string> names;
    for (const SensitivityTable::Index& index : table.indices)
        names.push_back(index.name);
    hdf5::write_texts(file, in_group("indices"), names);
    const hdf5::Dims outcomes = {table.outcomes.size()}, both = {table.outcomes.size(), table.factors.size()};
    hdf5::write_array(file, in_group("acts"), table.acts, {table.factors.size()}, "");
    write(file, "mean", table.mean, outcomes);
    if (!table.explained.value.empty())
        write(file, "explained", table.explained, outcomes);
    for (const SensitivityTable::Index& index : table.indices)
        write(file, index.name, index.of, both);
}

SensitivityTable read_sensitivity_table(hid_t file)
{
    SensitivityTable table;
    if (!hdf5::exists(file, group))
        return table;
    const hdf5::Handle opened = hdf5::open_group(file, group);
    table.method = hdf5::read_text(opened.id(), "method");
    table.interval = hdf5::read_text(opened.id(), "interval");
    table.rows = hdf5::read_number(opened.id(), "rows");
    table.invalid_rows = hdf5::read_number(opened.id(), "invalid_rows");
    table.inner = hdf5::read_number(opened.id(), "inner");
    const auto texts = [&](const char* name) {
        return hdf5::read_texts(file, in_group(name), hdf5::dims_of(file, in_group(name)));
    };
    table.outcomes = texts("outcomes");
    table.units = texts("units");
    table.meanings = texts("meanings");
    table.factors = texts("factors");
    if (table.units.size() != table.outcomes.size() || table.meanings.size() != table.outcomes.size())
        throw hdf5::Error("'sensitivity' has not a unit and a meaning for each outcome");
    const hdf5::Dims outcomes = {table.outcomes.size()}, both = {table.outcomes.size(), table.factors.size()};
    table.acts = hdf5::read_counts(file, in_group("acts"), {table.factors.size()});
    table.mean = read(file, "mean", outcomes);
    if (hdf5::exists(file, in_group("explained")))
        table.explained = read(file, "explained", outcomes);
    for (const std::string& name : texts("indices"))
        table.indices.push_back({name, read(file, name, both)});
    return table;
}

} // namespace stylobate
