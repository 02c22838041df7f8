# read.py: finds runs and reads their result files.
import csv
import glob
import json
import os
import re

import numpy as np

TEXT = {"moment", "part", "region", "quantity", "unit", "counts", "kind", "measure", "beyond", "reference_runs", "compared_runs",
        "bootstrap"}


def plain(name):
    """The name of a column without its unit: 'r [m]' is r."""
    return name.split(" [")[0].strip()


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return float("nan")


class Table:
    """A CSV file with one header line, by columns; rows can be picked by the text of columns."""

    def __init__(self, names, columns):
        self.columns = dict(zip(names, columns))
        self.rows = len(columns[0]) if columns else 0

    @staticmethod
    def read(path):
        with open(path, newline="", encoding="utf-8") as file:
            lines = list(csv.reader(file))
        names = [plain(name) for name in lines[0]] if lines else []
        lines = [line for line in lines[1:] if len(line) == len(names)]
        columns = []
        for name, cells in zip(names, zip(*lines) if lines else [()] * len(names)):
            if name in TEXT:
                columns.append(np.array(cells, dtype=object))
                continue
            try:
                columns.append(np.array(cells, dtype=float))
            except ValueError:
                columns.append(np.array([number(cell) for cell in cells]))
        return Table(names, columns)

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        return self.columns[name]

    def pick(self, **wanted):
        keep = np.ones(self.rows, dtype=bool)
        for name, value in wanted.items():
            if name in self.columns:
                keep &= self.columns[name] == value
        return Table(list(self.columns), [column[keep] for column in self.columns.values()])


def scene_value(text):
    """A value of a resolved scene, which the program wrote: JSON but for inline tables."""
    text = re.sub(r'([{,]\s*)([A-Za-z_]+)\s*=', r'\1"\2":', text.strip())
    text = re.sub(r"(?<![\w.\"])\+?(-?)(\d+)\.(?!\d)", r"\g<1>\2.0", text)
    try:
        return json.loads(text)
    except ValueError:
        return text.strip('"')


def read_scene(path):
    """scene.resolved.toml as a dictionary."""
    scene = {}
    here = scene
    if not os.path.exists(path):
        return scene
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.strip()
            head = re.fullmatch(r"(\[\[?)(.+?)\]\]?", line)
            if head and "=" not in line:
                here = scene
                names = [name.strip('"') for name in re.findall(r'"[^"]*"|[^.]+', head[2])]
                for name in names[:-1]:
                    here = here.setdefault(name, {})
                if head[1] == "[[":
                    here.setdefault(names[-1], []).append({})
                    here = here[names[-1]][-1]
                else:
                    here = here.setdefault(names[-1], {})
            elif "=" in line and not line.startswith("#"):
                name, value = line.split("=", 1)
                here[name.strip().strip('"')] = scene_value(value)
    return scene


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


