#include "io/store/tables/result_fragility.hpp"

namespace stylobate {

namespace {

constexpr char group[] = "fragility";

std::string in_group(const std::string& name)
{
    return std::string(group) + "/" + name;
}

void write(hid_t file, const std::string& name, const IntervalArray& of, const hdf5::Dims& dims,
           const std::string& unit)
{
    hdf5::write_array(file, in_group(name), of.value, dims, unit);
    hdf5::write_array(file, in_group(name + "_lower"), of.lower, dims, unit);
    hdf5::write_array(file, in_group(name + "_upper"), of.upper, dims, unit);
}

IntervalArray read(hid_t file, const std::string& name, const hdf5::Dims& dims)
{
    return {hdf5::read_doubles(file, in_group(name), dims), hdf5::read_doubles(file, in_group(name + "_lower"), dims),
            hdf5::read_doubles(file, in_group(name + "_upper"), dims)};
}

} // namespace

void write_fragility(hid_t file, const FragilityTable& table)
{
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_text(made.id(), "measure", table.measure);
    hdf5::write_text(made.id(), "interval", "95 % by the motions: jackknife of curves, weighted motions of shares");
    const hdf5::Dims rows = {table.motion.size()}, states = {table.states.size()}, points = {table.grid.size()};
    hdf5::write_array(file, in_group("motion"), table.motion, rows, "");
    hdf5::write_array(file, in_group("intensity"), table.intensity, rows, "");
    if (table.states.empty()) // too few motions for any curve
        return;
    hdf5::write_texts(file, in_group("states"), table.states);
    hdf5::write_texts(file, in_group("meanings"), table.meanings);
    hdf5::write_array(file, in_group("trials"), table.trials, states, "");
    hdf5::write_array(file, in_group("reached"), table.reached, states, "");
    write(file, "median", table.median, states, "");
    write(file, "dispersion", table.dispersion, states, "");
    hdf5::write_array(file, in_group("grid"), table.grid, points, "");
    write(file, "curve", table.curve, {states[0], points[0]}, "");
    if (table.stripe.empty())
        return;
    hdf5::write_array(file, in_group("stripe"), table.stripe, {table.stripe.size()}, "");
    write(file, "share", table.share, {states[0], table.stripe.size()}, "");
}

FragilityTable read_fragility_table(hid_t file)
{
    FragilityTable table;
    if (!hdf5::exists(file, group))
        return table;
    table.measure = hdf5::read_text(hdf5::open_group(file, group).id(), "measure");
    const auto dims = [file](const char* name) { return hdf5::dims_of(file, in_group(name)); };
    const hdf5::Dims rows = dims("motion");
    table.motion = hdf5::read_integers(file, in_group("motion"), rows);
    table.intensity = hdf5::read_doubles(file, in_group("intensity"), rows);
    if (!hdf5::exists(file, in_group("states").c_str()))
        return table;
    const hdf5::Dims states = dims("states"), points = dims("grid");
    table.states = hdf5::read_texts(file, in_group("states"), states);
    table.meanings = hdf5::read_texts(file, in_group("meanings"), states);
    table.trials = hdf5::read_counts(file, in_group("trials"), states);
    table.reached = hdf5::read_counts(file, in_group("reached"), states);
    table.median = read(file, "median", states);
    table.dispersion = read(file, "dispersion", states);
    table.grid = hdf5::read_doubles(file, in_group("grid"), points);
    table.curve = read(file, "curve", {states.at(0), points.at(0)});
    if (!hdf5::exists(file, in_group("stripe").c_str()))
        return table;
    const hdf5::Dims stripes = dims("stripe");
    table.stripe = hdf5::read_doubles(file, in_group("stripe"), stripes);
    table.share = read(file, "share", {states.at(0), stripes.at(0)});
    return table;
}

} // namespace stylobate
