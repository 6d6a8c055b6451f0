#!/usr/bin/env python3
"""Opens report.html in headless Chromium through chromedriver and uses it as a person would, with real clicks.

usage: report_in_browser.py REPORT.html SHAPES PARTS [--accuracy]     exit code 77: no Chromium or chromedriver here
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1280,1000"]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"


class Browser:
    def __init__(self, port, profile):
        self.root = f"http://127.0.0.1:{port}"
        self.wait_until_ready()
        options = {"args": ARGUMENTS + [f"--user-data-dir={profile}"]}
        self.session = None
        made = self.call("POST", "/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.session = made["sessionId"]

    def call(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(self.root + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=90) as answer:
            return json.load(answer)["value"]

    def wait_until_ready(self):
        for _ in range(300):
            try:
                if self.call("GET", "/status")["ready"]:
                    return
            except OSError:
                pass
            time.sleep(0.1)
        sys.exit("chromedriver does not answer")

    def do(self, path, body=None, method="POST"):
        return self.call(method, f"/session/{self.session}{path}", body if method == "POST" else None)

    def script(self, text):
        return self.do("/execute/sync", {"script": text, "args": []})

    def find(self, selector):
        return self.do("/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.do(f"/element/{self.find(selector)}/click", {})

    def drag(self, selector, right, down):
        origin = {ELEMENT: self.find(selector)}
        self.do("/actions", {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
            {"type": "pointerMove", "duration": 0, "origin": origin, "x": 0, "y": 0},
            {"type": "pointerDown", "button": 0},
            {"type": "pointerMove", "duration": 200, "origin": origin, "x": right, "y": down},
            {"type": "pointerUp", "button": 0}]}]})

    def wheel(self, selector, amount):
        origin = {ELEMENT: self.find(selector)}
        self.do("/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [
            {"type": "scroll", "origin": origin, "x": 0, "y": 0, "deltaX": 0, "deltaY": amount, "duration": 0}]}]})


def pixels_drawn(browser, viewer="A"):
    """How many pixels of the viewer differ from its background."""
    return browser.script("""
        const canvas = document.querySelector('#viewer%s canvas'), copy = document.createElement('canvas');
        copy.width = canvas.width; copy.height = canvas.height;
        const context = copy.getContext('2d'); context.drawImage(canvas, 0, 0);
        const data = context.getImageData(0, 0, copy.width, copy.height).data;
        let count = 0;
        for (let i = 0; i < data.length; i += 4) count += Math.abs(data[i] - 247) + Math.abs(data[i + 2] - 245) > 12 ? 1 : 0;
        return count;""" % viewer)


def camera(browser, viewer=0):
    return browser.script(f"return window.cosegReport.viewers[{viewer}].camera.position.toArray()")


def column(browser, number):
    return browser.script(f"return [...document.querySelectorAll('#shapes tbody tr')].map(r => r.cells[{number}].textContent)")


def check_convergence(browser):
    """The charts show the optimiser's history: the gap on a logarithmic axis, the objective above its bound."""
    charts = browser.script("""
        return window.cosegReport.charts.map(chart => ({
            title: chart.canvas.closest('.chart').querySelector('h3').textContent, kind: chart.options.scales.y ? chart.options.scales.y.type : '',
            sets: chart.data.datasets.map(set => set.data), labels: chart.data.labels,
            drawn: chart.data.datasets.map((_, i) => chart.getDatasetMeta(i).data.map(point => [point.x, point.y])), bottom: chart.chartArea.bottom}))""")
    history = json.loads(browser.script("return document.getElementById('data').textContent"))["report"]["optimisation"]["history"]
    assert len(history) > 1, history
    gaps = next(chart for chart in charts if chart["title"].startswith("Convergence"))
    assert gaps["kind"] == "logarithmic", gaps
    assert gaps["labels"] == [row["pass"] for row in history] and gaps["sets"][0] == [row["relative_gap"] or None for row in history], gaps
    assert gaps["drawn"][0][-1][1] > gaps["drawn"][0][0][1], "the gap does not fall in the picture"
    assert all(0 <= y <= gaps["bottom"] for _, y in gaps["drawn"][0]), gaps
    bounds = next(chart for chart in charts if chart["title"].startswith("Objective"))
    assert bounds["sets"] == [[row["objective"] for row in history], [row["lower_bound"] for row in history]], bounds
    assert all(upper[1] <= lower[1] + 0.5 for upper, lower in zip(*bounds["drawn"])), "the bound is drawn above the objective"


