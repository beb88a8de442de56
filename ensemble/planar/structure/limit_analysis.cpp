#include "ensemble/planar/structure/limit_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stylobate {

namespace {

using Real = long double;
constexpr Real nothing = 1e-13L; // of pivots and costs: the rows are scaled to about 1

/// The tableau of a basis: rows of [A | b], and the costs below.
class Tableau {
public:
    Tableau(std::vector<Real> a, std::vector<Real> b, std::size_t columns)
        : rows_(b.size()), columns_(columns), a_(std::move(a)), b_(std::move(b)), basis_(rows_, columns)
    {
    }
    std::size_t rows() const { return rows_; }
    Real& at(std::size_t row, std::size_t column) { return a_[row * columns_ + column]; }
    Real& right(std::size_t row) { return b_[row]; }
    std::size_t& basis(std::size_t row) { return basis_[row]; }

    void pivot(std::size_t row, std::size_t column)
    {
        const Real scale = 1 / at(row, column);
        for (std::size_t k = 0; k < columns_; ++k)
            at(row, k) *= scale;
        b_[row] *= scale;
        for (std::size_t i = 0; i < rows_; ++i) {
            const Real factor = at(i, column);
            if (i == row || factor == 0)
                continue;
            for (std::size_t k = 0; k < columns_; ++k)
                at(i, k) -= factor * at(row, k);
            b_[i] -= factor * b_[row];
        }
        basis_[row] = column;
    }

    /// Walks to the maximum of c x over the columns below `allowed`.
    void maximise(const std::vector<Real>& c, std::size_t allowed)
    {
        for (;;) {
            std::size_t enters = allowed;
            for (std::size_t k = 0; k < allowed && enters == allowed; ++k) {
                Real gain = c[k];
                for (std::size_t i = 0; i < rows_; ++i)
                    gain -= c[basis_[i]] * at(i, k);
                if (gain > nothing)
                    enters = k;
            }
            if (enters == allowed)
                return;
            std::size_t leaves = rows_;
            Real least = std::numeric_limits<Real>::infinity();
            for (std::size_t i = 0; i < rows_; ++i) {
                if (at(i, enters) <= nothing)
                    continue;
                const Real ratio = b_[i] / at(i, enters);
                if (leaves == rows_ || ratio < least - nothing ||
                    (ratio <= least + nothing && basis_[i] < basis_[leaves])) {
                    leaves = i;
                    least = ratio;
                }
            }
            if (leaves == rows_)
                throw std::runtime_error("the linear programme has no bound");
            pivot(leaves, enters);
        }
    }

private:
    std::size_t rows_, columns_;
    std::vector<Real> a_, b_;
    std::vector<std::size_t> basis_;
};

} // namespace

std::vector<Real> maximise(std::vector<Real> a, std::vector<Real> b, const std::vector<Real>& c)
{
    const std::size_t rows = b.size(), columns = c.size(), all = columns + rows;
    // phase one: an artificial unknown in each row, driven out
    std::vector<Real> wide(rows * all, 0);
    for (std::size_t i = 0; i < rows; ++i) {
        Real scale = 0;
        for (std::size_t k = 0; k < columns; ++k)
            scale = std::max(scale, std::fabs(a[i * columns + k]));
        scale = (b[i] < 0 ? -1 : 1) / scale;
        for (std::size_t k = 0; k < columns; ++k)
            wide[i * all + k] = scale * a[i * columns + k];
        b[i] *= scale;
        wide[i * all + columns + i] = 1;
    }
    Tableau tableau(std::move(wide), std::move(b), all);
    for (std::size_t i = 0; i < rows; ++i)
        tableau.basis(i) = columns + i;
    std::vector<Real> artificial(all, 0);
    std::fill(artificial.begin() + static_cast<std::ptrdiff_t>(columns), artificial.end(), Real(-1));
    tableau.maximise(artificial, columns);
    for (std::size_t i = 0; i < rows; ++i) {
        if (tableau.basis(i) < columns)
            continue;
        if (tableau.right(i) > 1e-10L)
            throw std::runtime_error("the linear programme has no solution");
        for (std::size_t k = 0; k < columns; ++k) // a row that says nothing new may keep its artificial unknown at 0
            if (std::fabs(tableau.at(i, k)) > 1e-9L) {
                tableau.pivot(i, k);
                break;
            }
    }
    std::vector<Real> costs = c;
    costs.resize(all, 0);
    tableau.maximise(costs, columns);
    std::vector<Real> x(columns, 0);
    for (std::size_t i = 0; i < rows; ++i)
        if (tableau.basis(i) < columns)
            x[tableau.basis(i)] = tableau.right(i);
    return x;
}

