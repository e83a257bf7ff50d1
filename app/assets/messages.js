// Messages to the server and their answers, which come in the order of the messages. Latest wins:
// new values leave only after the frame that answers the last ones was painted, so nothing queues up.
window.rotorstab.messages = (() => {
  const page = window.rotorstab;
  const REST = 80; // ms without a change after which the full picture is asked for
  const IDLE = 5000; // ms without an answer after which a page in view asks whether the server is there
  const STORE = "rotorstab-unanswered";
  const REPLACING = ["preset", "reset", "use_shaft", "rotor_file"]; // set many values at once
  const STATEFUL = ["change", ...REPLACING, "pin", "unpin"];
  const here = () => location.pathname + location.search;

  const unanswered = new Map(); // sequence number: the message, and since when it waits
  let pending = {}; // values that were set and not sent
  let earlier = stored(); // messages that were not answered before the page came back
  let deliver = null, present = null; // how a message leaves, and who shows an answer in the sidebar
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

  // -- latest wins ------------------------------------------------------------
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
    // at once after the last picture, where that takes longer than the rest
    due = moving();
    if (!due) send({ type: "settle" });
  }

  function change(name, value) {
    // a number box tells the same value with its Enter and with its change
    if ((name in pending ? pending[name] : stateful().at(-1)?.values?.[name]) === value) return;
    pending[name] = value;
    queueMicrotask(flush); // what one event sets leaves together: a marker is placed in one step
    clearTimeout(resting);
    due = false;
    resting = setTimeout(settle, REST);
  }

  // what was set before a button was pressed is sent before it
  function press(message) {
    const values = pending;
    pending = {};
    if (Object.keys(values).length) send({ type: "change", values });
    send(message);
  }

  // -- answers -----------------------------------------------------------------
  // what was set after the message that an answer is for: the answer must not undo it
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
    // a full picture that was made meanwhile is not the answer to what moved since
    } else if (data.values && (moving() || stateful().length)) return;
    const answer = data.values ? { ...data, replaced, values: { ...data.values, ...ahead() } } : data;
    present(answer);
    page.answer(answer);
    if (data.values && !page.connection.greeted) {
      page.connection.greet();
      restore();
    }
  }

  // -- a page that comes back sends what was not answered, and its address holds all else -------
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
      // the page's own buttons reach the server through the sidebar's component
      page.send = press;
      page.change = change;
      send({ type: "hello" });
    },
    // ms that the oldest message has waited
    waited() {
      const [oldest] = unanswered.values();
      return oldest ? Date.now() - oldest.at : 0;
    },
    // nothing could be answered while the device slept
    renew() {
      for (const one of unanswered.values()) one.at = Date.now();
      ask();
    },
  };
})();
