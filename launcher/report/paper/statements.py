# SPDX-License-Identifier: LGPL-2.1-or-later
"""The statements of the paper beside our own numbers. Each is a function of the runs that returns (ours, agrees) with
agrees True, False or None (measured, but the paper gives no number to judge by); or None where runs are missing."""
from dataclasses import dataclass

import numpy as np

import findings
import peaks
import relaxation
from analysis import deposit, energy, pores, shear_band
from differences import difference
from paper.figures import waiting_line
from paper.selection import COMPACITIES, DENSE, LOOSE, REYNOLDS, spread

AT_ONCE = 1.0            # t_c: the loosest column waits no longer
STRAIGHT = 0.9           # R^2 of a linear dependence
WEAK = 2.0               # largest ratio of slopes that still is a weak dependence
SAME_CURVE = 0.1         # largest mean difference of curves that count as similar
BACK = 0.1               # of the largest mean velocity: the grains of a wave that runs back are faster
NEVER = float('inf')     # t_relax of a column that has not slid
SATURATED = 0.5          # of the first slope of dV/V0: the largest second one that is another regime
ALIKE = 0.1              # relative spread within which values count as independent of phi


@dataclass
class Statement:
    section: str
    text: str
    paper: str
    measure: object  # function of PaperRuns
    part: str        # of the study, for the command


def peak_value(run):
    found = peaks.peak(run)
    return None if found is None else found.value


def peak_time(run):
    found = peaks.peak(run)
    return None if found is None else found.time


def triangles_are_slower(runs):
    discs, triangles = (runs.numbers(findings.rest_time, 'sedimentation', variant=variant)
                        for variant in ('discs-nscd', 'triangles-nscd'))
    if not discs or not triangles:
        return None
    ratio = np.mean(triangles) / np.mean(discs)
    return (f'rest at {spread(triangles)} against {spread(discs)} t_c: {100 * (ratio - 1):+.0f} %', 1.0 < ratio < 1.2)


def md_from_nscd(runs, shape):
    """Mean difference of the mean vertical velocities over the largest; None where a run is missing."""
    nscd, md = (runs.member('sedimentation', variant=f'{shape}-{method}') for method in ('nscd', 'md'))
    if nscd is None or md is None:
        return None
    apart = difference(nscd.data.column('mean_velocity_y'), md.data.column('mean_velocity_y'))
    return apart.relative(apart.mean) if apart is not None and apart.scale else None


def md_is_like_nscd(runs):
    shares = {shape: md_from_nscd(runs, shape) for shape in ('discs', 'triangles')}
    shares = {shape: share for shape, share in shares.items() if share is not None}
    if not shares:
        return None
    text = ', '.join(f'{shape}: {100 * share:.2g} %' for shape, share in shares.items())
    return f'⟨u_y⟩ differs by, of its largest value on average, {text}', max(shares.values()) < SAME_CURVE


def dry_peak(runs):
    times = {phi: runs.numbers(peak_time, 'dry', compacity=phi) for phi in COMPACITIES}
    if not all(times.values()):
        return None
    text = ', '.join(f'φ = {phi}: {spread(found)}' for phi, found in times.items())
    means = [np.mean(found) for found in times.values()]
    return f'{text} t_c', abs(np.mean(means) - 9.0) < 1.0 and np.ptp(means) < 2.0


def dry_does_not_depend_on_compacity(runs):
    values = {phi: runs.numbers(peak_value, 'dry', compacity=phi) for phi in COMPACITIES}
    if not all(values.values()):
        return None
    means = np.array([np.mean(found) for found in values.values()])
    text = ', '.join(f'φ = {phi}: {spread(found)}' for phi, found in values.items())
    return f'peaks {text} u_c', bool(np.ptp(means) / means.mean() < ALIKE)


def waits(runs, reynolds, compacity):
    """t_relax of these columns [t_c], NEVER for one that has not slid by its end."""
    times = [relaxation.relaxation_time(run) for run in runs.of('immersed', compacity=compacity, reynolds=reynolds)]
    return [NEVER if time is None else time for time in times]


def told(times):
    slid = [time for time in times if time < NEVER]
    if len(slid) == len(times):
        return spread(slid)
    return f'{spread(slid)}, {len(times) - len(slid)} of {len(times)} not by the end' if slid else 'not by the end'


def loose_at_once(runs):
    found = {reynolds: waits(runs, reynolds, LOOSE) for reynolds in REYNOLDS}
    if not all(found.values()):
        return None
    text = ', '.join(f'Re = {reynolds}: {told(times)}' for reynolds, times in found.items())
    return f't_relax {text} t_c', all(max(times) < AT_ONCE for times in found.values())


def dense_waits(runs):
    found = {phi: [waits(runs, reynolds, phi) for reynolds in REYNOLDS] for phi in COMPACITIES[1:]}
    if not all(all(times) for times in found.values()):
        return None
    found = {phi: sum(times, []) for phi, times in found.items()}
    text = ', '.join(f'φ = {phi}: {told(times)}' for phi, times in found.items())
    return f't_relax over all Re: {text} t_c', all(min(times) > 0.0 for times in found.values())


