#!/usr/bin/env python3
"""rule.py [RUNS]: how wrong a sector is against its angle, from the runs of the set `angle` (and hopper20, hopper40) kept in
RUNS (runs/ beside this file): a table, and for each quantity which of these rules the data support:

    core   error = a (d / (D theta))^2          what is wrong fills a core of an arc of some d: its share of the cross section
    seam   error = a d / (D theta)              what is wrong grows with the length of the axis over that of the arc
    flow   error = a (d / (D0 theta))^2         it is the core over the orifice that counts, whatever the vessel
    flow4  error = a (d / (D0 theta))^4         the same, but of no weight until the flow is near to stopping

Rules of flows and arches are of sectors whose arc at the rim of the orifice is at least 2 d (theta D0 / d >= 4): below, a column of
grains on the axis is all that can fall. Errors are relative to the mean of the full vessels; chi2 per degree of freedom says how far a
rule is from the data, in standard errors. The spread of runs is c / sqrt(N), N the grains of the domain (of rates and speeds: the grains
that fit into its share of the orifice), c pooled over all ensembles; an ensemble's own spread is drawn towards it as if it were known
from PRIOR more runs. Arches: logistic regression of the share of sectors that arched on theta (D0 / d - k), k that of the greatest likelihood.
Needs numpy (Debian: python3-numpy)."""
import collections
import csv
import math
import pathlib
import re
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("error: rule.py needs numpy: apt-get install python3-numpy, and run it with /usr/bin/python3")

QUANTITIES = [  # name, moment, short meaning
    ("packing", "settle", "packing fraction at rest"),
    ("cn", "settle", "CN at rest"),
    ("cn_distinct", "settle", "CN of distinct neighbours at rest"),
    ("load", "settle", "mean contact force at rest"),
    ("packing", "flow_mean", "packing fraction in flow"),
    ("cn", "flow_mean", "CN in flow"),
    ("cn_distinct", "flow_mean", "CN of distinct neighbours in flow"),
    ("speed", "flow_mean", "root mean square speed in flow"),
    ("discharge_rate", "flow_mean", "discharge rate"),
]
RUNS = pathlib.Path(__file__).parent / "runs"
ANGLES = [180, 120, 90, 72, 60, 45, 36, 30, 24, 20, 15]  # degrees
Row = collections.namedtuple("Row", "vessel width orifice theta error of_sectors of_full sectors")
RUN = re.compile(r"w(\d+)_o(\d+)_a(\d+)_s(\d+)$")


def runs_in(folder):
    """(D/d, D0/d, angle [deg], scalars {(moment, quantity): value}) of every run of these sets."""
    for summary in sorted(pathlib.Path(folder).glob("*/*/results/scalars.csv")):
        set_name, name = summary.parts[-4], summary.parts[-3]
        if set_name == "angle":
            found = RUN.match(name)
            if not found:
                continue
            width, orifice, angle = (int(found.group(k)) for k in (1, 2, 3))
        elif set_name in ("hopper20", "hopper40"):
            width, orifice, angle = int(set_name[6:]), 8, int(re.match(r"a(\d+)_", name).group(1))
        elif set_name == "pile":
            width, orifice, angle = 40, 0, int(re.match(r"a(\d+)_", name).group(1))
        else:
            continue
        scalars = {}
        with open(summary, newline="") as file:
            for row in csv.DictReader(file):
                if row["part"] == "whole":
                    scalars[row["moment"], row["quantity"]] = float(row["value"])
        yield (set_name, width, orifice, angle), scalars


LEAST_RIM = 4  # theta D0 / d
PRIOR = 4      # degrees of freedom


def size_of(key, runs, quantity):
    """What the spread of a quantity goes down with, by its root: grains of the domain, or over its orifice."""
    _, _, orifice, angle = key
    if quantity in ("discharge_rate", "speed"):
        return orifice**2 * angle / 360
    return np.mean([r["settle", "grains"] for r in runs]) * angle / 360


