# figures_flow.py: discharge and rest: grains out against time, rates beside Beverloo's law, angle of repose.
import numpy as np

from ensembles import Sample, mean_and_sd
from figures_axis import DOTS, scalar_dots
from figures_distributions import legend_text
from style import Figure, Image, colour, curves, frame_values, line_style, svg


def discharge_image(vessel):
    figure, axes = curves(4.4, 3.9, rows=2)
    for e in vessel.gallery:
        tables = [t for t in (run.table("flow") for run in e.runs) if t is not None]
        if not tables:
            continue
        longest = max(tables, key=lambda t: t.rows)
        for row, column in enumerate(("out", "rate")):
            values = np.full((len(tables), longest.rows), np.nan)
            for k, t in enumerate(tables):
                values[k, :t.rows] = t[column]
            mean, sd = mean_and_sd(values)
            if row == 0:
                axes[row].plot(longest["time"], values.T, color=colour(e), linewidth=0.5, alpha=0.35)
            axes[row].plot(longest["time"], mean, label=legend_text(e, tables), **line_style(e))
    if not axes[0].lines:
        figure.clf()
        return None
    axes[0].set_ylabel("grains out (whole vessel)")
    axes[1].set_ylabel("rate [1/s], over 0.05 s")
    axes[1].set_xlabel("time after opening [s]")
    axes[0].legend(loc="upper left", fontsize=7.5)
    axes[1].set_ylim(0, None)
    return Image(svg(figure), "Grains out and discharge rate against time", "")


def beverloo(vessel, moment):
    """The band of Beverloo's law, or None."""
    low, high = ((vessel.full or vessel.gallery[0]).scalar(moment, q).mean for q in ("beverloo_low", "beverloo_high"))

    return (low, high) if np.isfinite(low) and np.isfinite(high) else None


def discharge(vessel, moments):
    moments = [m for m in dict.fromkeys(moments) if m]
    images = [discharge_image(vessel)]
    images += [scalar_dots(vessel, vessel.gallery, m, "discharge_rate", "discharge rate [1/s]", band=beverloo(vessel, m),
                           band_name="Beverloo") for m in moments]
    arched = [(e, e.scalar(moments[-1], "arched")) for e in vessel.gallery] if moments else []
    told = "; ".join(f"{e.label}: {int(s.values.sum())} of {s.n}" for e, s in arched if s.n)
    caption = ("Thin lines are seeds, thick ones their means. Points: rate over the moment named below; band: Beverloo's law, "
               f"C 0.55, k 1.5 to C 0.64, k 1.4, with the packing before opening. {DOTS}"
               + (f" Runs that had arched at the end ({moments[-1]}): {told}." if told else ""))
    return Figure("Discharge", images, caption)


def zhou(vessel):
    """Angle of repose [deg] by the correlation of Zhou et al. 2002, from the scene's friction; None without it."""
    contact = vessel.run.scene.get("contact") or {}
    grain, wall = contact.get("grain-grain") or {}, contact.get("grain-wall") or {}
    try:
        return (68.61 * grain["sliding"] ** 0.27 * wall["sliding"] ** 0.22 * (1e3 * grain["rolling"]) ** 0.06
                * (1e3 * wall["rolling"]) ** 0.12 * (1e3 * vessel.d) ** -0.2)
    except (KeyError, TypeError):
        return None


def repose(vessel, moment):
    known = zhou(vessel)
    band = (known - 3, known + 3) if known else None
    images = [scalar_dots(vessel, vessel.gallery, moment, "angle_of_repose", "angle of repose [deg]", band=band,
                          band_name=f"Zhou et al. 2002: {known:.1f}\u00b0" if known else ""),
              scalar_dots(vessel, vessel.gallery, moment, "grains", "grains left on the plate (whole vessel)")]
    caption = (f"Moment: {vessel.when(moment)}. Slope of the mean surface between 10 and 90 % of its height. Band: correlation of Zhou "
               f"et al. 2002 with its \u00b1 3\u00b0. {DOTS}")
    return Figure("Angle of repose", images, caption)


def beverloo_line(vessels, ensembles_of):
    """W^(2/5) against the orifice for vessels of one width, full and sectors, of runs that flow."""
    figure, axes = curves(3.3, 3.9)
    shown = []
    for angle in (360, 90, 60, 45, 30):
        points = []
        for v in vessels:
            e = next((e for e in ensembles_of(v) if (e.full and angle == 360) or (not e.full and e.angle == angle)), None)
            moment = v.roles()["mean"]
            sample = Sample(e.flowing(moment, "discharge_rate").values ** 0.4) if e else Sample([])
            if sample.n:
                points.append((v.orifice, sample, e))
        if len(points) < 2:
            continue
        x, y = np.array([p[0] for p in points]), np.array([p[1].mean for p in points])
        half = np.nan_to_num([p[1].half for p in points])
        axes[0].errorbar(x, y, [np.minimum(half, y), half], marker="o", markersize=5, capsize=3, label=points[0][2].label,
                         **line_style(points[0][2]))
        shown.append(y)
    if not shown:
        figure.clf()
        return None
    axes[0].set_xlabel("orifice $D_0$ / d")
    axes[0].set_ylabel(r"$W^{2/5}$ [s$^{-2/5}$]")
    frame_values(axes[0], shown)
    axes[0].set_ylim(max(axes[0].get_ylim()[0], 0), None)
    axes[0].legend()
    return Image(svg(figure), "Discharge rate to the power 2/5 against the orifice", f"vessel {vessels[0].width:g} d wide")
