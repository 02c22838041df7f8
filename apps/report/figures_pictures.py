# figures_pictures.py: pictures of grains and of forces: slices, horizontal cuts, networks of normal forces.
import numpy as np
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.patches import Wedge
from matplotlib.colors import ListedColormap

import painter
from style import BANDS, HEAT, SEQUENTIAL, Figure, Image, draw_walls, panel, raster, rgb, scale_bar, strip_layout

CN_TOP = 8  # coordination numbers from here on have one colour
PIXELS = 14  # per diameter


def cn_colours():
    return ListedColormap([SEQUENTIAL(k / CN_TOP) for k in range(CN_TOP + 1)])


def cn_bar():
    names = [str(k) for k in range(CN_TOP)] + [f"\u2265 {CN_TOP}"]
    return scale_bar(cn_colours(), 0, 1, "coordination number CN", ticks=np.arange(CN_TOP + 1), names=names,
                     boundaries=np.arange(CN_TOP + 2) - 0.5)


def window(vessel, moments, ensembles, table="slice"):
    """The part of the (r, z) plane that all pictures of these moments show, in d."""
    top, low = 1.0, 0.0
    for moment in moments:
        for e in ensembles:
            _, rows = e.first(table, moment)
            if rows is None:
                continue
            z = (rows["z"] if "z" in rows else rows["z2"]) / vessel.d
            top, low = max(top, float(np.quantile(z, 0.9995)) + 1.0), min(low, float(z.min()) - 0.5)
    half = vessel.width / 2 + 0.6
    outlet = (vessel.run.scene.get("domain") or {}).get("outlet") or {}
    fall = outlet.get("z", 0) / vessel.d if isinstance(outlet, dict) else 0
    return (-half, half), (min(max(low, fall), -0.8), top)


def mirrored(e, x, *others):
    """A sector's slice with its mirror image: x and the rest twice; and which half is the image."""
    if e.kind != "sector":
        return (x,) + others + (np.zeros(len(x), dtype=bool),)
    keep = x >= -0.5 * np.ptp(x)  # everything: a sector's slice has x >= 0 up to a radius
    x = x[keep]
    doubled = [np.concatenate([x, -x])] + [np.concatenate([o[keep], o[keep]]) for o in others]
    return tuple(doubled) + (np.arange(2 * len(x)) >= len(x),)


def slice_image(vessel, e, moment, view, paint, what):
    run, rows = e.first("slice", moment)
    if rows is None:
        return None
    d = vessel.d
    x, y, z, radius, image = mirrored(e, rows["x"] / d, rows["y"] / d, rows["z"] / d, rows["radius"] / d)
    tint = paint(rows)
    tint = np.concatenate([tint, tint]) if len(x) > len(tint) else tint
    tint = np.where(image[:, None], 0.35 + 0.65 * tint, tint)  # the mirror image is paler
    figure, axes = panel(*view)
    extent = (*view[0], *view[1])
    grains = painter.spheres(x, z, -y, radius, tint, extent, PIXELS)
    axes.imshow(grains, extent=extent, origin="lower", interpolation="antialiased", aspect="auto")
    draw_walls(axes, run.walls(moment), d)
    return Image(raster(figure), f"Slice 4 d thick, {e.label}, seed {run.seed}, {vessel.when(moment)}: {what}",
                 f"{e.label}, seed {run.seed}")


def slices(vessel, moment, paper=None):
    """Grains of a slice in the colours of the layers in which they started."""
    es = vessel.gallery
    view = window(vessel, [moment], es)
    layers = [rows["layer"].max() for rows in (e.first("slice", moment)[1] for e in es) if rows is not None]
    band = max(1, round((max(layers) if layers else 10) / 10))
    palette = [rgb(c) for c in BANDS]
    images = [slice_image(vessel, e, moment, view, lambda rows: painter.bands(rows["layer"], band, palette),
                          "grains in bands by the layer in which they started") for e in es]
    caption = (f"Moment: {vessel.when(moment)}. Slice 4 d thick through the axis; colours are the layers in which grains lay when "
               f"the run began, {band} layer{'s' if band > 1 else ''} a band. The right half of a sector is computed, the "
               "paler left half is its mirror image; of the full vessel both halves are computed.")
    return Figure(f"Flow pattern, {moment}", images, caption, paper, strip_layout(*view))


def cuts(vessel, moment, paper=None):
    """The horizontal cut seen from above; a sector turned n times, its own part in full colour."""
    es, d = vessel.gallery, vessel.d
    half = vessel.width / 2 + 0.6
    view = ((-half, half), (-half, half))
    shown, images, height = cn_colours(), [], None
    for e in es:
        run, rows = e.first("cut", moment)
        if rows is None or e.kind == "slot":
            continue
        height = float(np.mean(rows["z"])) / d
        x, y, z, radius, tint, copy = unfolded(e, rows, d, shown)
        tint = np.where(copy[:, None], 0.45 + 0.55 * tint, tint)
        figure, axes = panel(*view, width=2.3)
        axes.imshow(painter.spheres(x, y, z, radius, tint, (-half, half, -half, half), PIXELS),
                    extent=(-half, half, -half, half), origin="lower", interpolation="antialiased")
        circle(axes, vessel, run.walls(moment))
        faces(axes, e, vessel, x, y, copy)
        axes.set_ylabel("y / d", labelpad=-2)
        images.append(Image(raster(figure), f"Horizontal cut, {e.label}, seed {run.seed}, {vessel.when(moment)}: grains "
                            "coloured by coordination number", f"{e.label}, seed {run.seed}"))
    if images:
        images.append(cn_bar())
    caption = (f"Moment: {vessel.when(moment)}. Grains whose centres are within d of z = {height or 0:.1f} d, seen from above, "
               "coloured by coordination number. The sector is in full colour, its turned copies are paler.")
    return Figure(f"Horizontal cut, {moment}", images, caption, paper, "panels")


