// Style of the report and script of its slider: plain CSS and a few lines of script. Nothing is
// loaded from elsewhere.
#include "report_page/page.h"

namespace nephroid {

const char* const kReportStyle = R"css(
:root { --ink: #1c1f24; --soft: #5c6470; --line: #d9dde3; --paper: #fff; --wash: #f5f6f8;
  --good: #176f3d; --bad: #b3261e; }
* { box-sizing: border-box; }
html { background: var(--paper); color: var(--ink); -webkit-text-size-adjust: 100%; }
body { font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif;
  margin: 0 auto; max-width: 1160px; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0.5rem 0 0.75rem; }
h2 { font-size: 1.4rem; margin: 3rem 0 0.75rem; padding-top: 1rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 2rem 0 0.5rem; }
p { max-width: 46rem; margin: 0.6rem 0; }
.soft, figcaption, .facts { color: var(--soft); font-size: 0.9rem; }
nav { display: flex; flex-wrap: wrap; gap: 0.3rem 1.1rem; margin: 1rem 0; }
a { color: #0b57a4; }
code, pre { font: 0.86rem/1.5 ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; }
pre { background: var(--wash); border-radius: 6px; overflow-x: auto; padding: 0.8rem 1rem; }
.wide { overflow-x: auto; margin: 0.75rem 0; }
table { border-collapse: collapse; font-size: 0.92rem; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: 0.35rem 0.9rem 0.35rem 0;
  text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 500; line-height: 1.25; max-width: 7.5rem; white-space: normal;
  vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; padding-right: 1.4rem; }
tbody tr:hover { background: var(--wash); }
td.best { color: var(--good); font-weight: 650; }
td.best::before { content: "\2605\00a0"; font-size: 0.7em; vertical-align: 0.15em; }
.claims { list-style: none; margin: 0.75rem 0; padding: 0; }
.claims > li { border: 1px solid var(--line); border-left-width: 5px; border-radius: 6px;
  margin: 0.6rem 0; padding: 0.6rem 1rem; }
.claims .holds { border-left-color: var(--good); }
.claims .fails { border-left-color: var(--bad); }
.claims p { margin: 0; max-width: none; }
.claims b { font-weight: 600; margin-right: 0.5rem; }
.claims .holds > p b { color: var(--good); }
.claims .fails > p b, .failure { color: var(--bad); }
.claims ul { color: var(--soft); font-size: 0.88rem; list-style: none; margin: 0.35rem 0 0;
  padding: 0; }
.claims ul li { padding-left: 1.3rem; text-indent: -1.3rem; }
.claims ul li::before { color: var(--good); content: "\2713"; display: inline-block;
  text-indent: 0; width: 1.3rem; }
.claims ul .no { color: var(--bad); }
.claims ul .no::before { color: var(--bad); content: "\2717"; }
.failure { background: #fdf1f0; border-radius: 6px; padding: 0.6rem 1rem; white-space: pre-wrap;
  overflow-wrap: anywhere; }
.view { margin: 1rem 0 0.5rem; max-width: 860px; }
.view .bar { align-items: center; display: flex; flex-wrap: wrap; gap: 0.5rem;
  justify-content: space-between; margin-bottom: 0.5rem; }
.view label { color: var(--soft); font-size: 0.9rem; }
.view select { background: var(--paper); border: 1px solid var(--line); border-radius: 5px;
  color: inherit; font: inherit; font-size: 0.9rem; max-width: 100%; padding: 0.25rem 0.4rem; }
.stage { background: var(--wash); border-radius: 6px; cursor: ew-resize; overflow: hidden;
  position: relative; touch-action: pan-y; user-select: none; }
.stage img { display: block; width: 100%; }
.stage .right { inset: 0; position: absolute; clip-path: inset(0 0 0 50%); }
.stage .divider { background: #fff; box-shadow: 0 0 0 1px rgba(0,0,0,.45); bottom: 0; left: 50%;
  margin-left: -1px; position: absolute; top: 0; width: 2px; pointer-events: none; }
.view input[type=range] { accent-color: #0b57a4; margin: 0.5rem 0 0; width: 100%; }
.small img { image-rendering: pixelated; }
.strip { display: grid; gap: 0.75rem; grid-auto-columns: minmax(150px, 1fr); grid-auto-flow: column;
  margin: 1rem 0; overflow-x: auto; padding-bottom: 0.4rem; }
.strip > div { max-width: 280px; }
.strip figure { margin: 0 0 0.6rem; }
.strip img { border-radius: 4px; cursor: pointer; display: block; width: 100%; }
.strip img:hover { outline: 2px solid #0b57a4; outline-offset: -2px; }
figcaption { margin-top: 0.15rem; }
.heat { background: linear-gradient(90deg, HEATSTOPS); border-radius: 3px; height: 10px; }
.heat-ends { display: flex; justify-content: space-between; }
.plots { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); }
.plot { display: block; height: auto; width: 100%; }
.plot text { fill: var(--soft); font: 12px system-ui, sans-serif; }
.plot .title { fill: var(--ink); font-size: 14px; font-weight: 600; }
.plot .grid { stroke: var(--line); } .plot .faint { stroke: #eef0f3; }
.plot .axis { fill: none; stroke: var(--soft); }
.legend { display: flex; flex-wrap: wrap; font-size: 0.9rem; gap: 0.2rem 1.2rem; }
.sample { height: 12px; margin-right: 0.4rem; vertical-align: -1px; width: 26px; }
details { margin: 0.75rem 0; } summary { cursor: pointer; }
@media print { .view .bar, .view input { display: none; } h2 { break-before: auto; } }
)css";

const char* const kReportScript = R"js(
document.querySelectorAll('.view').forEach(function (view) {
  var scene = view.parentNode;
  var pictures = {};
  scene.querySelectorAll('.strip img').forEach(function (picture) {
    pictures[picture.dataset.picture] = picture;
    picture.addEventListener('click', function () {
      selects[1].value = picture.dataset.picture;
      show();
    });
  });
  var selects = view.querySelectorAll('select');
  var sides = view.querySelectorAll('.stage img');
  var divider = view.querySelector('.divider');
  var slider = view.querySelector('input');
  function show() {
    for (var i = 0; i !== 2; i++) {
      sides[i].src = pictures[selects[i].value].src;
      sides[i].alt = pictures[selects[i].value].alt;
    }
    sides[1].style.clipPath = 'inset(0 0 0 ' + slider.value + '%)';
    divider.style.left = slider.value + '%';
  }
  function drag(event) {
    if (event.buttons === 0) return;
    var box = sides[0].getBoundingClientRect();
    slider.value = 100 * (event.clientX - box.left) / box.width;
    show();
  }
  selects.forEach(function (select) { select.addEventListener('change', show); });
  slider.addEventListener('input', show);
  view.querySelector('.stage').addEventListener('pointerdown', drag);
  view.querySelector('.stage').addEventListener('pointermove', drag);
  show();
});
)js";

}  // namespace nephroid
