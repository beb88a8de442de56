// The page of a surface as one instrument: what is chosen (cell, realization, limit state, slice, colour, contour) stands
// in one place; map, player, outcomes, slice and falls all show it, and each of them can change it. The address of the
// page has the choice behind its #, so that a link opens the same.

const usualLevels = "0.05, 0.5, 0.95";

/** The numbers of a list; null if one is no probability between 0 and 1. */
function levelsOf(text) {
  const levels = text.split(/[,;\s]+/).filter((word) => word !== "").map(Number);
  return levels.every((level) => level > 0 && level < 1) ? levels : null;
}

class Instrument {
  /** @param place the element around the map   @param store the animations of the page, or null */
  constructor(place, cells, store) {
    this.cells = cells;
    this.store = store;
    this.place = place;
    this.map = new CellMap(place.querySelector("svg.cells"), cells, (cell) => this.choose({cell}, true), () => this.player);
    this.slice = new SliceChart(cells, (cell) => this.choose({cell}, true));
    this.falls = new FallsChart(cells, (realization) => this.choose({realization}, true));
    this.build();
    const animated = new Set(store?.list.map((one) => one.cell) ?? []);
    const both = [...animated].filter((cell) => cells.data.probability[cell] > 0 && cells.data.probability[cell] < 1);
    this.choose({cell: cells.usual(both.length ? both : [...animated]), realization: null, limit: 0, slice: "pga",
                 colour: "probability", contour: usualLevels});
    this.restore();
    addEventListener("hashchange", () => this.restore());
  }

  // ---- what it is made of ----

  build() {
    const {data, limits} = this.cells;
    const select = (name, label, options) => {
      this.controls[name] = html("select", {change: (event) => this.choose({[name]: event.target.value}, true)},
                                ...options.map(([value, text]) => html("option", {value}, text)));
      return html("label", {}, label, " ", this.controls[name]);
    };
    this.controls = {};
    const bar = html("div", {class: "controls chooser only-with-script", role: "group", "aria-label": "what is shown"},
        select("limit", "Limit state", limits.map(({words}, i) => [i, words])),
        select("colour", "Colour", this.cells.quantities(0).map(({name, label}) => [name, name === "probability" ? name : label])),
        this.contourField(),
        select("slice", "Slice over", [["pga", "PGA"], [data.row_name, data.row_name]]));
    this.title = html("h3", {});
    this.ofPlayer = html("div", {class: "of-player"});
    this.bars = html("div", {class: "of-bars"});
    this.sliceTitle = html("h4", {});
    this.fallsTitle = html("h4", {});
    this.facts = html("div", {class: "of-facts"});
    this.panel = html("section", {class: "cell-panel only-with-script"}, this.title, this.ofPlayer,
        html("div", {class: "of-charts"}, this.bars, this.sliceTitle, this.slice.element, this.fallsTitle, this.falls.element),
        this.facts);
    this.place.prepend(bar);
    this.place.append(this.panel);
    this.caption = this.place.querySelector("figcaption");
    this.caption.after(this.taking());
  }

  // Any levels, with commas between them; empty: none. Where one is no probability, the field says so, and the lines
  // stay.
  contourField() {
    const change = ({target}) => {
      const wrong = levelsOf(target.value) ? "" : `${target.value}: no list of probabilities between 0 and 1, like ${usualLevels}`;
      target.setCustomValidity(wrong);
      if (!wrong) return this.choose({contour: target.value.trim()}, true);
      target.reportValidity();
      say(wrong);
    };
    this.controls.contour = html("input", {type: "text", size: 14, inputmode: "decimal", "aria-label": "Contours", change});
    return html("label", {title: "Probabilities, with commas between them; empty: no lines"}, "Contours ",
                this.controls.contour);
  }

