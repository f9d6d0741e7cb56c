"""whole_inputs.py -- small files of every format that insonify reads, and the commands that read each."""

import pathlib
import struct
import subprocess
import zlib

import h5py
import numpy as np

SEEDS = pathlib.Path(__file__).parent / "seeds"
FOREIGN = ["a.raw", "a.bin", "a.xtf", "a.npy", "a.npz", "a.jpg", "a.pgm", "a.png"]  # As foreign_fuzzer.cpp numbers them.
MESHES = {"obj": "m.obj", "ply": "m.ply", "ply_text": "m.ply", "stl": "m.stl", "stl_text": "m.stl"}

MESH = b"v 0 0 0\nv 5 0 0\nv 0 5 0\nf 1 2 3\n"
SONAR = ("[{name: a, beam_count: 12, bin_count: 20, max_range: 12, position: [0, 0, 3], orientation_deg: [0, 60, 0], "
         "sampling: {columns_per_beam: 1, rows: 8}}]")
RUN = "run s.yaml -o out --pings 1 --no-pictures -f -q --threads 1"
SCENARIO = """model: calibrated
seed: 7
water: {temperature_c: 12, salinity: 33, depth: 17}
world: world.obj
materials:
  hull: {like: steel, reflection: 0.8}
  floor: {like: sand, ripple_height: 0.02, ripple_wavelength: 0.2}
points: [{position: [3, 0, 0], target_strength_db: -20}]
sonars:
  - name: fls
    preset: tritech-gemini-720i
    beam_count: 8
    bin_count: 20
    max_range: 12
    ping_period: 1
    orientation_deg: [0, 13, 0]
    sampling: {columns_per_beam: 1, rows: 8}
trajectory:
  - {time: 0, position: [-5, 3, 8], orientation_deg: [0, 0, -4]}
  - {time: 9, position: [-0.5, 1, 7.6], orientation_deg: [0, 0, -1]}
pings: 2
view: {position: [-10, -7, 15], look_at: [26, 1, 0], field_of_view_deg: 70}
"""
HEIGHTMAP = ('<sdf version="1.9"><world name="w"><model name="m"><static>true</static><link name="l"><visual name="v"><geometry>'
             "<heightmap><uri>h.png</uri><size>10 10 2</size></heightmap></geometry></visual></link></model></world></sdf>")


