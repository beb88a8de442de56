// The map of a surface: colours, contour lines, the open cell; readings under the pointer. The drawing is the one that
// stands in the page (html_map.cpp); the script paints it anew.

class CellMap {
  /** @param choose is called with the number of a cell   @param player the keys that are not the map's own go there */
  constructor(drawing, cells, choose, player) {
    this.drawing = drawing;
    this.figure = drawing.closest("figure");
    this.cells = cells;
    this.frame = drawing.dataset.frame.split(" ").map(Number);
    this.rects = [];
    for (const rect of drawing.querySelectorAll("[data-cell]")) this.rects[Number(rect.dataset.cell)] = rect;
    this.scale = drawing.querySelector(".scale");
    this.palette = [...this.scale.querySelectorAll("rect")].map((rect) => rect.getAttribute("fill"));
    this.tip = new Tip(this.figure);
    this.under = svg("rect", {class: "mark", "stroke-width": 1.5, visibility: "hidden"});
    this.opened = svg("g", {class: "opened", "pointer-events": "none"},
                      ...["paper", "ink"].map((tone) => svg("rect", {class: `mark ${tone}`})));
    drawing.append(this.under, this.opened);
    filled(drawing, {
      tabindex: 0,
      role: "application",
      "aria-label": "Map of the cells. The arrow keys go from cell to cell. The table below has all cells.",
      pointermove: (event) => this.point(event),
      pointerleave: () => this.leave(),
      click: (event) => {
        const rect = event.target.closest("[data-cell]");
        if (!rect) return;
        choose(Number(rect.dataset.cell));
        drawing.focus({preventScroll: true});
      },
      blur: () => this.leave(),
      keydown: (event) => {
        const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        if (!(event.key in steps)) return player()?.key(event);
        event.preventDefault();
        this.leave();
        const [df, dp] = steps[event.key];
        choose(cells.at(clamp(cells.row(this.cell) + df, 0, cells.columns - 1),
                        clamp(cells.pga(this.cell) + dp, 0, cells.pgas - 1)));
      },
    }, []);
  }

  // ---- what it shows ----

  /** @param quantity one of `Cells.quantities` */
  paint(quantity) {
    const {from, to, label} = quantity;
    this.rects.forEach((rect, cell) => {
      const value = quantity.value(cell);
      if (value === null) {
        rect.removeAttribute("fill");
        rect.setAttribute("class", "empty-cell");
      } else {
        rect.removeAttribute("class");
        rect.setAttribute("fill", this.colour(to > from ? (value - from) / (to - from) : 0));
      }
    });
    const texts = [...this.scale.querySelectorAll("text")], name = texts.pop();
    texts.forEach((text, k) => {
      const value = from + (to - from) * k / (texts.length - 1);
      text.textContent = to === 1 && from === 0 ? value.toFixed(1) : numberText(value, 2);
    });
    name.textContent = label;
  }

  /** Mixed from the colours of the scale, which stand for the middles of equal parts of it. */
  colour(share) {
    const at = clamp(share * this.palette.length - 0.5, 0, this.palette.length - 1), i = Math.floor(at);
    const parts = (colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
    const a = parts(this.palette[i]), b = parts(this.palette[Math.min(i + 1, this.palette.length - 1)]);
    return `#${a.map((part, k) => Math.round(part + (at - i) * (b[k] - part)).toString(16).padStart(2, "0")).join("")}`;
  }

  /** @param limit number of the limit state   @param levels probabilities */
  contour(limit, levels) {
    const d = this.cells.data, [left, top, width, height] = this.frame;
    const values = this.rects.map((_, cell) => this.cells.share(limit, cell).probability);
    const px = ([x, y]) => [left + x * width, top + (1 - y) * height].map((value) => value.toFixed(1)).join(" ");
    const all = levels.map((level) => mapContours(d.row_at, d.pga_at, values, level)), lines = [], labels = [];
    levels.forEach((level, k) => {
      if (!all[k].length) return;
      const path = all[k].map((line) => `M${line.map(px).join("L")}`).join("");
      for (const [tone, wide] of [["#202020", 3], ["#ffffff", 1.6]]) // seen on every colour
        lines.push(svg("path", {d: path, fill: "none", stroke: tone, "stroke-width": wide, "pointer-events": "none"}));
      const [x, y] = px(labelPlace(all[k], all.filter((_, other) => other !== k).flat())).split(" ").map(Number);
      labels.push(svg("rect", {x: x - 19, y: y - 9, width: 38, height: 17, rx: 3, fill: "#fff", "pointer-events": "none"}),
                  svg("text", {class: "on-colour", x, y: y + 4, "text-anchor": "middle", "pointer-events": "none"}, String(level)));
    });
    this.drawing.querySelector(".contours").replaceChildren(...lines, ...labels);
  }

  /** Marks the open cell. */
  open(cell) {
    this.cell = cell;
    for (const rect of this.opened.children) this.frameOf(rect, cell);
  }

  frameOf(outline, cell) {
    for (const name of ["x", "y", "width", "height"]) outline.setAttribute(name, this.rects[cell].getAttribute(name));
  }

  // ---- the pointer ----

  point(event) {
    const rect = event.target.closest("[data-cell]");
    if (!rect) return this.leave();
    const cell = Number(rect.dataset.cell), place = placeIn(this.figure, this.drawing);
    this.frameOf(this.under, cell);
    this.under.setAttribute("visibility", "visible");
    const [x, y, width] = ["x", "y", "width"].map((name) => Number(rect.getAttribute(name)));
    this.tip.show(readings(`Cell ${cell}`, this.cells.facts(this.limit ?? 0, cell)), place.left + (x + width / 2) * place.scale,
                  place.top + y * place.scale);
  }

  leave() {
    this.tip.hide();
    this.under.setAttribute("visibility", "hidden");
  }
}
