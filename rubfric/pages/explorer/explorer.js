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

// ---- Controls ----

function makeControls() {
  for (const place of places) {
    const scale = data.scales.find(({ number }) => String(number) === place);
    const label = scale ? [`${place}`, element("small", {}, `${rounded(scale.wavelength, 2)}${THIN}mm`)] : [{ total: "Total", whole: "Whole road" }[place]];
    byId("places").append(option("place", place, ...label));
  }
  byId("views").append(option("view", "curves", "Curves"), option("view", "map", "Map"));
  byId("units").append(...Object.keys(UNITS).map((name) => option("unit", name, name)));
  data.pressures.forEach((pressure, order) => byId("pressures").append(option("pressure", order, swatch(DASHES[order % DASHES.length]), plain(pressure))));
  byId("speed").max = data.speeds.length - 1;
  byId("speed").disabled = data.speeds.length < 2;
  byId("choices").addEventListener("change", ({ target }) => choose({ [target.name]: target.value }));
  byId("scene-choices").addEventListener("input", ({ target }) => choose({ [target.name]: target.type === "checkbox" ? ticked(target.name) : Number(target.value) }));
  for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
  const steps = { ArrowLeft: ["speed", -1], ArrowRight: ["speed", 1], ArrowDown: ["pressure", -1], ArrowUp: ["pressure", 1] };
  byId("chart").addEventListener("keydown", (event) => {
    if (!(event.key in steps) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const [axis, step] = steps[event.key];
    choose({ [axis]: chosen[axis] + step });
  });
  window.addEventListener("hashchange", () => { readAddress(); if (!otherTemperature()) choose({}); });
  darkness.addEventListener("change", () => { dress(darkness.matches); choose({}); });
  window.addEventListener("beforeprint", () => { dress(false); draw(); });
  window.addEventListener("afterprint", () => { dress(darkness.matches); draw(); });
  let width = window.innerWidth;
  window.addEventListener("resize", () => { if (window.innerWidth !== width) { width = window.innerWidth; choose({}); } });
}

function ticked(name) { return [...document.getElementsByName(name)].filter((input) => input.checked).map((input) => Number(input.value)); }

function showControls() {
  showPlay();
  byId("roads").hidden = !severalRoads(data).length || !["total", "whole"].includes(chosen.place);
  for (const [name, value] of Object.entries(chosen).filter(([key]) => key !== "beside")) {
    for (const input of document.getElementsByName(name)) input.checked = input.value === String(value);
  }
  byId("speed").value = chosen.speed;
  byId("speed").setAttribute("aria-valuetext", speedOf(data.speeds[chosen.speed]));
  byId("speed-value").textContent = speedOf(data.speeds[chosen.speed]);
  byId("speed-others").textContent = otherUnits(data.speeds[chosen.speed]);
  const labels = speedLabels(data.speeds, byId("speed").clientWidth + 90), last = Math.max(1, data.speeds.length - 1);
  byId("speed-ticks").replaceChildren(...labels.map((label, order) => element("span", { style: `--at: ${order / last}` }, label)));
  document.querySelectorAll("#pressures line").forEach((line, order) => line.setAttribute("stroke", pressureColour(data, order)));
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

// ---- Pictures ----

const framed = new Map();

/** The frame of a road: the same for all its scenes, so that they can be compared. */
function frame(scale) {
  if (!framed.has(scale.number)) {
    const alike = scale.period && severalRoads(data).length ? severalRoads(data).map(({ number }) => number) : [scale.number];
    const about = alike.flatMap((number) => data.scenes[number] ?? []).flat().map((scene) => scene?.picture).filter(Boolean);
    framed.set(scale.number, frameOf(scale, about));
  }
  return framed.get(scale.number);
}

function pictureOf(scene) { return numbers && scene?.picture ? opened(numbers, scene.picture) : null; }

function showScene(place) {
  const scale = roadOf(place);
  const scene = sceneAt(place);
  const picture = pictureOf(scene);
  byId("small-pictures").replaceChildren();
  byId("energies").replaceChildren(...(picture ? energyScale(data.energies, data.colours.energy) : []));
  byId("picture").hidden = !picture || Boolean(playing?.moves);
  byId("passing").hidden = !picture || !playing?.moves;
  byId("spot").hidden = !(picture && scale.period) || Boolean(playing?.moves);
  if (playing) playing.moving = [];
  byId("caption").replaceChildren();
  byId("numbers").replaceChildren();
  byId("warnings").replaceChildren(...warningsOf([[place, scene]]));
  if (place === "whole" && severalRoads(data).length) byId("numbers").append(...roadsTable(data, chosen, scene));
  if (scene) byId("numbers").append(sceneNumbers(scene));
  if (!picture) return null;
  if (playing?.moves) {
    byId("caption").textContent = showPassing(place, picture, scale);
    return null;
  }
  const how = picture.finite
    ? "Displacements are to scale; the white lines made squares before deformation."
    : `Small strain: only vertical displacements are shown, to scale, without the mean compression of ${percent(scene.compression)}.`;
  const hint = (ZOOMS ? " Drag to zoom, double click to see all again." : "") + (scale.period ? " Click on the block to magnify another spot." : "");
  const seen = scale.period ? ` One period of the road, and the framed spot, ${rounded(scale.spot, 2)}${THIN}mm wide, magnified.` : "";
  const drawn = place === "whole" && scale.draws ? ` The picture is of ${roadName(data, chosen.road)}.` : "";
  byId("caption").replaceChildren(`The block slides to the right; orange where it touches the road, with the contact pressure below.${seen} ${how}${drawn}`,
    element("span", { class: "fine" }, hint));
  byId("picture").setAttribute("aria-label", `The deformed block on ${placeName(place).toLowerCase()} at ${sceneName()}, in contact on ${percent(scene.contact)} of its area.`);
  const plot = blockPlot(picture, scale, frame(scale), colours, data.energies, byId("picture").clientWidth);
  if (scale.period) {
    const spot = spotFrame(scale, chosen.spot);
    plot.layout.shapes = [spotShape(spot, frame(scale))];
    byId("spot").replaceChildren(paintSmall(picture, scale, spot, 1100, colours, data.energies, true));
  }
  return Plotly.react("picture", plot.traces, plot.layout, CONFIG);
}

function smallPicture(road) {
  const { number, period } = road, name = period ? "whole road" : `scale ${number}`;
  const place = period ? "whole" : String(number);
  const picture = pictureOf(sceneAt(place));
  const button = element("button", { type: "button", class: period ? "small wide" : "small", title: `Show ${period ? "the " : ""}${name}` });
  if (picture && playing?.moves) {
    const moving = passing(picture, road, period ? { ...frame(road), right: frame(road).left + period } : frame(road), period ? 1400 : 320);
    playing.moving.push(moving);
    button.append(moving.canvas);
  } else if (picture) button.append(paintSmall(picture, road, frame(road), period ? 1400 : 320, colours, data.energies));
  button.append(name);
  button.addEventListener("click", () => { choose({ place }); byId("places").querySelector(`[value="${place}"]`).focus(); });
  return button;
}

function showTotal() {
  const pictured = data.whole && pictureOf(sceneAt("whole"));
  const shown = [...data.scales.map(({ number }) => String(number)), ...(data.whole ? ["whole"] : [])];
  const scenes = shown.map((place) => [place, sceneAt(place)]);
  if (playing) playing.moving = [];
  byId("passing").hidden = true;
  byId("small-pictures").replaceChildren(...[...(pictured ? [roadOf("whole")] : []), ...data.scales].map(smallPicture));
  byId("energies").replaceChildren();
  if (numbers) byId("small-pictures").append(element("div", { class: "energies" }, ...energyScale(data.energies, data.colours.energy)));
  byId("caption").textContent = "Bars: each scale alone at this pressure, and the whole error of their sum. Diamonds: the total with its error. " +
    "Pictures: the block on the whole road and on each scale, each in its own size." +
    (severalRoads(data).length ? ` The whole road in the picture is ${roadName(data, chosen.road)}.` : "");
  byId("spot").hidden = true;
  byId("numbers").replaceChildren(totalNumbers(data, chosen));
  byId("warnings").replaceChildren(...warningsOf(scenes));
  byId("picture").hidden = false;
  byId("picture").setAttribute("aria-label", `Friction of each scale against speed at ${pressureOf(data.pressures[chosen.pressure])}, stacked, and the total; the table has the numbers.`);
  const plot = barsPlot(data, chosen, byId("picture").clientWidth);
  return Plotly.react("picture", plot.traces, plot.layout, CONFIG);
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
  for (const make of [showAbout, makeControls, makeTemperatures, makePlay, () => makeRoads(data), () => makeOthers(data)]) make();
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
