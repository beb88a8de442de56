#pragma once
/// The result store (HDF5): rows of outcomes in index order, written in chunks, resumable. `io/FORMAT.md` describes it.

#include "ensemble/model/outcome.hpp"
#include "ensemble/model/surface_axes.hpp"
#include "ensemble/model/trajectory.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "io/store/tally.hpp"
#include "io/tables/table.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The motions of a fragility study, and how strong each is as it stands.
struct MotionTable {
    std::vector<std::string> names;    ///< (motions)
    std::vector<std::string> measures; ///< "pga_m_s2"
    std::vector<double> exponent;      ///< (measures) s times as strong a motion has s^exponent of it; 0: unchanged
    std::vector<double> value;         ///< (motions x measures)
    std::vector<double> shaking_end_s; ///< (motions x shakings) of sequences: when each shaking is over; else empty
    friend bool operator==(const MotionTable&, const MotionTable&) = default;
};

/// What is fixed when a store is created. Kinds without a surface have empty axes.
struct ResultHeader : SurfaceAxes {
    std::string kind; ///< the study's; "replay" for one realization of any
    std::string study_toml;
    std::uint64_t seed = 0;
    std::string code_version;
    std::optional<std::string> build; ///< compiler, processor, type and flags of the program; nullopt: not known
    std::optional<std::uint32_t> study_crc32; ///< of `study_toml`, as the file states it; the writer computes it anew
    int dimensions = 2;                       ///< of the structure: 2 in the plane, 3 in space
    std::uint64_t first = 0;                  ///< index of the first row: 0 but for a replay
    std::uint64_t total = 0;                  ///< rows
    bool selected =
        false; ///< the rows are some of the study's realizations, each row has its index: an adaptive surface, rare
               ///< events. `total` is how many they can become at most, in a finished file how many they are
    std::vector<std::string> input_names;  ///< columns of input/, see `Realization::inputs`; "friction[3]" goes into
                                           ///< column 3 of the two-dimensional dataset input/friction
    std::vector<std::string> block_names;  ///< of the blocks but the ground, in layout order; as many values has
                                           ///< `Outcome::fall_time_s` of every row
    std::vector<std::string> bed_names;    ///< of a survival study, whose rows hold the final state too; else empty
    MotionTable motions;                   ///< of a fragility study, else empty
    std::vector<std::string> warnings;     ///< what is doubtful about the study, a sentence or several in each
    std::vector<std::string> limit_states; ///< that are counted where no rows are kept (`TallyWriter`), else empty
    Shard shard;                           ///< the part that an unfinished file is meant for; of a complete one all
    /// Whether there is a row of each realization.
    bool has_rows() const { return limit_states.empty(); }
};

/// CRC-32 of the text of the study: `ResultHeader::study_crc32` of a file whose text is the one that was written.
std::uint32_t study_crc32_of(const ResultHeader& header);

/// Difference between the study of a file and the requested study, in words; nullopt if there is none.
/// @param complete whether the file is: where rows are selected, it then has those that were needed
std::optional<std::string> study_difference(const ResultHeader& found, bool complete, const ResultHeader& asked);

/// One row of /realizations.
struct ResultRow {
    std::uint64_t index = 0;
    std::uint64_t cell = 0;
    double frequency_hz = 0;
    double pga_m_s2 = 0;
    std::vector<double> inputs; ///< as in `ResultHeader::input_names`
    Outcome outcome;
};

/// Its own numbers, without the outcome's.
template <class F>
void visit_fields(std::type_identity<ResultRow>, F&& f)
{
    f("index", &ResultRow::index, FieldFacts{.says = "index of the realization"});
    f("cell", &ResultRow::cell, FieldFacts{.says = "cell of the surface, or motion x stripes + stripe"});
    f("frequency_hz", &ResultRow::frequency_hz, FieldFacts{.says = "frequency of the shaking"});
    f("pga_m_s2", &ResultRow::pga_m_s2, FieldFacts{.says = "peak ground acceleration"});
}

/// Whether all numbers of two rows have the same bits (NaN equals itself, 0 differs from -0).
bool same_bits(const ResultRow& a, const ResultRow& b);

/// A table over the cells of a surface, each array (nf x np), row by row. /surface holds that of the collapse.
struct SurfaceTable : SurfaceAxes {
    std::vector<std::uint64_t> trials;    ///< valid realizations
    std::vector<std::uint64_t> collapses; ///< those that reached the limit state of the table
    std::vector<double> probability;      ///< NaN where there is no trial; by method `surface` a posterior mean
    std::vector<double> lower;
    std::vector<double> upper;
    std::string interval;               ///< name of the interval and its level, for example "wilson 0.95"
    std::vector<IntervalMethod> method; ///< of each cell of an adaptive surface, else empty
    double half_width = 0;              ///< that was asked for, of an adaptive surface
    std::uint64_t rounds = 0;           ///< that it took
};

