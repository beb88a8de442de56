#!/usr/bin/env python3
"""Reference values of the verification cases and of some tests, computed by other means than the engine's and the
oracles'.

reference_values.py [SOURCE_FOLDER]    prints each value and whether the file that uses it has it, rounded to its digits;
                                       exit status 1 if one does not

Only the standard library is used: double precision, no file of the project is imported. Equations and methods:

  quarter periods    theta'^2 / 2 = p^2 (cos(alpha - theta0) - cos(alpha - theta)), Simpson's rule in s with
                     theta = theta0 (1 - s^2), 2000 intervals; relative error below 1e-12
  overturning        theta'' = -p^2 (sin(alpha - theta) - (a(t) / g) cos(alpha - theta)), mirrored on the other side;
                     Runge-Kutta of fourth order, 2000 steps of the pulse, the time of an impact by bisection of the
                     last step, theta' -> e theta'; after the pulse by the energy; bisection of eta to 1e-9. The error
                     is below 2e-7: twice the steps change no value by more
  sliding            v' = eta sin t - sign(v) while it slides, Simpson's rule over each phase, its ends by bisection
  frequencies        energy of beds and weight to second order in (x, theta) of each block, inverse iteration. The
                     weight presses along the normal of the lower face, in the middle of the overlap at rest, as in the
                     engine; with `dead_load` it is vertical and acts at the faces (ensemble/planar/structure/step_bound.hpp)
  largest steps      bisection of the step at which 4 M - 2 dt C - dt^2 K is no longer positive definite (Cholesky)
  scheme             the recurrence itself
"""

import math
import pathlib
import sys

g = 9.81


# ---- one rigid block ------------------------------------------------------------------------------------------------


def block(width, height):
    """Slenderness alpha and frequency parameter p of a rectangle."""
    return math.atan(width / height), math.sqrt(3 * g / (2 * math.hypot(width, height)))


def simpson(f, a, b, n):
    h = (b - a) / n
    return h / 3 * (f(a) + f(b) + sum((4 if i % 2 else 2) * f(a + i * h) for i in range(1, n)))


def quarter_period(alpha, p, start):
    def integrand(s):
        lean = start * s * s  # theta0 - theta
        half = start * s * s / 2
        sinc = math.sin(half) / half if half else 1.0
        # theta' = p sqrt(4 sin(alpha - theta0 + half) sin(half)), d theta = 2 theta0 s ds
        return 2 * math.sqrt(start) / (p * math.sqrt(2 * math.sin(alpha - start + lean / 2) * sinc))

    return simpson(integrand, 0, 1, 2000)


class Pulse:
    """A block under eta g tan(alpha) sin(w t) for half a period or a whole one; time in units of 1 / p."""

    steps = 2000

    def __init__(self, alpha, rate, cycles, e):
        self.alpha, self.rate, self.end, self.e = alpha, rate, 2 * math.pi * cycles / rate, e

    def acceleration(self, t, theta, eta, side):
        a = eta * math.tan(self.alpha) * math.sin(self.rate * t)
        left = self.alpha - side * theta
        return -side * math.sin(left) + a * math.cos(left)

    def step(self, t, y, h, eta, side):
        f = lambda t, y: (y[1], self.acceleration(t, y[0], eta, side))
        k1 = f(t, y)
        k2 = f(t + h / 2, (y[0] + h / 2 * k1[0], y[1] + h / 2 * k1[1]))
        k3 = f(t + h / 2, (y[0] + h / 2 * k2[0], y[1] + h / 2 * k2[1]))
        k4 = f(t + h, (y[0] + h * k3[0], y[1] + h * k3[1]))
        return tuple(y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) for i in (0, 1))

    def way(self, eta):
        """Number of impacts before it overturns; -1: it does not, or with two impacts or more."""
        t = math.asin(1 / eta) / self.rate
        y, side, impacts = (0.0, 0.0), 1, 0
        h = (self.end - t) / self.steps
        while self.end - t > 1e-12:
            now = min(h, self.end - t)
            after = self.step(t, y, now, eta, side)
            if side * after[0] < 0 and t > 0:
                low, high = 0.0, now
                for _ in range(60):
                    middle = (low + high) / 2
                    if side * self.step(t, y, middle, eta, side)[0] < 0:
                        high = middle
                    else:
                        low = middle
                y = self.step(t, y, low, eta, side)
                t += low
                y, side, impacts = (0.0, self.e * y[1]), -side, impacts + 1
                if impacts > 1:
                    return -1
                continue
            t, y = t + now, after
        theta, rate = side * y[0], side * y[1]
        energy = rate * rate / 2 - (1 - math.cos(self.alpha - theta))
        falls = (rate > 0 and energy > 0) if theta < self.alpha else not (rate < 0 and energy > 0)
        if falls:
            return impacts
        if impacts > 0 or self.e == 0:
            return -1
        # it returns: through the upright position with what it has, and over the other corner or not
        rate = self.e * math.sqrt(2 * (energy + 1 - math.cos(self.alpha)))
        return 1 if rate * rate / 2 > 1 - math.cos(self.alpha) else -1

    def edge(self, low, high, way):
        """Where eta begins (or ceases) to give this way of overturning, between two values."""
        first = self.way(low) == way
        assert (self.way(high) == way) != first, (low, high, way)
        while high - low > 1e-9:
            middle = (low + high) / 2
            if (self.way(middle) == way) == first:
                low = middle
            else:
                high = middle
        return (low + high) / 2


