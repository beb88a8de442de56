"""Reads a ground motion of any known format:  python3 record.py earthquake.AT2 [UNIT]"""

import sys

import stylobate

record = stylobate.Record.read(sys.argv[1], unit=sys.argv[2] if len(sys.argv) > 2 else None)
periods_s = [0.1, 0.3, 1.0]
print(f"{record.format}: {record.duration_s:.2f} s, PGA {record.intensity().pga_m_s2:.2f} m/s2")
print("Sa [m/s2] at", periods_s, "s:", record.spectral_acceleration_m_s2(periods_s))
