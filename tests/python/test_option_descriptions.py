"""Descriptions of options: the VTK setters match them, and a new description appears in all generated layers."""

import ast
import inspect
import json
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import bindpose
import pytest
from bindpose.meshes import to_dataset

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "filters" / "options"))
import descriptions  # noqa: E402

SETS = descriptions.read_sets()
# Options of abstract classes are tested on a class that derives from them.
CONCRETE = {"vtkWeightsAlgorithm": "vtkBoundedBiharmonicWeights", "vtkPoseAlgorithm": "vtkSkinningDeformation"}
CASES = [(group, name, option) for group in SETS.values() for name in group.filters for option in group.of_layer("vtk")]


def instance(name):
    return getattr(bindpose, CONCRETE.get(name, name))()


def accessors(algorithm, option):
    name = descriptions.vtk_name(option)
    return getattr(algorithm, f"Set{name}"), getattr(algorithm, f"Get{name}")


@pytest.mark.parametrize("group, name, option", CASES, ids=lambda case: getattr(case, "name", str(case)))
def test_defaults_are_those_of_the_description(group, name, option):
    _set, get = accessors(instance(name), option)
    expected = option.defaults.get(name, option.default_of("vtk"))
    if option.type == "choice":
        expected = option.choices[expected]
    if isinstance(expected, list):
        expected = tuple(expected)
    assert get() == (pytest.approx(expected, rel=1e-14) if option.type == "number" else expected)


@pytest.mark.parametrize("group, name, option", CASES, ids=lambda case: getattr(case, "name", str(case)))
def test_ranges_are_those_of_the_description(group, name, option):
    """Check that every allowed end of a range is accepted. Some setters clamp to these ends. For the other setters, the
    kernel checks the range.
    """
    set_, get = accessors(instance(name), option)
    if option.type == "choice":
        for value in option.choices.values():
            set_(value)
            assert get() == value
        return
    if option.type not in ("integer", "id", "number"):
        return
    low = option.fields.get("minimums", {}).get(name, option.fields.get("minimum"))
    high = option.fields.get("maximum")
    for end, beyond in ((low, -1), (high, 1)):
        if end is None:
            continue
        set_(end)
        assert get() == end
        set_(end + beyond)
        assert get() in (end, end + beyond)


def test_weight_methods_are_those_of_the_registry():
    described = SETS["weights_method"].options[0].words
    solver = bindpose.vtkUnconstrainedWeights()
    solver.SetInputData(0, to_dataset(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])))
    solver.SetInputData(1, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]))
    solver.SetMethod("best")
    with pytest.raises(bindpose.InvalidInput) as error:
        bindpose.run(solver)
    registry = str(error.value).split("expected one of ")[1].split(", ")
    assert ["bounded-biharmonic", "monotone", *registry] == described
    assert SETS["unconstrained_weights"].options[0].words == registry


def test_every_bind_and_pose_setter_is_described():
    """Check that every setter with a getter is described as an option, in the filters that have descriptions.
    Exceptions are listed here.
    """
    others = {"AbortExecute", "ProgressText", "NumberOfThreads", "InputData", "ReleaseDataFlag", "Debug", "ReferenceCount",
              "Step", "NumberOfSteps", "Interactive", "GlobalWarningDisplay", "ObjectName", "ErrorCode", "Information",
              "Executive", "ProgressObserver"}
    for name in {name for group in SETS.values() for name in group.filters}:
        described = {descriptions.vtk_name(option) for group in SETS.values() if name in group.filters or
                     (name in ("vtkBoundedBiharmonicWeights", "vtkMonotoneWeights", "vtkUnconstrainedWeights") and
                      group.filter == "vtkWeightsAlgorithm") or
                     (issubclass(getattr(bindpose, name), bindpose.vtkPoseAlgorithm) and group.filter == "vtkPoseAlgorithm")
                     for option in group.options}
        if name == "vtkWeightedColors" or name == "vtkDepthOrder":
            described.add("ArrayName")
        members = dir(getattr(bindpose, name))
        setters = {member[3:] for member in members if member.startswith("Set") and f"Get{member[3:]}" in members}
        base = {member[3:] for member in dir(bindpose.vtkBindposeAlgorithm) if member.startswith("Set")}
        assert setters - base - others - described == set(), name


# ---- The Python package ----------------------------------------------------------------------------


