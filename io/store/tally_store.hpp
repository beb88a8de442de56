#pragma once
/// A results file without rows: what a study's tables need, cell by cell, however many realizations there are.
/// `io/FORMAT.md` describes it; `ResultReader` reads it.

#include "ensemble/numerics/run_order.hpp"
#include "io/store/result_store.hpp"

namespace stylobate {

/// A results file of counts that is being written. Realizations may come in any order. Every second or so, and in
/// `flush`, the whole file is written anew under another name and takes the old one's place in one step: a process that
/// is killed at any moment leaves a file that `resume` continues, in which no realization is counted twice.
///
/// The list of what is done grows with the number of realizations that are stepped at the same time, if they are begun
/// in the order of `RunOrder`; nothing grows with their number.
class TallyWriter {
public:
    /// Creates the file, as `ResultWriter::create` does. @pre header.limit_states is not empty, and the header has axes
    /// @throws InputError as that one does
    static std::unique_ptr<TallyWriter> create(const std::filesystem::path& file, const ResultHeader& header);
    /// Opens an unfinished file of the same study. @throws InputError as `ResultWriter::resume` does
    static std::unique_ptr<TallyWriter> resume(const std::filesystem::path& file, const ResultHeader& header);

    ~TallyWriter();
    TallyWriter(const TallyWriter&) = delete;
    TallyWriter& operator=(const TallyWriter&) = delete;

    /// True for realizations that are counted.
    bool has(std::uint64_t index) const;
    /// What is counted, by its place in the order of the run.
    const DoneSet& done() const;
    /// What is counted.
    const Tally& tally() const;

    /// Takes one realization; not thread-safe. One that is there already changes nothing.
    /// @throws std::invalid_argument if it does not fit; std::system_error or std::runtime_error if the file cannot be
    ///         written; it stays then as it was written last
    void add(const TallyEntry& entry);
    /// Takes the counts of another file of the study.
    /// @throws std::invalid_argument if they do not fit, or if a realization is counted in both; else as the other one
    void add(const Tally& tally, const DoneSet& done);
    /// Writes what is counted.
    void flush();
    /// Writes the surface and marks the file complete, in one step. All realizations must have been added.
    void finish(const SurfaceTable& surface);

private:
    struct Impl;
    explicit TallyWriter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace stylobate
