# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers of a run that go into the table of a study, by name (docs/studies.md, docs/analysis.md)."""
from dataclasses import dataclass

import numpy as np

import curves
import findings
from analysis import peaks, relaxation
from analysis import (concentration, deposit, dilatancy, energy, pore_pressure, pores, rheology, shear_band,
                      weight_balance)
from analysis.once import or_remark


@dataclass
class Measured:
    """A column of the table: what is measured of a run, None where it cannot be told."""

    name: str        # in study.csv
    title: str
    unit: str        # for the axis of a plot
    plain_unit: str  # for a table
    measure: object  # function of RunData

    def of(self, run):
        """None, and a remark of the run, where its files cannot be read."""
        return or_remark(run, self.title, lambda: self.measure(run))


def end_of(column):
    return lambda run: run.end(column)


def end_norm(vector):
    """Norm in the last row of a vector with the columns `vector`_x, _y and, in space, _z."""
    def value(run):
        x, y, z = (run.end(f'{vector}_{axis}') for axis in 'xyz')
        return None if None in (x, y) else float(np.linalg.norm([x, y, z or 0.0]))
    return value


def peak_part(part):
    def value(run):
        found = peaks.peak(run)
        return getattr(found, part) if found else None
    return value


def maximum(column, in_record):
    return lambda run: findings.largest(run, column, in_record)


def of_found(measure, part):
    """An attribute of what a measurement finds."""
    def value(run):
        found = measure(run)
        return None if found is None else getattr(found, part)
    return value


def of_bed(k):
    def value(run):
        found = None if run.is_avalanche() else concentration.bed(run)
        return None if found is None else found[k]
    return value


DEGREES = 'degrees'
RELATIVE = '-'

MEASURED = [
    Measured('peak_velocity', 'Peak of the mean velocity', r'$|\langle u \rangle|\,/\,u_c$', 'u_c', peak_part('value')),
    Measured('peak_time', 'Time of the peak', curves.TIME_LABEL, 't_c', peak_part('time')),
    Measured('relaxation_time', 'Relaxation time of an avalanche', curves.TIME_LABEL, 't_c',
             relaxation.relaxation_time),
    Measured('relaxation_bound', 'Relaxation time longer than', curves.TIME_LABEL, 't_c', relaxation.relaxation_bound),
    Measured('rest_time', 'At rest from', curves.TIME_LABEL, 't_c', findings.rest_time),
    Measured('end_front', 'Front at the end', r'$\max(x+R)\,/\,D$', 'D', end_of('front_x')),
    Measured('end_height', 'Mean height at the end', r'$\langle y \rangle\,/\,D$', 'D',
             lambda run: None if run.has_cyclic_floor() else run.end('mean_position_y')),
    Measured('end_velocity', 'Mean velocity at the end', r'$|\langle u \rangle|\,/\,u_c$', 'u_c',
             end_of('mean_velocity_norm')),
    Measured('end_flow', 'Mean velocity of the whole box at the end', r'$|\langle u_f \rangle|\,/\,u_c$', 'u_c',
             end_norm('flow')),
    Measured('end_force', 'Force of the fluid on all grains at the end', r'$|\Sigma F|\,/\,\rho_f u_c^2 D^{d-1}$',
             'ρ_f u_c² D, in space ρ_f u_c² D²', end_norm('fluid_force')),
    Measured('overlap', 'Largest overlap', r'overlap $/\,D$', 'D', maximum('max_penetration', 'penetration')),
    Measured('grain_balance', 'Defect of the grains\' momentum', RELATIVE, RELATIVE,
             maximum('grain_balance', 'grain_balance')),
    Measured('unconverged_windows', 'Windows beyond contact.tolerance', 'windows', 'windows',
             findings.unconverged_windows),
    Measured('wall_seconds', 'Wall time', 'seconds', 's', lambda run: findings.wall_seconds(run)[0]),
    Measured('run_out', 'Run-out', r'$(L - L_0)\,/\,L_0$', RELATIVE, of_found(deposit.deposit, 'run_out')),
    Measured('heap_height', 'Height of the heap', r'$H\,/\,D$', 'D', of_found(deposit.deposit, 'top')),
    Measured('heap_slope', 'Slope of the heap', DEGREES, '°', of_found(deposit.deposit, 'slope')),
    Measured('slip_angle', 'Angle of the slip plane', DEGREES, '°', of_found(shear_band.shear_band, 'slip_angle')),
    Measured('quiescent_share', 'Grains at rest at half of the peak', 'share', RELATIVE,
             of_found(shear_band.shear_band, 'quiescent')),
    Measured('pore_change', f'Pores where δx/x₀ = {pores.AT:g}', r'$\delta V\,/\,V_0$', RELATIVE, pores.change_at),
    Measured('pore_extreme', f'Largest change of the pores until δx/x₀ = {pores.AT:g}', r'$\delta V\,/\,V_0$', RELATIVE,
             pores.largest_change),
    Measured('dilatancy_angle', 'Dilatancy angle until half of the peak', DEGREES, '°', dilatancy.initial_angle),
    Measured('pressure_lowest', 'Lowest pressure inside the column', r'$p\,/\,(\rho_s - \rho_f)\,g D$',
             '(ρ_s − ρ_f) g D', lambda run: pore_pressure.extreme(run, -1)),
    Measured('pressure_highest', 'Highest pressure inside the column', r'$p\,/\,(\rho_s - \rho_f)\,g D$',
             '(ρ_s − ρ_f) g D', lambda run: pore_pressure.extreme(run, 1)),
    Measured('least_on_contacts', 'Least share of the weight on contacts', 'share', RELATIVE,
             weight_balance.least_on_contacts),
    Measured('weight_defect', 'Defect of the weight at rest', RELATIVE, RELATIVE, weight_balance.final_defect),
    Measured('energy_defect', 'Defect of the energy', RELATIVE, RELATIVE, energy.largest_defect),
    Measured('to_contacts', 'Energy to contacts', 'share', RELATIVE,
             lambda run: energy.dissipated_share(run, 'contacts')),
    Measured('to_fluid', 'Energy to the liquid', 'share', RELATIVE,
             lambda run: energy.dissipated_share(run, 'fluid') if run.is_wet() else None),
    Measured('friction_slow', 'Friction where I < 0.01', r'$\mu$', RELATIVE,
             lambda run: rheology.friction_between(run, 0.0, 0.01)),
    Measured('friction_fast', 'Friction where 0.1 ≤ I < 1', r'$\mu$', RELATIVE,
             lambda run: rheology.friction_between(run, 0.1, 1.0)),
    Measured('bed_height', 'Height of the bed', r'$H\,/\,D$', 'D', of_bed(0)),
    Measured('bed_concentration', 'Concentration of the bed', 'solid share', RELATIVE, of_bed(1)),
]
UNTIL_REST = ('run_out', 'heap_height', 'heap_slope', 'bed_height', 'bed_concentration')  # final for grains at rest
OF_PEAKS = ('peak_velocity', 'peak_time')
DRAWN = ('peak_velocity', 'peak_time', 'relaxation_time', 'rest_time', 'end_front', 'end_height', 'run_out', 'slip_angle',
         'pore_change', 'wall_seconds')
