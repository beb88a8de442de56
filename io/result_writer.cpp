#include "ensemble/input_error.hpp"
#include "io/result_file.hpp"
#include "io/result_fragility.hpp"
#include "io/result_rare.hpp"
#include "io/result_sensitivity.hpp"
#include "io/result_store.hpp"
#include "io/result_twins.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

namespace stylobate {
namespace {

namespace names = result_names;

void write_rows_skeleton(hid_t file, const ResultHeader& header, const ResultLayout& layout)
{
    hdf5::create_group(file, names::realizations);
    const hdf5::Handle input = hdf5::create_group(file, names::input);
    hdf5::write_text(input.id(), names::input_order, joined_inputs(header));
    const hdf5::Handle outcome = hdf5::create_group(file, names::outcome);
    hdf5::write_text(outcome.id(), names::blocks, joined_names(header.block_names));
    for (const Column& column : layout.columns()) {
        const auto dataset = hdf5::create_dataset(file, std::string(names::realizations) + "/" + column.path,
                                                  file_type(column.stored).id(), column_dims(layout, column),
                                                  column.stored == Stored::state ? &state_not_run : nullptr);
        if (!column.unit.empty())
            hdf5::write_text(dataset.id(), "unit", column.unit);
        if (!column.none.empty())
            hdf5::write_text(dataset.id(), "none", column.none);
    }
    const auto checksum = hdf5::create_dataset(file, names::checksum, H5T_STD_U64LE, {layout.chunks()});
    hdf5::write_number(checksum.id(), names::rows_per_chunk, H5T_STD_U32LE, ResultWriter::rows_per_chunk);
}

/// Everything but the values of the rows.
void write_skeleton(hid_t file, const ResultHeader& header, const ResultLayout& layout)
{
    write_header(file, header, false);
    write_rows_skeleton(file, header, layout);
}

void write_trajectory(hid_t file, const Trajectory& trajectory)
{
    const std::string group = std::string(names::trajectories) + "/" + std::to_string(trajectory.index);
    const hdf5::Handle made = hdf5::create_group(file, group);
    hdf5::write_text(made.id(), names::blocks, joined_names(trajectory.name));
    const hdf5::Dims time = {trajectory.time_s.size()};
    const hdf5::Dims block = {trajectory.blocks()};
    const hdf5::Dims both = {trajectory.time_s.size(), trajectory.blocks()};
    hdf5::write_array(file, group + "/time_s", trajectory.time_s, time, "s");
    hdf5::write_array(file, group + "/x_m", trajectory.x_m, both, "m");
    hdf5::write_array(file, group + "/y_m", trajectory.y_m, both, "m");
    hdf5::write_array(file, group + "/theta_rad", trajectory.theta_rad, both, "rad");
    hdf5::write_array(file, group + "/base_x_m", trajectory.base_x_m, time, "m");
    hdf5::write_array(file, group + "/rest_x_m", trajectory.rest_x_m, block, "m");
    hdf5::write_array(file, group + "/rest_y_m", trajectory.rest_y_m, block, "m");
    hdf5::write_array(file, group + "/half_width_m", trajectory.half_width_m, block, "m");
    hdf5::write_array(file, group + "/half_height_m", trajectory.half_height_m, block, "m");
    std::vector<std::uint8_t> roles;
    for (const BlockRole role : trajectory.role)
        roles.push_back(static_cast<std::uint8_t>(role));
    hdf5::write_bytes(file, group + "/role", role_type().id(), roles, block);
    hdf5::write_array(file, group + "/column", trajectory.column, block, "");
}

/// A new file without the values of its rows. @param handle holds the path
RowPlaces write_unfilled(const std::filesystem::path& path, FileHandle& handle, const ResultHeader& header,
                         const ResultLayout& layout)
{
    const std::uint64_t block = seal_bytes(layout.columns().size() + 1);
    hdf5::Handle made = hdf5::create_file(path, block);
    write_skeleton(made.id(), header, layout);
    RowPlaces places = find_rows(made.id(), layout);
    made.close();
    handle.reserve();
    write_seal(handle, block, places.extents(layout));
    return places;
}

} // namespace

struct ResultWriter::Impl {
    /// A chunk that waits for its last rows.
    struct Pending {
        std::vector<std::byte> bytes;
        std::vector<bool> taken;
        std::uint64_t missing = 0;
    };

    ResultFile file;
    std::vector<bool> done; ///< by chunk
    RowNumbers numbers;
    std::uint64_t next = 0; ///< where the rows are selected they lie as they come: the number of the next one
    std::uint64_t rows = 0;
    std::array<std::uint64_t, 5> by_state = {};
    std::map<std::uint64_t, Pending> pending;
    std::map<std::uint64_t, Trajectory> trajectories;
    bool finished = false;

    explicit Impl(ResultFile opened) : file(std::move(opened)), done(file.layout.chunks(), false), numbers(file.header)
    {
    }

