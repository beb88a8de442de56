#include "studies/results/run_store.hpp"

#include "io/store/result_store.hpp"

#include <stdexcept>

namespace stylobate {

namespace {

class RowStore : public RunStore {
public:
    explicit RowStore(std::unique_ptr<ResultWriter> writer) : writer_(std::move(writer)) {}

    std::optional<State> state(std::uint64_t index) const override { return writer_->state(index); }
    void give_to(Kind& kind) const override
    {
        writer_->for_each_row([&](const ResultRow& row) { kind.add(row); });
    }
    void for_each_row(const std::function<void(const ResultRow&)>& f) const override { writer_->for_each_row(f); }
    void add(const ResultRow& row) override { writer_->add(row); }
    void add(const Trajectory& trajectory) override { writer_->add(trajectory); }
    using RunStore::add;
    void finish(const Kind& kind) override
    {
        const std::optional<SurfaceTable> surface = kind.surface();
        writer_->finish(surface ? &*surface : nullptr, kind.tables());
    }
    void flush() override { writer_->flush(); }

private:
    std::unique_ptr<ResultWriter> writer_;
};

class CountStore : public RunStore {
public:
    explicit CountStore(std::unique_ptr<TallyWriter> writer) : writer_(std::move(writer)) {}

    const DoneSet* counted() const override { return &writer_->done(); }
    void give_to(Kind& kind) const override { kind.add(writer_->tally()); }
    void add(const ResultRow& row) override { writer_->add(tally_entry(row)); }
    void add(const Trajectory&) override { throw std::logic_error("counts keep no trajectories"); }
    void add(const ResultReader& other) override { writer_->add(*other.tally(), *other.counted()); }
    void finish(const Kind& kind) override { writer_->finish(kind.surface().value()); }
    void flush() override { writer_->flush(); }

private:
    std::unique_ptr<TallyWriter> writer_;
};

} // namespace

void RunStore::add(const ResultReader& other)
{
    for (const std::uint64_t index : other.trajectory_indices())
        add(other.trajectory(index));
    other.for_each_row([&](const ResultRow& row) { add(row); });
}

std::unique_ptr<RunStore> open_store(const std::string& file, const ResultHeader& header, bool found)
{
    if (header.has_rows())
        return std::make_unique<RowStore>(found ? ResultWriter::resume(file, header)
                                                : ResultWriter::create(file, header));
    return std::make_unique<CountStore>(found ? TallyWriter::resume(file, header) : TallyWriter::create(file, header));
}

} // namespace stylobate
