"""AEE in pixels of TV-L1 and DIS on one pair of frames: pair.py FIRST SECOND FLOW.flo prints both numbers."""

import sys
from pathlib import Path

import cv2
import numpy as np

import flows
import sequences


def main() -> None:
    first, second, truth = sys.argv[1:]
    frames = [cv2.imread(path, cv2.IMREAD_GRAYSCALE) for path in (first, second)]
    flow = sequences.read_flo(Path(truth))
    known = (np.abs(flow) < sequences.UNKNOWN_ABOVE).all(axis=2)
    print(*(flows.aee(of(*frames), flow, known) for of in (flows.tvl1, flows.dis)))


if __name__ == "__main__":
    main()
