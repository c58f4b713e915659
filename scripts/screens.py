# SPDX-License-Identifier: BSD-3-Clause
"""What pictures.py takes from screens: pages in a browser that is driven by WebDriver, and the frame buffer of an X server."""
import base64
import json
import os
import shutil
import subprocess
import time
import urllib.request

import cv2
import numpy as np

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")


class Missing(Exception):
    """What a picture needs is not here; the message says what."""


def tool(*names, package):
    for name in names:
        if shutil.which(name):
            return name
    raise Missing(f"{names[0]} (Debian package {package})")


def framebuffer(path):
    """What Xvfb shows: a file of X window dump, whose header has big-endian words."""
    words = np.frombuffer(path.read_bytes()[:100], ">u4")
    header, width, height, bytes_per_line, colours = (int(words[k]) for k in (0, 4, 5, 12, 19))
    pixels = np.frombuffer(path.read_bytes(), np.uint8, offset=header + 12 * colours)
    return pixels[: bytes_per_line * height].reshape(height, bytes_per_line // 4, 4)[:, :width, :3]


class Browser:
    """A headless Chromium that is driven through WebDriver."""

    def __init__(self, width, height):
        driver = tool("chromedriver", package="chromium-driver")
        self.address = f"http://127.0.0.1:{20000 + os.getpid() % 10000}"
        self.program = subprocess.Popen([driver, f"--port={self.address.rsplit(':', 1)[1]}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        words = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--enable-unsafe-swiftshader",
                 f"--window-size={width},{height}"]
        try:
            self.wait(lambda: self.ask("GET", "/status")["ready"], "chromedriver does not answer")
            session = self.ask("POST", "/session", {"capabilities": {"alwaysMatch": {"goog:chromeOptions": {"args": words}}}})["sessionId"]
        except BaseException:
            self.end()
            raise
        self.address += f"/session/{session}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.ask("DELETE", "")
        finally:
            self.end()

    def end(self):
        self.program.terminate()
        self.program.wait()

    def ask(self, method, path, content=None):
        body = None if method != "POST" else json.dumps(content or {}).encode()
        request = urllib.request.Request(self.address + path, data=body, method=method, headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=180) as answer:
            return json.load(answer)["value"]

    def run(self, script):
        return self.ask("POST", "/execute/sync", {"script": script, "args": []})

    def picture(self):
        return cv2.imdecode(np.frombuffer(base64.b64decode(self.ask("GET", "/screenshot")), np.uint8), cv2.IMREAD_COLOR)

    @staticmethod
    def wait(is_so, what, seconds=120):
        end = time.monotonic() + seconds
        while True:
            try:
                if is_so():
                    return
            except OSError:
                pass  # does not listen yet
            if time.monotonic() > end:
                raise RuntimeError(what)
            time.sleep(0.2)
