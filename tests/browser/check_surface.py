"""The page of a surface in a real browser: what it shows under the pointer and under the keys is what the results file
has, what is chosen in one part shows in all, blocks move as a replay of the same realization says, nothing is loaded
from elsewhere, and no script complains.

    check_surface.py PROGRAM STUDIES [TEST...]      the program, the folder of its studies; some tests: Surface.test_...

Exit status 77, with a reason, where the browser or h5py is not installed.
"""

import base64
import json
import math
import os
import re
import struct
import subprocess
import sys
from urllib.parse import unquote
from xml.etree import ElementTree

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_test import BROKEN, LETTERS, Given, Page, h5py, main, settings, stylobate  # noqa: E402


def jeffreys(collapses, trials):
    """95 % interval by bisection of the beta distribution's integral: no code of the program."""
    def below(x, a, b, steps=4000):  # x = sin^2 u: the integrand is smooth
        def integral(limit):
            width = limit / steps
            return sum(math.sin((k + .5) * width) ** (2 * a - 1) * math.cos((k + .5) * width) ** (2 * b - 1)
                       for k in range(steps)) * width
        return integral(math.asin(math.sqrt(x))) / integral(math.pi / 2)

    def quantile(p):
        low, high = 0.0, 1.0
        for _ in range(30):
            middle = (low + high) / 2
            low, high = (middle, high) if below(middle, collapses + .5, trials - collapses + .5) < p else (low, middle)
        return low

    return (0.0 if collapses == 0 else quantile(.025)), (1.0 if collapses == trials else quantile(.975))


