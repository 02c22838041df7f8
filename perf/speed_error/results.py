# results.py: what speed_error measured, read from its files; means over seeds and their differences.
import csv
import math
import pathlib
import sys
from collections import namedtuple

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "report"))
import student  # noqa: E402

CONFIDENCE = 0.99  # of what is called an error

# All that is varied, in the words of speed_error.hpp.
Variant = namedtuple("Variant", "step young skin angle axis precision")


def variant_of(row):
    return Variant(*(float(row[key]) for key in ("step", "young", "skin", "angle")), row["axis"], row["precision"])


class Results:
    """The files *.csv of a folder, one a job; setup.csv says how the jobs were set up."""

    def __init__(self, folder):
        self.setup, self.jobs = {}, {}
        for path in sorted(pathlib.Path(folder).glob("*.csv")):
            with open(path, newline="", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    if path.name == "setup.csv":
                        self.setup.setdefault((row["scene"], row["item"]), []).append(row["value"])
                    else:
                        job = (row["kind"], row["scene"], variant_of(row), row["damping"], row["speed"], row["seed"])
                        self.jobs.setdefault(job, {})[row["quantity"]] = float(row["value"])
        if not self.setup:
            raise FileNotFoundError(f"{folder}: there are no results: run speed_error.sh without --page-only")
        self.scenes = list(dict.fromkeys(scene for scene, _ in self.setup if scene))
        self.standard = variant_of({item: values[0] for (scene, item), values in self.setup.items() if not scene})

    def of(self, kind, scene):
        """{(variant, damping, speed, seed): {quantity: value}} of one kind of job."""
        return {job[2:]: found for job, found in self.jobs.items() if job[:2] == (kind, scene)}

    def beds(self, scene, variant):
        """{quantity: value} of each seed there is."""
        return [found for (v, _, _, _), found in self.of("bed", scene).items() if v == variant]

    def sample(self, scene, variant, quantity):
        return Sample([bed[quantity] for bed in self.beds(scene, variant) if quantity in bed])

    def variants(self, varied, scenes=None):
        """Variants that were run and differ from the standard in nothing but the fields `varied`; the standard too."""
        ran = {v for scene in scenes or self.scenes for v, _, _, _ in self.of("bed", scene)} | {self.standard}
        return [v for v in ran if v._replace(**{key: getattr(self.standard, key) for key in varied}) == self.standard]

    def steps(self):
        return sorted(v.step for v in self.variants(["step"]))


class Sample:
    """Finite values, one a seed."""

    def __init__(self, values):
        self.values = np.array([v for v in values if math.isfinite(v)], dtype=float)
        self.count = len(self.values)
        self.mean = float(self.values.mean()) if self.count else math.nan
        self.mean_variance = float(self.values.var(ddof=1)) / self.count if self.count > 1 else math.nan
        self.standard_error = math.sqrt(self.mean_variance)


# As parts of a reference: the difference, its standard error, half the width of its interval of 99 % confidence.
Difference = namedtuple("Difference", "value standard_error bound")


def is_significant(difference):
    return abs(difference.value) > difference.bound


def difference(sample, reference):
    """Welch's comparison: the two samples may spread differently. None where they cannot be compared."""
    if sample.count < 2 or reference.count < 2 or reference.mean == 0:
        return None
    a, b = sample.mean_variance, reference.mean_variance
    value, error, bound = sample.mean - reference.mean, math.sqrt(a + b), math.nan
    if error > 0:
        freedom = (a + b) ** 2 / (a * a / (sample.count - 1) + b * b / (reference.count - 1))
        bound = student.two_sided(CONFIDENCE, freedom) * error
    scale = abs(reference.mean)
    return Difference(value / scale, error / scale, bound / scale)


def trend(x, y):
    """Slope of the straight line through the points, as a part of the mean of y. None with less than four points."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(x) < 4:
        return None
    squares = ((x - x.mean()) ** 2).sum()
    slope = ((x - x.mean()) * (y - y.mean())).sum() / squares
    left = ((y - y.mean() - slope * (x - x.mean())) ** 2).sum()
    error = math.sqrt(left / (len(x) - 2) / squares)
    bound = student.two_sided(CONFIDENCE, len(x) - 2) * error
    scale = abs(y.mean())
    return Difference(slope / scale, error / scale, bound / scale)