def png(levels):
    """Grey levels [row, column] of 8 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", levels.shape[1], levels.shape[0], 8, 0, 0, 0, 0)
    rows = b"".join(b"\0" + bytes(row) for row in levels)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def tiff(heights):
    """Heights [row, column] of 32 bits in one strip, at (500000, 5800000) with pixels of 2 x 4 m."""
    data = heights.astype("<f4").tobytes()
    entries, beyond = [], b""
    start = 8 + len(data) + 2 + 12 * 12 + 4
    for tag, kind, values in [(256, "I", [heights.shape[1]]), (257, "I", [heights.shape[0]]), (258, "H", [32]), (259, "H", [1]),
                              (262, "H", [1]), (273, "I", [8]), (277, "H", [1]), (278, "I", [heights.shape[0]]),
                              (279, "I", [len(data)]), (339, "H", [3]), (33550, "d", [2, 4, 0]),
                              (33922, "d", [0, 0, 0, 5e5, 5.8e6, 0])]:
        value = struct.pack(f"<{len(values)}{kind}", *values)
        if len(value) > 4:
            beyond, value = beyond + value, struct.pack("<I", start + len(beyond))
        entries.append(struct.pack("<HHI", tag, {"H": 3, "I": 4, "d": 12}[kind], len(values)) + value.ljust(4, b"\0"))
    directory = struct.pack("<H", len(entries)) + b"".join(entries) + bytes(4)
    return b"II*\0" + struct.pack("<I", 8 + len(data)) + data + directory + beyond


def write_bag(path):
    """A grid of 2 x 3 heights."""
    axes = "".join(f'<gmd:axisDimensionProperties><gmd:MD_Dimension><gmd:dimensionName><gmd:MD_DimensionNameTypeCode codeListValue="{name}">'
                   f'{name}</gmd:MD_DimensionNameTypeCode></gmd:dimensionName><gmd:resolution><gco:Measure uom="m">{step}</gco:Measure>'
                   "</gmd:resolution></gmd:MD_Dimension></gmd:axisDimensionProperties>" for name, step in [("row", 4), ("column", 2)])
    text = (f'<?xml version="1.0"?><gmi:MI_Metadata>{axes}<gmd:cornerPoints><gml:Point><gml:coordinates decimal="." cs="," ts=" ">'
            "500000,6000000 500004,6000004</gml:coordinates></gml:Point></gmd:cornerPoints></gmi:MI_Metadata>")
    with h5py.File(path, "w") as bag:
        bag["BAG_root/elevation"] = np.array([[-1, -2, -3], [-4, 1e6, -6]], np.float32)
        bag["BAG_root/metadata"] = np.frombuffer(text.encode(), "S1")


def recordings(insonify, folder):
    """@return  {file name: bytes} of one run in the formats of recordings."""
    (folder / "world.obj").write_bytes(MESH)
    (folder / "s.yaml").write_text(f"world: world.obj\npings: 2\nsonars: {SONAR}\n")
    for arguments in (["run", "s.yaml", "-o", ".", "--no-pictures", "--record", "h5,mcap", "-q"],
                      ["run", "s.yaml", "-o", "packed", "--no-pictures", "--compress", "-q"],
                      ["export", "a.h5", "-o", "b.npz"]):
        subprocess.run([insonify, *arguments], cwd=folder, check=True, capture_output=True)
    return {"a.h5": (folder / "a.h5").read_bytes(), "packed.h5": (folder / "packed/a.h5").read_bytes(),
            "a.mcap": (folder / "a.mcap").read_bytes(), "b.npz": (folder / "b.npz").read_bytes()}


def whole_inputs(insonify, scratch):
    """@return  List of (format, name, bytes, other files {name: bytes}, commands)."""
    inputs = []

    def world(form, name, bytes_, **others):
        scenario = f"world: {name}\nsonars: {SONAR}\n".encode()
        inputs.append((form, name, bytes_, {"s.yaml": scenario, "mesh.obj": MESH, **others}, [RUN]))

    named = b"usemtl hull\n" + MESH + b"usemtl floor\nf 3 2 1\n"
    inputs.append(("yaml", "s.yaml", SCENARIO.encode(), {"world.obj": named}, [RUN]))
    for name in ("shapes.sdf", "cone.sdf"):
        world("sdf", "w.sdf", (SEEDS / "sdf" / name).read_bytes())
    for path in sorted((SEEDS / "mesh").glob("*")):
        kind = path.name.split("_", 1)[1]
        world(kind.split("_")[0], MESHES.get(kind, "m." + kind), path.read_bytes()[1:])
    world("scn", "pool.scn", (SEEDS / "stonefish/pool.scn").read_bytes())
    levels = np.arange(289, dtype=np.uint16).reshape(17, 17).astype(np.uint8)
    scenario = f"world: w.sdf\nsonars: {SONAR}\n".encode()
    inputs.append(("png", "h.png", png(levels), {"s.yaml": scenario, "w.sdf": HEIGHTMAP.encode()}, [RUN]))
    world("asc", "g.asc", b"ncols 3\nnrows 2\nxllcorner 0.5\nyllcorner 10\ncellsize 2\nNODATA_value -9999\n-1 -2 -3\n-4 -9999 -6.5\n")
    world("tif", "g.tif", tiff(np.array([[-10, -11, -12], [-20, -21, -22]])))
    write_bag(scratch / "g.bag")
    world("bag", "g.bag", (scratch / "g.bag").read_bytes())
    for name, text in [("t.csv", b"time,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n1.5,2,2,3,0,0,0,1\n9,3,2,3,0,0,0.6,0.8\n"),
                       ("t.tum", b"0 1 2 3 0 0 0 1\n1.5 2 2 3 0 0 0 1\n9 3 2 3 0 0 0.6 0.8\n"),
                       ("e.csv", b"#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
                                 b"q_RS_z []\n0,1,2,3,1,0,0,0\n1500000000,2,2,3,1,0,0,0\n"),
                       ("t.kitti", b"1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 2 0 1 0 2 0 0 1 3\n")]:
        scenario = f"world: mesh.obj\ntrajectory: {name}\nsonars: {SONAR}\n".encode()
        inputs.append(("track", name, text, {"s.yaml": scenario, "mesh.obj": MESH}, [RUN]))
    for name, text in [("c.csv", b"depth,temperature,salinity\n0,18.5,35\n20,9.25,34.5\n9000,3,34.5\n"),
                       ("c.svp", b"[SVP_VERSION_2]\nc.svp\nSection 2015-148 23:49:31 -12:14:35 130:55:40\n0.2 1539.5\n7 1521\n9000 1540\n"),
                       ("c.asvp", b"( SoundVelocity  1.0 0 201505282349 -12.2 130.9 -1 0 0 SSM P 0002 )\n0.00 1539.51\n9000.00 1560\n")]:
        scenario = f"world: mesh.obj\nwater: {{profile: {name}}}\nsonars: {SONAR}\n".encode()
        inputs.append(("cast", name, text, {"s.yaml": scenario, "mesh.obj": MESH}, [RUN]))
    made = recordings(insonify, scratch)
    commands = ["info --verify {}", "draw {} -o pictures -f", "compare {} good.h5", "export {} -o x.npz -f", "replay {} -o again -f"]
    for name, bytes_ in made.items():
        inputs.append((name.split(".")[1], name, bytes_, {"good.h5": made["a.h5"]}, commands[:3] if name == "b.npz" else commands))
    for path in sorted((SEEDS / "foreign").glob("*")):
        name = FOREIGN[path.read_bytes()[0]]
        inputs.append((name.split(".")[1], name, path.read_bytes()[1:], {"good.h5": made["a.h5"]}, commands[:3]))
    return inputs