/// The values of each cell.
template <class F>
void visit_fields(std::type_identity<SurfaceTable>, F&& f)
{
    f("trials", &SurfaceTable::trials, FieldFacts{.says = "valid realizations"});
    f("collapses", &SurfaceTable::collapses, FieldFacts{.says = "collapsed realizations"});
    f("probability", &SurfaceTable::probability, FieldFacts{.says = "probability of collapse"});
    f("lower", &SurfaceTable::lower, FieldFacts{.says = "lower end of the interval of the probability of collapse"});
    f("upper", &SurfaceTable::upper, FieldFacts{.says = "upper end of the interval of the probability of collapse"});
}

/// Whether each cell has all its values.
bool has_all_cells(const SurfaceTable& surface);

/// A results file that is being written. Rows may come in any order; each is written, with its checksum, as it comes,
/// behind the rest of the file. A process that is killed at any moment leaves a file that `resume` continues with every
/// row that was added; a machine that stops, with all but those of the last seconds.
class ResultWriter {
public:
    static constexpr std::uint64_t rows_per_chunk = 256; ///< with one checksum, in a complete file

    /// Creates the file (under another name first, so that no half-made file is ever seen).
    /// @throws InputError if the folder is missing or cannot be written, or if the file exists already
    static std::unique_ptr<ResultWriter> create(const std::filesystem::path& file, const ResultHeader& header);

    /// Whether there is nothing left to do: the file is complete.
    /// @throws InputError if it is another study's, another version's, damaged, or no such file
    static bool is_finished(const std::filesystem::path& file, const ResultHeader& header);

    /// Opens an unfinished file of the same study.
    /// @throws InputError if it is another study's, complete already, another version's, damaged, or no such file;
    ///         nothing is changed then
    static std::unique_ptr<ResultWriter> resume(const std::filesystem::path& file, const ResultHeader& header);

    ~ResultWriter();
    ResultWriter(const ResultWriter&) = delete;
    ResultWriter& operator=(const ResultWriter&) = delete;

    /// True for rows that are in the file already.
    bool has(std::uint64_t index) const;
    /// How a realization ended whose row is in the file already.
    std::optional<State> state(std::uint64_t index) const;
    /// Rows in the file already.
    std::uint64_t rows() const;
    /// These rows, in index order.
    void for_each_row(const std::function<void(const ResultRow&)>& f) const;

    /// Takes one row; not thread-safe. A row that is there already changes nothing.
    /// @throws std::system_error if it cannot be written (full disk); what is written already stays
    void add(const ResultRow& row);
    /// Takes a trajectory; of several of one index the last. Added before its row it is there where the row is.
    void add(const Trajectory& trajectory);
    /// Writes a file of all rows in index order, the surface, the tables and the trajectories, which takes the place of
    /// this one, in one step: killed meanwhile, the file stays as it was. All rows must have been added; where they are
    /// selected, those that were added are all. Needs the disk space of the file once more.
    /// @param surface null where the study has none
    void finish(const SurfaceTable* surface, const std::vector<Table>& tables = {});
    /// Makes what was written so far safe against the end of the machine; that of the process cannot hurt them.
    void flush();

private:
    struct Impl;
    explicit ResultWriter(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// A results file without rows that is being written: what a study's tables need, cell by cell, however many
/// realizations there are. Realizations may come in any order. Every second or so, and in `flush`, the whole file is
/// written anew under another name and takes the old one's place in one step: a process that is killed at any moment
/// leaves a file that `resume` continues, in which no realization is counted twice.
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

/// A results file that is read, with rows or without, complete or not. Opening verifies every checksum.
class ResultReader {
public:
    /// @throws InputError if there is no such file, if it is no result of stylobate, or if it is damaged
    explicit ResultReader(const std::filesystem::path& file);
    ~ResultReader();
    ResultReader(const ResultReader&) = delete;
    ResultReader& operator=(const ResultReader&) = delete;

    const ResultHeader& header() const;
    bool complete() const;
    /// True for a realization whose row is there.
    bool has(std::uint64_t index) const;
    /// @throws InputError if the row is not in the file
    ResultRow row(std::uint64_t index) const;
    /// All rows that are there, in index order.
    std::vector<ResultRow> rows() const;
    /// Gives all rows one by one, in the order of the file, which is that in which they came if it is not complete: for
    /// what must not grow with their number.
    void for_each_row(const std::function<void(const ResultRow&)>& f) const;
    /// Of an unfinished file with rows: the bytes behind its last whole record, and whether they are more than what a
    /// process leaves that is killed while it writes. They are not read.
    struct Unread {
        std::uint64_t bytes = 0;
        bool damaged = false;
    };
    Unread unread() const;
    /// Realizations that are done: rows that are there, or that have been counted.
    std::uint64_t done() const;
    /// What was counted where there are no rows, else null.
    const Tally* tally() const;
    /// Which realizations were, by their places in the order of the run; null where there are rows.
    const DoneSet* counted() const;
    /// Empty axes if there is none.
    SurfaceTable surface() const;
    /// A table that `ResultWriter::finish` was given; an empty one if there is none of this name.
    Table table(const std::string& name) const;
    std::vector<std::uint64_t> trajectory_indices() const;
    /// @throws InputError if there is none of this index
    Trajectory trajectory(std::uint64_t index) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace stylobate
