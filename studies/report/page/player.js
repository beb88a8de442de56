// Realizations in motion: a drawing of the blocks in the frame of the base, the displacement of the base below it, and
// controls. The animations stand in the page as
//
//   {rate_hz, px_m, quantum_px, width, height, ground, blocks: [name], look: [class], list: [{index, cell, state,
//    frequency_hz, pga_m_s2, [motion], samples, falls: [[block, time_s], ...], data}], [fastenings]}
//
// px_m: pixels per metre; data: see `decoded`. Fastenings are rods, tendons and clamps in the plane: {at, to}, or of a
// rod {at, right, [tip]}. `at` and `to` are [block, x, y], from the middle of the upright block [px]; block -1: of the
// base. A rod comes from the left or from the right; one that only pushes has tip: [velocity, start, travel, share of
// the laboratory in its end] [px, s]. Those of windows.js and space.js have other members besides.

/**
 * The numbers of an animation. The bytes (base64) are whole numbers of variable length, seven bits a byte, the lowest
 * first, the eighth bit set where another byte follows. First half width and half height of each block; then for each
 * block x, y and rotation, and at the end the base: the first sample, and the differences from sample to sample. A
 * difference d is written as 2 d or, below 0, -2 d - 1; a run of n zeros as 0 and n. Lengths are in quanta of
 * `quantum_px` pixels. The rotation is in quanta of a radian over the half diagonal of the block in quanta: a corner
 * moves by one.
 * @param sizes numbers of the size of each block   @param channels of each block   @param ofBase channels of the base
 */
function decoded(animation, blocks, sizes = 2, channels = 3, ofBase = 1) {
  const bytes = Uint8Array.from(atob(animation.data), (letter) => letter.charCodeAt(0));
  let at = 0;
  const number = () => {
    let value = 0, factor = 1;
    for (;;) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  };
  const signed = (code) => code % 2 ? -(code + 1) / 2 : code / 2;
  const ofBlocks = Array.from({length: blocks}, () => Array.from({length: sizes}, number));
  const lists = Array.from({length: channels * blocks + ofBase}, () => {
    const values = new Float64Array(animation.samples);
    values[0] = signed(number());
    for (let i = 1; i < values.length;) {
      const code = number();
      const run = code === 0 ? number() : 1;
      for (let k = 0; k < run && i < values.length; ++k, ++i) values[i] = values[i - 1] + (code === 0 ? 0 : signed(code));
    }
    return values;
  });
  return {sizes: ofBlocks, channels: lists};
}

const stateWords = {stood: "stood", rocked: "rocked, did not fall", slid: "slid, did not fall", collapsed: "collapsed"};

class Player {
  /** @param store the animations of the page   @param list those of them that it shows, at least one */
  constructor(store, list) {
    this.store = store;
    this.list = list;
    this.speed = 1;
    this.running = false;
    this.build();
    this.choose(0);
  }

  // ---- what it is made of ----

