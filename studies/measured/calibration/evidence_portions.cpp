#include "studies/measured/calibration/evidence_portions.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_seal.hpp"
#include "io/study/study_file.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

constexpr std::string_view head = "stylobate calibration, sets kept: ";
// A record longer than this is none of ours: 16 sets of 8 million numbers.
constexpr std::uint64_t longest = std::uint64_t{1} << 30;

/// One portion of parameter sets.
struct Portion {
    std::string studies; ///< texts of all of them
    Predictions predictions;
    SimulationCount cost;
};

std::string texts_of(const std::vector<Study>& studies)
{
    std::string text;
    for (const Study& study : studies)
        text += study.text + '\0';
    return text;
}

void put(std::string& bytes, const void* from, std::size_t count)
{
    bytes.append(static_cast<const char*>(from), count);
}

void put(std::string& bytes, std::uint64_t number)
{
    put(bytes, &number, sizeof number);
}

std::string bytes_of(const Portion& portion)
{
    std::string bytes;
    put(bytes, portion.cost.simulations);
    put(bytes, portion.cost.window_simulations);
    put(bytes, portion.cost.block_steps);
    put(bytes, portion.studies.size());
    put(bytes, portion.studies.data(), portion.studies.size());
    put(bytes, portion.predictions.size());
    for (const std::vector<double>& numbers : portion.predictions) {
        put(bytes, numbers.size());
        put(bytes, numbers.data(), numbers.size() * sizeof(double));
    }
    return bytes;
}

/// Reads a portion. The checksum has been verified before, so that the bytes are those that were written.
Portion portion_of(std::string_view bytes)
{
    const auto number = [&] {
        std::uint64_t value = 0;
        std::memcpy(&value, bytes.data(), sizeof value);
        bytes.remove_prefix(sizeof value);
        return value;
    };
    Portion portion;
    portion.cost.simulations = number();
    portion.cost.window_simulations = number();
    portion.cost.block_steps = number();
    const std::uint64_t length = number();
    portion.studies = bytes.substr(0, length);
    bytes.remove_prefix(length);
    portion.predictions.resize(number());
    for (std::vector<double>& numbers : portion.predictions) {
        numbers.resize(number());
        std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
        bytes.remove_prefix(numbers.size() * sizeof(double));
    }
    return portion;
}

/// Before each record: its length and its checksum.
struct RecordHead {
    std::uint64_t length = 0;
    std::uint64_t crc32 = 0;
};

std::uint32_t crc_of(std::string_view bytes)
{
    return crc32_of(std::as_bytes(std::span(bytes)));
}

/// Predicts with this rank's part: every size-th study. @return what all have made, by rank; nothing of one that was
/// stopped
std::vector<std::string> predict_together(Ranks& ranks, CalibrationEvidence& evidence,
                                          const std::vector<Study>& candidates, const RunOptions& options,
                                          Observer& observer)
{
    std::vector<Study> mine;
    for (std::size_t i = static_cast<std::size_t>(ranks.rank()); i < candidates.size();
         i += static_cast<std::size_t>(ranks.size()))
        mine.push_back(candidates[i]);
    const SimulationCount before = evidence.cost();
    std::optional<Predictions> made(std::in_place);
    if (!mine.empty())
        made = evidence.predict(mine, options, observer);
    return ranks.of_all(made ? bytes_of({{}, std::move(*made), evidence.cost() - before}) : std::string());
}

} // namespace

struct KeptEvidence::File {
    std::filesystem::path path;
    FileHandle handle;
    std::uint64_t end = 0;                   ///< of what is good [bytes]
    std::map<std::string, Portion> portions; ///< by their studies
    std::size_t sets = 0;

    void write(std::string_view bytes)
    {
        try {
            handle.write(end, std::as_bytes(std::span(bytes)));
        } catch (const std::system_error& error) {
            throw InputError(path.string(), 0, std::string("cannot be written: ") + error.what());
        }
        end += bytes.size();
    }

    std::string read(std::uint64_t offset, std::uint64_t length) const
    {
        std::string bytes(length, '\0');
        handle.read(offset, std::as_writable_bytes(std::span(bytes)));
        return bytes;
    }

