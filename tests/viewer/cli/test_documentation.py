"""The table of options in viewer/README.md is the program's own."""

import pathlib


def test_readme_is_in_step(folder):
    table = folder.run("option-table").is_good().out
    readme = pathlib.Path(__file__).resolve().parents[3] / "viewer" / "README.md"
    text = readme.read_text()
    begin, end = "<!-- bindpose option-table -->\n", "<!-- end of the table -->\n"
    assert begin in text and end in text
    documented = text.split(begin)[1].split(end)[0]
    assert documented.strip() == table.strip(), (
        "viewer/README.md is out of step; put the output of 'bindpose option-table' between its marks")
