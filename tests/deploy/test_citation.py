"""CITATION.cff names the version and the licence of pyproject.toml, and the paper."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_the_citation_agrees_with_the_project():
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    for name in ("version", "license"):
        assert re.search(rf"^{name}: (.+)$", citation, re.M)[1] == project[name]
    assert "family-names: Sheu" in citation
