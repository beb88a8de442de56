#include "studies/verify/verification.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/words.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/rounds.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/results.hpp"
#include "studies/verify/value_checks.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace stylobate {

namespace {

const char* word_of(CheckVerdict verdict)
{
    switch (verdict) {
    case CheckVerdict::passed:
        return "ok";
    case CheckVerdict::differs:
        return "differs";
    case CheckVerdict::not_done:
        return "not checked";
    }
    return "";
}

std::string written_by(const FileVerification& v)
{
    return v.build ? fmt::format("{} ({})", v.code_version, *v.build) : v.code_version;
}

std::string version_note(const FileVerification& v)
{
    return v.same_version ? ""
                          : fmt::format("This is version {}: realizations that are run again may differ in their last "
                                        "bits, or by more where its changelog lists results that move.",
                                        code_version());
}

} // namespace

void FileCheck::add(ValueDifference difference)
{
    verdict = CheckVerdict::differs;
    if (full())
        ++more;
    else
        differences.push_back(std::move(difference));
}

bool FileVerification::well() const
{
    return std::ranges::none_of(checks, [](const FileCheck& check) { return check.verdict == CheckVerdict::differs; });
}

std::string text_of(const FileVerification& v)
{
    std::string text = fmt::format(
        "{}: {} of {} realizations of a study of kind {} (study {}), {}\n  written by stylobate {}\n", v.file, v.done,
        v.realizations, v.kind, v.study_crc32, v.complete ? "complete" : "unfinished", written_by(v));
    if (const std::string note = version_note(v); !note.empty())
        text += fmt::format("  {}\n", note);
    for (const FileCheck& check : v.checks) {
        text += fmt::format("  {:<10}{:<13}{}\n", check.name, word_of(check.verdict), check.text);
        for (const ValueDifference& d : check.differences)
            text += fmt::format("    {}{}: {}{}\n",
                                d.realization ? fmt::format("realization {}, ", *d.realization) : "", d.where, d.stored,
                                d.expected.empty() ? "" : fmt::format(" in the file, {} expected", d.expected));
        if (check.more > 0)
            text += fmt::format("    and {}\n", counted(check.more, "other"));
    }
    return text;
}

Json json_of(const FileVerification& v)
{
    Json checks = Json::list();
    for (const FileCheck& check : v.checks) {
        Json differences = Json::list();
        for (const ValueDifference& d : check.differences) {
            Json one = Json::object();
            one.member("where", d.where);
            if (d.realization)
                one.member("realization", *d.realization);
            differences.item(one.member("stored", d.stored).member("expected", d.expected));
        }
        checks.item(Json::object()
                        .member("name", check.name)
                        .member("verdict", word_of(check.verdict))
                        .member("text", check.text)
                        .member("found", check.found())
                        .member("differences", differences));
    }
    return Json::object()
        .member("file", v.file)
        .member("kind", v.kind)
        .member("realizations", v.realizations)
        .member("done", v.done)
        .member("complete", v.complete)
        .member("code_version", v.code_version)
        .member("build", v.build.value_or(""))
        .member("same_version", v.same_version)
        .member("study_crc32", v.study_crc32)
        .member("well", v.well())
        .member("checks", checks);
}

std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed)
{
    using Keyed = std::pair<std::uint64_t, std::uint64_t>;   // key, index
    std::map<std::uint64_t, std::set<Keyed>> lowest_of_cell; // of each cell the `most` of the lowest keys
    if (most > 0)
        reader.for_each_row([&](const ResultRow& row) {
            std::set<Keyed>& lowest = lowest_of_cell[row.cell];
            lowest.emplace(sample_key(seed, row.index), row.index);
            if (lowest.size() > most)
                lowest.erase(std::prev(lowest.end()));
        });
    std::vector<std::tuple<std::size_t, std::uint64_t, std::uint64_t>> all; // number in its cell, key, index
    for (const auto& [cell, lowest] : lowest_of_cell) {
        std::size_t number = 0;
        for (const auto& [key, index] : lowest)
            all.emplace_back(number++, key, index);
    }
    std::ranges::sort(all);
    std::vector<std::uint64_t> sample;
    for (std::size_t i = 0; i < all.size() && i < most; ++i)
        sample.push_back(std::get<2>(all[i]));
    std::ranges::sort(sample);
    return sample;
}

