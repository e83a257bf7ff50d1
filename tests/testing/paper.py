"""The paper's figures and conclusions with Floquet, which take seconds: once a process each."""

from functools import cache

from rotorstab.paper import FIGURES, FLOQUET_CONCLUSIONS, FLOQUET_FIGURES


@cache
def floquet_figure(number):
    """Return a figure with Floquet, at its default parameters."""
    return FIGURES[number](floquet=True)


@cache
def floquet_conclusion(letter):
    """Return what Floquet says of a conclusion."""
    return FLOQUET_CONCLUSIONS[letter]()


def share(patch, module):
    """Have a module take figures and conclusions with Floquet from here."""

    def maker(number):
        return lambda **options: (
            floquet_figure(number) if options == {"floquet": True} else FIGURES[number](**options)
        )

    conclusions = {
        letter: lambda letter=letter: floquet_conclusion(letter) for letter in FLOQUET_CONCLUSIONS
    }
    figures = {number: maker(number) for number in FLOQUET_FIGURES}
    for name, makers in (("FIGURES", figures), ("FLOQUET_CONCLUSIONS", conclusions)):
        patch.setattr(module, name, {**getattr(module, name), **makers})
