"""The ride of follow_wall.py with `insonify bridge ros1`: poses go in and sonar images come back, with a roscore of its own."""

import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import xmlrpc.client

LEVELS = (-100, 0)  # Of the images [dB]: none of the wall's echo is cut.
WALL = -5.0  # y [m]
POSES = 50.0  # A second.
SKIPPED = 77


def needs():
    """What is missing here, or ""."""
    if shutil.which("rosmaster") is None:
        return "there is no rosmaster (package python3-rosmaster)"
    try:
        import nav_msgs.msg  # noqa: F401
        import numpy  # noqa: F401
        import rospy  # noqa: F401
    except ImportError as missing:
        return f"{missing} (packages python3-rospy, python3-nav-msgs, python3-numpy)"
    return ""


def parsed_image(data):
    """Number, stamp [s], directions (beam, xyz), ranges [m] and values (bin, beam) of an encoded ProjectedSonarImage."""
    import numpy as np
    at = 0

    def take(form):
        nonlocal at
        values = struct.unpack_from("<" + form, data, at)
        at += struct.calcsize("<" + form)
        return values

    def array(kind, width=1):
        nonlocal at
        count, = take("I")
        values = np.frombuffer(data, kind, count * width, at)
        at += values.nbytes
        return values.reshape(-1, width) if width > 1 else values

    number, seconds, nanoseconds = take("III")
    array("u1")  # Frame.
    take("ff")  # Frequency and speed of sound.
    array("<f4"), array("<f4")  # Beam widths.
    directions, ranges = array("<f8", 3), array("<f4")
    _, _, beams = take("BII")
    values = array("u1").view("<u2").reshape(len(ranges), beams)
    return number, seconds + 1e-9 * nanoseconds, directions, ranges, values


def distance_of(directions, ranges, values):
    """To the first echo in the beams within 3 degrees of straight ahead [m]."""
    import numpy as np
    low, high = LEVELS
    level = low + (high - low) / 65535 * values.astype(float) - 30 * np.log10(ranges)[:, None]
    profile = 10 ** (level / 10) * (values > 0)
    ahead = np.abs(np.degrees(np.arctan2(-directions[:, 1], directions[:, 2]))) < 3
    profile = profile[:, ahead].sum(axis=1)
    return float(ranges[np.argmax(profile >= profile.max() / 4)])  # As wall_ride.h has it: within 6 dB.


def start_master():
    """The heart of roscore, at a free port, which ROS_MASTER_URI names then."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
    os.environ.pop("ROS_HOSTNAME", None)
    program = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    proxy = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    for _ in range(600):
        try:
            proxy.getPid("/ride")
            return program
        except OSError:
            time.sleep(0.05)
    program.kill()
    raise RuntimeError("rosmaster did not start")


def follow(path, insonify, seconds, distance_at):
    """Distances measured and true, length of a bin, pings that did not arrive, times from pose to message, and the
    bridge's own report."""
    if not pathlib.Path(os.path.realpath(insonify)).with_name("insonify-bridge-ros1").exists():
        print("skipped: insonify-bridge-ros1 was not built")
        sys.exit(SKIPPED)
    if missing := needs():
        print(f"skipped: {missing}")
        sys.exit(SKIPPED)
    os.environ["ROS_LOG_DIR"] = os.environ["ROS_HOME"] = str(path / "ros")
    master = start_master()
    import nav_msgs.msg
    import rospy
    bridge = subprocess.Popen([insonify, "bridge", "ros1", "follow.yaml", "--odometry", "/auv/odom",
                               "--bits", "16", f"--levels={LEVELS[0]}:{LEVELS[1]}"], cwd=path, text=True, stdout=subprocess.PIPE)
    try:
        rospy.init_node("ride", disable_signals=True)
        arrived = []
        images = rospy.Subscriber("/insonify/image", rospy.AnyMsg, lambda image: arrived.append((time.time(), image._buff)),
                                  tcp_nodelay=True)
        poses = rospy.Publisher("/auv/odom", nav_msgs.msg.Odometry, queue_size=1, tcp_nodelay=True)
        end = time.monotonic() + 30
        while not (images.get_num_connections() and poses.get_num_connections()):
            if time.monotonic() > end:
                raise RuntimeError("the node does not start")
            time.sleep(0.01)
        start = time.time()
        riding = threading.Event()

        def ride():
            message = nav_msgs.msg.Odometry()
            message.header.frame_id = "world"
            message.pose.pose.orientation.w = 1
            due = time.monotonic()
            while not riding.wait(max(0.0, due - time.monotonic())):
                due += 1 / POSES
                now = time.time()
                message.header.stamp = rospy.Time.from_sec(now)
                message.pose.pose.position.x = 0.5 * (now - start)
                message.pose.pose.position.y = WALL + distance_at(now - start)
                poses.publish(message)

        pilot = threading.Thread(target=ride)
        pilot.start()
        time.sleep(seconds)
        bridge.send_signal(signal.SIGINT)
        report = bridge.communicate(timeout=120)[0].splitlines()[-1]
        time.sleep(0.3)
        riding.set()
        pilot.join()
        images.unregister()
    finally:
        bridge.kill()
        master.kill()
    if not arrived:
        raise RuntimeError(f"no message came: {report}")
    found, latencies, numbers = [], [], []
    for at, data in arrived:
        number, stamp, directions, ranges, values = parsed_image(data)
        numbers.append(number)
        latencies.append(at - stamp)
        found.append((distance_of(directions, ranges, values), distance_at(stamp - start)))
    lost = numbers[-1] - numbers[0] + 1 - len(numbers)
    return found, float(ranges[-1] - ranges[0]) / (len(ranges) - 1), lost, latencies, report
