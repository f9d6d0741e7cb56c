"""Messages of calls that the compiled module refuses: which argument is wrong, where pybind11 would list types of C++."""

from __future__ import annotations

import difflib
import functools
import numbers
import re
import types
from typing import Any, Callable

import numpy as np

from . import _insonify

KINDS: dict[str, tuple[str, Any]] = {
    "str": ("text", str),
    "bool": ("True or False", (bool, np.bool_)),
    "int": ("a whole number", numbers.Integral),
    "float": ("a number", numbers.Real),
    "dict": ("a dict", dict),
}


def _parameters(doc: str) -> tuple[list[tuple[str, str, bool]], int]:
    """Name, type and whether it must be given, of each parameter of the signature that pybind11 writes; how many of them
    may be given by their place."""
    signature = re.search(r"\w+\((.*)\) -> ", doc)
    parts = re.split(r",\s*(?![^(\[]*[)\]])", signature.group(1)) if signature else []
    found: list[tuple[str, str, bool]] = []
    by_place = None
    for part in parts:
        by_place = len(found) if part == "*" else by_place
        name, _, rest = part.partition(":")
        if name and name[0] != "*" and name != "self":
            found.append((name, rest.split(" = ")[0].strip(), " = " not in rest))
    return found, len(found) if by_place is None else by_place


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names) or "none"


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else text[:77] + "..."


def _fits(value: Any, kind: str) -> tuple[bool, str]:
    """Whether a value is of a kind in pybind11's words, and that kind in ours."""
    if kind.startswith("numpy.ndarray"):
        try:
            np.asarray(value, dtype=np.float32)
            return True, ""
        except (TypeError, ValueError):
            return False, "an array of numbers"
    if kind.startswith("insonify."):
        name = kind.rpartition(".")[2]
        return isinstance(value, getattr(_insonify, name, object)), f"a {name}"
    words, expected = KINDS.get(kind, ("", object))
    return isinstance(value, expected) and not (kind in ("int", "float") and isinstance(value, bool)), words


def _refusal(name: str, doc: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Exception:
    """The error for a call with arguments that the function does not take."""
    known, by_place = _parameters(doc)
    names = [one for one, _, _ in known]
    takes = f"it takes {_listed(names)}"
    if not known and "**kwargs" in doc:
        return TypeError(f"{name}() takes its fields by keyword, not {_shown(args[0])}" if args else f"{name}() cannot be called so")
    for given in kwargs:
        if given not in names:
            near = difflib.get_close_matches(given, names, 1)
            return TypeError(f"{name}() has no argument {given!r}; " + (f"did you mean {near[0]}?" if near else takes))
    if len(args) > by_place:
        named = f", the last {len(names) - by_place} by their names" if by_place < len(names) else ""
        return TypeError(f"{name}() was given {len(args)} arguments without a name; {takes}{named}")
    values = dict(zip(names, args))
    for given in kwargs:
        if given in values:
            return TypeError(f"{name}() was given {given} twice, by its place and by its name")
    values.update(kwargs)
    for one, kind, needed in known:
        if one not in values and needed:
            return TypeError(f"{name}() needs {one}; {takes}")
        fits, words = _fits(values[one], kind) if one in values else (True, "")
        if not fits:
            return _insonify.Error(f"{one} = {_shown(values[one])} must be {words}")
    return TypeError(f"{name}() does not take {_listed([_shown(one) for one in values.values()])}; {takes}")


def _explained(function: Callable[..., Any], name: str, bound: bool) -> Callable[..., Any]:
    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            if "incompatible" not in str(error) or "The following argument types are supported" not in str(error):
                raise
        raise _refusal(name, function.__doc__ or "", args[1:] if bound else args, kwargs)

    return call


def explain_refusals(owner: Any) -> None:
    """Replaces the public functions of a module of pybind11 and of its classes by ones that explain what they refuse."""
    for name, member in list(vars(owner).items()):
        is_init = name == "__init__" and not isinstance(member, types.WrapperDescriptorType)
        if isinstance(member, type) and isinstance(owner, types.ModuleType):
            if not issubclass(member, BaseException):
                explain_refusals(member)
        elif isinstance(member, staticmethod):
            setattr(owner, name, staticmethod(_explained(member.__func__, name, False)))
        elif callable(member) and (name[0] != "_" or is_init):
            bound = isinstance(owner, type)
            setattr(owner, name, _explained(member, owner.__name__ if is_init else name, bound))


for _module in (_insonify, _insonify.acoustics, _insonify.similarity, _insonify.survey):
    explain_refusals(_module)
