// The overlap of two blocks against exact polygon clipping, written here on its own in extended precision.

#include "kernels/planar/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace stylobate {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Exact;
#else
using Exact = long double;
#endif

struct Pair {
    Placement<double> place;
    PairSizes<double> sizes;
    double depth_limit() const { return 0.1 * std::min(sizes.lower_half_height, sizes.upper_half_height); }
};

std::string describe(const Pair& p)
{
    char text[400];
    std::snprintf(text, sizeof text,
                  "x %.17g depth %.17g sine %.17g cosine %.17g lower %.17g x %.17g upper %.17g x %.17g", p.place.x,
                  p.place.depth, p.place.sine, p.place.cosine, p.sizes.lower_half_width, p.sizes.lower_half_height,
                  p.sizes.upper_half_width, p.sizes.upper_half_height);
    return text;
}

// ---- Sutherland and Hodgman: the upper rectangle, cut by the lower one's four sides ---------------------------------

struct Vertex {
    Exact x, y;
    bool lower_edge; ///< the edge from here to the next vertex lies on the lower block's outline
};

struct Clipped {
    std::vector<Vertex> polygon;
    Exact area = 0, moment_x = 0, moment_depth = 0, normal_x = 0, normal_y = 0;
    double deepest = 0; ///< largest depth under the top face
};

/// Keeps what has a x + b y <= c.
std::vector<Vertex> cut(const std::vector<Vertex>& in, Exact a, Exact b, Exact c)
{
    std::vector<Vertex> out;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const Vertex& p = in[i];
        const Vertex& q = in[(i + 1) % in.size()];
        const Exact dp = a * p.x + b * p.y - c, dq = a * q.x + b * q.y - c;
        if (dp <= 0)
            out.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
            const Exact t = dp / (dp - dq);
            // leaving: the next edge runs along the cut; coming back: it is the rest of this one
            out.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), dp < 0 || p.lower_edge});
            if (dp > 0)
                out.back().lower_edge = p.lower_edge;
        } else if (dp == 0 && dq > 0) {
            out.back().lower_edge = true;
        }
    }
    return out;
}

Clipped clip(const Pair& pair)
{
    const Exact s = pair.place.sine, c = pair.place.cosine, x = pair.place.x, y = -Exact(pair.place.depth);
    const Exact b = pair.sizes.upper_half_width, h = 2 * Exact(pair.sizes.upper_half_height);
    const Exact width = pair.sizes.lower_half_width;
    Clipped r;
    r.polygon = {{x - b * c, y - b * s, false},
                 {x + b * c, y + b * s, false},
                 {x + b * c - h * s, y + b * s + h * c, false},
                 {x - b * c - h * s, y - b * s + h * c, false}};
    r.polygon = cut(r.polygon, 0, 1, 0);
    r.polygon = cut(r.polygon, -1, 0, width);
    r.polygon = cut(r.polygon, 1, 0, width);
    r.polygon = cut(r.polygon, 0, -1, 2 * Exact(pair.sizes.lower_half_height));
    if (r.polygon.empty())
        return r;
    const Vertex origin = r.polygon.front(); // sums relative to the contact, so that nothing cancels
    Exact mx = 0, my = 0;
    for (std::size_t i = 0; i < r.polygon.size(); ++i) {
        const Vertex& p = r.polygon[i];
        const Vertex& q = r.polygon[(i + 1) % r.polygon.size()];
        const Exact px = p.x - origin.x, py = p.y - origin.y, qx = q.x - origin.x, qy = q.y - origin.y;
        const Exact cross = px * qy - qx * py;
        r.area += cross / 2;
        mx += cross * (px + qx) / 6;
        my += cross * (py + qy) / 6;
        if (p.lower_edge) {
            r.normal_x += q.y - p.y;
            r.normal_y -= q.x - p.x;
        }
        r.deepest = std::max(r.deepest, static_cast<double>(-p.y));
    }
    r.moment_x = mx + origin.x * r.area;
    r.moment_depth = -(my + origin.y * r.area);
    return r;
}

