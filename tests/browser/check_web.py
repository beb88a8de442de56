"""The page that runs the engine as WebAssembly (scripts/web.sh) in a real browser: its outcomes have the bits of the
program's, its messages are the program's, and it asks for nothing beside itself.

    check_web.py PROGRAM STUDIES ROOT [TEST...]   the program, the folder of its studies, the root of the sources

Builds the page first. Exit status 77, with a reason, where Emscripten, the browser or h5py is not installed.
"""

import base64
import json
import os
import shutil
import struct
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from page_test import Given, Page, h5py, main, stylobate  # noqa: E402

# soft joints: steps are long, and tests short
COLUMN = """
[study]
kind = "single"
seed = 3
realizations = {realizations}
[structure]
kind = "column"
blocks = 4
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 4e6
normal_damping_ratio = 0.1
tangential_damping_ratio = 0.1
friction = 0.68
[excitation]
kind = "harmonic"
frequency_hz = 4.0
pga_m_s2 = 6.0
ramp_cycles = 2
cycles = 6
[perturbation]
friction = {{ distribution = "normal", cov = 0.10, min = 0.36, max = 0.84, per = "joint" }}
normal_stiffness = {{ distribution = "lognormal", sigma_ln = 0.7, per = "structure" }}
damping_ratio = {{ distribution = "log_uniform", from = 0.05, to = 0.5, per = "structure" }}
drum_width = {{ distribution = "normal", sd_m = 0.0002, per = "block" }}
drum_height = {{ distribution = "normal", sd_m = 0.0002, per = "block" }}
drum_offset = {{ distribution = "normal", sd_m = 0.00024, per = "block" }}
density = {{ distribution = "normal", cov = 0.03, per = "block" }}
tilt = {{ distribution = "normal", sd_rad = 0.0017453, per = "structure" }}
phase = {{ distribution = "uniform", per = "structure" }}
"""


def bits(value):
    """Of a number; which NaN it is does not count."""
    value = float(value)
    return "nan" if value != value else struct.pack("<d", value).hex()


