"""Which thread works for the pages: one at a time, on a deployed server always the loop's."""

import asyncio
import threading
import time

from panel.io.state import set_curdoc

from app.background.threads import Scheduler
from app.live.controls import Controls
from tests.testing.serving import Server, run


def test_one_thread_at_a_time_works_for_the_pages(monkeypatch):
    inside, most = [], []

    def respond(message):
        inside.append(message)
        most.append(len(inside))
        time.sleep(0.005)
        inside.pop()
        return {}

    def talk():
        controls = Controls(respond)
        monkeypatch.setattr(controls, "send", lambda answer: None)
        for _ in range(4):
            controls.receive({"seq": 1})

    threads = [threading.Thread(target=talk) for _ in range(6)]
    for one in threads:
        one.start()
    for one in threads:
        one.join(60)
    assert most == [1] * 24


class Document:
    """A document as far as `Scheduler` knows one."""

    def __init__(self, session_context=True):
        self.session_context = session_context
        self.added = []

    def add_next_tick_callback(self, callback):
        self.added.append((threading.get_ident(), callback))


def scheduled(document, callback):
    """Have a thread of its own ask for a callback, while the loop of the page runs."""

    async def page():
        with set_curdoc(document):
            scheduler = Scheduler()
        await asyncio.to_thread(scheduler.call, callback)
        await asyncio.sleep(0)
        return threading.get_ident()

    return run(page())


def test_a_callback_is_given_to_the_document_on_the_loop_where_its_session_is_made():
    document, called = Document(), []
    loop = scheduled(document, lambda: called.append(1))
    ((thread, callback),) = document.added
    assert thread == loop
    assert called == []
    callback()
    assert called == [1]


def test_a_page_that_has_gone_is_not_called_back(monkeypatch):
    gone = Document(session_context=None)
    scheduled(gone, lambda: None)
    assert gone.added == []

    def ended(callback):
        raise RuntimeError("already-destroyed Document")

    going = Document()
    going.add_next_tick_callback = ended
    scheduled(going, lambda: None)

    async def build():
        with set_curdoc(going):
            return Scheduler()

    run(build()).call(lambda: None)  # its loop has ended


def test_a_callback_for_later_is_given_to_the_document_after_its_time():
    document, waited = Document(), []

    async def page():
        with set_curdoc(document):
            scheduler = Scheduler()
        scheduler.call_later(0.05, lambda: waited.append("called"))
        await asyncio.sleep(0)
        waited.append(len(document.added))
        while not document.added:
            await asyncio.sleep(0.01)

    run(page())
    document.added[0][1]()
    assert waited == [0, "called"]
    Scheduler().call_later(0.0, lambda: waited.append("without a page"))
    assert len(waited) == 2


def test_without_a_page_a_callback_comes_at_once():
    called = []
    Scheduler().call(lambda: called.append(threading.get_ident()))
    assert called == [threading.get_ident()]


APP = """
import threading
import panel as pn
def say():
    print("on the loop:", threading.current_thread() is threading.main_thread(), flush=True)
pn.state.curdoc.add_next_tick_callback(say)
pn.pane.Markdown("page").servable()
"""


def test_a_deployed_server_works_on_one_thread(tmp_path):
    """Its limits measure what that thread does for whom."""
    app = tmp_path / "app.py"
    app.write_text(APP)
    server = Server(tmp_path / "log.txt", app)
    try:
        assert server.wait().get("/app")[0] == 200
        deadline = time.monotonic() + 60
        while "on the loop" not in server.log.read_text():
            assert time.monotonic() < deadline
            time.sleep(0.05)
    finally:
        server.stop()
    assert "on the loop: True" in server.log.read_text()