def flowing(runs, quantity, moment):
    """Values of the runs; those of a flow only where the grains flow."""
    flow = moment == "flow_mean"
    values = [r.get((moment, quantity), math.nan) for r in runs if not (flow and r.get((moment, "arched"), 0) == 1)]
    return [v for v in values if math.isfinite(v)]


def relative_spread(values):
    return np.std(values, ddof=1) / abs(np.mean(values)) if len(values) > 1 else 0.0


def errors_of(ensembles, quantity, moment):
    """Rows: vessel (set, D/d, D0/d), D/d, D0/d, theta [rad], error relative to the full vessel, standard errors of the sectors and of
    the full vessels, how many sectors. And c of the spread."""
    values = {key: flowing(runs, quantity, moment) for key, runs in ensembles.items()}
    values = {key: v for key, v in values.items() if v}
    freedom = sum(len(v) - 1 for v in values.values())
    if freedom == 0:
        return [], math.nan
    sizes = {key: size_of(key, ensembles[key], quantity) for key in values}
    c2 = sum(relative_spread(v) ** 2 * sizes[key] * (len(v) - 1) for key, v in values.items()) / freedom

    def standard_error(key):
        v = values[key]
        spread2 = ((len(v) - 1) * relative_spread(v) ** 2 + PRIOR * c2 / sizes[key]) / (len(v) - 1 + PRIOR)
        return math.sqrt(spread2 / len(v))

    rows = []
    for key in sorted(values):
        name, width, orifice, angle = key
        full = (name, width, orifice, 360)
        if key == full or full not in values:
            continue
        error = np.mean(values[key]) / np.mean(values[full]) - 1
        rows.append(Row((name, width, orifice), width, orifice, math.radians(angle), error, standard_error(key),
                        standard_error(full), len(values[key])))
    return rows, math.sqrt(c2)


def fit(rows, shape):
    """Factor a with its error, and chi2 per degree of freedom, of error = a shape(D/d, D0/d, theta), by generalised least
    squares: sectors that are compared with the same full vessels share the error of these."""
    x = np.array([shape(r.width, r.orifice, r.theta) for r in rows])
    y = np.array([r.error for r in rows])
    shared = np.array([[a.of_full * b.of_full if a.vessel == b.vessel else 0 for b in rows] for a in rows])
    weights = np.linalg.inv(shared + np.diag([r.of_sectors**2 for r in rows]))
    weight = x @ weights @ x
    a = x @ weights @ y / weight
    chi2 = (y - a * x) @ weights @ (y - a * x) / max(1, len(rows) - 1)
    return a, math.sqrt(max(1, chi2) / weight), chi2


SHAPES = {
    "core": lambda w, o, t: 1 / (w * t) ** 2,
    "seam": lambda w, o, t: 1 / (w * t),
    "flow": lambda w, o, t: 1 / (o * t) ** 2,
    "flow4": lambda w, o, t: 1 / (o * t) ** 4,
}


def logistic(x, y):
    """Maximum likelihood of p = 1 / (1 + exp((x - middle) / width)) by a search; returns middle, its standard error (from the
    profile of the likelihood: half of where -2 log L is within 3.84 of the least, over 1.96), width, -2 log L."""
    middles, widths = np.linspace(0.5, 14, 271), np.geomspace(0.05, 4, 80)
    loss = np.empty((len(middles), len(widths)))
    for i, middle in enumerate(middles):
        p = np.clip(1 / (1 + np.exp(np.clip((x - middle) / widths[:, None], -50, 50))), 1e-9, 1 - 1e-9)
        loss[i] = -2 * np.log(np.where(y > 0, p, 1 - p)).sum(axis=1)
    i, k = np.unravel_index(loss.argmin(), loss.shape)
    near = middles[loss.min(axis=1) < loss.min() + 3.84]
    return middles[i], (near.max() - near.min()) / 2 / 1.96, widths[k], loss.min()


def in_per_cent(row):
    return f"{100 * row.error:+.1f} ± {100 * math.hypot(row.of_sectors, row.of_full):.1f}"