  build() {
    const {width} = this.store;
    this.buildStage();
    this.paths = svg("g", {});
    this.falls = svg("g", {});
    this.cursor = svg("line", {class: "cursor", y1: 4, y2: 66});
    this.label = html("p", {class: "of-strip"});
    this.strip = svg("svg", {class: "strip", viewBox: `0 0 ${width} 70`, "aria-hidden": "true"}, this.paths, this.falls,
                     this.cursor);
    this.strip.addEventListener("pointerdown", (event) => this.scrubTo(event));
    this.strip.addEventListener("pointermove", (event) => event.buttons && this.scrubTo(event));
    this.playButton = html("button", {type: "button", click: () => this.toggle(), class: "play"}, "Play");
    this.slider = html("input", {type: "range", min: 0, step: 1, "aria-label": "time", input: () => {
      this.pause();
      this.show(Number(this.slider.value) / this.rate());
    }});
    this.clock = html("span", {class: "time"});
    this.speeds = html("select", {class: "speed", "aria-label": "speed", change: () => { this.speed = Number(this.speeds.value); }});
    for (const [factor, name] of [[1, "real time"], [0.5, "1/2 speed"], [0.25, "1/4 speed"], [0.1, "1/10 speed"],
                                  [0.05, "1/20 speed"]])
      this.speeds.append(html("option", {value: factor}, name));
    this.before = html("button", {type: "button", click: () => this.choose(this.place - 1), class: "previous",
                                  "aria-label": `previous ${this.noun()}`}, "◀");
    this.after = html("button", {type: "button", click: () => this.choose(this.place + 1), class: "next",
                                 "aria-label": `next ${this.noun()}`}, "▶");
    this.choices = html("select", {class: "choices", "aria-label": `${this.noun()} that is shown`,
                                   change: () => this.choose(Number(this.choices.value))},
                        ...this.list.map((one, i) => html("option", {value: i}, this.choiceText(one))));
    this.title = html("p", {class: "which"});
    this.says = html("p", {class: "says"});
    this.element = html("div", {class: "player only-with-script", keydown: (event) => this.key(event)},
        html("div", {class: "controls"}, this.before, this.choices, this.after), this.title,
        ...this.drawings(), this.label, this.strip,
        html("div", {class: "controls"}, this.playButton, this.slider, this.clock, this.speeds),
        this.says,
        html("details", {class: "note"}, html("summary", {}, "Keys, and what is drawn"),
             "Space plays and pauses, the arrows go a sample back and on (with shift ten), ",
             `n and p choose the next and the previous ${this.noun()}. ${this.noteText()}The drawing moves with the base; `,
             "the marks on the ground stand still in the laboratory."));
  }

  // ---- what space.js does in another way ----

  /** The drawing (`stage`), which has the focus of the keys. */
  buildStage() {
    const {width, height, ground} = this.store;
    this.blocks = this.store.blocks.map(() => svg("rect", {}));
    this.ticks = svg("path", {class: "scale"});
    this.fastenings = (this.store.fastenings ?? []).map(() => svg("line", {class: "fastening"}));
    this.stage = svg("svg", {class: "stage", viewBox: `0 0 ${width} ${height}`, role: "img", tabindex: 0},
                     svg("rect", {class: "ground", x: 0, y: ground, width, height: height - ground}), this.ticks,
                     ...this.blocks, ...this.fastenings);
  }

  /** The elements above the displacement of the base. */
  drawings() { return [this.stage]; }

  /** Further keys, what they do, and what is said of them. */
  moreKeys() { return {}; }
  noteText() {
    return this.store.fastenings?.length
        ? "Lines are rods, tendons and clamps; a rod acts on the middle line of its block. " : "";
  }

  /** The numbers of an animation. */
  numbersOf(one) { return decoded(one, this.store.blocks.length); }

  /** Draws what does not change with the time. */
  setBlocks() {
    const quantum = this.store.quantum_px;
    this.now.sizes.forEach(([w, h], i) => {
      filled(this.blocks[i], {x: -w * quantum, y: -h * quantum, width: 2 * w * quantum, height: 2 * h * quantum}, []);
    });
  }

  /** The curves of the base: their classes and channels, and what they are called. */
  baseCurves() { return {curves: [["history", this.now.channels.at(-1)]], name: "displacement of the base"}; }

  /** Draws the moment: `sample`, `nextSample`, `share`. */
  draw() {
    const {quantum_px: quantum, width, ground, look} = this.store;
    this.blocks.forEach((block, b) => {
      const [x, y, turn] = this.drawn(b, ...this.placeOf(b));
      block.setAttribute("class", `block ${look[b]}${this.hasFallen(b) ? " fallen" : ""}`);
      block.setAttribute("transform", `translate(${(width / 2 + x).toFixed(2)} ${(ground - y).toFixed(2)}) ` +
          `rotate(${(-turn * 180 / Math.PI).toFixed(3)})`);
    });
    const base = this.value(3 * this.blocks.length) * quantum;
    const spacing = 40, shift = (-this.drawnBase(base) % spacing + spacing) % spacing;
    let ticks = "";
    for (let x = shift; x < width; x += spacing) ticks += `M${x.toFixed(1)} ${ground}v10`;
    this.ticks.setAttribute("d", ticks);
    this.fastenings.forEach((line, i) => this.drawFastening(line, this.store.fastenings[i], base));
  }

