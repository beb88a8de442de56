#include "ensemble/model/input_error.hpp"
#include "io/store/result_file.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table_hdf5.hpp"

#include <algorithm>
#include <map>

namespace stylobate {

namespace names = result_names;

struct ResultReader::Impl {
    ResultFile file;
    RowNumbers numbers;
    std::uint64_t rows = 0;
    RowJournal journal;                                       ///< of a file that is not complete, from its beginning
    std::map<std::uint64_t, RowJournal::Record> trajectories; ///< in the same
    std::optional<TallyFile> counted;                         ///< instead of rows

    /// The chunk read last, so that reading row after row is cheap.
    mutable std::uint64_t cached_chunk = 0;
    mutable std::optional<std::vector<std::byte>> cached;

    /// @param number of an unfinished file the offset of the record's content
    ResultRow row(std::uint64_t number) const
    {
        if (!file.complete)
            return file.decode(
                0, RowJournal::content(file.handle, {RowJournal::Kind::row, number, file.layout.row_bytes()}));
        const std::uint64_t chunk = file.layout.chunk_of(number);
        if (!cached || cached_chunk != chunk) {
            cached = file.read_chunk(chunk);
            cached_chunk = chunk;
        }
        if (!cached)
            file.refuse_damaged("row " + std::to_string(number) + " has changed since the file was opened");
        ResultRow row = file.decode(number - file.layout.first_row(chunk), *cached);
        if (!file.header.selected && row.index != file.header.first + number)
            file.refuse_damaged("row " + std::to_string(number) + " is of another realization");
        return row;
    }

    /// Verifies every chunk of a complete file.
    void check_chunks()
    {
        const ResultLayout& layout = file.layout;
        rows = layout.rows();
        for (std::uint64_t chunk = 0; chunk < layout.chunks(); ++chunk)
            if (!file.read_chunk(chunk))
                file.refuse_damaged("the checksum of the rows from " + std::to_string(layout.first_row(chunk)) +
                                    " on is wrong");
        for (std::uint64_t number = 0; file.header.selected && number < rows; ++number)
            add(row(number).index, number);
    }

    /// Finds what there is of one that is not.
    void read_journal()
    {
        journal = file.journal;
        file.read_journal(
            [&](const ResultRow& row, const RowJournal::Record& record) {
                add(row.index, record.offset);
                if (++rows > file.header.total)
                    file.refuse_damaged("it has more rows than it announces");
            },
            [&](const RowJournal::Record& record, std::span<const std::byte> content) {
                try {
                    trajectories[trajectory_of(file.header.dimensions, content).index] = record;
                } catch (const std::invalid_argument& error) {
                    file.refuse_damaged(error.what());
                }
            });
    }

    void add(std::uint64_t index, std::uint64_t number)
    {
        if (!numbers.add(index, number))
            file.refuse_damaged("two of its rows are of one realization");
    }