// ---- comparison -----------------------------------------------------------------------------------------------------

/// The largest deviations seen.
struct Worst {
    double area = 0, centroid = 0, direction = 0;
};

/// Compares with the exact overlap: area relative to itself, centroid in metres, direction in radians.
///
/// Where the upper block's side runs along the lower block's side, rounding of the coordinates decides how much of it
/// is inside: a length of up to the depth. The direction is free by that much over the chord, and by no more.
::testing::AssertionResult agrees(const Pair& pair, const Overlap<double>& o, double relative_area,
                                  double absolute_area, Worst& worst)
{
    const Clipped exact = clip(pair);
    const double coordinate =
        std::max({pair.sizes.lower_half_width, std::fabs(pair.place.x), pair.sizes.upper_half_width,
                  pair.sizes.upper_half_height * std::fabs(pair.place.sine)});
    const double rounding = 4e-16 * coordinate;
    const auto area = static_cast<double>(exact.area);
    const double chord = std::hypot(static_cast<double>(exact.normal_x), static_cast<double>(exact.normal_y));
    const double wrong_area = std::fabs(static_cast<double>(o.area - exact.area));
    // a contact cannot be known better than its outline
    const double free_area = relative_area * area + absolute_area;
    if (!(wrong_area <= free_area))
        return ::testing::AssertionFailure() << "area " << o.area << ", exact " << area << "; " << describe(pair);
    if (area < 1e-15)
        return ::testing::AssertionSuccess();
    worst.area = std::max(worst.area, wrong_area / area);

    const double cx = static_cast<double>(o.moment_x / Exact(o.area) - exact.moment_x / exact.area);
    const double cy = static_cast<double>(o.moment_depth / Exact(o.area) - exact.moment_depth / exact.area);
    const double wrong_centroid = std::hypot(cx, cy);
    worst.centroid = std::max(worst.centroid, wrong_centroid);
    // the closed form takes a rotation of 1e-18 for none at all
    const double free_turn = 1e-18 * coordinate * coordinate / (2 * exact.deepest);
    if (!(wrong_centroid <= 1e-13 + absolute_area * coordinate / area + free_turn))
        return ::testing::AssertionFailure() << "centroid off by " << cx << ", " << cy << " m; " << describe(pair);

    const auto nx = static_cast<double>(exact.normal_x), ny = static_cast<double>(exact.normal_y);
    const double wrong_direction =
        std::fabs(std::atan2(o.normal_x * ny - o.normal_y * nx, o.normal_x * nx + o.normal_y * ny));
    worst.direction = std::max(worst.direction, wrong_direction);
    const double steep = std::max(std::fabs(pair.place.sine), 1e-300);
    const double free_length = std::min(2.01 * exact.deepest, rounding * (2 + 1 / steep));
    if (!(wrong_direction <= 1e-13 + free_length / chord))
        return ::testing::AssertionFailure() << "direction off by " << wrong_direction << " rad, exact " << nx << ", "
                                             << ny << "; " << describe(pair);
    return ::testing::AssertionSuccess();
}

Overlap<double> closed(const Pair& p, bool& fits)
{
    return stacked_overlap(p.place, p.sizes.lower_half_width, p.sizes.upper_half_width, p.depth_limit(), fits);
}

// ---- pairs ----------------------------------------------------------------------------------------------------------

