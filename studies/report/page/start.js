// Brings the page to life once it is read.
document.body.append(spoken);
for (const script of document.querySelectorAll("script.figure-data"))
  new LiveFigure(script.parentElement.querySelector("svg"), JSON.parse(script.textContent));
{
  const store = dataOf("animations"), cells = dataOf("cells");
  const map = document.querySelector("svg.cells");
  if (cells && map) new CellMap(map, cells, store);
  for (const place of document.querySelectorAll("[data-player]"))
    if (store && store.list.length)
      place.append(playerOf(store, store.list).element);
}
// what is folded on the screen is printed
addEventListener("beforeprint", () => {
  for (const folded of document.querySelectorAll("details:not([open])")) {
    folded.open = true;
    folded.dataset.folded = "";
  }
});
addEventListener("afterprint", () => {
  for (const folded of document.querySelectorAll("details[data-folded]")) {
    folded.open = false;
    delete folded.dataset.folded;
  }
});
document.documentElement.dataset.alive = "yes";
