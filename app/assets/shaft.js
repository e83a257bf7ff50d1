// The animation of the shaft: side view and end view, drawn from a part of the response.
window.rotorstab.shaft = (() => {
  const page = window.rotorstab;
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const SECONDS = 2.4; // time in s for one period of the load or the whirl, whichever is faster, at speed 1
  let data = null, canvases = null, index = 0, last = 0, frame = 0, onScreen = false, wanted = !still.matches;

  const decode = (text) => new Float32Array(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  function load(motion) {
    const flat = decode(motion.tip);
    const count = flat.length / 4;
    const rows = [0, 1, 2, 3].map((row) => flat.subarray(row * count, (row + 1) * count));
    const dt = motion.period / motion.samples;
    data = { ...motion, rows, count, dt, level: new Float32Array(count) };
    // factors that remove the growth e^(σt) and scale the largest value to 1
    let top = 0;
    for (let k = 0; k < count; k++) {
      data.level[k] = Math.exp(Math.min(80, motion.growth * dt * (count - 1 - k)));
      top = Math.max(top, data.level[k] * Math.hypot(rows[0][k], rows[1][k]));
    }
    for (let k = 0; k < count; k++) data.level[k] /= top || 1;
    index = Math.min(index, count - 1);
    setUp();
    draw();
    run();
  }

  // -- state between two samples ------------------------------------------------
  function at(position) {
    const k = Math.min(data.count - 2, Math.floor(position));
    const share = position - k;
    const levelled = document.querySelector(".shaft-level").checked;
    const gain = (j) => (levelled ? data.level[j] : 1);
    const [v, w, gamma, beta] = data.rows.map((row) => (1 - share) * row[k] * gain(k) + share * row[k + 1] * gain(k + 1));
    const time = position * data.dt;
    return { v, w, gamma, beta, time, phase: 2 * Math.PI * time / data.period };
  }

  function fit(canvas) {
    const { width, height } = canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const pixels = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    return { pen, width, height };
  }

  function arrow(pen, x, y, angle, length, ink) {
    pen.save();
    pen.translate(x, y);
    pen.rotate(angle);
    pen.strokeStyle = pen.fillStyle = ink;
    pen.lineWidth = 3;
    const head = Math.min(10, Math.abs(length));
    const sign = Math.sign(length) || 1;
    // the arrow points at the tip for compression and away from it for tension
    const [from, to] = sign > 0 ? [length, 0] : [0, -length];
    pen.beginPath(); pen.moveTo(from, 0); pen.lineTo(to + (sign > 0 ? head : -head), 0); pen.stroke();
    pen.beginPath(); pen.moveTo(to, 0); pen.lineTo(to + sign * head, -5); pen.lineTo(to + sign * head, 5); pen.closePath(); pen.fill();
    pen.restore();
  }

  function side(now) {
    const { pen, width, height } = fit(canvases.side);
    const ink = colour("--ink"), soft = colour("--soft"), line = colour("--line"), accent = colour("--accent");
    const root = 26, tip = width - 120, middle = height / 2, reach = 0.3 * height;
    pen.strokeStyle = line; pen.lineWidth = 1; pen.setLineDash([5, 4]);
    pen.beginPath(); pen.moveTo(root, middle); pen.lineTo(width - 8, middle); pen.stroke(); pen.setLineDash([]);
    pen.strokeStyle = soft; pen.lineWidth = 2;
    pen.beginPath(); pen.moveTo(root, middle - 36); pen.lineTo(root, middle + 36); pen.stroke();
    pen.lineWidth = 1;
    for (let y = -36; y < 36; y += 9) { pen.beginPath(); pen.moveTo(root, middle + y); pen.lineTo(root - 9, middle + y + 9); pen.stroke(); }
    const [a, b] = data.shapes;
    pen.strokeStyle = ink; pen.lineWidth = 4; pen.lineJoin = "round"; pen.beginPath();
    a.forEach((one, k) => {
      const x = root + (tip - root) * k / (a.length - 1);
      const y = middle - reach * (one * now.v + b[k] * now.gamma);
      if (k) pen.lineTo(x, y); else pen.moveTo(x, y);
    });
    pen.stroke();
    // slopes have the same scale, so that the disk stays perpendicular to the shaft
    const slope = -Math.atan(now.gamma * reach / (tip - root));
    const y = middle - reach * now.v;
    pen.save(); pen.translate(tip, y); pen.rotate(slope);
    pen.fillStyle = colour("--card"); pen.strokeStyle = ink; pen.lineWidth = 2;
    pen.beginPath(); pen.rect(-6, -30, 12, 60); pen.fill(); pen.stroke();
    pen.restore();
    const load = data.static + data.pulsating * Math.cos(now.phase);
    const largest = Math.max(Math.abs(data.static) + Math.abs(data.pulsating), 1e-9);
    const tilt = data.tangency * slope;
    arrow(pen, tip + 9 * Math.cos(tilt), y + 9 * Math.sin(tilt), tilt, 86 * load / largest, accent);
    pen.fillStyle = soft; pen.font = "12px system-ui, sans-serif";
    const [symbol, unit] = data.load;
    pen.fillText(`load ${symbol} = ${unit ? page.written(load) : load.toFixed(2).replace("-", "−")}${unit}`, 40, 16);
    pen.textAlign = "right"; pen.fillText(`t/T = ${(now.time / data.period).toFixed(2)}`, width - 8, 16); pen.textAlign = "left";
    pen.fillText("plane of V", 40, height - 6);
  }

  function end(now, position) {
    const { pen, width, height } = fit(canvases.end);
    const ink = colour("--ink"), soft = colour("--soft"), line = colour("--line"), accent = colour("--accent");
    const cx = width / 2, cy = height / 2, reach = 0.32 * Math.min(width, height);
    pen.strokeStyle = line; pen.lineWidth = 1;
    for (const [dx, dy] of [[1, 0], [0, 1]]) { pen.beginPath(); pen.moveTo(cx - dx * width / 2, cy - dy * height / 2); pen.lineTo(cx + dx * width / 2, cy + dy * height / 2); pen.stroke(); }
    // the path of the last two periods
    const from = Math.max(0, position - 2 * data.samples);
    pen.strokeStyle = accent; pen.lineWidth = 1.5; pen.beginPath();
    const stride = Math.max(1, Math.floor((position - from) / 800));
    for (let k = Math.ceil(from); k < position; k += stride) {
      const past = at(k);
      pen.lineTo(cx + reach * past.v, cy - reach * past.w);
    }
    pen.lineTo(cx + reach * now.v, cy - reach * now.w);
    pen.stroke();
    const x = cx + reach * now.v, y = cy - reach * now.w, turn = -data.spin * now.time;
    pen.strokeStyle = ink; pen.lineWidth = 2;
    pen.beginPath(); pen.arc(x, y, 24, 0, 2 * Math.PI); pen.stroke();
    pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x + 24 * Math.cos(turn), y + 24 * Math.sin(turn)); pen.stroke();
    pen.fillStyle = ink; pen.beginPath(); pen.arc(x, y, 3.5, 0, 2 * Math.PI); pen.fill();
    pen.fillStyle = soft; pen.font = "12px system-ui, sans-serif";
    pen.fillText("V", width - 14, cy - 5); pen.fillText("W", cx + 5, 13);
  }

  function draw() {
    if (!data || !canvases) return;
    const now = at(index);
    side(now);
    end(now, index);
    if (!frame) describe(now);
  }

  function describe(now) {
    const words = document.querySelector('[data-shaft="words"]');
    const levelled = document.querySelector(".shaft-level").checked && Math.abs(data.growth) * data.dt * data.count > 0.02;
    const scale = data.largest === null ? "" : ` = ${page.written(data.largest, 3)} in the chart above`;
    const follower = data.tangency === 1 ? "The load turns with the tip." : data.tangency === 0 ? "The load keeps its direction." : "The load turns with part of the tip’s slope.";
    words.textContent = levelled
      ? `Not to scale: the motion is drawn as if it did not ${data.growth > 0 ? "grow" : "decay"}; over the time shown it changes by a factor of ${page.written(Math.exp(Math.min(600, data.growth * data.dt * (data.count - 1))), 3)}. ${follower}`
      : `Not to scale: the largest displacement${scale} is drawn as 30 % of the height. ${follower}`;
    canvases.side.setAttribute("aria-label", `Side view of the shaft at t/T = ${(now.time / data.period).toFixed(2)}: tip at ${now.v.toFixed(2)} of the largest displacement. Space plays and pauses, arrow keys step.`);
    canvases.end.setAttribute("aria-label", `End view: disk centre at V ${now.v.toFixed(2)}, W ${now.w.toFixed(2)} of the largest displacement.`);
  }

  // -- time ----------------------------------------------------------------------
  const seen = () => onScreen && !document.hidden && data && canvases.side.offsetParent !== null;

  function tick(stamp) {
    if (!wanted || !seen()) { frame = 0; return; }
    const passed = Math.min(0.1, (stamp - last) / 1000);
    last = stamp;
    const speed = Number(document.querySelector(".shaft-speed").value);
    index += passed * speed * (2 * Math.PI / data.fastest / SECONDS) / data.dt;
    if (index >= data.count - 1) index = 0;
    draw();
    frame = requestAnimationFrame(tick);
  }

  function run() {
    if (frame || !wanted || !canvases || !seen()) return;
    last = performance.now();
    frame = requestAnimationFrame(tick);
  }

  function play(on) {
    wanted = on;
    const button = document.querySelector(".shaft-play");
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
    if (on) run(); else { cancelAnimationFrame(frame); frame = 0; draw(); }
  }

  function step(by) {
    play(false);
    const stride = Math.max(1, Math.round(2 * Math.PI / data.fastest / data.dt / 24));
    index = Math.round(index) + by * stride;
    index = ((index % data.count) + data.count) % data.count;
    draw();
  }

  function setUp() {
    if (canvases) return;
    canvases = { side: document.querySelector(".shaft-side"), end: document.querySelector(".shaft-end") };
    document.querySelector(".shaft-play").addEventListener("click", () => play(!wanted));
    document.querySelector(".shaft-step").addEventListener("click", () => step(1));
    document.querySelector(".shaft-back").addEventListener("click", () => step(-1));
    document.querySelector(".shaft-level").addEventListener("change", draw);
    canvases.side.addEventListener("keydown", (event) => {
      if (event.key === " ") { event.preventDefault(); play(!wanted); }
      if (event.key === "ArrowRight") { event.preventDefault(); step(1); }
      if (event.key === "ArrowLeft") { event.preventDefault(); step(-1); }
    });
    document.addEventListener("visibilitychange", run);
    new IntersectionObserver((entries) => { onScreen = entries.some((entry) => entry.isIntersecting); run(); }).observe(canvases.side);
    new ResizeObserver(() => draw()).observe(canvases.side);
    new MutationObserver(() => draw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    play(wanted);
  }

  return {
    load,
    stop() { cancelAnimationFrame(frame); frame = 0; },
    get state() { return data && { index, count: data.count, playing: Boolean(frame), rows: data.rows }; },
  };
})();
