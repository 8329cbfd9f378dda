"""The tables of options and keys in viewer/README.md are the program's own."""

import pathlib

import pytest


@pytest.mark.parametrize("verb, end", [
    ("option-table", "<!-- end of the table -->\n"),
    ("key-table", "<!-- end of the keys -->\n"),
])
def test_readme_is_in_step(folder, verb, end):
    table = folder.run(verb).is_good().out
    readme = pathlib.Path(__file__).resolve().parents[3] / "viewer" / "README.md"
    text = readme.read_text()
    begin = f"<!-- bindpose {verb} -->\n"
    assert begin in text and end in text
    documented = text.split(begin)[1].split(end)[0]
    assert documented.strip() == table.strip(), (
        f"viewer/README.md is out of step; put the output of 'bindpose {verb}' between its marks")
