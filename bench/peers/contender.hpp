#pragma once
/// Who takes part: an engine in one setting of its solver, with one dial that makes it more accurate and slower. Of the
/// others and of Stylobate's rigid blocks the dial is the time step; of its compliant contacts, whose error is that of
/// the compliance, it is K_N.

#include "bench/peers/column.hpp"

#include <array>
#include <optional>

namespace stylobate::peers {

/// The monolith in motion.
struct BlockRun {
    std::unique_ptr<World> world; ///< bodies: ground, monolith
    double step_s = 0;
    double ahead_steps = 0; ///< of its clock (`Engine::ahead_steps`)
};

struct Contender {
    std::string engine, version, planar, setting;
    bool own = false;          ///< Stylobate
    bool compliant = false;    ///< its dial is K_N
    bool first = true;         ///< the engine's customary setting
    std::vector<double> dials; ///< coarse to fine, each about 2^(-1/4) as fast as the one before
    double customary = 0;      ///< one of them
    std::function<double(double dial)> step_s;
    std::function<BlockRun(double dial, double lean_rad)> block; ///< leaned and let go, on ground at rest
    std::function<double(double dial)> quarter_period_s;
    std::function<double(double dial)> overturning_eta;
    std::function<Columns(double dial, bool shaken, double seconds)> columns;
};

/// An engine in all of its settings.
std::vector<Contender> contenders(const Engine& engine);

/// Stylobate in all contact forms, one thread, widest instruction set.
std::vector<Contender> own_contenders();

// Finds where each contender is as accurate as wanted, and times it there.

/// Both tests' errors must be as small as this, and columns must stand, at a dial and at the next four finer ones (a
/// factor of two): an error that passes through zero on its way is no accuracy.
inline constexpr std::array targets{0.01, 0.002};
inline constexpr std::size_t confirmed_by = 4;

/// Relative errors against the rigid block, of the two tests; NaN where a test has no result.
struct Errors {
    double dial = 0;
    double quarter_period = 0, overturning = 0;
    /// The larger of the two; infinity where one has no result.
    double worst() const;
};

/// A contender at one dial.
struct Timed {
    Errors errors;
    double step_s = 0;
    Columns shaken, resting;
    /// Every column has stayed where it was put, shaken and at rest: rigid ones neither lift off nor slip.
    bool stands() const { return shaken.moved == 0 && resting.moved == 0; }
};

struct Result {
    Contender contender;
    std::vector<Errors> scanned; ///< coarse to fine, as far as was needed
    Timed customary;
    /// The coarsest dial within each target from which on columns stand; none: there is none with this setting.
    std::array<std::optional<Timed>, targets.size()> reached;
};

/// @param seconds for each timing, about
/// @param patience_s a dial that takes longer than this and reaches nothing ends the scan
Result scan(const Contender& contender, double seconds, double patience_s);

/// The fastest at a target, of Stylobate or of the others; null: none.
const Result* fastest(const std::vector<Result>& results, bool own, std::size_t target);

} // namespace stylobate::peers
