"""The whole page: one document, one session."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from pathlib import Path
from types import MappingProxyType

import panel as pn
from markupsafe import Markup

from rotorstab import STIFFNESS_LAWS
from rotorstab.charts import ROLES, Role
from rotorstab.drawing.formats import FORMATS, PICTURE_FORMATS

from .background.threads import turn
from .exports.rows import input_labels
from .pages import PAGES
from .pages.lessons import cards
from .results.curves import curves_name
from .session import Session

ASSETS = Path(__file__).parent / "assets"
STYLES = ("page.css", "rotor.css", "inspector.css", "shaft.css", "lessons.css", "print.css")
# connection.js stands before Bokeh's files; each script adds to what those before it made
SCRIPTS = (
    "messages.js",
    "labels.js",
    "page.js",
    "layout.js",
    "history.js",
    "units.js",
    "rotor.js",
    "paper.js",
    "places.js",
    "marker.js",
    "motion.js",
    "shaft.js",
    "inspector.js",
    "progress.js",
    "lessons.js",
    "print.js",
)
# which of these are drawn depends on the load type and the stiffness law
LOADS = tuple(
    curves_name(load, law) for law in STIFFNESS_LAWS for load in ("axial", "follower", "partly")
)
LEGENDS = {
    "instability": ("backward", "forward", "edge"),
    "load_kinds": LOADS,
    "load_frequency": (*LOADS, "growing", "limit", "current"),
    "campbell": ("backward", "forward", "growing", "synchronous", "current"),
    "own_stability": ("edge", "estimate"),
    "own_whirl": ("backward", "forward", "straight", "growing", "synchronous", "current"),
    "own_drawing": ("shaft", "disk", "bearing", "clamp", "load"),
    "coefficients": ("exact", "linear"),
    "errors": ("k11", "k22", "level"),
}
# the input that switches a stroke's layer; the legend mutes the stroke while it is off
SWITCHED = {"backward": "show_bolotin", "forward": "show_bolotin", "edge": "show_growth"}


def meaning(role: Role) -> Markup | str:
    """Return the meaning of a stroke, for both units: in SI a symbol has no bar."""
    if not role.si_meaning:
        return role.meaning
    texts = Markup('<span class="nd">{}</span><span class="si">{}</span>')
    return texts.format(role.meaning, role.si_meaning)


def _attribute(name: str, switched: Mapping[str, str]) -> Markup | str:
    """Return the attribute by which the browser finds an entry: its switch or its curve."""
    if name in switched:
        return Markup(' data-layer="{}"').format(switched[name])
    if name in LOADS:
        return Markup(' data-curve="{}"{}').format(
            name, "" if name in LOADS[:2] else Markup(" hidden")
        )
    return ""


def stroke(name: str, length: int = 30) -> Markup:
    """Return a stroke of a legend, `length` pixels long, that looks as the lines of a role do."""
    role = ROLES[name]
    return Markup(
        '<svg width="{}" height="8" aria-hidden="true"><line x1="1" x2="{}" y1="4" y2="4" '
        'stroke="{}" stroke-width="{}" stroke-dasharray="{}"/></svg>'
    ).format(length, length - 1, role.color, role.width, "" if role.dash == "solid" else role.dash)


def legend(roles: tuple[str, ...], switched: Mapping[str, str] = MappingProxyType({})) -> Markup:
    """Return an HTML legend whose strokes are those of the chart.

    Parameters
    ----------
    roles : tuple of str
        Keys of `ROLES`.
    switched : mapping of str to str
        The input that switches a role's layer on and off, for the roles that have one.
    """
    entries = [
        Markup("<li{}>{}{}</li>").format(
            _attribute(name, switched), stroke(name), meaning(ROLES[name])
        )
        for name in roles
    ]
    return Markup('<ul class="legend">{}</ul>').format(Markup("").join(entries))


def asset(name: str) -> str:
    """Return the text of a file in assets."""
    return (ASSETS / name).read_text(encoding="utf-8")


def layout() -> str:
    """Return the Jinja text of the document, with the layout of every page in a section."""
    sections = [
        f'<section class="page" data-page="{page.key}" aria-label="{page.title}"'
        f' aria-busy="{"true" if page.chart_keys else "false"}"'
        f"{' hidden' if index else ''}>{page.fragment()}</section>"
        for index, page in enumerate(PAGES)
    ]
    links = [f'<a href="#{page.key}">{page.title}</a>' for page in PAGES]
    text = asset("page.html")
    lesson = (ASSETS / "pages" / "lesson.html").read_text(encoding="utf-8")
    for mark, content in (("pages", sections), ("links", links), ("beside", [lesson])):
        text = text.replace(f"<!-- {mark} -->", "".join(content))
    return text


LAYOUT = layout()


def download(key: str) -> Markup:
    """Return the export menu of a live chart."""
    options = Markup("").join(
        Markup('<option value="{}">{}</option>').format(kind, kind.upper()) for kind in FORMATS
    )
    return Markup(
        '<select class="export" data-chart="{}" aria-label="Export this chart" title="Export">'
        '<option value="">⤓</option>{}</select>'
    ).format(key, options)


class PageTemplate(pn.Template):
    """The whole page."""

    def __repr__(self) -> str:
        """Return a short text: Panel asks for it each time that a part is added."""
        return "rotorstab"


def build() -> pn.Template:
    """Return a page with a session of its own."""
    template = PageTemplate(LAYOUT)
    template.title = "rotorstab"
    session = Session(pn.state.session_args)
    for name, root in session.roots().items():
        template.add_panel(name, root)
    template.add_variable("style", Markup("\n".join(map(asset, STYLES))))
    template.add_variable("connection", Markup(asset("connection.js")))
    template.add_variable("scripts", [Markup(asset(name)) for name in SCRIPTS])
    template.add_variable("lessons", cards())
    legends = {
        key: legend(roles, SWITCHED if key == "instability" else {})
        for key, roles in LEGENDS.items()
    }
    template.add_variable("legends", legends)
    template.add_variable("stroke", stroke)
    template.add_variable("marker_color", ROLES["marker"].color)
    template.add_variable("download", download)
    template.add_variable("formats", tuple(FORMATS))
    template.add_variable("picture_formats", tuple(PICTURE_FORMATS))
    template.add_variable("looks", session.looks())
    template.add_variable("labels", input_labels())
    return template


def show() -> None:
    """Add the page to the document that is being served."""
    # Bokeh walks over all models for each root and change; once at the end is enough
    with turn, pn.state.curdoc.models.freeze() if pn.state.curdoc else nullcontext():
        build().servable()
