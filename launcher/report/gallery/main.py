# SPDX-License-Identifier: LGPL-2.1-or-later
"""main.py PROGRAM CONFIGS EXPECTED [--quick] [--record] [--judge] [--json] [--out DIR] [NAME...]: `turbidite gallery`.

Standard input is the document EXPECTED as JSON. Exit code: 0 all holds, 1 some number does not, 2 bad usage or a fault in
the document; that of the program if it fails.
"""
import argparse
import json
import re
import signal
import sys
import time
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parents[1]))

import entries
import playing
import quantities
import records
import run_data
import runs_there


class Gallery:
    def __init__(self, options, tree):
        self.options = options
        self.configs = Path(options.configs)
        self.entries = entries.read_entries(tree, self.is_study)
        self.form = 'quick' if options.quick else 'full'

    def file(self, name):
        path = self.configs / f'{name}.yaml'
        if not path.is_file():
            raise entries.Wrong(f'{name}: there is no case or study {path}')
        return path

    def folder(self, name):
        """Of the run, or of the study's runs. None lies in that of a study: validation/bead is a case, validation a study."""
        return Path(self.options.out) / (name.replace('/', '-') + ('-quick' if self.form == 'quick' else ''))

    def is_study(self, name):
        return re.search(r'^(parts|case):', self.file(name).read_text(), re.MULTILINE) is not None

    def takes_quick(self, name):
        """Whether it is played with `study --quick`: its parts have keys for that."""
        return self.form == 'quick' and self.is_study(name) and re.search(
            r'^\s+quick:', self.file(name).read_text(), re.MULTILINE) is not None

    def entry(self, name):
        if name not in self.entries:
            meant = quantities.did_you_mean(name, self.entries)
            raise entries.Wrong(f'the gallery has no {name}. {meant}`turbidite gallery` lists all.')
        return self.entries[name]

    def form_of(self, name):
        """Wrong where there is nothing to compare with."""
        forms = self.entry(name).forms
        if self.form not in forms:
            short = ', '.join(one for one, entry in self.entries.items() if 'quick' in entry.forms)
            raise entries.Wrong(f'{name} has no short form: leave out --quick. Those that have one: {short}.')
        if not forms[self.form].expected:
            verb = 'study' if self.is_study(name) else 'run'
            raise entries.Wrong(f'{name} has no expected numbers so far: `turbidite {verb} {self.file(name)}` plays it.')
        return forms[self.form]


def list_all(gallery):
    print(f'{"case or study":<30}{"recorded":<46}{"processor":>10}{"memory":>9}  short form')
    for name, entry in gallery.entries.items():
        form = entry.forms['full']
        quick = records.told(gallery.configs, entry.forms['quick'].recorded) if 'quick' in entry.forms else '-'
        seconds, memory = spent_on(form.recorded)
        print(f'{name:<30}{records.told(gallery.configs, form.recorded):<46}{seconds:>10}{memory:>9}  {quick}')


def spent_on(recorded):
    """Empty for what was not recorded, or played in several parts."""
    if not recorded or 'processor' not in recorded:
        return '', ''
    return f'{recorded["processor"]:.0f} s', f'{recorded["memory"]:.0f} MB'


def as_json(gallery, names):
    """Of those names, or of all."""
    def of_form(form):
        bounds = [{'run': one.run, 'what': one.what, 'lowest': finite(one.lowest), 'highest': finite(one.highest)}
                  for one in form.expected]
        return {'set': form.overrides, 'expected': bounds, 'recorded': form.recorded,
                'age': form.recorded and records.age(gallery.configs, form.recorded)}
    return json.dumps({name: {'study': gallery.is_study(name), **{form: of_form(one) for form, one in entry.forms.items()}}
                       for name, entry in gallery.entries.items() if name in names or not names}, indent=2)


def finite(value):
    return value if abs(value) < entries.INF else None


def judge(form, folder):
    """Prints a line per number; how many do not hold."""
    failed, runs = 0, {}
    for one in form.expected:
        run = runs.setdefault(one.run, run_data.load_run(folder / one.run))
        value = measured(run, one.what)
        holds = one.holds(value)
        failed += not holds
        number = 'cannot be told' if value is None else f'{value:.4g} {quantities.unit(one.what)}'.rstrip()
        print(f'  {"holds" if holds else "FAILS":<8}{one.name()} = {number}, expected {one.told()}')
    return failed