  /** What can be taken along. */
  taking() {
    const {cells} = this, every = [...Array(cells.count).keys()];
    const button = (words, action) => html("button", {type: "button", click: action}, words);
    const csv = (words, of) => button(words, () => copyText(of(), words));
    const name = cells.data.file.replace(/\.[^.]*$/, "");
    return html("details", {class: "take only-with-script"}, html("summary", {}, "Copy data, save the picture, link"),
        html("div", {class: "controls"},
            csv("Map as CSV", () => cells.csv(every, [this.choice.limit])),
            csv("Slice as CSV", () => cells.csv(this.slice.list(), [this.choice.limit])),
            csv("Cell as CSV", () => cells.csv([this.choice.cell], [...cells.limits.keys()])),
            button("Map as SVG", () => download(`${name}_map.svg`, pictureOf(this.map.drawing))),
            button("Map as PNG", async () => {
              const url = await pixelsOf(this.map.drawing);
              if (url) download(`${name}_map.png`, url);
              else say("This browser has no canvas: it saves no PNG, but the SVG.");
            }),
            button("Link to this cell", () => {
              this.write();
              copyText(location.href, "Link");
            })));
  }

  // ---- the choice ----

  /** @param changes to the choice   @param told whether the reader has made them: they are spoken, and go into the address */
  choose(changes, told = false) {
    const before = this.choice ?? {};
    if ("limit" in changes) changes.limit = Number(changes.limit);
    if ("cell" in changes && changes.cell !== before.cell && !("realization" in changes)) changes.realization = null;
    this.choice = {...before, ...changes};
    const changed = (...names) => names.some((name) => before[name] !== this.choice[name]);
    const {cell, limit, slice, colour, contour} = this.choice;
    if (changed("cell")) this.openCell();
    else if (changed("realization")) this.showRealization();
    if (changed("limit", "colour")) this.map.paint(this.cells.quantities(limit).find(({name}) => name === colour));
    if (changed("limit", "contour")) this.map.contour(limit, this.levels());
    this.map.limit = limit;
    this.map.open(cell);
    if (changed("cell", "limit")) {
      this.bars.replaceChildren(outcomeBars(this.cells, cell, limit, (other) => this.choose({limit: other}, true)));
      this.facts.replaceChildren(...this.factsOf(cell));
    }
    this.slice.show({cell, limit, over: slice});
    this.sliceTitle.textContent = this.slice.title();
    this.showFalls();
    this.caption.textContent = `${this.captionText()} Click or arrow keys: opens a cell.`;
    for (const [name, control] of Object.entries(this.controls)) control.value = String(this.choice[name]);
    if (!told) return;
    this.write();
    if (changed("cell", "limit"))
      say([`Cell ${cell}`, ...this.cells.facts(limit, cell).map(([name, value]) => `${name} ${value}`)].join(", "));
  }

  levels() {
    return levelsOf(this.choice.contour);
  }

  captionText() {
    const {limit, colour} = this.choice, {label} = this.cells.quantities(limit).find(({name}) => name === colour);
    const levels = this.levels(), words = this.cells.limits[limit].words;
    const lines = levels.length ? ` Lines: ${colour === "probability" ? "" : `probability of ${words} `}${levels.join(", ")}.` : "";
    return `${label[0].toUpperCase()}${label.slice(1)} over ${this.cells.data.row_name} and PGA.${lines}`;
  }

  // ---- the open cell ----

