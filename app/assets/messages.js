// Messages to the server and their answers, which arrive in the order of the messages. New values are sent only
// after the browser has painted the answer to the last ones, and then only the newest, so no queue can build up.
window.rotorstab.messages = (() => {
  const page = window.rotorstab;
  const REST = 80; // ms without a change after which the page requests the full picture
  const IDLE = 5000; // ms without an answer after which a visible page asks whether the server is there
  const STORE = "rotorstab-unanswered";
  const REPLACING = ["preset", "reset", "use_shaft", "rotor_file"]; // messages that set many values at once
  const STATEFUL = ["change", ...REPLACING, "pin", "unpin"];
  const here = () => location.pathname + location.search;

  const unanswered = new Map(); // by sequence number: the message and the time when it was sent
  let pending = {}; // values that were set and not sent
  let earlier = stored(); // messages from before a reload that were not answered
  let deliver = null, present = null; // functions that send a message and show an answer in the sidebar
  let sequence = 0, inflight = 0, releasing = false;
  let resting = 0, due = false;
  let heard = 0; // time of the last answer

  const moving = () => inflight !== 0 || Object.keys(pending).length > 0;
  const stateful = () => [...unanswered.values()].map(({ message }) => message).filter(({ type }) => STATEFUL.includes(type));

  function send(message) {
    const numbered = { ...message, seq: ++sequence };
    unanswered.set(sequence, { message: numbered, at: Date.now() });
    if (!page.connection.closed) deliver(numbered);
    return sequence;
  }

  // -- only the newest values are sent ------------------------------------------------------------
  function flush() {
    if (inflight || !Object.keys(pending).length) return;
    const values = pending;
    pending = {};
    inflight = send({ type: "change", values });
  }

  function freed() {
    releasing = false;
    inflight = 0;
    flush();
    if (due) settle();
  }

  function settle() {
    // if a message is still being answered, request the full picture right after its answer
    due = moving();
    if (!due) send(page.restMessage());
  }

  function change(name, value) {
    // a number box reports the same value for Enter and for its change event
    if ((name in pending ? pending[name] : stateful().at(-1)?.values?.[name]) === value) return;
    pending[name] = value;
    queueMicrotask(flush); // values that one event sets are sent together, for example both coordinates of the marker
    clearTimeout(resting);
    due = false;
    resting = setTimeout(settle, REST);
  }

  // values that were set before a button was pressed are sent before its message
  function press(message) {
    const values = pending;
    pending = {};
    if (Object.keys(values).length) send({ type: "change", values });
    send(message);
  }

  // -- answers -----------------------------------------------------------------
  // values that were set after the answered message, which the answer must not undo
  function ahead() {
    return Object.assign({}, ...stateful().map(({ values }) => values), pending);
  }

  function take(data) {
    heard = Date.now();
    let replaced = false;
    if (data.seq) {
      for (const [number, { message }] of unanswered) if (number <= data.seq) {
        unanswered.delete(number);
        replaced ||= REPLACING.includes(message.type);
      }
      if (inflight && !unanswered.has(inflight) && !releasing) {
        releasing = true;
        requestAnimationFrame(freed);
      }
      page.connection.look();
    // a full picture that the server sends on its own is outdated if something has moved since
    } else if (data.values && (moving() || stateful().length)) return;
    const answer = data.values ? { ...data, replaced, values: { ...data.values, ...ahead() } } : data;
    present(answer);
    page.answer(answer);
    if (data.values && !page.connection.greeted) {
      page.connection.greet();
      restore();
    }
  }

  // -- after a reload the page sends again what was not answered; its address holds everything else -------
  function keep() {
    const messages = [...earlier, ...stateful()];
    if (Object.keys(pending).length) messages.push({ type: "change", values: pending });
    try { sessionStorage.setItem(STORE, JSON.stringify({ here: here(), messages })); } catch { /* no storage */ }
  }

  function stored() {
    try {
      const found = JSON.parse(sessionStorage.getItem(STORE));
      return found && found.here === here() && Array.isArray(found.messages) ? found.messages : [];
    } catch { return []; }
  }

  function restore() {
    try { sessionStorage.removeItem(STORE); } catch { /* no storage */ }
    for (const message of earlier) send(message);
    if (earlier.length) send({ type: "settle" });
    earlier = [];
  }

  // -- whether the server is there: asked only while no other message waits ----------------
  function ask() {
    if (!page.connection.greeted || page.connection.closed || unanswered.size) return;
    if (document.visibilityState === "visible") send({ type: "ping" });
  }
  document.addEventListener("visibilitychange", ask);
  addEventListener("online", ask);
  setInterval(() => { if (Date.now() - heard > IDLE) ask(); }, 1000);

  return {
    take, keep, change,
    attach(how, who) {
      deliver = how;
      present = who;
      // the buttons of the page send their messages through the component of the sidebar
      page.send = press;
      page.change = change;
      send({ type: "hello" });
    },
    // time in ms that the oldest unanswered message has waited
    waited() {
      const [oldest] = unanswered.values();
      return oldest ? Date.now() - oldest.at : 0;
    },
    // after the device slept: no answer could arrive meanwhile
    renew() {
      for (const one of unanswered.values()) one.at = Date.now();
      ask();
    },
  };
})();
