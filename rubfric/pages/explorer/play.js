"use strict";
// Play: one speed after the other, with the road passing under the block.

// How long a speed is shown, ms; the views that pass in a second at the slowest speed, and how many times as many at the fastest.
const PLAY = { dwell: 2600, still: 1500, empty: 700, slowest: 0.15, faster: 8 };
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
let playing = null; // the timer of the next speed, whether the road moves, and the canvases on which it does

/** A block that stays where it is while the road passes: paints itself once the road has moved by a number of views. */
function passing(picture, road, view, width) {
  const period = road.period ?? road.wavelength, factor = width / (view.right - view.left);
  const tile = { ...view, left: road.period ? 0 : view.left };
  tile.right = tile.left + period;
  const painted = paintSmall(picture, road, tile, Math.round(period * factor), colours, data.energies);
  const load = loadStrip(picture, tile, painted.width, Math.round(0.13 * width));
  const canvas = element("canvas", { width, height: painted.height + load.height });
  const pen = canvas.getContext("2d");
  const modulo = (value) => ((value % period) + period) % period;
  const upper = picture.x.subarray((picture.rows - 1) * picture.columns);
  const pitch = (upper[picture.columns - 1] - upper[0]) / (picture.columns - 1);
  /** A line across the block, upright before deformation, that the road has reached by this much. */
  const line = (at, moved) => {
    const column = Math.min(picture.columns - 1.001, modulo(at + moved - upper[0]) / pitch), left = Math.floor(column), share = column - left;
    const material = upper[0] + column * pitch;
    pen.beginPath();
    for (let row = 0; row < picture.rows; row += 1) {
      const node = row * picture.columns + left;
      const between = (values) => values[node] + share * (values[node + 1] - values[node]);
      pen.lineTo((at + between(picture.x) - material - view.left) * factor, (view.top - between(picture.y)) * factor);
    }
    pen.stroke();
  };
  const paint = (views) => {
    const moved = views * (view.right - view.left);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    for (let x = -modulo(view.left + moved - tile.left) * factor; x < width; x += period * factor) {
      pen.drawImage(painted, x, 0);
      pen.drawImage(load, x, painted.height);
    }
    pen.strokeStyle = "rgba(255,255,255,0.6)";
    pen.lineWidth = 2;
    for (let order = -1; order <= 10; order += 1) line(view.left + (order / 9) * (view.right - view.left), moved);
  };
  return { canvas, paint };
}

/** The contact pressure along the road, filled. */
function loadStrip(picture, frame, width, height) {
  const strip = element("canvas", { width, height });
  const pen = strip.getContext("2d");
  const factor = width / (frame.right - frame.left), most = Math.max(...picture.pressure, 1e-12);
  pen.beginPath();
  pen.moveTo(0, height);
  picture.touching.forEach((at, place) => pen.lineTo((at - frame.left) * factor, height * (1 - (0.85 * picture.pressure[place]) / most)));
  pen.lineTo(width, height);
  pen.fillStyle = translucent(INKS.touch, 0.3);
  pen.strokeStyle = INKS.touch;
  pen.lineWidth = 2;
  pen.fill();
  pen.stroke();
  return strip;
}

/** What is seen of the whole road while it passes: as much as is magnified, up to its highest crest. */
function passingView(road) {
  if (!road.period) return frame(road);
  const spot = spotFrame(road, chosen.spot), wide = spot.right - spot.left;
  return { ...spot, bottom: road.lowest - 0.08 * wide, top: Math.min(frame(road).top, road.highest + 0.4 * wide) };
}

/** How long a length of the road takes, in words. */
function timeOf(seconds) {
  const [factor, name] = seconds >= 1 ? [1, "s"] : seconds >= 1e-3 ? [1e3, "ms"] : [1e6, "µs"];
  return `${rounded(seconds * factor, 2)}${THIN}${name}`;
}

function viewsPerSecond() { return PLAY.slowest * PLAY.faster ** (chosen.speed / Math.max(1, data.speeds.length - 1)); }

/** The block above a passing road in the place of its picture, and what it says of time. */
function showPassing(place, picture, road) {
  const view = passingView(road), wide = view.right - view.left;
  const moving = passing(picture, road, view, 900);
  playing.moving = [moving];
  byId("passing").replaceChildren(moving.canvas);
  byId("passing").setAttribute("aria-label", `The road passes under the block on ${placeName(place).toLowerCase()} at ${sceneName()}.`);
  return `The road passes under the block, to the left; the white lines stay with the block, the contact pressure is below. ` +
    `${rounded(wide, 2)}${THIN}mm of road take ${timeOf(1 / viewsPerSecond())} here, and ${timeOf(wide / data.speeds[chosen.speed])} at ${speedOf(data.speeds[chosen.speed])}.`;
}

/** Move the roads on, frame by frame. */
function roll(now) {
  if (!playing?.moves) return;
  const seconds = Math.min(0.1, (now - (playing.before ?? now)) / 1000);
  playing.before = now;
  playing.views += seconds * viewsPerSecond();
  for (const { paint } of playing.moving) paint(playing.views);
  window.requestAnimationFrame(roll);
}

/** Wait for as long as this speed is shown, then go on to the next, or end at the fastest. */
function nextSpeed() {
  const shown = sceneAt(chosen.place === "total" ? String(data.scales[0].number) : chosen.place);
  playing.timer = window.setTimeout(() => {
    if (chosen.speed === data.speeds.length - 1) return stopPlaying();
    choose({ speed: chosen.speed + 1 }, true);
    return nextSpeed();
  }, !shown ? PLAY.empty : playing.moves ? PLAY.dwell : PLAY.still);
}

function startPlaying() {
  playing = { moves: !calm.matches, moving: [], views: 0 };
  choose({ speed: chosen.speed === data.speeds.length - 1 ? 0 : chosen.speed }, true);
  nextSpeed();
  window.requestAnimationFrame(roll);
}

function stopPlaying() {
  if (!playing) return;
  window.clearTimeout(playing.timer);
  playing = null;
  choose({});
}

function showPlay() {
  byId("play").replaceChildren(element("span", { "aria-hidden": "true" }, playing ? "❚❚" : "▶"), playing ? " Pause" : " Play all speeds");
  document.body.classList.toggle("playing", playing !== null);
}

function makePlay() {
  byId("play").addEventListener("click", () => (playing ? stopPlaying() : startPlaying()));
  window.addEventListener("keydown", ({ key }) => { if (key === "Escape") stopPlaying(); });
  document.addEventListener("visibilitychange", () => { if (document.hidden) stopPlaying(); });
  calm.addEventListener("change", stopPlaying);
}
