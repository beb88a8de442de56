#include "studies/measured/diagnosis/evidence/law_samples.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

// A block whose vertical acceleration is beyond this part of gravity is thrown up or hit,
constexpr double most_lift = 0.5;
// as far as it can be seen: by smoothing that leaves less noise than this part of gravity.
constexpr double least_seen = 0.12;
// A combination counts as free of unknowns below this part of the law's own size.
constexpr double cancelled = 1e-9;

/// What a joint does at one sample: kinematics of its contact.
struct JointMotion {
    double rotation = 0; ///< upper - lower
    double slip = 0;     ///< velocity
    double corner_x = 0, corner_y = 0;
    double face = 0;  ///< direction of the face that is touched [rad]
    int sliding = 0;  ///< sign, 0: sticks
    int rocking = 0;  ///< sign of the rotation, 0: closed
    double width = 0; ///< half width of the narrower face
};

class Balance {
public:
    /// @param before the run; the run's own are added
    Balance(const Specimen& specimen, const CampaignScales& scales, const SmoothedRun& track, double friction,
            JointPath& before)
        : s_(specimen), scales_(scales), track_(track), friction_(friction), weights_(rest_weights(specimen))
    {
        for (std::size_t i = 0; i < track.samples(); ++i) {
            std::vector<JointMotion> joints;
            for (const auto& [lower, upper] : s_.joints)
                joints.push_back(motion(lower, upper, i));
            motion_.push_back(std::move(joints));
        }
        find_stretches();
        sum_paths(before);
        find_hops();
    }

    std::vector<LawSample> samples(int run) const
    {
        std::vector<LawSample> found;
        const std::size_t n = track_.samples();
        // The widest windows first: they see best. What they cover is not looked at again.
        std::vector<std::vector<char>> covered(s_.joints.size() * 2, std::vector<char>(n, 0));
        for (int w = static_cast<int>(scales_.widths.size()) - 1; w >= 0; --w) {
            const auto half = static_cast<std::size_t>(scales_.widths[static_cast<std::size_t>(w)].half_width());
            const std::vector<char> some = long_enough(half);
            for (std::size_t i = half; i + half < n; ++i) {
                if (!some[i])
                    continue;
                const std::vector<LawTerm> laws = laws_of(i, half, covered);
                if (laws.empty())
                    continue;
                const std::size_t before = found.size();
                balance(laws, w, i, run, found);
                // what gave no sample, because too many forces stayed unknown, may give one a little later
                for (std::size_t f = before; f < found.size(); ++f)
                    for (const LawTerm& law : found[f].terms)
                        for (std::size_t k = i - half / 2; k <= i + half / 2; ++k)
                            covered[slot(law.joint, law.law)][k] = 1;
            }
        }
        std::sort(found.begin(), found.end(),
                  [](const LawSample& a, const LawSample& b) { return a.time_s < b.time_s; });
        return found;
    }

private:
    static std::size_t slot(int joint, Law law)
    {
        return 2 * static_cast<std::size_t>(joint) + (law == Law::rocking ? 1 : 0);
    }

