# SPDX-License-Identifier: LGPL-2.1-or-later
"""The style of all pages: one column on a telephone, dark where the reader's screen is, and on paper without what only a
screen can do. Pictures are drawn on white; on a dark page they stay so, a little dimmed."""

STYLE = """
:root { color-scheme: light dark; --paper: #fff; --ink: #222; --faint: #595959; --raised: #f4f4f2; --good: #2c7a3f;
        --doubt: #7a5c00; --bad: #a40000; --link: #1a4fa0; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #17191c; --ink: #dedede; --faint: #a8a8a8; --raised: #24272b; --good: #6fc583; --doubt: #dcb64e;
          --bad: #ff8a80; --link: #8ab4f8; }
  img, .legend svg { background: #fff; border-radius: 4px; } img { filter: brightness(.9); } }
@media print {
  :root { color-scheme: light; --paper: #fff; --ink: #000; --faint: #333; --raised: #fff; --good: #2c7a3f; --doubt: #7a5c00;
          --bad: #a40000; --link: #000; }
  img { filter: none; } }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em;
       color: var(--ink); background: var(--paper); overflow-wrap: break-word; }
a { color: var(--link); }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; } h3 { font-size: 1em; }
table { border-collapse: collapse; } td, th { padding: .15em 1em .15em 0; vertical-align: top; }
th { text-align: left; font-weight: 600; } td:first-child { color: var(--faint); } img { max-width: 100%; }
table.numbers td + td, table.numbers th + th { text-align: right; font-variant-numeric: tabular-nums; }
.wide { overflow-x: auto; }
table.numbers td:first-child, table.numbers th:first-child { position: sticky; left: 0; background: var(--paper); }
.links a { margin-right: 1em; }
nav { display: flex; flex-wrap: wrap; gap: .2em 1.2em; margin: 1.2em 0; }
figure { margin: 0; } figcaption { color: var(--faint); max-width: 75ch; }
.panels { display: grid; gap: 8px; align-items: start;
          grid-template-columns: repeat(auto-fill, minmax(min(100%, var(--width)), 1fr)); }
.panels img { width: 100%; }
.legend { position: sticky; top: 0; background: var(--paper); padding: .3em 0; margin: 0; }
.legend span { white-space: nowrap; margin-right: 1.2em; } .legend svg { vertical-align: middle; }
sub, sup { line-height: 0; } code { overflow-wrap: anywhere; font-size: .92em; }
.verdict { font-size: 1.1em; font-weight: 600; padding: .5em .8em; border-left: 5px solid; }
.verdict.holds { border-color: var(--good); } .verdict.doubt { border-color: var(--doubt); }
.verdict.bad { border-color: var(--bad); }
ul.checks { list-style: none; padding: 0; } ul.checks li { padding-left: 1.5em; text-indent: -1.5em; }
ul.checks li::before { display: inline-block; width: 1.5em; text-indent: 0; content: "·"; }
ul.checks li.holds::before { content: "✓"; color: var(--good); }
ul.checks li.doubt::before { content: "!"; color: var(--bad); }
.note { color: var(--faint); max-width: 75ch; } .bad { color: var(--bad); } .remark { color: var(--doubt); }
details.part > summary { font-size: 1.15em; font-weight: 600; margin-top: 2em; cursor: pointer; }
details pre { background: var(--raised); padding: 1em; overflow-x: auto; font-size: 12px; }
@media (max-width: 600px) { body { margin: 1em auto; } td, th { padding-right: .6em; } }
@media print {
  body { max-width: none; margin: 0; padding: 0; font-size: 10pt; }
  nav { display: none; } .legend { position: static; } .wide { overflow: visible; }
  table.numbers { font-size: 7pt; }
  h2, h3 { break-after: avoid; } img, tr, figcaption { break-inside: avoid; }
  .panels { grid-template-columns: repeat(auto-fill, minmax(min(48%, calc(.75 * var(--width))), 1fr)); } }
"""
