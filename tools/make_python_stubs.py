#!/usr/bin/env python3
"""Writes the type stubs of the compiled Python module: what a person typed, filled in from the module itself.

    PYTHONPATH=build/dev/python tools/make_python_stubs.py python/stubs FOLDER

The build runs it. Lines of python/stubs/*.pyi that say what to fill in:

    # FIELDS      settings of a configuration class, its constructor and copy(), from the list of its fields
    # TABLES      tables of a ping        # LAYERS     the same of a recording
    # MEASURES    measures of similarity
    # FUNCTIONS   functions of numbers or arrays that the file does not have, from their docstrings
"""

import pathlib
import re
import sys

import insonify._insonify as module

SIGNATURE = re.compile(r"^(\w+)\((.*)\) -> object$")
PARAMETER = re.compile(r"^(\w+): numpy\.ndarray\[numpy\.float64\]( = .*)?$")


def docstring(text, indent="    "):
    """A docstring on lines of its own, wrapped by nobody."""
    return f'{indent}r"""{text.strip()}"""'


def facts_of(class_name):
    return module._described[class_name]


def fields(class_name):
    """Attributes, constructor and copy() of a configuration."""
    owner = getattr(module, class_name)
    lines = []
    for name, read, _ in facts_of(class_name):
        lines += [f"    {name}: {read}", docstring(getattr(owner, name).__doc__)]
    given = "".join(f", {name}: {given} = ..." for name, _, given in facts_of(class_name))
    preset = ", preset: str = ..., mode: str = ..." if class_name == "SonarConfig" else ""
    return lines + [f"    def __init__(self, *{preset}{given}) -> None: ...",
                    f"    def copy(self, *{given}) -> {class_name}: ...",
                    f"    def __copy__(self) -> {class_name}: ...",
                    f"    def __deepcopy__(self, memo: dict[Any, Any]) -> {class_name}: ...",
                    "    def __eq__(self, other: Any) -> bool: ...",
                    "    __hash__: None  # type: ignore[assignment]"]


def read_only(class_name, owner, type_of):
    lines = []
    for name, read, _ in facts_of(class_name):
        lines += ["    @property", f"    def {name}(self) -> {type_of(name, read)}:",
                  docstring(getattr(owner, name).__doc__, " " * 8)]
    return lines


def table_type(name, numbers):
    """Only intensities are always there; `Any` spares those who asked for the others a test for None."""
    return f"npt.NDArray[np.{numbers}]" + ("" if name == "intensity" else " | Any")


def functions(owner, text):
    """Overloads for numbers and arrays of the functions that `text` does not have."""
    lines = []
    for name in sorted(vars(owner)):
        function = getattr(owner, name)
        if name.startswith("_") or not callable(function) or isinstance(function, type):
            continue
        if re.search(rf"\bdef {name}\(", text):
            continue
        first, _, rest = function.__doc__.partition("\n")
        signature = SIGNATURE.match(first)
        given = signature.group(2).split(", ") if signature and signature.group(2) else []
        parameters = [PARAMETER.match(one) for one in given]
        if not given or not all(parameters):
            raise SystemExit(f"make_python_stubs: {first}: not a function of numbers; type it in python/stubs")
        for kind, result, ignore in (("float", "float", "  # type: ignore"), ("_Values", "npt.NDArray[np.float64]", "")):
            listed = ", ".join(f"{one.group(1)}: {kind}" + (" = ..." if one.group(2) else "") for one in parameters)
            lines += ["@overload", f"def {name}({listed}) -> {result}:{ignore}", docstring(rest)]
    return lines


def filled(path):
    """The lines of a stub with what is marked filled in."""
    text = path.read_text(encoding="utf-8")
    owner = module if path.stem == "__init__" else getattr(module, path.stem)
    lines, class_name = [], ""
    for line in text.splitlines():
        started = re.match(r"class (\w+)", line)
        class_name = started.group(1) if started else class_name
        marker = line.strip()
        if marker == "# FIELDS":
            lines += fields(class_name)
        elif marker == "# TABLES":
            lines += read_only(class_name, getattr(owner, class_name), table_type)
        elif marker == "# LAYERS":
            lines += read_only(class_name, getattr(owner, class_name),
                               lambda name, _: "RecordedLayer" if name == "intensity" else "RecordedLayer | Any")
        elif marker == "# MEASURES":
            lines += read_only(class_name, getattr(owner, class_name), lambda _, read: read)
        elif marker == "# FUNCTIONS":
            lines += functions(owner, text)
        else:
            lines.append(line)
    return lines


def main():
    source, folder = map(pathlib.Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(source.glob("*.pyi")):
        (folder / path.name).write_text("\n".join(filled(path)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