    JointMotion motion(int lower, int upper, std::size_t i) const
    {
        const auto u = static_cast<std::size_t>(upper);
        const double xu = track_.now(0, in_x, upper, i), yu = track_.now(0, in_y, upper, i);
        const double tu = track_.now(0, in_theta, upper, i), wu = track_.now(1, in_theta, upper, i);
        const double bu = s_.half_width_m[u], hu = s_.half_height_m[u];
        double xl, yl, tl = 0, wl = 0, vxl, vyl = 0, bl, hl;
        if (lower >= 0) {
            const auto l = static_cast<std::size_t>(lower);
            xl = track_.now(0, in_x, lower, i);
            yl = track_.now(0, in_y, lower, i);
            tl = track_.now(0, in_theta, lower, i);
            wl = track_.now(1, in_theta, lower, i);
            vxl = track_.now(1, in_x, lower, i);
            vyl = track_.now(1, in_y, lower, i);
            bl = s_.half_width_m[l];
            hl = s_.half_height_m[l];
        } else {
            xl = track_.base(0, i);
            vxl = track_.base(1, i);
            hl = 1;
            yl = s_.base_block_top_m - hl;
            // where the base is not known to be, its corners are not: the upper block's own is taken
            bl = track_.has_base() ? s_.base_block_half_width_m.value_or(endless_m) : endless_m;
        }
        JointMotion m;
        m.width = std::min(bu, bl);
        m.rotation = tu - tl;
        const double side = m.rotation >= 0 ? -1 : 1; // of the corner on which the upper block turns
        const double cu = std::cos(tu), su = std::sin(tu), cl = std::cos(tl), sl = std::sin(tl);
        // the upper block's corner lies on the lower one's face, or the lower one's on the upper one's
        double px = xu + side * bu * cu + hu * su, py = yu + side * bu * su - hu * cu;
        m.face = tl;
        if (std::fabs((px - xl) * cl + (py - yl) * sl) > bl) {
            px = xl + side * bl * cl - hl * sl;
            py = yl + side * bl * sl + hl * cl;
            m.face = tu;
        }
        m.corner_x = px;
        m.corner_y = py;
        // of closed faces any point will do: the middle
        const double open = std::min(1.0, 3 * std::fabs(m.rotation) / scales_.rotation_rad);
        const double cx = xu + hu * su + open * (px - xu - hu * su);
        const double cy = yu - hu * cu + open * (py - yu + hu * cu);
        const double vx = track_.now(1, in_x, upper, i) - wu * (cy - yu) - (vxl - wl * (cy - yl));
        const double vy = track_.now(1, in_y, upper, i) + wu * (cx - xu) - (vyl + wl * (cx - xl));
        m.slip = vx * std::cos(m.face) + vy * std::sin(m.face);
        if (lower >= 0 || track_.has_base())
            m.sliding = std::fabs(m.slip) > scales_.slip_m_s ? (m.slip > 0 ? 1 : -1) : 0;
        m.rocking = std::fabs(m.rotation) > scales_.rotation_rad ? (m.rotation > 0 ? 1 : -1) : 0;
        return m;
    }

    int state(std::size_t joint, Law law, std::size_t i) const
    {
        return law == Law::sliding ? motion_[i][joint].sliding : motion_[i][joint].rocking;
    }

    void find_stretches()
    {
        const std::size_t n = motion_.size();
        for (std::size_t j = 0; j < s_.joints.size(); ++j)
            for (const Law law : {Law::sliding, Law::rocking}) { // in the order of `slot`
                Stretches same{std::vector<std::size_t>(n), std::vector<std::size_t>(n, n)};
                for (std::size_t i = 0; i < n; ++i)
                    same.begin[i] = i > 0 && state(j, law, i) == state(j, law, i - 1) ? same.begin[i - 1] : i;
                for (std::size_t i = n; i-- > 1;)
                    same.end[i - 1] = state(j, law, i) == state(j, law, i - 1) ? same.end[i] : i;
                same_.push_back(std::move(same));
            }
    }

    void sum_paths(JointPath& before)
    {
        const std::size_t joints = s_.joints.size();
        std::vector<LawTerm> sums(joints);
        before.slip_m.resize(joints, 0);
        before.rotation_rad.resize(joints, 0);
        for (std::size_t j = 0; j < joints; ++j) {
            sums[j].slip_before_m = before.slip_m[j];
            sums[j].rotation_before_rad = before.rotation_rad[j];
        }
        const double forget = std::exp(-scales_.spacing_s / scales_.time_s);
        for (std::size_t i = 0; i < motion_.size(); ++i) {
            for (std::size_t j = 0; j < joints; ++j) {
                const JointMotion& m = motion_[i][j];
                const double moved = m.sliding == 0 ? 0 : m.slip * scales_.spacing_s;
                sums[j].slip_m += moved;
                sums[j].slip_path_m += std::fabs(moved);
                sums[j].recent_slip_m = forget * sums[j].recent_slip_m + std::fabs(moved);
                if (i > 0 && (m.rocking != 0 || motion_[i - 1][j].rocking != 0))
                    sums[j].rotation_path_rad += std::fabs(m.rotation - motion_[i - 1][j].rotation);
            }
            paths_.push_back(sums);
        }
        for (std::size_t j = 0; j < joints; ++j) {
            before.slip_m[j] += sums[j].slip_path_m;
            before.rotation_rad[j] += sums[j].rotation_path_rad;
        }
    }

