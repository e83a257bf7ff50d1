"""CITATION.cff agrees with pyproject.toml; the documents on serving name files that exist."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("", "deploy", "deploy/patches", "tests/deploy")


def test_the_citation_agrees_with_the_project():
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    for name in ("version", "license"):
        assert re.search(rf"^{name}: (.+)$", citation, re.M)[1] == project[name]
    assert "family-names: Sheu" in citation


@pytest.mark.parametrize("document", ["SECURITY.md", "docs/deploy.md"])
def test_every_file_that_a_document_names_exists(document):
    text = (ROOT / document).read_text("utf-8")
    names = set(re.findall(r"`([A-Za-z_./-]+\.(?:py|sh|md|js|j2|toml|service))`", text))
    assert names
    missing = {
        name for name in names if not any((ROOT / folder / name).exists() for folder in FOLDERS)
    }
    assert missing == set()
