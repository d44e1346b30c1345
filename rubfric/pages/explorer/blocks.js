"use strict";
// The deformed block on the road: its field as an image, and the plot around it.

const STEPS = 16383;

/** A picture in its units (mm, MPa; energies as decimal logarithms). */
function opened(numbers, about) {
  let place = about.begin;
  const take = (count, name) => {
    const [low, high] = about[name];
    const part = numbers.subarray(place, place + count);
    place += count;
    return Float64Array.from(part, (step) => low + (high - low) * (step / STEPS));
  };
  const nodes = about.rows * about.columns;
  const lines = about.net.reduce((sum, count) => sum + count, 0);
  const [x, netX] = [take(nodes, "x"), take(lines, "x")];
  const [y, netY] = [take(nodes, "y"), take(lines, "y")];
  const energy = take(nodes, "energy");
  const touching = take(about.touching, "x"), pressure = take(about.touching, "pressure");
  return { ...about, x, y, energy, netX, netY, touching, pressure };
}

/** What is seen of a road, mm: one and a quarter wavelengths about a crest, or a period, up to the highest of its blocks. */
function frameOf(road, pictures) {
  const { wavelength, period, crest, lowest, highest } = road;
  const top = Math.max(...pictures.map((about) => about.y[1]), 0);
  const unit = road.windows ? top - lowest : wavelength; // the coarsest wave of a window is as long as the window
  return {
    left: period ? 0 : crest - 0.625 * wavelength,
    right: period ?? crest + 0.625 * wavelength,
    bottom: lowest - 0.11 * unit,
    top: Math.min(top, highest + wavelength) + 0.04 * unit,
  };
}

function roadHeight({ waves }, x) {
  return waves.reduce((sum, [amplitude, wavenumber, phase]) => sum + amplitude * Math.sin(wavenumber * x + phase), 0);
}

/** Points of the road from left to right. */
function roadLine(scale, frame, count = scale.period ? 1500 : 240) {
  const x = Array.from({ length: count + 1 }, (_, place) => frame.left + ((frame.right - frame.left) * place) / count);
  return { x, y: x.map((at) => roadHeight(scale, at)) };
}

/** 256 colours of a map, as the words of an image. */
function shades(stops) {
  const hues = stops.map(parts);
  return Uint32Array.from({ length: 256 }, (_, shade) => {
    const at = (shade / 255) * (hues.length - 1);
    const low = Math.min(Math.floor(at), hues.length - 2);
    const [red, green, blue] = hues[low].map((part, hue) => Math.round(part + (at - low) * (hues[low + 1][hue] - part)));
    return (255 << 24) | (blue << 16) | (green << 8) | red;
  });
}

/** The field on a canvas: every cell is two triangles, with the energy linear in each. */
function paintField(picture, frame, width, colours, [low, high]) {
  const scale = width / (frame.right - frame.left);
  const height = Math.max(1, Math.round(scale * (frame.top - frame.bottom)));
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const across = picture.x.map((at) => (at - frame.left) * scale);
  const down = picture.y.map((at) => (frame.top - at) * scale);
  const shade = picture.energy.map((value) => Math.min(1, Math.max(0, (value - low) / (high - low))) * 255);
  const triangle = (a, b, c) => {
    const area = (across[b] - across[a]) * (down[c] - down[a]) - (across[c] - across[a]) * (down[b] - down[a]);
    if (area === 0) return;
    const clip = (value, end) => Math.min(end, Math.max(0, value));
    const top = clip(Math.floor(Math.min(down[a], down[b], down[c])), height);
    const bottom = clip(Math.ceil(Math.max(down[a], down[b], down[c])), height);
    const left = clip(Math.floor(Math.min(across[a], across[b], across[c])), width);
    const right = clip(Math.ceil(Math.max(across[a], across[b], across[c])), width);
    for (let row = top; row < bottom; row += 1) {
      for (let column = left; column < right; column += 1) {
        const x = column + 0.5, y = row + 0.5;
        const p = ((across[b] - x) * (down[c] - y) - (across[c] - x) * (down[b] - y)) / area;
        const q = ((across[c] - x) * (down[a] - y) - (across[a] - x) * (down[c] - y)) / area;
        const r = 1 - p - q;
        if (p < -1e-6 || q < -1e-6 || r < -1e-6) continue;
        pixels[row * width + column] = colours[Math.round(p * shade[a] + q * shade[b] + r * shade[c])];
      }
    }
  };
  for (let row = 0; row + 1 < picture.rows; row += 1) {
    for (let column = 0; column + 1 < picture.columns; column += 1) {
      const a = row * picture.columns + column, d = a + picture.columns;
      triangle(a, a + 1, d + 1);
      triangle(a, d + 1, d);
    }
  }
  const canvas = element("canvas", { width, height });
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}

