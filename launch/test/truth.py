# SPDX-License-Identifier: BSD-3-Clause
"""Poses of messages and of the simulator's truth, as 4x4 matrices."""
import numpy as np


def matrix(p, q):
    """4x4 of a translation and a quaternion x, y, z, w."""
    x, y, z, w = np.array(q) / np.linalg.norm(q)
    result = np.eye(4)
    result[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    result[:3, 3] = p
    return result


def pose_of(message):
    p, q = message.position, message.orientation
    return matrix((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))


def true_poses(path, stamps):
    """At these times: from the nearest of 200 a second, 2 ms or less away, carried on at the speed there."""
    rows = np.loadtxt(path)
    found = []
    for stamp in stamps:
        i = min(max(1, np.abs(rows[:, 0] - stamp.to_sec()).argmin()), len(rows) - 2)
        share = (stamp.to_sec() - rows[i - 1, 0]) / (rows[i + 1, 0] - rows[i - 1, 0])
        between = (1 - share) * rows[i - 1, 1:] + share * rows[i + 1, 1:]  # neighbours in a file have quaternions of one sign
        found.append(matrix(between[:3], between[3:]))
    return found
