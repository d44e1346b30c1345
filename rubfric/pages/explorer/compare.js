"use strict";
// Other rubbers and roads of a comparison: their friction, dashed and with its error, over the total that is shown.

function others(data) { return data.others ?? []; }

/** Whether friction at a place is that of the whole road, as the others' is. */
function comparable(data, place) { return place === (data.curves.total ? "total" : String(data.scales[0].number)) || place === "whole"; }

/** Those that are chosen, with their colours; none where something else than the whole road is shown. */
function compared(data, { place, beside }) {
  if (!comparable(data, place)) return [];
  const stops = data.colours.beside;
  return others(data).map((other, order) => ({ ...other, colour: visible(stops[order % stops.length]), symbol: SYMBOLS[(order + 1) % SYMBOLS.length] }))
    .filter((_, order) => beside.includes(order));
}

/** The controls that choose them; all begin chosen where they are few. */
function makeOthers(data) {
  if (!others(data).length) return;
  byId("others").append(element("legend", {}, "Beside it, dashed"));
  others(data).forEach(({ name }, order) => {
    const label = option("beside", order, swatch("8px,3px"), name);
    label.querySelector("input").type = "checkbox";
    byId("others").append(label);
  });
}

function showOthers(data, chosen) {
  byId("comparison").hidden = !others(data).length || chosen.view !== "curves" || !comparable(data, chosen.place);
  const stops = data.colours.beside;
  document.querySelectorAll("#others line").forEach((line, order) => line.setAttribute("stroke", visible(stops[order % stops.length])));
  for (const input of document.getElementsByName("beside")) input.checked = chosen.beside.includes(Number(input.value));
  byId("beside").replaceChildren(...(byId("comparison").hidden ? [] : compared(data, chosen).map((other) => besideWords(data, chosen, other))));
}

/** Friction of another at the chosen speed and pressure, and by how much it is more or less. */
function besideWords(data, { place, pressure, speed }, { name, friction, error }) {
  const [here, there] = [data.curves[place].friction[pressure][speed], friction[pressure][speed]];
  const more = here !== null && there !== null ? ` (${there < here ? "−" : "+"}${rounded(Math.abs(there - here), 2)})` : "";
  return element("div", {}, `${name}: μ = ${measured(there, error[pressure][speed])}${more}`);
}

/** Their curves at the chosen pressure, and the bands of their errors below them. */
function othersPlot(data, chosen) {
  const { pressure } = chosen;
  return compared(data, chosen).flatMap(({ name, friction, error, colour, symbol }) => [
    ...bandsOf(data.speeds, friction[pressure], error[pressure], colour),
    {
      x: data.speeds, y: friction[pressure], name, mode: "lines+markers", connectgaps: false,
      line: { color: colour, width: 2.4, dash: "9px,4px" }, marker: { symbol, size: 8, color: colour, line: { width: 1.5, color: colour } },
      error_y: { array: error[pressure].map((value) => value ?? 0), color: colour, thickness: 1.2, width: 3 },
      text: data.speeds.map((speed, place) => `${name}<br>${speedOf(speed)}, ${pressureOf(data.pressures[pressure])}<br>` +
        `<b>μ ${measured(friction[pressure][place], error[pressure][place])}</b>`),
      hovertemplate: "%{text}<extra></extra>",
    },
  ]);
}
