"""The measured and simulated blocks on the page of a diagnosis, in a real browser: they stand where the diagnosis file has
them, in every window and at every time, whatever is switched off or drawn larger; nothing is loaded from elsewhere, and
no script complains.

    check_windows.py PROGRAM LABORATORY [TEST...]    the program, and hidden_campaigns; some tests: Windows.test_...

Exit status 77, with a reason, where the browser or h5py is not installed.
"""

import math
import os
import re
import struct
import subprocess
import sys
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_test import Given, Page, h5py, main, stylobate  # noqa: E402


def windows_of(file):
    """The windows of a diagnosis: run, times, samples, and the places of each model by block."""
    motion = file["motion"]
    texts = lambda data: [text.decode() for text in data[:]]  # noqa: E731
    drawn = motion["blocks"]
    blocks = list(zip(drawn["kind"][:], drawn["half_width_m"][:], drawn["half_height_m"][:], drawn["rest_x_m"][:],
                      drawn["rest_y_m"][:]))
    free = sum(kind != 2 for kind, *_ in blocks)
    windows, tracks = motion["windows"], motion["windows/tracks"]
    models, places = texts(tracks["model"]), tracks["places"]
    found = []
    for w, run in enumerate(texts(windows["run"])):
        of_window = windows["samples/row"][:] == w
        one = {"run": run, "from": windows["from_s"][w], "to": windows["to_s"][w], "choice": windows["choice"][w],
               "time": windows["samples/time_s"][:][of_window], "base": windows["samples/base_x_m"][:][of_window],
               "tracks": {}, "excess": {}}
        for track in range(len(models)):
            if tracks["row"][track] != w:
                continue
            of_track = places["row"][:] == track
            one["tracks"][models[track]] = [places[key][:][of_track].reshape(-1, free)
                                            for key in ("x_m", "y_m", "theta_rad")]
            one["excess"][models[track]] = tracks["excess"][track]
        found.append(one)
    return blocks, free, found


def seal(path):
    """A file that was written to, sealed again: io/FORMAT.md."""
    with open(path, "rb") as file:
        content = file.read()
    length = struct.unpack_from("<I", content, 20)[0]
    head = content[:24] + struct.pack("<QII", len(content), 0, zlib.crc32(content[length:]))
    head += bytes(length - 4 - len(head))
    with open(path, "r+b") as file:
        file.write(head + struct.pack("<I", zlib.crc32(head)))


