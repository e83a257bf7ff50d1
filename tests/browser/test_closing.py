"""A page that is closed while the server redraws it leaves no traceback."""

import re
import time

import pytest

pytestmark = pytest.mark.browser

DRAG = """(start) => {
  for (let step = 0; step < 4; step += 1) {
    rotorstab.send({ type: "change", values: { spin_speed: start + 0.013 * step } });
    rotorstab.send({ type: "settle" });
  }
}"""


def open_sockets(server):
    """Number of open sockets, from the server itself."""
    return float(re.search(r"^rotorstab_sockets (\S+)$", server.get("/metrics")[2], re.M)[1])


@pytest.mark.parametrize("start", [1.0, pytest.param(1.5, marks=pytest.mark.long)])
def test_closing_during_a_redraw_logs_no_traceback(open_page, dashboard, start):
    others = open_sockets(dashboard)
    page = open_page()
    before = len(dashboard.log.read_text())
    page.evaluate(DRAG, start)
    page.close()
    deadline = time.monotonic() + 60
    while open_sockets(dashboard) > others:
        assert time.monotonic() < deadline
        time.sleep(0.1)
    new = dashboard.log.read_text()[before:]
    assert "Traceback" not in new
    assert "never retrieved" not in new
