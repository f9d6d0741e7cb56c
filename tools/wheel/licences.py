"""licences.py -- which libraries a wheel carries: packages, versions, licences, and their copyright files."""

import pathlib
import re
import subprocess


def package_of(path):
    """Name, version and copyright file of the Debian package that a file is from."""
    for form in (str(path), str(path).removeprefix("/usr"), "/usr" + str(path)):
        asked = subprocess.run(["dpkg", "-S", form], capture_output=True, text=True)
        if asked.returncode == 0:
            name = asked.stdout.split(":")[0]
            version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", f"{name}"], check=True, capture_output=True, text=True)
            return name, re.split(r"(?<=\d) ", version.stdout)[0], pathlib.Path("/usr/share/doc", name, "copyright")
    raise SystemExit(f"{path}: no Debian package has this file")


def licence_in(copyright_file):
    """The licence of most of a package's files, where its copyright file says so by the rules for machines (DEP-5)."""
    text = copyright_file.read_text(errors="replace")
    found = re.search(r"^Files: *\*.*?^License: *(.+?)$", text, re.MULTILINE | re.DOTALL)
    return found.group(1) if found else "see its file"


def write_licences(folder, libraries, floors):
    """Writes LIBRARIES.md and a copyright file for each package. libraries: paths here by names in the wheel."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, path in sorted(libraries.items()):
        package, version, copyright_file = package_of(path)
        rows.append(f"| `{name}` | {package} {version} | {licence_in(copyright_file)} |")
        (folder / f"{package}.copyright").write_bytes(copyright_file.read_bytes())
    (folder / "LIBRARIES.md").write_text(
        "# Libraries\n\nCarried along, as Debian 12 built them, under names of their own; the copyright file of each package is beside "
        "this one:\n\n| Library | Package | Licence of most of it |\n| --- | --- | --- |\n" + "\n".join(rows) +
        "\n\nTaken from the system: " + ", ".join(floors) + ". GDAL, by which GeoTIFF is read, is the system's too, where it has "
        "libgdal.so.32.\n\n`libinsonify-no-network.so` stands in for libcurl and libcrypto, which HDF5 needs to read from the cloud: "
        "that fails.\n")
