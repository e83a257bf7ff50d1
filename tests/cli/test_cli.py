"""The command line: its files, its one-line errors, its exit codes."""

import csv
import errno
import json
import os
import subprocess
import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import pytest

from rotorstab.__main__ import main
from rotorstab.cli import paper_commands
from rotorstab.drawing.formats import FORMATS, PICTURE_FORMATS, TABLE_FORMATS, PictureFormat
from rotorstab.model.stiffness_law import STIFFNESS_LAWS
from rotorstab.paper import CONCLUSIONS, FIGURES

pytestmark = pytest.mark.usefixtures("shared_paper")


def rows_of(path):
    return list(csv.DictReader(x for x in path.read_text().splitlines() if x[0] != "#"))


@pytest.mark.parametrize("number", FIGURES)
def test_figure_prints_its_reading(number, capsys):
    assert main(["figure", str(number)]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"Figure {number}. ")
    assert out.count("→ agree") + out.count("→ differ") == len(FIGURES[number]().reading)


@pytest.mark.parametrize("suffix", ["pdf", "svg", "png", "csv", "json"])
def test_figure_is_written_in_every_format(suffix, tmp_path, capsys):
    path = tmp_path / f"fig2.{suffix}"
    assert main(["figure", "2", "--output", str(path)]) == 0
    assert path.stat().st_size > 1000
    assert main(["figure", "2", "--output", str(path)]) == 2
    assert capsys.readouterr().err == f"rotorstab: {path} exists; --force overwrites it\n"


def test_a_format_that_is_added_is_offered_and_written(monkeypatch, tmp_path, capsys):
    picture = PictureFormat("image/webp", lambda heading: None)
    table = replace(TABLE_FORMATS["csv"], mime="text/plain")
    monkeypatch.setitem(PICTURE_FORMATS, "webp", picture)
    monkeypatch.setitem(TABLE_FORMATS, "txt", table)
    monkeypatch.setitem(FORMATS, "webp", picture)
    monkeypatch.setitem(FORMATS, "txt", table)
    assert main(["figure", "--help"]) == 0
    assert ".pdf .svg .png .csv .json .webp .txt" in " ".join(capsys.readouterr().out.split())
    for name, beginning in (("a.webp", b"RIFF"), ("a.txt", b"# Figure 2.")):
        assert main(["figure", "2", "--output", str(tmp_path / name)]) == 0
        assert (tmp_path / name).read_bytes().startswith(beginning)
    assert main(["table1", "--output", str(tmp_path / "b.txt"), "--excel"]) == 0
    assert (tmp_path / "b.txt").read_bytes().startswith(b"\xef\xbb\xbf# Table 1")


