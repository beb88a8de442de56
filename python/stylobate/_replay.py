"""One realization through time."""

from . import _core
from ._values import TOLD, named
from ._view import Shown, View, chart, line


class Replay(Shown):
    """The blocks of a structure at evenly spaced times. `nt` times, `nb` blocks in layout order: column by column from
    the bottom, then epistyles. The arrays are read-only views; places are in the frame of the base: x to the right, y
    upwards, in space z towards the viewer.

    dimensions     of the structure: 2 in the plane, 3 in space
    time_s         (nt) s
    x_m, y_m       (nt, nb) m     places of the blocks
    base_x_m       (nt) m         displacement of the base
    rest_x_m, rest_y_m            (nb) m   places as built: upright, faces touching
    half_height_m                 (nb) m
    blocks         names of the blocks (nb)
    fixed          (nb) whether a block moves with the base
    epistyle       (nb) whether it lies across columns
    outcome        how it ended: a dictionary, with the names of `Result.realizations`; -1: it did not happen

    In the plane a place is that of the block's centre:
    theta_rad      (nt, nb) rad   rotations, counter-clockwise from upright
    half_width_m   (nb) m

    In space a place is that of the body's middle, halfway between its faces:
    z_m            (nt, nb) m
    q_w, q_x, q_y, q_z            (nt, nb) the quaternion that turns a body from upright about its middle
    base_y_m, base_z_m            (nt) m
    rest_z_m       (nb) m
    bottom_half_x_m, bottom_half_z_m, top_half_x_m, top_half_z_m   (nb) m   half sizes of the faces, of a disc its radius
    round          (nb) 1: the faces are discs; 0: rectangles; 2: the bottom one is a disc, the top one a rectangle
    """

    def __init__(self, core):
        self._core = core  # the owner of what the arrays show
        self._lists = core.lists()
        for name, (_, _, _, values) in self._lists.items():
            setattr(self, name, values)
        self.dimensions = core.dimensions
        self.blocks = list(core.name)
        self.fixed = list(core.fixed)
        self.epistyle = list(core.epistyle)
        self.outcome = core.outcome()

    def corners(self):
        """Corners of the blocks.

        In the plane: counter-clockwise from the lower left one, (nt, nb, 4, 2) m, x and y. In space: of the bottom face,
        then of the top face, counter-clockwise as seen from above, (nt, nb, 8, 3) m, x, y and z; of discs those of the
        square about them.
        """
        import numpy as np

        if self.dimensions == 3:
            return self._corners_in_space()
        cos, sin = np.cos(self.theta_rad), np.sin(self.theta_rad)
        corners = np.empty((*self.x_m.shape, 4, 2))
        for i, (a, b) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
            u, v = a * self.half_width_m, b * self.half_height_m
            corners[..., i, 0] = self.x_m + cos * u - sin * v
            corners[..., i, 1] = self.y_m + sin * u + cos * v
        return corners

    def _corners_in_space(self):
        import numpy as np

        turns, middle = self.rotations(), np.stack([self.x_m, self.y_m, self.z_m], axis=-1)
        corners = np.empty((*self.x_m.shape, 8, 3))
        faces = ((-1, self.bottom_half_x_m, self.bottom_half_z_m), (1, self.top_half_x_m, self.top_half_z_m))
        for face, (up, half_x, half_z) in enumerate(faces):
            for i, (a, b) in enumerate(((1, 1), (1, -1), (-1, -1), (-1, 1))):
                upright = np.stack([a * half_x, up * self.half_height_m, b * half_z], axis=-1)
                corners[..., 4 * face + i, :] = middle + np.einsum("tbij,bj->tbi", turns, upright)
        return corners

    def rotations(self):
        """In space: the matrices that turn the upright bodies about their middles, (nt, nb, 3, 3).

        AttributeError: in the plane, where `theta_rad` is the rotation.
        """
        import numpy as np

        q = np.stack([self.q_w, self.q_x, self.q_y, self.q_z])
        w, x, y, z = q / np.linalg.norm(q, axis=0)
        rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    def to_xarray(self):
        """An xarray.Dataset over time_s [s] and block, with units."""
        import xarray

        data = {name: (dims, values, {"units": unit, "long_name": text})
                for name, (dims, unit, text, values) in self._lists.items()}
        time = data.pop("time_s")
        return xarray.Dataset(data, coords={"time_s": time, "block": ("block", self.blocks)})

    def _view(self):
        end, outcome = float(self.time_s[-1]), self.outcome
        fell = outcome["collapse_time_s"] >= 0
        when = f" at {outcome['collapse_time_s']:.3f} s" if fell else ""
        first = outcome["first_collapse_block"]
        which = f", {self.blocks[first]} first" if first >= 0 else ", several blocks first" if first == -2 else ""
        shown = View(f"Realization {outcome['index']}: {outcome['state']}{when}{which}")
        until = min(end, 1.02 * outcome["collapse_time_s"]) if fell else end
        shown.figure(*(_core.svg(self._core, until * part) for part in (0, 0.5, 0.75, 1)),
                     caption=f"In the frame of the base, from 0 to {until:.3f} s"
                             + ("; seen obliquely from above" if self.dimensions == 3 else ""))
        told = sorted({0, len(self.blocks) // 2, len(self.blocks) - 1})
        for along in "xz" if self.dimensions == 3 else "x":
            places, rest = getattr(self, f"{along}_m"), getattr(self, f"rest_{along}_m")
            series = [line(self.time_s, getattr(self, f"base_{along}_m"), name="base")]
            series += [line(self.time_s, places[:, i] - rest[i], name=self.blocks[i]) for i in told]
            shown.figure(chart(f"Displacements of realization {outcome['index']} along {along}", "time [s]",
                               "displacement [m]" if self.dimensions == 2 else f"displacement along {along} [m]", series))
        return shown.facts((named(name), outcome[name]) for name in TOLD if name in outcome)

    def __repr__(self):
        return (f"<Replay: realization {self.outcome['index']}, {self.outcome['state']}, {len(self.time_s)} times x "
                f"{len(self.blocks)} blocks>")


def _frames(replay, seconds, fps):
    """Samples of the frames of an animation."""
    import numpy as np

    time = replay.time_s
    length = float(time[-1] - time[0]) if seconds is None else seconds
    frames = np.linspace(time[0], time[-1], max(2, int(round(length * fps))))
    return np.clip(np.searchsorted(time, frames, side="right") - 1, 0, len(time) - 1)


def _animation_in_space(replay, seconds, fps):
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.animation import FuncAnimation
    from matplotlib.collections import PolyCollection

    samples = _frames(replay, seconds, fps)
    frames = replay._core.seen_in_space([int(sample) for sample in samples])
    figure = plt.figure()
    ax = figure.subplots()
    blocks = PolyCollection([])
    ax.add_collection(blocks)
    points = np.concatenate([points for seen in frames for points, *_ in seen])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.05 * float((high - low).max())
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_axis_off()  # obliquely no axis of the structure is one of the picture
    title = ax.set_title("")

    def draw(frame):
        points, fills, lines, widths = zip(*frames[frame])
        blocks.set_verts(points)
        blocks.set_facecolor([fill or "none" for fill in fills])
        blocks.set_edgecolor(lines)
        blocks.set_linewidth(widths)
        title.set_text(f"{replay.time_s[samples[frame]]:.2f} s")
        return blocks, title

    return FuncAnimation(figure, draw, frames=len(samples), interval=1000 / fps)


def animation(replay, seconds, fps):
    """`Result.animate`."""
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation
    from matplotlib.collections import PolyCollection

    if replay.dimensions == 3:
        return _animation_in_space(replay, seconds, fps)
    corners, samples = replay.corners(), _frames(replay, seconds, fps)
    colours = ["#a89878" if fixed else "#9db4cc" if epistyle else "#e6dcc3"
               for fixed, epistyle in zip(replay.fixed, replay.epistyle)]
    figure = plt.figure()
    ax = figure.subplots()
    blocks = PolyCollection(list(corners[0]), facecolors=colours, edgecolors="#333333")
    ax.add_collection(blocks)
    ax.axhline(0, color="#555555")
    low, high = corners.min(axis=(0, 1, 2)), corners.max(axis=(0, 1, 2))
    margin = 0.05 * float((high - low).max())
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(min(low[1], 0) - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    title = ax.set_title("")

    def draw(frame):
        sample = samples[frame]
        blocks.set_verts(list(corners[sample]))
        title.set_text(f"{replay.time_s[sample]:.2f} s")
        return blocks, title

    return FuncAnimation(figure, draw, frames=len(samples), interval=1000 / fps)
