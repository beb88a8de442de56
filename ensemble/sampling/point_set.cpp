#include "ensemble/sampling/point_set.hpp"

#include <boost/random/sobol.hpp>

#include <algorithm>
#include <bit>
#include <cassert>

namespace stylobate {

namespace {

/// More realizations of a cell than 2^20 are independent from there on.
constexpr int most_digits = 20;
/// Of Boost's tables.
constexpr std::size_t most_dimensions = 3667;
/// Of the numbers of a row's point B, beyond those of its point A.
constexpr std::uint64_t element_of_b = std::uint64_t{1} << 31;

/// The object of a number: the structure, its contacts, or the displacement of a perturbed replica.
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

/// Whether a number belongs to the motion, which structures of a site share.
bool is_of_motion(Stream stream)
{
    constexpr auto first_of = [](Mechanism mechanism) {
        return static_cast<std::uint64_t>(Stream::mechanisms) + 8 * static_cast<std::uint64_t>(mechanism);
    };
    const auto number = static_cast<std::uint64_t>(stream);
    return stream == Stream::phase || stream == Stream::pulse_frequency || stream == Stream::pulse_gamma ||
           (number >= first_of(Mechanism::table_pitch) && number < first_of(Mechanism::sensor_gain));
}

} // namespace

PointSet::PointSet(const Study& study, const std::vector<Place>& all)
    : seed_(study.seed), structure_seed_(study.seed), per_cell_(study.realizations), design_(study.design())
{
    if (design_.structure > 1)
        structure_seed_ = random_bits(study.seed, design_.structure, Stream::structure, 0);
    std::vector<Place> places = all;
    if (design_.factors != nullptr) {
        per_cell_ = design_.factors->samples;
        std::erase_if(places, [](const Place& place) { return place.factor < 0; });
        for (const Place& place : places)
            factor_.emplace(key(place.stream, place.element), static_cast<std::uint64_t>(place.factor));
        for (std::size_t i = 0, n = places.size(); i < n; ++i)
            places.push_back({places[i].stream, places[i].element + element_of_b, places[i].factor});
    }
    if (design_.chained())
        for (std::size_t d = 0; d < places.size(); ++d)
            dimension_.emplace(key(places[d].stream, places[d].element), d);
    if (design_.chained() || study.sampling == Sampling::independent || per_cell_ < 2 || places.empty())
        return;
    digits_ = std::min(most_digits, static_cast<int>(std::bit_width(per_cell_ - 1)));
    const std::size_t dimensions = std::min(places.size(), most_dimensions);
    for (std::size_t d = 0; d < dimensions; ++d)
        dimension_.emplace(key(places[d].stream, places[d].element), d);

    // Boost gives points in the order of Gray's code: the n-th differs from the one before by direction ctz(n)
    // (Antonov & Saleev, "An economic method of computing LP tau-sequences", USSR Computational Mathematics and
    // Mathematical Physics 19 (1979) 252)
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
    if (design_.per_motion > 1 && is_of_motion(stream))
        return design_.motion_index(index);
    // the structures of a row of cells, whatever the column
    const std::uint64_t structure = index / (design_.recurring * per_cell_) * per_cell_ + index % per_cell_;
    switch (cause_of(stream)) {
    case Cause::imperfection:
        return structure / design_.same_imperfections;
    case Cause::contact:
        return structure / design_.same_contacts;
    case Cause::twin:
        break;
    }
    return structure;
}

PointSet PointSet::given(std::span<const double> numbers) const
{
    assert(numbers.size() == size() && "a number for each place");
    PointSet points = *this;
    points.given_ = numbers;
    return points;
}

double PointSet::uniform(std::uint64_t index, Stream stream, std::uint64_t element) const
{
    index = drawn_as(index, stream);
    if (!given_.empty())
        return given_[dimension_.at(key(stream, element))];
    if (design_.factors == nullptr)
        return point(is_of_motion(stream) ? seed_ : structure_seed_, index, stream, element);
    const auto found = factor_.find(key(stream, element));
    if (found == factor_.end())
        return uniform01(seed_, design_.factors->rest_index(index), stream, element);
    const FactorDesign::Place place = design_.factors->place(index);
    const bool changed = place.point == design_.factors->first_changed() + found->second;
    if (design_.factors->method == SensitivityMethod::sobol)
        return point(seed_, place.row, stream, changed || place.point == 1 ? element + element_of_b : element);
    const double u = point(seed_, place.row, stream, element);
    return changed ? (u < 0.5 ? u + 0.5 : u - 0.5) : u; // exact: both are on the same grid
}

double PointSet::point(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element) const
{
    const std::uint64_t independent = random_bits(seed, index, stream, element);
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
        const std::uint64_t flip = random_bits(seed, index / per_cell_, Stream::scramble, (dimension << 32) | node) & 1;
        scrambled |= (((point >> (63 - d)) & 1) ^ flip) << (63 - d);
    }
    return to_uniform01(scrambled);
}

} // namespace stylobate
