#include "ensemble/model/input_error.hpp"
#include "io/store/result_file.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table_hdf5.hpp"

#include <map>
#include <stdexcept>

namespace stylobate {
namespace {

namespace names = result_names;

/// Everything that is known before the first realization.
void write_beginning(hid_t file, const ResultHeader& header)
{
    write_header(file, header, false);
    hdf5::create_group(file, names::realizations);
    const hdf5::Handle input = hdf5::create_group(file, names::input);
    hdf5::write_text(input.id(), names::input_order, joined_inputs(header));
    const hdf5::Handle outcome = hdf5::create_group(file, names::outcome);
    hdf5::write_text(outcome.id(), names::blocks, joined_names(header.block_names));
    if (!header.bed_names.empty())
        hdf5::write_text(outcome.id(), names::beds, joined_names(header.bed_names));
}

/// The rows without their values.
void write_columns(hid_t file, const ResultLayout& layout)
{
    for (const Column& column : layout.columns()) {
        const auto dataset = hdf5::create_dataset(file, std::string(names::realizations) + "/" + column.path,
                                                  file_type(column.stored).id(), column_dims(layout, column),
                                                  column.stored == Stored::state ? &state_not_run : nullptr);
        if (!column.unit.empty())
            hdf5::write_text(dataset.id(), "unit", column.unit);
        if (column.none)
            hdf5::write_text(dataset.id(), "none", std::string(*column.none));
    }
    const auto checksum = hdf5::create_dataset(file, names::checksum, H5T_STD_U64LE, {layout.chunks()});
    hdf5::write_number(checksum.id(), names::rows_per_chunk, H5T_STD_U32LE, ResultWriter::rows_per_chunk);
}

} // namespace

struct ResultWriter::Impl {
    static constexpr std::uint64_t states = 8; ///< room for a state beside the offset of a row

    ResultFile file;
    RowNumbers places; ///< offset of the record's content x `states` + the state
    std::map<std::uint64_t, RowJournal::Record> trajectories;
    bool finished = false;

    explicit Impl(ResultFile opened) : file(std::move(opened)), places(file.header, false) {}

    void count(const ResultRow& row, const RowJournal::Record& record)
    {
        if (!places.add(row.index, record.offset * states + static_cast<std::uint64_t>(row.outcome.state)))
            file.refuse_damaged("two of its rows are of one realization");
    }

    /// @param place as in `places`
    ResultRow row(std::uint64_t place) const
    {
        const RowJournal::Record record{RowJournal::Kind::row, place / states, file.layout.row_bytes()};
        return file.decode(0, RowJournal::content(file.handle, record));
    }

    /// A file of all rows in index order. @param handle holds the path
    /// @returns it, unsealed, its rows' places known
    ResultFile write_ordered(const std::filesystem::path& path, FileHandle handle) const;