# ---- one sliding block: friction 1, base eta sin t --------------------------------------------------------------------


def slide(eta, begin, velocity, until, direction):
    """Slides from `begin` until it stops. The base's acceleration is 0 after `until`. End and distance."""

    def v(t):
        shaken = min(t, until)
        return velocity - eta * (math.cos(shaken) - math.cos(begin)) - direction * (t - begin)

    t, step = begin, 1e-3
    while direction * v(t + step) > 0:
        t += step
    low, high = t, t + step
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if direction * v(middle) > 0 else (low, middle)
    bends = [begin] + ([until] if begin < until < low else []) + [low]
    return low, sum(simpson(v, a, b, 2000) for a, b in zip(bends, bends[1:]))


def pulse_slip(eta, cycles):
    """Total and net slip."""
    until, t, slips, direction = 2 * math.pi * cycles, math.asin(1 / eta), [], 1
    while True:
        t, slip = slide(eta, t, 0.0, until, direction)
        slips.append(slip)
        if t >= until:
            break
        a = eta * math.sin(t)
        if a < -1:  # it turns at once
            direction = -1
        elif t < math.pi + math.asin(1 / eta) and cycles == 1:  # it sticks until the base has turned
            t, direction = math.pi + math.asin(1 / eta), -1
        else:
            break
    return sum(abs(s) for s in slips), sum(slips)


def steady_slip(eta):
    """Slip path over the base's path, 4 eta in a cycle."""
    begin = math.asin(1 / eta)
    if eta >= math.sqrt(1 + math.pi**2 / 4):  # it never sticks: the velocity is 0 where cos t = pi / (2 eta)
        begin = math.acos(math.pi / (2 * eta))
        v = lambda t: -eta * (math.cos(t) - math.cos(begin)) - (t - begin)
        return simpson(v, begin, begin + math.pi, 20000) / (2 * eta)
    return slide(eta, begin, 0.0, 1e9, 1)[1] / (2 * eta)


# ---- small vibrations of a stack ------------------------------------------------------------------------------------


def solve(matrix, right):
    n = len(right)
    a = [row[:] + [right[i]] for i, row in enumerate(matrix)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(a[k][i]))
        a[i], a[pivot] = a[pivot], a[i]
        for k in range(i + 1, n):
            factor = a[k][i] / a[i][i]
            for j in range(i, n + 1):
                a[k][j] -= factor * a[i][j]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (a[i][n] - sum(a[i][j] * x[j] for j in range(i + 1, n))) / a[i][i]
    return x


def positive_definite(a):
    n, low = len(a), [[0.0] * len(a) for _ in a]
    for i in range(n):
        for j in range(i + 1):
            s = a[i][j] - sum(low[i][k] * low[j][k] for k in range(j))
            if i == j:
                if s <= 0:
                    return False
                low[i][i] = math.sqrt(s)
            else:
                low[i][j] = s / low[j][j]
    return True


