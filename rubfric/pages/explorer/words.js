"use strict";
// Numbers as a reader wants them, and elements of the page. Text never becomes markup: names come from the user.

const THIN = "\u202f"; // narrow space that does not break

/** A number as in the figures: 0.1, 10, 1000, 10 000, −5. */
function plain(value) {
  const text = String(Number(value.toPrecision(12))).replace("-", "−");
  if (text.includes("e") || Math.abs(value) < 10000) return text;
  const [whole, fraction] = text.split(".");
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, THIN);
  return fraction ? `${grouped}.${fraction}` : grouped;
}

/** A number with this many significant digits. */
function rounded(value, digits = 3) {
  if (value === null) return "unknown";
  const text = value.toPrecision(digits);
  return text.includes("e") ? plain(Number(text)) : plain(Math.abs(value) >= 100 ? Math.round(value) : Number(text));
}

/** A share in per cent, two digits that count. */
function percent(share) {
  if (share === null) return "unknown";
  const value = 100 * share;
  if (value > 0 && value < 0.001) return `below 0.001${THIN}%`;
  return `${Math.abs(value) >= 10 ? Math.round(value) : plain(Number(value.toPrecision(2)))}${THIN}%`;
}

/** An error with two digits that count, rounded up, and the digits after the point that it needs. */
function roundedUp(error) {
  const digits = Math.min(9, Math.max(0, 1 - Math.floor(Math.log10(error))));
  const unit = 10 ** -digits;
  return { digits, text: (Math.ceil(error / unit - 1e-9) * unit).toFixed(digits) };
}

/** Friction and its error, with the digits that the error leaves. */
function measured(friction, error) {
  if (friction === null) return "not run";
  if (error === null) return `${rounded(friction)}, error unknown`;
  if (error <= 0) return `${rounded(friction, 4)} ± 0`;
  const { digits, text } = roundedUp(error);
  return `${friction.toFixed(digits)} ± ${text}`;
}

/** The error as a share of friction, rounded up; nothing where there is none. */
function relative(friction, error) {
  if (friction === null || error === null || friction === 0) return "";
  const share = Math.abs(error / friction) * 100;
  if (share <= 0) return "";
  const unit = Math.min(1, 10 ** (Math.floor(Math.log10(share)) - 1));
  return `${plain(unit * Math.ceil(share / unit - 1e-9))}${THIN}%`;
}

// Units of speed, and how many of them are 1 mm/s; the page keeps speeds in mm/s, and writes them in the one that is chosen.
const UNITS = { "mm/s": 1, "m/s": 1e-3, "km/h": 3.6e-3 };
let unit = "mm/s";
function speedNumber(value, of = unit) { return plain(value * UNITS[of]); }
function speedOf(value, of = unit) { return `${speedNumber(value, of)}${THIN}${of}`; }
function otherUnits(value) { return Object.keys(UNITS).filter((name) => name !== unit).map((name) => speedOf(value, name)).join(" · "); }
function pressureOf(value) { return `${plain(value)}${THIN}MPa`; }

/** A sentence with its capital and full stop. */
function sentence(words) {
  const text = words.trim();
  return text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
}

/** Make an element: its attributes, then children or text. */
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A radio button that looks like a part of a row. */
function option(group, value, ...label) {
  const input = element("input", { type: "radio", name: group, value });
  return element("label", { class: "option" }, input, element("span", {}, ...label));
}

/** The line of a pressure. */
function swatch(dash) {
  const name = "http://www.w3.org/2000/svg";
  const drawing = document.createElementNS(name, "svg");
  drawing.setAttribute("width", "22");
  drawing.setAttribute("height", "6");
  drawing.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(name, "line");
  const look = { x1: 0, x2: 22, y1: 3, y2: 3, "stroke-width": 3 };
  if (dash !== "solid") look["stroke-dasharray"] = dash.replaceAll("px", "");
  for (const [key, value] of Object.entries(look)) line.setAttribute(key, value);
  drawing.append(line);
  return drawing;
}

function byId(id) { return document.getElementById(id); }

/** What is known of the peak of a curve at one pressure, in words. */
function peakWords(curve, pressure, pressures, speeds) {
  const { kind, at, between, missing } = curve.peaks[pressure];
  const here = `At ${pressureOf(pressures[pressure])}`;
  if (kind === "none") return `${here} nothing was run.`;
  const highest = measured(curve.friction[pressure][at], curve.error[pressure][at]);
  const there = speedOf(speeds[at]);
  const gaps = missing ? ` ${missing} of ${speeds.length} speeds have no result.` : "";
  const said = {
    peak: () => {
      const [low, high] = between.map((place) => speedNumber(speeds[place]));
      return `${here} the peak is ${highest} at ${there}, the highest of the speeds run; ` +
        `if the curve has a single peak, it lies between ${low} and ${high}${THIN}${unit}.`;
    },
    rising: () => `${here} there is no peak: friction is still rising at ${there}, the fastest speed run (${highest}).`,
    falling: () => `${here} there is no peak: friction is highest at ${there}, the slowest speed run (${highest}).`,
    level: () => `${here} no peak can be named: the highest, ${highest} at ${there}, cannot be distinguished from an end of the curve.`,
    few: () => `${here} there are too few speeds to name a peak; the highest is ${highest} at ${there}.`,
  };
  return said[kind]() + gaps;
}

/** What the marks of a chart mean, and how large the errors are. */
function marksWords(curve, { view, place, pressure }, data) {
  const shares = curve.friction.flatMap((row, at) => row.map((friction, speed) => {
    const error = curve.error[at][speed];
    return friction && error !== null ? Math.abs(error / friction) : 0;
  }));
  const largest = Math.max(...shares);
  const rings = curve.peaks.some(({ kind }) => kind === "peak");
  const mark = view === "map" ? "Dots: the highest of the speeds at a pressure, where it is a peak." : "Rings: sampled peaks.";
  const error = largest > 0 ? `${view === "map" ? "Estimated" : "Bands: estimated"} error, at most ${relative(1, largest)}.` : "";
  const sum = place === "total" && view === "curves" ? `Thin dashes: the sum of the scales at ${pressureOf(data.pressures[pressure])}, as the paper has it.` : "";
  const crossed = sum && crosses(data).x.length ? "Crosses: the whole road was not solved at once there." : "";
  const apart = place === "whole" && view === "curves" && severalRoads(data).length
    ? `Circles: each ${data.whole.windows ? "window" : "random road"} at ${pressureOf(data.pressures[pressure])}, filled the one that is shown.` : "";
  const warned = curve.friction.some((row, at) => row.some((friction, speed) => friction !== null && warningsAt(data, place, at, speed).size))
    ? "Triangles: a warning, which is said under the pointer and below the block." : "";
  return [rings ? mark : "", warned, error, sum, crossed, apart].filter(Boolean).join(" ");
}
