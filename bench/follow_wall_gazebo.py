"""The ride of follow_wall.py with `insonify bridge gazebo`: a program plays Gazebo, and reads the sonar images."""

import contextlib
import os
import signal
import subprocess

LEVELS = (-100, 0)  # Of the images [dB]: none of the wall's echo is cut.


def follow(path, insonify, vehicle, seconds, distance_at):
    """Distances measured and true, length of a bin, pings that did not arrive, times from pose to message, and the
    bridge's own report."""
    text = (path / "follow.yaml").read_text().replace("world: wall.obj", "world: none")
    (path / "follow.yaml").write_text(text[:text.index("trajectory:")])
    environment = dict(os.environ, IGN_PARTITION=f"follow-wall-{os.getpid()}", IGN_IP="127.0.0.1")
    with contextlib.ExitStack() as programs:
        bridge = programs.enter_context(subprocess.Popen(
            [insonify, "bridge", "gazebo", "follow.yaml", "--vehicle", "auv",
             "--bits", "16", f"--levels={LEVELS[0]}:{LEVELS[1]}"], cwd=path, text=True, stdout=subprocess.PIPE, env=environment))
        ride = programs.enter_context(subprocess.Popen(
            [vehicle, *map(str, LEVELS)], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment))
        try:
            if ride.stdout.readline() != "rides\n":
                raise RuntimeError("the vehicle does not start")
            with contextlib.suppress(subprocess.TimeoutExpired):
                bridge.wait(seconds)  # It goes on all the time.
        finally:
            lines = ride.communicate(timeout=120)[0].splitlines()
            bridge.send_signal(signal.SIGINT)
            report = bridge.communicate(timeout=120)[0].splitlines()[-1]
    rows = [tuple(map(float, line.split())) for line in lines]
    if not rows:
        raise RuntimeError(f"no message came: {report}")
    found = [(measured, distance_at(posed)) for posed, _, measured, _, _ in rows]
    latencies = [arrived - posed for posed, arrived, _, _, _ in rows]
    numbers = [int(number) for *_, number in rows]
    return found, rows[0][3], numbers[-1] - numbers[0] + 1 - len(rows), latencies, report
