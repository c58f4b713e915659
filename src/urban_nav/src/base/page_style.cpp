// SPDX-License-Identifier: BSD-3-Clause
#include "base/page_style.hpp"

namespace urban_nav {

const char* pageStyle() {
  return R"css(
:root { color-scheme: light dark; --ink: #1d2430; --soft: #5d6877; --paper: #fbfaf8; --card: #ffffff; --edge: #e3e0da; --grid: #ebe8e2;
  --a: #1f6feb; --b: #d9480f; --c: #0c8599; --d: #9c36b5; --good: #2b8a3e; --fair: #c67c00; --bad: #c92a2a; --plain: #5d6877; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8eb; --soft: #9aa4b2; --paper: #14171c; --card: #1c2027; --edge: #2d333d; --grid: #2a2f38;
  --a: #6ea8fe; --b: #ff922b; --c: #3bc9db; --d: #da77f2; --good: #51cf66; --fair: #fcc419; --bad: #ff6b6b; --plain: #9aa4b2; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
header, main, footer { max-width: 1180px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 28px; }
h1 { font-size: 1.9rem; margin: 0; letter-spacing: -0.01em; overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 44px 0 6px; padding-top: 14px; border-top: 1px solid var(--edge); }
p, figcaption { overflow-wrap: anywhere; } td { overflow-wrap: break-word; }
h3 { font-size: 0.98rem; margin: 0 0 8px; }
.subtitle { color: var(--soft); margin: 4px 0 10px; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 0.92rem; }
nav a { color: var(--a); text-decoration: none; } nav a:hover { text-decoration: underline; }
.running { position: relative; border: 1px solid var(--edge); border-radius: 8px; overflow: hidden; margin: 8px 0 12px; background: var(--card); }
.running .bar { position: absolute; inset: 0 auto 0 0; background: var(--a); opacity: 0.22; }
.running span { position: relative; display: block; padding: 6px 12px; font-size: 0.9rem; }
.tiles { display: grid; grid-template-columns: repeat(var(--across), 1fr); gap: 12px; margin: 22px 0; }
@media (max-width: 760px) { .tiles { grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); } }
.tile { background: var(--card); border: 1px solid var(--edge); border-left: 4px solid var(--edge); border-radius: 8px; padding: 12px 14px; }
.tile.good { border-left-color: var(--good); } .tile.fair { border-left-color: var(--fair); } .tile.bad { border-left-color: var(--bad); }
.value { font-size: 1.55rem; font-weight: 650; line-height: 1.2; font-variant-numeric: tabular-nums; } .value small { font-size: 0.85rem; font-weight: 450; color: var(--soft); }
.what { color: var(--soft); font-size: 0.86rem; }
.verdicts { list-style: none; margin: 0 0 8px; padding: 0; display: grid; gap: 8px; }
.verdicts li { display: flex; gap: 12px; align-items: baseline; background: var(--card); border: 1px solid var(--edge); border-radius: 8px; padding: 9px 14px; }
.mark { flex: none; width: 1.45em; height: 1.45em; border-radius: 50%; text-align: center; line-height: 1.45em; font-size: 0.85rem; font-weight: 700; color: var(--card); background: var(--plain); }
.good .mark { background: var(--good); } .fair .mark { background: var(--fair); } .bad .mark { background: var(--bad); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(480px, 100%), 1fr)); gap: 16px; margin: 14px 0; }
figure { margin: 0; background: var(--card); border: 1px solid var(--edge); border-radius: 8px; padding: 14px; min-width: 0; break-inside: avoid; }
figure.wide { grid-column: 1 / -1; }
figcaption, .caption { color: var(--soft); font-size: 0.86rem; margin-top: 6px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); gap: 16px; margin: 14px 0; }
img { max-width: 100%; height: auto; display: block; border-radius: 4px; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 16px; font-size: 0.84rem; color: var(--soft); margin-bottom: 4px; }
.key { display: inline-flex; align-items: center; gap: 6px; } .key i { width: 18px; height: 0; border-top: 3px solid; display: inline-block; }
.key i.dash { border-top-style: dashed; } .key i.block { height: 10px; border: 0; background: currentColor; opacity: 0.35; } .key i.round { width: 9px; height: 9px; border: 0; border-radius: 50%; background: currentColor; }
svg.plot { width: 100%; height: auto; display: block; overflow: visible; }
.grid { stroke: var(--grid); stroke-width: 1; } .tick { fill: var(--soft); font-size: 11px; } .label { fill: var(--soft); font-size: 12px; }
.line { fill: none; stroke: currentColor; stroke-width: 1.9; stroke-linejoin: round; stroke-linecap: round; } .dashed { stroke-dasharray: 6 4; } .faint { stroke-width: 0.8; opacity: 0.4; }
.band { fill: currentColor; opacity: 0.18; } .bar, .dot { fill: currentColor; } .span { fill: currentColor; opacity: 0.16; }
.c-a { color: var(--a); } .c-b { color: var(--b); } .c-c { color: var(--c); } .c-d { color: var(--d); } .c-good { color: var(--good); } .c-fair { color: var(--fair); } .c-bad { color: var(--bad); } .c-plain { color: var(--plain); }
.cross { stroke: var(--soft); stroke-width: 1; stroke-dasharray: 3 3; pointer-events: none; }
.read { fill: var(--ink); font-size: 12px; paint-order: stroke; stroke: var(--card); stroke-width: 4px; pointer-events: none; }
.scroll { overflow-x: auto; margin: 8px 0; } .long { max-height: 480px; overflow-y: auto; } table { border-collapse: collapse; font-size: 0.9rem; min-width: 50%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 5px 14px 5px 0; border-bottom: 1px solid var(--edge); vertical-align: top; } th { color: var(--soft); font-weight: 550; }
td.lines { white-space: pre-wrap; } td a { color: var(--a); } tr:target { background: var(--grid); }
footer { color: var(--soft); font-size: 0.85rem; padding-top: 26px; padding-bottom: 40px; }
@media print { :root { --paper: #fff; --card: #fff; } nav, .running { display: none; } body { font-size: 11pt; } h2 { break-after: avoid; } }
)css";
}

