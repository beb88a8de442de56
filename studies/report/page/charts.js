// Small drawings beside the map: the slice through a cell, the times of its falls, its outcomes. They are drawn in the
// pixels of the screen, so that their letters have one size.

/** A drawing as wide as its place. */
class Chart {
  /** @param look a class   @param height [px]   @param attributes of the drawing */
  constructor(look, height, attributes) {
    this.height = height;
    this.drawing = svg("svg", {class: `chart ${look}`, height, ...attributes});
    this.element = html("figure", {class: "of-chart"}, this.drawing);
    this.tip = new Tip(this.element);
    new ResizeObserver(() => {
      if (this.drawing.clientWidth && this.drawing.clientWidth !== this.width) this.redraw();
    }).observe(this.drawing);
  }

  redraw() {
    this.width = this.drawing.clientWidth || 360;
    this.drawing.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.left = 46;
    this.right = this.width - 12;
    this.top = 8;
    this.bottom = this.height - 34;
    if (this.shown) this.draw();
  }

  show(shown) {
    this.shown = shown;
    this.tip.hide();
    this.redraw();
  }

  x(share) { return this.left + share * (this.right - this.left); }
  y(share) { return this.bottom - share * (this.bottom - this.top); }

  /** Axes with their numbers. @param xs, ys of [share of the axis, text] */
  axes(xs, ys, label) {
    const parts = [svg("line", {class: "axis", x1: this.left, x2: this.right, y1: this.bottom, y2: this.bottom})];
    for (const [share, text] of ys)
      parts.push(svg("line", {class: "grid", x1: this.left, x2: this.right, y1: this.y(share), y2: this.y(share)}),
                 svg("text", {x: this.left - 6, y: this.y(share) + 4, "text-anchor": "end"}, text));
    let last = -Infinity;
    for (const [share, text] of xs) {
      if (this.x(share) - last < 44) continue;
      last = this.x(share);
      parts.push(svg("line", {class: "axis", x1: last, x2: last, y1: this.bottom, y2: this.bottom + 4}),
                 svg("text", {x: last, y: this.bottom + 16, "text-anchor": "middle"}, text));
    }
    parts.push(svg("text", {x: (this.left + this.right) / 2, y: this.height - 4, "text-anchor": "middle"}, label));
    return parts;
  }

  /** Where the pointer is in the drawing, as a share of the width of its axes. */
  shareAt(event) {
    const box = this.drawing.getBoundingClientRect();
    return (event.clientX - box.left - this.left) / (this.right - this.left);
  }
}

/** The probability along a row or a column of the map, with the intervals of the cells. */
class SliceChart extends Chart {
  /** @param choose is called with the number of a cell */
  constructor(cells, choose) {
    super("slice", 158, {tabindex: 0, role: "application",
      click: (event) => choose(this.nearest(event)),
      pointermove: (event) => this.read(this.nearest(event)),
      pointerleave: () => this.tip.hide(),
      blur: () => this.tip.hide(),
      keydown: (event) => {
        const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
        if (!step) return;
        event.preventDefault();
        const list = this.list();
        choose(list[clamp(list.indexOf(this.shown.cell) + step, 0, list.length - 1)]);
      }});
    this.cells = cells;
  }

  /** The cells of the slice. */
  list() {
    const {cell, over} = this.shown, {cells} = this;
    return over === "pga" ? Array.from({length: cells.pgas}, (_, p) => cells.at(cells.row(cell), p))
                          : Array.from({length: cells.columns}, (_, row) => cells.at(row, cells.pga(cell)));
  }

  places() { return this.shown.over === "pga" ? this.cells.data.pga_at : this.cells.data.row_at; }

  nearest(event) {
    const share = this.shareAt(event), places = this.places();
    const far = (i) => Math.abs(places[i] - share);
    return this.list().reduce((best, cell, i) => far(i) < far(best[1]) ? [cell, i] : best, [this.list()[0], 0])[0];
  }

  title() {
    const {cell, over, limit} = this.shown, {data} = this.cells;
    return `Probability of ${data.limits[limit].words} over ${over === "pga" ? `PGA at ${this.cells.rowText(cell)}`
        : `${data.row_name} at ${this.cells.pgaText(cell)}`}`;
  }

  read(cell) {
    const i = this.list().indexOf(cell), {probability} = this.cells.share(this.shown.limit, cell);
    this.tip.show(readings(`Cell ${cell}`, this.cells.facts(this.shown.limit, cell).slice(0, 5)), this.x(this.places()[i]),
                  this.y(probability ?? 0));
  }

  draw() {
    const {cell, over, limit} = this.shown, {data} = this.cells, places = this.places();
    const values = over === "pga" ? data.pga_m_s2 : data.rows, list = this.list();
    const points = list.map((one, i) => ({...this.cells.share(limit, one), one, x: this.x(places[i])}))
        .filter(({probability}) => probability !== null);
    const line = (end, from = points) => from.map((point) => `${point.x.toFixed(1)} ${this.y(point[end]).toFixed(1)}`).join("L");
    const parts = this.axes(places.map((place, i) => [place, numberText(values[i], 3)]),
                            [[0, "0 %"], [0.5, "50 %"], [1, "100 %"]], over === "pga" ? "PGA [m/s²]" : data.row_label);
    if (points.length)
      parts.push(svg("path", {class: "band", d: `M${line("upper")}L${line("lower", [...points].reverse())}Z`}),
                 svg("path", {class: "curve", d: `M${line("probability")}`}));
    for (const {one, x, probability, lower, upper} of points) {
      const here = one === cell;
      if (here || points.length === 1)
        parts.push(svg("line", {class: "interval", x1: x, x2: x, y1: this.y(lower), y2: this.y(upper)}));
      parts.push(svg("circle", {class: here ? "point here" : "point", "data-slice-cell": one, cx: x, cy: this.y(probability),
                                r: here ? 5.5 : 3}));
    }
    this.drawing.replaceChildren(...parts);
    this.drawing.setAttribute("aria-label", `${this.title()}. The left and right arrow keys go from cell to cell.`);
  }
}

