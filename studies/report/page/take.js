// What a reader takes along: data as CSV, the map as a picture, a link.

/** Puts a text on the clipboard, also where the browser grants no access to it. */
async function copyText(text, words) {
  try {
    await navigator.clipboard.writeText(text);
  } catch { // no permission, or an old browser
    const area = html("textarea", {class: "spoken", "aria-hidden": "true"});
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  say(`${words}: copied`);
  document.dispatchEvent(new CustomEvent("copied", {detail: text}));
}

/** Offers a file. @param url of its content */
function download(name, url) {
  const link = html("a", {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  say(`${name}: downloaded`);
  document.dispatchEvent(new CustomEvent("downloaded", {detail: {name, url}}));
}

/** A drawing of the page as a file of its own: the colours of the page's style stand in it. */
function pictureOf(drawing) {
  const copy = drawing.cloneNode(true), originals = drawing.querySelectorAll("*");
  copy.querySelectorAll("*").forEach((element, i) => {
    const look = getComputedStyle(originals[i]);
    for (const name of ["fill", "stroke", "stroke-width", "visibility", "fill-opacity"])
      element.style.setProperty(name, look.getPropertyValue(name));
    if (element.tagName === "text") element.style.fontSize = look.fontSize;
    if (look.display === "none") element.style.display = "none";
  });
  const [, , width, height] = drawing.getAttribute("viewBox").split(" ");
  const look = getComputedStyle(drawing);
  for (const name of ["class", "tabindex", "role", "style"]) copy.removeAttribute(name);
  filled(copy, {xmlns: "http://www.w3.org/2000/svg", width, height, "font-family": look.fontFamily}, []);
  copy.prepend(svg("rect", {width, height, style: `fill:${getComputedStyle(document.body).backgroundColor}`}));
  return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
}

/** The same as pixels, so many for each of the drawing. @returns an address; null where the browser has no canvas */
async function pixelsOf(drawing, factor = 2) {
  const canvas = html("canvas"), pen = canvas.getContext?.("2d");
  if (!pen) return null;
  const picture = new Image();
  picture.src = pictureOf(drawing);
  await picture.decode();
  const {width, height} = drawing.viewBox.baseVal;
  filled(canvas, {width: factor * width, height: factor * height}, []);
  pen.drawImage(picture, 0, 0, factor * width, factor * height);
  return canvas.toDataURL("image/png");
}
