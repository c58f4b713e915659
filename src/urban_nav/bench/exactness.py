# SPDX-License-Identifier: BSD-3-Clause
"""Tests the consistency of cameras, lasers, gyroscope and poses of a simulated session with only numpy and OpenCV:

    urban_nav simulate --world quad --seed 7 --duration 20 --sensors stereo,lasers,imu --folder quad -o quad.bag
    python3 exactness.py quad.bag quad [-o exactness.json]

SESSION.bag has its truth beside it in SESSION.truth/; FOLDER is what --folder wrote.
"""
import argparse
from pathlib import Path

import cv2
import numpy as np

import bags
from support import commit, show
from truth import Surface, Truth, angle, inverse, moved

NEAR, FAR = 1.0, 6.0  # m of depth in which stereo is accurate
STEP = 6              # frames between which motion is estimated: about 0.4 m


class Session:
    def __init__(self, bag, folder):
        self.truth = Truth(bag.with_suffix(".truth") / "trajectory.tum")
        self.surface = Surface(bag.with_suffix(".truth") / "cloud.ply", self.truth.places)
        self.folder, links = folder, []
        self.left, self.scans, self.rates = [], [], []
        wanted = {"tf_static", "stereo/left/image_raw", "laser_left/scan", "laser_right/scan", "imu/data"}
        for topic, body in bags.messages(bag, wanted):
            if topic == "tf_static":
                links += bags.transforms(body)
            elif topic == "stereo/left/image_raw":
                self.left.append(bags.header(body)[0])
            elif topic == "imu/data":
                self.rates.append(bags.rate(body))
            else:
                self.scans.append(bags.scan(body))
        self.places = {"base_link": np.eye(4)}  # T_base_frame
        for _ in links:
            for parent, child, matrix in links:
                if parent in self.places:
                    self.places[child] = self.places[parent] @ matrix
        lines = dict(line.split(":", 1) for line in (folder / "calib.txt").read_text().splitlines() if ":" in line)
        left, right = (np.array(lines[name].split(), float).reshape(3, 4) for name in ("P0", "P1"))
        self.camera, self.bf = left[:, :3], left[0, 3] - right[0, 3]
        self.eyes = self.truth.at(np.array(self.left)) @ self.places["stereo_left_optical_frame"]

    def image(self, side, i):
        return cv2.imread(str(self.folder / f"image_{side}" / f"{i:06d}.png"), cv2.IMREAD_GRAYSCALE)

    def points(self, pixels, disparity):
        """Returns points in the left camera."""
        rays = np.column_stack([pixels, np.ones(len(pixels))]) @ np.linalg.inv(self.camera).T
        return rays * (self.bf / disparity)[:, None]


def followed(a, b, corners):
    """Returns the positions in b of corners of a (Lucas and Kanade), and which of them return to their start."""
    how = dict(winSize=(13, 13), maxLevel=4, criteria=(3, 50, 0.001))
    there, ok, _ = cv2.calcOpticalFlowPyrLK(a, b, corners, None, **how)
    back, ok_back, _ = cv2.calcOpticalFlowPyrLK(b, a, there, None, **how)
    same = np.linalg.norm((back - corners).reshape(-1, 2), axis=1) < 0.3
    return there.reshape(-1, 2).astype(float), same & (ok.ravel() == 1) & (ok_back.ravel() == 1)


def poses(session):
    """Compares poses.txt with the trajectory, both relative to the first left camera."""
    rows = np.loadtxt(session.folder / "poses.txt").reshape(-1, 3, 4)
    if len(rows) != len(session.eyes):
        raise ValueError(f"{len(rows)} poses in poses.txt, {len(session.eyes)} left images in the bag")
    first, metres, turn = inverse(session.eyes[0]), 0.0, 0.0
    start = np.vstack([rows[0], [0, 0, 0, 1]])
    for row, eye in zip(rows, session.eyes):
        apart = inverse(inverse(start) @ np.vstack([row, [0, 0, 0, 1]])) @ first @ eye
        metres, turn = max(metres, np.linalg.norm(apart[:3, 3])), max(turn, angle(apart[:3, :3]))
    return [["poses.txt beside trajectory.tum and tf, at most", f"{1000 * metres:.2f} mm, {turn:.4f} deg", "",
             len(rows)]]


