// What is looked at stands in the address, so that it survives a reload and can be sent to somebody: what is
// selected, open and folded groups, plots, panels.

import { batch, effect } from '@preact/signals';
import { PlotField, plots } from './plots/plot_list.js';
import { Choose, SetPanels, chosen, openGroups, panels } from './state/choices.js';
import { hello, revision } from './state/store.js';

const kPanels = ['tab', 'dockOpen', 'worldShown', 'worldLarge'];

/** {chosen, open: {path: bool}, plots: [{port, field, unit}], panels}; what the address says nothing of is left out. */
export function ReadAddress(hash) {
  const told = new URLSearchParams(hash.replace(/^#/, ''));
  const read = { chosen: told.getAll('at'), open: {}, plots: [], panels: {} };
  for (const path of told.getAll('open')) read.open[path] = true;
  for (const path of told.getAll('fold')) read.open[path] = false;
  for (const text of told.getAll('plot')) {
    const [port, field, unit] = Parsed(text);
    if (typeof port === 'string' && Array.isArray(field)) read.plots.push({ port, field, unit: String(unit ?? '') });
  }
  for (const name of kPanels) {
    const value = told.get(name);
    if (value !== null) read.panels[name] = name === 'tab' ? value : value === 'true';
  }
  return read;
}

export function WriteAddress({ chosen: paths, open, plots: curves, panels: shown }) {
  const told = new URLSearchParams();
  for (const path of paths) told.append('at', path);
  for (const [path, isOpen] of Object.entries(open)) told.append(isOpen ? 'open' : 'fold', path);
  for (const { port, field, unit } of curves) told.append('plot', JSON.stringify([port, field, unit]));
  for (const name of kPanels) if (name in shown) told.append(name, shown[name]);
  return `#${told.toString().replaceAll('%2F', '/')}`;
}

/** Takes the address over, and has it follow what is looked at from now on. */
export function StartAddress() {
  let awaited = Apply(location.hash);
  addEventListener('hashchange', () => batch(() => { awaited = Apply(location.hash); })); // or the plots would come with the next change
  effect(() => {
    if (revision.value === 0 || !hello.value) return;
    // Plots need to know the ports that they are of.
    for (const { port, field, unit } of awaited.splice(0)) PlotField(port, field, unit);
    const { tab, dockOpen, worldShown, worldLarge } = panels.value;
    const curves = plots.value.flatMap((plot) => plot.curves.map(({ port, field }) => ({ port, field, unit: plot.unit })));
    const hash = WriteAddress({ chosen: chosen.value, open: openGroups.value, plots: curves,
      panels: { ...(dockOpen ? { tab, dockOpen } : {}), ...(worldShown ? {} : { worldShown }), ...(worldLarge ? { worldLarge } : {}) } });
    if (hash !== location.hash) Show(hash === '#' ? `${location.pathname}${location.search}` : hash);
  });
}

function Show(address) {
  try {
    history.replaceState(null, '', address);
  } catch {
    // Browsers refuse more than some ten a second, as while an arrow key is held; the next change says it.
  }
}

/** Returns the plots that are to come. */
function Apply(hash) {
  const read = ReadAddress(hash);
  if (read.chosen.length > 0) Choose([...read.chosen.slice(1), read.chosen[0]]);
  if (Object.keys(read.open).length > 0) openGroups.value = { ...openGroups.value, ...read.open };
  SetPanels(read.panels);
  const isThere = ({ port, field }) => plots.value.some((plot) => plot.curves.some((curve) =>
    curve.port === port && JSON.stringify(curve.field) === JSON.stringify(field)));
  return read.plots.filter((curve) => !isThere(curve));
}

/** The list that a text is, or an empty one. */
function Parsed(text) {
  try {
    const list = JSON.parse(text);
    return Array.isArray(list) ? list : [];
  } catch {
    return []; // an address that somebody has cut
  }
}
