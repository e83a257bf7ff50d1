"""Lessons: their files, the answers that the solver gives, and what a session says of them."""

import json
import logging
import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.lessons import QUANTITIES, LessonError, Unanswerable, grade, library, parse, solution
from app.lessons.__main__ import main
from app.lessons.evaluation import evaluate
from app.lessons.expressions import read_condition, read_expression
from app.lessons.library import VARIABLE, collect, read_file, read_folder
from app.lessons.markdown import inline, plain, render, tokens
from app.pages.lessons import describe
from app.session import Session
from app.state import State
from rotorstab import BASE_CASE, growth_rate, lumped, resonances, whirl_frequencies

ROOT = Path(__file__).parents[3]
DOCUMENT = (ROOT / "docs" / "lessons.md").read_text(encoding="utf-8")
EXAMPLE = re.search(r"^`````markdown\n(.*?)^`````$", DOCUMENT, re.M | re.S)[1]
LESSONS = library().lessons
STEPS = [
    pytest.param(lesson, index, id=f"{key}-{index + 1}")
    for key, lesson in LESSONS.items()
    for index in range(len(lesson.steps))
]
INPUTS = State().inputs()


def test_eight_lessons_are_built_in_and_all_are_sound():
    assert len(LESSONS) >= 8
    assert library().problems == ()


@pytest.mark.parametrize(("lesson", "index"), STEPS)
def test_each_step_can_be_set_and_its_question_answered(lesson, index):
    step = lesson.steps[index]
    for inputs in (step.before, step.after):
        assert State().change(inputs) == {}
    answer, question = solution(step), step.question
    assert step.show.look
    assert step.predict or step.question.ask
    assert step.see
    if question.kind == "number":
        low, high = question.range
        assert low <= answer <= high
        assert grade(step, answer, step.after).right
        assert grade(step, f" {answer:.6f}".replace(".", ","), step.after).right
        away = 3 * question.tolerance * (abs(answer) if question.relative else 1)
        far = answer + away if answer + away <= high else answer - away
        wrong = grade(step, far, step.after)
        assert (wrong.right, wrong.words, wrong.counted) == (False, question.hint, True)
    elif question.kind == "choice":
        for chosen, choice in enumerate(question.choices):
            told = grade(step, chosen, step.after)
            assert told.right == (chosen == answer)
            if chosen != answer:
                assert told.words == (choice.hint or question.hint)
    else:
        assert grade(step, None, step.after).right
        # else there is nothing to reach
        assert not grade(step, None, step.before).right


def test_the_answers_are_the_solvers_own():
    buckling = evaluate("buckling", INPUTS)
    system = lumped(BASE_CASE, 2.0)
    whirl = whirl_frequencies(system, 0.5 * buckling).real
    modes = ("2B", "1B", "1F", "2F")
    assert [evaluate(f"whirl.{one}", INPUTS) for one in modes] == pytest.approx(whirl)
    pulled = [evaluate(f"whirl.{one}", INPUTS, -2.0) for one in modes]
    assert pulled == pytest.approx(whirl_frequencies(system, -2.0).real)
    table = resonances(system, 0.5 * buckling, 0.5 * buckling)
    unit = evaluate("fundamental", INPUTS)
    centre = evaluate("tongue.1B+1F.centre", INPUTS)
    assert centre == pytest.approx(table["1B+1F"].centre / unit)
    assert centre == pytest.approx((whirl[2] - whirl[1]) / unit)
    growth = growth_rate(system, 0.5 * buckling, 0.5 * buckling, 1.68 * unit)
    assert evaluate("growth", INPUTS) == pytest.approx(float(growth))
    assert evaluate("unstable", INPUTS) == 1
    assert evaluate("bolotin.1F", INPUTS) == pytest.approx(2.86513, abs=2e-5)
    assert evaluate("bolotin.1B", INPUTS) == pytest.approx(0.42637, abs=2e-5)
    assert evaluate("critical.forward.2", INPUTS | {"polar_inertia": 0.4}) > 1
    assert math.isnan(evaluate("critical.forward.2", INPUTS))