class Windows(Page):
    """Of a campaign whose table pitches: the cause is named, so that there is an extended study too."""

    @classmethod
    def make(cls):
        subprocess.run([Given.laboratory, "generate", "--seeds", "4", "--short", "--out", cls.at("lab")], check=True,
                       stdout=subprocess.DEVNULL)
        stylobate("diagnose", cls.at("lab/campaign_4.h5"), "-o", cls.at("d.h5"), "--nulls", 0)
        stylobate("report", cls.at("d.h5"))
        with h5py.File(cls.at("d.h5")) as file:
            cls.blocks, cls.free, cls.windows = windows_of(file)
        assert len(cls.windows) >= 3 and list(cls.windows[0]["tracks"]) == ["measured", "baseline", "extended"]

    def setUp(self):
        self.open("d.html")
        self.browser.js('document.querySelector(".player .stage").focus()')

    # ---- what is drawn ----

    def drawn(self):
        """The blocks of each layer: x, y [px], rotation [degree], half width, half height [px], shown or not."""
        return self.browser.js("""(() => {
            const layers = {};
            for (const block of document.querySelectorAll(".player .block")) {
                const [x, y, turn] = block.getAttribute("transform").match(/-?[\\d.]+/g).map(Number);
                (layers[block.classList[1]] ??= []).push(
                    [x, y, turn, block.width.baseVal.value / 2, block.height.baseVal.value / 2,
                     block.getClientRects().length > 0]);
            }
            return layers;
        })()""")

    def text(self, selector):
        return self.browser.js(f'document.querySelector("{selector}").textContent')

    def time(self):
        return float(self.text(".player .time").split()[0])

    def size_of(self, what):
        return float(self.browser.js(f"""document.querySelector('.player select[aria-label="size of {what}"]').value"""))

    def expect_places(self, window):
        """The drawing shows the file's places at the time on the clock, in one scale for all blocks: displacements from
        rest, and differences from the measured blocks, as much larger as is chosen."""
        larger, apart = self.size_of("displacements"), self.size_of("differences")
        time = self.time()
        k = min(range(len(window["time"])), key=lambda i: abs(window["time"][i] - time))
        self.assertAlmostEqual(window["time"][k], time, delta=6e-4)
        layers = self.drawn()
        left = min(x - w for _, w, _, x, _ in self.blocks)
        right = max(x + w for _, w, _, x, _ in self.blocks)
        bottom = min(y - h for _, _, h, _, y in self.blocks)
        stage = self.browser.js('document.querySelector(".player .ground").y.baseVal.value')
        scale = layers["measured"][0][3] / self.blocks[0][1]
        for name, look in (("measured", "measured"), ("baseline", "model1"), ("extended", "model2")):
            self.assertEqual(len(layers[look]), self.free)
            def drawn(c, b, rest):
                measured, model = window["tracks"]["measured"][c][k][b], window["tracks"][name][c][k][b]
                return rest + larger * (measured - rest) + apart * (model - measured)
            for b, (x, y, turn, half_width, half_height, _) in enumerate(layers[look]):
                _, w, h, rest_x, rest_y = self.blocks[b]
                self.assertAlmostEqual(half_width, w * scale, delta=0.05)
                self.assertAlmostEqual(half_height, h * scale, delta=0.05)
                self.assertAlmostEqual(x - 320, (drawn(0, b, rest_x) - (left + right) / 2) * scale, delta=0.15)
                self.assertAlmostEqual(stage - y, (drawn(1, b, rest_y) - bottom) * scale, delta=0.15)
                self.assertAlmostEqual(-math.radians(turn), drawn(2, b, 0), delta=2e-3)
        return k

    # ---- the windows ----

    def test_blocks_stand_where_the_file_has_them(self):
        for number, window in enumerate(self.windows):
            title = self.text(".player .which")
            self.assertIn(f"Run {window['run']}, {window['from']:.2f} to {window['to']:.2f} s", title)
            self.assertIn(f"({number + 1} of {len(self.windows)})", title)
            self.assertIn("typical" if window["choice"] == 1 else "worst", title)
            for name in ("baseline", "extended"):
                self.assertRegex(title, rf"{name}[^,:]* {window['excess'][name]:.1f} ")
            self.assertEqual(self.browser.js('document.querySelector(".player .stage").ariaLabel'), title)
            seen = set()
            for keys in ([], ["ArrowRight"] * 7, ["End"], ["ArrowLeft"] * 5, ["Home", "ArrowRight"]):
                for key in keys:
                    self.browser.key(key)
                seen.add(self.expect_places(window))
            self.assertEqual(len(seen), 5)
            self.browser.key("n")
        self.browser.key("n")  # there are no more
        self.expect_places(self.windows[-1])
        self.browser.key("p")
        self.expect_places(self.windows[-2])
        self.assertIn(f"Run {self.windows[-2]['run']}", self.text(".spoken"))

    def test_the_worst_and_the_median_are_among_them(self):
        self.assertEqual([w["choice"] for w in self.windows[:2]], [0, 1])
        errors = [w["excess"]["baseline"] for w in self.windows]
        self.assertEqual(errors[0], max(errors))
        with h5py.File(self.at("d.h5")) as file:
            self.assertAlmostEqual(errors[0], file["wrong/excess"][0], delta=1e-9)
            self.assertEqual(self.windows[0]["run"], file["wrong/run"][0].decode())

    def test_the_difference_that_is_told_is_that_of_the_places(self):
        for _ in range(9):
            self.browser.key("ArrowRight")
        k = self.expect_places(self.windows[0])
        tracks = self.windows[0]["tracks"]
        told = re.findall(r"([\d.e-]+) mm \(block (\d+)\), ([\d.e-]+) mrad \(block (\d+)\)", self.text(".player .says"))
        self.assertEqual(len(told), 2)
        for (far, of_far, turned, of_turned), name in zip(told, ("baseline", "extended")):
            x, y, theta = (tracks[name][c][k] - tracks["measured"][c][k] for c in range(3))
            apart = [math.hypot(a, b) for a, b in zip(x, y)]
            self.assertAlmostEqual(float(far) / 1000, max(apart), delta=0.01 * max(apart) + 2e-5)
            self.assertAlmostEqual(apart[int(of_far)], max(apart), delta=2e-5)
            self.assertAlmostEqual(float(turned) / 1000, max(abs(theta)), delta=0.01 * max(abs(theta)) + 1e-4)
            self.assertAlmostEqual(abs(theta[int(of_turned)]), max(abs(theta)), delta=1e-4)

    def test_base_is_where_the_file_has_it(self):
        self.browser.key("End")
        base = float(re.match(r"Base at (\S+) m", self.text(".player .says")).group(1))
        self.assertAlmostEqual(base, self.windows[0]["base"][-1], delta=6e-4 * abs(base) + 1e-5)

    # ---- what the reader does ----

    def test_layers_can_be_switched_off(self):
        for look in ("measured", "model1", "model2"):
            self.browser.click(f".player button.{look}")
            self.assertEqual(self.browser.js(f'document.querySelector("button.{look}").ariaPressed'), "false")
            shown = {name: any(block[5] for block in blocks) for name, blocks in self.drawn().items()}
            self.assertFalse(shown[look])
            self.assertTrue(all(shown[other] for other in shown if other != look))
            self.browser.js('document.querySelector(".player .stage").focus()')
            self.browser.key("ArrowRight")  # it stays off while time goes on
            self.assertFalse(any(block[5] for block in self.drawn()[look]))
            self.browser.click(f".player button.{look}")
            self.assertTrue(all(block[5] for block in self.drawn()[look]))

    def test_displacements_and_differences_are_drawn_as_large_as_is_asked_for(self):
        self.browser.key("End")
        for factors in ((1, 1), (5, 5), (2, 20), (10, 1)):
            before = self.drawn()
            for what, factor in zip(("displacements", "differences"), factors):
                self.browser.js(f"""(() => {{
                    const choice = document.querySelector('.player select[aria-label="size of {what}"]');
                    choice.value = "{factor}";
                    choice.dispatchEvent(new Event("change"));
                }})()""")
            self.assertNotEqual(self.drawn(), before)
            self.expect_places(self.windows[0])

    def play_to_the_end(self):
        return self.browser.js("""new Promise((done) => {
            const player = document.querySelector(".player"), began = performance.now();
            let frames = 0;
            player.addEventListener("frame", () => ++frames);
            player.addEventListener("paused", (event) => done([(performance.now() - began) / 1000, event.detail, frames]));
            document.querySelector(".player .play").click();
        })""")

    def test_playing_is_slow_enough_to_be_watched(self):
        self.browser.js('document.querySelector(".player").scrollIntoView()')
        window = self.windows[0]
        end = window["time"][-1] - window["time"][0]
        took, at, frames = self.play_to_the_end()
        self.assertAlmostEqual(at, end, delta=6e-4)
        self.assertGreater(took, 1.9)
        self.assertGreater(frames, 2)
        self.expect_places(window)
        self.browser.js('(() => { const s = document.querySelector(".player select[aria-label=speed]"); s.value = "1"; '
                        's.dispatchEvent(new Event("change")); })()')
        fast, _, _ = self.play_to_the_end()
        self.assertLess(fast, took)

    def test_scrubbing_goes_to_a_time(self):
        self.browser.js('(() => { const s = document.querySelector(".player input"); s.value = 11; '
                        's.dispatchEvent(new Event("input")); })()')
        self.assertEqual(self.expect_places(self.windows[0]), 11)
        self.browser.click(".player .strip")  # its middle
        time = self.windows[0]["time"]
        self.assertAlmostEqual(self.time() - time[0], (time[-1] - time[0]) / 2, delta=0.01 * (time[-1] - time[0]) + 1e-3)

    def test_has_a_name_for_everything_that_is_operated(self):
        nameless = self.browser.js("""[...document.querySelectorAll("button, input, select, [tabindex], svg[role]")]
            .filter((e) => !e.textContent.trim() && !e.getAttribute("aria-label")).map((e) => e.outerHTML.slice(0, 80))""")
        self.assertEqual(nameless, [])
        self.browser.js('document.querySelector(".player .next").focus()')
        reached = []
        for _ in range(9):
            self.browser.key("Tab")
            reached.append(self.browser.js("document.activeElement.ariaLabel || document.activeElement.textContent"))
        self.assertEqual(reached[:5], ["measured", "calibrated baseline", "extended study", "size of displacements",
                                       "size of differences"])
        self.assertEqual(reached[6:], ["Play", "time", "speed"])

    # ---- paper, phones, browsers without scripts ----

    def expect_picture(self):
        """The picture and the table are there, and no controls."""
        self.assertEqual(self.browser.js("""[...document.querySelectorAll(".player, button, select, input")]
            .filter((e) => e.getClientRects().length).length"""), 0)
        measured = self.browser.js("""[...document.querySelectorAll("figure .stage svg")].map(
            (panel) => [...panel.querySelectorAll(".block.measured")].filter((b) => b.getClientRects().length).length)""")
        self.assertEqual(measured, [self.free] * len(self.windows))
        rows = self.browser.js("""[...document.querySelectorAll("table")].map((t) => t.innerText).find(
            (text) => text.includes("typical"))""")
        for window in self.windows:
            for name in ("baseline", "extended"):
                self.assertIn(f"{window['excess'][name]:.1f} (", rows)

    def test_prints_a_picture(self):
        self.browser.look(media="print")
        try:
            self.expect_picture()
        finally:
            self.browser.look(media="")

    def test_is_a_picture_without_scripts(self):
        self.browser.scripts(False)
        try:
            self.open("d.html")
        finally:
            self.browser.scripts(True)
        self.expect_picture()

    def test_measured_blocks_stand_out_in_light_and_dark(self):
        brightness = lambda colour: sum(map(int, re.findall(r"\d+", colour)[:3]))  # noqa: E731
        stroke = 'getComputedStyle(document.querySelector(".player .block.measured")).stroke'
        light = brightness(self.browser.js(stroke))
        self.browser.look("dark")
        dark = brightness(self.browser.js(stroke))
        self.browser.look("light")
        self.assertLess(light, 200)
        self.assertGreater(dark, 500)

    def test_fits_a_phone(self):
        self.browser.size(360, 740, phone=True)
        self.open("d.html")
        width = self.browser.js("document.documentElement.scrollWidth")
        self.browser.size(1200, 1600)
        self.assertLessEqual(width, 360)

    # ---- older files ----

    def test_a_file_without_motion_has_a_page_that_says_so(self):
        with open(self.at("d.h5"), "rb") as new, open(self.at("old.h5"), "wb") as old:
            old.write(new.read())
        with h5py.File(self.at("old.h5"), "r+") as file:
            del file["motion"]
            file.attrs.modify("format_version", 2)
        seal(self.at("old.h5"))
        stylobate("report", self.at("old.h5"), "--force")
        self.open("old.html")
        self.assertIn("not shown in motion: old.h5 was written by an earlier version",
                      self.browser.js("document.body.textContent"))
        self.assertEqual(self.browser.js('document.querySelectorAll(".player, [data-player]").length'), 0)
        self.assertGreater(self.browser.js('document.querySelectorAll("figure svg").length'), 1)  # the curves


if __name__ == "__main__":
    main(["program", "laboratory"], __doc__)
