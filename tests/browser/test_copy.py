"""Copying without https, where browsers have no `navigator.clipboard`."""

from itertools import product

import pytest

pytestmark = pytest.mark.browser

NO_CLIPBOARD = """
  Object.defineProperty(navigator, "clipboard", { value: undefined, configurable: true });
  const copy = document.execCommand.bind(document);
  window.refused = false;
  document.execCommand = (name) => !refused && copy(name);
"""


def ask(page, name):
    page.locator("details.share-menu summary").click()
    page.get_by_role("button", name=name).click()


def test_a_text_is_copied_or_selected_with_advice_that_is_in_view(page):
    page.evaluate(NO_CLIPBOARD)
    dialog = page.locator("dialog.code")
    texts = ("As Python", ""), ("Copy link", page.evaluate("location.origin"))
    for refused, (name, begins) in product((False, True), texts):
        page.evaluate("(one) => { window.refused = one; }", refused)
        ask(page, name)
        dialog.wait_for(state="visible")
        if not begins:
            dialog.get_by_role("button", name="Copy").click()
        words = "is selected: copy it with Ctrl+C" if refused else "has been copied"
        told = dialog.get_by_role("status")
        told.filter(has_text=words).wait_for(state="visible")
        # nothing lies over it
        assert told.evaluate(
            """(one) => {
              const { x, y, width, height } = one.getBoundingClientRect();
              return document.elementFromPoint(x + width / 2, y + height / 2) === one;
            }"""
        )
        text = dialog.locator("code").text_content()
        assert text.startswith(begins)
        assert page.evaluate("getSelection().toString().trim()") == text.strip()
        dialog.get_by_role("button", name="Close").click()
    page.evaluate("() => { delete navigator.clipboard; delete document.execCommand; }")
