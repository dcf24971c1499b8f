#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page's view in Chromium without a GPU and without a network: it is drawn; slider and colours change it.

  python3 viewer_test.py PROGRAM|PAGE.html [PICTURE]     the program: of a phantom's run. Exit 77 where there is no
  Chromium or the page has no view; PICTURE: what was seen last
"""
import base64
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

SKIPPED = 77
PATIENCE = 240  # s


class Browser:
    """Chromium that is spoken to through two pipes: JSON, each message ended by a null."""

    def __init__(self, program, profile, *switches):
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()
        command = f'exec "$@" 3<&{to_browser} 4>&{from_browser}'
        self.process = subprocess.Popen(
            ["bash", "-c", command, "bash", program, "--headless", "--no-sandbox", "--remote-debugging-pipe",
             "--no-first-run", "--disable-background-networking", "--host-resolver-rules=MAP * ~NOTFOUND",
             f"--user-data-dir={profile}", "--window-size=1200,1500", *switches],
            pass_fds=[to_browser, from_browser], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.number, self.session, self.rest = 0, None, b""

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                self.rest += os.read(self.into, 1 << 20) or sys.exit("Chromium has gone")
            text, self.rest = self.rest.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.number:
                return answer["result"] if "result" in answer else sys.exit(f"{method}: {answer}")

    def open(self, page):
        target = self.call("Target.createTarget", url=page.resolve().as_uri())["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]

    def value(self, script):
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        return answer["result"].get("value")

    def until(self, condition):
        """Waits until the page says so; what the page then says to its reader."""
        end = time.monotonic() + PATIENCE
        while not self.value(condition) and time.monotonic() < end:
            time.sleep(0.1)
        return self.value("says.textContent")

    def picture(self, element):
        box = self.value(f"(({{x, y, width, height}}) => ({{x, y: y + scrollY, width, height}}))"
                         f"({element}.getBoundingClientRect())")
        shot = self.call("Page.captureScreenshot", clip={**box, "scale": 0.5}, captureBeyondViewport=True)
        return base64.b64decode(shot["data"])

    def close(self):
        self.process.terminate()
        self.process.wait()


def pixels(png):
    """Rows of bytes of an 8-bit PNG without an alpha channel or with one."""
    chunks, at = {}, 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        chunks[kind] = chunks.get(kind, b"") + png[at + 8:at + 8 + size]
        at += 12 + size
    width, height, _, colour = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    step = {2: 3, 6: 4}[colour]
    data, rows, above = zlib.decompress(chunks[b"IDAT"]), [], bytes(width * step)
    for y in range(height):
        kind, *row = data[y * (width * step + 1):(y + 1) * (width * step + 1)]
        for i, value in enumerate(row):
            a, b, c = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[i] = (value + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
        above = bytes(row)
        rows.append(above)
    return b"".join(rows)


def check(condition, what):
    if not condition:
        sys.exit(f"{what}: not so")


def share_that_differs(one, other):
    return sum(1 for a, b in zip(one, other) if abs(a - b) > 16) / len(one)


def colours(browser):
    """Each changes what is seen without it; the choice is left as it was."""
    names, chosen = browser.value("[...colours.options].map(({ text }) => text)"), browser.value("colours.value")
    check(names == ["none", "displacement", "estimated error", "uncertainty", "volume ratio"], f"all colours are there ({names})")

    def choose(number):
        browser.value(f"delete document.body.dataset.view; colours.value = {number}; colours.dispatchEvent(new Event('input'))")
        browser.until("document.body.dataset.view")
        return pixels(browser.picture("canvas"))

    seen = [choose(number) for number in range(len(names))]
    choose(chosen)
    for name, picture in zip(names[1:], seen[1:]):
        differs = share_that_differs(seen[0], picture)
        print(f"{name}: {100 * differs:.2f} % is coloured")
        check(differs > 0.002, f"{name} is seen")


def look(browser, page, picture):
    browser.open(page)
    said = browser.until("window.says?.textContent.startsWith('Click')")
    check("Click" in said, f"the view is drawn (it says: {said})")
    check(browser.value("document.querySelectorAll('#curves canvas').length") > 0, "curves are drawn")
    check("the tissue here moves" in browser.value("readout.textContent"), "a place is told")
    before = browser.picture("canvas")
    colours(browser)
    browser.value("slider.value = 100; slider.dispatchEvent(new Event('input'))")
    browser.until("document.body.dataset.view === 'drawn at 100'")
    check("came" in browser.value("readout.textContent"), "the place is told as it lies after")
    after = browser.picture("canvas")
    if picture:
        pathlib.Path(picture).write_bytes(after)
    first, second = pixels(before), pixels(after)
    seen = sum(1 for value in first if value > 40) / len(first)
    changed = share_that_differs(first, second)
    print(f"{100 * seen:.1f} % of the view is not dark, {100 * changed:.2f} % changes from before to after")
    check(seen > 0.05, "the view is not dark")
    check(changed > 0.002, "the slider changes what is seen")


def without_webgl(browser, page, _):
    browser.open(page)
    said = browser.until("window.says?.textContent.includes('WebGL2')")
    check("no WebGL2" in said, f"without WebGL2 the page says so (it says: {said})")
    check(browser.value("frame.hidden"), "nothing is drawn without WebGL2")


def run_of_phantom(program, folder):
    subprocess.run([program, "phantom", "--size", "64", "--spacing", "3", "--out", f"{folder}/head", "--quiet"], check=True)
    scene = pathlib.Path(folder, "head/scene.xml")
    scene.write_text(scene.read_text().replace("</scene>", '<uncertainty samples="2"/></scene>'))
    subprocess.run([program, "run", scene, "--set", "discretise.nodes=1500", "--out", f"{folder}/run", "--quiet"], check=True)
    return pathlib.Path(folder, "run/report/index.html")


def main(folder):
    page, picture = pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if not chromium:
        print("skipped: there is no Chromium")
        sys.exit(SKIPPED)
    if page.suffix != ".html":
        page = run_of_phantom(sys.argv[1], folder)
    if 'id="canvas"' not in page.read_text():
        print("skipped: the program was built without the libraries of the view")
        sys.exit(SKIPPED)
    check(page.stat().st_size < 10e6, "the page is smaller than 10 MB")
    for switches, use in ((["--use-angle=swiftshader", "--enable-unsafe-swiftshader"], look),
                          (["--disable-3d-apis"], without_webgl)):
        browser = Browser(chromium, f"{folder}/profile", *switches)
        try:
            use(browser, page, picture)
        finally:
            browser.close()


with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
    main(scratch)
