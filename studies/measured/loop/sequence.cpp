#include "studies/measured/loop/sequence.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace stylobate {

namespace {

constexpr double shown_deviations = 2; // by the strongest size of a cause that counts as tested
constexpr double limit_level = 0.95;
constexpr int limit_steps = 200;  // of the sizes up to the strongest
constexpr double most_size = 1.5; // over the strongest that was simulated

/// Shares that sum to 1, none below the least. Those that would be are put there, the others shrink in proportion.
std::vector<double> with_floor(std::vector<double> shares, double least)
{
    const auto n = static_cast<double>(shares.size());
    least = std::min(least, 0.5 / n);
    double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares)
        share = sum > 0 ? share / sum : 1 / n;
    std::vector<bool> at_least(shares.size(), false);
    for (bool again = true; again;) {
        again = false;
        double held = 0, free = 0;
        for (std::size_t i = 0; i < shares.size(); ++i)
            (at_least[i] ? held : free) += at_least[i] ? least : shares[i];
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (!at_least[i] && shares[i] / free * (1 - held) < least)
                again = at_least[i] = true;
        if (!again)
            for (std::size_t i = 0; i < shares.size(); ++i)
                shares[i] = at_least[i] ? least : shares[i] / free * (1 - held);
    }
    return shares;
}

/// Places of the causes of each mechanism, in the order of the list.
std::vector<std::pair<std::string, std::vector<std::size_t>>> by_mechanism(const std::vector<CausePlace>& causes)
{
    std::vector<std::pair<std::string, std::vector<std::size_t>>> out;
    for (std::size_t i = 0; i < causes.size(); ++i) {
        const auto found =
            std::find_if(out.begin(), out.end(), [&](const auto& m) { return m.first == causes[i].mechanism; });
        if (found == out.end())
            out.push_back({causes[i].mechanism, {i}});
        else
            found->second.push_back(i);
    }
    return out;
}

void check_share(const PriorShare& share, const std::vector<CausePlace>& causes)
{
    if (!(share.weight >= 0) || !std::isfinite(share.weight))
        throw InputError(fmt::format("prior of the tests: the weight {} of {} is not a number of at least 0.",
                                     share.weight, share.of));
    const bool known = std::any_of(causes.begin(), causes.end(), [&](const CausePlace& c) {
        return (share.of == c.mechanism || share.of == cause_group(c.mechanism)) &&
               (!share.place || *share.place == c.place);
    });
    if (!known)
        throw InputError(fmt::format("prior of the tests: {}{} is no cause that was simulated.\n  Leave it out, or "
                                     "simulate it.",
                                     share.of, share.place ? " at " + *share.place : ""));
}

/// Estimates in used columns.
struct UsedEstimates {
    std::vector<Eigen::Index> columns;
    Eigen::VectorXd values;
};

UsedEstimates used_estimates(const Signatures& signatures, std::span<const SeenEstimate> seen)
{
    UsedEstimates out;
    std::vector<double> values;
    for (const SeenEstimate& estimate : seen)
        if (signatures.used[static_cast<std::size_t>(estimate.column)] && std::isfinite(estimate.value)) {
            out.columns.push_back(estimate.column);
            values.push_back(estimate.value);
        }
    out.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    return out;
}

/// Covariance of the estimates in healthy specimens, its root, and the whitened estimates.
struct HealthyEstimates {
    UsedEstimates used;
    Eigen::LLT<Eigen::MatrixXd> root;
    Eigen::VectorXd white;

    HealthyEstimates(const Signatures& s, std::span<const SeenEstimate> seen) : used(used_estimates(s, seen))
    {
        if (used.columns.empty())
            return;
        root.compute(s.covariance_of(used.columns));
        white = root.matrixL().solve(used.values - s.mean(used.columns));
    }
    /// The estimates along the shift of a size.
    struct Along {
        double estimates = 0, shift = 0; ///< from healthy specimens
        double sd = 1;                   ///< of specimens with that size
    };
    Along along(const ShiftOfSize& of, double size) const
    {
        const Eigen::VectorXd at = root.matrixL().solve(Eigen::VectorXd(of.shift(size)(used.columns)));
        const Eigen::VectorXd weight = root.matrixU().solve(at);
        // repeats on one specimen share what varies between specimens
        const Eigen::MatrixXd spread = of.spread(size)(used.columns, Eigen::all);
        const double variance = at.squaredNorm() + (spread.transpose() * weight).squaredNorm();
        return variance > 0 ? Along{at.dot(white), at.squaredNorm(), std::sqrt(variance)} : Along{};
    }
    double distance(const ShiftOfSize& of, double size) const
    {
        return root.matrixL().solve(Eigen::VectorXd(of.shift(size)(used.columns))).norm();
    }
};

