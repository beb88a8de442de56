#pragma once
/// Overlap of two rectangles: area, first moments and contact direction. `THEORY.md` section 2 derives the forms.
///
/// Everything is in the frame of the lower block with the origin at the middle of its top face; y up. The contact
/// direction is the sum of outward normal x length over those parts of the lower block's faces that lie inside the
/// upper one. For two convex shapes that is the chord between the crossings of their outlines, turned by 90 degrees,
/// but it needs no search for crossings and has no degenerate case for equal drums that stand flush.

#include "kernels/real.hpp"

namespace stylobate {

/// Where the upper block's bottom face is, seen from the lower block.
template <class Real>
struct Placement {
    Real x;      ///< middle of the bottom face [m]
    Real depth;  ///< the same, downwards: positive when the faces overlap [m]
    Real sine;   ///< of the relative rotation, counter-clockwise
    Real cosine; ///< of the relative rotation
};

template <class Real>
struct Overlap {
    Real area;         ///< A_c [m2]
    Real moment_x;     ///< integral of x over the area [m3]
    Real moment_depth; ///< integral of -y over the area [m3]
    Real normal_x;     ///< contact direction x its length [m]
    Real normal_y;
    Real elastic; ///< elastic energy over K_N [m3]: of the Winkler bed that the area law stands for
};

/// Half sizes of the two blocks [m].
template <class Real>
struct PairSizes {
    Real lower_half_width;
    Real lower_half_height;
    Real upper_half_width;
    Real upper_half_height;
};

/// Overlap of any two rectangles (also of blocks that lie beside or across each other).
///
/// Green's theorem over the upper block's four edges, cut by the lower block's box: the area is the integral of
/// -clamp(y) dx over the part of the outline with x inside the box. It is continuous in the input and has no
/// degenerate case; nothing is searched for.
template <class Real>
STYLOBATE_INLINE Overlap<Real> general_overlap(const Placement<Real>& p, const PairSizes<Real>& s)
{
    const Real zero(0.0), one(1.0), half(0.5);
    const Real low = Real(-2.0) * s.lower_half_height; // the lower block: |x| <= half width, low <= y <= 0
    const Real width = s.lower_half_width;
    // corners of the upper block, counter-clockwise from bottom left
    const Real bx = s.upper_half_width * p.cosine, by = s.upper_half_width * p.sine;
    const Real hx = Real(-2.0) * s.upper_half_height * p.sine, hy = Real(2.0) * s.upper_half_height * p.cosine;
    const Real cx[4] = {p.x - bx, p.x + bx, p.x + bx + hx, p.x - bx + hx};
    const Real y = zero - p.depth;
    const Real cy[4] = {y - by, y + by, y + by + hy, y - by + hy};

    Overlap<Real> o{zero, zero, zero, zero, zero, zero};
    const Real tiny(1e-300);
    for (int edge = 0; edge < 4; ++edge) {
        const int next = (edge + 1) & 3;
        const Real x0 = cx[edge], y0 = cy[edge];
        const Real dx = cx[next] - x0, dy = cy[next] - y0;
        // part of the edge, from t0 to t1, with |x| <= width
        const Real per_x = one / select(abs_of(dx) < tiny, tiny, dx);
        const Real ta = (Real(0.0) - width - x0) * per_x, tb = (width - x0) * per_x;
        const Real t0 = clamp(min_of(ta, tb), zero, one), t1 = clamp(max_of(ta, tb), t0, one);
        // where it meets y = low and y = 0: between these it is slanted, beyond them it is clamped to the box
        const Real per_y = one / select(abs_of(dy) < tiny, tiny, dy);
        const Real tc = (low - y0) * per_y, td = (Real(0.0) - y0) * per_y;
        const Real t2 = clamp(min_of(tc, td), t0, t1), t3 = clamp(max_of(tc, td), t0, t1);
        const Real cut[4] = {t0, t2, t3, t1};
        for (int piece = 0; piece < 3; ++piece) {
            const Real u0 = cut[piece], u1 = cut[piece + 1];
            const Real xa = fma(u0, dx, x0), xb = fma(u1, dx, x0);
            // the outer pieces lie on the box to the bit: what rounding leaves of y there, times a long run, would
            // drown a corner that only grazes
            const Real flat = select(fma(half * (u0 + u1), dy, y0) > half * low, zero, low);
            const Real ya = piece == 1 ? clamp(fma(u0, dy, y0), low, zero) : flat;
            const Real yb = piece == 1 ? clamp(fma(u1, dy, y0), low, zero) : flat;
            const Real run = xb - xa;
            // integrals of -y, -x y and y^2/2 along the piece, for y linear in x
            o.area = o.area - run * half * (ya + yb);
            o.moment_x = o.moment_x - run * Real(1.0 / 6.0) * (xa * (ya + ya + yb) + xb * (ya + yb + yb));
            o.moment_depth = o.moment_depth + run * Real(1.0 / 6.0) * (ya * ya + ya * yb + yb * yb);
        }
        // the part inside the box belongs to the upper block's outline; its outward normal x length is (dy, -dx) (t3 -
        // t2)
        const Real my = fma(half * (t2 + t3), dy, y0);
        const auto inside_y = clamp(my, low, zero);
        const Real share = select(inside_y != my, zero, t3 - t2);
        o.normal_x = o.normal_x - share * dy;
        o.normal_y = o.normal_y + share * dx;
    }
    const Real chord2 = o.normal_x * o.normal_x + o.normal_y * o.normal_y;
    // The bed's energy is the area's first moment about the face that presses. Two thirds of A^2 / L are that of a
    // triangle, which is what meets at a corner; where a face lies in the other block, the moment about it is less.
    const Real corner = Real(2.0 / 3.0) * o.area * o.area / sqrt_of(max_of(chord2, tiny));
    const Real top = min_of(o.moment_depth, fnma(low, o.area, zero - o.moment_depth));
    const Real side = fms(width, o.area, abs_of(o.moment_x));
    o.elastic = max_of(min_of(corner, min_of(top, side)), zero);
    return o;
}

/// The same for a pair that stands, in closed form: bottom face of the upper block against top face of the lower one.
///
/// Seen so that the left end is the deeper one, the overlap is the trapezoid under the top face, plus the sliver where
/// the upper block's left side leans outwards, less the sliver where its right side leans inwards, all cut by the
/// lower block's sides: a pentagon at the most. `fits` says in which realizations this holds; the others need
/// `general_overlap`, which gives the same numbers where both hold.
///
/// @param depth_limit a tenth of the smaller half height: how deep a corner may be for the closed form to hold
template <class Real, class Mask>
STYLOBATE_INLINE Overlap<Real> stacked_overlap(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                               Real depth_limit, Mask& fits)
{
    const Real zero(0.0), half(0.5), third(1.0 / 3.0), sixth(1.0 / 6.0);
    // mirror, so that the left end is the deeper one
    const Real X = turn_sign(p.x, p.sine);
    const Real sine = max_of(abs_of(p.sine), Real(1e-18));
    const Real both = Real(1.0) / (sine * p.cosine);
    const Real slope = sine * sine * both;       // tan of the relative rotation
    const Real cot = p.cosine * p.cosine * both; // and its inverse
    const Real bL = lower_half_width;
    const Real reach = upper_half_width * p.cosine;
    const Real left = X - reach, right = X + reach;
    const Real dl = max_of(fma(upper_half_width, sine, p.depth), zero);  // depth of the upper block's left corner
    const Real dr = max_of(fnma(upper_half_width, sine, p.depth), zero); // and of its right corner, 0 if it is out

    // left end: either the upper block's corner with its sliver beyond, or cut by the lower block's side
    const Real inset = left + bL; // of the upper corner from the lower block's side
    const Real cut = min_of(inset, zero);
    const Real xa = left - cut;
    const Real da = max_of(fma(cut, slope, dl), zero);
    const Real q = min_of(dl, (inset - cut) * cot);
    const Real w = q * slope;
    // right end: the corner, the lower block's side, or where the bottom face comes out of the top face
    const Real end = min_of(right, bL);
    const Real W = max_of(min_of(end - xa, da * cot), zero);
    const Real db = max_of(fnma(W, slope, da), zero);
    const Real qr = clamp(fma(end - right, cot, dr), zero, dr);
    const Real wr = qr * slope;

    const Real area_left = w * fnma(half, q, dl);
    const Real area_right = half * wr * qr;
    const Real area = fma(half * W, da + db, area_left) - area_right;
    // first moments about x = xa and about the top face
    const Real W6 = W * sixth;
    const Real arm_left = w * w * fms(third, q, half * dl);
    const Real arm = fnma(area_right, fnma(third, wr, W), fma(W * W6, fma(Real(2.0), db, da), arm_left));
    const Real depth_left = half * w * fma(dl, dl - q, third * q * q);
    const Real depth_right = third * area_right * qr;
    const Real depth = fma(W6, fma(da, da + db, db * db), depth_left) - depth_right;

    // it holds for moderate rotations and small depths, with the deeper corner over the lower block
    fits = (p.cosine > Real(0.2)) & (dl < depth_limit) & (wr <= W) & ((left < bL) | (dl <= zero));

    return {area, turn_sign(fma(xa, area, arm), p.sine), depth, turn_sign((db - qr) - (da - q), p.sine), W - wr + w,
            depth};
}

} // namespace stylobate
