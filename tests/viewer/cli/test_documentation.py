"""The tables of options and keys in the viewer's documents match those of the program, and no document has a dead link.
"""

import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


def test_keys_are_in_step(folder):
    table = folder.run("key-table").is_good().out
    text = (ROOT / "viewer" / "window.md").read_text()
    documented = text.split("<!-- bindpose key-table -->\n")[1].split("<!-- end of the keys -->\n")[0]
    assert documented.strip() == table.strip(), (
        "viewer/window.md is out of step; put the output of 'bindpose key-table' between its marks")


def test_options_are_in_step(folder):
    page = ROOT / "viewer" / "command_line.md"
    generator = ROOT / "filters" / "options" / "generate.py"
    subprocess.run([sys.executable, "-B", generator, "page", page, folder.path / "page.md"], check=True)
    assert (folder.path / "page.md").read_text() == page.read_text(), (
        f"viewer/command_line.md is out of step; run {generator} page {page} {page}")


def pages():
    """Return all documents of the project: those in the source tree, without the build folder."""
    folders = ("examples", "filters", "python", "tests", "viewer")
    return sorted([*ROOT.glob("*.md"), *(page for folder in folders for page in (ROOT / folder).rglob("*.md"))])


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_what_a_page_links_to_is_there(page):
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text())
    missing = [link for link in links if "://" not in link and not (page.parent / link).exists()]
    assert not missing