def waiting_lines(runs):
    """figures.waiting_line by Re; None if any column was not played."""
    played = all(waits(runs, reynolds, phi) for reynolds in REYNOLDS for phi in COMPACITIES[1:])
    return {reynolds: waiting_line(runs, reynolds) for reynolds in REYNOLDS} if played else None


def told_of_lines(fits, of_fit, fewer):
    return ', '.join(f'Re = {reynolds}: {of_fit(fit) if fit else fewer}' for reynolds, fit in fits.items())


def waits_linearly(runs):
    fits = waiting_lines(runs)
    if fits is None:
        return None
    fits = {reynolds: fit if fit and fit[2] is not None else None for reynolds, fit in fits.items()}
    known = [fit for fit in fits.values() if fit]
    return (told_of_lines(fits, lambda fit: f'R² = {fit[2]:.2f}', 'fewer than three have slid'),
            all(fit[2] >= STRAIGHT for fit in known) if known else None)


def slopes_are_alike(runs):
    """Where hardly a column has slid at one Re while others have at another, Re changes more than slightly."""
    fits = waiting_lines(runs)
    if fits is None:
        return None
    slopes = [fit[0] for fit in fits.values() if fit]
    text = told_of_lines(fits, lambda fit: f'{fit[0]:.3g} t_c', 'fewer than two have slid')
    if not slopes:
        return f'slopes per unit of φ {text}', None
    return (f'slopes per unit of φ {text}',
            len(slopes) == len(fits) and min(slopes) > 0.0 and max(slopes) / min(slopes) < WEAK)


def peaks_of(runs, reynolds):
    """Mean peak velocity by compacity; None unless all columns are there."""
    found = [runs.numbers(peak_value, 'immersed', compacity=phi, reynolds=reynolds) for phi in COMPACITIES]
    return [float(np.mean(values)) for values in found] if all(found) else None


def peak_falls_with_compacity(runs):
    found = {reynolds: peaks_of(runs, reynolds) for reynolds in REYNOLDS}
    if any(values is None for values in found.values()):
        return None
    text = '; '.join(f'Re = {reynolds}: ' + ', '.join(f'{value:.3g}' for value in values)
                     for reynolds, values in found.items())
    return f'{text} u_c from loose to dense, to 20 t_c', all((np.diff(values) < 0.0).all() for values in found.values())


def peak_and_viscosity(runs):
    found = {reynolds: peaks_of(runs, reynolds) for reynolds in REYNOLDS}
    if any(values is None for values in found.values()):
        return None
    falls = [all(np.diff([found[reynolds][k] for reynolds in REYNOLDS]) < 0.0) for k in range(len(COMPACITIES))]
    return (f'the peak falls with growing viscosity for {sum(falls)} of {len(falls)} compacities: read as "for '
            'decreasing φ and decreasing 1/Re"', all(falls))


def slides_at_45(runs):
    found = runs.numbers(lambda run: getattr(shear_band.shear_band(run), 'angle', None), 'immersed', compacity=DENSE,
                         reynolds='89')
    return (f'{spread(found)}° below the horizontal', bool(abs(np.mean(found) - 45.0) <= 10.0)) if found else None


def wedge_rests(runs):
    found = runs.numbers(lambda run: getattr(shear_band.shear_band(run), 'quiescent', None), 'immersed',
                         compacity=DENSE, reynolds='89')
    return (f'{100 * np.mean(found):.0f} % of the grains rest at half of the peak', bool(np.mean(found) > 0.2)) if found else None


def spreads_half(runs):
    found = [runs.numbers(lambda run: getattr(deposit.deposit(run), 'run_out', None), 'run-out', compacity=phi)
             for phi in (LOOSE, DENSE)]
    if not all(found):
        return None
    loose, dense = (float(np.mean(values)) for values in found)
    if loose <= 0.0:
        return f'run-outs {dense:.3g} (dense) and {loose:.3g} (loose)', False
    return (f'run-outs {dense:.3g} (dense) and {loose:.3g} (loose): ratio {dense / loose:.2g}',
            0.35 <= dense / loose <= 0.65)


def wave_breaks(runs):
    """The mean horizontal velocity turns round after the front has reached the right wall."""
    for run in runs.of('closed'):
        time, front = run.column('front_x')
        arrived = np.flatnonzero(front >= run.size()[0] - 0.5)
        _, velocity = run.column('mean_velocity_x')
        if not len(arrived):
            return 'the front does not reach the right wall', False
        back = float(velocity[arrived[0]:].min())
        forth = float(velocity.max())
        return (f'front at the right wall at {time[arrived[0]]:.3g} t_c; ⟨u_x⟩ up to {forth:.2g}, then down to '
                f'{back:.2g} u_c', back < -BACK * forth)
    return None


