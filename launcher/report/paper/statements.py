# SPDX-License-Identifier: LGPL-2.1-or-later
"""The statements of the paper beside our own numbers. Each is a function of the runs that returns (ours, agrees) with
agrees True, False or None (measured, but not enough to judge: a heap that still flows, a paper without a number); or None
where runs are missing."""
from dataclasses import dataclass

import numpy as np

import findings
from analysis import peaks
from analysis import deposit, energy, phases, pore_pressure, pores, shear_band, waves
from differences import difference
from paper import waiting
from paper.selection import COLUMNS, COMPACITIES, DENSE, LOOSE, spread

STRAIGHT = 0.9           # R^2 of a linear dependence
WEAK = 2.0               # largest ratio of slopes that still is a weak dependence
SAME_CURVE = 0.1         # largest mean difference of curves that count as similar
SLOWER = (1.0, 1.2)      # times of triangles over those of discs that count as "about 10 %"
DRY_PEAK = 9.0           # t_c
NEAR_PEAK = 1.0          # t_c: largest distance of the mean from it; columns may differ by twice that
STOPPED = 0.05           # of the peak: the largest velocity that has decreased to zero
STILL = 0.02             # u_c: the largest mean velocity of a column whose curve remains zero
BACK = 0.1               # of the largest mean velocity: the grains of a wave that runs back are faster
SATURATED = 0.5          # of the first slope of dV/V0: the largest second one that is another regime
ALIKE = 0.1              # relative spread within which values count as independent of phi
PLANE = (35.0, 55.0)     # degrees that count as 45
QUIESCENT = 0.2          # least share of the grains that makes a quiescent part
HALF = (0.35, 0.65)      # ratios that count as about half
ENERGY = 1e-3            # largest relative defects of the balances
MOMENTUM = 1e-8
FLUID_MOMENTUM = 1e-6    # limits.fluid_balance_soft


@dataclass
class Statement:
    section: str
    text: str
    paper: str
    measure: object  # function of PaperRuns
    part: str        # of the study, for the command; that of immersed columns stands for all sets of them


def value_of_peak(run):
    found = peaks.peak(run)
    return None if found is None else found.value


def time_of_peak(run):
    found = peaks.peak(run)
    return None if found is None else found.time


# --- sedimentation ------------------------------------------------------------------------------------

def triangles_are_slower(runs):
    found = [runs.of('sedimentation', variant=variant) for variant in ('triangles-nscd', 'discs-nscd')]
    if not all(found):
        return None
    times = [[findings.rest_time(run) for run in shape] for shape in found]
    if any(time is None for shape in times for time in shape):
        return 'some are not at rest by the end', None
    triangles, discs = times
    ratio = np.mean(triangles) / np.mean(discs)
    halves = [[half for half in map(findings.half_fall, shape) if half is not None] for shape in found]
    further = f'; half of the fall in {spread(halves[0])} against {spread(halves[1])} t_c' if all(halves) else ''
    return (f'rest at {spread(triangles)} against {spread(discs)} t_c: {100 * (ratio - 1):+.0f} %{further}',
            bool(SLOWER[0] < ratio < SLOWER[1]))


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


# --- dry columns --------------------------------------------------------------------------------------

def of_dry(runs, measure):
    """{phi: values}; None unless all are there."""
    found = {phi: runs.numbers(measure, 'dry', compacity=phi) for phi in COMPACITIES}
    return found if all(found.values()) else None


def by_compacity(found, form='.3g'):
    return ', '.join(f'φ = {phi}: {spread(values, form)}' for phi, values in found.items())


def dry_peak(runs):
    times = of_dry(runs, time_of_peak)
    if times is None:
        return None
    means = [np.mean(found) for found in times.values()]
    return (f'{by_compacity(times)} t_c',
            bool(abs(np.mean(means) - DRY_PEAK) < NEAR_PEAK and np.ptp(means) < 2.0 * NEAR_PEAK))


