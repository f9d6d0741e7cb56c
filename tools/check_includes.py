#!/usr/bin/env python3
"""Checks that includes point upstream only, so that data can flow one way.

    tools/check_includes.py            # from the repository root; exit status 1 on a violation

The chain below is the architecture. A file may include its own module and any module to its left. In the larger modules
a folder is a room: ROOMS says which rooms a file in it may include. Files in a module's own folder may include them all.
"""

import pathlib
import re
import sys

CHAIN = ["base", "gpu", "acoustics", "scene", "sonar", "echo", "receiver", "survey", "image", "pattern", "simulator"]

# Modules at the edge: which internal headers they may include, and that nothing in the chain may include them. Public
# headers are open to all of them.
EDGE = {"io": CHAIN, "view": CHAIN, "live": [*CHAIN, "io"], "wire": CHAIN, "similarity": ["base"], "apps": [], "python": [], "ros": [], "web": [], "bench": []}

# Rooms of a module, and the other rooms of that module that each may include; "*" is any room not named, "." the
# module's own folder.
ROOMS = {
    "echo": {
        "laws": [],
        "grid": ["laws"],
        "model": ["laws", "grid"],
        "rays": ["laws", "grid", "model"],
        "mirror": ["laws", "grid", "model"],
        "batch": ["laws", "grid", "model", "."],
        "thin": ["laws", "grid", "model", "batch", "."],
        "targets": ["laws", "grid", "model", "mirror", "batch", "thin", "."],
        "walks": ["laws", "grid", "model", "batch"],
        "*": ["laws", "grid", "model", "rays", "mirror", "batch", "."],  # Engines, each a room.
    },
    "receiver": {
        "array": ["."],
        "pulse": ["."],
        "speckle": ["pulse", "."],
        "noise": ["array", "."],
    },
    "io": {
        "file": [],
        "message": [],
        "picture": ["file"],
        "grid": ["file", "picture"],
        "mesh": ["file", "picture"],
        "world": ["file", "picture", "grid", "mesh"],
        "sdf": ["file", "picture", "grid", "mesh", "world"],
        "stonefish": ["file", "picture", "grid", "mesh"],
        "scenario": ["file", "stonefish", "world"],
        "recording": ["file"],
        "foreign": ["file"],
        "mcap": ["file", "message"],
        "bag": ["file"],
        "recorded": ["file", "foreign", "recording", "mcap"],
        "reader": ["file", "foreign", "picture", "grid", "mesh", "recording"],
        "export": ["file", "picture", "message", "recorded", "bag"],
    },
    "apps": {
        "console": [],
        "pictures": ["console"],
        "run": ["console", "pictures"],
        "replay": ["console", "pictures", "serve"],
        "transport": ["console"],
        "emulate": ["console", "transport"],
        "bridge": ["console", "transport"],
        "ros1": ["console", "transport"],  # Of apps/bridges/, each a program.
        "dds": ["console", "transport"],
        "gazebo": ["console", "transport"],
        "*": ["console", "pictures"],  # Commands, each a room.
    },
}

# Folders whose files include each other by paths that begin there; elsewhere paths begin at src/.
ROOTS = {"apps": ("apps/insonify/", "apps/bridges/")}

# Libraries that stay in one place: headers that begin so are included there and nowhere else in src/ and apps/.
LIBRARIES = {"CLI/": "apps/insonify/console/", "boost/beast": "apps/insonify/serve/net/", "embree": "src/echo/embree.h", "assimp": "src/io/mesh/", "sdf/": "src/io/sdf/", "yaml-cpp": "src/io/scenario/", "zstd": "src/io/mcap/", "jpeglib": "src/io/picture/"}

