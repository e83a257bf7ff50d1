"""Files: made elsewhere, in turns, and the user hears what became of them."""

import base64
import json
import time
from concurrent.futures import CancelledError, Future
from queue import Queue

import numpy as np
import pytest

from app.background import printing, processes
from app.background.printing import Printer, gather
from app.exports import files
from app.exports.files import MOST_FILES, Files, export, making, report
from app.pages.paper import Paper
from app.reading.user_error import UserError
from app.results import comparisons, growth_maps
from app.results.analysis import solve, window_of
from app.results.comparisons import paper_figure
from app.results.limits import Detail
from app.session import Session
from app.state import State
from rotorstab.charts import chart_figure
from rotorstab.drawing.tables import figure_csv
from rotorstab.paper import FIGURES


@pytest.fixture(scope="module")
def session():
    return Session()


@pytest.fixture(scope="module")
def figure():
    return chart_figure(solve(State(), detail=Detail.COARSE).charts["campbell"], {})


class Desk:
    """A worker that notes its calls; the test decides how each ends."""

    def __init__(self):
        self.calls = []

    def call(self, function, *arguments):
        self.calls.append(Future())
        return self.calls[-1]

    def close(self):
        pass


@pytest.fixture
def desk(monkeypatch):
    made = Desk()
    monkeypatch.setattr(printing, "Worker", lambda: made)
    return made


def test_whoever_asks_for_one_file_waits_for_one_of_each_other(desk, figure):
    printer = Printer()
    many = [printer.file(k, figure, "svg", "many") for k in range(60)]
    one = printer.file("one", figure, "svg", "one")
    other = printer.file(59, figure, "svg", "other")  # the last of the long queue
    assert other is many[-1]
    assert printer.pending() == 61
    for _ in range(4):
        desk.calls[-1].set_result({"svg": b"drawn"})
    assert [future.done() for future in (one, other, many[0], many[1])] == [True] * 4
    assert not any(future.done() for future in many[2:-1])
    assert len(desk.calls) == 5  # one after the other


def test_a_drawing_that_is_cancelled_or_fails_ends_and_the_next_one_is_made(desk, figure):
    printer = Printer()
    first, second, third = (printer.file(key, figure, "svg") for key in "abc")
    desk.calls[0].cancel()
    assert isinstance(first.exception(1), CancelledError)
    desk.calls[1].set_exception(MemoryError())
    assert isinstance(second.exception(1), MemoryError)
    desk.calls[2].set_result({"svg": b"drawn"})
    assert third.result(1) == b"drawn"
    assert printer.pending() == 0
    again = printer.file("a", figure, "svg")  # what failed is made anew, what was made is kept
    assert again is not first
    assert printer.file("c", figure, "svg") is third


def test_an_end_leaves_nobody_waiting(desk, figure):
    printer = Printer()
    running, waiting = (printer.file(key, figure, "svg") for key in "ab")
    printer.close()
    desk.calls[0].set_result({"svg": b"drawn"})
    assert running.result(1) == b"drawn"
    assert waiting.cancelled()
    assert len(desk.calls) == 1
    assert isinstance(gather([running, waiting]).exception(1), CancelledError)


def test_who_leaves_takes_only_the_own_files_along(desk, figure):
    printer = Printer()
    printer.file("begun", figure, "svg", "who")
    own, common = (printer.file(key, figure, "svg", "who") for key in ("own", "common"))
    printer.file("common", figure, "svg", "other")
    printer.drop("who")
    assert own.cancelled()
    assert not common.cancelled()
    assert printer.pending() == 2
    desk.calls[0].set_result({"svg": b"drawn"})
    printer.file("own", figure, "svg", "who")
    printer.file("own", figure, "svg", "other")
    desk.calls[1].set_result({"svg": b"drawn"})  # of "common"; now "own" is drawn for one of them
    printer.drop("who")
    printer.drop("other")
    desk.calls[2].set_result({"svg": b"drawn"})
    assert printer.file("own", figure, "svg").result(1) == b"drawn"


class Page:
    """A scheduler as of a served page: what is called runs when the test says so."""

    document = object()

    def __init__(self):
        self.calls, self.end = Queue(), []

    def call(self, callback):
        self.calls.put(callback)

    def at_end(self, callback):
        self.end.append(callback)

    def turn(self):
        self.calls.get(timeout=60)()