    /// Runs a part that reads through HDF5; what it finds wrong is damage.
    template <class Function>
    auto guarded(Function function) const
    {
        try {
            return function(file.hdf5.id());
        } catch (const hdf5::Error& error) {
            file.refuse_damaged(error.what());
        } catch (const std::invalid_argument& error) {
            file.refuse_damaged(error.what());
        }
    }
};

ResultReader::ResultReader(const std::filesystem::path& file) : impl_(std::make_unique<Impl>())
{
    impl_->file = open_result(file, false);
    const ResultFile& opened = impl_->file;
    if (!opened.header.has_rows()) {
        impl_->counted = impl_->guarded([&](hid_t id) { return read_tally(id, opened.header); });
        return;
    }
    impl_->numbers = RowNumbers(opened.header, opened.complete);
    if (opened.complete)
        impl_->check_chunks();
    else
        impl_->read_journal();
}

ResultReader::~ResultReader() = default;

const ResultHeader& ResultReader::header() const
{
    return impl_->file.header;
}

bool ResultReader::complete() const
{
    return impl_->file.complete;
}

const Tally* ResultReader::tally() const
{
    return impl_->counted ? &impl_->counted->tally : nullptr;
}

const DoneSet* ResultReader::counted() const
{
    return impl_->counted ? &impl_->counted->done : nullptr;
}

ResultReader::Unread ResultReader::unread() const
{
    if (complete() || !header().has_rows())
        return {};
    const RowJournal::Rest rest = impl_->file.journal.rest(impl_->file.handle, impl_->file.layout.row_bytes());
    return {rest.bytes, rest.damaged};
}

std::uint64_t ResultReader::done() const
{
    return impl_->counted ? impl_->counted->tally.added() : impl_->rows;
}

bool ResultReader::has(std::uint64_t index) const
{
    return header().has_rows() && impl_->numbers.of(index).has_value();
}

ResultRow ResultReader::row(std::uint64_t index) const
{
    const ResultHeader& of = header();
    if (!of.has_rows())
        throw InputError(impl_->file.path.string(), 0,
                         "has no rows of realizations (output.realizations = \"none\"). Replay realization " +
                             std::to_string(index) + " instead.");
    const auto number = impl_->numbers.of(index);
    if (!number && of.selected)
        throw InputError(impl_->file.path.string(), 0,
                         "does not hold realization " + std::to_string(index) +
                             ": an adaptive run computes a variable number in each cell. The index column of 'export "
                             "--to csv' lists them.");
    if (index < of.first || (!of.selected && index - of.first >= of.total))
        throw InputError(impl_->file.path.string(), 0,
                         "has no realization " + std::to_string(index) + "; it has those from " +
                             std::to_string(of.first) + " to " + std::to_string(of.first + of.total - 1));
    if (!number)
        throw InputError(impl_->file.path.string(), 0,
                         "does not hold realization " + std::to_string(index) +
                             " yet: the run was interrupted. Continue it with 'run'.");
    return impl_->row(*number);
}

std::vector<ResultRow> ResultReader::rows() const
{
    std::vector<ResultRow> rows;
    for_each_row([&](const ResultRow& row) { rows.push_back(row); });
    std::sort(rows.begin(), rows.end(), [](const ResultRow& a, const ResultRow& b) { return a.index < b.index; });
    return rows;
}

void ResultReader::for_each_row(const std::function<void(const ResultRow&)>& f) const
{
    if (complete() || !header().has_rows()) {
        for (std::uint64_t number = 0; number < impl_->rows; ++number)
            f(impl_->row(number));
        return;
    }
    std::uint64_t left = impl_->rows; // those that were there when the file was opened
    RowJournal(impl_->journal).read(impl_->file.handle, [&](const RowJournal::Record& record, auto content) {
        if (record.kind == RowJournal::Kind::row && left > 0 && left-- > 0)
            f(impl_->file.decode(0, content));
    });
}

SurfaceTable ResultReader::surface() const
{
    return impl_->guarded([this](hid_t file) {
        SurfaceTable table;
        const std::string group = std::string(names::surface) + "/";
        if (!hdf5::exists(file, names::surface) || !hdf5::exists(file, group + "trials"))
            return table;
        table.axes() = header();
        const hdf5::Dims dims = {table.rows().size(), table.pga_m_s2.size()};
        visit_fields(std::type_identity<SurfaceTable>(), [&](const char* name, auto field, auto) {
            using Number = typename std::remove_cvref_t<decltype(table.*field)>::value_type;
            table.*field = hdf5::read_array<Number>(file, group + name, dims);
        });
        const hdf5::Handle opened = hdf5::open_group(file, names::surface);
        table.interval = hdf5::read_text(opened.id(), "interval");
        if (!hdf5::exists(file, group + "method"))
            return table;
        for (const std::uint8_t method : hdf5::read_bytes(file, group + "method", method_type().id(), dims)) {
            if (method > static_cast<std::uint8_t>(IntervalMethod::surface))
                throw hdf5::Error("'" + group + "method' contains values that no run writes");
            table.method.push_back(static_cast<IntervalMethod>(method));
        }
        table.half_width = hdf5::read_any_number(opened.id(), "half_width");
        table.rounds = hdf5::read_number(opened.id(), "rounds");
        return table;
    });
}

Table ResultReader::table(const std::string& name) const
{
    return impl_->guarded([&](hid_t file) { return read_table(file, name, impl_->file.path.string()); });
}

std::vector<std::uint64_t> ResultReader::trajectory_indices() const
{
    return impl_->guarded([this](hid_t file) {
        std::vector<std::uint64_t> indices;
        for (const auto& [index, record] : impl_->trajectories)
            indices.push_back(index);
        if (!complete() || !hdf5::exists(file, names::trajectories))
            return indices;
        for (const std::string& name : hdf5::names_in(hdf5::open_group(file, names::trajectories).id())) {
            if (name.empty() || name.size() > 19 || name.find_first_not_of("0123456789") != std::string::npos)
                throw hdf5::Error("'" + name + "' is not the index of a trajectory");
            indices.push_back(std::stoull(name));
        }
        std::sort(indices.begin(), indices.end());
        return indices;
    });
}

Trajectory ResultReader::trajectory(std::uint64_t index) const
{
    const auto indices = trajectory_indices();
    if (!std::binary_search(indices.begin(), indices.end(), index))
        throw InputError(impl_->file.path.string(), 0,
                         "has no trajectory of realization " + std::to_string(index) + "; 'replay' computes one");
    if (!complete())
        return trajectory_of(header().dimensions,
                             RowJournal::content(impl_->file.handle, impl_->trajectories.at(index)));
    return impl_->guarded([&](hid_t file) { return read_trajectory(file, header().dimensions, index); });
}

} // namespace stylobate
