// The clock of the animated motion: it moves through the response that the server sent once, and sends no message.
window.rotorstab.motion = (() => {
  const page = window.rotorstab;
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const SECONDS = 1; // time in s for one period of the load or of the whirl, whichever is faster, at speed 1
  const HOLD = 1.5; // time in s for which the motion stands still where it has left the picture
  const LEVEL = 0.6; // share of the picture that the motion takes while its growth is taken out
  const followers = []; // functions that draw a state of the motion
  let data = null, index = 0, held = 0;
  let last = 0, frame = 0, frames = 0, onScreen = false, wanted = !still.matches;
  let speed = 1, levelled = false;

  const decode = (text) => new Float32Array(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);

  // the factors that take the growth e^(σt) out of the motion
  function levels(rows, growth, dt) {
    const count = rows[0].length;
    const level = Float64Array.from({ length: count }, (_, k) => Math.exp(-growth * dt * k));
    let largest = 0;
    for (let k = 0; k < count; k++) largest = Math.max(largest, level[k] * Math.hypot(rows[0][k], rows[1][k]));
    return level.map((one) => one * LEVEL / (largest || 1));
  }

  function load(motion) {
    const periods = data && index / data.samples;
    data = null;
    if (motion) {
      const flat = decode(motion.tip);
      const count = flat.length / 4;
      const rows = [0, 1, 2, 3].map((row) => flat.subarray(row * count, (row + 1) * count));
      const dt = motion.period / motion.samples;
      data = { ...motion, rows, count, dt, level: levels(rows, motion.growth, dt) };
      // another motion goes on at the same time, and begins again where it has left the picture by then
      index = (periods || 0) * motion.samples;
      if (index > count - 1) { index = held && motion.cut ? count - 1 : 0; }
      if (index < count - 1) held = 0;
    }
    draw();
    run();
  }

  // the state between two samples: V, W, Γ and B of the tip, relative to the edge of the picture
  function at(position) {
    const k = Math.max(0, Math.min(data.count - 2, Math.floor(position)));
    const share = position - k;
    const gain = (j) => (levelled ? data.level[j] : 1);
    const [v, w, gamma, beta] = data.rows.map((row) => (1 - share) * row[k] * gain(k) + share * row[k + 1] * gain(k + 1));
    const periods = position / data.samples;
    return { v, w, gamma, beta, periods, time: position * data.dt, beyond: held > 0 && !levelled };
  }

  function draw() {
    const now = data && at(index);
    for (const follow of followers) follow(now, data);
  }

  const seen = () => onScreen && !document.hidden;

  function tick(stamp) {
    frame = 0;
    if (!wanted || !data || !seen()) return;
    const passed = Math.max(0, Math.min(0.1, (stamp - last) / 1000));
    last = stamp;
    advance(passed);
    frames += 1;
    draw();
    frame = requestAnimationFrame(tick);
  }

  function advance(passed) {
    if (held > 0) {
      held -= passed;
      if (held <= 0) { held = 0; index = 0; }
      return;
    }
    index += passed * speed * (2 * Math.PI / data.fastest / SECONDS) / data.dt;
    if (index < data.count - 1) return;
    index = data.cut ? data.count - 1 : 0;
    held = data.cut ? HOLD : 0;
  }

  function run() {
    if (frame || !wanted || !data || !seen()) return;
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

  function knock() {
    index = 0;
    held = 0;
    play(true);
  }

  function step(by) {
    if (!data) return;
    play(false);
    held = 0;
    const stride = 2 * Math.PI / data.fastest / data.dt / 24;
    index = Math.max(0, Math.min(data.count - 1, index + by * stride));
    draw();
  }

  document.addEventListener("DOMContentLoaded", () => {
    const one = (selector) => document.querySelector(selector);
    one(".shaft-play").addEventListener("click", () => play(!wanted));
    one(".shaft-knock").addEventListener("click", knock);
    one(".shaft-speed").addEventListener("change", (event) => { speed = Number(event.target.value); });
    one(".shaft-level").addEventListener("change", (event) => { levelled = event.target.checked; draw(); });
    const side = one(".shaft-side");
    side.addEventListener("keydown", (event) => {
      const act = { " ": () => play(!wanted), ArrowRight: () => step(1), ArrowLeft: () => step(-1), Home: knock }[event.key];
      if (act) { event.preventDefault(); act(); }
    });
    document.addEventListener("visibilitychange", run);
    new IntersectionObserver((entries) => { onScreen = entries.at(-1).isIntersecting; run(); }).observe(side);
    play(wanted);
  }, { once: true });

  return {
    load, draw,
    follow(act) { followers.push(act); },
    get state() {
      if (!data) return null;
      const { v, w, beyond } = at(index);
      return { index, count: data.count, cut: data.cut, playing: Boolean(frame), frames, beyond, size: Math.hypot(v, w), rows: data.rows };
    },
    at: (position) => at(position),
  };
})();
