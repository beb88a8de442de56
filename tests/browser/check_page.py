"""Pages of `stylobate report` without a map in a real browser: what they show under the pointer and under the keys is
what the results file has, nothing is loaded from elsewhere, and no script complains.

    check_page.py PROGRAM STUDIES [TEST...]      the program, the folder of its studies; some tests: Single.test_...

Exit status 77, with a reason, where the browser or h5py is not installed.
"""

import json
import math
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_test import BROKEN, LETTERS, Given, Page, h5py, main, settings, stylobate  # noqa: E402


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


    def test_a_rod_that_only_pushes_leaves_its_block(self):
        stylobate("run", f"{Given.studies}/free_rocking.toml", "-o", self.at("rod.h5"), *settings(
            mechanisms__rod="{block=0,to_right_n_m=2000,height_m=0.16,speed_m_s=0.1,start_s=0.2,travel_m=0.02}"))
        stylobate("export", self.at("rod.h5"), "--to", "html", "-o", self.at("rod.html"))
        self.open("rod.html")
        end = lambda: float(self.browser.js('document.querySelector(".player .fastening").getAttribute("x1")'))
        block = lambda: float(re.findall(r"-?[\d.]+", self.browser.js(
            'document.querySelector(".player .block").getAttribute("transform")'))[0])
        scale = self.browser.js('JSON.parse(document.getElementById("animations").textContent).px_m')
        start = end(), block()
        self.browser.js('document.querySelector(".player .stage").focus()')
        self.browser.key("End")
        self.assertAlmostEqual(end() - start[0], 0.02 * scale, delta=0.5)
        self.assertGreater(block(), start[1])


class Space(Page):
    """A surface of a column in space."""

    @classmethod
    def make(cls):
        stylobate("run", f"{Given.studies}/round_column.toml", "-o", cls.at("round.h5"),
                  *settings(study__realizations=4, surface__frequency_hz="{from=1.0,to=2.0,count=2}",
                            surface__pga_m_s2="{from=5.0,to=8.0,count=2}"))
        stylobate("report", cls.at("round.h5"))

    def test_letters_can_be_read_beside_the_map_and_on_a_phone(self):
        for width, height in ((1400, 800), (420, 800)):
            self.browser.size(width, height, phone=width < 500)
            self.open("round.html")
            self.browser.js("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
            got = self.browser.js("document.documentElement.scrollWidth"), self.browser.js(LETTERS)
            plan = self.browser.js('document.querySelectorAll(".plan text").length')
            self.browser.size(1200, 1600)
            self.assertLessEqual(got[0], width)
            self.assertEqual(plan, 3)
            self.assertEqual(got[1]["small"], [])

    def test_a_browser_without_canvas_is_told(self):
        added = self.browser.send("Page.addScriptToEvaluateOnNewDocument",
                                  {"source": "HTMLCanvasElement.prototype.getContext = () => null;"})
        try:
            self.open("round.html")
        finally:
            self.browser.send("Page.removeScriptToEvaluateOnNewDocument", added)
        self.assertIn("has no canvas", self.browser.js('document.querySelector(".of-player").textContent'))
        self.browser.click('[data-cell="0"]')  # all other parts work
        self.assertTrue(self.browser.js('document.querySelector(".cell-panel h3").textContent').startswith("Cell 0:"))


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
        pressed = """[...document.querySelector("svg .key").closest("svg").querySelectorAll(".key")]
            .filter((key) => key.getAttribute("aria-pressed") === "true")
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
        cells = settings(study__realizations=3, excitation__cycles=5, surface__frequency_hz="{from=1,to=3,count=2}",
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
            self.open(f"{name}.html")
            yield name
            self.assertEqual(self.browser.errors, [], name)

    def test_opens_with_the_answer_and_its_interval(self):
        for name in self.each():
            answer = self.browser.js('document.querySelector(".answer, h2 ~ .box strong").textContent')
            self.assertTrue(answer.strip(), name)
            if name not in ("single", "replay", "survival"):  # one realization; a past that is perhaps not judged
                self.assertRegex(answer, r"\d\s?\S*\sto\s\S*\d|without an interval|open|not determined")

    def test_fits_a_phone_with_letters_that_can_be_read(self):
        self.browser.size(420, 900, phone=True)
        intervals = 0
        try:
            for name in self.each():
                self.assertLessEqual(self.browser.js("document.documentElement.scrollWidth"), 420, name)
                self.assertEqual(self.browser.js(LETTERS)["small"], [], name)
                found = self.browser.js(BROKEN)
                intervals += found["intervals"]
                self.assertEqual(found["broken"], [], name)
        finally:
            self.browser.size(1200, 1600)
        self.assertGreater(intervals, 20)

    def test_settings_are_folded_and_printed(self):
        for name in self.each():
            if name != "risk":
                self.assertEqual(self.browser.js('document.querySelectorAll("details[open]").length'), 0)
            self.browser.js("""void addEventListener("beforeprint", () => {
                window.folded = document.querySelectorAll("details:not([open]):not(.take)").length; })""")
            self.browser.pdf(self.at("page.pdf"))
            self.assertEqual(self.browser.js("window.folded"), 0)
            self.assertEqual(self.browser.js('document.querySelectorAll("details[open]").length'), 0)

    def test_the_structure_is_dark_where_the_page_is(self):
        stone = 'getComputedStyle(document.querySelector(".sketch rect + rect, .sketch path")).fill'
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
