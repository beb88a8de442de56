// Windows of a campaign in motion: the measured blocks over those of simulations that start from the measured state. The
// animations (player.js) have these members besides, and no states, falls or shaking:
//
//   {layers: [{name, look, first, count}], rest: [[x, y]], larger, apart, speed, list: [{title, start_s, rate_hz,
//    gone: [[block, first, last], ...]}]}
//
// layers: from the bottom to the top, so many of the blocks from the first on; the last layer was measured. rest: of each
// block, from the middle of the ground, upwards [px]. larger, apart, speed: at first; how many times as large
// displacements from there, and differences between a model and what was measured, are drawn. start_s: the cameras'
// clock at the first sample. gone: samples at which a block is unknown.

class WindowPlayer extends Player {
  build() {
    this.larger = this.store.larger;
    this.apart = this.store.apart;
    this.measured = this.store.layers.at(-1);
    this.off = new Set(); // layers that are not drawn
    super.build();
    this.speed = this.store.speed;
    this.speeds.value = String(this.speed);
    const switches = this.store.layers.map((layer, i) => html("button",
        {type: "button", class: `layer ${layer.look}`, "aria-pressed": "true", click: (event) => this.toggleLayer(i, event)},
        html("span", {class: "layer-swatch"}), layer.name));
    switches.unshift(switches.pop());
    this.stage.before(html("div", {class: "controls", role: "group", "aria-label": "what is drawn"}, ...switches,
                           this.sizes("larger", "displacements"), this.sizes("apart", "differences")));
  }

  /** How large something is drawn. @param member that has it */
  sizes(member, what) {
    const choice = html("select", {"aria-label": `size of ${what}`, change: () => {
      this[member] = Number(choice.value);
      this.show(this.time);
    }});
    for (const factor of [1, 2, 5, 10, 20, 50, 100])
      choice.append(html("option", {value: factor}, factor === 1 ? `${what} to scale` : `${what} × ${factor}`));
    choice.value = String(this[member]);
    return choice;
  }

  toggleLayer(i, event) {
    if (!this.off.delete(i)) this.off.add(i);
    event.currentTarget.setAttribute("aria-pressed", String(!this.off.has(i)));
    this.show(this.time);
  }

  noun() { return "window"; }
  rate() { return this.one.rate_hz; }
  titleText() { return this.one.title; }
  choiceText(one) { return one.title; }

  clockText() {
    return `${(this.one.start_s + this.time).toFixed(3)} s (to ${(this.one.start_s + this.end).toFixed(3)} s)`;
  }

  drawn(block, ...place) {
    const rest = [...this.store.rest[block], 0];
    const layer = this.store.layers.find(({first, count}) => block >= first && block < first + count);
    const other = layer && layer !== this.measured ? this.measured.first + block - layer.first : block;
    if (other === block || !this.isKnown(other)) return place.map((value, i) => rest[i] + this.larger * (value - rest[i]));
    const measured = this.placeOf(other);
    return place.map((value, i) => rest[i] + this.larger * (measured[i] - rest[i]) + this.apart * (value - measured[i]));
  }

  drawnBase(base) { return this.larger * base; }

  isKnown(block) {
    return !this.one.gone.some(([b, first, last]) => b === block && this.nextSample >= first && this.sample <= last);
  }

  show(time) {
    super.show(time);
    this.store.layers.forEach(({first, count}, layer) => {
      for (let b = first; b < first + count; ++b)
        this.blocks[b].style.display = this.off.has(layer) || !this.isKnown(b) ? "none" : "";
    });
  }

  /** How far the blocks of each model are from the measured ones. */
  saysText() {
    const {layers, px_m, blocks} = this.store, measured = this.measured;
    const texts = layers.slice(0, -1).map(({name, first, count}) => {
      let moved = {most: -1}, turned = {most: -1};
      for (let b = 0; b < count; ++b) {
        if (!this.isKnown(first + b) || !this.isKnown(measured.first + b)) continue;
        const [x, y, turn] = this.placeOf(first + b), [x0, y0, turn0] = this.placeOf(measured.first + b);
        const far = Math.hypot(x - x0, y - y0) / px_m, angle = Math.abs(turn - turn0);
        if (far > moved.most) moved = {most: far, block: blocks[first + b]};
        if (angle > turned.most) turned = {most: angle, block: blocks[first + b]};
      }
      return moved.most < 0 ? `${name}: unknown`
          : `${name}: ${numberText(1000 * moved.most, 3)} mm (${moved.block}), ` +
            `${numberText(1000 * turned.most, 3)} mrad (${turned.block})`;
    });
    return `Largest differences from the measured blocks: ${texts.join("; ")}.`;
  }
}
