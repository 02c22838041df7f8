# figures_axis.py: what happens near the axis: CN against arc length, its correction, radial profiles, mass at the axis.
import numpy as np

from ensembles import Sample
from figures_distributions import BAND, legend_text
from vocabulary import AXIS_ZONE_ARC
from style import FULL, Figure, Image, colour, curves, frame_values, line_style, marker, svg


def sectors(vessel):
    return [e for e in vessel.gallery if not e.full and e.kind == "sector"]


def profile_line(axes, x, found, e, keep=None):
    _, _, mean, sd, seeds = found
    keep = np.isfinite(mean) if keep is None else keep & np.isfinite(mean)
    axes.plot(x[keep], mean[keep], label=legend_text(e, range(seeds)), marker=marker(e), **{**line_style(e), "linewidth": 1.3})
    axes.fill_between(x[keep], (mean - sd)[keep], (mean + sd)[keep], color=colour(e), alpha=0.16, linewidth=0)


COUNTS = {"cn": "CN", "cn_distinct": "CN, distinct neighbours"}


def off_wall(vessel, found):
    """Rings at least 2 d from the wall."""
    return found[0] / vessel.d <= vessel.width / 2 - 2


def arc_image(vessel, moment, column):
    figure, axes = curves(3.6, 3.9)
    drawn, far = False, []
    for e in sectors(vessel):
        found = e.profile(moment, column)
        if found is None:
            continue
        profile_line(axes[0], found[1], found, e, (found[1] <= 2 * AXIS_ZONE_ARC) & off_wall(vessel, found))
        far.append(e.scalar(moment, "cn0").mean)
        drawn = True
    if not drawn:
        figure.clf()
        return None
    cn0 = float(np.nanmean(far)) if np.isfinite(far).any() else float("nan")
    if np.isfinite(cn0):
        arc = np.array([0, AXIS_ZONE_ARC, 2 * AXIS_ZONE_ARC])
        line = np.where(arc <= AXIS_ZONE_ARC, (cn0 / 3 - 1) * arc + 4 - cn0 / 3, cn0)
        axes[0].plot(arc, line, color="#1c1c1c", linewidth=1.6, linestyle=(0, (5, 2)), zorder=4,
                     label=f"Yang et al. 2014, CN$_0$ = {cn0:.2f}")
    if vessel.full is not None:
        level = vessel.full.scalar(moment, "cn0")
        if level.n:
            axes[0].axhline(level.mean, color=FULL, linewidth=1, linestyle=":", label=f"full, bulk: {level.mean:.2f}")
    axes[0].axvline(AXIS_ZONE_ARC, color="#9a9a9a", linewidth=0.8)
    axes[0].set_xlabel(r"arc length $r\,\theta\,/\,d$")
    axes[0].set_ylabel(COUNTS[column])
    axes[0].set_xlim(0, 2 * AXIS_ZONE_ARC)
    axes[0].legend(loc="lower right")
    return Image(svg(figure), f"{COUNTS[column]} against arc length, {vessel.when(moment)}", vessel.brief(moment))


def cn_arc(vessel, moments, paper=None):
    images = [arc_image(vessel, m, column) for column in ("cn_distinct", "cn") for m in dict.fromkeys(moments) if m]
    caption = ("Mean CN of bulk grains in rings d/2 wide, 2 d and more from the wall, against the length of the arc between the faces. "
               "Distinct neighbours: one that touches directly and through the seam counts once; CN: each contact counts. " + BAND +
               " Dashed: the paper's line CN = (CN0/3 - 1) r theta/d + 4 - CN0/3 below 4 d, CN0 beyond, with CN0 the mean beyond 4 d "
               "of the sectors here. Dotted: bulk of the full vessel. Fitted k and b: table below.")
    extra = fit_table(vessel, [m for m in dict.fromkeys(moments) if m])
    return Figure("Coordination number against arc length", images, caption, paper, extra=extra)


def fit_table(vessel, moments):
    from tables import cell, table
    rows = []
    for moment in moments:
        for e in sectors(vessel):
            found = [e.scalar(moment, q) for q in ("cn0", "cn_slope_paper", "cn_distinct_slope", "cn_slope", "cn_intercept_paper",
                                                   "cn_distinct_intercept", "cn_intercept")]
            if found[3].n:
                rows.append([moment, e.label, str(found[3].n)] + [cell(sample) for sample in found])
    head = ["moment", "sector", "seeds", "CN0", "k<br><small>paper's line</small>", "k<br><small>distinct</small>",
            "k<br><small>CN</small>", "b<br><small>paper's line</small>", "b<br><small>distinct</small>", "b<br><small>CN</small>"]
    return table(head, rows, "Fit CN = k r theta/d + b at arcs below 4 d: means \u00b1 standard deviations over seeds.") if rows else ""


