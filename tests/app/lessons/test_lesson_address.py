"""A lesson's step in the address: links, Back, and what a step that asks does not give away."""

import pytest

from app.lessons import library

pytestmark = pytest.mark.browser
LESSON = library().lessons["07-damping"]
SPIN = LESSON.steps[3].before["spin_speed"]
SHOWN = "document.querySelector('[data-lesson=\"where\"]').textContent"


def go_to(page, step):
    """Go to a step of a lesson by its address, on a page that is open already."""
    page.evaluate("(step) => { location.hash = `lesson/${step}`; }", step)
    at_step(page, int(step.rpartition("/")[2]))


def at_step(page, number):
    page.wait_for_function(f"{SHOWN}.includes('step {number} of')")


def test_a_step_beyond_the_last_is_the_last(page):
    page.evaluate("location.hash = 'lesson/07-damping/99'")
    at_step(page, len(LESSON.steps))
    page.wait_for_function(f"location.hash === '#lesson/07-damping/{len(LESSON.steps)}'")
    page.get_by_text("this is the last one").wait_for()


def test_a_link_sets_a_step_up_and_back_goes_to_the_step_before(open_page):
    """With settings in the address: see tests/browser/test_return.py."""
    page = open_page(path="/app#lesson/07-damping/4")
    at_step(page, 4)
    page.wait_for_function(f"rotorstab.last.values.spin_speed === {SPIN}")
    # sliders leave no entry
    entries = page.evaluate("history.length")
    page.evaluate("rotorstab.change('external_damping', 0.03)")
    page.wait_for_function("location.search.includes('0.03')")
    assert page.evaluate("history.length") == entries
    page.get_by_role("button", name="Next").click()
    at_step(page, 5)
    page.wait_for_function(f"history.length === {entries + 1}")
    # the menu says where one is
    assert page.locator("nav a[aria-current]").text_content() == "Lessons"
    page.go_back()
    at_step(page, 4)
    page.wait_for_function("location.hash === '#lesson/07-damping/4'")
    page.go_forward()
    at_step(page, 5)


def test_a_prediction_is_not_given_away_and_a_unit_is_no_wrong_answer(page):
    go_to(page, "01-parametric-resonance/1")
    page.evaluate("rotorstab.change('show_growth', true)")
    page.wait_for_function("rotorstab.last.values.show_growth")
    assert page.locator("[data-point]").is_hidden()
    assert page.get_by_role("button", name="Details").is_hidden()
    page.get_by_text("The result is shown after your prediction.").wait_for()
    box = page.locator(".lesson-box")
    box.fill("2 ω_n")
    box.press("Enter")
    page.locator(".lesson-words.note", has_text="Write a number only").wait_for()
    assert page.locator("[data-point]").is_hidden()
    assert page.get_by_role("button", name="Details").is_hidden()
    box.fill("2")
    box.press("Enter")
    page.locator(".lesson-words.right").wait_for()
    page.get_by_role("button", name="Details").click()
    page.locator("#details", has_text="1B+1F").wait_for()
    # nor is the next one, by what is open
    page.get_by_role("button", name="Next").press("Enter")
    at_step(page, 2)
    assert page.locator("#details").is_hidden()


def test_nothing_of_the_old_step_acts_while_the_new_one_is_under_way(page):
    go_to(page, "07-damping/3")
    page.evaluate("window.sends = rotorstab.send; rotorstab.send = () => {}")
    page.get_by_role("button", name="Next").click()
    assert page.locator(".lesson").get_attribute("aria-busy") == "true"
    assert page.locator('[data-lesson="form"]').evaluate("one => one.closest('[inert]') !== null")
    assert page.locator(".lesson-foot").evaluate("one => one.inert")
    page.evaluate("rotorstab.send = sends")


