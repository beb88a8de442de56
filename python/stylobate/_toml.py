"""Python values as TOML text."""

import json
import math
import numbers
import os

from ._core import InputError


def value(thing, key):
    """The text of a value. `key` is for messages."""
    if hasattr(thing, "tolist"):  # of NumPy
        thing = thing.tolist()
    if isinstance(thing, bool):
        return "true" if thing else "false"
    if isinstance(thing, numbers.Integral):
        return str(int(thing))
    if isinstance(thing, numbers.Real):
        number = float(thing)
        if math.isnan(number):
            return "nan"
        return repr(number) if math.isfinite(number) else ("inf" if number > 0 else "-inf")
    if isinstance(thing, (str, os.PathLike)):
        return json.dumps(os.fspath(thing), ensure_ascii=False)  # a string of JSON is one of TOML
    if isinstance(thing, dict):
        return "{ " + ", ".join(f"{_key(k)} = {value(v, f'{key}.{k}')}" for k, v in thing.items()) + " }"
    if isinstance(thing, (list, tuple)):
        return "[" + ", ".join(value(each, key) for each in thing) + "]"
    raise InputError(f"{key} is a {type(thing).__name__}; a study has numbers, texts, true or false, lists and tables")


def document(tables):
    """The text of a study: a table for each key of `tables`, in their order."""
    lines = []
    for name, table in tables.items():
        if not isinstance(table, dict):
            raise InputError(f"{name} is a {type(table).__name__}; a study has tables, such as "
                             '{"structure": {"kind": "column"}}')
        lines.append(f"[{_key(name)}]")
        lines += [f"{_key(k)} = {value(v, f'{name}.{k}')}" for k, v in table.items()]
    return "\n".join(lines) + "\n"


def _key(name):
    if not isinstance(name, str):
        raise InputError(f"{name!r} is no name of a key; names are texts")
    plain = name and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if plain else json.dumps(name, ensure_ascii=False)