namespace {

/// The header that a replay of one realization has, of the study's.
ResultHeader replay_header(ResultHeader study, std::uint64_t index)
{
    study.kind = "replay";
    study.first = index;
    study.total = 1;
    study.selected = false;
    study.limit_states.clear();
    study.axes() = {};
    return study;
}

/// What is asked of the file, and what takes the realizations that are run again; the takers are called from one thread
/// at a time.
struct Recorded {
    std::vector<std::uint64_t> sample;                    ///< ascending
    std::function<bool(std::uint64_t index)> there;       ///< whether the file has the realization
    std::function<void(const ResultRow&)> take;           ///< a realization of the sample
    std::function<void(const Trajectory&)> take_movement; ///< its trajectory, of a study that follows them one by one
    std::vector<std::uint64_t> followed;                  ///< all that such a study has
    bool ends_at_missing = false; ///< whether the rounds end where one is missing: the next depends on it
};

/// The rounds of the run, repeated with the realizations of the file; those of the sample are run again.
class RecordedRounds : public Rounds {
public:
    /// As of a part of the study, so that nothing follows on the rounds.
    RecordedRounds(const Experiment& run, const RunOptions& how, Observer& told, Recorded recorded)
        : Rounds(run, how, told, Shard{1, 2}), recorded_(std::move(recorded))
    {
    }

    bool run(const Round& round) override
    {
        const Study& study = experiment.study();
        std::vector<std::uint64_t> again;
        const std::uint64_t size = round.indices.empty() ? study.total() : round.indices.size();
        for (std::uint64_t number = 0; number < size; ++number)
            look_for(round.indices.empty() ? number : round.indices[number], again);
        if (!again.empty()) {
            RunPlan plan;
            plan.indices = again;
            plan.total = again.size();
            plan.as = round.as;
            plan.realize = round.realize;
            plan.mark_done([](std::uint64_t) { return std::optional<State>(); });
            plan.sink = [&](const Realization& realization, const Outcome& outcome) {
                recorded_.take(result_row(study, realization, outcome));
            };
            const std::uint64_t done = run_ensemble(experiment, options, plan, observer).done;
            again_ += done;
            stopped_ = done < again.size();
        }
        return !stopped_ && !(missing_ && recorded_.ends_at_missing);
    }

    bool trace(std::uint64_t /*kept_trajectories*/) override
    {
        std::vector<std::uint64_t> again;
        for (const std::uint64_t index : recorded_.followed)
            look_for(index, again);
        std::mutex mutex; // guards the takers, the observer and the counts
        const auto go_on = [&] {
            if (const std::unique_lock lock(mutex, std::try_to_lock); lock.owns_lock() && observer.stop_requested())
                stopped_ = true;
            return true;
        };
        tbb::task_arena arena(options.threads);
        arena.execute([&] {
            in_parallel(std::size_t{0}, again.size(), [&](std::size_t i) {
                {
                    const std::lock_guard lock(mutex);
                    if (stopped_ = stopped_ || observer.stop_requested(); stopped_)
                        return;
                }
                const TracedRealization f = stylobate::trace(experiment, again[i], options.isa, go_on);
                const std::lock_guard lock(mutex);
                recorded_.take(result_row(experiment.study(), f.realization, f.outcome));
                recorded_.take_movement(f.trajectory);
                ++again_;
            });
        });
        return !stopped_;
    }

    /// Realizations that were asked for, and the first of them that is not there.
    std::uint64_t asked() const { return asked_; }
    std::optional<std::uint64_t> missing() const { return missing_; }
    /// Those of the sample that were run again.
    std::uint64_t again() const { return again_; }
    bool stopped() const { return stopped_; }

private:
    void look_for(std::uint64_t index, std::vector<std::uint64_t>& of_sample)
    {
        ++asked_;
        if (!missing_ && !recorded_.there(index))
            missing_ = index;
        if (std::ranges::binary_search(recorded_.sample, index))
            of_sample.push_back(index);
    }

    Recorded recorded_;
    std::uint64_t asked_ = 0, again_ = 0;
    std::optional<std::uint64_t> missing_;
    bool stopped_ = false;
};

class Verifier {
public:
    Verifier(const std::string& file, const VerifyOptions& options, Observer& observer)
        : options_(options), observer_(observer), results_(file, options.settings), reader_(results_.reader()),
          header_(results_.header()), study_(results_.study())
    {
        v_.file = file;
        v_.kind = header_.kind;
        v_.realizations = header_.total;
        v_.done = reader_.done();
        v_.complete = reader_.complete();
        v_.code_version = header_.code_version;
        v_.build = header_.build;
        v_.study_crc32 = fmt::format("{:08x}", study_crc32_of(header_));
        v_.same_version = header_.code_version == code_version();
    }