    /// Of each sample, the stretch [begin, end) in which a joint does what it does there.
    struct Stretches {
        std::vector<std::size_t> begin, end;
    };

    /// Samples to either side of the middle of a window in which a law must hold: velocities are known to the width of
    /// their own smoothing.
    std::size_t margin_of(Law law, std::size_t half) const
    {
        return half + static_cast<std::size_t>(scales_.rates.half_width()) / (law == Law::rocking ? 2 : 1);
    }

    /// (samples) 1 where some joint does the same thing for long enough: only there `laws_of` can find anything.
    std::vector<char> long_enough(std::size_t half) const
    {
        const std::size_t n = motion_.size();
        std::vector<char> some(n, 0);
        for (std::size_t j = 0; j < s_.joints.size(); ++j)
            for (const Law law : {Law::sliding, Law::rocking}) {
                const std::vector<std::size_t>& end = same_[slot(static_cast<int>(j), law)].end;
                const std::size_t margin = margin_of(law, half);
                for (std::size_t i = 0; i < n; i = end[i])
                    if (state(j, law, i) != 0 && end[i] > i + 2 * margin)
                        std::fill(some.begin() + static_cast<std::ptrdiff_t>(i + margin),
                                  some.begin() + static_cast<std::ptrdiff_t>(end[i] - margin), 1);
            }
        return some;
    }

    /// Whether a joint does the same thing all through a window.
    bool steady(std::size_t joint, Law law, std::size_t i, std::size_t half) const
    {
        const std::size_t margin = margin_of(law, half);
        if (!track_.usable(i, static_cast<int>(margin)))
            return false;
        if (state(joint, law, i) == 0)
            return false;
        const Stretches& same = same_[slot(static_cast<int>(joint), law)];
        if (same.begin[i] > i - margin || same.end[i] <= i + margin)
            return false;
        return law == Law::rocking || !hops(s_.joints[joint].second, i, half);
    }

    /// Whether a block is thrown up or hit in a window: it then touches what it slides on now and again, and what it
    /// does while it touches is not what the smoothed velocities show.
    bool hops(int block, std::size_t i, std::size_t half) const
    {
        if (hopping_.empty())
            return false;
        const std::vector<int>& before = hopping_[static_cast<std::size_t>(block)];
        return before[i + half + 1] != before[i - half];
    }

    void find_hops()
    {
        const double enough = least_seen * s_.gravity_m_s2;
        int width = 0;
        while (width < static_cast<int>(scales_.widths.size()) &&
               scales_.noise_m * scales_.widths[static_cast<std::size_t>(width)].noise(2) > enough)
            ++width;
        if (width == static_cast<int>(scales_.widths.size()))
            return;
        for (int b = 0; b < s_.blocks(); ++b) {
            std::vector<int> before(track_.samples() + 1, 0);
            const std::vector<double> lift = track_.all_of(width, 2, in_y, b);
            for (std::size_t i = 0; i < lift.size(); ++i)
                before[i + 1] = before[i] + (std::fabs(lift[i]) > most_lift * s_.gravity_m_s2 ? 1 : 0);
            hopping_.push_back(std::move(before));
        }
    }