def corners_all_over(image, size=64):
    """Returns the strongest corner of each square of the image, so that ground and walls have equal weight."""
    found = []
    for v in range(0, image.shape[0], size):
        for u in range(0, image.shape[1], size):
            corners = cv2.goodFeaturesToTrack(image[v:v + size, u:u + size], 20, 0.01, 6)
            if corners is not None:
                found.append(corners + np.float32([u, v]))
    return np.concatenate(found) if found else None


def motion(session):
    """Triangulates corners of a pair, tracks them, and estimates camera motion by solvePnP."""
    told, true, apart, turns = [], [], [], []
    for i in range(0, len(session.eyes) - STEP, STEP):
        left, right, later = session.image(0, i), session.image(1, i), session.image(0, i + STEP)
        corners = corners_all_over(left)
        if corners is None:
            continue
        other, paired = followed(left, right, corners)
        next_, found = followed(left, later, corners)
        pixels = corners.reshape(-1, 2).astype(float)
        disparity = pixels[:, 0] - other[:, 0]
        good = paired & found & (disparity > session.bf / 25) & (np.abs(pixels[:, 1] - other[:, 1]) < 0.7)
        if good.sum() < 30:
            continue
        points = session.points(pixels[good], disparity[good])
        cv2.setRNGSeed(i)
        ok, turn, shift, inliers = cv2.solvePnPRansac(points, next_[good], session.camera, None, reprojectionError=1.0,
                                                     iterationsCount=300, confidence=0.999)
        if not ok or inliers is None or len(inliers) < 20:
            continue
        turn, shift = cv2.solvePnPRefineLM(points[inliers[:, 0]], next_[good][inliers[:, 0]], session.camera, None,
                                           turn, shift)
        now = inverse(session.eyes[i + STEP]) @ session.eyes[i]
        told.append(np.linalg.norm(shift))
        true.append(np.linalg.norm(now[:3, 3]))
        apart.append(np.linalg.norm(shift.ravel() - now[:3, 3]))
        turns.append(angle(cv2.Rodrigues(turn)[0].T @ now[:3, :3]))
    ratio = 100 * (sum(told) / sum(true) - 1)
    return [["length of the motion by solvePnP over the true one", f"{ratio:+.2f} %", "1 %", len(told)],
            ["each step of it off by, median", f"{1000 * np.median(apart):.1f} mm of {1000 * np.median(true):.0f}, "
             f"{np.median(turns):.3f} deg", "", len(told)]]


def by_blocks(session, i, matcher):
    """StereoSGBM: pixels and disparities, 3000 of them."""
    disparity = matcher.compute(session.image(0, i), session.image(1, i)) / 16.0
    v, u = np.nonzero((disparity > session.bf / FAR) & (disparity < min(62, session.bf / NEAR)))
    some = np.linspace(0, len(v) - 1, min(3000, len(v))).astype(int)
    return np.column_stack([u[some], v[some]]).astype(float), disparity[v[some], u[some]]


def by_corners(session, i, _):
    """Lucas and Kanade: another matcher with other errors."""
    left, right = session.image(0, i), session.image(1, i)
    found = cv2.goodFeaturesToTrack(left, 1500, 0.002, 5)
    if found is None:
        return np.empty((0, 2)), np.empty(0)
    other, paired = followed(left, right, found)
    pixels = found.reshape(-1, 2).astype(float)
    disparity = pixels[:, 0] - other[:, 0]
    paired &= (disparity > session.bf / FAR) & (disparity < session.bf / NEAR)
    paired &= np.abs(pixels[:, 1] - other[:, 1]) < 0.7
    return pixels[paired], disparity[paired]


