"""Read the descriptions of options: filters/core/*/*.options.json and viewer/cli/verbs.json.

A set describes options of one filter, or of several filters that share them. README.md beside this file lists the
fields. Everything that shows or parses options is generated from these descriptions.
"""

import json
import pathlib
import re

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LAYERS = ("vtk", "paraview", "python", "cli")
STAGE_TYPES = {"flag", "integer", "id", "number", "integers", "numbers", "choice", "word",
               "point_array", "cell_array"}
NUMBER_TYPES = ("integer", "id", "number")
VERB_TYPES = STAGE_TYPES | {"text", "path"}
SET_FIELDS = {"filter", "also", "methods_of", "methods", "options"}
OPTION_FIELDS = {"name", "type", "default", "help", "choices", "words", "labels", "minimum", "above", "maximum", "below", "unit",
                 "slider", "length", "advanced", "layers", "methods", "layer_defaults", "why", "defaults", "minimums", "columns",
                 "integers"}
STAGE_OPTION_FIELDS = OPTION_FIELDS | {"input", "output"}
VERB_OPTION_FIELDS = OPTION_FIELDS | {"short", "value", "required", "repeated", "optional", "unless", "set"}
UNITS = {"diagonals": "bounding-box diagonals"}


class DescriptionError(Exception):
    """A description is not valid; the message names the file and the option."""


def plain(number):
    """The shortest text of a number: 100, 0.02, 1e-06."""
    return f"{number:.15g}"


class Option:
    """One option of a set or of a verb."""

    def __init__(self, fields, where, owner=None):
        self.where = f"{where}: option '{fields.get('name', '?')}'"
        self.owner = owner
        self.fields = fields
        self.name = fields["name"]
        self.type = fields["type"]
        self.help = fields["help"]
        self.default = fields.get("default")
        self.choices = fields.get("choices", {})
        self.words = fields.get("words", list(self.choices))
        self.length = fields.get("length", 1)
        self.advanced = fields.get("advanced", False)
        self.layers = fields.get("layers", LAYERS)
        self.defaults = fields.get("defaults", {})

    def label(self, word):
        """The text of a choice in ParaView and in the window."""
        default = "Automatic" if word == "auto" else word.replace("-", " ").capitalize()
        return self.fields.get("labels", {}).get(word, default)

    def methods(self):
        """Return the names of the methods that use the option; empty if all methods use it."""
        return self.fields.get("methods") or (self.owner.methods if self.owner else [])

    def default_of(self, layer):
        return self.fields.get("layer_defaults", {}).get(layer, self.default)

    def default_text(self, layer):
        """The default as it is typed on the command line; empty if there is none."""
        default = self.default_of(layer)
        if default is None or isinstance(default, bool):
            return ""
        if isinstance(default, list):
            return ",".join(plain(number) for number in default)
        return default if isinstance(default, str) else plain(default)

    def range_text(self):
        """The allowed values in words: "0 to 20", "above 0", "at least 2"; empty if there is no limit."""
        low, above = self.fields.get("minimum"), self.fields.get("above")
        high, below = self.fields.get("maximum"), self.fields.get("below")
        end = f"below {plain(below)}" if below is not None else f"at most {plain(high)}" if high is not None else ""
        if above is not None:
            return f"above {plain(above)}" + (f" and {end}" if end else "")
        if low is not None:
            if high is not None:
                return f"{plain(low)} to {plain(high)}"
            return f"at least {plain(low)}" + (f" and {end}" if end else "")
        return end

    def values_text(self):
        """Unit and range: "degrees, 0 to 20"."""
        unit = self.fields.get("unit", "")
        return ", ".join(text for text in (UNITS.get(unit, unit), self.range_text()) if text)


class Set:
    """Options of one filter, or of several filters that share them."""

    def __init__(self, name, fields, where):
        self.name = name
        self.where = where
        self.filter = fields.get("filter", "")
        self.filters = [self.filter, *fields.get("also", [])] if self.filter else []
        self.methods_of = fields.get("methods_of", "")
        self.methods = fields.get("methods", [])
        self.options = [Option(option, f"{where}: set '{name}'", self) for option in fields["options"]]

    def of_layer(self, layer):
        return [option for option in self.options if layer in option.layers]


