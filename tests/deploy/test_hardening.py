"""What a client can do to a real server: forged messages, foreign hosts, silence, exits."""

import asyncio
import json
import socket

import pytest

from deploy.constants import LONGEST_ADDRESS
from deploy.patches import limits
from deploy.patches.hosts import shortened
from tests.testing.serving import Server, run
from tests.testing.wire import changed, custom, opened

APP = """
import sys
import panel as pn
from bokeh.models import Div
from bokeh.plotting import figure

class Part(pn.custom.JSComponent):
    _esm = "export function render() {}"

    def _handle_msg(self, data):
        kind = data["type"]
        if kind == "exit":
            sys.exit("a callback exits")
        if kind == "interrupt":
            raise KeyboardInterrupt
        if kind == "later":
            pn.state.curdoc.add_next_tick_callback(lambda: sys.exit("later"))
            pn.state.curdoc.add_timeout_callback(lambda: sys.exit("later still"), 10)
        if kind == "fail":
            raise RuntimeError("a detail of the failure")
        if kind == "large":
            self._send_msg({"seq": data["seq"], "text": "x" * 4_000_000})
        self._send_msg({"seq": data["seq"], "got": repr(data)[:300]})

if "exit" in pn.state.session_args:
    sys.exit("the app exits")
plot = figure(x_range=(0, 1), y_range=(0, 1), width=300, height=200)
plot.line([0, 1], [0, 1])
div = Div(text="untouched")
pn.Column(Part(), pn.pane.Bokeh(plot), pn.pane.Bokeh(div), pn.widgets.FloatSlider(end=1)).servable()
"""


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hardened")
    app = folder / "tiny.py"
    app.write_text(APP)
    server = Server(folder / "log.txt", app)
    try:
        yield server.wait()
    finally:
        server.stop()


def with_wire(server, talk):
    """Run a conversation over a new wire whose document was pulled; return what it returns."""

    async def go():
        async with opened(server, "/tiny") as wire:
            await wire.pull()
            result = await talk(wire)
            leaks = [one for one in wire.heard if "Traceback" in one or 'File "' in one]
            assert leaks == []
            return result

    return run(go())


def alive(server):
    """Whether the process is the one that was started and serves a page and a message."""
    assert server.process.poll() is None

    async def hello(wire):
        return await wire.ask({"type": "hello"})

    return with_wire(server, hello) is not None


# Messages: what the page sends passes, everything else is refused and changes nothing.


def test_ranges_sizes_and_custom_messages_pass(server):
    async def talk(wire):
        for name in wire.models["Range1d"]:
            assert (await wire.reply(await wire.patch(changed(name, "start", 0.25))))[0] == "OK"
        plot = wire.models["Figure"][0] if "Figure" in wire.models else wire.models["figure"][0]
        for attr in ("inner_width", "inner_height", "outer_width", "outer_height"):
            assert (await wire.reply(await wire.patch(changed(plot, attr, 300))))[0] == "OK"
        assert (
            "deep" in (await wire.ask({"type": "x", "values": {"deep": [1, {"a": None}]}}))["got"]
        )
        return await wire.pull()

    assert '"start": 0.25' in json.dumps(with_wire(server, talk))


DIV = {"type": "object", "name": "Div", "id": "z"}
NAN = {"type": "number", "value": "nan"}


def nested(depth):
    """A mapping in a mapping in a mapping."""
    return {"a": nested(depth - 1)} if depth else {}


def building(component):
    """A custom message whose content is a model to be built."""
    event = custom(component, {})
    event["msg_data"]["values"]["entries"][1] = ["data", DIV]
    return event


# each makes an event from {type: ids of the document's models}
FORGED = {
    "a range that is not finite": lambda m: changed(m["Range1d"][0], "end", NAN),
    "a range of 1e308": lambda m: changed(m["Range1d"][0], "end", 1e308),
    "a range of 400 digits": lambda m: changed(m["Range1d"][0], "end", 10**400),
    "a range that is a flag": lambda m: changed(m["Range1d"][0], "end", True),
    "another property of a range": lambda m: changed(m["Range1d"][0], "bounds", [0, 1]),
    "a source's columns": lambda m: changed(m["ColumnDataSource"][0], "data", {"type": "map"}),
    "a slider's limit": lambda m: changed(m["Slider"][0], "end", 1e9),
    "a slider's value": lambda m: changed(m["Slider"][0], "value", 0.5),
    "text of the page": lambda m: changed(m["Div"][0], "text", "<img src=x onerror=alert(1)>"),
    "code of the page": lambda m: changed(m["ReactiveESM"][0], "esm", "alert(1)"),
    "a model that is not there": lambda m: changed("q0", "end", 1),
    "a whole model": lambda m: changed("", "end", 1) | {"model": DIV},
    "a new root": lambda m: {"kind": "RootAdded", "model": DIV},
    "a root less": lambda m: {"kind": "RootRemoved", "model": {"id": m["ReactiveESM"][0]}},
    "a title": lambda m: {"kind": "TitleChanged", "title": "mine"},
    "a column": lambda m: (
        changed(m["ColumnDataSource"][0], "data", None)
        | {"kind": "ColumnDataChanged", "data": {}, "cols": None}
    ),
    "a message that builds a model": lambda m: building(m["ReactiveESM"][0]),
    "a message to another model": lambda m: custom(m["Div"][0], {"type": "hello"}),
    "half a character": lambda m: custom(m["ReactiveESM"][0], {"type": "\ud800"}),
    "a deep message": lambda m: custom(m["ReactiveESM"][0], nested(9)),
    "a kind that is none": lambda m: {"kind": ["ModelChanged"]},
    "no event": lambda m: None,
}


