// The page: sliders that write a study, one realization in motion, and the share of collapse with its growing interval.

const part = (id) => document.getElementById(id);

/** The share of collapse and its interval over the number of realizations. */
class Growth {
  constructor(figure) {
    this.figure = figure;
    this.waiting = null; ///< the drawing that is due
  }

  /** @param total the end of the axis */
  clear(total) {
    this.total = total;
    this.points = [];
    this.draw();
  }

  /** @param of realizations that the share is of */
  add(of, share, lower, upper) {
    const last = this.points.at(-1);
    if (last && of <= last.of) return;
    this.points.push({of, share, lower, upper});
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.draw();
    });
  }

  draw() {
    const left = 44, right = 590, top = 12, bottom = 180;
    const x = (of) => (left + (right - left) * of / this.total).toFixed(1);
    const y = (share) => (bottom + (top - bottom) * share).toFixed(1);
    const drawing = svg("svg", {viewBox: "0 0 600 215", role: "img", "aria-label": "share of collapse over the number of realizations"});
    for (const share of [0, 0.25, 0.5, 0.75, 1])
      drawing.append(svg("line", {class: "grid", x1: left, x2: right, y1: y(share), y2: y(share)}),
                     svg("text", {x: left - 6, y: Number(y(share)) + 4, "text-anchor": "end"}, `${100 * share} %`));
    drawing.append(svg("line", {class: "axis", x1: left, x2: right, y1: bottom, y2: bottom}),
                   svg("text", {x: left, y: 198, "text-anchor": "middle"}, "0"),
                   svg("text", {x: right, y: 198, "text-anchor": "end"}, `${this.total} realizations`));
    const line = (points, of) => points.map((p) => `${x(p.of)} ${y(of(p))}`).join(" L ");
    if (this.points.length)
      drawing.append(svg("path", {class: "band", d: `M ${line(this.points, (p) => p.upper)} L ${
                                                    line([...this.points].reverse(), (p) => p.lower)} Z`}),
                     svg("path", {class: "share", d: `M ${line(this.points, (p) => p.share)}`}));
    this.figure.replaceChildren(drawing);
  }
}

class Page {
  constructor(engine) {
    this.engine = engine;
    this.record = null;
    this.values = Object.fromEntries(sliders.map((one) => [one.name, one.value]));
    this.growth = new Growth(part("growth"));
    this.outcomes = []; ///< of the last ensemble, by index
    part("workers").value = Math.max(1, Math.min(64, navigator.hardwareConcurrency ?? 2));
    for (const one of sliders) part("sliders").append(this.slider(one));
    filled(part("form"), {submit: (event) => event.preventDefault()}, []);
    for (const [id, event, act] of [
      ["show", "click", () => this.show()], ["another", "click", () => this.show(Number(part("index").value) + 1)],
      ["run", "click", () => this.run()], ["stop", "click", () => this.engine.stop()],
      ["record", "change", () => this.takeRecord(part("record").files[0])], ["unit", "change", () => this.readRecord()],
      ["component", "change", () => this.chooseComponent()], ["no-record", "click", () => this.dropRecord()],
      ["realizations", "change", () => this.write()], ["download", "click", () => this.download()],
      ["link", "click", () => this.link()]])
      part(id).addEventListener(event, act);
    part("study").addEventListener("input", () => { this.opened = null; });
    this.write();
    this.openAddress();
    window.addEventListener("hashchange", () => this.openAddress());
    part("form").hidden = false;
  }

  openAddress() {
    try {
      const study = studyOfAddress(location.hash);
      if (study === null) return;
      part("study").value = study;
      this.opened = null;
      this.show(0);
    } catch (error) {
      this.refuse("The study in the address of the page cannot be read: it is no base64url of UTF-8.");
    }
  }

  slider(one) {
    const place = one.log ? (v) => Math.log(v / one.from) / Math.log(one.to / one.from) : (v) => v;
    const value = one.log ? (p) => Number((one.from * (one.to / one.from) ** p).toPrecision(3)) : (p) => Number(Number(p).toPrecision(3));
    const shown = html("output", {}, `${shortNumber(one.value)} ${one.unit}`);
    const input = html("input", {
      type: "range", min: one.log ? 0 : one.from, max: one.log ? 1 : one.to, step: one.log ? 0.002 : one.step,
      value: place(one.value), name: one.name,
      input: () => {
        this.values[one.name] = value(Number(input.value));
        shown.textContent = `${shortNumber(this.values[one.name])} ${one.unit}`;
        input.setAttribute("aria-valuetext", shown.textContent);
        this.write();
      },
      change: () => this.show(),
    });
    input.setAttribute("aria-valuetext", shown.textContent);
    return html("label", {}, one.label, shown, input);
  }

  /** Writes the study from the sliders. */
  write() {
    const realizations = Math.max(1, Math.round(Number(part("realizations").value)) || 1);
    part("study").value = studyText({...this.values, realizations, record: this.record});
    this.opened = null;
  }