def test_force_overwrites(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    assert main(["figure", "2", "--output", str(path), "--force"]) == 0
    assert path.read_text().startswith("# Figure 2.")


def test_all_figures_come_out_of_one_command(tmp_path, capsys):
    directory = tmp_path / "all"
    assert main(["figure", "--all", str(directory), "--formats", "csv,json"]) == 0
    names = {path.name for path in directory.iterdir()}
    stems = [f"figure_{n}" for n in range(2, 10)] + ["table_1"]
    assert names == {f"{stem}.{kind}" for stem in stems for kind in ("csv", "json")}
    assert main(["figure", "--all", str(directory), "--formats", "csv"]) == 2
    assert "figure_2.csv exists" in capsys.readouterr().err


def test_table_1(tmp_path, capsys):
    assert main(["table1"]) == 0
    assert "159.805" in capsys.readouterr().out
    path = tmp_path / "t.json"
    assert main(["table1", "--output", str(path)]) == 0
    assert json.loads(path.read_text())["title"].startswith("Table 1")


def test_conclusions_are_printed(capsys):
    assert main(["conclusions"]) == 0
    out = capsys.readouterr().out
    assert all(f"({letter})" in out for letter in CONCLUSIONS)
    verdicts = [line[4:] for line in out.splitlines() if line.startswith("  → ")]
    assert verdicts[::2] == ["agree", "agree in part", "agree", "agree in part", "agree"]
    confirmed = ["not confirmed", "partly confirmed", "confirmed", "not confirmed", "confirmed"]
    assert verdicts[1::2] == confirmed


def test_figure_with_floquet(tmp_path, capsys):
    path = tmp_path / "f8.csv"
    assert main(["figure", "8", "--floquet"]) == 0
    assert "→ not confirmed" in capsys.readouterr().out
    assert main(["figure", "8", "--floquet", "--output", str(path)]) == 0
    assert {row["kind"] for row in rows_of(path)} == {"line", "unstable"}
    assert main(["figure", "3", "--floquet"]) == 2
    message = "rotorstab: `--floquet` is for figures 4 to 9, got 3\n"
    assert capsys.readouterr().err == message


def test_all_figures_with_floquet(tmp_path, monkeypatch):
    monkeypatch.setattr(paper_commands, "FIGURES", {number: FIGURES[number] for number in (2, 8)})
    directory = tmp_path / "all"
    assert main(["figure", "--all", str(directory), "--formats", "json", "--floquet"]) == 0
    for number in (2, 8):
        panels = json.loads((directory / f"figure_{number}.json").read_text())["panels"]
        assert any(panel["unstable"] for panel in panels) is (number == 8)


def test_whirl_of_an_own_rotor(tmp_path, capsys):
    path = tmp_path / "w.csv"
    arguments = ["whirl", "--spin-speed", "0,2", "--load", "0:1:3", "--output", str(path)]
    assert main(arguments) == 0
    rows = rows_of(path)
    assert len(rows) == 2 * 3 * 4
    last_speed = [row for row in rows if row["spin_speed"] == "2.0" and row["load"] == "0.0"]
    # theory: −1.73338, −0.26610, 1.07302, 4.92646
    assert [round(float(row["frequency"]), 5) for row in last_speed] == [
        -1.73338,
        -0.2661,
        1.07302,
        4.92646,
    ]
    assert main(["whirl", "--model", "finite-element", "--modes", "4"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 9


@pytest.mark.parametrize(
    ("chosen", "model", "law"),
    [
        ([], "lumped", "linear"),
        (["--model", "lumped", "--stiffness", "exact"], "lumped", "exact"),
        (["--stiffness", "linear"], "lumped", "linear"),
        (["--model", "exact"], "lumped", "exact"),  # as it was written before `--stiffness`
        (["--model", "finite-element"], "finite-element", None),
        (["--model", "finite-element", "--stiffness", "linear"], "finite-element", None),
    ],
)
def test_regions_of_an_own_rotor(chosen, model, law, tmp_path, capsys):
    path = tmp_path / "r.json"
    arguments = ["regions", "--spin-speed", "1", "--static-factor", "0,0.5", "--modes", "4"]
    arguments += chosen
    assert main(arguments) == 0
    assert "theta/omega_n" in capsys.readouterr().out
    assert main([*arguments, "--output", str(path)]) == 0
    loaded = json.loads(path.read_text())
    assert loaded["parameters"]["model"] == model
    assert loaded["parameters"].get("stiffness") == law
    assert len(loaded["panels"][0]["lines"]) == 8


def test_a_stiffness_law_that_is_added_is_what_the_command_computes(monkeypatch, capsys):
    arguments = ["whirl", "--load", "1", "--stiffness"]
    assert main([*arguments, "exact"]) == 0
    exact = capsys.readouterr().out
    assert main([*arguments, "linear"]) == 0
    assert capsys.readouterr().out != exact
    assert main([*arguments[:-1], "--model", "exact"]) == 0
    assert capsys.readouterr().out == exact
    monkeypatch.setitem(STIFFNESS_LAWS, "another", STIFFNESS_LAWS["exact"])
    assert main([*arguments, "another"]) == 0
    assert capsys.readouterr().out == exact


def test_regions_can_be_drawn(tmp_path):
    path = tmp_path / "r.svg"
    assert main(["regions", "--tangency", "1", "--output", str(path)]) == 0
    assert path.read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: COMMAND"),
        (["figure"], "give either a figure's number, 2 to 9, or --all DIRECTORY"),
        (["figure", "1"], "invalid choice: 1"),
        (["figure", "6", "--output", "a.docx"], "`--output` must end in .pdf, .svg, .png"),
        (["figure", "6", "--output", "no/such/place.csv"], "No such file or directory: no/such"),
        (["figure", "--all", "x", "--formats", "gif"], "`--formats` must be among"),
        (["table1", "--output", "a.pdf"], "`--output` must end in .csv, .json, got 'a.pdf'"),
        (["whirl", "--shear", "2"], "`shear` must be in [0, 1), got 2"),
        (["whirl", "--shear", "nan"], "`shear` must be in [0, 1), got nan"),
        (["whirl", "--shear", "x"], "argument --shear: invalid float value: 'x'"),
        (["whirl", "--load", "1:2"], "is not a number, a list such as"),
        (["whirl", "--load", "0:1:99999999"], "2 to 10000 values"),
        *(
            (
                ["whirl", *model, f"--{name}", value],
                f"must be in [-{largest}, {largest}], got {value}",
            )
            for model in ([], ["--stiffness", "exact"], ["--model", "finite-element"])
            for name, largest in (("spin-speed", "1e+09"), ("load", "1e+12"))
            for value in ("1e+300", largest.replace("1", "2", 1))
        ),
        (["regions", "--spin-speed", "1e300"], "`spin_speed` must be in [-1e+09, 1e+09]"),
        (["whirl", "--internal-damping", "1e10"], "must be in [0, 1e+09], got 1e+10"),
        (["whirl", "--load", "inf"], "`load` must be in [-1e+12, 1e+12], got inf"),
        (["whirl", "--spin-speed", "0:1:1000", "--load", "0:1:1000"], "got 1e+06"),
        (["whirl", "--model", "cubic"], "invalid choice: 'cubic' (choose from"),
        (["whirl", "--stiffness", "cubic"], "invalid choice: 'cubic' (choose from"),
        (["whirl", "--stiffness", "exact", "--load", "50"], "pole of the exact stiffness"),
        (
            ["whirl", "--model", "finite-element", "--stiffness", "exact"],
            "`--stiffness exact` is for the lumped model; finite elements have the linear law",
        ),
        (["whirl", "--model", "finite-element", "--modes", "99"], "`modes` must be in [2, 40]"),
        (["whirl", "--disk-mass", "0"], "`disk_mass` must be in (0, inf), got 0"),
        (["regions", "--static-factor", "0,1,2,3"], "must have 1 to 3 values, got 4"),
        (["regions", "--external-damping", "0.1"], "must be undamped"),
        (["regions", "--largest-factor", "0"], "`largest_factor` must be in (0, inf), got 0"),
    ],
)
def test_bad_arguments_give_one_line_and_exit_code_2(arguments, message, capsys, tmp_path):
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("rotorstab")
    assert err.count("\n") == 1
    assert message in err


def test_missing_holoviews_is_one_clear_line(monkeypatch, capsys, tmp_path):
    for name in [name for name in sys.modules if name.startswith("rotorstab.drawing.printed")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "holoviews", None)
    assert main(["figure", "2", "--output", str(tmp_path / "a.pdf")]) == 2
    assert "which is not installed: pip install 'rotorstab[app]'" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_missing_matplotlib_is_one_clear_line(monkeypatch, capsys, tmp_path):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["figure", "2", "--output", str(tmp_path / "a.pdf")]) == 2
    line = "rotorstab: .pdf needs matplotlib, which is not installed: pip install 'rotorstab[app]'"
    assert capsys.readouterr().err.startswith(line)
    assert list(tmp_path.iterdir()) == []


