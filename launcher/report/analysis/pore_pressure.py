# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pore pressure: the reduced pressure of the liquid (that of a liquid at rest taken off) between the grains.

Unit: (rho_s - rho_f) g D, the submerged weight per area of a layer of solid of one D, so that phi H/D would carry a
whole column of height H; rho_s is the mean density of the grains at first. Negative values hold a packing that dilates
together, positive ones carry one that contracts (Topin et al. 2011, section 3.3). In a closed box the level of a
pressure means nothing: there it is taken relative to the upper right corner.
"""
from dataclasses import dataclass

import numpy as np

import findings
import fluid_fields
import run_data
import solid
from analysis import peaks
from analysis import snapshots
from analysis.once import once_per_run

MOST_FIELDS = 21
PLACES = ('base', 'wall', 'inside')


@dataclass
class Probes:
    """Pressures at fixed places [(rho_s - rho_f) g D]."""

    names: list         # of the places, for a legend
    places: np.ndarray  # (k, 2), in space (k, 3) [D]
    time: np.ndarray    # (n,) [t_c]
    values: np.ndarray  # (n, k)


def unit(run):
    """(rho_s - rho_f) g D over rho_f [u^2]; None for grains that are not denser than the fluid."""
    excess = solid.first_mean_density(run) - 1.0
    return excess * float(run.record.get('g') or 1.0) * run.scale('D') if excess > 0.0 else None


def has_level(run):
    """Whether some side of the box fixes a pressure."""
    return any(run.case.get(f'domain.{side}') == 'free' for side in ('left', 'right', 'bottom', 'top', 'front', 'back'))


def field(run, time, folder):
    """(rows, columns) of equal height at one of fluid_fields.field_times."""
    pressure = fluid_fields.pressure_at(run, time, folder) / unit(run)
    return pressure if has_level(run) else pressure - pressure[-1, -1]


def natural_places(run):
    """Base: on the floor in the middle of the column; wall: half-way up the left wall; inside: half-way up the middle;
    half a D off floor and wall. From the grains of the first output whose motion is not prescribed."""
    first = snapshots.snapshots(run)[0]
    width, height = first.centres[first.free()].max(axis=0) + 0.5
    return np.array([[width / 2, 0.5], [0.5, height / 2], [width / 2, height / 2]])


def at_places(pressure, places, size):
    """Bilinear between the middles of cells, constant beyond; places (k, 2) and size in D."""
    rows, columns = pressure.shape
    x = np.clip(places[:, 0] / size[0] * columns - 0.5, 0, columns - 1)
    y = np.clip(places[:, 1] / size[1] * rows - 0.5, 0, rows - 1)
    i, j = np.minimum(x.astype(int), columns - 2), np.minimum(y.astype(int), rows - 2)
    s, t = x - i, y - j
    return ((1 - s) * (1 - t) * pressure[j, i] + s * (1 - t) * pressure[j, i + 1]
            + (1 - s) * t * pressure[j + 1, i] + s * t * pressure[j + 1, i + 1])


@once_per_run
def probes(run):
    """Of probes.csv where the case has output.probes, otherwise of the fields at the natural places of a column; None
    for other runs."""
    if not run.is_wet() or unit(run) is None:
        return None
    if has_written_probes(run):
        return written_probes(run)
    if run.in_space():
        return None
    return field_probes(run) if run.is_avalanche() and snapshots.snapshots(run) else None


def has_written_probes(run):
    """They are as the liquid has them, without a shift of the level."""
    return (run.folder / 'probes.csv').exists() and run.given('output.probes') is not None


def written_probes(run):
    rows = run_data.read_history(run.folder / 'probes.csv')
    places = np.array([float(v) for v in run.case['output.probes'].strip('[]').split(',')])
    places = places.reshape(-1, 3 if run.in_space() else 2)
    if not len(rows['time']):
        return None
    values = np.column_stack([rows[f'pressure_{k + 1}'] for k in range(len(places))]) * run.scale('u_c')**2 / unit(run)
    names = [f'({", ".join(f"{x:g}" for x in place)}) D' for place in places]
    return Probes(names, places, rows['time'], values)


def field_probes(run):
    times = fluid_fields.field_times(run)
    chosen = [times[i] for i in snapshots.evenly(len(times), MOST_FIELDS)]
    places, found = natural_places(run), []
    for time, folder in chosen:
        try:
            found.append((time / run.scale('t_c'), at_places(field(run, time, folder), places, run.size())))
        except (ValueError, KeyError, OSError) as error:
            run.remarks.append(f'Pressure at {time:g}: {error}')
    if len(found) < 2:
        return None
    names = [f'{name}, ({x:.3g}, {y:.3g}) D' for name, (x, y) in zip(PLACES, places)]
    return Probes(names, places, np.array([time for time, _ in found]), np.array([values for _, values in found]))


def extreme(run, sign):
    """Largest (sign 1) or smallest (-1) pressure at the last of the places in the pile, after the start."""
    found = inside(run)
    if found is None or not run.is_avalanche():
        return None
    time, values = found
    values = values[time > 0.0]
    return float(sign * (sign * values).max()) if len(values) else None


def while_starting(run):
    """(lowest, highest) there until the mean velocity of an avalanche has risen to half of its peak; None without."""
    found, half = inside(run), peaks.half_time(run)
    if found is None or half is None or not run.is_avalanche():
        return None
    time, values = found
    early = values[(time > 0.0) & findings.until(time, half)]
    return (float(early.min()), float(early.max())) if len(early) else None


def inside(run):
    """(times, pressures) at the last of the places in the box around the grains of the first output; None without one."""
    found, extent = probes(run), run_data.first_extent(run)
    if found is None:
        return None
    if extent is None:  # as far as one knows
        return found.time, found.values[:, -1]
    low, high = (side[:found.places.shape[1]] for side in extent)
    within = np.flatnonzero(((found.places >= low) & (found.places <= high)).all(axis=1))
    return (found.time, found.values[:, within[-1]]) if len(within) else None