def measured(run, what):
    """None, and a line that says why, for a run without the quantity."""
    try:
        return quantities.quantity(what)(run)
    except (ValueError, KeyError, OSError) as error:
        print(f'          {what}: {error}')
        return None


def play(gallery, name):
    """Exit code."""
    form, options = gallery.form_of(name), gallery.options
    folder = gallery.folder(name)
    played = records.load_played(folder) if options.judge else play_now(gallery, name, form, folder)
    if played is None or played.code is None:
        raise entries.Wrong(f'--judge compares what was played before, and no run of the gallery ended in {folder}.')
    if played.code != 0 and options.judge and is_completed(form, folder):
        played = records.Played(played.source, 0, None, None)
    if played.code != 0:
        print(f'{name}: it did not end as it should: exit code {played.code}', file=sys.stderr)
        return played.code if played.code > 0 else 128 - played.code  # negative: the signal that killed it
    require_done(form, folder)
    if options.judge:
        require_of_its_form(gallery, name, form)
    failed = judge(form, folder)
    print(f'{name}: {len(form.expected) - failed} of {len(form.expected)} numbers hold; {told_spent(played)}')
    if options.record and not failed:
        require_of_its_commit(form, folder, played.source)
        record(gallery, name, played)
    return 1 if failed else 0


def require_of_its_form(gallery, name, form):
    """Its keys may have been changed since, or somebody has played or resumed with others in the folder."""
    folder, says = gallery.folder(name), dict(map(split, form.sets()))
    played = list(map(split, played_sets(gallery, name, form)))
    lacking = [(key, None) for key in says if key not in dict(played)]
    for key, value in [*played, *lacking]:
        if value != says.get(key):
            raise entries.Wrong(f'{name}: {folder} was played {with_key(key, value)}, and the {gallery.form} form is '
                                f'{with_key(key, says.get(key))}. Play it again without --judge.')


def played_sets(gallery, name, form):
    """`key=value` of a case, or of a study, whose runs have keys of their own, with which they are begun."""
    folder, runs = gallery.folder(name), judged(form, gallery.folder(name))
    resumed = [text for run in runs for text in run.resumed_with()]
    if not gallery.is_study(name):
        return [text for run in runs for text in run.begun_with()] + resumed
    words = runs_there.study_command(folder)
    quick = gallery.takes_quick(name)
    if words and ('--quick' in words) != quick:
        raise entries.Wrong(f'{name}: {folder} was played {"without" if quick else "with"} --quick, and the '
                            f'{gallery.form} form is {"with" if quick else "without"} it. Play it again without --judge.')
    return [text for flag, text in zip(words, words[1:]) if flag == '--set'] + resumed


def split(text):
    key, _, value = text.partition('=')
    return key.strip(), value.strip()


def with_key(key, value):
    return f'without {key}' if value is None else f'with {key} = {value}'


def require_done(form, folder):
    """A study ends with 0 while another call plays the rest of it."""
    for run in judged(form, folder):
        state = 'being played' if run.is_held() else run.record.get('status') or 'not there'
        if state != 'done':
            raise entries.Wrong(f'{run.folder} is not done, and cannot be judged: it is {state}. --judge compares what is '
                                'there once it is.')


def is_completed(form, folder):
    """`turbidite resume` has played what was left by a run of the gallery that was cut off."""
    return all(run.record.get('status') == 'done' and run.was_resumed() for run in judged(form, folder))


def judged(form, folder):
    return [runs_there.run_there(folder / run) for run in sorted({one.run for one in form.expected})]


def told_spent(played):
    if played.processor is None:
        return 'played in several parts, whose time is not known'
    return f'{played.processor:.0f} s of processor time, {played.memory:.0f} MB in its largest program'


def play_now(gallery, name, form, folder):
    # Taken first: by the end of the run there may be another commit.
    source = records.source(gallery.configs, gallery.options.expected, gallery.options.program)
    is_study = gallery.is_study(name)
    continued = is_study and begin_study(gallery, folder, source)
    kept = None if is_study else records.KeptRun(folder)
    line = playing.command(gallery.options.program, gallery.file(name), form, folder, is_study, gallery.takes_quick(name))
    print(playing.shown(line), flush=True)
    begun = records.load_played(folder)
    played = playing.play(line, source)
    if kept and played.code != 0 and kept.is_still_there():  # the run was refused
        kept.restore()
        return played
    if continued or begun != records.load_played(folder):  # another call has begun, too
        played.processor = played.memory = None
    records.save_played(folder, played)
    return played


