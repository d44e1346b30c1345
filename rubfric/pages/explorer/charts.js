"use strict";
// Friction against speed, as a map over speed and pressure, and as bars of the scales.

/** The words at a point under the pointer. */
function pointWords(data, place, pressure, speed) {
  const curve = data.curves[place];
  const friction = curve.friction[pressure][speed], error = curve.error[pressure][speed];
  const lines = [`${speedOf(data.speeds[speed])}, ${pressureOf(data.pressures[pressure])}`];
  if (friction === null) return `${lines[0]}<br>${place === "whole" ? whyNot(data, pressure, speed) : "not run"}`;
  const share = relative(friction, error);
  lines.push(`<b>μ ${measured(friction, error)}</b>${share ? ` (${share})` : ""}`);
  if (place === "total") {
    lines.push(WAY_NAMES[data.totals.way[pressure][speed]], ...partsWords(data, pressure, speed));
    for (const way of ["sum", "corrected", "cascade", "persson"]) {
      const { friction: of, error: off } = data.totals.ways[way];
      if (of[pressure][speed] !== null) lines.push(`${WAY_NAMES[way]}: ${measured(of[pressure][speed], off[pressure][speed])}`);
    }
  } else {
    if (place === "whole" && data.whole.draws) lines.push(`mean over ${data.whole.draws} ${data.whole.windows ? "windows" : "random roads"}`);
    lines.push(...sceneWords(data.scenes[place][pressure][speed]).slice(1));
  }
  return [...lines, ...warningLines(data, place, pressure, speed)].join("<br>");
}

/** The words about a scene: its friction, what the rubber's data leave open, its contact and kinematics. */
function sceneWords(scene) {
  const share = relative(scene.friction, scene.error);
  const mixed = scene.finite > 0 && scene.finite < 1; // a mean over several roads
  return [
    `<b>μ ${measured(scene.friction, scene.error)}</b>${share ? ` (${share})` : ""}`,
    ...(scene.rubberError > 0 ? [`rubber’s data: ± ${roundedUp(scene.rubberError).text}`] : []),
    `contact ${percent(scene.contact)}`, mixed ? "small and finite strain" : scene.finite ? "finite strain" : "small strain",
  ];
}

/** Stretches of neighbouring speeds of which friction and error are known. */
function stretches(friction, error) {
  const found = [];
  friction.forEach((value, place) => {
    if (value === null || error[place] === null) return;
    const last = found[found.length - 1];
    if (last && last[last.length - 1] === place - 1) last.push(place);
    else found.push([place]);
  });
  return found;
}

/** An axis with a tick at every speed; the powers of ten have numbers, or the speeds where they span less. */
function speedAxis(speeds) {
  const [low, high] = [Math.log10(speeds[0]), Math.log10(speeds[speeds.length - 1])];
  const room = Math.max(0.03 * (high - low), 0.05);
  const powers = [], factor = UNITS[unit];
  for (let power = Math.ceil(low + Math.log10(factor) - 1e-9); power <= Math.floor(high + Math.log10(factor) + 1e-9); power += 1) powers.push(10 ** power / factor);
  const named = powers.length > 1 ? powers : speeds;
  const ticks = [...named, ...speeds.filter((speed) => !named.some((one) => Math.abs(one - speed) < 1e-9 * speed))];
  return {
    ...AXIS, type: "log", range: [low - room, high + room], showgrid: false,
    tickvals: ticks, ticktext: ticks.map((speed, place) => (place < named.length ? speedNumber(speed) : "")),
    title: titled(`sliding speed (${unit})`),
  };
}

/** Labels of places that represent speeds; every other one where there is no room for all. */
function speedLabels(speeds, width) {
  const step = Math.ceil(38 / Math.max(1, (width - 90) / speeds.length));
  return speeds.map((speed, place) => (place % step === 0 ? speedNumber(speed) : ""));
}

/** The band of the error of a curve, in as many parts as there are stretches without a gap. */
function bandsOf(speeds, friction, error, colour) {
  return stretches(friction, error).map((run) => {
    const there = [...run, ...[...run].reverse()];
    return {
      x: there.map((place) => speeds[place]),
      y: there.map((place, count) => friction[place] + (count < run.length ? error[place] : -error[place])),
      mode: "lines", fill: "toself", fillcolor: translucent(colour, 0.28), line: { width: 0 }, hoverinfo: "skip",
    };
  });
}

