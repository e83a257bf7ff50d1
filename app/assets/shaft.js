// Pictures of the whirling shaft: side view and end view at one fixed scale, drawn at each state of the motion.
window.rotorstab.shaft = (() => {
  const page = window.rotorstab;
  const MARGIN = 12; // px between the edge up to which the motion is drawn and the border
  const DISK = 22; // px
  let canvases = null, inks = {}, said = "";

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  function readInks() {
    for (const name of ["ink", "soft", "line", "accent", "card", "error"]) inks[name] = colour(`--${name}`);
  }

  // a pen whose unit is a CSS pixel, on an empty canvas
  function fit(canvas) {
    const { clientWidth: width, clientHeight: height } = canvas;
    const ratio = window.devicePixelRatio || 1;
    const pixels = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "12px system-ui, sans-serif";
    return { pen, width, height };
  }

  function line(pen, points, ink, width, dash = []) {
    pen.strokeStyle = ink;
    pen.lineWidth = width;
    pen.lineJoin = "round";
    pen.setLineDash(dash);
    pen.beginPath();
    for (const [x, y] of points) pen.lineTo(x, y);
    pen.stroke();
    pen.setLineDash([]);
  }

  // an arrow along x that points at its origin where the length is positive, and away from it where it is not
  function arrow(pen, x, y, angle, length, ink) {
    pen.save();
    pen.translate(x, y);
    pen.rotate(angle);
    const head = Math.min(9, Math.abs(length));
    const sign = Math.sign(length) || 1;
    const [from, to] = sign > 0 ? [length, 0] : [0, -length];
    line(pen, [[from, 0], [to + sign * head, 0]], ink, 3);
    pen.fillStyle = ink;
    pen.beginPath(); pen.moveTo(to, 0); pen.lineTo(to + sign * head, -5); pen.lineTo(to + sign * head, 5); pen.fill();
    pen.restore();
  }

  function clamp(pen, x, middle) {
    line(pen, [[x, middle - 30], [x, middle + 30]], inks.soft, 2);
    for (let y = -30; y < 30; y += 9) line(pen, [[x, middle + y], [x - 8, middle + y + 8]], inks.soft, 1);
  }

  // the loads in the words of the page; the arrow has the length 1 at the largest magnitude
  function loadOf(now, data) {
    const load = data.static + data.pulsating * Math.cos(2 * Math.PI * now.periods);
    const largest = Math.max(Math.abs(data.static) + Math.abs(data.pulsating), 1e-9);
    const [symbol, unit] = data.load;
    const words = `load ${symbol} = ${unit ? page.written(load, 3) : load.toFixed(2).replace("-", "−")}${unit}`;
    return { words, share: load / largest };
  }

  function side(now, data, reach) {
    const { pen, width, height } = fit(canvases.side);
    const root = 22, tip = width - 74, middle = height / 2;
    line(pen, [[root, middle], [width - 6, middle]], inks.line, 1, [5, 4]);
    clamp(pen, root, middle);
    const [a, b] = data.shapes;
    const shape = a.map((one, k) => [root + (tip - root) * k / (a.length - 1), middle - reach * (one * now.v + b[k] * now.gamma)]);
    line(pen, shape, inks.ink, 4);
    // slopes have the same scale as displacements, so that the disk stays perpendicular to the shaft
    const slope = -Math.atan(now.gamma * reach / (tip - root));
    const y = middle - reach * now.v;
    pen.save(); pen.translate(tip, y); pen.rotate(slope);
    pen.fillStyle = inks.card; pen.strokeStyle = inks.ink; pen.lineWidth = 2;
    pen.beginPath(); pen.rect(-5, -DISK, 10, 2 * DISK); pen.fill(); pen.stroke();
    pen.restore();
    const { words, share } = loadOf(now, data);
    const tilt = data.tangency * slope;
    arrow(pen, tip + 8 * Math.cos(tilt), y + 8 * Math.sin(tilt), tilt, 54 * share, inks.accent);
    pen.fillStyle = inks.soft;
    pen.fillText(words, 34, 14);
    pen.fillText("side view: V", 34, height - 6);
    pen.textAlign = "right";
    pen.fillText(`t/T = ${now.periods.toFixed(1)}`, width - 6, height - 6);
    pen.textAlign = "left";
  }

  function end(now, data, reach) {
    const { pen, width, height } = fit(canvases.end);
    const cx = width / 2, cy = height / 2;
    line(pen, [[0, cy], [width, cy]], inks.line, 1);
    line(pen, [[cx, 0], [cx, height]], inks.line, 1);
    pen.strokeStyle = inks.soft; pen.lineWidth = 1; pen.setLineDash([3, 4]);
    pen.beginPath(); pen.arc(cx, cy, reach, 0, 2 * Math.PI); pen.stroke(); pen.setLineDash([]);
    // the path of the last two periods of the load
    const position = now.periods * data.samples;
    const from = Math.max(0, Math.ceil(position - 2 * data.samples));
    const stride = Math.max(1, Math.floor((position - from) / 300));
    const path = [];
    for (let k = from; k < position; k += stride) path.push(page.motion.at(k));
    line(pen, [...path, now].map(({ v, w }) => [cx + reach * v, cy - reach * w]), inks.accent, 1.5);
    const x = cx + reach * now.v, y = cy - reach * now.w, turn = -data.spin * now.time;
    pen.strokeStyle = inks.ink; pen.lineWidth = 2;
    pen.beginPath(); pen.arc(x, y, DISK, 0, 2 * Math.PI); pen.stroke();
    line(pen, [[x, y], [x + DISK * Math.cos(turn), y + DISK * Math.sin(turn)]], inks.ink, 2);
    pen.fillStyle = inks.ink; pen.beginPath(); pen.arc(x, y, 3, 0, 2 * Math.PI); pen.fill();
    pen.fillStyle = inks.soft;
    pen.fillText("V", width - 12, cy - 5);
    pen.fillText("W", cx + 5, 12);
    pen.fillText("end view", 4, height - 6);
  }

  function draw(now, data) {
    if (!canvases) return;
    document.querySelector(".shaft-beyond").hidden = !now?.beyond;
    if (!now) {
      for (const canvas of Object.values(canvases)) fit(canvas);
      return;
    }
    const reach = Math.min(...Object.values(canvases).map((one) => one.clientHeight / 2), canvases.end.clientWidth / 2) - MARGIN;
    if (reach <= 0) return; // the panel is not in view
    side(now, data, reach);
    end(now, data, reach);
    if (!page.motion.state?.playing) describe(now);
  }

  // for screen readers, while the motion stands still
  function describe(now) {
    const place = (value) => value.toFixed(2).replace("-", "−");
    const words = `Shaft at ${now.periods.toFixed(1)} periods of the load: tip at V ${place(now.v)}, W ${place(now.w)} of the way to the edge of the picture. Space plays and pauses, arrow keys step, Home knocks again.`;
    if (words !== said) canvases.side.setAttribute("aria-label", words);
    said = words;
  }

  document.addEventListener("DOMContentLoaded", () => {
    canvases = { side: document.querySelector(".shaft-side"), end: document.querySelector(".shaft-end") };
    readInks();
    page.motion.follow(draw);
    new MutationObserver(() => { readInks(); page.motion.draw(); }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    const resized = new ResizeObserver(() => page.motion.draw());
    for (const canvas of Object.values(canvases)) resized.observe(canvas);
  }, { once: true });

  return {};
})();
