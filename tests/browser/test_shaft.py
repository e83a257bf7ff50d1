"""The marked point and the moving shaft: from the first second, under the mouse and the keys."""

import pytest

from tests.testing.page import frame_of, settle

pytestmark = pytest.mark.browser
PICTURE = "['side', 'end'].map((one) => document.querySelector(`.shaft-${one}`).toDataURL()).join()"
SENTENCE = "document.querySelector('[data-point]').textContent"
HANDLE = ".marker-handle"


def place(page, frequency, factor):
    """Type a place of the marker."""
    for name, value in (("marker_frequency", frequency), ("marker_factor", factor)):
        box = page.locator(f"[data-marker={name}]")
        box.fill(str(value))
        box.press("Enter")
        settle(page, name, value)


def test_the_shaft_moves_at_once_and_sends_no_message(open_page):
    page = open_page(1366, 768, reduced_motion="no-preference")
    page.wait_for_function("rotorstab.motion.state?.frames > 0", timeout=3000)
    first = page.evaluate(PICTURE)
    page.wait_for_function(f"(first) => {PICTURE} !== first", arg=first, timeout=3000)
    assert page.evaluate(SENTENCE).startswith("Unstable: the whirl doubles every ")
    settle(page)
    sent = []
    session = page.context.new_cdp_session(page)
    session.send("Network.enable")
    session.on(
        "Network.webSocketFrameSent", lambda one: sent.append(one["response"]["payloadData"])
    )
    before = page.evaluate("rotorstab.motion.state.frames")
    page.wait_for_function("(n) => rotorstab.motion.state.frames > n + 30", arg=before)
    assert [one for one in sent if '"ping"' not in one] == []
    page.evaluate("rotorstab.send({ type: 'settle' })")
    page.wait_for_timeout(300)
    assert sent  # the session does hear what the page sends


def test_growth_leaves_the_picture_and_begins_again_and_a_stable_motion_stays_small(page):
    page.locator(".shaft-side").scroll_into_view_if_needed()
    place(page, 1.68, 0.5)
    page.locator(".shaft-speed").select_option("4")
    page.locator(".shaft-knock").click()
    page.wait_for_function("rotorstab.motion.state.size < 0.3")
    page.wait_for_function("rotorstab.motion.state.beyond")
    page.locator(".shaft-beyond").wait_for(state="visible")
    assert page.locator(".shaft-beyond").inner_text() == "beyond linear theory"
    page.wait_for_function("!rotorstab.motion.state.beyond && rotorstab.motion.state.size < 0.3")
    place(page, 3, 0.5)
    assert page.evaluate(SENTENCE) == "Stable: the whirl neither grows nor decays."
    largest = page.evaluate(
        """() => new Promise((done) => {
          let largest = 0;
          const end = performance.now() + 1500;
          const look = () => {
            largest = Math.max(largest, rotorstab.motion.state.size);
            if (performance.now() < end) requestAnimationFrame(look); else done(largest);
          };
          look();
        })"""
    )
    assert 0 < largest < 0.3
    page.locator(".shaft-speed").select_option("1")


def test_taking_the_growth_out_levels_the_motion(page):
    place(page, 1.68, 0.5)
    assert not page.locator(".shaft-level").is_checked()
    page.locator(".shaft-level").check()
    sizes = page.evaluate(
        """() => {
          const { count } = rotorstab.motion.state, late = [];
          for (let k = count / 2; k < count - 1; k++) {
            const { v, w } = rotorstab.motion.at(k);
            late.push(Math.hypot(v, w));
          }
          const half = late.length / 2;
          return [late.slice(0, half), late.slice(half)].map((part) => Math.max(...part));
        }"""
    )
    page.locator(".shaft-level").uncheck()
    assert sizes[1] == pytest.approx(sizes[0], rel=0.1)


def test_the_marker_is_dragged_and_moved_by_keys_and_all_follows(page):
    page.locator(HANDLE).scroll_into_view_if_needed()
    place(page, 1.68, 0.5)
    x, y, width, height = frame_of(page, "instability")
    low, high = (
        page.evaluate("rotorstab.last.values")[f"{end}_frequency"] for end in ("lowest", "highest")
    )
    box = page.locator(HANDLE).bounding_box()
    centre = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    assert centre[0] == pytest.approx(x + width * (1.68 - low) / (high - low), abs=1.5)
    assert centre[1] == pytest.approx(y + height / 2, abs=1.5)
    page.mouse.move(*centre)
    page.mouse.down()
    wanted = x + width * (3.4 - low) / (high - low)
    page.mouse.move(wanted, centre[1], steps=8)
    # before the button is let go
    page.wait_for_function(f"{SENTENCE} === 'Stable: the whirl neither grows nor decays.'")
    page.mouse.up()
    page.wait_for_function("Math.abs(rotorstab.last.values.marker_frequency - 3.4) < 0.06")
    values = settle(page)
    assert values["marker_factor"] == pytest.approx(0.5, abs=0.01)
    # nothing was zoomed
    assert frame_of(page, "instability") == [x, y, width, height]
    assert page.evaluate("rotorstab.places.window('instability')[0]") == [low, high]

    handle = page.locator(HANDLE)
    assert handle.evaluate("one => document.activeElement === one")
    here = values["marker_frequency"]
    handle.press("ArrowRight")
    page.wait_for_function("(here) => rotorstab.last.values.marker_frequency > here", arg=here)
    step = settle(page)["marker_frequency"]
    handle.press("Shift+ArrowLeft")
    page.wait_for_function("(here) => rotorstab.last.values.marker_frequency < here", arg=here)
    values = settle(page)
    assert 0.02 < step - values["marker_frequency"] < 2
    assert handle.get_attribute("role") == "slider"
    text = handle.get_attribute("aria-valuetext")
    assert text.startswith(f"θ/ωₙ = {values['marker_frequency']:g}, β_d = ")
    assert page.evaluate("rotorstab.last.inspector.sentence") in text
    page.locator(".marker-follow").click()
    page.wait_for_function("rotorstab.last.values.marker_frequency === 1.68")


def test_who_wants_no_motion_sees_it_paused(page):
    settle(page)
    assert page.evaluate("rotorstab.motion.state.playing") is False
    assert page.locator(".shaft-play").inner_text() == "Play"
    page.locator(".shaft-knock").click()
    page.wait_for_function("rotorstab.motion.state.playing")