    std::vector<LawTerm> laws_of(std::size_t i, std::size_t half, const std::vector<std::vector<char>>& covered) const
    {
        std::vector<LawTerm> laws;
        for (std::size_t j = 0; j < s_.joints.size(); ++j)
            for (const Law law : {Law::sliding, Law::rocking}) {
                const auto& used = covered[slot(static_cast<int>(j), law)];
                if (used[i - half / 2] || used[i] || used[i + half / 2] || !steady(j, law, i, half))
                    continue;
                const JointMotion& m = motion_[i][j];
                LawTerm term = paths_[i][j];
                term.law = law;
                term.joint = static_cast<int>(j);
                term.sign = law == Law::sliding ? m.sliding : m.rocking;
                term.half_width_m = m.width;
                term.rest_weight_n = weights_[j];
                term.slip_m_s = m.slip;
                term.rotation_rad = m.rotation;
                laws.push_back(term);
            }
        return laws;
    }

    /// Newton's law of all blocks at a sample: matrix x unknowns = inertia. The unknowns are of each joint the force x,
    /// the force y on the upper block and the moment about its corner.
    struct Newton {
        Eigen::MatrixXd matrix;            ///< (3 blocks x 3 joints)
        Eigen::VectorXd inertia;           ///< (3 blocks)
        std::array<BlockValues, 3> motion; ///< displacements, velocities, accelerations
    };

    Newton newton_at(int width, std::size_t i) const
    {
        const Eigen::Index blocks = s_.blocks(), joints = static_cast<Eigen::Index>(s_.joints.size());
        const auto at = [&](int d, Component c, Eigen::Index b) {
            return track_.of(width, d, c, static_cast<int>(b), i);
        };
        Newton n{Eigen::MatrixXd::Zero(3 * blocks, 3 * joints), Eigen::VectorXd(3 * blocks), {}};
        for (Eigen::Index b = 0; b < blocks; ++b) {
            const auto k = static_cast<std::size_t>(b);
            const double m = s_.mass_kg[k];
            n.inertia.segment<3>(3 * b) << m * at(2, in_x, b), m * (at(2, in_y, b) + s_.gravity_m_s2),
                m * (std::pow(s_.half_width_m[k], 2) + std::pow(s_.half_height_m[k], 2)) / 3 * at(2, in_theta, b);
            for (int d = 0; d < 3; ++d)
                for (const Component c : {in_x, in_y, in_theta})
                    n.motion[static_cast<std::size_t>(d)][c].push_back(at(d, c, b));
        }
        for (Eigen::Index j = 0; j < joints; ++j) {
            const JointMotion& m = motion_[i][static_cast<std::size_t>(j)];
            const auto [lower, upper] = s_.joints[static_cast<std::size_t>(j)];
            for (const auto& [block, sign] : {std::pair{upper, 1.0}, {lower, -1.0}}) {
                if (block < 0)
                    continue;
                const Eigen::Index row = 3 * block;
                const double arm_x = m.corner_x - at(0, in_x, block), arm_y = m.corner_y - at(0, in_y, block);
                n.matrix(row, 3 * j) = n.matrix(row + 1, 3 * j + 1) = n.matrix(row + 2, 3 * j + 2) = sign;
                n.matrix(row + 2, 3 * j) = -sign * arm_y;
                n.matrix(row + 2, 3 * j + 1) = sign * arm_x;
            }
        }
        return n;
    }

    /// (laws x 3 joints) of the unknowns, over the weight that the joint carries at rest.
    Eigen::MatrixXd law_rows(const std::vector<LawTerm>& laws, std::size_t i) const
    {
        const Eigen::Index count = static_cast<Eigen::Index>(laws.size());
        Eigen::MatrixXd law = Eigen::MatrixXd::Zero(count, 3 * static_cast<Eigen::Index>(s_.joints.size()));
        for (Eigen::Index l = 0; l < count; ++l) {
            const LawTerm& t = laws[static_cast<std::size_t>(l)];
            const JointMotion& m = motion_[i][static_cast<std::size_t>(t.joint)];
            const double c = std::cos(m.face), s = std::sin(m.face);
            const double per = 1 / t.rest_weight_n;
            if (t.law == Law::sliding)
                law.block<1, 2>(l, 3 * t.joint) << per * (-t.sign * c + friction_ * s),
                    per * (-t.sign * s - friction_ * c);
            else
                law(l, 3 * t.joint + 2) = per * t.sign / t.half_width_m;
        }
        return law;
    }

