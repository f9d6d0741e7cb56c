"""Pages of the C++ reference: one for each public header, from what Doxygen reads of its comments.

    python3 tools/site/cpp_reference.py XML FOLDER    # XML: Doxygen's folder; writes FOLDER/cpp/*.md and FOLDER/cpp.md
"""

import html
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

HEADERS = pathlib.Path(__file__).resolve().parents[2] / "include"


def escaped(text):
    return re.sub(r"([\\`*_\[\]|])", r"\\\1", html.escape(text or "", quote=False))


class Pages:
    def __init__(self, folder):
        self.compounds = [root.find("compounddef") for root in (xml.parse(p).getroot() for p in sorted(folder.glob("*.xml")))
                          if root.find("compounddef") is not None]
        self.places = {}  # Where each thing is: page and anchor.
        for compound in self.compounds:
            if compound.get("kind") in ("struct", "class"):
                self.place(compound, self.short(compound.findtext("compoundname")))
            for member in compound.iter("memberdef"):
                self.place(member, self.short(member.findtext("qualifiedname") or member.findtext("name")))

    def place(self, element, name):
        location = element.find("location")
        if location is not None and location.get("file", "").startswith("insonify/"):
            self.places[element.get("id")] = (location.get("file"), re.sub(r"[^\w.]+", "-", name.replace("::", ".")).strip("-"))

    @staticmethod
    def short(name):
        return name.removeprefix("insonify::")

    def text(self, element, here):
        """Markdown of a description's children, in one line but for paragraphs."""
        if element is None:
            return ""
        parts = [escaped(element.text)]
        for child in element:
            parts += [self.element(child, here), escaped(child.tail)]
        return "".join(parts)

    def element(self, child, here):
        tag = child.tag
        if tag == "computeroutput":
            return f"`{''.join(child.itertext())}`"
        if tag == "ref":
            return self.link(child, here)
        if tag == "para":
            return self.text(child, here).strip() + "\n\n"
        if tag == "verbatim":
            return f"\n\n```text\n{(child.text or '').strip(chr(10))}\n```\n\n"
        if tag == "listitem":
            return "- " + self.text(child, here).strip() + "\n"
        if tag in ("itemizedlist", "orderedlist"):
            return "\n\n" + "".join(self.element(item, here) for item in child) + "\n"
        if tag == "parameterlist":
            items = []
            for item in child.iter("parameteritem"):
                names = ", ".join(f"`{''.join(n.itertext())}`" for n in item.iter("parametername"))
                items.append(f"- {names}: {self.text(item.find('parameterdescription'), here).strip()}")
            kind = {"exception": "Throws:", "param": "", "templateparam": "Template parameters:"}.get(child.get("kind"), "")
            return f"\n\n{kind}\n\n" + "\n".join(items) + "\n\n"
        if tag == "simplesect":
            words = {"return": "Returns ", "see": "See ", "note": "Note: "}.get(child.get("kind"), "")
            return "\n\n" + words + self.text(child, here).strip() + "\n\n"
        if tag == "ndash":
            return "–"
        if tag == "table":
            rows = ["| " + " | ".join(self.text(cell, here).strip().replace("\n", " ") for cell in row) + " |" for row in child]
            return "\n\n" + "\n".join([rows[0], "|" + " --- |" * (rows[0].count(" | ") + 1), *rows[1:]]) + "\n\n"
        return self.text(child, here)

    def link(self, child, here):
        words = escaped("".join(child.itertext()))
        if child.get("refid") not in self.places:
            return words
        file, anchor = self.places[child.get("refid")]
        return f"[{words}]({'' if file == here else relative(file, here)}#{anchor})"

    def description(self, element, here):
        both = [self.text(element.find(kind), here).strip() for kind in ("briefdescription", "detaileddescription")]
        return re.sub(r"\n{3,}", "\n\n", "\n\n".join(part for part in both if part))

    def brief(self, element, here):
        return re.sub(r"\s+", " ", self.description(element, here)).strip()

    def functions(self, members, here, level):
        lines, seen = [], set()
        for member in members:
            name = self.places.get(member.get("id"), ("", ""))[1]
            if name not in seen:
                lines += [f"{'#' * level} {html.escape(member.findtext('name'), quote=False)}() {{ #{name} }}", ""]
            seen.add(name)
            lines += ["```cpp", self.declaration(member), "```", "", self.description(member, here), ""]
        return lines

    @staticmethod
    def declaration(member):
        template = member.find("templateparamlist")
        first = "" if template is None else "template <" + ", ".join(
            " ".join("".join(p.itertext()).split()) for p in template.iter("param")) + ">\n"
        returned = "".join(member.find("type").itertext())
        arguments = re.sub(r"(?<![=!<>])=(?!=)", " = ", member.findtext("argsstring") or "")
        static = "static " if member.get("static") == "yes" else ""
        text = tidy(f"{static}{returned} {member.findtext('name')}{arguments}")
        return first + (re.sub(r", (?![^<(]*>)", ",\n    ", text) if len(text) > 110 else text) + ";"

    def variables(self, members, here, head):
        lines = [f"| {head} | Meaning |", "| --- | --- |"]
        for member in members:
            anchor = self.places[member.get("id")][1]
            kind = "".join(member.find("type").itertext())
            initializer = member.find("initializer")
            value = "" if initializer is None else " ".join("".join(initializer.itertext()).split())
            value = f" `{value}`" if 3 < len(value) < 40 else ""
            declared = tidy(f"{kind} {member.findtext('name')}").replace("|", r"\|")
            lines.append(f'| <a id="{anchor}" href="#{anchor}">`{declared}`</a>{value} | '
                         f"{self.brief(member, here)} |")
        return [*lines, ""]

    def enums(self, members, here, level):
        lines = []
        for member in members:
            name = member.findtext("name")
            lines += [f"{'#' * level} enum {name} {{ #{self.places[member.get('id')][1]} }}", "", self.description(member, here),
                      "", "| Value | Meaning |", "| --- | --- |"]
            lines += [f"| `{v.findtext('name')}` | {self.brief(v, here)} |" for v in member.iter("enumvalue")] + [""]
        return lines

    def members(self, compound, here, level):
        """Enumerations, variables and functions of a class or a header, in this order."""
        found = [m for m in compound if m.get("prot") != "private" and m.get("id") in self.places and not is_special(m)]
        kinds = {kind: [m for m in found if m.get("kind") == kind] for kind in ("enum", "typedef", "variable", "function")}
        lines = self.enums(kinds["enum"], here, level)
        if kinds["variable"]:
            lines += self.variables(kinds["variable"], here, "Field" if level == 3 else "Constant")
        if kinds["typedef"]:
            lines += self.variables(kinds["typedef"], here, "Type")
        return lines + self.functions(kinds["function"], here, level)

    def page(self, header):
        about = purpose(header)
        lines = [f"# {header}", "", about[:1].upper() + about[1:], "",
                 f"```cpp\n#include <{header}>\n```", ""]
        classes = [c for c in self.compounds if c.get("kind") in ("struct", "class") and self.places.get(c.get("id"), ("",))[0] == header]
        for compound in sorted(classes, key=lambda c: int(c.find("location").get("line"))):
            name = self.places[compound.get("id")][1]
            lines += [f"## {compound.get('kind')} {html.escape(self.short(compound.findtext('compoundname')), quote=False)} {{ #{name} }}", "",
                      self.description(compound, header), ""]
            lines += self.members([m for s in compound.iter("sectiondef") for m in s.iter("memberdef")], header, 3)
        free = [m for c in self.compounds if c.get("kind") == "namespace" and c.findtext("compoundname").startswith("insonify")
                for m in c.iter("memberdef") if self.places.get(m.get("id"), ("",))[0] == header]
        lines += self.members(sorted(free, key=lambda m: int(m.find("location").get("line"))), header, 2)
        return "\n".join(lines) + "\n", about


