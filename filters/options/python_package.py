"""Write the Python package's table of options and the stubs of its modules."""

import ast
import pprint

from descriptions import MENTION, cli_name, vtk_name

NOTE = "# Generated from the descriptions of options; see filters/options/README.md. Do not edit.\n"
TYPES = {"flag": "bool", "integer": "int", "id": "int", "number": "float", "integers": "Sequence[int]",
         "numbers": "Sequence[float]", "text": "str | float | Sequence[str] | Sequence[float] | None",
         "point_array": "str | ArrayLike | None"}


def python_word(word):
    """Return the Python value of a choice: an integer for digits (such as the order of an energy), otherwise the
    word."""
    return int(word) if word.isdigit() else word


def render_options(verbs):
    """Return the options of the function `render`: those of the verb `render` except files."""
    render = next(verb for verb in verbs if verb.name == "render")
    return [option for option in render.options if option.type != "path"]


def entry(option):
    """Return the fields of an option that the Python package needs at run time."""
    fields = option.fields
    default = option.default_of("python")
    if option.type == "flag" and default is None:
        default = False
    if option.type == "choice":
        default = python_word(default)
    if option.type == "number" and default is not None:
        default = float(default)
    if option.defaults or option.type == "point_array":
        default = None  # None: the filter uses its own default
    return {"name": option.name.replace("-", "_"), "type": option.type,
            "default": tuple(default) if isinstance(default, list) else default,
            "choices": {python_word(word): value for word, value in option.choices.items()}, "length": option.length,
            "help": MENTION.sub(lambda found: f"`{found[1].replace('-', '_')}`", option.help),
            "values": option.values_text(), "methods": list(option.methods()), "defaults": dict(option.defaults),
            **{key: fields[key] for key in ("minimum", "above", "maximum", "below") if key in fields}}


def filter_entry(option):
    """Return the fields of an option that is passed to a filter."""
    return {**entry(option), "setter": f"Set{vtk_name(option)}", "array": option.default,
            "integers": option.fields.get("integers", False)}


def word_entry(option):
    """Return the fields of an option that is passed to the program."""
    return {**entry(option), "word": f"--{cli_name(option)}"}


def table(sets, verbs):
    groups = {name: [filter_entry(option) for option in group.of_layer("python")] for name, group in sets.items()}
    described = {name: options for name, options in groups.items() if options}
    words = {"render": [word_entry(option) for option in render_options(verbs)]}
    return (f'{NOTE}"""The options of filters, by set, and of the program, by verb."""\n\n'
            f"SETS = {pprint.pformat(described, width=120, sort_dicts=False)}\n\n"
            f"VERBS = {pprint.pformat(words, width=120, sort_dicts=False)}\n")


# ---- Stubs -----------------------------------------------------------------------------------------


def option_type(option):
    if option.type == "choice":
        return f"Literal[{', '.join(repr(python_word(word)) for word in option.choices)}]"
    optional = option.defaults or (option.type == "number" and option.default is None)
    return TYPES[option.type] + (" | None" if optional else "")


def described_options(function, sets, verbs):
    """Return the options that the decorator @with_options("NAME", …, only=…, without=…) gives to a function; None
    without the decorator."""
    for decorator in function.decorator_list:
        if isinstance(decorator, ast.Call) and getattr(decorator.func, "id", "") == "with_options":
            names = [argument.value for argument in decorator.args]
            words = {keyword.arg: ast.literal_eval(keyword.value) for keyword in decorator.keywords}
            described = {**{name: group.of_layer("python") for name, group in sets.items()}, "render": render_options(verbs)}
            return [option for name in names for option in described[name]
                    if option.name in words.get("only", [option.name]) and option.name not in words.get("without", ())]
    return None


def replace_argument(function, options):
    """Replace the argument `options` or `**options` by the described options."""
    arguments = function.args
    names = [argument.arg for argument in arguments.kwonlyargs]
    at = names.index("options") if "options" in names else len(names)
    if "options" not in names:
        arguments.kwarg = None
    defaults = [entry(option)["default"] for option in options]
    end = at + ("options" in names)
    arguments.kwonlyargs[at:end] = [
        ast.arg(option.name.replace("-", "_"), ast.parse(option_type(option), mode="eval").body) for option in options]
    arguments.kw_defaults[at:end] = [ast.parse(repr(default), mode="eval").body for default in defaults]


def without_body(function, sets, verbs):
    """Turn a function into its stub: list the described options as arguments; remove the body, and all decorators
    except `property`."""
    options = described_options(function, sets, verbs)
    if options is not None:
        if options:
            replace_argument(function, options)
        names = [argument.arg for argument in function.args.kwonlyargs]
        if "progress" in names and "progress_bar" not in names:
            function.args.kwonlyargs.append(ast.arg("progress_bar", ast.Name("bool")))
            function.args.kw_defaults.append(ast.Constant(False))
    function.decorator_list = [each for each in function.decorator_list if getattr(each, "id", "") == "property"]
    function.body = [ast.Expr(ast.Constant(...))]


def has_annotations(function):
    """Report whether a function has annotations. A function without annotations is used only within the package and
    gets no stub."""
    arguments = function.args
    return function.returns is not None or any(argument.annotation for argument in arguments.args + arguments.kwonlyargs)


def used_imports(imports, body):
    """Return the imports of names that a stub uses."""
    used = {node.id for part in body for node in ast.walk(part) if isinstance(node, ast.Name)}
    for node in imports:
        node.names = [each for each in node.names if (each.asname or each.name).partition(".")[0] in used]
    return [node for node in imports if node.names]


def stub(source, sets, verbs):
    """Return the stub of a module, as text: the declarations of its public functions and classes. The options of the
    sets that a function names in @with_options become its parameters."""
    tree = ast.parse(source)
    imports = [ast.parse(line).body[0] for line in
               ("from collections.abc import Sequence", "from typing import Literal", "from numpy.typing import ArrayLike")]
    body = []
    for node in tree.body:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            imports.append(node)
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and has_annotations(node):
            without_body(node, sets, verbs)
            body.append(node)
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            node.body = [child for child in node.body if not getattr(child, "name", "").startswith("_") or child.name == "__init__"]
            for child in node.body:
                if isinstance(child, ast.FunctionDef):
                    without_body(child, sets, verbs)
            body.append(node)
    return NOTE + ast.unparse(ast.fix_missing_locations(ast.Module([*used_imports(imports, body), *body], []))) + "\n"


def package_stub(source, classes):
    """Return the stub of the package, as text. It exports the functions and declares the VTK classes, whose methods
    have the type Any."""
    text = f"{NOTE}from typing import Any\n\n"
    for node in ast.parse(source).body:
        if isinstance(node, ast.ImportFrom) and node.names[0].name != "*":
            node.names = [ast.alias(each.name, each.name) for each in node.names if not each.asname]
            text += ast.unparse(node) + "\n" if node.names else ""
    text += ("\nclass _VTKType(type):\n    def __getattr__(cls, name: str) -> Any: ...\n\n"
             "class _VTKClass(metaclass=_VTKType):\n    def __init__(self) -> None: ...\n"
             "    def __getattr__(self, name: str) -> Any: ...\n\n")
    return text + "".join(f"class {name}(_VTKClass): ...\n" for name in sorted(classes))
