#!/usr/bin/env python3
"""A Gymnasium environment: a vehicle with a sonar has to keep its distance from a wall, in a current.

    python3 gym_environment.py       # flies it with a simple controller

With gymnasium installed WallEnv is a gymnasium.Env; without, it has the same methods and spaces of the same form.

Observation: float32 [bins, beams], levels from 0 (60 dB below the loudest that a wall gives) to 1.
Action: float32 [2], speed ahead and to port in units of 1 m/s, from -1 to 1, for one ping (0.25 s).
Reward: 1 at the wanted distance, less by the metre. An episode ends at the wall (terminated, -10) or after 60 pings.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

import insonify

try:
    import gymnasium  # type: ignore[import]
    from gymnasium.spaces import Box  # type: ignore[import]

    Base: Any = gymnasium.Env
except ImportError:
    Base = object

    @dataclasses.dataclass
    class Box:  # type: ignore[no-redef]
        """As much of gymnasium.spaces.Box as this needs."""

        low: float
        high: float
        shape: tuple[int, ...]
        dtype: Any = np.float32

        def contains(self, x: Any) -> bool:
            return bool(x.shape == self.shape and x.dtype == self.dtype and np.all(x >= self.low) and np.all(x <= self.high))

        def sample(self) -> Any:
            return np.random.default_rng().uniform(self.low, self.high, self.shape).astype(self.dtype)


SPAN = 60.0  # [dB]
LOUDEST = -40.0  # [dB re the source at 1 m, raised by 30 dB per decade of range]


class WallEnv(Base):  # type: ignore[misc]
    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}

    def __init__(self, wanted: float = 5.0, render_mode: str | None = None) -> None:
        self.wanted, self.render_mode = wanted, render_mode
        sonar = insonify.SonarConfig(name="fls", beam_count=32, bin_count=100, min_range=0.5, max_range=12,
                                     azimuth_aperture_deg=60, elevation_aperture_deg=15, frequency=600e3,
                                     sampling=insonify.Sampling(columns_per_beam=2, rows=16))
        scene = insonify.Scene()
        scene.add("wall", [[0, -80, -20], [0, 80, -20], [0, 80, 20], [0, -80, 20]], [[0, 1, 2], [0, 2, 3]], "concrete")
        self._sim = insonify.Simulator(insonify.Scenario(sonars=[sonar], ground_truth="none"), scene)
        self._gain = 30 * np.log10(sonar.bin_ranges())[:, None]
        self.ranges = sonar.bin_ranges()
        self.observation_space = Box(0.0, 1.0, (sonar.bin_count, sonar.beam_count), np.float32)
        self.action_space = Box(-1.0, 1.0, (2,), np.float32)
        self._random = np.random.default_rng()
        self._step = 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        if Base is not object:
            super().reset(seed=seed)
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self._position = np.array([-self._random.uniform(3, 10), self._random.uniform(-5, 5)])  # The wall is at x = 0.
        self._current = self._random.uniform(-0.3, 0.3, 2)
        self._step = 0
        self._number = int(self._random.integers(2**31))  # Of the first ping: its noise.
        return self._look(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        speed = np.clip(np.asarray(action, dtype=float), -1, 1) + self._current
        self._position = self._position + 0.25 * speed
        self._step += 1
        distance = -self._position[0]
        terminated = bool(distance < 0.6)
        truncated = self._step >= 60
        reward = -10.0 if terminated else 1.0 - abs(distance - self.wanted)
        if terminated:
            self._position[0] = -0.6
        return self._look(), float(reward), terminated, truncated, self._info()

    def render(self) -> Any:
        return insonify.fan(self._ping, levels=(LOUDEST - SPAN, LOUDEST)) if self.render_mode == "rgb_array" else None

    def close(self) -> None:
        pass

    def _look(self) -> Any:
        pose = insonify.Pose.rpy((*self._position, 0))
        self._ping = self._sim.ping("fls", pose, number=self._number + self._step)
        levels = insonify.to_db(self._ping.intensity) + self._gain
        return np.clip((levels - LOUDEST) / SPAN + 1, 0, 1).astype(np.float32)

    def _info(self) -> dict[str, Any]:
        return {"distance": float(-self._position[0])}


def controller(env: WallEnv, observation: Any) -> Any:
    """Goes ahead or back by the range of the strongest echo in the middle beams."""
    middle = observation[:, 14:18].mean(axis=1)
    error = env.ranges[np.argmax(middle)] - env.wanted
    return np.array([np.clip(2 * error, -1, 1), 0], dtype=np.float32)


def main() -> None:
    env = WallEnv()
    for episode in range(3):
        observation, info = env.reset(seed=episode)
        begin, total = info["distance"], 0.0
        terminated = truncated = False
        while not (terminated or truncated):
            observation, reward, terminated, truncated, info = env.step(controller(env, observation))
            total += reward
        print(f"Episode {episode}: from {begin:.1f} m to {info['distance']:.2f} m of {env.wanted:g} m, reward {total:.1f}")
    env.close()


if __name__ == "__main__":
    main()
