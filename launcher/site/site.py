# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of the project as a site that can be searched without internet.

    site.py build SOURCES SITE        the site in the folder SITE, from the Markdown of the sources as it is
    site.py show SITE [PORT]          on this machine alone, until Ctrl-C
    site.py fresh SOURCES SITE [PORT] both

Building needs mkdocs and mkdocs-material (Debian). A page without a place in mkdocs.yml, a place without a page, and a link
that leads nowhere are errors. With doxygen the site has the reference of the headers too (api/), and links to a header lead
there; without it both are left out."""
import functools
import http.server
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

CONFIGURATION = Path(__file__).resolve().parent / 'mkdocs.yml'
REFERENCE = Path('launcher/site/api')
API_PLACE = re.compile(r'^ +- API: .*\n', re.M)
LINK = re.compile(r'\]\(([^)#\s:]+)(#[^)\s]*)?\)')
BAD_INPUT, PROGRAM_FAILED = 2, 4  # exit codes, docs/running.md
PICTURES = ('.png', '.webp', '.svg')


class NotWritable(Exception):
    """The folder of the site."""


def pages_of(sources):
    """Of the top folder, docs and configs, relative to the sources."""
    found = [*sources.glob('*.md'), *sources.glob('docs/**/*.md'), *sources.glob('configs/*.md')]
    return sorted(page.relative_to(sources) for page in found)


def as_page(sources, page, reference):
    """The text of a page: links to headers lead to their pages in the reference, those to other sources of programs, which
    are no part of the site, become their names."""
    def link(match):
        target = (sources / page).parent / match[1]
        if described := reference.get(target.resolve()):
            return '](' + '../' * (len(page.parts) - 1) + f'api/{described})'
        if target.suffix == '.md' or target.suffix in PICTURES or not target.exists():
            return match[0]
        return '](' + '\0'
    text = LINK.sub(link, (sources / page).read_text())
    return re.sub(r'(?<!!)\[([^\]]*)\]\(\0', r'\1', text)


def version_of(sources):
    """That of the project, with the last commit of the headers if the sources have a history."""
    project = sources / 'CMakeLists.txt'
    version = re.search(r'project\(\w+ VERSION ([\d.]+)', project.read_text() if project.exists() else '')
    try:
        commit = subprocess.run(['git', '-C', sources, 'log', '-1', '--format=%h', '--abbrev=10', '--', 'coupler'],
                                capture_output=True, text=True, check=False).stdout.strip()
    except FileNotFoundError:
        commit = ''
    return ' '.join(part for part in (version and version[1], commit and f'({commit})') if part)


def lacking(sources):
    """What keeps the site from having the reference; empty if nothing does."""
    if not (sources / REFERENCE).is_dir():
        return f'{sources} has pages only'
    return '' if shutil.which('doxygen') else 'apt-get install doxygen'


def describe(sources, folder, more=''):
    """The reference of headers and module, made by doxygen in the folder: the page of each header, and the warnings. The
    settings are those of REFERENCE, and what more is given."""
    folder.mkdir(parents=True)
    warnings = ''
    with tempfile.TemporaryDirectory() as work:
        for part in ('python.Doxyfile', 'Doxyfile'):
            settings = (f'@INCLUDE_PATH = {REFERENCE}\n@INCLUDE = {part}\nPROJECT_NUMBER = "{version_of(sources)}"\n'
                        f'OUTPUT_DIRECTORY = "{folder}"\nGENERATE_TAGFILE = "{work}/tags.xml"\n{more}\n')
            done = subprocess.run(['doxygen', '-'], input=settings, cwd=sources, capture_output=True, text=True, check=False)
            if done.returncode:
                sys.exit(f'doxygen ended with {done.returncode}\n{done.stdout}{done.stderr}')
            warnings += done.stderr
        files = ElementTree.parse(f'{work}/tags.xml').findall("compound[@kind='file']")
    pages = {(sources / file.findtext('path') / file.findtext('name')).resolve(): file.findtext('filename') for file in files}
    return pages, warnings


def stage(sources, folder, reference):
    """Pages and their pictures in the folders they have in the sources, so that their links hold."""
    for page in pages_of(sources):
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).write_text(as_page(sources, page, reference))
    shutil.copytree(sources / 'docs/images', folder / 'docs/images')


def without_place(sources):
    """Pages that the table of contents leaves out."""
    placed = set(re.findall(r'[\w./-]+\.md', CONFIGURATION.read_text()))
    return [str(page) for page in pages_of(sources) if str(page) not in placed]


def build(sources, site):
    """Raises SystemExit with mkdocs' words, and NotWritable."""
    if shutil.which('mkdocs') is None:
        sys.exit('mkdocs is not installed: apt-get install mkdocs mkdocs-material')
    if lost := without_place(sources):
        sys.exit(f'{CONFIGURATION} has no place for {", ".join(lost)}')
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        configuration, reference = CONFIGURATION.read_text() + 'docs_dir: pages\n', {}
        if lacks := lacking(sources):
            print(f'The site is without the reference of the headers (API): {lacks}', file=sys.stderr)
            configuration = API_PLACE.sub('', configuration)
        else:
            reference, _ = describe(sources, work / 'pages/api')
        stage(sources, work / 'pages', reference)
        (work / 'mkdocs.yml').write_text(configuration)
        done = subprocess.run(['mkdocs', 'build', '--strict', '-f', work / 'mkdocs.yml', '-d', work / 'site'],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            said = [line for line in (done.stdout + done.stderr).splitlines() if not line.startswith('INFO')]
            sys.exit('\n'.join(said))
        replace(site, work / 'site')


def replace(site, built):
    """Whole or not at all: copied beside it, and renamed. NotWritable where that is not allowed."""
    try:
        site.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=site.parent, prefix=f'.{site.name}-') as beside:
            new, old = Path(beside) / 'new', Path(beside) / 'old'
            shutil.copytree(built, new)
            if site.exists():
                site.rename(old)
            new.rename(site)
    except OSError as error:
        raise NotWritable(f'{site} cannot be written: {error}') from error


