#pragma once
/// The columns that are timed: the small-scale specimen (7 drums, the lowest one fixed) for 10 s, under a harmonic of
/// 5 Hz and 2.15 m/s2 or at rest, each drum off its axis by a draw of 1e-6 m.

#include "bench/peers/engine.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"

namespace stylobate::peers {

inline constexpr double column_seconds = 10;
inline constexpr int most_columns = 64;

/// The study of such columns, from which every engine gets the same realizations.
Study column_study(bool shaken, double normal_stiffness_n_m2 = 1e8);

/// How columns fared. Rigid ones neither lift off, which takes g B / H = 2.706 m/s2, nor slip: statics without a
/// choice. So any that moves is an error of the engine, or of a compliant contact.
struct Columns {
    int count = 0;
    int collapsed = 0; ///< a drum below .6 of its height, as the study says
    int moved = 0;     ///< the top drum is at the end off its place by more than 1 % of its width, or has fallen
    /// On one core: the best of several timings of every simulated second, and 10 such seconds for each realization,
    /// even where one ends sooner.
    double realizations_per_second = 0;
};

/// The blocks of a realization as bodies, each with the friction of the bed under it. A base that is out of level is a
/// change of gravity: the scene has the part across the base.
Scene scene_of(const Study& study, const Realization& realization);

/// The acceleration of a level ground that pulls as the part of gravity along this realization's base does [m/s2], to
/// be added to that of its motion.
double leaning_acceleration(const Realization& realization);

/// Whether a drum is below the part of its height at which the study calls the column collapsed, or nowhere.
bool has_fallen(const World& world, const Scene& scene, const Study& study);

/// Time that this process has had of the processor [s]: neighbours on a shared machine do not count.
double processor_seconds();

/// @param seconds about as long it takes; 3 columns at the least, 64 at the most
Columns run_columns(const Engine& engine, std::size_t setting, double step_s, bool shaken, double seconds);

} // namespace stylobate::peers
