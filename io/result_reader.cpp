#include "ensemble/input_error.hpp"
#include "io/result_file.hpp"
#include "io/result_fragility.hpp"
#include "io/result_rare.hpp"
#include "io/result_sensitivity.hpp"
#include "io/result_store.hpp"
#include "io/result_twins.hpp"
#include "io/tally_file.hpp"

#include <algorithm>

namespace stylobate {

namespace names = result_names;

struct ResultReader::Impl {
    ResultFile file;
    std::vector<bool> there; ///< by chunk
    RowNumbers numbers;
    std::optional<TallyFile> counted; ///< instead of rows

    /// The chunk read last, so that reading row after row is cheap.
    mutable std::uint64_t cached_chunk = 0;
    mutable std::optional<std::vector<std::byte>> cached;

    ResultRow row(std::uint64_t number) const
    {
        const std::uint64_t chunk = file.layout.chunk_of(number);
        if (!cached || cached_chunk != chunk) {
            cached = file.read_chunk(chunk);
            cached_chunk = chunk;
        }
        if (!cached)
            file.refuse_damaged("row " + std::to_string(number) + " has changed since the file was opened");
        try {
            return file.layout.decode(number, *cached);
        } catch (const std::invalid_argument& error) {
            file.refuse_damaged(error.what());
        }
    }

