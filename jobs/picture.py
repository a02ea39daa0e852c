#!/usr/bin/env python3
"""Pictures of a run: a field and the bodies at four times, from fields/*.h5 and solid/*.h5.

usage: picture.py DIR OUT.png [--field schlieren] [--plane y=1.6] [--window x0 x1 y0 y1] [--scale 10] [--view 25 -60]
Without a fluid the bodies are drawn in space, coloured by a field of the solid (default: von_mises).
Needs python3-h5py, python3-numpy, python3-matplotlib (not needed to build or run Brisance).
"""
import argparse
import glob
import os

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection


def read_scene(directory):
    """Corners of the grid, from the resolved scene."""
    import tomllib

    with open(os.path.join(directory, "scene.resolved.toml"), "rb") as file:
        fluid = tomllib.load(file)["fluid"]
    return np.array(fluid["low"], float), np.array(fluid["high"], float)


def polygons(path, axes):
    """Faces of the particles, projected on two axes."""
    with h5py.File(path) as file:
        points, topology = file["points"][:], file["topology"][:].ravel()
    out, at = [], 0
    while at < len(topology):
        n = topology[at + 1]
        out.append(points[topology[at + 2 : at + 2 + n]][:, axes])
        at += 2 + n
    return out


def surface(path, first, scale, field):
    """Outer faces of the particles in space and the value of a field on each."""
    with h5py.File(path) as file, h5py.File(first) as rest:
        points = rest["points"][:] + scale * (file["points"][:] - rest["points"][:])
        topology, values = file["topology"][:].ravel(), file[field][:]
        time = float(np.ravel(file.attrs["time"])[0])
    values = np.linalg.norm(values, axis=-1) if values.ndim > 1 and values.shape[-1] == 3 else np.ravel(values)
    faces, at = [], 0
    while at < len(topology):
        n = topology[at + 1]
        faces.append(points[topology[at + 2 : at + 2 + n]])
        at += 2 + n
    # A face that touches another, as both sides of an unbroken link do, cannot be seen.
    centres = np.array([f.mean(axis=0) for f in faces])
    size = np.array([np.ptp(f, axis=0).max() for f in faces])
    keys = [tuple(k) for k in np.round(centres / (0.1 * np.median(size))).astype(int)]
    count = {}
    for key in keys:
        count[key] = count.get(key, 0) + 1
    seen = [n for n, key in enumerate(keys) if count[key] == 1]
    return [faces[n] for n in seen], values[seen], time


def pick(count):
    """Up to four of `count` frames, without the first one if there are others."""
    return sorted({round(i) for i in np.linspace(min(1, count - 1), count - 1, 4)})


def blank_rest(panels, used):
    for panel in panels.flat[used:]:
        panel.set_visible(False)