class PairMaker {
public:
    explicit PairMaker(std::uint64_t seed) : engine_(seed) {}

    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }

    /// `corner`: depth of the deeper lower corner.
    static Pair at(double x, double corner, double rotation, double lower, double upper, double height)
    {
        const double s = std::sin(rotation);
        return {{x, corner - upper * std::fabs(s), s, std::cos(rotation)}, {lower, height, upper, height}};
    }

    /// A pair as it stands in a column: static depths, small rotations, drums nearly equal and nearly flush.
    Pair standing()
    {
        const double lower = 0.024 * (1 + uniform(-0.01, 0.01));
        const double upper = uniform(0, 1) < 0.3 ? lower : 0.024 * (1 + uniform(-0.01, 0.01));
        const double x = uniform(0, 1) < 0.3 ? 0 : sign() * log_uniform(1e-9, 1e-3);
        const double depth = log_uniform(1e-8, 1e-5);
        return at(x, depth + 0.024 * 1e-17, sign() * log_uniform(1e-16, 0.9 * depth / 0.024), lower, upper, 0.0145);
    }
    /// A pair that rocks: one corner in, the other out.
    Pair rocking()
    {
        return at(uniform(-0.01, 0.01), log_uniform(1e-8, 1e-4), sign() * log_uniform(1e-6, 0.6), uniform(0.015, 0.03),
                  uniform(0.015, 0.03), 0.0145);
    }
    /// Any two rectangles, in any position in which they may touch.
    Pair anyhow()
    {
        const double rotation = uniform(-3.2, 3.2);
        return {{uniform(-0.05, 0.05), uniform(-0.05, 0.05), std::sin(rotation), std::cos(rotation)},
                {uniform(0.01, 0.04), uniform(0.005, 0.04), uniform(0.01, 0.04), uniform(0.005, 0.04)}};
    }

private:
    std::mt19937_64 engine_;
};

/// Everything that may coincide, and what lies beside it by rounding and by more.
std::vector<Pair> degenerate_pairs()
{
    std::vector<Pair> pairs;
    const std::array offsets{0.0, 1e-17, 1e-16, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 4e-2};
    const std::array rotations{0.0,  1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-9,
                               1e-8, 1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  0.5};
    const std::array widths{0.024, 0.024 * (1 + 1e-15), 0.024 * (1 - 1e-15), 0.0240001, 0.0239999, 0.012, 0.048, 1.0};
    for (double offset : offsets)
        for (double rotation : rotations)
            for (double upper : widths)
                for (double corner : {1e-9, 1e-6, 1e-4})
                    for (double turn : {-1.0, 1.0})
                        for (double side : {-1.0, 1.0})
                            pairs.push_back(
                                PairMaker::at(side * offset, corner, turn * rotation, 0.024, upper, 0.0145));
    // a corner of one above a corner of the other, exactly and beside it
    for (double rotation : rotations)
        for (double inset : offsets)
            for (double in : {-1.0, 1.0})
                for (double turn : {-1.0, 1.0}) {
                    const double reach = 0.02 * std::cos(rotation);
                    pairs.push_back(
                        PairMaker::at(turn * (reach - 0.024 + in * inset), 1e-6, turn * rotation, 0.024, 0.02, 0.0145));
                    pairs.push_back(
                        PairMaker::at(turn * (0.024 - reach + in * inset), 1e-6, turn * rotation, 0.024, 0.02, 0.0145));
                }
    return pairs;
}

// ---- tests ----------------------------------------------------------------------------------------------------------

TEST(Overlap, OracleKnowsSimplePairs)
{
    const Pair plain{{0.01, 0.002, 0, 1}, {0.03, 0.02, 0.025, 0.02}};
    const Clipped box = clip(plain); // from -0.015 to 0.03
    EXPECT_NEAR(static_cast<double>(box.area), 0.045 * 0.002, 1e-18);
    EXPECT_NEAR(static_cast<double>(box.moment_x / box.area), 0.0075, 1e-16);
    EXPECT_NEAR(static_cast<double>(box.moment_depth / box.area), 0.001, 1e-16);
    EXPECT_NEAR(static_cast<double>(box.normal_y), 0.045, 1e-16);
    EXPECT_NEAR(static_cast<double>(box.normal_x), 0.002, 1e-16); // the lower block's right side is inside
    const Pair corner{{0, 0.002 - 0.02 * 0.6, 0.6, 0.8}, {0.03, 0.02, 0.02, 0.02}};
    const Clipped triangle = clip(corner); // right angle 0.002 deep
    EXPECT_NEAR(static_cast<double>(triangle.area), 0.5 * 0.002 * 0.002 * (0.75 + 1 / 0.75), 1e-17);
    EXPECT_NEAR(static_cast<double>(triangle.normal_y), 0.002 * (0.75 + 1 / 0.75), 1e-16);
    EXPECT_NEAR(static_cast<double>(triangle.normal_x), 0, 1e-18);
    EXPECT_TRUE(clip(Pair{{0, -0.001, 0, 1}, {0.03, 0.02, 0.02, 0.02}}).polygon.empty());
}

