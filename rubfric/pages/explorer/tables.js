"use strict";
// The numbers of what is chosen, as lists and tables.

/** One number of the list, with a remark. */
function entry(term, value, remark = "", wide = false) {
  const shown = element("dd", {}, value, " ", element("small", {}, remark));
  return element("div", wide ? { class: "wide" } : {}, element("dt", {}, term), shown);
}

/** The numbers of one scene, and why its kinematics were chosen. */
function sceneNumbers(scene) {
  const local = scene.largestLocal === null ? "" : `${rounded(scene.largestLocal)} MPa per deformed area`;
  return element("dl", {},
    entry("μ by stress power", rounded(scene.friction, 4)),
    entry("μ by dissipation", rounded(scene.dissipation, 4)),
    entry("μ by contact pressure", rounded(scene.contactRoute, 4)),
    entry("The three differ by at most", percent(scene.closure)),
    entry("In contact", percent(scene.contact), "of the nominal area"),
    entry("Largest contact pressure", pressureOf(Number(scene.largest.toPrecision(3))), local),
    entry("Nominal compression", percent(scene.compression), "on a flat road"),
    entry("Mesh", `${plain(scene.columns)} × ${plain(scene.rows)} cells`),
    entry(`Kinematics: ${scene.finite ? "finite" : "small"} strain`, scene.reason ? sentence(scene.reason) : "", "", true),
  );
}

/** What each scale adds at the chosen speed and pressure, and the sum. */
function totalNumbers(data, chosen) {
  const { pressure, speed } = chosen;
  const total = data.curves.total.friction[pressure][speed];
  const cells = (kind, values) => values.map((value) => element(kind, {}, value));
  const rows = data.scales.map(({ number }, order) => {
    const scene = data.scenes[number][pressure][speed];
    const name = element("td", {}, element("span", { class: "swatch", style: `background:${data.colours.scales[order]}` }), `scale ${number}`);
    if (!scene) return element("tr", {}, name, ...cells("td", ["not run", "", "", ""]));
    const share = total ? percent(scene.friction / total) : "";
    return element("tr", {}, name, ...cells("td", [measured(scene.friction, scene.error), share, percent(scene.contact), rounded(scene.largest)]));
  });
  const sum = measured(total, data.curves.total.error[pressure][speed]);
  rows.push(element("tr", {}, ...cells("td", ["total", sum, "", "", ""])));
  const head = element("tr", {}, ...["", "μ", "share", "contact", "largest MPa"].map((name) => element("th", { scope: "col" }, name)));
  const table = element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows));
  return element("div", { class: "scroll" }, table);
}

/** The warnings of some scenes, each once, with the scales that it is about. */
function warningsOf(scenes) {
  const said = new Map();
  for (const [number, scene] of scenes) {
    for (const words of scene?.warnings ?? []) said.set(words, [...(said.get(words) ?? []), number]);
  }
  const items = [...said].map(([words, scales]) => element("li", {}, scenes.length > 1 ? `Scale ${scales.join(", ")}: ${words}` : words));
  return items.length ? [element("ul", { "aria-label": "Warnings" }, ...items)] : [];
}
