"use strict";
// The page: what is chosen, the controls that choose it, and everything drawn again when it changes.

const data = held.pages ? held.pages[warmth] : held;
const severalScales = "total" in data.curves;
const places = [...(severalScales ? ["total"] : []), ...(data.whole ? ["whole"] : []), ...data.scales.map(({ number }) => String(number))];
const colours = shades(data.colours.energy);
let numbers = null; // of the pictures, once they are unpacked
let drawn = Promise.resolve();

// ---- What is chosen, and the address that says so ----

const chosen = { place: places[0], view: "curves", unit, pressure: 0, speed: 0, road: 0, spot: null, beside: others(data).length > 2 ? [0] : others(data).map((_, order) => order) };

/** The scene of highest friction at a place: what a visitor sees first. */
function highestScene(place) {
  let best = { pressure: 0, speed: 0, friction: -1 };
  data.curves[place].friction.forEach((row, pressure) => row.forEach((friction, speed) => {
    if (friction !== null && friction > best.friction) best = { pressure, speed, friction };
  }));
  return best;
}

/** Choose what the address names; what it leaves out or misspells stays as it is. */
function readAddress() {
  const said = new URLSearchParams(window.location.hash.slice(1));
  const nearest = (values, name) => {
    const wanted = Number(said.get(name));
    return said.has(name) ? values.findIndex((value) => Math.abs(value - wanted) <= 1e-9 * value) : -1;
  };
  if (places.includes(said.get("scale"))) chosen.place = said.get("scale");
  if (["curves", "map"].includes(said.get("view"))) chosen.view = said.get("view");
  if (said.get("unit") in UNITS) chosen.unit = said.get("unit");
  const [pressure, speed] = [nearest(data.pressures, "pressure"), nearest(data.speeds, "speed")];
  if (pressure >= 0) chosen.pressure = pressure;
  if (speed >= 0) chosen.speed = speed;
  if (said.has("with")) chosen.beside = said.get("with").split(",").map((one) => Number(one) - 1).filter((order) => order in others(data));
  const road = Number(said.get("road")) - 1;
  if (said.has("road") && road in severalRoads(data)) chosen.road = road;
}

function address(warm = temperatures[warmth]) {
  const { place, view, pressure, speed } = chosen, measure = chosen.unit === "mm/s" ? "" : `&unit=${chosen.unit}`;
  return `#scale=${place}&view=${view}&pressure=${data.pressures[pressure]}&speed=${data.speeds[speed]}${measure}${severalRoads(data).length ? `&road=${chosen.road + 1}` : ""}${others(data).length ? `&with=${chosen.beside.map((order) => order + 1).join(",")}` : ""}${addressed(warm)}`;
}

/** Choose, within what there is, and draw; many choices in one frame are drawn once. Who chooses a speed ends the play. */
function choose(changes, played = false) {
  if ("speed" in changes && !played) stopPlaying();
  Object.assign(chosen, changes);
  chosen.pressure = Math.min(data.pressures.length - 1, Math.max(0, chosen.pressure));
  chosen.speed = Math.min(data.speeds.length - 1, Math.max(0, chosen.speed));
  window.history.replaceState(null, "", address());
  if (!choose.waiting) choose.waiting = window.requestAnimationFrame(() => { choose.waiting = 0; draw(); });
}

// ---- Words and numbers ----

function placeName(place) { return { total: "Total", whole: "Whole road" }[place] ?? `Scale ${place}`; }

function roadOf(place) { return place === "whole" ? wholeRoad(data, chosen) : data.scales.find(({ number }) => String(number) === place); }

/** The scene at a place; of several roads that on the chosen one. */
function sceneAt(place) { return data.scenes[roadOf(place).number]?.[chosen.pressure][chosen.speed] ?? null; }

function sceneName() { return `${speedOf(data.speeds[chosen.speed])}, ${pressureOf(data.pressures[chosen.pressure])}`; }