TEST(Overlap, StandingPairsAlwaysFitTheClosedForm)
{
    PairMaker maker(1);
    Worst worst, general;
    int open = 0;
    for (int i = 0; i < 30000; ++i) {
        const Pair pair = maker.standing();
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        open += !fits;
        ASSERT_TRUE(agrees(pair, o, 2e-12, 0, worst)) << "closed form, pair " << i;
        ASSERT_TRUE(agrees(pair, general_overlap(pair.place, pair.sizes), 1e-10, 0, general)) << "general, pair " << i;
    }
    EXPECT_EQ(open, 0);
    EXPECT_GT(worst.area, 0);
    RecordProperty("area", std::to_string(worst.area * 1e15) + "e-15");
    RecordProperty("centroid", std::to_string(worst.centroid * 1e18) + "e-18 m");
    RecordProperty("direction", std::to_string(worst.direction * 1e12) + "e-12");
}

TEST(Overlap, RockingPairsFitTheClosedForm)
{
    PairMaker maker(2);
    Worst worst, general;
    int open = 0;
    for (int i = 0; i < 30000; ++i) {
        const Pair pair = maker.rocking();
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        ASSERT_TRUE(agrees(pair, general_overlap(pair.place, pair.sizes), 1e-9, 1e-20, general))
            << "general, pair " << i;
        open += !fits;
        if (fits) {
            ASSERT_TRUE(agrees(pair, o, 1e-10, 1e-22, worst)) << "closed form, pair " << i;
        }
    }
    EXPECT_LT(open, 10);
    RecordProperty("open", open);
}

TEST(Overlap, DegeneratePairs)
{
    Worst worst, general;
    int fitting = 0, all = 0;
    for (const Pair& pair : degenerate_pairs()) {
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        ++all;
        fitting += fits;
        if (fits) {
            ASSERT_TRUE(agrees(pair, o, 1e-10, 1e-22, worst)) << "closed form";
        }
        ASSERT_TRUE(agrees(pair, general_overlap(pair.place, pair.sizes), 1e-9, 1e-20, general)) << "general";
    }
    EXPECT_GT(fitting, 0.8 * all);
    RecordProperty("fitting", std::to_string(fitting) + " of " + std::to_string(all));
}

TEST(Overlap, AnyTwoRectangles)
{
    PairMaker maker(3);
    Worst worst, general;
    int touching = 0, fitting = 0;
    for (int i = 0; i < 40000; ++i) {
        const Pair pair = maker.anyhow();
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        const Overlap<double> g = general_overlap(pair.place, pair.sizes);
        touching += g.area > 0;
        fitting += fits && g.area > 0;
        ASSERT_TRUE(agrees(pair, g, 1e-10, 1e-18, general)) << "general, pair " << i;
        if (fits) {
            ASSERT_TRUE(agrees(pair, o, 1e-10, 1e-22, worst)) << "closed form, pair " << i;
        }
    }
    EXPECT_GT(touching, 15000);
    EXPECT_GT(fitting, 100);
}

