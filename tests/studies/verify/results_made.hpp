#pragma once
/// Small results of each kind of study, made in the process, and the same with one value altered and all checksums
/// right: what a wrong program, and no damage, would leave.

#include "ensemble/run/executor.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/study_run.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace stylobate {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class MadeResults : public testing::Test {
protected:
    const TemporaryFolder own;
    const fs::path folder = own.path();
    std::string file = (folder / "results.h5").string();
};

inline LoadedStudy ready_study(const std::string& input, const std::vector<std::string>& settings)
{
    return LoadedStudy::from_file(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/" + input + ".toml", settings);
}

/// Two cells of a column, so many realizations in each.
inline std::vector<std::string> two_cells(int realizations, std::vector<std::string> more = {})
{
    more.insert(more.end(),
                {"study.realizations=" + std::to_string(realizations), "surface.frequency_hz={from=2.0,to=2.0,count=1}",
                 "surface.pga_m_s2={from=4.0,to=12.0,count=2}"});
    return more;
}

/// Stops after so many looks.
class Impatient : public Observer {
public:
    explicit Impatient(int looks) : looks_(looks) {}
    bool stop_requested() override { return looks_-- <= 0; }

private:
    int looks_;
};

/// Runs a study into a file, as `stylobate run` does.
inline void make_results(const LoadedStudy& loaded, const std::string& file, const Shard& shard = {})
{
    ResultHeader header = loaded.result_header();
    header.shard = shard;
    Observer patient;
    StudyRun(loaded, header, file, file).run({best_isa(), 2}, patient);
}

/// What is altered in a copy.
struct Alteration {
    std::function<void(ResultHeader&)> header = [](ResultHeader&) {};
    std::function<void(ResultRow&)> row = [](ResultRow&) {};
    std::function<bool(const ResultRow&)> keep = [](const ResultRow&) { return true; };
    std::function<void(SurfaceTable&)> surface = [](SurfaceTable&) {};
    std::function<void(Trajectory&)> trajectory = [](Trajectory&) {};
    std::string table{}; ///< beside the surface, copied as it is; empty: none
};

/// A complete copy of a complete file, with right checksums.
inline void alter(const std::string& from, const std::string& to, const Alteration& altered)
{
    const ResultReader reader(from);
    ResultHeader header = reader.header();
    altered.header(header);
    const auto writer = ResultWriter::create(to, header);
    for (const std::uint64_t index : reader.trajectory_indices()) {
        Trajectory trajectory = reader.trajectory(index);
        altered.trajectory(trajectory);
        writer->add(trajectory);
    }
    reader.for_each_row([&](ResultRow row) {
        if (!altered.keep(row))
            return;
        altered.row(row);
        writer->add(row);
    });
    SurfaceTable surface = reader.surface();
    altered.surface(surface);
    std::vector<Table> tables;
    if (!altered.table.empty())
        tables.push_back(reader.table(altered.table));
    writer->finish(surface.trials.empty() ? nullptr : &surface, tables);
}

inline std::string bytes_of(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void put_bytes(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

} // namespace stylobate
