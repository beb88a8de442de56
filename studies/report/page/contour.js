// Contour lines on a rectangular grid by marching squares, as io/plots/contour.cpp draws them.

/**
 * The lines on which z is `level`, as lists of [x, y]; z is linear along the edges of the grid. A saddle is cut by the
 * mean of its corners. A square with a corner that is not known has no line.
 * @param x, y coordinates, ascending   @param z of the nodes: z[i * y.length + j]; null: not known
 */
function contourLines(x, y, z, level) {
  const segments = new Map(); // by edge: those that it is joined to. 2 node: along x from there; 2 node + 1: along y
  const join = (a, b) => {
    for (const [from, to] of [[a, b], [b, a]]) segments.set(from, [...segments.get(from) ?? [], to]);
  };
  for (let i = 0; i + 1 < x.length; ++i) {
    for (let j = 0; j + 1 < y.length; ++j) {
      const node = i * y.length + j, corner = [z[node], z[node + y.length], z[node + y.length + 1], z[node + 1]];
      if (corner.some((value) => value === null)) continue;
      const edge = [2 * node, 2 * (node + y.length) + 1, 2 * (node + 1), 2 * node + 1];
      const crossed = edge.filter((_, k) => (corner[k] >= level) !== (corner[(k + 1) % 4] >= level));
      if (crossed.length === 2) {
        join(...crossed);
      } else if (crossed.length === 4) {
        const middle = corner.reduce((sum, value) => sum + value, 0) / 4 >= level;
        const first = (corner[0] >= level) !== middle;
        join(edge[first ? 3 : 0], edge[first ? 0 : 1]);
        join(edge[first ? 1 : 2], edge[first ? 2 : 3]);
      }
    }
  }
  const point = (edge) => {
    const node = Math.floor(edge / 2), i = Math.floor(node / y.length), j = node % y.length, alongY = edge % 2 === 1;
    const from = z[node], to = z[node + (alongY ? 1 : y.length)], share = (level - from) / (to - from);
    return alongY ? [x[i], y[j] + share * (y[j + 1] - y[j])] : [x[i] + share * (x[i + 1] - x[i]), y[j]];
  };
  const lines = [], ends = [...segments.keys()].sort((a, b) => segments.get(a).length - segments.get(b).length);
  for (const start of ends) { // open lines first, what is left are rings
    if (!segments.get(start).length) continue;
    const line = [point(start)];
    for (let edge = start; segments.get(edge).length;) {
      const next = segments.get(edge).pop(), back = segments.get(next);
      back.splice(back.indexOf(edge), 1);
      line.push(point(next));
      edge = next;
    }
    lines.push(line);
  }
  return lines;
}

/** The lines of a map: cells reach the frame, so the lines do, too. @param z of the cells, as above */
function mapContours(x, y, z, level) {
  const ends = (values) => [0, ...values, 1], inside = (values, i) => clamp(i - 1, 0, values.length - 1);
  const padded = ends(x).flatMap((_, i) => ends(y).map((__, j) => z[inside(x, i) * y.length + inside(y, j)]));
  return contourLines(ends(x), ends(y), padded, level);
}

/** Where on its longest line a level is named: far from other lines and from the frame, near its middle. */
function labelPlace(own, others) {
  const far = (a, b, flat = 1) => Math.hypot(flat * (a[0] - b[0]), a[1] - b[1]);
  const length = (line) => line.reduce((sum, p, i) => sum + (i ? far(p, line[i - 1]) : 0), 0);
  const line = own.reduce((best, one) => length(one) > length(best) ? one : best), all = others.flat();
  const score = (p) => {
    const frame = Math.min(p[0], 1 - p[0], p[1], 1 - p[1]);
    const clear = all.reduce((least, q) => Math.min(least, far(p, q, 0.6)), 0.12);
    return clear + 0.1 * Math.min(frame, 0.4) - (frame < 0.06 ? 1 : 0);
  };
  return line.reduce((best, p) => score(p) > score(best) ? p : best, line[Math.floor(line.length / 2)]);
}