def dry_does_not_depend_on_compacity(runs):
    values = of_dry(runs, value_of_peak)
    if values is None:
        return None
    means = np.array([np.mean(found) for found in values.values()])
    return f'peaks {by_compacity(values)} u_c', bool(np.ptp(means) / means.mean() < ALIKE)


def left_of_peak(run):
    """Share of the largest |<u>| that is left at the end."""
    peak, velocity = peaks.peak(run), run.column(peaks.COLUMN)[1]
    return None if peak is None else float(velocity[-1] / peak.value)


def dry_decreases_to_zero(runs):
    """No verdict on what still falls."""
    found = {phi: runs.of('dry-rest', compacity=phi) for phi in (LOOSE, DENSE)}
    if not all(found.values()):
        return None
    shares = {phi: [left_of_peak(run) for run in there] for phi, there in found.items()}
    there = [run for group in found.values() for run in group]
    end = max(run.column(peaks.COLUMN)[0][-1] for run in there)
    text = f'at {end:.3g} t_c there is left of the peak {by_compacity(shares, ".3f")}'
    if max(map(max, shares.values())) < STOPPED:
        return text, True
    falls = any(left_of_peak(run) >= STOPPED and still_falls(run) for run in there)
    return text + (', still falling' if falls else ''), None if falls else False


def still_falls(run):
    """Over the last quarter of the run."""
    time, velocity = run.column(peaks.COLUMN)
    return velocity[-1] < np.interp(time[0] + 0.75 * (time[-1] - time[0]), time, velocity)


# --- waiting ------------------------------------------------------------------------------------------

def loose_at_once(runs):
    grid = runs.grid()
    found = {reynolds: waiting.waits(runs, reynolds, LOOSE) for reynolds, there in (grid or {}).items() if LOOSE in there}
    if not found:
        return None
    text = ', '.join(f'Re = {reynolds}: {waiting.told(times)}' for reynolds, times in found.items())
    return f't_relax {text} t_c', all(one.at_once for times in found.values() for one in times)


def dense_waits(runs):
    """One Re at a time; what has a bound waits at least that long."""
    found = dense_columns(runs)
    if found is None:
        return None
    text = '; '.join(f'Re = {reynolds}: ' + ', '.join(f'φ = {phi}: {waiting.told(times)}' for phi, times in rows.items())
                     for reynolds, rows in found.items())
    return f't_relax {text} t_c', all(one.waits for rows in found.values() for times in rows.values() for one in times)


def dense_columns(runs):
    """{Re: {phi: waiting times}} of the columns from LEAST_WAITING on; None unless all are played."""
    grid = runs.grid()
    if grid is None:
        return None
    return {reynolds: {phi: waiting.waits(runs, reynolds, phi) for phi in there if float(phi) >= waiting.LEAST_WAITING}
            for reynolds, there in grid.items()}


def stands_still(runs):
    """Mean |<u>| until t_relax, or what bounds it, of the columns that wait."""
    grid = runs.grid()
    if grid is None:
        return None
    found = {reynolds: [creep(run) for phi in there if float(phi) >= waiting.LEAST_WAITING
                        for run in runs.immersed(compacity=phi, reynolds=reynolds)] for reynolds, there in grid.items()}
    text = ', '.join(f'Re = {reynolds}: {spread(values, ".2g")}' for reynolds, values in found.items())
    return f'mean of |⟨u⟩| until t_relax {text} u_c', max(max(values) for values in found.values()) < STILL


def creep(run):
    """Mean |<u>| [u_c] until t_relax."""
    time, velocity = run.column(peaks.COLUMN)
    before = time <= max(waiting.wait(run).time, time[1])
    return float(np.trapz(velocity[before], time[before]) / (time[before][-1] - time[0]))


def waiting_lines(runs):
    """{Re: waiting.Line or None}; None if any column was not played."""
    grid = runs.grid()
    return None if grid is None else {reynolds: waiting.line(runs, reynolds, there) for reynolds, there in grid.items()}


