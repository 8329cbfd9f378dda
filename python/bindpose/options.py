"""Create signatures, documentation and checks of functions from the descriptions of options."""

import functools
import inspect
import operator
import re
import textwrap

import numpy as np

from .errors import InvalidInput
from .meshes import like
from .option_table import SETS, VERBS
from .running import ProgressBar

_ARRAYS = ("point_array", "cell_array")
_TYPE_NAMES = {"flag": "bool", "integer": "int", "id": "int", "number": "float", "text": "str, number or sequence",
               "point_array": "str or array_like, optional"}


def _type_text(option):
    """Return the type of an option, as in a numpydoc entry."""
    if option["type"] == "choice":
        text = "{" + ", ".join(repr(word) for word in option["choices"]) + "}"
    elif option["length"] > 1:
        text = f"{option['length']} {'integers' if option['type'] == 'integers' else 'numbers'}"
    else:
        text = _TYPE_NAMES[option["type"]]
    if option["type"] in _ARRAYS:
        return text
    return f"{text}, optional" if option["default"] is None else f"{text}, default {option['default']!r}"


def _listed(words):
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _entry(option):
    """Return a numpydoc entry: name, type and default; help, unit and range, methods that use the option."""
    text = option["help"]
    if option["values"]:
        text += f" {option['values'][0].upper()}{option['values'][1:]}."
    if option["defaults"]:
        text += " Default: the method's default."
    if option["type"] in _ARRAYS:
        text += f" Default: the array ``{option['array']}``, if it exists."
    if option["methods"]:
        text += f" Used by method{'s' if len(option['methods']) > 1 else ''} {_listed(option['methods'])}."
    body = textwrap.fill(text, 108, initial_indent=" " * 4, subsequent_indent=" " * 4, break_long_words=False)
    return f"{option['name']} : {_type_text(option)}\n{body}\n"


def _number(option, value):
    """Return the value as a number of the option's type, or None if it is not an allowed number."""
    try:
        number = operator.index(value) if option["type"] in ("integer", "integers", "id") else float(value)
    except (TypeError, ValueError):
        return None
    above, below = option.get("above"), option.get("below")
    inside = (number >= option.get("minimum", number) and number <= option.get("maximum", number) and
              (above is None or number > above) and (below is None or number < below))
    return number if inside and np.isfinite(number) else None


def _checked(option, value):
    """Return the value, converted to the option's type. Raise InvalidInput if the option does not allow it."""
    name = option["name"]
    if option["type"] in _ARRAYS or value is option["default"]:
        return value
    if option["type"] == "flag":
        return bool(value)
    if option["type"] == "text":
        if not isinstance(value, (str, int, float, list, tuple, np.ndarray, np.generic)):
            raise InvalidInput(f"{name} must be a text, a number or a sequence of them (got {value!r})")
        return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value
    if option["type"] == "choice":
        word = value.item() if isinstance(value, np.generic) else value
        if not isinstance(word, (str, int)) or word not in option["choices"]:
            raise InvalidInput(f"{name} must be one of {', '.join(map(str, option['choices']))} (got {value!r})")
        return word
    limits = f" ({option['values']})" if option["values"] else ""
    if option["length"] == 1:
        number = _number(option, value)
        if number is None:
            kind = "a number" if option["type"] == "number" else "an integer"
            raise InvalidInput(f"{name} must be {kind}{limits}, got {value!r}")
        return number
    values = np.ravel(value) if np.ndim(value) == 1 else ()
    numbers = tuple(_number(option, each) for each in values)
    if len(numbers) != option["length"] or None in numbers:
        raise InvalidInput(f"{name} must be {option['length']} numbers{limits}, got {value!r}")
    return numbers


