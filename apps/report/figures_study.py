# figures_study.py: across vessels: how narrow a sector may be, and what bounds it.
import math
from html import escape

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from figures_axis import DOTS, scalar_dots
from figures_flow import beverloo_line
from style import Figure, Image, curves, plt, svg
from tables import cell, difference, percent, table

# Vessels in this section: Okabe and Ito's colours, which colour-blind readers tell apart.
TINTS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
SHAPES = "osD^vP*"
STUDIED = [("cn", "rest", "CN at rest", 2), ("cn", "mean", "CN in flow", 2), ("packing", "rest", "packing fraction at rest", 1),
           ("speed", "mean", "root mean square speed", 10), ("discharge_rate", "mean", "discharge rate", 10),
           ("axis_density_1d", "mean", "mass at r < d", 10), ("load", "mean", "mean contact force", 5)]
AXES = [("angle", r"sector angle $\theta$ [deg]", lambda v, a: a),
        ("wall", r"arc at the wall $\theta D\,/\,2d$", lambda v, a: math.radians(a) * v.width / 2),
        ("orifice", r"arc at the orifice's edge $\theta D_0\,/\,2d$", lambda v, a: math.radians(a) * (v.orifice or np.nan) / 2)]


def sectors_of(vessel):
    return [e for e in vessel.main if e.kind == "sector"]


def studied(vessels):
    return [v for v in vessels if v.hopper and v.full is not None and len(sectors_of(v)) >= 3]


def name_of(vessel):
    return f"D = {vessel.width:g} d, $D_0$ = {vessel.orifice:g} d, {vessel.count} grains"


def error_image(vessels, quantity, role, words, limit, axis):
    key, label, place = axis
    figure, axes = curves(3.3, 4.0)
    for k, v in enumerate(vessels):
        moment = v.roles()[role]
        base = v.full.scalar(moment, quantity)
        found = [(e, difference(e.scalar(moment, quantity), base)) for e in sectors_of(v)]
        found = [(place(v, e.angle), *f) for e, f in found if f is not None]
        if not found:
            continue
        x, y, half = (np.array(column, dtype=float) for column in zip(*found))
        axes[0].errorbar(x, y, np.nan_to_num(half), marker=SHAPES[k % 7], color=TINTS[k % 7], capsize=2, linewidth=1.2,
                         markersize=4.5, elinewidth=0.8, label=name_of(v))
    if not axes[0].lines:
        plt.close(figure)
        return None
    axes[0].axhspan(-limit, limit, color="#d9d2c0", alpha=0.6, linewidth=0)
    axes[0].axhline(0, color="#1c1c1c", linewidth=0.9)
    axes[0].set_xscale("log")
    angles = sorted({e.angle for v in vessels for e in sectors_of(v)})
    ticks = angles[::max(1, round(len(angles) / 7))] if key == "angle" else [1, 2, 4, 8, 16, 32, 64]
    axes[0].xaxis.set_major_locator(FixedLocator(ticks))
    axes[0].xaxis.set_minor_locator(NullLocator())
    axes[0].xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes[0].set_xlabel(label)
    axes[0].set_ylabel("sector less full [%]")
    axes[0].set_title(words, loc="left")
    if key == "angle":
        axes[0].legend(fontsize=7)
    return Image(svg(figure), f"Error of {words} against {key}", "")


def smallest_angles(vessels):
    """For each quantity the errors against the angle and against both arcs, and the table of smallest angles."""
    vessels = studied(vessels)
    figures = []
    if not vessels:
        return figures, ""
    several = len(vessels) > 1
    for quantity, role, words, limit in STUDIED:
        images = [error_image(vessels, quantity, role, words, limit, axis) for axis in (AXES if several else AXES[:1])]
        if any(images):
            figures.append(Figure(f"Error against angle: {words}", images, f"Difference of the means of sectors and of the full vessel of "
                                  f"the same size, with its 95 % interval (Student's t over seeds; none where an ensemble has one seed). "
                                  f"Band: \u00b1 {limit} %."
                                  + (" If the arc at the wall decides, curves fall together in the second picture; if the arc at the "
                                     "orifice decides, in the third." if several else "")))
    lines = {}
    for v in vessels:
        lines.setdefault(v.width, []).append(v)
    images = [beverloo_line(group, lambda v: v.main) for group in lines.values() if len({v.orifice for v in group}) > 1]
    if any(images):
        figures.append(Figure("Beverloo's law", images, "Discharge rate to the power 2/5 against the width of the orifice: a line by "
                              "Beverloo's law. Means over seeds with 95 % intervals."))
    return figures, smallest_table(vessels)


