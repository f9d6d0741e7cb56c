#!/usr/bin/env python3
"""Checks that functions below src/ fit on a screen: bodies of at most 50 lines.

    tools/check_functions.py [FOLDER...]    # from the repository root; exit status 1 where one is longer
"""

import pathlib
import re
import sys

MOST_LINES = 50

# Comments, raw strings, strings and characters, in which braces mean nothing.
TEXTS = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)
SCOPE = re.compile(r"\b(namespace|struct|class|union|enum|extern)\b")


def blank(match):
    """As many lines without a brace."""
    return "\n" * match.group().count("\n") or " "


def functions_of(text):
    """First line and lines within the braces of each function; those of a local class or lambda are lines of their function."""
    text = TEXTS.sub(blank, text)
    text = re.sub(r"^\s*#(?:.*\\\n)*.*$", blank, text, flags=re.MULTILINE)
    inside, head, line, open_line = [], "", 1, 0
    for char in text:
        line += char == "\n"
        if char == "{":
            # A scope holds functions, anything else holds none: what is open around it says which it is.
            signature = re.sub(r"template\s*<[^{}]*?>\s*(?=struct|class)", "", head)
            outermost = all(kind == "scope" for kind in inside)
            if outermost and SCOPE.search(signature) and "(" not in re.sub(r"alignas\([^)]*\)", "", signature):
                inside.append("scope")
            elif outermost and "(" in head and not re.search(r"[^=!<>]=[^=]*$", head.rsplit(")", 1)[-1]) and \
                    not re.match(r"[^(]*[^=!<>]=(?!=)", head):
                inside.append("function")
                open_line = line
            else:
                inside.append("other")
            head = ""
        elif char == "}":
            if inside and inside.pop() == "function":
                yield open_line, max(0, line - open_line - 1)
            head = ""
        elif char == ";":
            head = ""
        else:
            head += char


def main():
    found = 0
    for folder in sys.argv[1:] or ["src"]:
        for file in sorted(p for p in pathlib.Path(folder).rglob("*") if p.suffix in (".h", ".cpp")):
            for line, length in functions_of(file.read_text()):
                if length > MOST_LINES:
                    print(f"{file}:{line}: a function of {length} lines; {MOST_LINES} at most")
                    found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
