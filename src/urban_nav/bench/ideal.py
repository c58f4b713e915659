# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a simulated session without noise agrees with its truth to numerical precision, and that clocks of devices can be corrected.
Uses only numpy and OpenCV; the sessions are simulated into FOLDER unless they exist.

    python3 ideal.py FOLDER [-o ideal.json]
"""
import argparse
from pathlib import Path

import cv2
import numpy as np

import bags
from support import commit, show, urban_nav
from truth import Surface, Truth, inverse, moved

GRAVITY = np.array([0.0, 0.0, 9.81])  # m/s^2
PATCH = 8                             # px to each side of a matched position
PLANE = 0.02                          # px, largest deviation of disparities of a patch from a plane
SOLID = (1, 2, 3, 4, 5)               # classes of ground and walls: static and without holes


def simulated(folder, name, *options):
    """Returns the bag and its truth folder."""
    bag = folder / f"{name}.bag"
    if not bag.exists():
        print(f"simulates {name}", flush=True)
        urban_nav("simulate", "--world", "quad", "--seed", 7, *options, "-o", bag)
    return bag, bag.with_suffix(".truth")


def places_of(bag):
    """Returns T_base_frame by frame."""
    links = [link for _, body in bags.messages(bag, {"tf_static"}) for link in bags.transforms(body)]
    return {child: matrix for parent, child, matrix in links if parent == "base_link"}


def sizes(off, unit=1.0, form=".3f"):
    off = unit * np.asarray(off)
    return f"{np.median(off):+{form}}, {np.median(np.abs(off)):{form}}"


# The gyroscope and accelerometer, integrated

def beginning(truth, place, when):
    """Returns pose and velocity of a device at a time, by polynomials through adjacent true poses."""
    near = np.argsort(np.abs(truth.stamps - when))[:10]
    times = truth.stamps[near] - when
    positions = (truth.at(truth.stamps[near]) @ place)[:, :3, 3]
    speed = [np.polyfit(times / 0.02, positions[:, i], 7)[-2] / 0.02 for i in range(3)]
    return (truth.at(when) @ place)[0], np.array(speed)


def integrated(pose, speed, rates, forces, step):
    """Fourth-order Runge-Kutta integration over two periods: start, middle, end."""
    def change(state, rate, force):
        turn, velocity = state[0], state[1]
        spin = np.array([[0, -rate[2], rate[1]], [rate[2], 0, -rate[0]], [-rate[1], rate[0], 0]])
        return [turn @ spin, turn @ force - GRAVITY, velocity]

    def after(state, by, time):
        return [a + time * b for a, b in zip(state, by)]
    state, time = [pose[:3, :3].copy(), speed, pose[:3, 3].copy()], 2 * step
    for i in range(0, len(rates) - 2, 2):
        first = change(state, rates[i], forces[i])
        second = change(after(state, first, time / 2), rates[i + 1], forces[i + 1])
        third = change(after(state, second, time / 2), rates[i + 1], forces[i + 1])
        last = change(after(state, third, time), rates[i + 2], forces[i + 2])
        mean = [(a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(first, second, third, last)]
        state = after(state, mean, time)
    return state


def imu(bag, truth, places):
    bodies = [body for _, body in bags.messages(bag, {"imu/data"})]
    stamps = np.array([bags.rate(body)[0] for body in bodies])
    rates, forces = np.array([bags.rate(body)[2] for body in bodies]), np.array([bags.force(body) for body in bodies])
    step, place, off = (stamps[-1] - stamps[0]) / (len(stamps) - 1), places["imu_link"], []
    for start in range(1, len(stamps) - 1001, 200):
        pose, speed = beginning(truth, place, stamps[start])
        end = integrated(pose, speed, rates[start:start + 1001], forces[start:start + 1001], step)
        off.append(np.linalg.norm(end[2] - (truth.at(stamps[start + 1000]) @ place)[0, :3, 3]))
    return [["IMU integrated over 10 s: off at the end, median; at most",
             f"{1000 * np.median(off):.3f} mm; {1000 * max(off):.3f} mm", "1 mm", len(off)]]


# One world point, by laser, depth image and surface

def view(truth_folder, stamp, side="left"):
    name = truth_folder / f"stereo_{side}_optical_frame" / str(stamp)
    return cv2.imread(f"{name}.pfm", cv2.IMREAD_UNCHANGED), cv2.imread(f"{name}.png", cv2.IMREAD_UNCHANGED)


def beams(bag, truth_folder, truth, places, wanted):
    """Time, origin and end in `world` of beams that end on ground and walls, every `wanted`-th turn, without noise."""
    scans = [bags.scan(body) for _, body in bags.messages(bag, {"laser_left/scan", "laser_right/scan"})]
    for frame in ("laser_left", "laser_right"):
        classes = np.loadtxt(truth_folder / f"{frame}.csv", delimiter=",", skiprows=1, usecols=3).reshape(-1, 181)
        own = [scan for scan in scans if scan[1] == frame]
        for (stamp, _, angles, delays, ranges), kinds in list(zip(own, classes))[::wanted]:
            good = np.isfinite(ranges) & (ranges < 15) & np.isin(kinds, SOLID)
            sensor = truth.at(stamp + delays[good]) @ places[frame]
            way = np.column_stack([np.cos(angles[good]), np.sin(angles[good]), np.zeros(good.sum())])
            yield stamp, sensor[:, :3, 3], moved_each(sensor, way * ranges[good, None])


def moved_each(poses, points):
    return np.einsum("nij,nj->ni", poses[:, :3, :3], points) + poses[:, :3, 3]


def planar(values, u, v, half, limit):
    """Returns values at (u, v) by a plane fitted to the square around each, and whether the fit is within `limit` of the value."""
    across, down = np.meshgrid(range(-half, half + 1), range(-half, half + 1))
    design = np.column_stack([np.ones(across.size), across.ravel(), down.ravel()])
    centre_u, centre_v = np.rint(u).astype(int), np.rint(v).astype(int)
    square = values[centre_v[:, None] + down.ravel(), centre_u[:, None] + across.ravel()].astype(float)
    square[~np.isfinite(square)] = 1e9
    plane = square @ np.linalg.pinv(design).T
    rough = np.abs(square - plane @ design.T).max(1)
    return plane[:, 0] + plane[:, 1] * (u - centre_u) + plane[:, 2] * (v - centre_v), rough < limit


def points(bag, truth_folder, truth, places, camera):
    surface = Surface(truth_folder / "cloud.ply", truth.places, rough=1e-5)
    stamps = [bags.image(body)[0] for _, body in bags.messages(bag, {"stereo/left/image_raw"})]
    eyes = truth.at(1e-9 * np.array(stamps)) @ places["stereo_left_optical_frame"]
    rows = []

    off = []
    for _, origins, ends in beams(bag, truth_folder, truth, places, 10):
        behind, flat = surface.along(origins, ends)
        off.append(behind[flat & (np.abs(behind) < 0.05)])
    rows.append(("laser beam, behind the true surface", np.concatenate(off)))

    off, v, u = [], *(grid.ravel() for grid in np.mgrid[8:384:8, 8:512:8])
    for stamp, eye in list(zip(stamps, eyes))[::20]:
        depth, kinds = view(truth_folder, stamp)
        solid = np.isin(kinds[v, u], SOLID) & (depth[v, u] < 15)
        local = np.column_stack([u, v, np.ones(len(u))])[solid] @ np.linalg.inv(camera[:, :3]).T * depth[v, u][solid, None]
        ends = moved(eye, local)
        behind, flat = surface.along(np.tile(eye[:3, 3], (len(ends), 1)), ends)
        off.append(behind[flat & (np.abs(behind) < 0.05)])
    rows.append(("depth image, behind the true surface", np.concatenate(off)))

    off = []
    views = {stamp: view(truth_folder, stamp)[0] for stamp in stamps[::10]}
    for when, origins, ends in beams(bag, truth_folder, truth, places, 20):
        for stamp, eye in list(zip(stamps, eyes))[::10]:
            if not 0.5 < when - 1e-9 * stamp < 8:
                continue
            local = moved(inverse(eye), ends)
            ahead = local[local[:, 2] > 1]
            pixels = ahead @ camera[:, :3].T / ahead[:, 2:]
            inside = ((pixels[:, :2] > 8) & (pixels[:, :2] < (503, 375))).all(1)
            ahead, pixels = ahead[inside], pixels[inside]
            nearness, flat = planar(1 / views[stamp], pixels[:, 0], pixels[:, 1], 2, 2e-6)
            deeper = (1 / nearness - ahead[:, 2]) * np.linalg.norm(ahead, axis=1) / ahead[:, 2]
            off.append(deeper[flat & (np.abs(deeper) < 0.02)])
    rows.append(("depth image, behind the end of a beam", np.concatenate(off)))
    return [[f"{name}: median of its size; 99 %", f"{np.median(np.abs(off)):.1e} m; {np.percentile(np.abs(off), 99):.1e} m",
             "1e-4 m", len(off)] for name, off in rows]


# Disparities of the texture

def pairs(bag):
    """Returns left and right images by stamp, rectified by OpenCV if camera_info has a distortion."""
    found, maps = {"left": {}, "right": {}}, {}
    topics = {f"stereo/{side}/{what}": side for side in found for what in ("image_raw", "camera_info")}
    for topic, body in bags.messages(bag, set(topics)):
        side = topics[topic]
        if topic.endswith("camera_info"):
            D, K, R, P = bags.camera_info(body)
            maps[side] = cv2.initUndistortRectifyMap(K, D, R, P[:, :3], (512, 384), cv2.CV_32FC1) if D.any() else None
        else:
            stamp, pixels = bags.image(body)
            found[side][stamp] = pixels
    for stamp in found["left"]:
        yield stamp, *(found[side][stamp] if maps[side] is None else
                       cv2.remap(found[side][stamp], *maps[side], cv2.INTER_LANCZOS4) for side in ("left", "right"))


def by_corners(left, right):
    """Lucas and Kanade on corners: pixels, disparities."""
    how = dict(winSize=(2 * PATCH + 1,) * 2, maxLevel=4, criteria=(3, 100, 1e-4))
    corners = cv2.goodFeaturesToTrack(left, 1500, 0.002, 5)
    there, ok, _ = cv2.calcOpticalFlowPyrLK(left, right, corners, None, **how)
    back, ok_back, _ = cv2.calcOpticalFlowPyrLK(right, left, there, None, **how)
    corners, there, back = (a.reshape(-1, 2).astype(float) for a in (corners, there, back))
    good = (ok.ravel() == 1) & (ok_back.ravel() == 1) & (np.linalg.norm(back - corners, axis=1) < 0.3)
    good &= np.abs(there[:, 1] - corners[:, 1]) < 0.7
    return corners[good], (corners - there)[good, 0]


def by_correlation(left, right):
    """Normalised correlation along the row, and a parabola through its best: pixels, disparities."""
    pixels, disparities = [], []
    for u, v in (corner.ravel().astype(int) for corner in cv2.goodFeaturesToTrack(left, 800, 0.002, 8)):
        if not (PATCH <= v < 384 - PATCH and 50 + PATCH <= u < 512 - PATCH):
            continue
        rows = slice(v - PATCH, v + PATCH + 1)
        strip, patch = right[rows, u - 50 - PATCH:u + PATCH + 1], left[rows, u - PATCH:u + PATCH + 1]
        score = cv2.matchTemplate(np.ascontiguousarray(strip), np.ascontiguousarray(patch), cv2.TM_CCOEFF_NORMED)[0]
        best = int(np.argmax(score))
        if score[best] < 0.9 or best in (0, len(score) - 1):
            continue
        a, b, c = score[best - 1:best + 2].astype(float)
        pixels.append((u, v))
        disparities.append(50 - best - 0.5 * (a - c) / (a - 2 * b + c))
    return np.array(pixels, float), np.array(disparities)


def by_blocks(left, right):
    """StereoSGBM, as in exactness.py: every fourth pixel of every fourth row that has a disparity."""
    disparity = cv2.StereoSGBM_create(0, 64, 5, 200, 800, 1, 31, 10, 100, 2).compute(left, right) / 16.0
    v, u = np.nonzero(disparity[::4, ::4] > 0)
    return 4.0 * np.column_stack([u, v]), disparity[4 * v, 4 * u]


def warped(stamp, left, bf, truth_folder):
    """Renders the left image in the right camera by the true depths: errors on this pair are those of the matcher."""
    depth = view(truth_folder, stamp, "right")[0]
    u, v = np.meshgrid(np.arange(left.shape[1], dtype=np.float32), np.arange(left.shape[0], dtype=np.float32))
    return cv2.remap(left, (u + bf / depth).astype(np.float32), v, cv2.INTER_LANCZOS4)


def disparities_of_blocks(bag, truth_folder, bf):
    rows = []
    for name, other in (("rectified", lambda stamp, left, right: right),
                        ("the left picture and itself, warped by the truth", lambda stamp, left, right: warped(stamp, left, bf, truth_folder))):
        matched = ((stamp, *by_blocks(left, other(stamp, left, right))) for stamp, left, right in list(pairs(bag))[::8])
        rows.append([f"{name}, StereoSGBM: disparity less the true one, median; of its size", *compare_with_truth(matched, truth_folder, bf)])
    return rows


def compare_with_truth(matched, truth_folder, bf):
    """Cells of the table, of (stamp, pixels, disparities): beside bf / depth where that is a plane all over the patch."""
    off = []
    for stamp, pixels, found in matched:
        inside = ((pixels > PATCH + 1) & (pixels < (510 - PATCH, 382 - PATCH))).all(1)
        pixels, found = pixels[inside], found[inside]
        true, flat = planar(bf / view(truth_folder, stamp)[0], pixels[:, 0], pixels[:, 1], PATCH, PLANE)
        off.append((found - true)[flat & (np.abs(found - true) < 1)])
    off = np.concatenate(off)
    return f"{sizes(off)} px", "0.05 px", len(off)


def disparities(name, bag, truth_folder, bf):
    """`truth_folder`: that of a session with rectified views."""
    rows = []
    for how, match in (("Lucas-Kanade", by_corners), ("correlation", by_correlation)):
        matched = ((stamp, *match(left, right)) for stamp, left, right in list(pairs(bag))[::4])
        rows.append([f"{name}, {how}: disparity less the true one, median; of its size", *compare_with_truth(matched, truth_folder, bf)])
    return rows


# Clocks

def clock_of(stamps, values, signal, begin, skewed):
    """Offset and, if `skewed`, skew of the stamps, by least squares; each channel has a scale and a constant of its own. `values`: rows of channels;
    `signal`: gives the true rows at true times."""
    def with_signal(offset, skew):
        times = stamps - offset - skew * (stamps - begin)
        return signal(times), (signal(times + 0.002) - signal(times - 0.002)) / 0.004

    def left_over(offset):
        true = with_signal(offset, 0.0)[0]
        return sum(np.linalg.lstsq(np.column_stack([true[:, i], np.ones(len(true))]), values[:, i], rcond=None)[1][0]
                   for i in range(values.shape[1]))
    offset, skew = min(np.arange(-0.6, 0.6, 0.02), key=left_over), 0.0
    scales, constants = np.ones(values.shape[1]), np.zeros(values.shape[1])
    for _ in range(10):
        true, change = with_signal(offset, skew)
        columns, off = [], []
        for i in range(values.shape[1]):
            design = np.zeros((len(stamps), 2 + 2 * values.shape[1]))
            design[:, 0] = -scales[i] * change[:, i]
            design[:, 1] = design[:, 0] * (stamps - begin) if skewed else 0.0
            design[:, 2 + 2 * i], design[:, 3 + 2 * i] = true[:, i], 1.0
            columns.append(design)
            off.append(values[:, i] - scales[i] * true[:, i] - constants[i])
        step = np.linalg.lstsq(np.vstack(columns), np.concatenate(off), rcond=None)[0]
        offset, skew = offset + step[0], skew + step[1]
        scales, constants = scales + step[2::2], constants + step[3::2]
    return offset, skew


def clocks(bag, truth_folder, places):
    truth = Truth(truth_folder / "trajectory.tum")
    stated = {line.split(",")[0]: [float(x) for x in line.split(",")[1:]]
            for line in (truth_folder / "clocks.csv").read_text().splitlines()[1:]}
    begin, end = truth.stamps[0], truth.stamps[-1]

    def of_gyroscope(times):
        return truth.rates(times) @ places["imu_link"][:3, :3]

    def of_wheels(times):
        before, after = truth.at(times - 0.01), truth.at(times + 0.01)
        way = np.einsum("nji,nj->ni", before[:, :3, :3], after[:, :3, 3] - before[:, :3, 3]) / 0.02
        return np.column_stack([way[:, 0], truth.rates(times)[:, 2]])

    def of_receiver(times):
        place = places["gps_link"]
        return ((truth.at(times + 0.01) @ place)[:, :3, 3] - (truth.at(times - 0.01) @ place)[:, :3, 3]) / 0.02
    rows = []
    devices = (("imu", "imu/data", lambda body: bags.rate(body)[::2], of_gyroscope, True), ("wheels", "wheel_odom", bags.speeds, of_wheels, True),
               ("gps", "gps/vel", bags.velocity, of_receiver, False))  # once per second is too rare for a skew
    for name, topic, read, signal, skewed in devices:
        found = [read(body) for _, body in bags.messages(bag, {topic})]
        stamps, values = np.array([f[0] for f in found]), np.array([f[1] for f in found])
        inside = (stamps > begin + 1) & (stamps < end - 1)
        offset, skew = clock_of(stamps[inside], values[inside], signal, begin, skewed)
        rows.append([f"clock of {name}: offset{'; skew' if skewed else ''}, found beside true",
                     f"{1000 * offset:+.2f} beside {1000 * stated[name][0]:+.2f} ms"
                     + (f"; {1e6 * skew:+.0f} beside {1e6 * stated[name][1]:+.0f} ppm" if skewed else ""), "", inside.sum()])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    arguments = parser.parse_args()
    measured = commit()
    cv2.setNumThreads(1)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    pure = ("--without", "all:all")
    moving, its_truth = simulated(arguments.folder, "moving", "--duration", 60, "--sensors", "imu", *pure)
    bag, truth_folder = simulated(arguments.folder, "ideal", "--duration", 8, "--sensors", "stereo,lasers", *pure, "--views", "stereo,lasers")
    places, truth = places_of(bag), Truth(truth_folder / "trajectory.tum")
    infos = {topic: bags.camera_info(body) for topic, body in bags.messages(bag, {"stereo/left/camera_info", "stereo/right/camera_info"})}
    camera, bf = infos["stereo/left/camera_info"][3], -infos["stereo/right/camera_info"][3][0, 3]
    table = imu(moving, Truth(its_truth / "trajectory.tum"), places) + points(bag, truth_folder, truth, places, camera)
    table += disparities("rectified", bag, truth_folder, bf) + disparities_of_blocks(bag, truth_folder, bf)
    short = ("--duration", 4, "--sensors", "stereo", "--with", "stereo:lens")
    raw, _ = simulated(arguments.folder, "raw", *short, *pure)
    table += disparities("raw, rectified by OpenCV", raw, truth_folder, bf)
    noisy, _ = simulated(arguments.folder, "noisy", *short, "--without", "stereo:jitter")
    table += disparities("... and with all defects", noisy, truth_folder, bf)
    table += clocks(*simulated(arguments.folder, "clocks", "--duration", 120, "--sensors", "imu,wheels,gps", "--with", "all:clock"), places)
    show(("simulated and true", "measured", "asked for", "of"), [[str(cell) for cell in row] for row in table], [], measured, arguments.output)


if __name__ == "__main__":
    main()
