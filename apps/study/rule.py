#!/usr/bin/env python3
"""rule.py [DATA]: prints how wrong sectors are against their angle, and the rules their errors follow (README.md)."""
import collections
import math
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("error: rule.py needs numpy: apt-get install python3-numpy, and run it with /usr/bin/python3")

import kept

SETS = ("angle", "hopper20", "hopper40", "pile")
QUANTITIES = [  # name, moment, meaning
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
OF_THE_PILE = [  # name, meaning, power of 1 / theta
    ("angle_of_repose", "angle of repose", 1),
    ("cn_distinct", "CN of distinct neighbours of a pile", 2),
]
OF_THE_ORIFICE = ("speed", "discharge_rate")  # quantities that vary with what is over the orifice
SHAPES = {  # of D/d, D0/d, theta
    "axis zone": lambda w, o, t: 1 / (w * t) ** 2,
    "seam": lambda w, o, t: 1 / (w * t),
    "flow": lambda w, o, t: 1 / (o * t) ** 2,
    "flow4": lambda w, o, t: 1 / (o * t) ** 4,
}
LEAST_RIM = 4      # theta D0 / d
ONE_ORIFICE = 8    # d, of the beds at rest that count
PRIOR = 4          # degrees of freedom
FLOW_BEGINS = 0.7  # s after the opening
WITHIN_95 = 3.84   # -2 log L above the least, of one parameter
FULL = 1           # order of a full vessel; that of a sector is 360 degrees / angle

# An ensemble is the runs that differ in their seed alone. Its key: set, D/d, D0/d, order.
Row = collections.namedtuple("Row", "vessel width orifice theta error of_sectors of_full sectors")


def angle_of(order):
    """Words for the angle of a sector."""
    return f"{360 / order:.4g}°"


def whole_if_so(text):
    """A width in diameters; 0 where the vessel has no orifice."""
    value = float(text or 0)
    return int(value) if value == int(value) else value


def read_runs(data):
    """{(set, run): key of its ensemble}."""
    return {(row["set"], row["run"]): (row["set"], whole_if_so(row["D/d"]), whole_if_so(row["D0/d"]), int(row["n"]))
            for row in kept.read_table(data, "runs") if row["set"] in SETS}


def order_of_part(part):
    """Order n of the part wedge_n<n>_<k>."""
    return int(part.split("_")[1][1:])


def read_scalars(data, numbers):
    """Adds what was measured in each run: under (moment, quantity) of the whole, under (moment, quantity, order)
    a list of the wedges cut from it."""
    for row in kept.read_table(data, "scalars"):
        of_run = numbers.get((row["set"], row["run"]))
        if of_run is None:
            continue
        name, value = (row["moment"], row["quantity"]), float(row["value"])
        if row["part"] == "whole":
            of_run[name] = value
        else:
            of_run.setdefault((*name, order_of_part(row["part"])), []).append(value)


def read_interruptions(data, numbers):
    """Adds ("flow_mean", "interrupted") of each run that has a flow."""
    flows = {}
    for row in kept.read_table(data, "flow"):
        time = float(row["time [s]"])
        if time > FLOW_BEGINS - 1e-6:
            flows.setdefault((row["set"], row["run"]), []).append((time, float(row["out"])))
    for run, rows in flows.items():
        if run in numbers:
            numbers[run]["flow_mean", "interrupted"] = float(interrupted(*np.array(rows).T))


def read_ensembles(data):
    """{key: [numbers of each run]}."""
    keys = read_runs(data)
    numbers = {run: {} for run in keys}
    read_scalars(data, numbers)
    read_interruptions(data, numbers)
    ensembles = {}
    for run, key in keys.items():
        ensembles.setdefault(key, []).append(numbers[run])
    return ensembles


def interrupted(time, out):
    """Whether for some 0.1 s (two rows) fewer grains came than a quarter of what the mean rate would bring."""
    mean = (out[-1] - out[0]) / (time[-1] - time[0])
    return bool((out[2:] - out[:-2] < 0.25 * mean * (time[2:] - time[:-2])).any())


def stopped(run):
    """1 where a flow arched or was interrupted, 0 where not, nan where nothing could flow."""
    arched = run.get(("flow_mean", "arched"), math.nan)
    return max(arched, run.get(("flow_mean", "interrupted"), 0)) if math.isfinite(arched) else math.nan


def size_of(key, runs, quantity):
    """What the spread of a quantity falls with, by its root: grains of the domain, or over its orifice."""
    _, _, orifice, order = key
    if quantity in OF_THE_ORIFICE:
        return orifice**2 / order
    return np.mean([run["settle", "grains"] for run in runs]) / order


def values_of(key, runs, quantity, moment):
    """Values of the runs of an ensemble; of a flow those that are steady, at rest those of one orifice a vessel."""
    if moment == "settle" and key[2] not in (0, ONE_ORIFICE):
        return []
    values = [run.get((moment, quantity), math.nan) for run in runs
              if not (moment == "flow_mean" and stopped(run) == 1)]
    return [value for value in values if math.isfinite(value)]


def relative_spread(values):
    return np.std(values, ddof=1) / abs(np.mean(values)) if len(values) > 1 else 0.0


def pooled_spread(values, sizes):
    """c of the spread c / sqrt(size), over all ensembles; nan where none has two runs."""
    freedom = sum(len(v) - 1 for v in values.values())
    if freedom == 0:
        return math.nan
    return math.sqrt(sum(relative_spread(v) ** 2 * sizes[key] * (len(v) - 1) for key, v in values.items()) / freedom)


def standard_error(values, expected_spread):
    """Of the mean; the spread is drawn towards the expected one as if that were known from PRIOR more runs."""
    own = len(values) - 1
    spread2 = (own * relative_spread(values) ** 2 + PRIOR * expected_spread**2) / (own + PRIOR)
    return math.sqrt(spread2 / len(values))


def errors_of(ensembles, quantity, moment):
    """Rows: vessel (set, D/d, D0/d), D/d, D0/d, theta [rad], error relative to the full vessels, standard errors of
    the sectors and of the full vessels, how many sectors. And c of the spread."""
    values = {key: values_of(key, runs, quantity, moment) for key, runs in ensembles.items()}
    values = {key: v for key, v in values.items() if v}
    sizes = {key: size_of(key, ensembles[key], quantity) for key in values}
    c = pooled_spread(values, sizes)
    if math.isnan(c):
        return [], c
    errors = {key: standard_error(v, c / math.sqrt(sizes[key])) for key, v in values.items()}
    rows = []
    for key in sorted(values):
        name, width, orifice, order = key
        full = (name, width, orifice, FULL)
        if order == FULL or full not in values:
            continue
        error = np.mean(values[key]) / np.mean(values[full]) - 1
        rows.append(Row((name, width, orifice), width, orifice, 2 * math.pi / order, error, errors[key], errors[full],
                        len(values[key])))
    return rows, c


def ruled(rows, moment):
    """The rows that the rules are of."""
    return [row for row in rows if moment != "flow_mean" or row.orifice * row.theta >= LEAST_RIM]


def fit(rows, shape):
    """Factor a with its error, and chi2 per degree of freedom, of error = a shape(D/d, D0/d, theta), by generalised
    least squares: sectors that are compared with the same full vessels share the error of these. An error is never
    less than the scatter about the rule says."""
    x = np.array([shape(row.width, row.orifice, row.theta) for row in rows])
    y = np.array([row.error for row in rows])
    shared = np.array([[a.of_full * b.of_full if a.vessel == b.vessel else 0 for b in rows] for a in rows])
    weights = np.linalg.inv(shared + np.diag([row.of_sectors**2 for row in rows]))
    weight = x @ weights @ x
    a = x @ weights @ y / weight
    chi2 = (y - a * x) @ weights @ (y - a * x) / max(1, len(rows) - 1)
    return a, math.sqrt(max(1, chi2) / weight), chi2


def logistic(x, y):
    """Maximum likelihood of p = 1 / (1 + exp((x - middle) / width)) by a search; returns middle, its standard error
    (half of its range within 95 %, over 1.96), width, -2 log L."""
    middles, widths = np.linspace(0.5, 14, 271), np.geomspace(0.05, 4, 80)
    loss = np.empty((len(middles), len(widths)))
    for i, middle in enumerate(middles):
        p = np.clip(1 / (1 + np.exp(np.clip((x - middle) / widths[:, None], -50, 50))), 1e-9, 1 - 1e-9)
        loss[i] = -2 * np.log(np.where(y > 0, p, 1 - p)).sum(axis=1)
    i, k = np.unravel_index(loss.argmin(), loss.shape)
    near = middles[loss.min(axis=1) < loss.min() + WITHIN_95]
    return middles[i], (near.max() - near.min()) / 2 / 1.96, widths[k], loss.min()


def best_rim(theta, orifice, stops):
    """k of theta (D0 / d - k) for which the stops are likeliest, the range of k within 95 %, and the fits by k."""
    fits = {k: logistic(theta * (orifice - k), stops) for k in np.arange(0, 6.25, 0.25)}
    best = min(fits, key=lambda k: fits[k][-1])
    near = [k for k in fits if fits[k][-1] < fits[best][-1] + WITHIN_95]
    return best, (min(near), max(near)), fits


def in_per_cent(row):
    return f"{100 * row.error:+.1f} ± {100 * math.hypot(row.of_sectors, row.of_full):.1f}"


def print_table(heading, rows):
    print("\n| " + " | ".join(heading) + " |\n|---" + "|---" * (len(heading) - 1) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")


def words_for(vessel):
    name, width, orifice = vessel
    return f"D {width} d, orifice {orifice} d ({name})"


def print_rules(rows):
    fits = {name: fit(rows, shape) for name, shape in SHAPES.items()}
    print_table(["rule", "a", "chi2 / dof"],
                [[name, f"{a:.3g} ± {error:.2g}", f"{chi2:.2f}"] for name, (a, error, chi2) in fits.items()])


def print_errors(ensembles):
    orders = sorted({key[3] for key in ensembles} - {FULL})
    for quantity, moment, meaning in QUANTITIES:
        rows, c = errors_of(ensembles, quantity, moment)
        counted = ruled(rows, moment)
        if len(counted) < 3:
            continue
        over = "orifice" if quantity in OF_THE_ORIFICE else "domain"
        print(f"\n### {meaning} (`{quantity}`, {moment})\n")
        print(f"{len(counted)} ensembles, {sum(row.sectors for row in counted)} sectors; "
              f"spread of runs {c:.2g} / sqrt(grains of the {over})")
        print_rules(counted)
        cells = {(row.vessel, round(2 * math.pi / row.theta)): in_per_cent(row) for row in rows}
        print_table(["vessel", *map(angle_of, orders)],
                    [[words_for(vessel), *(cells.get((vessel, n), "") for n in orders)]
                     for vessel in sorted({row.vessel for row in rows})])


def stops_of(ensembles):
    """{key: [1 where a run arched or was interrupted, else 0]} of the ensembles that can flow."""
    stops = {key: [stopped(run) for run in runs if math.isfinite(stopped(run))] for key, runs in ensembles.items()}
    return {key: values for key, values in stops.items() if values}


def words_for_stops(runs, stops):
    arched = sum(run["flow_mean", "arched"] for run in runs if math.isfinite(stopped(run)))
    paused = sum(stops) - arched
    return f"{arched:.0f}" + (f" + {paused:.0f}" if paused else "") + f" of {len(stops)}"


def print_stops(ensembles):
    stops = stops_of(ensembles)
    orders = sorted({key[3] for key in ensembles} | {FULL})
    cells = {key: words_for_stops(ensembles[key], values) for key, values in stops.items()}
    print("\n### stops: arched (+ interrupted) of all")
    print_table(["vessel", *("full" if n == FULL else angle_of(n) for n in orders)],
                [[words_for(vessel), *(cells.get((*vessel, n), "") for n in orders)]
                 for vessel in sorted({key[:3] for key in stops})])
    print_law_of_stops(stops)


def print_law_of_stops(stops):
    sectors = [(2 * math.pi / order, orifice, stop) for (_, _, orifice, order), values in stops.items()
               if order != FULL and 2 * math.pi / order * orifice >= LEAST_RIM for stop in values]
    best, (low, high), fits = best_rim(*np.array(sectors).T)
    middle, error, width, loss = fits[best]
    print(f"\nHalf of the sectors stop at x = theta (D0 / d - {best:g}) = {middle:.2f} ± {error:.2f}; "
          f"share 1 / (1 + exp((x - {middle:.2f}) / {width:.2f}));\n-2 log L = {loss:.1f} over {len(sectors)} runs "
          f"(with D0 / d alone {fits[0][-1]:.1f}; {low:g} to {high:g} in place of {best:g} are within 95 %)")


def flank_errors(piles):
    """{order: [errors in per cent]} of the angle of repose of wedges cut from full piles, against these."""
    errors = {}
    for (_, _, _, order), runs in piles.items():
        for run in runs if order == FULL else []:
            for name, values in run.items():
                if name[:2] == ("pile", "angle_of_repose") and len(name) == 3:
                    whole = run["pile", "angle_of_repose"]
                    errors.setdefault(name[2], []).extend(100 * (value / whole - 1) for value in values)
    return errors


def print_piles(piles):
    for quantity, meaning, power in OF_THE_PILE:
        rows, _ = errors_of(piles, quantity, "pile")
        if not rows:
            continue
        a, error, chi2 = fit(rows, lambda w, o, t: t**-power)
        print(f"\n### {meaning} (`{quantity}`, pile; plate of 32 d)\n")
        print("; ".join(f"{angle_of(round(2 * math.pi / row.theta))} {in_per_cent(row)}"
                        for row in sorted(rows, key=lambda row: -row.theta)))
        print(f"\nerror = a / theta{'' if power == 1 else '^2'}: a = {a:.3g} ± {error:.2g}, chi2 / dof {chi2:.2f}")
    print("\nAngle of repose of wedges cut from full piles, against these:\n" + "; ".join(
        f"{angle_of(n)} {np.mean(v):+.1f} ± {np.std(v, ddof=1) / math.sqrt(len(v)):.1f}"
        for n, v in sorted(flank_errors(piles).items()) if len(v) > 1))


def main(data=kept.DATA):
    ensembles = read_ensembles(data)
    vessels = {key: runs for key, runs in ensembles.items() if key[0] != "pile"}
    print_errors(vessels)
    print_stops(vessels)
    print_piles({key: runs for key, runs in ensembles.items() if key[0] == "pile"})


if __name__ == "__main__":
    main(*sys.argv[1:2])