TEST(Overlap, ExactlyAlignedStack)
{
    // the initial state: equal drums, no rotation, flush corners on both sides
    for (double half : {0.024, 0.03, 1.0 / 3})
        for (double depth : {1e-7, 1.661569e-6, 1e-4})
            for (double sine : {0.0, -0.0}) {
                const Pair pair{{0, depth, sine, 1}, {half, 0.0145, half, 0.0145}};
                bool fits = false;
                const Overlap<double> c = closed(pair, fits);
                EXPECT_TRUE(fits);
                for (const Overlap<double>& o : {c, general_overlap(pair.place, pair.sizes)}) {
                    EXPECT_NEAR(o.area / (2 * half * depth), 1, 1e-14);
                    EXPECT_NEAR(o.moment_x / o.area, 0, 1e-12);
                    EXPECT_NEAR(o.moment_depth / o.area, depth / 2, 1e-14 * depth);
                    EXPECT_NEAR(o.normal_y, 2 * half, 1e-14);
                    // whose side is inside whose is undecided: the direction is free by the depth, no more
                    EXPECT_LE(std::fabs(o.normal_x), depth * (1 + 1e-9));
                }
                EXPECT_NEAR(c.elastic / (depth * depth * half), 1, 1e-14);
            }
}

TEST(Overlap, CornersThatOnlyGraze)
{
    // also of large blocks, where rounding of a coordinate is not small against the contact
    PairMaker maker(9);
    for (double scale : {0.0145, 0.5})
        for (double corner : {1e-9, 1e-8, 1e-7, 1e-6})
            for (int i = 0; i < 1000; ++i) {
                const Pair pair = PairMaker::at(0.4 * scale * maker.uniform(-1, 1), corner,
                                                maker.sign() * maker.uniform(0.05, 1.3), scale, scale, 4 * scale);
                const Overlap<double> o = general_overlap(pair.place, pair.sizes);
                const Clipped exact = clip(pair);
                if (exact.area < 1e-18)
                    continue;
                ASSERT_NEAR(static_cast<double>(o.area / exact.area), 1, 1e-6) << describe(pair);
                ASSERT_NEAR(static_cast<double>(o.moment_x / Exact(o.area) - exact.moment_x / exact.area), 0, 1e-13)
                    << describe(pair);
            }
}

TEST(Overlap, ApartMeansNothing)
{
    PairMaker maker(4);
    for (int i = 0; i < 20000; ++i) {
        Pair pair = PairMaker::at(maker.uniform(-0.05, 0.05), -maker.log_uniform(1e-9, 1e-2),
                                  maker.sign() * maker.log_uniform(1e-16, 1.3), 0.024, 0.02, 0.0145);
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        if (fits) {
            ASSERT_EQ(o.area, 0) << describe(pair);
        }
        ASSERT_EQ(general_overlap(pair.place, pair.sizes).area, 0) << describe(pair);
    }
}

TEST(Overlap, MirrorImage)
{
    PairMaker maker(5);
    for (int i = 0; i < 30000; ++i) {
        const Pair pair = i % 3 == 0 ? maker.standing() : i % 3 == 1 ? maker.rocking() : maker.anyhow();
        Pair mirror = pair;
        mirror.place.x = -pair.place.x;
        mirror.place.sine = -pair.place.sine;
        bool fits = false, fits_too = false;
        const Overlap<double> a = closed(pair, fits), b = closed(mirror, fits_too);
        ASSERT_EQ(fits, fits_too);
        if (fits) { // to the bit
            ASSERT_EQ(a.area, b.area);
            ASSERT_EQ(a.moment_x, -b.moment_x);
            ASSERT_EQ(a.moment_depth, b.moment_depth);
            ASSERT_EQ(a.normal_x, -b.normal_x);
            ASSERT_EQ(a.normal_y, b.normal_y);
            ASSERT_EQ(a.elastic, b.elastic);
        }
        const Overlap<double> g = general_overlap(pair.place, pair.sizes);
        const Overlap<double> m = general_overlap(mirror.place, mirror.sizes);
        ASSERT_NEAR(g.area, m.area, 1e-12 * g.area + 1e-18) << describe(pair);
        ASSERT_NEAR(g.moment_x, -m.moment_x, 1e-12 * g.area * 0.05 + 1e-19) << describe(pair);
        ASSERT_NEAR(g.normal_y, m.normal_y, 1e-14) << describe(pair);
    }
}

// ---- energy ---------------------------------------------------------------------------------------------------------

