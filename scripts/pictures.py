#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of the documents anew, from the build that is there.

    scripts/pictures.py                        all pictures
    scripts/pictures.py report.png tracks.jpg  these
    scripts/pictures.py --list                 what each picture is made from

Pictures replace those in docs/; look at every one before you commit it. Most show one simulated session of a minute and a short one of another
day, which are made once and stay in build/pictures. A picture whose program, tool or data is not here stays as it is, and a line says what it needs:
bench programs (./run_tests.sh --benches builds them), a headless Chromium, rviz with Xvfb and the nodelets, real data in URBAN_NAV_DATA.
docs/data_flow.svg is drawn by hand; a test compares it with the list of stages.

Exit status 0 if no picture failed.
"""
import argparse
import base64
import csv
import html
import json
import math
import os
import re
import shutil
import subprocess
import sys
import time
from functools import cached_property
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
WORKSPACE = ROOT / "build" / "ws"
DAY_S, OTHER_DAY_S = 60, 20  # durations of the simulated sessions, s
QUALITY = 85  # of JPEG
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")


class Missing(Exception):
    """What a picture needs is not here; the message says what."""


def run(*command, **options):
    """Runs a program and returns its standard output."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}:\n{result.stderr[-2000:]}")
    return result.stdout


def urban_nav(*arguments):
    return run(ROOT / "urban_nav", *arguments)


def built(package, program):
    """The path of a program of the workspace, which is brought up to date."""
    path = WORKSPACE / "devel" / "lib" / package / program
    if not path.exists():
        raise Missing(f"{program}, which ./run_tests.sh --benches builds")
    run("ninja", "-C", WORKSPACE / "build", program)
    return path


def tool(*names, package):
    for name in names:
        if shutil.which(name):
            return name
    raise Missing(f"{names[0]} (Debian package {package})")


def data(*parts):
    """A folder of the real data."""
    folder = os.environ.get("URBAN_NAV_DATA")
    if not folder:
        raise Missing("real data in the folder that URBAN_NAV_DATA names")
    path = Path(folder).joinpath(*parts)
    if not path.exists():
        raise Missing(f"{path}")
    return path


def is_newer(path, than):
    return path.exists() and than.exists() and path.stat().st_mtime >= than.stat().st_mtime


class Report:
    """A page of the command, as its sections with their pictures."""

    def __init__(self, path):
        self.text = path.read_text(encoding="utf-8")

    def section(self, name):
        found = re.search(rf'<section id="{name}">.*?</section>', self.text, re.S)
        if not found:
            raise RuntimeError(f"the report has no section {name}")
        return found.group(0)

    def pictures(self, name):
        """(caption, image) of each picture of a section."""
        found = re.findall(r'src="data:image/jpeg;base64,([^"]+)"><figcaption>(.*?)</figcaption>', self.section(name), re.S)
        if not found:
            raise RuntimeError(f"section {name} of the report has no picture")
        return [(html.unescape(caption), cv2.imdecode(np.frombuffer(base64.b64decode(jpeg), np.uint8), cv2.IMREAD_COLOR)) for jpeg, caption in found]


