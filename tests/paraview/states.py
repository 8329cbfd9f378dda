"""Open every state of examples/paraview, for tests/paraview.sh: pvbatch states.py LIBRARY FOLDER.

Every source of a state must have data. The state is saved and loaded again, and must then have the same data.
"""

import pathlib
import runpy
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import plugin  # noqa: E402
from paraview import simple  # noqa: E402

STATES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "paraview"


def sizes():
    """Return the numbers of points and cells of every source by its name."""
    found = {}
    for (name, _), source in simple.GetSources().items():
        data = plugin.fetch(source)
        found[name] = data.GetNumberOfPoints(), data.GetNumberOfCells()
    return found


def main():
    library, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    simple.LoadPlugin(library, remote=False, ns=vars(simple))
    states = sorted(STATES.glob("*.py"))
    for state in states:
        runpy.run_path(str(state))
        opened = sizes()
        assert len(opened) >= 4, f"{state.name}: {sorted(opened)}"
        for name, size in opened.items():
            assert min(size) > 0, f"{state.name}: {name} is empty"
        view = simple.GetActiveView()
        assert any(display.Visibility for display in view.Representations), f"{state.name} shows nothing"
        simple.SaveScreenshot(str(folder / f"{state.stem}.png"), view, ImageResolution=[800, 600])
        saved = folder / f"{state.stem}.pvsm"
        simple.SaveState(str(saved))
        delete_everything()
        simple.LoadState(str(saved))
        assert sizes() == opened, f"{state.name}: {sizes()} after loading, {opened} before"
        delete_everything()
    assert len(states) >= 3
    print(f"{len(states)} example states opened, saved and loaded again")


def delete_everything():
    for source in list(simple.GetSources().values()):
        simple.Delete(source)
    simple.Delete(simple.GetActiveView())


if __name__ == "__main__":
    main()
