"""Write the C++ header of the window: words, labels, ranges and defaults of the stages' options."""

import json

from command_line import NOTE
from descriptions import plain

HEAD = """#ifndef document_stage_options_h
#define document_stage_options_h

#include "document/options.h"

/// Options of the stages, in one namespace per set of the descriptions.
namespace stage_options
{

struct Choices
{
  int initial; ///< index of the default
  std::vector<OptionChoice> choices;
};

/// A number with the range of its slider.
struct Number
{
  double initial;
  double lowest;
  double highest;
};

"""


def constant(option):
    """Return the definition of an option; empty if the window cannot show it."""
    default = option.default_of("window")
    if option.type == "choice":
        cells = ", ".join(f"{{ {json.dumps(word)}, QT_TRANSLATE_NOOP(\"Document\", {json.dumps(option.label(word))}), {value} }}"
                          for word, value in option.choices.items())
        return f"inline const Choices {option.name}{{ {option.words.index(default)}, {{ {cells} }} }};\n"
    if "slider" in option.fields:
        lowest, highest = option.fields["slider"]
        return f"inline const Number {option.name}{{ {plain(default)}, {plain(lowest)}, {plain(highest)} }};\n"
    return ""


def header(sets):
    text = NOTE + HEAD
    for group in sets.values():
        constants = "".join(constant(option) for option in group.options)
        if constants:
            text += f"namespace {group.name}\n{{\n{constants}}} // namespace {group.name}\n\n"
    return text + "} // namespace stage_options\n\n#endif\n"
