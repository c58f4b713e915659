#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of the documents anew, from the build that is there.

    scripts/pictures.py                        all pictures
    scripts/pictures.py report.png tracks.jpg  these
    scripts/pictures.py --list                 what each picture is made from
    scripts/pictures.py --check                each picture that a document shows is here, is made here and is small; each one is shown

Pictures replace those in docs/; look at every one before you commit it. Most show one simulated session of a minute and a short one of another
day, which are made once and stay in build/pictures. A picture whose program, tool or data is not here stays as it is, and a line says what it needs:
bench programs (./run_tests.sh --benches builds them), a headless Chromium, rviz with Xvfb and the nodelets, real data in URBAN_NAV_DATA.
docs/data_flow.svg is drawn by hand; a test compares it with the list of stages. --devel takes the programs of a workspace that is built
elsewhere, as they are.

Exit status 0 if no picture failed, and with --check if nothing is wrong.
"""
import argparse
import base64
import csv
import html
import json
import math
import os
import re
import subprocess
import sys
import time
from functools import cached_property
from pathlib import Path

import cv2
import numpy as np

from screens import BROWSERS, Browser, Missing, framebuffer, tool

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
DAY_S, OTHER_DAY_S = 60, 20  # durations of the simulated sessions, s
QUALITY = 85  # of JPEG
LARGEST = 200_000  # bytes of a picture
BY_HAND = ("docs/data_flow.svg",)
HOSTILE = "src/urban_nav_input/test/corpus/"  # files of tests, which no document shows


def run(*command, **options):
    """Runs a program and returns its standard output."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}:\n{result.stderr[-2000:]}")
    return result.stdout


class Programs:
    """The programs of a workspace; that of the repository is brought up to date."""

    def __init__(self, devel=None):
        self.is_own = devel is None
        self.devel = devel or ROOT / "build" / "ws" / "devel"

    @cached_property
    def command(self):
        """The path of the command."""
        if self.is_own:
            run(ROOT / "urban_nav", "--version")
        return self.devel / "lib" / "urban_nav" / "urban_nav"

    def built(self, package, program):
        """The path of another program."""
        path = self.devel / "lib" / package / program
        if not path.exists():
            raise Missing(f"{program}, which ./run_tests.sh --benches builds")
        if self.is_own:
            run("ninja", "-C", self.devel.parent / "build", program)
        return path


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

    def __init__(self, folder, programs):
        self.folder = folder
        self.programs = programs
        folder.mkdir(parents=True, exist_ok=True)

    def urban_nav(self, *arguments):
        return run(self.programs.command, *arguments)

    def session(self, day, seconds):
        bag = self.folder / f"day{day}.bag"
        if not is_newer(bag, self.programs.command.parents[1] / "liburban_nav_sim.so"):
            print(f"simulates {seconds} s of day {day}", file=sys.stderr)
            self.urban_nav("simulate", "--world", "quad", "--seed", 7, "--route", "return", "--day", day, "--duration", seconds, "--sensors",
                      "stereo,ladybug,lasers,imu,gps", "-o", bag)
        return bag

    def map(self, name, *arguments):
        """The output folder of `map`."""
        out = self.folder / name
        if not is_newer(out / "summary.json", self.programs.command):  # written last
            print(f"maps {name}", file=sys.stderr)
            self.urban_nav("map", *arguments, "--out", out, "--overwrite")
        return out

    @staticmethod
    def truth(bag):
        return bag.with_suffix(".truth") / "trajectory.tum"

    @cached_property
    def day(self):
        return self.session(1, DAY_S)

    @cached_property
    def other_day(self):
        return self.session(2, OTHER_DAY_S)

    @cached_property
    def one_map(self):
        return self.map("one", self.day, "--truth", self.truth(self.day))

    @cached_property
    def report(self):
        return Report(self.one_map / "report.html")

    @cached_property
    def map_of_both(self):
        return self.map("both", self.other_day, "--store", self.one_map / "session.db", "--stages", "vo,places,loops,graph,lasers")

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
        self.urban_nav("why", out / "session.db", *moments, "-o", page)
        found = re.findall(r'src="data:image/jpeg;base64,([^"]+)"', page.read_text(encoding="utf-8"))
        images = [cv2.imdecode(np.frombuffer(base64.b64decode(jpeg), np.uint8), cv2.IMREAD_COLOR) for jpeg in found]
        if not images:
            raise RuntimeError(f"{page} has no picture")
        return images[0]


