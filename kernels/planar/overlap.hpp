#pragma once
/// Overlap of two rectangles: area, first moments and contact direction. `THEORY.md` section 2 derives the forms and
/// names their sources.
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
    Real elastic; ///< elastic energy over K_N [m3]: of the Winkler bed that the area law represents
};

/// Lane by lane, one of two overlaps.
template <class Mask, class Real>
STYLOBATE_INLINE Overlap<Real> select(Mask mask, const Overlap<Real>& yes, const Overlap<Real>& no)
{
    return {select(mask, yes.area, no.area),
            select(mask, yes.moment_x, no.moment_x),
            select(mask, yes.moment_depth, no.moment_depth),
            select(mask, yes.normal_x, no.normal_x),
            select(mask, yes.normal_y, no.normal_y),
            select(mask, yes.elastic, no.elastic)};
}

/// Of a bed, from relative displacements and versines, without cancellation of large numbers.
/// @param x, rise upper centre - lower centre, frame of the base; upwards less the height at rest [m]
/// @param height of the centres at rest: the sum of the half heights [m]
template <class Real>
STYLOBATE_INLINE Placement<Real> bed_placement(Real lower_sine, Real lower_versine, Real upper_sine, Real upper_versine,
                                               Real x, Real rise, Real height, Real upper_half_height)
{
    const Real sl = lower_sine, vl = lower_versine, su = upper_sine, vu = upper_versine, hu = upper_half_height;
    const Real one(1.0);
    const Real cl = one - vl, cu = one - vu;
    const Real versine = fnma(su, sl, fnma(vl, vu, vl + vu));
    Placement<Real> place;
    place.sine = fms(su, cl, cu * sl);
    place.cosine = one - versine;
    place.x = fma(x, cl, fma(rise + height, sl, hu * place.sine));
    place.depth = fma(x, sl, fms(height, vl, fma(hu, versine, rise * cl)));
    return place;
}

/// `Placement::depth` of blocks that share no bed, whose centres may be any height apart.
/// @param cosine of the relative rotation;  @param x, y upper centre - lower centre, frame of the base [m]
template <class Real>
STYLOBATE_INLINE Real pair_depth(Real cosine, Real lower_sine, Real lower_versine, Real x, Real y,
                                 Real lower_half_height, Real upper_half_height)
{
    return fma(x, lower_sine, fnma(y, Real(1.0) - lower_versine, fma(upper_half_height, cosine, lower_half_height)));
}

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
/// Green's theorem over the upper block's four edges, cut by the lower block's box (Steger, "On the calculation of
/// arbitrary moments of polygons", Technical Report FGBV-96-05, Technische Universitaet Muenchen (1996); clamping
/// instead of clipping: own derivation): the area is the integral of -clamp(y) dx over the part of the outline with x
/// inside the box. It is continuous in the input, has no degenerate case, and needs no search.
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
    const Real tiny = Real(Extreme<NumberOf<Real>>::tiny);
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
            // the outer pieces lie on the box to the bit: the rounding error of y there, times a long run, would exceed
            // the overlap of a grazing corner
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
    // triangle, the overlap of a corner; where a face lies in the other block, the moment about it is less.
    const Real corner = Real(2.0 / 3.0) * o.area * o.area / sqrt_of(max_of(chord2, tiny));
    const Real top = min_of(o.moment_depth, fnma(low, o.area, zero - o.moment_depth));
    const Real side = fms(width, o.area, abs_of(o.moment_x));
    o.elastic = max_of(min_of(corner, min_of(top, side)), zero);
    return o;
}

/// Where the ends of the upper block's bottom face are, seen from the lower block and mirrored, if need be, so that the
/// left end is the deeper one.
template <class Real>
struct PentagonFrame {
    Real left, right;             ///< x of the ends [m]
    Real left_depth, right_depth; ///< how deep they are, 0 where above the top face [m]
    Real slope;                   ///< tan of the relative rotation: its sign is that of the picture that was mirrored
    Real cot;                     ///< 1 / |slope|
};

/// (Separate from `pentagon` to hide the latency of the division: many frames first, then many pentagons.)
template <class Real>
STYLOBATE_INLINE void pentagon_frame(const Placement<Real>& p, Real upper_half_width, PentagonFrame<Real>& frame)
{
    const Real zero(0.0);
    const Real X = turn_sign(p.x, p.sine);
    const Real sine = max_of(abs_of(p.sine), Real(1e-18));
    const Real both = Real(1.0) / (sine * p.cosine);
    const Real reach = upper_half_width * p.cosine;
    frame.left = X - reach;
    frame.right = X + reach;
    // beyond moderate rotations the pentagon does not hold: no depth limit is as large as this
    frame.left_depth = select(p.cosine > Real(0.2), max_of(fma(upper_half_width, sine, p.depth), zero),
                              Real(Extreme<NumberOf<Real>>::huge));
    frame.right_depth = max_of(fnma(upper_half_width, sine, p.depth), zero);
    frame.slope = turn_sign(sine * sine * both, p.sine);
    frame.cot = p.cosine * p.cosine * both;
}

/// The overlap of a pair that stands, in closed form: bottom face of the upper block against top face of the lower one.
///
/// The overlap is the trapezoid under the top face, plus the sliver where the upper block's left side leans outwards,
/// less the sliver where its right side leans inwards, all cut by the lower block's sides: a pentagon at the most.
/// `fits` marks the realizations in which this holds; the others need `general_overlap`, which gives the same numbers
/// where both hold. `o.elastic` is left to the caller: it is `o.moment_depth`.
///
/// @param depth_limit a tenth of the smaller half height: how deep a corner may be for the closed form to hold
template <class Real, class Mask>
STYLOBATE_INLINE void pentagon(const PentagonFrame<Real>& frame, Real lower_half_width, Real depth_limit, Mask& fits,
                               Overlap<Real>& o)
{
    const Real zero(0.0), half(0.5), three(3.0);
    const Real sixth = Real(1.0 / 6.0);
    const Real slope = abs_of(frame.slope), cot = frame.cot;
    const Real left = frame.left, right = frame.right, dl = frame.left_depth, dr = frame.right_depth;
    const Real bL = lower_half_width;

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

    // twice the area: trapezoid + left sliver - right sliver
    const Real corner = wr * qr;
    o.area = half * (fma(W, da + db, w * (dl + (dl - q))) - corner);
    // six times the first moments about x = xa and about the top face
    const Real arm = fnma(corner, fms(three, W, wr), fma(W * W, (db + db) + da, w * w * fnma(three, dl, q + q)));
    const Real depth = sixth * fnma(corner, qr, fma(W, fma(da, da + db, db * db), w * fma(three * dl, dl - q, q * q)));
    o.moment_x = turn_sign(fma(xa, o.area, sixth * arm), frame.slope);
    o.moment_depth = depth;
    o.normal_x = turn_sign((db - qr) - (da - q), frame.slope);
    o.normal_y = W - wr + w;

    // it holds for small depths, with the deeper corner over the lower block
    fits = (dl < depth_limit) & (wr <= W) & ((left < bL) | (dl <= zero));
}

/// Frame and pentagon in one.
template <class Real, class Mask>
STYLOBATE_INLINE Overlap<Real> stacked_overlap(const Placement<Real>& p, Real lower_half_width, Real upper_half_width,
                                               Real depth_limit, Mask& fits)
{
    PentagonFrame<Real> frame;
    pentagon_frame(p, upper_half_width, frame);
    Overlap<Real> o;
    pentagon(frame, lower_half_width, depth_limit, fits, o);
    o.elastic = o.moment_depth;
    return o;
}

} // namespace stylobate
