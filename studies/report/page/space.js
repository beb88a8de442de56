// Realizations of structures in space in motion (player.js): a view that can be turned (solid.js), and a plan with the
// orbits of blocks. The animations have these members besides:
//
//   {dimensions: 3, pivot, reach, round: [0, 1 or 2], orbits: [block], list: [{azimuth_rad}]}
//
// pivot: height of the middle of the drawing above the ground [px]; reach: half the side of the ground [px]; orbits:
// blocks whose orbits are drawn at first; azimuth_rad: direction of the fall, from x towards z, where there is one.
//
// The data have for each block half its height, half sizes of its bottom along x and z, and of its top; then x, y and z of
// its middle and its rotation vector; at the end x, y and z of the base. A rotation is in quanta of a radian over the half
// diagonal in quanta. The rotation vector goes on where the angle passes a whole turn.

const viewNames = {oblique: [0.52, 0.35], front: [0, 0], side: [Math.PI / 2, 0], above: [0, Math.PI / 2]};

/** Half the diagonal of a block. @param size of the data */
function halfDiagonal([height, x0, z0, x1, z1]) { return Math.hypot(height, Math.max(x0, x1), Math.max(z0, z1)); }

class SpacePlayer extends Player {
  buildStage() {
    const {width, height} = this.store;
    [this.azimuth, this.elevation] = viewNames.oblique;
    this.stage = html("canvas", {class: "stage turns", role: "img", tabindex: 0, style: `aspect-ratio:${width}/${height}`,
      pointerdown: (event) => {
        this.stage.setPointerCapture(event.pointerId);
        this.held = [event.clientX, event.clientY];
      },
      pointermove: (event) => {
        if (!this.held || !event.buttons) return;
        const [x, y] = this.held;
        this.held = [event.clientX, event.clientY];
        this.turn((x - event.clientX) * 0.01, (event.clientY - y) * 0.01);
      },
      pointerup: () => { this.held = null; },
      pointercancel: () => { this.held = null; },
    });
    this.plan = svg("svg", {class: "plan", viewBox: "0 0 300 300", role: "img"});
    this.keys = html("p", {class: "orbit-keys"});
    this.views = html("div", {class: "controls", role: "group", "aria-label": "view"},
        ...Object.entries(viewNames).map(([name, [azimuth, elevation]]) =>
            html("button", {type: "button", click: () => this.lookFrom(azimuth, elevation)}, name)));
    this.orbitChoice = html("select", {"aria-label": "orbits in the plan", change: () => this.buildPlan()},
        html("option", {value: ""}, "orbits of the tops"),
        ...this.store.blocks.map((name, block) => html("option", {value: block}, `orbit of ${name}`)));
    this.larger = html("select", {"aria-label": "size of displacements in the plan", change: () => this.buildPlan()});
    for (const factor of [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000])
      this.larger.append(html("option", {value: factor}, factor === 1 ? "plan to scale" : `displacements × ${factor}`));
    new ResizeObserver(() => this.fit()).observe(this.stage);
    new ResizeObserver(() => this.bodies && this.buildPlan()).observe(this.plan);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  drawings() {
    return [html("div", {class: "in-space"},
        html("div", {class: "view"}, this.stage, this.views),
        html("div", {class: "from-above"}, this.plan, this.keys,
             html("div", {class: "controls"}, this.orbitChoice, this.larger)))];
  }

  numbersOf(one) { return decoded(one, this.store.blocks.length, 5, 6, 3); }
  noteText() { return "Dragging, or a and d, turns the view; w and s raise and lower the eye. "; }

  moreKeys() {
    return {a: () => this.turn(-0.1, 0), d: () => this.turn(0.1, 0), w: () => this.turn(0, 0.1), s: () => this.turn(0, -0.1)};
  }

  // ---- where things are ----

  /** Middle [px; from the middle of the ground] and attitude of a block at a sample. */
  poseAt(block, sample) {
    const {sizes, channels} = this.now, quantum = this.store.quantum_px;
    const value = (channel) => channels[6 * block + channel][sample], radian = halfDiagonal(sizes[block]);
    return [[0, 1, 2].map((c) => value(c) * quantum), attitudeOf([3, 4, 5].map((c) => value(c) / radian))];
  }

  /** The same at the time that is shown. */
  placeOf(block) {
    const [a, p] = this.poseAt(block, this.sample), [b, q] = this.poseAt(block, this.nextSample);
    return [a.map((x, i) => x + this.share * (b[i] - x)), between(p, q, this.share)];
  }

  /** Displacement of the base at the time that is shown [px]. */
  base() { return [0, 1, 2].map((c) => this.value(6 * this.store.blocks.length + c) * this.store.quantum_px); }

  baseText() {
    const [x, y, z] = this.base().map((value) => numberText(value / this.store.px_m, 3));
    return `x ${x} m, z ${z} m${y === "0" ? "" : `, ${y} m up`}`;
  }

  baseCurves() {
    const [x, , z] = this.now.channels.slice(-3);
    return {curves: [["history", x], ["history across", z]],
            name: "displacement of the base along x, and along z (broken)"};
  }

  saysText() {
    const tilts = this.store.blocks.map((_, block) => tiltOf(this.placeOf(block)[1]));
    const most = tilts.reduce((best, tilt, block) => tilt > tilts[best] ? block : best, 0);
    const tilt = `Largest tilt: ${(tilts[most] * 180 / Math.PI).toFixed(1)}° (${this.store.blocks[most]}).`;
    const azimuth = this.one.azimuth_rad;
    const has = azimuth !== undefined && this.one.falls.some(([, time]) => time <= this.time + 1e-9);
    const fall = has ? ` The first one fell towards ${Math.round(azimuth * 180 / Math.PI)}° from x towards z.` : "";
    return `${tilt} ${super.saysText()}${fall}`;
  }

  // ---- the view ----

  turn(azimuth, elevation) { this.lookFrom(this.azimuth + azimuth, this.elevation + elevation); }

  lookFrom(azimuth, elevation) {
    this.azimuth = azimuth;
    this.elevation = clamp(elevation, 0, Math.PI / 2); // never from below the ground
    this.draw();
  }

  setBlocks() {
    const quantum = this.store.quantum_px;
    this.bodies = this.now.sizes.map((size, block) => {
      const [height, x0, z0, x1, z1] = size.map((length) => length * quantum);
      return bodyOf(height, [x0, z0], [x1, z1], this.store.round[block]);
    });
    const steps = Array.from(this.larger.options, (option) => Number(option.value));
    const fits = steps.filter((factor) => factor * this.farthest() <= this.narrowest() / 2);
    this.larger.value = String(Math.max(1, ...fits));
    this.buildPlan();
  }

  /** The canvas has as many points as its place on the screen. */
  fit() {
    const scale = window.devicePixelRatio || 1;
    this.stage.width = Math.max(1, Math.round(this.stage.clientWidth * scale));
    this.stage.height = Math.max(1, Math.round(this.stage.clientHeight * scale));
    this.draw();
  }

  draw() {
    this.drawView();
    this.drawPlan();
  }

  drawView() {
    const pen = this.stage.getContext("2d"), {width, height, pivot} = this.store;
    const look = getComputedStyle(this.element ?? this.stage);
    const colour = (name) => look.getPropertyValue(`--${name}`).trim() || "#888";
    const scale = this.stage.width / width; // points for each pixel of the drawing
    const view = viewFrom(this.azimuth, this.elevation);
    const onPaper = ([x, y]) => [width / 2 + x, height / 2 - y];
    const place = (p) => onPaper(seen(view, [p[0], p[1] - pivot, p[2]]));
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, width, height);
    const trace = (points) => {
      pen.beginPath();
      points.forEach(([x, y], i) => i ? pen.lineTo(x, y) : pen.moveTo(x, y));
      pen.closePath();
    };
    this.drawGround(pen, trace, place, colour);
    pen.lineJoin = "round";
    const shapes = this.bodies.map((body, block) => {
      const [[x, y, z], attitude] = this.placeOf(block);
      return appearance(body, [x, y - pivot, z], attitude, view);
    });
    for (const block of paintOrder(shapes)) {
      const {faces, outline} = shapes[block], fallen = this.hasFallen(block), {round} = this.bodies[block];
      const stone = colour(fallen ? "fallen" : this.store.look[block]);
      for (const {points, normal, number} of faces) {
        trace(points.map(onPaper));
        pen.fillStyle = pen.strokeStyle = shaded(pen, stone, brightness(normal));
        pen.lineWidth = 0.8;
        pen.fill();
        pen.stroke(); // no light comes between two faces
        if (round && number > 1) continue;
        pen.strokeStyle = colour("edge");
        pen.lineWidth = 0.7;
        pen.stroke();
      }
      trace(outline.map(onPaper));
      pen.setLineDash(fallen ? [3, 2] : []);
      pen.strokeStyle = colour("edge");
      pen.lineWidth = fallen ? 1.8 : 1;
      pen.stroke();
      pen.setLineDash([]);
    }
    this.drawAxes(pen, view, colour);
    this.stage.dataset.view = `${this.azimuth.toFixed(3)} ${this.elevation.toFixed(3)}`;
  }

