#pragma once
/// Results of a surface with perturbed replicas: predictability of the verdict of each cell, its sources, and the
/// predictability horizon.

#include "ensemble/model/replica_separation.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/store/result_store.hpp"
#include "studies/kinds/replicas/discordance.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// One kind of replica over the surface.
struct KindDiscordance {
    Replica kind;
    std::string name;                   ///< "moved by 1e-12 m"
    std::vector<DiscordantShare> cells; ///< (nf x np)
    DiscordanceRatio all;
    std::array<std::uint64_t, 3> classes{}; ///< cells by the `Sureness` that their interval lies within
    std::uint64_t open = 0;                 ///< undecided cells (too few pairs); those without a pair are not counted
};

/// How the separation of replicas of one kind grows.
struct ReplicaGrowth {
    std::size_t kind = 0;                  ///< in `Replicas::kinds`
    double start = 0;                      ///< separation at rest, median
    std::vector<Estimated> exponent_per_s; ///< (nf x np) mean
    std::vector<Estimated> horizon_s;      ///< (nf x np) median; infinite: not lost
    std::vector<std::uint64_t> lost;       ///< (nf x np) pairs that came apart by the tolerance
    std::uint64_t pairs = 0, pairs_lost = 0;
    Estimated all_exponents_per_s; ///< median over the pairs of all cells
    Estimated all_horizons_s;      ///< the same, of the horizon
    /// How much longer than that of the next kind, a greater move, the horizon is: mean over the realizations in which
    /// both came apart; ln of the ratio of the moves over it is the exponent once more, without any window in time.
    Estimated gained_s;
    double gained_exponent_per_s = 0; ///< NaN for the greatest move
};

struct Replicas {
    std::vector<double> frequency_hz, pga_m_s2;
    std::uint64_t realizations = 0; ///< originals of each cell
    std::uint64_t followed = 0;     ///< of these
    double tolerance = 0;
    std::vector<double> probability; ///< (nf x np) of collapse, of the originals; NaN without a valid one
    std::vector<KindDiscordance> kinds;
    std::vector<ReplicaGrowth> growth; ///< of the moves that begin below the tolerance
    std::uint64_t invalid_pairs = 0;   ///< with an invalid member: left out
    /// (nf x np) number of the smallest move at which the verdict is not certain, by its interval; as many as there are
    /// moves: it is certain at all of them; one more: undecided (too few pairs).
    std::vector<std::size_t> lost_at;
    std::size_t moves = 0; ///< number of kinds that are displacements, the first ones
};

/// What is needed of a row.
struct ReplicaRow {
    std::uint64_t index = 0, cell = 0;
    State state = State::invalid;
};

/// @param rows of all realizations of a surface with replicas, in any order   @param followed pairs
Replicas replicas_of(const Study& study, const ResultHeader& header, std::vector<ReplicaRow> rows,
                     const std::vector<ReplicaSeparation>& followed);

/// "moved by 1e-09 m", "step x 0.8", "single precision", "form two_corner"
std::string describe(const Replica& kind);

/// Lines for a terminal.
std::string replicas_text(const Replicas& replicas);
Json replicas_json(const Replicas& replicas);

/// The section of a result's page.
void replicas_section(const Replicas& replicas, PageWriter& writer);

/// `replicas.csv`: each cell and kind.
std::string replicas_csv(const Replicas& replicas);
/// `predictability.csv`: each cell and followed move.
std::string predictability_csv(const Replicas& replicas);

/// Predictability of the verdict, a map for each kind of replica.
void plot_discordance(const Replicas& replicas, const std::string& title, const std::filesystem::path& png);
/// Exponents and horizons. @throws InputError if no pair was followed
void plot_growth(const Replicas& replicas, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate
