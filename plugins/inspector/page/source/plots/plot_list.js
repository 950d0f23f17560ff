// Which numbers are plotted, and where they are collected. Curves with the same unit share a plot.

import { signal } from '@preact/signals';
import { NumberAt, FieldText } from '../model/value_rows.js';
import { NameOf } from '../model/structure.js';
import { SetPanels } from '../state/choices.js';
import { structure, watches } from '../state/store.js';
import { Series } from './series.js';

const kRate = 30;      // values a second that are asked for
const kElements = 400; // of lists: an element that is plotted must not be cut off

export const plots = signal([]);      // [{id, unit, curves: [{id, port, field, label, colour, series, end}]}]
export const isPaused = signal(false);
export const plotWindow = signal(20); // s
export const pulse = signal(0);       // counts what has come, so that plots know they are old
let next = 1;

export function IsPlotted(port, field) {
  return FindCurve(port, field) !== null;
}

/** Plots a number, or takes it away. */
export function PlotField(port, field, unit) {
  const found = FindCurve(port, field);
  if (found) return RemoveCurve(found.plot.id, found.curve.id);
  const colour = FreeColour();
  const curve = { id: next++, port, field, colour, label: Label(port, field), series: new Series(), unit };
  curve.end = watches.watch(port, { rate: kRate, elements: kElements, onValue: (item) => Collect(curve, item) }).end;
  const plot = plots.value.find((candidate) => candidate.unit === unit && candidate.curves.length < 6);
  plots.value = plot
    ? plots.value.map((each) => (each === plot ? { ...each, curves: [...each.curves, curve] } : each))
    : [...plots.value, { id: next++, unit, curves: [curve] }];
  SetPanels({ tab: 'plots', dockOpen: true });
}

export function RemoveCurve(plotId, curveId) {
  plots.value = plots.value.map((plot) => {
    if (plot.id !== plotId) return plot;
    plot.curves.find((curve) => curve.id === curveId)?.end();
    return { ...plot, curves: plot.curves.filter((curve) => curve.id !== curveId) };
  }).filter((plot) => plot.curves.length > 0);
}

export function RemovePlot(plotId) {
  for (const plot of plots.value) if (plot.id === plotId) for (const curve of plot.curves) RemoveCurve(plotId, curve.id);
}

function Collect(curve, item) {
  if (item) curve.series.add(item.stamp, NumberAt(item.value, curve.field));
  else curve.series.clear();
  pulse.value += 1;
}

function FindCurve(port, field) {
  const text = FieldText(field);
  for (const plot of plots.value) {
    const curve = plot.curves.find((each) => each.port === port && FieldText(each.field) === text);
    if (curve) return { plot, curve };
  }
  return null;
}

function FreeColour() {
  const used = new Set(plots.value.flatMap((plot) => plot.curves.map((curve) => curve.colour)));
  let colour = 0;
  while (used.has(colour)) ++colour;
  return colour;
}

function Label(port, field) {
  const element = structure.get(port);
  const text = FieldText(field);
  return `${NameOf(element?.owner ?? '')}/${element?.name ?? NameOf(port)}${text ? `.${text}` : ''}`;
}