@pytest.fixture
def own(monkeypatch):
    """A printer and a background of the test's own."""
    made = Printer(), processes.Background(0)
    monkeypatch.setattr(files, "printer", made[0])
    monkeypatch.setattr(files, "background", made[1])
    yield made
    for one in made:
        one.close()


def never(*_, **__):
    pytest.fail("computed on the thread of the server")


@pytest.fixture
def moved(session, monkeypatch):
    """A session that has just moved: its full map is not there, and is not made here."""
    session.respond({"type": "page", "name": "explore"})
    session.respond({"type": "reset"})
    growth_maps.clear()
    session.respond({"type": "change", "values": {"spin_speed": 1.375}})
    monkeypatch.setattr(growth_maps, "floquet_map", never)
    return session


@pytest.mark.parametrize("what", ["csv", "report"])
def test_a_file_of_a_page_that_has_just_moved_waits_for_the_map_of_another_process(
    own, moved, what
):
    told, page = [], Page()
    wanted = Files(page, told.append, moved.state)
    explore = moved.pages["explore"]
    if what == "report":
        reply = report(explore, moved.state, moved.query(), {})
    else:
        reply = export(explore, moved.state, {"format": "csv", "chart": "instability"})
    assert "making" in wanted.start(reply)["toast"]
    inputs = moved.state.inputs()
    moved.state.spin_speed = 1.5  # it moves on meanwhile: the file is of what was asked for
    page.turn()
    page.turn()
    assert making() == 0
    text = base64.b64decode(told[-1]["file"]["base64"]).decode("utf-8-sig")
    state = State(**inputs)
    assert growth_maps.known_detail(window_of(state)) is Detail.FULL
    if what == "report":
        assert text.count("<svg") >= 3
        assert "1.375" in text
    else:
        chart = moved.pages["explore"].compute(state)["instability"]
        parameters = files.named_inputs(inputs)
        assert text == figure_csv(chart_figure(chart, parameters))


def test_a_figure_with_floquet_is_computed_by_another_process(own, monkeypatch):
    comparisons.figures.clear()
    without = FIGURES[8]
    # this process makes the paper's own curves only
    monkeypatch.setitem(FIGURES, 8, lambda floquet=False: never() if floquet else without())
    told, page = [], Page()
    wanted = Files(page, told.append, State())
    request = {"format": "json", "number": 8, "floquet": True}
    assert "making" in wanted.start(export(Paper(), State(), request))["toast"]
    shown = Paper().handle({"type": "figure", "number": 8, "floquet": True}, State())
    first = wanted.start(shown)["figure"]  # the paper's own, while Floquet's part is computed
    assert (first["number"], first["floquet"], first["waits"]) == (8, True, True)
    for _ in range(3):
        page.turn()
    (file,) = (one["file"] for one in told if "file" in one)
    assert file["name"] == "rotorstab-figure-8-floquet.json"
    (words,) = (one["figure"] for one in told if one.get("figure_made"))
    assert (words["number"], words["floquet"]) == (8, True)
    assert len(words["reading"]) > len(first["reading"])
    table = json.loads(base64.b64decode(file["base64"]))
    assert table["parameters"] == dict(paper_figure(8, True).parameters)


def test_the_user_hears_of_a_map_that_cannot_be_made(own, moved, monkeypatch, caplog):
    def no_room(*_, **__):
        raise OSError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(processes, "ProcessPoolExecutor", no_room)
    told, page = [], Page()
    wanted = Files(page, told.append, moved.state)
    request = {"format": "csv", "chart": "instability"}
    wanted.start(export(moved.pages["explore"], moved.state, request))
    page.turn()
    assert "try again" in told[-1]["toast"]
    assert making() == 0
    monkeypatch.undo()


def test_the_user_hears_of_a_printer_that_does_not_start(own, session, monkeypatch):
    def no_room(*_, **__):
        raise OSError(11, "Resource temporarily unavailable")

    session.respond({"type": "reset"})
    monkeypatch.setattr(processes, "ProcessPoolExecutor", no_room)
    told = Queue()
    monkeypatch.setattr(session.controls, "send", told.put)
    answer = session.respond({"type": "export", "format": "pdf", "chart": "campbell"})
    assert "making" in answer["toast"]
    assert "try again" in told.get(timeout=60)["toast"]
    monkeypatch.undo()
    monkeypatch.setattr(session.controls, "send", told.put)
    session.respond({"type": "export", "format": "csv", "chart": "campbell"})
    assert "file" in told.get(timeout=60)


