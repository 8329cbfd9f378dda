"""Write the C++ of the command line: the table of verbs and options, and functions that pass options to filters."""

import json
import textwrap

from descriptions import MENTION, cli_name, plain, vtk_name

KINDS = {"flag": "flag", "text": "text", "path": "text", "point_array": "text", "cell_array": "text", "choice": "choice",
         "integer": "integer", "id": "integer", "number": "number", "integers": "integers", "numbers": "numbers"}
PLACEHOLDERS = {"degrees": "DEGREES", "seconds": "SECONDS", "microseconds": "MICROSECONDS", "MiB": "MIB",
                "diagonals": "FRACTION", "pixels": "PIXELS", "voxels": "VOXELS"}
TYPE_PLACEHOLDERS = {"integer": "N", "id": "N", "number": "NUMBER", "integers": "N,…", "numbers": "NUMBER,…",
                     "point_array": "ARRAY", "cell_array": "ARRAY"}
NOTE = "// Generated from the descriptions of options; see filters/options/README.md. Do not edit.\n"


def is_positional(option):
    return option.name.isupper()


def is_required(option):
    return option.fields.get("required", False) or (is_positional(option) and not option.fields.get("optional", False))


def placeholder(option):
    """Return the placeholder of the value in --help: DEGREES, N, METHOD."""
    if option.type == "flag" or is_positional(option):
        return ""
    by_name = option.name.replace("_", "-").split("-")[-1].upper()
    return option.fields.get("value") or PLACEHOLDERS.get(option.fields.get("unit")) or \
        TYPE_PLACEHOLDERS.get(option.type) or by_name


def typed_name(option):
    if is_positional(option):
        return option.name
    short = option.fields.get("short")
    return (f"-{short}," if short else "") + f"--{cli_name(option)}"


def quoted(text):
    """Return a C++ string literal, split into lines in the same way as the code formatter does."""
    lines = textwrap.wrap(text, 84, drop_whitespace=False, break_long_words=False) or [""]
    return "\n      ".join(json.dumps(line, ensure_ascii=False) for line in lines)


def listed(words):
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def help_text(option):
    """Return the text of an option in --help: its help with option names as typed on the command line, the methods that
    use the option, and defaults that differ between methods."""
    names = {other.name: f"--{cli_name(other)}" for other in (option.owner.options if option.owner else [])}
    text = MENTION.sub(lambda found: names[found[1]], option.help)
    if option.type == "flag" and option.default:
        text = "Off: " + text[0].lower() + text[1:]
    if option.methods():
        text += f" Used by method{'s' if len(option.methods()) > 1 else ''} {listed(option.methods())}."
    if option.defaults:
        text += " Default of other methods: " + ", ".join(
            f"{plain(value)} ({name[3:]})" for name, value in option.defaults.items()) + "."
    return text


def limit(option, inclusive, exclusive, missing):
    value = option.fields.get(inclusive, option.fields.get(exclusive))
    if value is None:
        return missing, "false"
    return plain(value), "true" if exclusive in option.fields else "false"


def row(option):
    fields = option.fields
    default = option.default_text("cli")
    lowest, above = limit(option, "minimum", "above", "-infinity")
    highest, below = limit(option, "maximum", "below", "infinity")
    cells = [json.dumps(typed_name(option)), json.dumps(placeholder(option), ensure_ascii=False),
             f"OptionKind::{KINDS[option.type]}", json.dumps(default), json.dumps("|".join(option.choices)),
             quoted(help_text(option)), json.dumps(option.values_text()),
             json.dumps("|".join(option.methods())), "true" if is_required(option) else "false",
             "true" if fields.get("repeated") else "false", json.dumps(fields.get("unless", "")),
             f"{{ {lowest}, {above}, {highest}, {below} }}", str(option.length)]
    return "      { " + ", ".join(cells) + " },\n"


def table(verbs, common):
    text = NOTE + '#include "cli/option_table.h"\n\n#include <limits>\n\nnamespace bindpose::cli\n{\n\n'
    text += "namespace\n{\nconstexpr double infinity = std::numeric_limits<double>::infinity();\n} // namespace\n\n"
    text += "const std::vector<Verb>& verbs()\n{\n  static const std::vector<Verb> table{\n"
    for verb in verbs:
        text += f"    {{ {json.dumps(verb.name)}, {quoted(verb.help)},\n      {{\n"
        text += "".join(row(option) for option in verb.options) + "      } },\n"
    text += "  };\n  return table;\n}\n\nconst std::vector<Option>& common_options()\n{\n"
    text += "  static const std::vector<Option> table{\n" + "".join(row(option) for option in common)
    return text + "  };\n  return table;\n}\n\n} // namespace bindpose::cli\n"


def argument(option):
    """Return the C++ arguments that pass the typed value of an option to a setter. For an option with several numbers,
    they are entries of the C++ variable `numbers`."""
    key = json.dumps(cli_name(option))
    if option.type == "flag":
        return "false" if option.default else "true"
    if option.type == "choice":
        pairs = ", ".join(f"{{ {json.dumps(word)}, {value} }}" for word, value in option.choices.items())
        return f"arguments.choice({key}, {{ {pairs} }})"
    if option.type in ("integer", "id"):
        return f"arguments.integer({key})"
    if option.type == "number":
        return f"arguments.number({key})"
    if option.type == "integers":
        return ", ".join(f"static_cast<int>(numbers[{k}])" for k in range(option.length))
    if option.type == "numbers":
        return ", ".join(f"numbers[{k}]" for k in range(option.length))
    return f"arguments.text({key})"


def setters(sets, verbs):
    """Return one C++ function per set that a verb uses. The function passes the typed options to a filter; all other
    parameters of the filter keep their values."""
    text = NOTE + "#ifndef bindpose_cli_set_options_h\n#define bindpose_cli_set_options_h\n\n"
    text += '#include "cli/arguments.h"\n\nnamespace bindpose::cli\n{\n\n'
    used = {group.name for verb in verbs for group in verb.sets}
    for name, group in sets.items():
        options = [option for option in group.of_layer("cli") if "vtk" in option.layers]
        if name not in used or not options:
            continue
        text += f"template <typename Filter>\nvoid set_{name}_options(const Arguments& arguments, Filter* filter)\n{{\n"
        for option in options:
            text += f"  if (arguments.is_typed({json.dumps(cli_name(option))}))\n  {{\n"
            if option.length > 1:
                text += f"    const std::vector<double> numbers = arguments.numbers({json.dumps(cli_name(option))});\n"
            text += f"    filter->Set{vtk_name(option)}({argument(option)});\n  }}\n"
            if option.default_of("cli") != option.default_of("vtk"):
                value = option.choices.get(option.default_of("cli"), option.default_of("cli"))
                text += f"  else\n  {{\n    filter->Set{vtk_name(option)}({value});\n  }}\n"
        text += "}\n\n"
    return text + "} // namespace bindpose::cli\n\n#endif\n"
