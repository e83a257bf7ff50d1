"""What the documents show works as it stands, and what they name is there."""

import ast
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from rotorstab.cli.parser import main

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = sorted(path for path in (*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")))
TEXTS = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in DOCUMENTS}
LIBRARY = "docs/library.md"
COMMANDS = sorted(
    {
        command
        for name in ("README.md", "docs/command_line.md")
        for command in re.findall(
            r"^ *(?:.*`)?\.venv/bin/rotorstab ([^`\n]*?)(?:`.*|  +#.*)?$", TEXTS[name], re.MULTILINE
        )
    }
)
MAPS = ("CONTRIBUTING.md", "docs/architecture.md", "SECURITY.md")
TOP = "|".join(path.name for path in ROOT.iterdir() if path.is_dir() and path.name[0] != ".")


def test_the_python_blocks_run_and_give_what_their_comments_say():
    names: dict[str, object] = {}
    source = "".join(re.findall(r"```python\n(.*?)```", TEXTS[LIBRARY], re.DOTALL))
    lines = source.splitlines()
    checked = 0
    for node in ast.parse(source).body:
        code = ast.get_source_segment(source, node)
        comment = re.search(r"# ([−\d].*)$", lines[node.end_lineno - 1])
        if isinstance(node, ast.Expr) and comment:
            value = np.ravel(eval(code, names))
            written = comment[1].replace("−", "-")
            numbers = [float(text) for text in re.findall(r"-?\d+\.\d+", written)]
            np.testing.assert_allclose(value, numbers, atol=5.1e-5)
            checked += 1
        else:
            exec(code, names)
    assert checked >= 3
    assert names["tongue"].name == "2B+2F"


# `serve` runs until it is ended: tests/deploy/test_command.py starts it
@pytest.mark.usefixtures("shared_paper")
@pytest.mark.parametrize("command", [one for one in COMMANDS if one.split()[0] != "serve"])
def test_the_commands_run(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    # tables are enough here: pictures have their own tests
    words = shlex.split(command.replace("fig6.pdf", "fig6.csv").replace("LINK", "as=0.5&spin=2"))
    assert main(words) == 0
    assert capsys.readouterr().out or list(tmp_path.iterdir())


def test_the_documents_show_commands():
    assert len(COMMANDS) >= 7


def anchors(text: str) -> set[str]:
    """Return the anchors of a document's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    plain = [re.sub(r"[^\w\- ]", "", heading.lower()) for heading in headings]
    return {heading.replace(" ", "-") for heading in plain}


@pytest.mark.parametrize("name", TEXTS)
def test_every_link_leads_to_a_file_and_a_heading(name):
    outside_of_code = re.sub(r"^(`{3,}).*?^\1", "", TEXTS[name], flags=re.DOTALL | re.MULTILINE)
    for target in re.findall(r"\]\((?!https?:)([^)\s]+)\)", outside_of_code):
        path, _, anchor = target.partition("#")
        found = (ROOT / name).parent / path if path else ROOT / name
        assert found.exists(), target
        if anchor:
            key = found.resolve().relative_to(ROOT).as_posix()
            assert anchor in anchors(TEXTS[key]), target


@pytest.mark.parametrize("name", MAPS)
def test_every_path_that_a_map_names_exists(name):
    paths = re.findall(rf"`((?:{TOP})/[\w./-]*)`", TEXTS[name])
    assert len(paths) > 15
    for path in paths:
        assert (ROOT / path).exists(), path


@pytest.mark.parametrize("row", re.findall(r"^\| (?!---|what ).*$", TEXTS[MAPS[0]], re.MULTILINE))
def test_every_name_in_the_map_stands_in_a_file_beside_it(row):
    cell = row.split("|")[2]
    paths = [ROOT / path for path in re.findall(rf"`((?:{TOP})/[\w./-]*)`", cell)]
    folders = [one for path in paths if path.is_dir() for one in path.rglob("*.*")]
    files = [path for path in (*paths, *folders) if path.suffix in {".py", ".html", ".md"}]
    code = "\n".join(path.read_text(encoding="utf-8") for path in files)
    for symbol in re.findall(r"`((?:[A-Za-z_]\w*\.)?[A-Za-z_]\w+)`", cell):
        assert re.search(rf"\b{re.escape(symbol.split('.')[-1])}\b", code), symbol
