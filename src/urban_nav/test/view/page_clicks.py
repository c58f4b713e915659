#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the page of `view` in a headless Chromium:
    page_clicks.py edits|many|tiles ADDRESS
Exit status 77 where there is no browser to drive."""
import shutil
import sys

DRIVER = shutil.which("chromedriver")
try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    webdriver = None
if webdriver is None or DRIVER is None:
    print("no chromium-driver or no python3-selenium here: the page is not opened in a browser")
    sys.exit(77)

PATIENCE = 120  # s


def start():
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--window-size=1400,1000", "--disable-dev-shm-usage"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=webdriver.chrome.service.Service(DRIVER), options=options)


class Page:
    def __init__(self, browser, address):
        self.browser = browser
        browser.get(address)
        self.ready()

    def wait(self, so, what):
        WebDriverWait(self.browser, PATIENCE, poll_frequency=0.05).until(lambda _: so(), what)

    def ready(self):
        self.wait(lambda: self.find("body").get_attribute("data-state") == "ready", "the page stays busy")

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def count(self, selector):
        return self.browser.execute_script("return document.querySelectorAll(arguments[0]).length", selector)

    def click(self, selector):
        self.find(selector).click()
        self.ready()

    def key(self, letter):
        self.find("body").send_keys(letter)
        self.ready()

    def choose(self, selector, value):
        Select(self.find(selector)).select_by_value(value)

    def check_console(self):
        lines = [line["message"] for line in self.browser.get_log("browser") if line["level"] == "SEVERE"]
        assert not lines, lines


def edits(browser, address):
    page = Page(browser, address)
    assert page.find("#compared").text.startswith("compared with"), page.find("#compared").text
    assert page.find("#sessions").text.count("0.00 mm at most") == 2, page.find("#sessions").text
    page.choose("#verdict-filter", "accepted")
    accepted = page.count("#rows [data-edge]")
    page.click("#rows [data-edge]")
    number = page.find('#rows [aria-selected="true"]').get_attribute("data-edge")
    assert page.find("#explanation").text, "the selected closure is explained"
    page.click('[data-action="reject"]')
    assert page.count("#rows [data-edge]") == accepted - 1, "it is no longer among the accepted ones"
    assert page.find("#edit-rows").text.split() == ["1", "reject", number], page.find("#edit-rows").text
    assert "moved" in page.find("#outcome").text, page.find("#outcome").text
    page.key("u")
    assert page.find('[data-edit="1"]').get_attribute("data-undone") == "1"
    assert page.count("#rows [data-edge]") == accepted

    first = browser.current_window_handle
    browser.switch_to.new_window("window")
    other = Page(browser, address)
    browser.switch_to.window(first)
    page.key("j")
    page.key("r")
    browser.switch_to.window(browser.window_handles[1])
    other.wait(lambda: other.count('[data-edit][data-undone="0"]') == 1, "the other page does not follow")
    other.ready()
    assert other.find("#sessions").text.count("0.00 mm at most") < 2, "the map has moved from the store before"
    other.check_console()
    browser.switch_to.window(first)

    page.find("#time").send_keys(Keys.END)
    page.click("#to-t1")
    page.click("#why-here")
    assert page.find('[data-field="t1"]').get_attribute("value")
    assert page.find("#explanation").text
    page.check_console()


def many(browser, address):
    page = Page(browser, address)
    shown = page.count("#rows [data-edge]")
    assert shown > 10_000, shown
    page.key("j")
    page.key("j")
    assert page.count('#rows [aria-selected="true"]') == 1
    page.choose("#verdict-filter", "accepted")
    assert 0 < page.count("#rows [data-edge]") < 100
    assert page.find('[data-action="reject"]').get_attribute("disabled"), "the store is only read"
    page.check_console()


def tiles(browser, address):
    page = Page(browser, address)
    if not browser.execute_script("return document.createElement('canvas').getContext('webgl') !== null"):
        print("no WebGL here: points are not drawn")
        sys.exit(77)
    shown = lambda name: browser.execute_script("return document.getElementById('points').dataset[arguments[0]]", name)
    complete = lambda: page.wait(lambda: shown("complete") == "1", "the points are not all drawn")
    picture = lambda: browser.execute_script("return document.getElementById('points').toDataURL()")
    complete()
    every = int(shown("points"))
    assert every == int(sys.argv[3]), every
    by_pictures = picture()
    page.choose("#colour", "session")
    complete()
    assert picture() != by_pictures
    lines = page.find("#lines")
    browser.execute_script("arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: 3000, bubbles: true, cancelable: true}))", lines)
    page.wait(lambda: int(shown("points")) < every / 4, "far away, points would share their pixels")
    complete()
    page.key("f")
    page.wait(lambda: int(shown("points")) == every, "the whole map again")
    complete()
    before = picture()
    browser.execute_script("document.querySelector('details').open = true")
    page.find('[data-field="t1"]').send_keys("monday+20")
    page.find('[data-field="at"]').send_keys("-8.4,15.2,0")  # 0.3 m from where it is
    page.click('[data-action="pin"]')
    page.wait(lambda: shown("revision") == "2", "the points do not follow")
    complete()
    assert int(shown("points")) == every
    assert picture() != before, "the map has moved"
    page.click('[data-action="undo"]')
    page.wait(lambda: shown("revision") == "3", "the points do not follow")
    complete()
    assert picture() == before, "and is back"
    page.check_console()


def main():
    browser = start()
    try:
        {"edits": edits, "many": many, "tiles": tiles}[sys.argv[1]](browser, sys.argv[2])
    finally:
        browser.quit()


if __name__ == "__main__":
    main()