MENTION = re.compile(r"`([\w-]+)`")


def mentions(option):
    """Return the names in backticks in the help of an option; they must be names of options."""
    return MENTION.findall(option.help)


def vtk_name(option):
    """The name of the VTK property: winding_threshold -> WindingThreshold, rigidity -> RigidityArrayName."""
    name = "".join(word.capitalize() for word in option.name.split("_"))
    return name + "ArrayName" if option.type.endswith("_array") else name


def cli_name(option):
    """The name on the command line: winding_threshold -> winding-threshold; place_inside, on by default -> no-place-inside."""
    name = option.name.replace("_", "-")
    return f"no-{name}" if option.type == "flag" and option.default else name


def require(condition, where, sentence):
    if not condition:
        raise DescriptionError(f"{where}: {sentence}")


def check_default(option, default):
    """Check that a default has the option's type and is in the option's range."""
    where = option.where
    if option.type in ("choice", "word"):
        require(default in option.words, where, f"default {default!r} is not one of {', '.join(option.words)}")
        return
    if option.type == "flag":
        require(isinstance(default, bool), where, f"default {default!r} must be true or false")
        return
    if option.type in ("text", "path", "point_array", "cell_array"):
        require(isinstance(default, str), where, f"default {default!r} must be a string")
        return
    numbers = default if isinstance(default, list) else [default]
    require(len(numbers) == option.length, where, f"default needs {option.length} numbers")
    fields = option.fields
    for number in numbers:
        require(isinstance(number, (int, float)) and not isinstance(number, bool), where, f"{number!r} is not a number")
        require(not ("minimum" in fields and number < fields["minimum"]) and
                not ("maximum" in fields and number > fields["maximum"]) and
                not ("above" in fields and number <= fields["above"]) and
                not ("below" in fields and number >= fields["below"]), where, f"default {number} is out of range")


def check_option(option, allowed_fields, types):
    where, fields = option.where, option.fields
    unknown = sorted(set(fields) - allowed_fields)
    require(not unknown, where, f"unknown field '{unknown[0] if unknown else ''}'")
    require(option.type in types, where, f"unknown type '{option.type}'")
    require(option.help.endswith(".") and option.help[0].isalnum(), where, "help must be one or more sentences")
    require((option.type == "choice") == bool(option.choices), where,
            "'choices' is required for the type 'choice' and not allowed for other types")
    require((option.type == "word") == ("words" in fields), where,
            "'words' is required for the type 'word' and not allowed for other types")
    require(set(fields.get("labels", {})) <= set(option.choices), where,
            "labels may be given only for names in 'choices'")
    require(set(option.layers) <= set(LAYERS), where, f"each layer must be one of {', '.join(LAYERS)}")
    require("layer_defaults" not in fields or fields.get("why"), where,
            "'layer_defaults' requires the field 'why' with a reason")
    require("minimum" not in fields or "above" not in fields, where, "'minimum' and 'above' cannot both be given")
    require("maximum" not in fields or "below" not in fields, where, "'maximum' and 'below' cannot both be given")
    require(set(fields.get("layer_defaults", {})) <= {*LAYERS, "window"}, where,
            f"each key of 'layer_defaults' must be one of {', '.join(LAYERS)}, window")
    if "slider" in fields:
        require(option.type in NUMBER_TYPES, where,
                f"a slider is only allowed for the types {', '.join(NUMBER_TYPES)}")
        require(isinstance(fields["slider"], list) and len(fields["slider"]) == 2, where, "a slider must have two numbers")
        lowest, highest = fields["slider"]
        require(lowest <= option.default_of("window") <= highest, where, "the slider's range must contain the default")
        require(lowest >= fields.get("minimum", lowest) and highest <= fields.get("maximum", highest), where,
                "the slider's range must be within the limits of the option")
    for default in [option.default, *fields.get("layer_defaults", {}).values(), *option.defaults.values()]:
        if default is not None:
            check_default(option, default)