  openCell() {
    const {cell, realization} = this.choice, {data} = this.cells, trials = data.trials[cell];
    this.title.textContent = `Cell ${cell}: ${this.cells.title(cell)}; ${trials} realization${trials === 1 ? "" : "s"}`;
    this.panel.setAttribute("aria-label", `cell ${cell}, ${this.cells.title(cell)}`);
    this.player?.pause();
    this.player = null;
    this.list = this.store ? this.store.list.filter((one) => one.cell === cell) : [];
    const parts = [];
    if (realization !== null && !this.list.some((one) => one.index === realization)) {
      parts.push(html("p", {class: "note"}, `The page has no animation of realization ${realization} in this cell. `,
                      html("code", {}, `stylobate replay ${data.file} --realization ${realization} -o one.h5`)));
      this.choice.realization = null;
    }
    if (this.list.length) {
      this.player = playerOf(this.store, this.list);
      this.player.element.addEventListener("chosen", (event) => {
        if (event.detail.index !== this.choice.realization) this.choose({realization: event.detail.index}, true);
      });
      this.choice.realization ??= this.list[0].index;
      this.showRealization();
      parts.push(this.player.element);
    } else if (trials) {
      parts.push(html("p", {class: "note"}, "The page has no animation of this cell. One of its realizations: ",
          html("code", {}, `stylobate replay ${data.file} ${data.row_option} ${numberText(data.rows[this.cells.row(cell)], 6)} ` +
              `--pga ${numberText(data.pga_m_s2[this.cells.pga(cell)], 6)} -o one.h5`)));
    }
    this.ofPlayer.replaceChildren(...parts);
  }

  showRealization() {
    const place = this.list.findIndex((one) => one.index === this.choice.realization);
    if (this.player && place >= 0 && place !== this.player.place) this.player.choose(place);
  }

  showFalls() {
    const {cell, realization} = this.choice, times = this.cells.fallTimes(cell);
    this.falls.element.hidden = !times?.length;
    this.fallsTitle.textContent = times === null ? "The results have no rows of realizations: the times of falls are not known."
        : times.length ? `Times of ${times.length} first fall${times.length === 1 ? "" : "s"}` : "No realization of this cell fell.";
    if (times?.length) this.falls.show({times, list: this.list, realization});
  }

  factsOf(cell) {
    const {data} = this.cells, body = html("tbody");
    const row = (name, value) => body.append(html("tr", {}, html("td", {}, name), html("td", {}, value)));
    for (const [name, value] of this.cells.facts(this.choice.limit, cell).slice(4)) row(name, html("span", {class: "n"}, value));
    const first = data.first?.[cell], times = data.times?.[cell];
    if (first) row("fell first", first.map(([name, count]) => `${name}: ${count}`).join(", "));
    if (times)
      row("time of the first fall", `median ${numberText(times[1], 3)} s (${numberText(times[0], 3)} to ${numberText(times[2], 3)} s)`);
    const parts = [html("table", {class: "facts"}, body)];
    if (data.rose?.[cell])
      parts.push(html("div", {class: "of-falls"}, roseOf(data.rose[cell], `directions of the falls of cell ${cell}`),
          html("p", {class: "note"}, "Directions of the falls from above, x to the right, z downwards: areas are numbers of ",
               "realizations.")));
    return parts;
  }

  // ---- the address ----

  write() {
    const {cell, realization, limit, slice, colour, contour} = this.choice;
    const words = new URLSearchParams({cell});
    if (realization !== null) words.set("realization", realization);
    words.set("limit", this.cells.limits[limit].name);
    words.set("slice", slice);
    if (colour !== "probability") words.set("colour", colour);
    if (contour !== usualLevels) words.set("contour", contour);
    history.replaceState(null, "", `#${words}`);
  }

  /** Takes what the address has; what the page does not have is left out, and spoken. */
  restore() {
    const words = new URLSearchParams(location.hash.slice(1)), changes = {};
    if (!words.has("cell")) return; // of a section, or nothing
    const number = (name) => /^\d+$/.test(words.get(name) ?? "") ? Number(words.get(name)) : null;
    const cell = number("cell"), limit = this.cells.limits.findIndex(({name}) => name === words.get("limit"));
    if (cell !== null && cell < this.cells.count) Object.assign(changes, {cell, realization: number("realization")});
    else say(`The page has no cell ${words.get("cell")}.`);
    if (limit >= 0) changes.limit = limit;
    if (levelsOf(words.get("contour") ?? "none")) changes.contour = words.get("contour");
    for (const name of ["slice", "colour"])
      if ([...this.controls[name].options].some(({value}) => value === words.get(name))) changes[name] = words.get(name);
    this.choose(changes);
  }
}
