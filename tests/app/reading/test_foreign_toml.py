"""TOML from outside: bounded before it is parsed, and its faults said in words."""

import signal
import tomllib
import tracemalloc

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.lessons.tables import LessonError, Table
from app.reading.toml import MOST_LEVELS, read_toml
from app.state.rotor_file import LARGEST_FILE, read_rotor_file

ROOM = LARGEST_FILE - 100
BOMBS = {
    "dotted key": ".".join("a" * (ROOM // 2)) + "=1",
    "spaced dots": " . ".join("a" * (ROOM // 4)) + "=1",
    "dotted table": "[" + ".".join("a" * (ROOM // 2)) + "]",
    "dotted array of tables": "[[" + ".".join("a" * (ROOM // 2)) + "]]",
    "quoted keys": ".".join(['"a"'] * (ROOM // 4)) + "=1",
    "literal keys": ".".join(["'a'"] * (ROOM // 4)) + "=1",
    "inline table": "b={" + ".".join("a" * (ROOM // 2)) + "=1}",
    "after a text": 'b="""x"""\n' + ".".join("a" * (ROOM // 2)) + "=1",
    "after a text with quotes": 'b="""x\\"""""\n' + ".".join("a" * (ROOM // 2)) + "=1",
    "within texts with quotes": 'b=["""x"""", {' + ".".join("a" * (ROOM // 2)) + '="1"}]',
    "within literal texts with quotes": "b=['''x'''', {" + ".".join("a" * (ROOM // 2)) + "='1'}]",
    "arrays": "a=" + "[" * (ROOM // 2) + "]" * (ROOM // 2),
    "inline tables": "a=" + "{a=" * (ROOM // 4) + "1" + "}" * (ROOM // 4),
    "many of nine": "\n".join(f"{'.'.join('abcdefghi')}{n}=1" for n in range(ROOM // 24)),
}


@pytest.mark.parametrize("text", BOMBS.values(), ids=BOMBS)
def test_a_bomb_is_refused_before_it_is_parsed(text, monkeypatch):
    assert len(text) <= LARGEST_FILE
    monkeypatch.setattr(tomllib, "loads", lambda text: pytest.fail("it was parsed"))
    with pytest.raises(ValueError, match=f"nested deeper than {MOST_LEVELS} levels"):
        read_rotor_file(text)
    with pytest.raises(LessonError, match=f"nested deeper than {MOST_LEVELS} levels"):
        Table(text, 1).read()


WORST = {
    "one level less": "\n".join(f"{'.'.join('abcdefg')}.h{n}=1" for n in range(ROOM // 22)),
    "tables": "\n".join(f"[{'.'.join('abcdefg')}.h{n}]" for n in range(ROOM // 24)),
    "arrays of tables": "[[a.b.c.d.e.f.g]]\n" * (ROOM // 18),
    "keys": "\n".join(f"a{n}=1" for n in range(ROOM // 8)),
    "numbers": "a=[" + "1," * (ROOM // 2 - 3) + "]",
    "digits": "a=" + "9" * ROOM,
    "hexadecimal": "a=0x" + "f" * ROOM,
    "unclosed texts": "a=" + "'\"" * (ROOM // 2),
    "unclosed long texts": 'a="""' + "'''" * (ROOM // 3),
    "backslashes": 'a="' + "\\" * ROOM,
    "comments": "#\n" * (ROOM // 2),
    "dates": "a=[" + "1979-05-27," * (ROOM // 12) + "]",
}


@pytest.mark.parametrize("text", WORST.values(), ids=WORST)
def test_the_worst_that_is_parsed_stays_small(text):
    tracemalloc.start()
    try:
        with pytest.raises(ValueError, match=r"line|lacks|is unknown"):
            read_rotor_file(text)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10e6  # a bomb of the same length took hundreds


LONG = 100_000  # characters; the square of it is minutes of work
FLAT = {
    "spaces in a value": "a=1" + " " * LONG + "m",
    "spaces between words": "a=1 b" + (" " * 9 + "x") * (LONG // 10),
    "escaped quotes in a long text": 'a="""' + '\\"' * (LONG // 2),
    "escaped quotes in a text": 'a="' + '\\"' * (LONG // 2),
    "long texts that are not closed": "a=" + "'''\"\n" * (LONG // 5) + "''",
    "quotes of both kinds": "a=" + "\"'" * (LONG // 2),
    "spaces between dots": "a" + " " * LONG + ".b" + " " * LONG,
    "no equals sign": "a " * (LONG // 2),
}


@pytest.mark.parametrize("text", FLAT.values(), ids=FLAT)
def test_the_work_does_not_grow_with_the_square_of_the_length(text):
    def give_up(number, frame):
        raise RuntimeError("the work grows with the square of the length")

    before = signal.signal(signal.SIGVTALRM, give_up)
    signal.setitimer(signal.ITIMER_VIRTUAL, 10)
    try:
        with pytest.raises(ValueError, match=r"^line "):
            read_toml(text)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def test_what_teachers_and_technicians_write_is_no_bomb():
    text = '''
    title = "1. 2. 3. 4. 5. 6. 7. 8. 9. 10. 11. [[[[[[[[[[[[ {{{{{{{{{{{{ a.b.c.d.e.f.g.h.i.j"
    summary = """
    a.b.c.d.e.f.g.h.i.j = 1 [[[[[[[[[[[[
    """ # [[[[[[[[[[[[[[[[ a.b.c.d.e.f.g.h.i.j.k
    literal = \'\'\'a.b.c.d.e.f.g.h.i.j \'\'\'
    path = 'C:\\a.b.c.d.e.f.g.h.i.j'
    numbers = [[1.0, 2.0], [3.0, 4.0], [1.5, 2.5], [1.0, 2.0], [3.0, 4.0], [1.5, 2.5]]
    [table.of.tables]
    a.b = 1.5
    '''
    assert read_toml(text) == tomllib.loads(text)


@given(st.text("ab.[]{}='\"\\\n# 1,", max_size=60) | st.text(max_size=60))
def test_what_is_read_is_what_tomllib_reads(text):
    try:
        expected = tomllib.loads(text.replace("\r\n", "\n").replace("\r", "\n"))
    except ValueError:
        expected = None
    try:
        found = read_toml(text)
    except ValueError as error:
        found, words = None, str(error)
    else:
        words = ""
    assert words.isprintable()
    assert "set_int_max" not in words
    assert found == expected or "nested deeper" in words


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("a = 1\nb = " + "9" * 5000, 2, "a number has too many digits"),
        ("a = 1\nb = 0,5", 2, "write a number with a point, 0.5, not with a comma"),
        ("a = 0,5 # half", 1, "with a point, 0.5,"),
        ("a = 1,200", 1, "a number has no comma: '1,200' can mean 1.2 or 1200"),
        ("a = 20 mm", 1, 'a quantity is a text in quotes: "20 mm"'),
        ("a = 20mm", 1, 'a quantity is a text in quotes: "20mm"'),
        ("a = steel", 1, 'a name is a text in quotes: "steel"'),
        ("a = “20 mm”", 1, 'write straight quotes, " instead of “'),
        ("\na = 2001-99-99", 2, "not TOML"),
        ("a = [\n1,\n", 3, "not TOML"),
        ("a = 1\n\n[b", 3, "not TOML"),
        ("a = 1\na = 2", 2, "not TOML: Cannot overwrite"),
        ("a\x00 = 1", 1, "not UTF-8 text"),
        ("\ufffdPNG", 1, "not UTF-8 text"),
        ("\ud800 = 1", 1, "not TOML"),
    ],
)
def test_a_fault_is_said_in_words_with_its_line(text, line, words):
    with pytest.raises(ValueError, match=f"^line {line}: ") as caught:
        read_toml(text)
    assert words in str(caught.value)
    assert str(caught.value).isprintable()
    with pytest.raises(LessonError) as again:
        Table(text, 11).read()
    assert again.value.line == 10 + line
    assert words in again.value.reason


def test_a_byte_order_mark_and_windows_lines_are_read():
    assert read_toml("\ufeffa = 1\r\nb = 2\r\n") == {"a": 1, "b": 2}
