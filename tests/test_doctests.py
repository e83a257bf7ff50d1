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


def test_the_solver_has_examples():
    solver = ("rotor", "stiffness", "system", "quartic", "whirl", "critical", "bolotin")
    for name in solver:
        module = importlib.import_module(f"rotorstab.{name}")
        assert doctest.testmod(module).attempted > 0
