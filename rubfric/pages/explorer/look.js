"use strict";
// How charts and pictures look on light and on dark ground, and the colours of pressures and scales there.

// Drag to zoom only where a finger does not have to scroll the page.
const ZOOMS = window.matchMedia("(hover: hover) and (pointer: fine)").matches;
const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", sans-serif';
const CONFIG = { displayModeBar: false, responsive: false, scrollZoom: false, showTips: false, doubleClick: "reset" };
const SYMBOLS = ["circle", "square-open", "triangle-up", "diamond-open", "triangle-down", "cross-open", "x", "pentagon-open"];
const DASHES = ["solid", "8px,3px", "4px,2px", "8px,2px,2px,2px", "2px,2px"];
const LIGHT = {
  ink: "#1d2129", quiet: "#5c6370", rule: "#b6b4ae", grid: "#eeece7", paper: "#ffffff",
  road: "#ecebe7", roadLine: "#8b8a86", hatch: "#c9c7c1", touch: "#e8601c", warning: "#a15c00",
};
const DARK = {
  ink: "#e9eaee", quiet: "#a9afbb", rule: "#6b7080", grid: "#2d313b", paper: "#1a1d24",
  road: "#353943", roadLine: "#8b8f9b", hatch: "#555a66", touch: "#ff7f3f", warning: "#f2b84b",
};
const darkness = window.matchMedia("(prefers-color-scheme: dark)");
let INKS, LOOK, AXIS;

/** Take the colours of light or of dark ground. */
function dress(dark) {
  INKS = dark ? DARK : LIGHT;
  LOOK = {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: FONT, size: 12, color: INKS.ink },
    hoverlabel: { bgcolor: INKS.paper, bordercolor: INKS.roadLine, font: { family: FONT, size: 13, color: INKS.ink }, align: "left" },
  };
  AXIS = { zeroline: false, gridcolor: INKS.grid, linecolor: INKS.rule, tickcolor: INKS.rule, ticks: "outside", ticklen: 4, fixedrange: true };
}
dress(darkness.matches);

function parts(colour) { return [1, 3, 5].map((from) => parseInt(colour.slice(from, from + 2), 16)); }

function translucent(colour, opacity) { return `rgba(${parts(colour).join(",")},${opacity})`; }

/** The relative luminance of a colour, as WCAG defines it. */
function luminance(colour) {
  const [red, green, blue] = parts(colour).map((part) => (part <= 10 ? part / 3294.6 : ((part / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/** A colour that is seen on dark ground: lighter until its contrast is 3.5. */
function visible(colour) {
  let seen = colour;
  while (INKS === DARK && (luminance(seen) + 0.05) / (luminance(DARK.paper) + 0.05) < 3.5) {
    seen = `#${parts(seen).map((part) => Math.ceil(part + 0.08 * (255 - part)).toString(16).padStart(2, "0")).join("")}`;
  }
  return seen;
}

function pressureColour(data, order) { return visible(data.colours.pressures[order]); }
function scaleColour(data, order) { return visible(data.colours.scales[order]); }
function titled(text) { return { text, standoff: 8, font: { size: 13 } }; }
