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
from page_test import LETTERS, Given, Page, h5py, main, settings, stylobate  # noqa: E402


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
        shown = """[...document.querySelectorAll("[data-series]")].filter((g) => g.style.display !== "none").length"""
        all_of = self.browser.js(shown)
        self.browser.click(".controls button")  # the fitted curves
        self.assertLess(self.browser.js(shown), all_of)
        self.browser.click(".controls button")
        self.assertEqual(self.browser.js(shown), all_of)


if __name__ == "__main__":
    main(["program", "studies"], __doc__)
