#include "ensemble/numerics/run_order.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

__extension__ using Wide = unsigned __int128;
__extension__ using Signed = __int128;

bool is_prime(std::uint64_t n)
{
    for (std::uint64_t divisor = 2; divisor * divisor <= n; ++divisor)
        if (n % divisor == 0)
            return false;
    return n > 1;
}

/// Largest quotient of the continued fraction of a / n: the smaller, the more even the multiples of a.
std::uint64_t largest_quotient(std::uint64_t a, std::uint64_t n)
{
    std::uint64_t largest = 0;
    while (a > 0) {
        largest = std::max(largest, n / a);
        n = std::exchange(a, n % a);
    }
    return largest;
}

/// The inverse of a mod n by Euclid's algorithm. @pre gcd(a, n) = 1
std::uint64_t inverse(std::uint64_t a, std::uint64_t n)
{
    Signed t = 0, next_t = 1;
    std::uint64_t r = n, next_r = a;
    while (next_r != 0) {
        const std::uint64_t quotient = r / next_r;
        t = std::exchange(next_t, t - static_cast<Signed>(quotient) * next_t);
        r = std::exchange(next_r, r - quotient * next_r);
    }
    return static_cast<std::uint64_t>(t < 0 ? t + static_cast<Signed>(n) : t);
}

} // namespace

RunOrder::RunOrder(std::uint64_t total) : total_(total)
{
    // blocks of some thousand, but some sixty of them at least; of few realizations each is a block
    constexpr std::uint64_t fewest = 61, most = 1 << 16, in_block = 1024, least_in_block = 4;
    blocks_ = total;
    if (total >= fewest * least_in_block) {
        blocks_ = std::clamp(total / in_block, fewest, most);
        while (total % blocks_ == 0 || !is_prime(blocks_))
            ++blocks_;
    }
    std::vector<std::uint64_t> begin(blocks_ + 1);
    if (blocks_ >= 4) {
        // 2^64 / golden ratio; the best of its neighbours, of which some have no common divisor with the blocks
        const auto near = static_cast<std::uint64_t>((Wide{blocks_} * 0x9e3779b97f4a7c15U) >> 64);
        std::uint64_t best = ~std::uint64_t{0};
        const std::uint64_t reach = std::min<std::uint64_t>(64, blocks_ / 4);
        for (std::uint64_t a = std::max<std::uint64_t>(1, near - reach); a <= near + reach && a < blocks_; ++a)
            if (std::gcd(a, blocks_) == 1)
                if (const std::uint64_t quotient = largest_quotient(a, blocks_); quotient < best) {
                    best = quotient;
                    step_ = a;
                }
        back_ = inverse(step_, blocks_);
    }
    for (std::uint64_t b = 0, residue = 0; b < blocks_; ++b, residue = (residue + step_) % blocks_)
        begin[b + 1] = begin[b] + total / blocks_ + (residue < total % blocks_ ? 1 : 0);
    begin_ = std::make_shared<const std::vector<std::uint64_t>>(std::move(begin));
}

std::size_t RunOrder::block_of(std::uint64_t place) const
{
    assert(place < total_);
    const auto after = std::upper_bound(begin_->begin(), begin_->end(), place);
    return static_cast<std::size_t>(after - begin_->begin()) - 1;
}

std::uint64_t RunOrder::index(std::uint64_t place) const
{
    const std::size_t b = block_of(place);
    return step_ * b % blocks_ + blocks_ * (place - (*begin_)[b]);
}

std::uint64_t RunOrder::place(std::uint64_t index) const
{
    assert(index < total_);
    const std::uint64_t b = back_ * (index % blocks_) % blocks_;
    return (*begin_)[b] + index / blocks_;
}

std::uint64_t RunOrder::block_begin(std::uint64_t place) const
{
    return (*begin_)[block_of(place)];
}

std::uint64_t RunOrder::block_end(std::uint64_t place) const
{
    return (*begin_)[block_of(place) + 1];
}

std::uint64_t RunOrder::fair(std::uint64_t places) const
{
    return places >= total_ ? total_ : block_begin(places);
}

RunOrder::Places RunOrder::places(const Shard& shard) const
{
    constexpr std::uint64_t many = 16; // shards then differ by a sixteenth at the most
    const bool whole_blocks = blocks_ >= many * shard.of;
    const auto first_of = [&](std::uint64_t k) { // of the shards behind k of them; without overflow
        const std::uint64_t n = whole_blocks ? blocks_ : total_;
        const std::uint64_t part = n / shard.of * k + n % shard.of * k / shard.of;
        return whole_blocks ? (*begin_)[part] : part;
    };
    return {first_of(shard.number - 1), first_of(shard.number)};
}

bool DoneSet::has(std::uint64_t place) const
{
    const auto after = parts_.upper_bound(place);
    return after != parts_.begin() && std::prev(after)->second.end > place;
}

bool DoneSet::join(At part)
{
    const At next = std::next(part);
    if (next == parts_.end() || next->first != part->second.end)
        return false;
    const bool same_block = order_.block_begin(next->first) != next->first;
    if (!same_block && next->second.end < order_.block_end(next->first))
        return false;
    part->second.end = next->second.end;
    part->second.collapsed += next->second.collapsed;
    part->second.invalid += next->second.invalid;
    parts_.erase(next);
    return true;
}

void DoneSet::insert(std::uint64_t begin, const Part& part)
{
    At at = parts_.emplace(begin, part).first;
    join(at);
    while (at != parts_.begin() && join(std::prev(at))) // a block that is whole now may join the one before it
        at = std::prev(parts_.upper_bound(begin));
}

void DoneSet::add(std::uint64_t place, bool collapsed, bool invalid)
{
    insert(place, {place + 1, collapsed, invalid});
}

void DoneSet::add(const DoneSet& other)
{
    for (const auto& [begin, part] : other.parts_)
        insert(begin, part);
}

std::optional<std::uint64_t> DoneSet::common(const DoneSet& other) const
{
    auto a = parts_.begin(), b = other.parts_.begin();
    while (a != parts_.end() && b != other.parts_.end()) {
        const std::uint64_t first = std::max(a->first, b->first);
        if (first < std::min(a->second.end, b->second.end))
            return first;
        if (a->second.end <= b->second.end)
            ++a;
        else
            ++b;
    }
    return std::nullopt;
}

bool DoneSet::append(std::uint64_t begin, const Part& part)
{
    if (begin >= part.end || (!parts_.empty() && begin < parts_.rbegin()->second.end) ||
        part.collapsed > part.done(begin) || part.invalid > part.done(begin) - part.collapsed)
        return false;
    const At at = parts_.emplace_hint(parts_.end(), begin, part);
    return at == parts_.begin() || !join(std::prev(at));
}

DoneSet::Part DoneSet::all() const
{
    Part all;
    for (const auto& [begin, part] : parts_) {
        all.end += part.done(begin);
        all.collapsed += part.collapsed;
        all.invalid += part.invalid;
    }
    return all;
}

DoneSet::Part DoneSet::sample(std::uint64_t from) const
{
    const auto at = parts_.find(from);
    const bool whole =
        at != parts_.end() && order_.block_begin(from) == from && order_.fair(at->second.end) == at->second.end;
    return whole ? at->second : Part{};
}

} // namespace stylobate