    FileVerification verify()
    {
        check_checksums();
        load();
        check_study();
        check_values();
        check_made();
        return std::move(v_);
    }

private:
    /// Whoever has opened the file has verified them, all but what an unfinished file has behind its last record.
    void check_checksums()
    {
        FileCheck check{.name = "checksums", .text = "every byte, by the checksums of the rows and of the rest"};
        if (const ResultReader::Unread unread = reader_.unread(); unread.damaged)
            check.add({"the records of the rows", std::nullopt,
                       fmt::format("{} bytes that are no record", unread.bytes),
                       "nothing: what was there is lost, and the run computes it again"});
        else if (unread.bytes > 0)
            check.text += fmt::format("; the last {} bytes are the beginning of a record, as a run leaves that is "
                                      "killed",
                                      unread.bytes);
        v_.checks.push_back(std::move(check));
    }

    /// The study with its motions; without them, why not.
    void load()
    {
        try {
            loaded_.emplace(LoadedStudy::from_results(study_, header_, results_.file(), options_.settings));
        } catch (const InputError& error) {
            if (!options_.settings.empty())
                throw;
            unloaded_ = error.what();
        }
    }

    /// The study's text against its checksum, against what this version reads from it, and against the header.
    void check_study()
    {
        FileCheck check{.name = "study"};
        const std::uint32_t crc = study_crc32_of(header_);
        if (header_.study_crc32 && *header_.study_crc32 != crc)
            check.add({"study_crc32", std::nullopt, fmt::format("{:08x}", *header_.study_crc32),
                       fmt::format("{:08x}, of study_toml", crc)});
        if (study_.seed != header_.seed)
            check.add(
                {"seed", std::nullopt, fmt::format("{}", header_.seed), fmt::format("{}, of study_toml", study_.seed)});
        if (header_.kind != "replay" && header_.kind != word_for(study_kind_names, study_.kind))
            check.add({"kind", std::nullopt, header_.kind, std::string(word_for(study_kind_names, study_.kind))});
        check.text = "the text of the study against its checksum and the seed";
        if (!loaded_) {
            check.text += "; not against the motions: " + unloaded_;
        } else {
            ResultHeader made = loaded_->result_header();
            if (header_.kind == "replay")
                made = replay_header(std::move(made), header_.first);
            // another version may write defaults that came later; a record may lie elsewhere, and is known by its
            // samples
            if (!v_.same_version || !options_.settings.empty())
                made.study_toml = header_.study_toml;
            const auto other = study_difference(header_, reader_.complete(), made);
            sound_ = !other;
            if (other)
                check.add({"header", std::nullopt, *other, ""});
            check.text += v_.same_version ? "; inputs, blocks, axes and motions against what it makes"
                                          : "; inputs, blocks, axes and motions against what this version makes of it";
        }
        v_.checks.push_back(std::move(check));
    }

    void check_values()
    {
        if (!header_.has_rows()) {
            v_.checks.push_back(check_counts(study_, reader_));
            return;
        }
        RowChecks rows = check_rows(study_, reader_);
        sound_ = sound_ && !rows.wrong_cell;
        v_.checks.push_back(std::move(rows.check));
    }

    /// What is made of the realizations, and realizations made again.
    void check_made()
    {
        FileCheck tables{.name = "tables"}, replay{.name = "replay"};
        const std::string why = !sound_ ? "the study does not fit what is stored" : !loaded_ ? unloaded_ : "";
        const std::unique_ptr<Kind> kind = make_kind(study_, header_);
        if (sound_) {
            if (const Tally* tally = reader_.tally())
                kind->add(*tally);
            reader_.for_each_row([&](const ResultRow& row) { kind->add(row); });
        }
        bool planned = !header_.selected; // others are computed from all rows, whatever made them
        if (why.empty())
            planned = plan(*kind, tables, replay);
        else
            replay = {"replay", CheckVerdict::not_done, why, {}, 0};
        if (!reader_.complete())
            tables = {"tables", CheckVerdict::not_done, "the run is not complete: they are written at its end", {}, 0};
        else if (!sound_ || (!planned && tables.verdict == CheckVerdict::passed))
            tables = {"tables", CheckVerdict::not_done, v_.stopped ? "stopped" : why, {}, 0};
        else if (planned)
            check_tables(*kind, tables);
        v_.checks.push_back(std::move(tables));
        v_.checks.push_back(std::move(replay));
    }

