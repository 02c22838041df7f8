# figures_study.py: across vessels: how narrow a sector may be, and what bounds it.
import math
from html import escape

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from ensembles import counted, grouped, student
from figures_axis import DOTS, scalar_dots
from figures_flow import beverloo_line
from style import Figure, Image, curves, frame_values, plt, svg
from vocabulary import angle_label
from tables import cell, difference, digits, percent, table

# Vessels in this section: Okabe and Ito's colours, which colour-blind readers tell apart, in as many turns of the markers.
TINTS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
SHAPES = "osD^vP*"
ASIDE = 0.14  # vessels at one angle stand side by side in the picture of arches: over this range of the logarithm
MANY = 4  # runs from which on a share of arches is drawn with its interval
ZONE_LAW = [("packing", "rest"), ("cn_distinct", "rest")]  # quantities whose errors fall with (d / (D theta))^2
ZONE_LIMIT = 2  # of the packing, per cent
STUDIED = [("cn", "rest", "CN at rest", 2), ("cn_distinct", "rest", "CN of distinct neighbours at rest", 2),
           ("cn", "mean", "CN in flow", 2), ("cn_distinct", "mean", "CN of distinct neighbours in flow", 2),
           ("packing", "rest", "packing fraction at rest", 1),
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
    return f"D = {vessel.width:g} d, $D_0$ = {vessel.orifice:g} d, {grouped(vessel.count)} grains"


def look(k):
    """Colour and marker of vessel k: no two alike of as many as there are pairs of them."""
    return {"color": TINTS[k % len(TINTS)], "marker": SHAPES[(k + k // len(TINTS)) % len(SHAPES)], "markersize": 4.5}


def legend(vessels, *more):
    """The vessels' colours and markers as a strip by itself, below the pictures of a figure. more: other lines, {words: look}."""
    figure = plt.figure(figsize=(4.4, 0.1 + 0.18 * math.ceil((len(vessels) + len(more)) / 2)))
    handles = [plt.Line2D([], [], label=name_of(v), linewidth=1.2, **look(k)) for k, v in enumerate(vessels)]
    handles += [plt.Line2D([], [], label=words, **style) for words, style in more]
    figure.legend(handles=handles, loc="center", ncol=2, fontsize=7.5, borderpad=0, columnspacing=1.2, handlelength=1.8)
    return Image(svg(figure), "Colour scale: colours and markers of the vessels", "")


def of_flow(e, moment, quantity, role):
    """In flow only runs that flow are compared: arched ones are counted by themselves."""
    return e.flowing(moment, quantity) if role == "mean" else e.scalar(moment, quantity)


def dress(axes, vessels, key, label):
    axes.set_xscale("log")
    angles = sorted({e.angle for v in vessels for e in sectors_of(v)})
    ticks = angles[::max(1, round(len(angles) / 7))] if key == "angle" else [1, 2, 4, 8, 16, 32, 64]
    axes.xaxis.set_major_locator(FixedLocator(ticks))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:.3g}")
    axes.set_xlabel(label)


def arched_image(vessels, axis):
    """Share of sectors that stopped, with Wilson's 95 % interval; of few runs a hollow marker."""
    key, label, place = axis
    figure, axes = curves(3.3, 4.0)
    for k, v in enumerate(vessels):
        found = [(place(v, e.angle), e.scalar(v.roles()["mean"], "arched")) for e in sectors_of(v)]
        found = [(x, s.mean, s.n) for x, s in found if s.n]
        if not found:
            continue
        x, share, n = (np.array(column, dtype=float) for column in zip(*found))
        x *= math.exp(ASIDE * ((k + 0.5) / len(vessels) - 0.5))
        z = 1.96
        middle = (share + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * np.sqrt(share * (1 - share) / n + z * z / (4 * n * n))
        spread = np.clip([share - (middle - half), middle + half - share], 0, None)
        many = n >= MANY
        axes[0].errorbar(x[many], 100 * share[many], 100 * spread[:, many], capsize=2, linewidth=1.0, elinewidth=0.8, **look(k))
        axes[0].plot(x[~many], 100 * share[~many], linestyle="", markerfacecolor="white", **look(k))
    if not axes[0].lines:
        plt.close(figure)
        return None
    dress(axes[0], vessels, key, label)
    axes[0].set_ylabel("sectors that arched [%]")
    axes[0].set_ylim(-4, 104)
    return Image(svg(figure), f"Share of sectors that arched against {key}", "")


def one_orifice(vessels):
    """Of vessels that differ by the orifice alone the one with the most runs: at rest the same seed gives all of them the same bed."""
    best = {}
    for v in vessels:
        runs = sum(len(e.runs) for e in v.ensembles)
        if (v.width, v.count) not in best or runs > best[v.width, v.count][0]:
            best[v.width, v.count] = (runs, v)
    return [v for _, v in best.values()]


def zone_law(vessels, quantity, role):
    """a of error = a (d / (D theta))^2 with half its 95 % interval and the number of ensembles, by least squares; None of fewer than
    three. The variance of a mean goes down with the grains it is of, so the weight of a difference of two is 1 / (1/N + 1/N_full)."""
    x, y, weight = [], [], []
    for v in one_orifice(vessels):
        moment = v.roles()[role]
        base = v.full.scalar(moment, quantity)
        for e in sectors_of(v):
            sample = e.scalar(moment, quantity)
            found = difference(sample, base)
            if found is not None:
                x.append((v.width * math.radians(e.angle)) ** -2)
                y.append(found[0] / 100)
                weight.append(v.count / (e.order / sample.n + 1 / base.n))
    if len(x) < 3:
        return None
    x, y, weight = np.array(x), np.array(y), np.array(weight)
    a = (weight * x * y).sum() / (weight * x * x).sum()
    spread = (weight * (y - a * x) ** 2).sum() / (len(x) - 1)
    return a, student(len(x)) * math.sqrt(spread / (weight * x * x).sum()), len(x)


def zone_words(law):
    a, half, n = law
    return f"a = {digits(a, half)} \u00b1 {digits(half, half)} (95 %; {counted(n, 'ensemble')})".replace("-", "\u2212")


RULE = {"color": "#1c1c1c", "linewidth": 1.3, "linestyle": (0, (5, 2))}


def error_image(vessels, quantity, role, words, limit, axis, law=None):
    """law: that of zone_law, drawn as a line."""
    key, label, place = axis
    figure, axes = curves(3.3, 4.0)
    shown = [[-limit, limit]]
    for k, v in enumerate(vessels):
        moment = v.roles()[role]
        base = of_flow(v.full, moment, quantity, role)
        found = [(e, difference(of_flow(e, moment, quantity, role), base)) for e in sectors_of(v)]
        found = [(place(v, e.angle), *f) for e, f in found if f is not None]
        if not found:
            continue
        x, y, half = (np.array(column, dtype=float) for column in zip(*found))
        shown.append(y)
        axes[0].errorbar(x, y, np.nan_to_num(half), capsize=2, linewidth=1.2, elinewidth=0.8, **look(k))
    if not axes[0].lines:
        plt.close(figure)
        return None
    if law:
        v = vessels[0]
        found = [w.width / v.width * e.angle for w in vessels for e in sectors_of(w)]
        angles = np.geomspace(min(found), max(found))
        error = 100 * law[0] / (v.width * np.radians(angles)) ** 2
        axes[0].plot([place(v, angle) for angle in angles], error, zorder=4, **RULE)
    axes[0].axhspan(-limit, limit, color="#d9d2c0", alpha=0.6, linewidth=0)
    axes[0].axhline(0, color="#1c1c1c", linewidth=0.9)
    dress(axes[0], vessels, key, label)
    axes[0].set_ylabel("sector less full [%]")
    frame_values(axes[0], shown)
    return Image(svg(figure), f"Error of {words} against {key}", "")


def smallest_angles(vessels):
    """For each quantity the errors against the angle and against both arcs, and the table of smallest angles."""
    vessels = studied(vessels)
    figures = []
    if not vessels:
        return figures, ""
    several = len(vessels) > 1
    decisive = "wall" if several else "angle"  # the picture in which one line is the rule of all vessels
    for quantity, role, words, limit in STUDIED:
        law = zone_law(vessels, quantity, role) if (quantity, role) in ZONE_LAW else None
        images = [error_image(vessels, quantity, role, words, limit, axis, law if axis[0] == decisive else None)
                  for axis in (AXES if several else AXES[:1])]
        if any(images):
            rule = [(r"error = a (d / (D $\theta$))$^2$", RULE)] if law else []
            figures.append(Figure(f"Error against angle: {words}", images + [legend(vessels, *rule)],
                                  "Difference of the means of sectors and of the full vessel of the same size, with its 95 % interval "
                                  "(Student's t over seeds; none where an ensemble has one seed; of two it may reach beyond the picture). "
                                  f"Band: \u00b1 {limit} %."
                                  + (" Runs that had arched are left out." if role == "mean" else "")
                                  + (" If the arc at the wall decides, curves fall together in the second picture; if the arc at the "
                                     "orifice decides, in the third." if several else "")
                                  + (f" Dashed: error = a (d / (D \u03b8))\u00b2, {zone_words(law)}, fitted to these ensembles (how: table "
                                     "of smallest angles)." if law else "")))
    images = [arched_image(vessels, axis) for axis in (AXES if several else AXES[:1])]
    if any(images):
        figures.append(Figure("Arching against angle", images + [legend(vessels)], "Share of the sectors whose discharge had stopped, with "
                              f"its 95 % interval (Wilson); hollow, without one, where there are fewer than {MANY} runs."
                              + (" Vessels at one place stand side by side." if several else "")))
    lines = {}
    for v in vessels:
        lines.setdefault(v.width, []).append(v)
    images = [beverloo_line(group, lambda v: v.main) for group in lines.values() if len({v.orifice for v in group}) > 1]
    if any(images):
        figures.append(Figure("Beverloo's law", images, "Discharge rate to the power 2/5 against the width of the orifice: a line by "
                              "Beverloo's law. Here colours stand for angles. Means over seeds; runs that had arched are left out. "
                              "95 % intervals, not below 0 (none of one seed; of two they may reach beyond the picture)."))
    return figures, smallest_table(vessels)


def smallest(vessel, quantity, role, limit):
    """The smallest angle down to which every angle's error is within the limit, and whether intervals prove it. An angle at which all
    sectors arched ends the flow; one without this quantity was not run, and is passed over."""
    moment = vessel.roles()[role]
    base, best, sure = of_flow(vessel.full, moment, quantity, role), None, True
    for e in sectors_of(vessel):  # from wide to narrow
        if role == "mean" and e.scalar(moment, "arched").mean == 1:
            break
        found = difference(of_flow(e, moment, quantity, role), base)
        if found is None:
            continue
        if abs(found[0]) > limit:
            break
        best = e.angle
        sure = sure and math.isfinite(found[1]) and abs(found[0]) + found[1] <= limit
    return best, sure


def smallest_table(vessels):
    rows, law = [], zone_law(vessels, *ZONE_LAW[0])
    for v in vessels:
        row = [f"D = {v.width:g} d, D<sub>0</sub> = {v.orifice:g} d, {grouped(v.count)} grains"]
        for quantity, role, _, limit in STUDIED:
            best, sure = smallest(v, quantity, role, limit)
            row.append("\u2013" if best is None else f"{best:.3g}\u00b0{'' if sure else ' ?'}")
        cn0 = v.full.scalar(v.roles()["rest"], "cn0").mean
        cn0 = cn0 if math.isfinite(cn0) else v.full.scalar(v.roles()["rest"], "cn").mean
        zone = math.degrees(math.sqrt(max(law[0], 0) / (ZONE_LIMIT / 100)) / v.width) if law else float("nan")
        paper = math.degrees(4.62 / (v.width / 2) * math.sqrt(max(cn0 / 3 - 1, 0) / (0.02 * cn0))) if cn0 > 0 else float("nan")
        rules = [zone, paper, math.degrees(6 / v.orifice)]
        rows.append(row + [f"{angle:.0f}\u00b0" if math.isfinite(angle) else "\u2013" for angle in rules])
    head = ["vessel"] + [f"{escape(words)}<br><small>within {limit} %</small>" for _, _, words, limit in STUDIED]
    head += [f"by the rule found here<br><small>packing fraction at rest within {ZONE_LIMIT} %</small>", "by the paper's CN line",
             "6 d / D<sub>0</sub>"]
    told = (f"Of the first, \u03b8 = (d / D) (a / {ZONE_LIMIT / 100:g})<sup>1/2</sup>, {zone_words(law)} is fitted to the errors of the "
            "packing fraction at rest of all sectors of these vessels: least squares of error = a (d / (D \u03b8))<sup>2</sup>, each "
            "weighted by 1 / (1/N + 1/N<sub>full</sub>), N the grains of all its runs together, since the variance of a mean goes down "
            "with them; of vessels that differ by the orifice alone, which hold the same beds, one counts. " if law else "")
    return table(head, rows, "Smallest angle down to which the difference to the full vessel stays within the limit; \u201c?\u201d: within "
                 "it, but the 95 % interval is not. In flow, of runs that had not arched, and above any angle at which all had. Last three "
                 "columns: rules. " + told + "Of the paper, (4.62 / (D/2d)) ((CN0/3 - 1) / (0.02 CN0))<sup>1/2</sup> for 2 % in CN; "
                 "and 6 d / D<sub>0</sub>.")


SIDES = [("packing", "rest"), ("cn", "rest"), ("cn", "mean"), ("axis_density_1d", "mean"), ("axis_density_2d", "mean"),
         ("speed", "mean"), ("discharge_rate", "mean"), ("arched", "mean")]


def sides(vessel, vessels):
    """Sectors with other sides or another axis treatment beside the plain ones, and a slot of the same widths."""
    slots = [e for v in vessels if (v.width, v.orifice) == (vessel.width, vessel.orifice) for e in v.ensembles if e.kind == "slot"]
    angles = {e.angle for e in vessel.others if e.kind == "sector"}
    if not angles:
        return None
    members = [e for e in vessel.ensembles if e.full or e.angle in angles] + slots
    roles, rows = vessel.roles(), []
    base = {q: vessel.full.scalar(roles[role], q) for q, role in SIDES} if vessel.full else {}
    for e in members:
        name = "full" if e.full else "slot" if e.kind == "slot" else f"{angle_label(e.order)}, sides {e.sides}, axis {e.axis}"
        row = [escape(name), str(len(e.runs))]
        for quantity, role in SIDES:
            sample = e.scalar(roles[role], quantity)
            row.append(f"{int(sample.values.sum())} of {sample.n}" if quantity == "arched" and sample.n else cell(sample)
                       + (f"<br><small>{percent(difference(sample, vessel.full.scalar(roles[role], quantity)))} %</small>"
                          if sample.n and not e.full and base and quantity != "arched"
                          and not (e.kind == "slot" and quantity == "discharge_rate") else ""))
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
