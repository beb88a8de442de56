// What the parts of the page share. The scripts are embedded one after the other in one block, so their names are
// theirs alone. Nothing here loads anything: all data stand in the page as JSON.

/** An element of HTML with attributes and children (texts or elements). */
function html(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** An element of SVG. */
function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children);
  return element;
}

/** The JSON that stands in the page under a name; null where there is none. */
function dataOf(id) {
  const script = document.getElementById(id);
  return script ? JSON.parse(script.textContent) : null;
}

/** A number with so many significant digits; a dash where there is none. */
function numberText(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const rounded = Number(Number(value).toPrecision(digits));
  return Math.abs(rounded) >= 1e6 || (rounded !== 0 && Math.abs(rounded) < 1e-4) ? rounded.toExponential()
                                                                                : String(rounded);
}

function percentText(share, digits = 1) {
  return share === null ? "–" : `${(100 * share).toFixed(digits)} %`;
}

/** A share with its interval: "61.4 % (58.1 to 64.0)". */
function shareText(share, lower, upper) {
  if (share === null) return "–";
  const [low, high] = [lower, upper].map((end) => (100 * end).toFixed(1));
  return `${percentText(share)} (${low} to ${high})`;
}

function clamp(value, least, most) {
  return Math.min(Math.max(value, least), most);
}

/** What a screen reader is told; the pointer's readings are not: there would be no end of them. */
const spoken = html("div", {class: "spoken", role: "status", "aria-live": "polite"});
function say(text) {
  spoken.textContent = text;
}

/** The readings beside the pointer, over a figure. */
class Tip {
  constructor(figure) {
    this.figure = figure;
    this.element = html("div", {class: "tip", "aria-hidden": "true", hidden: true});
    figure.append(this.element);
  }

  /** @param content an element   @param x, y where it belongs [px of the figure] */
  show(content, x, y) {
    this.element.replaceChildren(content);
    this.element.hidden = false;
    const room = this.figure.clientWidth, width = this.element.offsetWidth, height = this.element.offsetHeight;
    const left = x + 14 + width <= room ? x + 14 : x - 14 - width;
    this.element.style.left = `${clamp(left, 0, Math.max(0, room - width))}px`;
    this.element.style.top = `${Math.max(0, y - height - 10)}px`;
  }

  hide() {
    this.element.hidden = true;
  }
}

/** Names and values, line by line. @param rows of [name, value, colour or nothing] */
function readings(title, rows) {
  const body = html("tbody");
  for (const [name, value, colour] of rows) {
    const cell = html("td");
    if (colour) cell.append(html("span", {class: "swatch", style: `background:${colour}`}));
    cell.append(name);
    body.append(html("tr", {}, cell, html("td", {}, value)));
  }
  return html("div", {}, html("b", {}, title), html("table", {}, body));
}

/** Where an element of an SVG lies in the figure around it: factor and offset from the drawing's units. */
function placeIn(figure, drawing) {
  const outer = figure.getBoundingClientRect(), inner = drawing.getBoundingClientRect();
  return {scale: inner.width / drawing.viewBox.baseVal.width, left: inner.left - outer.left, top: inner.top - outer.top};
}