/** Curves of friction against speed, one for each pressure, the chosen one on top. */
function curvesPlot(data, chosen) {
  const curve = data.curves[chosen.place];
  const order = data.pressures.map((_, place) => place).filter((place) => place !== chosen.pressure);
  const bands = [], lines = [], rings = [];
  for (const pressure of [...order, chosen.pressure]) {
    const friction = curve.friction[pressure], error = curve.error[pressure], colour = pressureColour(data, pressure);
    const strong = pressure === chosen.pressure;
    bands.push(...bandsOf(data.speeds, friction, error, colour));
    lines.push({
      x: data.speeds, y: friction, name: pressureOf(data.pressures[pressure]), mode: "lines+markers", connectgaps: false,
      line: { color: colour, width: strong ? 3.2 : 1.6, dash: DASHES[pressure % DASHES.length] },
      marker: { symbol: SYMBOLS[pressure % SYMBOLS.length], size: strong ? 10 : 8, color: colour, line: { width: 1.5, color: colour } },
      error_y: { array: error.map((value) => value ?? 0), color: colour, thickness: 1.2, width: 3 },
      customdata: data.speeds.map((_, speed) => [pressure, speed]),
      text: data.speeds.map((_, speed) => pointWords(data, chosen.place, pressure, speed)), hovertemplate: "%{text}<extra></extra>",
    });
    const { kind, at } = curve.peaks[pressure];
    if (kind === "peak") {
      rings.push({
        x: [data.speeds[at]], y: [friction[at]], mode: "markers", hoverinfo: "skip",
        marker: { symbol: "circle-open", size: 19, color: colour, line: { width: 1.6 } },
      });
    }
  }
  const warned = warningMarks(data, chosen.place, (pressure, speed) => [data.speeds[speed], curve.friction[pressure][speed]]);
  const here = { x: [data.speeds[chosen.speed]], y: [curve.friction[chosen.pressure][chosen.speed]] };
  const point = {
    ...here, mode: "markers", hoverinfo: "skip",
    marker: { size: 12, color: pressureColour(data, chosen.pressure), line: { width: 2.5, color: INKS.ink } },
  };
  const x = data.speeds[chosen.speed];
  const total = chosen.place === "total", summed = total ? [comparison(data, chosen)] : [], beside = othersPlot(data, chosen);
  const apart = chosen.place === "whole" ? roadPoints(data, chosen).flatMap(({ y }) => y.map((value) => value ?? 0)) : [];
  const top = Math.max(highestOf(curve), ...apart, ...[...summed, ...beside].flatMap(({ y }) => y.map((value) => value ?? 0)));
  return {
    traces: [...bands, ...rings, warned, ...summed, ...beside, ...lines, ...(chosen.place === "whole" ? roadPoints(data, chosen) : []), point, ...(total ? [crosses(data)] : [])],
    layout: {
      ...LOOK, margin: { l: 58, r: 14, t: 10, b: 52 }, showlegend: false, hovermode: "closest", hoverdistance: 30, dragmode: false,
      xaxis: speedAxis(data.speeds),
      yaxis: { ...AXIS, rangemode: "tozero", range: [0, 1.07 * top], title: titled("friction coefficient μ"), tickformat: ".3~g" },
      shapes: [{ type: "line", x0: x, x1: x, yref: "paper", y0: 0, y1: 1, line: { color: INKS.roadLine, width: 1, dash: "dot" }, layer: "below" }],
    },
  };
}

function highestOf(curve) {
  const tops = curve.friction.flatMap((row, pressure) => row.map((value, speed) => (value ?? 0) + (curve.error[pressure][speed] ?? 0)));
  return Math.max(...tops, 1e-9);
}

