"""The hashes of types that the bridge to DDS tells are those of its messages' definitions."""

import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

from type_hash import type_hash

ROOT = pathlib.Path(__file__).resolve().parents[2]
INSONIFY = pathlib.Path(sys.argv[1]).resolve()

# As `ros2 topic info -v` of the release Jazzy prints them.
PRINTED = {
    "sensor_msgs/msg/Image": "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47",
    "sensor_msgs/msg/LaserScan": "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "std_msgs/msg/String": "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
}

# Types that the bridge reads or writes and no recording holds.
SEPARATOR = "=" * 80 + "\nMSG: "
TIME = SEPARATOR + "builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
READ = {
    "sensor_msgs/msg/LaserScan": SEPARATOR.join((
        "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\nfloat32 time_increment\n"
        "float32 scan_time\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\nfloat32[] intensities\n",
        "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n")) + TIME,
    "rosgraph_msgs/msg/Clock": "builtin_interfaces/Time clock\n" + TIME,
    "nav_msgs/msg/Odometry": SEPARATOR.join((
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
        "geometry_msgs/TwistWithCovariance twist\n",
        "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n",
        "geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance\n",
        "geometry_msgs/TwistWithCovariance\ngeometry_msgs/Twist twist\nfloat64[36] covariance\n",
        "geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
        "geometry_msgs/Twist\ngeometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
        "geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n",
        "geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n",
        "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n")) + TIME,
}


def told():
    """Hashes by type, of the bridge's source."""
    source = (ROOT / "apps/bridges/dds/dds_names.cpp").read_text()
    return {f"{package}/msg/{name}": value
            for package, name, value in re.findall(r'"(\w+)::msg::dds_::(\w+)_",\s*"(RIHS01_\w+)"', source)}


def schemas(path):
    """Definitions by type, of the summary of an MCAP file, which is not compressed."""
    data = path.read_bytes()
    at, found = struct.unpack_from("<Q", data, len(data) - 8 - 20)[0], {}
    while at < len(data) - 8:
        operation, length = struct.unpack_from("<BQ", data, at)
        at += 9
        if operation == 0x03:
            place, texts = at + 2, []
            for _ in range(3):  # Name, encoding, definition.
                size = struct.unpack_from("<I", data, place)[0]
                texts.append(data[place + 4:place + 4 + size].decode())
                place += 4 + size
            found[texts[0]] = texts[2]
        at += length
    return found


class TypeHashTest(unittest.TestCase):
    def test_the_hashes_are_those_of_the_definitions(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "a.yaml").write_text(
                "world: none\npoints: [{position: [6, 1, 0], target_strength_db: -25}]\n"
                "sonars: [{name: fls, beam_count: 8, bin_count: 20, max_range: 9},\n"
                "  {name: sss, type: sss, azimuth_aperture_deg: 1, bin_count: 20, max_range: 9},\n"
                "  {name: mbes, type: mbes, beam_count: 8, bin_count: 20, max_range: 9}]\npings: 1\n")
            subprocess.run([INSONIFY, "run", "a.yaml", "-o", ".", "--record", "mcap", "--no-pictures", "--quiet"], cwd=folder,
                           check=True, stderr=subprocess.DEVNULL)
            definitions = READ
            for name in ("fls", "sss", "mbes"):
                definitions = definitions | schemas(pathlib.Path(folder) / f"{name}.mcap")
        self.assertEqual(told(), {name: type_hash(name, text) for name, text in definitions.items()})

    def test_ros2_prints_the_same(self):
        self.assertEqual(PRINTED, {name: told()[name] for name in PRINTED})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
