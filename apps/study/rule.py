#!/usr/bin/env python3
"""rule.py [RUNS]: how wrong a sector is against its angle, from the runs of the set `angle` (and hopper20, hopper40) kept in
RUNS (runs/ beside this file): a table, and for each quantity which of these rules the data support:

    core   error = a (d / (D theta))^2          what is wrong fills a core of an arc of some d: its share of the cross section
    seam   error = a d / (D theta)              what is wrong grows with the length of the axis over that of the arc
    flow   error = a (d / (D0 theta))^2         it is the core over the orifice that counts, whatever the vessel

Rules of flows and arches are of sectors whose arc at the rim of the orifice is at least 2 d (theta D0 / d >= 4): below, a column of
grains on the axis is all that can fall. Errors are relative to the mean of the full vessels; chi2 per degree of freedom says how far a rule is from the data, in standard
errors. Arches: logistic regression of the share of sectors that arched on theta (D0 / d - k), k that of the greatest likelihood. Needs numpy."""
import csv
import math
import pathlib
import re
import sys

import numpy as np

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


def mean_and_error(values):
    """Mean and its standard error; of one value the error is nan."""
    values = np.asarray(values)
    return values.mean(), values.std(ddof=1) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def flowing(runs, quantity, moment):
    """Values of the runs; those of a flow only where the grains flow."""
    flow = moment == "flow_mean"
    values = [r.get((moment, quantity), math.nan) for r in runs if not (flow and r.get((moment, "arched"), 0) == 1)]
    return [v for v in values if math.isfinite(v)]


def errors_of(ensembles, quantity, moment):
    """Rows (set, D/d, D0/d, theta [rad], relative error, its standard error, sectors). An ensemble of one run is given the
    spread of the pooled others."""
    scatter = []
    for runs in ensembles.values():
        values = flowing(runs, quantity, moment)
        if len(values) > 2:
            scatter.append((np.std(values, ddof=1) / abs(np.mean(values)), len(values)))
    if not scatter:
        return []
    typical = math.sqrt(sum(s * s * (n - 1) for s, n in scatter) / sum(n - 1 for _, n in scatter))
    rows = []
    for (name, width, orifice, angle), runs in sorted(ensembles.items()):
        full = ensembles.get((name, width, orifice, 360), [])
        a, b = flowing(full, quantity, moment), flowing(runs, quantity, moment)
        if angle == 360 or not a or not b:
            continue
        (ma, _), (mb, _) = mean_and_error(a), mean_and_error(b)
        # A few values tell their own scatter badly: never less than what is typical of all ensembles.
        error = math.hypot(*(max(typical, np.std(v, ddof=1) / abs(m) if len(v) > 2 else 0) / math.sqrt(len(v))
                             for v, m in ((a, ma), (b, mb))))
        rows.append((name, width, orifice, math.radians(angle), mb / ma - 1, error, len(b)))
    return rows


def fit(rows, shape):
    """Factor a with its error, and chi2 per degree of freedom, of error = a shape(D/d, D0/d, theta)."""
    x = np.array([shape(r[1], r[2], r[3]) for r in rows])
    y, s = np.array([r[4] for r in rows]), np.array([r[5] for r in rows])
    weight = (x * x / s**2).sum()
    a = (x * y / s**2).sum() / weight
    chi2 = (((y - a * x) / s) ** 2).sum() / max(1, len(rows) - 1)
    return a, math.sqrt(max(1, chi2) / weight), chi2


SHAPES = {
    "core": lambda w, o, t: 1 / (w * t) ** 2,
    "seam": lambda w, o, t: 1 / (w * t),
    "flow": lambda w, o, t: 1 / (o * t) ** 2,
}


def logistic(x, y):
    """Maximum likelihood of p = 1 / (1 + exp((x - middle) / width)) by a search; returns middle, width, -2 log L."""
    best = None
    for middle in np.linspace(0.5, 14, 271):
        for width in np.geomspace(0.05, 4, 80):
            p = np.clip(1 / (1 + np.exp(np.clip((x - middle) / width, -50, 50))), 1e-9, 1 - 1e-9)
            loss = -2 * (y * np.log(p) + (1 - y) * np.log(1 - p)).sum()
            if best is None or loss < best[2]:
                best = (middle, width, loss)
    return best


def print_errors(ensembles):
    for quantity, moment, meaning in QUANTITIES:
        rows = errors_of(ensembles, quantity, moment)
        if len(rows) < 3:
            continue
        ruled = [r for r in rows if moment != "flow_mean" or r[2] * r[3] >= LEAST_RIM]
        fits = {name: fit(ruled, shape) for name, shape in SHAPES.items()}
        print(f"\n## {meaning} (`{quantity}`, {moment}): {len(ruled)} ensembles\n")
        print("| rule | a | chi2 / dof |\n|---|---|---|")
        for name, (a, error, chi2) in fits.items():
            print(f"| {name} | {a:.3g} ± {error:.2g} | {chi2:.2f} |")
        print("\n| vessel | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---" * 1 + "|---" * len(ANGLES) + "|")
        for vessel in sorted({r[:3] for r in rows}):
            cells = []
            for angle in ANGLES:
                here = [r for r in rows if r[:3] == vessel and round(math.degrees(r[3])) == angle]
                cells.append(f"{100 * here[0][4]:+.1f} ± {100 * here[0][5]:.1f}" if here else "")
            print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(cells) + " |")


def print_pile(ensembles):
    rows = errors_of(ensembles, "angle_of_repose", "pile")
    if not rows:
        return
    a, error, chi2 = fit(rows, lambda w, o, t: 1 / t)
    print("\n## angle of repose (`angle_of_repose`, pile; plate of 32 d)\n")
    print("; ".join(f"{math.degrees(r[3]):.0f}° {100 * r[4]:+.1f} ± {100 * r[5]:.1f}" for r in sorted(rows, key=lambda r: -r[3])))
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
    print("\n## arches: arched of all\n")
    print("| vessel | full | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---|---" + "|---" * len(ANGLES) + "|")
    for vessel, by_angle in sorted(rows.items()):
        cells = [f"{by_angle[a][0]:.0f} of {by_angle[a][1]}" if a in by_angle else "" for a in [360] + ANGLES]
        print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(cells) + " |")
    theta, holes, y = np.array(theta), np.array(holes), np.array(y)
    fits = {k: logistic(theta * (holes - k), y) for k in np.arange(0, 6, 0.5)}
    best = min(fits, key=lambda k: fits[k][2])
    middle, width, loss = fits[best]
    print(f"\nHalf of the sectors arch at x = theta (D0 / d - {best:g}) = {middle:.2f}; share 1 / (1 + exp((x - {middle:.2f}) / {width:.2f}));"
          f" -2 log L = {loss:.1f} over {len(y)} runs (with D0 / d alone {fits[0][2]:.1f})")


ANGLES = [180, 120, 90, 72, 60, 45, 36, 30, 24, 20, 15]


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "runs"
    ensembles, piles = {}, {}
    for key, scalars in runs_in(folder):
        (piles if key[0] == "pile" else ensembles).setdefault(key, []).append(scalars)
    print("# Errors of sectors in per cent of the full vessel, ± one standard error (flow: of those that flow)")
    print_errors(ensembles)
    print_arches(ensembles)
    print_pile(piles)


if __name__ == "__main__":
    main()
