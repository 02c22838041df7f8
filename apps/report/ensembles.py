# ensembles.py: runs that differ in their seed alone, and means over them.
import numpy as np

from student import two_sided
from vocabulary import angle_label


class Sample:
    """Numbers from several seeds: mean, standard deviation (n - 1; nan of one), half width of the mean's 95 % interval."""

    def __init__(self, values):
        values = np.array([v for v in values if v is not None and np.isfinite(v)], dtype=float)
        self.values = values
        self.n = len(values)
        self.mean = float(values.mean()) if self.n else float("nan")
        self.sd = float(values.std(ddof=1)) if self.n > 1 else float("nan")
        self.half = student(self.n) * self.sd / np.sqrt(self.n) if self.n > 1 else float("nan")


def student(n):
    """Half width of the 95 % interval of the mean of n numbers, in standard errors."""
    return two_sided(0.95, n - 1) if n > 1 else float("nan")


def mean_and_sd(rows):
    """Mean and standard deviation of the rows, cell by cell, over the rows that have a number there."""
    rows = np.asarray(rows, dtype=float)
    there = np.isfinite(rows)
    n = there.sum(axis=0)
    filled = np.where(there, rows, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = filled.sum(axis=0) / n
        sd = np.sqrt(np.where(there, (rows - mean) ** 2, 0).sum(axis=0) / (n - 1))
    return np.where(n > 0, mean, np.nan), np.where(n > 1, sd, np.nan)


class Ensemble:
    """Runs of one vessel, angle, sides and axis, in the order of their seeds."""

    def __init__(self, key, runs):
        self.kind, self.angle, self.sides, self.axis = key
        self.runs = sorted(runs, key=lambda run: run.seed)
        self.order = self.runs[0].order
        self.full = self.kind == "full"

    @property
    def plain(self):
        """Full, or a sector as the paper has it: periodic sides, clamped axis."""
        return self.full or (self.kind == "sector" and self.sides == "periodic" and self.axis == "clamp")

    @property
    def label(self):
        if self.kind in ("full", "slot"):
            return self.kind
        extra = [self.sides] if self.sides != "periodic" else []
        extra += [f"axis {self.axis}"] if self.axis != "clamp" else []
        return ", ".join([angle_label(self.order)] + extra)

    def seeds(self, runs=None):
        found = [run.seed for run in (runs or self.runs)]
        if len(found) > 2 and found == list(range(found[0], found[-1] + 1)):
            return f"{found[0]}\u2013{found[-1]}"
        return ", ".join(map(str, found))

    def first(self, table, moment):
        """The run of the lowest seed that has rows of this moment in a table, and these rows."""
        for run in self.runs:
            found = run.table(table)
            if found is not None:
                rows = found.pick(moment=moment)
                if rows.rows:
                    return run, rows
        return None, None

    def scalar(self, moment, quantity):
        found = [run.scalar(moment, quantity) for run in self.runs]
        return Sample([f[0] for f in found if f])

    def flowing(self, moment, quantity):
        """The same of the runs that had not stopped at the end of this moment."""
        found = [(run.scalar(moment, quantity), run.scalar(moment, "arched")) for run in self.runs]
        return Sample([value[0] for value, arched in found if value and not (arched and arched[0] == 1)])

    def arched(self, moment):
        """How many runs had stopped at the end of a moment: words, or "" where none had."""
        values = self.scalar(moment, "arched").values
        return f"{int(values.sum())} of {len(values)} arched" if len(values) and values.sum() > 0 else ""

    def unit(self, moment, quantity):
        return next((f[3] for f in (run.scalar(moment, quantity) for run in self.runs) if f), "")

    def distribution(self, moment, quantity, region="all"):
        """[(first, shares)] of each run, with their scale and step; shares add up to 1."""
        found, binning = [], None
        for run in self.runs:
            table = run.table("distributions")
            rows = table.pick(moment=moment, part="whole", region=region, quantity=quantity) if table else None
            if rows is None or not rows.rows:
                continue
            counts = np.array(rows["counts"][0].split(), dtype=float)
            if not counts.sum() > 0:
                continue
            binning = binning or (rows["scale"][0], rows["step"][0])
            if binning == (rows["scale"][0], rows["step"][0]):
                found.append((int(rows["first"][0]), counts / counts.sum()))
        return found, binning

    def profile(self, moment, column):
        """Rings: r and mean and standard deviation over seeds of a column of radial.csv, and how many seeds."""
        rows = []
        for run in self.runs:
            table = run.table("radial")
            ring = table.pick(moment=moment, part="whole") if table else None
            if ring is not None and ring.rows and column in ring:
                rows.append(ring)
        if not rows:
            return None
        # Rings without grains are not in the files: by their places, not by their rows.
        places = np.unique(np.round(np.concatenate([ring["r"] for ring in rows]), 9))
        filled, arcs = np.full((len(rows), len(places)), np.nan), np.full(len(places), np.nan)
        for k, ring in enumerate(rows):
            where = np.searchsorted(places, np.round(ring["r"], 9))
            filled[k, where], arcs[where] = ring[column], ring["arc"]
        mean, sd = mean_and_sd(filled)
        return places, arcs, mean, sd, len(rows)

    def field(self, moment, column):
        """map.csv as arrays: r, z, mean over seeds [z, r], number of seeds."""
        grids = []
        for run in self.runs:
            table = run.table("map")
            cells = table.pick(moment=moment, part="whole") if table else None
            if cells is not None and cells.rows and column in cells:
                grids.append((cells["r"], cells["z"], cells[column]))
        if not grids:
            return None
        r = np.unique(np.round(np.concatenate([g[0] for g in grids]), 9))
        z = np.unique(np.round(np.concatenate([g[1] for g in grids]), 9))
        stack = np.full((len(grids), len(z), len(r)), np.nan)
        for k, (gr, gz, value) in enumerate(grids):
            stack[k, np.searchsorted(z, np.round(gz, 9)), np.searchsorted(r, np.round(gr, 9))] = value
        if column == "zone":  # the zone of most seeds; counts decide, not a mean
            votes = np.stack([(stack == zone).sum(axis=0) for zone in range(4)])
            return r, z, votes.argmax(axis=0).astype(float), len(grids)
        return r, z, mean_and_sd(stack)[0], len(grids)


class Vessel:
    """Everything that was run in one vessel: full first, then sectors from wide to narrow."""

    def __init__(self, key, runs):
        self.process, self.width, self.orifice, self.count = key
        groups = {}
        for run in runs:
            groups.setdefault((run.kind, run.angle, run.sides, run.axis), []).append(run)
        ensembles = [Ensemble(k, members) for k, members in groups.items()]
        ensembles.sort(key=lambda e: (e.kind == "slot", not e.full, -e.angle, not e.plain, e.sides, e.axis))
        self.ensembles = ensembles
        self.main = [e for e in ensembles if e.plain]
        self.others = [e for e in ensembles if not e.plain]
        self.run = (self.main or ensembles)[0].runs[0]
        self.d = self.run.diameter
        self.radius = self.run.radius
        self.full = next((e for e in ensembles if e.full), None)

    @property
    def hopper(self):
        return self.orifice is not None

    @property
    def gallery(self):
        """The ensembles that have a place in each figure: full, 90, 60, 45, 30 degrees, or what there is."""
        usual = [e for e in self.main if e.full or e.order in (4, 6, 8, 12)]
        return (usual if any(not e.full for e in usual) else self.main or self.ensembles)[:6]

    @property
    def title(self):
        name = {"pile": "Sandpile", "sandpile": "Sandpile"}.get(self.process, self.process.capitalize())
        hole = f", orifice {self.orifice:g} d" if self.hopper else ""
        return f"{name}, vessel {self.width:g} d wide{hole}, {grouped(self.count)} grains"

    @property
    def id(self):
        return f"{self.process}-{self.width:g}-{self.orifice or 0:g}-{self.count}".replace(".", "_").replace(" ", "-")

    def moments(self, kind, role=None):
        """Names of the moments of stages of a kind, and of a role if one is named, in their order."""
        return list(dict.fromkeys(m["name"] for e in self.ensembles for run in e.runs for m in run.summary.get("moments", [])
                                  if m.get("kind") == kind and m.get("stage") != "" and role in (None, m.get("role"))))

    def roles(self):
        """Which moment is which: at rest, the first and last instant of the flow, its mean and the end. Where no moment has the role
        of rest or flow, the first instant counts as at rest and what follows as flow."""
        instants, means = self.moments("instant"), self.moments("mean")
        rest = (self.moments("instant", "rest") or instants or [None])[0]
        later = instants[instants.index(rest) + 1:] if rest in instants else []
        flows = self.moments("instant", "flow") or later or instants
        flow_means = self.moments("mean", "flow") or means
        mean = (flow_means[-1] if self.hopper else flow_means[0]) if flow_means else None  # a pile flows most at first
        return {"rest": rest, "instant": flows[0] if flows else None, "second": flows[-1] if flows else None, "mean": mean,
                "end": instants[-1] if instants else None}

    def brief(self, moment):
        """A moment for a label: name and time alone."""
        return self.when(moment).replace("average of ", "").replace(" after opening", "").replace(" before opening", "")

    def when(self, moment):
        """Words for a moment: its name and its time after the first stage."""
        for e in self.ensembles:
            for run in e.runs:
                known = run.moment(moment)
                if not known:
                    continue
                first = run.summary["moments"][0]
                begin, end = (known.get(k) for k in ("begin_s", "end_s"))
                if moment == first["name"] or None in (end, first.get("end_s")):
                    return f"{moment} (before opening)" if moment == first["name"] else moment
                if known.get("kind") == "mean":
                    frames = known.get("frames")
                    return (f"{moment} (average of {frames} frames, {begin - first['end_s']:.2f} to "
                            f"{end - first['end_s']:.2f} s after opening)")
                if known.get("role") == "rest":
                    return f"{moment} (at rest)"
                return f"{moment} ({end - first['end_s']:.2f} s after opening)"
        return str(moment)


def grouped(count):
    """12000 as 12 000, with thin blanks."""
    return f"{count:,}".replace(",", "\u202f")


def counted(count, thing):
    """1 run, 2 runs."""
    return f"{count} {thing}{'s' if count != 1 else ''}"


def sort_into_vessels(runs):
    """Runs of one scene in vessels of one size with the same grains; grains of several sizes have another mean in each run, so that
    widths in d are those of the first run, a full one if there is any."""
    groups = {}
    for run in runs:
        particles = run.scene.get("particles") or {}
        grains = str([particles.get(name) for name in ("diameter", "sizes", "file")])
        size = (round(run.radius, 9), round(run.orifice, 9) if run.orifice else None)
        groups.setdefault((run.scene_name, *size, run.count, grains), []).append(run)
    keyed = []
    for (name, radius, orifice, count, _), members in groups.items():
        d = min(members, key=lambda run: (run.order, run.seed)).diameter
        width = round(2 * radius / d, 2) if d else 0
        keyed.append(((name, width, round(orifice / d, 2) if orifice else None, count), members))
    keyed.sort(key=lambda item: ("pile" in item[0][0], "slot" in item[0][0], item[0][1], item[0][2] or 0, item[0][3]))
    return [Vessel(key, members) for key, members in keyed]