/// The least size above which all are excluded up to the strongest. A size that half of the healthy specimens would not
/// exclude is not excluded: estimates that lie by chance on the far side of healthy ones show nothing (Cowan, Cranmer,
/// Gross and Vitells, "Power-constrained limits", arXiv:1105.3166 (2011)).
std::optional<double> limit_along(const HealthyEstimates& healthy, const ShiftOfSize& of)
{
    const double quantile = student_quantile(limit_level, estimate_freedom);
    const auto excluded = [&](double size) {
        const HealthyEstimates::Along a = healthy.along(of, size);
        return a.shift / a.sd >= quantile && (a.estimates - a.shift) / a.sd < -quantile;
    };
    const double last = of.sizes.back();
    if (!excluded(last))
        return std::nullopt;
    double out = last;
    for (int i = limit_steps - 1; i > 0; --i) {
        const double size = last * i / limit_steps;
        if (!excluded(size)) {
            double low = size, high = out; // the limit is between them
            for (int k = 0; k < 30; ++k)
                (excluded((low + high) / 2) ? high : low) = (low + high) / 2;
            return high;
        }
        out = size;
    }
    return out;
}

/// From what the other estimates of its kind let expect, but one of them. Nothing: there are no others.
std::optional<SeenDeviation> deviation_from_others(const Signatures& s, const UsedEstimates& used, std::size_t i,
                                                   const std::vector<std::size_t>& joints,
                                                   const std::optional<std::size_t>& but)
{
    const Eigen::Index column = used.columns[i];
    std::vector<Eigen::Index> places{column};
    std::vector<double> off;
    for (const std::size_t k : joints)
        if (used.columns[k] != column && k != but) {
            places.push_back(used.columns[k]);
            off.push_back(used.values(static_cast<Eigen::Index>(k)) - s.mean(used.columns[k]));
        }
    if (off.empty())
        return std::nullopt;
    const auto n = static_cast<Eigen::Index>(off.size());
    const Eigen::MatrixXd c = s.covariance_of(places);
    const Eigen::VectorXd weight = c.bottomRightCorner(n, n).llt().solve(c.col(0).tail(n));
    const double value = used.values(static_cast<Eigen::Index>(i));
    const double expected = s.mean(column) + weight.dot(Eigen::Map<const Eigen::VectorXd>(off.data(), n));
    return SeenDeviation{column, value, expected,
                         (value - expected) / std::sqrt(c(0, 0) - weight.dot(c.col(0).tail(n))), true};
}

/// Sum over the forms of a cause.
double shares_at(const Hypotheses& hypotheses, const std::vector<double>& shares, std::size_t cause)
{
    double sum = 0;
    for (std::size_t k = 0; k < shares.size(); ++k)
        if (hypotheses.causes[k].same_place(hypotheses.causes[cause]))
            sum += shares[k];
    return sum;
}

double entropy_of_share(double share)
{
    return share > 0 ? -share * std::log(share) : 0;
}

} // namespace

std::string cause_group(const std::string& mechanism)
{
    static const std::map<std::string, std::string> groups = {
        {"stribeck", "friction"},
        {"joint_friction", "friction"},
        {"friction_wear", "friction"},
        {"dowel", "friction"},
        {"corner_loss", "corners, centres and bonds"},
        {"eccentricity", "corners, centres and bonds"},
        {"wedge", "corners, centres and bonds"},
        {"adhesion", "corners, centres and bonds"},
        {"damping", "damping"},
        {"drag", "drag"},
    };
    const auto found = groups.find(mechanism);
    return found == groups.end() ? mechanism : found->second;
}

