"""The page of `stylobate report` in a real browser: what it shows under the pointer and under the keys is what the
results file has, blocks move as a replay of the same realization says, nothing is loaded from elsewhere, and no script
complains.

    check_page.py PROGRAM STUDIES [TEST...]      the program, the folder of its studies; some tests: Surface.test_...

Exit status 77, with a reason, where the browser or h5py is not installed.
"""

import json
import math
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_test import Given, Page, h5py, main, stylobate  # noqa: E402


def settings(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


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
        self.browser.js('document.querySelector("svg.cells").focus()')
        for keys, cell in ((["ArrowRight", "ArrowUp"], 5), (["ArrowUp"], 6), (["ArrowLeft", "ArrowLeft"], 2),
                           (["ArrowDown"] * 9, 0)):
            for key in keys:
                self.browser.key(key)
            self.expect_cell(self.tip(), cell)
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
        self.browser.key("Escape")
        self.assertFalse(self.browser.js('!!document.querySelector(".cell-panel")'))
        self.assertEqual(self.browser.js("document.activeElement.getAttribute('class')"), "cells")

    def test_a_cell_with_one_fate_says_how_to_replay_it(self):
        cell = next(c for c in range(16) if c not in self.mixed)
        self.open_cell(cell)
        text = self.browser.js('document.querySelector(".cell-panel").textContent')
        command = re.search(r"stylobate (replay surface\.h5 --frequency \S+ --pga \S+)", text).group(1)
        done = subprocess.run([Given.program, *command.split(), "--json"], cwd=self.folder.name, check=True,
                              stdout=subprocess.PIPE)
        self.assertEqual(self.cell[self.index.index(json.loads(done.stdout)["realization"])], cell)

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
        self.open_cell(self.mixed[0])
        index, _ = self.which()
        for keys in ([], ["ArrowRight"] * 12, ["End"], ["ArrowLeft"] * 7, ["Home", "ArrowRight"]):
            for key in keys:
                self.browser.key(key)
            self.expect_places(index)

    def test_fallen_blocks_are_marked_from_their_fall_on(self):
        cell = self.mixed[0]
        self.open_cell(cell)
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
        self.open_cell(cell)
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
        self.open_cell(self.mixed[0])
        self.browser.js('document.querySelector(".player").scrollIntoView()')
        end = float(self.browser.js('document.querySelector(".player .time").textContent').split(" of ")[1].split()[0])
        took, at, frames = self.play_to_the_end('document.querySelector(".player .play").click()')
        self.assertAlmostEqual(at, end, delta=6e-4)
        self.assertGreater(frames, 2)
        self.assertGreater(took, 0.9 * end)  # not faster than the time; a slow machine may take longer
        self.expect_places(self.which()[0])
        self.browser.js('(() => { const s = document.querySelector(".player select"); s.value = "0.5"; '
                        's.dispatchEvent(new Event("change")); })()')
        took, at, _ = self.play_to_the_end('document.querySelector(".player .play").click()')
        self.assertAlmostEqual(at, end, delta=6e-4)
        self.assertGreater(took, 1.8 * end)

    def test_space_plays_and_pauses(self):
        self.open_cell(self.mixed[0])
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
        self.open_cell(self.mixed[0])
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
        shown = self.browser.js("""[...document.querySelectorAll("button, input, select, .tip, .player, .cell-panel, nav")]
            .filter((e) => e.getClientRects().length).length""")
        pictures = self.browser.js("""[...document.querySelectorAll("figure svg, figure img")]
            .filter((e) => e.getClientRects().length).length""")
        self.browser.look(media="")
        self.assertEqual(shown, 0)
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

    def test_fits_a_phone(self):
        self.browser.size(360, 740, phone=True)
        self.open("surface.html")
        self.open_cell(self.mixed[0])
        width = self.browser.js("document.documentElement.scrollWidth")
        self.browser.size(1200, 1600)
        self.assertLessEqual(width, 360)

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
        self.assertEqual(self.browser.js('document.querySelectorAll("button, .player").length'), 0)
        self.assertIn("runs no scripts", self.browser.js('document.querySelector("noscript").textContent'))


class Single(Page):
    @classmethod
    def make(cls):
        stylobate("run", f"{Given.studies}/free_rocking.toml", "-o", cls.at("one.h5"))
        stylobate("report", cls.at("one.h5"))

    def test_history_has_the_values_of_the_trajectory(self):
        self.open("one.html")
        with h5py.File(self.at("one.h5")) as file:
            t = file["trajectories/0"]
            time, x, rest = t["time_s"][:], t["x_m"][:], t["rest_x_m"][:]
        self.browser.js('document.querySelector("figure svg [data-series]").closest("svg").focus()')
        for key in ["Home"] + ["ArrowRight"] * 40:
            self.browser.key(key)
        tip = self.tip()
        at = float(tip["title"].split(": ")[1])
        k = min(range(len(time)), key=lambda i: abs(time[i] - at))
        value = next(float(text) for name, text in tip.items() if name.startswith("drum"))
        self.assertAlmostEqual(value, x[k][0] - rest[0], delta=6e-4 * abs(x[k][0] - rest[0]) + 1e-9)
        self.assertGreater(abs(value), 1e-6)

    def test_its_realization_moves(self):
        self.open("one.html")
        place = 'document.querySelector(".player .block").getAttribute("transform")'
        before = self.browser.js(place)
        self.browser.js('document.querySelector(".player .stage").focus()')
        self.browser.key("End")
        self.assertNotEqual(self.browser.js(place), before)


    def test_a_page_of_one_realization_alone(self):
        stylobate("export", self.at("one.h5"), "--to", "html", "-o", self.at("alone.html"))
        self.open("alone.html")
        with h5py.File(self.at("one.h5")) as file:
            theta = file["trajectories/0/theta_rad"][0][0]
        turn = self.browser.js('document.querySelector(".player .block").getAttribute("transform")')
        self.assertAlmostEqual(-float(re.findall(r"-?[\d.]+", turn)[2]), math.degrees(theta), delta=0.05)


class Fragility(Page):
    @classmethod
    def make(cls):
        study = [Given.program, "run", f"{Given.studies}/fragility_column.toml", "-o", cls.at("curves.h5"),
                 *settings(fragility__motions=12, study__realizations=6, contact__normal_stiffness_n_m2="1e8",
                           fragility__intensity='{from=0.4,to=2.5,count=6,spacing="log"}')]
        subprocess.run([*study, "--quiet"], check=True)
        stylobate("report", cls.at("curves.h5"))
        done = subprocess.run([*study, "--json"], check=True, stdout=subprocess.PIPE)  # complete: it is only told
        cls.states = json.loads(done.stdout)["fragility"]["states"]

    def test_points_are_the_shares_of_the_stripes(self):
        self.open("curves.html")
        collapse = next(s for s in self.states if s["name"] == "collapse")
        self.browser.js('document.querySelector("figure svg [data-series]").closest("svg").focus()')
        self.browser.key("End")
        while True:  # back to the strongest stripe: curves reach further
            tip = self.tip()
            shares = {name: text for name, text in tip.items() if name.endswith("shares of the stripes")}
            if shares:
                break
            self.browser.key("ArrowLeft")
        text = next(text for name, text in shares.items() if name.startswith(collapse["limit_state"]))
        stripe = collapse["stripes"][-1]
        self.assertAlmostEqual(float(text.split()[0]), stripe["reached"] / stripe["trials"], delta=1e-3)

    def test_layers_can_be_switched_off_and_the_lack_of_fit_is_said(self):
        self.open("curves.html")
        legend = self.browser.js('[...document.querySelectorAll("svg .key")].map((key) => key.textContent.trim())')
        for state in self.states:
            if state["curve"] and (state["name"].startswith("peak") or state["name"] == "collapse"):
                entry = next(text for text in legend if text.startswith(state["limit_state"]))
                p = float(re.search(r"p = ([-\d.e]+)", entry).group(1))
                self.assertAlmostEqual(p, state["lack_of_fit_p"], delta=0.06 * state["lack_of_fit_p"])
                self.assertEqual("does not fit" in entry, state["lack_of_fit_p"] < 0.05)
        # one limit state at first, the collapse; the legend switches the others on
        pressed = """[...document.querySelectorAll("svg .key")].filter((key) => key.getAttribute("aria-pressed") === "true")
            .map((key) => key.textContent.trim())"""
        collapse = next(s for s in self.states if s["name"] == "collapse")["limit_state"]
        self.assertEqual([text.startswith(collapse) for text in self.browser.js(pressed)], [True])
        shown = """[...document.querySelectorAll("[data-series]")].filter((g) => g.style.display !== "none").length"""
        one = self.browser.js(shown)
        self.browser.click("svg .key:nth-of-type(2)")
        self.assertEqual(len(self.browser.js(pressed)), 2)
        self.assertGreater(self.browser.js(shown), one)
        all_of = self.browser.js(shown)
        self.browser.click(".controls button")  # the fitted curves
        self.assertLess(self.browser.js(shown), all_of)
        self.browser.click(".controls button")
        self.assertEqual(self.browser.js(shown), all_of)


class EveryKind(Page):
    """What holds on the page of every kind of result."""

    @classmethod
    def make(cls):
        fragility = settings(fragility__motions=9, study__realizations=2,
                             fragility__intensity='{measure="pgv",from=0.4,to=4,count=4,spacing="log"}')
        cells = settings(study__realizations=3, excitation__cycles=3, surface__frequency_hz="{from=1,to=3,count=2}",
                         surface__pga_m_s2="{from=4,to=12,count=2}")
        studies = Given.studies
        stylobate("run", f"{studies}/free_rocking.toml", "-o", cls.at("single.h5"))
        stylobate("run", f"{studies}/doric_column.toml", "-o", cls.at("surface.h5"), *cells)
        stylobate("run", f"{studies}/doric_column.toml", "-o", cls.at("one_cell.h5"), *cells,
                  *settings(surface__frequency_hz="{from=1,to=1,count=1}", surface__pga_m_s2="{from=9,to=9,count=1}"))
        stylobate("run", f"{studies}/doric_column.toml", "-o", cls.at("counts.h5"), *cells,
                  *settings(output__realizations='"none"'))
        stylobate("run", f"{studies}/round_column.toml", "-o", cls.at("space.h5"), *cells)
        stylobate("run", f"{studies}/monument_risk.toml", "-o", cls.at("fragility.h5"), *fragility)
        stylobate("replay", cls.at("fragility.h5"), "--realization", 20, "-o", cls.at("replay.h5"))
        stylobate("risk", cls.at("fragility.h5"), "--hazard", "k0=1e-3,k=3,measure=pgv,sigma_ln=0.5", "-o",
                  cls.at("risk.h5"))
        stylobate("run", f"{studies}/sensitivity_column.toml", "-o", cls.at("sensitivity.h5"),
                  *settings(sensitivity__samples=8, excitation__cycles=4, excitation__ramp_cycles=1))
        stylobate("run", f"{studies}/monument_past.toml", "-o", cls.at("survival.h5"),
                  *settings(study__realizations=4, survival__events=1, surface__frequency_hz="{from=0.5,to=1.5,count=2}",
                            surface__pga_m_s2="{from=2,to=20,count=4}"))
        stylobate("compare", f"{studies}/strengthening_dowels.toml", "-o", cls.at("comparison.h5"), *cells)
        cls.pages = ["single", "surface", "one_cell", "counts", "space", "fragility", "replay", "risk", "sensitivity",
                     "survival", "comparison"]
        for name in cls.pages:
            stylobate("report", cls.at(f"{name}.h5"))

    def each(self):
        for name in self.pages:
            with self.subTest(page=name):
                self.open(f"{name}.html")
                yield name
                self.assertEqual(self.browser.errors, [])

    def test_opens_with_the_answer_and_its_interval(self):
        for name in self.each():
            answer = self.browser.js('document.querySelector("h2 + .box strong, h2 + p ~ .box strong").textContent')
            self.assertTrue(answer.strip(), name)
            if name not in ("single", "replay", "survival"):  # one realization; a past that is perhaps not judged
                self.assertRegex(answer, r"\d\s?\S* to \S*\d|without an interval|open|not determined")

    def test_fits_a_narrow_screen(self):
        self.browser.size(420, 900, phone=True)
        try:
            for _ in self.each():
                self.assertLessEqual(self.browser.js("document.documentElement.scrollWidth"), 420)
                self.assertEqual(self.browser.js("""(() => {
                    const small = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
                    while (walk.nextNode()) {
                        const of = walk.currentNode.parentElement;
                        if (!walk.currentNode.textContent.trim() || !of.getClientRects().length) continue;
                        if (of.closest("svg, script, noscript")) continue;
                        if (parseFloat(getComputedStyle(of).fontSize) < 10.95) small.push(of.outerHTML.slice(0, 80));
                    }
                    return small;
                })()"""), [])
        finally:
            self.browser.size(1200, 1600)

    def test_no_line_breaks_inside_an_interval(self):
        self.browser.size(420, 900, phone=True)
        intervals = 0
        try:
            for _ in self.each():
                found = self.browser.js("""(() => {
                    const broken = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
                    let all = 0;
                    while (walk.nextNode()) {
                        const node = walk.currentNode;
                        if (node.parentElement.closest("script, svg, pre, code")) continue;
                        for (const one of node.textContent.matchAll(/[-+]?[\\d.]+\\sto\\s[-+]?[\\d.]+/g)) {
                            const range = document.createRange();
                            range.setStart(node, one.index);
                            range.setEnd(node, one.index + one[0].length);
                            const lines = new Set([...range.getClientRects()].map((box) => Math.round(box.top)));
                            if (lines.size > 1) broken.push(one[0]);
                            ++all;
                        }
                    }
                    return [all, broken];
                })()""")
                intervals += found[0]
                self.assertEqual(found[1], [])
        finally:
            self.browser.size(1200, 1600)
        self.assertGreater(intervals, 30)

    def test_settings_are_folded_and_printed(self):
        for name in self.each():
            if name != "risk":
                self.assertEqual(self.browser.js('document.querySelectorAll("details[open]").length'), 0)
            self.browser.js("""void addEventListener("beforeprint", () => {
                window.folded = document.querySelectorAll("details:not([open])").length; })""")
            self.browser.pdf(self.at("page.pdf"))
            self.assertEqual(self.browser.js("window.folded"), 0)
            self.assertEqual(self.browser.js('document.querySelectorAll("details[open]").length'), 0)

    def test_the_structure_is_dark_where_the_page_is(self):
        stone = 'getComputedStyle(document.querySelector(".sketch rect + rect, .sketch polygon")).fill'
        brightness = lambda colour: sum(map(int, re.findall(r"\d+", colour)[:3]))  # noqa: E731
        for name in self.each():
            if name == "risk":
                continue
            light = brightness(self.browser.js(stone))
            self.browser.look("dark")
            dark = brightness(self.browser.js(stone))
            self.browser.look("light")
            self.assertLess(dark, light - 150)

    def test_a_comparison_shows_what_differs(self):
        self.open("comparison.html")
        self.assertEqual(self.browser.js('document.querySelectorAll(".beside .sketches").length'), 4)
        marks = self.browser.js('[...document.querySelectorAll(".marks-list")].map((e) => e.textContent.trim())')
        self.assertEqual(len(marks), 3)  # the base has none
        self.assertTrue(all(text.startswith("dowel (all 9 joints)") for text in marks), marks)
        rows = self.browser.js("""[...[...document.querySelectorAll("caption")].find((c) => c.textContent.includes("keys"))
            .parentElement.rows].map((row) => [...row.cells].map((cell) => cell.textContent))""")
        self.assertEqual(rows[0][0], "key")
        for row in rows[1:]:
            self.assertGreater(len(set(row[1:])), 1, row)
            self.assertTrue(row[0].startswith("mechanisms."), row)
        gap = next(row for row in rows if row[0] == "mechanisms.dowel.gap_m")
        self.assertEqual(dict(zip(rows[0], gap)), {"key": "mechanisms.dowel.gap_m", "strengthening_dowels": "–",
                                                   "bonded_dowels": "0", "dowels": "0.001", "loose_dowels": "0.02"})

    def test_realizations_of_a_fragility_study_have_their_motion(self):
        self.open("fragility.html")
        self.assertRegex(self.browser.js('document.querySelector(".player .which").textContent'),
                         r"Realization \d+, motion \S+ at PGV [\d.]+ m/s: ")
        self.open("replay.html")
        self.assertRegex(self.browser.js('document.querySelector("figcaption + *, figcaption").closest("main").textContent'),
                         r"Realization 20, motion \S+ at PGV [\d.]+ m/s")


if __name__ == "__main__":
    main(["program", "studies"], __doc__)