    /// (combinations x laws) that leave nothing of the unknowns; of a column every law by itself.
    /// @param left of the unknowns by every law
    static Eigen::MatrixXd cancelling(const Eigen::MatrixXd& left, const Eigen::MatrixXd& law,
                                      const Eigen::VectorXd& unknown)
    {
        const Eigen::Index count = law.rows();
        if (left.cwiseAbs().maxCoeff() < cancelled * (law * unknown.asDiagonal()).cwiseAbs().maxCoeff())
            return Eigen::MatrixXd::Identity(count, count);
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(left, Eigen::ComputeFullU);
        const double scale = (law * unknown.asDiagonal()).norm();
        Eigen::Index rank = 0;
        while (rank < svd.singularValues().size() && svd.singularValues()(rank) > 1e-6 * scale)
            ++rank;
        return svd.matrixU().rightCols(count - rank).transpose();
    }

    /// Standard deviation of a combination of the blocks' inertia, from the noise of the cameras.
    double sd_of(const Eigen::RowVectorXd& v, int width) const
    {
        const double noise = scales_.widths[static_cast<std::size_t>(width)].noise(2);
        double variance = 0;
        for (Eigen::Index b = 0; b < s_.blocks(); ++b) {
            const double m = s_.mass_kg[static_cast<std::size_t>(b)];
            const double moment = inertia_of(b) * v(3 * b + 2);
            variance += std::pow(noise, 2) *
                        (std::pow(scales_.noise_m * m, 2) * (v(3 * b) * v(3 * b) + v(3 * b + 1) * v(3 * b + 1)) +
                         std::pow(scales_.noise_rad * moment, 2));
        }
        return std::sqrt(variance);
    }

    /// The laws of a combination with their weights and normal forces; none if one of its joints carries too little.
    /// @param carried (3 joints) the unknowns
    std::vector<LawTerm> terms_of(const std::vector<LawTerm>& laws, const Eigen::RowVectorXd& u,
                                  const Eigen::VectorXd& carried, std::size_t i) const
    {
        std::vector<LawTerm> terms;
        for (Eigen::Index l = 0; l < u.size(); ++l) {
            if (std::fabs(u(l)) < 1e-6)
                continue;
            LawTerm term = laws[static_cast<std::size_t>(l)];
            const JointMotion& m = motion_[i][static_cast<std::size_t>(term.joint)];
            term.weight = u(l);
            term.normal =
                (carried(3 * term.joint + 1) * std::cos(m.face) - carried(3 * term.joint) * std::sin(m.face)) /
                term.rest_weight_n;
            if (!(term.normal > least_normal))
                return {};
            terms.push_back(term);
        }
        return terms;
    }

