# figures_maps.py: fields over (r, z) with their mirror image, means over seeds: CN, velocity, packing, pressure, zones.
import numpy as np

from matplotlib.colors import ListedColormap

from ensembles import counted
from style import DIVERGING, SEQUENTIAL, ZONES, Figure, Image, draw_walls, panel, plt, raster, scale_bar, strip_layout

BED = 0.15  # packing below which a cell is not drawn: no bed there


class Quantity:
    """What a map shows: columns of map.csv, their unit in `scale` of the vessel, words and colours."""

    def __init__(self, columns, words, symbol, scale, cmap=SEQUENTIAL, zero=False, sign=1, more="", span=None):
        self.columns, self.words, self.symbol, self.scale = columns, words, symbol, scale
        self.cmap, self.zero, self.sign, self.more, self.span = cmap, zero, sign, more, span

    def grid(self, vessel, e, moment):
        """r, z [d], value; nan where there is no bed."""
        packing = e.field(moment, "packing")
        parts = [e.field(moment, column) for column in self.columns]
        if packing is None or any(part is None for part in parts):
            return None
        r, z, _, seeds = parts[0]
        value = self.sign * sum(part[2] for part in parts) / len(parts) / self.scale(vessel)
        return r / vessel.d, z / vessel.d, np.where(packing[2] >= BED, value, np.nan), seeds


def froude(vessel):
    return np.sqrt(9.81 * vessel.d)


def layer_weight(vessel):
    """Pressure under one layer of grains [Pa]: density of a grain times g d."""
    particles = vessel.run.scene.get("particles") or {}
    material = (vessel.run.scene.get("material") or {}).get(particles.get("material"), {})
    return (material.get("density") or 1) * 9.81 * vessel.d


QUANTITIES = {
    "cn": Quantity(["cn"], "coordination number", "CN", lambda v: 1),
    "vz": Quantity(["vz"], "vertical velocity, downwards", r"$-v_z\,/\,\sqrt{g\,d}$", froude, plt.get_cmap("magma_r"), True, -1),
    "packing": Quantity(["packing"], "packing fraction", r"$\phi$", lambda v: 1, plt.get_cmap("cividis"), span=(0.35, 0.75)),
    "pressure": Quantity(["prr", "ptt", "pzz"], "pressure", r"$p\,/\,(\rho\,g\,d)$", layer_weight,
                         plt.get_cmap("YlGnBu"), True,
                         more=" Pressure: a third of the trace of the tensor, in the weight of one layer of grains."),
}


def limits(grids, zero):
    values = np.concatenate([g[2][np.isfinite(g[2])] for g in grids])
    if not len(values):
        return 0.0, 1.0
    low, high = (0.0 if zero else np.quantile(values, 0.02)), np.quantile(values, 0.985)
    return float(low), float(high if high > low else low + 1)


def view_of(vessel, grids):
    top = max([float(g[1][np.isfinite(g[2]).any(axis=1)].max()) for g in grids if np.isfinite(g[2]).any()] or [1]) + 2
    half = vessel.width / 2 + 0.6
    return (-half, half), (-0.8, top)


def draw(vessel, e, moment, grid, view, cmap, low, high, words, smooth=True):
    r, z, value = grid[:3]
    figure, axes = panel(*view)
    step_r = r[1] - r[0] if len(r) > 1 else 1
    step_z = z[1] - z[0] if len(z) > 1 else 2
    whole = np.concatenate([value[:, ::-1], value], axis=1)
    edge = r[-1] + step_r / 2
    axes.imshow(np.ma.masked_invalid(whole), origin="lower", extent=(-edge, edge, z[0] - step_z / 2, z[-1] + step_z / 2),
                cmap=cmap, vmin=low, vmax=high, interpolation="bilinear" if smooth else "nearest", aspect="auto")
    axes.set_xlim(*view[0])
    axes.set_ylim(*view[1])
    draw_walls(axes, e.runs[0].walls(moment), vessel.d)
    axes.set_xlabel("r / d")
    return Image(raster(figure, quality=88), f"Map of {words}, {e.label}, {vessel.when(moment)}, mean over {counted(grid[3], 'seed')}",
                 ", ".join(part for part in (e.label, counted(grid[3], 'seed'), e.arched(moment)) if part))


