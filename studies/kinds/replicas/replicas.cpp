#include "studies/kinds/replicas/replicas.hpp"

#include "io/keys/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace stylobate {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// @param rows by index
void count_discordant(const Study& study, const std::vector<ReplicaRow>& rows, Replicas& out)
{
    const std::uint64_t n = study.originals();
    const auto cells = static_cast<std::size_t>(study.cells());
    std::vector<std::vector<PairCounts>> counts(out.kinds.size(), std::vector<PairCounts>(cells));
    std::vector<std::uint64_t> valid(cells), collapsed(cells);
    for (const ReplicaRow& row : rows) {
        const State replica = row.state, original = rows[row.index % n].state;
        if (row.index < n) {
            valid[row.cell] += replica != State::invalid;
            collapsed[row.cell] += replica == State::collapsed;
            continue;
        }
        if (replica == State::invalid || original == State::invalid) {
            ++out.invalid_pairs;
            continue;
        }
        PairCounts& c = counts[row.index / n - 1][row.cell];
        const bool fell = original == State::collapsed, replica_fell = replica == State::collapsed;
        ++(fell && replica_fell ? c.both : fell ? c.original : replica_fell ? c.replica : c.neither);
    }
    for (std::size_t cell = 0; cell < cells; ++cell)
        out.probability.push_back(valid[cell] > 0
                                      ? static_cast<double>(collapsed[cell]) / static_cast<double>(valid[cell])
                                      : std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < out.kinds.size(); ++k) {
        KindDiscordance& kind = out.kinds[k];
        kind.all = discordance_ratio(counts[k]);
        for (const PairCounts& c : counts[k]) {
            const DiscordantShare share = discordant_share(c);
            kind.cells.push_back(share);
            if (share.trials == 0)
                continue;
            if (const std::optional<Sureness> verdict = share.verdict())
                ++kind.classes[static_cast<std::size_t>(*verdict)];
            else
                ++kind.open;
        }
    }
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::size_t k = 0;
        bool certain = true;
        while (k < out.moves && !(out.kinds[k].cells[cell].lower >= certain_below))
            certain = out.kinds[k++].cells[cell].verdict() == Sureness::certain && certain;
        out.lost_at.push_back(k == out.moves && !certain ? k + 1 : k);
    }
}

double median(std::vector<double> values)
{
    return estimated_median(std::move(values)).value;
}

ReplicaGrowth growth_of(const Study& study, std::size_t kind, const std::vector<ReplicaSeparation>& pairs)
{
    ReplicaGrowth growth;
    growth.kind = kind;
    const auto cells = static_cast<std::size_t>(study.cells());
    std::vector<std::vector<double>> exponents(cells), horizons(cells);
    std::vector<double> starts, all_exponents, all_horizons;
    growth.lost.resize(cells);
    for (const ReplicaSeparation& pair : pairs)
        if (pair.kind == kind) {
            const auto cell = static_cast<std::size_t>(study.cell(pair.original));
            const bool lost = !std::isnan(pair.horizon_s);
            const double horizon = lost ? pair.horizon_s : infinity;
            ++growth.pairs;
            growth.pairs_lost += lost;
            growth.lost[cell] += lost;
            starts.push_back(pair.start);
            exponents[cell].push_back(pair.exponent_per_s);
            horizons[cell].push_back(horizon);
            if (!std::isnan(pair.exponent_per_s))
                all_exponents.push_back(pair.exponent_per_s);
            all_horizons.push_back(horizon);
        }
    growth.start = median(starts);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        growth.exponent_per_s.push_back(estimated_mean(exponents[cell]));
        growth.horizon_s.push_back(estimated_median(horizons[cell]));
    }
    growth.all_exponents_per_s = estimated_median(all_exponents);
    growth.all_horizons_s = estimated_median(all_horizons);
    return growth;
}

/// Horizons of one kind against those of the next one.
void add_gain(const std::vector<Replica>& kinds, std::size_t next, const std::vector<ReplicaSeparation>& pairs,
              ReplicaGrowth& growth)
{
    std::map<std::uint64_t, double> of_next;
    for (const ReplicaSeparation& pair : pairs)
        if (pair.kind == next)
            of_next.emplace(pair.original, pair.horizon_s);
    std::vector<double> gains;
    for (const ReplicaSeparation& pair : pairs)
        if (pair.kind == growth.kind)
            if (const auto found = of_next.find(pair.original); found != of_next.end())
                gains.push_back(pair.horizon_s - found->second); // NaN unless both came apart
    growth.gained_s = estimated_mean(gains);
    growth.gained_exponent_per_s = std::log(kinds[next].size / kinds[growth.kind].size) / growth.gained_s.value;
}

} // namespace

std::string describe(const Replica& kind)
{
    switch (kind.by) {
    case ReplicaBy::move:
        return fmt::format("moved by {:g} m", kind.size);
    case ReplicaBy::step:
        return fmt::format("step x {:g}", kind.size);
    case ReplicaBy::precision:
        return "single precision";
    case ReplicaBy::form:
        return fmt::format("form {}", word_for(contact_form_names, kind.form));
    }
    return {};
}

Replicas replicas_of(const Study& study, const ResultHeader& header, std::vector<ReplicaRow> rows,
                     const std::vector<ReplicaSeparation>& pairs)
{
    Replicas out;
    out.frequency_hz = header.frequency_hz;
    out.pga_m_s2 = header.pga_m_s2;
    out.realizations = study.realizations;
    out.followed = study.replicas->followed;
    out.tolerance = study.replicas->tolerance;
    for (const Replica& kind : study.replicas->kinds) {
        out.kinds.push_back({kind, describe(kind), {}, {}, {}, {}});
        out.moves += kind.by == ReplicaBy::move;
    }
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    count_discordant(study, rows, out);
    for (std::size_t k = 0; k < out.moves; ++k) {
        const bool begins_beyond = std::all_of(pairs.begin(), pairs.end(), [&](const ReplicaSeparation& pair) {
            return pair.kind != k || pair.start >= out.tolerance;
        });
        if (!begins_beyond)
            out.growth.push_back(growth_of(study, k, pairs));
    }
    for (std::size_t i = 0; i < out.growth.size(); ++i) {
        out.growth[i].gained_exponent_per_s = std::numeric_limits<double>::quiet_NaN();
        if (i + 1 < out.growth.size())
            add_gain(study.replicas->kinds, out.growth[i + 1].kind, pairs, out.growth[i]);
    }
    return out;
}

} // namespace stylobate
