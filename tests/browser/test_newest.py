"""The ways to serve the page, with whatever Panel and Bokeh are installed: `make newest`.

From Panel 1.10 on `panel serve app` works for several pages at the same time, in worker threads.
"""

import json
import sys
from pathlib import Path

import pytest

from app.state import State
from benchmarks.classroom.client import User
from tests.testing.dashboard import open_dashboard
from tests.testing.page import agrees, settle, wait_for_address
from tests.testing.serving import Server, run

pytestmark = [pytest.mark.browser, pytest.mark.long]

ROOT = Path(__file__).parents[2]
PLAIN, DEPLOYED = "panel serve app", "deploy/start.sh"
PLAIN_COMMAND = [sys.executable, "-m", "panel", "serve", str(ROOT / "app"), "--port", "PORT"]
DRAG = """([from, to]) => {
  for (let step = 0; step <= 12; step += 1) {
    const spin_speed = Number((from + (to - from) * step / 12).toFixed(3));
    rotorstab.send({ type: "change", values: { spin_speed } });
  }
  rotorstab.send({ type: "settle" });
}"""


@pytest.fixture(scope="module", params=[DEPLOYED, PLAIN])
def served(request, tmp_path_factory):
    """A server of its own: nothing is computed yet."""
    command = PLAIN_COMMAND if request.param == PLAIN else None
    server = Server(tmp_path_factory.mktemp("newest") / "log.txt", command=command)
    try:
        server.wait().get("/app")  # the first page takes long
        yield server
    finally:
        server.stop()


def test_a_message_that_comes_before_the_page_is_ready_is_answered(served):
    async def early():
        user = User(served.origin)  # it never says that it is ready
        await user.open()
        answer = await user.ask(type="change", values={"shear": 0.03})
        assert answer.content["values"]["shear"] == 0.03
        await user.close()

    run(early())
    assert "Traceback" not in served.log.read_text()


@pytest.fixture
def tabs(browser, served):
    """Two pages of one user's; a complaint of theirs or of the server fails the test."""
    context, page, watch = open_dashboard(browser, served)
    other = context.new_page()
    yield page, other
    context.close()
    watch.check(served)
    log = served.log.read_text()
    assert "Traceback" not in log
    assert "ERROR" not in log


def test_a_step_of_a_slider_is_drawn_in_full_opens_again_and_is_taken_away(tabs):
    page, other = tabs
    assert agrees(page) == State().inputs()  # the full map, made by another process
    page.locator("#rs-spin_speed").press("ArrowRight")
    page.wait_for_function("rotorstab.last.values.spin_speed > 2")
    values = agrees(page)
    wait_for_address(page, f"spin={values['spin_speed']:g}&")
    other.goto(page.url)
    other.wait_for_function("window.rotorstab?.last?.values && Bokeh.documents[0]?.is_idle")
    assert agrees(other) == values
    with page.expect_download() as download:
        page.evaluate(
            """() => {
              rotorstab.send({ type: "change", values: { spin_speed: 0.9 } });
              rotorstab.send({ type: "export", chart: "instability", format: "json" });
            }"""
        )
    table = json.loads(Path(download.value.path()).read_text("utf-8"))
    assert download.value.suggested_filename == "rotorstab-instability.json"
    assert 0.9 in table["parameters"].values()


@pytest.mark.parametrize("served", [PLAIN], indirect=True)
def test_two_pages_move_at_the_same_time(tabs, served):
    page, other = tabs
    other.goto(served.origin + "/app?v=1&md=7")
    other.wait_for_function("window.rotorstab?.last?.values && Bokeh.documents[0]?.is_idle")
    page.evaluate(DRAG, [0.5, 1.7])
    other.evaluate(DRAG, [3.5, 1.7])
    for one, mass in ((page, 5.0), (other, 7.0)):
        settle(one, "spin_speed", 1.7)
        assert agrees(one)["disk_mass"] == mass
