"""bundle.py -- makes an installed tree self-contained: libraries that it needs are copied into its lib/ and found there.

Copies have names of their own, as `auditwheel` gives them, so that another library of that name in the same process is neither
replaced nor used. glibc, libstdc++ and libgcc are the system's. What HDF5 needs for reading from the cloud alone is left out, with
the thirty libraries below: functions that fail stand in for it.
"""

import hashlib
import pathlib
import re
import shutil
import subprocess
import tempfile

OF_THE_SYSTEM = re.compile(r"(libc|libm|libdl|librt|libpthread|ld-linux-x86-64|libstdc\+\+|libgcc_s)\.so\.\d+")
LEFT_OUT = ("libcurl.so.4", "libcrypto.so.3")
STAND_IN = "libinsonify-no-network.so"


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def needed_by(file):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "--wide", "--dynamic", file))


def is_binary(file):
    if file.is_symlink() or not file.is_file():
        return False
    with open(file, "rb") as opened:
        return opened.read(4) == b"\x7fELF"


def library_places():
    """Paths of the system's 64-bit libraries by their names."""
    places = {}
    for name, kind, path in re.findall(r"^\s*(\S+) \((.*)\) => (\S+)$", output_of("/sbin/ldconfig", "-p"), re.MULTILINE):
        if "x86-64" in kind:
            places.setdefault(name, pathlib.Path(path).resolve())
    return places


def libraries_of(files, own):
    """Names and paths of all libraries that binaries need, and that those need, but for the system's and their own."""
    places, found, open_files = library_places(), {}, list(files)
    while open_files:
        for name in needed_by(open_files.pop()):
            if name in found or name in own or name in LEFT_OUT or OF_THE_SYSTEM.fullmatch(name):
                continue
            found[name] = places[name]
            open_files.append(places[name])
    return found


def own_name(name, path):
    stem, ending = name.split(".so", 1)
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{ending}"


def make_stand_in(path, users):
    """Compiles a library that has what the users take from those that are left out: each function returns 0."""
    functions = {}
    for user in users:
        for function, version in re.findall(r" U (\w+)@(\w+(?:\.\w+)*)$", output_of("nm", "-D", user), re.MULTILINE):
            if version.startswith(("CURL_", "OPENSSL_")):
                functions.setdefault(version, set()).add(function)
    with tempfile.TemporaryDirectory() as folder:
        code, versions = pathlib.Path(folder, "none.c"), pathlib.Path(folder, "none.map")
        code.write_text("".join(f"void* {name}(void) {{ return 0; }}\n" for names in functions.values() for name in sorted(names)))
        versions.write_text("".join(f"{version} {{ {'; '.join(sorted(names))}; }};\n" for version, names in functions.items()))
        output_of("gcc", "-shared", "-fPIC", "-O1", "-s", "-fno-builtin", f"-Wl,--version-script={versions}", f"-Wl,-soname,{STAND_IN}",
                  "-o", path, code)


def redirect(file, new_names, search_path):
    """Makes a binary look for libraries under new names, by these search paths. One call each: patchelf 0.14 mixes them up."""
    words = [word for name in needed_by(file) if name in new_names for word in ("--replace-needed", name, new_names[name])]
    if words:
        output_of("patchelf", *words, file)
    output_of("patchelf", "--set-rpath", search_path, file)


def bundle(tree, search_paths):
    """Returns the libraries that were copied into tree/lib: their paths here by their names there.

    search_paths: for the folders of binaries of the tree, by their names relative to it, where libraries are from there.
    """
    binaries = [file for file in sorted(tree.rglob("*")) if is_binary(file)]
    own = {file.name for file in binaries} | {file.name for file in (tree / "lib").iterdir() if file.is_symlink()}
    found = libraries_of(binaries, own)
    new_names = {name: own_name(name, path) for name, path in found.items()}
    for name, path in found.items():
        copy = tree / "lib" / new_names[name]
        shutil.copyfile(path, copy)
        copy.chmod(0o755)
        binaries.append(copy)
    users = [file for file in binaries if set(needed_by(file)) & set(LEFT_OUT)]
    if users:
        make_stand_in(tree / "lib" / STAND_IN, users)
    for file in binaries:
        if file.name in new_names.values():
            output_of("patchelf", "--set-soname", file.name, file)
        redirect(file, {**dict.fromkeys(LEFT_OUT, STAND_IN), **new_names}, search_paths[str(file.parent.relative_to(tree))])
    return {new_names[name]: path for name, path in found.items()}


def floor_of(files, prefix):
    """The newest version that binaries need of what begins with prefix, such as "GLIBC_": (2, 36)."""
    versions = [tuple(map(int, version.split("."))) for file in files
                for version in re.findall(rf"\({prefix}([\d.]+)\)|\b{prefix}([\d.]+)\b", output_of("objdump", "-p", file))
                for version in version if version]
    return max(versions)
