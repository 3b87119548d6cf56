"""Optical flow of others, in pixels, u to the right and v down, with their own defaults."""

import cv2
import numpy as np
from skimage.registration import optical_flow_tvl1

# Weight of the data against smoothness, scikit-image's own default.
ATTACHMENT = 15


def dis(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Dense inverse search (T. Kroeger et al., 2016), preset medium."""
    return cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM).calc(first, second, None)


def tvl1(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """TV-L1 (C. Zach et al., 2007)."""
    frames = [frame.astype(np.float32) / 255 for frame in (first, second)]
    # It gives rows first.
    v, u = optical_flow_tvl1(*frames, attachment=ATTACHMENT)
    return np.dstack([u, v])


def aee(found: np.ndarray, truth: np.ndarray, known: np.ndarray) -> float:
    """Mean length of the error in pixels, where the truth is known."""
    return float(np.linalg.norm(found - truth, axis=2)[known].mean())
