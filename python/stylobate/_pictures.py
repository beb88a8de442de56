"""Pictures with Matplotlib."""

from . import _core


def plot(result, ax, limit_state):
    import matplotlib.pyplot as plt

    kind = result.kind
    if kind not in ("surface", "fragility"):
        raise _core.InputError(f"plot: a result of kind '{kind}' has no surface and no fragility curves; "
                               "animate(index) draws a realization")
    if ax is None:
        ax = plt.figure().subplots()
    if kind == "surface":
        surface = result.surface(limit_state)
        mesh = ax.pcolormesh(surface.frequency_hz, surface.pga_m_s2, surface.probability.T, vmin=0, vmax=1,
                             shading="nearest")
        ax.figure.colorbar(mesh, ax=ax, label=f"probability of {limit_state}")
        ax.set_xlabel("frequency [Hz]")
        ax.set_ylabel("peak ground acceleration [m/s²]")
        return ax
    fragility = result.fragility()
    for state in fragility.limit_state.values:
        curve = fragility.sel(limit_state=state)
        (line,) = ax.plot(curve.intensity, curve.probability, label=str(state))
        ax.fill_between(curve.intensity, curve.probability_lower, curve.probability_upper, color=line.get_color(),
                        alpha=0.2, linewidth=0)
    ax.set_xlabel(f"{fragility.measure} [{fragility.intensity.units}]")
    ax.set_ylabel("probability")
    ax.set_ylim(0, 1)
    ax.legend()
    return ax


def animate(replay, seconds, fps):
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
