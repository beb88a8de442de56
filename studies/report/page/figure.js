// A figure that the program has drawn: values under the pointer or under the keys, and series that can be switched off.
// The drawing itself stays as it is; its data stand behind it in a script with the class `figure-data`:
//
//   {x: {from, to, log, first, last, label, ticks}, y: {...}, series: [{name, group, layer, kind, shown, x, y, low, high}]}
//
// first and last are where the ends of an axis lie [px]. A group of the drawing has data-series, its number.

class FigureAxis {
  constructor(axis) {
    Object.assign(this, axis);
  }
  px(value) {
    const scaled = this.log ? Math.log10 : (v) => v;
    const part = (scaled(value) - scaled(this.from)) / (scaled(this.to) - scaled(this.from));
    return this.first + part * (this.last - this.first);
  }
  text(value) {
    return this.ticks && this.ticks.length ? this.ticks[Math.round(value)] : numberText(value);
  }
}

class LiveFigure {
  constructor(drawing, data) {
    this.figure = drawing.closest("figure");
    this.drawing = drawing;
    this.x = new FigureAxis(data.x);
    this.y = new FigureAxis(data.y);
    this.series = data.series.map((series, i) => ({...series, element: drawing.querySelector(`[data-series="${i}"]`)}));
    const groupOf = (series) => series.group || series.name;
    const shown = new Set(this.series.filter((series) => series.shown !== false).map(groupOf));
    this.hiddenGroups = new Set(this.series.map(groupOf).filter((group) => !shown.has(group)));
    this.hiddenLayers = new Set();
    this.tip = new Tip(this.figure);
    this.marks = svg("g", {class: "marks"});
    drawing.append(this.marks);
    this.makeKeys();
    this.makeLayers();
    this.redraw();
    this.listen();
  }

  shown(series) {
    return !this.hiddenGroups.has(series.group || series.name) && !this.hiddenLayers.has(series.layer);
  }

  // ---- switches ----

  makeKeys() {
    for (const key of this.drawing.querySelectorAll(".key")) {
      const group = key.dataset.group;
      const mark = () => {
        const off = this.hiddenGroups.has(group);
        key.classList.toggle("off", off);
        key.setAttribute("aria-pressed", String(!off));
      };
      const flip = (event) => {
        if (event.type === "keydown" && event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        event.stopPropagation();
        if (!this.hiddenGroups.delete(group)) this.hiddenGroups.add(group);
        mark();
        this.redraw();
      };
      const box = key.getBBox(); // gaps between the letters belong to it too
      key.prepend(svg("rect", {x: box.x, y: box.y - 2, width: box.width, height: box.height + 4,
                               fill: "transparent"}));
      filled(key, {role: "button", tabindex: 0, "aria-pressed": "true", "aria-label": `show ${group}`, click: flip,
                   keydown: flip}, []);
      mark();
    }
  }

  makeLayers() {
    const layers = [...new Set(this.series.map((series) => series.layer).filter(Boolean))];
    if (layers.length < 2) return;
    const bar = html("div", {class: "controls", role: "group", "aria-label": "what is drawn"});
    for (const layer of layers) {
      const button = html("button", {type: "button", "aria-pressed": "true", click: () => {
        if (!this.hiddenLayers.delete(layer)) this.hiddenLayers.add(layer);
        button.setAttribute("aria-pressed", String(!this.hiddenLayers.has(layer)));
        this.redraw();
      }}, layer);
      bar.append(button);
    }
    this.figure.prepend(bar);
  }

  redraw() {
    for (const series of this.series)
      if (series.element) series.element.style.display = this.shown(series) ? "" : "none";
    this.hide();
  }

  // ---- readings ----

  listen() {
    filled(this.drawing, {
      tabindex: 0,
      role: "group", // of a picture the switches inside would not be read
      "aria-roledescription": "figure; left and right arrow keys read its values",
      pointermove: (event) => this.at(event),
      pointerdown: (event) => this.at(event),
      pointerleave: () => this.hide(),
      blur: () => this.hide(),
      keydown: (event) => this.step(event),
    }, []);
  }

  at(event) {
    const place = placeIn(this.figure, this.drawing), outer = this.figure.getBoundingClientRect();
    const px = (event.clientX - outer.left - place.left) / place.scale;
    const py = (event.clientY - outer.top - place.top) / place.scale;
    this.read(px, py, 40);
  }

  /** The values nearest to a place. @param most as far as this they are read [px]   @returns what is read, as text */
  read(px, py, most) {
    let nearest = Infinity, at = null;
    const found = [];
    for (const series of this.series) {
      if (!this.shown(series)) continue;
      if (series.kind === "spans") continue;
      let best = -1, distance = Infinity;
      for (let i = 0; i < series.x.length; ++i) {
        if (series.x[i] === null || (series.y.length && series.y[i] === null)) continue;
        const d = Math.abs(this.x.px(series.x[i]) - px);
        if (d < distance) [best, distance] = [i, d];
      }
      if (best < 0) continue;
      found.push({series, i: best, distance});
      if (distance < nearest) [nearest, at] = [distance, series.x[best]];
    }
    if (at === null || nearest > most) {
      this.hide();
      return "";
    }
    const rows = [], parts = [];
    this.marks.replaceChildren(svg("line", {class: "mark", x1: this.x.px(at), x2: this.x.px(at), y1: this.y.first,
                                            y2: this.y.last, "stroke-width": 1, opacity: 0.4}));
    for (const {series, i, distance} of found) {
      if (distance > nearest + 3) continue; // it has nothing here
      const value = series.y.length ? series.y[i] : null;
      let text = value === null ? "" : numberText(value);
      if (series.low.length && series.low[i] !== null && series.high[i] !== null)
        text += ` (${numberText(series.low[i])} to ${numberText(series.high[i])})`;
      const name = [series.name || series.group, series.layer].filter(Boolean).join(", ");
      rows.push([name || this.y.label, text, `var(--s${series.colour})`]);
      parts.push(`${name || this.y.label}: ${text}`);
      if (value !== null && series.kind !== "bars") // bars stand beside their place
        this.marks.append(svg("circle", {class: "mark", cx: this.x.px(series.x[i]), cy: this.y.px(value), r: 5}));
    }
    const title = `${this.x.label ? this.x.label + ": " : ""}${this.x.text(at)}`;
    const place = placeIn(this.figure, this.drawing);
    this.tip.show(readings(title, rows.slice(0, 12)), place.left + this.x.px(at) * place.scale,
                  place.top + clamp(py, this.y.last + 60, this.y.first) * place.scale);
    this.current = at;
    return `${title}. ${parts.join("; ")}`;
  }

  hide() {
    this.tip.hide();
    this.marks.replaceChildren();
  }

  /** The arrow keys go from value to value. */
  step(event) {
    const steps = {ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity};
    if (event.key === "Escape") return this.hide();
    if (!(event.key in steps) || event.target !== this.drawing) return;
    event.preventDefault();
    const places = [...new Set(this.series.filter((series) => this.shown(series) && series.kind !== "spans")
                                   .flatMap((series) => series.x))].filter((x) => x !== null).sort((a, b) => a - b);
    if (!places.length) return;
    let before = places.findIndex((x) => x >= this.current);
    if (before < 0) before = steps[event.key] > 0 ? -1 : places.length; // nothing was read yet
    const next = clamp(before + steps[event.key], 0, places.length - 1);
    say(this.read(this.x.px(places[next]), this.y.last, Infinity));
  }
}
