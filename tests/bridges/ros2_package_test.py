"""The packages in ros1/ and ros2/ are whole as far as that shows without ROS, and the layout for Foxglove shows topics that exist."""

import json
import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
INSONIFY, VERSION = sys.argv[1:3]
LAUNCH = ROOT / "ros2/launch/bridge.launch.py"


class Stand:
    """Stands for any class of ROS 2's `launch`: keeps what it was made from."""

    def __init__(self, *words, **options):
        self.words, self.options = words, options


class Configuration(Stand):
    def perform(self, context):
        return context[self.words[0]]


def launch_file():
    """The functions and constants of the launch file, with stand-ins for the modules that it imports."""
    stands = {"launch": {"LaunchDescription": Stand},
              "launch.actions": {"DeclareLaunchArgument": Stand, "ExecuteProcess": Stand, "OpaqueFunction": Stand},
              "launch.substitutions": {"LaunchConfiguration": Configuration}}
    for name, classes in stands.items():
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(classes)
    return runpy.run_path(str(LAUNCH))


def command(**values):
    """The command line that the launch file runs with these arguments, the others being at their defaults."""
    description = launch_file()["generate_launch_description"]()
    *declared, act = description.words[0]
    context = {each.words[0]: each.options["default_value"] for each in declared}
    assert set(values) <= set(context)
    [process] = act.options["function"]({**context, **values})
    return process.options["cmd"]


