# figures_distributions.py: distributions over grains and contacts, means over seeds with a band, and their ratio to full.
import numpy as np

from ensembles import counted
from vocabulary import axis_zone
from style import Figure, Image, curves, colour, line_style, marker, plt, svg

BAND = "Lines: means over seeds; bands: \u00b1 one standard deviation over seeds (none where there is one seed)."


def aligned(members, quantity, moment, region="all"):
    """First bin, scale, step and {ensemble: shares [seed, bin]}, all from the same first bin on."""
    found = [(e,) + e.distribution(moment, quantity, region) for e in members]
    binnings = [b for _, runs, b in found if runs]
    if not binnings:
        return None
    runs_of = {e: runs for e, runs, b in found if runs and b == binnings[0]}
    first = min(f for runs in runs_of.values() for f, _ in runs)
    last = max(f + len(s) for runs in runs_of.values() for f, s in runs)
    table = {}
    for e, runs in runs_of.items():
        rows = np.zeros((len(runs), last - first))
        for k, (f, shares) in enumerate(runs):
            rows[k, f - first:f - first + len(shares)] = shares
        table[e] = rows
    return first, binnings[0][0], binnings[0][1], table


def edges(first, count, scale, step):
    m = np.arange(first, first + count + 1)
    return m - 0.5 if step == 0 else scale * np.sinh(m * step)


def quantile(edge, share, q):
    return float(np.interp(q, np.concatenate([[0], np.cumsum(share)]), edge))


def merged(edge, table, low, high):
    """Bins between low and high joined to a sixtieth of the range at least, each with something in it."""
    pooled = sum(rows.mean(axis=0) for rows in table.values()) / len(table)
    least = (high - low) / 60
    cuts = [int(np.searchsorted(edge, low))]
    for k in range(cuts[0] + 1, min(int(np.searchsorted(edge, high)) + 1, len(edge))):
        if edge[k] - edge[cuts[-1]] >= least and pooled[cuts[-1]:k].sum() > 1e-4:
            cuts.append(k)
    wide = np.diff(edge[cuts])
    return edge[cuts], {e: np.add.reduceat(rows[:, :cuts[-1]], cuts[:-1], axis=1) / wide for e, rows in table.items()}


def legend_text(e, rows):
    return f"{e.label} ({counted(len(rows), 'seed')})"


def around(mean, sd, log):
    """Edges of the band: mean -+ sd; on a logarithmic axis those of a lognormal with this mean and deviation."""
    if not log:
        return mean - sd, mean + sd
    with np.errstate(divide="ignore", invalid="ignore"):
        width = np.sqrt(np.log1p((sd / mean) ** 2))
        return mean * np.exp(-width), mean * np.exp(width)


def band(axes, x, rows, e, log=False, **more):
    mean = rows.mean(axis=0)
    mean = np.where(mean > 0, mean, np.nan) if log else mean
    axes.plot(x, mean, label=legend_text(e, rows), **{**line_style(e), **more})
    if len(rows) > 1:
        low, high = around(mean, rows.std(axis=0, ddof=1), log)
        axes.fill_between(x, low, high, color=colour(e), alpha=0.16, linewidth=0)


