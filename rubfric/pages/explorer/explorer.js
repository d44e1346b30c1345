"use strict";
// The page: what is chosen, the controls that choose it, and everything drawn again when it changes.

const data = held.pages ? held.pages[warmth] : held;
const severalScales = "total" in data.curves;
const places = [...(severalScales ? ["total"] : []), ...(data.whole ? ["whole"] : []), ...data.scales.map(({ number }) => String(number))];
const colours = shades(data.colours.energy);
let numbers = null; // of the pictures, once they are unpacked
let drawn = Promise.resolve();

// ---- What is chosen, and the address that says so ----

const chosen = { place: places[0], view: "curves", pressure: 0, speed: 0, spot: null };

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
  const [pressure, speed] = [nearest(data.pressures, "pressure"), nearest(data.speeds, "speed")];
  if (pressure >= 0) chosen.pressure = pressure;
  if (speed >= 0) chosen.speed = speed;
}

function address(warm = temperatures[warmth]) {
  const { place, view, pressure, speed } = chosen;
  return `#scale=${place}&view=${view}&pressure=${data.pressures[pressure]}&speed=${data.speeds[speed]}${addressed(warm)}`;
}

/** Choose, within what there is, and draw; many choices in one frame are drawn once. */
function choose(changes) {
  Object.assign(chosen, changes);
  chosen.pressure = Math.min(data.pressures.length - 1, Math.max(0, chosen.pressure));
  chosen.speed = Math.min(data.speeds.length - 1, Math.max(0, chosen.speed));
  window.history.replaceState(null, "", address());
  if (!choose.waiting) choose.waiting = window.requestAnimationFrame(() => { choose.waiting = 0; draw(); });
}

// ---- Controls ----

/** A radio button that looks like a part of a row. */
function option(group, value, ...label) {
  const input = element("input", { type: "radio", name: group, value });
  return element("label", { class: "option" }, input, element("span", {}, ...label));
}

function swatch(pressure) {
  const name = "http://www.w3.org/2000/svg";
  const drawing = document.createElementNS(name, "svg");
  drawing.setAttribute("width", "22");
  drawing.setAttribute("height", "6");
  drawing.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(name, "line");
  const look = { x1: 0, x2: 22, y1: 3, y2: 3, stroke: data.colours.pressures[pressure], "stroke-width": 3 };
  const dash = DASHES[pressure % DASHES.length];
  if (dash !== "solid") look["stroke-dasharray"] = dash.replaceAll("px", "");
  for (const [key, value] of Object.entries(look)) line.setAttribute(key, value);
  drawing.append(line);
  return drawing;
}

