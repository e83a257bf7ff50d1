"""The lessons of a server: the built-in ones, and those of the folder ROTORSTAB_LESSONS."""

from __future__ import annotations

import logging
import os
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .format import LONGEST_FILE, Lesson, parse
from .grading import unanswerable
from .tables import LessonError

__all__ = ["VARIABLE", "Library", "Problem", "collect", "library", "read_file", "read_folder"]

VARIABLE = "ROTORSTAB_LESSONS"
_LOG = logging.getLogger("rotorstab.lessons")
_NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,60}")
_MOST_FILES = 200


@dataclass(frozen=True)
class Problem:
    """A file that is no lesson, with the line and the reason."""

    file: str
    line: int
    reason: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.reason}"


@dataclass(frozen=True)
class Library:
    """The lessons of a server.

    Parameters
    ----------
    lessons : dict of str to Lesson
        By key, the built-in ones first.
    problems : tuple of Problem
        The files that were left out.
    foreign : frozenset of str
        Keys of the lessons that are not built in.
    """

    lessons: dict[str, Lesson]
    problems: tuple[Problem, ...]
    foreign: frozenset[str]


def read_file(path: Path) -> Lesson | Problem:
    """Return the lesson of one file, with every answer checked, or what is wrong with it."""
    if not _NAME.fullmatch(path.stem):
        return Problem(path.name, 1, "a lesson's file name has only a-z, 0-9 and -")
    try:
        if path.stat().st_size > 4 * LONGEST_FILE:
            return Problem(path.name, 1, "the file is too long")
        lesson = parse(path.read_bytes().decode("utf-8"), path.stem)
    except LessonError as error:
        return Problem(path.name, error.line, error.reason)
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        return Problem(path.name, line, "the file is not UTF-8 text")
    except OSError as error:
        return Problem(path.name, 1, f"cannot be read: {error.strerror}")
    if fault := unanswerable(lesson):
        return Problem(path.name, *fault)
    return lesson


def read_folder(folder: Path) -> tuple[list[Lesson], list[Problem]]:
    """Return the lessons of a folder's .md files in the order of their names, and the problems."""
    try:
        files = sorted(path for path in folder.iterdir() if path.suffix == ".md")
    except OSError as error:
        return [], [Problem(str(folder), 1, f"cannot be read: {error.strerror}")]
    lessons: list[Lesson] = []
    problems: list[Problem] = []
    for path in files[:_MOST_FILES]:
        if path.stem.lower() == "readme":
            continue
        found = read_file(path)
        if isinstance(found, Lesson):
            lessons.append(found)
        else:
            problems.append(found)
    if len(files) > _MOST_FILES:
        problems.append(Problem(str(folder), 1, f"only the first {_MOST_FILES} files are read"))
    return lessons, problems


def collect(folder: str | None) -> Library:
    """Return the built-in lessons and those of a folder, which replace built-in ones by name."""
    lessons, problems = read_folder(Path(__file__).parent)
    found = {lesson.key: lesson for lesson in lessons}
    foreign: list[Lesson] = []
    if folder:
        foreign, more = read_folder(Path(folder))
        problems += more
        found |= {lesson.key: lesson for lesson in foreign}
    return Library(found, tuple(problems), frozenset(lesson.key for lesson in foreign))


@cache
def library() -> Library:
    """Return the lessons, which are read once in a process; the log names what is left out."""
    found = collect(os.environ.get(VARIABLE))
    for problem in found.problems:
        _LOG.error("lesson left out: %s", problem)
    return found