def check_array(option):
    """Check that an array option has either the field `input` or the field `output`, and other options have neither."""
    where, fields = option.where, option.fields
    if not option.type.endswith("_array"):
        require("input" not in fields and "output" not in fields, where,
                "'input' and 'output' are only allowed for the types point_array and cell_array")
        return
    require(("input" in fields) != ("output" in fields), where,
            "an array must have exactly one of the fields 'input' and 'output'")
    source = fields.get("input", "Input")
    require(isinstance(source, str) and re.fullmatch(r"[A-Z][A-Za-z]*", source), where,
            f"input {source!r} must be the name of a ParaView property, such as Input or Handles")
    require(fields.get("output", True) is True, where, "'output' must be true or left out")


def check_mentions(option, others, owner):
    """Check that the help of an option mentions only options of the same set or verb."""
    names = {other.name for other in others}
    unknown = [name for name in mentions(option) if name not in names]
    require(not unknown, option.where, f"help mentions '{unknown[0] if unknown else ''}', which is not an option of the {owner}")


def check_references(sets):
    """Check each option: its methods must be choices of the option `method`, and its help must mention known
    options."""
    known = {}
    for group in sets.values():
        for option in group.options:
            if option.name == "method":
                known[group.methods_of or group.name] = set(option.words)
    for group in sets.values():
        words = known.get(group.methods_of or group.name, set())
        for option in group.options:
            check_mentions(option, group.options, "set")
            strange = [word for word in option.methods() if word not in words]
            require(not strange, option.where, f"unknown method '{strange[0] if strange else ''}'")


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DescriptionError(f"{path}: {error}") from None


def option_files(source=SOURCE):
    return sorted((source / "filters" / "core").glob("*/*.options.json"))


def read_sets(source=SOURCE):
    """All sets by name."""
    sets = {}
    for path in option_files(source):
        where = path.relative_to(source)
        for name, fields in read_json(path).items():
            unknown = sorted(set(fields) - SET_FIELDS)
            require(not unknown, f"{where}: set '{name}'", f"unknown field '{unknown[0] if unknown else ''}'")
            require(name not in sets, where, f"set '{name}' is described twice")
            sets[name] = Set(name, fields, where)
            names = [option.name for option in sets[name].options]
            require(len(set(names)) == len(names), where, f"set '{name}' describes an option twice")
            for option in sets[name].options:
                require(option.default is not None, option.where, "a default is missing")
                check_option(option, STAGE_OPTION_FIELDS, STAGE_TYPES)
                check_array(option)
    check_references(sets)
    return sets


class Verb:
    """A verb of the command line. `options` contains the verb's own options and the options of its sets, in the order
    of --help."""

    def __init__(self, fields, sets, where):
        self.name = fields["name"]
        self.help = fields["help"]
        self.methods = []  # none: an option of a verb belongs to no method
        self.options = []
        self.sets = []
        own = []
        for entry in fields["options"]:
            if "set" in entry:
                require(entry["set"] in sets, f"{where}: verb '{self.name}'", f"unknown set '{entry['set']}'")
                self.sets.append(sets[entry["set"]])
                without = entry.get("without", [])
                strange = [name for name in without if name not in {option.name for option in self.sets[-1].options}]
                require(not strange, f"{where}: verb '{self.name}'",
                        f"set '{entry['set']}' has no option '{strange[0] if strange else ''}'")
                self.options += [option for option in self.sets[-1].of_layer("cli") if option.name not in without]
            else:
                own.append(verb_option(entry, f"{where}: verb '{self.name}'", self))
                self.options.append(own[-1])
        names = [cli_name(option) for option in self.options]
        twice = [name for name in names if names.count(name) > 1]
        require(not twice, f"{where}: verb '{self.name}'", f"option '{twice[0] if twice else ''}' is listed twice")
        for option in own:
            check_mentions(option, self.options, "verb")


def verb_option(fields, where, owner=None):
    option = Option(fields, where, owner)
    check_option(option, VERB_OPTION_FIELDS, VERB_TYPES)
    return option


def read_verbs(sets, source=SOURCE):
    """The verbs, and the options that all verbs have."""
    path = source / "viewer" / "cli" / "verbs.json"
    where = path.relative_to(source)
    table = read_json(path)
    return ([Verb(fields, sets, where) for fields in table["verbs"]],
            [verb_option(fields, f"{where}: common") for fields in table["common"]])
