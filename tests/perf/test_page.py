"""test_page.py: the page of speed against error, perf/speed_error/page.py, from made-up results. Needs numpy and matplotlib."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "perf" / "speed_error"))
import figure  # noqa: E402
import page  # noqa: E402
from results import Results, Sample, difference, trend  # noqa: E402

COLUMNS = "kind,scene,step,young,skin,angle,axis,precision,damping,speed,seed,quantity,value\n"
STANDARD = {"step": 10, "young": 1e7, "skin": 0, "angle": 360, "axis": "clamp", "precision": "double"}
PACKING = {2: (0.50, 0.52, 0.51, 0.53), 10: (0.51, 0.53, 0.52, 0.50), 40: (0.60, 0.61, 0.62, 0.60)}  # of the step, four seeds


class Folder:
    """Results of two scenes: beds at three steps, impacts, one race, one bed at rest, one drift."""

    def __init__(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.scratch.name)
        setup = "".join(f",{item},{value}\n" for item, value in {**STANDARD, "impact_places": 3, "discharged": 200}.items())
        for scene in ("hopper", "pile"):
            setup += f'{scene},file,{scene}.toml\n{scene},set,"wall.floor.profile=[[""4 d"", 0]]"\n{scene},set,n=4\n'
            self.add_scene(scene)
        (self.path / "setup.csv").write_text("scene,item,value\n" + setup)

    def add(self, name, kind, scene, numbers, damping="", speed="", seed=1, **varied):
        start = ",".join(str(cell) for cell in (kind, scene, *{**STANDARD, **varied}.values(), damping, speed, seed))
        (self.path / f"{name}.csv").write_text(COLUMNS + "".join(f"{start},{key},{value}\n" for key, value in numbers.items()))

    def add_scene(self, scene):
        for step, values in PACKING.items():
            for seed, packing in enumerate(values, 1):
                numbers = {"packing": packing, "stress": 1, "heat": 1e-12, "bed_rests": 1, "residual_end": 0.01, "broke": 0}
                numbers["rate"] = "nan" if seed == 1 else 100 + seed
                self.add(f"{scene}_{step}_{seed}", "bed", scene, numbers, seed=seed, step=step)
            for speed in (0.1, 1):
                numbers = {"restitution": step / 1000, "restitution_error": 0.001, "spin": 0.002, "spin_error": 0, "contact_steps": 36}
                self.add(f"{scene}_impact_{step}_{speed}", "impact", scene, numbers, speed=speed, step=step)
        race = {f"speed_{phase}{end}": value for phase in ("rest", "flow") for end, value in (("", 1), ("_low", 0.9), ("_high", 1.1))}
        self.add(f"{scene}_race", "race", scene, race)
        self.add(f"{scene}_stability", "stability", scene, {"overlap": 0.003, "heat10": 1e-7, "heat15": 0.2, "heat20": "inf"}, damping=0.3)
        drift = {f"after{n}{end}": 1e-9 for n in (10, 100, 1000) for end in ("", "_largest")}
        self.add(f"{scene}_drift", "drift", scene, drift, precision="nudged")


class Statistics(unittest.TestCase):
    def test_welch(self):
        # Equal spreads and numbers: 2 (n - 1) degrees of freedom; t of 99 % with 6 is 3.707 (Abramowitz & Stegun, table 26.10).
        d = difference(Sample([2, 3, 4, 5]), Sample([1, 2, 3, 4]))
        self.assertAlmostEqual(d.value, 1 / 2.5)
        self.assertAlmostEqual(d.standard_error, math.sqrt(2 * 5 / 3 / 4) / 2.5)
        self.assertAlmostEqual(d.bound / d.standard_error, 3.707, places=3)

    def test_what_cannot_be_compared(self):
        self.assertIsNone(difference(Sample([1]), Sample([1, 2])))
        self.assertIsNone(difference(Sample([1, 2]), Sample([math.nan, 2])))
        self.assertIsNone(difference(Sample([1, 2]), Sample([-1, 1])))
        self.assertIsNone(trend([1, 2, 3], [1, 2, 3]))

    def test_trend(self):
        # Slope 0.4 with residuals 0.6 -0.8 -0.2 0.4: squares 1.2, with two degrees of freedom; t of 99 % is 9.925.
        d = trend([1, 2, 3, 4], [3, 2, 3, 4])
        self.assertAlmostEqual(d.value, 0.4 / 3)
        self.assertAlmostEqual(d.standard_error, math.sqrt(1.2 / 2 / 5) / 3)
        self.assertAlmostEqual(d.bound / d.standard_error, 9.925, places=3)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        cls.results = Results(cls.folder.path)
        cls.text = page.Page(cls.results, quick=True).text("commit x", "quick.svg")

    def rows(self, start):
        return [[cell.strip() for cell in line.split("|")[1:-1]] for line in self.text.splitlines() if line.startswith("| " + start)]

    def test_cells(self):
        self.assertEqual(self.rows("2 %, reference")[0][4], "0.515 ± 0.0065")
        same, other = self.rows("10 %")[0], self.rows("40 %")[0]
        self.assertEqual(same[1:5], ["1", "1.00 (0.90 to 1.10)", "1.00 (0.90 to 1.10)", "+0 ± 1.8"])
        self.assertEqual(other[1:5], ["4", "-", "-", "**+18 ± 1.6**"])  # 0.6075 / 0.515, two standard errors of 0.0065 and 0.0048
        self.assertEqual(same[-5:], ["1e-12", "4 of 4", "1", "0 of 4", "0 of 0"])
        self.assertIn("hopper, 4 seeds, reference 2 %:", self.text)

    def test_runs_without_a_number_do_not_count(self):
        self.assertTrue(self.rows("2 %, reference")[0][9].startswith("103 ± "))  # of 102, 103, 104

    def test_other_tables(self):
        self.assertEqual(self.rows("10 |")[0], ["10", "36, 36", "1 ± 0.1", "1 ± 0.1", "0.2 ± 0", "0.2 ± 0"])
        self.assertEqual(self.rows("hopper | 1e7")[0], ["hopper", "1e7", "0.3", "0.003", "rests", "**2e-1**", "**stopped**"])
        self.assertEqual(self.rows("pile | double, places")[0][2], "1.0e-09 (one seed), largest 1.0e-09")

    def test_introduction_names_the_changes_of_the_scenes(self):
        self.assertIn("      --set 'wall.floor.profile=[[\"4 d\", 0]]'\n      --set 'n=4'\n", self.text)
        self.assertIn("speed_error.sh --quick`\n(commit x)\n", self.text)

    def test_lines_are_short_outside_tables(self):
        self.assertEqual([line for line in self.text.splitlines() if len(line) > 120 and line[0] != "|"], [])

    def test_small_powers(self):
        self.assertEqual([page.short_power(x) for x in (1e7, 3e6, 2.4e-13, 0.06, 0, 1e12)], ["1e7", "3e6", "2e-13", "6e-2", "0e0", "1e12"])

    def test_figure_and_what_stands_by_hand(self):
        base = self.folder.path / "out"
        base.with_suffix(".md").write_text("old\n" + page.BY_HAND + "\n\nkept\n")
        sys.argv = ["page.py", str(self.folder.path), str(base), "commit x"]
        page.main()
        text = base.with_suffix(".md").read_text()
        self.assertTrue(text.endswith(page.BY_HAND + "\n\nkept\n"))
        self.assertNotIn("old\n", text)
        self.assertIn("</svg>", base.with_suffix(".svg").read_text())

    def test_no_results(self):
        with tempfile.TemporaryDirectory() as empty, self.assertRaises(FileNotFoundError):
            Results(empty)


if __name__ == "__main__":
    unittest.main()