def draw_solid(o):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    frames = sorted(glob.glob(os.path.join(o.directory, "solid", "*.h5")))
    field = o.field or "von_mises"
    shown = [surface(frames[i], frames[0], o.scale, field) for i in pick(len(frames))]
    everything = np.concatenate([s[1] for s in shown])
    lo, hi = everything.min(), np.percentile(everything, 99.5)
    colours = plt.matplotlib.cm.ScalarMappable(plt.Normalize(lo, hi if hi > lo else lo + 1), "viridis")
    figure, panels = plt.subplots(2, 2, figsize=(10, 7.6), subplot_kw={"projection": "3d"}, layout="constrained")
    corners = np.concatenate([np.concatenate(s[0]) for s in shown])
    low, high = np.percentile(corners, 0.5, axis=0), np.percentile(corners, 99.5, axis=0)
    for panel, (faces, values, time) in zip(panels.flat, shown):
        panel.add_collection3d(Poly3DCollection(faces, facecolors=colours.to_rgba(values), edgecolors="0.2", linewidths=0.15))
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        panel.set_box_aspect(np.maximum(high - low, 0.02 * (high - low).max()))
        panel.view_init(*o.view)
        panel.set_title(f"{1e3 * time:.3g} ms", fontsize=9)
        panel.tick_params(labelsize=6)
    blank_rest(panels, len(shown))
    figure.colorbar(colours, ax=panels, label=field, shrink=0.8)
    figure.savefig(o.picture, dpi=90)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("directory")
    parser.add_argument("picture")
    parser.add_argument("--field", help="a name in output.fields, or of the solid in a scene without fluid; vectors by their length")
    parser.add_argument("--plane", help="cut a 3D run: x=, y= or z= a position in m; not given: the middle of z")
    parser.add_argument("--window", nargs=4, type=float)
    parser.add_argument("--scale", type=float, default=1, help="displacement of the bodies times this")
    parser.add_argument("--view", nargs=2, type=float, default=(25, -60), help="elevation and azimuth of the eye, in degrees")
    o = parser.parse_args()
    if not glob.glob(os.path.join(o.directory, "fields", "*.h5")):
        draw_solid(o)
        return
    o.field = o.field or "pressure"
    low, high = read_scene(o.directory)
    frames = sorted(glob.glob(os.path.join(o.directory, "fields", "*.h5")))
    chosen = [frames[i] for i in pick(len(frames))]
    cut_axis, position = ("xyz".index(o.plane[0]), float(o.plane[2:])) if o.plane else (2, None)
    axes = [a for a in range(3) if a != cut_axis]
    figure, panels = plt.subplots(2, 2, figsize=(9, 6.4), layout="constrained")
    values = []
    for path in chosen:
        with h5py.File(path) as file:
            p = file[o.field][:]
            p = np.linalg.norm(p, axis=-1) if p.ndim == 4 else p
            p = np.log10(np.maximum(p, 1e-300) / 1e5) if o.field == "pressure" else p
            s = file["solid_fraction"][:] if "solid_fraction" in file else np.zeros_like(p)
            time = file.attrs["time"] if "time" in file.attrs else 0.0
        n = p.shape[2 - cut_axis]  # of a 2D run: 1
        index = n // 2
        if position is not None:
            index = int((position - low[cut_axis]) / (high[cut_axis] - low[cut_axis]) * n)
        values.append((np.take(p, index, 2 - cut_axis), np.take(s, index, 2 - cut_axis), float(np.ravel(time)[0])))
    everything = np.concatenate([v[0][v[1] < 0.5].ravel() for v in values])
    lo, hi = everything.min(), everything.max()
    if hi - lo < 1e-6 * max(abs(lo), abs(hi)):  # uniform but for roundings
        lo, hi = lo - 1e-3 * max(abs(lo), 1e-3), hi + 1e-3 * max(abs(hi), 1e-3)
    solids = sorted(glob.glob(os.path.join(o.directory, "solid", "*.h5")))
    rest = polygons(solids[0], axes) if solids else []
    for panel, path, (p, s, time) in zip(panels.flat, chosen, values):
        field = np.ma.masked_where(s > 0.999, p)
        image = panel.imshow(field, origin="lower", vmin=lo, vmax=hi, interpolation="nearest",
                             cmap="gray" if o.field == "schlieren" else "inferno",
                             extent=(low[axes[0]], high[axes[0]], low[axes[1]], high[axes[1]]))
        now = polygons(path.replace("/fields/", "/solid/"), axes) if solids else []
        moved = [a + o.scale * (b - a) for a, b in zip(rest, now)]
        panel.add_collection(PolyCollection(moved, facecolors="0.75", edgecolors="0.2", linewidths=0.3))
        if o.window:
            panel.set_xlim(o.window[:2])
            panel.set_ylim(o.window[2:])
        panel.set_title(f"{1e3 * time:.2f} ms", fontsize=9)
        panel.tick_params(labelsize=7)
    blank_rest(panels, len(chosen))
    figure.colorbar(image, ax=panels, label="log10(pressure / bar)" if o.field == "pressure" else o.field, shrink=0.8)
    figure.savefig(o.picture, dpi=90)


if __name__ == "__main__":
    main()
