"""Pages of the Python reference: names in groups, signatures from the type stubs, texts from the docstrings.

    PYTHONPATH=build/release/python python3 tools/site/python_reference.py FOLDER    # writes FOLDER/python*.md, prints NAME TITLE

Methods between double underscores are left out, but for constructors.
"""

import ast
import html
import inspect
import pathlib
import re
import sys

# Pages, by the end of their file's name: title, what it is about, names.
GROUPS = {
    "pings": ("Make pings", "A scenario, the simulator that runs it, and its pings.",
              ["Simulator", "Scenario", "scene_names", "Scene", "Ping", "Line", "PingRequest", "Pose", "look_at", "load",
               "Recording", "NO_LABEL", "Error", "Warning"]),
    "recordings": ("Read, export and compare recordings", "Recordings of insonify and files of instruments.",
                   ["open", "RecordedPings", "RecordedLayer", "export", "compare"]),
    "pictures": ("Draw", "Pictures of pings as arrays of pixels.", ["draw_fan", "draw_polar", "fan", "to_db", "write_png"]),
    "sonar": ("Settings of a sonar", "The instrument and its receiver.",
              ["SonarConfig", "ReceiverConfig", "Sampling", "presets", "preset_names"]),
    "world": ("Settings of the world", "Water, materials, trajectories and what else a scenario has.",
              ["Water", "Material", "MaterialOverride", "materials", "material_library", "SeaSurface", "PointTarget", "Waypoint",
               "load_trajectory", "SurveyPattern", "SurveyLines", "MotionNoise", "PingSpan", "Motion", "Interferer", "Thruster", "PaperModel", "ViewConfig"]),
    "acoustics": ("Formulas of acoustics", "", []),
    "similarity": ("Measures of similarity", "", []),
    "survey": ("Products of side-scan lines", "", []),
}
SIGNATURE = re.compile(r"^\w+\(.*\)( -> .*)?$")
NAMED = re.compile(r"^([\w, *]{1,60}): (.*)$")


def sentences(text):
    """A docstring as Markdown: lines `name: meaning` become a list, and lines that continue one are joined to it."""
    lines = inspect.cleandoc(text or "").splitlines()
    while lines and (SIGNATURE.match(lines[0]) or not lines[0].strip()):  # What pybind11 and the stubs have anyhow.
        lines.pop(0)
    shown, listed, code = [], False, False
    for line in lines:
        named = NAMED.match(line)
        if not line.strip():
            shown.append("")
            listed = code = False
        elif line.startswith("    ") and not listed:
            shown += [] if code else ["", "```python"]
            shown.append(line[4:])
            code = True
            continue
        elif named and named[1].islower():
            shown += [] if listed else [""]
            shown.append(f"- **{named[1]}**: {escaped(named[2])}")
            listed = True
        elif listed and line.startswith(" "):
            shown[-1] += " " + escaped(line.strip())
        else:
            shown += ["", escaped(line)] if listed else [escaped(line)]
            listed = False
    return close_code("\n".join(shown).strip())


def close_code(text):
    """Ends each ```python block at the blank line after it."""
    parts, inside = [], False
    for line in text.split("\n"):
        if line == "```python":
            inside = True
        elif inside and not line.strip():
            parts.append("```")
            inside = False
        parts.append(line)
    return "\n".join(parts + (["```"] if inside else []))


def escaped(text):
    return re.sub(r"([*_<|\[\]])", r"\\\1", text) if "`" not in text else text.replace("|", r"\|")


def brief(text):
    return re.split(r"(?<=[.:])\s", re.sub(r"\s+", " ", sentences(text)).strip())[0].rstrip(":")


def stub(path):
    """Classes and functions of a file by name."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def signature(node, name):
    """The call, without the types' modules, wrapped between arguments where it is long."""
    arguments = ast.unparse(node.args)
    for first in ("self, ", "self", "cls, ", "cls"):
        arguments = arguments.removeprefix(first)
    returned = f" -> {ast.unparse(node.returns)}" if node.returns and name[0].islower() else ""
    text = f"{name}({arguments}){returned}".replace("npt.NDArray[np.", "ndarray[").replace("npt.NDArray[Any]", "ndarray")
    text = re.sub(r"\b_(PoseLike|Poses|Points|Settings|Path|Twist|Movable)\b", r"\1", text)
    text = text.replace("_Values", "float | ndarray")
    if len(text) > 100:
        text = re.sub(r", (?=\*?\*?\w+:|\*,)", ",\n    ", text)
    return f"```python\n{text}\n```"


def fields_table(owner, members):
    """The attributes of a class with their docstrings: [(name, type, text)] as a table."""
    lines = ["", "| Attribute | Type | Meaning |", "| --- | --- | --- |"]
    for name, kind, text in members:
        anchor = f"{owner}.{name}"
        meaning = html.escape(" ".join((text or "").split()), quote=False).replace("|", r"\|").replace("[", r"\[")
        kind = re.sub(r"npt\.NDArray\[np\.(\w+)\]", r"ndarray[\1]", kind).replace("npt.NDArray[Any]", "ndarray").replace("|", r"\|")
        lines.append(f'| <a id="{anchor}" href="#{anchor}">`{name}`</a> | `{kind}` | {meaning} |')
    return lines