const char* pageScript() {
  return R"js(
"use strict";
for (const plot of document.querySelectorAll("svg.plot")) {
  const area = plot.querySelector("svg.area"), make = (name) => document.createElementNS("http://www.w3.org/2000/svg", name);
  const line = make("line"), text = make("text"), [left, top, width, height] = area.getAttribute("viewBox").split(" ").map(Number);
  line.setAttribute("class", "cross"); text.setAttribute("class", "read");
  const at = (share, low, high) => Number(low) + share * (high - low);
  const shown = (value, span) => value.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(Math.abs(span) || 1)))));
  plot.addEventListener("pointermove", (event) => {
    const box = plot.getBoundingClientRect(), view = plot.viewBox.baseVal;
    const u = (event.clientX - box.left) / box.width * view.width, v = (event.clientY - box.top) / box.height * view.height;
    if (u < left || u > left + width || v < top || v > top + height) { line.remove(); text.remove(); return; }
    const d = plot.dataset, x = at((u - left) / width, d.x0, d.x1), y = at(1 - (v - top) / height, d.y0, d.y1);
    for (const [key, value] of [["x1", u], ["x2", u], ["y1", top], ["y2", top + height]]) line.setAttribute(key, value);
    text.textContent = `${shown(x, d.x1 - d.x0)} | ${shown(y, d.y1 - d.y0)}`;
    text.setAttribute("x", u > left + 0.75 * width ? u - 8 : u + 8); text.setAttribute("y", Math.max(top + 14, v - 8));
    text.setAttribute("text-anchor", u > left + 0.75 * width ? "end" : "start");
    plot.append(line, text);
  });
  plot.addEventListener("pointerleave", () => { line.remove(); text.remove(); });
}
)js";
}

}  // namespace urban_nav