# The module that each public header speaks for. Those in a folder of include/insonify/ speak for the module of its name.
PUBLIC = {
    "insonify.h": "apps",  # All of them; for programs only.
    "error.h": "base",
    "field.h": "base",
    "geometry.h": "base",
    "interrupted.h": "base",
    "log.h": "base",
    "printable.h": "base",
    "version.h": "base",
    "words.h": "base",
    "settings_table.h": "base",
    "water.h": "acoustics",
    "material.h": "scene",
    "interferer.h": "scene",
    "thruster.h": "scene",
    "point_target.h": "scene",
    "mesh.h": "scene",
    "relief.h": "scene",
    "scene.h": "scene",
    "sea_surface.h": "scene",
    "array_pattern.h": "sonar",
    "bearing_grid.h": "sonar",
    "scan.h": "sonar",
    "pulse.h": "sonar",
    "sonar_config.h": "sonar",
    "receiver_config.h": "sonar",
    "ground_truth.h": "echo",
    "sounding.h": "echo",
    "engine.h": "echo",
    "paper_model.h": "echo",
    "ping.h": "receiver",
    "picture.h": "image",
    "channels.h": "image",
    "waterfall.h": "image",
    "draw_mosaic.h": "image",
    "draw_sounding_grid.h": "image",
    "mosaic_files.h": "io",
    "sounding_grid_files.h": "io",
    "pattern.h": "pattern",
    "bed_heights.h": "pattern",
    "ping_request.h": "simulator",
    "scenario.h": "simulator",
    "scenario_requests.h": "simulator",
    "scattering.h": "scene",
    "scene_files.h": "io",
    "scene_view.h": "view",
    "simulator.h": "simulator",
    "describe.h": "io",
    "files.h": "io",
    "messages.h": "io",
    "mcap_recording.h": "io",
    "ping_sink.h": "io",
    "marker.h": "io",
    "recording_formats.h": "io",
    "export.h": "io",
    "recording_info.h": "io",
    "rock.h": "io",
    "world_parts.h": "io",
    "live_loop.h": "live",
    "live_sender.h": "live",
    "recorded_pings.h": "io",
    "sound_speed_files.h": "io",
    "stored_tables.h": "io",
    "similarity.h": "similarity",
    "survey_plan.h": "view",
}

INCLUDE = re.compile(r'^\s*#include "([^"]+)"')
SYSTEM_INCLUDE = re.compile(r"^\s*#include <([^>]+)>")


def public_module(parts):
    """Module of a public header, by its path below include/insonify/; None if it is not known."""
    return parts[0] if len(parts) > 1 else PUBLIC.get(parts[0].removesuffix(".in"))


def module_of(path):
    """Module of a source path relative to the root; None if it belongs to none (src/simulator.cpp is the simulator's)."""
    parts = pathlib.PurePosixPath(path).parts
    if parts[0] == "include":
        return public_module(parts[2:])
    if parts[0] == "src":
        return pathlib.PurePosixPath(parts[1]).stem
    return parts[0]


def room_of(path, module):
    """Room of a source path or quoted include, "." for the module's own folder; None outside its module."""
    path = path.removeprefix("src/")
    if module in ROOTS and not path.startswith("insonify/"):
        for root in ROOTS[module]:
            path = path.removeprefix(root)
        path = f"{module}/{path}"
    parts = pathlib.PurePosixPath(path).parts
    if module not in ROOMS or parts[0] != module:
        return None
    return parts[1] if len(parts) > 2 else "."


def rights_of(module, room):
    """The other rooms of its module that a room may include; None for a room that is not known."""
    return ROOMS[module].get(room, ROOMS[module].get("*"))


def room_violation(module, room, include):
    """Why a file of `room` may not include the quoted path of its own module, or None if it may."""
    target = room_of(include, module)
    if room in (None, ".") or target in (None, room) or target in rights_of(module, room):
        return None
    return f"is in the folder {module}/" if target == "." else f"is in the room {module}/{target}"


def library_violation(file, include):
    """Why a file below src/ or apps/ may not include <include>, or None if it may."""
    for library, home in LIBRARIES.items():
        if include.startswith(library) and not file.startswith(home):
            return f"belongs in {home}"
    return None


def violation(module, include):
    """Why `module` may not include the quoted path, or None if it may."""
    parts = pathlib.PurePosixPath(include).parts
    if parts[0] == "insonify":
        target = public_module(parts[1:])
        if target is None:
            return "is not a known public header"
        if module in EDGE:
            return None
    elif parts[0] in CHAIN or parts[0] in EDGE:
        target = parts[0]
    else:
        return None
    if target == module:
        return None
    allowed = EDGE[module] if module in EDGE else CHAIN[: CHAIN.index(module)]
    return None if target in allowed else f"belongs to {target}"


def main():
    violations = 0
    folders = [d for d in ("include", "src", "apps", "python", "ros", "web", "bench") if pathlib.Path(d).is_dir()]
    for file in sorted(p for d in folders for p in pathlib.Path(d).rglob("*.[hc]*") if p.suffix in (".h", ".cpp")):
        module = module_of(file.as_posix())
        room = room_of(file.as_posix(), module)
        if room not in (None, ".") and rights_of(module, room) is None:
            print(f"{file}: {room} is not a known room of {module}")
            violations += 1
            continue
        for number, line in enumerate(file.read_text().splitlines(), start=1):
            match, system = INCLUDE.match(line), SYSTEM_INCLUDE.match(line)
            reason = None
            if match:
                reason = violation(module, match.group(1)) or room_violation(module, room, match.group(1))
            elif system and file.parts[0] in ("src", "apps"):
                match, reason = system, library_violation(file.as_posix(), system.group(1))
            if reason:
                print(f"{file}:{number}: {module} may not include {match.group(1)}, which {reason}")
                violations += 1
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
