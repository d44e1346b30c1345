"use strict";
// The temperatures of a campaign that has several: each has a payload of its own, with which the page is loaded anew.

const held = JSON.parse(byId("payload").textContent);
const temperatures = held.temperatures ?? [];
const warmth = Math.max(0, temperatures.indexOf(temperatureSaid() ?? held.shown));

/** The temperature that the address names, if there is such a one. */
function temperatureSaid() {
  const said = new URLSearchParams(window.location.hash.slice(1)).get("temperature");
  return said === null ? undefined : temperatures.find((one) => Math.abs(one - Number(said)) <= 1e-9 * Math.abs(one));
}

function addressed(warm) { return warm === undefined ? "" : `&temperature=${warm}`; }

function rubberAt() { return temperatures.length ? `Rubber at ${plain(temperatures[warmth])}${THIN}°C. ` : ""; }

/** Show what is chosen at another temperature. */
function reload(warm) {
  window.history.replaceState(null, "", address(warm));
  window.location.reload();
}

/** Load the page anew where the address names another temperature; return whether it does. */
function otherTemperature() {
  const said = temperatureSaid();
  const other = said !== undefined && said !== temperatures[warmth];
  if (other) reload(said);
  return other;
}

function makeTemperatures() {
  if (temperatures.length < 2) return;
  const row = element("fieldset", { id: "temperatures", class: "segments" }, element("legend", {}, "Temperature (°C)"));
  row.append(...temperatures.map((one, order) => option("temperature", order, plain(one))));
  byId("choices").append(row);
  row.querySelector(`[value="${warmth}"]`).checked = true;
  row.addEventListener("change", (event) => { event.stopPropagation(); reload(temperatures[event.target.value]); });
}