/** A picture without axes: the field, the road, and where they touch; a large one has the net too. */
function paintSmall(picture, scale, frame, width, colours, energies, net = false) {
  const canvas = paintField(picture, frame, width, colours, energies);
  const pen = canvas.getContext("2d");
  const factor = width / (frame.right - frame.left);
  const to = (at, height) => [(at - frame.left) * factor, (frame.top - height) * factor];
  const trace = (x, y) => x.forEach((at, place) => pen.lineTo(...to(at, y[place])));
  /** Lines with breaks. */
  const broken = ({ x, y }) => {
    pen.beginPath();
    x.forEach((at, place) => {
      if (at === null) return;
      if (!place || x[place - 1] === null) pen.moveTo(...to(at, y[place]));
      pen.lineTo(...to(at, y[place]));
    });
    pen.stroke();
  };
  if (net && picture.finite) {
    pen.strokeStyle = "rgba(255,255,255,0.55)";
    pen.lineWidth = 1.5;
    broken(netLines(picture));
  }
  const road = roadLine(scale, frame);
  pen.beginPath();
  trace([frame.left, ...road.x, frame.right], [frame.bottom, ...road.y, frame.bottom]);
  pen.fillStyle = INKS.road;
  pen.fill();
  pen.lineWidth = 2.5;
  for (const row of [0, picture.rows - 1]) {
    const nodes = row * picture.columns;
    pen.beginPath();
    trace(picture.x.slice(nodes, nodes + picture.columns), picture.y.slice(nodes, nodes + picture.columns));
    pen.strokeStyle = INKS.ink;
    pen.stroke();
  }
  pen.strokeStyle = INKS.touch;
  pen.lineWidth = 8;
  pen.lineCap = "round";
  broken(contactLine(picture, scale));
  return canvas;
}

/** Where the block touches the road, with breaks where it does not. */
function contactLine(picture, scale) {
  const x = [], y = [];
  picture.touching.forEach((at, place) => {
    const on = picture.pressure[place] > 0;
    x.push(on ? at : null);
    y.push(on ? roadHeight(scale, at) : null);
  });
  return { x, y };
}

/** Lines of the net as one trace with breaks. */
function netLines(picture) {
  const x = [], y = [];
  let place = 0;
  for (const count of picture.net) {
    x.push(...picture.netX.subarray(place, place + count), null);
    y.push(...picture.netY.subarray(place, place + count), null);
    place += count;
  }
  return { x, y };
}