/// Extended precision in the kernels' clothes, for numerical derivatives.
struct Fine {
    long double v;
    Fine() = default;
    Fine(double all) : v(all) {}
    static Fine of(long double value)
    {
        Fine f(0);
        f.v = value;
        return f;
    }
    friend Fine operator+(Fine a, Fine b) { return of(a.v + b.v); }
    friend Fine operator-(Fine a, Fine b) { return of(a.v - b.v); }
    friend Fine operator*(Fine a, Fine b) { return of(a.v * b.v); }
    friend Fine operator/(Fine a, Fine b) { return of(a.v / b.v); }
    friend bool operator<(Fine a, Fine b) { return a.v < b.v; }
    friend bool operator>(Fine a, Fine b) { return a.v > b.v; }
    friend bool operator<=(Fine a, Fine b) { return a.v <= b.v; }
    friend Fine fma(Fine a, Fine b, Fine c) { return of(a.v * b.v + c.v); }
    friend Fine fnma(Fine a, Fine b, Fine c) { return of(c.v - a.v * b.v); }
    friend Fine fms(Fine a, Fine b, Fine c) { return of(a.v * b.v - c.v); }
    friend Fine min_of(Fine a, Fine b) { return a.v < b.v ? a : b; }
    friend Fine max_of(Fine a, Fine b) { return a.v > b.v ? a : b; }
    friend Fine abs_of(Fine a) { return of(std::fabs(a.v)); }
    friend Fine select(bool mask, Fine yes, Fine no) { return mask ? yes : no; }
    friend Fine turn_sign(Fine a, Fine sign) { return std::signbit(sign.v) ? of(-a.v) : a; }
};

} // namespace

template <>
struct Lanes<Fine> {
    using Number = double; ///< whose thresholds it takes
};

