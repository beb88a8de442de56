#include "ensemble/statics/bedding.hpp"

#include <cmath>

namespace stylobate {

namespace {

/// Springs of the form `points`: their area A L = sum w_i d_i^1.5 / sqrt(d_ref) and first moment by Newton's method in
/// the depth at the middle and the slope along the face, times L / 2.
Bedding on_points(double per_root_depth, double L, double area, double e)
{
    constexpr FaceRule<5> rule = lobatto_rule();
    const double want = area / L;
    double depth = std::pow(want / per_root_depth, 2.0 / 3), slope = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
        double sum = 0, moment = 0, k = 0, k_x = 0, k_xx = 0;
        for (int i = 0; i < 5; ++i) {
            const double x = 2 * rule.at[i] - 1, d = depth + slope * x;
            if (d <= 0)
                continue;
            const double p = rule.part[i] * per_root_depth * std::sqrt(d);
            sum += p * d;
            moment += p * d * x;
            k += 1.5 * p;
            k_x += 1.5 * p * x;
            k_xx += 1.5 * p * x * x;
        }
        const double lacks = want - sum, lacks_moment = want * 2 * e / L - moment;
        if (std::fabs(lacks) + std::fabs(lacks_moment) < 1e-15 * want)
            break;
        const double determinant = k * k_xx - k_x * k_x;
        if (!(determinant > 1e-12 * k * k)) { // one point is left: press deeper, and turn towards the load
            depth += 0.1 * std::fabs(depth);
            slope *= 0.7;
            continue;
        }
        double by_depth = (k_xx * lacks - k_x * lacks_moment) / determinant;
        double by_slope = (k * lacks_moment - k_x * lacks) / determinant;
        // no farther than the bed is deep, so that not all of it opens at once
        const double most = 0.5 * (std::fabs(depth) + std::fabs(slope)),
                     far = std::fabs(by_depth) + std::fabs(by_slope);
        const double part = far > most ? most / far : 1;
        depth += part * by_depth;
        slope += part * by_slope;
    }
    return {depth, -std::atan(2 * slope / L)};
}

} // namespace

Bedding bedding(double K, double L, double N, double e)
{
    const double eccentric = std::fabs(e);
    if (eccentric <= L / 6)
        return {N / (K * L), -12 * N * e / (K * L * L * L)};
    if (eccentric >= L / 2)
        return {N / (K * L), 0};
    const double pressed = 3 * (L / 2 - eccentric); // a triangle under the nearer edge
    const double edge_depth = 2 * N / (K * pressed);
    const double rotation = edge_depth / pressed;
    return {edge_depth - rotation * L / 2, e > 0 ? -rotation : rotation};
}

Bedding bedding(const BedLaw& law, double L, double N, double e)
{
    const double area = law.area(N);
    if (law.bonded)
        return {area / L, -12 * area * e / (L * L * L)};
    if (law.form == ContactForm::area || std::fabs(e) >= L / 2)
        return bedding(N / area, L, N, e);
    if (law.form == ContactForm::points)
        return on_points(law.faces.per_root_depth, L, area, e);
    // springs of L / 2 at the ends, by the lever rule
    const double left = area * (1 - 2 * e / L) / L, right = area * (1 + 2 * e / L) / L;
    return {0.5 * (left + right), -std::atan((right - left) / L)};
}

} // namespace stylobate
