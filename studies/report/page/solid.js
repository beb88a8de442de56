// Solids in space and what a viewer sees of them: plain geometry, nothing of the page. x to the right, y up, z towards
// the viewer; a viewer far away, so that parallel lines stay parallel. A solid is convex: a drum, drawn as a prism with
// 24 sides whose corners lie on its circles, or a block with six faces.

const drumSides = 24;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// ---- attitudes: quaternions [w, x, y, z] ----

/** Of a rotation vector: its axis times its angle [rad]. */
function attitudeOf(vector) {
  const angle = Math.hypot(...vector);
  const share = angle < 1e-9 ? 0.5 : Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), ...vector.map((part) => part * share)];
}

/** From one attitude to another the short way, at an even rate. @param share 0: the first one; 1: the other one */
function between(a, b, share) {
  let cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = cosine < 0 ? -1 : 1;
  cosine = Math.min(Math.abs(cosine), 1);
  const angle = Math.acos(cosine), sine = Math.sin(angle);
  const [p, q] = sine < 1e-6 ? [1 - share, share]
                             : [Math.sin((1 - share) * angle) / sine, Math.sin(share * angle) / sine];
  const mixed = a.map((part, i) => p * part + q * sign * b[i]);
  const length = Math.hypot(...mixed);
  return mixed.map((part) => part / length);
}

function turned([w, x, y, z], p) {
  const v = [x, y, z], a = cross(v, p).map((part, i) => part + w * p[i]), b = cross(v, a);
  return p.map((part, i) => part + 2 * b[i]);
}

/** Angle between the axis of a body and the vertical [rad]. */
function tiltOf([w, x, y, z]) { return 2 * Math.atan2(Math.hypot(x, z), Math.hypot(w, y)); }

// ---- bodies ----

/**
 * Corners of a level face, counter-clockwise as seen from above.
 * @param square of a round body: the corners lie on a rectangle, and its own are among them
 */
function ring([halfX, halfZ], y, round, square = false) {
  if (!round) return [[halfX, y, halfZ], [halfX, y, -halfZ], [-halfX, y, -halfZ], [-halfX, y, halfZ]];
  return Array.from({length: drumSides}, (_, i) => {
    const angle = 2 * Math.PI * i / drumSides, cosine = Math.cos(angle), sine = Math.sin(angle);
    const out = square ? 1 / Math.max(Math.abs(cosine), Math.abs(sine)) : 1;
    return [halfX * out * cosine, y, -halfZ * out * sine];
  });
}

/**
 * An upright body about its middle. Faces are lists of corners, counter-clockwise as seen from outside: bottom, top,
 * then the sides.
 * @param bottom, top half sizes along x and z
 * @param kind 0: a prism, 1: a drum, 2: a capital with an echinus, drawn from its disc straight to its abacus
 */
function bodyOf(halfHeight, bottom, top, kind) {
  const round = kind > 0, low = ring(bottom, -halfHeight, round), n = low.length;
  const sides = Array.from({length: n}, (_, i) => [i, (i + 1) % n, n + (i + 1) % n, n + i]);
  return {corners: [...low, ...ring(top, halfHeight, round, kind === 2)], round,
          faces: [low.map((_, i) => n - 1 - i), low.map((_, i) => n + i), ...sides]};
}

// ---- the viewer ----

/**
 * Who looks at the scene. @param azimuth from z towards x [rad]: 0 sees x to the right, a quarter of a turn sees z to
 * the left   @param elevation [rad]: 0 is level, a quarter of a turn is straight from above
 */
function viewFrom(azimuth, elevation) {
  const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
  return {right: [ca, 0, -sa], up: [-sa * se, ce, -ca * se], near: [sa * ce, se, ca * ce]};
}

/** To the right, upwards, and towards the viewer. */
function seen(view, p) { return [dot(view.right, p), dot(view.up, p), dot(view.near, p)]; }

