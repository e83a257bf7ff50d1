"""What files of pictures say of themselves, read from their bytes."""

import re
from io import BytesIO
from xml.etree import ElementTree

DUBLIN_CORE = "{http://purl.org/dc/elements/1.1/}"


def metadata(data, kind):
    """Return title, link and parameters of a PDF, SVG or PNG file, as texts by these names."""
    found = {"pdf": _pdf, "svg": _svg, "png": _png}[kind](data)
    return dict(zip(("title", "link", "parameters"), found, strict=True))


def _png(data):
    from PIL import Image

    with Image.open(BytesIO(data)) as image:
        return [image.text.get(name, "") for name in ("Title", "Source", "Description")]


def _svg(data):
    root = ElementTree.fromstring(data)
    found = [root.find(f".//{DUBLIN_CORE}{name}") for name in ("title", "source", "description")]
    return ["" if one is None else one.text for one in found]


def _pdf(data):
    number = re.search(rb"/Info (\d+) 0 R", data)[1]
    start = re.search(rb"(?m)^%s 0 obj" % number, data).end()
    information = data[start : data.index(b"endobj", start)]
    return [_pdf_string(information, name) for name in (b"Title", b"Subject", b"Keywords")]


def _pdf_string(information, name):
    """Return a literal string of a PDF dictionary: in UTF-16 if it begins so, else in ASCII."""
    found = re.search(rb"/%s \(((?:\\.|[^\\)])*)\)" % name, information, re.DOTALL)
    if not found:
        return ""
    escapes = {b"n": b"\n", b"r": b"\r"}
    plain = re.sub(
        rb"\\(.)", lambda match: escapes.get(match[1], match[1]), found[1], flags=re.DOTALL
    )
    return plain.decode("utf-16" if plain.startswith(b"\xfe\xff") else "ascii")


def boxes_of(drawn):
    """Return the texts of a figure of Matplotlib, and the box of each in dots, 300 an inch."""
    drawn.set_dpi(300)
    drawn.draw_without_rendering()
    renderer = drawn.canvas.get_renderer()
    texts = [*drawn.texts, *(text for one in drawn.legends for text in one.get_texts())]
    for axes in drawn.axes:
        texts += [axes.title, axes._left_title, axes.xaxis.label, axes.yaxis.label, *axes.texts]
        if axes.get_legend():
            texts += axes.get_legend().get_texts()
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            room = 1e-9 * (high - low)
            for tick in axis.get_major_ticks():
                if low - room <= tick.get_loc() <= high + room:
                    texts += [tick.label1, tick.label2]
    shown = [text for text in texts if text.get_text() and text.get_visible()]
    return [(text, text.get_window_extent(renderer)) for text in shown]


def overlaps(boxes, room=4.0):
    """Return the pairs of texts whose boxes overlap by more than a hair."""
    return [
        (one.get_text(), other.get_text())
        for index, (one, a) in enumerate(boxes)
        for other, b in boxes[index + 1 :]
        if min(a.x1, b.x1) - max(a.x0, b.x0) > room and min(a.y1, b.y1) - max(a.y0, b.y0) > room
    ]
