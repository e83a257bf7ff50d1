"""What the README shows works as it stands."""

import ast
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from rotorstab.cli.parser import main

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PYTHON = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
COMMANDS = re.findall(r"^\.venv/bin/rotorstab (.*?)(?:  +#.*)?$", README, re.MULTILINE)


def test_the_python_blocks_run_and_give_what_their_comments_say():
    names: dict[str, object] = {}
    source = "".join(PYTHON)
    lines = source.splitlines()
    checked = 0
    for node in ast.parse(source).body:
        code = ast.get_source_segment(source, node)
        comment = re.search(r"# ([−\d].*)$", lines[node.end_lineno - 1])
        if isinstance(node, ast.Expr) and comment:
            value = np.ravel(eval(code, names))
            told = [float(text) for text in re.findall(r"-?\d+\.\d+", comment[1].replace("−", "-"))]
            np.testing.assert_allclose(value, told, atol=5.1e-5)
            checked += 1
        else:
            exec(code, names)
    assert checked >= 3
    assert names["tongue"].name == "2B+2F"


@pytest.mark.parametrize("command", COMMANDS)
def test_the_commands_run(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    # tables are enough here: pictures have their own tests
    words = shlex.split(command.replace("fig6.pdf", "fig6.csv"))
    assert main(words) == 0
    assert capsys.readouterr().out or list(tmp_path.iterdir())


def test_every_file_that_is_linked_is_there():
    for target in re.findall(r"\]\((docs/[^)]+)\)", README):
        assert (ROOT / target).is_file(), target
