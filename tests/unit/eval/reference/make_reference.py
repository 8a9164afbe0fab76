#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""Metrics by independent implementations, for the tests of eval/.

    apt-get install python3-skimage python3-scipy python3-numpy      # Debian 12: 0.19.3, 1.10.1, 1.24.2
    python3 tests/unit/eval/reference/make_reference.py > tests/unit/eval/reference/reference.json

The inputs are formulas that the tests evaluate again (see eval_reference.hpp): nothing but numbers is stored.
"""
import json
import sys

import numpy as np
import scipy
import skimage
from scipy.spatial import cKDTree
from scipy.stats import rankdata, spearmanr
from skimage.metrics import peak_signal_noise_ratio, structural_similarity


def hashed(n, seed):
    """n numbers in [0, 1): multiples of 2^-24, so that they are the same in single precision."""
    x = (np.arange(n, dtype=np.uint64) + np.uint64(seed * 1000003)) & np.uint64(0xFFFFFFFF)
    for multiplier in (0x7FEB352D, 0x846CA68B):
        x = ((x ^ (x >> np.uint64(16))) * np.uint64(multiplier)) & np.uint64(0xFFFFFFFF)
    x = x ^ (x >> np.uint64(15))
    return (x >> np.uint64(8)).astype(np.float64) / 2.0**24


def picture(rows, columns, seed):
    """Ramps and steps, rounded to multiples of 2^-12."""
    y, x = np.mgrid[0:rows, 0:columns]
    smooth = (3 * x * x + 5 * y + 7 * seed * x) % 1024 / 1024.0
    steps = ((x // 7 + y // 5 + seed) % 3) / 4.0
    return np.round((0.5 * smooth + 0.5 * steps) * 4096) / 4096


def image_case(rows, columns, amount, seed):
    a = picture(rows, columns, seed)
    noise = np.round((hashed(rows * columns, seed).reshape(rows, columns) - 0.5) * amount * 4096) / 4096
    b = np.clip(a + noise, 0, 1)
    return {
        "rows": rows, "columns": columns, "amount": amount, "seed": seed,
        "psnr": peak_signal_noise_ratio(a, b, data_range=1),
        "ssim": structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1),
    }


def ause(uncertainty, error, n=100):
    """From the definition, for uncertainties without ties."""
    def curve(order):
        kept = [max(1, (n - k) * len(error) // n) for k in range(n)]
        return np.array([np.sqrt(np.mean(error[order[:m]] ** 2)) for m in kept]) / np.sqrt(np.mean(error**2))

    return np.trapz(curve(np.argsort(uncertainty)) - curve(np.argsort(np.abs(error))), dx=1 / n)


def uncertainty_case(n, seed, correlation):
    error = 2 * hashed(n, seed) - 1
    uncertainty = correlation * np.abs(error) + (1 - correlation) * hashed(n, seed + 1)
    levels = np.floor(8 * uncertainty)  # ties
    return {
        "n": n, "seed": seed, "correlation": correlation,
        "spearman": spearmanr(uncertainty, np.abs(error)).correlation,
        "spearman_ties": spearmanr(levels, np.floor(16 * np.abs(error))).correlation,
        "rank_sum_of_squares": float(np.sum(rankdata(levels) ** 2)),
        "ause": ause(uncertainty, error),
    }


def points_case(n, m, seed, threshold):
    a = hashed(3 * n, seed).reshape(n, 3)
    b = hashed(3 * m, seed + 1).reshape(m, 3)
    to_b, index = cKDTree(b).query(a)
    to_a, _ = cKDTree(a).query(b)
    return {
        "n": n, "m": m, "seed": seed, "threshold": threshold,
        "mean_to_b": to_b.mean(), "mean_to_a": to_a.mean(), "within_of_b": float((to_b < threshold).mean()),
        "within_of_a": float((to_a < threshold).mean()), "index_sum": int(index.sum()),
    }


def labels_case(n, seed, classes):
    truth = np.floor(classes * hashed(n, seed)).astype(int)
    estimate = np.where(hashed(n, seed + 1) < 0.7, truth, np.floor(classes * hashed(n, seed + 2))).astype(int)
    known = truth != 0
    iou = [
        float(np.sum(known & (truth == c) & (estimate == c)) / np.sum(known & ((truth == c) | (estimate == c))))
        for c in range(1, classes)
    ]
    return {"n": n, "seed": seed, "classes": classes, "iou": iou, "accuracy": float(np.mean((truth == estimate)[known]))}


def depth_case(n, seed):
    truth, estimate = 1 + 4 * hashed(n, seed), 1 + 4 * hashed(n, seed + 1)
    truth[hashed(n, seed + 2) < 0.1] = np.nan
    estimate[hashed(n, seed + 3) < 0.2] = np.nan
    mask = hashed(n, seed + 4) < 0.5
    counted = mask & ~np.isnan(truth)
    error = (estimate - truth)[counted]
    return {
        "n": n, "seed": seed, "pixels": int(counted.sum()), "known": float(np.mean(~np.isnan(error))),
        "rmse": float(np.sqrt(np.nanmean(error**2))), "mae": float(np.nanmean(np.abs(error))),
    }


json.dump(
    {
        "made_with": {"scikit-image": skimage.__version__, "scipy": scipy.__version__, "numpy": np.__version__},
        "images": [image_case(11, 11, 0.5, 1), image_case(37, 53, 0.1, 2), image_case(64, 48, 0.02, 3),
                   image_case(100, 101, 1.0, 4)],
        "uncertainty": [uncertainty_case(1000, 11, 0.0), uncertainty_case(777, 12, 0.5), uncertainty_case(1234, 13, 0.9),
                        uncertainty_case(50, 14, 0.3)],
        "points": [points_case(2000, 3000, 21, 0.05), points_case(500, 20, 22, 0.2)],
        "labels": [labels_case(5000, 31, 5)],
        "depth": [depth_case(6000, 41)],
    },
    sys.stdout, indent=1)
print()
