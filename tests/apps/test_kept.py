"""test_kept.py: runs that apps/study/kept.py packs and unpacks."""
import json
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "study"))
import kept  # noqa: E402

SCALARS = "moment,part,quantity,unit,value,low,high\n"


def make_run(runs, name, packing, order=4, kind="sector"):
    results = runs / name / "results"
    results.mkdir(parents=True)
    domain = {"kind": kind, "order": order, "sides": "periodic", "axis": "clamp", "diameter_m": 0.005, "radius_m": 0.05,
              "orifice_m": 0.04}
    cost = {"grains": 345, "particle_steps": 2.46852e7, "wall_seconds": 1.63388}
    (runs / name / "scene.resolved.toml").write_text("[domain]\n")
    (runs / name / "provenance.json").write_text(json.dumps({"git_describe": "1f51fe5"}))
    (results / "scalars.csv").write_text(f"{SCALARS}settle,whole,packing,,{packing},nan,nan\n")
    (results / "map.csv").write_text(f"moment,part,packing\nsettle,whole,{packing}\n")
    (results / "summary.json").write_text(json.dumps({"domain": domain, "seed": 3, "cost": cost}))


def content(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*") if path.is_file() and path.name != kept.STAMP}


class Kept(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.runs, self.data, self.back = (pathlib.Path(scratch.name) / name for name in ("runs", "data", "back"))
        make_run(self.runs, "angle/a_s1", 0.57)
        make_run(self.runs, "angle/b_s1", 0.58, order=1, kind="full")
        make_run(self.runs, "pile/a_s1", 0.59)

    def values(self):
        return {(row["set"], row["run"]): row["value"] for row in kept.read_table(self.data, "scalars")}

    def test_unpacking_gives_what_was_packed_and_no_file_is_kept_twice(self):
        (self.runs / "pile" / "a_s1" / "results" / "flow.csv").write_text("time [s],out,rate [1/s]\n0.05,1,2\n")
        kept.pack(self.runs, self.data)
        kept.unpack(self.back, self.data)
        self.assertEqual(content(self.back), content(self.runs))
        for path in self.data.glob("*.csv.xz"):
            path.unlink()
        kept.unpack(self.back / "archives", self.data)
        self.assertEqual({name.split("/")[-1] for name in content(self.back / "archives")},
                         {"scene.resolved.toml", "provenance.json", "summary.json", "map.csv"})

    def test_runs_have_one_row_each(self):
        kept.pack(self.runs, self.data)
        sector, full, _ = kept.read_table(self.data, "runs")
        self.assertEqual(sector, {
            "set": "angle", "run": "a_s1", "vessel": "hopper", "D/d": "20", "D0/d": "8", "n": "4", "seed": "3",
            "sides": "periodic", "axis": "clamp", "grains": "345", "particle_steps": "2.46852e+07",
            "wall_seconds": "1.63388", "commit": "1f51fe5"})
        self.assertEqual((full["n"], full["sides"], full["axis"]), ("1", "", ""))

    def test_the_same_runs_make_the_same_bytes(self):
        kept.pack(self.runs, self.data)
        before = content(self.data)
        for path in self.runs.rglob("*"):
            os.utime(path, (1, 1))
        kept.pack(self.runs, self.data)
        self.assertEqual(content(self.data), before)

    def test_a_set_is_replaced_and_others_stay(self):
        kept.pack(self.runs, self.data)
        others = content(self.data)["pile.tar.xz"]
        make_run(self.back, "angle/c_s1", 0.6)
        kept.pack(self.back, self.data)
        self.assertEqual(self.values(), {("angle", "c_s1"): "0.6", ("pile", "a_s1"): "0.59"})
        self.assertEqual(content(self.data)["pile.tar.xz"], others)

    def test_what_is_there_is_unpacked_again_only_when_missing_or_older(self):
        kept.pack(self.runs, self.data)
        kept.unpack(self.back, self.data)
        run = self.back / "angle" / "a_s1"
        scene, summary = run / "scene.resolved.toml", run / "results" / "summary.json"
        scene.write_text("mine")
        kept.unpack(self.back, self.data)
        self.assertEqual(scene.read_text(), "mine")
        summary.unlink()
        kept.unpack(self.back, self.data)
        self.assertEqual(content(self.back), content(self.runs))
        scene.write_text("mine")
        later = (self.back / kept.STAMP).stat().st_mtime + 1
        os.utime(self.data / "runs.csv", (later, later))
        kept.unpack(self.back, self.data)
        self.assertEqual(content(self.back), content(self.runs))

    def test_a_run_that_is_not_reduced_to_its_end_is_not_packed(self):
        (self.runs / "angle" / "a_s1" / "results" / "summary.json").unlink()
        kept.pack(self.runs, self.data)
        self.assertEqual(set(self.values()), {("angle", "b_s1"), ("pile", "a_s1")})

    def test_runs_that_are_not_kept_yet_stay_where_they_are(self):
        kept.pack(self.runs, self.data)
        make_run(self.back, "angle/c_s1", 0.6)
        kept.unpack(self.back, self.data)
        self.assertTrue((self.back / "angle" / "c_s1" / "results" / "summary.json").exists())


if __name__ == "__main__":
    unittest.main()