def print_errors(ensembles):
    for quantity, moment, meaning in QUANTITIES:
        rows, c = errors_of(ensembles, quantity, moment)
        if len(rows) < 3:
            continue
        ruled = [r for r in rows if moment != "flow_mean" or r.orifice * r.theta >= LEAST_RIM]
        fits = {name: fit(ruled, shape) for name, shape in SHAPES.items()}
        over = "orifice" if quantity in ("discharge_rate", "speed") else "domain"
        print(f"\n### {meaning} (`{quantity}`, {moment})\n")
        print(f"{len(ruled)} ensembles, {sum(r.sectors for r in ruled)} sectors; spread of runs {c:.2g} / sqrt(grains of the {over})\n")
        print("| rule | a | chi2 / dof |\n|---|---|---|")
        for name, (a, error, chi2) in fits.items():
            print(f"| {name} | {a:.3g} ± {error:.2g} | {chi2:.2f} |")
        print("\n| vessel | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---" * 1 + "|---" * len(ANGLES) + "|")
        for vessel in sorted({r.vessel for r in rows}):
            cells = []
            for angle in ANGLES:
                here = [r for r in rows if r.vessel == vessel and round(math.degrees(r.theta)) == angle]
                cells.append(in_per_cent(here[0]) if here else "")
            print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(cells) + " |")


def print_pile(ensembles):
    rows, _ = errors_of(ensembles, "angle_of_repose", "pile")
    if not rows:
        return
    a, error, chi2 = fit(rows, lambda w, o, t: 1 / t)
    print("\n### angle of repose (`angle_of_repose`, pile; plate of 32 d)\n")
    print("; ".join(f"{math.degrees(r.theta):.0f}° {in_per_cent(r)}" for r in sorted(rows, key=lambda r: -r.theta)))
    print(f"\nerror = a / theta: a = {a:.3g} ± {error:.2g}, chi2 / dof {chi2:.2f}")


def print_arches(ensembles):
    theta, holes, y, rows = [], [], [], {}
    for (name, width, orifice, angle), runs in ensembles.items():
        arched = [r.get(("flow_mean", "arched"), math.nan) for r in runs]
        arched = [a for a in arched if math.isfinite(a)]
        if not arched:
            continue
        rows.setdefault((name, width, orifice), {})[angle] = (sum(arched), len(arched))
        if angle != 360 and math.radians(angle) * orifice >= LEAST_RIM:
            theta += [math.radians(angle)] * len(arched)
            holes += [orifice] * len(arched)
            y += arched
    print("\n### arches: arched of all\n")
    print("| vessel | full | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---|---" + "|---" * len(ANGLES) + "|")
    for vessel, by_angle in sorted(rows.items()):
        cells = [f"{by_angle[a][0]:.0f} of {by_angle[a][1]}" if a in by_angle else "" for a in [360] + ANGLES]
        print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(cells) + " |")
    theta, holes, y = np.array(theta), np.array(holes), np.array(y)
    fits = {k: logistic(theta * (holes - k), y) for k in np.arange(0, 6.5, 0.5)}
    best = min(fits, key=lambda k: fits[k][-1])
    near = [k for k in fits if fits[k][-1] < fits[best][-1] + 3.84]
    middle, error, width, loss = fits[best]
    print(f"\nHalf of the sectors arch at x = theta (D0 / d - {best:g}) = {middle:.2f} ± {error:.2f}; share 1 / (1 + exp((x - {middle:.2f}) / {width:.2f}));"
          f" -2 log L = {loss:.1f} over {len(y)} runs (with D0 / d alone {fits[0][-1]:.1f}; {min(near):g} to {max(near):g} in place of {best:g} are within 95 %)")


def main(folder):
    ensembles, piles = {}, {}
    for key, scalars in runs_in(folder):
        (piles if key[0] == "pile" else ensembles).setdefault(key, []).append(scalars)
    print_errors(ensembles)
    print_arches(ensembles)
    print_pile(piles)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else RUNS)
