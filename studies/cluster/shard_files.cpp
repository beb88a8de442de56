#include "studies/cluster/shard_files.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace stylobate {

void check_is_part(const ResultReader& reader, const std::string& file)
{
    const ResultHeader& header = reader.header();
    if (header.kind == "replay")
        throw InputError(file, 0, "is one realization that was run again, and no shard of a study.");
    if (header.selected)
        throw InputError(file, 0, "is of a study whose realizations are chosen by what others did. It has no shards.");
    if (reader.complete())
        throw InputError(file, 0, "is already complete: nothing is to be merged with it.");
}

ShardFile read_shard_file(const std::string& file, const ResultHeader& header)
{
    const ResultReader reader(file);
    check_is_part(reader, file);
    const ResultHeader& found = reader.header();
    if (const std::string other = study_difference(found, false, header); !other.empty())
        throw InputError(file, 0, "is of another study than the first file: " + other + ".");
    if (found.code_version != header.code_version)
        throw InputError(file, 0,
                         fmt::format("was begun by version {} and this is version {}. Merge shards with the version "
                                     "that has made all of them.",
                                     found.code_version, header.code_version));
    if (reader.counted())
        return {file, found.shard, *reader.counted()};
    const RunOrder order(header.total);
    ShardFile part{file, found.shard, DoneSet(order)};
    reader.for_each_row([&](const ResultRow& row) {
        const State state = row.outcome.state;
        part.done.add(order.place(row.index), state == State::collapsed, state == State::invalid);
    });
    return part;
}

DoneSet joined(const std::vector<ShardFile>& files, const RunOrder& order)
{
    DoneSet all(order);
    for (const ShardFile& part : files) {
        if (const std::optional<std::uint64_t> place = all.common(part.done)) {
            const auto owner =
                std::find_if(files.begin(), files.end(), [&](const ShardFile& p) { return p.done.has(*place); });
            throw InputError(fmt::format("{} and {} both have realization {}. Leave one of them out.", owner->file,
                                         part.file, order.index(*place)));
        }
        all.add(part.done);
    }
    return all;
}

std::string missing_text(const std::vector<ShardFile>& files, const Kind& kind, std::uint64_t done, std::uint64_t total)
{
    constexpr std::size_t most = 10; // lines
    std::vector<std::string> lines;
    std::set<std::uint64_t> numbers, of;
    for (const ShardFile& part : files) {
        of.insert(part.shard.of);
        numbers.insert(part.shard.number);
        const std::uint64_t size = kind.size_of(part.shard);
        const std::uint64_t has = part.done.all().end;
        if (!part.shard.whole() && has < size)
            lines.push_back(fmt::format("{0} lacks {1} of the {2} realizations of shard {3}: stylobate run STUDY.toml "
                                        "--shard {3} -o {0}",
                                        part.file, size - has, size, part.shard.text()));
    }
    if (of.size() == 1 && *of.begin() > 1)
        for (Shard shard{1, *of.begin()}; shard.number <= shard.of && lines.size() <= most; ++shard.number)
            if (!numbers.contains(shard.number) && kind.size_of(shard) > 0)
                lines.push_back(
                    fmt::format("shard {0} has no file: stylobate run STUDY.toml --shard {0}", shard.text()));
    if (lines.size() > most) {
        lines.resize(most);
        lines.emplace_back("and others");
    }
    std::string text = fmt::format("{} of {} realizations are missing.\n", total - done, total);
    for (const std::string& line : lines)
        text += "  " + line + "\n";
    return text + "  Give --partial to join what there is; `run` then computes the rest.";
}

} // namespace stylobate