class Ros2PackageTest(unittest.TestCase):
    def test_the_package_has_the_version_of_the_project(self):
        package = xml.etree.ElementTree.parse(ROOT / "ros2/package.xml").getroot()
        self.assertEqual(package.find("version").text, VERSION)
        self.assertIn(f"project({package.find('name').text})", (ROOT / "ros2/CMakeLists.txt").read_text())

    def test_it_depends_on_the_packages_of_its_messages(self):
        package = xml.etree.ElementTree.parse(ROOT / "ros2/package.xml").getroot()
        types_of_page = re.findall(r"`(\w+)/msg/\w+`", (ROOT / "docs/reference/messages.md").read_text())
        of_system = {"rosgraph_msgs"}  # Of ROS 2 itself.
        depends = {each.text for kind in ("depend", "exec_depend") for each in package.findall(kind)}
        self.assertEqual(depends - {"launch", "rclcpp", "rclcpp_components"} - of_system, set(types_of_page) - of_system)

    def test_its_component_is_made_of_the_files_that_are_compiled_with_stand_ins(self):
        listed = re.findall(r"src/\w+\.cpp", (ROOT / "ros2/CMakeLists.txt").read_text())
        self.assertEqual(sorted(listed), sorted(str(each.relative_to(ROOT / "ros2")) for each in (ROOT / "ros2/src").glob("*.cpp")))
        with_stand_ins = (ROOT / "tests/bridges/ros2/CMakeLists.txt").read_text()
        for each in listed:
            self.assertIn(f"ros2/{each}", with_stand_ins)

    def test_it_is_built_and_installed_by_ament(self):
        if not pathlib.Path("/usr/share/ament_cmake/cmake").is_dir():
            self.skipTest("needs the package ament-cmake")
        with tempfile.TemporaryDirectory() as folder:
            for words in (["-S", ROOT / "ros2", "-B", f"{folder}/build", f"-DCMAKE_INSTALL_PREFIX={folder}/there",
                           f"-DPython3_EXECUTABLE={sys.executable}"], ["--install", f"{folder}/build"]):
                done = subprocess.run(["cmake", *words], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                if words[0] == "-S" and not pathlib.Path("/opt/ros").is_dir():
                    self.assertRegex(done.stdout, "The component insonify_ros2::SonarNode is not built without rclcpp\n")
            there = pathlib.Path(folder) / "there/share"
            self.assertTrue((there / "insonify_ros2/launch/bridge.launch.py").is_file())
            self.assertTrue((there / "ament_index/resource_index/packages/insonify_ros2").is_file())

    def test_arguments_become_options(self):
        self.assertEqual(command(scenario="a b.yaml"), "insonify|bridge|dds|a b.yaml|--world-frame|world".split("|"))
        self.assertEqual(
            command(scenario="a.yaml", odometry="/odom", world_frame="odom", use_sim_time="True", levels="-90:-30",
                    set="max_range=12 pings=3", options="--domain 7 --quiet"),
            "insonify bridge dds a.yaml --world-frame odom --odometry /odom --clock simulated --levels=-90:-30 "
            "--set max_range=12 --set pings=3 --domain 7 --quiet".split())

    def test_the_bridge_understands_all_of_them(self):
        if not shutil.which("insonify-bridge-dds", path=pathlib.Path(INSONIFY).resolve().parent):
            self.skipTest("the bridge to DDS is not built (INSONIFY_BRIDGES)")
        for way in ({"odometry": "/odom"}, {"tf": "base_link"}):
            words = command(scenario="not-there.yaml", use_sim_time="true", levels="-90:-30", set="max_range=12 pings=3",
                            options="--domain 7 --local", **way)
            done = subprocess.run([INSONIFY, *words[1:]], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (2, "insonify: not-there.yaml: no such file\n"))


class Ros1PackageTest(unittest.TestCase):
    def test_the_package_has_the_version_of_the_project(self):
        package = xml.etree.ElementTree.parse(ROOT / "ros1/package.xml").getroot()
        self.assertEqual(package.find("version").text, VERSION)
        self.assertIn(f"project({package.find('name').text})", (ROOT / "ros1/CMakeLists.txt").read_text())

    def test_it_is_built_and_installed_in_a_workspace_of_catkin(self):
        if not shutil.which("catkin_make"):
            self.skipTest("needs the package catkin")
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(ROOT / "ros1", pathlib.Path(folder) / "src/insonify_ros1")
            done = subprocess.run(["catkin_make", "-DPYTHON_EXECUTABLE=/usr/bin/python3", "-DCATKIN_ENABLE_TESTING=OFF", "install"],
                                  cwd=folder, capture_output=True, text=True, check=False,
                                  env={**os.environ, "CMAKE_BUILD_TYPE": "", "PWD": folder})
            self.assertEqual(done.returncode, 0, done.stderr)
            there = pathlib.Path(folder) / "install"
            self.assertTrue(os.access(there / "lib/insonify_ros1/bridge", os.X_OK))
            for file in ("package.xml", "launch/bridge.launch", "rviz/insonify.rviz"):
                self.assertTrue((there / "share/insonify_ros1" / file).is_file(), file)
            if shutil.which("roslaunch"):  # Which finds it by the workspace's environment.
                found = subprocess.run(["bash", "-c", ". install/setup.sh && roslaunch --nodes insonify_ros1 bridge.launch "
                                        "scenario:=dive.yaml name:=dory"], cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual((found.returncode, found.stdout), (0, "/dory\n"), found.stderr)


class FoxgloveLayoutTest(unittest.TestCase):
    def setUp(self):
        self.layout = json.loads((ROOT / "share/foxglove/insonify.json").read_text())

    def test_every_panel_is_in_the_layout_once(self):
        def panels(place):
            return [place] if isinstance(place, str) else panels(place["first"]) + panels(place["second"])
        self.assertEqual(sorted(panels(self.layout["layout"])), sorted(self.layout["configById"]))

    def test_its_topics_are_those_of_messages(self):
        page = (ROOT / "docs/reference/messages.md").read_text()
        known = {topic.replace("NAME", "fls") for topic in re.findall(r"(?m)^\| `(/[^`]+)` \|", page)}
        shown = set()
        for panel in self.layout["configById"].values():
            shown |= set(panel.get("topics", {}))
            shown |= {panel[key] for key in ("topicPath",) if key in panel}
            shown |= {panel["imageMode"]["imageTopic"]} if panel.get("imageMode") else set()
        shown = {path.split(".")[0] for path in shown}
        self.assertGreater(len(shown), 3)
        self.assertLessEqual(shown, known)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)