class Options:
    """The checked options of a call, as attributes.

    Parameters
    ----------
    described : dict of name to description
    given : dict of name to value
        The values that the caller passed; all other options have their defaults.
    """

    def __init__(self, described, given):
        self._described = described
        for name, option in described.items():
            setattr(self, name, _checked(option, given[name]) if name in given else option["default"])
        method = getattr(self, "method", None)
        for name in given:
            users = described[name]["methods"]
            if method and users and method not in users and getattr(self, name) != described[name]["default"]:
                raise InvalidInput(f"{name} is not used by method {method!r} (used by {_listed(users)})")

    def apply(self, algorithm, *sets):
        """Pass the options of the sets to a filter; an option that is None gets the filter's default."""
        for option in (option for name in sets for option in SETS[name]):
            if not hasattr(self, option["name"]) or option["type"] in _ARRAYS:
                continue
            value = getattr(self, option["name"])
            if value is None:
                value = getattr(type(algorithm)(), "G" + option["setter"][1:])()
            elif option["type"] == "choice":
                value = option["choices"][value]
            arguments = value if isinstance(value, tuple) else (value,)
            getattr(algorithm, option["setter"])(*arguments)

    def words(self, verb):
        """Return the options of a verb that differ from their defaults, as words of the command line."""
        words = []
        for option in VERBS[verb]:
            value = getattr(self, option["name"])
            if value is None or value == option["default"] or value == "":
                continue
            if option["type"] == "flag":
                words.append(option["word"])
                continue
            parts = value if isinstance(value, (list, tuple)) else [value]
            commas = [part for part in parts if len(parts) > 1 and "," in str(part)]
            if commas:
                raise InvalidInput(f"an entry of {option['name']} must not contain a comma (got {commas[0]!r})")
            words.append(f"{option['word']}={','.join(map(str, parts))}")
        return words

    def arrays(self):
        """Yield (description, value) of each given option that names or contains an array."""
        for name, option in self._described.items():
            value = getattr(self, name)
            if option["type"] in _ARRAYS and value is not None:
                yield option, value


def _described(sets, only, without):
    return {option["name"]: option for name in sets for option in (SETS.get(name) or VERBS[name])
            if (only is None or option["name"] in only) and option["name"] not in without}


def checked_options(given, *sets):
    """Return the given options, which must be in one of the sets, as `Options`. Raise TypeError for an unknown name, as
    Python does for an unexpected keyword argument."""
    described = _described(sets, None, ())
    unknown = [name for name in given if name not in described]
    if unknown:
        raise TypeError(f"unexpected keyword argument {unknown[0]!r}")
    return Options(described, given)


def with_options(*sets, only=None, without=()):
    """Return a decorator that adds described options and a progress bar to a function of the package. The decorator
    also converts results to the class of the function's first argument, see `like`.

    The function has a keyword-only parameter ``options``, and a line ``{options}`` in the parameters of its docstring.
    The described options replace both; the function gets their values as an `Options` object. A function with
    ``**options`` gets the keywords as they were passed, and can check them by `checked_options` later. A function
    without options has neither the parameter nor the line.

    A function with a parameter ``progress`` also gets a parameter ``progress_bar``: whether to draw a bar on the
    standard error.

    Parameters
    ----------
    sets : str
        Names of sets of descriptions, or a verb of the program.
    only : sequence of str, optional
        Options to take. Default: all.
    without : sequence of str
        Options to leave out.
    """
    described = _described(sets, only, without)

    def decorate(function):
        signature = inspect.signature(function)
        names = signature.parameters
        source = next(iter(names))
        has_bar = "progress" in names and "progress_bar" not in names
        if "options" in names and names["options"].kind == inspect.Parameter.VAR_KEYWORD:
            wrapper = function
        else:
            @functools.wraps(function)
            def wrapper(*arguments, **keywords):
                if sets:
                    given = {name: keywords.pop(name) for name in described if name in keywords}
                    keywords["options"] = Options(described, given)
                if has_bar and keywords.pop("progress_bar", False):
                    keywords["progress"] = ProgressBar(keywords.get("progress"))
                result = function(*arguments, **keywords)
                return like(arguments[0] if arguments else keywords.get(source), result)

        wrapper.option_sets = sets
        wrapper.__signature__ = signature.replace(parameters=list(_public_parameters(names.values(), described, has_bar)))
        if sets:
            indent = re.search(r"^( *)\{options\}\n", function.__doc__, re.MULTILINE)[1]
            entries = textwrap.indent("".join(_entry(option) for option in described.values()), indent)
            wrapper.__doc__ = function.__doc__.replace(f"{indent}{{options}}\n", entries)
        return wrapper

    return decorate


def _public_parameters(parameters, described, has_bar):
    """Yield the parameters of a decorated function for its signature: described options instead of ``options``."""
    for parameter in parameters:
        if parameter.name == "options":
            for name, option in described.items():
                yield inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=option["default"])
        else:
            yield parameter
        if parameter.name == "progress" and has_bar:
            yield inspect.Parameter("progress_bar", inspect.Parameter.KEYWORD_ONLY, default=False)
