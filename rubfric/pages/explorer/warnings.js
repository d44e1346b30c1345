"use strict";
// The warnings of scenes: marked in the charts, said under the pointer, and listed below the block.

/** The warnings of some scenes, by place, each once, with the places that it is about. */
function gathered(scenes) {
  const said = new Map();
  for (const [place, scene] of scenes) {
    for (const words of scene?.warnings ?? []) said.set(words, [...(said.get(words) ?? []), place]);
  }
  return said;
}

/** The scenes behind a point of a chart, by place: of the total those of all scales and of the whole road. */
function scenesBehind(data, place, pressure, speed) {
  const roads = severalRoads(data).map(({ number }) => number);
  const whole = data.whole ? ["whole", ...roads] : [];
  const places = { total: [...data.scales.map(({ number }) => String(number)), ...whole], whole }[place] ?? [place];
  return places.map((one) => [one, data.scenes[one]?.[pressure]?.[speed] ?? null]);
}

function warningsAt(data, place, pressure, speed) { return gathered(scenesBehind(data, place, pressure, speed)); }

function whose(place) {
  if (place === "whole") return "whole road";
  return place.startsWith("whole") ? roadName(data, Number(place.slice(5)) - 1) : `scale ${place}`;
}

/** The first warnings and whom they are about, in lines that fit under a pointer. */
function warningLines(data, place, pressure, speed, most = 3) {
  const said = [...warningsAt(data, place, pressure, speed)], more = said.length - most;
  const lines = said.slice(0, most).flatMap(([words, places]) => {
    const lines = [""];
    for (const word of `△ ${sentence(places.map(whose).join(", ")).slice(0, -1)}: ${words}`.split(" ")) {
      if (lines[lines.length - 1].length + word.length > 56) lines.push("");
      lines[lines.length - 1] += `${word} `;
    }
    return lines;
  });
  return more > 0 ? [...lines, `△ and ${more} more`] : lines;
}

/** A triangle around every point that carries a warning; ``at`` gives the abscissa and the ordinate of a point. */
function warningMarks(data, place, at) {
  const x = [], y = [];
  data.curves[place].friction.forEach((row, pressure) => row.forEach((friction, speed) => {
    if (friction === null || !warningsAt(data, place, pressure, speed).size) return;
    const [right, up] = at(pressure, speed);
    x.push(right);
    y.push(up);
  }));
  return { x, y, name: "warnings", mode: "markers", hoverinfo: "skip", marker: { symbol: "triangle-up-open", size: 19, color: INKS.warning, line: { width: 1.5 } } };
}

/** The list of the warnings of some scenes. */
function warningsOf(scenes) {
  const items = [...gathered(scenes)].map(([words, places]) =>
    element("li", {}, scenes.length > 1 ? `${sentence(places.map(whose).join(", ")).slice(0, -1)}: ${words}` : words));
  return items.length ? [element("ul", { "aria-label": "Warnings" }, ...items)] : [];
}