def told_of_lines(fits, of_fit, fewer):
    return ', '.join(f'Re = {reynolds}: {of_fit(fit) if fit else fewer}' for reynolds, fit in fits.items())


def waits_linearly(runs):
    fits = waiting_lines(runs)
    if fits is None:
        return None
    fits = {reynolds: fit if fit and fit.straight is not None else None for reynolds, fit in fits.items()}
    known = [fit for fit in fits.values() if fit]
    return (told_of_lines(fits, lambda fit: f'R² = {fit.straight:.2f} of {len(fit.compacities)} compacities',
                          'fewer than three have a t_relax'),
            all(fit.straight >= STRAIGHT and fit.slope > 0.0 for fit in known) if known else None)


def slopes_are_alike(runs):
    """Where hardly a column has slid at one Re while others have at another, Re changes more than slightly."""
    fits = waiting_lines(runs)
    if fits is None or len(fits) < 2:
        return None
    slopes = [fit.slope for fit in fits.values() if fit]
    text = told_of_lines(fits, lambda fit: f'{fit.slope:.3g} t_c of {len(fit.compacities)} compacities',
                         'fewer than two have a t_relax')
    if not slopes:
        return f'slopes per unit of φ {text}', None
    return (f'slopes per unit of φ {text}',
            len(slopes) == len(fits) and min(slopes) > 0.0 and max(slopes) / min(slopes) < WEAK)


# --- largest velocities -------------------------------------------------------------------------------

@dataclass
class MeanPeak:
    value: float  # u_c
    rising: bool  # some of the runs have it at their end

    @property
    def text(self):
        return f'{self.value:.3g}' + (' (still rising)' if self.rising else '')


def mean_peak(found):
    """Of the largest |<u>| of these runs."""
    tops = [peaks.peak(run) for run in found]
    return MeanPeak(float(np.mean([top.value for top in tops])),
                    any(top.time >= run.column(peaks.COLUMN)[0][-1] for top, run in zip(tops, found)))


def mean_peaks(runs):
    """{Re: {phi: MeanPeak}}; None unless all columns are there."""
    grid = runs.grid()
    if grid is None:
        return None
    return {reynolds: {phi: mean_peak(runs.immersed(compacity=phi, reynolds=reynolds)) for phi in there}
            for reynolds, there in grid.items()}


def peak_falls_with_compacity(runs):
    """Within the time that the paper's Fig. 8 shows, like the paper's."""
    found = mean_peaks(runs)
    if found is None:
        return None
    text = '; '.join(f'Re = {reynolds}: ' + ', '.join(f'φ = {phi}: {top.text}' for phi, top in tops.items())
                     for reynolds, tops in found.items())
    falls = [(np.diff([top.value for top in tops.values()]) < 0.0).all() for tops in found.values()]
    return f'{text} u_c', all(map(bool, falls))


def peak_and_viscosity(runs):
    found = mean_peaks(runs)
    shared = [phi for phi in COMPACITIES if found and all(phi in tops for tops in found.values())]
    if not shared or len(found) < 2:
        return None
    falls = [bool((np.diff([tops[phi].value for tops in found.values()]) < 0.0).all()) for phi in shared]
    return (f'the peak falls with growing viscosity for {sum(falls)} of {len(falls)} compacities: read as "for '
            'decreasing φ and decreasing 1/Re"', all(falls))


# --- how columns collapse -----------------------------------------------------------------------------

def of_bands(runs, part):
    """What a slip band tells of the densest columns at Re 89, without those that have none."""
    found = [getattr(shear_band.shear_band(run), part, None) for run in runs.immersed(compacity=DENSE, reynolds='89')]
    return [value for value in found if value is not None]


def slides_at_45(runs):
    found = of_bands(runs, 'slip_angle')
    return (f'{spread(found)}° below the horizontal', bool(PLANE[0] <= np.mean(found) <= PLANE[1])) if found else None


def wedge_rests(runs):
    found = of_bands(runs, 'quiescent')
    if not found:
        return None
    return f'{100 * np.mean(found):.0f} % of the grains rest at half of the peak', bool(np.mean(found) > QUIESCENT)


