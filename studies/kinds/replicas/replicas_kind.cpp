#include "studies/kinds/replicas/replicas_kind.hpp"

#include "ensemble/replicas/replicas.hpp"
#include "io/tables/rows.hpp"

#include <numeric>

namespace stylobate {

std::uint64_t ReplicasKind::size_of(const Shard& shard) const
{
    std::uint64_t size = 0;
    for (const ReplicaRange& range : replica_ranges(study_))
        size += RunOrder(range.end - range.begin).places(shard).size();
    return size;
}

double ReplicasKind::table_bytes() const
{
    return 60 * static_cast<double>(separated_originals(study_) * moves_of(study_));
}

bool ReplicasKind::plan(Rounds& rounds)
{
    rounds.progress.total = size_of(rounds.shard);
    for (const ReplicaRange& range : replica_ranges(study_)) {
        std::vector<std::uint64_t> indices(range.end - range.begin);
        std::iota(indices.begin(), indices.end(), range.begin);
        // replicas are no further trials
        if (!rounds.run({.indices = indices, .as = &range.study, .fair = range.begin == 0}))
            return false;
    }
    if (!rounds.shard.whole() || !rounds.options.leads())
        return true; // pairs are followed where all are there
    followed_ = replica_separations(rounds.experiment, rounds.options, rounds.observer);
    return !rounds.observer.stop_requested();
}

void ReplicasKind::take(const ResultRow& row)
{
    SurfaceKind::take(row);
    rows_.push_back({row.index, row.cell, row.outcome.state});
}

void ReplicasKind::restore(const ResultReader& reader)
{
    if (const Table table = reader.table("twins"); !table.empty())
        followed_ = rows_of<ReplicaSeparation>(table, "original");
    conclude();
}

std::vector<Table> ReplicasKind::tables() const
{
    if (followed_.empty())
        return {};
    Table table("twins");
    add_rows(table, followed_);
    return {table};
}

std::string ReplicasKind::text() const
{
    return SurfaceKind::text() + replicas_text(replicas_);
}

void ReplicasKind::add_to(Json& json) const
{
    json.member("twins", replicas_json(replicas_));
}

Picture ReplicasKind::picture(const ResultReader& reader, const std::string& results,
                              const PictureRequest& request) const
{
    if (request.name != "twins" && request.name != "predictability")
        return SurfaceKind::picture(reader, results, request);
    check_complete(reader, results);
    if (request.name == "twins")
        return {"twins", "Predictability of the verdict", "",
                [this](const std::string& title, const std::filesystem::path& file) {
                    plot_discordance(replicas_, title, file);
                }};
    return {
        "predictability", "Predictability horizon of the motion", "",
        [this](const std::string& title, const std::filesystem::path& file) { plot_growth(replicas_, title, file); }};
}

std::vector<std::pair<std::string, std::string>> ReplicasKind::files(const std::string& format,
                                                                     const std::string& name) const
{
    auto files = SurfaceKind::files(format, name);
    files.emplace_back("twins.csv", replicas_csv(replicas_));
    if (!replicas_.growth.empty())
        files.emplace_back("predictability.csv", predictability_csv(replicas_));
    return files;
}

void ReplicasKind::sections(PageWriter& writer) const
{
    SurfaceKind::sections(writer);
    replicas_section(replicas_, writer);
}

} // namespace stylobate