LimitLoad limit_acceleration(const Realization& r)
{
    // Unknowns: of each bed N1, N2, T+, T-, and what is left of its cone; then the acceleration. Forces in weights of
    // the structure, accelerations in g.
    const auto beds = static_cast<std::size_t>(r.beds());
    const std::size_t columns = 5 * beds + 1;
    Real weight = 0;
    std::vector<int> row_of(r.blocks.size(), -1);
    int free_blocks = 0;
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        if (!r.blocks[i].fixed) {
            row_of[i] = 3 * free_blocks++;
            weight += r.blocks[i].mass_kg;
        }
    const std::size_t rows = 3 * static_cast<std::size_t>(free_blocks) + beds;
    std::vector<Real> a(rows * columns, 0), b(rows, 0), c(columns, 0);
    const auto put = [&](int row, std::size_t column, Real value) {
        a[static_cast<std::size_t>(row) * columns + column] += value;
    };
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        if (row_of[i] >= 0) {
            const Real share = r.blocks[i].mass_kg / weight;
            put(row_of[i], columns - 1, -share); // sum of F_x = m a, sum of F_y = m g, no moment about the centre
            b[static_cast<std::size_t>(row_of[i] + 1)] = share;
        }
    std::vector<Real> left(beds), right(beds);
    for (std::size_t j = 0; j < beds; ++j) {
        const Joint& joint = r.joints[j];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        left[j] = std::max(lower.x_m - lower.half_width_m, upper.x_m - upper.half_width_m);
        right[j] = std::min(lower.x_m + lower.half_width_m, upper.x_m + upper.half_width_m);
        const Real y = lower.y_m + lower.half_height_m;
        for (const auto& [block, sign] : {std::pair{joint.upper, 1}, {joint.lower, -1}}) {
            const auto k = static_cast<std::size_t>(block);
            const int row = row_of[k];
            if (row < 0)
                continue;
            const Real arm_y = y - r.blocks[k].y_m;
            put(row + 1, 5 * j, sign);
            put(row + 1, 5 * j + 1, sign);
            put(row + 2, 5 * j, sign * (left[j] - r.blocks[k].x_m));
            put(row + 2, 5 * j + 1, sign * (right[j] - r.blocks[k].x_m));
            for (int t : {0, 1}) {
                const Real direction = t == 0 ? sign : -sign;
                put(row, 5 * j + 2 + static_cast<std::size_t>(t), direction);
                put(row + 2, 5 * j + 2 + static_cast<std::size_t>(t), -direction * arm_y);
            }
        }
        const int cone = 3 * free_blocks + static_cast<int>(j);
        put(cone, 5 * j, joint.friction);
        put(cone, 5 * j + 1, joint.friction);
        for (std::size_t t : {2, 3, 4})
            put(cone, 5 * j + t, -1);
    }
    c[columns - 1] = 1;
    const std::vector<Real> x = maximise(std::move(a), std::move(b), c);
    LimitLoad state;
    state.acceleration_m_s2 = static_cast<double>(x.back() * r.gravity_m_s2);
    for (std::size_t j = 0; j < beds; ++j) {
        const Real* f = &x[5 * j];
        const Real N = f[0] + f[1], unit = weight * r.gravity_m_s2;
        state.pressure_n.push_back(static_cast<double>(N * unit));
        state.shear_n.push_back(static_cast<double>((f[2] - f[3]) * unit));
        state.at.push_back(N > 1e-12L ? static_cast<double>((f[1] - f[0]) / N)
                                      : std::numeric_limits<double>::quiet_NaN());
    }
    return state;
}

} // namespace stylobate
