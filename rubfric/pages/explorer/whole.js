"use strict";
// The whole road: what its friction and error are made of, a magnified spot, and the scale of energies below a picture.

const WAY_NAMES = { sum: "sum of the scales", corrected: "sum, corrected for the coupling", cascade: "cascade from scale to scale", persson: "Persson’s theory", direct: "all scales at once" };

/** What several roads are. */
function drawnWords(data) {
  return data.whole?.windows ? "windows of the measured road" : "roads with random phases";
}

/** Of which road a total is, after what it is. */
function roadWords(data) {
  const draws = data.whole?.draws ?? 0;
  return draws ? `, mean over ${draws} ${drawnWords(data)}` : " on one road, with these phases";
}

/** The parts of the error of a total that has several, for the words under the pointer. */
function partsWords(data, pressure, speed) {
  const names = { numerical: "mesh and solver", coupling: "coupling of the scales", road: data.whole?.windows ? "so few windows" : "so few random roads", rubber: "rubber’s data" };
  const parts = Object.entries(data.totals.parts).map(([part, values]) => [names[part], values[pressure][speed]]).filter(([, value]) => value > 0);
  return parts.length > 1 ? parts.map(([name, value]) => `± ${roundedUp(value).text} by ${name}`) : [];
}

/** Why the whole road has no friction there, in two words. */
function whyNot(data, pressure, speed) {
  const reason = data.refusals?.[pressure][speed];
  return !reason ? "not run" : reason.startsWith("not solved") ? "not solved" : "refused";
}

/** How the total was obtained and what its error covers. */
function coversTotal(data, { pressure, speed }) {
  const { way, note, parts } = data.totals;
  const taken = way[pressure][speed];
  if (!taken) return "";
  const of = (name) => parts[name][pressure][speed];
  const share = (name, words) => (of(name) ? [`${words} (${rounded(of(name), 2)})`] : []);
  const covered = [
    ...share("numerical", "mesh and solver"), ...share("coupling", "what it may miss of the coupling of the scales"),
    ...share("road", data.whole?.windows ? "so few windows of the road" : "so few random roads"), ...(parts.rubber ? share("rubber", "the rubber's data") : []),
  ];
  const about = taken === "direct" ? `${WAY_NAMES.direct}${roadWords(data)}` : WAY_NAMES[taken];
  const said = taken === "direct" ? "" : ` ${sentence(note[pressure][speed] ?? "")}`;
  return `${sentence(about)} ± covers ${covered.join(" and ") || "nothing"}.${said.trim() === "." ? "" : said}`;
}

/** What the error of a scene covers, or why there is no result. */
function coversScene(data, chosen, scene) {
  const { place, pressure, speed } = chosen;
  const reason = place === "whole" && data.refusals[pressure][speed];
  if (!scene) return reason ? sentence(reason) : "";
  const few = place === "whole" && data.whole.draws ? data.curves.whole.error[pressure][speed] - scene.error : 0;
  const parts = few > 0 ? ` (${rounded(scene.error, 2)}) and so few ${data.whole.windows ? "windows" : "random roads"} (${rounded(few, 2)})` : "";
  return `${place === "whole" ? sentence(`${WAY_NAMES.direct}${roadWords(data)}`) : "This scale alone."} ± covers mesh and solver${parts}.` +
    (scene.rubberError > 0 ? ` The rubber’s data leave ± ${roundedUp(scene.rubberError).text} beside that.` : "") + (place === "whole" ? roadAlone(data, chosen) : "");
}

/** What no error covers. */
function limitsWords(data) {
  return data.totals?.parts.rubber
    ? "That of the total covers the data of the rubber, which are said beside that of a scene; not the choice of its law."
    : "It covers neither the data of the rubber nor the choice of its law.";
}

/** The sum of the scales at the chosen pressure, for comparison with the total. */
function comparison(data, chosen) {
  const { friction, error } = data.totals.ways.sum;
  const [values, errors] = [friction[chosen.pressure], error[chosen.pressure]];
  return {
    x: data.speeds, y: values, name: WAY_NAMES.sum, mode: "lines", connectgaps: false, line: { color: INKS.quiet, width: 1.6, dash: "6px,4px" },
    text: values.map((value, speed) => `${WAY_NAMES.sum}<br>${speedOf(data.speeds[speed])}, ${pressureOf(data.pressures[chosen.pressure])}<br>μ ${measured(value, errors[speed])}`),
    hovertemplate: "%{text}<extra></extra>",
  };
}

/** Crosses on the totals that were obtained in another way, since the whole road was refused. */
function crosses(data) {
  const found = { x: [], y: [] };
  data.totals.way.forEach((row, pressure) => row.forEach((way, speed) => {
    if (!way || way === "direct" || whyNot(data, pressure, speed) !== "refused") return;
    found.x.push(data.speeds[speed]);
    found.y.push(data.curves.total.friction[pressure][speed]);
  }));
  return { ...found, mode: "markers", hoverinfo: "skip", marker: { symbol: "x-thin", size: 13, line: { width: 1.8, color: INKS.ink } } };
}

/** The part of the whole road that is magnified, mm. */
function spotFrame(road, place) {
  const wide = road.spot;
  const left = Math.min(road.period - wide, Math.max(0, (place ?? road.crest) - 0.5 * wide));
  const heights = roadLine(road, { left, right: left + wide }, 300).y;
  return { left, right: left + wide, bottom: Math.min(...heights) - 0.08 * wide, top: Math.max(...heights) + 0.28 * wide };
}

/** The frame of the spot in the picture of the whole road. */
function spotShape({ left, right, bottom, top }, whole) {
  const line = { color: INKS.ink, width: 1.2 };
  return { type: "rect", x0: left, x1: right, y0: Math.max(bottom, whole.bottom), y1: Math.min(top, whole.top), line };
}

/** Numbers within a range of decimal logarithms: every power of ten, every other, or also twice and five times those. */
function decades([low, high]) {
  const fine = high - low < 2.2 ? [1, 2, 5] : [1], step = high - low > 4.5 ? 2 : 1;
  const ticks = [];
  for (let power = Math.floor(low); power <= Math.ceil(high); power += step) {
    for (const factor of fine) {
      const value = factor * 10 ** power;
      if (Math.log10(value) >= low - 1e-9 && Math.log10(value) <= high + 1e-9) ticks.push(value);
    }
  }
  return ticks;
}

/** The scale of energies: its colours, and numbers below them. */
function energyScale([low, high], stops) {
  const bar = element("div", { class: "bar", style: `background: linear-gradient(to right, ${stops.join(", ")})` });
  const ticks = decades([low, high]).map((value) => {
    const place = (100 * (Math.log10(value) - low)) / (high - low);
    return element("span", { style: `left: ${place.toFixed(2)}%` }, plain(value));
  });
  return [element("div", { class: "quiet" }, "strain-energy density (MPa)"), bar, element("div", { class: "ticks" }, ...ticks)];
}
