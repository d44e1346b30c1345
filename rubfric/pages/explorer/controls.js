"use strict";
// The controls that choose what is shown, and what they show of it.

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
