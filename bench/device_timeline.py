#!/usr/bin/env python3
"""The time line that a study is expected to have on a GPU whose lanes step it: a model of the queue, not a measurement.

  stylobate export RESULTS.h5 --to csv -o FOLDER
  bench/device_timeline.py FOLDER/realizations.csv [--multiprocessors 132] [--realizations-a-multiprocessor 60]
      [--cycles 1270,1710,1790] [--clock-ghz 1.755] [--slower 1.25] [--host-us 0.5] [--threads 16]

It begins the realizations as the program does (the longest 1,000 first, the others shuffled; so many
of the longest on the host, one for each of its threads that do not serve the device), steps all slots by 512 steps a
launch, fills free slots after each, and hands the last ones over to the host. A step of a launch takes the cycles that
its warps a scheduler need, between those given for 1, 2 and 3 (below one: those of one); 5 % are added for copies and
waiting. `--host-us` is what a step takes in a lane of the host. The output is a table of seconds, with what bounds them.
"""

import argparse
import csv
import random

STEPS_OF_LAUNCH, LONGEST, COPIES, SCHEDULERS = 512, 1000, 1.05, 4


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", type=argparse.FileType())
    parser.add_argument("--multiprocessors", type=int, default=132)
    parser.add_argument("--realizations-a-multiprocessor", type=int, default=60)
    parser.add_argument("--realizations-a-warp", type=int, default=5)
    parser.add_argument("--cycles", type=lambda text: [float(c) for c in text.split(",")], default=[1270, 1710, 1790])
    parser.add_argument("--clock-ghz", type=float, default=1.755)
    parser.add_argument("--slower", type=float, default=1.25, help="times the cycles (default: 1.25)")
    parser.add_argument("--host-us", type=float, default=0.5)
    parser.add_argument("--threads", type=int, default=16)
    options = parser.parse_args()
    rows = csv.DictReader(options.rows)
    if "steps" not in (rows.fieldnames or []):
        parser.error(f"{options.rows.name} has no column 'steps': give the realizations.csv of the export above")
    return options, [int(float(row["steps"])) for row in rows]


class Machine:
    def __init__(self, options):
        self.o = options
        self.slots = options.multiprocessors * options.realizations_a_multiprocessor

    def launch_s(self, busy):
        warps = busy / self.o.realizations_a_warp / (self.o.multiprocessors * SCHEDULERS)
        cycles = self.o.cycles
        below = min(max(int(warps), 1), len(cycles)) - 1
        above = min(below + 1, len(cycles) - 1)
        share = min(max(warps - below - 1, 0), 1)
        mean = cycles[below] + (cycles[above] - cycles[below]) * share
        return STEPS_OF_LAUNCH * mean * self.o.slower * COPIES / (self.o.clock_ghz * 1e9)

    def run(self, order, on_host, host_threads, last):
        """@return seconds of the device and of the host"""
        host = [0.0] * max(host_threads, 1)

        def to_host(steps, now):
            first = host.index(min(host))
            host[first] = max(host[first], now) + steps * self.o.host_us * 1e-6

        for steps in sorted(on_host, reverse=True):
            to_host(steps, 0)
        waiting, busy, now = list(reversed(order)), [], 0.0
        while waiting or busy:
            while waiting and len(busy) < self.slots:
                busy.append(waiting.pop())
            if not waiting and len(busy) <= last:
                for steps in sorted(busy, reverse=True):
                    to_host(steps, now)
                break
            now += self.launch_s(len(busy))
            busy = [steps - STEPS_OF_LAUNCH for steps in busy if steps > STEPS_OF_LAUNCH]
        return now, max(host)


def main():
    options, steps = parse()
    machine = Machine(options)
    ranked = sorted(range(len(steps)), key=lambda i: -steps[i])
    first = ranked[:LONGEST]
    run_order = list(range(len(steps)))
    random.Random(1).shuffle(run_order)
    begun = set(first)
    rest = [i for i in run_order if i not in begun]
    free = options.threads - max(1, options.threads // 4)
    print(f"{len(steps)} realizations; steps: mean {sum(steps) / len(steps):.0f}, longest {steps[ranked[0]]}")
    print("order            on the host  device s  host s  bound by")
    ways = [("run order", 0, run_order, 0), ("longest first", 0, first + rest, 0)]
    ways += [("longest first", apart, first + rest, 2 * options.threads) for apart in (0, free, 2 * free, 3 * free)]
    for name, apart, order, last in ways:
        host = set(ranked[:apart])
        device_s, host_s = machine.run([steps[i] for i in order if i not in host], [steps[i] for i in host],
                                       free if apart else options.threads, last)
        print(f"{name:15} {apart:11}  {device_s:8.2f}  {host_s:6.2f}  {'host' if host_s > device_s else 'device'}")


if __name__ == "__main__":
    main()