LEAKS = """() => {
  const open = (one) => one.checkVisibility({ visibilityProperty: true });
  const figures = [...Bokeh.documents[0].roots()].flatMap((top) => [...top.references()])
    .filter((one) => one.type === "Figure");
  const named = (key) => figures.find((one) => one.name === key);
  const shown = (key, label) => {
    const names = named(key).renderers.find((one) => one.name === label);
    return names.visible && names.glyph.text_alpha.value > 0;
  };
  const words = "[data-point], .details-button, [data-inspector], .pins, .save-menu";
  return {
    words: [...document.querySelectorAll(words)].filter(open).map((one) => one.textContent),
    asked: [...document.querySelectorAll("[data-number], [data-whirl]")].filter(
      (one) => getComputedStyle(one).visibility === "hidden"
        && one.parentElement.classList.contains("asked")
    ).map((one) => one.dataset.number || one.dataset.whirl),
    names: shown("instability", "tongue") || shown("load-frequency", "limit"),
    hover: ["instability", "load-frequency", "campbell"].some(
      (key) => named(key).toolbar.tools.some((one) => one.type === "HoverTool" && one.active)
    ),
  };
}"""
# what a step offers, and whether it is on the screen: also with its longest texts, which wait
SCREEN = """(hint) => {
  const open = (one) => one.checkVisibility({ visibilityProperty: true });
  const boxes = (selector) => [...document.querySelectorAll(selector)].filter(open);
  const inside = (one) => {
    const { left, top, right, bottom, width, height } = one.getBoundingClientRect();
    const within = left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight;
    return within && Math.min(width, height) > 80;
  };
  const parts = {
    instability: "[data-view=instability] .plot",
    "load-frequency": "[data-view=load-frequency] .plot",
    campbell: "[data-view=campbell] .plot", shaft: ".shaft-side", response: ".tip-chart .plot",
    multipliers: ".multipliers .plot", orbit: ".orbit .plot",
  };
  const shown = Object.entries(parts).filter(([, place]) => boxes(place).length);
  const page = document.documentElement, body = document.querySelector(".lesson-body");
  const words = document.querySelector("[data-lesson=words]");
  const see = document.querySelector("[data-lesson=see-part]");
  const fits = () => page.scrollHeight <= innerHeight && page.scrollWidth <= innerWidth
    && body.scrollHeight <= body.clientHeight;
  const [text, kind, hidden] = [words.innerHTML, words.className, see.hidden];
  const found = {
    looked: shown.map(([name]) => name),
    inside: shown.every(([, place]) => boxes(place).every(inside)),
    offered: boxes("aside, .marker-bar, .whole-range, .fit-colours, .point-details, .layers button")
      .filter((one) => !one.closest("[inert]")).length,
    controls: [...document.querySelectorAll("[data-lesson=move] :is(input, select)")]
      .map((one) => one.id.replace("lesson-", "")),
    fits: fits(),
  };
  words.className = "lesson-words hint";
  words.innerHTML = hint;
  found.hint = fits();
  words.className = "lesson-words right";
  words.innerHTML = "Yes. The solver gives <b>1.234</b>.";
  see.hidden = false;
  found.see = fits();
  [words.innerHTML, words.className, see.hidden] = [text, kind, hidden];
  return found;
}"""


# the questions of these ask for a number, a choice and a goal
FEW = ("01-parametric-resonance", "07-damping")
ALL = pytest.param(tuple(library().lessons), marks=pytest.mark.long)


@pytest.mark.parametrize("keys", [FEW, ALL], ids=["few", "all"])
def test_every_step_is_on_one_screen_and_gives_nothing_away(page, keys):
    page.set_viewport_size({"width": 1366, "height": 768})
    shown = {"buckling", "flutter", "fundamental"}
    for key in keys:
        for number, step in enumerate(library().lessons[key].steps, 1):
            page.evaluate("(hash) => { location.hash = hash; }", f"lesson/{key}/{number}")
            page.wait_for_function(
                "(title) => document.querySelector('[data-lesson=heading]').innerHTML === title"
                " && document.querySelector('.lesson').getAttribute('aria-busy') === 'false'"
                " && Bokeh.documents[0].is_idle",
                arg=step.title,
            )
            screen = page.evaluate(SCREEN, step.question.hint)
            where = key, number, screen
            assert sorted(screen["looked"]) == sorted(step.show.look), where
            assert screen["inside"], where
            assert [screen[part] for part in ("fits", "hint", "see")] == [True] * 3, where
            assert screen["offered"] == 0, where
            assert tuple(screen["controls"]) == step.show.move, where
            if step.question.kind == "goal":
                continue
            page.wait_for_function("rotorstab.veiled")
            found = page.evaluate(LEAKS)
            where = key, number, found
            assert found["words"] == [], where
            assert not found["names"], where
            assert not found["hover"], where
            told = [one.name for one in step.question.answer.terms] if step.question.answer else []
            hidden = {one.removeprefix("whirl.") for one in told} - {
                one.removeprefix("whirl.") for one in step.show.given
            }
            assert set(found["asked"]) == hidden & (shown | {"1B", "1F", "2B", "2F"}), where


def test_names_return_with_the_answer_and_when_the_lesson_is_left(page):
    go_to(page, "06-axial-and-follower/3")
    page.wait_for_function("rotorstab.veiled")
    page.wait_for_function(f"!({LEAKS})().names")
    page.locator(".lesson-choice input").first.check()
    page.get_by_role("button", name="Check").click()
    page.locator(".lesson-words.right").wait_for()
    page.wait_for_function("!rotorstab.veiled")
    page.wait_for_function(
        f"() => {{ const {{ names, hover, words }} = ({LEAKS})();"
        " return names && hover && words.length > 0; }"
    )
    page.evaluate("location.hash = 'lesson/06-axial-and-follower/5'")
    at_step(page, 5)
    page.wait_for_function("rotorstab.veiled")
    page.get_by_role("button", name="Leave the lesson").click()
    page.wait_for_function("!rotorstab.veiled")
    page.wait_for_function(f"({LEAKS})().names")


def test_a_place_is_not_read_off_the_map_before_it_is_computed():
    """Where a tongue's place is asked for, no map shows that very place."""
    for key, lesson in library().lessons.items():
        for step in lesson.steps:
            answer = step.question.answer
            if answer is None or not any(one.name.endswith(".centre") for one in answer.terms):
                continue
            moved = {
                name
                for name, value in step.after.items()
                if value != step.before[name] and not name.startswith(("show_", "marker"))
            }
            assert moved or not step.before["show_growth"], (key, step.title)


