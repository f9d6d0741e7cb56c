#!/usr/bin/python3
"""Collects the pictures of runs in one page that needs nothing beside it.

    tools/make_gallery.py build/demo    # writes build/demo/index.html

Each folder in the one named is a run of `insonify run SCENE --channels -o FOLDER/SCENE`, with what it printed in log.txt
if that was kept; scenes/SCENE.yaml says in its first comment what it is. A folder SCENE_calibrated is the same scene in the
calibrated model: its pings are set beside the other's, with the first comment of scenes/SCENE_calibrated.yaml, which says what
one sees, under them. The scenes of the paper come first, in its order.
"""

import base64
import html
import pathlib
import re
import sys

CALIBRATED = "_calibrated"
SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"

# Scenes that belong side by side, and what is said over them.
GROUPS = [
    ("Wrecked ferry", ["ferry"]),
    ("Subsea cooler among pipelines", ["cooler"]),
    ("Destroyed car", ["car"]),
    ("Subsea Christmas tree", ["christmas_tree"]),
    ("SSIV mock-up", ["ssiv"]),
    ("Test tank", ["tank"]),
    ("Attenuation: one cone, two waters", ["cone_clear", "cone_absorbing"]),
    ("A sphere over a flat bottom", ["sphere"]),
]

STYLE = """
:root { color-scheme: dark }
body { margin: 0 auto; max-width: 1500px; padding: 2rem; background: #16191e; color: #cfd6dd;
       font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif }
h1, h2 { color: #f0f3f6; font-weight: 600 } h2 { margin: 3rem 0 .3rem }
nav a { color: #8fc7ff; margin-right: 1.2em } p { max-width: 75ch; margin: .3rem 0 1rem }
.scene { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 560px), 1fr)); gap: 1rem; align-items: start }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 560px), 1fr)); gap: 1rem }
.pair .scene { grid-template-columns: 1fr }
figure { margin: 0 } img { width: 100%; border-radius: 4px } figcaption { color: #97a2ad; font-size: .875rem }
.run { color: #97a2ad; font-size: .875rem; margin-bottom: .6rem }
"""

KINDS = [
    ("view", "The scene as a camera sees it; yellow is what the sonar insonifies"),
    ("channels", "The two channels by direction at the first ping: pulse distance and echo intensity"),
    ("fan", "{moment}, model: {model}"),
    ("scan", "The whole scan, model: {model}"),
]


def scene_of(folder):
    """The scene's name."""
    return folder.name.removesuffix(CALIBRATED)


def scene_file(folder):
    """Text of the scenario that was run, or none if it is not a shipped one."""
    path = SCENES / f"{folder.name}.yaml"
    return path.read_text(encoding="utf-8") if path.exists() else ""


def model_of(folder):
    """The model of the echo: the scene's own, or the default."""
    asked = re.search(r"^model: (\w+)", scene_file(folder), re.MULTILINE)
    return asked[1] if asked else "calibrated"


def runs_of(folder):
    """The folder, and that of the same scene in the calibrated model."""
    twin = folder.with_name(folder.name + CALIBRATED)
    return [folder, twin] if twin.is_dir() else [folder]


def pictures_of(folder):
    """The picture of each kind with its caption, of the last ping where there are several."""
    found = {}
    for path in sorted(folder.glob("*.png")):
        match = re.fullmatch(r".*_(view|fan|scan|channels)(_\d+)?", path.stem)
        if match and not (match[1] == "scan" and match[2]):
            found[match[1]] = path
    model = {"paper": "paper (linear)", "calibrated": "calibrated (decibels)"}[model_of(folder)]
    number = int(re.search(r"(\d+)$", found["fan"].stem)[1]) if "fan" in found else 0
    moment = f"The last ping, number {number}" if number > 0 else "The ping"
    seen = f". {description_of(folder)}" if folder.name.endswith(CALIBRATED) else ""
    return [
        (found[kind], caption.format(model=model, moment=moment) + (seen if kind in ("fan", "scan") else ""))
        for kind, caption in KINDS
        if kind in found
    ]


def description_of(folder):
    """The comment that the scene's file begins with."""
    lines = []
    for line in scene_file(folder).splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# "))
    return " ".join(lines)


def said_of(folder):
    """What the run said of its pings and its speed."""
    log = folder / "log.txt"
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return [line.strip() for line in lines if re.search(r"\d pings? of |pings/s to compute", line)]


def figure(scene, path, caption):
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    text = html.escape(caption)
    alt = html.escape(f"{scene}: {caption.split('. ')[0]}")
    return f'<figure><img src="data:image/png;base64,{data}" alt="{alt}"><figcaption>{text}</figcaption></figure>'


def section(title, folders):
    columns = []
    for folder in folders:
        runs = [f"{model_of(run)}: " + "; ".join(said_of(run)) for run in runs_of(folder) if said_of(run)]
        names = " and ".join(f"scenes/{run.name}.yaml" for run in runs_of(folder))
        lines = "<br>".join(html.escape(line) for line in [names, *runs])
        pictures = "".join(figure(title, *picture) for run in runs_of(folder) for picture in pictures_of(run))
        description = html.escape(description_of(folder))
        columns.append(
            f"<div>{f'<p>{description}</p>' if description else ''}"
            f'<div class="run">{lines}</div><div class="scene">{pictures}</div></div>'
        )
    inside = "\n".join(columns)
    if len(columns) > 1:
        inside = f'<div class="pair">{inside}</div>'
    return f'<h2 id="{folders[0].name}">{html.escape(title)}</h2>\n{inside}'


def page(root):
    folders = {path.name: path for path in sorted(root.iterdir()) if path.is_dir() and pictures_of(path)}
    for twin in [name + CALIBRATED for name in folders]:
        folders.pop(twin, None)
    groups = [(title, [folders.pop(name) for name in names if name in folders]) for title, names in GROUPS]
    groups += [(name.replace("_", " ").capitalize(), [folder]) for name, folder in folders.items()]
    groups = [(title, members) for title, members in groups if members]
    links = "".join(f'<a href="#{members[0].name}">{html.escape(title)}</a>' for title, members in groups)
    body = "\n".join(section(title, members) for title, members in groups)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>insonify: scenes</title>'
        f'<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head>\n<body><h1>insonify: scenes</h1>'
        "<p>What <code>./dev demo</code> has just computed: the scenes of Cerqueira et al. (2020), rebuilt, and the tutorial&#x27;s "
        "sphere, each as a camera and as its sonar sees it, in the paper&#x27;s model and in the calibrated one.</p>"
        f"<nav>{links}</nav>\n{body}\n</body></html>\n"
    )


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    (root / "index.html").write_text(page(root), encoding="utf-8")
    print(root / "index.html")


if __name__ == "__main__":
    main()
