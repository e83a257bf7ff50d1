"""The examples in the docstrings run and print what they say."""

import doctest
import importlib
import pkgutil

import pytest

import rotorstab

MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(rotorstab.__path__, "rotorstab.")
    if not module.name.endswith("__main__")
)


@pytest.mark.parametrize("name", MODULES)
def test_docstring_examples(name):
    result = doctest.testmod(importlib.import_module(name))
    assert result.failed == 0


@pytest.mark.parametrize("name", ["rotors", "model", "whirl", "bolotin", "floquet", "maps"])
def test_each_chapter_of_the_solver_has_examples(name):
    modules = [one for one in MODULES if one.startswith(f"rotorstab.{name}.")]
    assert any(doctest.testmod(importlib.import_module(one)).attempted for one in modules)
