"""What tests of the bridge to ROS 1 share: a roscore of their own, the node, and rosbag.

A test program is called with the path of `insonify`, of which the node's program is a neighbour. Where something is missing
it ends with status 77 and says what.
"""

import atexit
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
import xmlrpc.client

warnings.simplefilter("ignore")  # Of rospy's own code.
signal.signal(signal.SIGINT, signal.default_int_handler)  # In the background of a shell it is ignored, by children too.
SKIPPED = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


INSONIFY = os.path.abspath(sys.argv.pop(1))
BRIDGE = os.path.join(os.path.dirname(os.path.realpath(INSONIFY)), "insonify-bridge-ros1")
if not os.path.exists(BRIDGE):
    skip(f"{BRIDGE} was not built (./dev bridges, or INSONIFY_BRIDGES=ON)")
for tool in ("rosmaster", "rosbag"):
    if shutil.which(tool) is None:
        skip(f"there is no {tool} (packages python3-rosmaster, python3-rosbag)")
FOLDER = pathlib.Path(os.environ.get("INSONIFY_ROS1_FOLDER") or tempfile.mkdtemp(prefix="insonify-ros1-"))
if "INSONIFY_ROS1_FOLDER" not in os.environ:  # Programs that a test starts share its folder.
    os.environ["INSONIFY_ROS1_FOLDER"] = str(FOLDER)
    atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)


def free_port():
    """A port below those that Linux gives to connections: none takes it while a roscore is started again."""
    first, count = 20000, 12000
    for offset in range(count):
        port = first + (os.getpid() + offset) % count  # Tests that run at the same time begin at different ports.
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError:
                pass
    raise AssertionError(f"no port from {first} to {first + count - 1} is free")


PORT = free_port()
# Before rospy is imported, which reads them then.
os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{PORT}", ROS_IP="127.0.0.1", ROS_HOME=str(FOLDER / "ros"),
                  ROS_LOG_DIR=str(FOLDER / "log"), ROSCONSOLE_FORMAT="${severity}: ${message}")
os.environ.pop("ROS_HOSTNAME", None)
try:
    import dynamic_reconfigure.client  # noqa: F401
    import nav_msgs.msg
    import rosbag  # noqa: F401
    import rosgraph_msgs.msg
    import rospy
    import tf2_msgs.msg  # noqa: F401
except ImportError as missing:
    skip(f"{missing} (packages python3-rospy, python3-rosbag, python3-nav-msgs, python3-tf2-msgs, "
         "python3-dynamic-reconfigure, for the Python that runs the tests)")

# Limits only end a test that fails: on a busy machine all that is waited for can take seconds.
PATIENCE = 60.0  # For what must happen [s].
PROMPT = 20.0  # For the end of a node [s]. Calls of roscpp to a roscore that hangs last minutes.

# The strongest target is 6.02 m ahead and a little to port.
SCENARIO = """world: none
points:
  - {position: [6, 0.5, 0], target_strength_db: -20}
  - {position: [4, -1.5, 0.2], target_strength_db: -32}
  - {position: [8, 3, 0.5], target_strength_db: -35}
  - {position: [9, -4, 0], target_strength_db: -30}
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.0625, sampling: {columns_per_beam: 2, rows: 40}}
"""


def wait_for(what, seconds=PATIENCE, message="it did not happen"):
    """The first true value of what(), looked for again and again. The message is a text, or a function that makes it in the end."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = what()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"{message() if callable(message) else message} within {seconds} s")


class Program:
    """A process that does not outlive the test, with the lines that it prints."""

    def __init__(self, *words):
        self._said = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen([str(word) for word in words], cwd=FOLDER, stdout=self._said,
                                        stderr=subprocess.STDOUT)

    def said(self):
        return os.pread(self._said.fileno(), 1 << 20, 0).decode()

    def wait_to_say(self, text, seconds=PATIENCE):
        end = time.monotonic() + seconds
        while text not in self.said() and self.process.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        assert text in self.said(), f"it said\n{self.said()}\nbut not {text!r} within {seconds} s"

    def end(self, how=signal.SIGINT):
        """Its exit status and the seconds that it took to end."""
        begin = time.monotonic()
        if self.process.poll() is None:
            self.process.send_signal(how)
        try:
            return self.process.wait(timeout=PATIENCE), time.monotonic() - begin
        finally:
            self.process.kill()


def write(name, text):
    (FOLDER / name).write_text(text)


def node(*words, scenario="dive.yaml", bits=("--bits", "16")):
    return Program(INSONIFY, "bridge", "ros1", scenario, *bits, "--at-once", *words)


class Master:
    """roscore's heart, at PORT."""

    def __init__(self):
        self.program = Program("rosmaster", "--core", "-p", PORT)
        self.proxy = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        wait_for(self.answers, message="rosmaster did not answer")

    def answers(self):
        try:
            return self.proxy.getPid("/test")[0] == 1
        except OSError:
            return False

    def set(self, name, value):
        assert self.proxy.setParam("/test", name, value)[0] == 1

    def received(self, name, topic):
        """How many messages of a topic a node has received, from all of its publishers."""
        uri = self.proxy.lookupNode("/test", name)[2]
        subscribed = xmlrpc.client.ServerProxy(uri).getBusStats("/test")[1]  # roscpp leaves out status and message.
        return sum(link[2] for each, links in subscribed if each == topic for link in links)

    def publishes(self, name, topic):
        """Whether a node is known as a publisher of a topic."""
        published = dict(self.proxy.getSystemState("/test")[2][0])
        return name in published.get(topic, [])

    def end(self):
        self.program.end(signal.SIGKILL)