/** Traces and layout of the plot of a block. */
function blockPlot(picture, scale, frame, colours, energies, width) {
  const field = paintField(picture, frame, 1000, colours, energies);
  const road = roadLine(scale, frame);
  const face = (row) => ({
    x: Array.from(picture.x.subarray(row * picture.columns, (row + 1) * picture.columns)),
    y: Array.from(picture.y.subarray(row * picture.columns, (row + 1) * picture.columns)),
  });
  const line = (points, look, more = {}) => ({ ...points, mode: "lines", line: { ...look, simplify: false }, hoverinfo: "skip", ...more });
  const touch = contactLine(picture, scale), thick = scale.period ? 3 : 5;
  const traces = [
    line(netLines(picture), { color: "rgba(255,255,255,0.55)", width: 1 }, { visible: picture.finite && !scale.period }),
    line(
      { x: [frame.left, ...road.x, frame.right], y: [frame.bottom, ...road.y, frame.bottom] },
      { color: INKS.roadLine, width: 1 },
      { fill: "toself", fillcolor: INKS.road, fillpattern: { shape: "/", fgcolor: INKS.hatch, bgcolor: INKS.road, size: 7, solidity: 0.12 } },
    ),
    line(face(0), { color: INKS.ink, width: 1.4 }),
    line(face(picture.rows - 1), { color: INKS.ink, width: 1.4 }),
    { ...touch, mode: "lines+markers", line: { color: INKS.touch, width: thick, simplify: false }, marker: { color: INKS.touch, size: thick - 1 }, hoverinfo: "skip" },
    hoverNodes(picture, frame),
    {
      x: Array.from(picture.touching), y: Array.from(picture.pressure), yaxis: "y2", mode: "lines", fill: "tozeroy",
      line: { color: INKS.touch, width: 1.5, simplify: false }, fillcolor: translucent(INKS.touch, 0.22),
      hovertemplate: "contact pressure %{y:.3g} MPa, per undeformed area<br>at %{x:.3g} mm<extra></extra>",
    },
  ];
  return { traces, layout: blockLayout(picture, frame, field, width) };
}

/** Some of the nodes, invisible, that show their energy under the pointer. */
function hoverNodes(picture, frame) {
  const found = { x: [], y: [], text: [] };
  for (let row = 0; row < picture.rows; row += 2) {
    for (let column = 0; column < picture.columns; column += 4) {
      const node = row * picture.columns + column;
      if (picture.x[node] < frame.left || picture.x[node] > frame.right) continue;
      found.x.push(picture.x[node]);
      found.y.push(picture.y[node]);
      found.text.push(`${rounded(10 ** picture.energy[node])} MPa`);
    }
  }
  return { ...found, mode: "markers", marker: { opacity: 0, size: 8 }, hovertemplate: "strain energy %{text}<extra></extra>" };
}

/** The block above, to scale, and the contact pressure below it, on the same abscissa. */
function blockLayout(picture, frame, field, width) {
  const margin = { l: 60, r: 10, t: 8, b: 40 };
  const wide = Math.max(60, width - margin.l - margin.r);
  const tall = (wide * (frame.top - frame.bottom)) / (frame.right - frame.left);
  const [gap, profile] = [14, 70];
  const inner = tall + gap + profile;
  const axis = { zeroline: false, showgrid: false, ticks: "outside", ticklen: 4, tickcolor: INKS.rule, linecolor: INKS.rule };
  const title = (text) => ({ text, standoff: 6, font: { size: 12 } });
  return {
    ...LOOK, margin, width, height: inner + margin.t + margin.b, showlegend: false, hovermode: "closest", dragmode: ZOOMS ? "zoom" : false,
    xaxis: { ...axis, range: [frame.left, frame.right], anchor: "y2", title: title("distance along the road (mm)"), nticks: 6, fixedrange: !ZOOMS, constrain: "domain" },
    yaxis: {
      ...axis, range: [frame.bottom, frame.top], domain: [(profile + gap) / inner, 1], scaleanchor: "x", constrain: "domain",
      title: title(tall > 95 ? "height (mm)" : "mm"), nticks: tall > 95 ? 6 : 4, fixedrange: !ZOOMS,
    },
    yaxis2: {
      ...axis, domain: [0, profile / inner], range: [0, 1.12 * Math.max(...picture.pressure, 1e-12)],
      title: title("MPa"), nticks: 3, fixedrange: true, showgrid: true, gridcolor: INKS.grid,
    },
    images: [{
      source: field.toDataURL(), xref: "x", yref: "y", x: frame.left, y: frame.top, sizex: frame.right - frame.left,
      sizey: frame.top - frame.bottom, sizing: "stretch", layer: "below",
    }],
  };
}
