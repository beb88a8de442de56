// The rose of falls: how many realizations fell towards which direction, as seen from above. Counts are by sectors of
// equal angles, the first one about x, the others towards z, which points down.

/** @param counts of each sector   @param title for readers who do not see it */
function roseOf(counts, title) {
  const middle = 100, most = Math.max(1, ...counts), sector = 2 * Math.PI / counts.length;
  const radius = (count) => 72 * Math.sqrt(count / most); // areas are as the counts
  const at = (r, angle) => `${(middle + r * Math.cos(angle)).toFixed(1)} ${(middle + r * Math.sin(angle)).toFixed(1)}`;
  const parts = counts.map((count, i) => {
    if (!count) return null;
    const r = radius(count), from = (i - 0.5) * sector, to = (i + 0.5) * sector;
    return svg("path", {class: "petal", d: `M${middle} ${middle}L${at(r, from)}A${r} ${r} 0 0 1 ${at(r, to)}Z`},
               svg("title", {}, `${Math.round(i * 360 / counts.length)}°: ${count}`));
  });
  return svg("svg", {class: "rose", viewBox: "0 0 200 200", role: "img", "aria-label": title},
             svg("circle", {class: "grid", cx: middle, cy: middle, r: radius(most)}),
             svg("circle", {class: "grid", cx: middle, cy: middle, r: radius(most / 4)}),
             ...parts.filter((part) => part),
             svg("text", {x: 182, y: 104, "font-size": 13}, "x"),
             svg("text", {x: middle, y: 192, "font-size": 13, "text-anchor": "middle"}, "z"),
             svg("text", {x: 4, y: 14, "font-size": 13}, `outer circle: ${most}`));
}
