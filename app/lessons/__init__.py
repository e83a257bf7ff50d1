"""Lessons: Markdown files with parameters and questions that the solver answers.

Format and quantities: docs/lessons.md.
"""

from .format import Lesson, Step, parse
from .grading import Grade, Unanswerable, grade, solution
from .library import Problem, library, read_folder
from .quantities import QUANTITIES
from .quantity import Quantity
from .questions import Question
from .tables import LessonError

__all__ = [
    "QUANTITIES",
    "Grade",
    "Lesson",
    "LessonError",
    "Problem",
    "Quantity",
    "Question",
    "Step",
    "Unanswerable",
    "grade",
    "library",
    "parse",
    "read_folder",
    "solution",
]