function showAbout() {
  const { plane, kinematics, accuracy, aspect, source, references } = data.about;
  const scales = data.scales.length === 1 ? "one scale" : `${data.scales.length} scales`;
  const measuredRoad = data.whole?.windows ? `, and the profile itself in ${severalRoads(data).length} windows of ${rounded(severalRoads(data)[0].period, 3)}${THIN}mm` : "";
  const asked = accuracy === null ? "" : `, accuracy asked for ${percent(accuracy)}`;
  byId("about").textContent = `${rubberAt()}Road of ${scales}${measuredRoad}; block ${plain(aspect)} times as high as wide${measuredRoad && " on each scale"}, plane ${plane}; ` +
    `kinematics ${kinematics}${asked}. Steady sliding; friction is what the rubber dissipates.`;
  byId("footer").textContent = `${source}. After ${references}. ± is the estimated error. ${limitsWords(data)}`;
}

function showWords() {
  const { place, pressure, speed } = chosen;
  const curve = data.curves[place];
  const friction = curve.friction[pressure][speed], error = curve.error[pressure][speed];
  const share = relative(friction, error);
  byId("chart-title").textContent = `${placeName(place)}: friction ` + (chosen.view === "map" ? "over speed and pressure" : "against speed");
  byId("peak").textContent = peakWords(curve, pressure, data.pressures, data.speeds);
  byId("marks").textContent = marksWords(curve, chosen, data);
  byId("scene-title").textContent = `${placeName(place)} at ${sceneName()}`;
  const several = place === "whole" && severalRoads(data).length;
  byId("numbers-title").textContent = place === "total" ? "The scales, and five ways to the total" : several ? `Every ${data.whole.windows ? "window" : "random road"}, and their mean` : "The numbers of this scene";
  const none = sentence(place === "whole" ? whyNot(data, pressure, speed) : "not run").slice(0, -1);
  byId("covers").textContent = place === "total" ? coversTotal(data, chosen) : coversScene(data, chosen, data.scenes[place][pressure][speed]);
  byId("headline").replaceChildren(friction === null ? none : `μ = ${measured(friction, error)} `, element("small", {}, share && `(${share})`));
  byId("summary").textContent = `${placeName(place)} at ${sceneName()}: friction ${measured(friction, error)}${several ? `.${roadAlone(data, chosen)}` : ""}`;
  const keys = "Left and right arrows choose the speed, up and down arrows the pressure.";
  byId("chart").setAttribute("aria-label", `${byId("chart-title").textContent}. ${keys}`);
}

// ---- Drawing ----

function draw() {
  unit = chosen.unit;
  showOthers(data, chosen);
  showControls();
  showWords();
  const chart = byId("chart");
  const plot = chosen.view === "map" ? mapPlot(data, chosen, chart.clientWidth) : curvesPlot(data, chosen);
  const size = { width: chart.clientWidth, height: chart.clientHeight };
  const charted = Plotly.react(chart, plot.traces, { ...plot.layout, ...size }, CONFIG);
  drawn = Promise.all([charted, chosen.place === "total" ? showTotal() : showScene(chosen.place)]).then(() => {
    for (const id of ["chart", "picture"]) listen(byId(id));
    byId("numbers-card").hidden = !byId("numbers").children.length;
    document.body.dataset.shown = address();
  });
}

/** Choose the scene that is clicked. */
function listen(plot) {
  if (plot.listens || !plot.on) return;
  plot.listens = true;
  plot.on("plotly_click", ({ points }) => {
    const place = points[0]?.customdata;
    if (chosen.place === "whole" && plot.id === "picture") choose({ spot: points[0].x });
    else if (Array.isArray(place)) choose({ pressure: place[0], speed: place[1], ...(place.length > 2 && { road: place[2] }) });
  });
}

async function begin() {
  const first = highestScene(places[0]);
  Object.assign(chosen, { pressure: first.pressure, speed: first.speed });
  readAddress();
  if (data.whole?.windows) WAY_NAMES.direct = "the profile itself";
  for (const make of [showAbout, makeControls, makeTemperatures, makePlay, makeSaves, () => makeRoads(data), () => makeOthers(data)]) make();
  document.querySelector("main").hidden = false;
  try {
    [numbers] = await Promise.all([unpack(data.pictures), loadLibrary()]);
  } catch {
    byId("notice").hidden = false;
    byId("notice").textContent = "This browser cannot unpack the charts and the pictures of the block; Chrome 80, Firefox 113, Safari 16.4 and later can.";
    return;
  }
  choose({});
}

begin();