COVER = """() => getComputedStyle(
  document.querySelector("[data-view=campbell] .plot"), "::after").content"""
NUMBER = """() => getComputedStyle(
  document.querySelector('[data-lesson="watch"] dd')).visibility"""


def choose(page, number):
    page.locator(".lesson-choice input").nth(number).check()
    page.get_by_role("button", name="Check").click()


def test_curves_wait_for_the_prediction_and_numbers_for_the_trying(page):
    go_to(page, "04-gyroscope/1")
    page.wait_for_function(f"({COVER})().includes('after your prediction')")
    choose(page, 0)
    page.locator(".lesson-words.hint").wait_for()
    page.wait_for_function(f"({COVER})() === 'none'")
    assert page.evaluate(NUMBER) == "hidden"
    page.locator("#lesson-spin_speed").press("ArrowRight")
    page.wait_for_function(f"({NUMBER})() === 'visible'")
    choose(page, 2)
    page.locator(".lesson-words.right").wait_for()
    choose(page, 1)
    page.locator(".lesson-words.note", has_text="Your earlier right answer still counts").wait_for()
    page.reload()
    at_step(page, 1)
    page.locator(".lesson-words.right", has_text="It gets faster").wait_for()


PLACES = """() => [...document.querySelectorAll(".plot, .lesson-form, .lesson-move")].map((one) => {
  const { x, y, width, height } = one.getBoundingClientRect();
  return [x, y, width, height];
}).join()"""


def test_a_right_answer_shows_what_its_text_speaks_of_and_nothing_jumps(page):
    page.set_viewport_size({"width": 1366, "height": 768})
    start = page.evaluate("rotorstab.last.values")
    go_to(page, "01-parametric-resonance/4")
    page.wait_for_function("rotorstab.veiled && rotorstab.inspector.ready")
    # before the prediction the point of the step cannot be moved
    before = page.evaluate(
        "() => { rotorstab.marker.tap(2.2, 0.3); return rotorstab.last.values.marker_frequency; }"
    )
    assert before == 3.0
    places = page.evaluate(PLACES)
    page.evaluate("""() => {
      const words = document.querySelector("[data-lesson=words]");
      new MutationObserver(() => { window.atWords ??= words.textContent && {
        frequency: rotorstab.last.values.marker_frequency,
        see: document.querySelector("[data-lesson=see-part]").hidden,
      }; }).observe(words, { childList: true });
    }""")
    choose(page, 0)
    page.locator(".lesson-words.right").wait_for()
    assert page.evaluate("atWords") == {"frequency": 1.0, "see": False}
    assert page.evaluate(PLACES) == places
    # then it moves, within the ranges of the step's sliders
    page.evaluate("rotorstab.marker.tap(0.1, 0.3)")
    page.wait_for_function("rotorstab.last.values.marker_factor === 0.3")
    assert page.evaluate("rotorstab.last.values.marker_frequency") == 0.5
    # a step that was done begins with what its text speaks of
    page.get_by_role("button", name="Back").click()
    at_step(page, 3)
    page.locator(".lesson-steps button").nth(3).click()
    at_step(page, 4)
    page.wait_for_function("rotorstab.last.values.marker_frequency === 1")
    page.locator(".lesson-words.right").wait_for()
    # Explore is the whole dashboard again, as it was before the lesson
    page.get_by_role("link", name="Explore").click()
    page.locator("#sidebar").wait_for(state="visible")
    assert page.locator(".lesson").is_hidden()
    page.wait_for_function("rotorstab.last.values.marker_follows")
    assert page.evaluate("rotorstab.last.values") == start


def test_a_wrong_answer_moves_nothing_and_a_shown_one_does(page):
    page.emulate_media(reduced_motion="no-preference")
    go_to(page, "04-gyroscope/1")
    page.wait_for_function("rotorstab.veiled")
    choose(page, 0)
    page.locator(".lesson-words.hint").wait_for()
    assert page.evaluate("rotorstab.last.values.spin_speed") == 0
    page.get_by_role("button", name="Show me").click()
    # the slider moves through the values between
    page.wait_for_function("(v => v > 0 && v < 1)(rotorstab.last.values.spin_speed)")
    page.locator(".lesson-words.shown").wait_for()
    assert page.evaluate("rotorstab.last.values.spin_speed") == 1
    page.emulate_media(reduced_motion="reduce")


def test_a_lost_connection_is_told_wherever_one_is_on_the_page(page):
    go_to(page, "05-bolotin/4")
    page.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
    page.evaluate("""() => {
      const lost = document.querySelector(".lost");
      lost.hidden = false;
      lost.textContent = "The connection to the server was lost.";
    }""")
    box = page.locator(".lost").bounding_box()
    assert 0 <= box["y"] < 200
    page.evaluate("document.querySelector('.lost').hidden = true")