def disparities(session, name, match):
    """Compares with the plane at a pixel if there is one; and the resulting depth of walls."""
    matcher = cv2.StereoSGBM_create(0, 64, 5, 200, 800, 1, 31, 10, 100, 2)
    pixels_off, walls_off = [], []
    for i in range(0, len(session.eyes), max(1, len(session.eyes) // 40)):
        pixels, disparity = match(session, i, matcher)
        if not len(pixels):
            continue
        local = session.points(pixels, disparity)
        points, origin = moved(session.eyes[i], local), session.eyes[i][:3, 3]
        behind, flat = session.surface.along(np.tile(origin, (len(points), 1)), points)
        # Behind along the ray, in depth, in disparity.
        deeper = behind * local[:, 2] / np.linalg.norm(local, axis=1)
        flat &= np.abs(deeper) < 0.2 * local[:, 2]
        pixels_off.append((disparity - session.bf / (local[:, 2] - deeper))[flat])
        upright = np.abs(session.surface.planes(points)[1][:, 2]) < 0.2
        walls_off.append(deeper[flat & upright])
    pixels_off, walls_off = np.concatenate(pixels_off), np.concatenate(walls_off)
    wall = "too few"
    if len(walls_off) > 500:
        wall = f"{100 * np.median(walls_off):+.1f} cm, {100 * np.median(np.abs(walls_off)):.1f} cm"
    return [[f"{name}: disparity less the true one, median; of its size",
             f"{np.median(pixels_off):+.3f} px, {np.median(np.abs(pixels_off)):.3f} px", "0.05 px", len(pixels_off)],
            [f"{name}: walls {NEAR:.0f} to {FAR:.0f} m away too deep by, median; of its size", wall, "3 cm",
             len(walls_off)]]


def beams(session):
    """Evaluates each beam at its time on the true path."""
    rows = []
    for frame in ("laser_left", "laser_right"):
        off = []
        for stamp, name, angles, delays, ranges in [s for s in session.scans if s[1] == frame][::25]:
            good = np.isfinite(ranges) & (ranges > 0.1) & (ranges < 15)
            sensor = session.truth.at(stamp + delays[good]) @ session.places[frame]
            way = np.column_stack([np.cos(angles[good]), np.sin(angles[good]), np.zeros(good.sum())])
            points = np.einsum("nij,nj->ni", sensor[:, :3, :3], way * ranges[good, None]) + sensor[:, :3, 3]
            behind, flat = session.surface.along(sensor[:, :3, 3], points)
            off.append(behind[flat & (np.abs(behind) < 0.3)])
        off = np.concatenate(off) * 1000
        spread = (np.percentile(off, 84.13) - np.percentile(off, 15.87)) / 2
        rows.append([f"{frame}: behind the true surface, median; spread", f"{np.median(off):+.1f} mm; {spread:.1f} mm",
                     "within 5 mm; 5 mm", len(off)])
    return rows


def gyroscope(session):
    """Compares rates with those of the true path."""
    inside = [r for r in session.rates
              if session.truth.stamps[0] + 0.02 < r[0] < session.truth.stamps[-1] - 0.02]
    true = session.truth.rates(np.array([r[0] for r in inside]))
    off = [rate - session.places[frame][:3, :3].T @ turn for (_, frame, rate), turn in zip(inside, true)]
    return [["gyroscope less the true rate, root mean square", f"{np.sqrt(np.mean(np.square(off))):.4f} rad/s", "",
             len(off)]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    arguments = parser.parse_args()
    measured = commit()
    cv2.setNumThreads(1)
    session = Session(arguments.bag, arguments.folder)
    table = []
    for part in (poses, motion):
        table += part(session)
    table += disparities(session, "StereoSGBM", by_blocks) + disparities(session, "Lucas-Kanade", by_corners)
    for part in (beams, gyroscope):
        table += part(session)
    show(("simulated and true", "measured", "asked for", "of"), [[str(cell) for cell in row] for row in table], [], measured, arguments.output)


if __name__ == "__main__":
    main()