def run_outs(runs):
    """(loose, dense) heaps: [(run, Deposit)]; None unless both are there."""
    found = [[(run, deposit.deposit(run)) for run in runs.of('run-out', compacity=phi)] for phi in (LOOSE, DENSE)]
    whole = all(found) and all(heap is not None for heaps in found for _, heap in heaps)
    return found if whole else None


def spreads_half(runs):
    """By both readings of a final spreading length. None of them is final before the heaps rest within the box."""
    found = run_outs(runs)
    if found is None:
        return None
    loose, dense = ([np.mean([getattr(heap, name) for _, heap in heaps]) for name in ('run_out', 'lengthening')]
                    for heaps in found)
    if loose[0] <= 0.0:
        return f'the loose column has not spread: (L − L₀)/L₀ = {loose[0]:.3g}', False
    ratios = [float(part / whole) for part, whole in zip(dense, loose)]
    text = (f'(L − L₀)/L₀ = {dense[0]:.3g} (dense) and {loose[0]:.3g} (loose), ratio {ratios[0]:.2g}; '
            f'L/L₀ = {dense[1]:.3g} and {loose[1]:.3g}, ratio {ratios[1]:.2g}')
    unfinished = [why for heaps in found for run, heap in heaps for why in [not_final(run, heap)] if why]
    if unfinished:
        return f'{text}; lower bounds: {", ".join(dict.fromkeys(unfinished))}', None
    half = [HALF[0] <= ratio <= HALF[1] for ratio in ratios]
    return text, half[0] if half[0] == half[1] else None


def not_final(run, heap):
    """Why the length of a heap is not its last one; empty if it is."""
    if not heap.fits:
        return 'a heap reaches the side of the box'
    if findings.rest_time(run) is None:
        return f'not at rest by {run.column("mean_speed")[0][-1]:.3g} t_c'
    return ''


def dense_is_slower(runs):
    loose, dense = ([value_of_peak(run) for run in runs.of('run-out', compacity=phi)] for phi in (LOOSE, DENSE))
    if not loose or not dense:
        return None
    return (f'peak of |⟨u⟩| {spread(dense)} (dense) against {spread(loose)} u_c (loose)', bool(max(dense) < min(loose)))


def falls_in_three_phases(runs):
    """What is missing may still come as long as the grains move."""
    there = runs.of('run-out', compacity=LOOSE)
    found = [phases.phases(run) for run in there]
    if not found or any(one is None for one in found):
        return None
    text = '; '.join(one.text for one in found)
    if all(one.complete for one in found):
        return text, True
    return text, None if any(findings.rest_time(run) is None for run in there) else False


def no_wave_on_the_dense_one(runs):
    """Beside the loose one, on which the same measure has to find waves. That there is none can be said of a flow that has
    come to rest."""
    loose, dense = (runs.of('run-out', compacity=phi) for phi in (LOOSE, DENSE))
    if not loose or not dense:
        return None
    text = f'loose: {"; ".join(map(told_wave, loose))}; dense: {"; ".join(map(told_wave, dense))}'
    if any(map(has_wave, dense)):
        return text, False
    if not all(map(has_wave, loose)):
        return text, None if any(findings.rest_time(run) is None for run in loose) else False
    return text, None if any(findings.rest_time(run) is None for run in dense) else True


def has_wave(run):
    return (waves.largest_crest(run) or 0.0) >= waves.LEAST_CREST


def told_wave(run):
    crest = waves.largest_crest(run)
    if crest is None:
        return f'it has not flowed horizontally by {run.column("mean_speed")[0][-1]:.3g} t_c'
    return f'crests of up to {crest:.2g} D while it flows horizontally'


