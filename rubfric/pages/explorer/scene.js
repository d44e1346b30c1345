"use strict";
// The block of a scene, and of the total what its scales add, beside the chart.

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