def show_fresh(sources, site, port):
    """The pages as they are. Where the folder of the site may not be written, from a temporary one."""
    with tempfile.TemporaryDirectory() as work:
        try:
            build(sources, site)
        except NotWritable:
            site = Path(work) / 'site'
            build(sources, site)
        except SystemExit as error:
            print(f'{error}\nturbidite: the site cannot be built\n  The lines above say why; the pages themselves are in '
                  f'{sources / "docs"}.', file=sys.stderr)
            sys.exit(PROGRAM_FAILED)
        show(site, port)


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def show(site, port):
    """Until Ctrl-C; port 0 is a free one."""
    handler = functools.partial(Silent, directory=str(site))
    try:
        server = http.server.ThreadingHTTPServer(('127.0.0.1', port), handler)
    except OSError as error:
        print(f'turbidite: port {port} cannot be used: {error.strerror}\n  Choose another one, or leave --port out.',
              file=sys.stderr)
        sys.exit(BAD_INPUT)
    with server:
        print(f'The pages are at http://127.0.0.1:{server.server_address[1]}/ on this machine. Ctrl-C ends it.', flush=True)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            pass


if __name__ == '__main__':
    match sys.argv[1:]:
        case ['build', sources, site]:
            try:
                build(Path(sources).resolve(), Path(site).resolve())
            except NotWritable as error:
                sys.exit(str(error))
        case ['fresh', sources, site, *port]:
            show_fresh(Path(sources).resolve(), Path(site).resolve(), int(port[0]) if port else 0)
        case ['show', site, *port]:
            show(Path(site).resolve(), int(port[0]) if port else 0)
        case _:
            sys.exit(__doc__)