def test_signature_documentation_and_stub():
    signature = inspect.signature(bindpose.tetrahedralize)
    assert list(signature.parameters)[:2] == ["surface", "handles"]
    assert list(signature.parameters)[-3:] == ["threads", "progress", "progress_bar"]
    stub = ast.parse((pathlib.Path(bindpose.__file__).parent / "functions.pyi").read_text(encoding="utf-8"))
    function = next(node for node in stub.body if getattr(node, "name", "") == "tetrahedralize")
    stubbed = {argument.arg for argument in function.args.kwonlyargs}
    assert "progress_bar" in stubbed
    for option in SETS["tetrahedralize"].of_layer("python"):
        assert signature.parameters[option.name].default == option.default
        assert signature.parameters[option.name].kind == inspect.Parameter.KEYWORD_ONLY
        assert re.search(rf"^    {option.name} : ", bindpose.tetrahedralize.__doc__, re.MULTILINE)
        assert option.name in stubbed
    assert "{options}" not in bindpose.tetrahedralize.__doc__


@pytest.mark.parametrize("keywords, sentence", [
    ({"method": "best"}, "method must be one of auto, cdt, remesh, embed, wrap, ftetwild (got 'best')"),
    ({"quality": 21}, "quality must be a number (degrees, 0 to 20), got 21"),
    ({"quality": "high"}, "quality must be a number (degrees, 0 to 20), got 'high'"),
    ({"quality": float("nan")}, "quality must be a number"),
    ({"winding_threshold": 0}, "winding_threshold must be a number (above 0), got 0"),
    ({"resolution": 2.5}, "resolution must be an integer (0 to 1000), got 2.5"),
    ({"method": "cdt", "wrap_alpha": 0.1}, "wrap_alpha is not used by method 'cdt' (used by wrap)"),
])
def test_what_an_option_does_not_allow_is_named(keywords, sentence):
    with pytest.raises(bindpose.InvalidInput) as error:
        bindpose.tetrahedralize(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), **keywords)
    assert sentence in str(error.value)


def test_vectors_need_their_length():
    triangle = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    for bounds in ((0, 1), "0,1,0,1,0,1", 3, (0, 1, 0, 1, 0, float("inf"))):
        with pytest.raises(bindpose.InvalidInput, match="bounds must be 6 numbers"):
            bindpose.winding_number(triangle, 4, bounds=bounds)


# ---- A new option ----------------------------------------------------------------------------------


def copy_of_the_descriptions(folder):
    for path in [*descriptions.option_files(), *(ROOT / "filters" / "options").glob("*.py"), ROOT / "viewer" / "cli" / "verbs.json",
                 ROOT / "viewer" / "command_line.md", *(ROOT / "filters" / "paraview" / "plugin").glob("*.xml"),
                 *(ROOT / "python" / "bindpose").glob("*.py")]:
        target = folder / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)
    return folder / "filters" / "core" / "inside" / "tetrahedralize.options.json"


def generate(folder, *words):
    return subprocess.run([sys.executable, "-B", folder / "filters" / "options" / "generate.py", *words], capture_output=True,
                          text=True, check=False)


def add_option(path, **fields):
    sets = json.loads(path.read_text(encoding="utf-8"))
    sets["tetrahedralize"]["options"].append({"name": "made_up", "type": "number", "default": 0.25, "minimum": 0, "maximum": 2,
                                              "unit": "degrees", "help": "An option that a test made up.", **fields})
    path.write_text(json.dumps(sets), encoding="utf-8")


def test_a_described_option_is_everywhere(tmp_path):
    add_option(copy_of_the_descriptions(tmp_path), slider=[0, 1])
    out = tmp_path / "out"
    for words in (["option-table", out], ["set-options", tmp_path / "set"], ["window", tmp_path / "window"],
                  ["paraview", tmp_path / "filters" / "paraview" / "plugin" / "inside.xml", tmp_path / "xml"],
                  ["python-table", tmp_path / "table.py"],
                  ["python-stub", tmp_path / "python" / "bindpose" / "functions.py", tmp_path / "stub"],
                  ["page", tmp_path / "viewer" / "command_line.md", tmp_path / "page"]):
        done = generate(tmp_path, *words)
        assert done.returncode == 0, done.stderr
    assert '"--made-up", "DEGREES", OptionKind::number, "0.25"' in out.read_text()
    assert 'filter->SetMadeUp(arguments.number("made-up"))' in (tmp_path / "set").read_text()
    assert "const Number made_up{ 0.25, 0, 1 };" in (tmp_path / "window").read_text()
    proxies = xml.etree.ElementTree.parse(tmp_path / "xml")
    element = proxies.find(".//DoubleVectorProperty[@name='MadeUp']")
    assert element.get("default_values") == "0.25" and element.find("DoubleRangeDomain").get("max") == "2"
    assert element.find("Documentation").text == "An option that a test made up. Degrees, 0 to 2."
    assert "'name': 'made_up'" in (tmp_path / "table.py").read_text()
    assert "made_up: float=0.25" in (tmp_path / "stub").read_text()
    assert "| `--made-up DEGREES` | degrees, 0 to 2 | 0.25 | An option that a test made up. |" in (tmp_path / "page").read_text()