def connections(name):
    """Nodes by the topic and direction of those connections of a node that are made."""
    code, _, uri = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).lookupNode("/test", name)
    if code != 1:
        return {}
    try:
        links = xmlrpc.client.ServerProxy(uri).getBusInfo("/test")[2]
    except OSError:  # One of that name was killed, and another has not begun.
        return {}
    found = {}
    for _, other, direction, _, topic, connected, *_ in links:
        if connected:
            found.setdefault((topic, direction), []).append(other)
    return found


def subscribe(topic, kind, take):
    """A subscriber of which the topic's publishers know: rospy counts connections that are not made yet."""
    def readers():
        """Those of each publisher."""
        published = dict(xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).getSystemState("/test")[2][0])
        return [connections(node).get((topic, "o"), []) for node in published.get(topic, [])]

    def is_known():
        each = readers()
        return each and all(rospy.get_name() in names for names in each)
    subscriber = rospy.Subscriber(topic, kind, take)
    wait_for(is_known, message=lambda: f"{topic}: its publishers have the readers {readers()}, the subscriber "
                                       f"{subscriber.get_num_connections()} connections;")
    return subscriber


class Listener:
    """Keeps the messages of a topic, as bytes."""

    def __init__(self, topic):
        self.messages = []
        self.times = []
        self._subscriber = subscribe(topic, rospy.AnyMsg, self._take)

    def _take(self, message):
        self.times.append(time.time())
        self.messages.append(message._buff)

    def wait(self, count, seconds=PATIENCE):
        wait_for(lambda: len(self.messages) >= count, seconds, lambda: f"only {len(self.messages)} messages of {count}")
        return self.messages[count - 1]

    def next(self, seconds=PATIENCE):
        """The next message that comes from now on."""
        return self.wait(len(self.messages) + 1, seconds)

    def image_after(self, moment):
        """The first sonar image, decoded, whose ping began after a moment [s since 1970]."""
        def found():
            images = (decoded(each) for each in list(self.messages[seen:]))
            return next((image for image in images if image.header.stamp.to_sec() > moment), None)
        seen = max(0, len(self.messages) - 10)
        return wait_for(found, message="no image came")


def connected(publisher, count=1):
    wait_for(lambda: publisher.get_num_connections() >= count, message=f"nobody reads {publisher.name}")
    return publisher


def odometry(stamp, x, y=0.0, yaw_wz=(1.0, 0.0), frame="world"):
    message = nav_msgs.msg.Odometry()
    message.header.stamp = rospy.Time.from_sec(stamp)
    message.header.frame_id = frame
    message.child_frame_id = "base_link"
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.w, message.pose.pose.orientation.z = yaw_wz
    return message


def clock(time_now):
    return rosgraph_msgs.msg.Clock(rospy.Time.from_sec(time_now))


def far_edge(image):
    """Centre of the last bin of an encoded ProjectedSonarImage [m]."""
    return decoded(image).ranges[-1]


_type = None


def image_type():
    """The class of ProjectedSonarImage, by the definition that an exported bag has."""
    global _type
    if _type is None:
        subprocess.run([INSONIFY, "run", "dive.yaml", "-o", "definition", "--pings", "1", "--no-pictures", "--record", "h5"],
                       cwd=FOLDER, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([INSONIFY, "export", next((FOLDER / "definition").glob("*.h5")), "-o", "definition.bag"],
                       cwd=FOLDER, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with rosbag.Bag(str(FOLDER / "definition.bag")) as bag:
            _type = next(bag.read_messages("/fls/sonar_image", raw=True))[1][4]
    return _type


def decoded(image):
    """A ProjectedSonarImage from its bytes."""
    return image_type()().deserialize(image)


class NodeTest(unittest.TestCase):
    """With the scenario as dive.yaml. A roscore is the test's own affair."""

    @classmethod
    def setUpClass(cls):
        write("dive.yaml", SCENARIO)

    def start(self, *words, **options):
        """The node, which does not outlive the test."""
        program = node(*words, **options)
        self.addCleanup(program.end, signal.SIGKILL)
        return program


class MasterTest(NodeTest):
    """With a roscore, and the test program as a node of its own."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.master = Master()
        cls.addClassCleanup(cls.master.end)
        rospy.init_node("tester", disable_signals=True)


def close_bag(program):
    """Waits until `rosbag record` has recorded as many messages of each topic as it was told."""
    wait_for(lambda: program.process.poll() is not None, message="rosbag has not recorded enough")
    assert program.process.returncode == 0, program.said()


def main():
    """Runs the tests of the program."""
    status = 0 if unittest.main(exit=False, verbosity=2, warnings="ignore").result.wasSuccessful() else 1
    shutil.rmtree(FOLDER, ignore_errors=True)
    sys.stdout.flush()
    os._exit(status)  # rospy's threads do not end where roscore is gone.
