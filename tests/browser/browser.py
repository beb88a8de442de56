"""A headless Chromium over the DevTools protocol, by a pair of pipes: nothing but Python's own library is needed.

Everything waits for events of the browser or for promises of the page, never for a time.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile

TIMEOUT_S = 120  # ends what hangs; a machine that is ten times as slow passes


class BrowserError(Exception):
    pass


def find_chromium():
    """The browser's path, or None."""
    for name in ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable"):
        path = shutil.which(name)
        if path:
            return path
    return None


class Browser:
    """One page. Since it was opened, `requests` lists what it has asked for (what lies in itself aside) and
    `errors` what it has complained of."""

    def __init__(self, chromium):
        self.profile = tempfile.mkdtemp(prefix="stylobate-browser-")
        to_browser, self._write = os.pipe()
        self._read, from_browser = os.pipe()

        def in_child():  # the protocol's descriptors are 3 and 4
            a, b = os.dup(to_browser), os.dup(from_browser)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self._process = subprocess.Popen(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--hide-scrollbars", "--disable-background-networking", "--disable-component-update",
             "--disable-background-timer-throttling", "--force-device-scale-factor=1",
             f"--user-data-dir={self.profile}", "--remote-debugging-pipe", "about:blank"],
            close_fds=False, preexec_fn=in_child, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b""
        self._last = 0
        self._events = []
        self.requests, self.errors = [], []
        target = self._send("Target.createTarget", {"url": "about:blank"}, session=None)["targetId"]
        self._session = self._send("Target.attachToTarget", {"targetId": target, "flatten": True},
                                   session=None)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")
        self.size(1200, 1600)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._send("Browser.close", {}, session=None)
        except (BrowserError, OSError):
            self._process.kill()
        self._process.wait()
        os.close(self._write)
        os.close(self._read)
        shutil.rmtree(self.profile, ignore_errors=True)

    # ---- the protocol ----

    def send(self, method, parameters=None):
        return self._send(method, parameters or {}, self._session)

    def _send(self, method, parameters, session):
        self._last += 1
        message = {"id": self._last, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._write, data):]
        wanted = self._last
        while True:
            answer = self._receive()
            if answer.get("id") == wanted:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']}")
                return answer["result"]
            self._note(answer)

    def _receive(self):
        while b"\0" not in self._buffer:
            if not select.select([self._read], [], [], TIMEOUT_S)[0]:
                raise BrowserError("the browser does not answer")
            part = os.read(self._read, 1 << 20)
            if not part:
                raise BrowserError("the browser has ended")
            self._buffer += part
        line, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(line)

    def _note(self, event):
        method, parameters = event.get("method"), event.get("params", {})
        if method == "Network.requestWillBeSent":
            if not parameters["request"]["url"].startswith("data:"):
                self.requests.append(parameters["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.errors.append(str([a.get("value") for a in parameters["args"]]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.errors.append(parameters["entry"]["text"])
        self._events.append(method)

    def _wait(self, method):
        while method not in self._events:
            self._note(self._receive())
        self._events.clear()

    # ---- what a user does and sees ----

    def size(self, width, height, phone=False):
        self.send("Emulation.setDeviceMetricsOverride",
                  {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone})

    def look(self, scheme="light", media=""):
        self.send("Emulation.setEmulatedMedia",
                  {"media": media, "features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def scripts(self, on):
        self.send("Emulation.setScriptExecutionDisabled", {"value": not on})

    def open(self, path):
        """@param path may end in # and what a link has behind it"""
        self.send("Page.navigate", {"url": "about:blank"})  # the same page with another # would not be loaded anew
        self._wait("Page.loadEventFired")
        self.requests, self.errors = [], []
        self._events.clear()
        self.send("Page.navigate", {"url": "file://" + os.path.abspath(path)})
        self._wait("Page.loadEventFired")

    def js(self, expression):
        """The value of an expression of the page; promises are waited for."""
        answer = self.send("Runtime.evaluate", {"expression": expression, "returnByValue": True, "awaitPromise": True,
                                                "userGesture": True})
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise BrowserError(f"{expression}: {details.get('exception', {}).get('description', details['text'])}")
        return answer["result"].get("value")

    def middle(self, selector):
        """Where the middle of an element is in the window, scrolled into it."""
        place = self.js(f"""(() => {{
            const element = document.querySelector({json.dumps(selector)});
            if (!element) return null;
            element.scrollIntoView({{block: "center", behavior: "instant"}});
            const box = element.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];
        }})()""")
        if place is None:
            raise BrowserError(f"the page has no {selector}")
        return place

    def move(self, x, y):
        self.send("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x, "y": y})

    def hover(self, selector):
        self.move(*self.middle(selector))

    def click(self, selector):
        x, y = self.middle(selector)
        self.move(x, y)
        for kind in ("mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, "button": "left", "clickCount": 1})

    def key(self, name):
        codes = {" ": ("Space", 32, " "), "Enter": ("Enter", 13, "\r"), "Escape": ("Escape", 27, ""),
                 "Tab": ("Tab", 9, ""), "ArrowLeft": ("ArrowLeft", 37, ""), "ArrowUp": ("ArrowUp", 38, ""),
                 "ArrowRight": ("ArrowRight", 39, ""), "ArrowDown": ("ArrowDown", 40, ""), "End": ("End", 35, ""),
                 "Home": ("Home", 36, "")}
        code, number, text = codes[name] if name in codes else (f"Key{name.upper()}", ord(name.upper()), name)
        base = {"key": name, "code": code, "windowsVirtualKeyCode": number}
        self.send("Input.dispatchKeyEvent", {"type": "keyDown", **base, **({"text": text} if text else {})})
        self.send("Input.dispatchKeyEvent", {"type": "keyUp", **base})

    def screenshot(self, path, whole=False):
        answer = self.send("Page.captureScreenshot", {"format": "png", "captureBeyondViewport": whole})
        with open(path, "wb") as file:
            file.write(base64.b64decode(answer["data"]))

    def pdf(self, path):
        answer = self.send("Page.printToPDF", {"printBackground": True})
        with open(path, "wb") as file:
            file.write(base64.b64decode(answer["data"]))