/** A map of friction: a cell for each scene that was run, with nothing made up between them. */
function mapPlot(data, chosen, width) {
  const curve = data.curves[chosen.place];
  const speeds = data.speeds.map((_, place) => place), pressures = data.pressures.map((_, place) => place);
  const roomy = (width - 100) / speeds.length > 40;
  const rings = { x: [], y: [] };
  curve.peaks.forEach(({ kind, at }, pressure) => {
    if (kind === "peak") { rings.x.push(at + (roomy ? 0.36 : 0)); rings.y.push(pressure + (roomy ? 0.34 : 0)); }
  });
  const stops = data.colours.friction;
  const cells = {
    type: "heatmap", x: speeds, y: pressures, z: curve.friction, zmin: 0, zmax: highestOf(curve), xgap: 2, ygap: 2, hoverongaps: false,
    colorscale: stops.map((stop, place) => [place / (stops.length - 1), stop]),
    customdata: pressures.map((pressure) => speeds.map((speed) => [pressure, speed])),
    text: pressures.map((pressure) => speeds.map((speed) => pointWords(data, chosen.place, pressure, speed))),
    hovertemplate: "%{text}<extra></extra>", texttemplate: roomy ? "%{z:.3f}" : "", textfont: { size: roomy ? 12 : 10 },
    colorbar: { thickness: 10, outlinewidth: 0, title: { text: "μ" }, tickformat: ".3~g", len: 1, x: 1.01, xpad: 6 },
  };
  const marks = { ...rings, mode: "markers", hoverinfo: "skip", marker: { symbol: "circle", size: 8, color: "#ffffff", line: { width: 1.8, color: LIGHT.ink } } };
  const warned = warningMarks(data, chosen.place, (pressure, speed) => [speed - (roomy ? 0.36 : 0), pressure + (roomy ? 0.34 : 0)]);
  const [x, y] = [chosen.speed, chosen.pressure];
  const ticks = (tickvals, ticktext) => ({ tickvals, ticktext, range: [-0.5, tickvals.length - 0.5], showgrid: false, ticks: "", tickangle: 0 });
  return {
    traces: [cells, marks, { ...warned, marker: { symbol: "triangle-up", size: 11, color: "#ffffff", line: { width: 1.8, color: LIGHT.warning } } }],
    layout: {
      ...LOOK, margin: { l: 58, r: 14, t: 10, b: 52 }, showlegend: false, hovermode: "closest", dragmode: false,
      xaxis: { ...AXIS, ...ticks(speeds, speedLabels(data.speeds, width - 50)), title: titled(`sliding speed (${unit})`) },
      yaxis: { ...AXIS, ...ticks(pressures, data.pressures.map(plain)), title: titled("nominal pressure (MPa)") },
      shapes: [{ type: "rect", x0: x - 0.49, x1: x + 0.49, y0: y - 0.49, y1: y + 0.49, line: { color: INKS.touch, width: 3.5 } }],
    },
  };
}

/** What each scale adds to their sum, and the total, at every speed and the chosen pressure. */
function barsPlot(data, chosen, width) {
  const places = data.speeds.map((_, place) => place);
  const { friction: summed, error: off } = data.totals.ways.sum;
  const total = data.curves.total;
  const opacity = places.map((place) => (place === chosen.speed ? 1 : 0.42));
  const bars = data.scales.map(({ number }, order) => {
    const scenes = data.scenes[number][chosen.pressure];
    const whole = places.map((place) => summed[chosen.pressure][place] !== null);
    return {
      type: "bar", name: `scale ${number}`, x: places, y: scenes.map((scene, place) => (whole[place] ? scene.friction : null)),
      marker: { color: scaleColour(data, order), opacity, line: { width: 0 } },
      customdata: places.map((speed) => [chosen.pressure, speed]),
      text: scenes.map((scene) => (scene ? `scale ${number} alone: μ ${measured(scene.friction, scene.error)}` : "")),
      textposition: "none", hovertemplate: "%{text}<extra></extra>",
    };
  });
  const points = (name, values, errors, symbol, ink) => ({
    x: places, y: values[chosen.pressure], mode: "markers", name, marker: { symbol, size: 10, color: ink, line: { width: 1.5, color: symbol === "diamond" ? INKS.paper : ink } },
    error_y: { array: errors[chosen.pressure].map((value) => value ?? 0), color: ink, thickness: 1.5, width: 5 },
    customdata: places.map((speed) => [chosen.pressure, speed]),
    text: places.map((speed) => pointWords(data, "total", chosen.pressure, speed)), hovertemplate: "%{text}<extra></extra>",
  });
  const sums = points("sum", summed, off, "line-ew-open", INKS.quiet);
  return {
    traces: [...bars, sums, points("total", total.friction, total.error, "diamond", INKS.ink)],
    layout: {
      ...LOOK, barmode: "stack", bargap: 0.28, width, height: 270, margin: { l: 52, r: 8, t: 26, b: 48 }, hovermode: "closest", dragmode: false,
      legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom", traceorder: "normal", font: { size: 12 }, itemclick: false, itemdoubleclick: false },
      xaxis: { ...AXIS, tickvals: places, ticktext: speedLabels(data.speeds, width), tickangle: 0, ticks: "", range: [-0.6, places.length - 0.4], showgrid: false, title: titled(`sliding speed (${unit})`) },
      yaxis: { ...AXIS, rangemode: "tozero", title: titled("friction coefficient μ"), tickformat: ".3~g" },
    },
  };
}
