// The text of a study from the sliders, and back from the address of the page.

/** The sliders: what they set, in words, and their range. `log`: the places of the slider are equal factors. */
const sliders = [
  {name: "columns", label: "Columns", from: 1, to: 6, value: 1, step: 1, unit: ""},
  {name: "drums", label: "Drums of a column", from: 1, to: 12, value: 6, step: 1, unit: ""},
  {name: "width", label: "Width of a drum", from: 0.03, to: 3, value: 0.048, log: true, unit: "m"},
  {name: "height", label: "Height of a drum", from: 0.02, to: 3, value: 0.029, log: true, unit: "m"},
  {name: "stiffness", label: "Stiffness of a joint", from: 1e6, to: 1e10, value: 1e8, log: true, unit: "N/m²"},
  {name: "friction", label: "Friction", from: 0.1, to: 1.2, value: 0.68, step: 0.01, unit: ""},
  {name: "damping", label: "Damping ratio", from: 0.01, to: 0.5, value: 0.1, log: true, unit: ""},
  {name: "frequency", label: "Frequency", from: 0.3, to: 15, value: 3, log: true, unit: "Hz"},
  {name: "pga", label: "PGA", from: 0.5, to: 20, value: 2.2, step: 0.1, unit: "m/s²"},
];

/** A number with three digits, as TOML and people write it. */
function shortNumber(value) {
  const rounded = Number(value.toPrecision(3));
  return rounded >= 1e5 ? rounded.toExponential().replace("+", "") : String(rounded);
}

/** The study's number (TOML): a real one has a point or an exponent. */
function real(value) {
  const text = shortNumber(value);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/**
 * A study of one column or colonnade under one excitation.
 * @param s values of the sliders, and realizations, record: null or {file, unit, component}
 */
function studyText(s) {
  const colonnade = s.columns > 1;
  const lines = [
    "# Made by the page; stylobate run study.toml gives the same outcomes.", "",
    "[study]", 'kind = "single"', "seed = 1", `realizations = ${s.realizations}`, "",
    "[structure]", `kind = "${colonnade ? "colonnade" : "column"}"`,
  ];
  if (colonnade) lines.push(`columns = ${s.columns}`, `column_spacing_m = ${real(1.5 * s.width)}`);
  lines.push(`blocks = ${s.drums + 1}                # the lowest one is fixed to the ground`, "fixed_blocks = 1",
             `drum_width_m = ${real(s.width)}`, `drum_height_m = ${real(s.height)}`, `depth_m = ${real(s.width)}`,
             "density_kg_m3 = 2028.0");
  if (colonnade) lines.push(`epistyle_height_m = ${real(s.width)}`);
  lines.push("", "[contact]", `normal_stiffness_n_m2 = ${real(s.stiffness)}`,
             `normal_damping_ratio = ${real(s.damping)}`, `tangential_damping_ratio = ${real(s.damping)}`,
             `friction = ${real(s.friction)}`, "", "[excitation]");
  if (s.record) {
    lines.push('kind = "record"', `file = ${JSON.stringify(s.record.file)}`);
    if (s.record.unit) lines.push(`unit = "${s.record.unit}"`);
    if (s.record.component) lines.push(`component = ${JSON.stringify(s.record.component)}`);
    lines.push("baseline = true", `scale_to_pga_m_s2 = ${real(s.pga)}`);
  } else {
    lines.push('kind = "harmonic"', 'start = "smooth"', 'end = "smooth"', "ramp_cycles = 2", "cycles = 10");
    lines.push(`frequency_hz = ${real(s.frequency)}`, `pga_m_s2 = ${real(s.pga)}`);
  }
  lines.push("", "# What differs from one realization to the next.", "[perturbation]",
             'friction = { distribution = "normal", cov = 0.10, min = 0.05, max = 2.0, per = "joint" }',
             'normal_stiffness = { distribution = "lognormal", sigma_ln = 0.7, per = "structure" }',
             `drum_width = { distribution = "normal", sd_m = ${real(0.004 * s.width)}, per = "block" }`,
             `drum_height = { distribution = "normal", sd_m = ${real(0.004 * s.width)}, per = "block" }`,
             `drum_offset = { distribution = "normal", sd_m = ${real(0.005 * s.width)}, per = "block" }`,
             'density = { distribution = "normal", cov = 0.03, per = "block" }',
             'tilt = { distribution = "normal", sd_rad = 0.0017453, per = "structure" }');
  if (!s.record) lines.push('phase = { distribution = "uniform", per = "structure" }');
  lines.push("", "[outcome]", "collapse = { height_fraction = 0.6 }");
  return lines.join("\n") + "\n";
}

/** The study in the address of the page, `#study=` and base64url of its text in UTF-8; null where there is none. */
function studyOfAddress(hash) {
  const found = /^#study=([A-Za-z0-9_-]+)$/.exec(hash);
  if (!found) return null;
  const bytes = atob(found[1].replace(/-/g, "+").replace(/_/g, "/"));
  return new TextDecoder().decode(Uint8Array.from(bytes, (letter) => letter.charCodeAt(0)));
}

function addressOfStudy(text) {
  let bytes = "";
  for (const byte of new TextEncoder().encode(text)) bytes += String.fromCharCode(byte);
  return `#study=${btoa(bytes).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "")}`;
}