class Stack:
    """n equal blocks on a fixed one, K_T = K_N B, C_N = C_T = 2 xi sqrt(K_N B m); unknowns x, theta of each block.

    The depth of a bed is h + h cos(phi) - n . (r_u - r_l), with n across the lower face and phi the relative rotation:
    to second order its part in x and theta is X theta_l + h theta_l^2 - h phi^2 / 2, X = x_u - x_l, on which the
    pressed force N (the weight above) does work. The faces slide by X + h theta_u + h theta_l.
    """

    def __init__(self, n, width, height, mass, stiffness, xi=0.0, gravity=g, dead_load=False):
        self.n, self.mass, self.k = n, mass, stiffness * width
        self.inertia = mass * (width**2 + height**2) / 12
        self.c = 2 * xi * math.sqrt(self.k * mass)
        size = 2 * n
        self.K = [[0.0] * size for _ in range(size)]
        self.C = [[0.0] * size for _ in range(size)]

        def add(to, factor, row):
            for i, a in row:
                for j, b in row:
                    to[i][j] += factor * a * b

        for bed in range(n):
            N = (n - bed) * mass * gravity
            h = height / 2 - (0 if dead_load else N / self.k / 2)
            upper, lower = 2 * bed, 2 * bed - 2
            slide = [(upper, 1), (upper + 1, h)] + ([(lower, -1), (lower + 1, h)] if bed else [])
            turn = [(upper + 1, 1)] + ([(lower + 1, -1)] if bed else [])
            add(self.K, self.k, slide)
            add(self.C, self.c, slide)
            add(self.K, self.k * width**2 / 12, turn)
            if dead_load:
                for theta in (upper + 1, lower + 1) if bed else (upper + 1,):
                    self.K[theta][theta] -= N * h
                continue
            add(self.K, -N * h, turn)
            if bed:  # N (X theta_l + h theta_l^2), the second derivatives
                for i, j, value in ((upper, lower + 1, N), (lower, lower + 1, -N)):
                    self.K[i][j] += value
                    self.K[j][i] += value
                self.K[lower + 1][lower + 1] += 2 * h * N

    def mass_of(self, i):
        return self.inertia if i % 2 else self.mass

    def first_frequency(self):
        x = [1.0 + 0.1 * i for i in range(2 * self.n)]
        value = 0.0
        for _ in range(200):
            y = solve(self.K, [self.mass_of(i) * x[i] for i in range(len(x))])
            value = sum(self.mass_of(i) * y[i] * x[i] for i in range(len(x))) / sum(
                self.mass_of(i) * y[i] * y[i] for i in range(len(x))
            )
            norm = math.sqrt(sum(v * v for v in y))
            x = [v / norm for v in y]
        return math.sqrt(value) / (2 * math.pi)

    def largest_step(self):
        def stable(dt):
            lateral = [[-2 * dt * self.C[i][j] - dt * dt * self.K[i][j] for j in range(2 * self.n)] for i in range(2 * self.n)]
            for i in range(2 * self.n):
                lateral[i][i] += 4 * self.mass_of(i)
            axial = [[0.0] * self.n for _ in range(self.n)]
            for bed in range(self.n):
                part = 2 * dt * self.c + dt * dt * self.k
                axial[bed][bed] -= part
                if bed:
                    axial[bed - 1][bed - 1] -= part
                    axial[bed][bed - 1] += part
                    axial[bed - 1][bed] += part
                axial[bed][bed] += 4 * self.mass
            return positive_definite(lateral) and positive_definite(axial)

        low, high = 0.0, 1.0
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if stable(middle) else (low, middle)
        return low


# ---- the scheme -----------------------------------------------------------------------------------------------------


def one_second(n):
    """u'' + 2 xi w u' + w^2 u = 0 by central differences with the velocity of the last step, u(1 s)."""
    w, xi, dt = 2 * math.pi, 0.05, 1.0 / n
    before, now = 1 - w * w * dt * dt / 2, 1.0
    for _ in range(n):
        before, now = now, 2 * now - before - dt * dt * w * w * now - 2 * xi * w * dt * (now - before)
    return now


# ---- the values and the files that have them ------------------------------------------------------------------------


def spec(stiffness, xi=0.0, gravity=g, dead_load=False):
    return Stack(6, 0.048, 0.029, 0.1355, stiffness, xi, gravity, dead_load)


