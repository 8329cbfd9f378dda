"""Write the properties of ParaView's proxies: <Options set="NAME"/> in a template becomes the properties of a set."""

import copy
import re
import xml.etree.ElementTree
from xml.sax.saxutils import escape, quoteattr

from descriptions import MENTION, plain, vtk_name

MARK = re.compile(r"^( *)<Options set=\"(\w+)\"(?: filter=\"(\w+)\")?/>\n", re.MULTILINE)
ELEMENTS = {"flag": "IntVectorProperty", "choice": "IntVectorProperty", "integer": "IntVectorProperty",
            "integers": "IntVectorProperty", "id": "IdTypeVectorProperty", "word": "StringVectorProperty",
            "number": "DoubleVectorProperty",
            "numbers": "DoubleVectorProperty", "point_array": "StringVectorProperty", "cell_array": "StringVectorProperty"}


def default_text(option, filter_name):
    default = option.defaults.get(filter_name, option.default_of("paraview"))
    if option.type == "choice":
        return str(option.choices[default])
    if isinstance(default, bool):
        return str(int(default))
    if isinstance(default, list):
        return " ".join(plain(number) for number in default)
    return default if isinstance(default, str) else plain(default)


def array_list(option):
    """Return the XML of a domain that lists the arrays of an input. The template defines the array domain of this
    input."""
    if "input" not in option.fields:
        return []
    return [f'<ArrayListDomain name="arrays" input_domain_name="{option.type}s">', "  <RequiredProperties>",
            f'    <Property name="{option.fields["input"]}" function="Input"/>', "  </RequiredProperties>", "</ArrayListDomain>"]


def domain(option, filter_name):
    if option.type == "flag":
        return ['<BooleanDomain name="bool"/>']
    if option.type == "choice":
        entries = [f"  <Entry value=\"{value}\" text={quoteattr(option.label(word))}/>"
                   for word, value in option.choices.items()]
        return ['<EnumerationDomain name="enum">', *entries, "</EnumerationDomain>"]
    if option.type == "word":
        return ['<StringListDomain name="list">', *(f'  <String value="{word}"/>' for word in option.words),
                "</StringListDomain>"]
    if option.type.endswith("_array"):
        return array_list(option)
    fields = option.fields
    low = fields.get("minimums", {}).get(filter_name, fields.get("minimum", fields.get("above")))
    high = fields.get("maximum", fields.get("below"))
    limits = [f'{side}="{" ".join([plain(value)] * option.length)}"'
              for side, value in (("min", low), ("max", high)) if value is not None]
    kind = "DoubleRangeDomain" if option.type in ("number", "numbers") else "IntRangeDomain"
    return [f'<{kind} name="range" {" ".join(limits)}/>'] if limits else []


def hints(option):
    """Return the XML of an option's hints.

    An option is shown only for the methods that use it; no hint is needed if the whole set belongs to one method. An
    option that is the name of an input array has the hint NoDefault, because ParaView would otherwise select the first
    array of the input.
    """
    words = option.fields.get("methods", [])
    method = next((other for other in option.owner.options if other.name == "method"), None)
    lines = ["<NoDefault/>"] if "input" in option.fields else []
    if words and method:
        values = " ".join(str(method.choices.get(word, word)) for word in words)
        lines.append(f'<PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Method" values="{values}"/>')
    return ["<Hints>", *("  " + line for line in lines), "</Hints>"] if lines else []


def sentence(option):
    values = option.values_text()
    return MENTION.sub(lambda found: found[1].replace("_", " ").title(), option.help) + (f" {values[0].upper()}{values[1:]}." if values else "")


def property_lines(option, filter_name):
    name = vtk_name(option)
    element = ELEMENTS[option.type]
    advanced = ' panel_visibility="advanced"' if option.advanced else ""
    lines = [f'<{element} name="{name}" command="Set{name}" number_of_elements="{option.length}"',
             f"    default_values={quoteattr(default_text(option, filter_name))}{advanced}>"]
    inside = [*domain(option, filter_name), f"<Documentation>{escape(sentence(option))}</Documentation>", *hints(option)]
    return [*lines, *("  " + line for line in inside), f"</{element}>"]


def fill(template, sets):
    """Return the template with its marks replaced. A mark may name the filter whose defaults are used."""
    def properties(found):
        group = sets[found[2]]
        filter_name = found[3] or group.filter
        return "".join(f"{found[1]}{line}\n" for option in group.of_layer("paraview")
                       for line in property_lines(option, filter_name))
    return MARK.sub(properties, template)


def properties_of(proxy):
    """Return the properties and output ports of a proxy by name. Hints and documentation are not inherited."""
    return {element.get("name"): element for element in proxy if element.tag.endswith("Property") or element.tag == "OutputPort"}


def inherit(text, base_texts):
    """Return proxies with the properties of their base proxies in `base_texts`.

    ParaView can also inherit properties, but its help describes only properties in a proxy's own XML.
    """
    bases = {proxy.get("name"): proxy for base in base_texts for proxy in xml.etree.ElementTree.fromstring(base).iter("SourceProxy")}
    root = xml.etree.ElementTree.fromstring(text)
    for proxy in root.iter("SourceProxy"):
        base = bases.get(proxy.get("base_proxyname"))
        inherited = []
        while base is not None:
            own = properties_of(proxy)
            names = {element.get("name") for element in inherited}
            inherited = [copy.deepcopy(element) for name, element in properties_of(base).items()
                         if name not in own and name not in names] + inherited
            for name in ("base_proxygroup", "base_proxyname"):
                proxy.attrib.pop(name, None)
            base = bases.get(base.get("base_proxyname"))
        for element in proxy:
            element.attrib.pop("override", None)
        first = next((index for index, element in enumerate(proxy) if element.tag != "Documentation"), len(proxy))
        for offset, element in enumerate(inherited):
            proxy.insert(first + offset, element)
    xml.etree.ElementTree.indent(root)
    return xml.etree.ElementTree.tostring(root, encoding="unicode") + "\n"