  /** A rod, a tendon or a clamp. @param base its displacement [px] */
  drawFastening(line, {at, to, right, tip}, base) {
    const {width, ground} = this.store;
    const placed = ([block, x, y], [u, v, turn] = block < 0 ? [0, 0, 0] : this.placeOf(block)) =>
        [u + x * Math.cos(turn) - y * Math.sin(turn), v + x * Math.sin(turn) + y * Math.cos(turn)];
    let from = placed(at);
    const end = to ? placed(to) : [(right ? 1 : -1) * width / 2, from[1]];
    if (tip) { // it leaves the block where the block is ahead of it
      const [velocity, start, travel, share] = tip;
      const path = Math.sign(velocity) * clamp(Math.abs(velocity) * (this.time - start), 0, travel);
      const reached = placed(at, this.placeAt(at[0], 0))[0] + path - share * base;
      from = [right ? Math.max(from[0], reached) : Math.min(from[0], reached), from[1]];
    }
    filled(line, {x1: width / 2 + from[0], y1: ground - from[1], x2: width / 2 + end[0], y2: ground - end[1]}, []);
  }

  /** Where the base is, as a text. */
  baseText() { return `${numberText(this.value(3 * this.blocks.length) * this.store.quantum_px / this.store.px_m, 3)} m`; }

  // ---- what windows.js does in another way ----

  noun() { return "realization"; }

  /** Samples a second. */
  rate() { return this.store.rate_hz; }

  titleText() {
    const one = this.one;
    const shaking = one.motion ? `, ${one.motion}`
        : one.frequency_hz > 0 ? ` at ${numberText(one.frequency_hz)} Hz, ${numberText(one.pga_m_s2)} m/s²` : "";
    return `Realization ${one.index}${shaking}: ${stateWords[one.state] ?? one.state}`;
  }

  /** Of the list of all. */
  choiceText(one) {
    const first = Math.min(...one.falls.map(([, time]) => time));
    return `${one.index}: ${stateWords[one.state] ?? one.state}${Number.isFinite(first) ? ` at ${numberText(first, 3)} s` : ""}`;
  }

  clockText() { return `${this.time.toFixed(3)} s of ${this.end.toFixed(3)} s`; }

  /** Where a block is drawn, of its own place [px, rad]; x from the middle, y upwards from the ground. */
  drawn(block, x, y, turn) { return [x, y, turn]; }

  /** How far the base is drawn, of its displacement [px]. */
  drawnBase(base) { return base; }

  /** What is said below the drawing, besides the place of the base. */
  saysText() {
    const fallen = this.one.falls.filter(([, t]) => t <= this.time + 1e-9);
    return fallen.length ? `Fallen: ${fallen.map(([b, t]) => `${this.store.blocks[b]} (${t.toFixed(3)} s)`).join(", ")}.`
                         : "No block has fallen.";
  }

  // ---- which realization ----

  choose(place) {
    if (place < 0 || place >= this.list.length) return;
    this.pause();
    this.place = place;
    const one = this.list[place];
    this.one = one;
    this.numbers ??= new Map();
    if (!this.numbers.has(one)) this.numbers.set(one, this.numbersOf(one));
    this.now = this.numbers.get(one);
    one.falls.sort((a, b) => a[1] - b[1]);
    this.fallTime = new Map(one.falls);
    this.end = (one.samples - 1) / this.rate();
    this.setBlocks();
    this.title.textContent = `${this.titleText()} (${place + 1} of ${this.list.length})`;
    this.stage.setAttribute("aria-label", this.title.textContent);
    this.before.hidden = this.after.hidden = this.choices.hidden = this.list.length === 1;
    this.choices.value = String(place);
    this.before.disabled = place === 0;
    this.after.disabled = place === this.list.length - 1;
    this.slider.max = one.samples - 1;
    this.drawStrip();
    this.show(0);
    this.element.dispatchEvent(new CustomEvent("chosen", {detail: one}));
  }