def wave_breaks(runs):
    """The mean horizontal velocity turns round after the front has reached the right wall."""
    for run in runs.of('closed'):
        arrival = run.front_arrives()
        time, velocity = run.column('mean_velocity_x')
        if arrival is None:
            return 'the front does not reach the right wall', False
        back = float(velocity[time >= arrival].min())
        forth = float(velocity.max())
        return (f'front at the right wall at {arrival:.3g} t_c; ⟨u_x⟩ up to {forth:.2g}, then down to '
                f'{back:.2g} u_c', back < -BACK * forth)
    return None


# --- pores --------------------------------------------------------------------------------------------

def of_columns(runs, measure):
    """{phi: means} at Re 89; None unless all of them tell it."""
    there = (runs.grid() or {}).get('89', [])
    found = {phi: [measure(run) for run in runs.immersed(compacity=phi, reynolds='89')] for phi in there}
    if not found or any(value is None for values in found.values() for value in values):
        return None
    return {phi: np.mean(values, axis=0) for phi, values in found.items()}


def only_the_loosest_contracts(runs):
    found = of_columns(runs, pores.largest_change)
    if found is None:
        return None
    text = ', '.join(f'φ = {phi}: {value:+.3g}' for phi, value in found.items())
    first, *others = found.values()
    return f'{text} until δx/x₀ = {pores.AT:g}', bool(first < 0.0 and min(others) > 0.0)


def pores_grow_with_compacity(runs):
    found = of_columns(runs, pores.largest_change)
    return None if found is None else (', '.join(f'{value:+.3g}' for value in found.values()) + ' from loose to dense',
                                       bool((np.diff(list(found.values())) > 0.0).all()))


def two_regimes(runs):
    """Two lines fitted to dV/V0 against dx/x0 of the columns that dilate."""
    found = [pores.regimes(run) for phi in COMPACITIES[1:] for run in runs.immersed(compacity=phi, reynolds='89')]
    found = [one for one in found if one is not None]
    if not found:
        return None
    flatter = [one.second / one.first if one.first > 0.0 else np.inf for one in found]
    return (f'the second {spread(flatter, ".2f")} times as steep as the first, from δx/x₀ = '
            f'{spread([one.knee for one in found], ".2f")} on',
            max(flatter) < SATURATED)


def pressures(runs):
    """{phi: (lowest, highest)} inside the columns while they start."""
    return of_columns(runs, pore_pressure.while_starting)


def told_pressures(found):
    return 'inside, until half of the peak: ' + ', '.join(
        f'φ = {phi}: {low:+.2g} to {high:+.2g}' for phi, (low, high) in found.items()) + ' (ρ_s − ρ_f) g D'


def suction_holds_the_dense(runs):
    found = pressures(runs)
    dense = {phi: ends for phi, ends in (found or {}).items() if float(phi) >= waiting.LEAST_WAITING}
    if not dense:
        return None
    return told_pressures(dense), all(bool(low < 0.0 and -low > high) for low, high in dense.values())


def pressure_carries_the_loose(runs):
    found = pressures(runs)
    if found is None or LOOSE not in found:
        return None
    low, high = found[LOOSE]
    return told_pressures({LOOSE: found[LOOSE]}), bool(high > 0.0 and high > -low)


# --- balances -----------------------------------------------------------------------------------------

def largest_defect(runs, measure, most):
    found = [measure(run.data) for run in runs.done()]
    found = [value for value in found if value is not None]
    return (f'largest defect {max(found):.1e} of {len(found)} runs', max(found) < most) if found else None


def energy_closes(runs):
    # Grains between springs do not move with the velocity of a window's end, and the term of the time integration is another.
    return largest_defect(runs, lambda run: None if run.has_springs() else energy.largest_defect(run), ENERGY)


def momentum_closes(runs):
    return largest_defect(runs, lambda run: findings.largest(run, 'grain_balance', 'grain_balance'), MOMENTUM)


def fluid_momentum_closes(runs):
    return largest_defect(runs, lambda run: findings.largest(run, 'fluid_balance', 'fluid_balance') if run.is_wet() else None,
                          FLUID_MOMENTUM)


