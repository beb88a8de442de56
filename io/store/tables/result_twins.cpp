#include "io/store/tables/result_twins.hpp"

#include <string>

namespace stylobate {

namespace {

constexpr char group[] = "twins";

std::string in_group(const char* name)
{
    return std::string(group) + "/" + name;
}

/// Calls f(name, unit, member) for every number of a pair, counts first.
template <class Counts, class Reals>
void visit(const Counts& counts, const Reals& reals)
{
    counts("original", &FollowedTwin::original);
    counts("kind", &FollowedTwin::kind);
    reals("start", "", &FollowedTwin::start);
    reals("exponent_per_s", "1/s", &FollowedTwin::exponent_per_s);
    reals("horizon_s", "s", &FollowedTwin::horizon_s);
    reals("followed_s", "s", &FollowedTwin::followed_s);
    reals("original_end_s", "s", &FollowedTwin::original_end_s);
}

} // namespace

void write_twins(hid_t file, const std::vector<FollowedTwin>& twins)
{
    hdf5::create_group(file, group);
    const auto column = [&](auto member) {
        std::vector<std::decay_t<decltype(twins[0].*member)>> values;
        for (const FollowedTwin& twin : twins)
            values.push_back(twin.*member);
        return values;
    };
    visit([&](const char* name,
              auto member) { hdf5::write_array(file, in_group(name), column(member), {twins.size()}, ""); },
          [&](const char* name, const char* unit, auto member) {
              hdf5::write_array(file, in_group(name), column(member), {twins.size()}, unit);
          });
}

std::vector<FollowedTwin> read_twins_group(hid_t file)
{
    if (!hdf5::exists(file, group))
        return {};
    const hdf5::Dims dims = hdf5::dims_of(file, in_group("original"));
    if (dims.size() != 1)
        throw hdf5::Error("'twins/original' is not a list");
    std::vector<FollowedTwin> twins(dims[0]);
    const auto fill = [&](auto member, const auto& values) {
        for (std::size_t i = 0; i < twins.size(); ++i)
            twins[i].*member = values[i];
    };
    visit([&](const char* name, auto member) { fill(member, hdf5::read_counts(file, in_group(name), dims)); },
          [&](const char* name, const char*, auto member) {
              fill(member, hdf5::read_doubles(file, in_group(name), dims));
          });
    return twins;
}

} // namespace stylobate
