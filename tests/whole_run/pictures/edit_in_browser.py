#!/usr/bin/env python3
"""Uses the page of coseg edit in headless Chromium as a person would, with real clicks and keys.

usage: edit_in_browser.py COSEG RUN     the run has 4 shapes, 2 parts and levels; exit code 77: no Chromium or chromedriver here
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

from edit_client import Server
from report_in_browser import Browser, ELEMENT

KEYS = {"Enter": "\ue007", "Control": "\ue009", "Shift": "\ue008"}


def press(browser, *keys):
    """Keys, of which all but the last are held."""
    codes = [KEYS.get(key, key) for key in keys]
    actions = [{"type": "keyDown", "value": code} for code in codes] + [{"type": "keyUp", "value": code} for code in reversed(codes)]
    browser.do("/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})


def wait(browser, condition, what):
    for _ in range(300):
        if browser.script(f"return !!(window.cosegEdit && window.cosegEdit.ready && ({condition}))"):
            return
        time.sleep(0.1)
    sys.exit(f"FAILED: {what}; the page says: " + browser.script("return document.getElementById('message').textContent"))


def acts(browser):
    return browser.script("return window.cosegEdit.state.acts")


def drag_part(browser, one, other):
    rows = browser.do("/elements", {"using": "css selector", "value": ".part .faint"})
    moves = [{"type": "pointerMove", "duration": 0, "origin": {ELEMENT: rows[2 * one][ELEMENT]}, "x": 0, "y": 0}, {"type": "pointerDown", "button": 0},
             {"type": "pointerMove", "duration": 200, "origin": {ELEMENT: rows[2 * one][ELEMENT]}, "x": 5, "y": 5},
             {"type": "pointerMove", "duration": 300, "origin": {ELEMENT: rows[2 * other][ELEMENT]}, "x": 0, "y": 0}, {"type": "pointerUp", "button": 0}]
    browser.do("/actions", {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": moves}]})


def shown_labels(browser):
    """Those that the page has of the shape in the large view."""
    return browser.do("/execute/async", {"script": "const done = arguments[0]; window.cosegEdit.labelsOf(window.cosegEdit.current).then(l => done(l.part));", "args": []})


def check_page(browser, server):
    wait(browser, "true", "the page is not ready")
    assert browser.script("return document.querySelectorAll('.tile').length") == 4
    assert browser.script("return document.querySelectorAll('.part').length") == 2
    current = browser.script("return window.cosegEdit.current")
    before = shown_labels(browser)
    assert before == server.labels(current)[0]

    # A click in the middle of the shape paints the patch there: with one part or the other it is a change.
    press(browser, "1")
    browser.click("#view")
    wait(browser, "window.cosegEdit.state.acts === 1", "a click paints nothing")
    press(browser, "2")
    browser.click("#view")
    wait(browser, "window.cosegEdit.state.acts === 2", "a second click paints nothing")
    after = shown_labels(browser)
    assert after != before and after == server.labels(current)[0], "the page does not show what follows"
    pixels = browser.script("return document.getElementById('view').toDataURL().length")
    press(browser, "Control", "z")
    wait(browser, "window.cosegEdit.state.acts === 1", "Ctrl+Z takes nothing back")
    press(browser, "Control", "y")
    wait(browser, "window.cosegEdit.state.acts === 2", "Ctrl+Y does nothing again")
    assert shown_labels(browser) == after and browser.script("return document.getElementById('view').toDataURL().length") == pixels

    # A reload in the middle shows what is.
    browser.do("/refresh", {})
    wait(browser, "window.cosegEdit.state.acts === 2", "a reload loses something")

    # One key confirms, and the next shape comes up.
    press(browser, "n")
    asked = browser.script("return window.cosegEdit.next")
    wait(browser, f"window.cosegEdit.current === {asked}", "N does not show the shape that is asked for")
    press(browser, "Enter")
    wait(browser, f"window.cosegEdit.state.shapes[{asked}].confirmed && window.cosegEdit.current !== {asked}", "Enter does not confirm")

    # Parts: a new one, dragged on another.
    browser.click("#newPart")
    wait(browser, "window.cosegEdit.state.parts.length === 3", "no new part")
    drag_part(browser, 2, 0)
    wait(browser, "window.cosegEdit.state.parts.length === 2", "a part that is dragged on another is not merged")
    number = acts(browser)
    name = browser.find(".part input[type=text]")
    browser.do(f"/element/{name}/clear", {})
    browser.do(f"/element/{name}/value", {"text": "legs" + KEYS["Enter"]})
    wait(browser, f"window.cosegEdit.state.acts > {number} && window.cosegEdit.state.parts[0].name === 'legs'", "a name")

    # What another page does is not overwritten.
    server.state()
    server.post("act", {"act": "name", "part": 1, "name": "top"})
    press(browser, "Control", "z")
    wait(browser, "window.cosegEdit.state.parts[1].name === 'top'", "what another page did is not shown")
    assert "another page" in browser.script("return document.getElementById('message').textContent")
    return browser.script("return window.cosegEdit.seconds")


def main():
    driver = shutil.which("chromedriver")
    if not driver or not (shutil.which("chromium") or shutil.which("google-chrome")):
        print("skipped: chromium and chromium-driver are not installed")
        sys.exit(77)
    server = Server(sys.argv[1], sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        process = subprocess.Popen([driver, "--port=0", f"--log-path={os.path.join(scratch, 'log')}"], stdout=subprocess.PIPE, text=True)
        try:
            port = next(line.split("port ")[-1].strip(". \n") for line in process.stdout if "successfully on port" in line)
            browser = Browser(port, os.path.join(scratch, "profile"))
            try:
                browser.do("/url", {"url": server.address})
                seconds = check_page(browser, server)
                print(f"the last act was on screen after {seconds:.2f} s")
                # The other page's act is refused by 409, and the name that is empty for a moment by 422.
                severe = [entry for entry in browser.do("/se/log", {"type": "browser"})
                          if entry["level"] == "SEVERE" and not any(code in json.dumps(entry) for code in ("status of 409", "status of 422"))]
                assert not severe, severe
            finally:
                browser.call("DELETE", f"/session/{browser.session}")
            server.end()
        finally:
            server.process.kill()
            process.terminate()
            process.wait(timeout=20)
    print("ok: coseg edit in a browser")


if __name__ == "__main__":
    main()
