"""The ride of follow_wall.py with `insonify bridge dds`: poses go in and sonar images come back over DDS."""

import contextlib
import fcntl
import signal
import subprocess

LEVELS = (-100, 0)  # Of the images [dB]: none of the wall's echo is cut.


@contextlib.contextmanager
def own_domain():
    """A DDS domain that no other test uses at the same time; the tests in C++ lock the same files."""
    for number in range(40, 100):
        with open(f"/tmp/insonify-dds-domain-{number}", "a") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield number
            return
    raise RuntimeError("all domains are in use")


def follow(path, insonify, vehicle, seconds, distance_at):
    """Distances measured and true, length of a bin, pings that did not arrive, times from pose to message, and the
    bridge's own report."""
    with own_domain() as domain, contextlib.ExitStack() as programs:
        bridge = programs.enter_context(subprocess.Popen(
            [insonify, "bridge", "dds", "follow.yaml", "--local", "--domain", str(domain), "--odometry", "/auv/odom",
             "--bits", "16", f"--levels={LEVELS[0]}:{LEVELS[1]}"], cwd=path, text=True, stdout=subprocess.PIPE))
        ride = programs.enter_context(subprocess.Popen(
            [vehicle, str(domain), *map(str, LEVELS)], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE))
        try:
            if ride.stdout.readline() != "rides\n":
                raise RuntimeError("the vehicle does not start")
            with contextlib.suppress(subprocess.TimeoutExpired):
                bridge.wait(seconds)  # It goes on all the time.
        finally:
            bridge.send_signal(signal.SIGINT)
            report = bridge.communicate(timeout=120)[0].splitlines()[-1]
            lines = ride.communicate(timeout=120)[0].splitlines()
    rows = [tuple(map(float, line.split())) for line in lines]
    if not rows:
        raise RuntimeError(f"no message came: {report}")
    found = [(measured, distance_at(posed)) for posed, _, measured, _ in rows]
    latencies = [arrived - posed for posed, arrived, _, _ in rows]
    return found, rows[0][3], int(report.split()[0]) - len(rows), latencies, report