STATEMENTS = [
    Statement('2.3', 'Triangles need longer than discs to sediment', 'about 10 %', triangles_are_slower, 'sedimentation'),
    Statement('2.3', 'NSCD and MD give similar results in sedimentation', 'similar', md_is_like_nscd, 'sedimentation'),
    Statement('3.3', 'Dry columns reach their largest mean velocity', '9.0 t_c', dry_peak, 'dry'),
    Statement('3.3', 'Without fluid the compacity does not influence the mean velocity', 'the same for all',
              dry_does_not_depend_on_compacity, 'dry'),
    Statement('3.3', 'Dry, ⟨u_s⟩ then decreases to zero', 'zero', dry_decreases_to_zero, 'dry-rest'),
    Statement('3.3', 'The loosest column destabilises instantly', 't_relax = 0', loose_at_once, 'immersed'),
    Statement('3.3', 'From φ = 0.829 on columns wait', 't_relax > 0', dense_waits, 'immersed'),
    Statement('3.3', 'Meanwhile ⟨u_s⟩ remains zero', 'zero', stands_still, 'immersed'),
    Statement('3.3', 't_relax grows linearly with φ', 'linear', waits_linearly, 'immersed'),
    Statement('3.3', 'Re changes the slope only slightly', 'slightly', slopes_are_alike, 'immersed'),
    Statement('3.3', 'The largest velocity rises with falling φ', 'rises', peak_falls_with_compacity, 'immersed'),
    Statement('3.3', 'The largest velocity and Re ("increasing for a decreasing value of φ and 1/Re")', 'rises with Re',
              peak_and_viscosity, 'immersed'),
    Statement('3.2', 'The loosest column falls, then flows over a deposit, then along the floor', 'three phases',
              falls_in_three_phases, 'run-out'),
    Statement('3.2', 'The densest column slides on a plane', '45°', slides_at_45, 'immersed'),
    Statement('3.2', 'It slides over a quiescent part', 'quiescent', wedge_rests, 'immersed'),
    Statement('3.2', 'The dense avalanche is slower', 'slower', dense_is_slower, 'run-out'),
    Statement('3.2', 'The dense column spreads half as far as the loose one', 'about half', spreads_half, 'run-out'),
    Statement('3.2', 'Waves form on the loose column, none on the dense one', 'no wave', no_wave_on_the_dense_one, 'run-out'),
    Statement('3.2', 'In a closed box the loose column breaks back as a wave', 'breaking wave', wave_breaks, 'closed'),
    Statement('3.3', 'A dense column that starts to move has a negative pore pressure', 'negative',
              suction_holds_the_dense, 'immersed'),
    Statement('3.3', 'The loosest has an excessive one', 'positive', pressure_carries_the_loose, 'immersed'),
    Statement('3.3', 'The pores shrink in the loosest column only', 'δV/V₀ < 0 only there', only_the_loosest_contracts,
              'immersed'),
    Statement('3.3', 'The pores grow more the denser the column', 'increases with φ', pores_grow_with_compacity,
              'immersed'),
    Statement('3.3', 'The pores grow quickly at first, then saturate', 'two regimes', two_regimes, 'immersed'),
    Statement('-', 'Energy of the grains is accounted for', '-', energy_closes, ''),
    Statement('-', 'Momentum of the grains is accounted for', '-', momentum_closes, ''),
    Statement('-', 'Momentum of the fluid is accounted for', '-', fluid_momentum_closes, ''),
]


def verdict(agrees):
    return {True: 'agrees', False: 'does not agree', None: 'no verdict'}[agrees]


def rows(runs):
    """[section, statement, paper, ours, verdict, mesh and pores, part] of all statements, those about immersed columns once
    for each set of them."""
    return [row(one, runs.with_columns(part), part) for one in STATEMENTS
            for part in (COLUMNS if one.part == COLUMNS[0] else [one.part])]


def row(statement, runs, part):
    result = statement.measure(runs)
    ours, agrees = result if result is not None else ('not played yet', None)
    return [statement.section, statement.text, statement.paper, ours, '-' if result is None else verdict(agrees),
            runs.conditions(part) or '-', part]
