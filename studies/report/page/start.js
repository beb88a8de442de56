// Brings the page to life once it is read.
document.body.append(spoken);
for (const script of document.querySelectorAll("script.figure-data"))
  new LiveFigure(script.parentElement.querySelector("svg"), JSON.parse(script.textContent));
{
  const store = dataOf("animations"), cells = dataOf("cells");
  const map = document.querySelector(".instrument");
  if (cells && map) new Instrument(map, new Cells(cells), store);
  for (const place of document.querySelectorAll("[data-player]"))
    if (store && store.list.length)
      place.append(playerOf(store, store.list).element);
}
// What is folded is printed too.
let unfolded = [];
addEventListener("beforeprint", () => {
  unfolded = [...document.querySelectorAll("details:not([open]):not(.take)")];
  for (const details of unfolded) details.open = true;
});
addEventListener("afterprint", () => {
  for (const details of unfolded) details.open = false;
});
document.documentElement.dataset.alive = "yes";
