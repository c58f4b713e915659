#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the page of `labels teach` in a headless Chromium: a user that knows the class of each point gives corrections.
    teach_clicks.py teach|flat ADDRESS TRUTH [PICTURE]    # TRUTH: one number of a class for each point, a line each
Exit status 77 where there is no browser to drive."""
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import page_clicks
from page_clicks import Page

CORRECTIONS = 20


def start(words):
    options = page_clicks.webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--window-size=1400,1000", "--disable-dev-shm-usage", *words):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = page_clicks.webdriver.chrome.service.Service(page_clicks.DRIVER)
    return page_clicks.webdriver.Chrome(service=service, options=options)


class TeachPage(Page):
    def state(self):
        return self.browser.execute_async_script(
            "const done = arguments[0], token = new URLSearchParams(location.search).get('token');"
            "fetch('/api/state', {headers: {'X-Urban-Nav-Token': token}}).then(a => a.json()).then(done)")

    def picture(self):
        return self.browser.execute_script("return document.getElementById('points').toDataURL()")

    def press(self, key):
        """Presses a key and waits until the answers that follow are shown."""
        self.key(key)
        time.sleep(0.05)
        self.ready()


def teach(browser, address, truth):
    page = TeachPage(browser, address)
    names = {c["number"]: k + 1 for k, c in enumerate(page.state()["classes"])}
    assert not page.find("#outcome").text
    before = page.picture()
    page.press("n")
    assert int(page.find("#selected").get_attribute("data-points")) > 0, "the suggestion is selected"
    assert page.picture() != before, "and shown"
    page.press(page_clicks.Keys.ESCAPE)
    assert page.find("#selected").get_attribute("data-points") == "0"
    for given in range(CORRECTIONS):
        row = page.find('[data-suggestion="1"]')
        point = int(row.get_attribute("data-point"))
        row.click()
        page.press(str(names[truth[point]]))
        assert page.count("[data-correction]") == given + 1, (given, page.find("#outcome").text)
    assert page.picture() != before, "the cloud is coloured by the new answers"

    first = browser.current_window_handle
    browser.switch_to.new_window("window")
    other = TeachPage(browser, address)
    assert other.count("[data-correction]") == CORRECTIONS
    browser.switch_to.window(first)
    page.press("u")
    assert page.count("[data-correction]") == CORRECTIONS - 1
    browser.switch_to.window(browser.window_handles[1])
    other.wait(lambda: other.count("[data-correction]") == CORRECTIONS - 1, "the other page does not follow")
    other.ready()
    other.press("U")
    assert other.count("[data-correction]") == CORRECTIONS
    other.check_console()
    browser.switch_to.window(first)
    page.wait(lambda: page.count("[data-correction]") == CORRECTIONS, "this page does not follow")
    page.ready()
    page.key("b")
    page.key("b")
    page.press("n")
    few = int(page.find("#selected").get_attribute("data-points"))
    page.key("b")
    page.ready()
    assert int(page.find("#selected").get_attribute("data-points")) > few, "a larger brush selects more"
    page.check_console()


def flat(browser, address, truth):
    """Without WebGL the list still takes corrections."""
    page = TeachPage(browser, address)
    assert "no WebGL" in page.find("#notice").text, page.find("#notice").text
    names = {c["number"]: c["name"] for c in page.state()["classes"]}
    row = page.find('[data-suggestion="1"]')
    point = int(row.get_attribute("data-point"))
    row.click()
    page.click(f'[data-class="{names[truth[point]]}"]')
    page.wait(lambda: page.count("[data-correction]") == 1, "the correction is not taken")
    page.ready()
    page.click('[data-action="undo"]')
    page.wait(lambda: page.count("[data-correction]") == 0, "it is not undone")
    page.check_console()


def main():
    truth = [int(line) for line in Path(sys.argv[3]).read_text().split()]
    part = {"teach": teach, "flat": flat}[sys.argv[1]]
    browser = start(["--disable-gpu", "--disable-3d-apis"] if part is flat else [])
    try:
        part(browser, sys.argv[2], truth)
        if len(sys.argv) > 4:
            browser.save_screenshot(sys.argv[4])
    finally:
        browser.quit()


if __name__ == "__main__":
    main()
