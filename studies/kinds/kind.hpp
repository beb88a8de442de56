#pragma once
/// The contract of a kind of study: which studies it fits, the realizations that it requests, the evaluation of their
/// rows, and how it is reported as text, JSON, tables, pictures and sections of a page. A kind is a folder here and a
/// line in `studies/results/kinds.cpp`; `run`, `replay`, `export` and `report` know no kind by name.
///
///   run:       add(rows of an earlier part) -> plan(rounds), which adds the rest -> conclude() -> surface(), tables()
///   afterwards: add(all rows of the file) -> restore(file)
///   then both: text(), add_to(json), sections(page), picture(...), files(...)

#include "io/store/result_store.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/rounds.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

struct LawBand;

/// A picture of a kind, and its options on the command line.
struct PictureKind {
    std::string_view name; ///< "surface": the word of the command line
    std::string_view of;   ///< results that have it: "a fragility study"
    bool limit = false;    ///< of one limit state
    bool slices = false;   ///< of some rows of a surface
};
struct PictureRequest {
    std::string_view name;              ///< of a picture of the kind
    std::optional<std::string> limit;   ///< nullopt: the usual one
    std::vector<double> rows;           ///< of a slice, frequencies or directions; none: three of the axis
    std::optional<std::string> rows_by; ///< the option that gives them; nullopt: none does
    const LawBand* laws = nullptr;      ///< over contact laws; null: not measured
};
struct Picture {
    std::string name;    ///< of its file, without an ending: "slice_2Hz_slid"
    std::string title;   ///< "Probability of collapse"
    std::string partial; ///< what the title adds of a run that is not complete
    std::function<void(const std::string& title, const std::filesystem::path& file)> draw;
};

/// Which cells are asked for, by where they lie.
struct CellChoice {
    std::optional<double> frequency_hz, direction_deg, pga_m_s2;
    std::optional<std::string> motion;
    std::optional<double> intensity;
};
struct ChosenCells {
    std::function<bool(std::uint64_t cell)> has = [](std::uint64_t) { return true; };
    std::optional<std::string> words; ///< "at 3.02 Hz, 9.8 m/s2"; nullopt: all cells
};

/// The value of an axis that is nearest on the axis' scale.
/// @param option "--pga"   @param results for the message
/// @throws InputError if the value lies outside the axis by more than the digits that people leave out
std::size_t nearest_on_axis(const std::vector<double>& axis, double wanted, const char* option, const std::string& unit,
                            const std::string& results);

/// @throws InputError if the run is not complete
void check_complete(const ResultReader& reader, const std::string& results);

/// What a page opens with.
struct Answer {
    std::string sentence; ///< with its interval: "At PGV 1.2 to 1.9 m/s half of the structures fall (95 % interval)."
    std::string more;     ///< best estimate, and what it is of
};

class Kind {
public:
    /// @param study, header must outlive it
    Kind(const Study& study, const ResultHeader& header);
    virtual ~Kind() = default;
    Kind(const Kind&) = delete;
    Kind& operator=(const Kind&) = delete;

    static constexpr std::span<const PictureKind> own_pictures = {};

    // ---- before a run ----------------------------------------------------------------------------------------------

    /// Realizations 0 .. n - 1 are drawn once before anything is written, so that a study that cannot be run is
    /// refused.
    virtual std::uint64_t drawn_first() const { return study_.total(); }
    /// Why the study cannot be run in parts, each without the others; nullopt: it can.
    virtual std::optional<std::string> why_no_shards() const { return std::nullopt; }
    /// Why the realizations cannot be shared out to several processes while they run; nullopt: they can.
    virtual std::optional<std::string> why_no_ranks() const { return std::nullopt; }
    /// How many realizations a shard has.
    virtual std::uint64_t size_of(const Shard& shard) const
    {
        return static_cast<std::uint64_t>(study_.events()) * RunOrder(study_.originals()).places(shard).size();
    }
    /// What keeps the study from being stepped on a device: "has [twins], ..."; nullopt: nothing does.
    virtual std::optional<std::string> needs_processor() const { return std::nullopt; }
    /// Looks at the study before its run. @param file of the study, for messages
    /// @returns what the user should know, or nothing   @throws InputError if it cannot be run so
    virtual std::optional<std::string> prepare(const Experiment&, const std::string& file);
    /// How many trajectories the results file keeps, after `prepare`.
    virtual std::uint64_t trajectories() const { return 0; }
    /// Memory of each realization [bytes]: what the store and the kind keep of it until the end (`RowNumbers`, `take`),
    /// with the spare room of arrays that grow, and copies at the end. Measured on runs of two sizes each
    /// (docs/check.md). @param outcome that of an outcome with its lists
    virtual double row_memory([[maybe_unused]] double outcome) const { return header_.selected ? 150 : 12; }
    /// What the results file has beside its rows and its surface [bytes], measured likewise.
    virtual double table_bytes() const { return 0; }
    /// Whether `prepare` plans what the results file keeps and nothing else; a run in memory does without it.
    virtual bool prepares_file_alone() const { return false; }

