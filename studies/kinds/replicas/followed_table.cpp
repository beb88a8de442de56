#include "studies/kinds/replicas/followed_table.hpp"

namespace stylobate {

namespace {

/// Calls f(name, unit, member) for every number of a pair.
template <class F>
void visit(const F& f)
{
    f("original", "", &FollowedTwin::original);
    f("kind", "", &FollowedTwin::kind);
    f("start", "", &FollowedTwin::start);
    f("exponent_per_s", "1/s", &FollowedTwin::exponent_per_s);
    f("horizon_s", "s", &FollowedTwin::horizon_s);
    f("followed_s", "s", &FollowedTwin::followed_s);
    f("original_end_s", "s", &FollowedTwin::original_end_s);
}

const std::vector<double>& column(const Table& table, const char* name, const Table::Shape& shape, double)
{
    return table.numbers(name, shape);
}

const std::vector<std::uint64_t>& column(const Table& table, const char* name, const Table::Shape& shape, std::uint64_t)
{
    return table.counts(name, shape);
}

} // namespace

Table to_table(const std::vector<FollowedTwin>& twins)
{
    Table table("twins");
    visit([&](const char* name, const char* unit, auto member) {
        std::vector<std::decay_t<decltype(twins[0].*member)>> values;
        for (const FollowedTwin& twin : twins)
            values.push_back(twin.*member);
        table.add(name, std::move(values), {twins.size()}, unit);
    });
    return table;
}

std::vector<FollowedTwin> followed_twins(const Table& table)
{
    if (table.empty())
        return {};
    const Table::Shape shape = table.shape("original");
    if (shape.size() != 1)
        table.refuse("'twins/original' is not a list");
    std::vector<FollowedTwin> twins(shape[0]);
    visit([&](const char* name, const char*, auto member) {
        const auto& values = column(table, name, shape, FollowedTwin().*member);
        for (std::size_t i = 0; i < twins.size(); ++i)
            twins[i].*member = values[i];
    });
    return twins;
}

} // namespace stylobate