    void count(std::uint64_t chunk, std::span<const std::byte> bytes)
    {
        done[chunk] = true;
        const std::uint64_t first = file.layout.first_row(chunk);
        for (std::uint64_t i = 0; i < file.layout.rows_in(chunk); ++i) {
            const ResultRow row = file.layout.decode(first + i, bytes);
            if (file.header.selected)
                numbers.add(row.index, first + i); // a row that was added is known already
            ++by_state[static_cast<std::size_t>(row.outcome.state)];
            ++rows;
        }
    }

    /// The number of a row that is not there; none if the realization has no place in the file.
    std::optional<std::uint64_t> number_for(std::uint64_t index)
    {
        if (!file.header.selected)
            return numbers.of(index);
        const ResultLayout& layout = file.layout;
        while (next < layout.rows() && done[layout.chunk_of(next)])
            next = layout.first_row(layout.chunk_of(next) + 1);
        if (next >= layout.rows())
            return std::nullopt;
        numbers.add(index, next);
        return next++;
    }

    /// A file of the selected rows alone, in index order. @param handle holds the path
    void write_selected(const std::filesystem::path& path, FileHandle& handle);

    void check_open() const
    {
        if (finished)
            throw std::logic_error("the results file is finished: nothing can be added");
    }
};

void ResultWriter::Impl::write_selected(const std::filesystem::path& path, FileHandle& handle)
{
    const ResultLayout& from = file.layout;
    std::vector<ResultRow> selected;
    for (std::uint64_t chunk = 0; chunk < from.chunks(); ++chunk) {
        const auto waiting = pending.find(chunk);
        std::vector<std::byte> bytes;
        if (waiting != pending.end()) {
            bytes = waiting->second.bytes;
        } else if (done[chunk]) {
            std::optional<std::vector<std::byte>> read = file.read_chunk(chunk);
            if (!read)
                file.refuse_damaged("rows from " + std::to_string(from.first_row(chunk)) +
                                    " on have changed since they were written");
            bytes = std::move(*read);
        } else {
            continue;
        }
        for (std::uint64_t i = 0; i < from.rows_in(chunk); ++i)
            if (done[chunk] || waiting->second.taken[i])
                selected.push_back(from.decode(from.first_row(chunk) + i, bytes));
    }
    std::sort(selected.begin(), selected.end(), [](const auto& a, const auto& b) { return a.index < b.index; });

    ResultHeader header = file.header;
    header.total = selected.size();
    ResultFile to;
    to.path = path;
    to.header = header;
    to.layout = ResultLayout(header);
    to.handle = std::move(handle);
    to.places = write_unfilled(path, to.handle, header, to.layout);
    for (std::uint64_t chunk = 0; chunk < to.layout.chunks(); ++chunk) {
        std::vector<std::byte> bytes(to.layout.row_bytes() * to.layout.rows_in(chunk));
        for (std::uint64_t i = 0; i < to.layout.rows_in(chunk); ++i) {
            const std::uint64_t number = to.layout.first_row(chunk) + i;
            to.layout.encode(number, selected[number], bytes);
        }
        to.write_chunk(chunk, bytes);
    }
    handle = std::move(to.handle);
    file.header = header;
    file.layout = to.layout;
}

ResultWriter::ResultWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultWriter::~ResultWriter() = default;

std::unique_ptr<ResultWriter> ResultWriter::create(const std::filesystem::path& file, const ResultHeader& header)
{
    const ResultLayout layout(header);
    if (header.frequency_hz.empty() != header.pga_m_s2.empty())
        throw std::invalid_argument("a surface has two axes");
    if (std::filesystem::exists(std::filesystem::symlink_status(file)))
        throw InputError(file.string(), 0, "exists already; choose another output");

    ResultFile result;
    result.path = file;
    result.header = header;
    result.layout = layout;
    const std::filesystem::path unready = beside(file, ".creating");
    result.handle = FileHandle::claim(unready);
    Temporary temporary(unready);
    try {
        result.places = write_unfilled(unready, result.handle, header, layout);
        result.handle.sync();
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    } catch (const std::system_error& error) {
        throw InputError(file.string(), 0, "cannot be written: " + error.code().message());
    }
    rename_new(unready, file);
    temporary.keep();
    return std::unique_ptr<ResultWriter>(new ResultWriter(std::make_unique<Impl>(std::move(result))));
}

std::unique_ptr<ResultWriter> ResultWriter::resume(const std::filesystem::path& file, const ResultHeader& header)
{
    // behind a symbolic link the file itself is continued and, at the end, replaced
    std::error_code ignored;
    const auto real = std::filesystem::canonical(file, ignored);
    ResultFile opened = open_result(real.empty() ? file : real, true);
    check_same_study(opened, header);
    opened.hdf5.reset(); // rows need the places only

    auto impl = std::make_unique<Impl>(std::move(opened));
    for (std::uint64_t chunk = 0; chunk < impl->file.layout.chunks(); ++chunk)
        if (const auto bytes = impl->file.read_chunk(chunk)) {
            try {
                impl->count(chunk, *bytes);
            } catch (const std::invalid_argument& error) {
                impl->file.refuse_damaged(error.what());
            }
        }
    return std::unique_ptr<ResultWriter>(new ResultWriter(std::move(impl)));
}

bool ResultWriter::has(std::uint64_t index) const
{
    const auto number = impl_->numbers.of(index);
    return number && impl_->done[impl_->file.layout.chunk_of(*number)];
}

std::uint64_t ResultWriter::rows() const
{
    return impl_->rows;
}

std::vector<std::uint64_t> ResultWriter::rows_by_state() const
{
    return {impl_->by_state.begin(), impl_->by_state.end()};
}

void ResultWriter::add(const ResultRow& row)
{
    impl_->check_open();
    const ResultLayout& layout = impl_->file.layout;
    const auto refuse = [&] {
        throw std::invalid_argument("row " + std::to_string(row.index) + " does not fit into the results file");
    };
    if (row.inputs.size() != layout.inputs() || row.outcome.fall_time_s.size() != layout.blocks())
        refuse();
    if (has(row.index) || (impl_->file.header.selected && impl_->numbers.of(row.index)))
        return;
    const std::optional<std::uint64_t> number = impl_->number_for(row.index);
    if (!number)
        refuse();
    const std::uint64_t chunk = layout.chunk_of(*number);
    const auto [at, is_new] = impl_->pending.try_emplace(chunk);
    Impl::Pending& pending = at->second;
    if (is_new) {
        pending.missing = layout.rows_in(chunk);
        pending.taken.resize(pending.missing);
        pending.bytes.resize(layout.row_bytes() * pending.missing);
    }
    const std::uint64_t place = *number - layout.first_row(chunk);
    if (pending.taken[place])
        return;
    layout.encode(*number, row, pending.bytes);
    pending.taken[place] = true;
    if (--pending.missing > 0)
        return;
    impl_->file.write_chunk(chunk, pending.bytes);
    impl_->count(chunk, pending.bytes);
    impl_->pending.erase(at);
}

void ResultWriter::add(const Trajectory& trajectory)
{
    impl_->check_open();
    const std::size_t times = trajectory.time_s.size();
    const std::size_t blocks = trajectory.blocks();
    const std::size_t values = times * blocks;
    if (trajectory.x_m.size() != values || trajectory.y_m.size() != values || trajectory.theta_rad.size() != values ||
        trajectory.base_x_m.size() != times || trajectory.half_height_m.size() != blocks ||
        trajectory.rest_x_m.size() != blocks || trajectory.rest_y_m.size() != blocks ||
        trajectory.role.size() != blocks || trajectory.column.size() != blocks || trajectory.name.size() != blocks)
        throw std::invalid_argument("the arrays of a trajectory do not fit together");
    joined_names(trajectory.name); // for its refusals
    impl_->trajectories[trajectory.index] = trajectory;
}

void ResultWriter::flush()
{
    impl_->file.handle.sync();
}

void ResultWriter::finish(const SurfaceTable* surface, const SensitivityTable* sensitivity, const RareTable* rare,
                          const std::vector<FollowedTwin>* twins, const FragilityTable* fragility)
{
    impl_->check_open();
    ResultFile& file = impl_->file;
    if (file.header.selected ? impl_->rows == 0 && impl_->pending.empty() : impl_->rows != file.layout.rows())
        throw std::logic_error("only " + std::to_string(impl_->rows) + " of " + std::to_string(file.layout.rows()) +
                               " rows have been added");
    if (surface)
        check_table(file.header, *surface);

    // The HDF5 structure changes now, in a copy that takes the file's place in one step: a run that is killed here
    // leaves the unfinished file as it was.
    const std::filesystem::path unready = beside(file.path, ".finishing");
    std::filesystem::remove(unready);
    FileHandle copy = FileHandle::claim(unready);
    Temporary temporary(unready);
    if (file.header.selected)
        impl_->write_selected(unready, copy);
    else
        copy.copy_from(file.handle);
    hdf5::Handle opened = hdf5::open_file(unready, true);
    if (surface)
        write_surface(opened.id(), *surface);
    if (sensitivity)
        write_sensitivity(opened.id(), *sensitivity);
    if (rare)
        write_rare(opened.id(), *rare);
    if (twins)
        write_twins(opened.id(), *twins);
    if (fragility)
        write_fragility(opened.id(), *fragility);
    if (!impl_->trajectories.empty())
        hdf5::create_group(opened.id(), names::trajectories);
    for (const auto& [index, trajectory] : impl_->trajectories)
        write_trajectory(opened.id(), trajectory);
    hdf5::change_number(opened.id(), "complete", 1);
    const RowPlaces places = find_rows(opened.id(), file.layout);
    opened.close();
    write_seal(copy, seal_bytes(file.layout.columns().size() + 1), places.extents(file.layout));
    copy.sync();
    rename_over(unready, file.path);
    temporary.keep();
    file.handle = std::move(copy);
    file.places = places;
    impl_->finished = true;
}

} // namespace stylobate
