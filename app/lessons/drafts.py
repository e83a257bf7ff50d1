"""The steps of a lesson's Markdown while their blocks are gathered."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from markdown_it.token import Token

from .markdown import tokens
from .tables import LessonError, Table

__all__ = ["PARTS", "Draft", "read_drafts"]

PARTS = ("predict", "try", "see")
_BLOCKS = ("set", "question", "show")
_MOST_STEPS = 30
_LONGEST_TITLE = 200  # characters


@dataclass
class Draft:
    """A step while its blocks are gathered.

    Parameters
    ----------
    title : str
    line : int
        Of its heading.
    parts : dict of str to list of Token
        Blocks of text by part, one of `PARTS`.
    before_try, in_try : list of (dict, Table)
        Inputs that are set when the step begins, and by its Try.
    question, show : (dict, Table) or None
    """

    title: str
    line: int
    parts: dict[str, list[Token]] = field(default_factory=dict)
    before_try: list[tuple[dict[str, Any], Table]] = field(default_factory=list)
    in_try: list[tuple[dict[str, Any], Table]] = field(default_factory=list)
    question: tuple[dict[str, Any], Table] | None = None
    show: tuple[dict[str, Any], Table] | None = None


def read_drafts(text: str, offset: int) -> tuple[list[Token], list[Draft]]:
    """Return the blocks of the introduction and of every step.

    Parameters
    ----------
    text : str
        Without the front matter.
    offset : int
        Number of lines before it in the file.
    """
    intro: list[Token] = []
    drafts: list[Draft] = []
    part = intro  # the list that blocks of text are added to
    blocks = tokens(text)
    index = 0
    while index < len(blocks):
        block = blocks[index]
        line = offset + (block.map[0] if block.map else 0) + 1
        if block.type == "heading_open" and block.level == 0 and block.tag in ("h1", "h2", "h3"):
            part = _heading(drafts, part, block.tag, blocks[index + 1].content.strip(), line)
            index += 3  # a heading is three tokens: its opening, its text, its end
            continue
        index += 1
        name = block.info.strip()
        if block.type == "fence" and name in _BLOCKS and block.level == 0:
            if not drafts:
                raise LessonError(line, f"a {name} block belongs into a step")
            _gather(drafts[-1], name, Table(block.content, line + 1))
            continue
        if drafts and not drafts[-1].parts:
            raise LessonError(line, "a step's text belongs under ### Predict, ### Try or ### See")
        part.append(block)
    return intro, drafts


def _heading(
    drafts: list[Draft], part: list[Token], tag: str, title: str, line: int
) -> list[Token]:
    """Begin a step or one of its parts; return the list that the next blocks are added to."""
    if tag == "h1":
        raise LessonError(line, "a step begins with ##; the title belongs to the top")
    if tag == "h2":
        if not title or len(title) > _LONGEST_TITLE:
            raise LessonError(line, f"a step needs a title of up to {_LONGEST_TITLE} characters")
        if len(drafts) >= _MOST_STEPS:
            raise LessonError(line, f"more than {_MOST_STEPS} steps")
        drafts.append(Draft(title, line))
        return part  # a step has no text before its first part
    name = title.lower()
    if not drafts or name not in PARTS or name in drafts[-1].parts:
        raise LessonError(line, "a step has the parts ### Predict, ### Try, ### See, once")
    drafts[-1].parts[name] = []
    return drafts[-1].parts[name]


def _gather(draft: Draft, name: str, table: Table) -> None:
    """Add a block of parameters to a step."""
    values = table.read()
    if name == "set":
        (draft.in_try if "try" in draft.parts else draft.before_try).append((values, table))
    elif name == "question":
        if draft.question:
            raise LessonError(table.line, "a step has one question")
        draft.question = values, table
    else:
        if draft.show:
            raise LessonError(table.line, "a step has one show block")
        draft.show = values, table