    /// Everything up to the first record that is cut or damaged.
    void read_all(const std::string& first_line)
    {
        const std::uint64_t size = handle.size();
        if (size < first_line.size() || read(0, first_line.size()) != first_line)
            return;
        end = first_line.size();
        RecordHead record;
        while (end + sizeof record <= size) {
            handle.read(end, std::as_writable_bytes(std::span(&record, 1)));
            if (record.length > longest || end + sizeof record + record.length > size)
                return;
            const std::string bytes = read(end + sizeof record, record.length);
            if (crc_of(bytes) != record.crc32)
                return;
            Portion portion = portion_of(bytes);
            sets += portion.predictions.size();
            end += sizeof record + record.length;
            std::string studies = portion.studies;
            portions.emplace(std::move(studies), std::move(portion));
        }
    }
};

KeptEvidence::KeptEvidence(std::unique_ptr<CalibrationEvidence> inner, std::filesystem::path file,
                           const std::string& key)
    : EvidenceBy(std::move(inner)), file_(std::make_unique<File>())
{
    file_->path = std::move(file);
    file_->handle = FileHandle::claim(file_->path);
    if (!head.starts_with(file_->read(0, std::min<std::uint64_t>(file_->handle.size(), head.size()))))
        throw InputError(file_->path.string(), 0,
                         "keeps no parameter sets of a calibration, and nothing was written.\n  Remove it, or name "
                         "another file.");
    const std::string first_line = std::string(head) + key + "\n";
    file_->read_all(first_line);
    if (file_->end == 0) {
        // of other data, or of another version: over it, and what is behind the first record is cut off
        std::filesystem::resize_file(file_->path, 0);
        file_->write(first_line);
    } else {
        std::filesystem::resize_file(file_->path, file_->end);
    }
}

KeptEvidence::~KeptEvidence() = default;

bool KeptEvidence::add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer)
{
    const auto found = file_->portions.find(texts_of(candidates));
    if (found != file_->portions.end() && inner_->take(found->second.predictions)) {
        restored_ += candidates.size();
        elsewhere_ += found->second.cost;
        return true;
    }
    return CalibrationEvidence::add(candidates, options, observer);
}

std::optional<Predictions> KeptEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                 Observer& observer)
{
    const SimulationCount before = inner_->cost();
    std::optional<Predictions> made = inner_->predict(candidates, options, observer);
    if (!made)
        return made;
    const std::string bytes = bytes_of({texts_of(candidates), *made, inner_->cost() - before});
    const RecordHead record{bytes.size(), crc_of(bytes)};
    std::string whole;
    put(whole, &record, sizeof record);
    file_->write(whole + bytes);
    file_->sets += candidates.size();
    return made;
}

std::size_t KeptEvidence::kept() const
{
    return file_->sets;
}

void KeptEvidence::remove()
{
    std::error_code ignored;
    std::filesystem::remove(file_->path, ignored);
}

SharedEvidence::~SharedEvidence()
{
    if (std::uncaught_exceptions() == 0) // else all ranks are ended
        ranks_.of_first({});
}

std::optional<Predictions> SharedEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                   Observer& observer)
{
    ranks_.of_first(texts_of(candidates));
    const std::vector<std::string> made = predict_together(ranks_, *inner_, candidates, options, observer);
    std::vector<Predictions> of_rank;
    for (std::size_t rank = 0; rank < made.size(); ++rank) {
        if (made[rank].empty())
            return std::nullopt;
        Portion portion = portion_of(made[rank]);
        if (rank > 0)
            elsewhere_ += portion.cost;
        of_rank.push_back(std::move(portion.predictions));
    }
    Predictions all;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        all.push_back(std::move(of_rank[i % made.size()][i / made.size()]));
    return all;
}

void serve_evidence(Ranks& ranks, CalibrationEvidence& evidence, const RunOptions& options, Observer& observer)
{
    for (std::string texts = ranks.of_first({}); !texts.empty(); texts = ranks.of_first({})) {
        std::vector<Study> candidates;
        for (std::string_view rest = texts; !rest.empty();) {
            const std::size_t length = rest.find('\0');
            candidates.push_back(parse_study(std::string(rest.substr(0, length)), "a parameter set"));
            rest.remove_prefix(length + 1);
        }
        predict_together(ranks, evidence, candidates, options, observer);
    }
}

} // namespace stylobate