def purpose(header):
    """What the comment at the head of a file says that it is for."""
    named = re.match(r"// \S+ -- ((?:.*\n//)*.*)", (HEADERS / header).read_text(encoding="utf-8"))
    words = " ".join((named[1] if named else "").replace("\n//", " ").split())
    return re.sub(r"([*_\[\]|])", r"\\\1", html.escape(re.split(r"(?<=[.])\s+(?=[A-Z])", words)[0], quote=False))


def is_special(member):
    """Destructors, and what is copied, moved or deleted."""
    name, arguments = member.findtext("name"), member.findtext("argsstring") or ""
    return name.startswith("~") or name == "operator=" or arguments.endswith(("=default", "=delete")) or "&&) noexcept" in arguments


def tidy(declaration):
    """A declaration with spaces as clang-format sets them."""
    text = re.sub(r"\s*([&*]+)\s*(?=[\w.])", r"\1 ", " ".join(declaration.split()))
    return re.sub(r"\s*([&*]+)(?=[,)>])", r"\1", text.replace("< ", "<").replace(" >", ">"))


def page_name(header):
    return header.removeprefix("insonify/").removesuffix(".h")


def relative(file, here):
    return "../" * (page_name(here).count("/")) + page_name(file) + ".md"


def write_pages(folder, target):
    """Writes the pages; returns the navigation: [(name, page)]."""
    pages, rows, names = Pages(folder), {"": [], "acoustics/": []}, []
    for path in sorted((HEADERS / "insonify").rglob("*.h"), key=lambda p: (len(p.parts), p)):
        header = path.relative_to(HEADERS).as_posix()
        text, about = pages.page(header)
        file = target / "cpp" / (page_name(header) + ".md")
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        part = "acoustics/" if "/acoustics/" in header else ""
        rows[part].append(f"| [{header}](cpp/{page_name(header)}.md) | {about} |")
        names.append((page_name(header).removeprefix("acoustics/") + ".h", f"cpp/{page_name(header)}.md"))
    head = ["| Header | Is for |", "| --- | --- |"]
    lines = ["# C++ reference", "", "All public headers, from their comments. [The C++ interface](cpp.md) says which to include for what.",
             "", *head, *rows[""], "", "## Formulas", "", *head, *rows["acoustics/"]]
    (target / "cpp_headers.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return names


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write_pages(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