/** When the realizations of a cell fell. */
class FallsChart extends Chart {
  /** @param choose is called with the index of a realization that is animated */
  constructor(cells, choose) {
    super("falls", 132, {role: "img",
      pointermove: (event) => this.read(event),
      pointerleave: () => this.tip.hide(),
      click: (event) => {
        const time = this.timeAt(event), [nearest] = [...this.fallen()].sort((a, b) => Math.abs(a[1] - time) - Math.abs(b[1] - time));
        if (nearest) choose(nearest[0]);
      }});
    this.cells = cells;
  }

  /** Of the animated realizations those that fell: index and time of the first fall. */
  fallen() {
    return this.shown.list.filter((one) => one.falls.length)
        .map((one) => [one.index, Math.min(...one.falls.map(([, time]) => time))]);
  }

  /** Ends and number of the bars. */
  bars() {
    const times = this.shown.times, first = times[0], last = times.at(-1);
    const count = clamp(Math.ceil(Math.sqrt(times.length)), 1, 20), room = last > first ? 0 : 0.5 * Math.max(first, 1e-3);
    const from = first - room, width = (last + room - from) / count;
    const counts = Array(count).fill(0);
    for (const time of times) ++counts[Math.min(count - 1, Math.floor((time - from) / width))];
    return {from, width, counts};
  }

  timeAt(event) {
    const {from, width, counts} = this.bars();
    return from + clamp(this.shareAt(event), 0, 1) * width * counts.length;
  }

  read(event) {
    const {from, width, counts} = this.bars(), share = this.shareAt(event), i = Math.floor(share * counts.length);
    if (i < 0 || i >= counts.length) return this.tip.hide();
    this.tip.show(readings(`${numberText(from + i * width, 3)} to ${numberText(from + (i + 1) * width, 3)} s`,
                           [["first falls", String(counts[i])]]), this.x((i + 0.5) / counts.length), this.top + 40);
  }

  draw() {
    const {from, width, counts} = this.bars(), most = Math.max(...counts), to = from + width * counts.length;
    const ticks = Array.from({length: counts.length + 1}, (_, k) => [k / counts.length, numberText(from + k * width, 3)]);
    const parts = this.axes(ticks, [[0, "0"], [1, String(most)]], "time of the first fall [s]");
    counts.forEach((count, k) => {
      const x = this.x(k / counts.length), y = this.y(count / most);
      parts.push(svg("rect", {class: "bar", x: x + 0.5, y, width: Math.max(1, this.x((k + 1) / counts.length) - x - 1),
                              height: this.bottom - y}));
    });
    for (const [index, time] of this.fallen()) {
      const x = this.x((time - from) / (to - from)), here = index === this.shown.realization;
      parts.push(svg("path", {class: here ? "fallen-one here" : "fallen-one", "data-realization": index,
                              d: `M${x} ${this.bottom}l-5 ${here ? -12 : -9}h10Z`}, svg("title", {}, `realization ${index}`)));
      if (here) parts.push(svg("line", {class: "cursor", x1: x, x2: x, y1: this.top, y2: this.bottom}));
    }
    this.drawing.replaceChildren(...parts);
    const times = this.shown.times, middle = times[Math.floor(times.length / 2)];
    this.drawing.setAttribute("aria-label", `Times of ${times.length} first falls, from ${numberText(times[0], 3)} to ` +
        `${numberText(times.at(-1), 3)} s, half of them within ${numberText(middle, 3)} s`);
  }
}

/** A bar for each limit state, with its interval; a click chooses one. */
function outcomeBars(cells, cell, chosen, choose) {
  const body = html("tbody");
  cells.limits.forEach(({words}, limit) => {
    const {probability, lower, upper} = cells.share(limit, cell);
    const bar = svg("svg", {viewBox: "0 0 100 12", preserveAspectRatio: "none", "aria-hidden": "true"});
    if (probability !== null)
      bar.append(svg("rect", {class: "bar", y: 1, height: 10, width: 100 * probability}),
                 svg("rect", {class: "interval", y: 4.5, height: 3, x: 100 * lower, width: Math.max(0.5, 100 * (upper - lower))}));
    body.append(html("tr", {class: limit === chosen ? "here" : "", "data-limit": cells.limits[limit].name,
                            click: () => choose(limit)},
        html("th", {scope: "row"}, words), html("td", {class: "of-bar"}, bar),
        html("td", {class: "r"}, shareText(probability, lower, upper))));
  });
  return html("table", {class: "outcome-bars"}, html("caption", {}, `In brackets: ${cells.data.interval}.`), body);
}
