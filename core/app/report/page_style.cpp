// SPDX-License-Identifier: BSD-2-Clause
// PageStyle returns the style sheet of the report. The series colours follow Okabe and Ito's
// palette for colour-blind readers. Each series also has a distinct marker.
#include "core/app/report/page_sections.h"

namespace exphoton::study {

std::string PageStyle() {
  return R"css(
:root{color-scheme:light dark;--bg:#fbfaf8;--card:#fff;--ink:#1c1b19;--soft:#6a665f;--rule:#e3dfd8;
--accent:#0b5fa5;--limit:#b9b2a61f;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#b0568f;--c4:#8a6d00;--c5:#4a90c2;
--p0:#7b8794;--p1:#a3adb8;--p2:#e69f00;--p3:#c8791a;--p4:#009e73;--p5:#0072b2;--p6:#cc79a7;--p7:#c9cdd2;
--noise:#56a0d3;--bias:#d55e00}
@media (prefers-color-scheme:dark){:root{--bg:#141517;--card:#1c1e21;--ink:#ecebe8;--soft:#a19d95;
--rule:#33363b;--accent:#7cc0ff;--limit:#ffffff0f;
--c0:#5ab4f0;--c1:#ff9a4d;--c2:#3fd0a4;--c3:#e39bcb;--c4:#e3c34a;--c5:#9cc9ea;
--p0:#8b97a4;--p1:#66707a;--p2:#f0b840;--p3:#d2843a;--p4:#35b890;--p5:#4aa3e0;--p6:#dc93ba;--p7:#4a5057;
--noise:#5aa9df;--bias:#ff8a3d}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--bg);color:var(--ink);
font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","DejaVu Sans",sans-serif}
main{max-width:68rem;margin:0 auto;padding:2.2rem 1.2rem 4rem}
header p.kicker{margin:0;color:var(--soft);letter-spacing:.06em;text-transform:uppercase;font-size:.78rem}
h1{font-size:clamp(1.3rem,1rem + 1.5vw,1.85rem);line-height:1.28;font-weight:650;margin:.4rem 0 1rem;
text-wrap:balance;letter-spacing:-.012em}
h2{font-size:1.2rem;margin:0 0 .35rem;letter-spacing:-.005em}
h3{font-size:1rem;margin:1.4rem 0 .5rem}
p{margin:.4rem 0 .8rem;max-width:46rem}
p.lead{color:var(--soft)}
section{background:var(--card);border:1px solid var(--rule);border-radius:12px;padding:1.25rem 1.35rem;
margin:1.2rem 0}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(13rem,1fr));gap:.2rem 1.6rem;margin:1rem 0 0}
.facts div{border-top:1px solid var(--rule);padding:.5rem 0}
.facts b{display:block;font-weight:600}
.facts span{color:var(--soft);font-size:.86rem}
.scroll{overflow-x:auto;-webkit-overflow-scrolling:touch;margin:.4rem 0}
table{border-collapse:collapse;width:100%;font-size:.88rem;font-variant-numeric:tabular-nums}
th,td{padding:.34rem .7rem .34rem 0;text-align:right;white-space:nowrap;border-bottom:1px solid var(--rule)}
th{font-weight:600;color:var(--soft);border-bottom-color:var(--soft)}
th:first-child,td:first-child{text-align:left}
td.t,th.t{text-align:left}
td.wrap{white-space:normal;min-width:9rem}
td.wide{white-space:normal;min-width:8.5rem}
.cut{fill:var(--card);font-size:12px}
td.bar{width:24%;min-width:8rem;padding-right:.4rem}
td small,th small{color:var(--soft);font-weight:400}
tr.group td{padding-top:.9rem;font-weight:600;border-bottom:0}
tr:last-child td{border-bottom:0}
.bars svg{display:block;width:100%;height:14px;border-radius:3px;background:var(--limit)}
.chart{display:block;width:100%;min-width:600px;height:auto;font-size:13px}
.chart text{fill:var(--ink)}
.chart .tick{fill:var(--soft)}.chart .axis{fill:var(--soft)}
.chart .note{fill:var(--soft);font-size:12px}
.chart .name{font-weight:650;font-size:14px}
.chart .number{font-size:11.5px;font-weight:650}
.grid{stroke:var(--rule);stroke-width:.6}.grid.major{stroke-width:1.3}
.limit{fill:var(--limit)}
.slope{stroke:var(--soft);stroke-width:1;stroke-dasharray:2 5}
.floor{stroke-width:1.2;stroke-dasharray:7 4;opacity:.8}
.series{fill:none;stroke-width:2.2;stroke-linejoin:round}
.whisker{stroke-width:1.3;opacity:.75}
.point{stroke:var(--card);stroke-width:1}
.point.hollow{fill:var(--card);stroke-width:1.5}
line.c0,polyline.c0,.hollow.c0{stroke:var(--c0)}line.c1,polyline.c1,.hollow.c1{stroke:var(--c1)}
line.c2,polyline.c2,.hollow.c2{stroke:var(--c2)}line.c3,polyline.c3,.hollow.c3{stroke:var(--c3)}
line.c4,polyline.c4,.hollow.c4{stroke:var(--c4)}line.c5,polyline.c5,.hollow.c5{stroke:var(--c5)}
.point.c0{fill:var(--c0)}.point.c1{fill:var(--c1)}.point.c2{fill:var(--c2)}
.point.c3{fill:var(--c3)}.point.c4{fill:var(--c4)}.point.c5{fill:var(--c5)}
.point.hollow{fill:var(--card)}
.chart .textc0{fill:var(--c0)}.chart .textc1{fill:var(--c1)}.chart .textc2{fill:var(--c2)}
.chart .textc3{fill:var(--c3)}.chart .textc4{fill:var(--c4)}.chart .textc5{fill:var(--c5)}
.p0{fill:var(--p0);--k:var(--p0)}.p1{fill:var(--p1);--k:var(--p1)}.p2{fill:var(--p2);--k:var(--p2)}
.p3{fill:var(--p3);--k:var(--p3)}.p4{fill:var(--p4);--k:var(--p4)}.p5{fill:var(--p5);--k:var(--p5)}
.p6{fill:var(--p6);--k:var(--p6)}.p7{fill:var(--p7);--k:var(--p7)}
.noise{fill:var(--noise);--k:var(--noise)}.bias{fill:var(--bias);--k:var(--bias)}
i.dot{display:inline-block;width:.72em;height:.72em;border-radius:50%;margin-right:.45em;background:var(--k)}
i.key{display:inline-block;width:.85em;height:.85em;border-radius:3px;margin:0 .4em 0 0;vertical-align:-.06em;
background:var(--k)}
i.k0{--k:var(--c0)}i.k1{--k:var(--c1)}i.k2{--k:var(--c2)}i.k3{--k:var(--c3)}i.k4{--k:var(--c4)}i.k5{--k:var(--c5)}
.keys{display:flex;flex-wrap:wrap;gap:.2rem 1.1rem;font-size:.84rem;color:var(--soft);margin:.3rem 0 .6rem}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,11.5rem),1fr));gap:1rem}
figure{margin:0;break-inside:avoid}
figure img{display:block;width:100%;height:auto;margin-bottom:.35rem;border-radius:4px}
img.pixels{image-rendering:pixelated}
figcaption{font-size:.84rem;line-height:1.4}
figcaption small{display:block;color:var(--soft)}
.maps{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,17rem),1fr));gap:1.2rem}
.legend{display:flex;align-items:center;gap:.5rem;font-size:.8rem;color:var(--soft);margin:.1rem 0 .3rem}
.ramp{flex:1;height:.6rem;border-radius:3px;min-width:3rem}
.best{font-weight:700;color:var(--accent)}
.refused{color:var(--soft);font-style:italic}
.alarm{color:var(--bias);font-weight:650}
details{margin:.6rem 0}summary{cursor:pointer;font-weight:600}
pre{overflow-x:auto;font:.8rem/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,"DejaVu Sans Mono",monospace;
background:var(--bg);border:1px solid var(--rule);border-radius:8px;padding:.8rem}
footer{color:var(--soft);font-size:.82rem;margin-top:1.6rem}
@media (max-width:40rem){main{padding:1.2rem .7rem 3rem}section{padding:1rem .85rem;border-radius:10px}
table{font-size:.8rem}td.bar{min-width:4.6rem}td.wrap{min-width:6.6rem}th,td{padding-right:.5rem}}
@media print{.pictures{grid-template-columns:repeat(auto-fill,minmax(7.6rem,1fr));gap:.6rem}
:root{color-scheme:light;--bg:#fff;--card:#fff;--ink:#000;--soft:#555;--rule:#ccc;--accent:#0b5fa5;
--limit:#0000000f;--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#b0568f;--c4:#8a6d00;--c5:#4a90c2;
--noise:#56a0d3;--bias:#d55e00}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}
body{font-size:11pt}main{max-width:none;padding:0}section{border:0;padding:0;margin:1.2rem 0}
h2,h3{break-after:avoid}tr,.chart{break-inside:avoid}.scroll{overflow:visible}.chart{min-width:0}
table{font-size:8pt}th,td{padding-right:.35rem;white-space:normal}pre{white-space:pre-wrap;word-break:break-all}
details::details-content{display:block;content-visibility:visible;height:auto}}
)css";
}

}  // namespace exphoton::study
