#include "ensemble/model/input_error.hpp"
#include "io/store/result_file.hpp"
#include "io/store/result_labels.hpp"
#include "io/store/tally_file.hpp"
#include "io/store/tally_store.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace stylobate {

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
        write_seal(made, block, {});
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
    const std::size_t cells = header.frequency_hz.size() * header.pga_m_s2.size();
    if (header.has_rows() || cells == 0 || header.total == 0 || header.block_names.empty() || header.first != 0)
        throw std::invalid_argument("counts are of all realizations of a surface");
    if (std::filesystem::exists(std::filesystem::symlink_status(file)))
        throw InputError(file.string(), 0, "exists already; choose another output");
    auto impl = std::make_unique<Impl>();
    impl->path = file;
    impl->header = header;
    impl->order = RunOrder(header.total);
    impl->counted.done = DoneSet(impl->order);
    impl->counted.tally = Tally(cells, header.limit_states.size(), header.block_names.size());
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