ANALYSIS = [one for one in MEASURED if one.name.startswith('relaxation') or MEASURED.index(one) >= [
    m.name for m in MEASURED].index('run_out')]  # what no other table of a comparison tells


def number(value):
    return '' if value is None else f'{value:.4g}'


def spread(values):
    """`mean (smallest to largest; 2 of 3 runs)` of those that are known, the last part where some are not."""
    known = [value for value in values if value is not None]
    if not known:
        return ''
    told = [] if min(known) == max(known) else [f'{number(min(known))} to {number(max(known))}']
    told += [f'{len(known)} of {len(values)} runs'] if len(known) < len(values) else []
    return number(float(np.mean(known))) + (f' ({"; ".join(told)})' if told else '')


def titled(one):
    """A title with the unit, where there is one."""
    return one.title if one.plain_unit == RELATIVE else f'{one.title} [{one.plain_unit}]'


def table(quantities, members):
    """A row per quantity that some run of the members has: its title with the unit, then a cell per member."""
    found = [(one, [[one.of(run) for run in member.runs] for member in members]) for one in quantities]
    return [[titled(one)] + [spread(values) + so_far(one, member.runs, values) for member, values in zip(members, cells)]
            for one, cells in found if any(value is not None for values in cells for value in values)]


def so_far(one, runs, values):
    """' so far' for what a longer run may still change: of grains that move at the end, a peak in the last row; else empty."""
    return ' so far' if any(value is not None and may_change(one, run) for run, value in zip(runs, values)) else ''


def may_change(one, run):
    if one.name in UNTIL_REST:
        return findings.rest_time(run) is None and findings.has_moved(run)
    found = peaks.peak(run) if one.name in OF_PEAKS else None
    return found is not None and found.time >= run.history['time'][-1]