def smallest(vessel, quantity, role, limit):
    """The smallest angle down to which every angle's error is within the limit, and whether intervals prove it."""
    moment = vessel.roles()[role]
    base, best, sure = vessel.full.scalar(moment, quantity), None, True
    for e in sectors_of(vessel):  # from wide to narrow
        found = difference(e.scalar(moment, quantity), base)
        if found is None:
            continue
        if abs(found[0]) > limit:
            break
        best = e.angle
        sure = sure and math.isfinite(found[1]) and abs(found[0]) + found[1] <= limit
    return best, sure


def smallest_table(vessels):
    rows = []
    for v in vessels:
        row = [f"D = {v.width:g} d, D<sub>0</sub> = {v.orifice:g} d, {v.count} grains"]
        for quantity, role, _, limit in STUDIED:
            best, sure = smallest(v, quantity, role, limit)
            row.append("\u2013" if best is None else f"{best:g}\u00b0{'' if sure else ' ?'}")
        cn0 = v.full.scalar(v.roles()["rest"], "cn0").mean
        cn0 = cn0 if math.isfinite(cn0) else v.full.scalar(v.roles()["rest"], "cn").mean
        paper = math.degrees(4.62 / (v.width / 2) * math.sqrt(max(cn0 / 3 - 1, 0) / (0.02 * cn0))) if cn0 > 0 else float("nan")
        rows.append(row + [f"{paper:.0f}\u00b0", f"{math.degrees(6 / v.orifice):.0f}\u00b0"])
    head = ["vessel"] + [f"{words}<br><small>within {limit} %</small>" for _, _, words, limit in STUDIED]
    head += ["by the paper's CN line", "6 d / D<sub>0</sub>"]
    return table(head, rows, "Smallest angle down to which the difference to the full vessel stays within the limit; \u201c?\u201d: within it, but "
                 "the 95 % interval is not. Last two columns: two rules, (4.62 / (D/2d)) ((CN0/3 - 1) / (0.02 CN0))<sup>1/2</sup> for 2 % "
                 "in CN, and 6 d / D0.")


SIDES = [("packing", "rest"), ("cn", "rest"), ("cn", "mean"), ("axis_density_1d", "mean"), ("axis_density_2d", "mean"),
         ("speed", "mean"), ("discharge_rate", "mean"), ("arched", "mean")]


def sides(vessel, vessels):
    """Sectors with other sides or another axis treatment beside the plain ones, and a slot of the same widths."""
    slots = [e for v in vessels if (v.width, v.orifice) == (vessel.width, vessel.orifice) for e in v.ensembles if e.kind == "slot"]
    angles = {e.angle for e in vessel.others}
    if not angles:
        return None
    members = [e for e in vessel.ensembles if e.full or e.angle in angles] + slots
    roles, rows = vessel.roles(), []
    base = {q: vessel.full.scalar(roles[role], q) for q, role in SIDES} if vessel.full else {}
    for e in members:
        row = [escape("full" if e.full else "slot" if e.kind == "slot" else f"{e.angle:g}\u00b0, sides {e.sides}, axis {e.axis}"), str(len(e.runs))]
        for quantity, role in SIDES:
            sample = e.scalar(roles[role], quantity)
            row.append(f"{int(sample.values.sum())} of {sample.n}" if quantity == "arched" and sample.n else cell(sample)
                       + (f"<br><small>{percent(difference(sample, vessel.full.scalar(roles[role], quantity)))} %</small>"
                          if sample.n and not e.full and base and not (e.kind == "slot" and quantity == "discharge_rate") else ""))
        rows.append(row)
    head = ["ensemble", "seeds"] + [f"<code>{q}</code><br><small>{escape(str(roles[role]))}</small>" for q, role in SIDES]
    text = table(head, rows, "Means over seeds \u00b1 standard deviation; below each the difference to the full vessel with its 95 % "
                 "interval. The discharge of a slot is another quantity: it is not compared.")
    drawn = [e for e in members if e.kind != "slot"]
    images = [scalar_dots(vessel, drawn, roles["mean"], "discharge_rate", "discharge rate [1/s]"),
              scalar_dots(vessel, members, roles["mean"], "cn", "CN in flow"),
              scalar_dots(vessel, members, roles["rest"], "packing", "packing fraction at rest"),
              scalar_dots(vessel, members, roles["mean"], "axis_density_1d", "mass at r < d, over that of the bulk", line=1)]
    return Figure("What bounds a sector: sides and axis", images, DOTS, layout="wide", extra=text)
