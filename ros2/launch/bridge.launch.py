"""Starts `insonify bridge dds`: a scenario's sonars as topics of ROS 2.

    ros2 launch insonify_ros2 bridge.launch.py scenario:=dive.yaml odometry:=/auv/odom world_frame:=odom

Not run with ROS 2 itself, which the machines that test insonify do not have; a test runs it with stand-ins for the
modules of `launch`.
"""

import shlex

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration

# Name, default (None: must be given) and what it is.
ARGUMENTS = (
    ("scenario", None, "scenario file"),
    ("odometry", "", "topic of nav_msgs/msg/Odometry with the vehicle's pose"),
    ("tf", "", "frame of the vehicle, looked up in tf; instead of odometry"),
    ("world_frame", "world", "name of the world's frame"),
    ("use_sim_time", "false", "whether to use the time of /clock"),
    ("levels", "", "levels of the darkest and the brightest value, LOW:HIGH in dB"),
    ("set", "", "changes of the scenario's keys, KEY=VALUE, with blanks between"),
    ("options", "", "further arguments of `insonify bridge dds`, in shell syntax"),
)


def command(value):
    """The words of the command line for values of all arguments, by name."""
    words = ["insonify", "bridge", "dds", value["scenario"], "--world-frame", value["world_frame"]]
    for name in ("odometry", "tf"):
        words += [f"--{name}", value[name]] if value[name] else []
    words += ["--clock", "simulated"] if value["use_sim_time"].lower() == "true" else []
    words += [f"--levels={value['levels']}"] if value["levels"] else []
    for setting in value["set"].split():
        words += ["--set", setting]
    return words + shlex.split(value["options"])


def start(context):
    value = {name: LaunchConfiguration(name).perform(context) for name, _, _ in ARGUMENTS}
    return [ExecuteProcess(cmd=command(value), name="insonify", output="screen")]


def generate_launch_description():
    declared = [DeclareLaunchArgument(name, default_value=default, description=text) for name, default, text in ARGUMENTS]
    return LaunchDescription([*declared, OpaqueFunction(function=start)])
