# SPDX-License-Identifier: MIT
"""A page in headless Chromium, by its DevTools protocol: looks at it, presses its keys."""
import base64
import contextlib
import io
import itertools
import json
import pathlib
import shutil
import subprocess
import time
import urllib.request
from typing import Any, Callable, Iterator, List

import numpy as np
import pytest
from PIL import Image
from websockets.sync.client import ClientConnection, connect

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
NEEDS = pytest.mark.skipif(not BROWSER, reason="found no chromium, which shows pages")
SETTINGS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader"]
SETTINGS += ["--enable-unsafe-swiftshader", "--disable-background-networking"]
SETTINGS += ["--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"]  # no network


def wait_for(condition: Callable[[], Any], pause_s: float = 0.05) -> Any:
    """Returns the condition's value as soon as it is true; asks again after a pause, for 60 s."""
    end_s = time.monotonic() + 60
    while time.monotonic() < end_s:
        value = condition()
        if value:
            return value
        time.sleep(pause_s)
    raise AssertionError(f"found no {condition} in 60 s")


class Page:
    """A page of the browser."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket, self._numbers = socket, itertools.count(1)
        self.complaints: List[str] = []
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **params: Any) -> Any:
        """Returns the answer of a method of the protocol; collects what the console says meanwhile."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            message = json.loads(self._socket.recv(timeout=60))
            if message.get("id") == number:
                assert "error" not in message, message
                return message["result"]
            params = message.get("params", {})
            if "exceptionDetails" in params or params.get("entry", {}).get("level") == "error":
                self.complaints.append(str(params))

    def press(self, letter: str) -> None:
        """Presses and releases a key."""
        key = dict(
            key=letter, code=f"Key{letter.upper()}", windowsVirtualKeyCode=ord(letter.upper())
        )
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, **key)

    def text(self) -> str:
        """Returns what the page says."""
        wanted = "document.body.innerText"
        return self.call("Runtime.evaluate", expression=wanted)["result"].get("value", "")

    def pixels(self) -> np.ndarray:
        """Returns a picture of the page, uint8[h, w, 3]."""
        data = base64.b64decode(self.call("Page.captureScreenshot")["data"])
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


@contextlib.contextmanager
def open_page(url: str, folder: pathlib.Path, size_px: str = "900,500") -> Iterator[Page]:
    """Yields a page; the browser keeps its files in the folder."""
    place = ["--remote-debugging-port=0", f"--user-data-dir={folder}", f"--window-size={size_px}"]
    log = (folder.parent / "browser.log").open("w")
    browser = subprocess.Popen([str(BROWSER), *SETTINGS, *place, url], stdout=log, stderr=log)
    try:
        port_file = folder / "DevToolsActivePort"
        wait_for(lambda: port_file.is_file() and port_file.read_text().count("\n"))
        port = port_file.read_text().split()[0]

        def page() -> Any:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
                found = [each for each in json.load(answer) if each["type"] == "page"]
            return found and found[0]["webSocketDebuggerUrl"]

        with connect(wait_for(page), max_size=None) as socket:
            yield Page(socket)
    finally:
        browser.terminate()
        browser.wait(10)