def encoded(suffix, image):
    """The bytes of a picture, reduced in size until there are at most LARGEST."""
    for scale in (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4):
        smaller = image if scale == 1.0 else cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
        done, content = cv2.imencode(suffix, smaller, [cv2.IMWRITE_JPEG_QUALITY, QUALITY, cv2.IMWRITE_PNG_COMPRESSION, 9])
        if done and len(content) <= LARGEST:
            return content.tobytes()
    raise RuntimeError(f"a picture of {image.shape[1]} x {image.shape[0]} px cannot be written in {LARGEST} bytes")


def write(name, image):
    path = DOCS / name
    temporary = path.with_name(f".{path.name}")
    temporary.write_bytes(encoded(path.suffix, image))
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
    truth.write_text("".join(material.truth(bag).read_text(encoding="utf-8") for bag in bags), encoding="utf-8")
    material.urban_nav("places", "evaluate", "default", *bags, "--truth", truth, "--mask", 1000, "-o", out)  # s: of the other day alone
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
    program = material.programs.built("swf_vo", "swf_vo-bench-figure4")
    run(program, "--runs", 50, "-o", material.folder / "figure4.json")
    page = material.folder / "figure4.html"
    page.write_text(f'<body style="margin:0"><img width="1000" src="{(material.folder / "figure4.svg").as_uri()}">', encoding="utf-8")
    write("figure4.png", photograph(material, page, 1000, 814))


def trajectories(material):
    street = data("stereo", "kitti_raw_0926_0005")
    render = material.programs.built("urban_nav_core", "render_sequence")
    room = material.folder / "room"
    if not is_newer(room / "poses.txt", render):
        run(render, room)
    runs = []
    for folder, title in ((street, "KITTI raw 0926 0005"), (room, "rendered room")):
        out = material.map(f"vo_{folder.name}", folder, "--stages", "vo")
        length = json.loads((out / "summary.json").read_text(encoding="utf-8"))["distance_m"]
        runs.append(f"{out}={folder / 'poses.txt'}={title}, {length:.0f} m")
    run(sys.executable, ROOT / "swf_vo/bench/figure5.py", *runs, "-o", DOCS / "trajectories.png")


def simulated(material):
    run(material.programs.built("urban_nav_sim", "urban_nav_sim-bench-pictures"), "--folder", material.folder)
    for name in ("simulated.jpg", "simulated_above.jpg", "simulated_cloud.jpg"):
        write(name, cv2.imread(str(material.folder / name)))


def rviz(material, seconds=40.0, rate=0.25, width=1200, height=720):
    """rviz after some seconds of the session, played at a fraction of its pace."""
    tool("Xvfb", package="xvfb")
    tool("rviz", package="rviz")
    devel = material.programs.devel
    if not list((devel / "lib").glob("libswf_vo_nodelet.so")):
        raise Missing("the nodelets: ninja -C build/ws/build builds them")
    config = material.folder / "urban_nav.rviz"
    text = (ROOT / "rviz/rviz/urban_nav.rviz").read_text(encoding="utf-8")
    for key, value in (("Width", width), ("Height", height), ("X", 0), ("Y", 0)):
        text = re.sub(rf"^  {key}: \d+$", f"  {key}: {value}", text, flags=re.M)
    text = re.sub(r"^    Frame Rate: \d+$", "    Frame Rate: 2", text, flags=re.M)  # drawn in software
    config.write_text(text, encoding="utf-8")
    screen = material.folder / "screen"
    screen.mkdir(exist_ok=True)
    display, port = f":{os.getpid() % 1000 + 100}", 12000 + os.getpid() % 1000
    launch = f". {devel}/setup.bash && exec roslaunch -p {port} urban_nav_launch bag.launch bag:={material.day} rate:={rate} rviz_config:={config}"
    environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", ROS_HOME=str(material.folder / "ros"), ROS_HOSTNAME="localhost")
    programs = [subprocess.Popen(["Xvfb", display, "-screen", "0", f"{width}x{height}x24", "-fbdir", str(screen)], stderr=subprocess.DEVNULL)]
    try:
        time.sleep(2.0)
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
    write("rviz.jpg", image)