    /// The combinations of these laws in which the joints' unknown forces cancel.
    void balance(const std::vector<LawTerm>& laws, int width, std::size_t i, int run,
                 std::vector<LawSample>& found) const
    {
        const Newton newton = newton_at(width, i);
        const Eigen::MatrixXd law = law_rows(laws, i);
        // moments in lengths of the order of the blocks: the pseudo-inverse then knows no units
        const double length = s_.half_width_m.front();
        Eigen::VectorXd equation(newton.matrix.rows()), unknown(newton.matrix.cols());
        for (Eigen::Index k = 0; k < equation.size(); ++k)
            equation(k) = k % 3 == 2 ? 1 / length : 1;
        for (Eigen::Index k = 0; k < unknown.size(); ++k)
            unknown(k) = k % 3 == 2 ? length : 1;
        const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(equation.asDiagonal() * newton.matrix *
                                                                             unknown.asDiagonal());
        const Eigen::MatrixXd inverse = unknown.asDiagonal() * solver.pseudoInverse() * equation.asDiagonal();
        const Eigen::VectorXd carried = inverse * newton.inertia;
        const Eigen::MatrixXd by_newton = law * inverse; // (laws x 3 blocks)
        const Eigen::MatrixXd left = (law - by_newton * newton.matrix) * unknown.asDiagonal();
        const Eigen::MatrixXd combinations = cancelling(left, law, unknown);
        for (Eigen::Index r = 0; r < combinations.rows(); ++r) {
            const Eigen::RowVectorXd u = combinations.row(r);
            const Eigen::RowVectorXd v = u * by_newton;
            LawSample sample;
            sample.run = run;
            sample.time_s = track_.time_s(i);
            sample.value = v.dot(newton.inertia);
            sample.sd = sd_of(v, width);
            sample.terms = terms_of(laws, u, carried, i);
            if (sample.terms.empty())
                continue;
            sample.coefficients.assign(v.data(), v.data() + v.size());
            sample.motion = newton.motion;
            found.push_back(std::move(sample));
        }
    }

    double inertia_of(Eigen::Index b) const
    {
        const auto k = static_cast<std::size_t>(b);
        return s_.mass_kg[k] * (std::pow(s_.half_width_m[k], 2) + std::pow(s_.half_height_m[k], 2)) / 3;
    }

    const Specimen& s_;
    const CampaignScales& scales_;
    const SmoothedRun& track_;
    double friction_;
    std::vector<double> weights_;
    std::vector<std::vector<JointMotion>> motion_; ///< [sample][joint]
    std::vector<Stretches> same_;                  ///< (slots)
    std::vector<std::vector<LawTerm>> paths_;      ///< [sample][joint]: slip and rotation so far
    std::vector<std::vector<int>> hopping_;        ///< [block][n + 1] samples before in which it hops
};

} // namespace

double nominal_friction(const Specimen& specimen)
{
    return specimen.friction_nominal.value_or(0.7);
}

std::vector<double> rest_weights(const Specimen& specimen)
{
    // from the top: each block hands its load on to its joints in equal parts
    std::vector<std::size_t> order(specimen.mass_kg.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return specimen.rest_y_m[a] > specimen.rest_y_m[b]; });
    std::vector<double> load(order.size()), weights(specimen.joints.size(), 0);
    for (const std::size_t block : order) {
        load[block] += specimen.mass_kg[block] * specimen.gravity_m_s2;
        std::vector<std::size_t> under;
        for (std::size_t j = 0; j < specimen.joints.size(); ++j)
            if (specimen.joints[j].second == static_cast<int>(block))
                under.push_back(j);
        for (const std::size_t j : under) {
            weights[j] = load[block] / static_cast<double>(under.size());
            if (specimen.joints[j].first >= 0)
                load[static_cast<std::size_t>(specimen.joints[j].first)] += weights[j];
        }
    }
    return weights;
}

std::vector<std::vector<LawSample>> law_samples(const Campaign& campaign, const CampaignScales& scales,
                                                const std::vector<std::vector<double>>& base_m, double friction)
{
    std::vector<std::size_t> order(campaign.runs.size());
    for (std::size_t r = 0; r < order.size(); ++r)
        order[r] = r;
    const auto place = [&](std::size_t r) { return campaign.runs[r].run_order.value_or(static_cast<int>(r)); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    JointPath before;
    std::vector<std::vector<LawSample>> samples(order.size());
    for (const std::size_t r : order) {
        const SmoothedRun track(campaign.specimen, campaign.runs[r], scales, base_m[r]);
        samples[r] = Balance(campaign.specimen, scales, track, friction, before).samples(static_cast<int>(r));
    }
    return samples;
}

} // namespace stylobate
