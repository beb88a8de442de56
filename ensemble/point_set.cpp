#include "ensemble/point_set.hpp"

#include <boost/random/sobol.hpp>

#include <algorithm>
#include <bit>

namespace stylobate {

namespace {

/// More realizations of a cell than 2^20 are independent from there on.
constexpr int most_digits = 20;
/// Of Boost's tables.
constexpr std::size_t most_dimensions = 3667;

/// What a number is for: what the structure was built like, how its faces touch, or what only tells twins apart.
enum class Cause { imperfection, contact, twin };

Cause cause_of(Stream stream)
{
    switch (stream) {
    case Stream::friction:
    case Stream::normal_stiffness:
    case Stream::tangential_stiffness:
    case Stream::damping_ratio:
        return Cause::contact;
    case Stream::twin:
        return Cause::twin;
    default:
        break;
    }
    if (stream < Stream::mechanisms)
        return Cause::imperfection;
    switch (static_cast<Mechanism>(
        (static_cast<std::uint64_t>(stream) - static_cast<std::uint64_t>(Stream::mechanisms)) / 8)) {
    case Mechanism::corner_loss:
    case Mechanism::eccentricity:
    case Mechanism::wedge:
    case Mechanism::drum_offset:
        return Cause::imperfection;
    default:
        return Cause::contact;
    }
}

} // namespace

PointSet::PointSet(const Study& study, const std::vector<Place>& places)
    : seed_(study.seed), per_cell_(study.realizations)
{
    if (study.fragility) {
        stripes_ = static_cast<std::uint64_t>(study.fragility->stripes());
        contacts_ = static_cast<std::uint64_t>(study.fragility->contacts);
        twins_ = static_cast<std::uint64_t>(study.fragility->twins);
    }
    if (study.sampling == Sampling::independent || per_cell_ < 2 || places.empty())
        return;
    digits_ = std::min(most_digits, static_cast<int>(std::bit_width(per_cell_ - 1)));
    const std::size_t dimensions = std::min(places.size(), most_dimensions);
    for (std::size_t d = 0; d < dimensions; ++d)
        dimension_.emplace(key(places[d].stream, places[d].element), d);

    // Boost tells points, in the order of Gray's code: the n-th differs from the one before by direction ctz(n)
    const auto digits = static_cast<std::size_t>(digits_);
    direction_.resize(dimensions * digits);
    boost::random::sobol engine(dimensions);
    std::vector<std::uint64_t> before(dimensions, 0), point(dimensions);
    const auto next = [&] { std::generate(point.begin(), point.end(), [&] { return engine(); }); };
    next();
    if (std::all_of(point.begin(), point.end(), [](std::uint64_t x) { return x == 0; }))
        next(); // versions differ in whether the origin is a point
    for (std::uint64_t n = 1;; ++n) {
        const auto digit = static_cast<std::size_t>(std::countr_zero(n));
        if (std::has_single_bit(n))
            for (std::size_t d = 0; d < dimensions; ++d)
                direction_[d * digits + digit] = point[d] ^ before[d];
        if (digit + 1 == digits)
            break;
        before = point;
        next();
    }
}

std::uint64_t PointSet::drawn_as(std::uint64_t index, Stream stream) const
{
    if (stripes_ == 0)
        return index;
    // the structures of a motion, whatever the stripe
    const std::uint64_t structure = index / (stripes_ * per_cell_) * per_cell_ + index % per_cell_;
    switch (cause_of(stream)) {
    case Cause::imperfection:
        return structure / (contacts_ * twins_);
    case Cause::contact:
        return structure / twins_;
    case Cause::twin:
        break;
    }
    return structure;
}

double PointSet::uniform(std::uint64_t index, Stream stream, std::uint64_t element) const
{
    index = drawn_as(index, stream);
    const std::uint64_t independent = random_bits(seed_, index, stream, element);
    const std::uint64_t k = index % per_cell_;
    const auto found = dimension_.find(key(stream, element));
    if (found == dimension_.end() || k >> digits_ != 0)
        return to_uniform01(independent);
    const std::uint64_t dimension = found->second;
    std::uint64_t point = 0;
    for (std::uint64_t rest = k, d = 0; rest != 0; rest >>= 1, ++d)
        if (rest & 1)
            point ^= direction_[dimension * static_cast<std::uint64_t>(digits_) + d];
    std::uint64_t scrambled = independent >> digits_;
    for (int d = 0; d < digits_; ++d) {
        // which bit flips digit d: that of the digits before it, in this dimension of this cell
        const std::uint64_t before = d == 0 ? 0 : point >> (64 - d);
        const std::uint64_t node = (std::uint64_t{1} << d) | before;
        const std::uint64_t flip =
            random_bits(seed_, index / per_cell_, Stream::scramble, (dimension << 32) | node) & 1;
        scrambled |= (((point >> (63 - d)) & 1) ^ flip) << (63 - d);
    }
    return to_uniform01(scrambled);
}

} // namespace stylobate