def test_rotating_damping_destabilises_from_the_critical_speed_on():
    inputs = INPUTS | {"internal_damping": 0.02}
    critical = evaluate("critical.forward", inputs)
    assert evaluate("spin_limit", inputs) == pytest.approx(critical, abs=1e-4)
    assert evaluate("spin_limit", INPUTS) == math.inf


def test_every_quantity_has_a_value_and_is_documented():
    parts = {"<mode>": "1F", "<pair>": "1B+1F", "<n>": "1", "<way>": "forward", "<name>": "shear"}
    for quantity in QUANTITIES:
        name = quantity.form
        for part, word in parts.items():
            name = name.replace(part, word)
        assert not math.isnan(evaluate(name, INPUTS)), name
        assert f"| `{quantity.form}` | {quantity.doc} |" in DOCUMENT


def test_every_parameter_is_documented():
    # a new input wants a row in the last table of docs/lessons.md
    assert [name for name in INPUTS if f"| `{name}` |" not in DOCUMENT] == []


def test_the_documents_example_is_a_lesson():
    lesson = parse(EXAMPLE, "example")
    assert [solution(step) for step in lesson.steps] == [1, pytest.approx(1.427, abs=1e-3)]
    assert lesson.steps[1].before["static_load_factor"] == 0.5
    assert grade(lesson.steps[0], 0, INPUTS).words == "A guitar string is pulled."


# -- files ----------------------------------------------------------------------------