def class_section(name, node, owner):
    lines = [f"## {name} {{ #{name} }}", "", sentences(owner.__doc__)]
    fields, methods = [], []
    for index, member in enumerate(node.body):
        if isinstance(member, ast.AnnAssign) and not member.target.id.startswith("_"):
            fields.append((member.target.id, ast.unparse(member.annotation), getattr(getattr(owner, member.target.id, None), "__doc__", "")))
        elif isinstance(member, ast.FunctionDef):
            decorators = [ast.unparse(d) for d in member.decorator_list]
            if "property" in decorators:
                fields.append((member.name, ast.unparse(member.returns) if member.returns else "",
                               getattr(getattr(owner, member.name, None), "__doc__", "")))
            elif member.name == "__init__" and len(member.args.kwonlyargs) < 12:
                lines += ["", signature(member, name)]
            elif not member.name.startswith("_") and not any(d.endswith(".setter") for d in decorators):
                methods.append(member)
    if fields:
        lines += fields_table(name, fields)
    seen = set()
    for method in methods:
        if method.name not in seen:
            lines += ["", f"### {name}.{method.name} {{ #{name}.{method.name} }}", ""]
        lines += [signature(method, method.name)]
        if method.name not in seen:
            lines += ["", sentences(getattr(owner, method.name).__doc__)]
        seen.add(method.name)
    return lines


def function_section(name, node, function):
    return [f"## {name} {{ #{name} }}", "", *([signature(node, name)] if node else []), "", sentences(function.__doc__)]


def module_page(title, module, nodes):
    lines = [f"# {title}", "", sentences(module.__doc__), "", f"`insonify.{module.__name__.split('.')[-1]}`"]
    for name in sorted((n for n in dir(module) if not n.startswith("_")), key=str.lower):
        thing, node = getattr(module, name), nodes.get(name)
        if inspect.isclass(thing):
            lines += ["", *class_section(name, node, thing)] if node else []
        elif callable(thing):
            lines += ["", *function_section(name, node, thing)]
        else:
            lines += ["", f"## {name}", "", f"`{thing!r}`"]
    return lines


def group_page(title, about, names, package, nodes):
    lines = [f"# {title}", "", about]
    for name in names:
        thing, node = getattr(package, name), nodes.get(name)
        if name == "fan":
            lines += ["", "## fan { #fan }", "", "The same as [draw_fan](#draw_fan)."]
        elif inspect.isclass(thing) and node is not None:
            lines += ["", *class_section(name, node, thing)]
        elif callable(thing):
            lines += ["", *function_section(name, node, thing)]
        else:
            lines += ["", f"## {name} {{ #{name} }}", "", f"`{thing!r}`: the index that bins without an echo have in the tables of labels."]
    return lines


def overview(package):
    lines = ["# Python reference", "", "Made from the docstrings of the package; `help(insonify.Simulator)` prints the same. "
             "[From Python](../how-to/python.md) shows how it is used.", ""]
    for end, (title, about, members) in GROUPS.items():
        lines += [f"## [{title}](python-{end}.md)", "", about or brief(getattr(package, end).__doc__), ""]
        lines += [f"- [`{name}`](python-{end}.md#{name}): {brief(getattr(package, name).__doc__)}" if name != "NO_LABEL" else
                  f"- [`NO_LABEL`](python-{end}.md#NO_LABEL): marks bins without an echo" for name in members]
        lines.append("")
    return lines


def add_new_names(names):
    """Public names that no group has go to the first, and a line says so."""
    left = sorted(set(names) - {n for group in GROUPS.values() for n in group[2]} - {*GROUPS, "__version__"})
    if left:
        print(f"tools/site/python_reference.py: in no group: {', '.join(left)}", file=sys.stderr)
        GROUPS["pings"][2].extend(left)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    import insonify as package
    folder, home = pathlib.Path(sys.argv[1]), pathlib.Path(package.__file__).parent
    nodes = {**stub(home / "_insonify/__init__.pyi"), **stub(home / "__init__.py")}
    for file in ("_catalogue", "_compare", "_layers", "_levels", "_pictures", "_pose"):
        nodes.update(stub(home / f"{file}.py"))
    add_new_names(package.__all__)
    pages = {"": overview(package)}
    for end, (title, about, names) in GROUPS.items():
        pages["-" + end] = (group_page(title, about, names, package, nodes) if names else
                            module_page(title, getattr(package, end), stub(home / f"_insonify/{end}.pyi")))
    for end, lines in pages.items():
        (folder / f"python{end}.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
        print(f"python{end}.md", lines[0].removeprefix("# ") if end else "Overview")


if __name__ == "__main__":
    main()