function makeControls() {
  for (const place of places) {
    const scale = data.scales.find(({ number }) => String(number) === place);
    const label = scale ? [`${place}`, element("small", {}, `${rounded(scale.wavelength, 2)}${THIN}mm`)] : [{ total: "Total", whole: "Whole road" }[place]];
    byId("places").append(option("place", place, ...label));
  }
  byId("views").append(option("view", "curves", "Curves"), option("view", "map", "Map"));
  data.pressures.forEach((pressure, order) => byId("pressures").append(option("pressure", order, swatch(order), plain(pressure))));
  byId("speed").max = data.speeds.length - 1;
  byId("speed").disabled = data.speeds.length < 2;
  byId("choices").addEventListener("change", ({ target }) => choose({ [target.name]: target.value }));
  byId("scene-choices").addEventListener("input", ({ target }) => choose({ [target.id === "speed" ? "speed" : "pressure"]: Number(target.value) }));
  for (const form of document.forms) form.addEventListener("submit", (event) => event.preventDefault());
  const steps = { ArrowLeft: ["speed", -1], ArrowRight: ["speed", 1], ArrowDown: ["pressure", -1], ArrowUp: ["pressure", 1] };
  byId("chart").addEventListener("keydown", (event) => {
    if (!(event.key in steps) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const [axis, step] = steps[event.key];
    choose({ [axis]: chosen[axis] + step });
  });
  window.addEventListener("hashchange", () => { readAddress(); if (!otherTemperature()) choose({}); });
  let width = window.innerWidth;
  window.addEventListener("resize", () => { if (window.innerWidth !== width) { width = window.innerWidth; choose({}); } });
}

function showControls() {
  for (const [name, value] of [["place", chosen.place], ["view", chosen.view], ["pressure", chosen.pressure]]) {
    for (const input of document.getElementsByName(name)) input.checked = input.value === String(value);
  }
  byId("speed").value = chosen.speed;
  byId("speed").setAttribute("aria-valuetext", speedOf(data.speeds[chosen.speed]));
  byId("speed-value").textContent = speedOf(data.speeds[chosen.speed]);
}

// ---- Words and numbers ----

function placeName(place) { return { total: "Total", whole: "Whole road" }[place] ?? `Scale ${place}`; }

function roadOf(place) { return place === "whole" ? data.whole : data.scales.find(({ number }) => String(number) === place); }

function sceneName() { return `${speedOf(data.speeds[chosen.speed])}, ${pressureOf(data.pressures[chosen.pressure])}`; }

function showAbout() {
  const { plane, kinematics, accuracy, aspect, source, references } = data.about;
  const scales = data.scales.length === 1 ? "one scale" : `${data.scales.length} scales`;
  const asked = accuracy === null ? "" : `, accuracy asked for ${percent(accuracy)}`;
  byId("about").textContent = `${rubberAt()}Road of ${scales}; block ${plain(aspect)} times as high as wide, plane ${plane}; ` +
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
  byId("numbers-title").textContent = place === "total" ? "The scales, and five ways to the total" : "The numbers of this scene";
  const none = sentence(place === "whole" ? whyNot(data, pressure, speed) : "not run").slice(0, -1);
  byId("covers").textContent = place === "total" ? coversTotal(data, chosen) : coversScene(data, chosen, data.scenes[place][pressure][speed]);
  byId("headline").replaceChildren(friction === null ? none : `μ = ${measured(friction, error)} `, element("small", {}, share && `(${share})`));
  byId("summary").textContent = `${placeName(place)} at ${sceneName()}: friction ${measured(friction, error)}`;
  const keys = "Left and right arrows choose the speed, up and down arrows the pressure.";
  byId("chart").setAttribute("aria-label", `${byId("chart-title").textContent}. ${keys}`);
}

// ---- Pictures ----

const framed = new Map();

/** The frame of a road: the same for all its scenes, so that they can be compared. */
function frame(scale) {
  if (!framed.has(scale.number)) {
    const about = data.scenes[scale.number].flat().map((scene) => scene?.picture).filter(Boolean);
    framed.set(scale.number, frameOf(scale, about));
  }
  return framed.get(scale.number);
}

function pictureOf(scene) { return numbers && scene?.picture ? opened(numbers, scene.picture) : null; }

function showScene(place) {
  const scale = roadOf(place);
  const scene = data.scenes[place][chosen.pressure][chosen.speed];
  const picture = pictureOf(scene);
  byId("small-pictures").replaceChildren();
  byId("energies").replaceChildren(...(picture ? energyScale(data.energies, data.colours.energy) : []));
  byId("picture").hidden = !picture;
  byId("spot").hidden = !(picture && scale.period);
  byId("caption").replaceChildren();
  byId("numbers").replaceChildren();
  byId("warnings").replaceChildren(...warningsOf([[place, scene]]));
  if (scene) byId("numbers").replaceChildren(sceneNumbers(scene));
  if (!picture) return null;
  const how = picture.finite
    ? "Displacements are to scale; the white lines made squares before deformation."
    : `Small strain: only vertical displacements are shown, to scale, without the mean compression of ${percent(scene.compression)}.`;
  const hint = (ZOOMS ? " Drag to zoom, double click to see all again." : "") + (scale.period ? " Click on the block to magnify another spot." : "");
  const seen = scale.period ? ` One period of the road, and the framed spot, ${rounded(0.75 * scale.wavelength, 2)}${THIN}mm wide, magnified.` : "";
  const drawn = place === "whole" && scale.draws ? ` The picture is of the first of the ${scale.windows ? "windows" : "random roads"}.` : "";
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
  const picture = pictureOf(data.scenes[number][chosen.pressure][chosen.speed]);
  const button = element("button", { type: "button", class: period ? "small wide" : "small", title: `Show ${period ? "the " : ""}${name}` });
  if (picture) button.append(paintSmall(picture, road, frame(road), period ? 1400 : 320, colours, data.energies));
  button.append(name);
  button.addEventListener("click", () => { choose({ place: String(number) }); byId("places").querySelector(`[value="${number}"]`).focus(); });
  return button;
}

function showTotal() {
  const pictured = data.whole && pictureOf(data.scenes.whole[chosen.pressure][chosen.speed]);
  const shown = [...data.scales.map(({ number }) => String(number)), ...(data.whole ? ["whole"] : [])];
  const scenes = shown.map((place) => [place, data.scenes[place][chosen.pressure][chosen.speed]]);
  byId("small-pictures").replaceChildren(...[...(pictured ? [data.whole] : []), ...data.scales].map(smallPicture));
  byId("energies").replaceChildren();
  byId("caption").textContent = "Bars: each scale alone at this pressure, and the whole error of their sum. Diamonds: the total with its error. " +
    "Pictures: the block on the whole road and on each scale, each in its own size, brighter where more energy is stored." +
    (data.whole?.draws ? ` The whole road in the picture is the first of ${data.whole.draws} ${drawnWords(data)}.` : "");
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
  showControls();
  showWords();
  const chart = byId("chart");
  const plot = chosen.view === "map" ? mapPlot(data, chosen, chart.clientWidth) : curvesPlot(data, chosen);
  const size = { width: chart.clientWidth, height: chart.clientHeight };
  const charted = Plotly.react(chart, plot.traces, { ...plot.layout, ...size }, CONFIG);
  drawn = Promise.all([charted, chosen.place === "total" ? showTotal() : showScene(chosen.place)]).then(() => {
    for (const id of ["chart", "picture"]) listen(byId(id));
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
    else if (Array.isArray(place)) choose({ pressure: place[0], speed: place[1] });
  });
}

async function begin() {
  const first = highestScene(places[0]);
  Object.assign(chosen, { pressure: first.pressure, speed: first.speed });
  readAddress();
  for (const make of [showAbout, makeControls, makeTemperatures]) make();
  document.querySelector("main").hidden = false;
  try {
    numbers = await unpack(data.pictures);
  } catch {
    byId("notice").hidden = false;
    byId("notice").textContent = "This browser cannot unpack the pictures of the block; Chrome 80, Firefox 113, Safari 16.4 and later can.";
  }
  choose({});
}

begin();