def corrected(vessel, moments, paper=None):
    images = []
    for moment in dict.fromkeys(m for m in moments if m):
        figure, axes = curves(4.2, 3.9, rows=2)
        for e in vessel.gallery:
            for row, column in enumerate(("cn_distinct", "cn_distinct" if e.full else "cn_corrected")):
                found = e.profile(moment, column) or e.profile(moment, column.replace("_distinct", ""))
                if found is not None:
                    profile_line(axes[row], found[0] / vessel.d, found, e)
        if not axes[0].lines:
            figure.clf()
            continue
        low = min(axis.get_ylim()[0] for axis in axes)
        high = max(axis.get_ylim()[1] for axis in axes)
        for axis, what in zip(axes, ("CN, distinct", "CN corrected")):
            axis.set_ylim(low, high)
            axis.set_ylabel(what)
        axes[1].legend(ncol=2, fontsize=7.5, loc="lower left")
        axes[1].set_xlabel("r / d")
        images.append(Image(svg(figure), f"CN and corrected CN against radius, {vessel.when(moment)}", vessel.brief(moment)))
    caption = ("Mean CN of bulk grains in rings d/2 wide. Above distinct neighbours; below with the paper's correction of sectors "
               "(full: none): CN CN0 / (k r theta/d + b) below an arc of 4 d. " + BAND)
    return Figure("Corrected coordination number", images, caption, paper)


PROFILES = [("vz", r"$v_z\,/\,\sqrt{g\,d}$", "speed"), ("vr", r"$v_r\,/\,\sqrt{g\,d}$", "speed"),
            ("speed_spread", r"$\delta v\,/\,\sqrt{g\,d}$", "speed"), ("grains", "grains per area, ring / mean", "density")]


def profiles(vessel, moment):
    images = []
    for column, label, kind in PROFILES:
        figure, axes = curves(3.0, 3.7)
        for e in vessel.gallery:
            found = e.profile(moment, column)
            if found is None:
                continue
            r, arc, mean, sd, seeds = found
            scale = np.full(len(r), np.sqrt(9.81 * vessel.d))
            if kind == "density":
                area = r / np.nansum(r)
                scale = area * np.nansum(mean)
            profile_line(axes[0], r / vessel.d, (r, arc, mean / scale, sd / scale, seeds), e)
        if not axes[0].lines:
            figure.clf()
            continue
        axes[0].set_xlabel("r / d")
        axes[0].set_ylabel(label)
        axes[0].legend(fontsize=7.5)
        images.append(Image(svg(figure), f"Radial profile of {column}, {vessel.when(moment)}", ""))
    caption = (f"Moment: {vessel.when(moment)}. Grains of the bulk in rings d/2 wide: mean vertical and radial velocity, root mean "
               "square of v minus its mean in the ring, and the number of grains per area over its mean. " + BAND)
    return Figure("Radial profiles", images, caption)


def dots(axes, x, samples, members):
    """Each seed a small dot, the mean a large one with its 95 % interval."""
    for place, sample, e in zip(x, samples, members):
        if not sample.n:
            continue
        if sample.n > 1:
            axes.scatter(place + 0.28 * (np.arange(sample.n) / max(sample.n - 1, 1) - 0.5), sample.values, s=9, color=colour(e),
                         alpha=0.45, linewidths=0)
        axes.errorbar([place], [sample.mean], [0 if np.isnan(sample.half) else sample.half], color=colour(e), marker=marker(e),
                      markersize=7, capsize=4, linewidth=1.6)
    axes.set_xticks(list(x))
    axes.set_xticklabels([short(e) for e in members])
    axes.grid(axis="x", visible=False)


def short(e):
    return e.label.replace(", ", "\n").replace("axis ", "")


DOTS = ("Small dots: seeds; large ones: their mean with its 95 % interval (Student's t; of two seeds it may reach beyond the picture).")


def scalar_dots(vessel, members, moment, quantity, label, scale=1.0, line=None, band=None, band_name=""):
    samples = [e.scalar(moment, quantity) for e in members]
    samples = [Sample(s.values / scale) for s in samples]
    if not any(s.n for s in samples):
        return None
    figure, axes = curves(2.9, max(3.7, 0.68 * len(members)))
    dots(axes[0], np.arange(len(members)), samples, members)
    frame_values(axes[0], [s.values for s in samples], [x for x in (line,) if x is not None] + list(band or ()))
    if band is not None:
        axes[0].axhspan(*band, color="#d9d2c0", alpha=0.7, linewidth=0)
        axes[0].text(0.98, sum(band) / 2, band_name, transform=axes[0].get_yaxis_transform(), ha="right", va="center",
                     fontsize=8, color="#6a6250")
    if line is not None:
        axes[0].axhline(line, color="#1c1c1c", linewidth=0.9, linestyle=":")
    axes[0].set_ylabel(label)
    return Image(svg(figure), f"{quantity} of each ensemble, {vessel.when(moment)}", vessel.brief(moment))


def axis_mass(vessel, moments):
    images = [scalar_dots(vessel, vessel.gallery, m, q, f"mass at r < {n} d, over that of the bulk", line=1)
              for m in dict.fromkeys(moments) if m for q, n in (("axis_density_1d", "1"), ("axis_density_2d", "2"))]
    caption = ("Mass of bulk grains whose centres lie within d or 2 d of the axis, over what the packing of the bulk would put there: "
               "1 where the axis is like the rest. " + DOTS)
    return Figure("Mass at the axis", images, caption)
