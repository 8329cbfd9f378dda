"""The tables of options and keys in the viewer's pages match those of the program, and no page has a dead link."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.mark.parametrize("verb, page, end", [
    ("option-table", "command_line.md", "<!-- end of the table -->\n"),
    ("key-table", "window.md", "<!-- end of the keys -->\n"),
])
def test_page_is_in_step(folder, verb, page, end):
    table = folder.run(verb).is_good().out
    text = (ROOT / "viewer" / page).read_text()
    begin = f"<!-- bindpose {verb} -->\n"
    assert begin in text and end in text
    documented = text.split(begin)[1].split(end)[0]
    assert documented.strip() == table.strip(), (
        f"viewer/{page} is out of step; put the output of 'bindpose {verb}' between its marks")


def pages():
    """Return all pages of the project: those next to the sources, not those in the build folder."""
    folders = ("examples", "filters", "python", "tests", "viewer")
    return sorted([*ROOT.glob("*.md"), *(page for folder in folders for page in (ROOT / folder).rglob("*.md"))])


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_what_a_page_links_to_is_there(page):
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text())
    missing = [link for link in links if "://" not in link and not (page.parent / link).exists()]
    assert not missing