@pytest.mark.parametrize("kind", ["export", "report"])
def test_the_user_hears_that_a_state_has_no_answer(session, monkeypatch, kind):
    def no_answer(*_, **__):
        raise UserError("this rotor has no such load")

    session.respond({"type": "reset"})
    monkeypatch.setattr(files, "solve", no_answer)
    monkeypatch.setattr("app.pages.explore.solve", no_answer)
    answer = session.respond({"type": kind, "format": "pdf", "chart": "campbell"})
    assert answer["toast"] == "this rotor has no such load"


def test_a_message_that_fails_is_answered(session, monkeypatch, caplog):
    def fail(*_):
        raise KeyError("a detail of the inside")

    monkeypatch.setattr("app.session.export", fail)
    answer = session.respond({"type": "export", "format": "pdf", "chart": "campbell"})
    assert "could not be done" in answer["toast"]
    assert "inside" not in answer["toast"]
    assert answer["values"] == session.state.inputs()
    assert "a detail of the inside" in caplog.text


def test_a_session_that_ends_waits_for_nothing(own, moved):
    told, page = [], Page()
    wanted = Files(page, told.append, moved.state)
    own[1].request(time.sleep, 600)
    request = {"format": "csv", "chart": "instability"}
    wanted.start(export(moved.pages["explore"], moved.state, request))
    assert (making(), own[1].pending()) == (1, 2)
    for callback in page.end:
        callback()
    assert (making(), own[1].pending()) == (0, 1)
    assert told == []


def test_a_session_may_wait_for_some_files_only_and_for_one_while_many_wait(desk, session):
    told, page = [], Page()
    wanted = Files(page, told.append, session.state)
    bystander = Files(page, told.append, State())
    futures = [Future() for _ in range(MOST_FILES)]
    for one in futures:
        assert not wanted.full()
        wanted.start(files.Reply(file=one))
    assert wanted.full()
    assert not bystander.full()
    crowd = Files(page, told.append, State())
    for _ in range(files.MOST_WAITING):
        crowd.start(files.Reply(file=Future()))
    assert not bystander.full()
    bystander.start(files.Reply(file=Future()))
    assert bystander.full()
    crowd.close()
    assert not bystander.full()
    futures[0].set_result({"toast": "ready"})
    page.turn()
    assert not wanted.full()
    assert told == [{"toast": "ready"}]
    wanted.close()
    bystander.close()


@pytest.mark.parametrize("key", ["load-frequency", "campbell"])
@pytest.mark.parametrize("kind", ["csv", "json", "svg"])
def test_a_file_of_a_zoomed_chart_has_what_is_seen(own, session, monkeypatch, key, kind):
    figures = []
    monkeypatch.setattr(
        "app.exports.files.printer.file",
        lambda cache_key, figure, *_: figures.append(figure) or Future(),
    )
    live = session.pages["explore"].charts[key].figure
    live.x_range.update(start=1.0, end=1.1)
    live.y_range.update(start=-1.0, end=1.0)
    window = {"left": 1.0, "right": 1.1, "low": -1.0, "high": 1.0}
    session.respond({"type": "window", "chart": key, **window})
    session.respond({"type": "export", "chart": key, "format": kind})
    chart = figures[0].panels[0]
    assert (chart.x_range, chart.y_range) == ((1.0, 1.1), (-1.0, 1.0))
    x = chart.layer("whirl").columns["xs"][0]
    assert np.sum((x >= 1.0) & (x <= 1.1)) > 100
    if kind != "svg":
        assert (x[0], x[-1]) == (1.0, 1.1)
    session.respond({"type": "view"})


def test_the_place_of_a_figure_that_cannot_be_computed_says_so(monkeypatch):
    """Its place once went on saying that it was being drawn."""
    told, page = [], Page()
    broken = Future()
    broken.set_exception(OSError("no process"))
    comparisons.figures.clear()
    monkeypatch.setattr(files.background, "request", lambda *_: broken)
    wanted = Files(page, told.append, State())
    wanted.start(Paper().handle({"type": "figure", "number": 9, "floquet": True}, State()))
    page.turn()
    assert "could not be computed" in told[-1]["not_drawn"]
    assert "could not be made" in told[-1]["toast"]
