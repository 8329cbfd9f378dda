#!/usr/bin/env python3
"""Check that the includes of the project respect its layers. Fail for an include in the wrong direction.

The library core includes no VTK header. A folder of core or of the window includes only from itself and from the
folders that CORE_ARROWS or APP_ARROWS list for it; there are no cycles. Filters include nothing from the viewer. The
ParaView plugin includes the handle widget and Qt, but nothing else from the viewer. Only the plugin includes headers of
ParaView. It has a proxy for every filter that can be instantiated. Nothing outside of the tests includes a header of the
tests. A parameter ExecutionContext is the first one. No two units (a header and its source) include each other. Each file
of the window has the namespace of its folder. No folder has more than 30 source files, except the flat list of VTK classes
in filters. A CMakeLists.txt names every source file.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LATE_CONTEXT = re.compile(r"[(,][^();{}]*,\s*(?:const )?(?:bindpose::)?ExecutionContext\s*&\s*\w*\s*[,)]")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# For each folder of core: the folders of core whose headers its files may include.
CORE_ARROWS = {
    "base": {"base"},
    "linear": {"base", "linear"},
    "geometry": {"base", "linear", "geometry"},
    "io": {"base", "geometry", "io"},
    "solid_angle": {"base", "geometry", "solid_angle"},
    "winding": {"base", "geometry", "solid_angle", "winding"},
    "surface": {"base", "geometry", "winding", "surface"},
    "helper": {"base", "geometry", "winding", "helper"},
    "gltf": {"base", "geometry", "io", "helper", "gltf"},
    "gltf_edit": {"base", "geometry", "io", "gltf", "gltf_edit"},
    "look": {"base", "geometry", "io", "gltf", "gltf_edit", "look"},
    "planar": {"base", "winding", "helper", "planar"},
    "embedding": {"base", "geometry", "winding", "surface", "embedding"},
    "segmentation": {"base", "geometry", "winding", "segmentation"},
    "tets": {"base", "geometry", "surface", "tets"},
    # The folder `inside` needs `io` for the mesh files that it exchanges with the program fTetWild.
    "inside": {"base", "geometry", "io", "winding", "surface", "helper", "embedding", "segmentation", "tets", "inside"},
    "handles": {"base", "geometry", "surface", "handles"},
    "domain": {"base", "linear", "geometry", "surface", "planar", "embedding", "tets", "inside", "handles", "domain"},
    "qp": {"base", "linear", "geometry", "domain", "qp"},
    "transfer": {"base", "linear", "geometry", "surface", "domain", "qp", "transfer"},
    "weights": {"base", "linear", "geometry", "surface", "inside", "domain", "qp", "transfer", "weights"},
    "weight_uses": {"base", "geometry", "weight_uses"},
    "automatic": {"base", "geometry", "winding", "surface", "helper", "inside", "handles", "automatic"},
    "pose": {"base", "geometry", "io", "handles", "pose"},
    "skinning": {"base", "geometry", "handles", "pose", "skinning"},
    "arap": {"base", "linear", "geometry", "handles", "pose", "skinning", "arap"},
    "fairing": {"base", "geometry", "arap", "fairing"},
    "poser": {"base", "geometry", "handles", "domain", "transfer", "weights", "pose", "skinning", "arap", "fairing", "poser"},
    "mesher": {"base", "helper", "segmentation", "inside", "mesher"},
}

COMPILED_BY_SCRIPTS = {"plain_tetgen.cpp"}

# For each folder of viewer/app: the folders of viewer/app whose headers its files may include.
APP_ARROWS = {
    "parts": {"parts"},
    "view": {"parts", "view"},
    "volume": {"parts", "view", "volume"},
    "tets": {"parts", "view", "tets"},
    "posing": {"parts", "view", "posing"},
    "handles": {"parts", "view", "posing", "handles"},
    "weights": {"parts", "view", "handles", "weights"},
    "window": {"parts", "view", "volume", "tets", "posing", "handles", "weights", "window"},
    "tour": {"parts", "view", "volume", "tets", "posing", "handles", "weights", "window", "tour"},
}

PLUGIN = "filters/paraview"
# Prefixes of include paths. They identify headers of the viewer, its handle widget, Qt, ParaView and the tests.
VIEWER = ("viewer/", "scene/", "shapes/", "pictures/", "poses/", "document/", "app/", "cli/", "widgets/")
HANDLE_WIDGET = ("vtkHandleSet",)
QT = ("Q",)
PARAVIEW = ("pq", "vtkPV", "vtkSM")
TESTS = ("support/",)
# For each folder: prefixes of include paths that are forbidden in the folder and its subfolders. For each file, only
# the first folder that contains the file counts, so the plugin must be before filters.
FORBIDDEN = {
    PLUGIN: VIEWER + TESTS,
    "filters": VIEWER + HANDLE_WIDGET + QT + PARAVIEW + TESTS,
    "viewer": PARAVIEW + TESTS,
}
LARGEST_FOLDER = 30


NO_PROXY = {"vtkPictureFileReader"}  # ParaView has readers of pictures


def without_proxy():
    """Return one sentence for each filter that the plugin's XML does not mention, and for each name in the XML that is not
    a filter."""
    filters = {path.stem for path in (ROOT / "filters").glob("vtk*.h") if f"static {path.stem}* New()" in path.read_text()}
    filters -= NO_PROXY
    proxies = re.compile(r'<(?:SourceProxy|WriterProxy)\b[^>]*\bclass="(\w+)"')
    # Ignore base proxies: they refer to abstract classes, whose names end with Algorithm.
    named = {name for path in (ROOT / PLUGIN).rglob("*.xml") for name in proxies.findall(path.read_text())
             if not name.endswith("Algorithm")}
    return [f"{name} is either no filter or has no proxy in {PLUGIN}" for name in sorted(filters ^ named)]


def sources(folder):
    for path in sorted((ROOT / folder).rglob("*")):
        if path.suffix in (".h", ".cpp", ".cxx"):
            yield path, INCLUDE.findall(path.read_text())


def mutual_includes():
    """Return the pairs of units that include each other. A unit is a path without its extension."""
    roots = [ROOT / folder for folder in ("filters/core", "filters", "filters/files", "filters/handles", "filters/reader",
                                          "filters/support", "viewer", "viewer/widgets", "viewer/widgets/handles")]
    used = {}
    for folder in ("filters", "viewer"):
        for path, includes in sources(folder):
            unit = path.with_suffix("")
            for include in includes:
                found = [root / include for root in (path.parent, *roots) if (root / include).is_file()]
                if found and found[0].with_suffix("") != unit:
                    used.setdefault(unit, set()).add(found[0].with_suffix(""))
    pairs = {tuple(sorted((unit, other))) for unit, others in used.items() for other in others if unit in used.get(other, ())}
    return {tuple(path.relative_to(ROOT).as_posix() for path in pair) for pair in pairs}


def against_arrows(folder, prefix, arrows):
    """Return one sentence for each include that `arrows` does not allow.

    The path of an include consists of `prefix`, a subfolder of `folder`, and the file name. `arrows` contains, for
    each subfolder, the subfolders whose headers its files may include.
    """
    wrong = []
    for path, includes in sources(folder):
        room = path.relative_to(ROOT / folder).parts[0]
        for include in includes:
            inside = include.removeprefix(prefix)
            if include.startswith(prefix) and (ROOT / folder / inside).is_file():
                other = inside.split("/")[0]
                if other not in arrows[room]:
                    wrong.append(f"{path.relative_to(ROOT)} ({room}) includes {include} ({other})")
    return wrong


def forbidden_includes():
    """Return one sentence for each include that FORBIDDEN lists for the folder of the file."""
    wrong, read = [], set()
    for folder, forbidden in FORBIDDEN.items():
        for path, includes in sources(folder):
            wrong += [f"{path.relative_to(ROOT)} includes {include}" for include in includes
                      if path not in read and include.startswith(forbidden)]
            read.add(path)
    return wrong


def late_contexts():
    """Return one sentence for each function whose parameter ExecutionContext is not the first one."""
    return [f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, found.start()) + 1} has an ExecutionContext after another parameter"
            for folder in ("filters", "viewer", "tests") for path, _ in sources(folder) for text in [path.read_text()]
            for found in LATE_CONTEXT.finditer(text)]


def outside_of_namespace():
    """Return one sentence for each file in viewer/app/FOLDER without the namespace app::FOLDER."""
    return [f"{path.relative_to(ROOT)} has no namespace app::{path.parent.name}" for path, _ in sources("viewer/app")
            if f"namespace app::{path.parent.name}\n{{" not in path.read_text()]


def large_folders():
    """Return one sentence for each folder with too many source files."""
    counts = {}
    for folder in ("filters", "viewer", "python", "tests", "examples"):
        for path, _ in sources(folder):
            if path.parent != ROOT / "filters":
                counts[path.parent] = counts.get(path.parent, 0) + 1
    return [f"{path.relative_to(ROOT)} has {count} source files, of at most {LARGEST_FOLDER}"
            for path, count in counts.items() if count > LARGEST_FOLDER]


def forgotten_sources():
    """Return one sentence for each source file that no CMakeLists.txt names, so it is never compiled."""
    folders = ("filters", "viewer", "python", "tests", "examples")
    words = {pathlib.PurePath(word).name for folder in folders for path in (ROOT / folder).rglob("CMakeLists.txt")
             for word in re.findall(r"[\w./${}-]+", path.read_text())}
    # A name may contain a variable: pq${widget}PropertyWidget.cxx. Names of little else match too much.
    variable = re.compile(r"\$\{\w+\}")
    words = {word for word in words if word == variable.sub("", word) or len(pathlib.PurePath(variable.sub("", word)).stem) > 3}
    names = re.compile("|".join(r"\w+".join(map(re.escape, variable.split(word))) for word in words))
    # VTK classes are listed without the suffix.
    return [f"{path.relative_to(ROOT)} is in no CMakeLists.txt" for folder in folders for path, _ in sources(folder)
            if path.suffix in (".cpp", ".cxx") and path.name not in COMPILED_BY_SCRIPTS
            and not names.fullmatch(path.name) and not (path.stem.startswith("vtk") and path.stem in words)]


def main():
    core = list(sources("filters/core"))
    wrong = [f"{path.relative_to(ROOT)} names the VTK header {include}" for path, includes in core for include in includes
             if pathlib.PurePath(include).name.startswith("vtk")]
    wrong += against_arrows("filters/core", "", CORE_ARROWS)
    wrong += against_arrows("viewer/app", "app/", APP_ARROWS)
    wrong += late_contexts()
    wrong += outside_of_namespace()
    wrong += large_folders()
    wrong += forgotten_sources()
    wrong += forbidden_includes()
    wrong += without_proxy()
    wrong += [f"{one} and {other} include each other" for one, other in sorted(mutual_includes())]
    for line in wrong:
        print(line)
    count = len(core)
    print(f"{count} files of core read, {len(wrong)} rules of the house broken")
    return 1 if wrong or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