def test_the_module_runs_and_survives_a_closed_pipe():
    command = [sys.executable, "-m", "rotorstab", "whirl", "--load", "0:2:500"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.readline()
        process.stdout.close()
        errors = process.stderr.read()
    assert process.returncode == 0
    assert errors == b""


def test_solving_does_not_import_a_drawing_library():
    code = (
        "import sys; from rotorstab.cli import paper_commands; "
        "from rotorstab.__main__ import main; main(['figure', '6']); "
        "sys.exit(any(m.split('.')[0] in ('holoviews', 'matplotlib', 'bokeh') "
        "for m in sys.modules))"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0


@pytest.mark.parametrize(
    "line",
    [
        "whirl --disk-mass 1e-300",
        "regions --disk-mass 1e-300",
    ],
)
def test_overflow_is_one_line_and_no_warning(line, capsys):
    assert main(line.split()) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err == "rotorstab: an argument is too large or too small to compute with\n"


@pytest.mark.parametrize(
    ("load", "values"),
    [
        (["--load", "-0.5:0.5:3"], ["-0.5", "0.0", "0.5"]),
        (["--load", "-0.5,0.5"], ["-0.5", "0.5"]),
        (["--load", "-.5"], ["-0.5"]),
        (["--load", "-1e-1,-2"], ["-0.1", "-2.0"]),
        (["--load", "−0.5,0.5"], ["-0.5", "0.5"]),
        (["--load=-0.5,0.5"], ["-0.5", "0.5"]),
        (["--load", " -0.5 , 0.5 "], ["-0.5", "0.5"]),
    ],
)
def test_a_list_or_range_may_begin_with_a_minus_sign(load, values, tmp_path, capsys):
    path = tmp_path / "w.csv"
    assert main(["whirl", *load, "--output", str(path)]) == 0
    assert list(dict.fromkeys(row["load"] for row in rows_of(path))) == values
    assert capsys.readouterr().err == ""


def test_a_negative_value_of_any_option_is_that_option_s(capsys):
    assert main(["whirl", "--spin-speed", "-2", "--shear", "-0.5"]) == 2
    assert "`shear` must be in [0, 1), got -0.5" in capsys.readouterr().err
    assert main(["whirl", "--load", "-inf"]) == 2
    assert "got -inf" in capsys.readouterr().err
    assert main(["whirl", "--load", "--force"]) == 2
    assert "argument --load: expected one argument" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--spin-speed", "--load"])
def test_a_list_that_looks_like_a_decimal_comma_is_told(option, capsys):
    assert main(["whirl", option, "0,5"]) == 0
    out, err = capsys.readouterr()
    assert err == (
        f"rotorstab whirl: {option} 0,5 is read as 2 values, 0 and 5; "
        "a decimal number has a point: 0.5\n"
    )
    assert len(out.splitlines()) == 1 + 2 * 4
    for clear in ("0,5.5", "0,1,2", "0:5:2", "5", "0.5,1"):
        assert main(["whirl", option, clear]) == 0
        assert capsys.readouterr().err == ""


def test_the_help_says_what_a_comma_means(capsys):
    assert main(["whirl", "--help"]) == 0
    assert "a comma separates values, a decimal number has a point" in " ".join(
        capsys.readouterr().out.split()
    )


def test_the_version_is_told(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"rotorstab {version('rotorstab')}\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize(
    "arguments", ["table1", "whirl --load 0:2:500", "figure 2", "--help", "--version"]
)
def test_output_that_cannot_be_written_is_one_line(arguments):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "rotorstab", *arguments.split()]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.stderr == "rotorstab: the output could not be written: No space left on device\n"
    assert done.returncode == 2


def test_without_an_output_it_is_one_line():
    done = subprocess.run(
        ["sh", "-c", f"'{sys.executable}' -m rotorstab table1 >&-"],
        stderr=subprocess.PIPE,
        text=True,
    )
    assert done.stderr == "rotorstab: the output could not be written: it is closed\n"
    assert done.returncode == 2


def test_a_file_for_which_there_is_no_room_is_named(tmp_path, monkeypatch, capsys):
    def full(handle):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    path = tmp_path / "t.csv"
    assert main(["table1", "--output", str(path)]) == 2
    assert capsys.readouterr().err == f"rotorstab: No space left on device: {path}\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("module", "missing"),
    [("screen", "holoviews"), ("contours", "bokeh"), ("printed", "holoviews")],
)
def test_drawing_without_the_extra_names_the_extra(module, missing):
    code = f"import sys; sys.modules['{missing}'] = None; import rotorstab.drawing.{module}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stderr.splitlines()[-1] == (
        f"ImportError: rotorstab.drawing.{module} needs {missing}, which is not installed: "
        "pip install 'rotorstab[app]'"
    )


@pytest.mark.parametrize(
    "command", ["table1", "whirl", "regions --spin-speed 1", "figure 2"], ids=str.split
)
def test_a_csv_for_excel_begins_with_a_byte_order_mark(command, tmp_path):
    plain, excel, as_json = (tmp_path / name for name in ("a.csv", "b.csv", "c.json"))
    assert main([*command.split(), "--output", str(plain)]) == 0
    assert main([*command.split(), "--output", str(excel), "--excel"]) == 0
    assert main([*command.split(), "--output", str(as_json), "--excel"]) == 0
    assert excel.read_bytes() == b"\xef\xbb\xbf" + plain.read_bytes()
    assert as_json.read_bytes().startswith(b"{")


def test_all_tables_can_be_for_excel(tmp_path):
    assert main(["figure", "--all", str(tmp_path), "--formats", "csv", "--excel"]) == 0
    assert all(path.read_bytes().startswith(b"\xef\xbb\xbf#") for path in tmp_path.iterdir())