@pytest.mark.parametrize("what", FORGED)
def test_forged_patches_are_refused_and_change_nothing(server, what):
    async def talk(wire):
        before = await wire.pull()
        kind, content = await wire.reply(await wire.patch(FORGED[what](wire.models)))
        assert kind == "ERROR"
        assert content == {"text": "the server could not use this message", "traceback": None}
        # nothing of a message is taken where a part of it is refused
        good = changed(wire.models["Range1d"][0], "start", 0.125)
        kind, _ = await wire.reply(await wire.patch(good, FORGED[what](wire.models)))
        assert kind == "ERROR"
        assert await wire.ask({"type": "hello"})
        assert await wire.pull() == before

    with_wire(server, talk)


def test_the_document_is_sent_some_times_only(server):
    async def talk(wire):
        kinds = [(await wire.reply(await wire.send("PULL-DOC-REQ", {})))[0] for _ in range(4)]
        assert kinds[:2] == ["PULL-DOC-REPLY"] * 2  # one was asked for before
        assert kinds[2:] == ["ERROR"] * 2

    with_wire(server, talk)


@pytest.mark.parametrize("kind", ["PUSH-DOC", "SERVER-INFO-REQ", "ACK", "ERROR"])
def test_other_messages_are_refused(server, kind):
    async def talk(wire):
        before = await wire.pull()
        reply, _ = await wire.reply(await wire.send(kind, {"doc": {"roots": [], "title": "mine"}}))
        assert reply == "ERROR"
        assert await wire.pull() == before

    with_wire(server, talk)


BROKEN = {
    "not JSON": ["{", "{}", "{}"],
    "deep": ['{"msgid":"1","msgtype":"PATCH-DOC"}', "{}", "[" * 100_000],
    "digits": ['{"msgid":"1","msgtype":"PATCH-DOC"}', "{}", "9" * 6000],
    "no name": ["{}", "{}", "{}"],
    "a list": ["[]", "{}", "{}"],
    "an unknown type": ['{"msgid":"1","msgtype":"?"}', "{}", "{}"],
    "buffers": ['{"msgid":"1","msgtype":"PATCH-DOC","num_buffers":1000000000}', "{}", "{}"],
    "bytes": [b"\x00\xff"],
}


@pytest.mark.parametrize("what", BROKEN)
def test_unreadable_messages_close_the_socket_without_a_word_of_the_inside(server, what):
    async def talk(wire):
        await wire.raw(*BROKEN[what])
        assert await wire.read() is None
        assert wire.connection.close_code == 1002
        assert wire.connection.close_reason == "unreadable message"

    with_wire(server, talk)
    assert alive(server)


def test_a_message_that_is_too_large_closes_the_socket(server):
    async def talk(wire):
        await wire.raw('{"msgid":"1","msgtype":"PATCH-DOC"}', "{}", "x" * 300_000)
        assert await wire.read() is None
        assert wire.connection.close_code == 1009

    with_wire(server, talk)
    assert alive(server)


def test_a_failing_callback_tells_no_detail(server):
    async def talk(wire):
        data = custom(wire.models["ReactiveESM"][0], {"type": "fail", "seq": 1})
        kind, content = await wire.reply(await wire.patch(data))
        assert "detail" not in json.dumps(content)
        return kind

    with_wire(server, talk)
    assert "a detail of the failure" in server.log.read_text()


def test_too_many_refused_messages_close_the_socket(server):
    async def talk(wire):
        for number in range(3 * limits.MOST_REFUSED):
            try:
                await wire.patch(changed("p0", "end", number))
            except Exception:  # closed meanwhile
                break
        while await wire.read() is not None:
            pass
        assert wire.connection.close_code == 1008
        assert wire.connection.close_reason == "too many refused messages"

    with_wire(server, talk)
    log = server.log.read_text()
    assert "too many refused messages" in log
    assert log.count("refused a PATCH-DOC message") < 100