def begin_study(gallery, folder, source):
    """A study goes on with the runs that are there. Those that this program has not played, as it is now, are set aside.
    Whether others are left."""
    before = records.load_played(folder)
    runs = runs_there.runs_of_study(folder)
    if source.changed or (before and before.source.changed):
        runs_there.set_aside(runs, 'not everything is committed, and they may be of other sources')
        runs = []
    own = records.versions_of(gallery.options.program)
    runs_there.set_aside([run for run in runs if run.versions() != own],
                         f'another version or commit than {" ".join(own).strip() or "this"} has played them')
    folder.mkdir(parents=True, exist_ok=True)
    # For a call that continues this one: what it began with.
    records.save_played(folder, records.Played(source, None, None, None, time.time_ns()))
    return any(run.versions() == own for run in runs)


def require_of_its_commit(form, folder, source):
    """Somebody may have played in the folder since the gallery did, or during it."""
    for run in judged(form, folder):
        other = [commit for commit in run.commits() if not commit or not records.same_commit(commit, source.commit)]
        if other:
            raise entries.Wrong(f'--record names the commit that was played, {source.commit}, and {run.folder} is of '
                                f'{other[0] or "an unknown one"}. Play it again without --judge.')


def record(gallery, name, played):
    require_commit(played.source)
    file = Path(gallery.options.expected)
    file.write_text(records.with_record(file.read_text(), name, gallery.form, played))
    print(f'{name}: recorded in {file}')


def require_recordable(gallery):
    """Before hours of playing."""
    options = gallery.options
    source = records.source(gallery.configs, options.expected, options.program)
    if not options.judge:  # else that of the gallery's last run
        require_commit(source)
    records.require_writable(options.expected)
    text = Path(options.expected).read_text()
    for name in options.names:
        records.with_record(text, name, gallery.form, records.Played(source, 0, None, None))


def require_commit(source):
    """A record names the commit that was played."""
    if source.commit is None:
        raise entries.Wrong('--record names the commit that was played: it needs a checkout with git, or an installed '
                            'program that says its commit (--version).')
    if source.checkout:
        raise entries.Wrong(f'--record names the commit that was played: the program is of {source.commit}, and the cases '
                            f'are of {source.checkout}. Build the program anew.')
    if source.changed:
        raise entries.Wrong(f'--record names the commit that was played, and {", ".join(source.changed[:3])} '
                            'is not committed.')


def parsed(arguments):
    parser = argparse.ArgumentParser()
    for name in ('program', 'configs', 'expected'):
        parser.add_argument(name)
    parser.add_argument('--out')
    for flag in ('--quick', '--record', '--judge', '--json'):
        parser.add_argument(flag, action='store_true')
    parser.add_argument('names', nargs='*')
    return parser.parse_intermixed_args(arguments)


def act(options, tree):
    gallery = Gallery(options, tree)
    if options.json:
        for name in options.names:
            gallery.entry(name)
        print(as_json(gallery, options.names))
        return 0
    if not options.names:
        for flag in ('record', 'judge'):
            if getattr(options, flag):
                raise entries.Wrong(f'--{flag} needs the name of a case or study. `turbidite gallery` lists all.')
        list_all(gallery)
    for name in options.names:
        gallery.form_of(name)
    if options.record:
        require_recordable(gallery)
    return play_all(gallery, options.names)


def play_all(gallery, names):
    """Until one is interrupted; one that cannot be played or judged does not keep the others from it. The largest exit code."""
    codes = [0]
    for name in names:
        try:
            codes.append(play(gallery, name))
        except entries.Wrong as wrong:
            codes.append(told(wrong))
        if was_interrupted(codes[-1]):
            break
    return max(codes)


def told(wrong):
    print(f'turbidite gallery: {wrong}\nExit code 2.', file=sys.stderr)
    return 2


def was_interrupted(code):
    """By Ctrl-C or a signal (docs/running.md), or killed."""
    return code >= 128


def main(arguments):
    try:
        return act(parsed(arguments), json.load(sys.stdin))
    except entries.Wrong as wrong:
        return told(wrong)
    except KeyboardInterrupt:  # while nothing is played
        return 130


if __name__ == '__main__':
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `turbidite gallery | head`
    sys.exit(main(sys.argv[1:]))