class Web(Page):
    @classmethod
    def make(cls):
        subprocess.run([os.path.join(Given.root, "scripts", "web.sh")], check=True, stdout=subprocess.DEVNULL)
        shutil.copy(os.path.join(Given.root, "build", "web", "index.html"), cls.at("index.html"))

    def setUp(self):
        self.open("index.html")
        self.alive()

    def alive(self):
        self.browser.js("""new Promise((done) => {
            const look = () => document.documentElement.dataset.alive ? done() : setTimeout(look, 20);
            look();
        })""")

    def tearDown(self):
        own = [request for request in self.browser.requests if not request.startswith("blob:")]
        self.browser.requests = own
        super().tearDown()

    def run_here(self, study, workers=2):
        """The outcomes of a study by the page: {index: {name: value}}."""
        found = self.browser.js(f"""(async () => {{
            document.getElementById("study").value = {json.dumps(study)};
            document.getElementById("workers").value = {workers};
            await page.run();
            const names = page.opened.facts.outcome_names.map((one) => one.name);
            const bytes = (numbers) => btoa(String.fromCharCode(...new Uint8Array(numbers.buffer)));
            return [names, page.outcomes.map((one) => [one.index, bytes(one.numbers)]),
                    document.getElementById("answer").textContent];
        }})()""")
        names, outcomes, self.answer = found
        decoded = {index: struct.unpack(f"<{len(names)}d", base64.b64decode(text)) for index, text in outcomes}
        return {index: dict(zip(names, numbers)) for index, numbers in decoded.items()}

    def run_program(self, study, name):
        with open(self.at(name + ".toml"), "w") as file:
            file.write(study)
        stylobate("run", self.at(name + ".toml"), "-o", self.at(name + ".h5"))
        with h5py.File(self.at(name + ".h5")) as file:
            index = file["realizations/index"][:].tolist()
            columns = {column: values[:] for column, values in file["realizations/outcome"].items()
                       if values.shape == (len(index),)}
        return {i: {name: values[row] for name, values in columns.items()} for row, i in enumerate(index)}

    def expect_equal(self, study, name, workers=2):
        there = self.run_program(study, name)
        for fused in (True, False):  # with the processor's multiply-adds where it has them, and without
            self.browser.js(f"""globalThis.modules ??= [...page.engine.modules];
                page.engine.modules = [modules[0], {"modules[1]" if fused else "null"}]""")
            here = self.run_here(study, workers)
            self.assertEqual(sorted(here), sorted(there))
            compared = 0
            for index, outcome in there.items():
                for column in set(outcome) & set(here[index]):
                    self.assertEqual(bits(here[index][column]), bits(outcome[column]),
                                     f"realization {index}, {column}, fused: {fused}")
                    compared += 1
            self.assertGreater(compared, 20 * len(there))
        return there

    def test_200_outcomes_have_the_bits_of_the_program(self):
        outcomes = self.expect_equal(COLUMN.format(realizations=200), "column")
        fallen = sum(outcome["state"] == 3 for outcome in outcomes.values())
        self.assertTrue(20 < fallen < 180, f"{fallen} of 200 fell: both fates are to be compared")
        self.assertIn(f"200 of 200 realizations, {fallen} collapsed", self.answer)

    def test_colonnades_and_mechanisms_have_the_bits_of_the_program(self):
        colonnade = COLUMN.format(realizations=8).replace('kind = "column"', """kind = "colonnade"
columns = 2
column_spacing_m = 0.08
epistyle_height_m = 0.03
epistyle_mass_kg = 0.3""")
        self.expect_equal(colonnade, "colonnade", workers=3)
        self.expect_equal(COLUMN.format(realizations=8) + """
[mechanisms]
stribeck = { dynamic_friction = 0.5, velocity_m_s = 0.05 }
corner_loss = { joint = 0, left_m = 0.005 }
""", "mechanisms", workers=1)

    def test_the_study_of_the_sliders_is_one_of_the_program(self):
        self.browser.js("""for (const [name, value] of [["drums", 2], ["columns", 2]]) {
            const slider = document.querySelector(`#sliders [name="${name}"]`);
            slider.value = value;
            slider.dispatchEvent(new Event("input"));
        }""")
        study = self.browser.js('document.getElementById("study").value')
        self.assertIn("columns = 2", study)
        with open(self.at("sliders.toml"), "w") as file:
            file.write(study)
        stylobate("check", self.at("sliders.toml"))

    def refusal(self):
        return self.browser.js('document.getElementById("refusal").textContent')

    def test_a_study_is_refused_with_the_message_of_the_program(self):
        study = COLUMN.format(realizations=8).replace("friction = 0.68", "fricton = 0.68")
        with open(self.at("study.toml"), "w") as file:
            file.write(study)
        program = subprocess.run([Given.program, "run", "study.toml"], cwd=self.folder.name, stderr=subprocess.PIPE, text=True)
        self.browser.js(f"""document.getElementById("study").value = {json.dumps(study)}; page.show(0)""")
        self.assertEqual(program.stderr.strip(), "stylobate: " + self.refusal().strip())

    def test_a_record_is_refused_with_the_message_of_the_program(self):
        with open(self.at("shaking.txt"), "w") as file:
            file.write("no record of anything\n")
        program = subprocess.run([Given.program, "record", "shaking.txt"], cwd=self.folder.name, stderr=subprocess.PIPE, text=True)
        self.browser.js("""page.takeRecord(new File(["no record of anything\\n"], "shaking.txt"))""")
        self.assertEqual(program.stderr.strip(), "stylobate: " + self.refusal().strip())

    def test_a_record_shakes_as_in_the_program(self):
        text = "".join(f"{k * 0.01:.2f} {3 * (-1) ** (k // 12):g}\n" for k in range(240))
        with open(self.at("table.txt"), "w") as file:
            file.write(text)
        self.browser.js(f"""(async () => {{
            document.getElementById("unit").value = "m/s2";
            await page.takeRecord(new File([{json.dumps(text)}], "table.txt"));
        }})()""")
        with open(self.at("uploaded.toml"), "w") as file:
            file.write(self.browser.js('document.getElementById("study").value'))
        stylobate("check", self.at("uploaded.toml"))
        study = COLUMN.format(realizations=8).replace('kind = "harmonic"', 'kind = "record"\nfile = "table.txt"\nunit = "m/s2"')
        study = study.replace("pga_m_s2 = 6.0", "scale_to_pga_m_s2 = 6.0")
        for line in ("frequency_hz = 4.0", "ramp_cycles = 2", "cycles = 6"):
            study = study.replace(line, "")
        study = "\n".join(line for line in study.splitlines() if not line.startswith("phase"))
        self.expect_equal(study, "record")

    def test_the_address_opens_a_study(self):
        study = COLUMN.format(realizations=5)
        code = base64.urlsafe_b64encode(study.encode()).decode().rstrip("=")
        self.browser.js(f'location.hash = "study={code}"')
        self.assertEqual(self.browser.js("""new Promise((done) => setTimeout(() => done(
            document.getElementById("study").value), 0))"""), study)

    def test_fits_a_narrow_window_and_is_operated_by_keys(self):
        self.browser.size(420, 900, phone=True)
        width = self.browser.js("document.documentElement.scrollWidth")
        self.browser.size(1200, 1600)
        self.assertLessEqual(width, 420)
        reached = set()
        self.browser.js("document.activeElement.blur()")
        for _ in range(60):
            self.browser.key("Tab")
            reached.add(self.browser.js("document.activeElement.name || document.activeElement.id || ''"))
        self.assertLessEqual({"drums", "pga", "record", "show", "run", "study", "download"}, reached)

    def test_is_small(self):
        self.assertLess(os.path.getsize(self.page), 3_000_000)


if __name__ == "__main__":
    if not shutil.which("em++"):
        print("skipped: Emscripten is not installed (scripts/web.sh installs it; Debian: emscripten)")
        sys.exit(77)
    main(("program", "studies", "root"), __doc__)
