"""Turns Markdown into safe HTML: no raw HTML, no pictures, links to the web only."""

from __future__ import annotations

import re
from collections.abc import Sequence

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict
from markupsafe import Markup, escape

from ..words.typography import keep_units_together

__all__ = ["inline", "plain", "render", "tokens"]

# "β_d" and its like; a combining bar may follow the letter
_SYMBOL = re.compile(r"([^\W\d_]̄?)_([^\W_²³]{1,8})")


def plain(text: str) -> Markup:
    """Return a text escaped for HTML, with the subscripts of its symbols."""
    escaped = str(escape(keep_units_together(text)))
    return Markup(_SYMBOL.sub(r'<span class="symbol">\1<sub>\2</sub></span>', escaped))


class _Renderer(RendererHTML):
    def text(self, tokens: Sequence[Token], idx: int, options: OptionsDict, env: EnvType) -> str:
        """Write a text with its symbols."""
        return str(plain(tokens[idx].content))

    def link_open(
        self, tokens: Sequence[Token], idx: int, options: OptionsDict, env: EnvType
    ) -> str:
        """Open a link to the web in a new tab, so that the lesson stays."""
        if str(tokens[idx].attrGet("href")).startswith("http"):
            tokens[idx].attrSet("target", "_blank")
            tokens[idx].attrSet("rel", "noopener noreferrer")
        return self.renderToken(tokens, idx, options, env)


def _maker() -> MarkdownIt:
    made = MarkdownIt("commonmark", {"html": False}, renderer_cls=_Renderer)
    made.enable("table").disable(["image", "html_block", "html_inline"])
    # a link that leads neither to the web nor into this page stays text
    made.validateLink = lambda url: bool(re.match(r"(https?://|#)", url.strip(), re.IGNORECASE))  # type: ignore[method-assign]
    return made


_MARKDOWN = _maker()


def tokens(text: str) -> list[Token]:
    """Return the blocks of a text with the numbers of their lines."""
    return _MARKDOWN.parse(text)


def render(blocks: Sequence[Token]) -> str:
    """Return the HTML of some blocks."""
    return str(_MARKDOWN.renderer.render(blocks, _MARKDOWN.options, {}))


def inline(text: str) -> str:
    """Return the HTML of one line."""
    return str(_MARKDOWN.renderInline(text))
