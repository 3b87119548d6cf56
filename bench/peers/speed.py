"""Times the peers' optical flow: answers a line of JSON by a line of JSON, for `npm run bench`.

A request is {"work": "tvl1" or "dis", "folder": what `bench/speed` rendered}; the answer has seconds, and the mean
end-point error (AEE) in pixels. One thread.
"""

import json
import sys
from pathlib import Path
from time import perf_counter

import cv2
import numpy as np

import flows

cv2.setNumThreads(1)

WORK = {"tvl1": flows.tvl1, "dis": flows.dis}


def read(folder: Path) -> tuple[list[np.ndarray], np.ndarray]:
    """Two grey frames and the true flow."""
    about = json.loads((folder / "scene.json").read_text(encoding="utf8"))
    shape = (about["height"], about["width"])
    grey = []
    for i in (0, 1):
        rgba = np.fromfile(folder / f"frame{i}.rgba", np.uint8).reshape(*shape, 4)
        grey.append(cv2.cvtColor(rgba, cv2.COLOR_RGBA2GRAY))
    return grey, np.fromfile(folder / "flow0.flo", "<f4", offset=12).reshape(*shape, 2)


def main() -> None:
    for line in sys.stdin:
        request = json.loads(line)
        grey, truth = read(Path(request["folder"]))
        start = perf_counter()
        found = WORK[request["work"]](*grey)
        seconds = perf_counter() - start
        known = np.isfinite(truth).all(axis=2)
        print(json.dumps({"total": seconds, "aee": flows.aee(found, truth, known)}), flush=True)


if __name__ == "__main__":
    main()
