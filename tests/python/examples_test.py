"""Runs one of examples/python in a scratch folder, and checks what it made.

    PYTHONPATH=build/dev/python tests/python/examples_test.py NAME SOURCE_FOLDER
"""

import inspect
import os
import pathlib
import re
import runpy
import subprocess
import sys
import tempfile

import numpy as np

SKIPPED = 77


def check_first_ping(folder, printed):
    # The wall's plane is 7 cos(20 deg) = 6.58 m from the origin, straight ahead of it at 20 degrees: the glint.
    found = re.search(r"at ([\d.]+) m, ([-\d.]+) degrees", printed)
    assert abs(float(found.group(1)) - 6.58) < 0.1 and (folder / "first_ping.png").stat().st_size > 1000, printed


def check_fly_a_square(folder, printed):
    assert printed.count("Side") == 4 and len(list(folder.glob("square_*.png"))) == 4, printed
    # 6 m from the crate's middle and 2.5 to 4 m above: its nearest corner is some 5 m away.
    for nearest in re.findall(r"from ([\d.]+) m on", printed):
        assert 4 < float(nearest) < 6, printed


def check_dataset(folder, printed):
    with np.load(folder / "dataset.npz") as made:
        assert made["levels"].shape == made["masks"].shape and made["levels"].shape[0] == 12
        assert len(made["boxes"]) > 20
        for ping, label, bin_0, bin_1, beam_0, beam_1 in made["boxes"]:
            mask = made["masks"][ping] == label
            assert mask[bin_0:bin_1 + 1, beam_0:beam_1 + 1].sum() == mask.sum() >= 12
            assert str(made["names"][label]).startswith("crate_")


def check_gym_environment(_, printed):
    distances = [float(one) for one in re.findall(r"to ([\d.]+) m of 5 m", printed)]
    assert len(distances) == 3 and all(4.5 < one < 5.5 for one in distances), printed


def check_point_cloud(folder, printed):
    medians = [float(one) for one in re.findall(r"within ([\d.]+) cm of the true surface,", printed)]
    assert len(medians) == 2 and max(medians) < 2, printed
    count = int(re.search(r"(\d+) points", printed).group(1))
    ply = (folder / "cloud.ply").read_bytes()
    head, body = ply.split(b"end_header\n", 1)
    assert f"element vertex {count}".encode() in head and len(body) == 14 * count > 14 * 10000


def check_pictures(folder, printed):
    assert (folder / "pictures.png").stat().st_size > 20000, printed


def check_speed(_, printed):
    assert printed.count(" beams x ") == 2 and printed.count("1 beam x") == 1, printed


def check_mosaic(folder, printed):
    # 24 m in steps of 1.5 m/s x 0.2 s; both swaths of 2 x 29.4 m overlap.
    assert "2 lines of 80 pings, 1000 bins to a side, altitude 6.0" in printed, printed
    # The bed comes back within the pulse and the beam after the shadow's end, here 2 dB down: within a tenth.
    height = float(re.search(r"the container is ([\d.]+) m high", printed).group(1))
    assert abs(height - 2.6) < 0.1, printed
    assert (folder / "mosaic.png").stat().st_size > 20000


def check_gym_by_signature(source):
    """The environment is as gymnasium's API has it, with that package or without."""
    module = runpy.run_path(str(source / "examples/python/gym_environment.py"))
    env = module["WallEnv"](render_mode="rgb_array")
    signature = inspect.signature(env.reset)
    assert [(one.name, one.kind, one.default) for one in signature.parameters.values()] == [
        ("seed", inspect.Parameter.KEYWORD_ONLY, None), ("options", inspect.Parameter.KEYWORD_ONLY, None)]
    assert list(inspect.signature(env.step).parameters) == ["action"]
    assert not inspect.signature(env.render).parameters and not inspect.signature(env.close).parameters
    assert env.metadata["render_modes"] == ["rgb_array"] and env.metadata["render_fps"] > 0
    observation, info = env.reset(seed=3, options={})
    assert env.observation_space.contains(observation) and isinstance(info, dict)
    assert env.action_space.contains(env.action_space.sample())
    again, _ = env.reset(seed=3)
    assert np.array_equal(observation, again)
    assert not np.array_equal(observation, env.reset(seed=4)[0])
    env.reset(seed=3)
    steps = 0
    terminated = truncated = False
    while not (terminated or truncated):  # Full ahead: into the wall.
        observation, reward, terminated, truncated, info = env.step(np.array([1, 0], dtype=np.float32))
        steps += 1
        assert env.observation_space.contains(observation) and isinstance(reward, float)
        assert type(terminated) is bool and type(truncated) is bool and isinstance(info, dict)
    assert terminated and not truncated and reward == -10 and steps < 60
    assert env.render().shape[2] == 3 and env.render().dtype == np.uint8
    env.close()


def main():
    name, source = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    if name == "pictures":
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            print("Skipped: there is no matplotlib (python3-matplotlib)")
            return SKIPPED
    arguments = ["9"] if name == "speed" else []
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, source / f"examples/python/{name}.py", *arguments], cwd=folder,
                              env=dict(os.environ, PYTHONDONTWRITEBYTECODE="1"), capture_output=True, text=True, timeout=300)
        print(done.stdout, done.stderr)
        assert done.returncode == 0 and done.stderr == ""
        globals()[f"check_{name}"](pathlib.Path(folder), done.stdout)
    if name == "gym_environment":
        check_gym_by_signature(source)
    return 0


if __name__ == "__main__":
    sys.exit(main())
