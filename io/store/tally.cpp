#include "io/store/tally.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/store/result_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

namespace stylobate {

Tally::Tally(std::size_t number_of_cells, std::size_t number_of_limit_states, std::size_t number_of_blocks)
    : limit_states(number_of_limit_states), blocks(number_of_blocks)
{
    visit_fields(std::type_identity<Tally>(),
                 [&](auto, auto field, auto by, auto) { (this->*field).resize(number_of_cells * width(by)); });
}

std::uint64_t Tally::all_trials() const
{
    return std::accumulate(trials.begin(), trials.end(), std::uint64_t{0});
}

std::uint64_t Tally::all_invalid() const
{
    return std::accumulate(invalid.begin(), invalid.end(), std::uint64_t{0});
}

std::uint64_t Tally::all_reached(std::size_t limit) const
{
    std::uint64_t all = 0;
    for (std::size_t cell = 0; cell < cells(); ++cell)
        all += reached[cell * limit_states + limit];
    return all;
}

void Tally::add(const TallyEntry& entry)
{
    if (entry.cell >= cells() || (entry.first_block >= 0 && static_cast<std::size_t>(entry.first_block) >= blocks))
        throw std::invalid_argument("realization " + std::to_string(entry.index) + " does not fit into the counts");
    if (entry.invalid != InvalidReason::none) {
        ++invalid[entry.cell];
        first_invalid.emplace(entry.index, entry.invalid);
        if (first_invalid.size() > most_invalid)
            first_invalid.erase(std::prev(first_invalid.end()));
        return;
    }
    ++trials[entry.cell];
    for (std::size_t limit = 0; limit < limit_states; ++limit)
        reached[entry.cell * limit_states + limit] += (entry.reached >> limit) & 1;
    if (entry.first_block >= 0)
        ++first[entry.cell * blocks + static_cast<std::size_t>(entry.first_block)];
    first_together[entry.cell] += entry.first_block == several_blocks;
    if (entry.collapse_time_s >= 0)
        collapse_time_s.add(entry.collapse_time_s);
    if (entry.total_collapse_time_s >= 0)
        total_collapse_time_s.add(entry.total_collapse_time_s);
    keep_worst(entry.energy_residual, entry.index);
}

void Tally::add(const Tally& other)
{
    if (other.cells() != cells() || other.limit_states != limit_states || other.blocks != blocks)
        throw std::invalid_argument("the counts are of another shape");
    visit_fields(std::type_identity<Tally>(), [&](auto, auto field, auto, auto) {
        std::ranges::transform(this->*field, other.*field, (this->*field).begin(), std::plus());
    });
    collapse_time_s.add(other.collapse_time_s);
    total_collapse_time_s.add(other.total_collapse_time_s);
    first_invalid.insert(other.first_invalid.begin(), other.first_invalid.end());
    while (first_invalid.size() > most_invalid)
        first_invalid.erase(std::prev(first_invalid.end()));
    if (other.energy_realization != no_realization)
        keep_worst(other.energy_residual, other.energy_realization);
}

void Tally::keep_worst(double residual, std::uint64_t realization)
{
    const double size = std::abs(residual), most = std::abs(energy_residual);
    if (size > most || (size == most && realization < energy_realization)) {
        energy_residual = residual;
        energy_realization = realization;
    }
}

namespace {

namespace names = result_names;

std::string in_tally(const std::string& name)
{
    return std::string(names::tally) + "/" + name;
}

/// Shape of counts. @param by as in `visit_fields`
hdf5::Dims dims_of(const ResultHeader& header, const Tally& tally, std::string_view by)
{
    hdf5::Dims dims = {header.rows().size(), header.pga_m_s2.size()};
    if (!by.empty())
        dims.push_back(tally.width(by));
    return dims;
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

    // the axes of /surface once more: the scale of a dimension lies in the same group
    hdf5::write_array(file, in_tally(header.row_quantity().key), header.rows(), {header.rows().size()},
                      header.row_quantity().unit);
    hdf5::write_array(file, in_tally("pga_m_s2"), header.pga_m_s2, {header.pga_m_s2.size()}, "m/s2");
    visit_fields(std::type_identity<Tally>(), [&](const char* name, auto field, std::string_view by, auto) {
        hdf5::write_array(file, in_tally(name), tally.*field, dims_of(header, tally, by), "");
    });
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
    TallyFile counted;
    Tally& tally = counted.tally;
    tally.limit_states = header.limit_states.size();
    tally.blocks = header.block_names.size();
    const hdf5::Handle group = hdf5::open_group(file, names::tally);
    tally.energy_residual = hdf5::read_any_number(group.id(), "energy_residual");
    tally.energy_realization = hdf5::read_number(group.id(), "energy_realization");
    visit_fields(std::type_identity<Tally>(), [&](const char* name, auto field, std::string_view by, auto) {
        tally.*field = hdf5::read_counts(file, in_tally(name), dims_of(header, tally, by));
    });
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

namespace {

using Clock = std::chrono::steady_clock;

/// What is lost of a run that is killed is what it does in this time, or in `patience` times as long as the file takes
/// to be written (writing it takes no hundredth of the run), but no more than in `longest`.
constexpr std::chrono::seconds between_writings{1}, longest{5};
constexpr int patience = 100;

} // namespace

struct TallyWriter::Impl {
    std::filesystem::path path;
    ResultHeader header;
    FileHandle handle; ///< holds the lock
    TallyFile counted;
    RunOrder order{0};
    Clock::time_point due = Clock::now() + between_writings;
    bool finished = false;

    /// The whole file under another name, which then gets its own.
    /// @param fresh no file of that name may be there
    /// @param surface of a complete file, else null
    void write(const SurfaceTable* surface, bool fresh)
    {
        const Clock::time_point start = Clock::now();
        const std::filesystem::path unready = beside(path, ".writing");
        FileHandle made = FileHandle::claim(unready);
        Temporary temporary(unready);
        const std::uint64_t block = seal_bytes(0);
        hdf5::Handle file = hdf5::create_file(unready, block);
        write_header(file.id(), header, surface != nullptr);
        write_tally(file.id(), header, counted);
        if (surface)
            write_surface(file.id(), *surface);
        write_labels(file.id());
        file.close();
        write_seal(made, block, {}, format_version_of(header.dimensions));
        made.sync();
        if (fresh)
            rename_new(unready, path);
        else
            rename_over(unready, path, handle);
        temporary.keep();
        handle = std::move(made);
        const Clock::time_point end = Clock::now();
        due = end + std::clamp<Clock::duration>(patience * (end - start), between_writings, longest);
    }

    void rewrite(const SurfaceTable* surface)
    {
        try {
            write(surface, false);
        } catch (const hdf5::Error& error) {
            throw std::runtime_error(path.string() + ": cannot be written: " + error.what() +
                                     "; it stays in its last written state");
        }
    }

    void check_open() const
    {
        if (finished)
            throw std::logic_error("the results file is finished: nothing can be added");
    }
};

TallyWriter::TallyWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TallyWriter::~TallyWriter() = default;

std::unique_ptr<TallyWriter> TallyWriter::create(const std::filesystem::path& file, const ResultHeader& header)
{
    if (header.has_rows() || header.cells() == 0 || header.total == 0 || header.block_names.empty() ||
        header.first != 0)
        throw std::invalid_argument("counts are of all realizations of a surface");
    if (std::filesystem::exists(std::filesystem::symlink_status(file)))
        throw InputError(file.string(), 0, "exists already; choose another output");
    auto impl = std::make_unique<Impl>();
    impl->path = file;
    impl->header = header;
    impl->order = RunOrder(header.total);
    impl->counted.done = DoneSet(impl->order);
    impl->counted.tally = Tally(header.cells(), header.limit_states.size(), header.block_names.size());
    try {
        impl->write(nullptr, true);
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    } catch (const std::system_error& error) {
        throw InputError(file.string(), 0, "cannot be written: " + error.code().message());
    }
    return std::unique_ptr<TallyWriter>(new TallyWriter(std::move(impl)));
}

std::unique_ptr<TallyWriter> TallyWriter::resume(const std::filesystem::path& file, const ResultHeader& header)
{
    // behind a symbolic link the file itself is replaced
    std::error_code ignored;
    const auto real = std::filesystem::canonical(file, ignored);
    ResultFile opened = open_result(real.empty() ? file : real, true);
    check_unfinished(opened, header);
    auto impl = std::make_unique<Impl>();
    try {
        impl->counted = read_tally(opened.hdf5.id(), opened.header);
    } catch (const hdf5::Error& error) {
        opened.refuse_damaged(error.what());
    }
    opened.hdf5.reset();
    impl->path = opened.path;
    impl->header = opened.header;
    impl->order = RunOrder(opened.header.total);
    impl->handle = std::move(opened.handle);
    return std::unique_ptr<TallyWriter>(new TallyWriter(std::move(impl)));
}

bool TallyWriter::has(std::uint64_t index) const
{
    return impl_->counted.done.has(impl_->order.place(index));
}

const DoneSet& TallyWriter::done() const
{
    return impl_->counted.done;
}

const Tally& TallyWriter::tally() const
{
    return impl_->counted.tally;
}

void TallyWriter::add(const TallyEntry& entry)
{
    impl_->check_open();
    const Tally& tally = impl_->counted.tally;
    if (entry.index >= impl_->header.total || entry.cell >= tally.cells() ||
        (entry.first_block >= 0 && static_cast<std::size_t>(entry.first_block) >= tally.blocks))
        throw std::invalid_argument("realization " + std::to_string(entry.index) +
                                    " does not fit into the results file");
    if (has(entry.index))
        return;
    impl_->counted.tally.add(entry);
    const bool invalid = entry.invalid != InvalidReason::none;
    impl_->counted.done.add(impl_->order.place(entry.index), !invalid && (entry.reached & 1) != 0, invalid);
    if (Clock::now() >= impl_->due)
        impl_->rewrite(nullptr);
}

void TallyWriter::add(const Tally& tally, const DoneSet& done)
{
    impl_->check_open();
    if (const std::optional<std::uint64_t> place = impl_->counted.done.common(done))
        throw std::invalid_argument("realization " + std::to_string(impl_->order.index(*place)) +
                                    " is counted already");
    impl_->counted.tally.add(tally);
    impl_->counted.done.add(done);
    if (Clock::now() >= impl_->due)
        impl_->rewrite(nullptr);
}

void TallyWriter::flush()
{
    impl_->check_open();
    impl_->rewrite(nullptr);
}

void TallyWriter::finish(const SurfaceTable& surface)
{
    impl_->check_open();
    const std::uint64_t added = impl_->counted.tally.added();
    if (added != impl_->header.total)
        throw std::logic_error("only " + std::to_string(added) + " of " + std::to_string(impl_->header.total) +
                               " realizations have been added");
    check_table(impl_->header, surface);
    impl_->rewrite(&surface);
    impl_->finished = true;
}

} // namespace stylobate
