"""Check lessons: `python -m app.lessons FILE-OR-FOLDER …` prints errors, or every answer."""

from __future__ import annotations

import sys
from pathlib import Path

from .format import Lesson
from .grading import number_text, solution
from .library import Problem, read_file, read_folder


def _report(lesson: Lesson) -> None:
    print(f"{lesson.key}: {lesson.title}")
    for number, step in enumerate(lesson.steps, 1):
        answer = solution(step)
        if isinstance(answer, int):
            words = step.question.choices[answer].text
        else:
            words = "the goal is reached" if answer is None else number_text(answer)
        print(f"  {number}. {step.title}: {words}")


def main(arguments: list[str]) -> int:
    """Check files and folders; return the exit code: 1 if a lesson has an error."""
    if not arguments:
        print(__doc__, file=sys.stderr)
        return 2
    lessons: list[Lesson] = []
    problems: list[Problem] = []
    for path in map(Path, arguments):
        if path.is_dir():
            good, bad = read_folder(path)
            lessons += good
            problems += bad
        else:
            found = read_file(path)
            if isinstance(found, Lesson):
                lessons.append(found)
            else:
                problems.append(found)
    for lesson in lessons:
        _report(lesson)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