namespace {

/// The stacked overlap when the upper block is moved down and turned (clockwise negative) about the origin of the
/// frame.
Overlap<Fine> moved(const Pair& p, long double down, long double turn, bool& fits)
{
    const long double s = p.place.sine, c = p.place.cosine, x = p.place.x, y = -p.place.depth;
    const long double ct = std::cos(turn), st = std::sin(turn);
    const Placement<Fine> place{Fine::of(x * ct - y * st), Fine::of(-(x * st + y * ct) + down),
                                Fine::of(s * ct + c * st), Fine::of(c * ct - s * st)};
    return stacked_overlap(place, Fine(p.sizes.lower_half_width), Fine(p.sizes.upper_half_width), Fine(p.depth_limit()),
                           fits);
}

/// Integral of -y over the overlap, slice by slice.
double elastic_by_slices(const Pair& pair)
{
    const Clipped c = clip(pair);
    Exact left = c.polygon.front().x, right = left;
    for (const Vertex& v : c.polygon) {
        left = v.x < left ? v.x : left;
        right = v.x > right ? v.x : right;
    }
    const int slices = 20000;
    Exact sum = 0;
    for (int i = 0; i < slices; ++i) {
        const Exact x = left + (right - left) * (i + Exact(0.5)) / slices;
        Exact low = 0, high = -1;
        for (std::size_t k = 0; k < c.polygon.size(); ++k) {
            const Vertex& p = c.polygon[k];
            const Vertex& q = c.polygon[(k + 1) % c.polygon.size()];
            if ((p.x <= x) != (q.x <= x)) {
                const Exact y = p.y + (q.y - p.y) * (x - p.x) / (q.x - p.x);
                low = y < low ? y : low;
                high = y > high ? y : high;
            }
        }
        sum += (low * low - high * high) / 2;
    }
    return static_cast<double>(sum * (right - left) / slices);
}

TEST(Overlap, ElasticEnergyIsThatOfTheBed)
{
    PairMaker maker(6);
    for (int i = 0; i < 60; ++i) {
        const Pair pair = i % 2 ? maker.standing() : maker.rocking();
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        if (!fits || o.area < 1e-12)
            continue;
        EXPECT_NEAR(o.elastic / elastic_by_slices(pair), 1, 2e-4) << describe(pair);
    }
}

TEST(Overlap, ForceIsTheGradientOfTheEnergy)
{
    // for a contact plane that stays: upwards the area, about the origin its moment
    PairMaker maker(7);
    int tried = 0;
    for (int i = 0; i < 4000; ++i) {
        const Pair pair = i % 2 ? maker.standing() : maker.rocking();
        bool fits[5] = {};
        const Overlap<double> o = closed(pair, fits[0]);
        const Clipped exact = clip(pair);
        if (!fits[0] || o.area < 1e-14)
            continue;
        const long double down = 1e-6L * exact.deepest, turn = down / pair.sizes.upper_half_width;
        const long double by_depth =
            (moved(pair, down, 0, fits[1]).elastic.v - moved(pair, -down, 0, fits[2]).elastic.v) / (2 * down);
        const long double by_turn =
            (moved(pair, 0, turn, fits[3]).elastic.v - moved(pair, 0, -turn, fits[4]).elastic.v) / (2 * turn);
        if (!(fits[1] && fits[2] && fits[3] && fits[4]))
            continue;
        ++tried;
        ASSERT_NEAR(static_cast<double>(by_depth) / o.area, 1, 1e-5) << describe(pair);
        // turning also moves the lower block's sides against the outline: depth^3 / 3 each
        const double sides = 2 * std::pow(exact.deepest, 3) / 3;
        ASSERT_NEAR(static_cast<double>(by_turn), -o.moment_x, 1e-5 * o.area * pair.sizes.upper_half_width + sides)
            << describe(pair);
    }
    EXPECT_GT(tried, 3000);
}

TEST(GeneralOverlap, EnergyIsThatOfTheBedOnEveryFace)
{
    const double b = 0.03, h = 0.05, L = 2 * 0.02, H = 2 * 0.01;
    const PairSizes<double> sizes{b, h, 0.02, 0.01};
    // (a depth of 1e-6 m is the difference of numbers of 0.1 m)
    for (const double d : {1e-6, 1e-4, 2e-3}) {
        // flat on the top face, under the bottom face, and beside either side; and a corner at 45 degrees
        EXPECT_NEAR(general_overlap<double>({0.004, d, 0, 1}, sizes).elastic, d * d * L / 2, 2e-5 * d * d * L);
        EXPECT_NEAR(general_overlap<double>({-0.003, 2 * h + H - d, 0, 1}, sizes).elastic, d * d * L / 2,
                    2e-5 * d * d * L);
        for (const double side : {-1.0, 1.0})
            EXPECT_NEAR(general_overlap<double>({side * (b + 0.02 - d), h + H / 2, 0, 1}, sizes).elastic, d * d * H / 2,
                        2e-5 * d * d * H);
        const double half = std::sqrt(0.5);
        // turned by 45 degrees, the lowest corner is the bottom left one of a block whose bottom middle is at (x,
        // depth)
        const Overlap<double> corner = general_overlap<double>({0.02 * half, d - 0.02 * half, half, half}, sizes);
        EXPECT_NEAR(corner.area, d * d, 2e-5 * d * d);
        EXPECT_NEAR(corner.elastic, d * d * d / 3, 2e-5 * d * d * d);
    }
}

TEST(Overlap, GeneralEnergyIsTheClosedFormsForACorner)
{
    // a triangle in both: a corner pressed into the middle of a face
    PairMaker maker(8);
    for (int i = 0; i < 1000; ++i) {
        const Pair pair =
            PairMaker::at(0, maker.log_uniform(1e-7, 1e-4), maker.sign() * maker.uniform(0.1, 0.6), 0.03, 0.02, 0.0145);
        bool fits = false;
        const Overlap<double> o = closed(pair, fits);
        ASSERT_TRUE(fits);
        ASSERT_NEAR(general_overlap(pair.place, pair.sizes).elastic / o.elastic, 1, 1e-6) << describe(pair);
    }
}

} // namespace
} // namespace stylobate
