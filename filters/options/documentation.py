"""Write the tables of options in viewer/command_line.md."""

from command_line import help_text, is_required, placeholder, typed_name

BEGIN, END = "<!-- options -->\n", "<!-- end of the options -->\n"
HEAD = "| option | values | default | meaning |\n|---|---|---|---|\n"


def row(option):
    name = typed_name(option).split(",")[0] + ("…" if option.fields.get("repeated") else "")
    value = placeholder(option)
    default = "required" if is_required(option) and not option.fields.get("unless") else option.default_text("cli")
    values = ", ".join(text for text in (", ".join(option.choices), option.values_text()) if text)
    return f"| `{name}{' ' + value if value else ''}` | {values} | {default} | {help_text(option)} |\n"


def tables(verbs, common):
    """The tables of all verbs as Markdown."""
    text = ""
    for verb in verbs:
        text += f"### `bindpose {verb.name}`\n\n{verb.help}\n\n{HEAD}" + "".join(map(row, verb.options)) + "\n"
    return text + f"### Every verb\n\n{HEAD}" + "".join(map(row, common))


def page(text, verbs, common):
    """Return the text of the page, with the new tables between the marks BEGIN and END."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return before + BEGIN + tables(verbs, common) + END + after
