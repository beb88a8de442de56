/// Functions of the C library that the engine calls where a realization is drawn and built. Debian's C library and
/// Emscripten's differ in the last bit of some results, and outcomes are to have the same bits: these take the place of
/// Emscripten's. web/README.md has the measured rates of results that still differ.

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

extern "C" {

/// The constants of Emscripten's own logarithm (Arm's optimized routines, MIT license), which is that of Debian's
/// library but for its multiply-adds.
extern const struct LogData {
    double ln2_high, ln2_low;
    double a[5];
    double b[11];
    struct {
        double inverse, log;
    } table[128];
} __log_data;

/// ln x, with the multiply-adds of the GNU C library on a processor that has them.
double log(double x)
{
    constexpr std::uint64_t offset = 0x3fe6000000000000;
    const double *a = __log_data.a, *b = __log_data.b;
    std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    if (x >= 1 - 0x1p-4 && x < 1 + 0x1.09p-4) {
        const double r = x - 1, r2 = r * r, r3 = r * r2;
        const double end = std::fma(r3, b[10], std::fma(r2, b[9], std::fma(r, b[8], b[7])));
        const double middle = std::fma(r3, end, std::fma(r2, b[6], std::fma(r, b[5], b[4])));
        const double series = std::fma(r3, middle, std::fma(r2, b[3], std::fma(r, b[2], b[1])));
        const double w = r * 0x1p27, r_high = r + w - w, r_low = r - r_high;
        const double square = r_high * r_high * b[0], high = r + square;
        const double low = std::fma(b[0] * r_low, r_high + r, r - high + square);
        return x == 1 ? 0 : std::fma(r3, series, low) + high;
    }
    if (!(x >= 0x1p-1022 && x <= std::numeric_limits<double>::max())) {
        if (x == 0)
            return -std::numeric_limits<double>::infinity();
        if (!(x > 0) || std::isinf(x))
            return x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
        bits = std::bit_cast<std::uint64_t>(x * 0x1p52) - (std::uint64_t{52} << 52);
    }
    const std::uint64_t above = bits - offset;
    const auto& entry = __log_data.table[above >> 45 & 127];
    const double k = static_cast<double>(static_cast<std::int64_t>(above) >> 52);
    const double z = std::bit_cast<double>(bits - (above & (std::uint64_t{0xfff} << 52)));
    const double r = std::fma(z, entry.inverse, -1.0), r2 = r * r;
    const double w = std::fma(k, __log_data.ln2_high, entry.log), high = w + r;
    const double low = std::fma(k, __log_data.ln2_low, w - high + r);
    const double series = std::fma(r2, std::fma(r, a[4], a[3]), std::fma(r, a[2], a[1]));
    return std::fma(r * r2, series, std::fma(r2, a[0], low)) + high;
}

/// sqrt(x2 + y2), corrected by the error of the sum: Borges, "An improved algorithm for hypot(a,b)", arXiv:1904.09481,
/// as the GNU C library has it without multiply-adds. @pre no square underflows or overflows; else as the standard says
double hypot(double x, double y)
{
    const double a = std::fmax(std::fabs(x), std::fabs(y)), b = std::fmin(std::fabs(x), std::fabs(y));
    if (std::isinf(x) || std::isinf(y))
        return std::numeric_limits<double>::infinity();
    if (std::isnan(x) || std::isnan(y))
        return std::numeric_limits<double>::quiet_NaN();
    if (a > 0x1p511)
        return 0x1p600 * hypot(a * 0x1p-600, b * 0x1p-600);
    if (b < 0x1p-459 && a > 0 && b > a * 0x1p-54)
        return 0x1p-600 * hypot(a * 0x1p600, b * 0x1p600);
    if (b <= a * 0x1p-54)
        return a + b;
    const double h = std::sqrt(a * a + b * b);
    if (h <= 2 * b) {
        const double d = h - b;
        return h - (a * (2 * d - a) + (d - 2 * (a - b)) * d) / (2 * h);
    }
    const double d = h - a;
    return h - (2 * d * (a - 2 * b) + ((4 * d - b) * b + d * d)) / (2 * h);
}

// Debian's are rounded correctly in all but one of about a thousand results, by tables and a second try. These are the
// correctly rounded ones, by the same function of 113 bits.

double sin(double x)
{
    return static_cast<double>(sinl(x));
}
double cos(double x)
{
    return static_cast<double>(cosl(x));
}
double tan(double x)
{
    return static_cast<double>(tanl(x));
}
double asin(double x)
{
    return static_cast<double>(asinl(x));
}
double acos(double x)
{
    return static_cast<double>(acosl(x));
}
double atan(double x)
{
    return static_cast<double>(atanl(x));
}
double atan2(double y, double x)
{
    return static_cast<double>(atan2l(y, x));
}
}
