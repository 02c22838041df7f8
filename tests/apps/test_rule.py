"""test_rule.py: apps/study/rule.py on made-up ensembles that follow known laws. Needs numpy."""
import contextlib
import io
import lzma
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "study"))
import numpy as np  # noqa: E402
import rule  # noqa: E402

ORDERS = (2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 24)
ZONE = 4.0     # error = ZONE (d / (D theta))^2
SPREAD = 0.25  # of runs: SPREAD / sqrt(grains)


def ensembles(random, law, seeds=lambda order: 3, spread=SPREAD):
    """Vessels of 20, 30, 40 d, of 1.15 (D/d)^3 grains, with sectors whose packing is 0.6 (1 + law(D/d, D0/d, theta))."""
    made = {}
    for width in (20, 30, 40):
        for order in (rule.FULL, *ORDERS):
            grains = 1.15 * width**3
            error = 0 if order == rule.FULL else law(width, 8, 2 * np.pi / order)
            made["angle", width, 8, order] = [
                {("settle", "grains"): grains,
                 ("settle", "packing"): 0.6 * (1 + error) * (1 + spread / np.sqrt(grains / order) * random.normal())}
                for _ in range(seeds(order))]
    return made


class Rules(unittest.TestCase):
    def test_the_law_that_made_the_errors_is_found_and_its_error_bar_holds(self):
        random = np.random.default_rng(1)
        law = lambda w, o, t: ZONE / (w * t) ** 2
        pulls, chi2s, others = [], [], []
        for _ in range(200):
            rows, c = rule.errors_of(ensembles(random, law), "packing", "settle")
            a, error, chi2 = rule.fit(rows, rule.SHAPES["axis zone"])
            pulls.append((a - ZONE) / error)
            chi2s.append(chi2)
            others.append(rule.fit(rows, rule.SHAPES["seam"])[2])
            self.assertAlmostEqual(c, SPREAD, delta=0.1)
        self.assertAlmostEqual(np.mean(pulls), 0, delta=0.25)
        self.assertAlmostEqual(np.std(pulls), 1, delta=0.25)
        self.assertAlmostEqual(np.mean(chi2s), 1, delta=0.15)
        self.assertGreater(np.mean(others), 3)

    def test_sectors_of_one_vessel_share_the_error_of_its_full_vessels(self):
        random = np.random.default_rng(2)
        # No law at all, few full vessels, many sectors: what looks like an error of all angles is that of the full ones.
        pulls = []
        for _ in range(200):
            made = ensembles(random, lambda w, o, t: 0, lambda order: 1 if order == rule.FULL else 12, 5.0)
            rows, _ = rule.errors_of(made, "packing", "settle")
            a, error, chi2 = rule.fit(rows, lambda w, o, t: 1)
            pulls.append(a / error)
        self.assertLess(np.std(pulls), 1.3)

    def test_errors_are_those_of_the_means(self):
        made = {("angle", 20, 8, order): [{("settle", "grains"): 8000.0, ("settle", "packing"): v} for v in values]
                for order, values in ((rule.FULL, (0.59, 0.61)), (4, (0.65, 0.67)))}
        (row,), _ = rule.errors_of(made, "packing", "settle")
        self.assertAlmostEqual(row.error, 0.1)
        self.assertEqual((row.width, row.orifice, row.sectors), (20, 8, 2))
        self.assertAlmostEqual(row.theta, np.pi / 2)

    def test_one_run_has_the_spread_of_all_and_many_runs_their_own(self):
        random = np.random.default_rng(4)
        made = ensembles(random, lambda w, o, t: 0, lambda order: 1 if order == 24 else 40)
        rows, c = rule.errors_of(made, "packing", "settle")
        for row in rows:
            grains = 1.15 * row.width**3 * row.theta / (2 * np.pi)
            if row.sectors == 1:
                self.assertAlmostEqual(row.of_sectors * np.sqrt(grains) / c, 1)
            else:
                key = (*row.vessel, round(2 * np.pi / row.theta))
                own = rule.relative_spread([r["settle", "packing"] for r in made[key]]) / np.sqrt(40)
                self.assertAlmostEqual(row.of_sectors / own, 1, delta=0.05)

    def test_rates_spread_with_the_grains_over_the_orifice(self):
        runs = [{("settle", "grains"): 1000.0}]
        self.assertEqual(rule.size_of(("angle", 20, 8, 4), runs, "discharge_rate"), 16)
        self.assertEqual(rule.size_of(("angle", 20, 8, 4), runs, "packing"), 250)

    def test_at_rest_beds_that_differ_by_the_orifice_alone_count_once(self):
        runs = [{("settle", "packing"): 0.6, ("flow_mean", "packing"): 0.5, ("flow_mean", "arched"): 0.0}]
        for orifice in (6, 8, 12):
            key = ("angle", 40, orifice, 4)
            self.assertEqual(rule.values_of(key, runs, "packing", "settle"), [0.6] if orifice == 8 else [])
            self.assertEqual(rule.values_of(key, runs, "packing", "flow_mean"), [0.5])

    def test_flows_are_of_runs_that_neither_arch_nor_pause(self):
        runs = [{("flow_mean", "discharge_rate"): 5.0, ("flow_mean", "arched"): 0.0, ("flow_mean", "interrupted"): 0.0},
                {("flow_mean", "discharge_rate"): 1.0, ("flow_mean", "arched"): 1.0, ("flow_mean", "interrupted"): 0.0},
                {("flow_mean", "discharge_rate"): 2.0, ("flow_mean", "arched"): 0.0, ("flow_mean", "interrupted"): 1.0}]
        self.assertEqual(rule.values_of(("angle", 20, 8, 4), runs, "discharge_rate", "flow_mean"), [5.0])

    def test_a_pause_is_a_tenth_of_a_second_with_less_than_a_quarter_of_the_mean_rate(self):
        time = 0.7 + 0.05 * np.arange(17)
        rates = np.full(16, 1000.0)
        out = lambda: np.concatenate([[0], np.cumsum(rates * 0.05)])
        self.assertFalse(rule.interrupted(time, out()))
        rates[7] = 0
        self.assertFalse(rule.interrupted(time, out()))  # 0.05 s alone
        rates[8] = 400
        self.assertTrue(rule.interrupted(time, out()))   # 200 in the mean over 0.1 s, of 900
        rates[8] = 500
        self.assertFalse(rule.interrupted(time, out()))

    def test_rules_of_flows_are_of_sectors_with_an_arc_of_2_d_at_the_rim(self):
        rows = [rule.Row((), 20, 8, theta, 0, 1, 1, 1) for theta in (0.49, 0.51)]
        self.assertEqual([r.theta for r in rule.ruled(rows, "flow_mean")], [0.51])
        self.assertEqual(len(rule.ruled(rows, "settle")), 2)

    def test_shapes_are_what_their_names_say(self):
        at = {name: shape(20, 8, 0.5) for name, shape in rule.SHAPES.items()}
        self.assertEqual(at, {"axis zone": 1 / 100, "seam": 1 / 10, "flow": 1 / 16, "flow4": 1 / 256})

    def test_a_scatter_beyond_the_error_bars_widens_the_error_of_the_factor(self):
        rows = [rule.Row(k, 20, 8, 1, error, 0.01, 0, 1) for k, error in enumerate((-0.1, 0.1, -0.1, 0.1))]
        a, error, chi2 = rule.fit(rows, lambda w, o, t: 1)
        self.assertAlmostEqual(a, 0)
        self.assertAlmostEqual(chi2, 4 * 100 / 3)
        self.assertAlmostEqual(error, 0.005 * np.sqrt(chi2))

    def test_the_share_that_stops_is_found_and_its_error_bar_holds(self):
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

    def test_the_grains_of_the_rim_that_do_not_count_are_found(self):
        held = 0
        for seed in range(10):
            random = np.random.default_rng(seed)
            theta, orifice = random.uniform(0.4, 2, 250), random.choice([6, 8, 10, 12], 250)
            stops = (random.uniform(size=250) < 1 / (1 + np.exp((theta * (orifice - 4) - 3) / 0.4))).astype(float)
            best, (low, high), fits = rule.best_rim(theta, orifice, stops)
            self.assertAlmostEqual(best, 4, delta=1.6)
            self.assertGreater(fits[0][-1] - fits[best][-1], 10)
            held += low <= 4 <= high
        self.assertGreaterEqual(held, 8)

    def test_runs_are_read_as_they_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            write_data(folder, {"w20_o8_a90_s3": 4}, [
                "settle,wedge_n8_0,packing,,0.55,nan,nan",
                "settle,wedge_n8_1,packing,,0.56,nan,nan"])
            ((key, (numbers,)),) = rule.read_ensembles(folder).items()
        self.assertEqual(key, ("angle", 20, 8, 4))
        self.assertEqual(numbers, {("settle", "packing"): 0.57, ("settle", "packing", 8): [0.55, 0.56],
                                   ("flow_mean", "interrupted"): 1.0})

    def test_angles_need_not_be_whole_degrees(self):
        with tempfile.TemporaryDirectory() as folder:
            write_data(folder, {"full_s1": 1, "full_s2": 1, "a51_s1": 7, "a27_s1": 13, "a22.5_s1": 16}, [
                "settle,whole,grains,,8000,nan,nan",
                "flow_mean,whole,arched,,1,nan,nan",
                "settle,wedge_n16_0,packing,,0.55,nan,nan"])
            made = rule.read_ensembles(folder)
            self.assertEqual([key[3] for key in made], [1, 7, 13, 16])
            self.assertEqual(made["angle", 20, 8, 1][0]["settle", "packing", 16], [0.55])
            with contextlib.redirect_stdout(io.StringIO()) as out:
                rule.print_errors(made)
                rule.print_stops(made)
        self.assertIn("| vessel | 51.43° | 27.69° | 22.5° |", out.getvalue())
        self.assertIn("| vessel | full | 51.43° | 27.69° | 22.5° |", out.getvalue())
        self.assertIn("| D 20 d, orifice 8 d (angle) | 2 of 2 | 1 of 1 | 1 of 1 | 1 of 1 |", out.getvalue())


def write_data(folder, orders, scalars):
    """Tables of runs in a vessel of 20 d, {name: order}, with a flow that pauses; alike but for their packing fractions:
    0.57, 0.58, ..."""
    flow = ["0.65,9,0", "0.7,10,0", "0.75,10,0", "0.8,10,0", "0.85,90,0"]
    folder = pathlib.Path(folder)
    (folder / "runs.csv").write_text("set,run,D/d,D0/d,n\n" + "".join(
        f"angle,{name},20,8,{order}\n" for name, order in orders.items()))
    for table, heading, rows in (("scalars", "moment,part,quantity,unit,value,low,high", scalars),
                                 ("flow", "time [s],out,rate [1/s]", flow)):
        lines = [f"set,run,{heading}"] + [f"angle,{name},{row}" for name in orders for row in rows]
        if table == "scalars":
            lines += [f"angle,{name},settle,whole,packing,,{0.57 + 0.01 * k:g},nan,nan" for k, name in enumerate(orders)]
        (folder / f"{table}.csv.xz").write_bytes(lzma.compress("\n".join(lines).encode()))


if __name__ == "__main__":
    unittest.main()
