# painter.py: grains as shaded spheres, painted into an array of pixels with a depth for each pixel.
import numpy as np


def spheres(x, y, depth, radius, colours, extent, pixels):
    """An image [row, column, rgba] of the window extent = (x0, x1, y0, y1), `pixels` to the unit of length.

    Greater depth is nearer. Light comes from above, left and front; the rim of a sphere is darkened, which keeps grains apart.
    """
    x0, x1, y0, y1 = extent
    wide, high = int(round((x1 - x0) * pixels)), int(round((y1 - y0) * pixels))
    image = np.zeros((high, wide, 4))
    nearest = np.full((high, wide), -np.inf)
    light = np.array([-0.40, 0.55, 0.73])
    for cx, cy, cz, cr, tint in zip((x - x0) * pixels, (y - y0) * pixels, depth * pixels, radius * pixels, colours):
        left, right = max(int(cx - cr), 0), min(int(cx + cr) + 2, wide)
        low, up = max(int(cy - cr), 0), min(int(cy + cr) + 2, high)
        if left >= right or low >= up:
            continue
        u = (np.arange(left, right) + 0.5 - cx) / cr
        v = ((np.arange(low, up) + 0.5 - cy) / cr)[:, None]
        w2 = 1 - u * u - v * v
        inside = w2 > 0
        w = np.sqrt(np.where(inside, w2, 0))
        height = cz + cr * w
        front = inside & (height > nearest[low:up, left:right])
        if not front.any():
            continue
        lit = np.clip(light[0] * u + light[1] * v + light[2] * w, 0, 1)
        shade = (0.42 + 0.62 * lit) * (0.55 + 0.45 * np.clip(w / 0.45, 0, 1))
        gloss = 0.22 * lit ** 14
        shown = np.clip(tint[None, None, :3] * shade[:, :, None] + gloss[:, :, None], 0, 1)
        block = image[low:up, left:right]
        block[front, :3] = shown[front]
        block[front, 3] = 1
        nearest[low:up, left:right][front] = height[front]
    return image


def bands(layers, count, palette):
    """Colours of layers: `count` layers a band, the palette over and over."""
    index = (np.asarray(layers, dtype=int) // max(count, 1)) % len(palette)
    return np.array(palette)[index]