def pores_at(runs):
    found = [runs.numbers(pores.largest_change, 'immersed', compacity=phi, reynolds='89') for phi in COMPACITIES]
    return [float(np.mean(values)) for values in found] if all(found) else None


def only_the_loosest_contracts(runs):
    found = pores_at(runs)
    if found is None:
        return None
    text = ', '.join(f'φ = {phi}: {value:+.3g}' for phi, value in zip(COMPACITIES, found))
    return f'{text} until δx/x₀ = {pores.AT:g}', found[0] < 0.0 and min(found[1:]) > 0.0


def pores_grow_with_compacity(runs):
    found = pores_at(runs)
    return None if found is None else (', '.join(f'{value:+.3g}' for value in found) + ' from loose to dense',
                                       bool((np.diff(found) > 0.0).all()))


def two_regimes(runs):
    """Two lines fitted to dV/V0 against dx/x0 of the columns that dilate."""
    found = [pores.regimes(run) for phi in COMPACITIES[1:] for run in runs.of('immersed', compacity=phi, reynolds='89')]
    found = [one for one in found if one is not None]
    if not found:
        return None
    flatter = [one.second / one.first if one.first > 0.0 else np.inf for one in found]
    return (f'the second {spread(flatter, ".2f")} times as steep as the first, from δx/x₀ = '
            f'{spread([one.knee for one in found], ".2f")} on',
            max(flatter) < SATURATED)


def energy_closes(runs):
    found = [energy.largest_defect(run.data) for run in runs.runs if run.data.history is not None]
    found = [value for value in found if value is not None]
    return (f'largest defect {max(found):.1e} of {len(found)} runs', max(found) < 1e-3) if found else None


def momentum_closes(runs):
    found = [findings.largest(run.data, 'grain_balance', 'grain_balance') for run in runs.runs
             if run.data.history is not None]
    found = [value for value in found if value is not None]
    return (f'largest defect {max(found):.1e} of {len(found)} runs', max(found) < 1e-8) if found else None


STATEMENTS = [
    Statement('2.3', 'Triangles need longer than discs to sediment', 'about 10 %', triangles_are_slower, 'sedimentation'),
    Statement('2.3', 'NSCD and MD give similar results in sedimentation', 'similar', md_is_like_nscd, 'sedimentation'),
    Statement('3.3', 'Dry columns reach their largest mean velocity', '9.0 t_c', dry_peak, 'dry'),
    Statement('3.3', 'Without fluid the compacity does not influence the mean velocity', 'the same for all',
              dry_does_not_depend_on_compacity, 'dry'),
    Statement('3.3', 'The loosest column destabilises instantly', 't_relax = 0', loose_at_once, 'immersed'),
    Statement('3.3', 'From φ = 0.829 on columns wait', 't_relax > 0', dense_waits, 'immersed'),
    Statement('3.3', 't_relax grows linearly with φ', 'linear', waits_linearly, 'immersed'),
    Statement('3.3', 'Re changes the slope only slightly', 'slightly', slopes_are_alike, 'immersed'),
    Statement('3.3', 'The largest velocity rises with falling φ', 'rises', peak_falls_with_compacity, 'immersed'),
    Statement('3.3', 'The largest velocity and Re ("increasing for a decreasing value of φ and 1/Re")', 'rises with Re',
              peak_and_viscosity, 'immersed'),
    Statement('3.2', 'The densest column slides on a plane', '45°', slides_at_45, 'immersed'),
    Statement('3.2', 'It slides over a quiescent part', 'quiescent', wedge_rests, 'immersed'),
    Statement('3.2', 'The dense column spreads half as far as the loose one', 'about half', spreads_half, 'run-out'),
    Statement('3.2', 'In a closed box the loose column breaks back as a wave', 'breaking wave', wave_breaks, 'closed'),
    Statement('3.3', 'The pores shrink in the loosest column only', 'δV/V₀ < 0 only there', only_the_loosest_contracts,
              'immersed'),
    Statement('3.3', 'The pores grow more the denser the column', 'increases with φ', pores_grow_with_compacity,
              'immersed'),
    Statement('3.3', 'The pores grow quickly at first, then saturate', 'two regimes', two_regimes, 'immersed'),
    Statement('-', 'Energy of the grains is accounted for', '-', energy_closes, ''),
    Statement('-', 'Momentum of the grains is accounted for', '-', momentum_closes, ''),
]


def verdict(agrees):
    return {True: 'agrees', False: 'does not agree', None: 'measured'}[agrees]


def rows(runs):
    """[section, statement, paper, ours, verdict, part] of all statements."""
    found = []
    for one in STATEMENTS:
        result = one.measure(runs)
        ours, agrees = result if result is not None else ('not played yet', None)
        found.append([one.section, one.text, one.paper, ours, '-' if result is None else verdict(agrees), one.part])
    return found