def ratio_panel(axes, x, table, full, label):
    """Each ensemble's mean over that of the full vessel; grey: the full vessel's own seeds."""
    base = table[full].mean(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        if len(table[full]) > 1:
            low, high = around(np.ones(len(base)), table[full].std(axis=0, ddof=1) / base, log=True)
            axes.fill_between(x, low, high, color="#bdbdbd", alpha=0.6, linewidth=0)
        axes.axhline(1, color="#1c1c1c", linewidth=1)
        for e, rows in table.items():
            if e is not full:
                axes.plot(x, np.where(rows.mean(axis=0) > 0, rows.mean(axis=0), np.nan) / base, **{**line_style(e), "linewidth": 1.2})
    axes.set_yscale("log", base=2)
    axes.set_ylim(1 / 5, 5)
    axes.set_yticks([1 / 4, 1 / 2, 1, 2, 4])
    axes.set_yticklabels(["1/4", "1/2", "1", "2", "4"])
    axes.set_ylabel("sector / full")
    axes.set_xlabel(label)


def cn_image(vessel, moment, quantity="cn", symbol="CN"):
    bins = aligned(vessel.gallery, quantity, moment)
    if bins is None:
        return None
    first, _, _, table = bins
    last = int(max(np.flatnonzero(rows.mean(axis=0) > 5e-4).max() for rows in table.values())) + 1
    x = np.arange(first, first + last)
    table = {e: 100 * rows[:, :last] for e, rows in table.items()}
    full = vessel.full if vessel.full in table else None
    figure, axes = curves(4.2 if full else 3.0, rows=2 if full else 1, ratios=[2.2, 1] if full else None)
    for e, rows in table.items():
        band(axes[0], x, rows, e, marker=marker(e))
    axes[0].set_ylabel("grains [%]")
    axes[0].set_ylim(0, None)
    axes[0].legend()
    if full:
        base = table[full]
        if len(base) > 1:
            sd = base.std(axis=0, ddof=1)
            axes[1].fill_between(x, -sd, sd, color="#bdbdbd", alpha=0.6, linewidth=0)
        axes[1].axhline(0, color="#1c1c1c", linewidth=1)
        for e, rows in table.items():
            if e is not full:
                axes[1].plot(x, rows.mean(axis=0) - base.mean(axis=0), marker=marker(e), **{**line_style(e), "linewidth": 1.2})
        axes[1].set_ylabel("sector $-$ full [%]")
    axes[-1].set_xlabel(f"coordination number {symbol}")
    return Image(svg(figure), f"Distribution of the coordination number, {vessel.when(moment)}", vessel.brief(moment))


def zone_image(vessel, moment, quantity="cn"):
    """Each sector's axis zone beside the full vessel's within the same distance from the axis."""
    figure, axes = curves(3.0)
    for e in vessel.gallery:
        if e.kind != "sector":
            continue
        for members, style in (([e], {}), ([vessel.full] if vessel.full else [], {"linestyle": ":", "linewidth": 1.4})):
            bins = aligned(members, quantity, moment, axis_zone(e.order))
            if bins is None:
                continue
            first, _, _, table = bins
            for member, rows in table.items():
                x = np.arange(first, first + rows.shape[1])
                axes[0].plot(x, 100 * rows.mean(axis=0), label=legend_text(e, rows) if not style else None,
                             **{**line_style(e), **style})
    if not axes[0].lines:
        plt.close(figure)
        return None
    axes[0].set_ylabel("grains of the axis zone [%]")
    axes[0].set_xlabel("coordination number CN")
    axes[0].set_ylim(0, None)
    axes[0].legend(fontsize=7.5)
    return Image(svg(figure), f"Distribution of the coordination number in the axis zone, {vessel.when(moment)}",
                 f"{vessel.brief(moment)}, axis zone")


def cn_distributions(vessel, moments, paper=None):
    moments = [m for m in dict.fromkeys(moments) if m]
    images = [cn_image(vessel, m) for m in moments] + [zone_image(vessel, m) for m in moments]
    caption = (f"Share of the grains of the bed by coordination number (contacts with overlap > 0, walls not counted). {BAND} Below: "
               "sector less full, in percentage points; grey: standard deviation over the seeds of the full vessel. Axis zone: r < 4 d / theta; dotted, the full vessel\u2019s "
               "grains within the same distance.")
    return Figure("Distribution of the coordination number", images, caption, paper)


def density_image(vessel, moment, quantity, unit, label, region="all", tail=3e-4):
    bins = aligned(vessel.gallery, quantity, moment, region)
    if bins is None:
        return None
    first, scale, step, table = bins
    edge = edges(first, next(iter(table.values())).shape[1], scale, step) / unit
    low = min(quantile(edge, rows.mean(axis=0), tail) for rows in table.values())
    high = max(quantile(edge, rows.mean(axis=0), 1 - tail) for rows in table.values())
    if not high > low:
        return None
    edge, table = merged(edge, table, low, high)
    if len(edge) < 4:
        return None
    x = (edge[1:] + edge[:-1]) / 2
    full = vessel.full if vessel.full in table else None
    figure, axes = curves(4.2 if full else 3.0, rows=2 if full else 1, ratios=[2.2, 1] if full else None)
    for e, rows in table.items():
        band(axes[0], x, rows, e, log=True)
    axes[0].set_yscale("log")
    floor = min(rows.mean(axis=0)[rows.mean(axis=0) > 0].min() for rows in table.values())
    axes[0].set_ylim(floor / 2, None)
    axes[0].set_ylabel("probability density")
    axes[0].legend(loc="best")
    if full:
        ratio_panel(axes[1], x, table, full, label)
    axes[-1].set_xlabel(label)
    return Image(svg(figure), f"Distribution of {quantity}, {vessel.when(moment)}", vessel.brief(moment))


def densities(vessel, names, moments, unit, label, title, meaning, paper=None):
    """One image a quantity and moment. label: with {} for the index of the component."""
    images = [density_image(vessel, moment, name, unit, label[name]) for moment in dict.fromkeys(moments) if moment
              for name in names]
    caption = (f"{meaning} {BAND} On a logarithmic axis the band is that of a lognormal with this mean and deviation. Below: the sector's "
               "mean density over that of the full vessel; grey: band of the full vessel's own seeds.")
    return Figure(title, images, caption, paper)


def velocities(vessel, moments, paper=None):
    unit = float(np.sqrt(9.81 * vessel.d))
    label = {f"v{c}": rf"$v_{c}\,/\,\sqrt{{g\,d}}$" for c in "rtz"}
    return densities(vessel, ["vr", "vt", "vz"], moments, unit, label, "Distributions of velocity",
                     f"Components of the velocities of the grains of the bed along the radius (r), the azimuth (t) and upwards (z), "
                     f"in units of sqrt(g d) = {unit:.3g} m/s.", paper)


def forces(vessel, moments, weight, paper=None):
    label = {"fr": r"$F_r\,/\,mg$", "ft": r"$F_t\,/\,mg$", "fz": r"$F_z\,/\,mg$"}
    return densities(vessel, ["fr", "ft", "fz"], moments, weight, label, "Distributions of total normal force",
                     "Components along radius (r), azimuth (t) and upwards (z) of the sum of the normal forces of other grains on a "
                     f"grain, in weights of a grain ({weight:.3g} N).", paper)


def loads(vessel, moments, weight):
    return densities(vessel, ["load"], moments, weight, {"load": r"normal force of a contact $f_n\,/\,mg$"},
                     "Distribution of contact forces", f"Normal force of each contact between grains, in weights of a grain ({weight:.3g} N).")