class Surface(Page):
    @classmethod
    def make(cls):
        stylobate("run", f"{Given.studies}/small_scale_column.toml", "-o", cls.at("surface.h5"),
                  *settings(study__realizations=6, structure__blocks=4, contact__normal_stiffness_n_m2="4e6",
                            contact__tangential_stiffness_n_m="2e5", excitation__cycles=4,
                            surface__frequency_hz="{from=4.0,to=8.0,count=4}",
                            surface__pga_m_s2="{from=4.0,to=25.0,count=4}"))
        stylobate("report", cls.at("surface.h5"))
        stylobate("report", cls.at("surface.h5"), "--animate", 0, "-o", cls.at("still.html"))
        with h5py.File(cls.at("surface.h5")) as file:
            rows = file["realizations"]
            cls.cell = rows["cell"][:].tolist()
            cls.index = rows["index"][:].tolist()
            cls.state = rows["outcome/state"][:].tolist()  # 0 stood, 1 rocked, 2 slid, 3 collapsed, 4 invalid
            cls.fall = rows["outcome/collapse_time_s"][:].tolist()
            cls.frequency = rows["frequency_hz"][:].tolist()
            cls.pga = rows["pga_m_s2"][:].tolist()
        states = {}
        for cell, state in zip(cls.cell, cls.state):
            states.setdefault(cell, []).append(state)
        cls.states = states
        cls.mixed = sorted(cell for cell, all_of in states.items() if 3 in all_of and any(s < 3 for s in all_of))
        assert cls.mixed, "the study has no cell with both fates"

    def setUp(self):
        self.open("surface.html")

    def expect_cell(self, readings, cell):
        row = self.cell.index(cell)
        states = self.states[cell]
        trials, collapses = sum(s < 4 for s in states), states.count(3)
        self.assertEqual(readings["title"], f"Cell {cell}")
        self.assertAlmostEqual(float(readings["frequency"].split()[0]), self.frequency[row], delta=1e-3 * 10)
        self.assertAlmostEqual(float(readings["PGA"].split()[0]), self.pga[row], delta=1e-3 * 25)
        self.assertEqual(readings["collapsed"], f"{collapses} of {trials}")
        self.assertEqual(readings["probability of collapse"], f"{100 * collapses / trials:.1f} %")
        low, high = map(float, re.findall(r"([\d.]+) %", readings["95 % Jeffreys interval"]))
        wanted = jeffreys(collapses, trials)
        self.assertAlmostEqual(low, 100 * wanted[0], delta=0.06)
        self.assertAlmostEqual(high, 100 * wanted[1], delta=0.06)
        for number, name in enumerate(("stood", "rocked", "slid")):
            self.assertEqual(readings[name], str(states.count(number)))

    def test_hovering_shows_the_numbers_of_the_file(self):
        for cell in (0, self.mixed[0], self.mixed[-1], 15):
            self.browser.hover(f'[data-cell="{cell}"]')
            self.expect_cell(self.tip(), cell)
        self.browser.move(2, 2)
        self.assertIsNone(self.tip())

    def test_the_keys_go_from_cell_to_cell(self):
        self.open_cell(0)
        for keys, cell in ((["ArrowRight", "ArrowUp"], 5), (["ArrowUp"], 6), (["ArrowLeft", "ArrowLeft"], 2),
                           (["ArrowDown"] * 9, 0)):
            for key in keys:
                self.browser.key(key)
            self.expect_open(cell)
            spoken = self.browser.js('document.querySelector(".spoken").textContent')
            self.assertIn(f"collapsed {self.states[cell].count(3)} of", spoken)

    def test_all_that_answers_can_be_reached_by_the_keys(self):
        reached = []
        self.browser.js("document.activeElement.blur()")
        for _ in range(40):
            self.browser.key("Tab")
            reached.append(self.browser.js("document.activeElement.getAttribute('class') || ''"))
        self.assertIn("cells", reached)
        self.assertIn("key", reached)

    def open_cell(self, cell):
        self.browser.click(f'[data-cell="{cell}"]')

    def open_player(self, cell):
        self.open_cell(cell)
        self.browser.js('document.querySelector(".player .stage").focus({preventScroll: true})')

    def facts(self):
        return dict(self.browser.js("""[...document.querySelectorAll(".cell-panel .facts tr")]
            .map((row) => [...row.cells].map((cell) => cell.textContent))"""))

    def test_a_click_opens_a_cell_with_its_outcomes(self):
        cell = self.mixed[0]
        self.open_cell(cell)
        facts = self.facts()
        self.assertEqual(facts["collapsed"], f"{self.states[cell].count(3)} of {len(self.states[cell])}")
        falls = sorted(t for c, t in zip(self.cell, self.fall) if c == cell and t >= 0)
        middle = len(falls) // 2
        median = falls[middle] if len(falls) % 2 else (falls[middle - 1] + falls[middle]) / 2
        numbers = [float(x) for x in re.findall(r"[\d.]+", facts["time of the first fall"])]
        for shown, wanted in zip(numbers, (median, falls[0], falls[-1])):
            self.assertAlmostEqual(shown, wanted, delta=0.006 * wanted)
        self.assertEqual(sum(int(n) for n in re.findall(r": (\d+)", facts["fell first"])), self.states[cell].count(3))

    def test_a_cell_without_animations_says_how_to_replay_it(self):
        self.open("still.html")
        cell = self.mixed[0]
        self.open_cell(cell)
        text = self.browser.js('document.querySelector(".cell-panel").textContent')
        command = re.search(r"stylobate (replay surface\.h5 --frequency \S+ --pga \S+)", text).group(1)
        done = subprocess.run([Given.program, *command.split(), "--json"], cwd=self.folder.name, check=True,
                              stdout=subprocess.PIPE)
        self.assertEqual(self.cell[self.index.index(json.loads(done.stdout)["realization"])], cell)

    # ---- the instrument ----

    def expect_open(self, cell, limit=0):
        """All parts show the cell, with the counts of the file; the address has it."""
        states = self.states[cell]
        trials = sum(s < 4 for s in states)
        shown = self.browser.js("""(() => {
            const box = (element) => ["x", "y", "width", "height"].map((name) => Number(element.getAttribute(name)));
            const open = document.querySelector(".opened rect"), title = document.querySelector(".cell-panel h3").textContent;
            return {title, open: box(open), cells: [...document.querySelectorAll("[data-cell]")].map(box),
                    here: Number(document.querySelector(".slice .here").dataset.sliceCell),
                    bars: Object.fromEntries([...document.querySelectorAll(".outcome-bars tr")].map((row) =>
                        [row.dataset.limit, row.querySelector(".r").textContent])),
                    falls: document.querySelector(".falls").checkVisibility()
                        ? document.querySelector(".falls").getAttribute("aria-label") : null,
                    hash: Object.fromEntries(new URLSearchParams(location.hash.slice(1)))};
        })()""")
        self.assertTrue(shown["title"].startswith(f"Cell {cell}:"), shown["title"])
        self.assertEqual(shown["open"], shown["cells"][cell])
        self.assertEqual(shown["here"], cell)
        for name, count in (("collapse", states.count(3)), ("rocked", states.count(1)), ("slid", states.count(2))):
            low, high = jeffreys(count, trials)
            numbers = [float(number) for number in re.findall(r"[\d.]+", shown["bars"][name])]
            for number, wanted in zip(numbers, (count / trials, low, high), strict=True):
                self.assertAlmostEqual(number, 100 * wanted, delta=0.06)
        falls = sorted(t for c, t in zip(self.cell, self.fall) if c == cell and t >= 0)
        if falls:
            numbers = [float(number) for number in re.findall(r"[\d.]*\d", shown["falls"])]
            self.assertEqual(numbers[0], len(falls))
            self.assertAlmostEqual(numbers[1], falls[0], delta=0.001 * max(t for t in self.fall if t >= 0) + 0.006 * falls[0])
            self.assertAlmostEqual(numbers[2], falls[-1], delta=0.001 * max(t for t in self.fall if t >= 0) + 0.006 * falls[-1])
        else:
            self.assertIsNone(shown["falls"])
        self.assertEqual(shown["hash"]["cell"], str(cell))
        return shown

    def test_what_is_chosen_in_one_part_shows_in_all(self):
        one, other = self.mixed[0], next(c for c in range(16) if c not in self.mixed)
        self.open_cell(one)
        first = self.expect_open(one)
        self.open_cell(other)
        self.assertNotEqual(self.expect_open(other)["bars"], first["bars"])
        beside = one + 1 if one % 4 < 3 else one - 1  # in the same slice
        self.open_cell(one)
        self.browser.click(f'[data-slice-cell="{beside}"]')
        self.expect_open(beside)
        self.browser.js('document.querySelector("svg.slice").focus()')
        self.browser.key("ArrowLeft" if beside > one else "ArrowRight")
        self.expect_open(one)

    def test_a_realization_is_marked_among_the_falls_and_in_the_address(self):
        cell = self.mixed[0]
        self.open_player(cell)
        marked = """(() => { const one = document.querySelector(".falls .here");
                             return one ? Number(one.dataset.realization) : null; })()"""
        seen = {}
        for _ in range(2):
            index, _ = self.which()
            fell = self.state[self.index.index(index)] == 3
            seen[fell] = index
            self.assertEqual(self.browser.js(marked), index if fell else None)
            self.browser.key("n")
        self.assertEqual(set(seen), {True, False})
        hashed = "new URLSearchParams(location.hash.slice(1)).get('realization')"
        self.browser.js(f"""(() => {{ const s = document.querySelector(".choices");
            s.value = [...s.options].find((o) => o.textContent.startsWith("{seen[False]}:")).value;
            s.dispatchEvent(new Event("change")); }})()""")
        self.assertEqual(self.browser.js(hashed), str(seen[False]))
        self.browser.click(".falls .bar")  # the one that fell is chosen
        self.assertEqual(self.which()[0], seen[True])
        self.assertEqual(self.browser.js(hashed), str(seen[True]))
        self.assertEqual(self.browser.js(marked), seen[True])

    def choose(self, label, value):
        self.browser.js(f"""(() => {{
            const select = [...document.querySelectorAll(".chooser label")].find((one) => one.textContent.startsWith("{label}"))
                .querySelector("select");
            const option = [...select.options].find((one) => one.textContent.startsWith("{value}"));
            select.value = option.value;
            select.dispatchEvent(new Event("change"));
        }})()""")

    def contours(self, text):
        self.browser.js(f"""(() => {{
            const field = document.querySelector(".chooser input");
            field.value = "{text}";
            field.dispatchEvent(new Event("change"));
        }})()""")

    def test_another_limit_state_changes_map_slice_and_readings(self):
        cell = next(c for c in range(16) if 0 < self.states[c].count(1) < len(self.states[c]))
        fill = "[...document.querySelectorAll('[data-cell]')].map((rect) => rect.getAttribute('fill'))"
        curve = "document.querySelector('.slice .curve').getAttribute('d')"
        self.open_cell(cell)
        before = self.browser.js(fill), self.browser.js(curve)
        self.choose("Limit state", "rocking")
        self.expect_open(cell)
        colours = self.browser.js(fill)
        self.assertNotEqual(before[0], colours)
        self.assertNotEqual(before[1], self.browser.js(curve))
        shares = [self.states[c].count(1) / len(self.states[c]) for c in range(16)]
        for a in range(16):
            for b in range(16):
                self.assertEqual(colours[a] == colours[b], shares[a] == shares[b], (a, b))
        self.browser.hover(f'[data-cell="{cell}"]')
        tip = self.tip()
        self.assertEqual(tip["reached"], f"{self.states[cell].count(1)} of {len(self.states[cell])}")
        self.assertEqual(tip["probability of rocking without collapse"], f"{100 * shares[cell]:.1f} %")
        self.choose("Limit state", "collapse")
        for was, now in zip(before[0], self.browser.js(fill)):  # as the program had painted it
            for k in (1, 3, 5):
                self.assertAlmostEqual(int(was[k:k + 2], 16), int(now[k:k + 2], 16), delta=3)

    def test_contours_are_those_of_the_program(self):
        drawn = """[[...document.querySelectorAll(".contours path")].map((path) => path.getAttribute("d")),
                    [...document.querySelectorAll(".contours text")].map((text) => text.textContent)]"""
        scripted, names = self.browser.js(drawn)
        self.browser.scripts(False)
        try:
            self.open("surface.html")
        finally:
            self.browser.scripts(True)
        still, its_names = self.browser.js(drawn)
        self.assertEqual(names, its_names)
        points = lambda paths: sorted(float(x) for path in paths for x in re.findall(r"[\d.]+", path))  # noqa: E731
        self.assertGreater(len(points(still)), 20)
        self.assertEqual(len(points(scripted)), len(points(still)))
        for a, b in zip(points(scripted), points(still)):
            self.assertAlmostEqual(a, b, delta=0.11)

    def test_other_colours_contours_and_slices(self):
        self.open_cell(self.mixed[0])
        self.choose("Colour", "realizations")
        self.assertEqual(len(set(self.browser.js(
            "[...document.querySelectorAll('[data-cell]')].map((rect) => rect.getAttribute('fill'))"))), 1)
        lines = "document.querySelectorAll('.contours path').length"
        texts = "[...document.querySelectorAll('.contours text')].map((text) => text.textContent)"
        self.assertGreater(self.browser.js(lines), 0)
        self.contours("0.3")
        self.assertEqual(self.browser.js(texts), ["0.3"])
        self.contours("0.35, .6")
        self.assertEqual(set(self.browser.js(texts)), {"0.35", "0.6"})
        for wrong in ("35 %", "1.2", "0", "half"):
            self.contours(wrong)
            self.assertEqual(set(self.browser.js(texts)), {"0.35", "0.6"}, wrong)
            self.assertIn("no list of probabilities", self.browser.js('document.querySelector(".spoken").textContent'))
            self.assertIn("no list", self.browser.js('document.querySelector(".chooser input").validationMessage'))
        self.contours("")
        self.assertEqual(self.browser.js(lines), 0)
        self.choose("Slice over", "frequency")
        self.assertEqual(self.browser.js('document.querySelectorAll("[data-slice-cell]").length'), 4)
        self.assertEqual(sorted(self.browser.js(
            '[...document.querySelectorAll("[data-slice-cell]")].map((point) => Number(point.dataset.sliceCell) % 4)')),
            [self.mixed[0] % 4] * 4)

    def test_a_link_opens_the_same(self):
        cell = self.mixed[-1]
        self.open_player(cell)
        self.browser.key("n")
        self.choose("Limit state", "sliding")
        self.choose("Slice over", "frequency")
        self.contours("0.2")
        state = """[location.hash, document.querySelector(".player .which").textContent,
                    ...[...document.querySelectorAll(".chooser :is(select, input)")].map(({value}) => value),
                    document.querySelector(".slice .curve").getAttribute("d"),
                    document.querySelector(".contours").innerHTML]"""
        was = self.browser.js(state)
        self.open("surface.html" + was[0])
        self.assertEqual(self.browser.js(state), was)
        self.expect_open(cell)
        self.open("surface.html#cell=99&limit=none")  # what there is not is left out
        self.assertIn("no cell 99", self.browser.js('document.querySelector(".spoken").textContent'))
        self.assertTrue(self.browser.js('!!document.querySelector(".cell-panel h3").textContent'))

    def copied(self, button):
        self.browser.js('document.querySelector(".take").open = true')
        return self.browser.js(f"""new Promise((done) => {{
            for (const kind of ["copied", "downloaded"])
              document.addEventListener(kind, (event) => done(event.detail), {{once: true}});
            [...document.querySelectorAll(".take button")].find((one) => one.textContent === "{button}").click();
        }})""")

    def test_copies_the_numbers_of_the_file(self):
        cell = self.mixed[0]
        self.open_cell(cell)
        for button, cells, limits in (("Map as CSV", range(16), 1), ("Slice as CSV", range(cell // 4 * 4, cell // 4 * 4 + 4), 1),
                                      ("Cell as CSV", [cell], 4)):
            head, *lines = [line.split(",") for line in self.copied(button).strip().split("\n")]
            self.assertEqual(len(lines), len(cells) * limits)
            rows = [dict(zip(head, line, strict=True)) for line in lines]
            self.assertEqual([int(row["cell"]) for row in rows[::limits]], list(cells))
            for row in (row for row in rows if row["limit_state"] == "collapse"):
                states = self.states[int(row["cell"])]
                at = self.cell.index(int(row["cell"]))
                self.assertAlmostEqual(float(row["frequency_hz"]), self.frequency[at], delta=1e-4)
                self.assertAlmostEqual(float(row["pga_m_s2"]), self.pga[at], delta=1e-4)
                self.assertEqual((int(row["trials"]), int(row["reached"])), (len(states), states.count(3)))
                for name, wanted in zip(("lower", "upper"), jeffreys(states.count(3), len(states)), strict=True):
                    self.assertAlmostEqual(float(row[name]), wanted, delta=6e-4)

    def test_saves_the_map(self):
        self.open_cell(self.mixed[0])
        saved = self.copied("Map as SVG")
        self.assertEqual(saved["name"], "surface_map.svg")
        root = ElementTree.fromstring(unquote(saved["url"].split(",", 1)[1]))
        fills = [rect.get("fill") for rect in root.iter("{http://www.w3.org/2000/svg}rect") if rect.get("data-cell")]
        self.assertEqual(fills, self.browser.js(
            "[...document.querySelectorAll('[data-cell]')].map((rect) => rect.getAttribute('fill'))"))
        png = base64.b64decode(self.copied("Map as PNG")["url"].split(",", 1)[1])
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (1280, 992))

    # ---- the animation ----

    def which(self):
        text = self.browser.js('document.querySelector(".player .which").textContent')
        return int(re.search(r"Realization (\d+)", text).group(1)), text

    def time(self):
        return float(self.browser.js('document.querySelector(".player .time").textContent').split()[0])

    def places(self):
        """Of the blocks in the drawing: x, y [px], rotation [degree], half width and half height [px]."""
        return self.browser.js("""[...document.querySelectorAll(".player .block")].map((block) => {
            const [x, y, turn] = block.getAttribute("transform").match(/-?[\\d.]+/g).map(Number);
            return [x, y, turn, block.width.baseVal.value / 2, block.height.baseVal.value / 2];
        })""")

    def replayed(self, index):
        """The trajectory of a realization, from a replay."""
        name = self.at(f"replay_{index}.h5")
        if not os.path.exists(name):
            stylobate("replay", self.at("surface.h5"), "--realization", index, "-o", name)
        with h5py.File(name) as file:
            t = file[f"trajectories/{index}"]
            return {key: t[key][:] for key in t.keys()}

    def expect_places(self, index):
        """The drawing shows the replay's positions at the time on the clock, in one scale for all blocks."""
        t = self.replayed(index)
        time = self.time()
        k = min(range(len(t["time_s"])), key=lambda i: abs(t["time_s"][i] - time))
        self.assertAlmostEqual(t["time_s"][k], time, delta=6e-4)
        places = self.places()
        scale = places[0][3] / t["half_width_m"][0]
        ground = places[0][1] + t["y_m"][k][0] * scale
        for b, (x, y, turn, half_width, half_height) in enumerate(places):
            self.assertAlmostEqual(half_width, t["half_width_m"][b] * scale, delta=0.2)
            self.assertAlmostEqual(half_height, t["half_height_m"][b] * scale, delta=0.2)
            self.assertAlmostEqual(x - places[0][0], (t["x_m"][k][b] - t["x_m"][k][0]) * scale, delta=0.25)
            self.assertAlmostEqual(ground - y, t["y_m"][k][b] * scale, delta=0.8)
            corner = math.hypot(half_width, half_height)
            self.assertAlmostEqual(-math.radians(turn) * corner, t["theta_rad"][k][b] * corner, delta=0.3)

    def test_blocks_move_as_in_a_replay(self):
        self.open_player(self.mixed[0])
        index, _ = self.which()
        for keys in ([], ["ArrowRight"] * 12, ["End"], ["ArrowLeft"] * 7, ["Home", "ArrowRight"]):
            for key in keys:
                self.browser.key(key)
            self.expect_places(index)

    def test_fallen_blocks_are_marked_from_their_fall_on(self):
        cell = self.mixed[0]
        self.open_player(cell)
        index, text = self.which()
        if "collapsed" not in text:
            self.browser.key("n")
            index, text = self.which()
        self.assertIn("collapsed", text)
        self.assertEqual(self.state[self.index.index(index)], 3)
        marked = 'document.querySelectorAll(".player .block.fallen").length'
        self.assertEqual(self.browser.js(marked), 0)
        self.browser.key("End")
        self.assertGreaterEqual(self.browser.js(marked), 1)
        says = self.browser.js('document.querySelector(".player .says").textContent')
        first = min(float(s) for s in re.findall(r"\(([\d.]+) s\)", says))
        self.assertAlmostEqual(first, self.fall[self.index.index(index)], delta=6e-4)
        self.expect_places(index)

    def test_next_and_previous_go_through_the_kept_realizations(self):
        cell = self.mixed[-1]
        self.open_player(cell)
        one, _ = self.which()
        self.browser.key("n")
        other, _ = self.which()
        self.assertNotEqual(one, other)
        fates = {self.state[self.index.index(i)] == 3 for i in (one, other)}
        self.assertEqual(fates, {True, False})
        self.assertTrue(all(self.cell[self.index.index(i)] == cell for i in (one, other)))
        self.browser.key("n")
        self.assertEqual(self.which()[0], other)  # there is no third
        self.browser.click(".player .previous")
        self.assertEqual(self.which()[0], one)

    def play_to_the_end(self, start):
        """Seconds of the page's clock that it took, and the end's time."""
        return self.browser.js(f"""new Promise((done) => {{
            const player = document.querySelector(".player"), began = performance.now();
            let frames = 0;
            player.addEventListener("frame", () => ++frames);
            player.addEventListener("paused", (event) => done([(performance.now() - began) / 1000, event.detail, frames]));
            {start};
        }})""")

    def test_playing_runs_in_real_time_and_slowly(self):
        self.open_player(self.mixed[0])
        self.browser.js('document.querySelector(".player").scrollIntoView()')
        end = float(self.browser.js('document.querySelector(".player .time").textContent').split(" of ")[1].split()[0])
        took, at, frames = self.play_to_the_end('document.querySelector(".player .play").click()')
        self.assertAlmostEqual(at, end, delta=6e-4)
        self.assertGreater(frames, 2)
        self.assertGreater(took, 0.9 * end)  # not faster than the time; a slow machine may take longer
        self.expect_places(self.which()[0])
        self.browser.js('(() => { const s = document.querySelector(".player .speed"); s.value = "0.5"; '
                        's.dispatchEvent(new Event("change")); })()')
        took, at, _ = self.play_to_the_end('document.querySelector(".player .play").click()')
        self.assertAlmostEqual(at, end, delta=6e-4)
        self.assertGreater(took, 1.8 * end)

    def test_space_plays_and_pauses(self):
        self.open_player(self.mixed[0])
        label = 'document.querySelector(".player .play").textContent'
        self.assertEqual(self.browser.js(label), "Play")
        self.browser.js('void (window.framed = new Promise((done) => '
                        'document.querySelector(".player").addEventListener("frame", done, {once: true})))')
        self.browser.key(" ")
        self.assertEqual(self.browser.js(label), "Pause")
        self.browser.js("window.framed.then(() => true)")
        self.browser.key(" ")
        self.assertEqual(self.browser.js(label), "Play")

    def test_scrubbing_goes_to_a_time(self):
        self.open_player(self.mixed[0])
        self.browser.js('(() => { const s = document.querySelector(".player input"); s.value = 11; '
                        's.dispatchEvent(new Event("input")); })()')
        self.expect_places(self.which()[0])
        self.browser.click(".player .strip")  # its middle
        end = float(self.browser.js('document.querySelector(".player .time").textContent').split(" of ")[1].split()[0])
        self.assertAlmostEqual(self.time(), end / 2, delta=0.01 * end)

    # ---- the page around it ----

    def test_series_of_a_figure_can_be_switched_off(self):
        self.browser.hover("figure svg:not(.cells) .key")
        key = self.browser.js('document.querySelector("svg .key").dataset.group')
        self.browser.click("svg .key")
        self.assertEqual(self.browser.js('document.querySelector("svg .key").getAttribute("aria-pressed")'), "false")
        self.assertEqual(self.browser.js('document.querySelector("[data-series=\\"0\\"]").style.display'), "none")
        self.browser.js('document.querySelector("figure svg [data-series]").closest("svg").focus()')
        self.browser.key("End")
        self.assertFalse(any(name.startswith(key) for name in self.tip()))
        self.browser.click("svg .key")
        self.assertEqual(self.browser.js('document.querySelector("[data-series=\\"0\\"]").style.display'), "")

    def test_prints_without_controls(self):
        self.open_cell(self.mixed[0])
        self.browser.look(media="print")
        shown = self.browser.js("""[...document.querySelectorAll("button, input, select, .tip, .player, nav")]
            .filter((e) => e.checkVisibility({contentVisibilityAuto: true})).length""")
        folded = self.browser.js("""[...document.querySelectorAll("details:not(.take, .player *) > :not(summary)")]
            .filter((e) => !e.checkVisibility({contentVisibilityAuto: true})).length""")
        charts = self.browser.js("""[...document.querySelectorAll(".chart, .outcome-bars, .opened")]
            .filter((e) => e.getClientRects().length).length""")
        pictures = self.browser.js("""[...document.querySelectorAll("figure svg, figure img")]
            .filter((e) => e.getClientRects().length).length""")
        self.browser.look(media="")
        self.assertEqual(shown, 0)
        self.assertEqual(folded, 0)
        self.assertEqual(charts, 4)  # slice, falls, outcomes, the mark in the map
        self.assertGreaterEqual(pictures, 4)

    def test_is_dark_where_the_reader_is(self):
        background = "getComputedStyle(document.body).backgroundColor"
        ink = 'getComputedStyle(document.querySelector("figure svg text:not(.on-colour)")).fill'
        light = self.browser.js(background), self.browser.js(ink)
        self.browser.look("dark")
        dark = self.browser.js(background), self.browser.js(ink)
        self.browser.look("light")
        brightness = lambda colour: sum(map(int, re.findall(r"\d+", colour)[:3]))  # noqa: E731
        self.assertGreater(brightness(light[0]), 700)
        self.assertLess(brightness(light[1]), 200)
        self.assertLess(brightness(dark[0]), 120)
        self.assertGreater(brightness(dark[1]), 500)

    def test_fits_a_phone_with_letters_that_can_be_read(self):
        for width in (420, 360):
            self.browser.size(width, 800, phone=True)
            self.open("surface.html")
            self.open_cell(self.mixed[0])
            self.browser.js('for (const one of document.querySelectorAll("details")) one.open = true')
            got = self.browser.js("document.documentElement.scrollWidth"), self.browser.js(LETTERS), self.browser.js(BROKEN)
            self.browser.size(1200, 1600)
            self.assertLessEqual(got[0], width)
            self.assertGreater(got[1]["texts"], 200)
            self.assertEqual(got[1]["small"], [])
            self.assertGreater(got[2]["intervals"], 10)
            self.assertEqual(got[2]["broken"], [])

    def test_all_texts_are_light_in_the_dark(self):
        self.open_cell(self.mixed[0])
        self.browser.look("dark")
        dark = self.browser.js("""(() => {
            const brightness = (colour) => colour.match(/[\\d.]+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0);
            const found = [];
            for (const element of document.querySelectorAll("body *")) {
              const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
              if (!own || !element.checkVisibility() || element.matches(".on-colour, .spoken *, script, option")) continue;
              const look = getComputedStyle(element), colour = element.ownerSVGElement ? look.fill : look.color;
              if (brightness(colour) < 330) found.push([element.tagName, element.textContent.slice(0, 40), colour]);
            }
            for (const ground of document.querySelectorAll(".chart, .player svg, .cell-panel, .chooser select"))
              if (brightness(getComputedStyle(ground).backgroundColor) > 200) found.push(["ground", ground.getAttribute("class")]);
            return found;
        })()""")
        self.browser.look("light")
        self.assertEqual(dark, [])

    def test_has_a_name_for_everything_that_is_operated(self):
        self.open_cell(self.mixed[0])
        nameless = self.browser.js("""[...document.querySelectorAll("button, input, select, [tabindex], img, svg[role]")]
            .filter((e) => !e.textContent.trim() && !e.getAttribute("aria-label") && !e.getAttribute("alt")
                           && !e.querySelector("[aria-label]")).map((e) => e.outerHTML.slice(0, 80))""")
        self.assertEqual(nameless, [])

    def test_works_without_scripts(self):
        self.browser.scripts(False)
        try:
            self.open("surface.html")
        finally:
            self.browser.scripts(True)
        # the debugger's own expressions run all the same
        self.assertIsNone(self.browser.js("document.documentElement.dataset.alive ?? null"))
        self.assertGreaterEqual(self.browser.js("""[...document.querySelectorAll("figure svg, figure img")]
            .filter((e) => e.getClientRects().length).length"""), 4)
        self.assertEqual(self.browser.js('document.querySelectorAll("button, select, .player, .cell-panel").length'), 0)
        self.assertIn("runs no scripts", self.browser.js('document.querySelector("noscript").textContent'))


if __name__ == "__main__":
    main(["program", "studies"], __doc__)