def check_page(browser, shapes, parts, has_accuracy):
    assert len(column(browser, 0)) == shapes, column(browser, 0)
    assert browser.script("return document.querySelectorAll('#viewerA option').length") == shapes
    assert browser.script("return document.querySelectorAll('#parts button').length") == parts
    image = browser.script("const i = document.querySelector('img.sheet'); return [i.complete, i.naturalWidth]")
    assert image[0] and image[1] > 600, image
    assert browser.script("return document.querySelectorAll('#charts canvas').length") >= 5
    assert has_accuracy == browser.script("return [...document.querySelectorAll('th')].some(t => t.textContent === 'accuracy')")

    check_convergence(browser)
    whole = pixels_drawn(browser)
    assert whole > 3000, f"the first shape is not drawn: {whole} pixels"
    before = camera(browser)
    browser.drag("#viewerA canvas", 150, 40)
    after = camera(browser)
    assert sum(abs(a - b) for a, b in zip(before, after)) > 0.3, (before, after)
    assert pixels_drawn(browser) > 3000
    distance = sum(c * c for c in camera(browser)) ** 0.5
    browser.wheel("#viewerA canvas", -240)
    assert sum(c * c for c in camera(browser)) ** 0.5 < distance - 0.05, "the wheel does not zoom"

    shown = pixels_drawn(browser)
    for part in range(parts):
        browser.click(f"#parts button:nth-child({part + 1})")
    assert pixels_drawn(browser) == 0, "hidden parts are drawn"
    for part in range(parts):
        browser.click(f"#parts button:nth-child({part + 1})")
    assert pixels_drawn(browser) == shown, "shown parts are not what they were"

    browser.click("th:nth-child(2)")
    faces = [int(text.replace(",", "")) for text in column(browser, 1)]
    assert faces == sorted(faces), faces
    browser.click("th:nth-child(2)")
    faces = [int(text.replace(",", "")) for text in column(browser, 1)]
    assert faces == sorted(faces, reverse=True), faces

    last = column(browser, 0)[2]
    browser.click("#shapes tbody tr:nth-child(3)")
    number = browser.script("return window.cosegReport.viewers[0].number")
    assert browser.script(f"return window.cosegReport.shapes[{number}].name") == last
    browser.click("#compare")
    assert pixels_drawn(browser, "B") > 1000, "the second shape is not drawn"
    browser.drag("#viewerB canvas", -120, 0)
    assert camera(browser, 0) == camera(browser, 1), "the two views do not turn together"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    path, shapes, parts = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    driver = shutil.which("chromedriver")
    if not driver or not (shutil.which("chromium") or shutil.which("google-chrome")):
        print("skipped: chromium and chromium-driver are not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        log = os.path.join(scratch, "log")
        process = subprocess.Popen([driver, "--port=0", f"--log-path={log}"], stdout=subprocess.PIPE, text=True)
        try:
            port = next(line.split("port ")[-1].strip(". \n") for line in process.stdout if "successfully on port" in line)
            browser = Browser(port, os.path.join(scratch, "profile"))
            try:
                start = time.time()
                browser.do("/url", {"url": "file://" + os.path.abspath(path)})
                ready = browser.script("return performance.getEntriesByType('navigation')[0].loadEventEnd") / 1000
                print(f"{os.path.getsize(path) / 1e6:.2f} MB, {shapes} shapes, drawn {ready:.2f} s after the browser was told to open it "
                      f"({time.time() - start:.2f} s with the browser's own start)")
                check_page(browser, shapes, parts, "--accuracy" in sys.argv)
                severe = [entry for entry in browser.do("/se/log", {"type": "browser"}) if entry["level"] == "SEVERE"]
                assert not severe, severe
            finally:
                browser.call("DELETE", f"/session/{browser.session}")
        finally:
            process.terminate()
            process.wait(timeout=20)
    print("ok: the report in a browser")


if __name__ == "__main__":
    main()
