"use strict";
// What is shown, to take away: the numbers as CSV with units in the heads, the pictures as PNG with their captions.

/** The name of a file: rubber, road, what of it, and where it is of one scene pressure and speed. */
function fileName(kind, scene) {
  const { rubber, road } = data.about, { place, pressure, speed } = chosen;
  const of = scene && place === "whole" && severalRoads(data).length ? `_${roadName(data, chosen.road)}` : "";
  const warm = temperatures.length ? `_${temperatures[warmth]}degC` : "";
  const at = scene ? `_${data.pressures[pressure]}MPa_${data.speeds[speed]}mm_per_s` : `_${chosen.view}`;
  return `${rubber}_${road}_${placeName(place).toLowerCase()}${of}${at}${warm}.${kind}`.replace(/[^\w.+-]+/g, "-");
}

function save(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Rows of equal keys as CSV; what is not known stays empty. */
function asCsv(rows) {
  const written = (value) => {
    const text = value === null || value === undefined ? "" : String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const heads = Object.keys(rows[0] ?? {});
  const lines = [heads, ...rows.map((row) => heads.map((head) => row[head]))].map((cells) => cells.map(written).join(","));
  return new Blob([`${lines.join("\n")}\n`], { type: "text/csv" });
}

function whereColumns(pressure, speed) {
  return {
    ...(temperatures.length && { temperature_degC: temperatures[warmth] }),
    velocity_mm_per_s: data.speeds[speed], pressure_MPa: data.pressures[pressure],
  };
}

/** Of the chart: the friction at every pressure and speed, and that of the others which are shown. */
function chartRows() {
  const { place } = chosen, here = `${data.about.rubber} on ${data.about.road}`;
  const curves = [{ name: here, ...data.curves[place] }, ...compared(data, chosen)];
  return curves.flatMap(({ name, friction, error }) => data.pressures.flatMap((_, pressure) => data.speeds.map((_, speed) => ({
    rubber_and_road: name, of: placeName(name === here ? place : "total").toLowerCase(), ...whereColumns(pressure, speed),
    friction: friction[pressure][speed], friction_error: error[pressure][speed],
    way: name === here && place === "total" ? data.totals.way[pressure][speed] : "",
    warnings: name === here ? scenesBehind(data, place, pressure, speed).reduce((sum, [, scene]) => sum + (scene?.warnings?.length ?? 0), 0) : "",
  }))));
}

/** Of the scene: the road and the contact pressure along it; of the total, what every scale adds and every way gives. */
function sceneRows() {
  const { place, pressure } = chosen;
  if (place === "total") {
    return data.speeds.map((_, speed) => Object.fromEntries([
      ...Object.entries(whereColumns(pressure, speed)),
      ...data.scales.flatMap(({ number }) => [["friction", "friction"], ["friction_error", "error"]].map(([head, name]) => [`${head}_scale_${number}`, data.scenes[number][pressure][speed]?.[name]])),
      ...Object.entries(data.totals.ways).flatMap(([way, { friction, error }]) => [[`friction_${way}`, friction[pressure][speed]], [`friction_error_${way}`, error[pressure][speed]]]),
      ["friction_total", data.curves.total.friction[pressure][speed]], ["friction_error_total", data.curves.total.error[pressure][speed]],
    ]));
  }
  const picture = pictureOf(sceneAt(place)), road = roadOf(place);
  const digits = (value) => Number(value.toPrecision(5));
  return Array.from(picture?.touching ?? [], (at, order) => ({
    distance_mm: digits(at), road_height_mm: digits(roadHeight(road, at)), contact_pressure_per_undeformed_area_MPa: digits(picture.pressure[order]),
  }));
}

/** Draw one below the other: words, pictures, the legend of the pressures and the scale of energies. */
function composed(items, wide = 1000) {
  const canvas = element("canvas"), pen = canvas.getContext("2d"), zoom = 2, margin = 24;
  const font = ({ size, bold }) => `${bold ? "600 " : ""}${size}px ${FONT}`;
  const laid = items.map((item) => {
    if (item.images) {
      const each = Math.min(wide, (wide + 16) / item.images.length - 16);
      return { ...item, each, height: Math.max(...item.images.map(({ width, height }) => (height * each) / width)) + (item.names ? 30 : 8) };
    }
    if (item.stops) return { ...item, height: 52 };
    pen.font = font(item);
    const lines = [""];
    for (const word of item.text.split(" ")) {
      const longer = `${lines[lines.length - 1]}${word} `;
      if (pen.measureText(longer).width > wide) lines.push(`${word} `);
      else lines[lines.length - 1] = longer;
    }
    return { ...item, lines, height: lines.length * item.size * 1.4 + 6 };
  });
  canvas.width = zoom * (wide + 2 * margin);
  canvas.height = zoom * (laid.reduce((sum, { height }) => sum + height, 0) + 2 * margin);
  pen.scale(zoom, zoom);
  pen.fillStyle = LIGHT.paper;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  let down = margin;
  for (const item of laid) {
    pen.fillStyle = item.quiet ? LIGHT.quiet : LIGHT.ink;
    if (item.images) {
      pen.font = `13px ${FONT}`;
      item.images.forEach((image, order) => {
        const left = margin + order * (item.each + 16), high = (image.height * item.each) / image.width;
        pen.drawImage(image, left, down, item.each, high);
        if (item.names) pen.fillText(item.names[order], left, down + high + 16);
      });
    } else if (item.stops) drawScale(pen, item, margin, down, wide);
    else {
      pen.font = font(item);
      item.lines.forEach((line, order) => pen.fillText(line, margin, down + item.size * (1 + 1.4 * order)));
    }
    down += item.height;
  }
  return new Promise((resolve) => { canvas.toBlob(resolve, "image/png"); });
}

/** The scale of energies on a canvas. */
function drawScale(pen, { stops, range: [low, high] }, left, top, wide) {
  const fill = pen.createLinearGradient(left, 0, left + wide, 0);
  stops.forEach((stop, order) => fill.addColorStop(order / (stops.length - 1), stop));
  pen.font = `13px ${FONT}`;
  pen.fillText("strain-energy density (MPa)", left, top + 13);
  pen.textAlign = "center";
  for (const value of decades([low, high])) pen.fillText(plain(value), left + (wide * (Math.log10(value) - low)) / (high - low), top + 44);
  pen.textAlign = "left";
  pen.fillStyle = fill;
  pen.fillRect(left, top + 19, wide, 10);
}

/** A plot as an image, as large as it is on the screen. */
async function plotImage(plot) {
  const { width, height } = plot._fullLayout;
  const image = element("img", { src: await Plotly.toImage(plot, { format: "png", width, height, scale: 2 }) });
  await image.decode();
  return image;
}

/** The lines of the chart and what they are, as an image. */
function legendImage() {
  const entries = [...data.pressures.map((pressure, order) => [pressureOf(pressure), pressureColour(data, order), DASHES[order % DASHES.length]]),
    ...compared(data, chosen).map(({ name, colour }) => [`${name}, ${pressureOf(data.pressures[chosen.pressure])}`, colour, "9px,4px"])];
  const canvas = element("canvas", { width: 2000, height: 10 }), pen = canvas.getContext("2d");
  pen.font = `26px ${FONT}`;
  let right = 0, row = 0;
  const placed = entries.map(([name, colour, dash]) => {
    const width = 100 + pen.measureText(name).width;
    if (right + width > 2000) [right, row] = [0, row + 1];
    right += width;
    return { name, colour, dash, x: right - width, y: 22 + 40 * row };
  });
  canvas.height = 40 * (row + 1);
  for (const { name, colour, dash, x, y } of placed) {
    pen.font = `26px ${FONT}`;
    pen.fillStyle = LIGHT.ink;
    pen.fillText(name, x + 60, y + 9);
    pen.strokeStyle = colour;
    pen.lineWidth = 5;
    pen.setLineDash(dash === "solid" ? [] : dash.split(",").map((part) => 2 * parseFloat(part)));
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + 50, y);
    pen.stroke();
  }
  return canvas;
}

const said = (id, look) => ({ text: byId(id).innerText.replaceAll("\n", " "), size: 15, ...look });

async function chartItems() {
  const legend = chosen.view === "map" ? [] : [{ images: [legendImage()] }];
  return [said("chart-title", { size: 20, bold: true }), { images: [await plotImage(byId("chart"))] }, ...legend, said("marks", { quiet: true }), said("peak")];
}

async function sceneItems() {
  const shown = (id) => (byId(id).hidden ? [] : [...byId(id).querySelectorAll("canvas")]);
  const scale = shown("small-pictures").length || !byId("spot").hidden || byId("energies").children.length ? [{ stops: data.colours.energy, range: data.energies }] : [];
  const small = [".small.wide canvas", ".small:not(.wide) canvas"].map((which) => [...byId("small-pictures").querySelectorAll(which)])
    .filter((images) => images.length).map((images) => ({ images, names: images.map((image) => image.nextSibling.textContent) }));
  const plot = byId("picture").hidden ? [] : [{ images: [await plotImage(byId("picture"))] }];
  return [said("scene-title", { size: 20, bold: true }), said("headline", { size: 24, bold: true }), said("covers", { quiet: true }),
    ...plot, ...shown("spot").map((image) => ({ images: [image] })), ...small, ...scale, said("caption", { quiet: true }), said("warnings")].filter(({ text }) => text !== "");
}

/** Save a chart or a scene as it is, on light ground, with its words and where it is from. */
async function savePicture(items, name) {
  stopPlaying();
  dress(false);
  draw();
  await drawn;
  const from = { text: `${document.title}. ${byId("about").textContent} ${data.about.source}.`, size: 12, quiet: true };
  const blob = await composed([...(await items()), from]);
  dress(darkness.matches);
  draw();
  save(blob, name);
}

function makeSaves() {
  const kinds = { chart: [chartItems, chartRows], scene: [sceneItems, sceneRows] };
  for (const [part, [items, rows]] of Object.entries(kinds)) {
    const button = (kind, act) => {
      const made = element("button", { type: "button", class: "button", id: `${part}-${kind.toLowerCase()}`, "aria-label": `Save the ${part} as ${kind}` }, kind);
      made.addEventListener("click", act);
      return made;
    };
    byId(`${part}-saves`).append(element("span", { class: "quiet" }, "Save as"),
      button("PNG", () => savePicture(items, fileName("png", part === "scene"))), button("CSV", () => save(asCsv(rows()), fileName("csv", part === "scene"))));
  }
}