std::vector<double> prior_of(const std::vector<CausePlace>& causes, const SequencePrior& prior)
{
    const auto mechanisms = by_mechanism(causes);
    std::vector<double> of_mechanism(mechanisms.size(), 0), of_place(causes.size(), 0);
    double sum = 0;
    for (const PriorShare& share : prior.shares) {
        check_share(share, causes);
        sum += share.weight;
        std::vector<std::size_t> meant;
        for (std::size_t m = 0; m < mechanisms.size(); ++m)
            if (share.of == mechanisms[m].first || share.of == cause_group(mechanisms[m].first))
                meant.push_back(m);
        for (const std::size_t m : meant) {
            const double part = share.weight / static_cast<double>(meant.size());
            of_mechanism[m] += part;
            const auto& places = mechanisms[m].second;
            for (const std::size_t i : places)
                if (!share.place)
                    of_place[i] += part / static_cast<double>(places.size());
                else if (*share.place == causes[i].place)
                    of_place[i] += part;
        }
    }
    for (double& share : of_mechanism)
        share += std::max(0.0, 1 - sum) / static_cast<double>(mechanisms.size());
    of_mechanism = with_floor(of_mechanism, prior.least);
    std::vector<double> out(causes.size(), 0);
    for (std::size_t m = 0; m < mechanisms.size(); ++m) {
        std::vector<double> places;
        for (const std::size_t i : mechanisms[m].second)
            places.push_back(of_place[i]);
        places = with_floor(places, prior.least);
        for (std::size_t k = 0; k < places.size(); ++k)
            out[mechanisms[m].second[k]] = of_mechanism[m] * places[k];
    }
    return out;
}

SequenceModel::SequenceModel(Signatures its_signatures, SequencePrior its_prior)
    : signatures(std::move(its_signatures)), hypotheses(signatures), prior(std::move(its_prior)),
      causes(prior_of(hypotheses.causes, prior))
{
    const double listed = causes.empty() ? 0 : 1 - prior.unlisted;
    for (double& share : causes)
        share *= (1 - prior.nothing) * listed;
    for (const Hypothesis& h : hypotheses.each)
        hypothesis.push_back(
            h.share * (h.cause < 0 ? (1 - prior.nothing) * (1 - listed) : causes[static_cast<std::size_t>(h.cause)]));
}

double Belief::entropy() const
{
    double sum = entropy_of_share(nothing) + entropy_of_share(unlisted);
    for (const double share : causes)
        sum += entropy_of_share(share);
    return sum;
}

double Belief::at_place(const Hypotheses& hypotheses, std::size_t cause) const
{
    return shares_at(hypotheses, causes, cause);
}

Belief belief_from(const SequenceModel& model, const Eigen::VectorXd& log_ratios)
{
    Belief out;
    out.causes.assign(model.causes.size(), 0);
    const std::size_t n = model.hypothesis.size();
    std::vector<double> log_weight(n);
    double most = std::log(model.prior.nothing);
    for (std::size_t i = 0; i < n; ++i) {
        log_weight[i] =
            std::log(model.hypothesis[i]) + (log_ratios.size() > 0 ? log_ratios(static_cast<Eigen::Index>(i)) : 0.0);
        most = std::max(most, log_weight[i]);
    }
    double something = 0;
    for (const double weight : log_weight)
        something += std::exp(weight - most);
    const double all = something + std::exp(std::log(model.prior.nothing) - most);
    out.nothing = std::exp(std::log(model.prior.nothing) - most) / all;
    out.log_evidence = std::log(something) + most - std::log(1 - model.prior.nothing);
    for (std::size_t i = 0; i < n; ++i) {
        out.hypothesis.push_back(std::exp(log_weight[i] - most) / all);
        const int cause = model.hypotheses.each[i].cause;
        (cause < 0 ? out.unlisted : out.causes[static_cast<std::size_t>(cause)]) += out.hypothesis.back();
    }
    return out;
}

