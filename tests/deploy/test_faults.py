"""A full disk, a picture process that dies, a queue that is full: words, and nothing half done."""

import errno
import os
import signal
from concurrent.futures.process import BrokenProcessPool

import pytest

from app.background.printing import Printer
from app.exports.files import excuse
from app.results.analysis import solve
from app.state import State
from rotorstab.charts import chart_figure
from rotorstab.cli import parser as cli


def test_a_full_disk_is_named_to_the_user():
    assert "disk is full" in excuse(OSError(errno.ENOSPC, "No space left on device"))
    for problem in (RuntimeError("/home/x"), OSError(errno.EACCES, "denied", "/home/x")):
        words = excuse(problem)
        assert "ask once more" in words
        assert "/home" not in words


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
        words = capsys.readouterr().err
        assert code == 2
        assert "No space left on device" in words
        assert words.count("\n") == 1
    assert [one.name for one in tmp_path.iterdir()] == ["kept.csv"]
    assert kept.read_text() == "old"


def test_a_picture_process_that_dies_is_started_again():
    printer = Printer()
    figure = chart_figure(solve(State(), settled=False).charts["campbell"], {})
    try:
        first = printer.file("first", figure, "svg")
        assert first.result(60).startswith(b"<?xml")
        (worker,) = printer.pids()
        os.kill(worker, signal.SIGSTOP)  # it makes no file before it dies
        waiting = printer.file("second", figure, "pdf")
        os.kill(worker, signal.SIGKILL)
        with pytest.raises(BrokenProcessPool):
            waiting.result(60)
        again = printer.file("second", figure, "pdf")
        assert again.result(60).startswith(b"%PDF")
    finally:
        printer.close()
