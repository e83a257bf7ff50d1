"""Entry point of `panel serve app`: one session, one page."""

from __future__ import annotations

from pathlib import Path

import panel as pn
from bokeh.models import CustomJS
from markupsafe import Markup

from rotorstab.charts import ROLES

from .pages import PAGES
from .printing import FORMATS
from .session import Session

ASSETS = Path(__file__).parent / "assets"
LEGENDS = {
    "instability": ("backward", "forward"),
    "load_frequency": ("axial", "follower", "growing", "limit", "current"),
    "campbell": ("backward", "forward", "synchronous", "current"),
    "coefficients": ("exact", "linear"),
    "errors": ("k11", "k22", "level"),
}


def legend(roles: tuple[str, ...]) -> Markup:
    """Return an HTML legend whose strokes are those of the chart."""
    entries = []
    for name in roles:
        role = ROLES[name]
        entries.append(
            Markup(
                '<li><svg width="30" height="8" aria-hidden="true"><line x1="1" x2="29" y1="4" '
                'y2="4" stroke="{}" stroke-width="{}" stroke-dasharray="{}"/></svg>{}</li>'
            ).format(
                role.color, role.width, "" if role.dash == "solid" else role.dash, role.meaning
            )
        )
    return Markup('<ul class="legend">{}</ul>').format(Markup("").join(entries))


def layout() -> str:
    """Return the Jinja text of the whole document, every page's layout in its section."""
    sections = [
        f'<section class="page" data-page="{page.key}" aria-label="{page.title}"'
        f"{' hidden' if index else ''}>{page.fragment()}</section>"
        for index, page in enumerate(PAGES)
    ]
    links = [f'<a href="#{page.key}">{page.title}</a>' for page in PAGES]
    text = (ASSETS / "page.html").read_text(encoding="utf-8")
    return text.replace("<!-- pages -->", "".join(sections)).replace(
        "<!-- links -->", "".join(links)
    )


LAYOUT = layout()


def download(key: str) -> Markup:
    """Return the export menu of a live chart."""
    options = Markup("").join(
        Markup('<option value="{}">{}</option>').format(kind, kind.upper()) for kind in FORMATS
    )
    return Markup(
        '<select class="export" data-chart="{}" aria-label="Export this chart">'
        '<option value="">Export …</option>{}</select>'
    ).format(key, options)


def build() -> pn.Template:
    """Return a page of its own session."""
    template = pn.Template(LAYOUT)
    template.title = "rotorstab"
    for name, root in Session(pn.state.session_args).roots().items():
        template.add_panel(name, root)
    template.add_variable("style", Markup((ASSETS / "page.css").read_text(encoding="utf-8")))
    template.add_variable("script", Markup((ASSETS / "page.js").read_text(encoding="utf-8")))
    template.add_variable("paper_script", Markup((ASSETS / "paper.js").read_text(encoding="utf-8")))
    for name, file in (
        ("inspector_style", "inspector.css"),
        ("inspector_script", "inspector.js"),
        ("shaft_script", "shaft.js"),
    ):
        template.add_variable(name, Markup((ASSETS / file).read_text(encoding="utf-8")))
    template.add_variable("legends", {key: legend(roles) for key, roles in LEGENDS.items()})
    template.add_variable("download", download)
    if pn.state.curdoc is not None:
        pn.state.curdoc.js_on_event(
            "connection_lost", CustomJS(code="window.rotorstab.connectionLost()")
        )
    return template


build().servable()
