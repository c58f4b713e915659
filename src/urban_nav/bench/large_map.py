#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the page of `view` on a store with a large map, as urban_nav-bench-large_map writes one, in a headless
Chromium with WebGL by software: time to the first points and to two million, memory of server and browser, frames/s
while the mouse turns the view.

    large_map.py STORE [--command urban_nav] [--picture FILE.png] [--json FILE]

Needs chromium-driver and python3-selenium."""
import argparse
import json
import shutil
import subprocess
import time
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.support.ui import WebDriverWait

from support import TOP

PATIENCE = 300  # s
DRAG_SECONDS = 5
DRAG = """
const done = arguments[arguments.length - 1], lines = document.getElementById('lines'), box = lines.getBoundingClientRect();
const at = (type, x, y) => lines.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX: box.left + x, clientY: box.top + y, buttons: 1, bubbles: true}));
lines.setPointerCapture = () => {};
const begin = performance.now(); let frames = 0, last = begin, longest = 0;
at('pointerdown', 300, 300);
const step = () => {
  const now = performance.now();
  if (frames > 0) longest = Math.max(longest, now - last);
  last = now;
  if (now - begin > 1000 * arguments[0]) {
    at('pointerup', 300, 300);
    done({fps: frames / (now - begin) * 1000, longest_ms: longest, points: Number(document.getElementById('points').dataset.points)});
    return;
  }
  ++frames;
  at('pointermove', 300 + 60 * Math.sin(frames / 5), 300 + 20 * Math.cos(frames / 5));
  requestAnimationFrame(step);
};
requestAnimationFrame(step);
"""
WHEEL = """
const lines = document.getElementById('lines'), box = lines.getBoundingClientRect();
lines.dispatchEvent(new WheelEvent('wheel', {deltaY: arguments[0], clientX: box.left + 10, clientY: box.top + 10, bubbles: true, cancelable: true}));
"""


def memory(pid):
    """Returns the resident memory of a process and its descendants, MB; shared pages count once."""
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parents[int(entry.name)] = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            except OSError:
                continue
    family, grown = {pid}, True
    while grown:
        more = {child for child, parent in parents.items() if parent in family} - family
        family |= more
        grown = bool(more)
    total = 0
    for each in family:
        try:
            total += sum(int(line.split()[1]) for line in Path(f"/proc/{each}/smaps_rollup").read_text().splitlines() if line.startswith("Pss:"))
        except OSError:
            continue
    return total / 1e3


def start_browser():
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--window-size=1400,1000", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader"):
        options.add_argument(word)
    return webdriver.Chrome(service=webdriver.chrome.service.Service(shutil.which("chromedriver")), options=options)


class Measurement:
    def __init__(self, browser, server):
        self.browser, self.server, self.figures = browser, server, {}

    def shown(self, name):
        return self.browser.execute_script(f"return document.getElementById('points').dataset.{name}")

    def wait(self, so):
        WebDriverWait(self.browser, PATIENCE, poll_frequency=0.02).until(lambda _: so())

    def note(self, name, value):
        self.figures[name] = round(value, 3)
        print(f"{name}: {value:.4g}", flush=True)

    def load(self, address):
        begin = time.monotonic()
        self.browser.get(address)
        self.wait(lambda: int(self.shown("points") or 0) > 0)
        self.note("first_points_s", time.monotonic() - begin)
        self.wait(lambda: int(self.shown("points") or 0) > 2_000_000 or self.shown("complete") == "1")
        self.note("two_million_or_all_s", time.monotonic() - begin)
        self.wait(lambda: self.shown("complete") == "1")
        self.note("complete_s", time.monotonic() - begin)
        self.note("points", float(self.shown("points")))

    def drag(self, name):
        result = self.browser.execute_async_script(DRAG, DRAG_SECONDS)
        for key, value in result.items():
            self.note(f"{name}_{key}", value)
        self.wait(lambda: self.shown("complete") == "1")

    def memory(self, name):
        self.note(f"{name}_server_mb", memory(self.server))
        self.note(f"{name}_browser_mb", memory(self.browser.service.process.pid))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("store")
    parser.add_argument("--command", default=str(TOP / "urban_nav"))
    parser.add_argument("--picture")
    parser.add_argument("--json")
    given = parser.parse_args()
    begin = time.monotonic()
    server = subprocess.Popen([given.command, "view", given.store, "--no-browser", "--read-only"], stdout=subprocess.PIPE, text=True)
    try:
        address = next(line.strip() for line in server.stdout if line.startswith("http://"))
        served = time.monotonic() - begin
        browser = start_browser()
        try:
            browser.set_script_timeout(PATIENCE)
            measured = Measurement(browser, server.pid)
            measured.note("address_s", served)
            measured.load(address)
            measured.drag("whole")
            measured.memory("whole")
            if given.picture:
                browser.save_screenshot(given.picture)
            for _ in range(12):
                browser.execute_script(WHEEL, -400)
                time.sleep(0.2)
            measured.wait(lambda: measured.shown("complete") == "1")
            measured.note("near_points", float(measured.shown("points")))
            measured.drag("near")
            measured.memory("near")
            if given.picture:
                browser.save_screenshot(given.picture.replace(".png", "_near.png"))
        finally:
            browser.quit()
    finally:
        server.terminate()
        server.wait()
    if given.json:
        Path(given.json).write_text(json.dumps(measured.figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
