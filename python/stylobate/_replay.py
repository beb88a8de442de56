"""One realization through time."""


class Replay:
    """The blocks of a structure at evenly spaced times. `nt` times, `nb` blocks in layout order: column by column from
    the bottom, then epistyles. The arrays are read-only views; places are in the frame of the base, y upwards.

    time_s         (nt) s
    x_m, y_m       (nt, nb) m     centres of the blocks
    theta_rad      (nt, nb) rad   rotations, counter-clockwise from upright
    base_x_m       (nt) m         displacement of the base
    rest_x_m, rest_y_m            (nb) m   centres as built: upright, faces touching
    half_width_m, half_height_m   (nb) m
    blocks         names of the blocks (nb)
    fixed          (nb) whether a block moves with the base
    epistyle       (nb) whether it lies across columns
    outcome        how it ended: a dictionary, with the names of `Result.realizations`; -1: it did not happen
    """

    def __init__(self, core):
        self._core = core  # the owner of what the arrays show
        self._lists = core.lists()
        for name, (_, _, _, values) in self._lists.items():
            setattr(self, name, values)
        self.blocks = list(core.name)
        self.fixed = list(core.fixed)
        self.epistyle = list(core.epistyle)
        self.outcome = core.outcome()

    def corners(self):
        """Corners of the blocks, counter-clockwise from the lower left one: (nt, nb, 4, 2) m, x and y."""
        import numpy as np

        cos, sin = np.cos(self.theta_rad), np.sin(self.theta_rad)
        corners = np.empty((*self.x_m.shape, 4, 2))
        for i, (a, b) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
            u, v = a * self.half_width_m, b * self.half_height_m
            corners[..., i, 0] = self.x_m + cos * u - sin * v
            corners[..., i, 1] = self.y_m + sin * u + cos * v
        return corners

    def to_xarray(self):
        """An xarray.Dataset over time_s [s] and block, with units."""
        import xarray

        data = {name: (dims, values, {"units": unit, "long_name": text})
                for name, (dims, unit, text, values) in self._lists.items()}
        time = data.pop("time_s")
        return xarray.Dataset(data, coords={"time_s": time, "block": ("block", self.blocks)})

    def __repr__(self):
        return (f"<Replay: realization {self.outcome['index']}, {self.outcome['state']}, {len(self.time_s)} times x "
                f"{len(self.blocks)} blocks>")


def animation(replay, seconds, fps):
    """`Result.animate`."""
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.animation import FuncAnimation
    from matplotlib.collections import PolyCollection

    time, corners = replay.time_s, replay.corners()
    length = float(time[-1] - time[0]) if seconds is None else seconds
    frames = np.linspace(time[0], time[-1], max(2, int(round(length * fps))))
    samples = np.clip(np.searchsorted(time, frames, side="right") - 1, 0, len(time) - 1)
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
        title.set_text(f"{time[sample]:.2f} s")
        return blocks, title

    return FuncAnimation(figure, draw, frames=len(frames), interval=1000 / fps)