class Run:
    """The result files of one run; a file that is missing gives None."""

    def __init__(self, folder):
        self.folder = folder
        self.name = os.path.join(*os.path.abspath(folder).split(os.sep)[-2:])
        self.results = os.path.join(folder, "results")
        if not os.path.exists(os.path.join(self.results, "summary.json")):
            self.results = folder  # a reduced run may have its files at its top
        self.summary = read_json(os.path.join(self.results, "summary.json"))
        self.provenance = read_json(os.path.join(folder, "provenance.json"))
        self.scene = read_scene(os.path.join(folder, "scene.resolved.toml"))
        self.tables = {}
        domain = self.summary.get("domain") or {}
        in_scene = self.scene.get("domain") or {}
        self.kind = domain.get("kind") or in_scene.get("kind") or "full"
        self.angle = float(domain.get("angle_deg") or in_scene.get("angle") or 360)
        self.order = int(domain.get("order") or round(360 / self.angle))
        self.sides = domain.get("sides") or in_scene.get("sides") or "periodic"
        self.axis = domain.get("axis") or in_scene.get("axis") or "clamp"
        if self.kind != "sector":
            self.sides, self.axis, self.order = "", "", 1
        particles = self.scene.get("particles") or {}
        self.seed = int(self.summary.get("seed") or particles.get("seed") or 0)
        self.diameter = self.grain_diameter(domain, particles)
        self.radius = domain.get("radius_m") or self.widest()
        self.orifice = domain.get("orifice_m") or self.plugged()
        self.scene_name = domain.get("scene") or ("slot" if self.kind == "slot" else "hopper" if self.orifice else "pile")
        self.cost = dict(self.summary.get("cost") or {})
        self.cost.setdefault("threads", self.provenance.get("threads"))
        self.count = int(particles.get("count") or (self.cost.get("grains") or 0) * self.order)

    @staticmethod
    def grain_diameter(domain, particles):
        given = particles.get("diameter")
        return float(domain.get("diameter_m") or (given if isinstance(given, (int, float)) else 1.0))

    def moment(self, name):
        """What summary.json says of a moment: kind, role, stage, walls and times; {} of one that it does not have."""
        return next((m for m in self.summary.get("moments", []) if m["name"] == name), {})

    def walls(self, moment=None):
        """Profiles of the walls that are there at a moment; of none, those of the start."""
        all_walls = [w for w in self.scene.get("wall", []) if isinstance(w.get("profile"), list)]
        there = self.moment(moment).get("walls", [w.get("name") for w in all_walls if w.get("present", True)])
        return [w["profile"] for w in all_walls if w.get("name") in there]

    def widest(self):
        return max([abs(point[0]) for wall in self.walls() for point in wall] or [float("nan")])

    def plugged(self):
        """Width of the hole around the axis that a stage opens, or None."""
        removed = {name for stage in self.scene.get("stage", []) for name in stage.get("remove") or []}
        for wall in self.scene.get("wall", []):
            ends = [point[0] for point in wall.get("profile") or []]
            if wall.get("name") in removed and ends and min(ends) <= 0:
                return max(ends) * 2
        return None

    def table(self, name):
        if name not in self.tables:
            path = os.path.join(self.results, name + ".csv")
            found = Table.read(path) if os.path.exists(path) else None
            self.tables[name] = found if found is not None and found.rows else None
        return self.tables[name]

    def scalar(self, moment, quantity):
        """(value, low, high, unit); from the CSV, else from the summary."""
        table = self.table("scalars")
        if table is not None:
            row = table.pick(moment=moment, part="whole", quantity=quantity)
            if row.rows:
                return row["value"][0], row["low"][0], row["high"][0], row["unit"][0]
        entry = ((self.summary.get("scalars") or {}).get(moment) or {}).get(quantity)
        if entry is None:
            return None
        return number(entry.get("value")), number(entry.get("low")), number(entry.get("high")), entry.get("unit") or ""

    def scalar_names(self, moment):
        """Quantities of the whole at a moment; from the CSV, else from the summary."""
        table = self.table("scalars")
        rows = list(table.pick(moment=moment, part="whole")["quantity"]) if table is not None else []
        return rows or list((self.summary.get("scalars") or {}).get(moment, {}))

    def moments(self):
        return [m["name"] for m in self.summary.get("moments", [])]


def is_run(folder):
    return (os.path.exists(os.path.join(folder, "results", "summary.json"))
            or os.path.exists(os.path.join(folder, "summary.json")))


def find_runs(folders):
    """The runs that the folders are or have up to three levels below, and the comparisons beside them."""
    runs, comparisons = {}, {}
    places = [(folder, 0) for folder in folders]
    while places:
        folder, depth = places.pop(0)
        comparisons.update((os.path.abspath(c), None) for c in sorted(glob.glob(os.path.join(glob.escape(folder), "comparisons", "*.csv"))))
        if is_run(folder):  # and nothing of what is in it
            runs.setdefault(os.path.abspath(folder), folder)
        elif depth < 3:
            places += [(f.rstrip(os.sep), depth + 1) for f in sorted(glob.glob(os.path.join(glob.escape(folder), "*", "")))]
    return [Run(f) for f in runs.values()], list(comparisons)