def view_page(material):
    """The page of `view`: two days in one map, the first accepted closure of the list selected."""
    store = (material.map_of_both / "session.db").relative_to(material.folder)  # the page shows the name as it is given
    command = [material.programs.command, "view", store, "--read-only", "--no-browser"]
    with subprocess.Popen(command, cwd=material.folder, stdout=subprocess.PIPE, text=True) as server:
        try:
            address = re.search(r"http://\S+", server.stdout.readline()).group(0)
            with Browser(1240, 920) as browser:
                browser.ask("POST", "/url", {"url": address})
                ready = lambda: browser.run('return document.body.dataset.state === "ready" && !document.getElementById("colour").disabled')
                browser.wait(ready, "the page stays busy")
                browser.run('const list = document.getElementById("verdict-filter"); list.value = "accepted"; list.dispatchEvent(new Event("change"));')
                browser.run('document.querySelector("#rows [data-edge]").click()')
                explained = 'return document.querySelectorAll("#explanation img").length > 0'
                browser.wait(lambda: browser.run(explained) and ready(), "no closure is explained")
                time.sleep(2.0)
                write("view.jpg", browser.picture())
        finally:
            server.terminate()


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
    "rviz.jpg": (rviz, "the simulated session, played to the nodelets; rviz under Xvfb"),
    "simulated.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "simulated_above.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "simulated_cloud.jpg": (simulated, "urban_nav_sim-bench-pictures"),
    "stereo_closure.jpg": (stereo_closure, "a closure by keyframes between two simulated days, as `why` shows it"),
    "tracks.jpg": (tracks, SESSION),
    "trajectories.png": (trajectories, "a sequence in URBAN_NAV_DATA and a rendered one"),
    "view.jpg": (view_page, "the page of `view` for two simulated days; Chromium and chromedriver"),
}


def faults(root=ROOT, made=tuple(PICTURES)):
    """What is wrong with the pictures of the repository at `root`, a sentence each. None where `root` is no repository."""
    listed = subprocess.run(["git", "ls-files", "*.md", "*.png", "*.jpg", "*.jpeg", "*.gif", "*.svg"], cwd=root, capture_output=True, text=True, check=False)
    if listed.returncode != 0:
        return None
    files = [name for name in listed.stdout.splitlines() if not name.startswith(HOSTILE) and (root / name).exists()]
    pictures = {name for name in files if not name.endswith(".md")}
    known = {*(f"docs/{name}" for name in made), *BY_HAND}
    shown, found = set(), []
    for name in files:
        if name.endswith(".md"):
            for target in re.findall(r"!\[[^\]]*\]\(([^)\s]+)|<img[^>]*\ssrc=\"([^\"]+)", (root / name).read_text(encoding="utf-8")):
                picture = os.path.normpath(os.path.join(os.path.dirname(name), "".join(target)))
                shown.add(picture)
                if picture not in pictures:
                    found.append(f"{name} shows {picture}, which is not in the repository")
    found += [f"{name} is not made by scripts/pictures.py" for name in sorted(pictures - known)]
    found += [f"{name} is shown by no document" for name in sorted((pictures | known) - shown)]
    found += [f"{name} has {(root / name).stat().st_size} bytes, more than {LARGEST}" for name in sorted(pictures) if (root / name).stat().st_size > LARGEST]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"pictures, default: all of {', '.join(PICTURES)}")
    parser.add_argument("--list", action="store_true", help="says what each picture is made from, and ends")
    parser.add_argument("--check", action="store_true", help="compares the documents with the pictures, and ends")
    parser.add_argument("--devel", type=Path, help="devel folder of another workspace, used as it is (default: build/ws/devel, brought up to date)")
    parser.add_argument("--work", type=Path, default=ROOT / "build" / "pictures", help="folder of the sessions and maps (default build/pictures)")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in PICTURES]
    if unknown:
        parser.error(f"{', '.join(unknown)}: not a picture of the documents")
    if arguments.list:
        for name, (_, source) in PICTURES.items():
            print(f"{name:24}{source}")
        return 0
    if arguments.check:
        found = faults()
        print("\n".join(found or ()), end="\n" if found else "")
        return 1 if found else 0
    material = Material(arguments.work.resolve(), Programs(arguments.devel and arguments.devel.resolve()))
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