    /// Where the rows are selected: which realizations they are of.
    void number_rows()
    {
        for (std::uint64_t number = 0; number < file.layout.rows(); ++number)
            if (there[file.layout.chunk_of(number)] && !numbers.add(row(number).index, number))
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
    for (std::uint64_t chunk = 0; chunk < opened.layout.chunks(); ++chunk) {
        impl_->there.push_back(opened.read_chunk(chunk).has_value());
        if (opened.complete && !impl_->there.back())
            opened.refuse_damaged("the checksum of the rows from " + std::to_string(opened.layout.first_row(chunk)) +
                                  " on is wrong");
    }
    impl_->numbers = RowNumbers(opened.header);
    if (opened.header.selected)
        impl_->number_rows();
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

std::uint64_t ResultReader::done() const
{
    if (impl_->counted)
        return impl_->counted->tally.added();
    std::uint64_t done = 0;
    const ResultLayout& layout = impl_->file.layout;
    for (std::uint64_t chunk = 0; chunk < impl_->there.size(); ++chunk)
        done += impl_->there[chunk] ? layout.rows_in(chunk) : 0;
    return done;
}

bool ResultReader::has(std::uint64_t index) const
{
    const auto number = impl_->numbers.of(index);
    return number && impl_->there[impl_->file.layout.chunk_of(*number)];
}

ResultRow ResultReader::row(std::uint64_t index) const
{
    const auto number = impl_->numbers.of(index);
    const ResultHeader& of = header();
    if (!of.has_rows())
        throw InputError(impl_->file.path.string(), 0,
                         "keeps no rows of its realizations (output.realizations = \"none\"). Replay realization " +
                             std::to_string(index) + " instead.");
    if (!number && of.selected)
        throw InputError(impl_->file.path.string(), 0,
                         "does not hold realization " + std::to_string(index) +
                             ": an adaptive run takes of each cell as many as it needs. The index column of "
                             "'export --to csv' says which there are.");
    if (!number)
        throw InputError(impl_->file.path.string(), 0,
                         "has no realization " + std::to_string(index) + "; it has those from " +
                             std::to_string(of.first) + " to " + std::to_string(of.first + of.total - 1));
    if (!has(index))
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
    const ResultLayout& layout = impl_->file.layout;
    for (std::uint64_t number = 0; number < layout.rows(); ++number)
        if (impl_->there[layout.chunk_of(number)])
            f(impl_->row(number));
}

SurfaceTable ResultReader::surface() const
{
    return impl_->guarded([this](hid_t file) {
        SurfaceTable table;
        const std::string group = std::string(names::surface) + "/";
        if (!hdf5::exists(file, names::surface) || !hdf5::exists(file, group + "trials"))
            return table;
        table.frequency_hz = header().frequency_hz;
        table.pga_m_s2 = header().pga_m_s2;
        const hdf5::Dims dims = {table.frequency_hz.size(), table.pga_m_s2.size()};
        table.trials = hdf5::read_counts(file, group + "trials", dims);
        table.collapses = hdf5::read_counts(file, group + "collapses", dims);
        table.probability = hdf5::read_doubles(file, group + "probability", dims);
        table.lower = hdf5::read_doubles(file, group + "lower", dims);
        table.upper = hdf5::read_doubles(file, group + "upper", dims);
        const hdf5::Handle opened = hdf5::open_group(file, names::surface);
        table.interval = hdf5::read_text(opened.id(), "interval");
        if (!hdf5::exists(file, group + "method"))
            return table;
        for (const std::uint8_t method : hdf5::read_bytes(file, group + "method", method_type().id(), dims)) {
            if (method > static_cast<std::uint8_t>(IntervalMethod::surface))
                throw hdf5::Error("'" + group + "method' holds what no run writes");
            table.method.push_back(static_cast<IntervalMethod>(method));
        }
        table.half_width = hdf5::read_any_number(opened.id(), "half_width");
        table.rounds = hdf5::read_number(opened.id(), "rounds");
        return table;
    });
}

SensitivityTable ResultReader::sensitivity() const
{
    return impl_->guarded([](hid_t file) { return read_sensitivity_table(file); });
}

RareTable ResultReader::rare() const
{
    return impl_->guarded([](hid_t file) { return read_rare_table(file); });
}

FragilityTable ResultReader::fragility() const
{
    return impl_->guarded([](hid_t file) { return read_fragility_table(file); });
}

std::vector<FollowedTwin> ResultReader::twins() const
{
    return impl_->guarded([](hid_t file) { return read_twins_group(file); });
}

std::vector<std::uint64_t> ResultReader::trajectory_indices() const
{
    return impl_->guarded([](hid_t file) {
        std::vector<std::uint64_t> indices;
        if (!hdf5::exists(file, names::trajectories))
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
                         "has no trajectory of realization " + std::to_string(index) + "; 'replay' makes one");
    return impl_->guarded([index](hid_t file) {
        const std::string group = std::string(names::trajectories) + "/" + std::to_string(index) + "/";
        Trajectory trajectory;
        trajectory.index = index;
        const hdf5::Dims both = hdf5::dims_of(file, group + "x_m");
        if (both.size() != 2)
            throw hdf5::Error("'" + group + "x_m' is not a matrix");
        trajectory.time_s = hdf5::read_doubles(file, group + "time_s", {both[0]});
        trajectory.x_m = hdf5::read_doubles(file, group + "x_m", both);
        trajectory.y_m = hdf5::read_doubles(file, group + "y_m", both);
        trajectory.theta_rad = hdf5::read_doubles(file, group + "theta_rad", both);
        trajectory.base_x_m = hdf5::read_doubles(file, group + "base_x_m", {both[0]});
        trajectory.rest_x_m = hdf5::read_doubles(file, group + "rest_x_m", {both[1]});
        trajectory.rest_y_m = hdf5::read_doubles(file, group + "rest_y_m", {both[1]});
        trajectory.half_width_m = hdf5::read_doubles(file, group + "half_width_m", {both[1]});
        trajectory.half_height_m = hdf5::read_doubles(file, group + "half_height_m", {both[1]});
        for (const std::uint8_t role : hdf5::read_bytes(file, group + "role", role_type().id(), {both[1]})) {
            if (role > static_cast<std::uint8_t>(BlockRole::ground))
                throw hdf5::Error("'" + group + "role' holds what no run writes");
            trajectory.role.push_back(static_cast<BlockRole>(role));
        }
        trajectory.column = hdf5::read_integers(file, group + "column", {both[1]});
        const hdf5::Handle opened = hdf5::open_group(file, group);
        trajectory.name = split_names(hdf5::read_text(opened.id(), names::blocks));
        if (trajectory.name.size() != both[1])
            throw hdf5::Error("'" + group + "' has not a name for each block");
        return trajectory;
    });
}

} // namespace stylobate
