#include "io/store/result_file.hpp"

#include <algorithm>
#include <cstring>

namespace stylobate {

namespace {

using Clock = std::chrono::steady_clock;

/// What a machine that stops loses is what has ended in this time; waiting for the disk takes no twentieth of the run.
constexpr std::chrono::seconds between_syncs{2};
constexpr int syncs_apart = 20;

struct Head {
    std::uint64_t size; ///< of the content [bytes]
    std::uint32_t kind;
    std::uint32_t crc; ///< CRC-32 of the size, the kind and the content
};
static_assert(sizeof(Head) == RowJournal::head_bytes);

std::uint32_t crc_of(const Head& head, std::span<const std::byte> content)
{
    return crc32_of(content, crc32_of(std::as_bytes(std::span(&head, 1)).first(sizeof head - sizeof head.crc)));
}

} // namespace

void RowJournal::read(const FileHandle& file, const std::function<void(const Record&, std::span<const std::byte>)>& f)
{
    const std::uint64_t size = file.size();
    while (end_ < size && size - end_ >= sizeof(Head)) {
        Head head = {};
        file.read(end_, std::as_writable_bytes(std::span(&head, 1)));
        if (head.size > size - end_ - sizeof head)
            return;
        buffer_.resize(head.size);
        const Record record = {static_cast<Kind>(head.kind), end_ + sizeof head, head.size};
        file.read(record.offset, buffer_);
        if (head.crc != crc_of(head, buffer_) || (record.kind != Kind::row && record.kind != Kind::trajectory))
            return;
        f(record, buffer_);
        end_ = record.offset + record.size;
    }
}

RowJournal::Rest RowJournal::rest(const FileHandle& file, std::uint64_t row_bytes) const
{
    const std::uint64_t size = file.size();
    Rest rest{size > end_ ? size - end_ : 0, false};
    if (rest.bytes < sizeof(Head))
        return rest;
    Head head = {};
    file.read(end_, std::as_writable_bytes(std::span(&head, 1)));
    const auto kind = static_cast<Kind>(head.kind);
    rest.damaged = head.size <= rest.bytes - sizeof head || (kind != Kind::row && kind != Kind::trajectory) ||
                   (kind == Kind::row && head.size != row_bytes);
    return rest;
}

RowJournal::Record RowJournal::append(FileHandle& file, Kind kind, std::span<const std::byte> content)
{
    Head head = {content.size(), static_cast<std::uint32_t>(kind), 0};
    head.crc = crc_of(head, content);
    if (!cut_ && file.size() > end_)
        file.cut(end_);
    cut_ = true;
    buffer_.resize(sizeof head + content.size());
    std::memcpy(buffer_.data(), &head, sizeof head);
    std::ranges::copy(content, buffer_.begin() + sizeof head);
    file.write(end_, buffer_);
    const Record record = {kind, end_ + sizeof head, content.size()};
    end_ = record.offset + record.size;
    if (const Clock::time_point now = Clock::now(); now >= due_) {
        file.sync();
        const Clock::time_point after = Clock::now();
        due_ = after + std::max<Clock::duration>(between_syncs, syncs_apart * (after - now));
    }
    return record;
}

std::vector<std::byte> RowJournal::content(const FileHandle& file, const Record& record)
{
    Head head = {};
    std::vector<std::byte> bytes(record.size);
    file.read(record.offset - sizeof head, std::as_writable_bytes(std::span(&head, 1)));
    file.read(record.offset, bytes);
    if (head.size != record.size || head.crc != crc_of(head, bytes))
        file.refuse_content(
            "was changed by something else while it was in use; run the study again: it goes on with what is "
            "left in the file");
    return bytes;
}

} // namespace stylobate
