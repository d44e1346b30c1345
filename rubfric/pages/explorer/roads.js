"use strict";
// Several roads: windows of a measured profile, or roads with random phases. One is chosen, beside the mean over all of them.

function severalRoads(data) { return data.whole?.roads ?? []; }

/** What one of them is. */
function roadName(data, road) { return `${data.whole.windows ? "window" : "random road"} ${road + 1}`; }

/** The whole road, or that of several which is chosen. */
function wholeRoad(data, chosen) {
  const roads = severalRoads(data);
  return roads.length ? { ...data.whole, ...roads[Math.min(chosen.road, roads.length - 1)] } : data.whole;
}

/** The controls that choose one of several. */
function makeRoads(data) {
  const roads = severalRoads(data);
  if (!roads.length) return;
  byId("roads").append(element("legend", {}, data.whole.windows ? "Window of the measured road" : "Road with random phases"));
  byId("roads").append(...roads.map((_, order) => option("road", order, plain(order + 1))));
}

/** Friction on the chosen one, in words. */
function roadAlone(data, { road, pressure, speed }) {
  const shown = severalRoads(data)[road];
  const scene = shown && data.scenes[shown.number]?.[pressure][speed];
  const name = shown && sentence(roadName(data, road)).slice(0, -1);
  if (scene) return ` ${name} alone: μ = ${measured(scene.friction, scene.error)}, an error of mesh and solver.`;
  const reason = shown?.refusals?.[pressure][speed];
  return reason ? ` ${name} was refused: ${sentence(reason)}` : "";
}

/** Friction on each of several roads at the chosen pressure: a circle each, filled and joined by a line for the chosen one. */
function roadPoints(data, chosen) {
  const colour = pressureColour(data, chosen.pressure);
  return severalRoads(data).map(({ number }, road) => {
    const scenes = (data.scenes[number] ?? [])[chosen.pressure] ?? [];
    const strong = road === chosen.road;
    return {
      x: data.speeds, y: data.speeds.map((_, speed) => scenes[speed]?.friction ?? null), name: roadName(data, road), connectgaps: false,
      mode: strong ? "lines+markers" : "markers", line: { color: INKS.ink, width: 1.2, dash: "1px,3px" },
      marker: { symbol: strong ? "circle" : "circle-open", size: strong ? 7 : 6, color: strong ? INKS.ink : colour, line: { width: 1.3, color: strong ? INKS.ink : colour } },
      customdata: data.speeds.map((_, speed) => [chosen.pressure, speed, road]),
      text: data.speeds.map((speed, at) => (scenes[at] ? [sentence(roadName(data, road)).slice(0, -1),
        `${speedOf(speed)}, ${pressureOf(data.pressures[chosen.pressure])}`, ...sceneWords(scenes[at])].join("<br>") : "")),
      hovertemplate: "%{text}<extra></extra>",
    };
  });
}

/** The friction of each of several roads at the chosen speed and pressure, their mean, and what the numbers below are of. */
function roadsTable(data, chosen, shown) {
  const { pressure, speed } = chosen;
  const row = (name, cells) => element("tr", {}, element("td", {}, name), ...cells.map((value) => element("td", {}, value)));
  const rows = severalRoads(data).map(({ number, refusals }, road) => {
    const scene = data.scenes[number]?.[pressure][speed];
    const name = `${roadName(data, road)}${road === chosen.road ? ", shown" : ""}`;
    if (!scene) return row(name, [refusals?.[pressure][speed] ? "refused" : "not run", "", ""]);
    return row(name, [measured(scene.friction, scene.error), percent(scene.contact), rounded(scene.largest)]);
  });
  const { friction, error } = data.curves.whole, mean = data.scenes.whole[pressure][speed];
  rows.push(row("mean", [measured(friction[pressure][speed], error[pressure][speed]), mean ? percent(mean.contact) : "", mean ? rounded(mean.largest) : ""]));
  const head = element("tr", {}, ...["", "μ", "contact", "largest contact pressure per undeformed area (MPa)"].map((name) => element("th", { scope: "col" }, name)));
  const table = element("div", { class: "scroll" }, element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows)));
  return shown ? [table, element("h2", { class: "below" }, `The numbers of ${roadName(data, chosen.road)}`)] : [table];
}