def values():
    """(file, literal in it, value)"""
    cases = "studies/evidence/verification/cases/"
    mono, tall, frame = block(0.048, 0.174), block(1, 4), block(1, 4)
    housner = 1 - 1.5 * math.sin(mono[0]) ** 2
    rocking, overturning, frames, sliding, vibration, scheme = (
        f"{cases}{subject}_cases.cpp" for subject in ("rocking", "overturning", "frame", "sliding", "vibration", "scheme")
    )
    bound = "tests/ensemble/planar/test_step_bound.cpp"
    for part, m, a in ((0.1, "0.20800736", "0.99328373"), (0.5, "0.58467309", "2.79337282"), (0.9, "1.32676631", "6.34056642")):
        yield rocking, m, 4 * quarter_period(*mono, part * mono[0])
        yield rocking, a, 4 * quarter_period(*tall, part * tall[0])
    yield rocking, "0.893922652", housner
    half = "1.321072 1.801581 2.297965 2.798592 3.300895 3.804013 4.811423 5.819579".split()
    direct = "1.417400 2.358878 3.669653 5.336236 7.362836 9.757167 15.684700 23.193915".split()
    for rate, h, d in zip((1, 2, 3, 4, 5, 6, 8, 10), half, direct):
        yield overturning, h, Pulse(mono[0], rate, 0.5, 0).edge(0.98 * float(h), 1.02 * float(h), 0)
        yield overturning, d, Pulse(mono[0], rate, 1, 0).edge(0.995 * float(d), 1.005 * float(d), 0)
    for rate, low, high in ((1, "1.131490", "1.415484"), (2, "1.225406", "2.323675"), (3, "1.408328", "3.526372"),
                            (4, "1.821030", "4.964773"), (5, "3.028258", "6.582665"), (6, "4.916057", "8.286245")):
        pulse = Pulse(mono[0], rate, 1, housner)
        yield overturning, low, pulse.edge(0.999 * float(low), 1.001 * float(low), 1)
        yield overturning, high, pulse.edge(0.999 * float(high), 1.001 * float(high), 1)
    p = frame[1] * math.sqrt(3 / 4)  # G = 1: (1 + 2 G) / (1 + 3 G)
    colo = block(0.06, 0.1)
    yield frames, "11.232991", colo[1]
    yield frames, "9.845976", colo[1] * math.sqrt((1 + 2 * 0.76) / (1 + 3 * 0.76))
    for name, (alpha, _), G in (("0.510940", colo, 0.76), ("0.889706", frame, 1)):
        yield frames, name, (1 - 1.5 * math.sin(alpha) ** 2 + 3 * G * math.cos(2 * alpha)) / (1 + 3 * G)
    yield frames, "1.636057", p
    yield frames, "0.548962", quarter_period(frame[0], p, 0.3 * frame[0])
    yield frames, "0.806377", quarter_period(frame[0], p, 0.5 * frame[0])
    for eta, h, total, net in ((1.5, "0.80925349", "1.61671040", "-0.00179657"), (2, "2.72811386", "5.18978059", "-0.12673449"),
                               (3, "9.58001414", "12.59964043", "1.61785827")):
        yield sliding, h, pulse_slip(eta, 0.5)[0]
        yield sliding, total, pulse_slip(eta, 1)[0]
        yield sliding, net, pulse_slip(eta, 1)[1]
    for eta, ratio in ((1.2, "0.064724028"), (1.5, "0.269152304"), (2, "0.618990892"), (10, "0.987585940")):
        yield sliding, ratio, steady_slip(eta)
    for stiffness, f, dead in ((1e7, "11.601259", "11.600457"), (1e8, "36.925473", "36.925220"), (1e9, "116.843899", "116.843819")):
        yield vibration, f, spec(stiffness).first_frequency()
        yield bound, dead, spec(stiffness, dead_load=True).first_frequency()
    mono_stack = lambda dead_load: Stack(1, 0.048, 0.174, 0.813, 1e8, dead_load=dead_load)
    yield vibration, "52.460075", mono_stack(False).first_frequency()
    yield bound, "52.459709", mono_stack(True).first_frequency()
    drum = math.sqrt(1e8 * 0.048 / 0.1355) / (2 * math.pi)
    yield vibration, "947.264153", drum
    yield vibration, "228.360153", 2 * drum * math.sin(math.pi / 26)
    yield vibration, "1839.476756", 2 * drum * math.sin(11 * math.pi / 26)
    yield scheme, "0.729786860", one_second(100)
    yield scheme, "0.729941218", one_second(200)
    yield scheme, "1.601231e-4", spec(1e8).largest_step()
    yield bound, "1.601232e-4", spec(1e8, dead_load=True).largest_step()
    for xi, step in ((0.1, "1.349618e-4"), (0.3, "0.952181e-4"), (0.5, "0.700472e-4")):
        yield scheme, step, spec(1e8, xi, 0.0).largest_step()
        yield bound, step, spec(1e8, xi, 0.0).largest_step()


def main(folder):
    failures, count = [], 0
    for name, literal, value in values():
        count += 1
        mantissa, _, exponent = literal.partition("e")
        unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        rounded = abs(value - float(literal)) <= 0.51 * unit  # half a unit, and the rounding of the comparison
        present = literal in (folder / name).read_text()
        remark = ("" if rounded else "  DIFFERS") + ("" if present else "  IS NOT THERE")
        print(f"{pathlib.PurePath(name).name:<24} {literal:>14}  {value:.12g}{remark}")
        if not (rounded and present):
            failures.append(literal)
    print(f"{count} values, {len(failures)} of them differ or are not in their files")
    return 1 if failures or count < 60 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[3]))