    /// The run once more, its realizations taken from the file.
    /// @returns whether it came to its end
    bool plan(Kind& kind, FileCheck& tables, FileCheck& replay)
    {
        const bool rows = header_.has_rows();
        std::optional<CountReplay> counts;
        Recorded recorded;
        if (rows) {
            recorded.sample = replay_sample(reader_, options_.replay, options_.seed);
            recorded.there = [this](std::uint64_t index) { return reader_.has(index); };
            recorded.take = [&](const ResultRow& again) {
                compare_rows(header_, reader_.row(again.index), again, replay);
            };
        } else {
            counts.emplace(study_, reader_, options_.replay, options_.seed);
            recorded.sample = counts->indices();
            recorded.there = [this, order = RunOrder(header_.total)](std::uint64_t index) {
                return reader_.counted()->has(order.place(index));
            };
            recorded.take = [&](const ResultRow& again) { counts->take(again); };
        }
        const std::vector<std::uint64_t> moving = reader_.trajectory_indices();
        recorded.take_movement = [&](const Trajectory& again) {
            if (std::ranges::binary_search(moving, again.index))
                compare_trajectories(reader_.trajectory(again.index), again, replay);
        };
        if (study_.design().traced || header_.kind == "replay") {
            recorded.followed.resize(header_.total);
            std::iota(recorded.followed.begin(), recorded.followed.end(), header_.first);
        }
        recorded.ends_at_missing = header_.selected;
        const std::uint64_t sampled = recorded.sample.size();
        RecordedRounds rounds(loaded_->experiment(), options_.run, observer_, std::move(recorded));
        const bool ended = kind.plan(rounds);
        v_.stopped = rounds.stopped();
        if (reader_.complete() && !v_.stopped) {
            if (rounds.missing())
                tables.add({"realizations", *rounds.missing(), "no such realization", "one that the study asks for"});
            else if (rounds.asked() != header_.total)
                tables.add({"realizations", std::nullopt, fmt::format("{}", header_.total),
                            fmt::format("{}, as many as the study asks for", rounds.asked())});
        }
        tell_replay(counts, rounds, sampled, replay);
        return ended;
    }

    void tell_replay(const std::optional<CountReplay>& counts, const RecordedRounds& rounds, std::uint64_t sampled,
                     FileCheck& replay) const
    {
        if (v_.stopped) {
            replay.verdict = replay.found() > 0 ? CheckVerdict::differs : CheckVerdict::not_done;
            replay.text = fmt::format("stopped after {} of {} realizations", rounds.again(), sampled);
        } else if (sampled == 0 && !counts) {
            replay.verdict = CheckVerdict::not_done;
            replay.text = options_.replay == 0 ? "--replay 0" : "there is no realization yet";
        } else if (counts) {
            counts->conclude(replay);
        } else {
            if (rounds.again() < sampled)
                replay.add({"realizations", std::nullopt, fmt::format("{} of the sample", sampled),
                            fmt::format("{}, as many as the study asks for", rounds.again())});
            replay.text = fmt::format("{} run again with {}: all values, bit by bit{}",
                                      counted(rounds.again(), "realization"), to_string(options_.run.isa),
                                      reader_.trajectory_indices().empty() ? "" : ", and the trajectories of these");
        }
    }

    void check_tables(Kind& kind, FileCheck& tables)
    {
        kind.conclude();
        std::string names;
        if (const std::optional<SurfaceTable> surface = kind.surface(); surface && header_.cells() > 0) {
            compare_surfaces(reader_.surface(), *surface, tables);
            names = "surface";
        }
        for (const Table& table : kind.tables()) {
            compare_tables(reader_.table(table.name()), table, tables);
            names += (names.empty() ? "" : ", ") + table.name();
        }
        tables.text = names.empty() ? "the study has none beside its realizations"
                                    : names + ", computed again from what is stored of the realizations";
        if (study_.design().replica_set)
            tables.text += "; not the pairs that were followed (/twins)";
    }

    const VerifyOptions& options_;
    Observer& observer_;
    const Results results_;
    const ResultReader& reader_;
    const ResultHeader& header_;
    const Study& study_;
    std::optional<LoadedStudy> loaded_;
    std::string unloaded_; ///< why it is not loaded
    bool sound_ = true;    ///< whether realizations can be taken for those of the study
    FileVerification v_;
};

} // namespace

/// SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195): its two multiplications, over both numbers.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index)
{
    const auto mix = [](std::uint64_t z) {
        z += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    };
    return mix(mix(seed) ^ index);
}

FileVerification verify_file(const std::string& file, const VerifyOptions& options, Observer& observer)
{
    return Verifier(file, options, observer).verify();
}

} // namespace stylobate
