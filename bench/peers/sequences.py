"""Exported sequences: a folder each, as `npm run accuracy -- --export DIR` writes them."""

import json
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

# Middlebury's mark for a flow that is not known.
UNKNOWN_ABOVE = 1e9
# Image motion in pixels that is none.
STILL_BELOW = 1e-3


@dataclass
class Sequence:
    """Two frames, the truth about them, and the circles to start from."""

    name: str
    grey: list[np.ndarray]  # uint8, one plane
    flow: np.ndarray  # height, width, (u right, v down)
    known: np.ndarray  # where flow is
    labels: np.ndarray  # 0 the background, k inside the k-th circle's object
    circles: list[tuple[float, float, float]]

    def moving(self) -> int:
        """How many regions move, the background included."""
        speed = np.linalg.norm(self.flow, axis=2)
        regions = range(len(self.circles) + 1)
        return sum(bool((speed[self.known & (self.labels == k)] > STILL_BELOW).any()) for k in regions)


def read_all(folder: Path) -> list[Sequence]:
    """Every sequence of `folder`: built-in ones before variants, names in order."""
    found = [path.parent for path in folder.glob("*/scene.json")]
    if not found:
        raise SystemExit(f"{folder} holds no exported sequence")
    return [read(path) for path in sorted(found, key=lambda p: ("-" in p.name, number(p.name), p.name))]


def number(name: str) -> int:
    """A variant's seed, so that variants come in the order in which they were drawn."""
    tail = name.rpartition("-")[2]
    return int(tail) if tail.isdigit() else 0


def read(folder: Path) -> Sequence:
    about = json.loads((folder / "scene.json").read_text(encoding="utf8"))
    flow = read_flo(folder / "flow.flo")
    return Sequence(
        name=folder.name,
        grey=[cv2.imread(str(folder / f"frame{i}.png"), cv2.IMREAD_GRAYSCALE) for i in (0, 1)],
        flow=flow,
        known=(np.abs(flow) < UNKNOWN_ABOVE).all(axis=2),
        labels=cv2.imread(str(folder / "labels.png"), cv2.IMREAD_UNCHANGED),
        circles=[(c["x"], c["y"], c["r"]) for c in about["curves"] if c["kind"] == "circle"],
    )


def read_flo(path: Path) -> np.ndarray:
    data = path.read_bytes()
    if data[:4] != b"PIEH":
        raise SystemExit(f"{path} is no Middlebury flow")
    width, height = np.frombuffer(data, "<i4", 2, offset=4)
    return np.frombuffer(data, "<f4", 2 * width * height, offset=12).reshape(height, width, 2)