# Callbacks that exit.


@pytest.mark.parametrize("kind", ["exit", "interrupt", "later"])
def test_a_callback_that_exits_ends_nothing(server, kind):
    async def talk(wire):
        data = custom(wire.models["ReactiveESM"][0], {"type": kind, "seq": 1})
        assert await wire.reply(await wire.patch(data))
        await asyncio.sleep(0.2)
        assert await wire.ask({"type": "hello"})  # this session goes on too

    with_wire(server, talk)
    assert alive(server)


def test_an_app_that_exits_answers_500(server):
    status, _, page = server.get("/tiny?exit=1")
    assert status == 500
    assert "the app exits" not in page
    assert alive(server)


# Requests.


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/admin", 404),
        ("/admin/", 404),
        ("/rest/session_info", 404),
        ("/rest/", 404),
        ("/components/os/path", 404),
        ("/components/panel.layout/Row/_css/../../x", 404),
        ("/tiny/autoload.js", 404),
        ("/tiny/metadata", 404),
        ("/static/../../etc/passwd", 404),
        ("/static/..%2f..%2fetc%2fpasswd", 404),
        ("/" + "a" * 9000, 414),
        ("/tiny?" + "a" * LONGEST_ADDRESS, 414),
    ],
)
def test_what_is_not_there(server, path, status):
    found, headers, page = server.get(path)
    assert found == status
    assert headers["Content-Security-Policy"]
    assert "Traceback" not in page
    assert str(server.log.parent) not in page
    assert "panel" not in page.replace("panel serve", "")


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "BREW"])
def test_other_methods_are_refused(server, method):
    status, _, page = server.get("/tiny", method=method)
    assert status in (400, 403, 405, 501)
    assert "Traceback" not in page


FOREIGN = (
    "evil.example",
    "evil.example:80",
    "localhost.evil.example",
    "127.0.0.1.evil.example",
    "[::1",
    "a:b",
    "1.2.3.4",
)


@pytest.mark.parametrize("host", FOREIGN)
def test_an_unknown_host_gets_no_page(server, host):
    for path in ("/tiny", "/static/js/bokeh.min.js", "/"):
        assert server.get(path, Host=host)[0] in (400, 421)
    assert server.get("/health", Host=host)[0] in (200, 400)  # a probe uses any name


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1:1", "[::1]:5006"])
def test_a_loopback_name_always_gets_the_page(server, host):
    assert server.get("/tiny", Host=host)[0] == 200


def test_an_address_of_100_kB_gets_the_page(server):
    status, _, page = server.get("/tiny?" + "x=" + "9" * 100_000)
    assert status == 200
    assert '"token":"' in page
    assert len(page) < 100_000


@pytest.mark.parametrize(
    ("query", "kept"),
    [
        ("a=1&b=2", "a=1&b=2"),
        ("spin=1&x=" + "9" * 90_000 + "&b=2", "spin=1&x=90000+characters&b=2"),
        ("x" * 90_000 + "&b=2", "x" * 20 + "&b=2"),
        ("p1=" + "~" * 3000, "p1=" + "~" * 3000),
        ("a=1&" * 25_000, "a=1&" * 2000 + "92+kB+of+text="),
        ("&" * 100_000, "&" * 4000 + "96+kB+of+text="),
    ],
)
def test_a_long_query_keeps_what_is_good_and_names_the_rest(query, kept):
    assert shortened(query) == kept


# Clients that are slow or silent.


def test_a_client_that_reads_nothing_is_let_go(tmp_path):
    (tmp_path / "tiny.py").write_text(APP)
    server = Server(tmp_path / "log.txt", tmp_path / "tiny.py", ROTORSTAB_KEEP_ALIVE="1")
    try:
        server.wait()

        async def go():
            async with opened(server, "/tiny") as slow, opened(server, "/tiny") as other:
                await slow.pull()
                await other.pull()
                stream = slow.connection.protocol.stream
                stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                for number in range(5):
                    part = custom(slow.models["ReactiveESM"][0], {"type": "large", "seq": number})
                    await slow.patch(part)
                # from here on nothing is read, and no ping is answered
                asyncio.get_running_loop().remove_reader(stream.fileno())
                for _ in range(240):
                    assert await other.ask({"type": "hello"})
                    if "as connection was closed" in server.log.read_text():
                        stream.close()
                        return True
                    await asyncio.sleep(0.25)
                stream.close()
            return False

        assert run(go())
        # and one that says nothing at all
        with socket.create_connection(("127.0.0.1", server.port), timeout=20) as silent:
            silent.sendall(b"GET /tiny HTTP/1.1\r\nHost: localhost\r\n")
            assert silent.recv(100) == b""
        assert server.get("/tiny")[0] == 200
        assert "Uncaught exception" not in server.log.read_text()
    finally:
        server.stop()
