#include "studies/calibration/kept_evidence.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_seal.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <span>
#include <string_view>
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
    EvidenceCost cost;
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

} // namespace

struct KeptEvidence::File {
    std::filesystem::path path;
    FileHandle handle;
    std::uint64_t end = 0;                   ///< of what is good [bytes]
    std::map<std::string, Portion> portions; ///< by their studies
    std::size_t sets = 0, restored = 0;
    EvidenceCost restored_cost;

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
    : inner_(std::move(inner)), file_(std::make_unique<File>())
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

const std::vector<std::size_t>& KeptEvidence::runs() const
{
    return inner_->runs();
}

std::size_t KeptEvidence::candidates() const
{
    return inner_->candidates();
}

bool KeptEvidence::add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer)
{
    const auto found = file_->portions.find(texts_of(candidates));
    if (found != file_->portions.end() && inner_->take(found->second.predictions)) {
        file_->restored += candidates.size();
        file_->restored_cost += found->second.cost;
        return true;
    }
    return CalibrationEvidence::add(candidates, options, observer);
}

std::optional<Predictions> KeptEvidence::predict(const std::vector<Study>& candidates, const RunOptions& options,
                                                 Observer& observer)
{
    const EvidenceCost before = inner_->cost();
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

std::vector<double> KeptEvidence::own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const
{
    return inner_->own_scores(candidate, used);
}

std::vector<double> KeptEvidence::scores(std::size_t candidate, std::size_t scales_of) const
{
    return inner_->scores(candidate, scales_of);
}

EvidenceCost KeptEvidence::cost() const
{
    EvidenceCost cost = inner_->cost();
    return cost += file_->restored_cost;
}

bool KeptEvidence::take(const Predictions& predictions)
{
    return inner_->take(predictions);
}

std::size_t KeptEvidence::restored() const
{
    return file_->restored;
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

} // namespace stylobate