  /** The ground moves with the base; its marks stand still in the laboratory. */
  drawGround(pen, trace, place, colour) {
    const {reach, px_m} = this.store, [bx, , bz] = this.base();
    trace([[-reach, 0, reach], [reach, 0, reach], [reach, 0, -reach], [-reach, 0, -reach]].map(place));
    pen.globalAlpha = 0.55;
    pen.fillStyle = colour("ground");
    pen.fill();
    pen.globalAlpha = 0.35;
    pen.strokeStyle = colour("soft");
    pen.lineWidth = 0.8;
    const spacing = roundLength(60 / px_m) * px_m;
    const marks = (shift) => {
      const all = [];
      for (let k = Math.ceil((shift - reach) / spacing); k * spacing - shift <= reach; ++k) all.push(k * spacing - shift);
      return all;
    };
    const line = (from, to) => {
      pen.beginPath();
      pen.moveTo(...place(from));
      pen.lineTo(...place(to));
      pen.stroke();
    };
    for (const x of marks(bx)) line([x, 0, -reach], [x, 0, reach]);
    for (const z of marks(bz)) line([-reach, 0, z], [reach, 0, z]);
    pen.globalAlpha = 1;
  }

  /** Directions of the axes, in the lower left corner. */
  drawAxes(pen, view, colour) {
    const {width, height} = this.store, at = [46, height - 46], length = 26;
    const letters = 13 * width / Math.max(this.stage.clientWidth, 1); // as large on every screen
    pen.strokeStyle = pen.fillStyle = colour("ink");
    pen.lineWidth = 1.4;
    pen.font = `${letters}px sans-serif`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]].forEach(([name, axis]) => {
      const [x, y] = seen(view, axis);
      if (Math.hypot(x, y) < 0.25) return;
      pen.beginPath();
      pen.moveTo(...at);
      pen.lineTo(at[0] + x * length, at[1] - y * length);
      pen.stroke();
      const far = length + 0.6 * letters / Math.hypot(x, y);
      pen.fillText(name, at[0] + x * far, at[1] - y * far);
    });
  }

  // ---- the plan ----

  /** The blocks whose orbits are drawn. */
  orbitBlocks() { return this.orbitChoice.value === "" ? this.store.orbits : [Number(this.orbitChoice.value)]; }

  /** How a block is displaced from its first place [px], along x and z, of all samples. */
  orbitOf(block) {
    const quantum = this.store.quantum_px;
    const [x, , z] = this.now.channels.slice(6 * block, 6 * block + 3);
    return Array.from(x, (value, i) => [(value - x[0]) * quantum, (z[i] - z[0]) * quantum]);
  }

  farthest() { return Math.max(1e-9, ...this.orbitBlocks().flatMap((b) => this.orbitOf(b).map((d) => Math.hypot(...d)))); }

  narrowest() {
    return Math.min(...this.orbitBlocks().map((b) => 2 * Math.min(...this.now.sizes[b].slice(1)) * this.store.quantum_px));
  }

  /** Draws what does not change with the time: orbits, scale, axes. */
  buildPlan() {
    const factor = Number(this.larger.value), side = 300, margin = 30, told = this.orbitBlocks();
    const first = this.bodies.map((_, block) => this.poseAt(block, 0)[0]);
    const orbits = told.map((block) => this.orbitOf(block).map(([x, z]) => [first[block][0] + factor * x, first[block][2] + factor * z]));
    const [left, back, right, front] = this.planBox(first, told, orbits);
    const scale = (side - 2 * margin) / Math.max(right - left, front - back, 1e-9);
    this.onPlan = (x, z) => [side / 2 + (x - (left + right) / 2) * scale, side / 2 + (z - (back + front) / 2) * scale];
    this.first = first;
    this.outlines = this.bodies.map((_, block) => svg("polygon", {"data-block": block}));
    const byHeight = [...this.outlines.keys()].sort((a, b) => first[a][1] - first[b][1]);
    const colours = told.map((_, i) => `var(--s${i % 7})`);
    const lines = orbits.map((orbit, i) => svg("path", {class: "orbit", "data-block": told[i], style: `stroke:${colours[i]}`,
      d: orbit.map(([x, z], k) => `${k ? "L" : "M"}${this.onPlan(x, z).map((v) => v.toFixed(1)).join(" ")}`).join("")}));
    this.dots = told.map((block, i) => svg("circle", {class: "now", r: 3, "data-block": block, style: `fill:${colours[i]}`}));
    const metre = scale * this.store.px_m, length = roundLength(90 / metre), bar = length * metre;
    const letters = 12 * side / (this.plan.clientWidth || side); // as large on every screen
    this.plan.replaceChildren(...byHeight.map((block) => this.outlines[block]), ...lines, ...this.dots,
        svg("path", {class: "axes", d: "M10 10h24M10 10v24"}),
        svg("text", {x: 39, y: 8 + letters / 2, "font-size": letters}, "x"),
        svg("text", {x: 7, y: 35 + letters, "font-size": letters}, "z"),
        svg("path", {class: "axes", d: `M${290 - bar} 284v6h${bar}v-6`}),
        svg("text", {x: 284 - bar, y: 292, "font-size": letters, "text-anchor": "end"}, `${numberText(length)} m`));
    this.plan.setAttribute("aria-label", `plan, with the orbits of ${told.map((b) => this.store.blocks[b]).join(", ")}`);
    this.keys.replaceChildren(...told.slice(0, 7).map((block, i) => html("span", {},
        html("span", {class: "swatch", style: `background:${colours[i]}`}), this.store.blocks[block])),
        told.length > 7 ? `and ${told.length - 7} more` : "");
    if (this.time !== undefined) this.drawPlan();
  }

  /** What the plan shows: the blocks as they stand first, and the orbits with the blocks around them. */
  planBox(first, told, orbits) {
    let box = [Infinity, Infinity, -Infinity, -Infinity];
    const add = (x, z, halfX, halfZ) => {
      box = [Math.min(box[0], x - halfX), Math.min(box[1], z - halfZ), Math.max(box[2], x + halfX), Math.max(box[3], z + halfZ)];
    };
    const half = (block) => {
      const [, x0, z0, x1, z1] = this.now.sizes[block].map((length) => length * this.store.quantum_px);
      return [Math.max(x0, x1), Math.max(z0, z1)];
    };
    first.forEach(([x, , z], block) => add(x, z, ...half(block)));
    orbits.forEach((orbit, i) => orbit.forEach(([x, z]) => add(x, z, ...half(told[i]))));
    return box;
  }

  drawPlan() {
    const factor = Number(this.larger.value), above = viewFrom(0, Math.PI / 2);
    this.bodies.forEach((body, block) => {
      const [[x, y, z], attitude] = this.placeOf(block), [x0, , z0] = this.first[block];
      const {outline} = appearance(body, [x0 + factor * (x - x0), y, z0 + factor * (z - z0)], attitude, above);
      const points = outline.map(([right, up]) => this.onPlan(right, -up).map((v) => v.toFixed(1)).join(","));
      this.outlines[block].setAttribute("points", points.join(" "));
      this.outlines[block].setAttribute("class", `block ${this.store.look[block]}${this.hasFallen(block) ? " fallen" : ""}`);
    });
    for (const dotted of this.dots) {
      const block = Number(dotted.dataset.block), [[x, , z]] = this.placeOf(block), [x0, , z0] = this.first[block];
      const [cx, cy] = this.onPlan(x0 + factor * (x - x0), z0 + factor * (z - z0));
      dotted.setAttribute("cx", cx.toFixed(1));
      dotted.setAttribute("cy", cy.toFixed(1));
    }
  }
}

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
function roundLength(length) {
  const decade = 10 ** Math.floor(Math.log10(length));
  return decade * (length >= 5 * decade ? 5 : length >= 2 * decade ? 2 : 1);
}

/** A colour, darker. */
function shaded(pen, colour, bright) {
  pen.fillStyle = colour; // the canvas writes every colour as #rrggbb
  const parts = [1, 3, 5].map((at) => Math.round(parseInt(pen.fillStyle.slice(at, at + 2), 16) * bright));
  return `rgb(${parts.join(",")})`;
}

/** In the place of a player that would need a canvas. */
class NoPlayer {
  constructor() {
    this.element = this.stage = html("p", {class: "player note"},
        "This browser has no canvas: realizations of structures in space are not shown in motion.");
  }
  choose() {}
  pause() {}
  key() {}
}

/** The player of a page's animations. */
function playerOf(store, list) {
  if (store.dimensions === 3 && !html("canvas").getContext?.("2d")) return new NoPlayer();
  return new (store.layers ? WindowPlayer : store.dimensions === 3 ? SpacePlayer : Player)(store, list);
}
