"""Faults of the machine: a full disk, and a process that is killed."""

import errno
import os
import signal
from concurrent.futures.process import BrokenProcessPool

import pytest

from app.background.printing import Printer
from app.exports.files import failure_message
from app.results.analysis import solve
from app.results.limits import Detail
from app.state import State
from rotorstab.charts import chart_figure
from rotorstab.cli import parser as cli


def test_a_full_disk_is_named_to_the_user():
    assert "disk is full" in failure_message(OSError(errno.ENOSPC, "No space left on device"))
    for problem in (RuntimeError("/home/x"), OSError(errno.EACCES, "denied", "/home/x")):
        sentence = failure_message(problem)
        assert "try again" in sentence
        assert "/home" not in sentence


@pytest.mark.parametrize("at", ["write", "fsync", "replace"])
def test_a_full_disk_leaves_no_part_of_a_file(tmp_path, monkeypatch, capsys, at):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    class Full:
        def __init__(self, handle, mode):
            self.handle = handle

        def __enter__(self):
            return self

        def __exit__(self, *_):
            os.close(self.handle)

        write = full

    if at == "write":
        monkeypatch.setattr(os, "fdopen", Full)
    else:
        monkeypatch.setattr(os, at, full)
    kept = tmp_path / "kept.csv"
    kept.write_text("old")
    for target, more in ((tmp_path / "new.csv", []), (kept, ["--force"])):
        code = cli.main(["whirl", "--load", "0:1:2", "--output", str(target), *more])
        message = capsys.readouterr().err
        assert code == 2
        assert "No space left on device" in message
        assert message.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["kept.csv"]
    assert kept.read_text() == "old"


def test_a_picture_process_that_is_killed_fails_its_file_and_the_next_one_is_made():
    printer = Printer()
    figure = chart_figure(solve(State(), detail=Detail.COARSE).charts["campbell"], {})
    try:
        first = printer.file("first", figure, "svg")
        assert first.result(60).startswith(b"<?xml")
        (process,) = printer.pids()
        os.kill(process, signal.SIGSTOP)  # it cannot finish the next file
        killed = printer.file("second", figure, "pdf")
        os.kill(process, signal.SIGKILL)
        with pytest.raises(BrokenProcessPool):
            killed.result(60)
        again = printer.file("second", figure, "pdf")
        assert again.result(60).startswith(b"%PDF")
        assert printer.pids() != [process]
    finally:
        printer.close()
