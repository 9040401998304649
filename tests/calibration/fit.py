#!/usr/bin/env python3
"""Fits the forecasts of core/plan to measured scenes.

    fit.py errors STATED.csv TRACED.csv > core/plan/forecast_errors.h
    fit.py times TIMES.csv > core/plan/forecast_times.h

The CSVs come from build/release/tests/calibrate; see README.md here. Plain Python: a thousand rows.
"""
import csv
import math
import sys

RIDGE = 2.0  # pull of coefficients towards 0, in rows
QUANTILE = 0.6  # share of the fitted scenes of which no more is stated than the forecast
NOISE_QUANTILE = 0.95  # share of the fitted scenes whose noise must stay under its forecast
TIME_QUANTILE = 0.55  # share of the timed renders that must take at most their forecast
FLOOR = 0.001  # smallest error that counts


def solve(matrix, right):
    """Gauss elimination with pivots; small dense systems."""
    n = len(right)
    a = [row[:] + [right[i]] for i, row in enumerate(matrix)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(a[r][i]))
        a[i], a[pivot] = a[pivot], a[i]
        for r in range(i + 1, n):
            factor = a[r][i] / a[i][i]
            for c in range(i, n + 1):
                a[r][c] -= factor * a[i][c]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (a[i][n] - sum(a[i][c] * x[c] for c in range(i + 1, n))) / a[i][i]
    return x


def ridge(rows, targets, weights):
    """Weighted least squares; the first figure is 1 and not pulled. Figures are scaled by their spread."""
    n = len(rows[0])
    total = sum(weights)
    mean = [sum(w * r[i] for r, w in zip(rows, weights)) / total for i in range(n)]
    spread = [math.sqrt(sum(w * (r[i] - mean[i]) ** 2 for r, w in zip(rows, weights)) / total) for i in range(n)]
    used = [0] + [i for i in range(1, n) if spread[i] > 1e-9]
    scaled = [[1.0] + [(r[i] - mean[i]) / spread[i] for i in used[1:]] for r in rows]
    m = len(used)
    normal = [[sum(w * r[i] * r[j] for r, w in zip(scaled, weights)) + (RIDGE if i == j and i > 0 else 0)
               for j in range(m)] for i in range(m)]
    right = [sum(w * r[i] * t for r, t, w in zip(scaled, targets, weights)) for i in range(m)]
    x = solve(normal, right)
    coefficients = [0.0] * n
    coefficients[0] = x[0]
    for k, i in enumerate(used[1:], 1):
        coefficients[i] = x[k] / spread[i]
        coefficients[0] -= x[k] * mean[i] / spread[i]
    return coefficients


def nonnegative(rows, targets, rounds=12, steps=400):
    """Coefficients >= 0 by coordinate descent. Rows are weighed anew by 1 / (target x forecast), so that twice as much and
    half as much count alike; then all are scaled so that TIME_QUANTILE of the rows take at most their forecast."""
    n = len(rows[0])
    x = [0.0] * n
    forecasts = targets
    for _ in range(rounds):
        weights = [1 / math.sqrt(t * f) for t, f in zip(targets, forecasts)]
        scaled = [[v * w for v in r] for r, w in zip(rows, weights)]
        norms = [sum(r[i] ** 2 for r in scaled) for i in range(n)]
        left = [t * w - sum(a * b for a, b in zip(x, r)) for r, t, w in zip(scaled, targets, weights)]
        for _ in range(steps):
            for i in range(n):
                if norms[i] <= 0:
                    continue
                change = max(sum(r[i] * l for r, l in zip(scaled, left)) / norms[i], -x[i])
                x[i] += change
                left = [l - change * r[i] for r, l in zip(scaled, left)]
        forecasts = [max(sum(a * b for a, b in zip(x, r)), 0.01 * t) for r, t in zip(rows, targets)]
    margin = quantile([t / f for t, f in zip(targets, forecasts)], TIME_QUANTILE)
    return [margin * value for value in x]