FAULTS = {
    "no front matter": ("+++\ntitle", "title", 1, "must begin"),
    "no closing line": ("\n+++\n\nA line", "\n\nA line", 1, "no closing line"),
    "bad TOML": ("minutes = 5", "minutes = = 5", 4, "TOML"),
    "unknown key": ("minutes = 5", "hours = 5", 4, "no 'hours'"),
    "bad minutes": ("minutes = 5", "minutes = true", 4, "whole number"),
    "unknown parameter": ("spin_speed = 0.0", "spin = 0.0", 7, "unknown parameter"),
    "out of range": ("spin_speed = 0.0", "spin_speed = 99", 7, "from 0 to 4"),
    "not a number": ("spin_speed = 0.0", "spin_speed = nan", 7, "from 0 to 4"),
    "no title": ('title = "Tune the shaft"', "title = 5", 2, "must be a text"),
    "unknown chart": ('"load-frequency"', '"loads"', 17, "there is no 'loads'"),
    "unknown control": ('["static_load_factor"]', '["alpha"]', 18, "there is no 'alpha'"),
    "unknown number": ('"buckling"]', '"bucking"]', 19, "there is no 'bucking'"),
    "unknown part": ("### Predict", "### Guess", 22, "### Predict"),
    "unknown quantity": ("whirl.1F > whirl", "whirl.1G > whirl", 29, "no quantity 'whirl.1G'"),
    "unknown case": ("whirl.1F > whirl.1F@before", "whirl.1F > whirl.1F@rest", 29, "no case"),
    "no comparison": ("whirl.1F > whirl.1F@before", "whirl.1F", 29, "compare"),
    "bad block": ("static_load_factor = 0.5", "static_load_factor = 2", 40, "from 0 to 0.95"),
    "no tolerance": ("tolerance = 0.05", "tolerance = 0", 54, "tolerance"),
    "bad share": ("tolerance = 0.05", 'tolerance = "900 %"', 54, "tolerance"),
    "bad range": ("range = [0, 5]", "range = [5, 0]", 55, "range"),
    "two kinds": ("range = [0, 5]", 'goal = "growth < 0"', 52, "one of"),
    "no hint": ('hint = "Twice', 'unit = "Twice', 52, "hint must be a text"),
    "no see": ("### See\n\nNear", "Near", 47, "no part ### See"),
    "no question": ('```question\nask = "And', '```\nask = "And', 47, "no question"),
    "stray text": ("\n### Predict\n\n```q", "\nHello.\n\n### Predict\n\n```q", 49, "belongs under"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_told_with_its_line(name, tmp_path, caplog):
    old, new, line, reason = FAULTS[name]
    assert old in EXAMPLE
    text = EXAMPLE.replace(old, new, 1)
    with pytest.raises(LessonError, match=re.escape(reason)) as caught:
        parse(text, "x")
    assert caught.value.line == line
    (tmp_path / "broken.md").write_text(text, encoding="utf-8")
    (tmp_path / "good.md").write_text(EXAMPLE, encoding="utf-8")
    lessons, problems = read_folder(tmp_path)
    assert [one.key for one in lessons] == ["good"]
    assert [(one.file, one.line) for one in problems] == [("broken.md", line)]


def test_a_question_without_one_answer_is_a_fault(tmp_path):
    for old, new, reason in [
        ("whirl.1F < whirl.1F@before", "whirl.1F > whirl.1F@before", "0 choices are right"),
        ("tongue.1B+1F.centre", "critical.forward.9", "no number"),
        ("range = [0, 5]", "range = [3, 5]", "out of its range"),
        ("tongue.1B+1F.centre", "tongue.1F+1B.centre", "no such pair"),
    ]:
        path = tmp_path / "lesson.md"
        path.write_text(EXAMPLE.replace(old, new), encoding="utf-8")
        assert reason in str(read_file(path))
    with pytest.raises(Unanswerable, match="choices"):
        solution(parse(EXAMPLE.replace("1F < whirl", "1F > whirl"), "x").steps[0])


def test_the_library_reports_skips_and_replaces(tmp_path, caplog, monkeypatch):
    (tmp_path / "zz-own.md").write_text(EXAMPLE, encoding="utf-8")
    (tmp_path / "02-shear.md").write_text(EXAMPLE, encoding="utf-8")
    (tmp_path / "Bad Name.md").write_text(EXAMPLE, encoding="utf-8")
    (tmp_path / "bytes.md").write_bytes(b"+++\ntitle\xff")
    (tmp_path / "long.md").write_text("x" * 500_000, encoding="utf-8")
    (tmp_path / "folder.md").mkdir()
    (tmp_path / "README.md").write_text("no lesson", encoding="utf-8")
    found = collect(str(tmp_path))
    assert list(found.lessons) == [*LESSONS, "zz-own"]
    assert found.lessons["02-shear"].title == "Tune the shaft"
    assert found.foreign == {"02-shear", "zz-own"}
    files = {one.file for one in found.problems}
    assert files == {"Bad Name.md", "bytes.md", "long.md", "folder.md"}

    monkeypatch.setenv(VARIABLE, str(tmp_path))
    library.cache_clear()
    with caplog.at_level(logging.ERROR):
        for _ in range(2):
            library()
    library.cache_clear()
    assert len(caplog.records) == 4
    assert "bytes.md:2: the file is not UTF-8 text" in caplog.text
    (problem,) = collect(str(tmp_path / "none")).problems
    assert problem.reason.startswith("cannot be read")


def test_the_checker_prints_answers_and_faults(tmp_path, capsys):
    path = tmp_path / "tune.md"
    path.write_text(EXAMPLE, encoding="utf-8")
    assert main([str(path)]) == 0
    assert "2. How far?: 1.427" in capsys.readouterr().out
    path.write_text("nothing", encoding="utf-8")
    assert main([str(tmp_path)]) == 1
    assert "tune.md:1: the file must begin" in capsys.readouterr().err
    assert main([]) == 2


def only_faults(text):
    fault = None
    try:
        parse(text, "x")
    except LessonError as error:
        fault = error
    if fault:
        assert 1 <= fault.line <= text.count("\n") + 2
        assert fault.reason


@given(st.text(max_size=300))
def test_garbage_is_refused_with_words(text):
    only_faults(text)
    only_faults("+++\n" + text + "\n+++\n")
    only_faults('+++\ntitle = "a"\nsummary = "b"\n+++\n' + text)
    only_faults(EXAMPLE.replace("static_load_factor = 0.5", text))
    only_faults(EXAMPLE.replace('answer = "tongue.1B+1F.centre"', text))


@given(st.integers(0, len(EXAMPLE)), st.integers(0, 80), st.text(max_size=30))
def test_a_damaged_lesson_is_refused_with_words_or_read(start, length, text):
    only_faults(EXAMPLE[:start] + text + EXAMPLE[start + length :])


words = st.sampled_from(
    ["whirl.1F", "growth@before", "+", "-", "*", "/", "<", ">", "=", "2", "-3.5", "1e9", "()", "@"]
)


@given(st.lists(words, max_size=8).map(" ".join) | st.text(max_size=40))
def test_no_text_is_executed_or_raises_anything_else(text):
    for read in (read_expression, read_condition):
        try:
            made = read(text)
        except ValueError:
            continue
        for value in (0.0, 1.0):
            if read is read_expression:
                assert isinstance(made.value(lambda name, case, value=value: value), float)


def test_comparisons_leave_exactly_one_of_three():
    values = {"growth": 1.0, "threshold": 1.005, "tongues": 1.2, "unstable": 0.0}
    for name in values:
        for other in values:
            held = [
                read_condition(f"{name} {relation} {other}").holds(lambda n, _: values[n], 0.01)
                for relation in "<=>"
            ]
            assert sum(held) == 1
    assert read_condition("growth = threshold").holds(lambda n, _: values[n], 0.01)
    with pytest.raises(ValueError, match="no value"):
        read_condition("growth > 0").holds(lambda *_: math.nan, 0.01)


HOSTILE = [
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "a <b onmouseover=alert(1)>b</b>",
    "[x](javascript:alert(1))",
    "[x](JaVaScRiPt:alert(1))",
    "[x](data:text/html,<script>alert(1)</script>)",
    "[x](vbscript:x)",
    "![x](http://elsewhere.example/spy.png)",
    "![x](x onerror=alert(1))",
    "<javascript:alert(1)>",
    '[x](http://a.example "\\" onmouseover=alert(1) x=\\"")',
    "[x]\n\n[x]: javascript:alert(1)",
    "`<script>` and ```<script>```",
    "~~~html\n<script>alert(1)</script>\n~~~",
    "| <script> | b |\n|---|---|\n| c_<img> | d |",
    "β_<script>",
    "&lt;script&gt; &#60;script&#62;",
    "{{ 7 * 7 }} {% raw %}",
]
ALLOWED = {"p", "strong", "em", "a", "code", "pre", "ul", "ol", "li", "blockquote", "hr", "br", "b"}
ALLOWED |= {"table", "thead", "tbody", "tr", "th", "td", "span", "sub", "h4", "h5", "h6"}
ATTRIBUTES = {
    "a": {"href", "title", "target", "rel"},
    "span": {"class"},
    "code": {"class"},
    "ol": {"start"},
    "th": {"style"},
    "td": {"style"},
}


def assert_inert(html):
    from html.parser import HTMLParser

    class Reader(HTMLParser):
        def handle_starttag(self, tag, attributes):
            assert tag in ALLOWED, html
            for name, value in attributes:
                assert name in ATTRIBUTES.get(tag, set()), html
                if name == "href":
                    assert re.match(r"https?://|#|$", value), html

    Reader().feed(html)


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_markdown_is_inert(text):
    assert_inert(render(tokens(text)))
    assert_inert(inline(text))
    lesson = parse(EXAMPLE.replace("Move α_s to 0.5.", text), "x")
    assert_inert(lesson.steps[0].try_)
    single = json.dumps(text.replace("\n", " "), ensure_ascii=False)
    spoilt = EXAMPLE.replace('"It rises"', single).replace('"A guitar string is pulled."', single)
    lesson = parse(spoilt, "x")
    assert_inert(lesson.steps[0].question.choices[0].text)
    assert_inert(lesson.steps[0].question.choices[0].hint)


@given(st.lists(st.sampled_from([*HOSTILE, "\n", "*", "_", "[", "](", ")", "<", '"', "`", "# "])))
def test_no_mixture_of_hostile_pieces_comes_alive(pieces):
    assert_inert(render(tokens("".join(pieces)).copy()).replace("<h1>", "").replace("<h2>", ""))


# -- a session without a browser --------------------------------------------------------


@pytest.fixture(scope="module")
def shared():
    return Session()


@pytest.fixture
def session(shared):
    shared.respond({"type": "lesson-end"})
    shared.respond({"type": "page", "name": "explore"})
    shared.respond({"type": "reset"})
    return shared


def test_a_lesson_walks_in_a_session(session):
    session.respond({"type": "change", "values": {"disk_mass": 9.0}})
    answer = session.respond({"type": "lesson", "lesson": "04-gyroscope", "step": 2})
    json.dumps(answer, allow_nan=False)
    lesson, step = answer["lesson"], LESSONS["04-gyroscope"].steps[2]
    assert answer["values"] == step.before
    assert answer["values"]["disk_mass"] == State().disk_mass
    assert (lesson["step"], lesson["kind"]) == (2, "number")
    assert "2.031" not in json.dumps(lesson)
    assert answer["lesson_numbers"]["whirl.1F"] == "0.9092"

    wrong = session.respond({"type": "lesson-answer", "value": "5"})["lesson_answer"]
    assert (wrong["right"], wrong["words"]) == (False, step.question.hint)
    no_number = session.respond({"type": "lesson-answer", "value": "x"})["lesson_answer"]
    assert not no_number["counted"]
    right = session.respond({"type": "lesson-answer", "value": "2,03"})["lesson_answer"]
    assert right["right"]
    assert "2.031" in session.respond({"type": "lesson-show"})["lesson_answer"]["words"]

    # the numbers follow the sliders, the answers do not
    moved = session.respond({"type": "change", "values": {"spin_speed": 2.0}})
    assert moved["lesson_numbers"]["whirl.1F"] == "1.073"
    assert session.respond({"type": "lesson-answer", "value": 2.03})["lesson_answer"]["right"]

    assert "lesson_numbers" not in session.respond({"type": "lesson-end"})
    assert "lesson_answer" not in session.respond({"type": "lesson-answer", "value": 2.03})


def test_try_sets_its_parameters_and_a_goal_asks_the_sliders(session):
    session.respond({"type": "lesson", "lesson": "07-damping", "step": 1})
    ask = {"type": "lesson-answer", "value": ""}
    assert not session.respond(ask)["lesson_answer"]["right"]
    session.respond({"type": "change", "values": {"external_damping": 0.2}})
    assert session.respond(ask)["lesson_answer"]["right"]
    answer = session.respond({"type": "lesson-set"})
    assert answer["values"] == LESSONS["07-damping"].steps[1].after
    assert session.respond(ask)["lesson_answer"]["right"]


def test_a_kept_lesson_leaves_the_sliders(session):
    session.respond({"type": "change", "values": {"disk_mass": 9.0}})
    answer = session.respond(
        {"type": "lesson", "lesson": "01-parametric-resonance", "step": 0, "keep": True}
    )
    assert answer["values"]["disk_mass"] == 9.0


def test_the_end_of_a_lesson_brings_back_what_was_set_before_it(session):
    session.respond({"type": "change", "values": {"spin_speed": 1.7, "show_bolotin": True}})
    before = session.state.inputs()
    for step in (0, 1):
        session.respond({"type": "lesson", "lesson": "01-parametric-resonance", "step": step})
    assert session.state.inputs() != before
    session.respond({"type": "lesson-end"})
    assert session.state.inputs() == before


def test_an_unknown_lesson_is_told(session):
    for key in ("none", "../x", 5, "", None, True, "x" * 10_000):
        answer = session.respond({"type": "lesson", "lesson": key, "step": 0})
        assert answer["lesson"] is None
        assert "no such lesson" in answer["toast"]


anything = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=12)


@given(
    st.fixed_dictionaries(
        {
            "type": st.sampled_from(
                ["lesson", "lesson-answer", "lesson-set", "lesson-show", "lesson-end"]
            )
        },
        optional={
            "lesson": st.sampled_from(list(LESSONS)) | anything,
            "step": st.integers(-3, 9) | anything,
            "value": anything | st.lists(anything, max_size=2) | st.just(np.ones(2)),
            "keep": anything,
        },
    )
)
def test_no_lesson_message_raises(shared, message):
    answer = shared.respond(message)
    json.dumps(answer, allow_nan=False)
    assert answer["notice"] == ""


def test_a_number_out_of_its_range_is_asked_again():
    step = library().lessons["01-parametric-resonance"].steps[0]
    for value in ("-2", 9):
        found = grade(step, value, step.after)
        assert not found.right
        assert not found.counted
        assert "from 0 to 5" in found.words


def shown(line):
    """Return the show block of the example's first step, with a line more in it."""
    return parse(EXAMPLE.replace("```show\n", f"```show\n{line}\n", 1), "a").steps[0].show


def test_a_step_may_cover_its_charts():
    assert shown("cover = true").cover == ("load-frequency",)
    assert shown('cover = "load-frequency"').cover == ("load-frequency",)
    assert shown("cover = false").cover == parse(EXAMPLE, "a").steps[0].show.cover == ()
    for line, reason in [
        ("cover = 5", "cover must be true, false or a list"),
        ('cover = ["campbell"]', "cover: there is no 'campbell'"),
    ]:
        with pytest.raises(LessonError, match=reason) as caught:
            shown(line)
        assert caught.value.line == 17


def test_a_step_may_give_a_slider_its_own_range():
    show = shown("sliders = { spin_speed = [0, 2, 0.05] }")
    assert show.move == ("static_load_factor", "spin_speed")
    assert show.sliders == {"spin_speed": (0.0, 2.0, 0.05)}
    for value, reason in [
        ("5", "a table of up to eight"),
        ("{ spin = [0, 2, 0.1] }", "there is no number 'spin'"),
        ("{ marker = [0, 1, 1] }", "there is no number 'marker'"),
        ("{ spin_speed = [0, 2] }", "three numbers"),
        ('{ spin_speed = [0, 2, "x"] }', "three numbers"),
        ("{ spin_speed = [2, 0, 0.1] }", "[low, high, step] within 0 to 4"),
        ("{ spin_speed = [0, 9, 0.1] }", "within 0 to 4"),
        ("{ spin_speed = [0, 2, 0] }", "within 0 to 4"),
        ("{ spin_speed = [0, 2, nan] }", "within 0 to 4"),
        ("{ spin_speed = [1, 2, 0.1] }", "spin_speed is 0 when the step begins"),
        ("{ static_load_factor = [0, 0.8, 0.1] }", "is in move already"),
    ]:
        with pytest.raises(LessonError, match=re.escape(reason)) as caught:
            shown(f"sliders = {value}")
        assert caught.value.line == 17
    # what Try sets lies on the slider too
    text = EXAMPLE.replace("move = ", "sliders = { static_load_factor = [0, 0.4, 0.1] }\n#")
    with pytest.raises(LessonError, match=r"0\.5 after Try"):
        parse(text, "a")


def test_a_step_shows_what_it_names_and_without_names_the_charts():
    text = EXAMPLE.replace('"load-frequency"', '["campbell", "inspector"]')
    panel = ("shaft", "response", "multipliers", "orbit")
    assert parse(text, "a").steps[0].show.look == ("campbell", *panel)
    everything = parse(EXAMPLE, "a").steps[1].show
    assert everything.look == everything.charts == ("instability", "load-frequency", "campbell")
    text = EXAMPLE.replace('"load-frequency"', '["shaft"]')
    with pytest.raises(LessonError, match="shaft needs a marked point"):
        parse(text, "a")
    marked = text.replace("spin_speed = 0.0", "marker = true")
    assert parse(marked, "a").steps[0].show.look == ("shaft",)


@pytest.mark.parametrize(("lesson", "index"), STEPS)
def test_each_slider_reaches_what_its_step_sets(lesson, index):
    step = lesson.steps[index]
    for name in step.show.move:
        if not isinstance(step.before[name], float):
            continue
        low, high, size = step.show.sliders[name]
        for value in (step.before[name], step.after[name]):
            assert low <= value <= high
            assert (value - low) / size == pytest.approx(round((value - low) / size)), name
    # nothing else moves while an answer is shown
    moved = {name for name, value in step.after.items() if value != step.before[name]}
    assert moved <= {*step.show.move, "show_disagreement"}


def test_a_power_is_no_part_of_a_subscript():
    assert plain("ω_n²") == '<span class="symbol">ω<sub>n</sub></span>²'


def test_a_width_tells_its_load():
    session = Session()
    session.respond({"type": "page", "name": "explore"})
    answer = session.respond({"type": "lesson", "lesson": "04-gyroscope", "step": 3})
    assert answer["lesson_numbers"]["tongue.1B+1F.width"].endswith(" at β_d = 0.5")


def test_a_panel_of_the_marked_point_without_a_point_lets_the_student_mark_one(
    tmp_path, monkeypatch
):
    text = EXAMPLE.replace('"load-frequency"', '["instability", "inspector"]')
    (tmp_path / "own.md").write_text(text, encoding="utf-8")
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    library.cache_clear()
    session = Session()
    free = [
        session.respond({"type": "lesson", "lesson": "own", "step": step})["lesson"]["free"]
        for step in (0, 1)
    ]
    library.cache_clear()
    marker = ["marker", "marker_frequency", "marker_factor"]
    assert free == [["static_load_factor", *marker], []]


def test_colours_can_be_compared_within_a_step():
    session = Session()

    def top():
        return (
            session.pages["explore"]
            .charts["instability"]
            .renderers["unstable"]
            .glyph.fill_color.transform.high
        )

    session.respond({"type": "lesson", "lesson": "04-gyroscope", "step": 3})
    before = top()
    session.respond({"type": "change", "values": {"spin_speed": 3.0}})
    assert top() == before
    session.respond({"type": "lesson-end"})
    session.respond({"type": "change", "values": {"spin_speed": 3.0, "static_load_factor": 0.0}})
    assert top() == before
    # only who asks for it gets another scale
    session.respond({"type": "colours", "fit": True})
    assert top() != before


def test_a_goal_counts_the_sliders_of_its_step_only():
    step = LESSONS["07-damping"].steps[5]
    damped = step.before | {"external_damping": step.after["external_damping"]}
    assert grade(step, "", damped).right
    slow = grade(step, "", step.before | {"spin_speed": 0.5})
    assert not slow.right
    assert "other sliders" in slow.words
    assert grade(step, "", step.before).words == step.question.hint


def test_a_choice_that_shows_a_slider_is_offered_with_the_slider_only():
    """Partly follower asks for the tangency, which the step must let the student move."""
    for lesson in LESSONS.values():
        for index, step in enumerate(lesson.steps):
            for control in describe(lesson, index)["move"]:
                if control["name"] == "load_type":
                    offered = "partly" in [value for value, _ in control["options"]]
                    used = "partly" in (step.before["load_type"], step.after["load_type"])
                    assert offered == (used or "tangency" in step.show.move)


def test_pins_are_not_drawn_beside_a_lesson_and_come_back_after_it():
    session = Session()
    session.respond({"type": "hello"})
    session.respond({"type": "change", "values": {"spin_speed": 0.6}})
    session.respond({"type": "pin", "label": "mine"})
    session.respond({"type": "change", "values": {"spin_speed": 1.2}})
    chart = session.pages["explore"].charts["load-frequency"]
    assert len(chart.sources["pins"].data["xs"])
    query = session.query()
    answer = session.respond({"type": "lesson", "lesson": "04-gyroscope", "step": 0})
    assert answer["pins"] is None
    assert not len(chart.sources["pins"].data["xs"])
    assert session.query().count("mine") == query.count("mine") == 1
    assert session.respond({"type": "lesson-end"})["pins"]
    assert len(chart.sources["pins"].data["xs"])