def test_arrays_are_listed_from_the_input_of_the_template(tmp_path):
    """Check every ArrayListDomain: it names an input of its proxy, and one of the InputArrayDomains of this input."""
    for template in (ROOT / "filters" / "paraview" / "plugin").glob("*.xml"):
        done = generate(ROOT, "paraview", template, tmp_path / template.name)
        assert done.returncode == 0, done.stderr
    trees = [xml.etree.ElementTree.parse(path) for path in tmp_path.glob("*.xml")]
    proxies = {proxy.get("name"): proxy for tree in trees for proxy in tree.iter() if proxy.tag in ("SourceProxy", "WriterProxy")}

    def inputs(proxy):
        own = {element.get("name"): element for element in proxy.findall("InputProperty")}
        base = proxies.get(proxy.get("base_proxyname"))
        return {**(inputs(base) if base is not None else {}), **own}

    count = 0
    for name, proxy in proxies.items():
        for domain in proxy.iter("ArrayListDomain"):
            required = inputs(proxy)[domain.find("RequiredProperties/Property").get("name")]
            domains = [element.get("name") for element in required.findall("InputArrayDomain")]
            assert domain.get("input_domain_name") in domains, name
            count += 1
    assert count > 20


@pytest.mark.parametrize("fields, sentence", [
    ({"name": "quality"}, "set 'tetrahedralize' describes an option twice"),
    ({"type": "real"}, "unknown type 'real'"),
    ({"defualt": 1}, "unknown field 'defualt'"),
    ({"default": 3}, "default 3 is out of range"),
    ({"default": "much"}, "'much' is not a number"),
    ({"help": "no sentence"}, "help must be one or more sentences"),
    ({"help": "See `nothing`."}, "help mentions 'nothing', which is not an option of the set"),
    ({"methods": ["best"]}, "unknown method 'best'"),
    ({"layer_defaults": {"vtk": 1}}, "'layer_defaults' requires the field 'why' with a reason"),
    ({"layer_defaults": {"windows": 1}, "why": "It is."},
     "each key of 'layer_defaults' must be one of vtk, paraview, python, cli, window"),
    ({"slider": 1}, "a slider must have two numbers"),
    ({"slider": [1, 2]}, "the slider's range must contain the default"),
    ({"slider": [0, 3]}, "the slider's range must be within the limits of the option"),
    ({"slider": [0, 1], "type": "flag", "default": True}, "a slider is only allowed for the types integer, id, number"),
    ({"above": 0}, "'minimum' and 'above' cannot both be given"),
    ({"choices": {"a": 0}}, "'choices' is required for the type 'choice'"),
    ({"type": "point_array", "default": "Rigidity"}, "an array must have exactly one of the fields 'input' and 'output'"),
    ({"type": "cell_array", "default": "Color", "input": "Handles", "output": True},
     "an array must have exactly one of the fields 'input' and 'output'"),
    ({"type": "point_array", "default": "Rigidity", "input": "input"}, "input 'input' must be the name of a ParaView property"),
    ({"type": "point_array", "default": "Result", "output": "Input"}, "'output' must be true or left out"),
    ({"input": "Input"}, "'input' and 'output' are only allowed for the types point_array and cell_array"),
])
def test_a_wrong_description_is_named(tmp_path, fields, sentence):
    add_option(copy_of_the_descriptions(tmp_path), **fields)
    done = generate(tmp_path, "check")
    assert done.returncode == 1
    assert "tetrahedralize.options.json" in done.stderr and sentence in done.stderr, done.stderr