    // ---- the run ---------------------------------------------------------------------------------------------------

    /// Takes a row, in any order.
    void add(const ResultRow& row);
    /// Takes the counts of a study that keeps no rows.
    void add(const Tally& tally);
    /// Asks for realizations until nothing is left to run.
    /// @returns false if the user has asked to stop
    virtual bool plan(Rounds& rounds) { return rounds.run({.fair = true}); }
    /// Computes the results; all realizations have been run.
    virtual void conclude() {}
    /// Computes the results of a file that is complete and whose rows have been added.
    virtual void restore(const ResultReader&) { conclude(); }
    /// Of the finished study: the share of collapses in the whole of it.
    virtual void share(Progress& progress) const;

    // ---- the results, after conclude() or restore() ----------------------------------------------------------------

    /// Of a study with cells of frequency, or direction, and PGA.
    virtual std::optional<SurfaceTable> surface() const { return std::nullopt; }
    /// What the results file keeps beside the rows.
    virtual std::vector<Table> tables() const { return {}; }
    /// Lines for a terminal.
    virtual std::string text() const;
    virtual void add_to(Json&) const {}

    // ---- of results, complete or not -------------------------------------------------------------------------------

    /// Whether a realization is a trial, and not a copy of one.
    virtual bool is_trial(std::uint64_t index) const { return index < study_.originals(); }
    /// Whether shares over all its realizations are meaningful, that is whether they are drawn from the study's
    /// distribution.
    virtual bool draws_plainly() const { return true; }
    /// Why none of its realizations can be run again by itself; nullopt: each can.
    virtual std::optional<std::string> why_no_replay() const { return std::nullopt; }
    /// Counts over all trials. @param complete whether these are all of the study
    Json limits_json() const;
    const LimitCounts& counts() const { return counts_; }
    const ResultHeader& header() const { return header_; }
    /// @throws InputError if there are no such cells. @param results for messages
    virtual ChosenCells choose(const CellChoice& choice, const std::string& results) const;
    /// How cells are chosen on the command line: "--frequency and --pga"; nullopt: it has no cells.
    virtual std::optional<std::string> chosen_by() const { return std::nullopt; }

    // ---- tables, pictures and pages of results ---------------------------------------------------------------------

    /// The first one is the usual one; none: its realizations over time are.
    virtual std::span<const PictureKind> pictures() const { return {}; }
    /// @param results for messages
    /// @throws InputError if it cannot be drawn of these results. @pre it is one of `pictures`
    virtual Picture picture(const ResultReader&, const std::string& results, const PictureRequest&) const;
    /// Whether the picture shows what `conclude` computes, and so wants a complete run.
    virtual bool pictures_want_all(std::string_view) const { return true; }
    /// Columns of the table of realizations, a value for each of these rows.
    virtual Table columns(const std::vector<ResultRow>&) const { return Table("realizations"); }
    /// Files of an export besides the tables of all results, and their texts.
    /// @param format "csv", "nrml", "json"   @param name of the study, for descriptions
    /// @throws InputError if there are none of this format
    virtual std::vector<std::pair<std::string, std::string>> files(const std::string& format,
                                                                   const std::string& name) const;
    /// Opens the page with its own summary. @returns whether it does
    virtual bool summary(PageWriter&) const { return false; }
    /// Puts the map of its cells on the first screen of the page. @pre `surface` has one
    virtual void map(PageWriter&) const {}
    virtual void sections(PageWriter&) const {}
    /// Whether the page shows the first realizations over time.
    virtual bool shows_motion() const { return true; }
    /// What the page opens with; nullopt: the share of the realizations that fell.
    virtual std::optional<Answer> answer() const { return std::nullopt; }

protected:
    /// Takes a row that is a trial or a copy of one.
    virtual void take(const ResultRow&) {}
    virtual void take(const Tally&) {}
    const std::string& kind_name() const { return header_.kind; }

    const Study& study_;
    const ResultHeader& header_;
    LimitCounts counts_;
};

} // namespace stylobate
