// The cells of a surface: what the page knows of each of them. Data:
//
//   {rows, row_key, row_name, row_symbol, row_label, row_option, row_at, pga_m_s2, pga_at, interval, trials, collapses,
//    probability, lower, upper, file, limits: [{name, words, reached}], intervals: [[trials, reached, [lower, upper]]],
//    [method], [outcomes: {state: [counts]}, first: {cell: [[name, count]]}, times: {cell: [first, median, last]}],
//    [falls: {quantum_s, cells: {cell: text}}], [rose: {cell: [falls by direction]}]}
//
// Arrays by cell, row x PGAs + PGA; the rows are columns of the map. row_at, pga_at: places of the values in the frame
// of the map, from 0 to 1. The first limit state is the collapse, whose counts and probabilities stand outside the list.

class Cells {
  constructor(data) {
    this.data = data;
    this.pgas = data.pga_m_s2.length;
    this.columns = data.rows.length;
    this.count = this.pgas * this.columns;
    this.limits = data.limits;
    this.intervals = new Map(data.intervals.map(([trials, reached, ends]) => [`${reached} of ${trials}`, ends]));
  }

  row(cell) { return Math.floor(cell / this.pgas); }
  pga(cell) { return cell % this.pgas; }
  at(row, pga) { return row * this.pgas + pga; }

  rowText(cell) { return `${numberText(this.data.rows[this.row(cell)])}${this.data.row_symbol}`; }
  pgaText(cell) { return `${numberText(this.data.pga_m_s2[this.pga(cell)])} m/s²`; }
  title(cell) { return `${this.rowText(cell)}, PGA ${this.pgaText(cell)}`; }

  /** How often a limit state was reached. @param limit its number */
  share(limit, cell) {
    const d = this.data, trials = d.trials[cell];
    if (limit === 0)
      return {trials, reached: d.collapses[cell], probability: d.probability[cell], lower: d.lower[cell],
              upper: d.upper[cell]};
    const reached = d.limits[limit].reached[cell], [lower, upper] = this.intervals.get(`${reached} of ${trials}`);
    return {trials, reached, probability: trials ? reached / trials : null, lower, upper};
  }

  /** Names and values, for readings and tables. */
  facts(limit, cell) {
    const d = this.data, rows = [[d.row_name, this.rowText(cell)], ["PGA", this.pgaText(cell)]];
    if (!d.trials[cell]) return [...rows, ["realizations", "none"]];
    const {trials, reached, probability, lower, upper} = this.share(limit, cell);
    rows.push([`probability of ${d.limits[limit].words}`, percentText(probability)],
              [d.interval, `${percentText(lower)} to ${percentText(upper)}`],
              [limit === 0 ? "collapsed" : "reached", `${reached} of ${trials}`]);
    for (const [state, counts] of Object.entries(d.outcomes ?? {})) rows.push([state, String(counts[cell])]);
    if (d.method) rows.push(["interval by", d.method[cell]]);
    return rows;
  }

  /** Times of the first falls in a cell, ascending [s]; null where the results have no rows. */
  fallTimes(cell) {
    if (!this.data.times) return null;
    const text = this.data.falls?.cells[cell];
    if (!text) return [];
    const bytes = atob(text), times = [];
    let sum = 0, value = 0, factor = 1;
    for (const letter of bytes) { // seven bits a byte, the lowest first; the eighth: another byte follows
      const byte = letter.charCodeAt(0);
      value += (byte & 127) * factor;
      factor *= 128;
      if (byte >= 128) continue;
      sum += value;
      times.push(sum * this.data.falls.quantum_s);
      [value, factor] = [0, 1];
    }
    return times;
  }

  /**
   * What the map can show in colour: its name, what it is, its value in a cell (null: there is none), and the ends of the
   * scale. @param limit number of the limit state
   */
  quantities(limit) {
    const d = this.data, words = d.limits[limit].words;
    const all = [
      {name: "probability", label: `probability of ${words}`, value: (cell) => this.share(limit, cell).probability,
       from: 0, to: 1},
      {name: "width", label: "width of its interval", value: (cell) => {
        const {trials, lower, upper} = this.share(limit, cell);
        return trials ? upper - lower : null;
      }, from: 0, to: 1},
      {name: "trials", label: "realizations", value: (cell) => d.trials[cell], from: 0, to: Math.max(1, ...d.trials)},
    ];
    const medians = Object.values(d.times ?? {}).map(([, median]) => median);
    if (medians.length)
      all.push({name: "median", label: "median time of the first fall [s]",
                value: (cell) => d.times[cell]?.[1] ?? null, from: 0, to: Math.max(...medians)});
    return all;
  }

  /** The cell that is open at first: the one whose probability is nearest to 1/2, of these or of all. */
  usual(preferred) {
    const of = preferred.length ? preferred : [...Array(this.count).keys()];
    const far = (cell) => Math.abs((this.data.probability[cell] ?? 9) - 0.5);
    return of.reduce((best, cell) => far(cell) < far(best) ? cell : best, of[0]);
  }

  /** Cells as CSV, a line for each limit state. @param cells, limits their numbers */
  csv(cells, limits) {
    const d = this.data, lines = [["cell", d.row_key, "pga_m_s2", "limit_state", "trials", "reached", "probability",
                                   "lower", "upper"].join(",")];
    for (const cell of cells)
      for (const limit of limits) {
        const {trials, reached, probability, lower, upper} = this.share(limit, cell);
        lines.push([cell, d.rows[this.row(cell)], d.pga_m_s2[this.pga(cell)], d.limits[limit].name, trials, reached,
                    ...[probability, lower, upper].map((share) => share === null ? "" : +share.toPrecision(6))].join(","));
      }
    return `${lines.join("\n")}\n`;
  }
}