def read(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def figures(row, prefix):
    return [float(v) for k, v in row.items() if k.startswith(prefix)]


def quantile(values, share):
    ordered = sorted(values)
    return ordered[min(int(math.ceil(share * len(ordered))) - 1, len(ordered) - 1)]


def error_model(rows, targets, share):
    """Coefficients of log(target), the margin in the first."""
    kept = [figures(row, "e_") for row in rows]
    logs = [math.log(max(t, FLOOR)) for t in targets]
    coefficients = ridge(kept, logs, [1.0] * len(rows))
    residuals = [t - sum(c * f for c, f in zip(coefficients, r)) for r, t in zip(kept, logs)]
    coefficients[0] += quantile(residuals, share)
    return coefficients


def stated_model(rows):
    """Of what is stated, without what is known of every picture (core/plan/known_error.h)."""
    stated = [(float(r["stated"]), float(r["known"])) for r in rows]
    return error_model(rows, [math.sqrt(max(s * s - k * k, 0)) for s, k in stated], QUANTILE)


def table(name, kind, coefficients):
    values = ", ".join(f"{c:.6g}" for c in coefficients)
    print(f"inline constexpr {kind} {name} = {{{{{values}}}}};")


HEAD = """// Coefficients of the forecasts, written by tests/calibration/fit.py from scenes measured by tests/calibration. Not to be
// edited by hand: measure and fit anew when a rung changes.
// clang-format off
#pragma once

#include "core/plan/forecast_figures.h"

namespace awan {
"""
END = """
}  // namespace awan"""


def fit_errors(rows, traced):
    print(HEAD)
    print("""// log(error) = sum of coefficient x figure, the margin included. Of grids without what known_error.h says.
struct ErrorModel {
    ErrorFigures coefficient;
};""")
    rows = [r for r in rows if r["rung"] != "truth" and math.isfinite(float(r["stated"]))]
    for name, rung in (("kAdditiveError", "additive"), ("kHarrisError", "harris"), ("kSingleError", "single"),
                       ("kTransportError", "transport")):
        table(name, "ErrorModel", stated_model([r for r in rows if r["rung"].startswith(rung)]))
    print("// Of rung truth: rms noise of a pixel with one path.")
    paths = [r for r in traced if r["rung"] == "truth"]
    noise = [float(r["error"]) * math.sqrt(float(r["samples"])) for r in paths]
    table("kPathNoise", "ErrorModel", error_model(paths, noise, NOISE_QUANTILE))
    print(END)


def fit_times(times):
    print(HEAD)
    print("""// ms = sum of coefficient x figure, with two threads on the machine of the calibration.
struct TimeModel {
    TimeFigures coefficient;
};""")
    def timed(rungs, part, keep):
        # What did not run (a light pass that the scene did not call for) says nothing.
        rows = [r for r in times if r["rung"].startswith(rungs) and part(r) > 0.1]
        kept = [[f if i in keep else 0.0 for i, f in enumerate(figures(r, "t_"))] for r in rows]
        return nonnegative(kept, [part(r) for r in rows])
    def field(name):
        return lambda r: float(r[name])
    def rest(r):
        return float(r["time_ms"]) - float(r["light_ms"]) - float(r["draw_ms"]) - float(r["measure_ms"])
    print("// Generate, survey and plan.")
    table("kPrepareTime", "TimeModel", timed(("transport",), rest, (0, 2, 3, 10)))
    table("kAdditiveTime", "TimeModel", timed(("additive",), field("draw_ms"), (0, 2, 3, 4, 9)))
    table("kHarrisLightTime", "TimeModel", timed(("harris",), field("light_ms"), (0, 2)))
    table("kHarrisDrawTime", "TimeModel", timed(("harris",), field("draw_ms"), (0, 2, 3, 4, 9)))
    table("kMarchLightTime", "TimeModel", timed(("transport", "single"), field("light_ms"), (0, 2, 5, 6, 12, 13)))
    table("kMarchDrawTime", "TimeModel", timed(("transport", "single"), field("draw_ms"), (0, 1, 2, 3, 4, 8, 9, 11, 13)))
    def measured(rungs, keep):
        rows = [r for r in times if r["rung"].startswith(rungs) and float(r["measure_ms"]) > 0.1]
        kept = [[f if i in keep else 0.0 for i, f in enumerate(figures(r, "m_"))] for r in rows]
        return nonnegative(kept, [float(r["measure_ms"]) for r in rows])
    print("// Measuring the error (measuring_figures): of grids; of others, with the light of the coarsest grid.")
    table("kMeasureGridTime", "TimeModel", measured(("transport",), (0, 1, 2, 3, 4, 8, 9, 11, 13)))
    table("kMeasureOtherTime", "TimeModel",
          measured(("additive", "harris", "single"), (0, 1, 2, 3, 4, 5, 6, 8, 9, 11, 12, 13)))
    table("kPathTime", "TimeModel", timed(("truth",), field("draw_ms"), (0, 2, 4, 7, 9)))
    print(END)


def main():
    if sys.argv[1] == "errors":
        fit_errors(read(sys.argv[2]), read(sys.argv[3]))
    else:
        fit_times(read(sys.argv[2]))


if __name__ == "__main__":
    main()
