"""Documentation of the Python functions: every public function has an example, and the examples give the documented
output.
"""

import doctest
import inspect

import bindpose
import numpy as np
import pytest

FUNCTIONS = {name: value for name, value in vars(bindpose).items()
             if inspect.isfunction(value) and not name.startswith("_")}
FUNCTIONS |= {"Rig": bindpose.Rig, "Rig.pose": bindpose.Rig.pose, "Rig.save": bindpose.Rig.save}
ORDER = ["Parameters", "Attributes", "Returns", "Raises", "Warns", "See Also", "Notes", "Examples"]


def sections_of(documentation):
    lines = documentation.splitlines()
    return [title for title, line in zip(lines, lines[1:]) if title and line == "-" * len(title)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"bindpose": bindpose, "np": np}
    example = doctest.DocTestParser().get_doctest(FUNCTIONS[name].__doc__, names, name, None, 0)
    assert example.examples, f"{name} has no example"
    runner = doctest.DocTestRunner()
    texts = []
    runner.run(example, out=texts.append)
    assert not runner.failures, "".join(texts)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_sections_are_in_the_order_of_numpydoc(name):
    sections = sections_of(inspect.cleandoc(FUNCTIONS[name].__doc__))
    assert sections == sorted(sections, key=ORDER.index)
    assert "Parameters" in sections and ("Returns" in sections or name in ("write", "Rig"))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_parameter_is_documented(name):
    documented = {word.strip("* ") for line in inspect.cleandoc(FUNCTIONS[name].__doc__).splitlines()
                  if not line.startswith(" ") for word in line.partition(" : ")[0].split(",")}
    assert set(inspect.signature(FUNCTIONS[name]).parameters) - {"self"} <= documented
