// The map of a surface: what is known of a cell under the pointer or under the keys; a click or Enter opens the cell.
// Data: {rows, row_name, row_symbol, row_option, pga_m_s2, interval, trials, collapses, probability, lower, upper, file, [method], [outcomes:
// {state: [counts]}, first: {cell: [[name, count]]}, times: {cell: [first, median, last]}], [rose: {cell: [falls by
// direction]}]}; arrays by cell, row x PGAs + PGA; the rows are columns of the map.

class CellMap {
  constructor(drawing, data, store) {
    this.drawing = drawing;
    this.figure = drawing.closest("figure");
    this.data = data;
    this.store = store;
    this.rows = data.pga_m_s2.length;
    this.columns = data.rows.length;
    this.rects = [];
    for (const rect of drawing.querySelectorAll("[data-cell]")) this.rects[Number(rect.dataset.cell)] = rect;
    this.tip = new Tip(this.figure);
    this.outline = svg("rect", {class: "mark", "stroke-width": 2.5, visibility: "hidden"});
    drawing.append(this.outline);
    this.cell = 0;
    this.figure.before(html("p", {class: "note only-with-script"}, "Pointer or arrow keys: the values of a cell. ",
                            "Click or Enter: its outcomes", store ? ", and some of its realizations in motion." : "."));
    filled(drawing, {
      tabindex: 0,
      role: "application",
      "aria-label": "Map of the cells. The arrow keys go from cell to cell, Enter opens one. The table below has all.",
      pointermove: (event) => this.point(event),
      pointerleave: () => this.leave(),
      click: (event) => {
        const rect = event.target.closest("[data-cell]");
        if (rect) this.open(Number(rect.dataset.cell));
      },
      focus: () => drawing.matches(":focus-visible") && this.look(this.cell, true),
      blur: () => this.leave(),
      keydown: (event) => this.key(event),
    }, []);
  }

  // ---- what is known of a cell ----

  title(cell) {
    return `${this.row(cell)}, PGA ${numberText(this.data.pga_m_s2[cell % this.rows])} m/s²`;
  }

  row(cell) {
    return `${numberText(this.data.rows[Math.floor(cell / this.rows)])}${this.data.row_symbol}`;
  }

  facts(cell) {
    const d = this.data;
    const rows = [[d.row_name, this.row(cell)],
                  ["PGA", `${numberText(d.pga_m_s2[cell % this.rows])} m/s²`]];
    if (!d.trials[cell]) return [...rows, ["realizations", "none"]];
    rows.push(["probability of collapse", percentText(d.probability[cell])],
              [d.interval, `${percentText(d.lower[cell])} to ${percentText(d.upper[cell])}`],
              ["collapsed", `${d.collapses[cell]} of ${d.trials[cell]}`]);
    for (const [state, counts] of Object.entries(d.outcomes ?? {})) rows.push([state, String(counts[cell])]);
    if (d.method) rows.push(["interval by", d.method[cell]]);
    return rows;
  }

  /** @param keys whether by the keys: then it is spoken */
  look(cell, keys) {
    const rect = this.rects[cell];
    this.cell = cell;
    for (const name of ["x", "y", "width", "height"]) this.outline.setAttribute(name, rect.getAttribute(name));
    this.outline.setAttribute("visibility", "visible");
    const place = placeIn(this.figure, this.drawing), facts = this.facts(cell);
    this.tip.show(readings(`Cell ${cell}`, facts),
                  place.left + (Number(rect.getAttribute("x")) + Number(rect.getAttribute("width")) / 2) * place.scale,
                  place.top + Number(rect.getAttribute("y")) * place.scale);
    if (keys) say(facts.map(([name, value]) => `${name} ${value}`).join(", "));
  }

  leave() {
    this.tip.hide();
    this.outline.setAttribute("visibility", "hidden");
  }

  point(event) {
    const rect = event.target.closest("[data-cell]");
    if (rect) this.look(Number(rect.dataset.cell), false);
    else this.leave();
  }

  key(event) {
    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (event.key in steps) {
      event.preventDefault();
      const [df, dp] = steps[event.key];
      const f = clamp(Math.floor(this.cell / this.rows) + df, 0, this.columns - 1);
      this.look(f * this.rows + clamp(this.cell % this.rows + dp, 0, this.rows - 1), true);
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.open(this.cell);
    } else if (event.key === "Escape") {
      this.close();
    }
  }

  // ---- a cell that is open ----

  open(cell) {
    this.close();
    this.cell = cell;
    const d = this.data, title = this.title(cell);
    this.panel = html("section", {class: "cell-panel only-with-script", "aria-label": `cell ${cell}, ${title}`,
      keydown: (event) => {
        if (event.key !== "Escape") return;
        this.close();
        this.drawing.focus();
      }},
      html("button", {type: "button", class: "close", click: () => { this.close(); this.drawing.focus(); }}, "Close (Esc)"),
      html("h3", {}, `Cell ${cell}: ${title}`));
    const body = html("tbody");
    for (const [name, value] of this.facts(cell).slice(2))
      body.append(html("tr", {}, html("td", {}, name), html("td", {}, value)));
    const first = d.first?.[cell], times = d.times?.[cell];
    if (first)
      body.append(html("tr", {}, html("td", {}, "fell first"),
                       html("td", {}, first.map(([name, count]) => `${name}: ${count}`).join(", "))));
    if (times)
      body.append(html("tr", {}, html("td", {}, "time of the first fall"), html("td", {},
          `median ${numberText(times[1], 3)} s (${numberText(times[0], 3)} to ${numberText(times[2], 3)} s)`)));
    this.panel.append(html("table", {class: "facts"}, body));
    if (d.rose?.[cell])
      this.panel.append(html("div", {class: "of-falls"}, roseOf(d.rose[cell], `directions of the falls of cell ${cell}`),
          html("p", {class: "note"}, "Directions of the falls from above, x to the right, z downwards: areas are numbers of ",
               "realizations.")));
    const list = this.store ? this.store.list.filter((one) => one.cell === cell) : [];
    if (list.length) {
      this.player = playerOf(this.store, list);
      this.panel.append(this.player.element);
    } else if (d.trials[cell]) {
      const f = d.rows[Math.floor(cell / this.rows)], p = d.pga_m_s2[cell % this.rows];
      this.panel.append(html("p", {class: "note"}, "The page has no animation of this cell. One of its realizations: ",
          html("code", {}, `stylobate replay ${d.file} ${d.row_option} ${numberText(f, 6)} --pga ${numberText(p, 6)} -o one.h5`)));
    }
    this.figure.after(this.panel);
    (this.player ? this.player.stage : this.panel.querySelector(".close")).focus({preventScroll: true});
    this.panel.scrollIntoView({block: "nearest"});
  }

  close() {
    this.player?.pause();
    this.player = null;
    this.panel?.remove();
    this.panel = null;
  }
}
