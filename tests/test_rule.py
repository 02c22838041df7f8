"""test_rule.py: apps/study/rule.py on made-up ensembles that follow known laws. Needs numpy."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "apps" / "study"))
import numpy as np  # noqa: E402
import rule  # noqa: E402

CORE = 4.0     # error = CORE (d / (D theta))^2
SPREAD = 0.25  # of runs: SPREAD / sqrt(grains)


def ensembles(random, law, seeds=lambda angle: 3, spread=SPREAD):
    """Vessels of 20, 30, 40 d, of 23 (D/d)^2 (D/d) / 20 grains, with sectors whose packing is 0.6 (1 + law(D/d, D0/d, theta))."""
    made = {}
    for width in (20, 30, 40):
        for angle in [360] + rule.ANGLES:
            grains = 1.15 * width**3
            error = 0 if angle == 360 else law(width, 8, np.radians(angle))
            made["angle", width, 8, angle] = [
                {("settle", "grains"): grains,
                 ("settle", "packing"): 0.6 * (1 + error) * (1 + spread / np.sqrt(grains * angle / 360) * random.normal())}
                for _ in range(seeds(angle))]
    return made


class Rules(unittest.TestCase):
    def test_the_law_that_made_the_errors_is_found_and_its_error_bar_holds(self):
        random = np.random.default_rng(1)
        law = lambda w, o, t: CORE / (w * t) ** 2
        pulls, chi2s, others = [], [], []
        for _ in range(200):
            rows, c = rule.errors_of(ensembles(random, law), "packing", "settle")
            a, error, chi2 = rule.fit(rows, rule.SHAPES["core"])
            pulls.append((a - CORE) / error)
            chi2s.append(chi2)
            others.append(rule.fit(rows, rule.SHAPES["seam"])[2])
            self.assertAlmostEqual(c, SPREAD, delta=0.1)
        self.assertAlmostEqual(np.mean(pulls), 0, delta=0.25)
        self.assertAlmostEqual(np.std(pulls), 1, delta=0.25)
        self.assertAlmostEqual(np.mean(chi2s), 1, delta=0.15)
        self.assertGreater(np.mean(others), 3)

    def test_sectors_of_one_vessel_share_the_error_of_its_full_vessels(self):
        random = np.random.default_rng(2)
        # No law at all, few full vessels, many sectors: what looks like an error common to all angles is that of the full ones.
        pulls = []
        for _ in range(200):
            rows, _ = rule.errors_of(ensembles(random, lambda w, o, t: 0, lambda angle: 1 if angle == 360 else 12, 5.0), "packing", "settle")
            a, error, chi2 = rule.fit(rows, lambda w, o, t: 1)
            pulls.append(a / error)
        self.assertLess(np.std(pulls), 1.3)

    def test_errors_are_those_of_the_means(self):
        made = {("angle", 20, 8, 360): [{("settle", "grains"): 8000.0, ("settle", "packing"): v} for v in (0.59, 0.61)],
                ("angle", 20, 8, 90): [{("settle", "grains"): 8000.0, ("settle", "packing"): v} for v in (0.65, 0.67)]}
        (row,), _ = rule.errors_of(made, "packing", "settle")
        self.assertAlmostEqual(row.error, 0.1)
        self.assertEqual((row.width, row.orifice, row.sectors), (20, 8, 2))
        self.assertAlmostEqual(row.theta, np.pi / 2)

    def test_flows_are_of_runs_that_flow(self):
        runs = [{("flow_mean", "discharge_rate"): 5.0, ("flow_mean", "arched"): 0.0},
                {("flow_mean", "discharge_rate"): 1.0, ("flow_mean", "arched"): 1.0}]
        self.assertEqual(rule.flowing(runs, "discharge_rate", "flow_mean"), [5.0])

    def test_the_share_that_arches_is_found_and_its_error_bar_holds(self):
        pulls = []
        for seed in range(40):
            random = np.random.default_rng(seed)
            x = random.uniform(0, 8, 300)
            y = (random.uniform(size=300) < 1 / (1 + np.exp((x - 3) / 0.5))).astype(float)
            middle, error, width, _ = rule.logistic(x, y)
            pulls.append((middle - 3) / error)
            self.assertAlmostEqual(width, 0.5, delta=0.35)
        self.assertAlmostEqual(np.mean(pulls), 0, delta=0.5)
        self.assertAlmostEqual(np.std(pulls), 1, delta=0.35)


if __name__ == "__main__":
    unittest.main()
