#pragma once
/// A results file that is open: its study, read once, and what its kind makes of it.

#include "io/store/result_store.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/kind.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

class Results {
public:
    /// @param settings may only give the present path of the record
    /// @throws InputError if it is no such file, if it is damaged, or if the settings change anything else
    explicit Results(const std::string& file, std::vector<std::string> settings = {});

    const std::string& file() const { return file_; }
    const ResultReader& reader() const { return reader_; }
    const ResultHeader& header() const { return reader_.header(); }
    const Study& study() const { return study_; }

    /// The kind as it is, without rows: for what it is asked before these are needed.
    const Kind& kind() const { return *kind_; }
    /// The kind with all rows of a complete run, and what it makes of them.
    /// @throws InputError if the run is not complete
    const Kind& concluded() const;
    /// The rows that are trials.
    const std::vector<ResultRow>& trials() const;
    /// What pictures and pages are called: the study's title, or else the file's name without its ending.
    std::string title() const;

    /// The study with its record and sampler, to run its realizations again.
    /// @throws InputError if none can be run again by itself, or if the record is not the one of the results
    const Experiment& experiment() const;
    /// One more than the last realization that may be asked for.
    std::uint64_t end() const { return realizations_end(header(), study_); }

private:
    std::string file_;
    std::vector<std::string> settings_;
    ResultReader reader_;
    Study study_;
    std::unique_ptr<Kind> kind_;
    mutable bool concluded_ = false;
    mutable std::optional<std::vector<ResultRow>> trials_;
    mutable std::optional<LoadedStudy> loaded_;
};

} // namespace stylobate
