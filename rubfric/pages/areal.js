"use strict";
(() => {
  const held = JSON.parse(document.getElementById("maps").textContent);
  const at = (id) => document.getElementById(id);
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  // The colours of plasma, from low to high.
  const stops = ["0d0887", "4c02a1", "7e03a8", "a92395", "cc4778", "e56b5d", "f89540", "fdc527", "f0f921"].map((hex) =>
    [0, 2, 4].map((place) => parseInt(hex.slice(place, place + 2), 16)),
  );
  const colour = (level) => {
    const place = ((level - 1) / 254) * (stops.length - 1);
    const first = Math.min(Math.floor(place), stops.length - 2);
    return stops[first].map((value, part) => value + (place - first) * (stops[first + 1][part] - value));
  };
  const [ny, nx] = held.shape;
  const heights = bytes(held.heights);
  const speeds = [...new Set(held.scenes.map((scene) => scene.velocity))].sort((a, b) => a - b);
  const loads = [...new Set(held.scenes.map((scene) => scene.load))].sort((a, b) => a - b);
  const map = at("map");
  map.width = nx;
  map.height = ny;
  map.style.aspectRatio = `${held.periods[0]} / ${held.periods[1]}`;
  const pen = map.getContext("2d", { willReadFrequently: true }); // pixels are written one by one, none is drawn
  const shown = { speed: Math.floor((speeds.length - 1) / 2), load: 0 };

  const written = (value, digits = 4) => (value === null || value === undefined ? "" : String(Number(value.toPrecision(digits))));
  const digits = (error) => Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(error))));
  const within = (value, error) =>
    value === null || value === undefined ? "" : error ? `${value.toFixed(digits(error))} ± ${error.toFixed(digits(error))}` : written(value);
  const percent = (value) => (value === null || value === undefined ? "" : `${written(100 * value, 3)} %`);

  function numbers(one) {
    return [
      ["Friction coefficient, surface", within(one.friction_coefficient, one.friction_error)],
      ["Its profiles in the plane model", within(one.friction_plane, one.friction_plane_error)],
      ["Profiles over surface", within(one.plane_over_surface, one.plane_over_surface_error)],
      ["Persson 2001", written(one.persson_friction)],
      ["Persson 2006, gamma = 1/2", written(one.persson_friction_reduced)],
      ["Contact area over nominal", percent(one.contact_fraction)],
      ["Of profiles in the plane model", percent(one.contact_plane)],
      ["By Persson's theory", percent(one.persson_contact_fraction)],
    ].filter((row) => row[1] !== "");
  }

  function draw() {
    const speed = speeds[shown.speed];
    const load = loads[shown.load];
    at("speed-now").textContent = `${speed} mm/s`;
    at("speed").setAttribute("aria-valuetext", `${speed} mm/s`);
    const scene = held.scenes.find((one) => one.velocity === speed && one.load === load);
    scene.level ??= bytes(scene.pressure);
    const picture = pen.createImageData(nx, ny);
    for (let row = 0; row < ny; row += 1) {
      for (let column = 0; column < nx; column += 1) {
        const from = row * nx + column;
        const to = 4 * ((ny - 1 - row) * nx + column);
        const level = scene.level[from];
        const grey = 90 + 0.6 * heights[from];
        picture.data.set(level ? [...colour(level), 255] : [grey, grey, grey, 255], to);
      }
    }
    pen.putImageData(picture, 0, 0);
    map.setAttribute("aria-label", `Contact at ${speed} mm/s and ${load} MPa: ${percent(scene.numbers.contact_fraction)} of the road is touched`);
    const body = at("numbers").tBodies[0];
    body.replaceChildren(
      ...numbers(scene.numbers).map((cells) => {
        const line = document.createElement("tr");
        line.append(...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
        return line;
      }),
    );
  }

  at("speed").max = speeds.length - 1;
  at("speed").value = shown.speed;
  at("speed").addEventListener("input", (event) => {
    shown.speed = Number(event.target.value);
    draw();
  });
  loads.forEach((load, place) => {
    const label = document.createElement("label");
    const choice = Object.assign(document.createElement("input"), { type: "radio", name: "load", checked: !place });
    choice.addEventListener("change", () => {
      shown.load = place;
      draw();
    });
    label.append(choice, ` ${load}`);
    at("loads").append(label);
  });
  const bar = at("bar").getContext("2d");
  for (let level = 1; level <= 255; level += 1) {
    bar.fillStyle = `rgb(${colour(level).map(Math.round).join(",")})`;
    bar.fillRect(level - 1, 0, 1, 1);
  }
  at("scale-low").textContent = `${written(held.scale[0], 2)} MPa or less`;
  at("scale-high").textContent = `${written(held.scale[1], 2)} MPa or more`;
  draw();
})();