  /** Displacement of the base over the whole time, with the falls. */
  drawStrip() {
    const {curves, name} = this.baseCurves(), {width} = this.store;
    let most = 0;
    for (const [, values] of curves) for (const value of values) most = Math.max(most, Math.abs(value));
    const x = (i) => (i / Math.max(1, this.one.samples - 1) * (width - 2) + 1).toFixed(1);
    this.paths.replaceChildren(...curves.map(([look, values]) => {
      let line = "";
      values.forEach((value, i) => { line += `${i ? "L" : "M"}${x(i)} ${(40 - 24 * value / Math.max(most, 1)).toFixed(1)}`; });
      return svg("path", {class: look, d: line});
    }));
    this.label.textContent = most === 0 ? "the base is at rest"
        : `${name}, ± ${numberText(most * this.store.quantum_px / this.store.px_m, 3)} m`;
    this.falls.replaceChildren(...this.one.falls.filter(([, time]) => time <= this.end).map(([, time]) => {
      const at = x(time * this.rate());
      return svg("line", {class: "fall", x1: at, x2: at, y1: 50, y2: 68});
    }));
  }

  // ---- a moment ----

  /** A coordinate at the time that is shown, or the last channel: the displacement of the base [quanta]. */
  value(channel) {
    const values = this.now.channels[channel];
    return values[this.sample] + this.share * (values[this.nextSample] - values[this.sample]);
  }

  hasFallen(block) { return this.fallTime.has(block) && this.fallTime.get(block) <= this.time + 1e-9; }

  /** The place of a block at the time that is shown [px, rad]. */
  placeOf(block) { return this.placeBy(block, (channel) => this.value(channel)); }

  /** The same at a sample. */
  placeAt(block, sample) { return this.placeBy(block, (channel) => this.now.channels[channel][sample]); }

  placeBy(block, value) {
    const [w, h] = this.now.sizes[block], quantum = this.store.quantum_px;
    return [value(3 * block) * quantum, value(3 * block + 1) * quantum, value(3 * block + 2) / Math.hypot(w, h)];
  }

  show(time) {
    this.time = clamp(time, 0, this.end);
    const {width} = this.store;
    const at = this.time * this.rate(), last = this.one.samples - 1;
    this.sample = Math.min(Math.floor(at + 1e-9), last);
    this.nextSample = Math.min(this.sample + 1, last);
    this.share = clamp(at - this.sample, 0, 1);
    this.draw();
    const x = this.time / Math.max(this.end, 1e-9) * (width - 2) + 1;
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    this.slider.value = this.sample;
    this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(2)} s`);
    this.clock.textContent = this.clockText();
    this.says.textContent = `Base at ${this.baseText()}. ${this.saysText()}`;
  }

  // ---- time runs ----

  toggle() {
    if (this.running) this.pause();
    else this.play();
  }

  play() {
    if (this.time >= this.end) this.show(0);
    this.running = true;
    this.playButton.textContent = "Pause";
    let last = null;
    const frame = (now) => {
      if (!this.running) return;
      if (last !== null) this.show(this.time + (now - last) / 1000 * this.speed);
      last = now;
      this.element.dispatchEvent(new CustomEvent("frame", {detail: this.time}));
      if (this.time >= this.end) this.pause();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  pause() {
    const ran = this.running;
    this.running = false;
    this.playButton.textContent = "Play";
    if (ran) this.element.dispatchEvent(new CustomEvent("paused", {detail: this.time}));
  }

  scrubTo(event) {
    const box = this.strip.getBoundingClientRect();
    this.pause();
    this.show((event.clientX - box.left) / box.width * this.end);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const own = event.target.tagName; // a control has its own use of some keys
    const step = (event.shiftKey ? 10 : 1) / this.rate();
    const moment = (time) => { this.pause(); this.show(time); };
    const actions = {
      " ": () => this.toggle(),
      ArrowLeft: () => moment(this.time - step),
      ArrowRight: () => moment(this.time + step),
      Home: () => moment(0),
      End: () => moment(this.end),
      n: () => this.choose(this.place + 1),
      p: () => this.choose(this.place - 1),
      ...this.moreKeys(),
    };
    if (!(event.key in actions) || own === "SELECT" || (own === "BUTTON" && event.key === " ") ||
        (own === "INPUT" && event.key !== " " && event.key !== "n" && event.key !== "p")) return;
    event.preventDefault();
    actions[event.key]();
    if (event.key === "n" || event.key === "p") say(this.title.textContent);
  }
}