class Material:
    """Sessions, maps and reports that pictures are taken from; each is made when it is first asked for and kept in the folder."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    @cached_property
    def program(self):
        """The program of the command, up to date."""
        urban_nav("--version")
        return WORKSPACE / "devel" / "lib" / "urban_nav" / "urban_nav"

    def session(self, day, seconds):
        bag = self.folder / f"day{day}.bag"
        if not is_newer(bag, self.program.parents[1] / "liburban_nav_sim.so"):
            print(f"simulates {seconds} s of day {day}", file=sys.stderr)
            urban_nav("simulate", "--world", "quad", "--seed", 7, "--route", "return", "--day", day, "--duration", seconds, "--sensors",
                      "stereo,ladybug,lasers,imu,gps", "-o", bag)
        return bag

    def map(self, name, *arguments):
        """The output folder of `map`."""
        out = self.folder / name
        if not is_newer(out / "summary.json", self.program):  # written last
            print(f"maps {name}", file=sys.stderr)
            urban_nav("map", *arguments, "--out", out, "--overwrite")
        return out

    @cached_property
    def day(self):
        return self.session(1, DAY_S)

    @cached_property
    def other_day(self):
        return self.session(2, OTHER_DAY_S)

    @cached_property
    def one_map(self):
        return self.map("one", self.day)

    @cached_property
    def report(self):
        return Report(self.one_map / "report.html")

    @cached_property
    def map_of_both(self):
        return self.map("both", self.other_day, "--store", self.one_map / "session.db")

    def closure(self, out, kind, between_days, size):
        """The picture of the accepted closure of a map with the largest size, a function of its row in closures.csv."""
        with (out / "closures.csv").open(encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if (row["kind"], row["verdict"]) == (kind, "accepted")]
        rows = [row for row in rows if (row["session_a"] != row["session_b"]) == between_days]
        if not rows:
            raise RuntimeError(f"no closure by {kind} was accepted")
        best = max(rows, key=size)
        page = self.folder / f"{kind}.html"
        moments = [f"{int(best[stamp]) // 10**9}.{int(best[stamp]) % 10**9:09d}" for stamp in ("stamp_a_ns", "stamp_b_ns")]
        urban_nav("why", out / "session.db", *moments, "-o", page)
        found = re.findall(r'src="data:image/jpeg;base64,([^"]+)"', page.read_text(encoding="utf-8"))
        images = [cv2.imdecode(np.frombuffer(base64.b64decode(jpeg), np.uint8), cv2.IMREAD_COLOR) for jpeg in found]
        if not images:
            raise RuntimeError(f"{page} has no picture")
        return images[0]


def write(name, image):
    path = DOCS / name
    temporary = path.with_name(f".{path.name}{path.suffix}")
    if not cv2.imwrite(str(temporary), image, [cv2.IMWRITE_JPEG_QUALITY, QUALITY, cv2.IMWRITE_PNG_COMPRESSION, 9]):
        raise RuntimeError(f"{path} cannot be written")
    temporary.replace(path)


def beside(images, gap=8):
    """The images beside each other on white, at the height of the lowest one."""
    height = min(image.shape[0] for image in images)
    scaled = [cv2.resize(image, (round(image.shape[1] * height / image.shape[0]), height), interpolation=cv2.INTER_AREA) for image in images]
    strip = np.full((height, gap, 3), 255, np.uint8)
    return np.hstack([part for image in scaled for part in (image, strip)][:-1])


def without_margin(image, edge=12):
    """The image without what is around its contents in the colour of its lower right corner, but for an edge."""
    differs = np.any(image != image[-1, -1], axis=2)
    rows, columns = np.flatnonzero(differs.any(axis=1)), np.flatnonzero(differs.any(axis=0))
    if rows.size == 0:
        return image
    return image[max(0, rows[0] - edge): rows[-1] + 1 + edge, max(0, columns[0] - edge): columns[-1] + 1 + edge]


def photograph(material, page, width, height):
    """A page as a browser shows it."""
    browser = tool(*BROWSERS, package="chromium-headless-shell")
    picture = material.folder / "page.png"
    picture.unlink(missing_ok=True)
    run(browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--window-size={width},{height}", "--virtual-time-budget=8000",
        f"--user-data-dir={material.folder / 'browser'}", f"--screenshot={picture}", page.as_uri())
    return cv2.imread(str(picture))


def report_page(material):
    """The beginning of the report: verdicts, and the trajectory over the truth."""
    text = re.sub(r'<script type="application/octet-stream">.*?</script>', "", material.report.text, flags=re.S)
    shown = ("<style>main > *:not(.verdicts):not(#truth), nav, footer, #truth > *:not(h2):not(.figures), #truth figure:nth-of-type(n+4) "
             "{ display: none !important; } #truth > .figures { display: grid !important; }</style>")
    page = material.folder / "report.html"
    page.write_text(text.replace("</head>", shown + "</head>", 1), encoding="utf-8")
    image = without_margin(photograph(material, page, 1240, 2400))
    write("report.png", cv2.resize(image, None, fx=0.8, fy=0.8, interpolation=cv2.INTER_AREA))


def tracks(material):
    write("tracks.jpg", material.report.pictures("views")[1][1])  # the robot drives towards a wing of the college


def dense_stereo(material):
    pictures = material.report.pictures("stereo")
    write("dense_stereo.jpg", pictures[len(pictures) // 2][1])


def demo_map(material):
    write("demo_map.jpg", beside([material.report.pictures(section)[0][1] for section in ("map", "labels")]))


def labels_map(material):
    write("labels_map.jpg", material.report.pictures("labels")[0][1])


def laser_map(material):
    write("laser_map.jpg", material.report.pictures("map")[1][1])


def shift(row):
    return math.hypot(*(float(row[name]) for name in "xyz"))


def turn(row):
    return 1.0 - abs(float(row["qw"]))


def cloud_closure(material):
    write("cloud_closure.jpg", material.closure(material.one_map, "icp", False, shift))


def stereo_closure(material):
    write("stereo_closure.jpg", material.closure(material.map_of_both, "stereo", True, turn))


def places_matches(material):
    """The surest right match with the other day, the least sure right one and the surest wrong one, if there is a wrong one; their captions are printed."""
    truth, out = material.folder / "days.tum", material.folder / "places"
    bags = (material.day, material.other_day)
    truth.write_text("".join((bag.with_suffix(".truth") / "trajectory.tum").read_text(encoding="utf-8") for bag in bags), encoding="utf-8")
    urban_nav("places", "evaluate", "default", *bags, "--truth", truth, "--mask", 1000, "-o", out)  # s: of the other day alone
    text = (out / "report.html").read_text(encoding="utf-8")
    name = re.search(r'<section id="([^"]+)">(?:(?!</section>).)*?<figcaption>Right', text, re.S)
    pictures = Report(out / "report.html").pictures(name.group(1))
    chosen = [next((each for each in pictures if each[0].startswith(kind)), None) for kind in ("Right, probability", "Right, but the least sure", "Wrong")]
    for caption, _ in filter(None, chosen):
        print(f"  {caption}", file=sys.stderr)
    write("places_matches.jpg", beside([image for _, image in filter(None, chosen)]))


def places_reliability(_):
    """Drawn from the measured table, as places_reliability.py draws it from the claims."""
    sys.path.insert(0, str(ROOT / "src" / "urban_nav" / "bench"))
    import places_reliability as bench  # pylint: disable=import-outside-toplevel,import-error
    table = json.loads((ROOT / "src/urban_nav/bench/results/places_reliability.json").read_text(encoding="utf-8"))
    bins = {name: [] for name in bench.COLOURS}
    for name, stated, claims, right, stretches, stretches_right, mean, *_ in table["rows"]:
        if name in bins:
            bins[name].append(bench.Bin(*map(float, stated.split(" to ")), int(claims), int(right), int(stretches), int(stretches_right), float(mean)))
    bench.draw(DOCS / "places_reliability.png", bins)


def figure4(material):
    program = built("swf_vo", "swf_vo-bench-figure4")
    run(program, "--runs", 50, "-o", material.folder / "figure4.json")
    page = material.folder / "figure4.html"
    page.write_text(f'<body style="margin:0"><img width="1000" src="{(material.folder / "figure4.svg").as_uri()}">', encoding="utf-8")
    write("figure4.png", photograph(material, page, 1000, 814))


def trajectories(material):
    street = data("stereo", "kitti_raw_0926_0005")
    render = built("urban_nav_core", "render_sequence")
    room = material.folder / "room"
    if not is_newer(room / "poses.txt", render):
        run(render, room)
    runs = []
    for folder, title in ((street, "KITTI raw 0926 0005"), (room, "rendered room")):
        out = material.map(f"vo_{folder.name}", folder, "--stages", "vo")
        length = json.loads((out / "summary.json").read_text(encoding="utf-8"))["distance_m"]
        runs.append(f"{out}={folder / 'poses.txt'}={title}, {length:.0f} m")
    run(sys.executable, ROOT / "swf_vo/bench/figure5.py", *runs, "-o", DOCS / "trajectories.png")


def simulated(_):
    run(built("urban_nav_sim", "urban_nav_sim-bench-pictures"), "--folder", DOCS)


def framebuffer(path):
    """What Xvfb shows: a file of X window dump, whose header has big-endian words."""
    words = np.frombuffer(path.read_bytes()[:100], ">u4")
    header, width, height, bytes_per_line, colours = (int(words[k]) for k in (0, 4, 5, 12, 19))
    pixels = np.frombuffer(path.read_bytes(), np.uint8, offset=header + 12 * colours)
    return pixels[: bytes_per_line * height].reshape(height, bytes_per_line // 4, 4)[:, :width, :3]


def rviz(material, seconds=25.0, rate=0.5, width=1200, height=720):
    """rviz after some seconds of the session, played at a fraction of its pace."""
    tool("Xvfb", package="xvfb")
    tool("rviz", package="rviz")
    setup = WORKSPACE / "devel" / "setup.bash"
    if not list((WORKSPACE / "devel" / "lib").glob("libswf_vo_nodelet.so")):
        raise Missing("the nodelets: ninja -C build/ws/build builds them")
    config = material.folder / "urban_nav.rviz"
    text = (ROOT / "rviz/rviz/urban_nav.rviz").read_text(encoding="utf-8")
    for key, value in (("Width", width), ("Height", height), ("X", 0), ("Y", 0)):
        text = re.sub(rf"^  {key}: \d+$", f"  {key}: {value}", text, flags=re.M)
    config.write_text(text, encoding="utf-8")
    screen = material.folder / "screen"
    screen.mkdir(exist_ok=True)
    display, port = f":{os.getpid() % 1000 + 100}", 12000 + os.getpid() % 1000
    launch = (f". {setup} && exec roslaunch -p {port} urban_nav_launch bag.launch bag:={material.day} rate:={rate} rviz_config:={config}")
    programs = [subprocess.Popen(["Xvfb", display, "-screen", "0", f"{width}x{height}x24", "-fbdir", str(screen)], stderr=subprocess.DEVNULL)]
    try:
        time.sleep(2.0)
        environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", ROS_LOG_DIR=str(material.folder / "ros"))
        log = (material.folder / "rviz.log").open("w", encoding="utf-8")
        programs.append(subprocess.Popen(["bash", "-c", launch], env=environment, stdout=log, stderr=log))
        time.sleep(10.0 + seconds / rate)
        image = framebuffer(screen / "Xvfb_screen0")
    finally:
        for program in reversed(programs):
            program.terminate()
            program.wait()
    if len(np.unique(image.reshape(-1, 3), axis=0)) < 100:
        raise RuntimeError(f"rviz showed nothing; see {material.folder / 'rviz.log'}")
    write("rviz.png", image)


SESSION = "the simulated session and its map"
PICTURES = {  # name: (function, what it is made from); a function may make several
    "cloud_closure.jpg": (cloud_closure, "a closure by laser clouds in opposite directions of the simulated session, as `why` shows it"),
    "demo_map.jpg": (demo_map, SESSION),
    "dense_stereo.jpg": (dense_stereo, SESSION),
    "figure4.png": (figure4, "swf_vo-bench-figure4; Chromium"),
    "labels_map.jpg": (labels_map, SESSION),
    "laser_map.jpg": (laser_map, SESSION),
    "places_matches.jpg": (places_matches, "`places evaluate` on two simulated days"),
    "places_reliability.png": (places_reliability, "the measured table src/urban_nav/bench/results/places_reliability.json"),
    "report.png": (report_page, SESSION + "; Chromium"),
    "rviz.png": (rviz, "the simulated session, played to the nodelets; rviz under Xvfb"),
    "simulated.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "simulated_above.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "simulated_cloud.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "stereo_closure.jpg": (stereo_closure, "a closure by keyframes between two simulated days, as `why` shows it"),
    "tracks.jpg": (tracks, SESSION),
    "trajectories.png": (trajectories, "a sequence in URBAN_NAV_DATA and a rendered one"),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"pictures, default: all of {', '.join(PICTURES)}")
    parser.add_argument("--list", action="store_true", help="says what each picture is made from, and ends")
    parser.add_argument("--work", type=Path, default=ROOT / "build" / "pictures", help="folder of the sessions and maps (default build/pictures)")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in PICTURES]
    if unknown:
        parser.error(f"{', '.join(unknown)}: not a picture of the documents")
    if arguments.list:
        for name, (_, source) in PICTURES.items():
            print(f"{name:24}{source}")
        return 0
    material = Material(arguments.work.resolve())
    status = 0
    for function in dict.fromkeys(PICTURES[name][0] for name in arguments.names or PICTURES):
        names = ", ".join(name for name, (each, _) in PICTURES.items() if each is function)
        try:
            function(material)
            print(f"docs: {names}: made")
        except Missing as missing:
            print(f"docs: {names}: left as it is; needs {missing}")
        except (RuntimeError, OSError, subprocess.SubprocessError) as error:
            print(f"docs: {names}: failed: {error}")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