  refuse(text) {
    part("refusal").textContent = text ?? "";
    part("refusal").hidden = !text;
    if (text) part("refusal").scrollIntoView({block: "nearest"});
  }

  /** Does something with the engine; what it refuses is shown. */
  async attempt(act) {
    this.refuse(null);
    try {
      return await act();
    } catch (error) {
      if (!(error instanceof EngineError)) throw error;
      if (error.message !== "stopped") this.refuse(error.message);
      return null;
    }
  }

  /** The study as the engine has read it. */
  async open() {
    const text = part("study").value;
    if (this.opened?.text !== text) this.opened = {text, facts: await this.engine.open(text)};
    return this.opened.facts;
  }

  // ---- one realization ----

  show(index = Number(part("index").value)) {
    return this.attempt(async () => {
      const facts = await this.open();
      index = Math.max(0, Math.round(index) || 0) % facts.realizations;
      part("index").value = index;
      part("shown").textContent = "computing …";
      const {store, state} = await this.engine.trace(index).finally(() => { part("shown").textContent = ""; });
      this.player?.pause();
      this.player = playerOf(store, store.list);
      part("player").replaceChildren(this.player.element);
      part("shown").textContent = stateWords[state] ?? state;
      if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.toggle();
    });
  }

  // ---- an ensemble ----

  run() {
    return this.attempt(async () => {
      const text = part("study").value, start = performance.now();
      this.opened = {text, facts: await this.engine.open(text)};
      this.growth.clear(this.opened.facts.realizations);
      this.outcomes = [];
      part("run").disabled = true;
      part("stop").disabled = false;
      part("rate").textContent = this.opened.facts.warnings.join(" ");
      try {
        await this.engine.run(text, Number(part("workers").value), (one, told) => {
          this.outcomes[one.index] = one;
          this.tell(told);
        });
      } finally {
        part("run").disabled = false;
        part("stop").disabled = true;
      }
      this.seconds = (performance.now() - start) / 1000;
      part("rate").textContent += ` ${this.seconds.toFixed(1)} s, ${
          (this.opened.facts.realizations / this.seconds).toFixed(1)} realizations per second, with ${
          this.engine.fused ? "the processor's multiply-adds" : "multiply-adds computed from sums and products"}.`;
    });
  }

  /** @param told the counts, the share of collapse and its interval */
  tell(told) {
    if (told.share === null) return;
    this.growth.add(told.of, told.share, told.lower, told.upper);
    part("answer").textContent = `${percentText(told.share)} collapsed (95 % interval ${percentText(told.lower)} to ${
        percentText(told.upper)}): ${told.done} of ${told.total} realizations, ${told.collapsed} collapsed${
        told.invalid ? `, ${told.invalid} invalid` : ""}.`;
  }

  // ---- a record ----

  async takeRecord(file) {
    if (!file) return;
    this.recordName = file.name;
    await this.engine.addFile(file.name, new Uint8Array(await file.arrayBuffer()));
    await this.readRecord();
  }

  /** Reads the record with the unit that is chosen. */
  readRecord() {
    return this.attempt(async () => {
      part("of-record").hidden = false;
      const {components} = await this.engine.record(this.recordName, part("unit").value);
      part("component").replaceChildren(...components.map((one) => html("option", {value: one.component},
          `${one.component} (${one.direction}, PGA ${numberText(one.pga_m_s2, 3)} m/s²)`)));
      this.components = components;
      this.chooseComponent();
    });
  }

  chooseComponent() {
    const one = this.components[part("component").selectedIndex];
    this.record = {file: this.recordName, unit: part("unit").value, component: this.components.length > 1 ? one.component : ""};
    part("record-note").textContent = `${this.recordName}: ${one.format}, ${one.samples} samples, ${
        numberText(one.dt_s)} s apart. It is scaled to the PGA of the slider.`;
    this.write();
    this.show();
  }

  dropRecord() {
    this.record = null;
    part("record").value = "";
    part("of-record").hidden = true;
    part("record-note").textContent = "";
    this.write();
    this.show();
  }

  // ---- the study ----

  download() {
    const link = html("a", {href: URL.createObjectURL(new Blob([part("study").value], {type: "text/plain"})), download: "study.toml"});
    link.click();
    URL.revokeObjectURL(link.href);
  }

  link() {
    history.replaceState(null, "", addressOfStudy(part("study").value));
    part("linked").textContent = "The address of this page is now the link.";
  }
}

(async () => {
  document.body.append(spoken);
  const reason = whyNoEngine();
  if (reason) {
    part("cannot").textContent = reason;
    part("cannot").hidden = false;
    return;
  }
  const engine = await Engine.load();
  await engine.ready();
  globalThis.page = new Page(engine);
  await globalThis.page.show();
  document.documentElement.dataset.alive = "yes";
})();
