#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Distances of a map's points to the true surfaces of a simulated session:

    distance_to_truth.py MAP.ply BAG.truth [TRAJECTORY.tum]

With a trajectory, the map is moved by the rigid motion that aligns its poses with the true ones. Points farther than 20 m from the
laser and those nearest to leaves are omitted; points of dense stereo have a separate line.
"""
import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "ushort": "<u2", "int": "<i4"}
LEAVES, LASER_HEIGHT, FARTHEST, LEVER, SHOWN, STEREO = 6, 0.75, 20.0, 8.0, 80000, 255


def read_ply(path):
    fields, count = [], 0
    with open(path, "rb") as file:
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode().split()
            if words[0] == "element":
                count = int(words[2])
            elif words[0] == "property":
                fields.append((words[2], TYPES[words[1]]))
        return np.frombuffer(file.read(count * np.dtype(fields).itemsize), np.dtype(fields))


def positions(cloud):
    return np.column_stack([cloud[axis] for axis in "xyz"]).astype(float)


def distances(points, truth):
    """Returns distances to the plane through the seven nearest samples, if they are flat and around the point, else to the nearest."""
    near_distance, near = cKDTree(truth).query(points, k=7)
    patches = truth[near]
    centres = patches.mean(1)
    offsets = patches - centres[:, None]
    values, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", offsets, offsets))
    plane = np.abs(np.einsum("ni,ni->n", points - centres, vectors[:, :, 0]))
    aside = np.sqrt(np.maximum(near_distance[:, 0] ** 2 - plane ** 2, 0.0))
    flat = (values[:, 0] < 0.02 * values[:, 1]) & (aside < 0.1)
    return np.where(flat, np.minimum(plane, near_distance[:, 0]), near_distance[:, 0]), near[:, 0]


def spread(poses):
    """Returns points around each pose, because positions on a straight line do not determine the rotation about it."""
    axes = LEVER * Rotation.from_quat(poses[:, 4:8]).as_matrix()
    return np.concatenate([poses[:, 1:4] + sign * axes[:, :, i] for i in range(3) for sign in (-1, 1)])


def rigid_motion(source, target):
    """Returns R, t that take `source` to `target` (Umeyama 1991)."""
    u, _, v = np.linalg.svd((target - target.mean(0)).T @ (source - source.mean(0)))
    rotation = u @ np.diag([1.0, 1.0, np.linalg.det(u @ v)]) @ v
    return rotation, target.mean(0) - rotation @ source.mean(0)


def measure(map_ply, folder, trajectory=None):
    """Returns {"lasers": (distances m, stated sigmas m), "stereo": ...} of the points of a map, without kinds that have no points."""
    cloud, folder = read_ply(map_ply), Path(folder)
    points, stamps = positions(cloud), cloud["stamp"]
    true = np.loadtxt(folder / "trajectory.tum")
    interpolated = lambda at: np.column_stack([np.interp(at, true[:, 0], true[:, i]) for i in (1, 2, 3)])
    if trajectory:
        estimate = np.loadtxt(trajectory)
        nearest = np.clip(np.searchsorted(true[:, 0], estimate[:, 0]), 0, len(true) - 1)
        rotation, translation = rigid_motion(spread(estimate), spread(true[nearest]))
        points = points @ rotation.T + translation
    near = np.linalg.norm(points - interpolated(stamps) - [0.0, 0.0, LASER_HEIGHT], axis=1) < FARTHEST
    chosen = np.flatnonzero(near)
    chosen = chosen[:: max(1, len(chosen) // SHOWN)]
    truth = read_ply(folder / "cloud.ply")
    distance, nearest = distances(points[chosen], positions(truth))
    stereo = cloud["laser"][chosen] == STEREO
    kinds = {name: kind & (truth["class"][nearest] != LEAVES) for name, kind in (("lasers", ~stereo), ("stereo", stereo))}
    return {name: (distance[used], cloud["sigma"][chosen][used]) for name, used in kinds.items() if used.any()}


def main():
    for name, (d, sigma) in measure(*sys.argv[1:4]).items():
        print(f"{name}, {len(d)} points: median {1e3 * np.median(d):.2f} mm, 95 % {100 * np.quantile(d, .95):.2f} cm, "
              f"99 % {100 * np.quantile(d, .99):.2f} cm; median of distance over sigma {np.median(d / sigma):.2f}")


if __name__ == "__main__":
    main()
