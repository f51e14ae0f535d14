"""The page as text: the view model through the templates, with style and script written into it.

render   the page of these records
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import resources
from types import ModuleType
from typing import TYPE_CHECKING

from ..base.errors import InvalidInput
from ..base.others_text import policy

if TYPE_CHECKING:
    from .records import Records

PACKAGE = "faultspace.review"
BEGIN = 'document.documentElement.classList.add("js");'  # before anything is shown
EXTRA = "the page needs Jinja2: pip install 'faultspace[report]'"


def jinja() -> ModuleType:
    """Return the library of templates. Raises InvalidInput where it is not installed, and names the extra that brings it."""
    try:
        import jinja2
    except ImportError:
        raise InvalidInput(EXTRA) from None
    return jinja2


def render(records: Records) -> str:
    """Return one page that is complete in itself. Raises InvalidInput where Jinja2 is missing."""
    library = jinja()
    from markupsafe import Markup

    from .drawing import mathml
    from .view import pictures
    from .view.page import WordView, view
    from .view.words import linked

    def words_linked(section: str, entries: Iterable[WordView]) -> Markup:
        return Markup(linked(str(section), [one.name for one in entries]))

    environment = library.Environment(
        loader=library.PackageLoader(PACKAGE), autoescape=True, undefined=library.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"three": three, "percent": percent, "words_linked": words_linked}
    style, script, begin = _file("page.css"), _file("page.js"), BEGIN
    environment.globals |= {
        "matrix": mathml.matrix,
        "typeset": mathml.typeset,
        "pictures": pictures,
        "policy": Markup(policy([style], [begin, script])),
        "style": Markup(style),
        "begin": Markup(begin),
        "script": Markup(script),
    }
    return str(environment.get_template("page.html").render(page=view(records)))


def three(value: float | None) -> str:
    """Return a number with three digits; none, where there is none."""
    return "none" if value is None else f"{value:.3g}"


def percent(value: float | None) -> str:
    """Return a fraction in percent, what is rounding as zero."""
    return "none" if value is None else f"{100 * value:.3g} %" if value > 1e-13 else "0 %"


def _file(name: str) -> str:
    return resources.files(PACKAGE).joinpath("templates", name).read_text("utf-8")