    void check_open() const
    {
        if (finished)
            throw std::logic_error("the results file is finished: nothing can be added");
    }
};

ResultFile ResultWriter::Impl::write_ordered(const std::filesystem::path& path, FileHandle handle) const
{
    ResultFile to;
    to.path = path;
    to.header = file.header;
    to.header.total = places.added();
    to.layout = ResultLayout(to.header);
    to.handle = std::move(handle);
    hdf5::Handle made = hdf5::create_file(path, seal_bytes(to.layout.columns().size() + 1));
    write_beginning(made.id(), to.header);
    write_columns(made.id(), to.layout);
    to.places = find_rows(made.id(), to.layout);
    made.close();
    to.handle.reserve();
    std::uint64_t chunk = 0, k = 0;
    std::vector<std::byte> bytes(to.layout.row_bytes() * to.layout.rows_in(0));
    places.for_each([&](std::uint64_t place) {
        to.layout.encode(k++, row(place), bytes);
        if (k < to.layout.rows_in(chunk))
            return;
        to.write_chunk(chunk, bytes);
        if (++chunk < to.layout.chunks())
            bytes.resize(to.layout.row_bytes() * to.layout.rows_in(chunk));
        k = 0;
    });
    return to;
}

ResultWriter::ResultWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultWriter::~ResultWriter() = default;

std::unique_ptr<ResultWriter> ResultWriter::create(const std::filesystem::path& file, const ResultHeader& header)
{
    ResultFile result;
    result.layout = ResultLayout(header);
    if (header.rows().empty() != header.pga_m_s2.empty())
        throw std::invalid_argument("a surface has two axes");
    if (std::filesystem::exists(std::filesystem::symlink_status(file)))
        throw InputError(file.string(), 0, "exists already; choose another output");

    result.path = file;
    result.header = header;
    const std::filesystem::path unready = beside(file, ".creating");
    result.handle = FileHandle::claim(unready);
    Temporary temporary(unready);
    try {
        const std::uint64_t block = seal_bytes(1);
        hdf5::Handle made = hdf5::create_file(unready, block);
        write_beginning(made.id(), header);
        write_labels(made.id());
        made.close();
        write_open_seal(result.handle, block, format_version_of(header.dimensions));
        result.journal = RowJournal(result.handle.size());
        if (!header.selected) // otherwise their number is not known in advance
            result.handle.reserve(RunOrder(header.total).places(header.shard).size() *
                                  (result.layout.row_bytes() + RowJournal::head_bytes));
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

bool ResultWriter::is_finished(const std::filesystem::path& file, const ResultHeader& header)
{
    const ResultFile opened = open_result(file, false);
    check_same_study(opened, header);
    return opened.complete;
}

std::unique_ptr<ResultWriter> ResultWriter::resume(const std::filesystem::path& file, const ResultHeader& header)
{
    // behind a symbolic link the file itself is continued and, at the end, replaced
    std::error_code ignored;
    const auto real = std::filesystem::canonical(file, ignored);
    ResultFile opened = open_result(real.empty() ? file : real, true);
    check_unfinished(opened, header);
    opened.hdf5.reset(); // rows need the journal only

    auto impl = std::make_unique<Impl>(std::move(opened));
    impl->file.read_journal([&](const ResultRow& row, const RowJournal::Record& record) { impl->count(row, record); },
                            [&](const RowJournal::Record& record, std::span<const std::byte> content) {
                                impl->trajectories[trajectory_of(header.dimensions, content).index] = record;
                            });
    return std::unique_ptr<ResultWriter>(new ResultWriter(std::move(impl)));
}

bool ResultWriter::has(std::uint64_t index) const
{
    return impl_->places.of(index).has_value();
}

std::optional<State> ResultWriter::state(std::uint64_t index) const
{
    const auto place = impl_->places.of(index);
    return place ? std::optional(static_cast<State>(*place % Impl::states)) : std::nullopt;
}

std::uint64_t ResultWriter::rows() const
{
    return impl_->places.added();
}

void ResultWriter::for_each_row(const std::function<void(const ResultRow&)>& f) const
{
    impl_->check_open();
    impl_->places.for_each([&](std::uint64_t place) { f(impl_->row(place)); });
}

void ResultWriter::add(const ResultRow& row)
{
    impl_->check_open();
    ResultFile& file = impl_->file;
    const ResultLayout& layout = file.layout;
    if (has(row.index))
        return;
    const bool here = file.header.selected
                          ? rows() < file.header.total
                          : row.index >= file.header.first && row.index - file.header.first < file.header.total;
    if (!here || !layout.fits(row))
        throw std::invalid_argument("row " + std::to_string(row.index) + " does not fit into the results file");
    std::vector<std::byte> bytes(layout.row_bytes());
    layout.encode(0, row, bytes);
    impl_->count(row, file.journal.append(file.handle, RowJournal::Kind::row, bytes));
}

void ResultWriter::add(const Trajectory& trajectory)
{
    impl_->check_open();
    ResultFile& file = impl_->file;
    check_trajectory(trajectory, file.header.dimensions);
    impl_->trajectories[trajectory.index] =
        file.journal.append(file.handle, RowJournal::Kind::trajectory, bytes_of(trajectory));
}

void ResultWriter::flush()
{
    impl_->file.handle.sync();
}

void ResultWriter::finish(const SurfaceTable* surface, const std::vector<Table>& tables)
{
    impl_->check_open();
    ResultFile& file = impl_->file;
    if (file.header.selected ? rows() == 0 : rows() != file.header.total)
        throw std::logic_error("only " + std::to_string(rows()) + " of " + std::to_string(file.header.total) +
                               " rows have been added");
    if (surface)
        check_table(file.header, *surface);

    // The finished file is another one that takes the place of this one in one step: a run that is killed here leaves
    // the unfinished file as it was.
    const std::filesystem::path unready = beside(file.path, ".finishing");
    std::filesystem::remove(unready);
    FileHandle claimed = FileHandle::claim(unready);
    Temporary temporary(unready);
    claimed.take_permissions(file.handle);
    ResultFile made = impl_->write_ordered(unready, std::move(claimed));
    hdf5::Handle opened = hdf5::open_file(unready, true);
    if (surface)
        write_surface(opened.id(), *surface);
    for (const Table& table : tables)
        write_table(opened.id(), table);
    if (!impl_->trajectories.empty())
        hdf5::create_group(opened.id(), names::trajectories);
    for (const auto& [index, record] : impl_->trajectories)
        write_trajectory(opened.id(), trajectory_of(file.header.dimensions, RowJournal::content(file.handle, record)));
    write_labels(opened.id());
    hdf5::change_number(opened.id(), "complete", 1);
    made.places = find_rows(opened.id(), made.layout);
    opened.close();
    write_seal(made.handle, seal_bytes(made.layout.columns().size() + 1), made.places.extents(made.layout),
               format_version_of(made.header.dimensions));
    made.handle.sync();
    rename_over(unready, file.path, file.handle);
    temporary.keep();
    made.path = file.path;
    file = std::move(made);
    impl_->finished = true;
}

} // namespace stylobate