def unfolded(e, rows, d, shown):
    x, y, z, radius = (rows[name] / d for name in ("x", "y", "z", "radius"))
    tint = shown(np.clip(rows["cn"], 0, CN_TOP).astype(int))
    turns = [(np.cos(2 * np.pi * k / e.order), np.sin(2 * np.pi * k / e.order)) for k in range(e.order)]
    everywhere = np.concatenate([np.stack([c * x - s * y, s * x + c * y]) for c, s in turns], axis=1)
    copy = np.arange(everywhere.shape[1]) >= len(x)
    return (*everywhere, np.tile(z, e.order), np.tile(radius, e.order), np.tile(tint, (e.order, 1)), copy)


def circle(axes, vessel, walls):
    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(vessel.width / 2 * np.cos(angle), vessel.width / 2 * np.sin(angle), color="#333333", linewidth=1.2)
    if vessel.hopper:
        axes.plot(vessel.orifice / 2 * np.cos(angle), vessel.orifice / 2 * np.sin(angle), color="white", linewidth=1.2,
                  linestyle=(0, (3, 2)))


def faces(axes, e, vessel, x, y, copy):
    """The two faces of a sector, found from where its own grains are."""
    if e.order < 2 or not (~copy).any():
        return
    own = ~copy & (np.hypot(x, y) > 2)
    middle = np.angle(np.mean(np.exp(1j * np.arctan2(y[own], x[own])))) if own.any() else 0
    # Faces lie at 0 and theta, or at both sides of 0; the mean of the grains says which.
    theta = 2 * np.pi / e.order
    start = np.round((middle - theta / 2) / (theta / 2)) * theta / 2
    for azimuth in (start, start + theta):
        axes.plot([0, vessel.width / 2 * np.cos(azimuth)], [0, vessel.width / 2 * np.sin(azimuth)], color="#111111",
                  linewidth=1.3)
    patch = Wedge((0, 0), vessel.width / 2, np.degrees(start), np.degrees(start + theta))
    axes.add_collection(PatchCollection([patch], facecolor="none", edgecolor="#111111", linewidth=1.3))


def networks(vessel, moment, paper=None):
    """Normal forces between the grains of a slice: width and colour by force."""
    es, d = vessel.gallery, vessel.d
    view = window(vessel, [moment], es)
    weight = vessel_weight(vessel)
    loads = [rows["load"] for rows in (e.first("network", moment)[1] for e in es) if rows is not None]
    if not loads:
        return None
    top = float(np.quantile(np.concatenate(loads), 0.995)) / weight
    images = []
    for e in es:
        run, rows = e.first("network", moment)
        if rows is None:
            continue
        ends = np.stack([np.stack([rows["x1"], rows["z1"]], 1), np.stack([rows["x2"], rows["z2"]], 1)], 1) / d
        load = rows["load"] / weight
        if e.kind == "sector":
            ends, load = np.concatenate([ends, ends * [-1, 1]]), np.concatenate([load, load])
        order = np.argsort(load)
        strength = np.clip(load[order] / top, 0, 1)
        figure, axes = panel(*view)
        axes.add_collection(LineCollection(ends[order], linewidths=0.15 + 2.3 * strength, colors=HEAT(strength ** 0.7),
                                           capstyle="round"))
        draw_walls(axes, run.walls(moment), d)
        images.append(Image(raster(figure), f"Network of normal forces in a slice 4 d thick, {e.label}, seed {run.seed}, "
                            f"{vessel.when(moment)}", f"{e.label}, seed {run.seed}"))
    steps = np.linspace(0, 1, 6)
    images.append(scale_bar(HEAT_BAR, 0, 1, f"normal force / weight of a grain ({weight:.3g} N)", ticks=steps,
                            names=[f"{s * top:.3g}" for s in steps[:-1]] + [f"\u2265 {top:.3g}"]))
    caption = (f"Moment: {vessel.when(moment)}. Contacts between grains of the slice 4 d thick as lines from centre to centre, width "
               "and colour by normal force, in the same scale for all panels. Left halves of sectors are mirror images.")
    return Figure(f"Network of normal forces, {moment}", images, caption, paper, strip_layout(*view))


HEAT_BAR = ListedColormap([HEAT(s ** 0.7) for s in np.linspace(0, 1, 256)])


def vessel_weight(vessel):
    """Weight of a grain of mean diameter [N]."""
    particles = vessel.run.scene.get("particles") or {}
    material = (vessel.run.scene.get("material") or {}).get(particles.get("material"), {})
    density = material.get("density", 0) or 1
    gravity = (vessel.run.scene.get("domain") or {}).get("gravity") or [0, 0, -9.81]
    return density * np.pi / 6 * vessel.d ** 3 * float(np.linalg.norm(gravity)) or 1.0
