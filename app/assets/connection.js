// The connection: whether the server answers, the message that the page shows if it does not, and how the
// page reconnects. This script runs before every other one, so that it also notices files that do not load.
window.rotorstab = (() => {
  const page = {};
  const root = document.documentElement;
  const Socket = window.WebSocket;
  const STORE = "rotorstab-returns"; // how often this tab came back without an answer
  // Times in ms
  const SLOW = 12000; // longest time between two steps of a page that opens
  const PART = 3000; // the same if a file did not load
  const ANSWER = 6000; // longest time until the server answers an open page
  const DEAF = 15000; // time without an answer after which a page replaces its socket, if the server answers other requests
  const STUCK = 45000; // the same for a page that opens: a busy server needs long to build it
  const REPLY = 10000; // longest time of one attempt
  const OLD = 240000; // a page of this age may have a token that has expired
  const FIRST = 800, LONGEST = 15000, LONGEST_PAUSE = 60000; // pauses between attempts

  let socket = null; // Bokeh's socket: its address and its state
  let missing = ""; // address of a file that did not load
  let greeted = false; // the server has answered the page
  let reached = true; // the server answered the last attempt
  let shown = ""; // kind of trouble that is shown
  let mending = false;
  const began = Date.now();
  let step = began; // time of the last step of opening the page
  let looked = began;

  const forward = () => { step = Date.now(); };

  // -- observing: files and the socket ------------------------------
  document.addEventListener("error", ({ target }) => { if (target.tagName === "SCRIPT" && target.src) missing = missing || target.src; }, true);
  document.addEventListener("load", forward, true);

  if (Socket) window.WebSocket = class extends Socket {
    constructor(url, protocols) {
      super(url, protocols);
      if (!Array.isArray(protocols) || protocols[0] !== "bokeh") return;
      const own = { url, protocols, opened: false, heard: false, closed: false };
      socket = own;
      forward();
      this.addEventListener("open", () => { own.opened = true; forward(); });
      this.addEventListener("message", () => { own.heard = true; forward(); });
      // a page that the user leaves closes its socket too, but does not exist any more after this delay
      this.addEventListener("close", () => { own.closed = true; setTimeout(look, 300); });
    }
  };

  function trouble() {
    const quiet = Date.now() - step;
    if (missing && !greeted && quiet > PART) return "file";
    if (socket && socket.closed) return socket.heard ? "lost" : "refused";
    if (greeted) return page.messages.waited() > ANSWER ? "silent" : "";
    if (quiet < SLOW) return "";
    return !socket ? "loading" : socket.opened ? "mute" : "hangs";
  }

  // -- messages to the user --------------------------------------------------------------
  const RETURNS = "This page returns by itself, with your settings, as soon as the server answers.";
  const TRIES = "This page tries again by itself and draws as soon as it gets through. If this lasts, try another network, or tell whoever runs the server.";
  const WAY = "a proxy, a VPN or a security program on the way";
  const WORDS = {
    offline: `This device has no network. ${RETURNS}`,
    unreachable: `The server does not answer. ${RETURNS}`,
    lost: `The connection to the server was lost. ${RETURNS}`,
    silent: "The server does not answer at the moment. What you set here is kept, and is sent as soon as the server answers.",
    file: `A part of this page could not be loaded: %. ${TRIES}`,
    loading: `A part of this page has not arrived yet: the network is slow, or ${WAY} delays it. ${TRIES}`,
    refused: `The page is here, but its live connection to the server (a WebSocket) is refused. Either ${WAY} does not let it through, or the server does not accept this address. ${TRIES}`,
    hangs: `The page is here, but its live connection to the server (a WebSocket) does not open: ${WAY} may block it. ${TRIES}`,
    mute: `The live connection to the server (a WebSocket) is open, but no data arrives: the server is busy, or ${WAY} blocks the data. ${TRIES}`,
  };

  // the message also needs a place when a slow file delays the rest of the page
  function place() {
    const early = document.querySelector(".lost-early");
    const own = document.querySelector(".lost:not(.lost-early)");
    if (own && early) early.remove();
    if (own || early) return own || early;
    const made = document.createElement("p");
    made.className = "lost lost-early";
    made.setAttribute("role", "alert");
    made.style.cssText = "position: fixed; inset: 16px 16px auto; margin: 0; padding: 10px 14px; border-radius: 10px;"
      + " background: #fff4d6; color: #5f4300; font: 15px/1.45 system-ui, sans-serif;";
    root.append(made);
    return made;
  }

  function show(found) {
    shown = found;
    if (found) root.dataset.trouble = found; else delete root.dataset.trouble;
    if (!found && !document.querySelector(".lost")) return;
    const words = !found ? "" : navigator.onLine === false ? WORDS.offline
      : !reached && found !== "silent" ? WORDS.unreachable
      : WORDS[found].replace("%", missing.split("?")[0].split("/").pop());
    const lost = place();
    lost.hidden = !found;
    if (lost.textContent !== words) lost.textContent = words;
  }

  function look() {
    const now = Date.now();
    if (now - looked > 5000) { // the device slept and could not receive anything
      forward();
      if (page.messages) page.messages.renew();
    }
    looked = now;
    if (page.left) return;
    const found = trouble();
    if (found && !shown && page.address) page.address(); // the address keeps the state of the last answer, `keep` what came after it
    if (found || shown) show(found);
    if (found && !mending) mend();
  }

  // -- reconnecting: the page reloads when a new attempt succeeds at what failed -----
  function returns(count) {
    try {
      if (count !== undefined) sessionStorage.setItem(STORE, count);
      return Number(sessionStorage.getItem(STORE)) || 0;
    } catch { return 1; }
  }

  async function replies() {
    try {
      // HEAD costs the server little, because it builds no page for it
      const answer = await fetch(location.pathname, { method: "HEAD", cache: "no-store", redirect: "manual", signal: AbortSignal.timeout(REPLY) });
      return answer.type === "opaqueredirect" || (answer.status < 500 && answer.status !== 429);
    } catch { return false; }
  }

  async function loads(address) {
    try {
      const answer = await fetch(address, { cache: "no-store", signal: AbortSignal.timeout(6 * REPLY) });
      await answer.arrayBuffer();
      return answer.ok;
    } catch { return false; }
  }

  function connects() {
    return new Promise((done) => {
      const trial = new Socket(socket.url, socket.protocols);
      const end = (good) => {
        clearTimeout(timer);
        trial.onclose = null;
        trial.close();
        done(good);
      };
      const timer = setTimeout(end, REPLY, false);
      trial.onmessage = () => end(true);
      trial.onclose = () => end(false);
    });
  }

  // the browser may send a request on an old connection that is broken too; a new socket has a new connection
  async function reaches(found) {
    const ways = found === "silent" ? [replies(), connects()] : [replies()];
    try {
      await Promise.any(ways.map(async (way) => { if (!await way) throw new Error("no answer"); }));
      return true;
    } catch { return false; }
  }

  function ready(found) {
    const old = Date.now() - began > OLD;
    switch (found) {
      case "file": return loads(missing);
      case "loading": return document.readyState !== "loading" || loads([...document.scripts].pop().src);
      // a new page has a new token, which helps if the server refused the old one
      case "refused": return returns() === 0 || old || connects();
      case "hangs": return old || connects();
      case "mute": return socket.heard ? Date.now() - step > STUCK : connects();
      case "silent": return page.messages.waited() > DEAF;
      default: return true;
    }
  }

  async function mend() {
    mending = true;
    // after each reload without success the page waits longer
    let wait = Math.max(FIRST, Math.min(LONGEST_PAUSE, 1000 * (2 ** returns() - 1)));
    while (trouble()) {
      await new Promise((done) => setTimeout(done, wait * (0.7 + 0.6 * Math.random())));
      reached = await reaches(trouble());
      look();
      if (page.left) break;
      if (reached && trouble() && await ready(trouble()) && trouble()) return reload();
      wait = Math.max(wait, Math.min(LONGEST, wait * 1.6));
    }
    mending = false;
    reached = true;
    look();
  }

  function reload() {
    returns(returns() + 1);
    if (page.messages) page.messages.keep();
    page.left = true;
    location.reload();
  }

  addEventListener("pagehide", () => {
    if (shown && page.messages) page.messages.keep();
    page.left = true;
  });
  addEventListener("pageshow", ({ persisted }) => { if (persisted) page.left = false; });
  addEventListener("online", look);
  addEventListener("offline", look);
  setInterval(look, 1000);

  page.connection = {
    get closed() { return Boolean(socket && socket.closed); },
    get greeted() { return greeted; },
    greet() {
      greeted = true;
      returns(0);
      look();
    },
    look,
  };
  return page;
})();
