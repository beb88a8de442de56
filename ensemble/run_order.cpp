#include "ensemble/run_order.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

__extension__ typedef unsigned __int128 Wide;
__extension__ typedef __int128 Signed;

std::uint64_t product(std::uint64_t a, std::uint64_t b, std::uint64_t n)
{
    return static_cast<std::uint64_t>(Wide{a} * b % n);
}

/// Largest quotient of the continued fraction of a / n: the smaller, the more even the multiples of a.
std::uint64_t largest_quotient(std::uint64_t a, std::uint64_t n)
{
    std::uint64_t largest = 0;
    while (a > 1) { // the last quotient only says where the fraction ends
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
    if (total < 4)
        return;
    // 2^64 / golden ratio; the best of its neighbours, of which some have no common divisor with the total
    const auto near = static_cast<std::uint64_t>((Wide{total} * 0x9e3779b97f4a7c15U) >> 64);
    std::uint64_t best = ~std::uint64_t{0};
    const std::uint64_t reach = std::min<std::uint64_t>(64, total / 4);
    for (std::uint64_t a = std::max<std::uint64_t>(1, near - reach); a <= near + reach && a < total; ++a)
        if (std::gcd(a, total) == 1)
            if (const std::uint64_t quotient = largest_quotient(a, total); quotient < best) {
                best = quotient;
                step_ = a;
            }
    back_ = inverse(step_, total);
}

std::uint64_t RunOrder::index(std::uint64_t place) const
{
    assert(place < total_);
    return product(step_, place, total_);
}

std::uint64_t RunOrder::place(std::uint64_t index) const
{
    assert(index < total_);
    return product(back_, index, total_);
}

bool DoneSet::has(std::uint64_t place) const
{
    const auto after = parts_.upper_bound(place);
    return after != parts_.begin() && std::prev(after)->second.end > place;
}

void DoneSet::add(std::uint64_t place, bool collapsed, bool invalid)
{
    const auto after = parts_.upper_bound(place);
    auto at = after;
    if (after != parts_.begin() && std::prev(after)->second.end == place)
        at = std::prev(after);
    else
        at = parts_.emplace_hint(after, place, Part{});
    at->second.end = place + 1;
    at->second.collapsed += collapsed;
    at->second.invalid += invalid;
    if (after != parts_.end() && after->first == place + 1) {
        at->second.end = after->second.end;
        at->second.collapsed += after->second.collapsed;
        at->second.invalid += after->second.invalid;
        parts_.erase(after);
    }
}

bool DoneSet::append(std::uint64_t begin, const Part& part)
{
    if (begin >= part.end || (!parts_.empty() && begin <= parts_.rbegin()->second.end) ||
        part.collapsed > part.done(begin) || part.invalid > part.done(begin) - part.collapsed)
        return false;
    parts_.emplace_hint(parts_.end(), begin, part);
    return true;
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

DoneSet::Part DoneSet::first() const
{
    const auto at = parts_.find(0);
    return at == parts_.end() ? Part{} : at->second;
}

} // namespace stylobate