Belief belief_of(const SequenceModel& model, std::span<const SeenEstimate> seen)
{
    const UsedEstimates used = used_estimates(model.signatures, seen);
    if (used.columns.empty())
        return belief_from(model, {});
    const JointDensity density(model.signatures, model.hypotheses, used.columns);
    return belief_from(model, density.log_ratios(density.whitened(used.values)));
}

SequenceJudgement judgement_of(const SequenceModel& model, std::span<const SeenEstimate> seen)
{
    SequenceJudgement out;
    const UsedEstimates used = used_estimates(model.signatures, seen);
    if (used.columns.empty())
        return out;
    const JointDensity density(model.signatures, model.hypotheses, used.columns);
    const Eigen::VectorXd white = density.whitened(used.values);
    const Belief belief = belief_from(model, density.log_ratios(white));
    out.log_evidence = belief.log_evidence;
    const bool strong = out.log_evidence >= std::log(evidence_to_name);
    double of_form = 0;
    for (std::size_t i = 0; i < belief.causes.size(); ++i) {
        const double share = shares_at(model.hypotheses, belief.causes, i),
                     before = shares_at(model.hypotheses, model.causes, i);
        // those for which the tests speak, more than for nothing
        const bool spoken_for = share * model.prior.nothing > belief.nothing * before * (1 + 1e-9);
        if (spoken_for && (share > out.share || (share == out.share && belief.causes[i] > of_form))) {
            out.cause = model.hypotheses.causes[i];
            out.share = share;
            of_form = belief.causes[i];
        }
    }
    std::size_t likeliest = 0, farthest = 0;
    double most = 0, off = 0, sum = 0;
    for (std::size_t i = 0; i < model.hypotheses.each.size(); ++i) {
        const Hypothesis& h = model.hypotheses.each[i];
        if (h.cause < 0 && belief.hypothesis[i] > off) {
            off = belief.hypothesis[i];
            farthest = i;
        }
        if (h.cause < 0 || !(model.hypotheses.causes[static_cast<std::size_t>(h.cause)] == out.cause))
            continue;
        sum += belief.hypothesis[i];
        out.size += belief.hypothesis[i] * h.size;
        if (density.shows(i) && belief.hypothesis[i] > most) {
            most = belief.hypothesis[i];
            likeliest = i;
        }
    }
    out.size = sum > 0 ? out.size / sum : 0;
    if (most > 0) {
        const Eigen::VectorXd along = density.whitened_shift(model.hypotheses.each[likeliest].shift);
        out.deviations = along.norm() > 0 ? along.dot(white) / along.norm() : 0;
    }
    if (strong && out.cause && out.share >= belief_to_name)
        out.verdict = SequenceVerdict::named;
    else if (strong && belief.unlisted >= belief_to_name) {
        out.verdict = SequenceVerdict::unexplained;
        out.off = model.hypotheses.each[farthest].unlisted;
    } else if (!strong && out.deviations < least_doubtful && belief.unlisted < belief.nothing)
        out.verdict = SequenceVerdict::none;
    out.doubtful = out.verdict == SequenceVerdict::open && out.deviations < most_doubtful;
    return out;
}

std::optional<SizeInterval> size_of(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                    const CausePlace& cause, double level)
{
    const UsedEstimates used = used_estimates(model.signatures, seen);
    std::vector<std::pair<double, double>> sizes; // size, logarithm of its density
    for (const ShiftOfSize& of : shifts_of(model.signatures, cause)) {
        if (of.at.back()->shift(used.columns).squaredNorm() == 0)
            continue;
        const double last = most_size * of.sizes.back();
        for (int i = 0; i < limit_steps; ++i) {
            const double size = last * (i + 0.5) / limit_steps;
            const Eigen::MatrixXd spread = of.spread(size)(used.columns, Eigen::all); // repeats share it
            const Eigen::LLT<Eigen::MatrixXd> root(model.signatures.covariance_of(used.columns) +
                                                   spread * spread.transpose());
            const Eigen::VectorXd white =
                root.matrixL().solve(used.values - (model.signatures.mean + of.shift(size))(used.columns));
            const double log_density =
                -root.matrixLLT().diagonal().array().log().sum() - surprise(white.squaredNorm(), white.size());
            sizes.emplace_back(size, log_density + std::log(std::fabs(last) / limit_steps));
        }
    }
    if (sizes.empty())
        return std::nullopt;
    std::sort(sizes.begin(), sizes.end());
    double most = -HUGE_VAL, all = 0;
    for (const auto& [size, weight] : sizes)
        most = std::max(most, weight);
    for (auto& [size, weight] : sizes)
        all += weight = std::exp(weight - most);
    SizeInterval out{0, sizes.front().first, sizes.back().first};
    double below = 0;
    for (const auto& [size, weight] : sizes) {
        out.mean += size * weight / all;
        const double after = below + weight / all;
        if (below < (1 - level) / 2 && after >= (1 - level) / 2)
            out.low = size;
        if (below < (1 + level) / 2 && after >= (1 + level) / 2)
            out.high = size;
        below = after;
    }
    return out;
}

