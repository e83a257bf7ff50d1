"""The versions of the libraries that are patched are bounded, and a moved part is named."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from panel.custom import JSComponent

from deploy.patches import patching
from deploy.patches.versions import OVERRIDDEN, PATCHED, moved, unknown
from tests.testing.serving import free_port

ROOT = Path(__file__).parents[2]
REQUIRED = tomllib.loads(ROOT.joinpath("pyproject.toml").read_text("utf-8"))["project"][
    "optional-dependencies"
]["app"]


def test_each_library_that_is_patched_has_a_floor_and_a_ceiling():
    bounds = {one.name: str(one.specifier) for one in map(Requirement, REQUIRED)}
    for name in {*PATCHED, *patching.PATCHED}:
        assert ">=" in bounds[name]
        assert "<" in bounds[name].replace(">=", "")


def test_a_version_beyond_the_bounds_is_named():
    def next_year(name):
        return "99.0"

    libraries = unknown(REQUIRED, next_year)
    assert len(libraries) == len(PATCHED)
    assert "panel 99.0 (made for <1.11,>=1.9.0)" in libraries
    assert unknown(REQUIRED, floor) == []
    assert unknown([], next_year) == []


@pytest.mark.parametrize("name", OVERRIDDEN)
def test_a_method_that_the_page_overrides_and_panel_has_no_more_is_named(monkeypatch, name):
    assert moved() == []
    (owner,) = (kind for kind in JSComponent.__mro__ if name in vars(kind))
    monkeypatch.delattr(owner, name)
    assert moved() == [f"panel.custom.JSComponent has no {name}"]


def floor(name):
    """Return the lowest version that is allowed."""
    (found,) = (one for one in map(Requirement, REQUIRED) if one.name == name)
    return next(one.version for one in found.specifier if one.operator == ">=")


MOVED = """
import runpy, sys
import {module} as module
del module.{name}
sys.argv = ["deploy/worker.py", {app!r}]
runpy.run_module("deploy.worker", run_name="__main__")
"""


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("bokeh.server.views.ws", "WSHandler._receive"),  # is replaced
        ("panel.io.location", "_get_location_params"),  # is called by what replaces it
        ("panel.models.esm", "ReactiveESM"),  # is imported
    ],
)
def test_a_server_that_cannot_be_hardened_does_not_start(tmp_path, module, name):
    app = tmp_path / "app.py"
    app.write_text("")
    done = subprocess.run(
        [sys.executable, "-c", MOVED.format(module=module, name=name, app=str(app))],
        cwd=ROOT,
        env=os.environ | {"PORT": str(free_port()), "BOKEH_SECRET_KEY": "x" * 40},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith("rotorstab: cannot harden this server, panel ")
    assert name.rpartition(".")[2] in line
