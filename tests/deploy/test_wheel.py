"""The wheel: it contains the dashboard and its server whole, and says how to start them."""

import ast
import configparser
import email
import subprocess
import sys
import tomllib
import zipfile
from importlib.metadata import EntryPoint, packages_distributions
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from deploy.command import NEEDED

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads(ROOT.joinpath("pyproject.toml").read_text("utf-8"))["project"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The open wheel of this source tree."""
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", folder],
        cwd=ROOT,
        check=True,
        capture_output=True,
    )
    (path,) = folder.glob("rotorstab-*.whl")
    with zipfile.ZipFile(path) as archive:
        yield archive


def metadata_file(wheel, name):
    """The text of a file of the wheel's metadata."""
    (path,) = (path for path in wheel.namelist() if path.endswith(f".dist-info/{name}"))
    return wheel.read(path).decode()


def sources(folder):
    """Paths of the files below a folder of the source tree, as the wheel should name them."""
    base = ROOT / "src" if (ROOT / "src" / folder).is_dir() else ROOT
    return {
        str(path.relative_to(base))
        for path in (base / folder).rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }


@pytest.mark.parametrize("package", ["rotorstab", "app", "deploy"])
def test_a_package_is_in_the_wheel_with_all_its_files(wheel, package):
    packed = {name for name in wheel.namelist() if name.startswith(f"{package}/")}
    assert packed == sources(package)


@pytest.mark.parametrize(
    "name",
    [
        "app/main.py",
        "app/assets/page.html",
        "app/assets/page.js",
        "app/lessons/01-parametric-resonance.md",
        "deploy/nginx.conf.j2",
        "deploy/setup.py",
        "rotorstab/py.typed",
    ],
)
def test_files_that_are_no_modules_are_in_the_wheel(wheel, name):
    assert wheel.getinfo(name).file_size > 0 or name.endswith("py.typed")


def test_nothing_but_the_three_packages_is_in_the_wheel(wheel):
    folders = {name.partition("/")[0] for name in wheel.namelist()}
    assert {name for name in folders if not name.endswith(".dist-info")} == {
        "rotorstab",
        "app",
        "deploy",
    }


def test_the_wheel_names_its_program_and_its_command(wheel):
    entries = configparser.ConfigParser()
    entries.read_string(metadata_file(wheel, "entry_points.txt"))
    assert set(entries["console_scripts"]) == {"rotorstab"}
    assert set(entries["rotorstab.commands"]) == {"serve"}
    for group in entries.sections():
        for name, value in entries[group].items():
            assert callable(EntryPoint(name, value, group).load())


def test_the_library_alone_needs_numpy_and_scipy_only(wheel):
    found = email.message_from_string(metadata_file(wheel, "METADATA"))
    required = map(Requirement, found.get_all("Requires-Dist"))
    assert {one.name for one in required if one.marker is None} == {"numpy", "scipy"}


def test_the_command_looks_for_all_that_its_extra_installs():
    names = [Requirement(text).name for text in PROJECT["optional-dependencies"]["app"]]
    distributions = packages_distributions()
    found = {canonicalize_name(name) for module in NEEDED for name in distributions[module]}
    assert found == {canonicalize_name(name) for name in names}


def imported_modules(path):
    """Top-level names of the modules that a file imports, other than its neighbours."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name.partition(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.partition(".")[0]


def test_the_extra_names_all_that_the_dashboard_and_its_server_import():
    paths = [path for folder in ("app", "deploy") for path in (ROOT / folder).rglob("*.py")]
    imported = {name for path in paths for name in imported_modules(path)}
    library = {"numpy", "scipy", "rotorstab", "app", "deploy"}
    assert imported - sys.stdlib_module_names - library <= set(NEEDED)
