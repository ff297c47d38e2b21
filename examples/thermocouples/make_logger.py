"""Makes logger.csv from a run of truth.toml: what a logger would have written, with noise of 0.5 K, five seconds before the
pour, two dead channels, and the signs of a German one.

    solidus run examples/thermocouples/truth.toml -o results/truth
    python3 examples/thermocouples/make_logger.py results/truth > examples/thermocouples/logger.csv
"""

import csv
import random
import sys

PROBES = ("T_centre[degC]", "T_casting[degC]", "T_wall[degC]", "T_mould[degC]")
BEFORE, NOISE = 5, 0.5


def german(value):
    return f"{value:.2f}".replace(".", ",")


def main(folder):
    with open(f"{folder}/history.csv", newline="") as file:
        header, *rows = csv.reader(file)
    columns = [header.index(probe) for probe in PROBES]
    noise = random.Random(55)
    print("Logger 8 channels;;;;;;\nStart;2026-11-02 09:14:03;;;;;\nTime;TC1;TC2;TC3;TC4;TC5;TC6\ns;°C;°C;°C;°C;°C;°C")
    room = [180.0 if "mould" in probe or "wall" in probe else 24.0 for probe in PROBES]
    for second in range(BEFORE):
        print(";".join([german(second), *(german(t + noise.gauss(0, NOISE)) for t in room), "22,10", "9999"]))
    for row in rows:
        values = [float(row[column]) + noise.gauss(0, NOISE) for column in columns]
        print(";".join([german(float(row[0]) + BEFORE), *map(german, values), "22,10", "9999"]))


if __name__ == "__main__":
    main(sys.argv[1])
