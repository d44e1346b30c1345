"use strict";
// The numbers of what is chosen, as lists and tables.

/** One number of the list, with a remark. */
function entry(term, value, remark = "", wide = false) {
  const shown = element("dd", {}, value, " ", element("small", {}, remark));
  return element("div", wide ? { class: "wide" } : {}, element("dt", {}, term), shown);
}

/** The numbers of one scene, and why its kinematics were chosen. */
function sceneNumbers(scene) {
  return element("dl", {},
    entry("μ by stress power", rounded(scene.friction, 4)),
    entry("μ by dissipation", rounded(scene.dissipation, 4)),
    entry("μ by contact pressure", rounded(scene.contactRoute, 4)),
    entry("The three differ by at most", percent(scene.closure)),
    entry("In contact", percent(scene.contact), "of the nominal area"),
    entry("Largest contact pressure per undeformed area", pressureOf(Number(scene.largest.toPrecision(3)))),
    entry("Largest contact pressure per deformed area", scene.largestLocal === null ? "unknown" : pressureOf(Number(scene.largestLocal.toPrecision(3)))),
    entry("Nominal compression", percent(scene.compression), "on a flat road"),
    entry("Mesh", `${plain(scene.columns)} × ${plain(scene.rows)} cells`),
    entry(`Kinematics: ${scene.finite ? "finite" : "small"} strain`, scene.reason ? sentence(scene.reason) : "", "", true),
  );
}

/** What each scale adds at the chosen speed and pressure, the total by every way, and the one that counts. */
function totalNumbers(data, chosen) {
  const { pressure, speed } = chosen;
  const { ways, way } = data.totals;
  const sum = ways.sum.friction[pressure][speed];
  const row = (name, scene, friction, error, share = "") => {
    const about = scene ? [percent(scene.contact), rounded(scene.largest)] : ["", ""];
    return element("tr", {}, name, ...[measured(friction, error), share, ...about].map((value) => element("td", {}, value)));
  };
  const rows = data.scales.map(({ number }, order) => {
    const scene = data.scenes[number][pressure][speed];
    const name = element("td", {}, element("span", { class: "swatch", style: `background:${scaleColour(data, order)}` }), `scale ${number}`);
    return row(name, scene, scene?.friction ?? null, scene?.error ?? null, scene && sum ? percent(scene.friction / sum) : "");
  });
  for (const name of ["sum", "corrected", "cascade", "persson", "direct"]) {
    const [friction, error] = [ways[name].friction[pressure][speed], ways[name].error[pressure][speed]];
    const cells = row(element("td", {}, WAY_NAMES[name]), name === "direct" ? data.scenes.whole?.[pressure][speed] : null, friction, error);
    if (name === "direct" && friction === null) cells.children[1].textContent = whyNot(data, pressure, speed);
    rows.push(cells);
  }
  const { friction, error } = data.curves.total;
  const taken = way[pressure][speed];
  rows.push(row(element("td", {}, taken ? `total: ${WAY_NAMES[taken]}` : "total"), null, friction[pressure][speed], error[pressure][speed]));
  const head = element("tr", {}, ...["", "μ", "share of sum", "contact", "largest contact pressure per undeformed area (MPa)"].map((name) => element("th", { scope: "col" }, name)));
  const table = element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows));
  return element("div", { class: "scroll" }, table);
}