def maps(vessel, name, moment, paper=None):
    quantity = QUANTITIES[name]
    grids = [(e, quantity.grid(vessel, e, moment)) for e in vessel.gallery]
    grids = [(e, g) for e, g in grids if g is not None]
    if not grids:
        return None
    low, high = quantity.span or limits([g for _, g in grids], quantity.zero)
    view = view_of(vessel, [g for _, g in grids])
    images = [draw(vessel, e, moment, g, view, quantity.cmap, low, high, quantity.words) for e, g in grids]
    images.append(scale_bar(quantity.cmap, low, high, f"{quantity.words}  {quantity.symbol}", extend="max" if quantity.zero else "both"))
    caption = (f"Moment: {vessel.when(moment)}. Coarse-grained field over (r, z), mean over the seeds named below each panel, drawn "
               f"with its mirror image; blank where the packing fraction is below {BED:g}. One scale for all panels." + quantity.more)
    return Figure(f"Map of {quantity.words}, {moment}", images, caption, paper, strip_layout(*view))


def differences(vessel, name, moment):
    """Sectors less the full vessel."""
    quantity = QUANTITIES[name]
    if vessel.full is None:
        return None
    base = quantity.grid(vessel, vessel.full, moment)
    found = []
    for e in vessel.gallery:
        g = None if e.full else quantity.grid(vessel, e, moment)
        if base is None or g is None or len(g[0]) != len(base[0]):
            continue
        high = min(len(g[1]), len(base[1]))
        found.append((e, (g[0], g[1][:high], g[2][:high] - base[2][:high], g[3])))
    if not found:
        return None
    spread = np.concatenate([np.abs(g[2][np.isfinite(g[2])]) for _, g in found])
    top = float(np.quantile(spread, 0.97)) if len(spread) and spread.max() > 0 else 1.0
    view = view_of(vessel, [g for _, g in found])
    images = [draw(vessel, e, moment, g, view, DIVERGING, -top, top, f"{quantity.words}, less the full vessel") for e, g in found]
    images.append(scale_bar(DIVERGING, -top, top, f"sector less full: {quantity.symbol}", extend="both"))
    caption = (f"Moment: {vessel.when(moment)}. Field of the sector less that of the full vessel ({counted(base[3], 'seed')}), both means "
               "over their seeds: red where the sector has more.")
    return Figure(f"Map of {quantity.words}, {moment}, sector less full", images, caption, None, strip_layout(*view))


def zones(vessel, moment):
    grids = [(e, e.field(moment, "zone")) for e in vessel.gallery]
    grids = [(e, (g[0] / vessel.d, g[1] / vessel.d, np.where(g[2] > 0, g[2], np.nan), g[3])) for e, g in grids
             if g is not None and (g[2] > 0).any()]
    if not grids:
        return None
    view = view_of(vessel, [g for _, g in grids])
    images = [draw(vessel, e, moment, g, view, ZONES, -0.5, 3.5, "flow zones", smooth=False) for e, g in grids]
    shown = ListedColormap([ZONES(k) for k in (1, 2, 3)])
    images.append(scale_bar(shown, 0, 3, "zone", ticks=[1, 2, 3], names=["stagnant", "plug", "converging"],
                            boundaries=[0.5, 1.5, 2.5, 3.5]))
    caption = (f"Moment: {vessel.when(moment)}. Stagnant: slower than a tenth of a plug as wide as the vessel (v0); plug: 0.5 to 1.5 v0 "
               "and nearly vertical; converging: the rest. Each cell has the zone of most seeds. Blank: no bed, or no discharge.")
    return Figure(f"Flow zones, {moment}", images, caption, None, strip_layout(*view))
