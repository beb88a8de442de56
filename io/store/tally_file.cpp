#include "io/store/tally_file.hpp"

#include "io/store/result_file.hpp"

#include <algorithm>

namespace stylobate {
namespace {

namespace names = result_names;

std::string in_tally(const std::string& name)
{
    return std::string(names::tally) + "/" + name;
}

void write_times(hid_t file, const std::string& name, const TimeCounts& times)
{
    const hdf5::Handle group = hdf5::create_group(file, in_tally(name));
    std::vector<double> time;
    std::vector<std::uint64_t> count;
    for (const auto& [time_s, n] : times.counts()) {
        time.push_back(time_s);
        count.push_back(n);
    }
    hdf5::write_number(group.id(), "exact", H5T_STD_U8LE, times.exact());
    hdf5::write_array(group.id(), "time_s", time, {time.size()}, "s");
    hdf5::write_array(group.id(), "count", count, {count.size()}, "");
}

TimeCounts read_times(hid_t file, const std::string& name, std::uint64_t most)
{
    const hdf5::Handle group = hdf5::open_group(file, in_tally(name));
    const hdf5::Dims dims = hdf5::dims_of(group.id(), "time_s");
    if (dims.size() != 1)
        throw hdf5::Error("'" + name + "' is not a list");
    const std::vector<double> time = hdf5::read_doubles(group.id(), "time_s", dims);
    const std::vector<std::uint64_t> count = hdf5::read_counts(group.id(), "count", dims);
    TimeCounts::Counts counts;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        total += count[i];
        const bool in_order = counts.empty() || time[i] > counts.back().first;
        if (!(time[i] >= 0) || !in_order || count[i] == 0 || count[i] > most || total > most)
            throw hdf5::Error("'" + name + "' contains values that no run writes");
        counts.emplace_back(time[i], count[i]);
    }
    return {std::move(counts), hdf5::read_number(group.id(), "exact") != 0};
}

} // namespace

void write_tally(hid_t file, const ResultHeader& header, const TallyFile& counted)
{
    const Tally& tally = counted.tally;
    const hdf5::Handle group = hdf5::create_group(file, names::tally);
    hdf5::write_text(group.id(), names::input_order, joined_inputs(header));
    hdf5::write_text(group.id(), names::blocks, joined_names(header.block_names));
    hdf5::write_text(group.id(), names::limit_states, joined_names(header.limit_states));
    hdf5::write_real(group.id(), "energy_residual", tally.energy_residual);
    hdf5::write_number(group.id(), "energy_realization", H5T_STD_U64LE, tally.energy_realization);

    const hdf5::Dims cells = {header.frequency_hz.size(), header.pga_m_s2.size()};
    const auto by = [&](std::size_t more) { return hdf5::Dims{cells[0], cells[1], more}; };
    // the axes of /surface once more: the scale of a dimension lies in the same group
    hdf5::write_array(file, in_tally("frequency_hz"), header.frequency_hz, {cells[0]}, "Hz");
    hdf5::write_array(file, in_tally("pga_m_s2"), header.pga_m_s2, {cells[1]}, "m/s2");
    hdf5::write_array(file, in_tally("trials"), tally.trials, cells, "");
    hdf5::write_array(file, in_tally("invalid"), tally.invalid, cells, "");
    hdf5::write_array(file, in_tally("reached"), tally.reached, by(tally.limit_states), "");
    hdf5::write_array(file, in_tally("first_fallen"), tally.first, by(tally.blocks), "");
    hdf5::write_array(file, in_tally("first_together"), tally.first_together, cells, "");
    write_times(file, "collapse_time", tally.collapse_time_s);
    write_times(file, "total_collapse_time", tally.total_collapse_time_s);

    std::vector<std::uint64_t> index;
    std::vector<std::uint8_t> reason;
    for (const auto& [i, why] : tally.first_invalid) {
        index.push_back(i);
        reason.push_back(static_cast<std::uint8_t>(why));
    }
    hdf5::write_array(file, in_tally("invalid_index"), index, {index.size()}, "");
    hdf5::write_bytes(file, in_tally("invalid_reason"), file_type(Stored::invalid_reason).id(), reason,
                      {reason.size()});

    std::vector<std::uint64_t> done;
    for (const auto& [begin, part] : counted.done.parts())
        done.insert(done.end(), {begin, part.end, part.collapsed, part.invalid});
    hdf5::write_array(file, in_tally("done"), done, {done.size() / 4, 4}, "");
}

TallyFile read_tally(hid_t file, const ResultHeader& header)
{
    const auto wrong = [](const std::string& what) { throw hdf5::Error("its counts are not those of a run: " + what); };
    const hdf5::Dims cells = {header.frequency_hz.size(), header.pga_m_s2.size()};
    const auto by = [&](std::size_t more) { return hdf5::Dims{cells[0], cells[1], more}; };
    TallyFile counted;
    Tally& tally = counted.tally;
    tally.limit_states = header.limit_states.size();
    tally.blocks = header.block_names.size();
    const hdf5::Handle group = hdf5::open_group(file, names::tally);
    tally.energy_residual = hdf5::read_any_number(group.id(), "energy_residual");
    tally.energy_realization = hdf5::read_number(group.id(), "energy_realization");
    tally.trials = hdf5::read_counts(file, in_tally("trials"), cells);
    tally.invalid = hdf5::read_counts(file, in_tally("invalid"), cells);
    tally.reached = hdf5::read_counts(file, in_tally("reached"), by(tally.limit_states));
    tally.first = hdf5::read_counts(file, in_tally("first_fallen"), by(tally.blocks));
    tally.first_together = hdf5::read_counts(file, in_tally("first_together"), cells);
    tally.collapse_time_s = read_times(file, "collapse_time", header.total);
    tally.total_collapse_time_s = read_times(file, "total_collapse_time", header.total);

    const hdf5::Dims list = hdf5::dims_of(file, in_tally("invalid_index"));
    if (list.size() != 1 || list[0] > Tally::most_invalid)
        wrong("the list of the invalid ones");
    const std::vector<std::uint64_t> index = hdf5::read_counts(file, in_tally("invalid_index"), list);
    const std::vector<std::uint8_t> reason =
        hdf5::read_bytes(file, in_tally("invalid_reason"), file_type(Stored::invalid_reason).id(), list);
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] >= header.total || reason[i] > static_cast<std::uint8_t>(InvalidReason::energy))
            wrong("the list of the invalid ones");
        tally.first_invalid.emplace(index[i], static_cast<InvalidReason>(reason[i]));
    }

    const hdf5::Dims parts = hdf5::dims_of(file, in_tally("done"));
    if (parts.size() != 2 || parts[1] != 4)
        wrong("the list of what is done");
    const std::vector<std::uint64_t> done = hdf5::read_counts(file, in_tally("done"), parts);
    counted.done = DoneSet(RunOrder(header.total));
    for (std::size_t i = 0; i < done.size(); i += 4)
        if (done[i + 1] > header.total || !counted.done.append(done[i], {done[i + 1], done[i + 2], done[i + 3]}))
            wrong("the list of what is done");
    const DoneSet::Part all = counted.done.all();
    if (tally.added() != all.end || tally.all_invalid() != all.invalid)
        wrong("their number differs from that of the counted realizations");
    return counted;
}

} // namespace stylobate
