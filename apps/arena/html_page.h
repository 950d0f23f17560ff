#pragma once

#include <string_view>

namespace runnel::arena {

/// The style of the page: one set of colours for light, one for dark surroundings.
inline constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ground: #ffffff; --card: #f6f7f9; --ink: #1f2733;
  --faint: #5b6675; --line: #d9dee5; --solid: #b9c2ce; --goal-bound: #2468d6;
  --following: #d2700f; --returning: #0f8a7e; --hit: #c9302c; --leave: #6b3fa0;
  --good: #127a45; --bad: #c9302c; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14181f; --card: #1d232c; --ink: #e6eaf0; --faint: #9aa6b5; --line: #333c48;
    --solid: #4c5869; --goal-bound: #6aa2ff; --following: #f2a154; --returning: #3fc7b8;
    --hit: #ff7b75; --leave: #b894ea; --good: #4fc98a; --bad: #ff7b75; } }
body { margin: 2rem auto; max-width: 90rem; padding: 0 1.2rem; background: var(--ground);
  color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin-bottom: 0; } h2 { font-size: 1.2rem; margin: 2rem 0 .4rem; }
p { margin: .3rem 0; color: var(--faint); }
.runs { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: .8rem; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: .5rem;
  padding: .5rem; } figure.wrong { border-color: var(--bad); }
figcaption { font-size: .85rem; color: var(--faint); } figcaption b { color: var(--ink); }
svg { width: 100%; height: 15rem; display: block; }
.wall, .shortest, .goal-bound, .following, .returning { fill: none; }
.shortest, .goal-bound, .following, .returning { vector-effect: non-scaling-stroke; }
.solid { fill: var(--solid); fill-rule: evenodd; }
.wall { stroke: var(--solid); stroke-linejoin: round; stroke-linecap: round; }
.shortest { stroke: var(--faint); stroke-width: 1.2; stroke-dasharray: 4 4; }
.goal-bound { stroke: var(--goal-bound); stroke-width: 2; }
.following { stroke: var(--following); stroke-width: 2; }
.returning { stroke: var(--returning); stroke-width: 2; }
.start { fill: var(--ink); } .goal { fill: var(--good); } .hit { fill: var(--hit); }
.leave { fill: var(--leave); } .good { color: var(--good); } .bad { color: var(--bad); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .6rem; border-bottom: 1px solid var(--line); text-align: left;
  white-space: nowrap; } td.number, th.number { text-align: right; }
th button { all: unset; cursor: pointer; font-weight: 600; } th button:focus-visible {
  outline: 2px solid var(--goal-bound); }
th[aria-sort=ascending] button::after { content: " \25b2"; }
th[aria-sort=descending] button::after { content: " \25bc"; }
.key span { margin-right: 1.2rem; white-space: nowrap; } .key i { display: inline-block;
  width: 1.4rem; height: 3px; margin-right: .4rem; vertical-align: middle; }
.key i.dot { width: .6rem; height: .6rem; border-radius: 50%; }
)";

/// Sorts a table by the column whose heading is pressed; again, the other way.
inline constexpr std::string_view kScript = R"(
document.querySelectorAll('th button').forEach(function (button) {
  button.addEventListener('click', function () {
    var head = button.parentNode, table = head.closest('table'), body = table.tBodies[0];
    var column = Array.prototype.indexOf.call(head.parentNode.children, head);
    var up = head.getAttribute('aria-sort') !== 'ascending';
    table.querySelectorAll('th').forEach(function (th) { th.removeAttribute('aria-sort'); });
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    var value = function (row) {
      var cell = row.children[column], number = parseFloat(cell.textContent);
      return head.classList.contains('number') ? (isNaN(number) ? Infinity : number)
                                               : cell.textContent;
    };
    Array.prototype.slice.call(body.rows).sort(function (a, b) {
      var x = value(a), y = value(b);
      return (x < y ? -1 : x > y ? 1 : 0) * (up ? 1 : -1);
    }).forEach(function (row) { body.appendChild(row); });
  });
});
)";

}  // namespace runnel::arena
