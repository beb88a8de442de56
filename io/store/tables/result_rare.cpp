#include "io/store/tables/result_rare.hpp"

namespace stylobate {

namespace {

constexpr char group[] = "rare";

std::string in_group(const char* name)
{
    return std::string(group) + "/" + name;
}

} // namespace

void write_rare(hid_t file, const RareTable& table)
{
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_real(made.id(), "probability", table.probability);
    hdf5::write_real(made.id(), "lower", table.lower);
    hdf5::write_real(made.id(), "upper", table.upper);
    hdf5::write_text(made.id(), "interval", table.interval);
    hdf5::write_number(made.id(), "realizations", H5T_STD_U64LE, table.realizations);
    hdf5::write_real(made.id(), "plain_realizations", table.plain_realizations);
    const hdf5::Dims both = {table.repeats.size(), table.levels};
    hdf5::write_array(file, in_group("repeats"), table.repeats, {table.repeats.size()}, "");
    hdf5::write_array(file, in_group("threshold_m"), table.threshold_m, both, "m");
    hdf5::write_array(file, in_group("share"), table.share, both, "");
    hdf5::write_array(file, in_group("acceptance"), table.acceptance, both, "");
    hdf5::write_array(file, in_group("stuck"), table.stuck, both, "");
}

RareTable read_rare_table(hid_t file)
{
    RareTable table;
    if (!hdf5::exists(file, group))
        return table;
    const hdf5::Handle opened = hdf5::open_group(file, group);
    table.probability = hdf5::read_any_number(opened.id(), "probability");
    table.lower = hdf5::read_any_number(opened.id(), "lower");
    table.upper = hdf5::read_any_number(opened.id(), "upper");
    table.interval = hdf5::read_text(opened.id(), "interval");
    table.realizations = hdf5::read_number(opened.id(), "realizations");
    table.plain_realizations = hdf5::read_any_number(opened.id(), "plain_realizations");
    const hdf5::Dims both = hdf5::dims_of(file, in_group("share"));
    if (both.size() != 2)
        throw hdf5::Error("'rare/share' is no matrix");
    table.levels = both[1];
    table.repeats = hdf5::read_doubles(file, in_group("repeats"), {both[0]});
    table.threshold_m = hdf5::read_doubles(file, in_group("threshold_m"), both);
    table.share = hdf5::read_doubles(file, in_group("share"), both);
    table.acceptance = hdf5::read_doubles(file, in_group("acceptance"), both);
    table.stuck = hdf5::read_doubles(file, in_group("stuck"), both);
    return table;
}

} // namespace stylobate