SequenceModel given(const SequenceModel& model, const CausePlace& cause, const SizeInterval& sizes)
{
    constexpr double half_width90 = 1.6449; // of a normal interval, in standard deviations
    Signatures s = model.signatures;
    for (const ShiftOfSize& of : shifts_of(model.signatures, cause))
        if (of.sizes.front() * sizes.mean > 0) {
            const Eigen::MatrixXd spread = of.spread(sizes.mean);
            const Eigen::VectorXd of_size = (of.shift(sizes.high) - of.shift(sizes.low)) / (2 * half_width90);
            s.mean += of.shift(sizes.mean);
            s.covariance += spread * spread.transpose() + of_size * of_size.transpose();
        }
    std::erase_if(s.causes, [&](const CauseSignature& c) {
        return cause.place == "all" || c.cause.place == cause.place || c.cause.place == "all";
    });
    SequencePrior prior = model.prior;
    prior.shares.clear(); // what the first diagnosis believed was of one cause
    return {std::move(s), std::move(prior)};
}

std::vector<SizeLimit> limits_of(const SequenceModel& model, std::span<const SeenEstimate> seen)
{
    std::vector<SizeLimit> out;
    const HealthyEstimates healthy(model.signatures, seen);
    if (healthy.used.columns.empty())
        return out;
    for (const CausePlace& cause : model.hypotheses.causes)
        for (const ShiftOfSize& of : shifts_of(model.signatures, cause)) {
            if (healthy.distance(of, of.sizes.back()) < shown_deviations)
                continue;
            SizeLimit limit;
            limit.cause = cause;
            limit.unit = of.at.back()->cause.unit;
            limit.below_neutral = of.sizes.back() < 0;
            limit.strongest = of.sizes.back();
            limit.size = limit_along(healthy, of);
            out.push_back(std::move(limit));
        }
    return out;
}

std::vector<SeenDeviation> deviations_of(const Signatures& s, std::span<const SeenEstimate> seen)
{
    const UsedEstimates used = used_estimates(s, seen);
    std::vector<SeenDeviation> out(used.columns.size());
    for (const std::vector<Eigen::Index>& group : s.alike) {
        std::vector<std::size_t> joints;
        for (std::size_t i = 0; i < used.columns.size(); ++i)
            if (std::find(group.begin(), group.end(), used.columns[i]) != group.end())
                joints.push_back(i);
        // the joint that is farthest off expects nothing of the others, where there are enough of them
        std::optional<std::size_t> farthest;
        double most = 0;
        for (const std::size_t i : joints)
            if (const auto d = deviation_from_others(s, used, i, joints, {});
                d && joints.size() > 2 && std::fabs(d->deviations) > most) {
                most = std::fabs(d->deviations);
                farthest = i;
            }
        for (const std::size_t i : joints) {
            const Eigen::Index column = used.columns[i];
            const double value = used.values(static_cast<Eigen::Index>(i)),
                         sd = std::sqrt(s.covariance_of({column})(0, 0));
            out[i] = {column, value, s.mean(column), (value - s.mean(column)) / sd, false};
            const auto others = deviation_from_others(s, used, i, joints, i == farthest ? std::nullopt : farthest);
            if (others && std::fabs(others->deviations) > std::fabs(out[i].deviations))
                out[i] = *others;
        }
    }
    return out;
}

} // namespace stylobate
