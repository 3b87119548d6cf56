"""Segmentation by clustering optical flow into affine layers, after J. Wang and E. Adelson, "Representing
moving images with layers", 1994, from the same circles that relievo starts from.

Each region's flow is fitted by u = a + bx + cy and v likewise, with outliers weighed down; each pixel goes
to the region whose fit is nearest to the flow around it; and so on until hardly a pixel changes.
"""

import cv2
import numpy as np

# Standard deviation, in pixels, of the Gaussian that residuals are averaged with: outlines are lines, not dust. The least
# of 1.5 to 6 has the fewest labels wrong on average.
SMOOTHING = 1.5
ROUNDS = 50
# Share of pixels that may still change when it has come to rest.
STILL = 1e-4
# Weighted fits for each region and round.
REWEIGHTED = 5
# Least residual, in pixels, that counts as an outlier's.
LEAST_SCALE = 0.05


def cluster(flow: np.ndarray, circles: list[tuple[float, float, float]]) -> np.ndarray:
    """Labels: 0 for the background, k for what began as the k-th circle."""
    height, width = flow.shape[:2]
    y, x = np.mgrid[:height, :width].astype(float)
    # Centred and of order one, so that the fits are well conditioned.
    basis = np.dstack([np.ones_like(x), (x - width / 2) / width, (y - height / 2) / width])
    labels = np.zeros((height, width), np.uint8)
    for k, (cx, cy, r) in enumerate(circles, 1):
        labels[np.hypot(x - cx, y - cy) < r] = k
    # A region that has lost its last pixel keeps its last fit, and with it a chance to come back.
    fits = [np.zeros((3, 2)) for _ in range(len(circles) + 1)]
    for _ in range(ROUNDS):
        for k in range(len(fits)):
            inside = labels == k
            if inside.sum() > basis.shape[2]:
                fits[k] = fit(basis[inside], flow[inside])
        residuals = [np.square(basis @ f - flow).sum(axis=2) for f in fits]
        smooth = [cv2.GaussianBlur(np.sqrt(r), (0, 0), SMOOTHING) for r in residuals]
        before, labels = labels, np.argmin(smooth, axis=0).astype(np.uint8)
        if (before != labels).mean() <= STILL:
            break
    return labels


def fit(basis: np.ndarray, flow: np.ndarray) -> np.ndarray:
    """Least squares, reweighted (Geman and McClure's weights, scale from the median residual)."""
    weight = np.ones(len(basis))
    for _ in range(REWEIGHTED):
        weighted = basis * weight[:, None]
        solution = np.linalg.lstsq(weighted.T @ basis, weighted.T @ flow, rcond=None)[0]
        residual = np.linalg.norm(basis @ solution - flow, axis=1)
        scale = max(2 * np.median(residual), LEAST_SCALE)
        weight = 1 / np.square(1 + np.square(residual / scale))
    return solution