/** The convex outline of points [x, y, ...], counter-clockwise. */
function outlineOf(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1) {
        const a = chain[chain.length - 2], b = chain[chain.length - 1];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Of a face whose corners may lie on one line, or not quite in one plane: through their middle, with the normal by
 *  Newell's method. */
function planeOf(points) {
  const at = [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const normal = [0, 1, 2].map((k) => {
    const u = (k + 1) % 3, v = (k + 2) % 3;
    return points.reduce((sum, a, i) => {
      const b = points[(i + 1) % points.length];
      return sum + (a[u] - b[u]) * (a[v] + b[v]);
    }, 0);
  });
  const length = Math.hypot(...normal) || 1;
  return {at, normal: normal.map((part) => part / length)};
}

/**
 * What is seen of a body that stands somewhere: the faces that look at the viewer, with their normals in the viewer's
 * frame, the outline, and the planes of all faces, by which `depthAt` finds where a line of sight passes through it.
 */
function appearance(body, middle, attitude, view) {
  const corners = body.corners.map((p) => {
    const t = turned(attitude, p);
    return seen(view, [t[0] + middle[0], t[1] + middle[1], t[2] + middle[2]]);
  });
  const planes = body.faces.map((face) => planeOf(face.map((i) => corners[i])));
  const outline = outlineOf(corners);
  const xs = outline.map((p) => p[0]), ys = outline.map((p) => p[1]);
  return {
    faces: body.faces.map((face, i) => ({points: face.map((k) => corners[k]), normal: planes[i].normal, number: i}))
        .filter(({normal}) => normal[2] > 1e-9),
    outline, planes, area: areaOf(outline), depth: seen(view, middle)[2],
    box: [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)],
  };
}

function areaOf(polygon) {
  let twice = 0;
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length];
    twice += p[0] * q[1] - p[1] * q[0];
  });
  return twice / 2;
}

/** The part of a convex polygon that lies in another one, both counter-clockwise. */
function common(polygon, other) {
  let part = polygon;
  for (let i = 0; i < other.length && part.length > 2; ++i) {
    const a = other[i], b = other[(i + 1) % other.length];
    const inside = (p) => (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    const kept = [];
    part.forEach((p, k) => {
      const q = part[(k + 1) % part.length], u = inside(p), v = inside(q);
      if (u >= 0) kept.push(p);
      if (u >= 0 !== v >= 0) kept.push([p[0] + (q[0] - p[0]) * u / (u - v), p[1] + (q[1] - p[1]) * u / (u - v)]);
    });
    part = kept;
  }
  return part;
}

/** The middle of what a line of sight at (x, y) passes through of a solid. */
function depthAt(shape, x, y) {
  let front = Infinity, back = -Infinity;
  for (const {at, normal: [nx, ny, nz]} of shape.planes) {
    if (Math.abs(nz) < 1e-9) continue;
    const depth = at[2] - (nx * (x - at[0]) + ny * (y - at[1])) / nz;
    if (nz > 0) front = Math.min(front, depth);
    else back = Math.max(back, depth);
  }
  return (front + back) / 2;
}

/** Which of two solids hides a part of the other one: 1 the first, -1 the second, 0 neither. One line of sight through
 *  both decides: a plane separates convex solids that do not overlap, so all such lines meet them in the same order. */
function hides(a, b) {
  if (a.box[0] >= b.box[2] || b.box[0] >= a.box[2] || a.box[1] >= b.box[3] || b.box[1] >= a.box[3]) return 0;
  const both = common(a.outline, b.outline);
  if (both.length < 3 || areaOf(both) < 1e-4 * Math.min(a.area, b.area)) return 0; // they touch: springs are short
  const x = both.reduce((sum, p) => sum + p[0], 0) / both.length;
  const y = both.reduce((sum, p) => sum + p[1], 0) / both.length;
  return Math.sign(depthAt(a, x, y) - depthAt(b, x, y));
}

/**
 * The order in which solids are painted, as places in the list: each after all those that it hides a part of. Among
 * three or more solids there may be no such order (each hides a part of the next); then the farthest comes first.
 */
function paintOrder(shapes) {
  const hidden = shapes.map(() => []), waits = shapes.map(() => 0); // hidden[i]: those that i hides a part of
  for (let i = 0; i < shapes.length; ++i)
    for (let j = i + 1; j < shapes.length; ++j) {
      const which = hides(shapes[i], shapes[j]);
      if (which === 0) continue;
      const [front, back] = which > 0 ? [i, j] : [j, i];
      hidden[back].push(front);
      ++waits[front];
    }
  const left = new Set(shapes.keys()), order = [];
  while (left.size) {
    let next = -1, free = false;
    for (const i of left) {
      const isFree = waits[i] === 0;
      if (next < 0 || (isFree && !free) || (isFree === free && shapes[i].depth < shapes[next].depth)) {
        next = i;
        free = isFree;
      }
    }
    left.delete(next);
    order.push(next);
    for (const front of hidden[next]) --waits[front];
  }
  return order;
}

/** How bright a face is, between 0 and 1: the light comes from the upper left of the viewer. */
function brightness(normal) {
  const light = [-0.36, 0.62, 0.70];
  return 0.62 + 0.38 * Math.max(0, dot(normal, light) / Math.hypot(...light));
}
